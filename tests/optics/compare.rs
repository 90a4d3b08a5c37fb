//! Compares a mask with the truth.

use super::eye::Truth;

/// How far a mask is from the truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Number of subpixels that were compared.
    pub subpixels: usize,
    /// Share of them whose view is off by more than the tolerance.
    pub wrong: f64,
    /// The constant in views that, taken from the mask, leaves the fewest wrong ones.
    pub offset: f64,
    /// Share that is still off by more than the tolerance after that.
    pub wrong_after_offset: f64,
}

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Every so many columns and rows are compared. Odd numbers that do not divide the lattice are best.
    pub stride: [usize; 2],
    /// Permitted difference in views. Half a view suits continuous masks. Masks of whole views, compared at the middle of each view,
    /// are off by half a view already where they are perfect.
    pub tolerance: f64,
}

impl Default for Sampling {
    fn default() -> Self {
        Self {
            stride: [7, 5],
            tolerance: 0.5,
        }
    }
}

/// Compares the views that a mask gives (column, row, colour) with the truth, modulo the number of views.
pub fn compare(
    truth: &Truth,
    mask: impl Fn(usize, usize, usize) -> f64,
    sampling: Sampling,
) -> Comparison {
    let (views, panel) = (f64::from(truth.display.views), &truth.display.panel);
    let mut misses = Vec::new();
    for row in (0..panel.rows).step_by(sampling.stride[1].max(1)) {
        for column in (0..panel.columns).step_by(sampling.stride[0].max(1)) {
            for colour in 0..3 {
                misses.push(wrap(
                    mask(column, row, colour) - truth.view_of(column, row, colour),
                    views,
                ));
            }
        }
    }
    // A miss that is not a number is wrong.
    let wrong = |offset: f64| {
        let good = misses
            .iter()
            .filter(|&&miss| wrap(miss - offset, views).abs() <= sampling.tolerance)
            .count();
        1.0 - good as f64 / misses.len().max(1) as f64
    };
    let offset = best_offset(&misses, views, sampling.tolerance);
    Comparison {
        subpixels: misses.len(),
        wrong: wrong(0.0),
        offset,
        wrong_after_offset: wrong(offset),
    }
}

/// The nearest equal number modulo `period`, from minus half of it to half of it.
fn wrap(value: f64, period: f64) -> f64 {
    value - (value / period).round() * period
}

/// Middle of the window of twice the tolerance that holds the most misses; of equal ones, that nearest to their mean direction.
fn best_offset(misses: &[f64], views: f64, tolerance: f64) -> f64 {
    const BINS_A_VIEW: f64 = 64.0;
    let bins = (views * BINS_A_VIEW).round() as usize;
    let mut counts = vec![0usize; bins];
    let (mut sin, mut cos) = (0.0, 0.0);
    for miss in misses.iter().filter(|miss| miss.is_finite()) {
        counts[(miss * BINS_A_VIEW).round().rem_euclid(bins as f64) as usize % bins] += 1;
        let (s, c) = (miss / views * std::f64::consts::TAU).sin_cos();
        (sin, cos) = (sin + s, cos + c);
    }
    let mean = sin.atan2(cos) / std::f64::consts::TAU * views;
    let half = (tolerance * BINS_A_VIEW).floor() as usize;
    if 2 * half + 1 >= bins {
        return mean;
    }
    let inside = |middle: usize| {
        (0..=2 * half)
            .map(|i| counts[(middle + bins + i - half) % bins])
            .sum::<usize>()
    };
    let offset = |middle: usize| wrap(middle as f64 / BINS_A_VIEW, views);
    let best = (0..bins).max_by(|&a, &b| {
        let distance = |middle: usize| wrap(offset(middle) - mean, views).abs();
        inside(a)
            .cmp(&inside(b))
            .then(distance(b).total_cmp(&distance(a)))
    });
    best.map_or(mean, offset)
}

/// How well a constant pitch, slant and offset can describe the truth.
///
/// Refraction and oblique sight bend the true phases, so even the best flat mask can be off near the corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatLimit {
    /// Greatest miss of the best plane in views.
    pub worst: f64,
    /// Share of the panel where the best plane is off by more than half a view.
    pub wrong: f64,
}

/// The plane of least squares through the phases of a grid of 41 by 41 points over the panel.
pub fn flat_limit(truth: &Truth) -> FlatLimit {
    const SIDE: i32 = 20;
    let (half, sheet) = (truth.display.panel.half(), &truth.display.sheet);
    let views = f64::from(truth.display.views);
    let mut points = Vec::new();
    for (x, y) in (-SIDE..=SIDE).flat_map(|y| (-SIDE..=SIDE).map(move |x| (x, y))) {
        let place = [
            f64::from(x) / f64::from(SIDE),
            f64::from(y) / f64::from(SIDE),
        ];
        let phase = sheet.phase(truth.eye, [place[0] * half[0], place[1] * half[1]]);
        points.push((place, phase.map_or(f64::NAN, |phase| phase * views)));
    }
    // The grid is symmetric, so the constant and the two slopes do not depend on each other.
    let count = points.len() as f64;
    let mean = points.iter().map(|(_, view)| view).sum::<f64>() / count;
    let slope: [f64; 2] = std::array::from_fn(|axis| {
        let product: f64 = points.iter().map(|(place, view)| place[axis] * view).sum();
        product
            / points
                .iter()
                .map(|(place, _)| place[axis] * place[axis])
                .sum::<f64>()
    });
    let miss = |(place, view): &([f64; 2], f64)| {
        (view - mean - slope[0] * place[0] - slope[1] * place[1]).abs()
    };
    FlatLimit {
        worst: points.iter().map(miss).fold(0.0, f64::max),
        wrong: points.iter().filter(|point| miss(point) > 0.5).count() as f64 / count,
    }
}

#[cfg(test)]
mod tests {
    use super::super::displays;
    use super::*;

    const SOME: Sampling = Sampling {
        stride: [13, 7],
        tolerance: 0.5,
    };

    #[test]
    fn a_perfect_mask_and_a_shifted_one() {
        let display = displays::small();
        let truth = Truth::new(&display);
        let perfect = compare(&truth, |x, y, c| truth.view_of(x, y, c), SOME);
        assert_eq!((perfect.wrong, perfect.wrong_after_offset), (0.0, 0.0));
        assert!(perfect.offset.abs() < 0.02);
        let shifted = compare(&truth, |x, y, c| truth.view_of(x, y, c) - 1.4, SOME);
        assert_eq!((shifted.wrong, shifted.wrong_after_offset), (1.0, 0.0));
        assert!((shifted.offset + 1.4).abs() < 0.02);
    }

    /// A pitch that is off by 1 % drifts by many periods over the panel: 1 view of 8 is within half a view by chance.
    #[test]
    fn a_wrong_pitch_is_seven_eighths_wrong() {
        let display = displays::small();
        let mut other = display.clone();
        other.sheet.pitch *= 1.01;
        let (truth, wrong) = (Truth::new(&display), Truth::new(&other));
        let result = compare(&truth, |x, y, c| wrong.view_of(x, y, c), SOME);
        assert!(
            (result.wrong_after_offset - 0.875).abs() < 0.12,
            "{result:?}"
        );
    }

    /// A sheet close to the pixels bends the phases little, a thick one before a near eye much.
    #[test]
    fn thick_sheets_are_less_flat() {
        let mut display = displays::small();
        display.sheet.thickness = 0.5;
        let thin = flat_limit(&Truth::new(&display));
        assert!(thin.worst < 0.1 && thin.wrong == 0.0, "{thin:?}");
        display.sheet.thickness = 6.0;
        display.distance = 100.0;
        let thick = flat_limit(&Truth::new(&display));
        assert!(thick.worst > 1.0 && thick.wrong > 0.1, "{thick:?}");
    }
}
