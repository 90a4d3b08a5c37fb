//! Cuts: the program's camera has jumped, so depths that were measured before say nothing of this frame.
//!
//! A cut is known from the matrices of a frame's first draw, before anything is drawn. Of a thing that stands still, they tell how the camera has
//! moved: V'·M·(V·M)⁻¹. So the first draw is compared with many draws of the frame before. If none of them could have moved there, the camera has
//! jumped, or the thing is new. Whether it was worth the care, the depths of the frame tell afterwards.

use glam::{DMat3, DMat4, DVec3};

/// How many draws of a frame are compared with the first one of the next.
const MOST: usize = 32;
/// A point at the distance of zero parallax moves by more than this part of the distance from one frame to the next: as by a turn of 35° or a step of
/// half the distance.
const JUMP: f64 = 0.6;
/// What moves fast moves on like that: this many times the last step is no jump.
const INERTIA: f64 = 4.0;
/// Cuts that were not worth the care, beyond twice those that were, before the program's matrices are taken to say nothing.
const USELESS: u32 = 3;

/// Where a draw puts its vertices: from their space to that of the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    linear: DMat3,
    at: DVec3,
}

impl Pose {
    /// Of a matrix (column-major) to clip space, which may have the view and the model in it. None where it has no perspective.
    pub fn of_clip(m: &[f32; 16]) -> Option<Pose> {
        let rows = DMat4::from_cols_array(&m.map(f64::from)).transpose();
        let direction = rows.w_axis.truncate();
        let scale = direction.length();
        // What is across the viewing direction, in units along it.
        let across = |row: glam::DVec4| {
            let along = row.truncate().dot(direction) / (scale * scale);
            let row = row - along * rows.w_axis;
            row * (scale / row.truncate().length())
        };
        let rows = [across(rows.x_axis), across(rows.y_axis), rows.w_axis];
        let linear = DMat3::from_cols_array_2d(&rows.map(|row| row.truncate().to_array()));
        let pose = Pose {
            linear: linear.transpose(),
            at: DVec3::from_array(rows.map(|row| row.w)),
        };
        let usable = pose.linear.is_finite() && pose.at.is_finite();
        (usable && pose.linear.determinant() != 0.0).then_some(pose)
    }

    /// By how much a point at `distance` has moved since `before`, as a part of that distance, if both are of the same thing.
    fn moved(&self, before: &Pose, distance: f64) -> f64 {
        let turn = self.linear * before.linear.inverse();
        let step = self.at - turn * before.at;
        let turned = (turn - DMat3::IDENTITY).to_cols_array();
        let turned = turned.iter().map(|v| v * v).sum::<f64>().sqrt() / 2.0_f64.sqrt();
        turned + step.length() / distance
    }
}

/// The cuts of one program.
#[derive(Clone, Debug, Default)]
pub struct Cuts {
    /// Of the last frame with a scene, and of this one.
    before: Vec<Pose>,
    now: Vec<Pose>,
    /// How far the first thing has moved last.
    step: f64,
    /// Separation and convergence before a cut whose depths are not known yet.
    left: Option<(f64, f64)>,
    useful: u32,
    useless: u32,
}

impl Cuts {
    /// Whether the next draw of the scene is of interest.
    pub fn looks(&self) -> bool {
        self.now.len() < MOST && self.useless <= USELESS + 2 * self.useful
    }

    /// Takes note of a draw of the scene, in order, without looking for a cut: no cameras are in force that a cut could leave.
    pub fn note(&mut self, pose: Pose) {
        self.now.push(pose);
    }

    /// Takes note of a draw of the scene, in order. `cameras` are separation and convergence in force. True for the first draw of a frame, if there
    /// was a cut.
    pub fn observe(&mut self, pose: Pose, cameras: (f64, f64)) -> bool {
        let first = self.now.is_empty();
        self.now.push(pose);
        if !first || self.before.is_empty() {
            return false;
        }
        let before = self.before.iter();
        let step = before
            .map(|before| pose.moved(before, cameras.1))
            .fold(f64::INFINITY, f64::min);
        let cut = step > JUMP + INERTIA * self.step;
        self.step = if cut { 0.0 } else { step };
        if cut {
            self.left = Some(cameras);
        }
        cut
    }

    /// The first frame whose depths are known after a cut, with 1/w of its farthest and nearest point. The cut was worth the care if the cameras of
    /// before would have shown the frame beyond the display's budget, which is in normalised device coordinates.
    pub fn judge(&mut self, ends: [f64; 2], budget: f64) {
        let Some((separation, convergence)) = self.left.take() else {
            return;
        };
        let beyond = |inverse: f64| separation * (1.0 - convergence * inverse).abs() > budget;
        match ends.into_iter().any(beyond) {
            true => self.useful += 1,
            false => self.useless += 1,
        }
    }

    /// A frame ends. One without a scene changes nothing: a menu may lie between two frames of a game.
    pub fn end_frame(&mut self) {
        if !self.now.is_empty() {
            std::mem::swap(&mut self.before, &mut self.now);
            self.now.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::camera::rh::proj::opengl;
    use glam::{Mat4, Vec3};

    const CAMERAS: (f64, f64) = (0.01, 10.0);

    fn view(at: Vec3, yaw: f32) -> Mat4 {
        Mat4::from_rotation_y(yaw) * Mat4::from_translation(-at)
    }

    fn things() -> [Mat4; 3] {
        [
            Mat4::IDENTITY,
            Mat4::from_translation(Vec3::new(3.0, 1.0, -8.0)) * Mat4::from_rotation_z(1.0),
            Mat4::from_scale(Vec3::splat(2.0)),
        ]
    }

    /// Cuts at the frames with these cameras.
    fn cuts(cameras: &[Mat4]) -> Vec<bool> {
        let mut cuts = Cuts::default();
        cameras
            .iter()
            .map(|view| {
                let all = things().map(|thing| shown(*view * thing).expect("a pose"));
                let cut = all.map(|pose| cuts.observe(pose, CAMERAS))[0];
                cuts.end_frame();
                cut
            })
            .collect()
    }

    fn shown(m: Mat4) -> Option<Pose> {
        let p = opengl::perspective(1.0, 1.5, 0.5, 500.0);
        Pose::of_clip(&(p * m).to_cols_array())
    }

    #[test]
    fn a_jump_of_the_camera_is_a_cut() {
        let walk = |k: u8| {
            view(
                Vec3::new(0.0, 0.0, -0.2 * f32::from(k)),
                0.02 * f32::from(k),
            )
        };
        let jumps = [
            view(Vec3::new(40.0, 0.0, 3.0), 0.0),
            view(Vec3::ZERO, 2.0),
            view(Vec3::new(0.0, 9.0, 0.0), 0.0),
        ];
        for jump in jumps {
            let cameras = [walk(0), walk(1), walk(2), jump, jump];
            let want = [false, false, false, true, false];
            assert_eq!(cuts(&cameras), want);
        }
    }

    #[test]
    fn fast_movement_is_none() {
        // At first by a quarter of the distance a frame, then faster and faster; a turn by 15° a frame.
        let flight: Vec<Mat4> = (0..20_u8)
            .map(|k| view(Vec3::new(0.0, 0.0, -2.5 * f32::from(k).powf(1.2)), 0.0))
            .collect();
        let turn: Vec<Mat4> = (0..20_u8)
            .map(|k| view(Vec3::ZERO, 0.26 * f32::from(k)))
            .collect();
        for cameras in [flight, turn] {
            assert!(!cuts(&cameras).contains(&true));
        }
    }

    #[test]
    fn another_order_of_the_draws_is_none() {
        let mut cuts = Cuts::default();
        let poses = things().map(|thing| shown(thing).expect("a pose"));
        for order in [[0, 1, 2], [2, 1, 0], [1, 0, 2]] {
            assert!(!order.map(|k: usize| cuts.observe(poses[k], CAMERAS))[0]);
            cuts.end_frame();
        }
    }

    #[test]
    fn a_menu_between_two_frames_is_none() {
        let mut cuts = Cuts::default();
        let here = shown(view(Vec3::ZERO, 0.0)).expect("a pose");
        let there = shown(view(Vec3::new(0.0, 30.0, 0.0), 0.0)).expect("a pose");
        for (pose, cut) in [(here, false), (here, false), (there, true)] {
            assert_eq!(cuts.observe(pose, CAMERAS), cut);
            cuts.end_frame();
            // No scene.
            cuts.end_frame();
        }
    }

    #[test]
    fn matrices_that_say_nothing_are_left_alone() {
        let mut cuts = Cuts::default();
        let there = |k: u8| shown(view(Vec3::new(0.0, 100.0 * f32::from(k), 0.0), 0.0));
        let mut jump = |k: u8, near: f64| {
            let cut = cuts.observe(there(k).expect("a pose"), CAMERAS);
            cuts.end_frame();
            // A point in front of the panel by the cameras of before; only the first frame counts.
            cuts.judge([0.02, 1.0 / near], 0.02);
            cuts.judge([0.02, 1.0 / near], 0.02);
            (cut, cuts.looks())
        };
        assert_eq!(jump(0, 5.0), (false, true));
        let mut all = (1..=4).map(|k| jump(k, 5.0)).collect::<Vec<_>>();
        assert_eq!(all.pop(), Some((true, false)));
        assert!(all.iter().all(|found| *found == (true, true)));
        // Three parts of the distance in front of it.
        assert_eq!(jump(5, 2.5), (true, true));
    }

    #[test]
    fn what_is_no_place_has_no_pose() {
        assert_eq!(shown(Mat4::ZERO), None);
        assert_eq!(Pose::of_clip(&[0.0; 16]), None);
        assert_eq!(Pose::of_clip(&[f32::NAN; 16]), None);
        // Without perspective.
        assert_eq!(Pose::of_clip(&Mat4::IDENTITY.to_cols_array()), None);
    }
}
