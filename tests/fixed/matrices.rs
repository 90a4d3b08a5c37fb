//! Random cameras for the cases.

use super::random::Random;

/// Column-major 4×4.
pub(crate) type Matrix = [f64; 16];

pub(crate) const IDENTITY: Matrix = [
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
];

pub(crate) fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| (0..4).map(|k| a[4 * k + i % 4] * b[4 * (i / 4) + k]).sum())
}

/// Rotation about one axis (0 to 2), radians.
pub(crate) fn turn(axis: usize, angle: f64) -> Matrix {
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut m = IDENTITY;
    m[4 * a + a] = angle.cos();
    m[4 * b + b] = angle.cos();
    m[4 * a + b] = angle.sin();
    m[4 * b + a] = -angle.sin();
    m
}

/// A projection and a modelview matrix under which the mesh of `ffcheck` is seen.
pub(crate) fn matrices(random: &mut Random) -> (Matrix, Matrix) {
    let (left, right) = (random.float(-0.7, -0.4), random.float(0.4, 0.7));
    let (near, far) = (1.0, 20.0);
    let mut p = [0.0; 16];
    p[0] = 2.0 * near / (right - left);
    p[5] = 2.0 * near / 1.1;
    p[8] = (right + left) / (right - left);
    p[10] = -(far + near) / (far - near);
    p[11] = -1.0;
    p[14] = -2.0 * far * near / (far - near);
    if random.chance(15) {
        // Orthographic.
        p = IDENTITY;
        (p[0], p[5], p[10]) = (0.5, 0.5, -0.2);
        p[14] = -1.1;
    }
    let mut m = IDENTITY;
    m[12] = random.float(-0.5, 0.5);
    m[13] = random.float(-0.5, 0.5);
    m[14] = random.float(-4.5, -2.5);
    for axis in 0..3 {
        m = multiply(&m, &turn(axis, random.float(-3.0, 3.0)));
    }
    let mut scale = IDENTITY;
    let all = if random.chance(50) {
        1.0
    } else {
        random.float(0.7, 1.5)
    };
    let uneven = if random.chance(25) {
        random.float(0.7, 1.4)
    } else {
        1.0
    };
    let mirrored = if random.chance(30) { -1.0 } else { 1.0 };
    (scale[0], scale[5], scale[10]) = (all * mirrored, all * uneven, all);
    (p, multiply(&m, &scale))
}
