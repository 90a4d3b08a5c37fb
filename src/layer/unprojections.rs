//! Matrices that unproject: inverses of the camera, of which each view has its own.

use crate::gl::BlockPlace;

/// The matrices by which a program computes positions from places on the screen, those of its vertices or of its fragments. Values are
/// column-major.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Unprojections {
    /// Plain uniforms, by their locations.
    pub(super) uniforms: Vec<(i32, [f32; 16])>,
    pub(super) in_blocks: Vec<(BlockPlace, [f32; 16])>,
}

impl Unprojections {
    pub(super) fn is_empty(&self) -> bool {
        self.uniforms.is_empty() && self.in_blocks.is_empty()
    }
}
