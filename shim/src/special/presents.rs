//! Commands other than swaps that show what was drawn, or hand it on as a texture.

use crate::context::{draws_to, frame, guarded, is_drawn, real, show_finished};
use crate::drawable::Drawable;
use crate::hooks::texture_now;
use crate::provider::Provider;
use core::ffi::c_ulong;
use manyview_core::gl::{Ptr, Real, consts as c};

fn gl() -> &'static Real {
    Provider::Gl.real()
}

/// Shows a drawable by `call`, which reads its back buffer. Of another drawable than the current one, the true back buffer has all that is
/// known here.
fn present<R>(drawable: Drawable, call: impl FnOnce() -> R) -> R {
    match draws_to(drawable) && is_drawn() {
        true => frame(None, call),
        false => guarded(call),
    }
}

pub(crate) unsafe fn glXCopySubBufferMESA(
    dpy: Ptr,
    drawable: c_ulong,
    x: i32,
    y: i32,
    width: i32,
    height: i32,
) {
    // SAFETY: the program's own call.
    present(Drawable::Glx(dpy, drawable), || unsafe {
        gl().glXCopySubBufferMESA(dpy, drawable, x, y, width, height)
    });
}

pub(crate) unsafe fn eglPostSubBufferNV(
    dpy: Ptr,
    surface: Ptr,
    x: i32,
    y: i32,
    width: i32,
    height: i32,
) -> u32 {
    // SAFETY: the program's own call.
    present(Drawable::Egl(dpy, surface), || unsafe {
        gl().eglPostSubBufferNV(dpy, surface, x, y, width, height)
    })
}

/// A hook of a command that shows rectangles of a surface.
macro_rules! regions {
    ($name:ident) => {
        pub(crate) unsafe fn $name(dpy: Ptr, surface: Ptr, numRects: i32, rects: Ptr) -> u32 {
            // SAFETY: the program's own call.
            present(Drawable::Egl(dpy, surface), || unsafe {
                gl().$name(dpy, surface, numRects, rects)
            })
        }
    };
}

regions!(eglSwapBuffersRegionNOK);
regions!(eglSwapBuffersRegion2NOK);

pub(crate) unsafe fn eglCopyBuffers(dpy: Ptr, surface: Ptr, target: Ptr) -> u32 {
    // SAFETY: the program's own call.
    present(Drawable::Egl(dpy, surface), || unsafe {
        gl().eglCopyBuffers(dpy, surface, target)
    })
}

pub(crate) unsafe fn glXWaitGL() {
    // SAFETY: the program's own call.
    show_finished(|| unsafe { gl().glXWaitGL() });
}

pub(crate) unsafe fn eglWaitGL() -> u32 {
    // SAFETY: the program's own call.
    show_finished(|| unsafe { gl().eglWaitGL() })
}

pub(crate) unsafe fn eglWaitClient() -> u32 {
    // SAFETY: the program's own call.
    show_finished(|| unsafe { gl().eglWaitClient() })
}

/// A drawable becomes the image of the texture that is bound at one of these targets.
fn becomes_texture(drawable: Drawable) {
    if draws_to(drawable) && is_drawn() {
        // SAFETY: the context is current.
        frame(None, || unsafe { real().glFlush() });
    }
    [c::TEXTURE_2D, c::TEXTURE_RECTANGLE]
        .into_iter()
        .for_each(texture_now);
}

pub(crate) unsafe fn glXBindTexImageEXT(dpy: Ptr, drawable: c_ulong, buffer: i32, attribs: Ptr) {
    becomes_texture(Drawable::Glx(dpy, drawable));
    // SAFETY: the program's own call.
    guarded(|| unsafe { gl().glXBindTexImageEXT(dpy, drawable, buffer, attribs) });
}

pub(crate) unsafe fn eglBindTexImage(dpy: Ptr, surface: Ptr, buffer: i32) -> u32 {
    becomes_texture(Drawable::Egl(dpy, surface));
    // SAFETY: the program's own call.
    guarded(|| unsafe { gl().eglBindTexImage(dpy, surface, buffer) })
}
