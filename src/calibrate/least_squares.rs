//! Least squares by the method of Levenberg and Marquardt, with a soft bound on outliers.
#![forbid(unsafe_code)]

use nalgebra::{DMatrix, DVector};

/// Beyond this many standard deviations a residual grows slower and slower.
const SOFT: f64 = 3.0;
const ROUNDS: usize = 60;

/// Where the sum of squares is least.
#[derive(Clone, Debug)]
pub(crate) struct Minimum {
    pub at: Vec<f64>,
    /// Half of the sum of squares.
    pub cost: f64,
    /// Covariance of the parameters, for residuals of standard deviation 1.
    pub covariance: DMatrix<f64>,
}

/// A residual in standard deviations, softened (pseudo-Huber).
pub(crate) fn soft(residual: f64) -> f64 {
    let ratio = residual / SOFT;
    // The root of 2(√(1+r²) − 1), in a form that keeps small values.
    residual * (2.0 / ((1.0 + ratio * ratio).sqrt() + 1.0)).sqrt()
}

/// Minimises from `start`; parameters are expected to be of the order of `steps`. None when the residuals are not
/// finite or the parameters cannot be told apart.
pub(crate) fn minimise(
    start: &[f64],
    steps: &[f64],
    residuals: impl Fn(&[f64]) -> Option<Vec<f64>>,
) -> Option<Minimum> {
    let at = |p: &[f64]| {
        let values = DVector::from_vec(residuals(p)?);
        let cost = values.norm_squared() / 2.0;
        cost.is_finite().then_some((values, cost))
    };
    let mut here = start.to_vec();
    let (mut values, mut cost) = at(&here)?;
    let mut damping = 1e-4;
    let mut normal = DMatrix::zeros(here.len(), here.len());
    for _ in 0..ROUNDS {
        let mut slopes = DMatrix::zeros(values.len(), here.len());
        for (i, step) in steps.iter().enumerate() {
            let step = step * 1e-5;
            let (mut above, mut below) = (here.clone(), here.clone());
            *above.get_mut(i)? += step;
            *below.get_mut(i)? -= step;
            slopes.set_column(i, &((at(&above)?.0 - at(&below)?.0) / (2.0 * step)));
        }
        normal = slopes.tr_mul(&slopes);
        let gradient = slopes.tr_mul(&values);
        let mut better = None;
        while better.is_none() && damping < 1e8 {
            let mut damped = normal.clone();
            for i in 0..here.len() {
                damped[(i, i)] *= 1.0 + damping;
            }
            let next: Option<Vec<f64>> = damped.cholesky().map(|factor| {
                let step = factor.solve(&gradient);
                here.iter().zip(step.iter()).map(|(p, s)| p - s).collect()
            });
            better = next
                .and_then(|next| at(&next).map(|(values, cost)| (next, values, cost)))
                .filter(|(_, _, new)| *new <= cost);
            damping *= if better.is_some() { 0.1 } else { 10.0 };
        }
        let Some((next, new_values, new_cost)) = better else {
            break;
        };
        let done = cost - new_cost <= 1e-9 * (1.0 + cost);
        (here, values, cost) = (next, new_values, new_cost);
        damping = damping.max(1e-12);
        if done {
            break;
        }
    }
    let covariance = normal.cholesky()?.inverse();
    Some(Minimum {
        at: here,
        cost,
        covariance,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_and_its_covariance() {
        let points = [(0.0, 1.0), (1.0, 3.0), (2.0, 5.0), (3.0, 7.0)];
        let fit = minimise(&[0.0, 0.0], &[1.0, 1.0], |p| {
            Some(points.iter().map(|(x, y)| p[0] + p[1] * x - y).collect())
        });
        let fit = fit.unwrap();
        assert!((fit.at[0] - 1.0).abs() < 1e-6 && (fit.at[1] - 2.0).abs() < 1e-6);
        // Of the slope: 1 / Σ(x − mean)².
        assert!((fit.covariance[(1, 1)] - 0.2).abs() < 1e-6);
    }

    #[test]
    fn an_outlier_pulls_little() {
        let values = [0.0, 0.1, -0.1, 0.05, -0.05, 100.0];
        let fit = minimise(&[10.0], &[1.0], |p| {
            Some(values.iter().map(|v| soft((v - p[0]) / 0.1)).collect())
        });
        assert!(fit.unwrap().at[0].abs() < 0.2);
    }

    #[test]
    fn what_cannot_be_told_apart_is_none() {
        assert!(minimise(&[1.0, 1.0], &[1.0, 1.0], |p| Some(vec![p[0] + p[1]])).is_none());
    }
}
