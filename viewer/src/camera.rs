//! A camera that turns about a point.

use crate::octree::Look;
use crate::read::Up;
use glam::{Mat3, Mat4, Quat, Vec2, Vec3};
use std::f32::consts::{FRAC_PI_2, PI};

/// From the middle to the upper edge of the picture, in radians.
const HALF_FIELD: f32 = 0.35;
/// At the start, seen from so far above the horizon, in radians.
const PITCH: f32 = 0.25;
/// Radians that a drag over the whole height of the picture turns.
const TURN: f32 = 3.0;
/// Nearest and farthest, in radii of the cloud.
const DISTANCES: [f32; 2] = [1e-4, 1e3];

/// Where the viewer is.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// The cloud's middle and radius.
    cloud: (Vec3, f32),
    up: Up,
    target: Vec3,
    distance: f32,
    /// About the axis that points upwards, in radians.
    yaw: f32,
    /// Above the horizon.
    pitch: f32,
}

impl Camera {
    /// Sees the whole of a cloud.
    #[must_use]
    pub fn new(cloud: (Vec3, f32), up: Up) -> Self {
        Self {
            cloud,
            up,
            target: cloud.0,
            distance: cloud.1 / HALF_FIELD.sin(),
            yaw: 0.0,
            pitch: PITCH,
        }
    }

    /// The cloud has grown while it is read. A viewer who has not moved sees the whole of it.
    pub fn set_cloud(&mut self, cloud: (Vec3, f32)) {
        let start = Self::new(self.cloud, self.up);
        if (self.target, self.distance) == (start.target, start.distance) {
            let whole = Self::new(cloud, self.up);
            (self.target, self.distance) = (whole.target, whole.distance);
        }
        self.cloud = cloud;
    }

    /// Turns by a way in heights of the picture, to the right and downwards.
    pub fn turn(&mut self, way: Vec2) {
        self.yaw -= way.x * TURN;
        self.pitch = (self.pitch + way.y * TURN).clamp(-FRAC_PI_2, FRAC_PI_2);
    }

    /// Turns about the axis that points upwards, in radians.
    pub fn turn_by(&mut self, angle: f32) {
        self.yaw += angle;
    }

    /// Moves what is seen by a way in heights of the picture, to the right and downwards.
    pub fn shift(&mut self, way: Vec2) {
        let scale = 2.0 * self.distance * HALF_FIELD.tan();
        let axes = self.axes();
        self.target += (axes.y_axis * way.y - axes.x_axis * way.x) * scale;
    }

    /// Comes closer by a factor.
    pub fn approach(&mut self, factor: f32) {
        let [near, far] = DISTANCES.map(|share| share * self.cloud.1);
        self.distance = (self.distance / factor).clamp(near, far);
    }

    /// To the right, upwards and towards the viewer.
    fn axes(&self) -> Mat3 {
        let turned = Quat::from_rotation_y(self.yaw) * Quat::from_rotation_x(-self.pitch);
        let upright = match self.up {
            Up::Y => Quat::IDENTITY,
            Up::Z => Quat::from_rotation_x(FRAC_PI_2),
            Up::MinusY => Quat::from_rotation_x(PI),
        };
        Mat3::from_quat(upright * turned)
    }

    /// From the tree's space to that of the camera.
    #[must_use]
    pub fn view(&self) -> Mat4 {
        let axes = self.axes();
        let eye = self.target + axes.z_axis * self.distance;
        let turned = axes.transpose();
        Mat4::from_mat3(turned) * Mat4::from_translation(-eye)
    }

    /// From the camera's space to clip coordinates, for a picture of this width and height.
    #[must_use]
    pub fn projection(&self, [width, height]: [u32; 2]) -> Mat4 {
        let aspect = width as f32 / height.max(1) as f32;
        let far = self.distance + self.reach();
        glam::camera::rh::proj::opengl::perspective(2.0 * HALF_FIELD, aspect, self.near(), far)
    }

    /// Depth of the near plane.
    #[must_use]
    pub fn near(&self) -> f32 {
        (self.distance - self.reach()).max(self.distance * 0.02)
    }

    /// How far the cloud reaches from what is looked at.
    fn reach(&self) -> f32 {
        (self.cloud.0 - self.target).length() + 1.5 * self.cloud.1
    }

    /// For the choice of nodes.
    #[must_use]
    pub fn look(&self, size: [u32; 2]) -> Look {
        Look {
            eye: self.target + self.axes().z_axis * self.distance,
            clip: self.projection(size) * self.view(),
            pixels: size[1] as f32 / 2.0 / HALF_FIELD.tan(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Camera, Up};
    use glam::{Vec2, Vec3};

    const CLOUD: (Vec3, f32) = (Vec3::new(1.0, 2.0, 3.0), 5.0);

    #[test]
    fn the_middle_is_in_the_middle_and_the_whole_is_seen() {
        for up in [Up::Y, Up::Z] {
            let mut camera = Camera::new(CLOUD, up);
            camera.turn(Vec2::new(0.3, -0.4));
            let clip = camera.projection([640, 480]) * camera.view();
            let middle = clip.project_point3(CLOUD.0);
            assert!(middle.truncate().length() < 1e-5, "{middle}");
            for axis in [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z] {
                let seen = clip.project_point3(CLOUD.0 + axis * CLOUD.1);
                assert!(seen.abs().max_element() <= 1.0, "{axis}: {seen}");
            }
        }
    }

    #[test]
    fn up_is_up_and_a_drag_moves_what_is_under_it() {
        for (up, axis) in [(Up::Y, Vec3::Y), (Up::Z, Vec3::Z), (Up::MinusY, -Vec3::Y)] {
            let mut camera = Camera::new(CLOUD, up);
            let seen = |camera: &Camera, place| {
                (camera.projection([640, 480]) * camera.view()).project_point3(place)
            };
            assert!(seen(&camera, CLOUD.0 + axis).y > 0.1);
            // A quarter of the height to the right, an eighth down.
            camera.shift(Vec2::new(0.25, 0.125));
            let moved = seen(&camera, CLOUD.0);
            let want = Vec2::new(0.5 * 480.0 / 640.0, -0.25);
            assert!((moved.truncate() - want).length() < 1e-4, "{moved}");
        }
    }
}
