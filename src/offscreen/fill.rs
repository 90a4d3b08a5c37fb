//! Copies the contents of an image to another one of the same format.

use crate::gl::{Attachment, Gl, Level, Object, consts as c};

/// Copies a level of an object to the same level of another. Both have the same target; it is GL_RENDERBUFFER for renderbuffers. Before
/// OpenGL 4.3 or OpenGL ES 3.2 this uses framebuffers, whose bindings are changed.
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
    let scissor = gl.is_enabled(c::SCISSOR_TEST);
    if scissor {
        gl.switch_scissor_test(false);
    }
    for layer in 0..layers {
        for &(point, mask) in level.points() {
            let [source, destination] = [from, to].map(|object| {
                let name = gl.gen_framebuffer();
                let face = match target {
                    c::TEXTURE_CUBE_MAP => c::TEXTURE_CUBE_MAP_POSITIVE_X + layer.unsigned_abs(),
                    _ => 0,
                };
                let like = Attachment {
                    point,
                    object,
                    level: at,
                    face,
                    layer,
                    layered: false,
                };
                gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, name);
                gl.attach_like(&like, object, target);
                name
            });
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, source);
            let [w, h] = [w, h].map(i32::unsigned_abs);
            gl.blit(&[0, 0, w, h, 0, 0, w, h, mask, c::NEAREST], 0, 0);
            gl.delete_framebuffer(source);
            gl.delete_framebuffer(destination);
        }
    }
    if scissor {
        gl.switch_scissor_test(true);
    }
}
