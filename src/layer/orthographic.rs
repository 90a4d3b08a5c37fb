//! Orthographic scenes: what the program draws without perspective and yet in depth.

use super::Layer;
use crate::config::{Camera, DepthState, Kept, OrthographicDraws, Projection, Viewport};
use crate::gl::Gl;
use crate::plan::decide::Shaders;
use crate::plan::{Planes, orthographic};
use crate::state::Touch;

impl Layer {
    /// Whether a draw of this kind of projection belongs to an orthographic scene (see [`crate::plan::decide::OrthographicWatch`]).
    pub(super) fn slants(&mut self, gl: &Gl, projection: Projection, shaders: &Shaders) -> bool {
        let wanted = self.session.config.orthographic;
        let always = wanted == OrthographicDraws::Scene;
        let watch = self.known.frame.orthographic;
        if projection == Projection::Perspective
            || wanted == OrthographicDraws::Flat
            || !always && !watch.is_possible()
        {
            return false;
        }
        self.state.read_classification(gl, Touch::DEPTH);
        if self.state.classification.depth == DepthState::Off {
            return false;
        }
        let p = self.state.matrices.projection;
        let known = self.state.viewport_kind() == Viewport::Main && watch.is_of_scene(&p);
        if always || known {
            return true;
        }
        match shaders {
            Shaders::Variant(variant) => {
                let search = self.variants.own.search(variant.program);
                search.is_some_and(|search| search.oblique().is_some())
            }
            _ => self
                .fixed_matrix(gl)
                .is_some_and(|all| orthographic::is_oblique(&all)),
        }
    }

    /// The product of GL_PROJECTION_MATRIX and GL_MODELVIEW_MATRIX, column-major; none in a context without them.
    pub(super) fn fixed_matrix(&mut self, gl: &Gl) -> Option<[f32; 16]> {
        if !self.state.has.compatibility {
            return None;
        }
        self.state.read_classification(gl, Touch::MODELVIEW);
        let modelview = glam::Mat4::from_cols_array(&self.state.classification.modelview);
        let p = glam::Mat4::from_cols_array(&self.state.matrices.projection);
        Some((p * modelview).to_cols_array())
    }

    /// Says once which numbers of the cameras an orthographic scene does not have.
    pub(super) fn tell_of_orthographic_scene(&mut self) {
        let option = match self.session.live.camera {
            Camera::Measured(Some(Kept::Separation(_))) => "separation alone",
            Camera::Measured(Some(Kept::Convergence(_))) => "convergence alone",
            Camera::Measured(Some(Kept::EyeSpacing(_))) => "eye-spacing alone",
            Camera::Measured(Some(Kept::FocalDepth(_))) => "focal-depth alone",
            Camera::Clip { .. } => "convergence",
            Camera::Measured(None) | Camera::Auto | Camera::Eye { .. } => return,
        };
        if !self.known.frame.orthographic.has_scene() || self.cameras.comfort.told_orthographic {
            return;
        }
        self.cameras.comfort.told_orthographic = true;
        self.diagnostics.announce(format!(
            "{option} has no effect on a scene without perspective; place its cameras by eye-spacing and focal-depth"
        ));
    }

    /// The near and the far plane in normalised device coordinates, by the state that was read last.
    pub(super) fn depth_planes(&self) -> Planes {
        Planes::of(&self.state.classification)
    }
}
