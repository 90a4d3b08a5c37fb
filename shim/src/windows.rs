//! Which windows of X are behind what the program draws to: drawables of glXCreateWindow, and surfaces of EGL.

use crate::xcb::{self, Connection};
use core::ffi::{CStr, c_ulong};
use manyview_core::gl::Ptr;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Of one process. A program has few of them.
struct Windows {
    /// GLX: Display, drawable and window.
    drawables: Vec<(usize, c_ulong, c_ulong)>,
    /// EGL: its display, and what it was got for.
    displays: Vec<(usize, Native)>,
    /// EGL: display, surface and window.
    surfaces: Vec<(usize, usize, u32)>,
}

/// What an EGLDisplay was got for, as a number: other threads may ask.
#[derive(Clone, Copy)]
enum Native {
    /// A Display of Xlib.
    Xlib(usize),
    /// A connection of xcb.
    Xcb(usize),
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

/// It has destroyed it.
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

/// The program has got an EGLDisplay for something of its own; `platform` is what it says that is, 0 if it does not.
pub(crate) fn egl_display(display: Ptr, platform: u32, native: Ptr) {
    const X11: u32 = 0x31D5;
    const XCB: u32 = 0x31DC;
    // Without one of its own, EGL opens a connection that nobody else knows.
    if display.is_null() || native.is_null() {
        return;
    }
    let native = match platform {
        X11 => Native::Xlib(native as usize),
        XCB => Native::Xcb(native as usize),
        // SAFETY: the program has just given it to EGL as the display of some window system.
        0 if unsafe { is_xlib(native) } => Native::Xlib(native as usize),
        _ => return,
    };
    let mut windows = windows();
    windows.displays.retain(|d| d.0 != display as usize);
    windows.displays.push((display as usize, native));
}

/// Whether there is memory at an address: programs give EGL numbers as displays too.
fn is_mapped(address: Ptr) -> bool {
    // SAFETY: sysconf has no conditions.
    let page = unsafe { libc::sysconf(libc::_SC_PAGESIZE) } as usize;
    let start = address as usize & !page.wrapping_sub(1);
    let mut resident = 0u8;
    // SAFETY: the address is only asked about; one page has one byte of answer.
    let known = unsafe { libc::mincore(start as Ptr, 1, &raw mut resident) };
    start != 0 && known == 0
}

/// Whether an untyped native display is one of X, told as Mesa does: by EGL_PLATFORM, else because it does not begin as those of
/// Wayland and GBM do.
///
/// # Safety
/// Nobody takes away the memory that is there, if some is.
unsafe fn is_xlib(native: Ptr) -> bool {
    if let Some(platform) = std::env::var_os("EGL_PLATFORM") {
        return platform == "x11";
    }
    if !is_mapped(native) {
        return false;
    }
    // SAFETY: forwarded, and something is there.
    let first = unsafe { native.cast::<Ptr>().read_unaligned() };
    let others: [(&CStr, &CStr); 2] = [
        (c"libwayland-client.so.0", c"wl_display_interface"),
        (c"libgbm.so.1", c"gbm_create_device"),
    ];
    others
        .into_iter()
        .all(|(library, symbol)| xcb::function(library, symbol) != Some(first))
}

/// The program has made a surface for a window; `window` is what it gave to EGL, by `address` if it gave that of the window's number.
///
/// # Safety
/// EGL has just taken `window` for a native window of this display.
pub(crate) unsafe fn egl_made(display: Ptr, surface: Ptr, window: Ptr, address: bool) {
    egl_gone(display, surface);
    let mut windows = windows();
    // Of X only.
    if !windows.displays.iter().any(|d| d.0 == display as usize) {
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

/// It has destroyed it.
pub(crate) fn egl_gone(display: Ptr, surface: Ptr) {
    let of = (display as usize, surface as usize);
    windows().surfaces.retain(|s| (s.0, s.1) != of);
}

/// The window behind a surface, and the connection to ask about it.
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
    };
    Some((connection, window))
}
