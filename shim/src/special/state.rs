//! State that the layer follows call by call, and queries of the program.

use crate::context::{
    draws_to_memory, enter, frame, peek, real, show_finished, show_flushed, viewport_set,
};
use crate::hooks::{Object, before_uncompiled, compile, named, touch};
use crate::instead::instead;
use manyview_core::gl::{FramebufferName, Ptr, TextureName, consts::PROGRAM_BINARY_FORMATS};
use manyview_core::layer::FeedbackCommand;
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
    let clashes = peek(|l| {
        l.binds_at(target, name);
        l.compiles() || l.hides_texture(name)
    });
    if clashes == Some(true) {
        enter(|gl, l| l.binds_texture(gl, name));
    }
    touch(Touch::TEXTURE);
    // SAFETY: the program's own call.
    unsafe { real().glBindTexture(target, texture) };
}

pub(crate) unsafe fn glCreateTextures(target: u32, n: i32, textures: Ptr) {
    before_uncompiled();
    // SAFETY: the program's own call.
    unsafe { real().glCreateTextures(target, n, textures) };
    let count = usize::try_from(n).ok().filter(|_| !textures.is_null());
    for i in 0..count.unwrap_or(0) {
        // SAFETY: the driver has written n names there.
        let name = unsafe { textures.cast::<TextureName>().add(i).read() };
        peek(|l| l.binds_at(target, name));
    }
}

pub(crate) unsafe fn glTextureView(
    texture: u32,
    target: u32,
    origtexture: u32,
    internalformat: u32,
    minlevel: u32,
    numlevels: u32,
    minlayer: u32,
    numlayers: u32,
) {
    named(Object::Texture(TextureName(origtexture)));
    // SAFETY: the program's own call.
    unsafe {
        real().glTextureView(
            texture,
            target,
            origtexture,
            internalformat,
            minlevel,
            numlevels,
            minlayer,
            numlayers,
        )
    };
    peek(|l| l.binds_at(target, TextureName(texture)));
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
    enter(|gl, l| l.deletes_textures(gl, names));
    // Deleting a bound texture unbinds it.
    peek(|l| l.touch(Touch::TEXTURE));
    // SAFETY: the program's own call.
    unsafe { real().glDeleteTextures(n, textures) };
}

pub(crate) unsafe fn glPushAttrib(mask: u32) {
    // SAFETY: the program's own call.
    let mut push = || unsafe { real().glPushAttrib(mask) };
    instead(&mut push, |gl, l, push| l.push_attrib(gl, mask, push));
}

pub(crate) unsafe fn glPopAttrib() {
    // SAFETY: the program's own call.
    let mut pop = || unsafe { real().glPopAttrib() };
    instead(&mut pop, |gl, l, pop| l.pop_attrib(gl, pop));
}

pub(crate) unsafe fn glIsTexture(texture: u32) -> u8 {
    before_uncompiled();
    // SAFETY: the program's own call.
    let is = unsafe { real().glIsTexture(texture) };
    // Textures of ours do not exist for the program.
    is & u8::from(peek(|l| l.hides_texture(TextureName(texture))) != Some(true))
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
    enter(|gl, l| l.feedback_changed(gl, FeedbackCommand::Begin(mode)));
}

pub(crate) unsafe fn glEndTransformFeedback() {
    // SAFETY: the program's own call.
    unsafe { real().glEndTransformFeedback() };
    enter(|gl, l| l.feedback_changed(gl, FeedbackCommand::End));
}

/// A hook of a command that switches transform feedback in another way.
macro_rules! feedback {
    ($command:ident: $name:ident($($arg:ident: $kind:ty),*)) => {
        pub(crate) unsafe fn $name($($arg: $kind),*) {
            // SAFETY: the program's own call.
            unsafe { real().$name($($arg),*) };
            enter(|gl, l| l.feedback_changed(gl, FeedbackCommand::$command));
        }
    };
}

feedback!(Pause: glPauseTransformFeedback());
feedback!(Pause: glResumeTransformFeedback());
feedback!(Bind: glBindTransformFeedback(target: u32, id: u32));
feedback!(Bind: glBindTransformFeedbackNV(target: u32, id: u32));
feedback!(Bind: glDeleteTransformFeedbacks(n: i32, ids: Ptr));

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
    // SAFETY: the program's own call.
    show_flushed(|| unsafe { real().glFlush() });
}

pub(crate) unsafe fn glFinish() {
    before_uncompiled();
    // SAFETY: the program's own call.
    let finish = || unsafe { real().glFinish() };
    // OSMesa has no swap: at glFinish its picture is in the program's memory, which is the end of a frame.
    match draws_to_memory() {
        true => frame(None, finish),
        false => show_finished(finish),
    }
}
