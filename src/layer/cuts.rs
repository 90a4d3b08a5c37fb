//! Cuts: the first frame after a jump of the program's camera is drawn with cameras that are safe for anything.

use super::Layer;
use crate::config::{Camera, Class, Projection, Viewport};
use crate::gl::Gl;
use crate::plan::decide::Shaders;
use crate::plan::{Facts, Kind, Pose};
use crate::state::Touch;

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
            _ if self.state.has.compatibility => {
                self.state.read_classification(gl, Touch::MODELVIEW);
                let modelview = glam::Mat4::from_cols_array(&self.state.classification.modelview);
                let p = glam::Mat4::from_cols_array(&facts.projections.fixed);
                Pose::of_clip(&(p * modelview).to_cols_array())
            }
            _ => None,
        };
        if let Some(pose) = pose
            && self.cameras.comfort.cuts.observe(pose, cameras)
        {
            self.cameras.comfort.restart();
            self.known.rig.forget_measured();
        }
    }
}
