//! The charts of Hübner et al.: rates of blended splats in eight views over that of one view, and errors against a pass for each view.

use super::chart::{Area, COLOURS, Drawing, GREY, INK, font, save};
use super::error::BenchError;
use super::table::columns;
use crate::points::charts::{Chart, Way};
use plotters::prelude::*;
use serde::Serialize;
use std::path::Path;

/// What was measured.
#[derive(Debug, Serialize)]
pub struct Splats {
    /// When, RFC 3339.
    pub date: String,
    /// By which command.
    pub command: Vec<String>,
    /// Name of the preset.
    pub preset: &'static str,
    /// A row for each cloud and size.
    pub rows: Vec<Chart>,
}

/// Names of the ways, as the paper and this project have them.
const WAYS: [&str; 4] = [
    "8 passes",
    "paper, vertices",
    "paper, fragments",
    "subpixels",
];

/// The way's rate over that of one view, and its picture's errors; the passes are what errors are measured against.
fn ways(row: &Chart) -> [(f64, Option<&Way>); 4] {
    let one_pass = [&row.vertex, &row.fragment, &row.subpixels];
    let [a, b, c] = one_pass.map(|way| (row.single / way.time, Some(way)));
    [(row.single / row.passes, None), a, b, c]
}

/// The table for people.
#[must_use]
pub fn text(splats: &Splats) -> String {
    let head = [
        "points",
        "pixels",
        "groups",
        "one view, ms",
        "way",
        "rate",
        "wrong, %",
        "PSNR, dB",
        "SSIM",
    ];
    let mut lines = vec![head.map(str::to_owned).to_vec()];
    for row in &splats.rows {
        for (name, (rate, way)) in WAYS.iter().zip(ways(row)) {
            let psnr = |way: &Way| {
                way.psnr
                    .map_or("exact".to_owned(), |psnr| format!("{psnr:.1}"))
            };
            lines.push(vec![
                row.points.to_string(),
                format!("{0}x{0}", row.size),
                row.groups.to_string(),
                format!("{:.1}", row.single),
                (*name).to_owned(),
                format!("{rate:.2}"),
                way.map_or_else(String::new, |way| format!("{:.3}", way.wrong)),
                way.map_or_else(String::new, psnr),
                way.map_or_else(String::new, |way| format!("{:.4}", way.ssim)),
            ]);
        }
    }
    columns(&lines)
}

/// Writes a line for each cloud, size and way.
///
/// # Errors
/// The file cannot be written.
pub fn write_csv(splats: &Splats, file: &Path) -> Result<(), BenchError> {
    let failed = |error: csv::Error| BenchError::Write {
        file: file.to_owned(),
        reason: error.to_string(),
    };
    let mut writer = csv::Writer::from_path(file).map_err(failed)?;
    let head = [
        "points",
        "size",
        "groups",
        "way",
        "rate",
        "wrong_percent",
        "psnr",
        "ssim",
    ];
    writer.write_record(head).map_err(failed)?;
    for row in &splats.rows {
        for (name, (rate, way)) in WAYS.iter().zip(ways(row)) {
            let number = |value: Option<f64>| value.map_or_else(String::new, |v| v.to_string());
            let record = [
                row.points.to_string(),
                row.size.to_string(),
                row.groups.to_string(),
                (*name).to_owned(),
                rate.to_string(),
                number(way.map(|way| way.wrong)),
                number(way.and_then(|way| way.psnr)),
                number(way.map(|way| way.ssim)),
            ];
            writer.write_record(record).map_err(failed)?;
        }
    }
    writer.flush().map_err(|error| failed(error.into()))
}

/// Draws a group of bars for each cloud and size: the rate of each way in per cent of that of one view (the paper's chart 3).
///
/// # Errors
/// The file cannot be written, or its name is of no format.
pub fn write_chart(splats: &Splats, file: &Path) -> Result<(), BenchError> {
    save(splats, file)
}

/// Pixels of a group of bars, of the chart's height, and of the title.
const GROUP: u32 = 300;
const HEIGHT: u32 = 560;
const TITLE: u32 = 130;

impl Drawing for Splats {
    fn size(&self) -> (u32, u32) {
        (140 + GROUP * self.rows.len().max(3) as u32, TITLE + HEIGHT)
    }

    fn draw<B: DrawingBackend>(
        &self,
        area: &Area<B>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        area.fill(&WHITE)?;
        let title = format!("{}: rate in per cent of that of one view", self.preset);
        area.draw(&Text::new(title, (24, 16), font(32)))?;
        let told = format!("over the bars: wrong subpixels in per cent; {}", self.date);
        area.draw(&Text::new(told, (24, 54), font(19).color(&GREY)))?;
        for (at, (name, colour)) in WAYS.iter().zip(COLOURS).enumerate() {
            let left = 24 + 200 * at as i32;
            let mark = [(left, 92), (left + 18, 110)];
            area.draw(&Rectangle::new(mark, colour.filled()))?;
            area.draw(&Text::new(*name, (left + 26, 90), font(19).color(&INK)))?;
        }
        let below = area.clone().shrink((0, TITLE), (self.size().0, HEIGHT));
        let all = self.rows.iter().flat_map(ways);
        let most = all.map(|(rate, _)| rate).fold(1.0, f64::max) * 110.0;
        let mut chart = ChartBuilder::on(&below)
            .margin(12)
            .x_label_area_size(40)
            .y_label_area_size(84)
            .build_cartesian_2d(0.0..self.rows.len() as f64, 0.0..most)?;
        let name = |at: usize| {
            let row = self.rows.get(at);
            row.map_or_else(String::new, |row| {
                format!("{} points, {} px", row.points, row.size)
            })
        };
        chart
            .configure_mesh()
            .disable_x_mesh()
            .disable_x_axis()
            .y_desc("per cent")
            .bold_line_style(RGBColor(228, 230, 235))
            .light_line_style(TRANSPARENT)
            .axis_style(GREY)
            .label_style(font(18))
            .draw()?;
        for (at, row) in self.rows.iter().enumerate() {
            let label = Text::new(
                name(at),
                (at as f64 + 0.12, -0.025 * most),
                font(18).color(&INK),
            );
            chart.draw_series([label])?;
            for (bar, ((rate, way), colour)) in ways(row).into_iter().zip(COLOURS).enumerate() {
                let left = at as f64 + 0.1 + 0.2 * bar as f64;
                let top = 100.0 * rate;
                let corners = [(left, 0.0), (left + 0.17, top)];
                chart.draw_series([Rectangle::new(corners, colour.filled())])?;
                if let Some(way) = way {
                    let text = format!("{:.2}", way.wrong);
                    let place = (left + 0.02, top + 0.045 * most);
                    chart.draw_series([Text::new(text, place, font(17).color(&INK))])?;
                }
            }
        }
        area.present()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured() -> Splats {
        let way = |time, psnr, wrong| Way {
            time,
            psnr,
            ssim: 1.0,
            wrong,
        };
        let row = Chart {
            points: 1000,
            size: 64,
            groups: 5,
            single: 10.0,
            passes: 80.0,
            vertex: way(25.0, Some(20.0), 5.0),
            fragment: way(20.0, Some(20.0), 5.0),
            subpixels: way(40.0, None, 0.0),
        };
        Splats {
            date: "2026".to_owned(),
            command: Vec::new(),
            preset: "huebner-chart1",
            rows: vec![row],
        }
    }

    #[test]
    fn rates_are_over_one_view() {
        let text = text(&measured());
        let lines: Vec<Vec<&str>> = text
            .lines()
            .map(|line| line.split_whitespace().collect())
            .collect();
        assert_eq!(
            lines[1],
            ["1000", "64x64", "5", "10.0", "8", "passes", "0.12"]
        );
        let last = [
            "1000",
            "64x64",
            "5",
            "10.0",
            "subpixels",
            "0.25",
            "0.000",
            "exact",
            "1.0000",
        ];
        assert_eq!(lines[4], last);
    }

    #[test]
    fn files_have_every_way() {
        let folder = tempfile::tempdir().unwrap();
        let (csv, chart) = (folder.path().join("a.csv"), folder.path().join("a.png"));
        write_csv(&measured(), &csv).unwrap();
        assert_eq!(std::fs::read_to_string(csv).unwrap().lines().count(), 5);
        write_chart(&measured(), &chart).unwrap();
        let picture = image::open(chart).unwrap().to_rgb8();
        for RGBColor(r, g, b) in &COLOURS[..4] {
            assert!(picture.pixels().any(|pixel| pixel.0 == [*r, *g, *b]));
        }
    }
}
