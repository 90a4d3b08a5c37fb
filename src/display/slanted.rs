//! A slanted lens sheet or barrier.
//!
//! `view = ⌊N · fract((3x + p + slant·row + offset + colour) / pitch)⌋`, with `row` from the top of the screen and `p` = 0, 1, 2
//! the place of the subpixel in its pixel. An inverted one has −φ for the phase φ.
#![forbid(unsafe_code)]

use super::bias::Whole;
use super::lattice::{Direction, Lattice, Row, by_colour};
use super::lens_phase::Phase;
use super::number::{are_exact, in_units};
use super::{Bias, Mask, MaskError, Number, Placement, SubpixelOrder};

/// The optics of a slanted lens or barrier.
#[derive(Clone, Debug, PartialEq)]
pub struct Slanted {
    /// Subpixels from lens to lens along a row, above 0.
    pub pitch: Number,
    /// Subpixels by which the phase grows from a row to the one below.
    pub slant: Number,
    /// Phase of the leftmost subpixel in the top row of the screen, in subpixels.
    pub offset: Number,
    /// Added for R, G and B, in subpixels, where the centres of the colours are not a third of a pixel apart.
    pub colours: [Number; 3],
    /// Local errors of the sheet, if they were measured.
    pub bias: Option<Bias>,
    /// Which colour is leftmost in a pixel.
    pub order: SubpixelOrder,
    /// Views descend with the phase, as behind a sheet of lenses, which swaps left and right: `view = ⌊N · fract(−φ)⌋`.
    pub inverted: bool,
}

impl Slanted {
    /// Hübner's 8-view filter: equation 9 is ⌊3x + c + ⅔(row + 1) + ⅓⌋ mod 8.
    pub const HUEBNER: Self = Self {
        pitch: Number::whole(8),
        slant: Number::Exact {
            numerator: 2,
            denominator: 3,
        },
        offset: Number::whole(1),
        colours: [Number::whole(0); 3],
        bias: None,
        order: SubpixelOrder::Rgb,
        inverted: false,
    };

    /// True when no number has to be rounded for the mask.
    pub fn is_exact(&self) -> bool {
        are_exact(self.numbers())
    }

    pub(super) fn phase(&self) -> Option<Phase> {
        if self.bias.is_some() {
            return None;
        }
        let turn = self.pitch.to_f64() * if self.inverted { -1.0 } else { 1.0 };
        let mean = self.colours.iter().map(|c| c.to_f64()).sum::<f64>() / 3.0;
        Some(Phase {
            start: (1.0 + self.offset.to_f64() + mean) / turn,
            right: 3.0 / turn,
            down: self.slant.to_f64() / turn,
            colour: 1.0 / turn,
        })
    }

    fn numbers(&self) -> [Number; 6] {
        let [r, g, b] = self.colours;
        [self.pitch, self.slant, self.offset, r, g, b]
    }

    pub(super) fn mask(&self, placement: &Placement, views: u32) -> Result<Mask, MaskError> {
        let map = self.bias.as_ref();
        let numbers = map.map_or(&[][..], |bias| bias.grid().2);
        let (unit, [pitch, slant, offset, r, g, b], bias) = in_units(self.numbers(), numbers);
        let map = map.map(|map| map.over(placement, &bias, pitch));
        // With a map, everything is in its finer units.
        let finer = map.as_ref().map_or(1, Whole::finer);
        let [unit, pitch, slant, offset, r, g, b] =
            [unit, pitch, slant, offset, r, g, b].map(|number| number * finer);
        // Descending views are ascending ones of the phase that falls.
        let sign = if self.inverted { -1 } else { 1 };
        let Some(lattice) = Lattice::new(pitch, sign * 3 * unit, Direction::Up) else {
            return Err(MaskError::Pitch);
        };
        let places = by_colour(self.order, [0, unit, 2 * unit]);
        let colours = [places[0] + r, places[1] + g, places[2] + b];
        let colours = [colours.map(|colour| sign * colour); 2];
        Mask::by_rows(placement, |first, row, out| {
            let start = sign * (offset + i128::from(row) * slant);
            let line = Row { start, colours };
            match &map {
                None => lattice.fill(first, &line, views, out),
                Some(map) => {
                    let biased = map.row(row);
                    let bias = |i: usize| sign * biased.at(first + i as i64);
                    lattice.fill_biased(first, &line, views, bias, out);
                }
            }
        })
    }
}
