//! Names of the layer's own textures.

use super::consts as c;
use super::{Gl, Held, PixelStore, Ptr, TextureName, shadow};

/// GL_RGBA32F
const RGBA32F: u32 = 0x8814;

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

    /// Replaces texels of layer 0 of the array texture that is bound, from the first column and a row on: width and height, and red, green, blue and alpha of each,
    /// rows bottom up.
    pub fn tex_sub_layer_rgba8(&self, _: &PixelStore, row: i32, [w, h]: [i32; 2], texels: &[u8]) {
        if texels.len() != w as usize * h as usize * 4 {
            return;
        }
        let (target, rgba) = (c::TEXTURE_2D_ARRAY, c::RGBA);
        let p = texels.as_ptr().cast_mut().cast();
        // SAFETY: w·h texels of four bytes, as many as there are; without gaps, in no buffer (`PixelStore`).
        unsafe {
            self.real
                .glTexSubImage3D(target, 0, 0, row, 0, w, h, 1, rgba, c::UNSIGNED_BYTE, p)
        };
    }

    /// glTexImage2D of RGBA with 32 bits each, level 0 of the 2D texture that is bound: w·h texels, row 0 first.
    pub fn tex_image_rgba32f(&self, _: &PixelStore, w: i32, h: i32, texels: &[[f32; 4]]) {
        if texels.len() < w as usize * h as usize {
            return;
        }
        let target = c::TEXTURE_2D;
        let p = texels.as_ptr() as Ptr;
        // SAFETY: w·h texels of 16 bytes (checked); without gaps, from no buffer (`PixelStore`).
        unsafe {
            self.real
                .glTexImage2D(target, 0, RGBA32F as i32, w, h, 0, c::RGBA, c::FLOAT, p)
        };
    }

    /// The same of the layers of the array texture that is bound, without contents.
    pub fn tex_layers_rgba32f(&self, w: i32, h: i32, layers: i32) {
        self.tex_storage_3d(RGBA32F, w, h, layers, c::RGBA, c::FLOAT);
    }
}
