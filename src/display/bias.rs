//! Local errors of a lens sheet: a coarse map over the screen that is added to the phase.
#![forbid(unsafe_code)]

use super::lattice::LARGEST_TURN;
use super::{Number, Placement};

/// Values on a grid whose corners are the corners of the screen; bilinear between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Bias {
    columns: usize,
    rows: usize,
    numbers: Vec<Number>,
    /// The same, rounded.
    values: Vec<f64>,
}

impl Bias {
    /// Most values along a side; the grid is for errors that change slowly over the screen.
    pub const LARGEST: usize = 64;

    /// `numbers` in subpixels, rows from the top, each from the left. None unless there are 2 to 64 columns and rows, as many
    /// values, and all of them are from -1000 to 1000.
    pub fn new(columns: usize, rows: usize, numbers: Vec<Number>) -> Option<Self> {
        let values: Vec<f64> = numbers.iter().map(|number| number.to_f64()).collect();
        let side = 2..=Self::LARGEST;
        let fits = side.contains(&columns)
            && side.contains(&rows)
            && values.len() == columns * rows
            && values.iter().all(|value| value.abs() <= 1000.0);
        fits.then_some(Self {
            columns,
            rows,
            numbers,
            values,
        })
    }

    /// Columns, rows and values, as [`Bias::new`] takes them.
    pub(super) fn grid(&self) -> (usize, usize, &[Number]) {
        (self.columns, self.rows, &self.numbers)
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

    /// The map for a screen, in whole numbers: `units` has its values as multiples of a unit, of which `turn` are a lens.
    pub(super) fn over<'a>(
        &self,
        placement: &Placement,
        units: &'a [i128],
        turn: i128,
    ) -> Whole<'a> {
        let sides = [placement.screen_width, placement.screen_height];
        let parts = sides.map(|side| 2 * i128::from(side.max(1)));
        let finer = parts[0] * parts[1];
        Whole {
            columns: self.columns,
            rows: self.rows,
            units,
            parts,
            finer: if turn <= LARGEST_TURN / finer {
                finer
            } else {
                1
            },
        }
    }
}

/// A map in whole numbers. Between its values it is bilinear, with weights in parts of twice the width and height of the screen in pixels, so
/// that nothing is rounded at the centres of pixels.
pub(super) struct Whole<'a> {
    columns: usize,
    rows: usize,
    units: &'a [i128],
    /// Twice the width and the height of the screen.
    parts: [i128; 2],
    /// The product of the parts; 1 where the unit is so small that nobody can measure what is rounded.
    finer: i128,
}

impl Whole<'_> {
    /// How many units of [`WholeRow::at`] are one of the map's.
    pub(super) fn finer(&self) -> i128 {
        self.finer
    }

    /// The values along a row of the screen.
    pub(super) fn row(&self, row: i64) -> WholeRow {
        let (upper, weight) = whole_cell(row, self.parts[1], self.rows);
        let line = |row: usize| self.units.iter().skip(row * self.columns);
        let values = line(upper).zip(line(upper + 1)).take(self.columns);
        WholeRow {
            parts: self.parts[0],
            coarser: self.parts[0] * self.parts[1] / self.finer,
            values: values
                .map(|(a, b)| a * (self.parts[1] - weight) + b * weight)
                .collect(),
        }
    }
}

/// One row of the screen.
pub(super) struct WholeRow {
    parts: i128,
    coarser: i128,
    values: Vec<i128>,
}

impl WholeRow {
    /// At the centre of a pixel.
    pub(super) fn at(&self, x: i64) -> i128 {
        let (left, weight) = whole_cell(x, self.parts, self.values.len());
        match (self.values.get(left), self.values.get(left + 1)) {
            (Some(a), Some(b)) => (a * (self.parts - weight) + b * weight).div_euclid(self.coarser),
            _ => 0,
        }
    }
}

/// The grid line before the centre of a pixel, at most the last but one, and how far it is to the next, of `parts`: twice as many as there are
/// pixels. At the edge outside.
fn whole_cell(pixel: i64, parts: i128, lines: usize) -> (usize, i128) {
    let cells = lines as i128 - 1;
    let place = ((2 * i128::from(pixel) + 1) * cells).clamp(0, parts * cells);
    let before = (place / parts).min(cells - 1);
    (before as usize, place - before * parts)
}

/// The grid line before a share of the screen, at most the last but one, and how far it is to the next; at the edge outside.
fn line_before(share: f64, lines: usize) -> (usize, f64) {
    let place = share.clamp(0.0, 1.0) * (lines - 1) as f64;
    let before = (place.floor() as usize).min(lines - 2);
    (before, place - before as f64)
}
