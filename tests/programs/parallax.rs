//! Checks that the views of a scene differ: a scene that is wrongly the same in all views would pass every comparison.

use crate::programs::row::Cell;
use crate::programs::tally::{ODD, tile};
use image::RgbImage;
use manyview::metric::{OUTLIER_LSB, pixels_over};

/// Fraction of pixels that has to differ between the own view and each outer one. Rounding is excluded: only pixels that are off by more
/// than [`OUTLIER_LSB`] count.
const LEAST: f64 = 0.0005;

/// The cell for pictures of [`ODD`] views each. Every picture has to show a scene with depth.
pub(crate) fn cell(pictures: impl Iterator<Item = RgbImage>) -> Cell {
    let mut shares = Vec::new();
    for picture in pictures {
        let own = tile(&picture, ODD / 2);
        let pixels = f64::from(own.width()) * f64::from(own.height());
        for view in [0, ODD - 1] {
            shares.push(pixels_over(&own, &tile(&picture, view), OUTLIER_LSB) as f64 / pixels);
        }
    }
    let Some(least) = shares.iter().copied().reduce(f64::min) else {
        return Cell::bad("no pictures captured");
    };
    let most = shares.iter().copied().fold(least, f64::max);
    let text = format!("{:.1} to {:.1} %", 100.0 * least, 100.0 * most);
    match least < LEAST {
        true => Cell::bad(format!("{text}: views are the same")),
        false => Cell::good(text),
    }
}

#[test]
fn views_that_do_not_differ_fail() {
    let picture = |shift: u32| {
        RgbImage::from_fn(ODD * 40, 30, |x, y| {
            let (view, x) = (x / 40, x % 40);
            image::Rgb([u8::from(x > 20 + shift * view && y > 9) * 200, 0, 9])
        })
    };
    let failed = |shifts: &[u32]| cell(shifts.iter().map(|&shift| picture(shift))).failed;
    assert!(!failed(&[1, 2]));
    assert!(failed(&[0]) && failed(&[]));
    assert!(failed(&[1, 0]), "in one frame");
    // Only one of the outer views differs.
    let mut half = picture(0);
    image::imageops::replace(
        &mut half,
        &tile(&picture(1), ODD - 1),
        i64::from(40 * (ODD - 1)),
        0,
    );
    assert!(cell([half].into_iter()).failed);
    // A difference as small as rounding.
    let mut rounded = picture(0);
    for pixel in rounded.pixels_mut().take(40 * 3) {
        pixel.0[1] += OUTLIER_LSB;
    }
    assert!(cell([rounded].into_iter()).failed);
}
