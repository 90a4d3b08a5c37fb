//! Cuts: the first frame after a jump of the program's camera is drawn with cameras that are safe for anything.

use super::Layer;
use crate::config::Camera;
use crate::gl::Gl;
use crate::plan::decide::Shaders;
use crate::plan::{Facts, Pose};

impl Layer {
    /// Before a draw is decided: looks whether the frame comes after a cut.
    pub(super) fn watch_cuts(&mut self, gl: &Gl, facts: &Facts) {
        let measured = matches!(self.session.live.camera, Camera::Measured(_));
        let Some(cameras) = self.known.rig.latched().filter(|_| measured) else {
            return;
        };
        if !facts.is_main_scene() || !self.cameras.comfort.cuts.looks() {
            return;
        }
        let pose = match &facts.shaders {
            Shaders::Variant(variant) => self.pose_by_shader(gl, variant.program),
            _ => self.fixed_matrix(gl).and_then(|all| Pose::of_clip(&all)),
        };
        let Some(pose) = pose else { return };
        let comfort = &mut self.cameras.comfort;
        // Cameras that are safe for anything have their zero parallax at the near plane: by that, every step would be a cut.
        if !comfort.has_found() {
            comfort.cuts.note(pose);
        } else if comfort.cuts.observe(pose, cameras) {
            comfort.restart();
            self.known.rig.forget_measured();
        }
    }
}
