//! The picture of gratings: tiles, each of its own frequency, in the frame of all patterns.
#![forbid(unsafe_code)]

use super::super::frame::{self, Frame};
use super::super::pattern::{GAMMA, SWING};
use glam::DVec2;
use image::{Rgb, RgbImage};
use std::f64::consts::TAU;

/// Tiles along the longer side and along the shorter one.
const LONG: usize = 11;
const SHORT: usize = 10;
/// Turns per pixel to the right, of the first grating, and from one to the next.
const ACROSS: f64 = 0.08;
const ACROSS_STEP: f64 = 0.1;
/// Turns per pixel from one grating to the next downwards; they lie around 0.
const DOWN_STEP: f64 = 0.085;
/// Changes with what the picture has, so that photos of an older one are known.
const VERSION: u64 = 1;

/// A tile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tile {
    /// Left top corner, panel pixels.
    pub corner: DVec2,
    /// Width and height, panel pixels.
    pub size: DVec2,
    /// Frequency of the grating, turns per panel pixel.
    pub frequency: DVec2,
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
        frequency: frequency(index),
    })
}

/// Of the tile that has this number. Neighbours have frequencies far apart, so that no part of the panel, which a lamp could hide, has all of
/// a kind; the steps have no divisor in common with the numbers of tiles. Rows of frequencies lie between each other as bricks do.
fn frequency(index: usize) -> DVec2 {
    let (column, row) = (index % LONG, index / LONG);
    let (i, j) = ((4 * column + 3 * row) % LONG, 3 * row % SHORT);
    let (i, j) = (i as f64, j as f64);
    DVec2::new(
        ACROSS + ACROSS_STEP * (i + 0.5 * (j % 2.0)),
        DOWN_STEP * (j - (SHORT - 1) as f64 / 2.0),
    )
}

/// The picture for a panel whose pixels have red on the left; row 0 on top.
pub(super) fn picture(size: (u32, u32)) -> RgbImage {
    let frame = frame(size);
    let (columns, _) = counts(&frame);
    let tiles: Vec<Tile> = tiles(&frame).collect();
    let (from, to) = frame.field();
    let field = |p: DVec2| {
        let cell = ((p - from) / (to - from)).clamp(DVec2::ZERO, DVec2::splat(1.0 - 1e-9))
            * DVec2::new(columns as f64, (tiles.len() / columns) as f64);
        let tile = tiles.get(cell.y as usize * columns + cell.x as usize);
        let phase = tile.map_or(0.0, |tile| (p - tile.corner).dot(tile.frequency));
        0.5 + SWING * (TAU * phase).cos()
    };
    RgbImage::from_fn(size.0, size.1, |x, row| {
        Rgb([0.5, 1.5, 2.5].map(|c| {
            let p = DVec2::new(f64::from(x) + c / 3.0, f64::from(row) + 0.5);
            let light = frame.light(p).unwrap_or_else(|| field(p));
            (255.0 * light.powf(1.0 / GAMMA)).round() as u8
        }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No two tiles have one frequency, and near each sheet as they are sold there are some, whichever way the panel stands.
    #[test]
    fn gratings_are_near_every_sheet() {
        let all: Vec<DVec2> = (0..LONG * SHORT).map(frequency).collect();
        for (i, a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|b| a.distance(*b) > 0.05), "{a}");
        }
        for size in [(3840, 2160), (1536, 2048)] {
            assert_eq!(tiles(&frame(size)).count(), all.len());
        }
        for (pitch, slant) in [
            (2.8, 0.0),
            (3.0, 0.5),
            (5.3, -1.0),
            (8.0, 0.66),
            (5.7, -2.0),
        ] {
            let f = DVec2::new(3.0, slant) / pitch;
            let near = all.iter().filter(|k| k.distance(f) < 0.17).count();
            assert!(near >= 5, "{near} for {pitch}, {slant}");
        }
    }
}
