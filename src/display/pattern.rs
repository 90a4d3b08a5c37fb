//! Patterns written by hand, repeated from the screen's top left corner: interlaced stereo panels, barriers with black guards.
#![forbid(unsafe_code)]

use super::lens_phase::Phase;
use super::{GUARD, Mask, MaskError, Placement};

/// Rows of cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    rows: Vec<Vec<u16>>,
    /// Cells are subpixels, from the left whatever their colours, rather than pixels.
    pub subpixels: bool,
}

impl Pattern {
    /// Most rows, and most cells of a row.
    pub const LARGEST: usize = 1024;

    /// Letters of cells: `L` and `R` are views 0 and 1, `0` to `9` the view, `b` black. None unless all rows have one length from
    /// 1 to 1024, there are 1 to 1024 rows, and some cell shows a view.
    pub fn new(rows: &[impl AsRef<str>], subpixels: bool) -> Option<Self> {
        let cell = |letter: char| match letter {
            'L' => Some(0),
            'R' => Some(1),
            'b' => Some(GUARD),
            _ => letter.to_digit(10).map(|digit| digit as u16),
        };
        let rows: Vec<Vec<u16>> = rows
            .iter()
            .map(|row| row.as_ref().chars().map(cell).collect())
            .collect::<Option<_>>()?;
        let side = 1..=Self::LARGEST;
        let length = rows.first()?.len();
        let fits = side.contains(&rows.len())
            && side.contains(&length)
            && rows.iter().all(|row| row.len() == length)
            && rows.iter().flatten().any(|&view| view != GUARD);
        fits.then_some(Self { rows, subpixels })
    }

    /// The largest view plus 1.
    pub fn views(&self) -> u32 {
        let views = self.rows.iter().flatten();
        let last = views.filter(|&&view| view != GUARD).max();
        last.map_or(1, |&view| u32::from(view) + 1)
    }

    /// Of rows, columns and checkers of two views.
    pub(super) fn phase(&self) -> Option<Phase> {
        let step = |steps: bool| if steps { 0.5 } else { 0.0 };
        let (right, down) = match (self.subpixels, self.rows.as_slice()) {
            (false, [row]) if row[..] == [0, 1] => (true, false),
            (false, [first, second]) if first[..] == [0] && second[..] == [1] => (false, true),
            (false, [first, second]) if first[..] == [0, 1] && second[..] == [1, 0] => (true, true),
            _ => return None,
        };
        Some(Phase {
            start: 0.0,
            right: step(right),
            down: step(down),
            colour: 0.0,
        })
    }

    pub(super) fn check_views(&self, views: u32) -> Result<(), MaskError> {
        match self.views() - 1 {
            view if view >= views => Err(MaskError::Table { view, views }),
            _ => Ok(()),
        }
    }

    pub(super) fn mask(&self, placement: &Placement) -> Result<Mask, MaskError> {
        let width = if self.subpixels { 3 } else { 1 };
        Mask::by_rows(placement, |first, row, out| {
            let row = row.rem_euclid(self.rows.len() as i64) as usize;
            let Some(cells) = self.rows.get(row) else {
                return;
            };
            let at = |place: i64| {
                let cell = place.rem_euclid(cells.len() as i64) as usize;
                cells.get(cell).copied().unwrap_or(GUARD)
            };
            for (x, out) in (first..).zip(out) {
                *out = [0, 1, 2].map(|c| at(width * x + if self.subpixels { c } else { 0 }));
            }
        })
    }
}
