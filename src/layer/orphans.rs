//! Orphaned GL objects: a destroyed context leaves them in its share group, and another context of the group deletes them.

use super::{Layer, Member};
use crate::gl::{FramebufferName, Gl, Held, Object, consts as c};
use crate::offscreen::Images;
use crate::state::Orphans;

impl Layer {
    /// The context is destroyed: leaves the objects that its share group keeps to the other contexts.
    pub fn leave(mut self: Box<Self>) {
        let mut lists = self.session.group.lists();
        let of_panels = self.targets.interleaver.textures();
        let atlases = || self.atlases().chain(self.canvases.atlases());
        for atlas in atlases() {
            lists.orphans.framebuffers.extend(atlas.framebuffers());
        }
        let framebuffers = self.targets.offscreen.framebuffers();
        lists.orphans.framebuffers.extend(framebuffers);
        let textures = atlases().flat_map(|atlas| atlas.textures());
        let textures = textures.copied();
        let textures = textures.chain(of_panels);
        lists.orphans.textures.extend(textures);
        let parked = self.canvases.atlases_mut();
        for atlas in std::iter::once(&mut self.targets.atlas).chain(parked) {
            let (buffer, fence) = atlas.give_buffer();
            lists.orphans.buffers.extend(buffer);
            lists.orphans.fences.extend(fence);
        }
        lists
            .orphans
            .buffers
            .extend(self.write_bindings.take_buffers());
        if let Some(panel) = &mut self.targets.panel {
            let (buffers, fences) = panel.give_buffers();
            lists.orphans.buffers.extend(buffers);
            lists.orphans.fences.extend(fences);
            lists.orphans.framebuffers.push(panel.framebuffer());
            lists.orphans.textures.push(panel.texture());
        }
        if let Some(osd) = &self.targets.osd {
            lists.orphans.framebuffers.push(osd.framebuffer());
            lists.orphans.textures.push(osd.texture());
        }
        if let Some(samples) = self.points.samples() {
            lists.orphans.framebuffers.extend(samples.framebuffers());
            lists.orphans.textures.extend(samples.textures());
        }
        lists
            .orphans
            .buffers
            .extend(self.points.surfaces.take_buffers());
        let programs = self
            .targets
            .interleaver
            .programs()
            .chain(self.variants.programs.names());
        let programs = programs.chain(self.variants.own.names());
        let programs = programs.chain(self.synthesis.programs());
        let programs = programs.chain(self.points.programs());
        lists.orphans.programs.extend(programs);
        let accumulated = std::iter::once(&self.targets.accumulated);
        let accumulated = accumulated.chain(self.canvases.accumulated());
        for accumulation in accumulated.flat_map(|accumulated| &accumulated.buffer) {
            lists.orphans.framebuffers.push(accumulation.framebuffer());
            lists.orphans.textures.extend(accumulation.textures());
            lists.orphans.programs.extend(accumulation.programs());
        }
    }
}

/// Deletes the objects that destroyed contexts of the share group have orphaned.
pub(super) fn delete_orphans(gl: &Gl, group: &Member) {
    let orphans = std::mem::take(&mut group.lists().orphans);
    if !orphans.framebuffers.is_empty() {
        let bound = FramebufferName(gl.get_integer(c::DRAW_FRAMEBUFFER_BINDING) as u32);
        for &framebuffer in &orphans.framebuffers {
            // A driver need not share framebuffer objects: the name may be one of the program's by now.
            if is_attached(gl, framebuffer, &orphans, &group.images()) {
                Held::Framebuffer.count(1);
                gl.delete_framebuffer(framebuffer);
            }
        }
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, bound);
    }
    // The objects were counted with the context that made them, which is gone: 1 for each balances the count of its deletion.
    for texture in orphans.textures {
        Held::Texture.count(1);
        gl.delete_texture(texture);
    }
    for buffer in orphans.buffers {
        Held::Buffer.count(1);
        gl.delete_buffer(buffer);
    }
    orphans.fences.into_iter().for_each(|f| gl.delete_fence(f));
    for program in orphans.programs {
        Held::Shader.count(1);
        gl.delete_program(program);
    }
}

/// Whether a texture or renderbuffer of ours is attached to a framebuffer object. Changes the draw framebuffer.
fn is_attached(gl: &Gl, framebuffer: FramebufferName, orphans: &Orphans, images: &Images) -> bool {
    if gl.is_framebuffer(framebuffer) == 0 {
        return false;
    }
    gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer);
    let attachments = gl.attachments(c::DRAW_FRAMEBUFFER);
    attachments.iter().any(|a| {
        images.owns(a.object)
            || matches!(a.object, Object::Texture(name) if orphans.textures.contains(&name))
    })
}
