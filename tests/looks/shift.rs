//! How far a part of the picture moves from view to view, found by comparing pixels: the report of the layer is not asked.

use crate::looks::launch::VIEWS;
use image::RgbImage;

/// Largest shift that is looked for, pixels between neighbouring views.
const REACH: u32 = 12;
/// Largest mean difference of the channels where a part is found again, of 255.
const ALIKE: f64 = 24.0;
/// The mean difference of the channels two pixels aside, below which a part has nothing to compare.
const PLAIN: f64 = 0.4;

/// Mean difference of the channels between a rectangle of one view and the one `dx` pixels to the right in another.
fn difference(from: &RgbImage, to: &RgbImage, at: [u32; 4], dx: i64) -> f64 {
    let [left, top, width, height] = at;
    let (mut sum, mut count) = (0u64, 0u64);
    for y in top..(top + height).min(from.height()) {
        for x in left..(left + width).min(from.width()) {
            let other = i64::from(x) + dx;
            if !(0..i64::from(to.width())).contains(&other) {
                continue;
            }
            let (a, b) = (from.get_pixel(x, y).0, to.get_pixel(other as u32, y).0);
            sum += a
                .iter()
                .zip(b)
                .map(|(a, b)| u64::from(a.abs_diff(b)))
                .sum::<u64>();
            count += 3;
        }
    }
    // Most of it has to be in the other view.
    match 2 * count >= 3 * u64::from(width) * u64::from(height) {
        true => sum as f64 / count as f64,
        false => f64::INFINITY,
    }
}

/// The shift of a rectangle of the leftmost view in view `view`, in pixels, to parts of one; positive is to the right.
fn shift(views: &[RgbImage], at: [u32; 4], view: usize) -> Option<f64> {
    let reach = i64::from(REACH) * view as i64;
    let cost = |dx: i64| difference(&views[0], &views[view], at, dx);
    let best = (-reach..=reach).min_by(|a, b| cost(*a).total_cmp(&cost(*b)))?;
    let (before, here, after) = (cost(best - 1), cost(best), cost(best + 1));
    if here > ALIKE {
        return None;
    }
    let bend = before - 2.0 * here + after;
    // A parabola through three points; where they are on a line the middle one is taken.
    let part = match bend.is_finite() && bend > 0.0 {
        true => (before - after) / (2.0 * bend),
        false => 0.0,
    };
    Some(best as f64 + part)
}

/// The shift in each view. None where the part has nothing that could be compared, or is not found again.
pub(crate) fn shifts(views: &[RgbImage], at: [u32; 4]) -> Option<Vec<f64>> {
    let plain = [-2, 2].map(|dx| difference(&views[0], &views[0], at, dx));
    if plain.iter().any(|&difference| difference < PLAIN) {
        return None;
    }
    (0..VIEWS as usize)
        .map(|view| shift(views, at, view))
        .collect()
}

#[test]
fn a_shift_is_found_to_a_part_of_a_pixel() {
    let view = |shift: f64| {
        RgbImage::from_fn(200, 60, |x, y| {
            // Waves of lengths that no shift brings together again.
            let at = f64::from(x) - shift + 0.3 * f64::from(y);
            let wave = ((0.31 * at).sin() + (0.173 * at).sin() + (0.0617 * at).sin()) / 3.0;
            image::Rgb([(127.0 + 100.0 * wave) as u8, 9, (90.0 - 80.0 * wave) as u8])
        })
    };
    let views: Vec<_> = (0..VIEWS).map(|v| view(0.75 * f64::from(v))).collect();
    let found = shifts(&views, [60, 10, 40, 30]).expect("a pattern");
    for (view, found) in found.iter().enumerate() {
        assert!((found - 0.75 * view as f64).abs() < 0.2, "{view}: {found}");
    }
    let plain = vec![RgbImage::new(200, 60); VIEWS as usize];
    assert_eq!(shifts(&plain, [60, 10, 40, 30]), None);
}
