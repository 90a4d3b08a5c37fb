//! Colours that depend on the direction, as sums of spherical harmonics up to degree 3.

use glam::Vec3;

const C0: f32 = 0.282_094_79;
const C1: f32 = 0.488_602_51;
const C2: [f32; 5] = [
    1.092_548_4,
    -1.092_548_4,
    0.315_391_57,
    -1.092_548_4,
    0.546_274_2,
];
const C3: [f32; 7] = [
    -0.590_043_6,
    2.890_611_4,
    -0.457_045_8,
    0.373_176_33,
    -0.457_045_8,
    1.445_305_7,
    -0.590_043_6,
];

/// The colour that is seen along a direction of length 1, from the viewer to the Gaussian; 0 and above. The coefficients are those of the basis in the order of
/// the files.
#[must_use]
pub fn colour(coefficients: &[Vec3], direction: Vec3) -> Vec3 {
    let (x, y, z) = (direction.x, direction.y, direction.z);
    let (xx, yy, zz) = (x * x, y * y, z * z);
    let basis = [
        C0,
        -C1 * y,
        C1 * z,
        -C1 * x,
        C2[0] * x * y,
        C2[1] * y * z,
        C2[2] * (2.0 * zz - xx - yy),
        C2[3] * x * z,
        C2[4] * (xx - yy),
        C3[0] * y * (3.0 * xx - yy),
        C3[1] * x * y * z,
        C3[2] * y * (4.0 * zz - xx - yy),
        C3[3] * z * (2.0 * zz - 3.0 * xx - 3.0 * yy),
        C3[4] * x * (4.0 * zz - xx - yy),
        C3[5] * z * (xx - yy),
        C3[6] * x * (xx - 3.0 * yy),
    ];
    let sum: Vec3 = coefficients.iter().zip(basis).map(|(c, b)| *c * b).sum();
    (sum + 0.5).max(Vec3::ZERO)
}

/// The coefficient of a colour that is the same from everywhere.
#[must_use]
pub fn constant(colour: Vec3) -> Vec3 {
    (colour - 0.5) / C0
}

#[cfg(test)]
mod tests {
    use super::{colour, constant};
    use glam::Vec3;

    /// The basis is orthonormal over the sphere: sums over a grid of directions tell.
    #[test]
    fn the_basis_is_orthonormal() {
        let basis = |number: usize, direction| {
            let mut coefficients = [Vec3::ZERO; 16];
            // Large enough that nothing is clamped: the sum is 0.5 + 0.1·b.
            coefficients[number] = Vec3::splat(0.1);
            (colour(&coefficients, direction).x - 0.5) * 10.0
        };
        let rings = 60;
        let mut directions = Vec::new();
        for ring in 0..rings {
            let z = 1.0 - (2.0 * ring as f32 + 1.0) / rings as f32;
            for step in 0..60 {
                let (sine, cosine) = (step as f32 * std::f32::consts::TAU / 60.0).sin_cos();
                directions.push(Vec3::new(
                    (1.0 - z * z).sqrt() * cosine,
                    (1.0 - z * z).sqrt() * sine,
                    z,
                ));
            }
        }
        let area = 4.0 * std::f32::consts::PI / directions.len() as f32;
        for a in 0..16 {
            for b in 0..=a {
                let product: f32 = directions.iter().map(|&d| basis(a, d) * basis(b, d)).sum();
                let want = if a == b { 1.0 } else { 0.0 };
                assert!(
                    (product * area - want).abs() < 0.01,
                    "{a} {b}: {}",
                    product * area
                );
            }
        }
    }

    #[test]
    fn a_constant_colour_is_the_same_from_everywhere() {
        let want = Vec3::new(0.2, 0.7, 0.4);
        let seen = colour(&[constant(want)], Vec3::new(0.6, 0.0, 0.8));
        assert!((seen - want).length() < 1e-6);
    }
}
