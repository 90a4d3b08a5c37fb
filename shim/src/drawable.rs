//! The drawable of a context: its size, its window, and the place of that.

use crate::geometry::{self, Seen};
use crate::provider::Provider;
use crate::windows;
use crate::xcb::{self, Connection};
use core::ffi::c_ulong;
use manyview_core::gl::Ptr;
use manyview_core::layer::OnScreen;

/// The drawable of a context.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Drawable {
    /// A GLX drawable, with its Display.
    Glx(Ptr, c_ulong),
    /// An EGL surface, with its EGLDisplay.
    Egl(Ptr, Ptr),
    /// The program's memory: width and height.
    Memory(u32, u32),
}

/// The drawables that a context has current: one to draw to, and one to read from. Mostly they are the same.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Pair {
    pub(crate) draw: Drawable,
    pub(crate) read: Drawable,
}

impl Pair {
    /// The same one for both.
    pub(crate) fn of(drawable: Drawable) -> Pair {
        Pair {
            draw: drawable,
            read: drawable,
        }
    }
}

/// Where a window is shown.
pub(crate) enum Shown {
    /// The name of an X display, and a window there.
    X(String, u32),
    /// A wl_display.
    Wayland(Ptr),
}

/// Where the window behind a drawable is shown. None for drawables without a window.
pub(crate) fn shown(drawable: Drawable) -> Option<Shown> {
    match drawable {
        Drawable::Glx(display, drawable) => {
            // SAFETY: the program has just shown a frame with this display on this thread.
            let name = unsafe { xcb::display_name(display) }?;
            let window = windows::behind(display, drawable);
            // Identifiers of X have 29 bits.
            Some(Shown::X(name, window as u32))
        }
        Drawable::Egl(display, surface) => {
            if let Some(wayland) = windows::wayland_display(display) {
                return Some(Shown::Wayland(wayland));
            }
            // SAFETY: the program has just shown this surface on this thread.
            let (_, window) = unsafe { windows::behind_surface(display, surface) }?;
            // A connection of xcb does not tell the name that it was opened with.
            let name = std::env::var("DISPLAY").ok()?;
            Some(Shown::X(name, window))
        }
        Drawable::Memory(..) => None,
    }
}

/// Width and height in pixels of a drawable that was just made current.
pub(crate) fn first_size(drawable: Drawable) -> Option<(u32, u32)> {
    size(drawable).or_else(|| match drawable {
        // SAFETY: the program has just made this drawable current on this thread.
        Drawable::Glx(display, drawable) => unsafe { geometry::queried_size(display, drawable) },
        _ => None,
    })
}

/// Width and height in pixels of a drawable that may have another size by now. None where it keeps its size, or does not exist any more.
pub(crate) fn size(drawable: Drawable) -> Option<(u32, u32)> {
    match drawable {
        // SAFETY: the program uses this display on this thread.
        Drawable::Glx(display, drawable) => unsafe { geometry::window_size(display, drawable) },
        Drawable::Egl(display, surface) => {
            let ask = |name: i32| {
                let mut v = 0i32;
                // SAFETY: the program's display and surface; one integer.
                let ok = unsafe {
                    Provider::Gl
                        .real()
                        .eglQuerySurface(display, surface, name, (&raw mut v).cast())
                };
                (ok != 0 && v > 0).then_some(v as u32)
            };
            const EGL_WIDTH: i32 = 0x3057;
            const EGL_HEIGHT: i32 = 0x3056;
            Some((ask(EGL_WIDTH)?, ask(EGL_HEIGHT)?))
        }
        Drawable::Memory(w, h) => Some((w, h)),
    }
}

/// The place of a drawable's window on its screen; `size` is that of the picture. None for drawables without a window.
pub(crate) fn place(
    drawable: Drawable,
    size: (u32, u32),
    seen: &mut Option<Seen>,
) -> Option<OnScreen> {
    let (connection, window) = window(drawable)?;
    // SAFETY: the window's own connection, which the program has open as long as it shows something in it.
    unsafe { geometry::place(connection, window, size, seen) }
}

/// Where the pointer is, in pixels from the top left corner of a drawable's window. None for drawables without a window.
pub(crate) fn pointer(drawable: Drawable) -> Option<(i32, i32)> {
    let (connection, window) = window(drawable)?;
    // SAFETY: as for [`place`].
    unsafe { xcb::pointer(connection, window) }
}

/// The window behind a drawable, and the connection for queries about it.
fn window(drawable: Drawable) -> Option<(Connection, u32)> {
    // SAFETY: the program shows this drawable on this thread.
    unsafe {
        match drawable {
            Drawable::Glx(display, drawable) => {
                let window = windows::behind(display, drawable);
                Some((xcb::connection(display)?, window as u32))
            }
            Drawable::Egl(display, surface) => windows::behind_surface(display, surface),
            // Memory has no place on a screen.
            Drawable::Memory(..) => None,
        }
    }
}
