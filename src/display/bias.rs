//! Local errors of a lens sheet: a coarse map over the screen that is added to the phase.
#![forbid(unsafe_code)]

use super::Placement;

/// Values on a grid whose corners are the corners of the screen; bilinear between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Bias {
    columns: usize,
    rows: usize,
    values: Vec<f64>,
}

impl Bias {
    /// Most values along a side; the grid is for errors that change slowly over the screen.
    pub const LARGEST: usize = 64;

    /// `values` in subpixels, rows from the top, each from the left. None unless there are 2 to 64 columns and rows, as many
    /// values, and all of them are from -1000 to 1000.
    pub fn new(columns: usize, rows: usize, values: Vec<f64>) -> Option<Self> {
        let side = 2..=Self::LARGEST;
        let fits = side.contains(&columns)
            && side.contains(&rows)
            && values.len() == columns * rows
            && values.iter().all(|value| value.abs() <= 1000.0);
        fits.then_some(Self {
            columns,
            rows,
            values,
        })
    }

    /// Columns, rows and values, as [`Bias::new`] takes them.
    pub(super) fn grid(&self) -> (usize, usize, &[f64]) {
        (self.columns, self.rows, &self.values)
    }

    /// At a place, as shares of the screen from its left and top.
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let (left, across) = line_before(x, self.columns);
        let (upper, down) = line_before(y, self.rows);
        let value = |row: usize, column: usize| self.values[row * self.columns + column];
        let along = |row: usize| {
            let (a, b) = (value(row, left), value(row, left + 1));
            a + (b - a) * across
        };
        let (a, b) = (along(upper), along(upper + 1));
        a + (b - a) * down
    }

    /// The least and the greatest value.
    pub(super) fn range(&self) -> [f64; 2] {
        let values = || self.values.iter().copied();
        [
            values().fold(f64::MAX, f64::min),
            values().fold(f64::MIN, f64::max),
        ]
    }

    /// The values along a row of the screen.
    pub(super) fn row(&self, placement: &Placement, row: i64) -> BiasRow {
        let (upper, weight) = cell(row, placement.screen_height, self.rows);
        let line = |row: usize| self.values.iter().skip(row * self.columns);
        let values = line(upper).zip(line(upper + 1)).take(self.columns);
        BiasRow {
            screen_width: placement.screen_width,
            values: values.map(|(a, b)| a + (b - a) * weight).collect(),
        }
    }
}

/// One row of the screen.
pub(super) struct BiasRow {
    screen_width: u32,
    values: Vec<f64>,
}

impl BiasRow {
    /// At the centre of a pixel, in subpixels.
    pub(super) fn at(&self, x: i64) -> f64 {
        let (left, weight) = cell(x, self.screen_width, self.values.len());
        match (self.values.get(left), self.values.get(left + 1)) {
            (Some(a), Some(b)) => a + (b - a) * weight,
            _ => 0.0,
        }
    }
}

/// The grid line before the centre of a pixel, at most the last but one, and how far it is to the next; at the edge outside.
fn cell(pixel: i64, pixels: u32, lines: usize) -> (usize, f64) {
    line_before((pixel as f64 + 0.5) / f64::from(pixels.max(1)), lines)
}

/// The grid line before a share of the screen, at most the last but one, and how far it is to the next; at the edge outside.
fn line_before(share: f64, lines: usize) -> (usize, f64) {
    let place = share.clamp(0.0, 1.0) * (lines - 1) as f64;
    let before = (place.floor() as usize).min(lines - 2);
    (before, place - before as f64)
}
