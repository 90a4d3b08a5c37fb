//! A panel as an eye sees it, by ray geometry alone. It reads no mask, and so checks the masks.
//!
//! Spaces. Millimetres: origin in the middle of the sheet of lenses or slits, x to the right, y upwards, z towards the viewer.
//! Panel: columns of subpixels `s` from the left edge and rows `r` from the top edge, both continuous, a pixel 3 subpixels wide
//! and 1 row high, and square. Across the lenses: `u = s + slant·r` in subpixels, which is constant along an axis.
//!
//! Rays. A cylindrical lens in focus, or a slit, lets an eye see one line of the pixels: where the plane through the eye and
//! the axis meets them. With the axis at `A` and the eye at `E`, both across the lenses, the eye `Z` before the sheet and the
//! pixels `h` behind the sheet, similar triangles give `U = A + (A − E)·h/Z`. For a sheet behind the pixels `h` is negative,
//! and so nothing is swapped: see [`Side`]. `|h|` follows from the cone: its edges are the rays by which an axis shows the ends
//! of one period, `tan(cone/2) = period / 2|h|`. It is the gap in air; a sheet of glass is thicker by its refractive index.
//!
//! Pitch. The period on the sheet is that on the pixels divided by `1 + h/Z0`: then an eye at the distance `Z0` sees the same
//! view at every place of the panel. Before and behind `Z0` the view changes across the panel.
//!
//! Light. Subpixels count with their centres, each colour by itself, since the colours lie at different places. The aperture of
//! a lens is one view wide; the share `crosstalk` of the light comes from the view's width on either side of it instead. One
//! lens shows only one or two colours in a row, and the eye sees white where the next rows and lenses show the others: so the
//! light is averaged over the few nearest places that have every colour in every view ([`Optics`]), and each of these
//! averages has the weight 1, so that white is white. Means are taken of light, that is of decoded sRGB.
//!
//! The picture is the one on the pixels' plane: each line that is seen fills the width of its lens there.
#![forbid(unsafe_code)]

mod error;
mod light;
mod optics;
mod strip;
#[cfg(test)]
mod tests;

pub use error::SimulateError;
pub use optics::{Optics, Side};
pub use strip::{MAX_EYES, MAX_STRIP_WIDTH, strip};

use image::RgbImage;
use light::Light;
use optics::Near;
use std::num::NonZero;
use std::ops::Range;

/// In a row, the nearest subpixel of a colour is never farther than this, in subpixels.
const NEAREST: f64 = 1.5;

/// Closer than this is the same place, in subpixels; far above the rounding of 16384 pixels.
const SAME: f64 = 1e-6;

/// Where an eye is, in mm from the middle of the sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// To the right.
    pub x: f64,
    /// Upwards.
    pub y: f64,
    /// From the sheet towards the viewer.
    pub z: f64,
}

/// The values that the description of a panel does not have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// Width of a pixel, mm.
    pub pixel: f64,
    /// Angle between the directions in which the first and the last view end, degrees, above 0 and below 180.
    pub cone: f64,
    /// Share of the light that comes from the places beside the right one, 0 to 1.
    pub crosstalk: f64,
    /// Distance of the eye that the sheet is made for, mm; the eye's own where there is none.
    pub design: Option<f64>,
}

impl Setup {
    /// From the middle of the viewing zone to its end, over the distance from the sheet.
    fn half_zone(&self) -> f64 {
        (self.cone / 2.0).to_radians().tan()
    }
}

/// The picture of `panel` as `eye` sees it, in the panel's size. `row_done` is called once per finished row, by any
/// thread.
pub fn see(
    panel: &RgbImage,
    optics: &Optics,
    setup: &Setup,
    eye: Eye,
    row_done: &(dyn Fn() + Sync),
) -> Result<RgbImage, SimulateError> {
    let (width, height) = panel.dimensions();
    if width == 0 || height == 0 {
        return Err(SimulateError::Empty);
    }
    let scene = Scene {
        panel,
        optics,
        light: &Light::new(),
        crosstalk: setup.crosstalk,
        lines: Lines::seen(panel.dimensions(), optics, setup, eye)?,
        around: optics.around(),
    };
    let stride = width as usize * 3;
    let mut seen = vec![0; stride * height as usize];
    let threads = std::thread::available_parallelism().map_or(1, NonZero::get);
    let rows = (height as usize).div_ceil(threads);
    std::thread::scope(|scope| {
        for (first, part) in (0i64..).step_by(rows).zip(seen.chunks_mut(rows * stride)) {
            let scene = &scene;
            scope.spawn(move || {
                for (row, out) in (first..).zip(part.chunks_exact_mut(stride)) {
                    scene.row(row, out);
                    row_done();
                }
            });
        }
    });
    RgbImage::from_raw(width, height, seen).ok_or(SimulateError::Empty)
}

/// The lines on the pixels that one eye sees through the lenses, across the lenses in subpixels.
#[derive(Clone, Copy, Debug)]
struct Lines {
    /// Of lens 0.
    first: f64,
    /// From lens to lens.
    spacing: f64,
}

impl Lines {
    fn seen(
        (width, height): (u32, u32),
        optics: &Optics,
        setup: &Setup,
        eye: Eye,
    ) -> Result<Self, SimulateError> {
        let subpixel = setup.pixel / 3.0;
        let period = optics.period * subpixel;
        let gap = period / 2.0 / setup.half_zone();
        let below = match optics.side {
            Side::Front => gap,
            Side::Behind => -gap,
        };
        let design = setup.design.unwrap_or(eye.z);
        for (what, z) in [("the eye", eye.z), ("the distance of design", design)] {
            // Nearer than that, no ray leaves the sheet in the order of the lenses.
            if z < 2.0 * gap {
                let least = 2.0 * gap;
                return Err(SimulateError::TooNear { what, z, least });
            }
        }
        // All lengths in mm across the lenses, from the middle of the panel. A row is three subpixels high.
        let middle = subpixel * (1.5 * f64::from(width) + optics.slant * f64::from(height) / 2.0);
        let across = eye.x - optics.slant / 3.0 * eye.y;
        let seen = |lens: f64| {
            let centre = subpixel * optics.start + (lens + 0.5) * period - middle;
            let axis = centre / (1.0 + below / design);
            (axis + (axis - across) * below / eye.z + middle) / subpixel
        };
        Ok(Self {
            first: seen(0.0),
            spacing: seen(1.0) - seen(0.0),
        })
    }

    fn at(&self, lens: i64) -> f64 {
        self.first + lens as f64 * self.spacing
    }

    /// The lenses whose widths meet the interval `from .. to`.
    fn between(&self, from: f64, to: f64) -> Range<i64> {
        let lens = |u: f64| (u - self.first) / self.spacing;
        (lens(from) - 0.5).floor() as i64..(lens(to) + 0.5).ceil() as i64 + 1
    }
}

/// Everything that the light of one picture depends on.
struct Scene<'a> {
    panel: &'a RgbImage,
    optics: &'a Optics,
    light: &'a Light,
    crosstalk: f64,
    lines: Lines,
    around: Vec<Near>,
}

impl Scene<'_> {
    /// One row of the picture, as R, G, B of each pixel.
    fn row(&self, row: i64, out: &mut [u8]) {
        let width = 3.0 * f64::from(self.panel.width());
        let slanted = self.optics.slant * (row as f64 + 0.5);
        let mut sums = vec![[0.0; 3]; self.panel.width() as usize];
        for lens in self.lines.between(slanted, slanted + width) {
            let u = self.lines.at(lens);
            let (left, right) = (
                (u - slanted - self.lines.spacing / 2.0).clamp(0.0, width),
                (u - slanted + self.lines.spacing / 2.0).clamp(0.0, width),
            );
            if left >= right {
                continue;
            }
            let seen = [0, 1, 2].map(|colour| self.through(lens, row, colour));
            // Both are within the panel.
            let (first, last) = ((left / 3.0) as usize, (right / 3.0) as usize);
            for (x, sum) in (first..=last).zip(sums.iter_mut().skip(first)) {
                let pixel = 3.0 * x as f64;
                let covered = (right.min(pixel + 3.0) - left.max(pixel)) / 3.0;
                for (sum, light) in sum.iter_mut().zip(seen) {
                    *sum += covered * light;
                }
            }
        }
        for (out, sum) in out.chunks_exact_mut(3).zip(&sums) {
            for (out, &light) in out.iter_mut().zip(sum) {
                *out = self.light.encoded(light);
            }
        }
    }

    /// Light of a colour that comes through a lens in a row.
    fn through(&self, lens: i64, row: i64, colour: usize) -> f64 {
        let half = self.optics.half_view();
        let beside = if self.crosstalk > 0.0 {
            3.0 * half
        } else {
            half
        };
        let reach = beside.max(NEAREST + SAME);
        let centre = self.optics.centres.get(colour).copied().unwrap_or(NEAREST);
        let (mut right, mut wrong, mut nearest) =
            (Mean::default(), Mean::default(), Mean::default());
        let mut distance = NEAREST + SAME;
        for near in &self.around {
            let row = row + near.row;
            // From the line that is seen to the centre of the colour in column 0.
            let start =
                centre + self.optics.slant * (row as f64 + 0.5) - self.lines.at(lens + near.lens);
            let first = ((-reach - start) / 3.0).ceil() as i64;
            let last = ((reach - start) / 3.0).floor() as i64;
            for x in first..=last {
                let Some(light) = self.subpixel(x, row, colour) else {
                    continue;
                };
                let off = start + 3.0 * x as f64;
                if (-half..half).contains(&off) {
                    right.add(near.weight, light);
                } else if off.abs() < beside {
                    wrong.add(near.weight, light);
                }
                if off.abs() < distance - SAME {
                    (distance, nearest) = (off.abs(), Mean::default());
                }
                if off.abs() < distance + SAME {
                    nearest.add(near.weight, light);
                }
            }
        }
        // Where the view has no subpixel of this colour, its nearest one bleeds in; beside the panel there is none.
        let right = right.value().or(nearest.value()).unwrap_or(0.0);
        let wrong = wrong.value().unwrap_or(right);
        right + self.crosstalk * (wrong - right)
    }

    fn subpixel(&self, x: i64, row: i64, colour: usize) -> Option<f64> {
        let (x, row) = (u32::try_from(x).ok()?, u32::try_from(row).ok()?);
        let stored = self
            .panel
            .get_pixel_checked(x, row)?
            .0
            .get(colour)
            .copied()?;
        Some(self.light.decoded(stored))
    }
}

/// A weighted mean that is being made.
#[derive(Clone, Copy, Default)]
struct Mean {
    sum: f64,
    weight: f64,
}

impl Mean {
    fn add(&mut self, weight: f64, value: f64) {
        self.sum += weight * value;
        self.weight += weight;
    }

    fn value(self) -> Option<f64> {
        (self.weight > 0.0).then(|| self.sum / self.weight)
    }
}
