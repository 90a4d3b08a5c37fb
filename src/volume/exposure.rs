//! The brightness of a scene on the display.
//!
//! A voxel is on or off and shines only while the screen passes it, so the display is dark ("The reduced image brightness requires dimming the ambient
//! lights", Popescu et al., section VII), and of a dark scene few voxels would shine at all.

use super::Volume;
use crate::interleave::reference::{encoded, linear};

/// One voxel in this many may be brighter than white.
const ABOVE: usize = 20;

impl Volume {
    /// The volume with all light multiplied by a factor of at least 1, so that one voxel in twenty would be brighter than white; and the
    /// factor. Black voxels do not count.
    #[must_use]
    pub fn exposed(mut self) -> (Volume, f32) {
        let mut counts = [0_usize; 256];
        for voxel in self.half_planes.iter().flatten() {
            let brightest = voxel.colour.into_iter().max().unwrap_or(0);
            counts[usize::from(brightest)] += 1;
        }
        let shining: usize = counts[1..].iter().sum();
        let mut above = 0;
        let white = (1..=255_u8).rev().find(|&stored| {
            above += counts[usize::from(stored)];
            above * ABOVE > shining
        });
        let gain = 1.0 / linear(f32::from(white.unwrap_or(255)) / 255.0);
        let exposed: Vec<u8> = (0..=255_u8)
            .map(|stored| {
                let light = gain * linear(f32::from(stored) / 255.0);
                (encoded(light.min(1.0)) * 255.0).round() as u8
            })
            .collect();
        for voxel in self.half_planes.iter_mut().flatten() {
            voxel.colour = voxel.colour.map(|stored| exposed[usize::from(stored)]);
        }
        (self, gain)
    }
}
