//! The layer's calls about textures.

use super::consts as c;
use super::{Gl, Object, PixelStore, Ptr, TextureName};

/// The store of a level of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level {
    /// Width, height, and layers or slices; all levels of an array have as many layers.
    pub size: [i32; 3],
    /// Internal format.
    pub internal: u32,
    depth: bool,
    stencil: bool,
    integer: bool,
    /// Bits of red or of depth, where the internal format may leave them open.
    bits: i32,
    samples: i32,
    fixed: bool,
}

impl Level {
    /// One of a renderbuffer.
    pub fn of_renderbuffer([internal, w, h, samples]: super::Storage) -> Level {
        Level {
            size: [w, h, 1],
            internal: internal as u32,
            depth: false,
            stencil: false,
            integer: false,
            bits: 0,
            samples,
            fixed: true,
        }
    }

    /// Whether its texels can be read as colours.
    pub fn has_colours(&self) -> bool {
        !(self.depth || self.stencil || self.integer)
    }

    /// The target of a texture with one layer of this kind, and that of one with many.
    pub fn layered(&self) -> (u32, u32) {
        match self.samples {
            0 => (c::TEXTURE_2D, c::TEXTURE_2D_ARRAY),
            _ => (c::TEXTURE_2D_MULTISAMPLE, c::TEXTURE_2D_MULTISAMPLE_ARRAY),
        }
    }

    /// Where an image of this kind is attached to a framebuffer, with the masks of what it holds.
    pub fn points(&self) -> &'static [(u32, u32)] {
        const COLOR: (u32, u32) = (c::COLOR_ATTACHMENT0, c::COLOR_BUFFER_BIT);
        const DEPTH: (u32, u32) = (c::DEPTH_ATTACHMENT, c::DEPTH_BUFFER_BIT);
        const STENCIL: (u32, u32) = (c::STENCIL_ATTACHMENT, c::STENCIL_BUFFER_BIT);
        match self.internal {
            c::DEPTH_COMPONENT
            | c::DEPTH_COMPONENT16
            | c::DEPTH_COMPONENT24
            | c::DEPTH_COMPONENT32
            | c::DEPTH_COMPONENT32F => &[DEPTH],
            c::DEPTH_STENCIL | c::DEPTH24_STENCIL8 | c::DEPTH32F_STENCIL8 => &[DEPTH, STENCIL],
            c::STENCIL_INDEX | c::STENCIL_INDEX8 => &[STENCIL],
            _ => &[COLOR],
        }
    }

    /// The internal format with its sizes, as drivers take one without; none where there is none to draw to.
    pub fn sized(&self) -> Option<u32> {
        Some(match self.internal {
            c::RGBA | 4 => c::RGBA8,
            c::RGB | 3 => c::RGB8,
            c::RED => c::R8,
            c::RG => c::RG8,
            c::SRGB => c::SRGB8,
            c::SRGB_ALPHA => c::SRGB8_ALPHA8,
            c::DEPTH_COMPONENT => c::DEPTH_COMPONENT24,
            c::DEPTH_STENCIL => c::DEPTH24_STENCIL8,
            ..=2 | c::ALPHA | c::LUMINANCE | c::LUMINANCE_ALPHA | c::INTENSITY => return None,
            sized => sized,
        })
    }

    /// The stores of renderbuffers that depths of this image may be copied to, which takes equal formats; a format without sizes leaves them
    /// to the driver.
    pub fn depth_storages(&self) -> [super::Storage; 2] {
        let [width, height, _] = self.size;
        let sized = match (self.internal, self.bits) {
            (c::DEPTH_COMPONENT, 16) => c::DEPTH_COMPONENT16,
            (c::DEPTH_COMPONENT, 32) => c::DEPTH_COMPONENT32,
            _ => self.sized().unwrap_or(self.internal),
        };
        [sized, self.internal].map(|format| [format as i32, width, height, self.samples])
    }

    /// The type that stands for the bits of an internal format without sizes, in OpenGL ES; none for one with sizes.
    fn unsized_type(&self) -> Option<u32> {
        Some(match (self.internal, self.bits) {
            (c::RGB, 5) => c::UNSIGNED_SHORT_5_6_5,
            (c::RGBA, 5) => c::UNSIGNED_SHORT_5_5_5_1,
            (c::RGBA, 4) => c::UNSIGNED_SHORT_4_4_4_4,
            (c::RGB | c::RGBA, 10) => c::UNSIGNED_INT_2_10_10_10_REV,
            (c::RGB | c::RGBA, 16) => c::HALF_FLOAT_OES,
            (c::RGB | c::RGBA, 32) => c::FLOAT,
            (c::DEPTH_COMPONENT, 16) => c::UNSIGNED_SHORT,
            (c::DEPTH_COMPONENT, _) => c::UNSIGNED_INT,
            (c::DEPTH_STENCIL, _) => c::UNSIGNED_INT_24_8,
            (
                c::RGB
                | c::RGBA
                | c::RED
                | c::RG
                | c::ALPHA
                | c::LUMINANCE
                | c::LUMINANCE_ALPHA
                | c::BGRA
                | c::SRGB
                | c::SRGB_ALPHA,
                _,
            ) => c::UNSIGNED_BYTE,
            _ => return None,
        })
    }

    /// A format and a type that go with the internal format; nothing is transferred.
    fn transfer(&self) -> (u32, u32) {
        match (self.depth, self.stencil, self.integer) {
            (true, true, _) if self.internal == c::DEPTH32F_STENCIL8 => {
                (c::DEPTH_STENCIL, c::FLOAT_32_UNSIGNED_INT_24_8_REV)
            }
            (true, true, _) => (c::DEPTH_STENCIL, c::UNSIGNED_INT_24_8),
            (true, false, _) => (c::DEPTH_COMPONENT, c::UNSIGNED_INT),
            (false, true, _) => (c::STENCIL_INDEX, c::UNSIGNED_BYTE),
            (false, false, true) => (c::RGBA_INTEGER, c::INT),
            (false, false, false) => (c::RGBA, c::UNSIGNED_BYTE),
        }
    }
}

/// Whether a texture target has samples, and so nothing that is set by glTexParameter.
pub fn is_multisampled(target: u32) -> bool {
    [c::TEXTURE_2D_MULTISAMPLE, c::TEXTURE_2D_MULTISAMPLE_ARRAY].contains(&target)
}

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

    /// The target of a texture (glGetTextureParameteriv); OpenGL 4.5 or GL_ARB_direct_state_access is needed.
    pub fn texture_target(&self, name: TextureName) -> u32 {
        let mut v = 0i32;
        // SAFETY: room for one value.
        unsafe {
            self.real
                .glGetTextureParameteriv(name.0, c::TEXTURE_TARGET, (&raw mut v).cast())
        };
        v as u32
    }

    /// The mipmap levels of the texture bound at a target, from the first one on, as far as there are any. No level is asked for that cannot
    /// be: that would be an error.
    pub fn tex_levels(&self, target: u32) -> Vec<Level> {
        let Some(first) = self.tex_level(target, 0) else {
            return Vec::new();
        };
        let [w, h, d] = first.size;
        let longest = match target {
            c::TEXTURE_3D => w.max(h).max(d),
            c::TEXTURE_RECTANGLE => 1,
            _ if is_multisampled(target) => 1,
            _ => w.max(h),
        };
        let last = longest.max(1).ilog2() as i32;
        let more = (1..=last).map_while(|at| self.tex_level(target, at));
        std::iter::once(first).chain(more).collect()
    }

    /// What a level of the texture bound at a target is, if there is one; of a cube map its first face.
    pub fn tex_level(&self, target: u32, level: i32) -> Option<Level> {
        // OpenGL ES 3.0 does not say.
        if !self.since((1, 0), Some((3, 1))) {
            return None;
        }
        let plane = match target {
            c::TEXTURE_CUBE_MAP => c::TEXTURE_CUBE_MAP_POSITIVE_X,
            other => other,
        };
        let ask = |name| self.get_tex_level_parameter(plane, level, name);
        let size = [c::TEXTURE_WIDTH, c::TEXTURE_HEIGHT, c::TEXTURE_DEPTH].map(ask);
        if size[0] <= 0 {
            return None;
        }
        let sampled = self.since((3, 2), Some((3, 1))) && is_multisampled(target);
        let internal = ask(c::TEXTURE_INTERNAL_FORMAT) as u32;
        let depth = ask(c::TEXTURE_DEPTH_SIZE);
        Some(Level {
            size,
            internal,
            bits: match depth {
                0 if self.is_es() => ask(c::TEXTURE_RED_SIZE),
                bits => bits,
            },
            depth: depth > 0,
            stencil: self.version() >= (3, 0) && ask(c::TEXTURE_STENCIL_SIZE) > 0,
            integer: self.version() >= (3, 0)
                && [c::INT, c::UNSIGNED_INT].contains(&(ask(c::TEXTURE_RED_TYPE) as u32)),
            samples: if sampled { ask(c::TEXTURE_SAMPLES) } else { 0 },
            fixed: sampled && ask(c::TEXTURE_FIXED_SAMPLE_LOCATIONS) != 0,
        })
    }

    /// glTexImage* of a level of the texture bound at a target, without data. No unpack buffer may be bound.
    pub fn tex_level_empty(&self, target: u32, level: i32, like: &Level) {
        let (format, kind) = match like.unsized_type() {
            Some(kind) if self.is_es() => (like.internal, kind),
            _ => like.transfer(),
        };
        let (internal, [w, h, d]) = (like.internal as i32, like.size);
        let real = self.real;
        let plane = |plane: u32| {
            // SAFETY: no data is read.
            unsafe {
                real.glTexImage2D(
                    plane,
                    level,
                    internal,
                    w,
                    h,
                    0,
                    format,
                    kind,
                    core::ptr::null_mut(),
                )
            }
        };
        let none = core::ptr::null_mut();
        match target {
            c::TEXTURE_CUBE_MAP => (0..6).for_each(|f| plane(c::TEXTURE_CUBE_MAP_POSITIVE_X + f)),
            // SAFETY: as above.
            c::TEXTURE_1D => unsafe {
                real.glTexImage1D(target, level, internal, w, 0, format, kind, none)
            },
            c::TEXTURE_3D | c::TEXTURE_2D_ARRAY | c::TEXTURE_CUBE_MAP_ARRAY => {
                // SAFETY: as above.
                unsafe {
                    real.glTexImage3D(target, level, internal, w, h, d, 0, format, kind, none)
                }
            }
            c::TEXTURE_2D_MULTISAMPLE => {
                let fixed = u8::from(like.fixed);
                // SAFETY: no pointers.
                unsafe {
                    real.glTexImage2DMultisample(target, like.samples, like.internal, w, h, fixed)
                }
            }
            c::TEXTURE_2D_MULTISAMPLE_ARRAY => {
                self.tex_image_3d_multisample(like.samples, like.internal, like.size, like.fixed);
            }
            _ => plane(target),
        }
    }

    /// A store for these levels of the texture bound at a target, from 0 on and without data. No unpack buffer may be bound.
    /// With `immutable` there can be no further levels.
    pub fn tex_levels_empty(&self, target: u32, levels: &[Level], immutable: bool) {
        let Some(first) = levels.first() else {
            return;
        };
        // glTexImage* of OpenGL ES wants the very format and type that go with the internal format.
        let kind = first.unsized_type();
        if !immutable && (!self.is_es() || kind.is_some()) {
            for (at, level) in (0..).zip(levels) {
                self.tex_level_empty(target, at, level);
            }
            return;
        }
        let internal = first.internal;
        let ([w, h, d], fixed) = (first.size, u8::from(first.fixed));
        // With levels that are still to be made: no more can be added.
        let longest = match target {
            c::TEXTURE_3D => w.max(h).max(d),
            _ => w.max(h),
        };
        let count = match immutable {
            true => levels.len() as i32,
            false => longest.max(1).ilog2() as i32 + 1,
        };
        let real = self.real;
        // SAFETY: no pointers.
        unsafe {
            match target {
                c::TEXTURE_2D_MULTISAMPLE => {
                    real.glTexStorage2DMultisample(target, first.samples, internal, w, h, fixed)
                }
                c::TEXTURE_2D_MULTISAMPLE_ARRAY => {
                    real.glTexStorage3DMultisample(target, first.samples, internal, w, h, d, fixed)
                }
                c::TEXTURE_3D | c::TEXTURE_2D_ARRAY | c::TEXTURE_CUBE_MAP_ARRAY => {
                    real.glTexStorage3D(target, count, internal, w, h, d)
                }
                c::TEXTURE_1D => real.glTexStorage1D(target, count, internal, w),
                _ => real.glTexStorage2D(target, count, internal, w, h),
            }
        };
    }

    /// Whether the texture bound at a target has a store that cannot be replaced (glTexStorage).
    pub fn is_immutable(&self, target: u32) -> bool {
        self.since((4, 2), Some((3, 0)))
            && self.get_tex_parameter(target, c::TEXTURE_IMMUTABLE_FORMAT) != 0
    }

    /// glTexImage2D of level 0 of RGBA8 without data. No unpack buffer may be bound.
    pub fn tex_image_rgba8_empty(&self, target: u32, w: i32, h: i32) {
        let level = Level {
            size: [w, h, 1],
            internal: c::RGBA8,
            depth: false,
            stencil: false,
            integer: false,
            bits: 0,
            samples: 0,
            fixed: false,
        };
        self.tex_level_empty(target, 0, &level);
    }

    /// Immutable layers for `levels` levels, without data, of the array texture that is bound; `like` is one layer of level 0.
    pub fn tex_storage_layers(
        &self,
        target: u32,
        levels: i32,
        internal: u32,
        layers: u32,
        like: &Level,
    ) {
        let [w, h, _] = like.size;
        let layers = layers as i32;
        // SAFETY: no pointers.
        unsafe {
            if is_multisampled(target) {
                let fixed = u8::from(like.fixed);
                self.real.glTexStorage3DMultisample(
                    target,
                    like.samples,
                    internal,
                    w,
                    h,
                    layers,
                    fixed,
                );
            } else {
                self.real
                    .glTexStorage3D(target, levels, internal, w, h, layers);
            }
        }
    }

    /// glTextureView of all levels of one layer as a texture of its own.
    pub fn texture_view(
        &self,
        target: u32,
        of: TextureName,
        internal: u32,
        levels: i32,
        layer: u32,
    ) -> TextureName {
        let name = self.gen_texture();
        let levels = levels.max(1).unsigned_abs();
        // SAFETY: no pointers.
        unsafe {
            self.real
                .glTextureView(name.0, target, of.0, internal, 0, levels, layer, 1)
        };
        name
    }

    /// glCopyImageSubData of a level of one layer; a name, a target and a layer each.
    pub fn copy_layer(
        &self,
        (from, from_target, from_layer): (Object, u32, u32),
        (to, to_target, to_layer): (Object, u32, u32),
        level: i32,
        [w, h]: [i32; 2],
    ) {
        let (from_layer, to_layer) = (from_layer as i32, to_layer as i32);
        // SAFETY: no pointers.
        unsafe {
            self.real.glCopyImageSubData(
                from.name(),
                from_target,
                level,
                0,
                0,
                from_layer,
                to.name(),
                to_target,
                level,
                0,
                0,
                to_layer,
                w,
                h,
                1,
            )
        };
    }

    /// glCopyImageSubData of a whole level: width, height and layers. `target` is GL_RENDERBUFFER for those.
    pub fn copy_image(
        &self,
        target: u32,
        level: i32,
        from: Object,
        to: Object,
        [w, h, d]: [i32; 3],
    ) {
        let (from, to) = (from.name(), to.name());
        // SAFETY: no pointers.
        unsafe {
            self.real.glCopyImageSubData(
                from, target, level, 0, 0, 0, to, target, level, 0, 0, 0, w, h, d,
            )
        };
    }

    /// glCopyImageSubData of a rectangle of the first layer, over its whole height, to another column of the same.
    pub fn copy_inside(
        &self,
        (name, target): (TextureName, u32),
        (from, to): (i32, i32),
        [w, h]: [i32; 2],
    ) {
        // SAFETY: no pointers.
        unsafe {
            self.real.glCopyImageSubData(
                name.0, target, 0, from, 0, 0, name.0, target, 0, to, 0, 0, w, h, 1,
            )
        };
    }

    /// glGetTexParameterfv; of what has one value the first.
    pub fn tex_parameter_floats(&self, target: u32, name: u32) -> [f32; 4] {
        let mut v = [0f32; 4];
        let p = v.as_mut_ptr().cast();
        // SAFETY: room for 4 values.
        unsafe { self.real.glGetTexParameterfv(target, name, p) };
        v
    }

    /// glTexParameterf
    pub fn tex_parameterf(&self, target: u32, name: u32, value: f32) {
        // SAFETY: no pointers.
        unsafe { self.real.glTexParameterf(target, name, value) };
    }

    /// glTexParameterfv of GL_TEXTURE_BORDER_COLOR.
    pub fn set_border_color(&self, target: u32, v: &[f32; 4]) {
        // SAFETY: 4 values.
        unsafe {
            self.real
                .glTexParameterfv(target, c::TEXTURE_BORDER_COLOR, v.as_ptr() as Ptr)
        };
    }

    /// glGenerateMipmap
    pub fn generate_mipmap(&self, target: u32) {
        // SAFETY: no pointers.
        unsafe { self.real.glGenerateMipmap(target) };
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

    /// glTexImage3DMultisample, or what OpenGL ES has instead of it.
    pub fn tex_image_3d_multisample(
        &self,
        samples: i32,
        format: u32,
        [w, h, d]: [i32; 3],
        fixed: bool,
    ) {
        let (target, fixed) = (c::TEXTURE_2D_MULTISAMPLE_ARRAY, u8::from(fixed));
        let real = self.real;
        // SAFETY: no pointers.
        unsafe {
            if self.is_es() {
                real.glTexStorage3DMultisample(target, samples, format, w, h, d, fixed);
            } else {
                real.glTexImage3DMultisample(target, samples, format, w, h, d, fixed);
            }
        }
    }

    /// glTexImage2D with a whole picture of bytes, 4 channels.
    pub fn tex_image_rgba8ui(&self, _: &PixelStore, w: i32, h: i32, data: &[[u8; 4]]) {
        if data.len() < w as usize * h as usize {
            return;
        }
        // SAFETY: w·h texels of 4 bytes (checked); without gaps, from no buffer (`PixelStore`).
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
    pub fn tex_image_rgba16ui(&self, _: &PixelStore, w: i32, h: i32, data: &[[u16; 4]]) {
        if data.len() < w as usize * h as usize {
            return;
        }
        // SAFETY: w·h texels of 8 bytes (checked); without gaps, from no buffer (`PixelStore`).
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

    /// glTexImage2D with a whole picture of signed 16-bit words.
    pub fn tex_image_r16i(&self, _: &PixelStore, w: i32, h: i32, data: &[i16]) {
        if data.len() < w as usize * h as usize {
            return;
        }
        // SAFETY: w·h texels of 2 bytes (checked); without gaps, from no buffer (`PixelStore`).
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
}
