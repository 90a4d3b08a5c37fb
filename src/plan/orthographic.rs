//! Views of an orthographic scene: what lies deeper moves further, within the display's budget.
//!
//! It is the limit of the one equation (see [`super::parallax`]) for an eye that goes away to infinity while the angle e/ξ between neighbouring
//! cameras stays: a point at distance t moves by e/ξ·(t − ξ). In clip space z is linear in t, and w is constant:
//! row0(P_i) = row0(P) + sep_i·row2(P) − sep_i·zero·row3(P).
//! A depth is 0 on the near plane and 1 on the far plane, whichever numbers the program has for them.

use super::comfort::{BEFORE, BEHIND, LIMIT_BEFORE, LIMIT_BEHIND};
use crate::state::ClassificationState;

/// Above the first part of the budget the cameras begin to move, below the second they stop.
const SLACK: f64 = 0.12;
const ARRIVED: f64 = 0.01;
/// Part of the remaining way that is covered in one frame.
const ALONG: f64 = 0.03;
/// Vertices lie in one plane where row 2 depends on nothing but the coordinate across it, but for rounding.
const TILTED: f32 = 1e-3;

/// z in normalised device coordinates on the near and on the far plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planes {
    near: f64,
    far: f64,
}

impl Planes {
    /// By the depth test, the depth range and glClipControl.
    pub fn of(state: &ClassificationState) -> Self {
        let turned = state.depths[0] > state.depths[1];
        Planes::new(state.zero_to_one, state.reversed != turned)
    }

    /// `zero_to_one`: z begins at 0. `reversed`: it is larger on the near plane.
    pub fn new(zero_to_one: bool, reversed: bool) -> Self {
        let low = if zero_to_one { 0.0 } else { -1.0 };
        match reversed {
            false => Planes {
                near: low,
                far: 1.0,
            },
            true => Planes {
                near: 1.0,
                far: low,
            },
        }
    }

    /// Depth 1 less depth 0.
    pub fn extent(&self) -> f64 {
        self.far - self.near
    }

    /// z at a depth.
    pub fn at(&self, depth: f64) -> f64 {
        self.near + depth * self.extent()
    }
}

/// Cameras of an orthographic scene: the disparity between neighbouring views is slope·(depth − zero), in normalised device coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slant {
    /// Disparity of the far plane less that of the near plane.
    pub slope: f64,
    /// The depth of zero parallax.
    pub zero: f64,
}

impl Slant {
    /// All from the near plane to the far one has a part of `budget`, in normalised device coordinates.
    pub fn between_planes(budget: f64) -> Self {
        Slant::through([0.0, 1.0], [-BEFORE * budget, BEHIND * budget])
    }

    /// The cameras that give two depths their disparities.
    fn through([near, far]: [f64; 2], [before, behind]: [f64; 2]) -> Self {
        let slope = (behind - before) / (far - near);
        Slant {
            slope,
            zero: near - before / slope,
        }
    }

    /// The disparity at a depth.
    pub fn at(&self, depth: f64) -> f64 {
        self.slope * (depth - self.zero)
    }
}

/// Disparity between neighbouring views from the near plane to the far one at which an orthographic scene is as deep as it is wide and high.
/// `p` is the projection, alone or with the view and the model (column-major); `neighbours` the distance of neighbouring cameras over the focal
/// depth.
pub fn orthoscopic(p: &[f32; 16], planes: &Planes, neighbours: f64) -> f64 {
    let [wide, deep] = [0, 2].map(|row| row_length(p, row));
    match wide / deep * planes.extent().abs() * neighbours.abs() {
        slope if slope > 0.0 && slope.is_finite() => slope,
        _ => f64::INFINITY,
    }
}

/// Length of a row of a matrix (column-major), but for its last number.
pub(super) fn row_length(p: &[f32; 16], row: usize) -> f64 {
    let [x, y, z] = [p[row], p[row + 4], p[row + 8]].map(f64::from);
    glam::DVec3::new(x, y, z).length()
}

/// Whether a matrix (column-major) has no perspective and shows things from an oblique direction: depth changes along their x or y axis. What is
/// drawn in a plane of the screen, such as text, is never seen so.
pub fn is_oblique(m: &[f32; 16]) -> bool {
    let row = [m[2], m[6], m[10]];
    let size = row.iter().fold(0.0f32, |size, v| size.max(v.abs()));
    [m[3], m[7], m[11]] == [0.0; 3]
        && m[15] != 0.0
        && size.is_finite()
        && m[2].abs().max(m[6].abs()) > TILTED * size
}

/// Of the matrices (column-major) that a program's shaders get, the one by which an orthographic scene is measured; none where nothing is seen from an
/// oblique direction. A projection scales x and z differently, a view or a model matrix does not.
pub fn among(matrices: &[[f32; 16]]) -> Option<[f32; 16]> {
    let affine = || {
        matrices
            .iter()
            .filter(|m| [m[3], m[7], m[11]] == [0.0; 3] && m[15] != 0.0)
    };
    let oblique = affine().find(|m| is_oblique(m))?;
    let planes = Planes::new(false, false);
    // Twice the ratio of both lengths.
    let scales = |m: &&[f32; 16]| (orthoscopic(m, &planes, 0.5) - 1.0).abs() > 0.01;
    Some(*affine().find(scales).unwrap_or(oblique))
}

/// The cameras of an orthographic scene under [`crate::config::Camera::Measured`]. They move as those of a perspective do (see
/// [`super::comfort`]): slowly, and only when the scene has changed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slanting {
    cameras: Option<Slant>,
    moving: bool,
}

impl Slanting {
    /// The cameras after a frame whose nearest and farthest points had these depths. `budget` is in normalised device coordinates, `most` the
    /// largest slope, as of [`orthoscopic`].
    pub fn track(&mut self, [near, far]: [f64; 2], budget: f64, most: f64) -> Option<Slant> {
        let goal = goal([near, far], budget, most);
        if !(goal.slope > 0.0 && goal.slope.is_finite() && goal.zero.is_finite()) {
            return self.cameras;
        }
        let ends = |cameras: Slant| [near, far].map(|depth| cameras.at(depth));
        let now = self.cameras.map_or(goal, |last| {
            let way = ends(last).into_iter().zip(ends(goal));
            let off = way.fold(0.0f64, |off, (from, to)| off.max((to - from).abs())) / budget;
            self.moving = off > if self.moving { ARRIVED } else { SLACK };
            match self.moving {
                false => last,
                true => between(last, goal, ALONG),
            }
        });
        let [before, behind] = ends(now).map(|disparity| disparity / budget);
        let inside = before >= -LIMIT_BEFORE && behind <= LIMIT_BEHIND;
        self.cameras = Some(if inside { now } else { goal });
        self.cameras
    }
}

/// Where the cameras would stand if the scene stayed as it is: its nearest point has its part of the budget, and its farthest one too unless the
/// scene is shallow.
fn goal([near, far]: [f64; 2], budget: f64, most: f64) -> Slant {
    let slope = ((BEFORE + BEHIND) * budget / (far - near).max(f64::EPSILON)).min(most);
    // A shallow scene lies behind the panel by the same part of its depth.
    let before = BEFORE / (BEFORE + BEHIND) * (far - near);
    Slant {
        slope,
        zero: near + before,
    }
}

/// A part of the way from one pair of cameras to another, at every depth.
fn between(from: Slant, to: Slant, part: f64) -> Slant {
    let mix = |a: f64, b: f64| a + part * (b - a);
    let (slope, offset) = (
        mix(from.slope, to.slope),
        mix(from.slope * from.zero, to.slope * to.zero),
    );
    Slant {
        slope,
        zero: offset / slope,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::camera::rh::proj::opengl;
    use glam::{Mat4, Vec3};

    const BUDGET: f64 = 0.005;

    #[test]
    fn near_and_far_have_their_parts_of_the_budget() {
        for ends in [[0.0, 1.0], [0.4995, 0.5005], [0.9, 0.99]] {
            let cameras = Slanting::default().track(ends, BUDGET, f64::INFINITY);
            let [before, behind] = ends.map(|depth| cameras.expect("cameras").at(depth) / BUDGET);
            assert!((before + BEFORE).abs() < 1e-9 && (behind - BEHIND).abs() < 1e-9);
        }
        let all = Slant::between_planes(BUDGET);
        assert!((all.at(0.0) + BEFORE * BUDGET).abs() < 1e-12);
        assert!((all.at(1.0) - BEHIND * BUDGET).abs() < 1e-12);
    }

    #[test]
    fn a_shallow_scene_is_not_made_deeper_than_it_is() {
        let cameras = Slanting::default().track([0.5, 0.501], BUDGET, 0.1);
        assert_eq!(cameras.map(|c| c.slope), Some(0.1));
        // One plane has no depth; its cameras are finite.
        let plane = Slanting::default().track([0.5, 0.5], BUDGET, 0.1);
        assert_eq!(plane.map(|c| (c.slope, c.zero)), Some((0.1, 0.5)));
    }

    #[test]
    fn nothing_leaves_the_budget_and_nothing_trembles() {
        let mut slanting = Slanting::default();
        let first = slanting.track([0.3, 0.6], BUDGET, 1.0);
        for step in 0..100 {
            let near = 0.3 + 0.01 * (f64::from(step) * 0.7).sin();
            assert_eq!(slanting.track([near, 0.6], BUDGET, 1.0), first);
        }
        for step in 0..200 {
            let ends = [
                0.3 - 0.0015 * f64::from(step),
                0.6 + 0.001 * f64::from(step),
            ];
            let cameras = slanting.track(ends, BUDGET, 1.0).expect("cameras");
            let [before, behind] = ends.map(|depth| cameras.at(depth) / BUDGET);
            assert!(
                before >= -LIMIT_BEFORE - 1e-9 && behind <= LIMIT_BEHIND + 1e-9,
                "{step}: {before} {behind}"
            );
        }
    }

    #[test]
    fn another_scene_is_reached_in_small_steps() {
        let mut slanting = Slanting::default();
        let mut last = slanting.track([0.0, 1.0], BUDGET, 1.0).expect("cameras");
        for _ in 0..600 {
            let now = slanting.track([0.4, 0.6], BUDGET, 1.0).expect("cameras");
            let step = [0.4, 0.6].map(|depth| (now.at(depth) - last.at(depth)).abs());
            assert!(step.iter().all(|step| *step < 0.04 * BUDGET), "{step:?}");
            last = now;
        }
        assert!((last.at(0.6) - BEHIND * BUDGET).abs() < 0.02 * BUDGET);
    }

    #[test]
    fn what_lies_in_the_screen_is_not_oblique() {
        let ortho = opengl::orthographic(-4.0, 4.0, -3.0, 3.0, 1.0, 50.0);
        let oblique = |m: Mat4| is_oblique(&m.to_cols_array());
        assert!(!oblique(ortho) && !oblique(ortho * Mat4::from_rotation_z(0.7)));
        assert!(!oblique(
            ortho * Mat4::from_translation(Vec3::new(1.0, 2.0, -9.0))
        ));
        // What rounding leaves of half a turn.
        assert!(!oblique(
            ortho * Mat4::from_rotation_y(std::f32::consts::PI)
        ));
        assert!(oblique(ortho * Mat4::from_rotation_x(0.6)));
        assert!(oblique(
            ortho * Mat4::from_rotation_x(0.6) * Mat4::from_rotation_y(0.8)
        ));
        let perspective = opengl::perspective(1.0, 1.3, 1.0, 50.0);
        assert!(!oblique(perspective * Mat4::from_rotation_x(0.6)));
        assert!(!oblique(Mat4::ZERO) && !oblique(Mat4::from_cols_array(&[f32::NAN; 16])));
    }

    #[test]
    fn orthoscopic_is_as_deep_as_wide() {
        // 8 wide, 49 deep: e/ξ of the depth, over half of the width.
        let ortho = opengl::orthographic(-4.0, 4.0, -3.0, 3.0, 1.0, 50.0);
        let turned = ortho * Mat4::from_rotation_x(0.6);
        for m in [ortho, turned] {
            let planes = Planes::new(false, false);
            let slope = orthoscopic(&m.to_cols_array(), &planes, 0.02);
            assert!((slope - 0.02 * 49.0 / 4.0).abs() < 1e-5, "{slope}");
        }
    }
}
