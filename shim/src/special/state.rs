//! State that the layer follows call by call, and queries of the program.

use crate::context::{draws_to_memory, enter, frame, peek, real, viewport_set, write_back_shared};
use crate::hooks::{before_uncompiled, compile, touch};
use manyview_core::gl::{FramebufferName, Ptr, TextureName, consts::PROGRAM_BINARY_FORMATS};
use manyview_core::state::{Command, Touch};

pub(crate) unsafe fn glMatrixMode(mode: u32) {
    let compiled = compile(Command::MatrixMode(mode), Touch::MODE);
    // SAFETY: the program's own call.
    unsafe { real().glMatrixMode(mode) };
    if !compiled {
        peek(|l| l.matrix_mode(mode));
    }
}

pub(crate) unsafe fn glViewport(x: i32, y: i32, width: i32, height: i32) {
    viewport_set(width, height);
    touch(Touch::RECTS);
    // SAFETY: the program's own call.
    unsafe { real().glViewport(x, y, width, height) };
}

pub(crate) unsafe fn glBindTexture(target: u32, texture: u32) {
    let name = TextureName(texture);
    if peek(|l| l.compiles() || l.owns_texture(name)) == Some(true) {
        enter(|gl, l| l.binds_texture(gl, name));
    }
    touch(Touch::TEXTURE);
    // SAFETY: the program's own call.
    unsafe { real().glBindTexture(target, texture) };
}

pub(crate) unsafe fn glDeleteTextures(n: i32, textures: Ptr) {
    before_uncompiled();
    let names = match usize::try_from(n) {
        // SAFETY: n names (the program's array).
        Ok(n) if !textures.is_null() => unsafe {
            core::slice::from_raw_parts(textures as *const TextureName, n)
        },
        _ => &[],
    };
    if names
        .iter()
        .any(|&name| peek(|l| l.owns_texture(name)) == Some(true))
    {
        enter(|gl, l| l.yield_names(gl));
    }
    enter(|gl, l| l.deleted_textures(gl, names));
    // Deleting a bound texture unbinds it.
    peek(|l| l.touch(Touch::TEXTURE));
    // SAFETY: the program's own call.
    unsafe { real().glDeleteTextures(n, textures) };
}

pub(crate) unsafe fn glPushAttrib(mask: u32) {
    // SAFETY: the program's own call.
    let mut push = || unsafe { real().glPushAttrib(mask) };
    if enter(|gl, l| l.push_attrib(gl, mask, &mut push)).is_none() {
        push();
    }
}

pub(crate) unsafe fn glPopAttrib() {
    // SAFETY: the program's own call.
    let mut pop = || unsafe { real().glPopAttrib() };
    if enter(|gl, l| l.pop_attrib(gl, &mut pop)).is_none() {
        pop();
    }
}

pub(crate) unsafe fn glIsTexture(texture: u32) -> u8 {
    before_uncompiled();
    // SAFETY: the program's own call.
    let is = unsafe { real().glIsTexture(texture) };
    // Textures of ours do not exist for the program.
    is & u8::from(peek(|l| l.owns_texture(TextureName(texture))) != Some(true))
}

pub(crate) unsafe fn glIsFramebuffer(framebuffer: u32) -> u8 {
    before_uncompiled();
    // SAFETY: the program's own call.
    let is = unsafe { real().glIsFramebuffer(framebuffer) };
    is & u8::from(peek(|l| l.owns_framebuffer(FramebufferName(framebuffer))) != Some(true))
}

pub(crate) unsafe fn glRenderMode(mode: u32) -> i32 {
    before_uncompiled();
    // SAFETY: the program's own call.
    let hits = unsafe { real().glRenderMode(mode) };
    peek(|l| l.render_mode(mode));
    hits
}

pub(crate) unsafe fn glBeginTransformFeedback(mode: u32) {
    // SAFETY: the program's own call.
    unsafe { real().glBeginTransformFeedback(mode) };
    peek(|l| l.transform_feedback(true));
}

pub(crate) unsafe fn glEndTransformFeedback() {
    // SAFETY: the program's own call.
    unsafe { real().glEndTransformFeedback() };
    peek(|l| l.transform_feedback(false));
}

/// The answer to glGet where it differs from the driver's because the program's framebuffer 0 is the atlas.
fn answer(name: u32) -> Option<i64> {
    before_uncompiled();
    peek(|l| l.answer(name)).flatten()
}

pub(crate) unsafe fn glGetIntegerv(pname: u32, data: Ptr) {
    // The list of binary formats is empty.
    if pname == PROGRAM_BINARY_FORMATS && peek(|l| l.refuses_binaries()) == Some(true) {
        return;
    }
    match answer(pname) {
        // SAFETY: the program's pointer to one value.
        Some(v) if !data.is_null() => unsafe { *data.cast::<i32>() = v as i32 },
        // SAFETY: the program's own call.
        _ => unsafe { real().glGetIntegerv(pname, data) },
    }
}

pub(crate) unsafe fn glGetBooleanv(pname: u32, data: Ptr) {
    match answer(pname) {
        // SAFETY: the program's pointer to one value.
        Some(v) if !data.is_null() => unsafe { *data.cast::<u8>() = u8::from(v != 0) },
        // SAFETY: the program's own call.
        _ => unsafe { real().glGetBooleanv(pname, data) },
    }
}

pub(crate) unsafe fn glGetFloatv(pname: u32, data: Ptr) {
    match answer(pname) {
        // SAFETY: the program's pointer to one value.
        Some(v) if !data.is_null() => unsafe { *data.cast::<f32>() = v as f32 },
        // SAFETY: the program's own call.
        _ => unsafe { real().glGetFloatv(pname, data) },
    }
}

pub(crate) unsafe fn glGetDoublev(pname: u32, data: Ptr) {
    match answer(pname) {
        // SAFETY: the program's pointer to one value.
        Some(v) if !data.is_null() => unsafe { *data.cast::<f64>() = v as f64 },
        // SAFETY: the program's own call.
        _ => unsafe { real().glGetDoublev(pname, data) },
    }
}

pub(crate) unsafe fn glGetInteger64v(pname: u32, data: Ptr) {
    match answer(pname) {
        // SAFETY: the program's pointer to one value.
        Some(v) if !data.is_null() => unsafe { *data.cast::<i64>() = v },
        // SAFETY: the program's own call.
        _ => unsafe { real().glGetInteger64v(pname, data) },
    }
}

pub(crate) unsafe fn glGetError() -> u32 {
    before_uncompiled();
    if let Some(Some(e)) = peek(|l| l.take_error()) {
        // While this error was pending, the driver would have recorded no other, so the driver's is dropped.
        // SAFETY: no arguments.
        unsafe { real().glGetError() };
        return e;
    }
    // SAFETY: the program's own call.
    unsafe { real().glGetError() }
}

pub(crate) unsafe fn glFlush() {
    before_uncompiled();
    write_back_shared();
    // SAFETY: the program's own call.
    let flush = || unsafe { real().glFlush() };
    if !draws_to_memory() && enter(|_, l| l.shows_on_flush()) == Some(true) {
        frame(None, flush)
    } else {
        flush()
    }
}

pub(crate) unsafe fn glFinish() {
    before_uncompiled();
    write_back_shared();
    // SAFETY: the program's own call.
    let finish = || unsafe { real().glFinish() };
    let memory = draws_to_memory();
    // OSMesa has no swap: at glFinish its picture is in the program's memory, which is the end of a frame.
    if memory || enter(|_, l| l.shows_on_flush()) == Some(true) {
        frame(None, finish)
    } else {
        finish()
    }
}
