//! GLX, EGL and OSMesa: contexts, swaps and function addresses.

use crate::context::{
    destroyed, enter, frame, guarded, is_current, leave_context, made_current, sheltered,
};
use crate::dl::proc_address;
use crate::drawable::{Drawable, Pair};
use crate::drawables;
use crate::hooks::before_uncompiled;
use crate::provider::Provider;
use crate::registry;
use crate::shares::created;
use crate::windows;
use core::ffi::c_ulong;
use manyview_core::gl::shadow::lists_of_bitmaps;
use manyview_core::gl::{ListName, Ptr, Real};

fn gl() -> &'static Real {
    Provider::Gl.real()
}

fn osmesa() -> &'static Real {
    Provider::OsMesa.real()
}

pub(crate) unsafe fn glXSwapBuffers(dpy: Ptr, drawable: c_ulong) {
    // SAFETY: the program's own call.
    frame(Some(Drawable::Glx(dpy, drawable)), || unsafe {
        gl().glXSwapBuffers(dpy, drawable)
    });
}

pub(crate) unsafe fn glXSwapBuffersMscOML(
    dpy: Ptr,
    drawable: c_ulong,
    target_msc: i64,
    divisor: i64,
    remainder: i64,
) -> i64 {
    // SAFETY: the program's own call.
    frame(Some(Drawable::Glx(dpy, drawable)), || unsafe {
        gl().glXSwapBuffersMscOML(dpy, drawable, target_msc, divisor, remainder)
    })
}

/// A hook of a command that creates a context; `share` names the argument with the context to share objects with.
macro_rules! create {
    ($name:ident($($arg:ident: $kind:ty),+), $share:ident, $provider:ident, $real:ident) => {
        pub(crate) unsafe fn $name($($arg: $kind),+) -> Ptr {
            // SAFETY: the program's own call.
            let context = guarded(|| unsafe { $real().$name($($arg),+) });
            sheltered(|| created(Provider::$provider, context, $share));
            context
        }
    };
}

create!(glXCreateContext(dpy: Ptr, vis: Ptr, share: Ptr, direct: i32), share, Gl, gl);
create!(glXCreateNewContext(dpy: Ptr, config: Ptr, kind: i32, share: Ptr, direct: i32), share, Gl, gl);
create!(glXCreateContextAttribsARB(dpy: Ptr, config: Ptr, share: Ptr, direct: i32, attribs: Ptr), share, Gl, gl);
create!(glXCreateContextWithConfigSGIX(dpy: Ptr, config: Ptr, kind: i32, share: Ptr, direct: i32), share, Gl, gl);
create!(eglCreateContext(dpy: Ptr, config: Ptr, share: Ptr, attribs: Ptr), share, Gl, gl);
create!(OSMesaCreateContext(format: u32, share: Ptr), share, OsMesa, osmesa);
create!(OSMesaCreateContextExt(format: u32, depth: i32, stencil: i32, accum: i32, share: Ptr), share, OsMesa, osmesa);
create!(OSMesaCreateContextAttribs(attribs: Ptr, share: Ptr), share, OsMesa, osmesa);

/// Makes a context current with drawables, none where there is nothing to draw to; `call` is the program's own and tells whether it is done.
fn make_current<R>(
    provider: Provider,
    context: Ptr,
    drawables: Option<Pair>,
    call: impl FnOnce() -> R,
    done: impl FnOnce(&R) -> bool,
) -> R {
    if is_current(provider, context, drawables) {
        return guarded(call);
    }
    leave_context((provider, context), drawables);
    let answer = guarded(call);
    if done(&answer) {
        made_current(provider, context, drawables);
    }
    answer
}

/// The common part of the GLX MakeCurrent family.
fn glx_current(dpy: Ptr, [draw, read]: [c_ulong; 2], ctx: Ptr, call: impl FnOnce() -> i32) -> i32 {
    let drawables = (draw != 0).then_some(Pair {
        draw: Drawable::Glx(dpy, draw),
        read: Drawable::Glx(dpy, read),
    });
    make_current(Provider::Gl, ctx, drawables, call, |&ok| ok != 0)
}

pub(crate) unsafe fn glXMakeCurrent(dpy: Ptr, drawable: c_ulong, ctx: Ptr) -> i32 {
    // SAFETY: the program's own call.
    glx_current(dpy, [drawable; 2], ctx, || unsafe {
        gl().glXMakeCurrent(dpy, drawable, ctx)
    })
}

pub(crate) unsafe fn glXMakeContextCurrent(
    dpy: Ptr,
    draw: c_ulong,
    read: c_ulong,
    ctx: Ptr,
) -> i32 {
    // SAFETY: the program's own call.
    glx_current(dpy, [draw, read], ctx, || unsafe {
        gl().glXMakeContextCurrent(dpy, draw, read, ctx)
    })
}

pub(crate) unsafe fn glXMakeCurrentReadSGI(
    dpy: Ptr,
    draw: c_ulong,
    read: c_ulong,
    ctx: Ptr,
) -> i32 {
    // SAFETY: the program's own call.
    glx_current(dpy, [draw, read], ctx, || unsafe {
        gl().glXMakeCurrentReadSGI(dpy, draw, read, ctx)
    })
}

pub(crate) unsafe fn glXUseXFont(font: c_ulong, first: i32, count: i32, base: i32) {
    before_uncompiled();
    // SAFETY: the program's own call.
    guarded(|| unsafe { gl().glXUseXFont(font, first, count, base) });
    if let Ok(count) = u32::try_from(count) {
        lists_of_bitmaps(base as u32, count);
        enter(|gl, l| l.bitmap_lists(gl, ListName(base as u32), count));
    }
}

pub(crate) unsafe fn glXCopyContext(dpy: Ptr, src: Ptr, dst: Ptr, mask: c_ulong) {
    // SAFETY: the program's own call.
    guarded(|| unsafe { gl().glXCopyContext(dpy, src, dst, mask) });
    registry::changed((Provider::Gl, dst));
}

pub(crate) unsafe fn glXDestroyContext(dpy: Ptr, ctx: Ptr) {
    destroyed(Provider::Gl, ctx);
    // SAFETY: the program's own call.
    guarded(|| unsafe { gl().glXDestroyContext(dpy, ctx) });
}

pub(crate) unsafe fn glXCreateWindow(dpy: Ptr, config: Ptr, win: c_ulong, attribs: Ptr) -> c_ulong {
    // SAFETY: the program's own call.
    let drawable = guarded(|| unsafe { gl().glXCreateWindow(dpy, config, win, attribs) });
    if drawable != 0 {
        sheltered(|| windows::made(dpy, drawable, win));
    }
    drawable
}

pub(crate) unsafe fn glXDestroyWindow(dpy: Ptr, win: c_ulong) {
    sheltered(|| {
        windows::gone(dpy, win);
        drawables::gone(Drawable::Glx(dpy, win));
    });
    // SAFETY: the program's own call.
    guarded(|| unsafe { gl().glXDestroyWindow(dpy, win) });
}

/// A hook of a command that destroys a drawable which is no window.
macro_rules! destroy {
    ($name:ident($drawable:ident)) => {
        pub(crate) unsafe fn $name(dpy: Ptr, $drawable: c_ulong) {
            sheltered(|| drawables::gone(Drawable::Glx(dpy, $drawable)));
            // SAFETY: the program's own call.
            guarded(|| unsafe { gl().$name(dpy, $drawable) });
        }
    };
}

destroy!(glXDestroyPbuffer(pbuf));
destroy!(glXDestroyGLXPbufferSGIX(pbuf));
destroy!(glXDestroyPixmap(pixmap));
destroy!(glXDestroyGLXPixmap(pixmap));

pub(crate) unsafe fn glXGetProcAddress(name: Ptr) -> Ptr {
    // SAFETY: the program's own string.
    unsafe { proc_address(name.cast(), gl().glXGetProcAddress(name)) }
}

pub(crate) unsafe fn glXGetProcAddressARB(name: Ptr) -> Ptr {
    // SAFETY: the program's own string.
    unsafe { proc_address(name.cast(), gl().glXGetProcAddressARB(name)) }
}

pub(crate) unsafe fn eglSwapBuffers(dpy: Ptr, surface: Ptr) -> u32 {
    // SAFETY: the program's own call.
    frame(Some(Drawable::Egl(dpy, surface)), || unsafe {
        gl().eglSwapBuffers(dpy, surface)
    })
}

/// A hook of a swap with damage. The rectangles are dropped, because a change in a part of the scene changes the whole panel.
macro_rules! swap_with_damage {
    ($name:ident) => {
        pub(crate) unsafe fn $name(dpy: Ptr, surface: Ptr, _rects: Ptr, _n: i32) -> u32 {
            // SAFETY: the program's display and surface; no rectangles.
            frame(Some(Drawable::Egl(dpy, surface)), || unsafe {
                gl().$name(dpy, surface, core::ptr::null_mut(), 0)
            })
        }
    };
}

swap_with_damage!(eglSwapBuffersWithDamageKHR);
swap_with_damage!(eglSwapBuffersWithDamageEXT);

pub(crate) unsafe fn eglMakeCurrent(dpy: Ptr, draw: Ptr, read: Ptr, ctx: Ptr) -> u32 {
    let drawables = (!draw.is_null()).then_some(Pair {
        draw: Drawable::Egl(dpy, draw),
        read: Drawable::Egl(dpy, read),
    });
    // SAFETY: the program's own call.
    let call = || unsafe { gl().eglMakeCurrent(dpy, draw, read, ctx) };
    make_current(Provider::Gl, ctx, drawables, call, |&ok| ok != 0)
}

pub(crate) unsafe fn eglDestroyContext(dpy: Ptr, ctx: Ptr) -> u32 {
    destroyed(Provider::Gl, ctx);
    // SAFETY: the program's own call.
    guarded(|| unsafe { gl().eglDestroyContext(dpy, ctx) })
}

pub(crate) unsafe fn eglReleaseThread() -> u32 {
    let none = core::ptr::null_mut();
    leave_context((Provider::Gl, none), None);
    // SAFETY: the program's own call.
    let ok = guarded(|| unsafe { gl().eglReleaseThread() });
    made_current(Provider::Gl, none, None);
    ok
}

pub(crate) unsafe fn eglGetDisplay(native: Ptr) -> Ptr {
    // SAFETY: the program's own call.
    let display = guarded(|| unsafe { gl().eglGetDisplay(native) });
    sheltered(|| windows::egl_display(display, 0, native));
    display
}

/// A hook as that of eglGetDisplay, for a platform that the program names.
macro_rules! platform_display {
    ($name:ident) => {
        pub(crate) unsafe fn $name(platform: u32, native: Ptr, attribs: Ptr) -> Ptr {
            // SAFETY: the program's own call.
            let display = guarded(|| unsafe { gl().$name(platform, native, attribs) });
            sheltered(|| windows::egl_display(display, platform, native));
            display
        }
    };
}

platform_display!(eglGetPlatformDisplay);
platform_display!(eglGetPlatformDisplayEXT);

/// A hook of a command that creates a surface for a window, which is given by its number or by the address of that.
macro_rules! window_surface {
    ($name:ident, $address:literal) => {
        pub(crate) unsafe fn $name(dpy: Ptr, config: Ptr, win: Ptr, attribs: Ptr) -> Ptr {
            // SAFETY: the program's own call.
            let surface = guarded(|| unsafe { gl().$name(dpy, config, win, attribs) });
            if !surface.is_null() {
                // SAFETY: EGL has taken the window.
                sheltered(|| unsafe { windows::egl_made(dpy, surface, win, $address) });
            }
            surface
        }
    };
}

window_surface!(eglCreateWindowSurface, false);
window_surface!(eglCreatePlatformWindowSurface, true);
window_surface!(eglCreatePlatformWindowSurfaceEXT, true);

pub(crate) unsafe fn eglDestroySurface(dpy: Ptr, surface: Ptr) -> u32 {
    sheltered(|| {
        windows::egl_gone(dpy, surface);
        drawables::gone(Drawable::Egl(dpy, surface));
    });
    // SAFETY: the program's own call.
    guarded(|| unsafe { gl().eglDestroySurface(dpy, surface) })
}

pub(crate) unsafe fn eglTerminate(dpy: Ptr) -> u32 {
    // SAFETY: the program's own call.
    let done = guarded(|| unsafe { gl().eglTerminate(dpy) });
    if done != 0 {
        sheltered(|| drawables::terminated(dpy));
    }
    done
}

pub(crate) unsafe fn eglGetProcAddress(name: Ptr) -> Ptr {
    // SAFETY: the program's own string.
    unsafe { proc_address(name.cast(), gl().eglGetProcAddress(name)) }
}

pub(crate) unsafe fn OSMesaMakeCurrent(
    ctx: Ptr,
    buffer: Ptr,
    kind: u32,
    width: i32,
    height: i32,
) -> u8 {
    let memory = Drawable::Memory(width as u32, height as u32);
    let drawables = (!buffer.is_null() && width > 0 && height > 0).then_some(Pair::of(memory));
    leave_context((Provider::OsMesa, ctx), drawables);
    // SAFETY: the program's own call.
    let ok = guarded(|| unsafe { osmesa().OSMesaMakeCurrent(ctx, buffer, kind, width, height) });
    if ok != 0 {
        made_current(Provider::OsMesa, ctx, drawables);
    }
    ok
}

pub(crate) unsafe fn OSMesaDestroyContext(ctx: Ptr) {
    leave_context((Provider::OsMesa, core::ptr::null_mut()), None);
    destroyed(Provider::OsMesa, ctx);
    // SAFETY: the program's own call.
    guarded(|| unsafe { osmesa().OSMesaDestroyContext(ctx) });
}

pub(crate) unsafe fn OSMesaGetProcAddress(name: Ptr) -> Ptr {
    // SAFETY: the program's own string.
    unsafe { proc_address(name.cast(), osmesa().OSMesaGetProcAddress(name)) }
}
