//! Size of a GLX drawable.

use crate::provider::{Provider, symbol};
use core::ffi::{CStr, c_ulong, c_void};
use manyview_core::gl::Ptr;

/// xcb_get_geometry_reply_t
#[repr(C)]
struct Reply {
    head: [u8; 8],
    root: u32,
    x: i16,
    y: i16,
    width: u16,
    height: u16,
    border: u16,
    pad: [u8; 2],
}

/// A function of a library that the driver has loaded.
fn function(library: &CStr, name: &CStr) -> Option<Ptr> {
    // SAFETY: a string; NOLOAD only finds what is there.
    let handle = unsafe { libc::dlopen(library.as_ptr(), libc::RTLD_NOLOAD | libc::RTLD_LAZY) };
    if handle.is_null() {
        return None;
    }
    let p = symbol(handle, name);
    (!p.is_null()).then_some(p)
}

/// Width and height in pixels. By xcb, whose errors come as values: an X error through Xlib would end the program.
///
/// # Safety
/// `display` is the Display that the program just used with this drawable on this thread.
pub(crate) unsafe fn glx_size(display: Ptr, drawable: c_ulong) -> Option<(u32, u32)> {
    // SAFETY: forwarded.
    unsafe { window_size(display, drawable) }.or_else(|| {
        let ask = |name: i32| {
            let mut v = 0u32;
            // SAFETY: a pbuffer or pixmap of this display (not a window: those answered above); one u32.
            unsafe {
                Provider::Gl
                    .real()
                    .glXQueryDrawable(display, drawable, name, (&raw mut v).cast())
            };
            v
        };
        const GLX_WIDTH: i32 = 0x801D;
        const GLX_HEIGHT: i32 = 0x801E;
        let size = (ask(GLX_WIDTH), ask(GLX_HEIGHT));
        (size.0 > 0 && size.1 > 0).then_some(size)
    })
}

unsafe fn window_size(display: Ptr, drawable: c_ulong) -> Option<(u32, u32)> {
    let connection = function(c"libX11-xcb.so.1", c"XGetXCBConnection")?;
    let ask = function(c"libxcb.so.1", c"xcb_get_geometry")?;
    let reply = function(c"libxcb.so.1", c"xcb_get_geometry_reply")?;
    // SAFETY: the three functions have these signatures (xcb/xproto.h, X11/Xlib-xcb.h); a cookie is one u32 in a struct.
    // SAFETY: the reply is allocated by malloc and freed by us; the error, if any, likewise.
    unsafe {
        let connection =
            core::mem::transmute::<Ptr, unsafe extern "C" fn(Ptr) -> Ptr>(connection)(display);
        if connection.is_null() {
            return None;
        }
        let cookie = core::mem::transmute::<Ptr, unsafe extern "C" fn(Ptr, u32) -> u32>(ask)(
            connection,
            drawable as u32,
        );
        let mut error: *mut c_void = core::ptr::null_mut();
        let r = core::mem::transmute::<
            Ptr,
            unsafe extern "C" fn(Ptr, u32, *mut *mut c_void) -> *mut Reply,
        >(reply)(connection, cookie, &mut error);
        let size = (!r.is_null()).then(|| (u32::from((*r).width), u32::from((*r).height)));
        libc::free(r.cast());
        libc::free(error);
        size
    }
}
