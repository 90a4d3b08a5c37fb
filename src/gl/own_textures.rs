//! Names of the layer's own textures.

use super::{Gl, Held, Ptr, TextureName, shadow};

impl Gl {
    /// A new name of a texture from glGenTextures.
    pub fn gen_texture(&self) -> TextureName {
        let mut name = TextureName::ZERO;
        // SAFETY: one name.
        unsafe { self.real.glGenTextures(1, (&raw mut name) as Ptr) };
        self.use_texture(name);
        name
    }

    /// The layer uses a name of a texture that is free, which counts as used in the driver once it is bound.
    pub fn use_texture(&self, name: TextureName) {
        shadow::texture_used(name);
        Held::Texture.count(1);
    }

    /// glDeleteTextures of one name of the layer's, if the program has not taken it.
    pub fn delete_texture(&self, name: TextureName) {
        Held::Texture.count(-1);
        if shadow::texture_left(name) {
            // SAFETY: one name.
            unsafe { self.real.glDeleteTextures(1, (&raw const name) as Ptr) };
        }
    }

    /// Frees a name for the program that the layer of another context uses. Framebuffers of that context keep the texture until it moves.
    pub fn free_texture(&self, name: TextureName) {
        shadow::texture_taken(name);
        // SAFETY: one name.
        unsafe { self.real.glDeleteTextures(1, (&raw const name) as Ptr) };
    }
}
