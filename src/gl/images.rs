//! Image units: textures that shaders load from and store to.

use super::consts as c;
use super::{Gl, TextureName};

/// What is bound to an image unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageUnit {
    unit: u32,
    /// The texture.
    pub texture: TextureName,
    level: i32,
    layered: bool,
    layer: i32,
    access: u32,
    format: u32,
}

impl ImageUnit {
    /// Whether shaders may store to it.
    pub fn is_written(&self) -> bool {
        self.access != c::READ_ONLY
    }
}

impl Gl {
    /// Whether shaders load from and store to images.
    pub fn has_images(&self) -> bool {
        self.since((4, 2), Some((3, 1))) || self.has_extension("GL_ARB_shader_image_load_store")
    }

    /// What is bound to an image unit, counted from 0; none where that is nothing.
    pub fn image_unit(&self, unit: u32) -> Option<ImageUnit> {
        let ask = |name| self.get_integers_indexed::<1>(name, unit)[0];
        let texture = TextureName(ask(c::IMAGE_BINDING_NAME) as u32);
        (!texture.is_zero()).then(|| ImageUnit {
            unit,
            texture,
            level: ask(c::IMAGE_BINDING_LEVEL),
            layered: ask(c::IMAGE_BINDING_LAYERED) != 0,
            layer: ask(c::IMAGE_BINDING_LAYER),
            access: ask(c::IMAGE_BINDING_ACCESS) as u32,
            format: ask(c::IMAGE_BINDING_FORMAT) as u32,
        })
    }

    /// glBindImageTexture of a texture in the place and the way of another one.
    pub fn bind_image(&self, like: &ImageUnit, texture: TextureName) {
        // SAFETY: no pointers.
        unsafe {
            self.real.glBindImageTexture(
                like.unit,
                texture.0,
                like.level,
                u8::from(like.layered),
                like.layer,
                like.access,
                like.format,
            )
        };
    }
}
