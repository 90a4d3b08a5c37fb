//! The gate: how far a picture may be from the oracle's.
//!
//! The design says: "≤ 0.03 % of pixels differ, ≤ 1 LSB, ≤ 2 px/Mpx over 8 LSB, no coverage difference". Read as:
//! * at most 0.03 % of all pixels differ at all, rounded down: pictures below 3334 pixels have to be equal;
//! * most differences are of 1 LSB. [`Gate::STRICT`] enforces it and [`Gate::DESIGN`] does not: silhouette pixels differ by
//!   more, and their number depends on the scene;
//! * at most 2 pixels per 10^6, rounded up to a whole pixel, are outliers: they differ by more than 8 LSB, or are the
//!   background in one picture and not in the other. A coverage difference is such a silhouette pixel, so both kinds share
//!   one allowance.
#![forbid(unsafe_code)]

use super::{Comparison, OUTLIER_LSB};

/// Limits; every one is inclusive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gate {
    /// Fraction of pixels that may differ, 0 to 1.
    pub differing: f64,
    /// Pixels per 10^6 that may differ by more than 1 LSB; None: not limited.
    pub over_one_per_million: Option<f64>,
    /// Pixels per 10^6 that may differ by more than 8 LSB or in coverage.
    pub outliers_per_million: f64,
}

/// The first limit that is broken.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GateError {
    /// Too many pixels differ.
    #[error("{found} of {pixels} pixels differ (worst by {worst} LSB), allowed are {allowed}")]
    Differing {
        /// Pixels.
        found: u64,
        /// Pixels.
        allowed: u64,
        /// Pixels of the picture.
        pixels: u64,
        /// LSB.
        worst: u8,
    },
    /// Too many differ by more than rounding.
    #[error(
        "{found} of {pixels} pixels differ by more than 1 LSB (worst {worst}), allowed are {allowed}"
    )]
    OverOne {
        /// Pixels.
        found: u64,
        /// Pixels.
        allowed: u64,
        /// Pixels of the picture.
        pixels: u64,
        /// LSB.
        worst: u8,
    },
    /// Too many are outliers.
    #[error(
        "{found} of {pixels} pixels differ by more than {OUTLIER_LSB} LSB or in coverage \
         ({over_eight} and {coverage}, worst {worst} LSB), allowed are {allowed}"
    )]
    Outliers {
        /// Pixels.
        found: u64,
        /// Of these, by more than 8 LSB.
        over_eight: u64,
        /// Of these, in coverage.
        coverage: u64,
        /// Pixels.
        allowed: u64,
        /// Pixels of the picture.
        pixels: u64,
        /// LSB.
        worst: u8,
    },
}

impl Gate {
    /// For exact strategies.
    pub const DESIGN: Self = Self {
        differing: 3e-4,
        over_one_per_million: None,
        outliers_per_million: 2.0,
    };
    /// The same, with the 1 LSB enforced on all but 2 pixels per 10^6.
    pub const STRICT: Self = Self {
        over_one_per_million: Some(2.0),
        ..Self::DESIGN
    };
    /// Bit-equal.
    pub const EQUAL: Self = Self {
        differing: 0.0,
        over_one_per_million: None,
        outliers_per_million: 0.0,
    };

    /// Checks a comparison.
    ///
    /// # Errors
    /// The first limit that is broken.
    pub fn check(&self, comparison: &Comparison) -> Result<(), GateError> {
        let &Comparison {
            pixels,
            differing,
            over_one,
            over_eight,
            coverage,
            ..
        } = comparison;
        let &Comparison {
            outliers, worst, ..
        } = comparison;
        // The slack is for rounding: 3e-4 of 10,000 is below 3 in floats.
        let allowed = (self.differing * pixels as f64 + 1e-9).floor() as u64;
        if differing > allowed {
            return Err(GateError::Differing {
                found: differing,
                allowed,
                pixels,
                worst,
            });
        }
        let allowance = |per_million: f64| (per_million * pixels as f64 / 1e6).ceil() as u64;
        let allowed = self.over_one_per_million.map_or(u64::MAX, allowance);
        if over_one > allowed {
            return Err(GateError::OverOne {
                found: over_one,
                allowed,
                pixels,
                worst,
            });
        }
        let allowed = allowance(self.outliers_per_million);
        if outliers > allowed {
            let found = outliers;
            return Err(GateError::Outliers {
                found,
                over_eight,
                coverage,
                allowed,
                pixels,
                worst,
            });
        }
        Ok(())
    }
}
