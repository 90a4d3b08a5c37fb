//! Time against error: a panel for each scene and size, a mark for each configuration, and the Pareto front of each number of views.

use super::error::BenchError;
use super::outcome::{Bench, Row};
use super::pareto::front;
use image::RgbImage;
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};
use std::collections::BTreeSet;
use std::path::Path;

/// Pixels of a panel.
const PANEL: (u32, u32) = (800, 560);
/// Pixels of the title, and of one line of the legend.
const TITLE: u32 = 84;
const LEGEND: u32 = 36;
/// Pixels for one word of the legend.
const WORD: u32 = 260;
pub(super) const INK: RGBColor = RGBColor(40, 44, 52);
pub(super) const GREY: RGBColor = RGBColor(150, 155, 165);
/// Colours that people with any kind of colour blindness tell apart (Okabe and Ito, "Color universal design", 2008).
pub(super) const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(90, 90, 90),
];

/// Place of equal pictures on the axis, whose PSNR is infinite: above all others, and above the resolution of 8 bits.
const EXACT: f64 = 100.0;

pub(super) type Area<'a, B> = DrawingArea<B, Shift>;
type Plane<'a, B> = ChartContext<'a, B, Cartesian2d<LogCoord<f64>, RangedCoordf64>>;

/// The formats of [`write()`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Pixels.
    Png,
    /// Lines.
    Svg,
}

impl Format {
    /// By the end of a file's name.
    pub fn of(file: &Path) -> Result<Self, BenchError> {
        match file.extension().and_then(|end| end.to_str()) {
            Some("png") => Ok(Self::Png),
            Some("svg") => Ok(Self::Svg),
            _ => Err(BenchError::ChartName(file.to_owned())),
        }
    }
}

/// The contents of a chart, for [`save`].
pub(super) trait Drawing {
    /// Width and height, pixels.
    fn size(&self) -> (u32, u32);

    /// Draws the whole chart.
    fn draw<B: DrawingBackend>(
        &self,
        area: &Area<B>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>>;
}

/// Draws the chart into a file.
pub fn write(bench: &Bench, file: &Path) -> Result<(), BenchError> {
    save(&Chart::new(bench), file)
}

/// Draws into a file of either format.
pub(super) fn save(drawing: &impl Drawing, file: &Path) -> Result<(), BenchError> {
    let failed = |reason: &dyn std::fmt::Display| BenchError::Write {
        file: file.to_owned(),
        reason: reason.to_string(),
    };
    // Both formats need a font: one to draw with, the other to measure words. The machine may have none.
    register_font(
        "sans-serif",
        FontStyle::Normal,
        epaint_default_fonts::UBUNTU_LIGHT,
    )
    .map_err(|_| BenchError::Chart("the built-in font cannot be read".to_owned()))?;
    let (width, height) = drawing.size();
    match Format::of(file)? {
        Format::Png => {
            let mut pixels = vec![0; 3 * width as usize * height as usize];
            let area = BitMapBackend::with_buffer(&mut pixels, (width, height));
            drawn(drawing, &area.into_drawing_area())?;
            let picture = RgbImage::from_raw(width, height, pixels).unwrap_or_default();
            picture.save(file).map_err(|error| failed(&error))
        }
        Format::Svg => {
            let mut text = String::new();
            let area = SVGBackend::with_string(&mut text, (width, height));
            drawn(drawing, &area.into_drawing_area())?;
            std::fs::write(file, text).map_err(|error| failed(&error))
        }
    }
}

fn drawn<B: DrawingBackend>(drawing: &impl Drawing, area: &Area<B>) -> Result<(), BenchError> {
    let drawn = drawing.draw(area);
    drawn.map_err(|error| BenchError::Chart(error.to_string()))
}

/// The contents of the chart.
struct Chart<'a> {
    bench: &'a Bench,
    /// The rows of each panel.
    panels: Vec<Vec<&'a Row>>,
    /// Names of the configurations, in the order of their colours.
    names: Vec<&'a str>,
    columns: u32,
}

impl<'a> Chart<'a> {
    fn new(bench: &'a Bench) -> Self {
        let mut panels: Vec<Vec<&Row>> = Vec::new();
        let mut names: Vec<&str> = Vec::new();
        for row in &bench.rows {
            let place = |row: &Row| (row.scene, row.width, row.height);
            match panels.iter_mut().find(|panel| {
                panel
                    .first()
                    .is_some_and(|first| place(first) == place(row))
            }) {
                Some(panel) => panel.push(row),
                None => panels.push(vec![row]),
            }
            if !names.contains(&row.configuration.as_str()) {
                names.push(&row.configuration);
            }
        }
        let columns = match panels.len() {
            0 | 1 => 1,
            2..=4 => 2,
            _ => 3,
        };
        Self {
            bench,
            panels,
            names,
            columns,
        }
    }

    /// Words of the legend in a line.
    fn words(&self) -> u32 {
        (self.columns * PANEL.0 - 48) / WORD
    }

    /// The configurations and the front.
    fn legend_lines(&self) -> u32 {
        (self.names.len() as u32 + 1).div_ceil(self.words())
    }

    fn panel<B: DrawingBackend>(
        &self,
        area: &Area<B>,
        rows: &[&Row],
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let Some(first) = rows.first() else {
            return Ok(());
        };
        let points: Vec<_> = rows.iter().map(|row| place(row)).collect();
        let lowest = points.iter().map(|(_, y)| *y).fold(60.0, f64::min);
        let bottom = ((lowest - 5.0) / 10.0).floor() * 10.0;
        let most = rows.iter().map(|row| row.times.high).fold(1.0, f64::max) * 1.4;
        let least = rows.iter().map(|row| row.times.low).fold(1.0, f64::min) / 1.2;
        let title = format!(
            "{}, {}x{}, bare {:.1} ms",
            first.scene, first.width, first.height, first.bare_ms.median
        );
        let mut chart: Plane<B> = ChartBuilder::on(area)
            .caption(title, font(25))
            .margin(18)
            .x_label_area_size(64)
            .y_label_area_size(84)
            .build_cartesian_2d((least..most).log_scale().base(2.0), bottom..EXACT + 5.0)?;
        chart
            .configure_mesh()
            .x_desc("times the bare program's own frame")
            .y_desc("PSNR, dB")
            .x_label_formatter(&|x| format!("{x}"))
            // Above the exact ones there is nothing to label.
            .y_label_formatter(&|y| match *y {
                y if y > EXACT => String::new(),
                y if y == EXACT => "exact".to_owned(),
                y => format!("{y}"),
            })
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(228, 230, 235))
            .axis_style(GREY)
            .label_style(font(18))
            .draw()?;
        chart.draw_series(DashedLineSeries::new(
            [(least, EXACT), (most, EXACT)],
            6,
            5,
            INK.stroke_width(1),
        ))?;
        // Rows with fewer views are an easier task, not a better result.
        let views: BTreeSet<u32> = rows.iter().map(|row| row.views).collect();
        for &views in &views {
            let alike = rows
                .iter()
                .zip(&points)
                .filter(|(row, _)| row.views == views);
            let alike: Vec<_> = alike.map(|(_, point)| *point).collect();
            chart.draw_series(LineSeries::new(stairs(&alike, most), GREY.stroke_width(2)))?;
        }
        let many = views.len() > 1;
        for (row, &(x, y)) in rows.iter().zip(&points) {
            let kind = self
                .names
                .iter()
                .position(|name| *name == row.configuration)
                .unwrap_or(0);
            let colour = colour(kind);
            chart.draw_series([PathElement::new(
                [(row.times.low, y), (row.times.high, y)],
                colour.stroke_width(2),
            )])?;
            chart.plotting_area().draw(&mark((x, y), kind))?;
            if many {
                // Neighbouring marks on the line stand above and below it in turns.
                let (v, shift) = if kind % 2 == 0 {
                    (VPos::Bottom, -6)
                } else {
                    (VPos::Top, 6)
                };
                let style = font(18).color(&colour).pos(Pos::new(HPos::Left, v));
                chart.plotting_area().draw(
                    &(EmptyElement::at((x, y))
                        + Text::new(row.views.to_string(), (10, shift), style)),
                )?;
            }
        }
        Ok(())
    }

    fn legend<B: DrawingBackend>(
        &self,
        area: &Area<B>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let spot = |at: usize| {
            let (x, y) = (at as u32 % self.words(), at as u32 / self.words());
            ((24 + x * WORD) as i32, (y * LEGEND + LEGEND / 2) as i32)
        };
        let middle = |style: TextStyle<'static>| style.pos(Pos::new(HPos::Left, VPos::Center));
        for (kind, name) in self.names.iter().enumerate() {
            let (x, y) = spot(kind);
            area.draw(&mark((x + 10, y), kind))?;
            area.draw(&Text::new(
                (*name).to_owned(),
                (x + 28, y),
                middle(font(21)),
            ))?;
        }
        let (x, y) = spot(self.names.len());
        area.draw(&PathElement::new(
            [(x, y), (x + 24, y)],
            GREY.stroke_width(2),
        ))?;
        area.draw(&Text::new("Pareto front", (x + 32, y), middle(font(21))))
    }
}

impl Drawing for Chart<'_> {
    fn size(&self) -> (u32, u32) {
        let rows = (self.panels.len() as u32).div_ceil(self.columns);
        (
            self.columns * PANEL.0,
            TITLE + rows * PANEL.1 + self.legend_lines() * LEGEND + LEGEND / 2,
        )
    }

    fn draw<B: DrawingBackend>(
        &self,
        area: &Area<B>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        area.fill(&WHITE)?;
        let (width, height) = self.size();
        area.draw(&Text::new(
            "Frame time and error of the picture",
            (24, 16),
            font(32),
        ))?;
        area.draw(&Text::new(
            format!("{}, {}", self.bench.renderer, self.bench.date),
            (24, 54),
            font(19).color(&GREY),
        ))?;
        for (at, rows) in self.panels.iter().enumerate() {
            let (x, y) = (at as u32 % self.columns, at as u32 / self.columns);
            let left = x * PANEL.0;
            let top = TITLE + y * PANEL.1;
            let panel = area.clone().shrink((left, top), PANEL);
            self.panel(&panel, rows)?;
        }
        let below = area.clone().shrink(
            (0, height - self.legend_lines() * LEGEND - LEGEND / 2),
            (width, self.legend_lines() * LEGEND),
        );
        self.legend(&below)?;
        area.present()
    }
}

/// The point of a row: times, and dB or [`EXACT`].
fn place(row: &Row) -> (f64, f64) {
    (
        row.times.median,
        row.picture.psnr.map_or(EXACT, |psnr| psnr.min(EXACT)),
    )
}

/// The front as steps to the right end of the axis.
fn stairs(points: &[(f64, f64)], most: f64) -> Vec<(f64, f64)> {
    let mut line = Vec::new();
    let mut height = None;
    for (x, y) in front(points)
        .into_iter()
        .filter_map(|at| points.get(at).copied())
    {
        line.extend(height.map(|before| (x, before)));
        line.push((x, y));
        height = Some(y);
    }
    line.extend(height.map(|height| (most, height)));
    line
}

fn colour(kind: usize) -> RGBColor {
    COLOURS[kind % COLOURS.len()]
}

/// One shape and colour for each configuration.
fn mark<'a, B: DrawingBackend + 'a, C: Clone + 'static>(
    at: C,
    kind: usize,
) -> DynElement<'a, B, C> {
    let colour = colour(kind);
    match kind % 4 {
        0 => Circle::new(at, 8, colour.filled()).into_dyn(),
        1 => TriangleMarker::new(at, 11, colour.filled()).into_dyn(),
        2 => {
            (EmptyElement::at(at) + Rectangle::new([(-7, -7), (7, 7)], colour.filled())).into_dyn()
        }
        _ => Cross::new(at, 8, colour.stroke_width(4)).into_dyn(),
    }
}

pub(super) fn font(pixels: u32) -> TextStyle<'static> {
    ("sans-serif", pixels).into_font().color(&INK)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_drawn_as_steps() {
        let points = [(2.0, 40.0), (4.0, 90.0), (3.0, 30.0)];
        assert_eq!(
            stairs(&points, 8.0),
            [(2.0, 40.0), (4.0, 40.0), (4.0, 90.0), (8.0, 90.0)]
        );
        assert!(stairs(&[], 8.0).is_empty());
    }

    #[test]
    fn the_name_says_the_format() {
        assert_eq!(Format::of(Path::new("a/b.png")).unwrap(), Format::Png);
        assert_eq!(Format::of(Path::new("b.svg")).unwrap(), Format::Svg);
        assert!(Format::of(Path::new("b.pdf")).is_err() && Format::of(Path::new("png")).is_err());
    }
}
