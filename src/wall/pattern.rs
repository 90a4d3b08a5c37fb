//! The coded pattern that each panel of a wall shows for the photos.
#![forbid(unsafe_code)]

use super::codes::{COUNT, MODULES, is_white};
use crate::display::Wall;
use image::{Rgb, RgbImage};

/// The most tags along the longer side of a panel: as many corners as a fit has use for.
const MOST_ALONG: u32 = 10;
/// Of a cell, in modules: the tag and what is white around it.
const CELL: u32 = MODULES + 1;

/// A tag on a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tag {
    /// Its number.
    pub(super) id: usize,
    /// The panel.
    pub(super) panel: usize,
    /// Left and top of its white edge, in pixels of the panel.
    at: [u32; 2],
    /// Side of a module in pixels.
    module: u32,
}

impl Tag {
    /// The corners of its black edge in pixels of the panel, in the order of the detector: left bottom, right bottom, right top, left top.
    pub(super) fn corners(&self) -> [[f64; 2]; 4] {
        let [left, top] = self.at.map(|at| f64::from(at + self.module));
        let side = f64::from(self.module * (MODULES - 2));
        let (right, bottom) = (left + side, top + side);
        [[left, bottom], [right, bottom], [right, top], [left, top]]
    }
}

/// All tags of a wall. Each panel has tags of its own, as many as there are for so many panels.
pub(super) fn tags(wall: &Wall) -> Vec<Tag> {
    let most = (COUNT / wall.panels().len().max(1)) as u32;
    let mut tags = Vec::new();
    for (panel, shown) in wall.panels().iter().enumerate() {
        let (width, height) = shown.pixels;
        let grid = |along: u32| {
            let cell = f64::from(width.max(height)) / f64::from(along);
            let count = |side: u32| ((f64::from(side) / cell) as u32).max(1);
            (count(width), count(height))
        };
        let grids = (1..=MOST_ALONG).rev().map(grid);
        let (columns, rows) = grids
            .into_iter()
            .find(|(columns, rows)| columns * rows <= most)
            .unwrap_or((1, 1));
        let module = (width / columns).min(height / rows) / CELL;
        for row in 0..rows {
            for column in 0..columns {
                let middle = |side: u32, of: u32, at: u32| side * (2 * at + 1) / (2 * of);
                let corner = |middle: u32| middle - module * MODULES / 2;
                tags.push(Tag {
                    id: tags.len(),
                    panel,
                    at: [
                        corner(middle(width, columns, column)),
                        corner(middle(height, rows, row)),
                    ],
                    module,
                });
            }
        }
    }
    tags
}

/// The picture that a panel of a wall shows, in its pixels.
#[must_use]
pub fn pattern(wall: &Wall, panel: usize) -> RgbImage {
    let (width, height) = wall.panels()[panel].pixels;
    let mut picture = RgbImage::from_pixel(width, height, Rgb([255; 3]));
    for tag in tags(wall).iter().filter(|tag| tag.panel == panel) {
        let side = tag.module * MODULES;
        for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
            if !is_white(tag.id, x / tag.module, y / tag.module) {
                picture.put_pixel(tag.at[0] + x, tag.at[1] + y, Rgb([0; 3]));
            }
        }
    }
    picture
}
