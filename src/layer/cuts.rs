//! Cuts: the first frame after a jump of the program's camera is drawn with cameras that are safe for anything.

use super::Layer;
use crate::config::{Camera, Class, Projection, Viewport};
use crate::gl::Gl;
use crate::plan::decide::Shaders;
use crate::plan::{Facts, Kind, Pose};

impl Layer {
    /// Before a draw is decided: looks whether the frame comes after a cut.
    pub(super) fn watch_cuts(&mut self, gl: &Gl, facts: &Facts) {
        let measured = matches!(self.session.live.camera, Camera::Measured(_));
        let Some(cameras) = self.known.rig.latched().filter(|_| measured) else {
            return;
        };
        let traits = &facts.traits;
        let scene = facts.classed.class == Class::Scene
            && !facts.classed.is_foreground()
            && traits.projection == Projection::Perspective
            && traits.viewport == Viewport::Main
            && traits.target.is_shown()
            && !matches!(traits.kind, Kind::Clear { .. } | Kind::Accum | Kind::Pixels);
        if !scene || !self.cameras.comfort.cuts.looks() {
            return;
        }
        let pose = match &facts.shaders {
            Shaders::Variant(variant) => self.pose_by_shader(gl, variant.program),
            _ => self.fixed_matrix(gl).and_then(|all| Pose::of_clip(&all)),
        };
        if let Some(pose) = pose
            && self.cameras.comfort.cuts.observe(pose, cameras)
        {
            self.cameras.comfort.restart();
            self.known.rig.forget_measured();
        }
    }
}
