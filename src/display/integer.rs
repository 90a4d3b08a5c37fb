//! Phases counted in whole steps, with a table from the phase to the view.
//!
//! `phase = (horizontal · x + subpixel · p + vertical · row + offset) mod modulus`, `row` from the top of the screen and `p` the
//! place of the subpixel in its pixel. Without a table `view = ⌊N · phase / modulus⌋`; a table has a view, or the guard, for each
//! of as many equal parts of the modulus as it is long.
#![forbid(unsafe_code)]

use super::lattice::{Direction, Lattice, Row, by_colour};
use super::lens_phase::Phase;
use super::{GUARD, Mask, MaskError, Placement, SubpixelOrder};

/// The steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Integer {
    /// From a pixel to the one on the right.
    pub horizontal: i64,
    /// From a subpixel to the one on the right.
    pub subpixel: i64,
    /// From a row to the one below.
    pub vertical: i64,
    /// At the leftmost subpixel of the top row.
    pub offset: i64,
    /// At least 1.
    pub modulus: i64,
    /// Views, or [`GUARD`], by phase; empty for equal parts.
    pub table: Vec<u16>,
    /// Which colour is leftmost in a pixel.
    pub order: SubpixelOrder,
}

impl Integer {
    pub(super) fn check_views(&self, views: u32) -> Result<(), MaskError> {
        let shown = self.table.iter().filter(|&&view| view != GUARD);
        match shown.map(|&view| u32::from(view)).max() {
            Some(view) if view >= views => Err(MaskError::Table { view, views }),
            _ => Ok(()),
        }
    }

    pub(super) fn phase(&self) -> Option<Phase> {
        let turn = self.modulus as f64;
        self.table.is_empty().then(|| Phase {
            start: (self.offset + self.subpixel) as f64 / turn,
            right: self.horizontal as f64 / turn,
            down: self.vertical as f64 / turn,
            colour: self.subpixel as f64 / turn,
        })
    }

    pub(super) fn mask(&self, placement: &Placement, views: u32) -> Result<Mask, MaskError> {
        let lattice = Lattice::new(self.modulus.into(), self.horizontal.into(), Direction::Up);
        let Some(lattice) = lattice else {
            return Err(MaskError::Pitch);
        };
        // Below 65536 by the file's reader; more parts would not fit a view's 16 bits.
        let parts = match self.table.len() {
            0 => views,
            parts => u32::try_from(parts).unwrap_or(u32::from(GUARD)),
        };
        let step = i128::from(self.subpixel);
        let colours = [by_colour(self.order, [0, step, 2 * step]); 2];
        Mask::by_rows(placement, |first, row, out| {
            let start = i128::from(self.offset) + i128::from(self.vertical) * i128::from(row);
            lattice.fill(first, &Row { start, colours }, parts, out);
            if !self.table.is_empty() {
                for part in out.as_flattened_mut() {
                    *part = self.table.get(usize::from(*part)).copied().unwrap_or(GUARD);
                }
            }
        })
    }
}
