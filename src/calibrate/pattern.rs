//! The picture shown on the panel: a frame that is easy to find, marks that say which side is up and which panel it was
//! made for, and the measuring field.
//!
//! Panel coordinates are pixels from the top left corner of the panel, x to the right, y down; the middle of subpixel
//! `(x, row, c)` is at `(x + (c + 1/2)/3, row + 1/2)`.
//!
//! The field is a cosine over the nominal phase of the lens plus a carrier of some fringes over the height of the panel.
//! Through the lenses only the beat of the two gratings is seen: the carrier, distorted by the error of the nominal lens.
//! The carrier keeps the frequency away from zero, so the sign of the error is in one photo, and coarse fringes survive
//! blur, noise and JPEG.
#![forbid(unsafe_code)]

use super::Setup;
use crate::display::SubpixelOrder;
use glam::DVec2;
use image::{Rgb, RgbImage};
use std::ops::Range;

/// Gamma of the panel; a wrong one adds harmonics and moves no phase.
const GAMMA: f64 = 2.2;
/// Half of the swing of the field, of full light.
pub(super) const SWING: f64 = 0.45;
/// How wrong the nominal pitch may be.
const PITCH_ERROR: f64 = 0.015;
/// How wrong the nominal slant may be, subpixels per row.
const SLANT_ERROR: f64 = 0.02;
/// Fringes that perspective and a bent field add.
const MARGIN: f64 = 2.0;
/// Where the white frame, the black ring and the field begin, in bands from the edge of the panel. The frame keeps away
/// from the edge, where the bezel would cover some of it from the side.
pub(super) const FRAME: f64 = 0.5;
const RING: f64 = 1.5;
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
/// Changes with what the picture has, so that photos of an older one are known.
const VERSION: u64 = 3;
/// Rows of single pixels, white and black in turn, in the ring at the left and the right side, which are grey where the picture is scaled: along the
/// side, and their middle in bands.
pub(super) const ROWS: Range<f64> = 0.32..0.68;
pub(super) const IN_MARKS: f64 = (MARKS.start + MARKS.end) / 2.0;
/// Marks on the outermost pixels, near the corners, of which some are missing where the picture is moved; along each side.
pub(super) const EDGES: [Range<f64>; 2] = [0.02..0.06, 0.94..0.98];
/// The least thickness of these, pixels.
const EDGE: f64 = 3.0;

/// Where everything lies in the picture.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// Width and height of the panel, pixels.
    pub size: DVec2,
    /// Thickness of the white frame, pixels; the black ring inside is twice as thick, and the black margin outside half. It is even, so that the edges
    /// of the frame are edges of pixels.
    pub band: f64,
    /// Fringes of the carrier over the height of the panel.
    pub carrier: f64,
    /// Largest deviation of the frequency from the carrier, fringes over the width and over the height.
    pub reach: DVec2,
    /// Says which panel the pattern was made for.
    pub code: u16,
    /// Thickness of the marks on the outermost pixels, pixels: a lens or more, so that they are seen from everywhere.
    pub edge: f64,
    /// Turns of the phase from the subpixel of red to that of blue.
    pub across: f64,
    pitch: f64,
    slant: f64,
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

impl Layout {
    pub(super) fn new(setup: &Setup) -> Self {
        let size = DVec2::new(f64::from(setup.width), f64::from(setup.height));
        let lenses = DVec2::new(3.0 * size.x, setup.slant.abs() * size.y) / setup.pitch;
        let reach = lenses * PITCH_ERROR
            + DVec2::new(0.0, SLANT_ERROR * size.y / setup.pitch)
            + DVec2::splat(MARGIN);
        Self {
            size,
            band: 2.0 * (0.015 * size.min_element()).max(setup.pitch / 3.0).round(),
            carrier: (2.0 * reach.y).ceil().max(24.0),
            reach,
            code: code(setup),
            edge: EDGE.max((setup.pitch / 3.0).ceil()),
            across: match setup.order {
                SubpixelOrder::Rgb => 2.0 / setup.pitch,
                SubpixelOrder::Bgr => -2.0 / setup.pitch,
            },
            pitch: setup.pitch,
            slant: setup.slant,
        }
    }

    /// Whether photos tell the colours apart: along a lens the pixels of each colour are seen in turn, and their beat has to be finer than the fringes.
    pub(super) fn tells_colours(&self) -> bool {
        self.slant.abs() * self.size.y / 3.0 >= 2.0 * self.carrier
    }

    /// Phase of the nominal lens at a point, turns.
    pub(super) fn nominal(&self, p: DVec2) -> f64 {
        (3.0 * p.x - 0.5 + self.slant * (p.y - 0.5)) / self.pitch
    }

    /// Phase of the pattern at a point of the field, turns.
    pub(super) fn phase(&self, p: DVec2) -> f64 {
        self.nominal(p) + self.carrier * p.y / self.size.y
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

    /// Light of a subpixel, 0 to 1.
    fn light(&self, p: DVec2) -> f64 {
        let sides = p.min(self.size - p);
        let depth = sides.min_element() / self.band;
        let part = p / self.size;
        let marked = |part: f64| EDGES.iter().any(|range| range.contains(&part));
        if sides.y < self.edge && marked(part.x) || sides.x < self.edge && marked(part.y) {
            return 1.0;
        }
        if depth < RING {
            return f64::from(u8::from(depth >= FRAME));
        }
        if depth >= FIELD {
            return 0.5 + SWING * (std::f64::consts::TAU * self.phase(p)).cos();
        }
        let inside = |y: f64| MARKS.contains(&(y / self.band));
        if inside(sides.x) && ROWS.contains(&part.y) {
            return f64::from(u8::from(p.y.rem_euclid(2.0) < 1.0));
        }
        let mark = inside(p.y) && MARK.contains(&part.x);
        let bit = (part.x - CODE.start) / (CODE.end - CODE.start) * f64::from(CODE_BITS);
        let coded = inside(self.size.y - p.y)
            && CODE.contains(&part.x)
            && self.code >> (bit as u16) & 1 == 1;
        f64::from(u8::from(mark || coded))
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

/// A checksum of the panel: FNV-1a over the values that the pattern depends on, folded.
fn code(setup: &Setup) -> u16 {
    let order = u64::from(setup.order == SubpixelOrder::Bgr);
    let words = [
        VERSION,
        setup.pitch.to_bits(),
        setup.slant.to_bits(),
        u64::from(setup.width),
        u64::from(setup.height),
        order,
    ];
    let hash = words
        .into_iter()
        .flat_map(u64::to_le_bytes)
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
    let folded = (hash ^ hash >> 12 ^ hash >> 24 ^ hash >> 36) & 0xfff;
    folded as u16
}

/// The pattern for a panel; row 0 on top.
pub(super) fn picture(setup: &Setup) -> RgbImage {
    let layout = Layout::new(setup);
    RgbImage::from_fn(setup.width, setup.height, |x, row| {
        let light = [0.5, 1.5, 2.5].map(|c| {
            let p = DVec2::new(f64::from(x) + c / 3.0, f64::from(row) + 0.5);
            (255.0 * layout.light(p).powf(1.0 / GAMMA)).round() as u8
        });
        let [left, middle, right] = light;
        Rgb(match setup.order {
            SubpixelOrder::Rgb => [left, middle, right],
            SubpixelOrder::Bgr => [right, middle, left],
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setup() -> Setup {
        Setup::new(960, 540, 8, 8.0, 0.66)
    }

    #[test]
    fn frame_ring_mark_and_code_are_where_they_are_looked_for() {
        let layout = Layout::new(&setup());
        for side in 0..4 {
            for part in [0.07, 0.22, 0.78, 0.93] {
                assert_eq!(layout.light(layout.along(side, part, 0.2)), 0.0);
                assert_eq!(layout.light(layout.along(side, part, IN_FRAME)), 1.0);
                assert_eq!(layout.light(layout.along(side, part, IN_RING)), 0.0);
            }
        }
        for place in PLACES {
            let expected = if place == (0, true) { 1.0 } else { 0.0 };
            assert!(
                layout.place(place).all(|p| layout.light(p) == expected),
                "{place:?}"
            );
        }
        for (bit, mut cell) in layout.bits().enumerate() {
            let expected = f64::from(layout.code >> bit & 1);
            assert!(cell.all(|p| layout.light(p) == expected), "bit {bit}");
        }
    }

    /// The fit takes the edges of the frame as rulers: half a pixel at each side of 2160 rows is a hundredth of a turn of the lenses.
    #[test]
    fn the_frame_ends_where_pixels_end() {
        for (width, height, pitch) in [
            (3840, 2160, 4.7),
            (1920, 1080, 17.0),
            (2560, 1600, 61.0),
            (960, 540, 8.0),
        ] {
            let setup = Setup::new(width, height, 8, pitch, 0.66);
            let layout = Layout::new(&setup);
            let picture = picture(&setup);
            // A column and a row that hold no mark.
            let column = (0.5 * layout.size.x) as u32;
            let row = (0.25 * layout.size.y) as u32;
            let white = |x: u32, y: u32| picture.get_pixel(x, y).0 == [255; 3];
            for (count, at) in [
                (height, &(|i| white(column, i)) as &dyn Fn(u32) -> bool),
                (width, &|i| white(i, row)),
            ] {
                let first = (0..count).find(|&i| at(i)).expect("a frame");
                let end = (first..count).find(|&i| !at(i)).expect("a ring");
                let edges = [first, end].map(f64::from);
                assert_eq!(
                    edges,
                    [FRAME, RING].map(|edge| edge * layout.band),
                    "{width}x{height}, pitch {pitch}"
                );
            }
        }
    }

    #[test]
    fn the_code_tells_panels_apart() {
        let mut others = [(); 3].map(|()| setup());
        others[0].pitch += 1e-6;
        others[1].slant += 1e-6;
        others[2].order = SubpixelOrder::Bgr;
        let code = code(&setup());
        assert!(others.iter().all(|other| self::code(other) != code));
    }

    #[test]
    fn blue_on_the_left_swaps_the_channels_of_the_field() {
        let mut bgr = setup();
        bgr.order = SubpixelOrder::Bgr;
        let (rgb, bgr) = (picture(&setup()), picture(&bgr));
        let ([a, b, c], swapped) = (rgb.get_pixel(400, 300).0, bgr.get_pixel(400, 300).0);
        assert!(a != c);
        assert_eq!(swapped, [c, b, a]);
    }
}
