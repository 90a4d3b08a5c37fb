//! The layer's calls about textures.

use super::consts as c;
use super::{Gl, Held, Ptr};

impl Gl {
    /// glGetTexParameteriv of one value.
    pub fn get_tex_parameter(&self, target: u32, name: u32) -> i32 {
        let mut v = [0i32; 4];
        // SAFETY: room for the most values that a name has.
        unsafe {
            self.real
                .glGetTexParameteriv(target, name, v.as_mut_ptr().cast())
        };
        v[0]
    }

    /// glGetTexEnvfv of one value.
    pub fn get_tex_env_float(&self, target: u32, name: u32) -> f32 {
        let mut v = [0f32; 4];
        // SAFETY: room for the most values that a name has.
        unsafe { self.real.glGetTexEnvfv(target, name, v.as_mut_ptr().cast()) };
        v[0]
    }

    /// glGetTexLevelParameteriv
    pub fn get_tex_level_parameter(&self, target: u32, level: i32, name: u32) -> i32 {
        let mut v = 0i32;
        // SAFETY: room for one value.
        unsafe {
            self.real
                .glGetTexLevelParameteriv(target, level, name, (&raw mut v).cast())
        };
        v
    }

    /// glTexImage2D of level 0 without data. No unpack buffer may be bound.
    pub fn tex_image_2d_empty(&self, target: u32, internal: u32, w: i32, h: i32, depth: bool) {
        let (format, kind) = if depth {
            (c::DEPTH_COMPONENT, c::UNSIGNED_INT)
        } else {
            (c::RGBA, c::UNSIGNED_BYTE)
        };
        // SAFETY: no data is read.
        unsafe {
            self.real.glTexImage2D(
                target,
                0,
                internal as i32,
                w,
                h,
                0,
                format,
                kind,
                core::ptr::null_mut(),
            )
        };
    }

    /// glCopyImageSubData of the whole level 0: width, height and layers.
    pub fn copy_image(&self, target: u32, from: u32, to: u32, [w, h, d]: [i32; 3]) {
        // SAFETY: no pointers.
        unsafe {
            self.real
                .glCopyImageSubData(from, target, 0, 0, 0, 0, to, target, 0, 0, 0, 0, w, h, d)
        };
    }

    /// glGetTexGeniv of one value; `coord` is GL_S to GL_Q.
    pub fn get_tex_gen(&self, coord: u32, name: u32) -> i32 {
        let mut v = [0i32; 4];
        // SAFETY: room for 4 elements.
        unsafe { self.real.glGetTexGeniv(coord, name, v.as_mut_ptr().cast()) };
        v[0]
    }

    /// glGetTexEnviv of one value of GL_TEXTURE_ENV.
    pub fn get_tex_env(&self, name: u32) -> i32 {
        let mut v = [0i32; 4];
        // SAFETY: room for 4 elements.
        unsafe {
            self.real
                .glGetTexEnviv(c::TEXTURE_ENV, name, v.as_mut_ptr().cast())
        };
        v[0]
    }

    /// glTexImage3D of an array texture without data.
    pub fn tex_storage_3d(&self, internal: u32, w: i32, h: i32, d: i32, format: u32, kind: u32) {
        // SAFETY: no data.
        unsafe {
            self.real.glTexImage3D(
                c::TEXTURE_2D_ARRAY,
                0,
                internal as i32,
                w,
                h,
                d,
                0,
                format,
                kind,
                core::ptr::null_mut(),
            )
        }
    }

    /// glTexImage2D with a whole picture of bytes, 4 channels; the unpack state must be the default.
    pub fn tex_image_rgba8ui(&self, w: i32, h: i32, data: &[[u8; 4]]) {
        if data.len() < w as usize * h as usize {
            return;
        }
        // SAFETY: w·h texels of 4 bytes (checked).
        unsafe {
            self.real.glTexImage2D(
                c::TEXTURE_2D,
                0,
                c::RGBA8UI as i32,
                w,
                h,
                0,
                c::RGBA_INTEGER,
                c::UNSIGNED_BYTE,
                data.as_ptr() as Ptr,
            )
        }
    }

    /// The same with 16-bit words.
    pub fn tex_image_rgba16ui(&self, w: i32, h: i32, data: &[[u16; 4]]) {
        if data.len() < w as usize * h as usize {
            return;
        }
        // SAFETY: w·h texels of 8 bytes (checked).
        unsafe {
            self.real.glTexImage2D(
                c::TEXTURE_2D,
                0,
                c::RGBA16UI as i32,
                w,
                h,
                0,
                c::RGBA_INTEGER,
                c::UNSIGNED_SHORT,
                data.as_ptr() as Ptr,
            )
        }
    }

    /// glTexImage2D with a whole picture of signed 16-bit words; the unpack state must be the default.
    pub fn tex_image_r16i(&self, w: i32, h: i32, data: &[i16]) {
        if data.len() < w as usize * h as usize {
            return;
        }
        // SAFETY: w·h texels of 2 bytes (checked), rows of any alignment.
        unsafe {
            self.real.glTexImage2D(
                c::TEXTURE_2D,
                0,
                c::R16I as i32,
                w,
                h,
                0,
                c::RED_INTEGER,
                c::SHORT,
                data.as_ptr() as Ptr,
            )
        }
    }

    /// glDeleteTextures of one name.
    pub fn delete_texture(&self, name: u32) {
        // SAFETY: one name.
        unsafe { self.real.glDeleteTextures(1, (&raw const name) as Ptr) };
        Held::Texture.count(-1);
    }
}
