//! From colours to voxels that are on or off.
//!
//! A pixel of the display has one bit for each channel, so a colour is the share of lit voxels around it. The eye averages light, so the shares
//! are those of linear light, decoded from sRGB. The threshold of a voxel depends on its place alone. Error diffusion is no alternative: it passes
//! the error of a pixel to its neighbours in the picture, but in a slice a surface is a line, whose neighbours lie in other slices. Here a
//! surface cuts through a grid in which each line has all thresholds: 256 neighbours along any of the three axes
//! have each threshold once. The grid is a lattice, after Roberts' R3 sequence ("The Unreasonable Effectiveness of Quasirandom Sequences", 2018),
//! with its steps rounded to odd numbers. The channels' thresholds are a third apart, so that a grey voxel is not always black or white.

use super::fragments::by_number;
use super::{RotatingScreen, Volume};
use crate::interleave::reference::linear;
use image::{Rgb, RgbImage};

/// Thresholds from sector to sector, row to row, column to column and channel to channel, modulo 256.
const STEPS: [u32; 4] = [209, 171, 141, 85];

/// A lit voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lit {
    /// As in [`super::Voxel`].
    pub at: u32,
    /// Red is 1, green 2 and blue 4.
    pub channels: u8,
}

/// The picture of the display: the voxels of the slices, with one bit for each channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Slices {
    pub(super) screen: RotatingScreen,
    /// As in [`Volume`].
    pub(super) half_planes: Vec<Vec<Lit>>,
}

impl Volume {
    /// With one bit for each channel.
    pub fn dithered(&self) -> Slices {
        let columns = self.screen.columns();
        let light: Vec<f32> = (0..=255_u8)
            .map(|stored| linear(f32::from(stored) / 255.0))
            .collect();
        Slices {
            screen: self.screen,
            half_planes: by_number(self.screen.half_planes(), || {
                let light = &light;
                move |half_plane: u32| {
                    let voxels = self.half_planes.get(half_plane as usize);
                    let none = Lit { at: 0, channels: 0 };
                    let mut lit = vec![none; voxels.map_or(0, Vec::len)];
                    let mut count = 0;
                    for voxel in voxels.into_iter().flatten() {
                        let place = [half_plane, voxel.at / columns, voxel.at % columns];
                        let mut channels = 0;
                        for (channel, &stored) in (0..).zip(&voxel.colour) {
                            let light = light.get(usize::from(stored)).copied().unwrap_or(0.0);
                            channels |= u8::from(light > threshold(place, channel)) << channel;
                        }
                        // Whether a voxel is lit is unpredictable, so there is no branch.
                        if let Some(next) = lit.get_mut(count) {
                            let at = voxel.at;
                            *next = Lit { at, channels };
                        }
                        count += usize::from(channels != 0);
                    }
                    lit.truncate(count);
                    lit
                }
            }),
        }
    }
}

/// The threshold of a voxel, above 0 and below 1.
#[inline(always)]
fn threshold([half_plane, row, column]: [u32; 3], channel: u32) -> f32 {
    let parts = [half_plane, row, column, channel];
    let sum: u32 = parts
        .iter()
        .zip(STEPS)
        .map(|(part, step)| part * step)
        .sum();
    ((sum % 256) as f32 + 0.5) / 256.0
}

impl Slices {
    /// The display of the slices.
    pub fn screen(&self) -> &RotatingScreen {
        &self.screen
    }

    /// Each half plane's lit voxels, in order.
    pub fn half_planes(&self) -> &[Vec<Lit>] {
        &self.half_planes
    }

    /// A slice, seen from the side where its first half plane is on the right.
    pub fn picture(&self, slice: u32) -> RgbImage {
        let (pixels, columns) = (self.screen.pixels, self.screen.columns());
        let mut picture = RgbImage::new(pixels, pixels);
        let [right, left] = self.screen.sides(slice);
        for (half_plane, mirrored) in [(right, false), (left, true)] {
            for lit in self
                .half_planes
                .get(half_plane as usize)
                .into_iter()
                .flatten()
            {
                let (row, column) = (lit.at / columns, lit.at % columns);
                let x = match mirrored {
                    true => columns - 1 - column,
                    false => columns + column,
                };
                let channel = |index: u8| 255 * (lit.channels >> index & 1);
                picture.put_pixel(x, row, Rgb([channel(0), channel(1), channel(2)]));
            }
        }
        picture
    }
}
