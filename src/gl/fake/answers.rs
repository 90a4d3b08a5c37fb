//! What the driver answers about its state, and what attachments and levels of textures are made of.

use super::limits::{TEXTURES, default};
use super::memory::{Kind, address, read, write};
use super::{Call, Driver, Scope, limits::more as m, model};
use crate::gl::{FramebufferName, RenderbufferName, TextureName, VertexArrayName, consts as c};

impl Driver {
    /// Commands that ask, and those that make what is asked for; none for others.
    pub(super) fn ask(&mut self, call: &mut Call) -> Option<i64> {
        let (first, second) = (call.int(0) as u32, call.int(1) as u32);
        let kind = Kind::of(call.name);
        let (scope, name, place) = match call.name {
            "glGetError" => return Some(self.errors.pop_front().unwrap_or(c::NO_ERROR).into()),
            "glGetString" => return Some(self.string(first)),
            "glGetStringi" => {
                let name = self.extensions.get(second as usize);
                return Some(name.map_or(0, |name| name.as_ptr() as i64));
            }
            "glCheckFramebufferStatus" | "glCheckNamedFramebufferStatus" => {
                return Some(self.framebuffer_status.into());
            }
            "glFenceSync" => return Some(1),
            "glClientWaitSync" => return Some(c::CONDITION_SATISFIED.into()),
            "glIsEnabled" => {
                let on = self.known(self.state.scope(first), first, call)?;
                return Some((on != [0.0]).into());
            }
            "glIsEnabledi" => {
                let on = self.known(Scope::Index(second), first, call)?;
                return Some((on != [0.0]).into());
            }
            "glGetIntegerv" | "glGetFloatv" | "glGetBooleanv" | "glGetDoublev"
            | "glGetInteger64v"
                if first == c::NUM_EXTENSIONS =>
            {
                write(
                    address(call.args.get(1)),
                    kind,
                    &[self.extensions.len() as f64],
                );
                return Some(0);
            }
            "glGetIntegerv" | "glGetFloatv" | "glGetBooleanv" | "glGetDoublev"
            | "glGetInteger64v" => (self.state.scope(first), first, 1),
            "glGetIntegeri_v" | "glGetFloati_v" | "glGetBooleani_v" => {
                (Scope::Index(second), first, 2)
            }
            "glGetLightfv" => (Scope::Light(first), second, 2),
            "glGetMaterialfv" => (Scope::Face(first), second, 2),
            "glGetTexEnvfv" | "glGetTexEnviv" | "glGetTexGeniv" => {
                (self.state.scope(c::SAMPLER_BINDING), second, 2)
            }
            "glGetTexParameteriv" | "glGetTexParameterfv" => {
                (Scope::Texture(self.bound_texture(first)), second, 2)
            }
            "glGetVertexAttribiv" => {
                let array = self.state.int(Scope::Context, c::VERTEX_ARRAY_BINDING);
                (Scope::VertexArray(VertexArrayName(array)), second, 2)
            }
            "glGetQueryiv" => (Scope::Index(first), second, 2),
            "glGetPointerv" => {
                write(address(call.args.get(1)), Kind::I64, &[0.0]);
                return Some(0);
            }
            _ if call.name.starts_with("glGetQueryObject") => {
                let done = f64::from(second == c::QUERY_RESULT_AVAILABLE);
                write(address(call.args.get(2)), kind, &[done]);
                return Some(0);
            }
            "glGetTexLevelParameteriv" => {
                let level = Scope::Level(self.bound_texture(first), call.int(1) as i32);
                let values = self.state.get(level, call.int(2) as u32);
                let value = values.first().copied().unwrap_or(0.0);
                write(address(call.args.get(3)), kind, &[value]);
                return Some(0);
            }
            "glGetRenderbufferParameteriv" => {
                let bound = self.state.int(Scope::Context, c::RENDERBUFFER_BINDING);
                let values = self
                    .state
                    .get(Scope::Renderbuffer(RenderbufferName(bound)), second);
                let value = values.first().copied().unwrap_or(0.0);
                write(address(call.args.get(2)), kind, &[value]);
                return Some(0);
            }
            "glGetFramebufferAttachmentParameteriv" => {
                let value = self.attachment(first, second, call.int(2) as u32);
                write(address(call.args.get(3)), kind, &[value]);
                return Some(0);
            }
            _ => return self.make(call),
        };
        let values = self.known(scope, name, call)?;
        write(address(call.args.get(place)), kind, &values);
        Some(0)
    }

    /// A value that is set or that a new context has; a name that is neither is kept for the test to fail by.
    fn known(&mut self, scope: Scope, name: u32, call: &Call) -> Option<Vec<f64>> {
        let known = self.state.values.contains_key(&(scope, name)) || default(name).is_some();
        if !known {
            self.unknown
                .push(format!("{}{scope} ({})", model::name_of(name), call));
            return Some(vec![0.0]);
        }
        let values = self.state.get(scope, name);
        // A framebuffer object draws to the first attachment alone.
        let other = matches!(scope, Scope::Framebuffer(of) if !of.is_zero())
            && (c::DRAW_BUFFER0 + 1..=c::DRAW_BUFFER15).contains(&name);
        let set = self.state.values.contains_key(&(scope, name));
        Some(if other && !set { vec![0.0] } else { values })
    }

    fn string(&self, name: u32) -> i64 {
        let text = match name {
            c::VERSION => self.version.as_c_str(),
            c::SHADING_LANGUAGE_VERSION => self.glsl.as_c_str(),
            c::EXTENSIONS => self.extension_list.as_c_str(),
            c::VENDOR => c"fake",
            c::RENDERER => self.renderer.as_c_str(),
            _ => return 0,
        };
        text.as_ptr() as i64
    }

    fn bound_texture(&self, target: u32) -> TextureName {
        let cube = c::TEXTURE_CUBE_MAP_POSITIVE_X..=c::TEXTURE_CUBE_MAP_NEGATIVE_Z;
        let target = match cube.contains(&target) {
            true => c::TEXTURE_CUBE_MAP,
            false => target,
        };
        let found = TEXTURES.iter().find(|known| known.0 == target);
        found.map_or(TextureName::ZERO, |&(_, binding, _)| {
            TextureName(self.state.int(self.state.scope(binding), binding))
        })
    }

    fn bound_framebuffer(&self, target: u32) -> FramebufferName {
        let binding = match target {
            c::READ_FRAMEBUFFER => c::READ_FRAMEBUFFER_BINDING,
            _ => c::DRAW_FRAMEBUFFER_BINDING,
        };
        FramebufferName(self.state.int(Scope::Context, binding))
    }

    /// What is at an attachment point: kind, name, level, layer, whether all layers are, face of a cube.
    fn attachment(&self, target: u32, point: u32, name: u32) -> f64 {
        let framebuffer = self.bound_framebuffer(target);
        let at = self
            .state
            .values
            .get(&(Scope::Framebuffer(framebuffer), point));
        let element = |element: usize| at.and_then(|v| v.get(element)).copied().unwrap_or(0.0);
        match name {
            c::FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE if framebuffer.is_zero() => {
                m::FRAMEBUFFER_DEFAULT.into()
            }
            c::FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING => c::LINEAR.into(),
            c::FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE => c::UNSIGNED_NORMALIZED.into(),
            c::FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE => element(0),
            c::FRAMEBUFFER_ATTACHMENT_OBJECT_NAME => element(1),
            c::FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL => element(2),
            c::FRAMEBUFFER_ATTACHMENT_TEXTURE_LAYER => element(3),
            c::FRAMEBUFFER_ATTACHMENT_LAYERED => element(4),
            c::FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE if framebuffer.is_zero() => 24.0,
            c::FRAMEBUFFER_ATTACHMENT_RED_SIZE..=c::FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE
                if framebuffer.is_zero() =>
            {
                8.0
            }
            c::FRAMEBUFFER_ATTACHMENT_TEXTURE_CUBE_MAP_FACE => element(5),
            _ => 0.0,
        }
    }

    fn attach(&mut self, target: u32, point: u32, object: [u32; 6]) {
        let framebuffer = Scope::Framebuffer(self.bound_framebuffer(target));
        let points = match point {
            c::DEPTH_STENCIL_ATTACHMENT => vec![c::DEPTH_ATTACHMENT, c::STENCIL_ATTACHMENT],
            point => vec![point],
        };
        let object = match object {
            [_, 0, ..] => [0.0; 6],
            object => object.map(f64::from),
        };
        for point in points {
            self.put(framebuffer, point, &object);
        }
    }

    /// Attachments, stores and parameters of textures and renderbuffers; none for other commands.
    fn make(&mut self, call: &Call) -> Option<i64> {
        let int = |at: usize| call.int(at) as u32;
        let (first, second) = (int(0), int(1));
        match call.name {
            "glFramebufferTexture" => {
                let target = self
                    .state
                    .int(Scope::Texture(TextureName(int(2))), m::TEXTURE_TARGET);
                let plane = [c::TEXTURE_1D, c::TEXTURE_2D, c::TEXTURE_RECTANGLE];
                let one = target == c::TEXTURE_2D_MULTISAMPLE || plane.contains(&target);
                self.attach(
                    first,
                    second,
                    [c::TEXTURE, int(2), int(3), 0, u32::from(!one), 0],
                );
            }
            "glFramebufferTextureLayer" => {
                self.attach(first, second, [c::TEXTURE, int(2), int(3), int(4), 0, 0]);
            }
            "glFramebufferTexture1D" | "glFramebufferTexture2D" => {
                let cube = c::TEXTURE_CUBE_MAP_POSITIVE_X..=c::TEXTURE_CUBE_MAP_NEGATIVE_Z;
                let face = if cube.contains(&int(2)) { int(2) } else { 0 };
                self.attach(first, second, [c::TEXTURE, int(3), int(4), 0, 0, face]);
            }
            "glFramebufferRenderbuffer" => {
                self.attach(first, second, [c::RENDERBUFFER, int(3), 0, 0, 0, 0]);
            }
            "glRenderbufferStorage" | "glRenderbufferStorageMultisample" => {
                let bound = self.state.int(Scope::Context, c::RENDERBUFFER_BINDING);
                let multisampled = call.args.len() == 5;
                let from = 1 + usize::from(multisampled);
                let samples = if multisampled { second } else { 0 };
                for (name, value) in [
                    (c::RENDERBUFFER_INTERNAL_FORMAT, int(from)),
                    (c::RENDERBUFFER_WIDTH, int(from + 1)),
                    (c::RENDERBUFFER_HEIGHT, int(from + 2)),
                    (c::RENDERBUFFER_SAMPLES, samples),
                ] {
                    self.put(
                        Scope::Renderbuffer(RenderbufferName(bound)),
                        name,
                        &[value.into()],
                    );
                }
            }
            "glTexParameteri" | "glTexParameterf" => {
                let texture = Scope::Texture(self.bound_texture(first));
                self.put(texture, second, &[call.number(2)]);
            }
            "glTexParameterfv" | "glTexParameteriv" => {
                let texture = Scope::Texture(self.bound_texture(first));
                let count = default(second).map_or(1, |values| values.len());
                let values = read(address(call.args.get(2)), Kind::of(call.name), count);
                self.put(texture, second, &values);
            }
            "glTexImage1D" => self.level(first, second, int(2), [int(3), 1, 1], 0),
            "glTexImage2D" => self.level(first, second, int(2), [int(3), int(4), 1], 0),
            "glTexImage3D" => self.level(first, second, int(2), [int(3), int(4), int(5)], 0),
            "glTexImage2DMultisample" | "glTexStorage2DMultisample" => {
                self.level(first, 0, int(2), [int(3), int(4), 1], second);
            }
            "glTexImage3DMultisample" | "glTexStorage3DMultisample" => {
                self.level(first, 0, int(2), [int(3), int(4), int(5)], second);
            }
            "glTexStorage2D" | "glTexStorage3D" => {
                let mut size = [int(3), int(4), call.args.get(5).map_or(1, |_| int(5))];
                for level in 0..second {
                    self.level(first, level, int(2), size, 0);
                    size = [(size[0] / 2).max(1), (size[1] / 2).max(1), size[2]];
                }
            }
            _ => return None,
        }
        Some(0)
    }

    fn level(&mut self, target: u32, level: u32, internal: u32, size: [u32; 3], samples: u32) {
        let texture = self.bound_texture(target);
        let depth = matches!(
            internal,
            c::DEPTH_COMPONENT
                | c::DEPTH_COMPONENT16
                | c::DEPTH_COMPONENT24
                | c::DEPTH_COMPONENT32
                | c::DEPTH_COMPONENT32F
                | c::DEPTH24_STENCIL8
        );
        let stencil = internal == c::DEPTH24_STENCIL8;
        for (name, value) in [
            (c::TEXTURE_WIDTH, size[0]),
            (c::TEXTURE_HEIGHT, size[1]),
            (c::TEXTURE_DEPTH, size[2]),
            (c::TEXTURE_INTERNAL_FORMAT, internal),
            (c::TEXTURE_DEPTH_SIZE, if depth { 24 } else { 0 }),
            (c::TEXTURE_STENCIL_SIZE, if stencil { 8 } else { 0 }),
            (c::TEXTURE_RED_SIZE, if depth { 0 } else { 8 }),
            (c::TEXTURE_SAMPLES, samples),
            (c::TEXTURE_FIXED_SAMPLE_LOCATIONS, 1),
        ] {
            self.put(Scope::Level(texture, level as i32), name, &[value.into()]);
        }
    }
}
