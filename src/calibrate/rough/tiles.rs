//! The picture of gratings: tiles in the frame of all patterns. Each frequency is in two neighbouring tiles, one of which is drawn for a panel with red on the left
//! of a pixel, the other for one with blue there.
#![forbid(unsafe_code)]

use super::super::frame::{self, Frame};
use super::super::pattern::{GAMMA, SWING};
use crate::display::SubpixelOrder;
use glam::DVec2;
use image::{Rgb, RgbImage};
use std::f64::consts::TAU;

/// Tiles along the longer side and along the shorter one; the first is even, so that the tiles of a frequency are neighbours.
const LONG: usize = 14;
const SHORT: usize = 12;
/// Frequencies to the right and downwards.
const ACROSS: usize = 12;
const DOWN: usize = 7;
/// From a pair of tiles to the next, in frequencies along their rows; it has no divisor in common with their number.
const STRIDE: usize = 17;
/// Turns per pixel to the right, of the first grating, and from one to the next.
const ACROSS_FIRST: f64 = 0.08;
const ACROSS_STEP: f64 = 0.09;
/// Turns per pixel from one grating to the next downwards; they lie around 0.
const DOWN_STEP: f64 = 0.12;
/// Changes with what the picture has, so that photos of an older one are known.
const VERSION: u64 = 2;

/// A tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tile {
    /// Left top corner, panel pixels.
    pub corner: DVec2,
    /// Width and height, panel pixels.
    pub size: DVec2,
    /// Frequency of the grating, turns per panel pixel.
    pub frequency: DVec2,
    /// Which colour is leftmost in a pixel of the panel that it is drawn for.
    pub order: SubpixelOrder,
}

pub(super) fn frame((width, height): (u32, u32)) -> Frame {
    let code = frame::code(&[VERSION, u64::from(width), u64::from(height)]);
    Frame::new((width, height), 0.0, code)
}

fn counts(frame: &Frame) -> (usize, usize) {
    match frame.size.x >= frame.size.y {
        true => (LONG, SHORT),
        false => (SHORT, LONG),
    }
}

/// The tiles by rows from the top.
pub(super) fn tiles(frame: &Frame) -> impl Iterator<Item = Tile> {
    let (columns, rows) = counts(frame);
    let (from, to) = frame.field();
    let size = (to - from) / DVec2::new(columns as f64, rows as f64);
    (0..columns * rows).map(move |index| Tile {
        corner: from + size * DVec2::new((index % columns) as f64, (index / columns) as f64),
        size,
        frequency: frequency(index / 2),
        order: order(index),
    })
}

/// Of the tile that has this number: each order has every other tile of a row, and of a column where the panel lies.
fn order(index: usize) -> SubpixelOrder {
    match (index + index / LONG).is_multiple_of(2) {
        true => SubpixelOrder::Rgb,
        false => SubpixelOrder::Bgr,
    }
}

/// Of the pair of tiles that has this number. Neighbours have frequencies far apart, and near ones lie in tiles far apart, so that no part of the panel, which
/// a lamp could hide, has all of a kind. Rows of frequencies lie between each other as bricks do.
fn frequency(pair: usize) -> DVec2 {
    let place = STRIDE * pair % (ACROSS * DOWN);
    let (i, j) = (place % ACROSS, place / ACROSS);
    DVec2::new(
        ACROSS_FIRST + ACROSS_STEP * (i as f64 + 0.5 * (j % 2) as f64),
        DOWN_STEP * (j as f64 - (DOWN - 1) as f64 / 2.0),
    )
}

/// The picture for a panel of this size; row 0 on top.
pub(super) fn picture(size: (u32, u32)) -> RgbImage {
    let frame = frame(size);
    let (columns, _) = counts(&frame);
    let tiles: Vec<Tile> = tiles(&frame).collect();
    let (from, to) = frame.field();
    let tile = |p: DVec2| {
        let cell = ((p - from) / (to - from)).clamp(DVec2::ZERO, DVec2::splat(1.0 - 1e-9))
            * DVec2::new(columns as f64, (tiles.len() / columns) as f64);
        tiles.get(cell.y as usize * columns + cell.x as usize)
    };
    RgbImage::from_fn(size.0, size.1, |x, row| {
        // A pixel belongs to the tile of its middle.
        let middle = DVec2::new(f64::from(x) + 0.5, f64::from(row) + 0.5);
        let tile = tile(middle);
        Rgb([0.0, 1.0, 2.0].map(|colour| {
            let place = match tile.map(|tile| tile.order) {
                Some(SubpixelOrder::Bgr) => 2.0 - colour,
                _ => colour,
            };
            let p = DVec2::new(f64::from(x) + (place + 0.5) / 3.0, middle.y);
            let light = frame.light(p).unwrap_or_else(|| {
                let phase = tile.map_or(0.0, |tile| (p - tile.corner).dot(tile.frequency));
                0.5 + SWING * (TAU * phase).cos()
            });
            (255.0 * light.powf(1.0 / GAMMA)).round() as u8
        }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Each frequency is drawn once in either order, in neighbouring tiles, and near each sheet as they are sold there are some, whichever way the panel stands.
    #[test]
    fn gratings_are_near_every_sheet() {
        let all: Vec<DVec2> = (0..ACROSS * DOWN).map(frequency).collect();
        for (i, a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|b| a.distance(*b) > 0.05), "{a}");
        }
        for size in [(3840, 2160), (1536, 2048)] {
            let tiles: Vec<Tile> = tiles(&frame(size)).collect();
            assert_eq!(tiles.len(), 2 * all.len());
            for (pair, frequency) in tiles.chunks_exact(2).zip(&all) {
                assert!(pair.iter().all(|tile| tile.frequency == *frequency));
                assert_ne!(pair[0].order, pair[1].order);
                assert_eq!(pair[0].corner.y, pair[1].corner.y);
            }
        }
        for (pitch, slant) in [
            (2.8, 0.0),
            (3.0, 0.5),
            (5.3, -1.0),
            (8.0, 0.66),
            (5.7, -2.0),
        ] {
            let f = DVec2::new(3.0, slant) / pitch;
            let near = (0..all.len()).filter(|pair| all[*pair].distance(f) < 0.17);
            let near: Vec<usize> = near.collect();
            assert!(near.len() >= 5, "{near:?} for {pitch}, {slant}");
            let apart = |of: fn(usize) -> usize| {
                let places = near.iter().map(|pair| of(*pair));
                places.collect::<BTreeSet<usize>>().len()
            };
            let (columns, rows) = (apart(|pair| 2 * pair % LONG), apart(|pair| 2 * pair / LONG));
            assert!(columns.min(rows) >= 4, "{near:?} for {pitch}, {slant}");
        }
    }
}
