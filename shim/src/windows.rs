//! The X windows behind the program's drawables: those of glXCreateWindow, and surfaces of EGL.

use crate::loaded::function;
use crate::xcb::{self, Connection};
use core::ffi::{CStr, c_ulong};
use manyview_core::gl::Ptr;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// All such windows of the process. A program has few of them.
struct Windows {
    /// GLX: Display, drawable and window.
    drawables: Vec<(usize, c_ulong, c_ulong)>,
    /// EGL: EGLDisplay, and the native display that it was obtained for.
    displays: Vec<(usize, Native)>,
    /// EGL: EGLDisplay, surface and window.
    surfaces: Vec<(usize, usize, u32)>,
}

/// The native display of an EGLDisplay, as a number because other threads may read it.
#[derive(Clone, Copy)]
enum Native {
    /// A Display of Xlib.
    Xlib(usize),
    /// A connection of xcb.
    Xcb(usize),
    /// A wl_display.
    Wayland(usize),
}

static WINDOWS: Mutex<Windows> = Mutex::new(Windows {
    drawables: Vec::new(),
    displays: Vec::new(),
    surfaces: Vec::new(),
});

fn windows() -> MutexGuard<'static, Windows> {
    WINDOWS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The program has made a drawable for a window.
pub(crate) fn made(display: Ptr, drawable: c_ulong, window: c_ulong) {
    gone(display, drawable);
    windows()
        .drawables
        .push((display as usize, drawable, window));
}

/// The program has destroyed it.
pub(crate) fn gone(display: Ptr, drawable: c_ulong) {
    let of = (display as usize, drawable);
    windows().drawables.retain(|w| (w.0, w.1) != of);
}

/// The window behind a drawable; a window is its own drawable.
pub(crate) fn behind(display: Ptr, drawable: c_ulong) -> c_ulong {
    let of = (display as usize, drawable);
    let windows = windows();
    let found = windows.drawables.iter().find(|w| (w.0, w.1) == of);
    found.map_or(drawable, |w| w.2)
}

/// The program has obtained an EGLDisplay for a native display; `platform` is the EGL platform that it named, or 0.
pub(crate) fn egl_display(display: Ptr, platform: u32, native: Ptr) {
    const X11: u32 = 0x31D5;
    const XCB: u32 = 0x31DC;
    const WAYLAND: u32 = 0x31D8;
    // Without a native display, EGL opens a connection that only EGL knows.
    if display.is_null() || native.is_null() {
        return;
    }
    let native = match platform {
        X11 => Native::Xlib(native as usize),
        XCB => Native::Xcb(native as usize),
        WAYLAND => Native::Wayland(native as usize),
        // SAFETY: the program has just given it to EGL as the display of some window system.
        0 => match unsafe { system(native) } {
            Some(known) => known,
            None => return,
        },
        _ => return,
    };
    let mut windows = windows();
    windows.displays.retain(|d| d.0 != display as usize);
    windows.displays.push((display as usize, native));
}

/// Whether there is memory at an address. It is checked because programs also give EGL plain numbers as native displays.
fn is_mapped(address: Ptr) -> bool {
    // SAFETY: sysconf has no conditions.
    let page = unsafe { libc::sysconf(libc::_SC_PAGESIZE) } as usize;
    let start = address as usize & !page.wrapping_sub(1);
    let mut resident = 0u8;
    // SAFETY: the address is only asked about; one page has one byte of answer.
    let known = unsafe { libc::mincore(start as Ptr, 1, &raw mut resident) };
    start != 0 && known == 0
}

/// The window system of an untyped native display, if it is X or Wayland. It is detected as in Mesa: by EGL_PLATFORM, or else by how it begins; a Display of X begins like none
/// of the others.
///
/// # Safety
/// Memory at `native`, if there is any, stays mapped during the call.
unsafe fn system(native: Ptr) -> Option<Native> {
    let (xlib, wayland) = (
        Native::Xlib(native as usize),
        Native::Wayland(native as usize),
    );
    if let Some(platform) = std::env::var_os("EGL_PLATFORM") {
        return match platform.to_str() {
            Some("x11") => Some(xlib),
            Some("wayland") => Some(wayland),
            _ => None,
        };
    }
    if !is_mapped(native) {
        return None;
    }
    // SAFETY: forwarded, and something is there.
    let first = unsafe { native.cast::<Ptr>().read_unaligned() };
    let begins = |library: &CStr, symbol: &CStr| function(library, symbol) == Some(first);
    if begins(c"libwayland-client.so.0", c"wl_display_interface") {
        return Some(wayland);
    }
    (!begins(c"libgbm.so.1", c"gbm_create_device")).then_some(xlib)
}

/// The program has made a surface for a window. `window` is its argument to EGL: the window's number, or with `address` the address of that.
///
/// # Safety
/// EGL has just taken `window` for a native window of this display.
pub(crate) unsafe fn egl_made(display: Ptr, surface: Ptr, window: Ptr, address: bool) {
    egl_gone(display, surface);
    let mut windows = windows();
    // Only windows of X are noted.
    let is_x = |native| !matches!(native, Native::Wayland(_));
    if !windows
        .displays
        .iter()
        .any(|d| d.0 == display as usize && is_x(d.1))
    {
        return;
    }
    let number = if address {
        // SAFETY: an xcb_window_t, or a Window, whose lower half is the number (x86-64); EGL has read it (contract).
        unsafe { window.cast::<u32>().read_unaligned() }
    } else {
        window as usize as u32
    };
    windows
        .surfaces
        .push((display as usize, surface as usize, number));
}

/// The program has destroyed it.
pub(crate) fn egl_gone(display: Ptr, surface: Ptr) {
    let of = (display as usize, surface as usize);
    windows().surfaces.retain(|s| (s.0, s.1) != of);
}

/// The window behind a surface, and the connection for queries about it.
///
/// # Safety
/// The program shows this surface on this thread.
pub(crate) unsafe fn behind_surface(display: Ptr, surface: Ptr) -> Option<(Connection, u32)> {
    let (native, window) = {
        let windows = windows();
        let of = (display as usize, surface as usize);
        let &(.., window) = windows.surfaces.iter().find(|s| (s.0, s.1) == of)?;
        let of = display as usize;
        let &(_, native) = windows.displays.iter().find(|d| d.0 == of)?;
        (native, window)
    };
    let connection = match native {
        // SAFETY: a Display that EGL uses for this surface, and so is open.
        Native::Xlib(display) => unsafe { xcb::connection(display as Ptr) }?,
        Native::Xcb(connection) => connection as Connection,
        Native::Wayland(_) => return None,
    };
    Some((connection, window))
}

/// The wl_display of an EGLDisplay.
pub(crate) fn wayland_display(display: Ptr) -> Option<Ptr> {
    let windows = windows();
    let of = display as usize;
    let &(_, native) = windows.displays.iter().find(|d| d.0 == of)?;
    match native {
        Native::Wayland(native) => Some(native as Ptr),
        Native::Xlib(_) | Native::Xcb(_) => None,
    }
}
