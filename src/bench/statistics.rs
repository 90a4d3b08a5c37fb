//! Medians and quartiles.

use serde::Serialize;

/// A median with the quartiles around it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Half of the samples are below it.
    pub median: f64,
    /// A quarter of the samples is below it.
    pub low: f64,
    /// A quarter of the samples is above it.
    pub high: f64,
}

impl Spread {
    /// None without samples. Values between two samples are interpolated (Hyndman and Fan's type 7).
    #[must_use]
    pub fn of(samples: &[f64]) -> Option<Self> {
        let mut sorted = samples.to_vec();
        sorted.sort_by(f64::total_cmp);
        Some(Self {
            median: quantile(&sorted, 0.5)?,
            low: quantile(&sorted, 0.25)?,
            high: quantile(&sorted, 0.75)?,
        })
    }
}

/// The median of whole numbers; 0 without any.
#[must_use]
pub fn median(samples: &[u64]) -> f64 {
    let samples: Vec<_> = samples.iter().map(|&sample| sample as f64).collect();
    Spread::of(&samples).map_or(0.0, |spread| spread.median)
}

/// Ratios of pairs of consecutive measurements, so that a slow-down of both cancels.
#[must_use]
pub fn ratios(samples: &[f64], base: &[f64]) -> Vec<f64> {
    samples.iter().zip(base).map(|(a, b)| a / b).collect()
}

fn quantile(sorted: &[f64], q: f64) -> Option<f64> {
    let place = q * sorted.len().checked_sub(1)? as f64;
    let (below, part) = (place.floor() as usize, place.fract());
    let low = *sorted.get(below)?;
    let high = sorted.get(below + 1).copied().unwrap_or(low);
    Some(low + part * (high - low))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_are_interpolated() {
        let spread = Spread::of(&[4.0, 1.0, 3.0, 2.0]).unwrap();
        assert_eq!((spread.low, spread.median, spread.high), (1.75, 2.5, 3.25));
        let one = Spread::of(&[7.0]).unwrap();
        assert_eq!((one.low, one.median, one.high), (7.0, 7.0, 7.0));
        assert_eq!(Spread::of(&[]), None);
    }

    #[test]
    fn pairs_lose_what_slows_both_down() {
        let (slow, base) = ([20.0, 40.0, 60.0], [10.0, 20.0, 30.0]);
        assert_eq!(ratios(&slow, &base), [2.0, 2.0, 2.0]);
        assert_eq!(median(&[3, 1, 9]), 3.0);
        assert_eq!(median(&[]), 0.0);
    }
}
