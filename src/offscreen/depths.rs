//! Small copies of the depths that the own view of a framebuffer of the program's has, where the program draws its scene there.

use super::image::with_texture;
use super::{Offscreen, locked};
use crate::atlas::{inside, small_size};
use crate::gl::{
    Attachment, FramebufferName, Gl, Level, Object, RenderbufferName, Storage, consts as c,
};

/// A framebuffer with a renderbuffer for depths.
#[derive(Debug)]
struct Buffer {
    framebuffer: FramebufferName,
    renderbuffer: RenderbufferName,
    size: [i32; 2],
}

/// The copies of one framebuffer's depths: formats have to be equal where depths are copied.
#[derive(Debug)]
pub(super) struct SmallDepths {
    /// One sample a pixel, where the program's has several: those are resolved before they are scaled.
    resolved: Option<Buffer>,
    small: Buffer,
    /// Width and height of the program's depths, in pixels.
    size: [i32; 2],
}

impl Offscreen {
    /// Whether [`Offscreen::make_depths`] has something to do: the framebuffer is there, and was not asked for its depths since it changed.
    pub fn lacks_depths(&mut self, gl: &Gl, framebuffer: FramebufferName) -> bool {
        self.targets.contains_key(&framebuffer) && self.target(gl, framebuffer).depths.is_none()
    }

    /// Makes what [`Offscreen::shrink_depths`] copies the depths of a framebuffer to. Changes the framebuffer bindings; the scissor test must be off, and the caller preserves errors.
    pub fn make_depths(&mut self, gl: &Gl, framebuffer: FramebufferName) {
        let from = self.view(gl, framebuffer, self.tiles.own());
        let depth = |a: &&Attachment| a.point == c::DEPTH_ATTACHMENT;
        let attachments = &self.target(gl, framebuffer).attachments;
        let attachment = attachments.iter().find(depth).copied();
        let level = attachment.and_then(|attachment| self.level(gl, &attachment));
        let storages = level.map(|level| level.depth_storages());
        let made = storages.into_iter().flatten().find_map(|storage| {
            let made = SmallDepths::new(gl, storage);
            made.take(gl, from, [0; 4]);
            if made.is_complete(gl) && gl.get_error() == c::NO_ERROR {
                return Some(made);
            }
            gl.drop_errors();
            made.delete(gl);
            None
        });
        self.target(gl, framebuffer).depths = Some(made);
    }

    /// The driver has refused something of what [`Offscreen::make_depths`] made, or to read it: no depths of this framebuffer are taken.
    pub fn refuse_depths(&mut self, gl: &Gl, framebuffer: FramebufferName) {
        if let Some(made) = self.target(gl, framebuffer).depths.replace(None).flatten() {
            made.delete(gl);
        }
    }

    /// Copies the depths that the own view of a framebuffer has now in a part of it (left, bottom, right, top in pixels), by the nearest pixel,
    /// to a framebuffer, and returns that with its width and height. None where there are no depths, or none whose format the driver tells. Changes the framebuffer bindings; the scissor test
    /// must be off.
    pub fn shrink_depths(
        &mut self,
        gl: &Gl,
        framebuffer: FramebufferName,
        area: [i32; 4],
    ) -> Option<(FramebufferName, [i32; 2])> {
        let own = self.tiles.own();
        let there = self.targets.contains_key(&framebuffer);
        let from = there.then(|| self.view(gl, framebuffer, own))?;
        let depths = self.targets.get(&framebuffer)?.depths.as_ref()?.as_ref()?;
        depths.take(gl, from, area);
        Some((depths.small.framebuffer, depths.small.size))
    }

    /// The store of an attached image.
    fn level(&self, gl: &Gl, attachment: &Attachment) -> Option<Level> {
        match attachment.object {
            Object::Renderbuffer(name) => {
                let before = RenderbufferName(gl.get_integer(c::RENDERBUFFER_BINDING) as u32);
                gl.bind_renderbuffer(name);
                let storage = gl.renderbuffer_storage();
                gl.bind_renderbuffer(before);
                Some(Level::of_renderbuffer(storage))
            }
            Object::Texture(name) => {
                let target = locked(&self.images).target_of(gl, &self.support, name);
                with_texture(gl, name, target, |target| {
                    gl.tex_level(target, attachment.level)
                })?
            }
        }
    }
}

impl SmallDepths {
    fn new(gl: &Gl, [format, width, height, samples]: Storage) -> SmallDepths {
        let small = Buffer::new(
            gl,
            format,
            small_size([width, height].map(i32::unsigned_abs)),
        );
        let resolved = (samples > 0).then(|| Buffer::new(gl, format, [width, height]));
        SmallDepths {
            resolved,
            small,
            size: [width, height],
        }
    }

    /// Whether the driver draws to framebuffers of that format.
    fn is_complete(&self, gl: &Gl) -> bool {
        self.buffers().all(|buffer| buffer.is_complete(gl))
    }

    /// Copies the depths of a part of a framebuffer.
    fn take(&self, gl: &Gl, from: FramebufferName, area: [i32; 4]) {
        let [width, height] = self.size;
        let from = match &self.resolved {
            Some(resolved) => {
                resolved.take(gl, from, [0, 0, width, height]);
                resolved.framebuffer
            }
            None => from,
        };
        self.small.take(gl, from, inside(area, self.size));
    }

    fn buffers(&self) -> impl Iterator<Item = &Buffer> {
        self.resolved.iter().chain([&self.small])
    }

    /// The framebuffers, which belong to the layer.
    pub(super) fn framebuffers(&self) -> impl Iterator<Item = FramebufferName> {
        self.buffers().map(|buffer| buffer.framebuffer)
    }

    /// Deletes the framebuffers and their renderbuffers; only while the context is current.
    pub(super) fn delete(self, gl: &Gl) {
        for buffer in self.buffers() {
            gl.delete_framebuffer(buffer.framebuffer);
            gl.delete_renderbuffer(buffer.renderbuffer);
        }
    }
}

impl Buffer {
    /// Changes the framebuffer bindings.
    fn new(gl: &Gl, format: i32, size: [i32; 2]) -> Buffer {
        let before = RenderbufferName(gl.get_integer(c::RENDERBUFFER_BINDING) as u32);
        let renderbuffer = gl.renderbuffer([format, size[0], size[1], 0]);
        gl.bind_renderbuffer(before);
        let framebuffer = gl.gen_framebuffer();
        gl.bind_framebuffer(c::FRAMEBUFFER, framebuffer);
        let depth = Attachment {
            point: c::DEPTH_ATTACHMENT,
            object: Object::Renderbuffer(renderbuffer),
            level: 0,
            face: 0,
            layer: 0,
            layered: false,
        };
        gl.attach_like(&depth, depth.object, c::RENDERBUFFER);
        gl.draw_buffers(&[c::NONE]);
        gl.read_buffer(c::NONE);
        Buffer {
            framebuffer,
            renderbuffer,
            size,
        }
    }

    fn is_complete(&self, gl: &Gl) -> bool {
        gl.bind_framebuffer(c::FRAMEBUFFER, self.framebuffer);
        gl.check_framebuffer_status(c::DRAW_FRAMEBUFFER) == c::FRAMEBUFFER_COMPLETE
    }

    /// Copies the depths between these corners, scaled by the nearest pixel.
    fn take(&self, gl: &Gl, from: FramebufferName, [left, bottom, right, top]: [i32; 4]) {
        let [w, h] = self.size;
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, self.framebuffer);
        let depth = c::DEPTH_BUFFER_BIT;
        gl.blit_framebuffer(left, bottom, right, top, 0, 0, w, h, depth, c::NEAREST);
    }
}
