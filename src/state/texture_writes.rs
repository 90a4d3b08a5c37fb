//! Commands that write to textures.

use crate::gl::TextureName;

/// A command that writes to a texture, or copies to it from the read framebuffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextureWrite {
    /// Where it writes to.
    pub to: TextureAt,
    /// For a copy from the read framebuffer: the first column and the number of columns, in pixels.
    pub copied: Option<[i32; 2]>,
}

/// How a command tells the texture that it writes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextureAt {
    /// It is bound at this target of the active unit.
    Bound(u32),
    /// It is bound at a target of a unit, which is GL_TEXTURE0 and so on: the unit and the target.
    Unit(u32, u32),
    /// By its name.
    Named(TextureName),
}
