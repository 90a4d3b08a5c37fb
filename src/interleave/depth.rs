//! Colour beside depth (RGBD): the program's own view on the left, its nearness as grey on the right.
//!
//! `grey = (d − far) / (near − far)`, where `near` and `far` are the nearest and the farthest depth that the frame has drawn, without one
//! pixel in 200 at either end. Values of a depth buffer are linear in 1/w under any projection and glDepthRange, so equal steps of
//! parallax are equal steps of grey. White is near, as in Looking Glass's tools.
#![forbid(unsafe_code)]

use super::reference::{ReferenceError, picture, resample};
use crate::plan::depths::OUTLIERS;
use image::{Rgb, RgbImage};

/// A depth buffer, and which of its values are white and black.
#[derive(Clone, Debug, PartialEq)]
pub struct Depth {
    /// Width and height in pixels.
    size: (u32, u32),
    /// Row 0 on top.
    values: Vec<u32>,
    /// Depth buffer values that are shown white and black, 0 to 1.
    pub ends: [f32; 2],
}

impl Depth {
    /// From values between 0 and `u32::MAX`. `nearer_is_larger`: of two values the larger one is nearer. A pixel with the farthest
    /// possible value was not drawn.
    pub fn new(size: (u32, u32), values: Vec<u32>, nearer_is_larger: bool) -> Self {
        let farthest = if nearer_is_larger { 0 } else { u32::MAX };
        let mut drawn: Vec<u32> = values.iter().copied().filter(|&v| v != farthest).collect();
        let (outside, last) = (drawn.len() / OUTLIERS, drawn.len().saturating_sub(1));
        let mut nth = |n: usize| match drawn.is_empty() {
            true => farthest,
            false => *drawn.select_nth_unstable(n).1,
        };
        let (low, high) = (nth(outside), nth(last - outside));
        let ends = if nearer_is_larger {
            [high, low]
        } else {
            [low, high]
        };
        Self {
            size,
            values,
            ends: ends.map(|end| (f64::from(end) / f64::from(u32::MAX)) as f32),
        }
    }

    /// The grey of the pixel that contains the place num/den across the picture.
    fn grey(&self, [x, y]: [u64; 2], [den_x, den_y]: [u64; 2]) -> u8 {
        let at = |num: u64, den: u64, size: u32| (num * u64::from(size) / den) as usize;
        let (x, y) = (at(x, den_x, self.size.0), at(y, den_y, self.size.1));
        let value = self.values.get(y * self.size.0 as usize + x);
        let d = value.map_or(0.0, |&v| (f64::from(v) / f64::from(u32::MAX)) as f32);
        let [near, far] = self.ends;
        let grey = if near == far {
            // There is one depth, or nothing: pixels that were drawn are white.
            f32::from(u8::from(d == near && d > 0.0 && d < 1.0))
        } else {
            ((d - far) / (near - far)).clamp(0.0, 1.0)
        };
        (grey * 255.0 + 0.5) as u8
    }
}

/// The own view and its depth, each in half of a picture of any size. Depths are not interpolated, since no surface lies between two.
pub fn rgbd(own: &RgbImage, depth: &Depth, size: (u32, u32)) -> Result<RgbImage, ReferenceError> {
    let mut out = picture(size)?;
    let colour = resample(own, (2, 1), size)?;
    let wide = 2 * u64::from(size.0);
    for (x, y, pixel) in out.enumerate_pixels_mut() {
        let centre = 2 * (2 * u64::from(x) + 1);
        if centre < wide {
            *pixel = *colour.get_pixel(x, y);
            continue;
        }
        let place = [centre - wide, 2 * u64::from(y) + 1];
        *pixel = Rgb([depth.grey(place, [wide, 2 * u64::from(size.1)]); 3]);
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn greys(values: Vec<u32>, nearer_is_larger: bool) -> Vec<u8> {
        let size = (values.len() as u32, 1);
        let own = RgbImage::from_pixel(size.0, 1, Rgb([9; 3]));
        let depth = Depth::new(size, values, nearer_is_larger);
        let out = rgbd(&own, &depth, (2 * size.0, 1)).unwrap();
        assert!(out.pixels().take(size.0 as usize).all(|p| p.0 == [9; 3]));
        let right = out.pixels().skip(size.0 as usize);
        right.map(|p| p.0[0]).collect()
    }

    #[test]
    fn near_is_white_whichever_way_depth_goes() {
        let values = vec![0x4000_0000, 0x6000_0000, 0x8000_0000, u32::MAX];
        assert_eq!(greys(values, false), [255, 128, 0, 0]);
        let values = vec![0xC000_0000, 0xA000_0000, 0x8000_0000, 0];
        assert_eq!(greys(values, true), [255, 128, 0, 0]);
        assert_eq!(greys(vec![u32::MAX; 2], false), [0, 0], "nothing is drawn");
        assert_eq!(greys(vec![0; 2], true), [0, 0]);
        assert_eq!(greys(vec![7 << 24, u32::MAX], false), [255, 0], "one depth");
    }

    #[test]
    fn one_pixel_in_200_does_not_count() {
        let mut values: Vec<u32> = (0..400).map(|i| 0x4000_0000 + i * 0x10_0000).collect();
        values[0] = 5;
        values[399] = u32::MAX - 5;
        let greys = greys(values, false);
        assert_eq!(
            [greys[0], greys[2], greys[397], greys[399]],
            [255, 255, 0, 0]
        );
    }
}
