//! Measurements of pictures. They do not depend on how the pictures were drawn.

use crate::display::{Display, Kind, MaskError, Number, Placement, Slanted};
use image::{Rgb, RgbImage};
use std::collections::BTreeMap;

/// A marker of a scene and where it is in the program's own picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marker {
    /// The colour of all its pixels and of no other.
    pub colour: [u8; 3],
    /// Pixel column of its centre.
    pub x: f64,
    /// Eye-space distance, may be infinite.
    pub depth: f64,
}

/// The markers that a scene has printed: `lens A` and `marker RRGGBB X DEPTH` lines.
#[must_use]
pub fn markers(text: &str) -> (f64, Vec<Marker>) {
    let mut lens = 0.0;
    let mut markers = Vec::new();
    for line in text.lines() {
        let words: Vec<_> = line.split(' ').collect();
        match words[..] {
            ["lens", a] => lens = a.parse().unwrap_or(0.0),
            ["marker", colour, x, depth] => markers.extend(marker(colour, x, depth)),
            _ => {}
        }
    }
    (lens, markers)
}

fn marker(colour: &str, x: &str, depth: &str) -> Option<Marker> {
    let rgb = u32::from_str_radix(colour, 16).ok()?.to_be_bytes();
    Some(Marker {
        colour: [rgb[1], rgb[2], rgb[3]],
        x: x.parse().ok()?,
        depth: depth.parse().ok()?,
    })
}

/// The largest distance of a marker from its place in the picture of a camera that is moved by `eye` along its x axis and sheared about
/// `focal`, pixels; infinite if a marker is not found.
#[must_use]
pub fn place(
    picture: &RgbImage,
    (lens, markers): &(f64, Vec<Marker>),
    eye: f64,
    focal: f64,
) -> f64 {
    let half = f64::from(picture.width()) / 2.0;
    let worst = markers.iter().map(|marker| {
        let shift = lens * eye * (1.0 / focal - 1.0 / marker.depth) * half;
        centre(picture, marker.colour)
            .map_or(f64::INFINITY, |found| (found - marker.x - shift).abs())
    });
    // Without any marker the measurement fails.
    worst.reduce(f64::max).unwrap_or(f64::INFINITY)
}

/// Mean column of the pixels of a colour; a pixel's position is its centre.
fn centre(picture: &RgbImage, colour: [u8; 3]) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0.0);
    for (x, _, pixel) in picture.enumerate_pixels() {
        if pixel.0 == colour {
            sum += f64::from(x) + 0.5;
            count += 1.0;
        }
    }
    (count > 0.0).then(|| sum / count)
}

fn steps(a: &Rgb<u8>, b: &Rgb<u8>) -> u8 {
    let each = a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b));
    each.max().unwrap_or(0)
}

fn pairs<'a>(a: &'a RgbImage, b: &'a RgbImage) -> impl Iterator<Item = (&'a Rgb<u8>, &'a Rgb<u8>)> {
    a.pixels().zip(b.pixels())
}

/// Pixels that are not equal, %.
#[must_use]
pub fn differing(expected: &RgbImage, actual: &RgbImage) -> f64 {
    if expected.dimensions() != actual.dimensions() {
        return 100.0;
    }
    let count = pairs(expected, actual).filter(|(a, b)| a != b).count();
    100.0 * count as f64 / expected.pixels().len() as f64
}

/// For each pixel the least difference from the expected ones within one pixel, steps.
fn from_nearest<'a>(expected: &'a RgbImage, actual: &'a RgbImage) -> impl Iterator<Item = u8> + 'a {
    let (width, height) = expected.dimensions();
    actual.enumerate_pixels().map(move |(x, y, pixel)| {
        let rows = y.saturating_sub(1)..(y + 2).min(height);
        let around = rows.flat_map(|row| {
            let columns = x.saturating_sub(1)..(x + 2).min(width);
            columns.map(move |column| (column, row))
        });
        let off = around.map(|(column, row)| steps(pixel, expected.get_pixel(column, row)));
        off.min().unwrap_or(u8::MAX)
    })
}

/// The largest difference from every expected pixel within one pixel, steps.
#[must_use]
pub fn worst_step(expected: &RgbImage, actual: &RgbImage) -> f64 {
    if expected.dimensions() != actual.dimensions() {
        return 255.0;
    }
    from_nearest(expected, actual).max().map_or(0.0, f64::from)
}

/// Pixels that are more than 8 steps from every expected pixel within one pixel, and the other way round: excess pixels,
/// and missing ones.
#[must_use]
pub fn foreign(expected: &RgbImage, actual: &RgbImage) -> f64 {
    if expected.dimensions() != actual.dimensions() {
        return f64::INFINITY;
    }
    let count = |a, b| from_nearest(a, b).filter(|&off| off > 8).count();
    (count(expected, actual) + count(actual, expected)) as f64
}

/// Pixels of a colour.
#[must_use]
pub fn area(picture: &RgbImage, colour: [u8; 3]) -> f64 {
    picture.pixels().filter(|pixel| pixel.0 == colour).count() as f64
}

/// The difference between a colour's share of the picture and the expected share, %.
#[must_use]
pub fn area_error(expected: &RgbImage, actual: &RgbImage, colour: [u8; 3]) -> f64 {
    let share = |picture: &RgbImage| area(picture, colour) / picture.pixels().len() as f64;
    100.0 * (share(actual) / share(expected) - 1.0).abs()
}

/// How far the edges of areas of one colour have moved: the surplus or deficit of the colour's pixels over the rows that have it, for the
/// worst colour. An area has to cross several rows.
#[must_use]
pub fn edge(expected: &RgbImage, actual: &RgbImage) -> f64 {
    if expected.dimensions() != actual.dimensions() {
        return f64::INFINITY;
    }
    let mut colours = BTreeMap::<[u8; 3], (f64, f64)>::new();
    for (expected, actual) in expected.rows().zip(actual.rows()) {
        let mut row = BTreeMap::<[u8; 3], f64>::new();
        expected.for_each(|pixel| *row.entry(pixel.0).or_default() -= 1.0);
        actual.for_each(|pixel| *row.entry(pixel.0).or_default() += 1.0);
        for (colour, difference) in row {
            let (sum, rows) = colours.entry(colour).or_default();
            *sum += difference.abs();
            *rows += 1.0;
        }
    }
    colours
        .values()
        .map(|(sum, rows)| sum / rows)
        .fold(0.0, f64::max)
}

/// Grey of one level of detail.
const LEVEL: f64 = 24.0;

/// How far the level of detail is from the expected one at the same place of the window; the picture may have fewer pixels. Only smooth
/// regions count: there is no level at edges, and tiles of lenses have one column more than the window shows.
#[must_use]
pub fn level(expected: &RgbImage, actual: &RgbImage) -> f64 {
    let (width, height) = expected.dimensions();
    let scale = |at: u32, from: u32, to: u32| {
        ((f64::from(at) + 0.5) / f64::from(from) * f64::from(to)) as u32
    };
    let mut worst = f64::INFINITY;
    for (x, y, pixel) in actual.enumerate_pixels() {
        let x = scale(x, actual.width(), width).min(width - 1);
        let y = scale(y, actual.height(), height).min(height - 1);
        let rows = y.saturating_sub(2)..(y + 3).min(height);
        let near: Vec<_> = rows.map(|row| *expected.get_pixel(x, row)).collect();
        let grey = |pixel: &Rgb<u8>| pixel.0[0] == pixel.0[1] && pixel.0[1] == pixel.0[2];
        let low = near.iter().map(|pixel| pixel.0[0]).min().unwrap_or(0);
        let high = near.iter().map(|pixel| pixel.0[0]).max().unwrap_or(0);
        if !near.iter().all(grey) || !grey(pixel) || f64::from(high - low) > LEVEL / 4.0 {
            continue;
        }
        let off = f64::from(steps(pixel, expected.get_pixel(x, y))) / LEVEL;
        worst = if worst.is_finite() {
            worst.max(off)
        } else {
            off
        };
    }
    worst
}

/// Lines that are not the same in both texts.
#[must_use]
pub fn answers(expected: &str, actual: &str) -> f64 {
    let (expected, actual): (Vec<_>, Vec<_>) =
        (expected.lines().collect(), actual.lines().collect());
    let common = expected.iter().zip(&actual).filter(|(a, b)| a == b).count();
    (expected.len().max(actual.len()) - common) as f64
}

/// Columns and rows of the lower right corner of a panel of 7680 x 4320 pixels.
const CORNER: u32 = 240;

/// Wrong subpixels of a slanted sheet's mask in the farthest corner of an 8K panel, %. Its lenses lean by a third of a subpixel a row and are
/// 3 subpixels wide: with 9 views every phase is a boundary between two of them, where the smallest error takes the other one.
///
/// # Errors
/// If the panel has no mask.
pub fn mask() -> Result<f64, MaskError> {
    let sheet = Slanted {
        pitch: Number::whole(3),
        slant: Number::Exact {
            numerator: 1,
            denominator: 3,
        },
        offset: Number::whole(0),
        ..Slanted::HUEBNER
    };
    let panel = Display::new("8K", 9, Kind::Slanted(sheet));
    let placement = Placement {
        screen_width: 7680,
        screen_height: 4320,
        x: (7680 - CORNER) as i32,
        y: (4320 - CORNER) as i32,
        width: CORNER,
        height: CORNER,
    };
    let mask = panel.mask(&placement, 9)?;
    let mut wrong = 0;
    for (row, y) in mask.rows().zip(4320 - CORNER..) {
        for (pixel, x) in row.iter().zip(7680 - CORNER..) {
            for (view, channel) in pixel.iter().zip(0..) {
                wrong += u32::from(u32::from(*view) != (3 * (3 * x + channel) + y) % 9);
            }
        }
    }
    Ok(100.0 * f64::from(wrong) / f64::from(3 * CORNER * CORNER))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A leaning bar as the scenes draw it, sampled at the middles of pixels.
    fn bar(x: f64) -> RgbImage {
        RgbImage::from_fn(256, 192, |column, row| {
            let up = f64::from(row) + 0.5 - 21.0;
            let left = x - 8.0 + 10.0 * (up / 149.0 - 0.5);
            let inside = (left..left + 16.0).contains(&(f64::from(column) + 0.5));
            Rgb([
                if inside && (0.0..149.0).contains(&up) {
                    255
                } else {
                    0
                },
                0,
                0,
            ])
        })
    }

    #[test]
    fn markers_are_found_to_a_hundredth_of_a_pixel() {
        let told = markers("lens 1.25\nsomething else\nmarker ff0000 100 16\n");
        for tenth in 0..40 {
            let eye = 0.013 * f64::from(tenth);
            let x = 100.0 + 1.25 * eye * (1.0 / 8.0 - 1.0 / 16.0) * 128.0;
            assert!(place(&bar(x), &told, eye, 8.0) < 0.005, "{eye}");
            let off = place(&bar(x + 0.02), &told, eye, 8.0);
            assert!((0.01..0.03).contains(&off), "{off}");
        }
        assert_eq!(
            place(&RgbImage::new(256, 192), &told, 0.0, 8.0),
            f64::INFINITY
        );
        assert_eq!(place(&bar(100.0), &markers(""), 0.0, 8.0), f64::INFINITY);
    }

    #[test]
    fn an_edge_may_be_rounded_and_a_pixel_may_not_be_elsewhere() {
        let (one, moved) = (bar(100.0), bar(100.9));
        assert!(differing(&one, &moved) > 0.1);
        assert_eq!(
            (foreign(&one, &moved), worst_step(&one, &moved)),
            (0.0, 0.0)
        );
        assert_eq!(edge(&one, &one), 0.0);
        let mut leak = one.clone();
        leak.put_pixel(3, 3, Rgb([0, 200, 0]));
        assert_eq!(
            (foreign(&one, &leak), worst_step(&one, &leak)),
            (1.0, 200.0)
        );
        // What is missing is found as well.
        assert_eq!(foreign(&leak, &one), 1.0);
        assert!(foreign(&one, &bar(103.0)) > 100.0);
    }

    #[test]
    fn areas_levels_and_answers_are_compared() {
        let grey = |level: f64| RgbImage::from_pixel(20, 20, Rgb([(level * LEVEL) as u8; 3]));
        assert_eq!(level(&grey(3.0), &grey(3.0)), 0.0);
        assert!((level(&grey(3.0), &grey(4.0)) - 1.0).abs() < 1e-9);
        assert!((area_error(&bar(100.0), &bar(50.0), [255, 0, 0])) < 1e-9);
        assert_eq!(answers("a\nb\nc", "a\nx\nc"), 1.0);
        assert_eq!(answers("a\nb", "a"), 1.0);
    }

    #[test]
    fn masks_are_exact_in_the_last_corner() {
        assert_eq!(mask().expect("a mask"), 0.0);
    }
}
