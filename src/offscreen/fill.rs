//! Copies the contents of an image to another one of the same format.

use crate::gl::{Attachment, FramebufferName, Gl, Level, Object, consts as c};

/// A layer of a level of an object, whose target is GL_RENDERBUFFER for renderbuffers.
#[derive(Clone, Copy)]
pub(super) struct Layer {
    pub(super) object: Object,
    pub(super) target: u32,
    pub(super) layer: u32,
}

/// Copies a level of an object to the same level of another. Both have the same target; it is GL_RENDERBUFFER for renderbuffers. Before
/// OpenGL 4.3 or OpenGL ES 3.2 this uses framebuffers.
pub(super) fn fill(gl: &Gl, target: u32, (from, to): (Object, Object), at: i32, level: &Level) {
    let [w, h, depth] = level.size;
    let layers = if target == c::TEXTURE_CUBE_MAP {
        6
    } else {
        depth
    }
    .max(1);
    if gl.since((4, 3), Some((3, 2))) {
        return gl.copy_image(target, at, from, to, [w, h, layers]);
    }
    for layer in 0..layers.unsigned_abs() {
        let end = |object| Layer {
            object,
            target,
            layer,
        };
        blit(gl, [end(from), end(to)], at, level);
    }
}

/// Copies one layer of a level to a layer of another object, whose format is [`Level::sized`] of that of the first, or the other way round.
pub(super) fn copy_layer(gl: &Gl, [from, to]: [Layer; 2], at: i32, level: &Level) {
    // glCopyImageSubData takes a format without sizes for another one than any with sizes.
    let color = level
        .points()
        .iter()
        .any(|(_, mask)| *mask == c::COLOR_BUFFER_BIT);
    if color && level.sized() != Some(level.internal) {
        return blit(gl, [from, to], at, level);
    }
    let ends = [from, to].map(|end| (end.object, end.target, end.layer));
    let [w, h, _] = level.size;
    gl.copy_layer(ends[0], ends[1], at, [w, h]);
}

/// Copies one layer by framebuffers.
fn blit(gl: &Gl, ends: [Layer; 2], at: i32, level: &Level) {
    let bindings = [
        (c::DRAW_FRAMEBUFFER, c::DRAW_FRAMEBUFFER_BINDING),
        (c::READ_FRAMEBUFFER, c::READ_FRAMEBUFFER_BINDING),
    ]
    .map(|(target, binding)| (target, FramebufferName(gl.get_integer(binding) as u32)));
    let scissor = gl.is_enabled(c::SCISSOR_TEST);
    if scissor {
        gl.switch_scissor_test(false);
    }
    for &(point, mask) in level.points() {
        let [source, destination] = ends.map(|end| {
            let name = gl.gen_framebuffer();
            let face = match end.target {
                c::TEXTURE_CUBE_MAP => c::TEXTURE_CUBE_MAP_POSITIVE_X + end.layer,
                _ => 0,
            };
            let like = Attachment {
                point,
                object: end.object,
                level: at,
                face,
                layer: end.layer as i32,
                layered: false,
            };
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, name);
            gl.attach_like(&like, end.object, end.target);
            name
        });
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, source);
        let [w, h, _] = level.size.map(i32::unsigned_abs);
        gl.blit(&[0, 0, w, h, 0, 0, w, h, mask, c::NEAREST], 0, 0);
        gl.delete_framebuffer(source);
        gl.delete_framebuffer(destination);
    }
    for (target, name) in bindings {
        gl.bind_framebuffer(target, name);
    }
    if scissor {
        gl.switch_scissor_test(true);
    }
}
