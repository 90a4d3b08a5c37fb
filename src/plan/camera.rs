//! The camera in a matrix that a program's own shaders multiply positions by.

use super::{Pose, Shear};
use glam::{DMat4, DVec4};

/// A pure projection (column-major) with the focal lengths and the near and far distances of `m`. `m` is a projection, or a projection
/// times a view or model-view matrix. The scale of the matrix's own space does not matter, since distances are measured as clip-space w.
/// None where `m` has no perspective, or no near distance.
///
/// A is the part of row 0 at a right angle to row 3, per unit of row 3; row 1 gives the same for the other axis. Near and far are the w at
/// which z is −w and w, along the direction in which w grows. Reversed depths swap the two; infinite ones have no far distance.
pub fn equivalent(m: &[f32; 16]) -> Option<[f32; 16]> {
    let row = |r: usize| {
        let at = |column: usize| m.get(4 * column + r).copied().map_or(0.0, f64::from);
        DVec4::new(at(0), at(1), at(2), at(3))
    };
    let (row0, row1, row2, row3) = (row(0), row(1), row(2), row(3));
    let direction = row3.truncate();
    let scale = direction.length();
    // A w that is a constant but for rounding has no perspective.
    let size = row0.truncate().length().max(row1.truncate().length());
    if !m.iter().all(|v| v.is_finite()) || scale <= 1e-6 * size || size == 0.0 {
        return None;
    }
    let [a, b] = [row0, row1].map(|r| r.truncate().reject_from(direction).length() / scale);
    let along = row2.truncate().dot(direction / scale);
    // t along the direction: w = scale·t + row3.w, z = along·t + row2.w.
    let w_where = |sign: f64| {
        let slope = along - sign * scale;
        let t = (sign * row3.w - row2.w) / slope;
        let w = scale * t + row3.w;
        // Single precision cannot tell such a w from infinity.
        if slope.abs() <= 1e-6 * scale || w.abs() > 1e9 {
            f64::INFINITY
        } else {
            w
        }
    };
    let ends = [w_where(-1.0), w_where(1.0)];
    let positive = || ends.into_iter().filter(|w| *w > 0.0);
    let near = positive().fold(f64::INFINITY, f64::min);
    let far = positive().fold(0.0, f64::max);
    if !near.is_finite() || a <= 0.0 || !a.is_finite() {
        return None;
    }
    let (c, d) = if far.is_finite() && far > near {
        (
            -(far + near) / (far - near),
            -2.0 * far * near / (far - near),
        )
    } else {
        (-1.0, -2.0 * near)
    };
    let mut p = [0.0f32; 16];
    for (at, value) in [(0, a), (5, b), (10, c), (11, -1.0), (14, d)] {
        if let Some(p) = p.get_mut(at) {
            *p = value as f32;
        }
    }
    Some(p)
}

/// The camera among a program's matrices: the index of its matrix, and the projection that [`equivalent`] makes of it. Some of the
/// matrices may belong to light sources. So a matrix with the `aspect` of the window (width over height) goes first, then a projection
/// alone, then the first matrix with a perspective.
pub fn among(matrices: &[[f32; 16]], aspect: f64) -> Option<(usize, [f32; 16])> {
    let all = matrices.iter().enumerate();
    let cameras = all.filter_map(|(at, m)| {
        let camera = equivalent(m).filter(|_| !unprojects(m, aspect))?;
        let rank = (!fits(&camera, aspect), !is_projection(m), at);
        Some((rank, (at, camera)))
    });
    cameras
        .min_by_key(|(rank, _)| *rank)
        .map(|(_, found)| found)
}

/// How a matrix lies in four vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lying {
    /// Each is a row: a position is multiplied by four dot products, as Direct3D's `m4x4` does.
    Rows,
    /// Each is a column.
    Columns,
}

impl Lying {
    /// Both, in the order in which they are tried.
    pub const ALL: [Lying; 2] = [Lying::Rows, Lying::Columns];

    /// The matrix, column-major.
    pub fn matrix(self, vectors: [[f32; 4]; 4]) -> [f32; 16] {
        let columns = glam::Mat4::from_cols_array_2d(&vectors);
        match self {
            Lying::Rows => columns.transpose().to_cols_array(),
            Lying::Columns => columns.to_cols_array(),
        }
    }
}

/// The camera among vectors that follow each other, such as the constants of Direct3D: where its four vectors begin, how they lie, and the projection that
/// [`equivalent`] makes of it. What four vectors of other things make up is no camera for the `aspect` of the window (width over height), or its depths do not go with
/// its w.
pub fn among_vectors(vectors: &[[f32; 4]], aspect: f64) -> Option<(usize, Lying, [f32; 16])> {
    let windows = vectors.windows(4).enumerate();
    let mut all = windows.flat_map(|(at, four)| Lying::ALL.map(|lying| (at, lying, four)));
    all.find_map(|(at, lying, four)| {
        let m = lying.matrix(four.try_into().ok()?);
        let camera = equivalent(&m).filter(|camera| fits(camera, aspect))?;
        sees_along_w(&m).then_some((at, lying, camera))
    })
}

/// Whether z and w of a matrix grow along the same direction and, across it, x and y at right angles to each other, as those of every camera do whose model has one scale
/// for all axes.
fn sees_along_w(m: &[f32; 16]) -> bool {
    let rows = matrix(m).transpose();
    let [x, y, z, w] = [rows.x_axis, rows.y_axis, rows.z_axis, rows.w_axis].map(|r| r.truncate());
    let along = |a: glam::DVec3, b: glam::DVec3| a.dot(b).abs() / (a.length() * b.length());
    let [x, y] = [x, y].map(|row| row.reject_from(w));
    along(z, w) > 0.9999 && along(x, y) < 0.01
}

/// Whether a camera from [`equivalent`] has the aspect of a picture, width over height, within one percent.
pub fn fits(camera: &[f32; 16], aspect: f64) -> bool {
    let own = f64::from(camera[5]) / f64::from(camera[0]);
    (own - aspect).abs() <= 0.01 * aspect
}

/// Whether a matrix is the inverse of a camera with this aspect. Programs compute positions from depths with such a matrix.
pub fn unprojects(m: &[f32; 16], aspect: f64) -> bool {
    // The inverse of an affine matrix is affine, so it has no perspective. Most matrices are.
    if [m[3], m[7], m[11]] == [0.0; 3] {
        return false;
    }
    let fits = |m: &[f32; 16]| equivalent(m).is_some_and(|camera| fits(&camera, aspect));
    let inverse = matrix(m).inverse();
    inverse.is_finite() && !fits(m) && fits(&inverse.as_mat4().to_cols_array())
}

/// The same inverse for the camera of a view: `m` is inverted, row 0 gets the shift of the one equation, and the result is inverted
/// again. `place` is the view's position (see [`super::Rig::position`]).
pub fn unprojection(m: &[f32; 16], shear: &Shear, place: f64) -> [f32; 16] {
    let separation = shear.separation(place);
    let mut rows = matrix(m).inverse().transpose();
    rows.x_axis += separation * (rows.w_axis - shear.conv * DVec4::W);
    rows.transpose().inverse().as_mat4().to_cols_array()
}

/// Part of the distance to the near plane by which a sky may be off the eye. A program that moves its sky to the eye by two matrices leaves what
/// they round: 1e-4 in a world of thousands, before a near plane at 0.1. Things are at least a near plane's distance away.
pub const ROUNDED: f64 = 1.0 / 64.0;

/// Whether what is drawn with these matrices turns about the eye and is not moved: by `camera`, which is one of them, and by each other one
/// that is affine, as a view or a model matrix is. Without a rotation it may be all that there is, in the space of the eye.
pub fn turns_about_eye(camera: &[f32; 16], matrices: &[[f32; 16]]) -> bool {
    let Some(projection) = equivalent(camera) else {
        return false;
    };
    let near = f64::from(projection[14]) / (f64::from(projection[10]) - 1.0);
    let off = near * ROUNDED;
    let own = matrix(camera);
    // The eye is where x, y and w are 0, whatever z is.
    let rows = own.transpose();
    let moved = [rows.x_axis, rows.y_axis, rows.w_axis];
    if moved
        .iter()
        .any(|row| row.w.abs() > off * row.truncate().length())
    {
        return false;
    }
    let others = matrices.iter().filter(|m| *m != camera);
    let mut turns = !is_projection(camera);
    for other in others.filter(|m| [m[3], m[7], m[11], m[15]] == [0.0, 0.0, 0.0, 1.0]) {
        if matrix(other).w_axis.truncate().length() > off {
            return false;
        }
        turns |= rotates(other);
    }
    turns
}

/// Where a program puts what it draws: by `camera`, one of its `matrices`, if there is more than a projection in it, else by all that are affine. Which of
/// these is the view, the model or their product is not known. All are multiplied, so that none of them jumps unseen.
pub fn pose(camera: &[f32; 16], matrices: &[[f32; 16]]) -> Option<Pose> {
    if !is_projection(camera) {
        return Pose::of_clip(camera);
    }
    let affine = matrices
        .iter()
        .filter(|m| [m[3], m[7], m[11], m[15]] == [0.0, 0.0, 0.0, 1.0]);
    let all = affine.fold(matrix(camera), |all, m| all * matrix(m));
    Pose::of_clip(&all.as_mat4().to_cols_array())
}

/// Whether an affine matrix does more than to scale along the axes and to translate.
pub fn rotates(m: &[f32; 16]) -> bool {
    [m[1], m[2], m[4], m[6], m[8], m[9]] != [0.0; 6]
}

fn matrix(m: &[f32; 16]) -> DMat4 {
    glam::Mat4::from_cols_array(m).as_dmat4()
}

/// Whether a matrix looks like a projection alone: its row 3 is (0, 0, ±1, 0).
fn is_projection(m: &[f32; 16]) -> bool {
    m[3] == 0.0 && m[7] == 0.0 && m[15] == 0.0 && m[11].abs() == 1.0
}

#[cfg(test)]
mod tests {
    use super::super::parallax::planes;
    use super::*;
    use glam::{Mat4, Quat, Vec3};

    /// A projection with the focal length `a` both ways.
    fn frustum(a: f32, c: f32, d: f32) -> Mat4 {
        Mat4::from_cols_array(&[
            a, 0.0, 0.0, 0.0, 0.0, a, 0.0, 0.0, 0.0, 0.0, c, -1.0, 0.0, 0.0, d, 0.0,
        ])
    }

    fn finite(a: f32, near: f32, far: f32) -> Mat4 {
        let (c, d) = (far + near, 2.0 * far * near);
        frustum(a, -c / (far - near), -d / (far - near))
    }

    #[track_caller]
    fn check(m: Mat4, a: f32, near: f32, far: f32) {
        let p = equivalent(&m.to_cols_array()).expect("a perspective");
        let [n, f] = planes(&p).map(|v| v as f32);
        let close = |x: f32, y: f32| (x - y).abs() <= 2e-3 * y.abs();
        assert!(
            close(p[0], a) && close(n, near) && close(f, far),
            "{p:?} {n} {f}"
        );
    }

    #[test]
    fn a_camera_is_found_in_vectors_at_any_offset() {
        // As Direct3D has it: z from 0 to w, w positive before the eye.
        let p = glam::camera::lh::proj::directx::perspective(0.9, 1.5, 0.5, 200.0);
        let view = Mat4::from_rotation_x(0.4) * Mat4::from_translation(Vec3::new(1.0, -2.0, 9.0));
        let camera = p * view * Mat4::from_scale(Vec3::splat(3.0));
        let rows = camera.transpose().to_cols_array_2d();
        // Bones, a light and others before and behind it.
        let bones = Mat4::from_rotation_y(0.7).transpose().to_cols_array_2d();
        let mut vectors = vec![[0.0, 0.5, 1.0, 2.0], [0.3, -0.4, 0.8, 0.0]];
        vectors.extend(bones);
        let at = vectors.len();
        vectors.extend(rows);
        vectors.extend([[1.0; 4], [0.2, 0.9, 0.1, 30.0], [1.0, 0.0, 0.0, 0.0]]);
        let found = among_vectors(&vectors, 1.5).expect("a camera");
        assert_eq!((found.0, found.1), (at, Lying::Rows));
        let a = 1.0 / (0.45_f32.tan() * 1.5);
        assert!((found.2[0] - a).abs() < 1e-4, "{:?} {a}", found.2);
        assert_eq!(among_vectors(&vectors, 1.0), None, "another aspect");
        vectors.splice(at..at + 4, camera.to_cols_array_2d());
        let found = among_vectors(&vectors, 1.5).expect("a camera");
        assert_eq!((found.0, found.1), (at, Lying::Columns));
        vectors.truncate(at + 3);
        assert_eq!(among_vectors(&vectors, 1.5), None);
    }

    #[test]
    fn a_model_and_a_camera_change_nothing() {
        let p = finite(1.4, 0.25, 80.0);
        check(p, 1.4, 0.25, 80.0);
        let turned = |scale: f32, angle: f32, place: Vec3| {
            Mat4::from_scale_rotation_translation(
                Vec3::splat(scale),
                Quat::from_axis_angle(Vec3::new(0.6, 0.8, 0.0), angle),
                place,
            )
        };
        let camera = turned(1.0, 0.7, Vec3::new(3.0, -2.0, 9.0));
        check(p * camera, 1.4, 0.25, 80.0);
        let place = turned(7.0, 2.0, Vec3::new(4.0, 5.0, 6.0));
        check(p * camera * place, 1.4, 0.25, 80.0);
        // All rows are scaled alike: the picture is the same, and w is scaled with them.
        check(p * 3.0, 1.4, 0.75, 240.0);
    }

    #[test]
    fn infinite_and_reversed_depths_have_a_near_distance() {
        // z = −w at 0.5; the far end is at most 1000 near distances away, as `planes` has it.
        check(frustum(1.0, -1.0, -1.0), 1.0, 0.5, 500.0);
        // Reversed, 0 to 1: z = w at 0.5, and z = 0 infinitely far.
        check(frustum(1.0, 0.0, 0.5), 1.0, 0.5, 500.0);
        // Reversed, 1 to −1.
        let p = finite(1.0, 0.25, 80.0);
        let upside_down = Mat4::from_scale(Vec3::new(1.0, 1.0, -1.0));
        check(upside_down * p, 1.0, 0.25, 80.0);
    }

    #[test]
    fn a_projection_alone_goes_before_what_else_has_a_perspective() {
        let mixed = finite(9.0, 0.1, 7.0) * Mat4::from_translation(Vec3::new(0.0, 0.0, -3.0));
        let (mixed, alone) = (
            mixed.to_cols_array(),
            finite(1.4, 0.25, 80.0).to_cols_array(),
        );
        let flat = Mat4::IDENTITY.to_cols_array();
        let a = |matrices: &[[f32; 16]]| among(matrices, 1.0).map(|(at, p)| (at, p[0]));
        assert_eq!(a(&[flat, mixed, alone]), Some((2, 1.4)));
        assert_eq!(a(&[flat, mixed]), Some((1, 9.0)));
        assert_eq!(a(&[flat]), None);
        // A matrix with the window's aspect goes before all others.
        let mut wide = alone;
        wide[0] /= 1.6;
        let a = |matrices: &[[f32; 16]]| among(matrices, 1.6).map(|(at, _)| at);
        assert_eq!(a(&[mixed, alone, wide]), Some(2));
        let far = Mat4::from_translation(Vec3::new(4.0, 0.0, -9.0));
        let moved = (Mat4::from_cols_array(&wide) * far).to_cols_array();
        assert_eq!(a(&[mixed, alone, moved]), Some(2));
    }

    #[test]
    fn what_a_view_draws_comes_back_by_its_unprojection() {
        let mut p = finite(1.4, 0.25, 80.0);
        p.x_axis.x = 1.4 / 1.5;
        let camera = Mat4::from_rotation_translation(
            Quat::from_axis_angle(Vec3::new(0.6, 0.8, 0.0), 0.7),
            Vec3::new(3.0, -2.0, 9.0),
        );
        for m in [p, p * camera] {
            let inverse = m.inverse().to_cols_array();
            assert!(unprojects(&inverse, 1.5) && !unprojects(&inverse, 1.2));
            assert!(!unprojects(&m.to_cols_array(), 1.5));
            assert_eq!(among(&[inverse], 1.5), None);
            let shear = Shear {
                along: crate::plan::Along::W,
                a: 1.0,
                spacing: 0.3,
                focal: 8.0,
                conv: 8.0,
            };
            let back = Mat4::from_cols_array(&unprojection(&inverse, &shear, 2.0));
            // Drawn by the view: x is shifted by sep · (w − conv).
            let point = glam::Vec4::new(0.5, -1.5, -7.0, 1.0);
            let mut clip = m * point;
            clip.x += shear.separation(2.0) as f32 * (clip.w - 8.0);
            let found = back * (clip / clip.w);
            let found = found / found.w;
            assert!((found - point).length() < 1e-3, "{found}");
        }
    }

    #[test]
    fn what_has_no_perspective_is_none() {
        let flat = Mat4::from_scale_rotation_translation(
            Vec3::new(0.01, 0.02, -1.0),
            Quat::IDENTITY,
            Vec3::new(-1.0, 1.0, 0.0),
        );
        assert_eq!(equivalent(&flat.to_cols_array()), None);
        assert_eq!(equivalent(&Mat4::IDENTITY.to_cols_array()), None);
        assert_eq!(equivalent(&[0.0; 16]), None);
        assert_eq!(equivalent(&[f32::NAN; 16]), None);
    }

    #[test]
    fn what_turns_about_the_eye_is_told_by_all_matrices() {
        let projection = finite(1.2, 0.5, 100.0);
        let rotation = Mat4::from_quat(Quat::from_euler(glam::EulerRot::XYZ, 0.3, 0.7, 0.1));
        let moved = |by: f32| Mat4::from_translation(Vec3::new(0.0, by, 0.0)) * rotation;
        let turns = |camera: Mat4, others: &[Mat4]| {
            let others = others.iter().chain([&camera]);
            let all: Vec<_> = others.map(Mat4::to_cols_array).collect();
            turns_about_eye(&camera.to_cols_array(), &all)
        };
        assert!(turns(projection, &[rotation]));
        assert!(turns(projection * rotation, &[]));
        assert!(turns(projection * rotation, &[Mat4::IDENTITY]));
        // What rounding leaves of two translations that cancel.
        assert!(turns(projection, &[moved(1e-3)]) && turns(projection * moved(1e-3), &[]));
        // In the space of the eye, or somewhere else.
        assert!(!turns(projection, &[]) && !turns(projection, &[Mat4::IDENTITY]));
        assert!(!turns(projection, &[moved(0.5)]) && !turns(projection * moved(0.5), &[]));
        assert!(!turns(projection * rotation, &[moved(0.5)]));
        let behind = Mat4::from_translation(Vec3::new(0.0, 0.0, -3.0)) * rotation;
        assert!(!turns(projection * behind, &[]) && !turns(projection, &[behind, rotation]));
        // No perspective.
        assert!(!turns(rotation, &[rotation]));
    }
}
