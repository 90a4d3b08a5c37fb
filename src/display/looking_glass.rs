//! Looking Glass panels, from their calibration JSON.
//!
//! ```text
//! P    = pitch · screenW / DPI · cos(atan(1 / slope))        lenses over the width of the screen
//! tilt = screenH / (screenW · slope)
//! z_c  = (u + c / (3 · screenW) + v · tilt) · P − center       c = 0, 1, 2 for R, G, B
//! view = ⌊N · (1 − fract(z))⌋ where invView is set, else ⌊N · fract(z)⌋
//! ```
//! u and v are the place of the pixel's centre from 0 to 1, v upwards. `flipImageX` changes the signs of tilt and c, `flipSubp`
//! makes R the last subpixel. With `subpixelCells` each colour of a pixel has an offset of its own, in pixels, in place of
//! c / (3 · screenW); `CellPatternMode` says which cell a pixel has. Public sources that read the same files agree on this.
//! They do not say what `flipImageY` does to the phase; here v counts downwards with it. `fringe` and `verticalAngle` are kept
//! and shown, and have no part in the mask.
#![forbid(unsafe_code)]

use super::lattice::{Direction, Lattice, Row};
use super::lens_phase::Phase;
use super::{Mask, MaskError, Placement};

/// The calibration of a device; lengths in pixels unless said otherwise. More than 12 fields: those of the device.
#[derive(Clone, Debug, PartialEq)]
pub struct LookingGlass {
    /// Serial number; its beginning names the model.
    pub serial: String,
    /// Lenses per inch, across them.
    pub pitch: f64,
    /// Rise over run of a lens.
    pub slope: f64,
    /// Phase of the left bottom corner, in lenses.
    pub center: f64,
    /// Angle over which the views are spread, degrees.
    pub view_cone: f64,
    /// Angle of the lenses towards up and down, degrees.
    pub vertical_angle: f64,
    /// Pixels per inch.
    pub dpi: f64,
    /// Width of the screen.
    pub width: u32,
    /// Height of the screen.
    pub height: u32,
    /// Views ascend against the phase.
    pub inverted: bool,
    /// The picture is mirrored, left and right.
    pub flip_x: bool,
    /// The picture is mirrored, top and bottom.
    pub flip_y: bool,
    /// B is the leftmost subpixel.
    pub flip_subpixels: bool,
    /// Only given by large devices.
    pub fringe: Option<f64>,
    /// Offsets (x, y) of R, G and B; empty for three equal stripes.
    pub cells: Vec<[[f64; 2]; 3]>,
    /// Which pixel has which cell.
    pub cell_pattern: CellPattern,
}

/// `CellPatternMode`; x from the left and y from the bottom.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CellPattern {
    /// 0: one cell.
    #[default]
    One,
    /// 1: `(x + y) mod 2`
    Checkerboard,
    /// 2: `x mod 2`
    Columns,
    /// 3: `(y + 2 · (x mod 2)) mod 4`
    Staggered,
    /// 4: `y mod 2`
    Rows,
}

impl CellPattern {
    /// By its number.
    pub const ALL: [Self; 5] = [
        Self::One,
        Self::Checkerboard,
        Self::Columns,
        Self::Staggered,
        Self::Rows,
    ];

    /// How many cells it tells apart.
    pub fn cells(self) -> usize {
        match self {
            Self::One => 1,
            Self::Checkerboard | Self::Columns | Self::Rows => 2,
            Self::Staggered => 4,
        }
    }

    fn cell(self, x: i64, y: i64) -> usize {
        let cell = match self {
            Self::One => 0,
            Self::Checkerboard => (x + y).rem_euclid(2),
            Self::Columns => x.rem_euclid(2),
            Self::Staggered => (y + 2 * x.rem_euclid(2)).rem_euclid(4),
            Self::Rows => y.rem_euclid(2),
        };
        cell as usize
    }
}

/// Fractions of the derived numbers that are kept.
const DIGITS: u32 = 56;

impl LookingGlass {
    /// P: lenses over the width of the screen.
    pub fn lenses(&self) -> f64 {
        let slope = self.slope.abs();
        // cos(atan(1/s)) without the two functions.
        let cosine = slope / (1.0 + slope * slope).sqrt();
        self.pitch * f64::from(self.width) / self.dpi * cosine
    }

    /// Widths of the screen by which the phase moves from the bottom to the top.
    pub fn tilt(&self) -> f64 {
        let tilt = f64::from(self.height) / (f64::from(self.width) * self.slope);
        if self.flip_x { -tilt } else { tilt }
    }

    pub(super) fn phase(&self) -> Option<Phase> {
        if !self.cells.is_empty() {
            return None;
        }
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        let (lenses, climb) = (self.lenses(), self.lenses() * self.tilt());
        let (first, down) = if self.flip_y {
            (0.5 / height, climb / height)
        } else {
            (1.0 - 0.5 / height, -climb / height)
        };
        let sign = if self.inverted { -1.0 } else { 1.0 };
        let stripe = lenses / (3.0 * width) * if self.flip_x { -1.0 } else { 1.0 };
        let start = lenses * 0.5 / width + climb * first - self.center + stripe;
        Some(Phase {
            start: sign * start,
            right: sign * lenses / width,
            down: sign * down,
            colour: sign * if self.flip_subpixels { -stripe } else { stripe },
        })
    }

    pub(super) fn mask(&self, placement: &Placement, views: u32) -> Result<Mask, MaskError> {
        let fixed = |value: f64| (value * (1u64 << DIGITS) as f64).round() as i128;
        let (width, height) = (i128::from(self.width), i128::from(self.height));
        let (lenses, climb) = (self.lenses(), self.lenses() * self.tilt());
        // All of z times this is whole: u has the denominator 2W, v 2H and the subpixels 3W.
        let unit = 6 * width * height;
        let way = if self.inverted {
            Direction::Down
        } else {
            Direction::Up
        };
        let across = fixed(lenses) * 6 * height;
        let Some(lattice) = Lattice::new(unit << DIGITS, across, way) else {
            return Err(MaskError::Pitch);
        };
        let (step_up, center) = (fixed(climb) * 3 * width, fixed(self.center) * unit);
        let stripes = [0, 1, 2].map(|c| {
            let place = if self.flip_subpixels { 2 - c } else { c };
            let place = fixed(lenses) * place * 2 * height;
            if self.flip_x { -place } else { place }
        });
        let (wide, high) = (f64::from(self.width), f64::from(self.height));
        let cells: Vec<[i128; 3]> = if self.cells.is_empty() {
            vec![stripes]
        } else {
            let offset = |[x, y]: [f64; 2]| fixed(lenses * x / wide + climb * y / high) * unit;
            self.cells.iter().map(|cell| cell.map(offset)).collect()
        };
        Mask::by_rows(placement, |first, row, out| {
            let from_bottom = i64::from(self.height) - 1 - row;
            let v = if self.flip_y { row } else { from_bottom };
            let start = across / 2 + step_up * (2 * i128::from(v) + 1) - center;
            let colours = [0, 1].map(|x| {
                let cell = self.cell_pattern.cell(x, from_bottom);
                cells.get(cell).copied().unwrap_or(stripes)
            });
            lattice.fill(first, &Row { start, colours }, views, out);
        })
    }
}
