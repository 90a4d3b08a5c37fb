//! Several eyes across the viewing zone, in one picture.
#![forbid(unsafe_code)]

use super::light::Light;
use super::{Eye, Optics, Setup, SimulateError, see};
use crate::display::Spacing;
use image::{Rgb, RgbImage};

/// Largest number of eyes in a strip.
pub const MAX_EYES: u32 = 256;

/// A strip is made smaller until it is at most this wide, in pixels.
pub const MAX_STRIP_WIDTH: u32 = 8192;

/// The pictures that `eyes` eyes see, side by side from the left eye to the right.
///
/// They stand beside each other at the distance of `middle`, each in the middle of its part of a viewing zone around it: with as
/// many eyes as views, and `middle` before the middle of the panel, eye i is in the middle of view i. All pictures are made
/// smaller by one whole factor, the least for [`MAX_STRIP_WIDTH`]. `row_done` is called for each row of each eye.
pub fn strip(
    panel: &RgbImage,
    optics: &Optics,
    setup: &Setup,
    middle: Eye,
    eyes: u32,
    row_done: &(dyn Fn() + Sync),
) -> Result<RgbImage, SimulateError> {
    if !(1..=MAX_EYES).contains(&eyes) {
        return Err(SimulateError::Eyes { eyes });
    }
    let (width, height) = panel.dimensions();
    let factor = width.div_ceil(MAX_STRIP_WIDTH / eyes).max(1);
    let (cell, cell_height) = (width.div_ceil(factor), height.div_ceil(factor));
    let mut out = RgbImage::new(cell * eyes, cell_height);
    let light = Light::new();
    for index in 0..eyes {
        // Whatever rule the cameras follow: at the ends of the zone an eye would be between the last view and the first.
        let place = Spacing::Centres.part(index, eyes);
        let eye = Eye {
            x: middle.x + place * 2.0 * middle.z * setup.half_zone(),
            ..middle
        };
        let seen = see(panel, optics, setup, eye, row_done)?;
        for y in 0..cell_height {
            for x in 0..cell {
                let mean = mean(&seen, (x * factor, y * factor), factor, &light);
                out.put_pixel(index * cell + x, y, mean);
            }
        }
    }
    Ok(out)
}

/// The mean light of a square that may hang over the right and lower edge.
fn mean(seen: &RgbImage, (left, top): (u32, u32), side: u32, light: &Light) -> Rgb<u8> {
    let (right, bottom) = (seen.width().min(left + side), seen.height().min(top + side));
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for y in top..bottom {
        for x in left..right {
            let pixel = seen.get_pixel(x, y).0;
            for (sum, stored) in sum.iter_mut().zip(pixel) {
                *sum += light.decoded(stored);
            }
            count += 1.0;
        }
    }
    Rgb(sum.map(|sum| light.encoded(sum / count)))
}
