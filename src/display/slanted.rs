//! A slanted lens sheet.
//!
//! `view = ⌊N · fract((3x + c + slant·row + offset) / pitch)⌋`, with `row` from the top of the screen. For rational
//! parameters the boundaries between views fall exactly on subpixels, where floats flip up to half of the views; so
//! these are computed in whole numbers, over the common denominator of the parameters.
#![forbid(unsafe_code)]

use super::number::gcd;
use super::{Mask, MaskError, Number, Placement, SubpixelOrder};

/// The optics of a slanted lens or barrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slanted {
    /// Subpixels from lens to lens along a row, above 0.
    pub pitch: Number,
    /// Subpixels by which the phase grows from a row to the one below.
    pub slant: Number,
    /// Phase of the leftmost subpixel in the top row of the screen, in subpixels.
    pub offset: Number,
    /// Which colour is leftmost in a pixel.
    pub order: SubpixelOrder,
}

impl Slanted {
    /// Hübner's 8-view filter: equation 9 is ⌊3x + c + ⅔(row + 1) + ⅓⌋ mod 8.
    pub const HUEBNER: Self = Self {
        pitch: Number::Exact {
            numerator: 8,
            denominator: 1,
        },
        slant: Number::Exact {
            numerator: 2,
            denominator: 3,
        },
        offset: Number::Exact {
            numerator: 1,
            denominator: 1,
        },
        order: SubpixelOrder::Rgb,
    };

    /// True when the mask is computed in whole numbers.
    pub fn is_exact(&self) -> bool {
        self.lattice().is_some()
    }

    pub(super) fn mask(&self, placement: &Placement, views: u32) -> Result<Mask, MaskError> {
        match self.lattice() {
            Some(lattice) => Mask::by_rows(placement, |x, y, row| {
                let mut phase = lattice.phase(x, y);
                for out in row {
                    *out = self.order.colours([(); 3].map(|()| {
                        let view = lattice.view(phase, views);
                        phase = lattice.next(phase);
                        view
                    }));
                }
            }),
            None => Mask::by_rows(placement, |first, y, row| {
                let (pitch, slant) = (self.pitch.to_f64(), self.slant.to_f64());
                let start = slant * y as f64 + self.offset.to_f64();
                for (x, out) in (first..).zip(row) {
                    *out = self.order.colours([0, 1, 2].map(|c| {
                        let phase = ((3 * x + c) as f64 + start) / pitch;
                        let view = (f64::from(views) * (phase - phase.floor())).floor();
                        // A phase just below a whole number has fract 1 after rounding.
                        view.min(f64::from(views) - 1.0) as u16
                    }));
                }
            }),
        }
    }

    /// All lengths as multiples of one over their common denominator; None when a number is a float or too large.
    fn lattice(&self) -> Option<Lattice> {
        let parts = [self.pitch, self.slant, self.offset].map(|number| match number {
            Number::Exact {
                numerator,
                denominator,
            } => Some((numerator, denominator)),
            Number::Float(_) => None,
        });
        let [Some(pitch), Some(slant), Some(offset)] = parts else {
            return None;
        };
        let mut unit = 1i64;
        for (_, denominator) in [pitch, slant, offset] {
            unit = unit.checked_mul(denominator.checked_div(gcd(unit, denominator))?)?;
        }
        let scaled = |(n, d): (i64, i64)| n.checked_mul(unit.checked_div(d)?);
        let pitch = scaled(pitch)?;
        // Times MAX_VIEWS (16 bit) and plus one step, a phase has to stay inside 64 bits.
        if !(1..1 << 46).contains(&pitch) {
            return None;
        }
        Some(Lattice {
            pitch,
            step: unit.rem_euclid(pitch),
            slant: scaled(slant)?.rem_euclid(pitch),
            offset: scaled(offset)?.rem_euclid(pitch),
        })
    }
}

/// The lens in whole units; every length is taken modulo the pitch.
struct Lattice {
    /// In 1 .. 2^46.
    pitch: i64,
    /// One subpixel.
    step: i64,
    slant: i64,
    offset: i64,
}

impl Lattice {
    /// Phase, in 0 .. pitch, of the leftmost subpixel of a pixel.
    fn phase(&self, x: i64, row: i64) -> i64 {
        let wide = |a: i64, b: i64| i128::from(a) * i128::from(b);
        let phase = wide(3 * x, self.step) + wide(row, self.slant) + i128::from(self.offset);
        // The remainder by a positive i64 fits one.
        phase.rem_euclid(i128::from(self.pitch)) as i64
    }

    /// Phase of the subpixel to the right.
    fn next(&self, phase: i64) -> i64 {
        let next = phase + self.step;
        if next >= self.pitch {
            next - self.pitch
        } else {
            next
        }
    }

    fn view(&self, phase: i64, views: u32) -> u16 {
        (i64::from(views) * phase / self.pitch) as u16
    }
}
