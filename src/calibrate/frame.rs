//! The frame about a pattern, by which its place in a photo is found, and marks that say which side is up, which picture it is, and whether it is
//! shown pixel for pixel.
//!
//! Panel coordinates are pixels from the top left corner of the panel, x to the right, y down; the middle of subpixel
//! `(x, row, c)` is at `(x + (c + 1/2)/3, row + 1/2)`.
#![forbid(unsafe_code)]

use glam::DVec2;
use std::ops::Range;

/// Where the white frame, the black ring and the field begin, in bands from the edge of the panel. The frame keeps away
/// from the edge, where the bezel would cover some of it from the side.
pub(super) const FRAME: f64 = 0.5;
pub(super) const RING: f64 = 1.5;
const FIELD: f64 = 3.5;
/// The middle of the frame and of the ring, in bands.
pub(super) const IN_FRAME: f64 = 1.0;
pub(super) const IN_RING: f64 = 2.5;
/// Where mark and code lie in the ring, in bands: away from the edge of the frame, which blur must leave alone.
const MARKS: Range<f64> = 2.3..3.0;
/// Where the mark lies along its side, from the corner, as a part of the side.
const MARK: Range<f64> = 0.12..0.20;
/// Where the code lies along the lower side.
const CODE: Range<f64> = 0.24..0.76;
const CODE_BITS: u16 = 12;
/// Rows of single pixels, white and black in turn, in the ring at the left and the right side, which are grey where the picture is scaled: along the
/// side, and their middle in bands.
pub(super) const ROWS: Range<f64> = 0.32..0.68;
pub(super) const IN_MARKS: f64 = (MARKS.start + MARKS.end) / 2.0;
/// Marks on the outermost pixels, near the corners, of which some are missing where the picture is moved; along each side.
pub(super) const EDGES: [Range<f64>; 2] = [0.02..0.06, 0.94..0.98];
/// The least thickness of these, pixels.
const EDGE: f64 = 3.0;

/// Where everything but the field lies in the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Width and height of the panel, pixels.
    pub size: DVec2,
    /// Thickness of the white frame, pixels; the black ring inside is twice as thick, and the black margin outside half. It is even, so that the edges
    /// of the frame are edges of pixels.
    pub band: f64,
    /// Thickness of the marks on the outermost pixels, pixels: a lens or more, so that they are seen from everywhere.
    pub edge: f64,
    /// Says which picture it is, and of which panel.
    pub code: u16,
}

/// The eight places at which a mark can be seen, of a panel turned or mirrored: side (top, right, bottom, left, in the
/// order of the clock) and whether the mark is at the side's beginning in that order.
pub(super) const PLACES: [(usize, bool); 8] = [
    (0, true),
    (0, false),
    (1, true),
    (1, false),
    (2, true),
    (2, false),
    (3, true),
    (3, false),
];

impl Frame {
    /// For lenses of at most this width, panel pixels.
    pub(super) fn new((width, height): (u32, u32), lens: f64, code: u16) -> Self {
        let size = DVec2::new(f64::from(width), f64::from(height));
        Self {
            size,
            band: 2.0 * (0.015 * size.min_element()).max(lens).round(),
            edge: EDGE.max(lens.ceil()),
            code,
        }
    }

    /// Corners of the measuring field: top left and bottom right.
    pub(super) fn field(&self) -> (DVec2, DVec2) {
        let inset = DVec2::splat(FIELD * self.band);
        (inset, self.size - inset)
    }

    /// A point by side (in the order of the clock from the top), part of the side, and depth from the edge in bands.
    pub(super) fn along(&self, side: usize, part: f64, depth: f64) -> DVec2 {
        let (d, s) = (depth * self.band, self.size);
        match side {
            0 => DVec2::new(part * s.x, d),
            1 => DVec2::new(s.x - d, part * s.y),
            2 => DVec2::new((1.0 - part) * s.x, s.y - d),
            _ => DVec2::new(d, (1.0 - part) * s.y),
        }
    }

    /// Points inside one of the eight places of the mark.
    pub(super) fn place(&self, (side, begin): (usize, bool)) -> impl Iterator<Item = DVec2> {
        cell(MARK).map(move |(part, depth)| {
            self.along(side, if begin { part } else { 1.0 - part }, depth)
        })
    }

    /// Points inside a cell of the code, lowest bit first.
    pub(super) fn bits(&self) -> impl Iterator<Item = impl Iterator<Item = DVec2>> {
        (0..CODE_BITS).map(move |bit| {
            let width = (CODE.end - CODE.start) / f64::from(CODE_BITS);
            let start = CODE.start + width * f64::from(bit);
            // From the left: the lower side runs leftwards in the order of the clock.
            cell(start..start + width).map(|(part, depth)| self.along(2, 1.0 - part, depth))
        })
    }

    /// Light of a subpixel, 0 to 1; none in the field.
    pub(super) fn light(&self, p: DVec2) -> Option<f64> {
        let sides = p.min(self.size - p);
        let depth = sides.min_element() / self.band;
        let part = p / self.size;
        let marked = |part: f64| EDGES.iter().any(|range| range.contains(&part));
        if sides.y < self.edge && marked(part.x) || sides.x < self.edge && marked(part.y) {
            return Some(1.0);
        }
        if depth < RING {
            return Some(f64::from(u8::from(depth >= FRAME)));
        }
        if depth >= FIELD {
            return None;
        }
        let inside = |y: f64| MARKS.contains(&(y / self.band));
        if inside(sides.x) && ROWS.contains(&part.y) {
            return Some(f64::from(u8::from(p.y.rem_euclid(2.0) < 1.0)));
        }
        let mark = inside(p.y) && MARK.contains(&part.x);
        let bit = (part.x - CODE.start) / (CODE.end - CODE.start) * f64::from(CODE_BITS);
        let coded = inside(self.size.y - p.y)
            && CODE.contains(&part.x)
            && self.code >> (bit as u16) & 1 == 1;
        Some(f64::from(u8::from(mark || coded)))
    }
}

/// Points in the inner part of a cell, as part of the side and depth in bands.
fn cell(range: Range<f64>) -> impl Iterator<Item = (f64, f64)> {
    let depth = (MARKS.start + MARKS.end) / 2.0;
    (0..12).flat_map(move |i| {
        let part = range.start + (range.end - range.start) * (0.2 + 0.6 * f64::from(i) / 11.0);
        (0..5).map(move |j| (part, depth + 0.25 * (f64::from(j) / 4.0 - 0.5)))
    })
}

/// A checksum of what a picture depends on (FNV-1a, folded).
pub(super) fn code(words: &[u64]) -> u16 {
    let hash = words
        .iter()
        .flat_map(|word| word.to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
    let folded = (hash ^ hash >> 12 ^ hash >> 24 ^ hash >> 36) & 0xfff;
    folded as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_ring_mark_and_code_are_where_they_are_looked_for() {
        let frame = Frame::new((960, 540), 8.0 / 3.0, 0x9c5);
        for side in 0..4 {
            for part in [0.07, 0.22, 0.78, 0.93] {
                assert_eq!(frame.light(frame.along(side, part, 0.2)), Some(0.0));
                assert_eq!(frame.light(frame.along(side, part, IN_FRAME)), Some(1.0));
                assert_eq!(frame.light(frame.along(side, part, IN_RING)), Some(0.0));
            }
        }
        for place in PLACES {
            let expected = if place == (0, true) { 1.0 } else { 0.0 };
            assert!(
                frame.place(place).all(|p| frame.light(p) == Some(expected)),
                "{place:?}"
            );
        }
        for (bit, mut cell) in frame.bits().enumerate() {
            let expected = f64::from(frame.code >> bit & 1);
            assert!(cell.all(|p| frame.light(p) == Some(expected)), "bit {bit}");
        }
    }
}
