//! The display: a screen that turns about a vertical axis, and the voxels that its slices are made of.

use super::VolumeError;
use serde::{Deserialize, Serialize};
use std::f32::consts::TAU;

/// The angle by which the screen turns while all its slices are shown once.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Turn {
    /// By 180°: each slice has a plane of its own. The second half turn shows them again on the screen's other face.
    Half,
    /// By 360°: slice k and slice k + n/2 lie in the same plane, one the other turned over.
    Full,
}

/// A display whose screen turns about the y axis of display space.
///
/// Display space: inches, origin in the middle of the screen, x to the right, y upwards along the axis, z towards the viewer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RotatingScreen {
    /// Radius of the screen, and so of the sphere that it sweeps, inches.
    pub radius: f64,
    /// Number of pictures that are shown one after the other.
    pub slices: u32,
    /// The angle for all slices.
    pub turn: Turn,
    /// Columns of a slice, and rows: the square around the screen. Even.
    pub pixels: u32,
    /// From the axis to the viewer, inches.
    pub viewer: f64,
}

impl RotatingScreen {
    /// The display of Popescu et al., section VII.
    ///
    /// A slice is the whole plane of the screen, on both sides of the axis. "Both faces of the screen carry an image", so the paper gives half a
    /// turn for a refresh (24 Hz at 720 rpm) and calls what is seen in that time a complete 3D image. "198 times for every complete rotation" is
    /// read as for every such image: then there are 198 · 768² voxels, the "100 million" in the title of its reference for the
    /// display (Favalora et al. 2002). Read as for every 360° there would be 99 planes, each twice, half of that: [`Turn::Full`].
    pub const POPESCU: RotatingScreen = RotatingScreen {
        radius: 5.0,
        slices: 198,
        turn: Turn::Half,
        pixels: 768,
        viewer: 50.0,
    };

    /// Half planes that end in the axis, in one full turn.
    pub fn half_planes(&self) -> u32 {
        match self.turn {
            Turn::Half => 2 * self.slices,
            Turn::Full => self.slices,
        }
    }

    /// The half planes on the right and on the left of a slice. On the left column 0 of the half plane is the rightmost one.
    pub fn sides(&self, slice: u32) -> [u32; 2] {
        let all = self.half_planes();
        [slice, (slice + all / 2) % all]
    }

    /// Columns of a half plane, from the axis outwards.
    pub fn columns(&self) -> u32 {
        self.pixels / 2
    }

    /// Inches from pixel to pixel.
    pub fn pixel(&self) -> f64 {
        2.0 * self.radius / f64::from(self.pixels)
    }

    /// Angle from half plane to half plane, radians.
    pub fn sector(&self) -> f64 {
        std::f64::consts::TAU / f64::from(self.half_planes())
    }

    /// The middle of a voxel in display space; `at` is that of [`super::Voxel`].
    pub fn centre(&self, half_plane: u32, at: u32) -> [f64; 3] {
        let (row, column) = (at / self.columns(), at % self.columns());
        let out = (f64::from(column) + 0.5) * self.pixel();
        let (sin, cos) = (f64::from(half_plane) * self.sector()).sin_cos();
        let y = self.radius - (f64::from(row) + 0.5) * self.pixel();
        [out * cos, y, out * sin]
    }

    /// Whether there can be such a display.
    pub fn check(&self) -> Result<(), VolumeError> {
        let number = |field: &'static str, value: f64, expected: &'static str| {
            Err(VolumeError::Display {
                field,
                found: value.to_string(),
                expected,
            })
        };
        if !(self.radius > 0.0 && self.radius <= 1e4) {
            return number(
                "radius",
                self.radius,
                "inches from the axis to the rim, above 0",
            );
        }
        if !(1..=4096).contains(&self.slices) || self.half_planes() % 2 == 1 {
            let expected = "1 to 4096 slices, an even number where they take a full turn";
            return number("slices", f64::from(self.slices), expected);
        }
        if !(2..=4096).contains(&self.pixels) || self.pixels % 2 == 1 {
            let expected = "an even number of rows and columns, 2 to 4096";
            return number("pixels", f64::from(self.pixels), expected);
        }
        if !(self.viewer > self.radius && self.viewer <= 1e6) {
            return number("viewer", self.viewer, "inches from the axis, outside of it");
        }
        Ok(())
    }
}

/// A point in the grid of the voxels. The voxel of a point has its coordinates rounded down.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Place {
    /// Sectors from half plane 0, which is in the middle of its sector: a point in that plane has 0.5. May exceed the number of sectors by
    /// less than one turn.
    pub(super) turn: f32,
    /// Pixels from the axis.
    pub(super) out: f32,
    /// Pixels from the top.
    pub(super) down: f32,
}

/// Constants that convert points to places.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells {
    pub(super) half_planes: u32,
    pub(super) columns: u32,
    pub(super) rows: u32,
    /// The screen's radius, pixels.
    pub(super) radius: f32,
    pub(super) pixels_per_inch: f32,
    pub(super) sectors_per_radian: f32,
}

impl Cells {
    pub(super) fn of(screen: &RotatingScreen) -> Cells {
        Cells {
            half_planes: screen.half_planes(),
            columns: screen.columns(),
            rows: screen.pixels,
            radius: screen.columns() as f32,
            pixels_per_inch: (1.0 / screen.pixel()) as f32,
            sectors_per_radian: screen.half_planes() as f32 / TAU,
        }
    }

    /// The place of a point that is in pixels, with the axes of display space.
    #[inline(always)]
    pub(super) fn place(&self, [x, y, z]: [f32; 3]) -> Place {
        Place {
            turn: azimuth(x, z) * self.sectors_per_radian + 0.5,
            out: (x * x + z * z).sqrt(),
            down: self.radius - y,
        }
    }

    /// Whether a place is within the sphere; false for NaN.
    #[inline(always)]
    pub(super) fn inside(&self, place: Place) -> bool {
        let up = place.down - self.radius;
        // Points that were clipped to the rim stay within after rounding.
        let rim = self.radius * (1.0 + 1e-5);
        place.out * place.out + up * up <= rim * rim
    }

    /// Half plane and voxel of a place within the sphere; undefined for other places. It has no branches.
    #[inline(always)]
    pub(super) fn voxel(&self, place: Place) -> (u32, u32) {
        let column = whole(place.out).min(self.columns - 1);
        let row = whole(place.down).min(self.rows - 1);
        let half_plane = whole(place.turn);
        let beyond = half_plane >= self.half_planes;
        let half_plane = half_plane.wrapping_sub(if beyond { self.half_planes } else { 0 });
        (half_plane, row * self.columns + column)
    }
}

/// From here on single-precision numbers have no fraction, and neighbouring integers have neighbouring bits.
const WHOLE: f32 = 8_388_608.0;

/// The nearest integer to a number from 0 to far below [`WHOLE`]; undefined for other numbers. The language's own conversions, which handle
/// those, take ten times as long in loops.
#[inline(always)]
pub(super) fn rounded(value: f32) -> u32 {
    (value + WHOLE).to_bits().wrapping_sub(WHOLE.to_bits())
}

/// The same, rounded down.
#[inline(always)]
fn whole(value: f32) -> u32 {
    let up = value + WHOLE - WHOLE > value;
    rounded(value).wrapping_sub(u32::from(up))
}

/// The angle from x towards z, 0 to 2π, to 1e-6. It has no branches, so that loops of it are vectorised.
///
/// From: Abramowitz and Stegun, "Handbook of Mathematical Functions", 4.4.49.
#[inline(always)]
fn azimuth(x: f32, z: f32) -> f32 {
    let (across, towards) = (x.abs(), z.abs());
    let steep = towards > across;
    let (low, high) = match steep {
        true => (across, towards),
        false => (towards, across),
    };
    let q = low / (high + f32::MIN_POSITIVE);
    let s = q * q;
    let series = [
        0.002_866_225_7,
        -0.016_165_737,
        0.042_909_614,
        -0.075_289_64,
        0.106_562_64,
        -0.142_089,
        0.199_935_51,
        -0.333_331_45_f32,
    ];
    let angle = q * (series.iter().fold(0.0, |sum, part| (sum + part) * s) + 1.0);
    let angle = if steep { TAU / 4.0 - angle } else { angle };
    let angle = if x < 0.0 { TAU / 2.0 - angle } else { angle };
    if z < 0.0 { TAU - angle } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuths_are_those_of_the_standard_library() {
        let mut worst = 0.0_f64;
        for step in 0..100_000 {
            let angle = f64::from(step) * std::f64::consts::TAU / 1e5;
            let (sin, cos) = angle.sin_cos();
            for far in [1e-3, 1.0, 400.0] {
                let (x, z) = ((cos * far) as f32, (sin * far) as f32);
                let exact = f64::from(z).atan2(f64::from(x));
                let off = (f64::from(azimuth(x, z)) - exact).rem_euclid(std::f64::consts::TAU);
                worst = worst.max(off.min(std::f64::consts::TAU - off));
            }
        }
        assert!(worst < 2e-6, "{worst}");
        assert_eq!(azimuth(0.0, 0.0), 0.0);
    }

    #[test]
    fn whole_numbers_are_those_of_the_language() {
        for step in 0..200_000_u32 {
            let value = step as f32 * 0.02;
            for value in [value, value.next_down().max(0.0), value.next_up()] {
                assert_eq!(whole(value), value as u32, "{value}");
                assert_eq!(rounded(value), value.round_ties_even() as u32, "{value}");
            }
        }
    }

    #[test]
    fn the_display_of_the_paper_has_a_hundred_million_voxels() {
        let screen = RotatingScreen::POPESCU;
        screen.check().unwrap();
        let voxels = screen.half_planes() * screen.columns() * screen.pixels;
        assert_eq!(voxels, 198 * 768 * 768);
        assert!((screen.sector().to_degrees() - 180.0 / 198.0).abs() < 1e-12);
        assert_eq!(screen.sides(3), [3, 201]);
        let full = RotatingScreen {
            turn: Turn::Full,
            ..screen
        };
        assert_eq!(full.sides(3), [3, 102]);
        assert_eq!(full.sides(102), [102, 3]);
    }

    #[test]
    fn what_is_no_display_is_refused_by_its_field() {
        let good = RotatingScreen::POPESCU;
        let wrong = [
            (
                "radius",
                RotatingScreen {
                    radius: 0.0,
                    ..good
                },
            ),
            (
                "radius",
                RotatingScreen {
                    radius: f64::NAN,
                    ..good
                },
            ),
            ("slices", RotatingScreen { slices: 0, ..good }),
            (
                "slices",
                RotatingScreen {
                    slices: 99,
                    turn: Turn::Full,
                    ..good
                },
            ),
            (
                "pixels",
                RotatingScreen {
                    pixels: 767,
                    ..good
                },
            ),
            (
                "viewer",
                RotatingScreen {
                    viewer: 5.0,
                    ..good
                },
            ),
        ];
        for (field, screen) in wrong {
            let message = screen.check().unwrap_err().to_string();
            assert!(message.contains(field), "{message}");
        }
    }
}
