//! Framebuffer objects and the program's framebuffer 0.

use crate::context::{enter, peek, real};
use crate::hooks::{Object, before_uncompiled, compile, if_split, named, write_back};
use crate::instead::{instead, instead_at};
use core::slice::from_raw_parts;
use manyview_core::gl::{FramebufferName, Gl, Ptr, RenderbufferName, TextureName, consts as c};
use manyview_core::layer::{Layer, is_scaled};
use manyview_core::plan::Kind;
use manyview_core::state::{Command, Run, Touch};

pub(crate) unsafe fn glBindFramebuffer(target: u32, framebuffer: u32) {
    before_uncompiled();
    // SAFETY: a name that the program or the layer made.
    let mut bind = |(t, n): (u32, FramebufferName)| unsafe { real().glBindFramebuffer(t, n.0) };
    let place = (target, FramebufferName(framebuffer));
    instead_at(place, &mut bind, |_, l, bind| {
        l.bind_framebuffer(place.0, place.1, &mut |t, n| bind((t, n)));
    });
}

pub(crate) unsafe fn glBindFramebufferEXT(target: u32, framebuffer: u32) {
    before_uncompiled();
    // SAFETY: a name that the program or the layer made.
    let mut bind = |(t, n): (u32, FramebufferName)| unsafe { real().glBindFramebufferEXT(t, n.0) };
    let place = (target, FramebufferName(framebuffer));
    instead_at(place, &mut bind, |_, l, bind| {
        l.bind_framebuffer(place.0, place.1, &mut |t, n| bind((t, n)));
    });
}

pub(crate) unsafe fn glDeleteFramebuffers(n: i32, framebuffers: Ptr) {
    before_uncompiled();
    let names = match usize::try_from(n) {
        Ok(n) if !framebuffers.is_null() => {
            // SAFETY: n names (the program's array), copied before the driver runs.
            unsafe { from_raw_parts(framebuffers as *const FramebufferName, n) }.to_vec()
        }
        _ => Vec::new(),
    };
    // SAFETY: the program's own call.
    unsafe { real().glDeleteFramebuffers(n, framebuffers) };
    enter(|gl, l| l.deleted_framebuffers(gl, &names));
}

pub(crate) unsafe fn glDeleteRenderbuffers(n: i32, renderbuffers: Ptr) {
    before_uncompiled();
    if !renderbuffers.is_null() && n > 0 {
        // SAFETY: n names (the program's array).
        let names = unsafe { from_raw_parts(renderbuffers as *const RenderbufferName, n as usize) };
        if_split(|gl, l| l.deleted_renderbuffers(gl, names));
    }
    // SAFETY: the program's own call.
    unsafe { real().glDeleteRenderbuffers(n, renderbuffers) };
}

/// Hooks of a command that copies between images.
macro_rules! copies_images {
    ($($name:ident),*) => {$(
        pub(crate) unsafe fn $name(
            srcName: u32,
            srcTarget: u32,
            srcLevel: i32,
            srcX: i32,
            srcY: i32,
            srcZ: i32,
            dstName: u32,
            dstTarget: u32,
            dstLevel: i32,
            dstX: i32,
            dstY: i32,
            dstZ: i32,
            width: i32,
            height: i32,
            depth: i32,
        ) {
            before_uncompiled();
            // SAFETY: the program's own call, or the same between other textures.
            let call = &mut |(from, to): (u32, u32)| unsafe {
                real().$name(
                    from, srcTarget, srcLevel, srcX, srcY, srcZ, to, dstTarget, dstLevel, dstX,
                    dstY, dstZ, width, height, depth,
                )
            };
            if [srcTarget, dstTarget].contains(&c::RENDERBUFFER) {
                write_back();
                named(match dstTarget {
                    c::RENDERBUFFER => Object::Renderbuffer(RenderbufferName(dstName)),
                    _ => Object::Texture(TextureName(dstName)),
                });
                return call((srcName, dstName));
            }
            instead_at((srcName, dstName), call, |gl, l, call| {
                let names = [TextureName(srcName), TextureName(dstName)];
                l.copy_image(gl, names, &mut |[from, to]| call((from.0, to.0)));
            });
        }
    )*};
}

copies_images!(glCopyImageSubData, glCopyImageSubDataNV);

pub(crate) unsafe fn glGenerateTextureMipmap(texture: u32) {
    before_uncompiled();
    // SAFETY: the program's own call.
    unsafe { real().glGenerateTextureMipmap(texture) };
    // SAFETY: the program's own call, on a texture of ours.
    let call = &mut |name: TextureName| unsafe { real().glGenerateTextureMipmap(name.0) };
    if_split(|gl, l| l.mipmaps_of(gl, TextureName(texture), call));
}

pub(crate) unsafe fn glGenerateTextureMipmapEXT(texture: u32, target: u32) {
    before_uncompiled();
    // SAFETY: the program's own call.
    unsafe { real().glGenerateTextureMipmapEXT(texture, target) };
    // SAFETY: the program's own call, on a texture of ours.
    let call =
        &mut |name: TextureName| unsafe { real().glGenerateTextureMipmapEXT(name.0, target) };
    if_split(|gl, l| l.mipmaps_of(gl, TextureName(texture), call));
}

pub(crate) unsafe fn glGenerateMultiTexMipmapEXT(texunit: u32, target: u32) {
    before_uncompiled();
    // SAFETY: the program's own call.
    let mut call = || unsafe { real().glGenerateMultiTexMipmapEXT(texunit, target) };
    call();
    if_split(|gl, l| l.with_unit(gl, texunit, |l| l.mipmaps(gl, target, &mut call)));
}

/// A call that chooses buffers. `ours` handles framebuffer 0; the driver handles the others, and names that `ours` does not know.
fn choose(
    zero: impl Fn(&Layer) -> bool,
    ours: impl FnOnce(&Gl, &mut Layer) -> Option<()>,
    target: u32,
    call: &mut dyn FnMut(),
) {
    instead(call, |gl, l, call| {
        if !zero(l) {
            l.attachments_changed();
            call();
        } else if ours(gl, l).is_none() {
            l.with_true_zero(gl, target, call);
        }
    });
}

/// As [`choose`], for the read buffer.
fn choose_read(zero: impl Fn(&Layer) -> bool, name: u32, call: &mut dyn FnMut()) {
    instead(call, |gl, l, call| {
        if !zero(l) {
            l.attachments_changed();
            call();
        } else if l.read_buffer(gl, name).is_none() {
            l.other_read_buffer(gl, name, call);
        }
    });
}

/// As [`choose`], for the draw buffers of the bound framebuffer. `several` is true for glDrawBuffers.
fn choose_draw(names: Option<&[u32]>, several: bool, call: &mut dyn FnMut()) {
    instead(call, |gl, l, call| {
        if !l.draws_to_zero() {
            l.attachments_changed();
            call();
        } else if names
            .and_then(|names| l.draw_buffers(gl, names, several))
            .is_none()
        {
            l.other_draw_buffers(gl, c::DRAW_FRAMEBUFFER, names.unwrap_or_default(), call);
        }
    });
}

pub(crate) unsafe fn glDrawBuffer(buf: u32) {
    if compile(Command::Of(Run::DrawBuffers), Touch::NONE) {
        enter(|_, l| l.compiled_names(&[0, buf]));
        // SAFETY: compiled into the program's list.
        return unsafe { real().glDrawBuffer(buf) };
    }
    choose_draw(
        Some(&[buf]),
        false,
        // SAFETY: the program's own call.
        &mut || unsafe { real().glDrawBuffer(buf) },
    );
}

/// # Safety
/// `bufs` points to `n` names.
unsafe fn buffers(n: i32, bufs: Ptr) -> Option<Vec<u32>> {
    let n = usize::try_from(n)
        .ok()
        .filter(|&n| n > 0 && n <= 16 && !bufs.is_null())?;
    // SAFETY: n names (caller).
    Some(unsafe { from_raw_parts(bufs as *const u32, n) }.to_vec())
}

/// Hooks of a command that chooses several draw buffers.
macro_rules! chooses_several {
    ($($name:ident),*) => {$(
        pub(crate) unsafe fn $name(n: i32, bufs: Ptr) {
            // SAFETY: the program's array.
            let names = unsafe { buffers(n, bufs) };
            if compile(Command::Of(Run::DrawBuffers), Touch::NONE) {
                // A call without valid names is an error with any framebuffer.
                let mut compiled = vec![1];
                compiled.extend_from_slice(names.as_deref().unwrap_or(&[u32::MAX]));
                enter(|_, l| l.compiled_names(&compiled));
                // SAFETY: compiled into the program's list.
                return unsafe { real().$name(n, bufs) };
            }
            choose_draw(
                names.as_deref(),
                true,
                // SAFETY: the program's own call.
                &mut || unsafe { real().$name(n, bufs) },
            );
        }
    )*};
}

chooses_several!(glDrawBuffers, glDrawBuffersNV);

pub(crate) unsafe fn glReadBufferNV(mode: u32) {
    // The extension has the same command, for contexts that lack the plain name.
    // SAFETY: the program's own argument.
    unsafe { glReadBuffer(mode) };
}

pub(crate) unsafe fn glReadBuffer(src: u32) {
    if compile(Command::Of(Run::ReadBuffer(src)), Touch::NONE) {
        // SAFETY: compiled into the program's list.
        return unsafe { real().glReadBuffer(src) };
    }
    choose_read(
        Layer::reads_from_zero,
        src,
        // SAFETY: the program's own call.
        &mut || unsafe { real().glReadBuffer(src) },
    );
}

pub(crate) unsafe fn glNamedFramebufferDrawBuffer(framebuffer: u32, buf: u32) {
    choose(
        |_| framebuffer == 0,
        |gl, l| l.draw_buffers(gl, &[buf], false),
        0,
        // SAFETY: the program's own call.
        &mut || unsafe { real().glNamedFramebufferDrawBuffer(framebuffer, buf) },
    );
}

pub(crate) unsafe fn glFramebufferDrawBufferEXT(framebuffer: u32, mode: u32) {
    choose(
        |_| framebuffer == 0,
        |gl, l| l.draw_buffers(gl, &[mode], false),
        0,
        // SAFETY: the program's own call.
        &mut || unsafe { real().glFramebufferDrawBufferEXT(framebuffer, mode) },
    );
}

pub(crate) unsafe fn glNamedFramebufferDrawBuffers(framebuffer: u32, n: i32, bufs: Ptr) {
    // SAFETY: the program's array.
    let names = unsafe { buffers(n, bufs) };
    choose(
        |_| framebuffer == 0,
        |gl, l| l.draw_buffers(gl, names.as_deref()?, true),
        0,
        // SAFETY: the program's own call.
        &mut || unsafe { real().glNamedFramebufferDrawBuffers(framebuffer, n, bufs) },
    );
}

pub(crate) unsafe fn glFramebufferDrawBuffersEXT(framebuffer: u32, n: i32, bufs: Ptr) {
    // SAFETY: the program's array.
    let names = unsafe { buffers(n, bufs) };
    choose(
        |_| framebuffer == 0,
        |gl, l| l.draw_buffers(gl, names.as_deref()?, true),
        0,
        // SAFETY: the program's own call.
        &mut || unsafe { real().glFramebufferDrawBuffersEXT(framebuffer, n, bufs) },
    );
}

pub(crate) unsafe fn glNamedFramebufferReadBuffer(framebuffer: u32, src: u32) {
    choose_read(
        |_| framebuffer == 0,
        src,
        // SAFETY: the program's own call.
        &mut || unsafe { real().glNamedFramebufferReadBuffer(framebuffer, src) },
    );
}

pub(crate) unsafe fn glFramebufferReadBufferEXT(framebuffer: u32, mode: u32) {
    choose_read(
        |_| framebuffer == 0,
        mode,
        // SAFETY: the program's own call.
        &mut || unsafe { real().glFramebufferReadBufferEXT(framebuffer, mode) },
    );
}

pub(crate) unsafe fn glGetFramebufferParameterivEXT(framebuffer: u32, pname: u32, params: Ptr) {
    before_uncompiled();
    // SAFETY: the program's own call.
    unsafe { real().glGetFramebufferParameterivEXT(framebuffer, pname, params) };
    let answer = match framebuffer {
        0 => peek(|l| l.answer_of_zero(pname)).flatten(),
        _ => None,
    };
    if let (Some(buffer), false) = (answer, params.is_null()) {
        // SAFETY: the driver has written one value of this name there.
        unsafe { params.cast::<i32>().write_unaligned(buffer as i32) };
    }
}

pub(crate) unsafe fn glBlitFramebufferANGLE(
    srcX0: i32,
    srcY0: i32,
    srcX1: i32,
    srcY1: i32,
    dstX0: i32,
    dstY0: i32,
    dstX1: i32,
    dstY1: i32,
    mask: u32,
    filter: u32,
) {
    // The extension has the same command with more restrictions, on which no program relies.
    // SAFETY: the program's own arguments.
    unsafe {
        glBlitFramebuffer(
            srcX0, srcY0, srcX1, srcY1, dstX0, dstY0, dstX1, dstY1, mask, filter,
        )
    };
}

pub(crate) unsafe fn glBlitFramebuffer(
    srcX0: i32,
    srcY0: i32,
    srcX1: i32,
    srcY1: i32,
    dstX0: i32,
    dstY0: i32,
    dstX1: i32,
    dstY1: i32,
    mask: u32,
    filter: u32,
) {
    // SAFETY: the program's own call, moved by a tile's offset.
    let mut blit = |(s, d): (i32, i32)| unsafe {
        real().glBlitFramebuffer(
            srcX0 + s,
            srcY0,
            srcX1 + s,
            srcY1,
            dstX0 + d,
            dstY0,
            dstX1 + d,
            dstY1,
            mask,
            filter,
        )
    };
    instead_at((0, 0), &mut blit, |gl, l, blit| {
        let (mask, filter) = (mask as i32, filter as i32);
        let arguments = [
            srcX0, srcY0, srcX1, srcY1, dstX0, dstY0, dstX1, dstY1, mask, filter,
        ];
        l.blit(gl, is_scaled(&arguments), &mut |s, d| blit((s, d)));
        if l.compiles() {
            l.compiled_names(&arguments.map(|v| v as u32));
        }
    });
}

pub(crate) unsafe fn glBlitNamedFramebuffer(
    readFramebuffer: u32,
    drawFramebuffer: u32,
    srcX0: i32,
    srcY0: i32,
    srcX1: i32,
    srcY1: i32,
    dstX0: i32,
    dstY0: i32,
    dstX1: i32,
    dstY1: i32,
    mask: u32,
    filter: u32,
) {
    // SAFETY: the program's own call, moved by a tile's offset.
    let blit = |(s, d): (i32, i32)| unsafe {
        real().glBlitFramebuffer(
            srcX0 + s,
            srcY0,
            srcX1 + s,
            srcY1,
            dstX0 + d,
            dstY0,
            dstX1 + d,
            dstY1,
            mask,
            filter,
        )
    };
    let mut call = |place: Option<(i32, i32)>| match place {
        Some(place) => blit(place),
        // SAFETY: the program's own call.
        None => unsafe {
            real().glBlitNamedFramebuffer(
                readFramebuffer,
                drawFramebuffer,
                srcX0,
                srcY0,
                srcX1,
                srcY1,
                dstX0,
                dstY0,
                dstX1,
                dstY1,
                mask,
                filter,
            )
        },
    };
    if readFramebuffer != 0 && drawFramebuffer != 0 {
        return call(None);
    }
    instead_at(None, &mut call, |gl, l, call| {
        let (draw, read) = (
            FramebufferName(drawFramebuffer),
            FramebufferName(readFramebuffer),
        );
        l.with_bound(gl, draw, Some(read), |l| {
            let (mask, filter) = (mask as i32, filter as i32);
            let arguments = [
                srcX0, srcY0, srcX1, srcY1, dstX0, dstY0, dstX1, dstY1, mask, filter,
            ];
            l.blit(gl, is_scaled(&arguments), &mut |s, d| call(Some((s, d))));
        });
    });
}

/// A clear of a framebuffer by name; that of framebuffer 0 is drawn as if it were bound. `call` clears the bound one (true) or the named one.
fn clear_named(framebuffer: u32, call: &mut dyn FnMut(bool)) {
    if framebuffer != 0 {
        return call(false);
    }
    let kind = Kind::Clear {
        depths: true,
        whole: 0,
    };
    instead_at(false, call, |gl, l, call| {
        l.with_bound(gl, FramebufferName::ZERO, None, |l| {
            l.draw(gl, kind, &mut || call(true));
        });
    });
}

/// A hook of glClearNamedFramebuffer*; `zero` is the same clear of the bound framebuffer.
macro_rules! clear_named {
    ($name:ident, $zero:ident, $($arg:ident: $kind:ty),+) => {
        pub(crate) unsafe fn $name(framebuffer: u32, buffer: u32, drawbuffer: i32, $($arg: $kind),+) {
            clear_named(framebuffer, &mut |bound| match bound {
                // SAFETY: the program's own arguments.
                true => unsafe { real().$zero(buffer, drawbuffer, $($arg),+) },
                // SAFETY: the program's own call.
                false => unsafe { real().$name(framebuffer, buffer, drawbuffer, $($arg),+) },
            });
        }
    };
}

clear_named!(glClearNamedFramebufferfv, glClearBufferfv, value: Ptr);
clear_named!(glClearNamedFramebufferiv, glClearBufferiv, value: Ptr);
clear_named!(glClearNamedFramebufferuiv, glClearBufferuiv, value: Ptr);
clear_named!(glClearNamedFramebufferfi, glClearBufferfi, depth: f32, stencil: i32);
