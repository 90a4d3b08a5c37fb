//! State by which draws are classified; no draw needs it for its views.

use super::{State, Touch};
use crate::config::{DepthRange, DepthState, Projection, Viewport};
use crate::gl::{Gl, TextureName, consts as c};

/// State by which draws are classified. A group is valid once [`State::read_classification`] was asked for it, until a command
/// touches it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClassificationState {
    /// Depth test and mask.
    pub depth: DepthState,
    /// Fragments have to have exactly the depth in the buffer: GL_EQUAL.
    pub equal: bool,
    /// Nearer points have larger depths: GL_GREATER or GL_GEQUAL.
    pub reversed: bool,
    /// Which part of the depth buffer is drawn to.
    pub range: DepthRange,
    /// GL_DEPTH_RANGE, near and far.
    pub depths: [f32; 2],
    /// Normalised depths begin at 0, by glClipControl.
    pub zero_to_one: bool,
    /// Blending is on.
    pub blends: bool,
    /// The stencil test is on.
    pub stencil: bool,
    /// The polygon stipple is on.
    pub stipple: bool,
    /// The 2D texture that the active unit samples; 0 for none.
    pub texture: TextureName,
    /// GL_MODELVIEW_MATRIX.
    pub modelview: [f32; 16],
}

impl Default for ClassificationState {
    fn default() -> Self {
        ClassificationState {
            depth: DepthState::Off,
            equal: false,
            reversed: false,
            range: DepthRange::Whole,
            depths: [0.0, 1.0],
            zero_to_one: false,
            blends: false,
            stencil: false,
            stipple: false,
            texture: TextureName::ZERO,
            modelview: glam::Mat4::IDENTITY.to_cols_array(),
        }
    }
}

impl State {
    /// Reads again those of `groups` that a command has touched. [`State::refresh`] has to come first.
    pub fn read_classification(&mut self, gl: &Gl, groups: Touch) {
        let stale = |group: Touch| groups.has(group) && self.touched.has(group);
        if stale(Touch::DEPTH) {
            let buffer = !self.framebuffers.draw.is_zero() || self.window.bits[4] > 0;
            self.classification.depth = if !buffer || !gl.is_enabled(c::DEPTH_TEST) {
                DepthState::Off
            } else if gl.get_integer(c::DEPTH_WRITEMASK) == 0 {
                DepthState::TestOnly
            } else {
                DepthState::On
            };
            let function = match self.classification.depth {
                DepthState::Off => 0,
                _ => gl.get_integer(c::DEPTH_FUNC) as u32,
            };
            self.classification.equal = function == c::EQUAL;
            self.classification.reversed = matches!(function, c::GREATER | c::GEQUAL);
        }
        if stale(Touch::RANGE) {
            self.classification.depths = gl.get_floats(c::DEPTH_RANGE);
            self.classification.range = depth_range(self.classification.depths);
            self.classification.zero_to_one = self.has.clip_control
                && gl.get_integer(c::CLIP_DEPTH_MODE) as u32 == c::ZERO_TO_ONE;
        }
        if stale(Touch::COVER) {
            self.classification.blends = gl.is_enabled(c::BLEND);
            self.classification.stencil = gl.is_enabled(c::STENCIL_TEST);
            self.classification.stipple =
                self.has.compatibility && gl.is_enabled(c::POLYGON_STIPPLE);
        }
        if stale(Touch::TEXTURE) {
            // Shaders sample a texture whether or not its target is enabled.
            let sampled = !self.in_use.program.is_zero()
                || !self.has.compatibility
                || gl.is_enabled(c::TEXTURE_2D);
            self.classification.texture = if sampled {
                TextureName(gl.get_integer(c::TEXTURE_BINDING_2D) as u32)
            } else {
                TextureName::ZERO
            };
        }
        if stale(Touch::MODELVIEW) && self.has.compatibility {
            self.classification.modelview = gl.get_matrix(c::MODELVIEW_MATRIX);
        }
        self.touched = self.touched.without(groups);
    }

    /// How much of the window the viewport covers.
    pub fn viewport_kind(&self) -> Viewport {
        let [_, _, width, height] = self.rectangles.viewport.map(i64::from);
        let small = |part: i64, whole: u32| part * 4 < i64::from(whole);
        if small(width, self.window.width) && small(height, self.window.height) {
            Viewport::Inset
        } else {
            Viewport::Main
        }
    }

    /// The kind of projection of the projection matrix.
    pub fn projection_kind(&self) -> Projection {
        let p = &self.matrices.projection;
        if [p[3], p[7], p[11]] != [0.0; 3] {
            Projection::Perspective
        } else if *p == glam::Mat4::IDENTITY.to_cols_array() {
            Projection::None
        } else {
            Projection::Orthographic
        }
    }
}

/// Where a near value of glDepthRange means that only a sky is drawn. Scenes use nearer ranges; that of Trigger Rally ends at 0.999.
const FAR: f32 = 0.99;

/// The part of the depth buffer between two values of glDepthRange.
fn depth_range([near, far]: [f32; 2]) -> DepthRange {
    match (near.min(far), near.max(far)) {
        (0.0, 1.0) => DepthRange::Whole,
        (FAR.., _) => DepthRange::Far,
        (0.0, _) => DepthRange::Near,
        _ => DepthRange::Part,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_ranges_have_words() {
        let cases = [
            ([0.0, 1.0], DepthRange::Whole),
            ([1.0, 0.0], DepthRange::Whole),
            ([1.0, 1.0], DepthRange::Far),
            ([0.999, 1.0], DepthRange::Far),
            ([1.0, 0.99], DepthRange::Far),
            ([0.98, 1.0], DepthRange::Part),
            ([0.0, 0.3], DepthRange::Near),
            ([0.0, 0.0], DepthRange::Near),
            ([0.3, 1.0], DepthRange::Part),
            ([0.5, 0.5], DepthRange::Part),
        ];
        for (values, want) in cases {
            assert_eq!(depth_range(values), want, "{values:?}");
        }
    }
}
