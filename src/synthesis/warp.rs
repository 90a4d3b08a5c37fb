//! Synthesises a view from a depth image: McMillan's 3D warping along rows. Cameras stand beside each other, so nothing moves up or down.
//!
//! Neighbouring samples of one surface stay joined; a surface ends half a pixel beyond its last sample. The nearest surface is seen. Where there is
//! none, there is a hole: it gets the colour at its farther end, since a disocclusion shows the background. Pixels on which nothing was drawn lie
//! behind everything and are the same in all views.

use super::depth_image::is_nothing;
use super::{DepthImage, Shift};
use image::{Rgb, RgbImage};

/// Pixels by which neighbours may move apart, beyond the slope of the surfaces around them, and still belong to one surface.
const TEAR: f64 = 0.5;

/// A synthesised view.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct View {
    /// The picture, holes filled.
    pub picture: RgbImage,
    /// By pixel, rows from the top: whether no sample covers it.
    pub holes: Vec<bool>,
}

impl View {
    /// Share of the pixels that are holes, 0 to 1.
    pub fn hole_share(&self) -> f64 {
        let holes = self.holes.iter().filter(|hole| **hole).count();
        holes as f64 / self.holes.len().max(1) as f64
    }
}

/// 1/w and colour that are seen at a pixel. None in a hole.
pub(super) type Seen = Option<(f64, [u8; 3])>;

/// The view of a camera beside that of the picture.
pub fn warp(image: &DepthImage, shift: &Shift) -> View {
    let rows = 0..image.size()[1];
    let seen = rows.flat_map(|y| warp_row(image, y, shift)).collect();
    finish(image.size(), seen, true)
}

/// The view with these pixels, rows from the top; `filled`: holes get the colour at their farther end, else black.
pub(super) fn finish(size: [u32; 2], mut seen: Vec<Seen>, filled: bool) -> View {
    let [w, h] = size;
    let holes = seen.iter().map(Option::is_none).collect();
    if filled {
        seen.chunks_mut(w.max(1) as usize).for_each(fill);
    }
    let mut picture = RgbImage::new(w, h);
    for (pixel, seen) in picture.pixels_mut().zip(seen) {
        *pixel = Rgb(seen.map_or([0; 3], |(_, colour)| colour));
    }
    View { picture, holes }
}

fn warp_row(image: &DepthImage, y: u32, shift: &Shift) -> Vec<Seen> {
    let (colours, inverses) = (image.colours(y), image.inverses(y));
    let width = inverses.len();
    let at: Vec<f64> = (0..)
        .zip(inverses)
        .map(|(x, &v): (u32, &f32)| f64::from(x) + 0.5 + shift.pixels(f64::from(v), width as u32))
        .collect();
    let limit = TEAR / shift.pixels_per_inverse(width as u32);
    let drawn = |x: usize| inverses.get(x).is_some_and(|v| !is_nothing(*v));
    // Pixels are joined where the step between them is small in the view, or equals the step before it on the side that the rays come from.
    let towards = if shift.separation < 0.0 { -1 } else { 1 };
    let joined = |x: usize| {
        let steps = [Some(x), x.checked_add_signed(towards)].map(|x| step(inverses, x?));
        let own = steps[0].unwrap_or(f64::INFINITY);
        let other = steps[1].map_or(own, |before| own - before);
        drawn(x) && drawn(x + 1) && own.abs().min(other.abs()) <= limit
    };
    let joined: Vec<bool> = (0..width.saturating_sub(1)).map(joined).collect();
    let mut row: Vec<Seen> = vec![None; width];
    for x in 0..width {
        if !drawn(x) {
            continue;
        }
        let sample = (f64::from(inverses[x]), colours[x]);
        let after = joined.get(x).copied().unwrap_or(false);
        let before = x > 0 && joined[x - 1];
        if !before {
            cover(&mut row, [at[x] - 0.5, at[x]], [sample; 2]);
        }
        match after {
            true => {
                let next = (f64::from(inverses[x + 1]), colours[x + 1]);
                cover(&mut row, [at[x], at[x + 1]], [sample, next]);
            }
            false => cover(&mut row, [at[x], at[x] + 0.5], [sample; 2]),
        }
    }
    for (x, seen) in row.iter_mut().enumerate() {
        if seen.is_none() && !drawn(x) {
            *seen = Some((f64::from(inverses[x]), colours[x]));
        }
    }
    row
}

/// The step of 1/w from a pixel to the next.
fn step(inverses: &[f32], from: usize) -> Option<f64> {
    let pair = (inverses.get(from)?, inverses.get(from + 1)?);
    Some(f64::from(*pair.1) - f64::from(*pair.0))
}

/// How much the step of 1/w from a pixel to the next differs from the steps before and after it, whichever is closer. It is 0 on planes and at
/// creases, and the height of a step between two surfaces.
pub(super) fn excess(inverses: &[f32], x: usize) -> f64 {
    let step = |from: usize| step(inverses, from);
    let Some(own) = step(x) else {
        return f64::INFINITY;
    };
    let before = x.checked_sub(1).and_then(step);
    let around = before.into_iter().chain(step(x + 1));
    let least = around.map(|other| (own - other).abs()).reduce(f64::min);
    least.unwrap_or(own.abs())
}

/// Draws a surface between two places of a row, with a depth test. One that is turned away (`to` lies left of `from`) is not seen.
fn cover(row: &mut [Seen], [from, to]: [f64; 2], [first, last]: [(f64, [u8; 3]); 2]) {
    let start = (from - 0.5).ceil().max(0.0);
    let mut x = start as usize;
    while let Some(seen) = row.get_mut(x) {
        let centre = x as f64 + 0.5;
        if centre >= to {
            break;
        }
        let u = (centre - from) / (to - from);
        let inverse = first.0 + (last.0 - first.0) * u;
        if seen.is_none_or(|(nearest, _)| inverse > nearest) {
            *seen = Some((inverse, mixed(first.1, last.1, u)));
        }
        x += 1;
    }
}

fn mixed(a: [u8; 3], b: [u8; 3], u: f64) -> [u8; 3] {
    let mix = |(a, b): (u8, u8)| (f64::from(a) + (f64::from(b) - f64::from(a)) * u).round() as u8;
    [(a[0], b[0]), (a[1], b[1]), (a[2], b[2])].map(mix)
}

/// Fills holes with the pixel at their farther end.
fn fill(row: &mut [Seen]) {
    let mut x = 0;
    while x < row.len() {
        if row[x].is_some() {
            x += 1;
            continue;
        }
        let end = (x..row.len()).find(|&at| row[at].is_some());
        let left = x.checked_sub(1).and_then(|at| row[at]);
        let right = end.and_then(|at| row[at]);
        let farther = match (left, right) {
            (Some(l), Some(r)) => Some(if l.0 <= r.0 { l } else { r }),
            (one, None) | (None, one) => one,
        };
        let end = end.unwrap_or(row.len());
        row[x..end].fill(farther);
        x = end;
    }
}
