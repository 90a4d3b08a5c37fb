//! Leia-type panels.
//!
//! ```text
//! base = p_over_du · X + p_over_dv · Y + mod(colorSlant · Y, p_over_du)
//! base += 2·inv for R, 1 for G, 2·(1 − inv) for B           inv: colorInversion
//! view = mod(base + 1 − p_over_dv · H + offset, n)           n: the panel's own number of views
//! ```
//! X from the left and Y from the bottom are whole, as the sources that use these numbers give them no half. Lengths are in views
//! of the panel; with another N the phase `view / n` is spread over N views.
#![forbid(unsafe_code)]

use super::lattice::{Direction, Lattice, Row};
use super::lens_phase::Phase;
use super::number::in_units;
use super::{Mask, MaskError, Number, Placement};

/// The numbers of a panel; all in views.
#[derive(Clone, Debug, PartialEq)]
pub struct Leia {
    /// From a pixel to the one on the right.
    pub p_over_du: Number,
    /// From a pixel to the one above.
    pub p_over_dv: Number,
    /// Added per row, modulo `p_over_du`.
    pub colour_slant: Number,
    /// B before R.
    pub colour_inversion: bool,
    /// Added to all.
    pub offset: Number,
}

impl Leia {
    pub(super) fn phase(&self, native: u32) -> Option<Phase> {
        if self.colour_slant.to_f64() != 0.0 {
            return None;
        }
        let turn = f64::from(native);
        Some(Phase {
            // The top row; G adds 1.
            start: (2.0 + self.offset.to_f64() - self.p_over_dv.to_f64()) / turn,
            right: self.p_over_du.to_f64() / turn,
            down: -self.p_over_dv.to_f64() / turn,
            colour: if self.colour_inversion { -1.0 } else { 1.0 } / turn,
        })
    }

    pub(super) fn mask(
        &self,
        placement: &Placement,
        native: u32,
        views: u32,
    ) -> Result<Mask, MaskError> {
        let numbers = [
            self.p_over_du,
            self.p_over_dv,
            self.colour_slant,
            self.offset,
        ];
        let (unit, [across, up, slant, offset], _) = in_units(numbers, &[]);
        let Some(lattice) = Lattice::new(i128::from(native) * unit, across, Direction::Up) else {
            return Err(MaskError::Pitch);
        };
        let places = if self.colour_inversion {
            [2, 1, 0]
        } else {
            [0, 1, 2]
        };
        let colours = [places.map(|place| place * unit); 2];
        let height = i128::from(placement.screen_height);
        Mask::by_rows(placement, |first, row, out| {
            let y = height - 1 - i128::from(row);
            let shear = match across {
                0 => 0,
                _ => (slant * y).rem_euclid(across.abs()),
            };
            let start = up * (y - height) + shear + unit + offset;
            lattice.fill(first, &Row { start, colours }, views, out);
        })
    }
}
