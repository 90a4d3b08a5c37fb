//! The program's own framebuffers: what is attached to them, and others like them.

use super::consts as c;
use super::{Gl, Held, RenderbufferName, TextureName};

/// An image at an attachment point of a framebuffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attachment {
    /// Such as GL_COLOR_ATTACHMENT0.
    pub point: u32,
    /// The texture or renderbuffer.
    pub object: Object,
    /// Level of the texture.
    pub level: i32,
    /// Such as GL_TEXTURE_CUBE_MAP_POSITIVE_X, or 0.
    pub face: u32,
    /// Layer of an array or slice of a volume.
    pub layer: i32,
    /// All layers.
    pub layered: bool,
}

/// What images belong to, by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Object {
    /// A texture.
    Texture(TextureName),
    /// A renderbuffer.
    Renderbuffer(RenderbufferName),
}

impl Object {
    /// Its name where it is a texture.
    pub fn texture(self) -> Option<TextureName> {
        match self {
            Object::Texture(name) => Some(name),
            Object::Renderbuffer(_) => None,
        }
    }

    /// As the driver takes it.
    pub(super) fn name(self) -> u32 {
        match self {
            Object::Texture(name) => name.0,
            Object::Renderbuffer(name) => name.0,
        }
    }
}

/// The store of a renderbuffer: internal format, width, height, samples.
pub type Storage = [i32; 4];

impl Gl {
    /// What is attached to the framebuffer bound at `target`, which is not 0.
    pub fn attachments(&self, target: u32) -> Vec<Attachment> {
        let colours = self.get_integer(c::MAX_COLOR_ATTACHMENTS).clamp(1, 32) as u32;
        let points = (0..colours).map(|at| c::COLOR_ATTACHMENT0 + at);
        let points = points.chain([c::DEPTH_ATTACHMENT, c::STENCIL_ATTACHMENT]);
        points
            .filter_map(|point| self.attachment(target, point))
            .collect()
    }

    fn attachment(&self, target: u32, point: u32) -> Option<Attachment> {
        let ask = |name| {
            let mut v = 0i32;
            // SAFETY: room for one value.
            unsafe {
                self.real.glGetFramebufferAttachmentParameteriv(
                    target,
                    point,
                    name,
                    (&raw mut v).cast(),
                )
            };
            v
        };
        let kind = ask(c::FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) as u32;
        let name = |wanted| match kind == wanted {
            true => Some(ask(c::FRAMEBUFFER_ATTACHMENT_OBJECT_NAME) as u32),
            false => None,
        };
        let plain = |object| Attachment {
            point,
            object,
            level: 0,
            face: 0,
            layer: 0,
            layered: false,
        };
        if let Some(name) = name(c::RENDERBUFFER) {
            return Some(plain(Object::Renderbuffer(RenderbufferName(name))));
        }
        let name = name(c::TEXTURE)?;
        Some(Attachment {
            level: ask(c::FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL),
            face: ask(c::FRAMEBUFFER_ATTACHMENT_TEXTURE_CUBE_MAP_FACE) as u32,
            layer: ask(c::FRAMEBUFFER_ATTACHMENT_TEXTURE_LAYER),
            layered: self.since((3, 2), Some((3, 2)))
                && ask(c::FRAMEBUFFER_ATTACHMENT_LAYERED) != 0,
            ..plain(Object::Texture(TextureName(name)))
        })
    }

    /// Attaches an object to the framebuffer bound for drawing in the way that `like` is attached to its own. `target` is that of the
    /// texture.
    pub fn attach_like(&self, like: &Attachment, object: Object, target: u32) {
        let (to, point) = (c::DRAW_FRAMEBUFFER, like.point);
        // SAFETY: no pointers.
        unsafe {
            match object {
                Object::Renderbuffer(name) => {
                    self.real
                        .glFramebufferRenderbuffer(to, point, c::RENDERBUFFER, name.0)
                }
                Object::Texture(name) if like.layered => self
                    .real
                    .glFramebufferTexture(to, point, name.0, like.level),
                Object::Texture(name) if has_layers(target) => self
                    .real
                    .glFramebufferTextureLayer(to, point, name.0, like.level, like.layer),
                Object::Texture(name) if target == c::TEXTURE_1D => self
                    .real
                    .glFramebufferTexture1D(to, point, target, name.0, like.level),
                Object::Texture(name) => {
                    let plane = if like.face == 0 { target } else { like.face };
                    self.real
                        .glFramebufferTexture2D(to, point, plane, name.0, like.level)
                }
            }
        }
    }

    /// The store of the renderbuffer that is bound.
    pub fn renderbuffer_storage(&self) -> Storage {
        let names = [
            c::RENDERBUFFER_INTERNAL_FORMAT,
            c::RENDERBUFFER_WIDTH,
            c::RENDERBUFFER_HEIGHT,
            c::RENDERBUFFER_SAMPLES,
        ];
        names.map(|name| {
            let mut v = 0i32;
            // SAFETY: room for one value.
            unsafe {
                self.real
                    .glGetRenderbufferParameteriv(c::RENDERBUFFER, name, (&raw mut v).cast())
            };
            v
        })
    }

    /// A new renderbuffer with a store, which it leaves bound.
    pub fn renderbuffer(&self, [format, width, height, samples]: Storage) -> RenderbufferName {
        let name = self.gen_renderbuffer();
        // SAFETY: no pointers.
        unsafe {
            self.real.glBindRenderbuffer(c::RENDERBUFFER, name.0);
            if samples > 0 {
                self.real.glRenderbufferStorageMultisample(
                    c::RENDERBUFFER,
                    samples,
                    format as u32,
                    width,
                    height,
                );
            } else {
                self.real
                    .glRenderbufferStorage(c::RENDERBUFFER, format as u32, width, height);
            }
        }
        name
    }

    /// glBindRenderbuffer
    pub fn bind_renderbuffer(&self, name: RenderbufferName) {
        // SAFETY: no pointers.
        unsafe { self.real.glBindRenderbuffer(c::RENDERBUFFER, name.0) };
    }

    /// glDeleteRenderbuffers of one name that [`Gl::renderbuffer`] made.
    pub fn delete_renderbuffer(&self, name: RenderbufferName) {
        // SAFETY: one name.
        unsafe { self.real.glDeleteRenderbuffers(1, (&raw const name) as _) };
        Held::Framebuffer.count(-1);
    }
}

/// Whether images of such a texture are attached by their layer.
fn has_layers(target: u32) -> bool {
    matches!(
        target,
        c::TEXTURE_3D
            | c::TEXTURE_2D_ARRAY
            | c::TEXTURE_1D_ARRAY
            | c::TEXTURE_CUBE_MAP_ARRAY
            | c::TEXTURE_2D_MULTISAMPLE_ARRAY
    )
}
