//! The picture shown on the panel once pitch and slant are known to 1 %: the measuring field, in a frame ([`super::frame`]).
//!
//! The field is a cosine over the nominal phase of the lens plus a carrier of some fringes over the height of the panel.
//! Through the lenses only the beat of the two gratings is seen: the carrier, distorted by the error of the nominal lens.
//! The carrier keeps the frequency away from zero, so the sign of the error is in one photo, and coarse fringes survive
//! blur, noise and JPEG.
#![forbid(unsafe_code)]

use super::Setup;
use super::frame::{self, Frame};
use crate::display::SubpixelOrder;
use glam::DVec2;
use image::{Rgb, RgbImage};

/// Gamma of the panel; a wrong one adds harmonics and moves no phase.
pub(super) const GAMMA: f64 = 2.2;
/// Half of the swing of the field, of full light.
pub(super) const SWING: f64 = 0.45;
/// How wrong the nominal pitch may be.
const PITCH_ERROR: f64 = 0.015;
/// How wrong the nominal slant may be, subpixels per row.
const SLANT_ERROR: f64 = 0.02;
/// Fringes that perspective and a bent field add.
const MARGIN: f64 = 2.0;
/// Changes with what the picture has, so that photos of an older one are known.
const VERSION: u64 = 3;

/// Where everything lies in the picture.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// What is about the field.
    pub frame: Frame,
    /// Fringes of the carrier over the height of the panel.
    pub carrier: f64,
    /// Largest deviation of the frequency from the carrier, fringes over the width and over the height.
    pub reach: DVec2,
    /// Turns of the phase from the subpixel of red to that of blue.
    pub across: f64,
    pitch: f64,
    slant: f64,
}

impl Layout {
    pub(super) fn new(setup: &Setup) -> Self {
        let size = DVec2::new(f64::from(setup.width), f64::from(setup.height));
        let lenses = DVec2::new(3.0 * size.x, setup.slant.abs() * size.y) / setup.pitch;
        let reach = lenses * PITCH_ERROR
            + DVec2::new(0.0, SLANT_ERROR * size.y / setup.pitch)
            + DVec2::splat(MARGIN);
        Self {
            frame: Frame::new((setup.width, setup.height), setup.pitch / 3.0, code(setup)),
            carrier: (2.0 * reach.y).ceil().max(24.0),
            reach,
            across: match setup.order {
                SubpixelOrder::Rgb => 2.0 / setup.pitch,
                SubpixelOrder::Bgr => -2.0 / setup.pitch,
            },
            pitch: setup.pitch,
            slant: setup.slant,
        }
    }

    /// Whether photos tell the colours apart: along a lens the pixels of each colour are seen in turn, and their beat has to be finer than the fringes.
    pub(super) fn tells_colours(&self) -> bool {
        self.slant.abs() * self.frame.size.y / 3.0 >= 2.0 * self.carrier
    }

    /// Phase of the nominal lens at a point, turns.
    pub(super) fn nominal(&self, p: DVec2) -> f64 {
        (3.0 * p.x - 0.5 + self.slant * (p.y - 0.5)) / self.pitch
    }

    /// Phase of the pattern at a point of the field, turns.
    pub(super) fn phase(&self, p: DVec2) -> f64 {
        self.nominal(p) + self.carrier * p.y / self.frame.size.y
    }

    /// Light of a subpixel, 0 to 1.
    fn light(&self, p: DVec2) -> f64 {
        let field = || 0.5 + SWING * (std::f64::consts::TAU * self.phase(p)).cos();
        self.frame.light(p).unwrap_or_else(field)
    }
}

/// A checksum of the values that the pattern depends on.
fn code(setup: &Setup) -> u16 {
    let order = u64::from(setup.order == SubpixelOrder::Bgr);
    frame::code(&[
        VERSION,
        setup.pitch.to_bits(),
        setup.slant.to_bits(),
        u64::from(setup.width),
        u64::from(setup.height),
        order,
    ])
}

/// The pattern for a panel; row 0 on top.
pub(super) fn picture(setup: &Setup) -> RgbImage {
    let layout = Layout::new(setup);
    RgbImage::from_fn(setup.width, setup.height, |x, row| {
        let light = [0.5, 1.5, 2.5].map(|c| {
            let p = DVec2::new(f64::from(x) + c / 3.0, f64::from(row) + 0.5);
            (255.0 * layout.light(p).powf(1.0 / GAMMA)).round() as u8
        });
        let [left, middle, right] = light;
        Rgb(match setup.order {
            SubpixelOrder::Rgb => [left, middle, right],
            SubpixelOrder::Bgr => [right, middle, left],
        })
    })
}

#[cfg(test)]
mod tests {
    use super::super::frame::{FRAME, RING};
    use super::*;

    fn setup() -> Setup {
        Setup::new(960, 540, 8, 8.0, 0.66)
    }

    /// The fit takes the edges of the frame as rulers: half a pixel at each side of 2160 rows is a hundredth of a turn of the lenses.
    #[test]
    fn the_frame_ends_where_pixels_end() {
        for (width, height, pitch) in [
            (3840, 2160, 4.7),
            (1920, 1080, 17.0),
            (2560, 1600, 61.0),
            (960, 540, 8.0),
        ] {
            let setup = Setup::new(width, height, 8, pitch, 0.66);
            let layout = Layout::new(&setup);
            let picture = picture(&setup);
            // A column and a row that hold no mark.
            let column = (0.5 * layout.frame.size.x) as u32;
            let row = (0.25 * layout.frame.size.y) as u32;
            let white = |x: u32, y: u32| picture.get_pixel(x, y).0 == [255; 3];
            for (count, at) in [
                (height, &(|i| white(column, i)) as &dyn Fn(u32) -> bool),
                (width, &|i| white(i, row)),
            ] {
                let first = (0..count).find(|&i| at(i)).expect("a frame");
                let end = (first..count).find(|&i| !at(i)).expect("a ring");
                let edges = [first, end].map(f64::from);
                assert_eq!(
                    edges,
                    [FRAME, RING].map(|edge| edge * layout.frame.band),
                    "{width}x{height}, pitch {pitch}"
                );
            }
        }
    }

    #[test]
    fn the_code_tells_panels_apart() {
        let mut others = [(); 3].map(|()| setup());
        others[0].pitch += 1e-6;
        others[1].slant += 1e-6;
        others[2].order = SubpixelOrder::Bgr;
        let code = code(&setup());
        assert!(others.iter().all(|other| self::code(other) != code));
    }

    #[test]
    fn blue_on_the_left_swaps_the_channels_of_the_field() {
        let mut bgr = setup();
        bgr.order = SubpixelOrder::Bgr;
        let (rgb, bgr) = (picture(&setup()), picture(&bgr));
        let ([a, b, c], swapped) = (rgb.get_pixel(400, 300).0, bgr.get_pixel(400, 300).0);
        assert!(a != c);
        assert_eq!(swapped, [c, b, a]);
    }
}
