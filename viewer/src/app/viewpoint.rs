//! From where the cloud is seen, and how large its points are.

use super::arguments::Arguments;
use super::input::Change;
use crate::camera::Camera;
use crate::octree::Octree;
use crate::read::Up;
use glam::Vec3;
use std::time::Duration;

/// Sizes of points that the user can have, as factors.
const SIZES: [f32; 2] = [0.1, 10.0];

/// More time than this is no motion that anyone would follow.
const LONGEST: Duration = Duration::from_millis(500);

/// What the user changes.
pub(super) struct Viewpoint {
    up: Up,
    /// Once there are points.
    pub(super) camera: Option<Camera>,
    /// By how much points are larger.
    pub(super) scale: f32,
    /// Radians a second.
    turn: f32,
}

impl Viewpoint {
    pub(super) fn new(up: Up, arguments: &Arguments) -> Self {
        Self {
            up,
            camera: None,
            scale: 1.0,
            turn: arguments.turn.to_radians(),
        }
    }

    /// Whether it changes by itself.
    pub(super) fn is_turning(&self) -> bool {
        self.turn != 0.0
    }

    /// So much time has passed. After a long frame it goes on where it was.
    pub(super) fn advance(&mut self, since: Duration) {
        if let Some(camera) = &mut self.camera {
            camera.turn_by(self.turn * since.min(LONGEST).as_secs_f32());
        }
    }

    pub(super) fn change(&mut self, change: Change) {
        let Some(camera) = &mut self.camera else {
            return;
        };
        match change {
            Change::Turn(way) => camera.turn(way),
            Change::Shift(way) => camera.shift(way),
            Change::Approach(factor) => camera.approach(factor),
            Change::Size(factor) => self.scale = (self.scale * factor).clamp(SIZES[0], SIZES[1]),
            Change::Whole => {
                self.camera = None;
                self.scale = 1.0;
            }
        }
    }

    /// Sees the whole of a cloud, where it is not seen yet.
    pub(super) fn see(&mut self, cloud: (Vec3, f32)) {
        let up = self.up;
        self.camera.get_or_insert_with(|| Camera::new(cloud, up));
    }

    /// Follows a cloud while it grows, or at the start.
    pub(super) fn follow(&mut self, tree: &Octree, is_growing: bool) {
        match &mut self.camera {
            Some(camera) if is_growing => camera.set_cloud(tree.extent()),
            Some(_) => {}
            None => self.see(tree.extent()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Arguments, Camera, Up, Viewpoint};
    use clap::Parser;
    use glam::Vec3;
    use std::time::Duration;

    #[test]
    fn it_turns_by_the_degrees_of_a_second_whatever_the_rate_is() {
        let cloud = (Vec3::ZERO, 1.0);
        let arguments = ["manyview-points", "a.ply", "--turn", "90", "--fps", "30"];
        let arguments = Arguments::parse_from(arguments);
        let mut quarter = Camera::new(cloud, Up::Y);
        quarter.turn_by(90_f32.to_radians());
        for rate in [10, 25, 144] {
            let mut viewpoint = Viewpoint::new(Up::Y, &arguments);
            viewpoint.see(cloud);
            for _ in 0..rate {
                viewpoint.advance(Duration::from_secs(1) / rate);
            }
            let view = viewpoint.camera.expect("a camera").view();
            assert!(view.abs_diff_eq(quarter.view(), 1e-4), "{rate}");
        }
    }
}
