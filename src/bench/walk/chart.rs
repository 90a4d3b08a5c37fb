//! True views, rate, error and disocclusions of each frame, in plots one above the other.

use super::Walk;
use crate::bench::chart::{Area, COLOURS, Drawing, GREY, INK, font, save};
use crate::bench::error::BenchError;
use plotters::prelude::*;
use std::path::Path;

/// Pixels of one plot, and of the title.
const PLOT: (u32, u32) = (1200, 260);
const TITLE: u32 = 84;
/// The PSNR that stands for equal pictures, dB.
const EXACT: f64 = 100.0;

/// Draws the walk into a file.
pub fn write(walk: &Walk, file: &Path) -> Result<(), BenchError> {
    save(walk, file)
}

/// One of the plots.
struct Plot<'a> {
    about: &'a str,
    /// Values by frame; the first line is the one that the text describes.
    lines: Vec<Vec<(f64, f64)>>,
    /// A horizontal line.
    bound: Option<f64>,
    from: f64,
    to: f64,
}

impl Walk {
    fn plots(&self) -> [Plot<'static>; 4] {
        let line = |value: &dyn Fn(&super::Frame) -> f64| {
            let points = self.frames.iter().map(|f| (f.frame as f64, value(f)));
            points.collect::<Vec<_>>()
        };
        let rates = vec![line(&|f| 1e3 / f.ms), line(&|f| 1e3 / f.exact_ms)];
        let highest = rates
            .iter()
            .flatten()
            .map(|(_, y)| *y)
            .fold(self.rate, f64::max);
        let holes = line(&|f| f.hole_percent);
        let most = holes.iter().map(|(_, y)| *y).fold(0.5, f64::max);
        [
            Plot {
                about: "views drawn",
                lines: vec![line(&|f| f64::from(f.drawn))],
                bound: None,
                from: 0.0,
                to: f64::from(self.views) + 0.5,
            },
            Plot {
                about: "frames/s; all drawn",
                lines: rates,
                bound: Some(self.rate),
                from: 0.0,
                to: 1.1 * highest,
            },
            Plot {
                about: "PSNR, dB",
                lines: vec![line(&|f| f.psnr.unwrap_or(EXACT).min(EXACT))],
                bound: Some(30.0),
                from: 25.0,
                to: 60.0,
            },
            Plot {
                about: "holes, %",
                lines: vec![holes],
                bound: None,
                from: 0.0,
                to: 1.1 * most,
            },
        ]
    }
}

impl Drawing for Walk {
    fn size(&self) -> (u32, u32) {
        (PLOT.0, TITLE + 4 * PLOT.1)
    }

    fn draw<B: DrawingBackend>(
        &self,
        area: &Area<B>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        area.fill(&WHITE)?;
        let title = format!("{} views at {} frames per second", self.views, self.rate);
        area.draw(&Text::new(title, (24, 16), font(32)))?;
        let told = format!("{}, {}", self.command.join(" "), self.date);
        area.draw(&Text::new(told, (24, 54), font(19).color(&GREY)))?;
        let ends = [self.frames.first(), self.frames.last()];
        let [first, last] = ends.map(|frame| frame.map_or(0.0, |frame| frame.frame as f64));
        for (at, plot) in self.plots().iter().enumerate() {
            let below = area.clone().shrink((0, TITLE + at as u32 * PLOT.1), PLOT);
            let mut chart = ChartBuilder::on(&below)
                .margin(12)
                .margin_right(30)
                .x_label_area_size(34)
                .y_label_area_size(84)
                .build_cartesian_2d(first..last.max(first + 1.0), plot.from..plot.to)?;
            chart
                .configure_mesh()
                .y_desc(plot.about)
                .y_labels(6)
                .x_label_formatter(&|frame| format!("{frame:.0}"))
                .y_label_formatter(&|value| {
                    let text = format!("{value:.1}");
                    text.strip_suffix(".0").unwrap_or(&text).to_owned()
                })
                .light_line_style(TRANSPARENT)
                .bold_line_style(RGBColor(228, 230, 235))
                .axis_style(GREY)
                .label_style(font(18))
                .draw()?;
            if let Some(bound) = plot.bound {
                let ends = [(first, bound), (last, bound)];
                chart.draw_series(DashedLineSeries::new(ends, 6, 5, INK.stroke_width(1)))?;
            }
            for (line, colour) in plot.lines.iter().zip(COLOURS).rev() {
                let points = line.iter().map(|(x, y)| (*x, y.clamp(plot.from, plot.to)));
                chart.draw_series(LineSeries::new(points, colour.stroke_width(2)))?;
            }
        }
        area.present()
    }
}
