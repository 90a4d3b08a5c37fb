//! A picture of the fit: the fringes of each photo, and their residuals.
#![forbid(unsafe_code)]

use super::fringes::BLOCKS;
use super::{Fit, Photo, Sighting};
use glam::DVec2;
use image::{Rgb, RgbImage};

/// Width of a panel in the picture, pixels.
const WIDTH: u32 = 600;
const GAP: u32 = 8;
/// The colour is full where the residual is half a view.
const FULL: f64 = 0.5;
const UNMEASURED: Rgb<u8> = Rgb([96, 96, 96]);

impl Fit {
    /// A row per photo: the panel upright as it was found in the photo, then the residuals, white where there is none, red
    /// for half a view or more above and blue for half a view or more below what the fit expects.
    #[must_use]
    pub fn picture(&self, photos: &[Photo], sightings: &[Sighting], panel: (u32, u32)) -> RgbImage {
        let size = DVec2::new(f64::from(panel.0), f64::from(panel.1));
        let height = (f64::from(WIDTH) * size.y / size.x).ceil() as u32;
        let rows = self.misses.len() as u32;
        let mut picture = RgbImage::new(2 * WIDTH + GAP, rows * (height + GAP));
        for (i, ((misses, photo), sighting)) in
            (0..).zip(self.misses.iter().zip(photos).zip(sightings))
        {
            let mut grid = [[None; BLOCKS]; BLOCKS];
            for ((column, row), miss) in misses {
                if let Some(cell) = grid.get_mut(*row).and_then(|cells| cells.get_mut(*column)) {
                    *cell = Some(*miss);
                }
            }
            for (x, y) in (0..height).flat_map(|y| (0..WIDTH).map(move |x| (x, y))) {
                let part = DVec2::new(
                    (f64::from(x) + 0.5) / f64::from(WIDTH),
                    (f64::from(y) + 0.5) / f64::from(height),
                );
                let seen = sighting
                    .start
                    .to_picture(part * size)
                    .and_then(|p| photo.at(p));
                let seen = seen.unwrap_or_default();
                let top = i * (height + GAP) + y;
                picture.put_pixel(x, top, Rgb(seen.map(|v| (255.0 * v.sqrt()) as u8)));
                let cell = (part * BLOCKS as f64)
                    .as_uvec2()
                    .min(glam::UVec2::splat(BLOCKS as u32 - 1));
                let cells = grid.get(cell.y as usize);
                let miss = cells
                    .and_then(|cells| cells.get(cell.x as usize))
                    .copied()
                    .flatten();
                picture.put_pixel(WIDTH + GAP + x, top, miss.map_or(UNMEASURED, colour));
            }
        }
        picture
    }
}

fn colour(miss: f64) -> Rgb<u8> {
    let part = (miss / FULL).clamp(-1.0, 1.0);
    let pale = (255.0 * (1.0 - part.abs())) as u8;
    Rgb(if part > 0.0 {
        [255, pale, pale]
    } else {
        [pale, pale, 255]
    })
}
