//! Homographies from pairs of places.
#![forbid(unsafe_code)]

use crate::display::Homography;
use nalgebra::{DMatrix, DVector, Matrix3};

/// The homography that takes the first place of each pair to the second one, by least squares over its eight numbers (direct linear transform, Hartley and
/// Zisserman, section 4.1, in normalised coordinates). None of fewer than four pairs, or where they lie on a line.
pub(super) fn from_pairs(pairs: &[([f64; 2], [f64; 2])]) -> Option<Homography> {
    let (from, to) = (
        normal(pairs.iter().map(|pair| pair.0))?,
        normal(pairs.iter().map(|pair| pair.1))?,
    );
    let mut a = DMatrix::zeros(2 * pairs.len(), 8);
    let mut b = DVector::zeros(2 * pairs.len());
    for (i, (p, q)) in pairs.iter().enumerate() {
        let ([x, y], [u, v]) = (place(&from, *p), place(&to, *q));
        let rows = [
            [x, y, 1.0, 0.0, 0.0, 0.0, -u * x, -u * y],
            [0.0, 0.0, 0.0, x, y, 1.0, -v * x, -v * y],
        ];
        for (half, row) in rows.iter().enumerate() {
            for (column, value) in row.iter().enumerate() {
                a[(2 * i + half, column)] = *value;
            }
        }
        (b[2 * i], b[2 * i + 1]) = (u, v);
    }
    let h = a.svd(true, true).solve(&b, 1e-10).ok()?;
    let h = Matrix3::new(h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1.0);
    let h = to.try_inverse()? * h * from;
    Some(of(&(h / h[(2, 2)])))
}

/// A shift and a scale to a mean of 0 and a distance of about 1.
fn normal(places: impl Iterator<Item = [f64; 2]> + Clone) -> Option<Matrix3<f64>> {
    let count = places.clone().count();
    if count < 4 {
        return None;
    }
    let n = count as f64;
    let mean = places
        .clone()
        .fold([0.0; 2], |sum, p| [sum[0] + p[0] / n, sum[1] + p[1] / n]);
    let far = places
        .map(|p| (p[0] - mean[0]).hypot(p[1] - mean[1]))
        .sum::<f64>()
        / n;
    if far <= 0.0 {
        return None;
    }
    let s = 1.0 / far;
    Some(Matrix3::new(
        s,
        0.0,
        -s * mean[0],
        0.0,
        s,
        -s * mean[1],
        0.0,
        0.0,
        1.0,
    ))
}

fn place(h: &Matrix3<f64>, [x, y]: [f64; 2]) -> [f64; 2] {
    crate::display::apply(&of(h), [x, y])
}

/// As rows.
pub(super) fn of(h: &Matrix3<f64>) -> Homography {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| h[(row, column)]))
}

/// As a matrix.
pub(super) fn matrix(h: &Homography) -> Matrix3<f64> {
    Matrix3::from_fn(|row, column| h[row][column])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::display::apply;

    #[test]
    fn a_homography_is_found_again() {
        let h = [[1.2, 0.1, 30.0], [-0.05, 0.9, 12.0], [0.0001, -0.0002, 1.0]];
        let places = (0..20).map(|i| [f64::from(i * 37 % 101), f64::from(i * 53 % 97)]);
        let pairs: Vec<_> = places.map(|p| (p, apply(&h, p))).collect();
        let found = from_pairs(&pairs).unwrap();
        for (p, q) in &pairs {
            let [x, y] = apply(&found, *p);
            assert!((x - q[0]).hypot(y - q[1]) < 1e-8);
        }
        assert_eq!(from_pairs(&pairs[..3]), None);
    }
}
