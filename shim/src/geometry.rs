//! The size of a GLX drawable, and the place of a window on its screen.

use crate::provider::Provider;
use crate::windows;
use crate::xcb::{Connection, Monitor, connection, monitors, translated, window};
use core::ffi::c_ulong;
use manyview_core::gl::Ptr;
use manyview_core::layer::OnScreen;

/// Width and height of the window behind a drawable, in pixels. None where there is no window, or it is destroyed: xcb returns errors as
/// values, while an X error through Xlib would end the program.
///
/// # Safety
/// `display` is the Display that the program just used with this drawable on this thread.
pub(crate) unsafe fn window_size(display: Ptr, drawable: c_ulong) -> Option<(u32, u32)> {
    let behind = windows::behind(display, drawable);
    // SAFETY: forwarded.
    unsafe { window(connection(display)?, behind as u32) }.map(|found| found.size)
}

/// Width and height of a pbuffer or a pixmap, in pixels, which keeps them as long as it lives.
///
/// # Safety
/// The program has just made the drawable current on this thread: of one that is destroyed, Xlib would report an error.
pub(crate) unsafe fn queried_size(display: Ptr, drawable: c_ulong) -> Option<(u32, u32)> {
    let ask = |name: i32| {
        let mut v = 0u32;
        // SAFETY: forwarded; one u32.
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
}

/// Frames after which monitors are queried again even if the window has not moved, because they may have changed.
const ASK_AGAIN: u32 = 60;

/// The result of the last full query of a window.
#[derive(Clone, Copy)]
pub(crate) struct Seen {
    connection: Connection,
    window: u32,
    root: u32,
    size: (u32, u32),
    at: (i32, i32),
    on_screen: OnScreen,
    /// Frames since that query.
    frames: u32,
}

/// The place of a window on the monitor that has its centre. None if `number` is not a window. A frame queries only the place of the window,
/// unless that or `size` has changed.
///
/// # Safety
/// The connection is the program's and open.
pub(crate) unsafe fn place(
    connection: Connection,
    number: u32,
    size: (u32, u32),
    seen: &mut Option<Seen>,
) -> Option<OnScreen> {
    let known = seen.take().filter(|known| {
        (known.connection, known.window, known.size) == (connection, number, size)
            && known.frames < ASK_AGAIN
    });
    if let Some(mut known) = known {
        // SAFETY: forwarded.
        let at = unsafe { translated(connection, number, known.root) }?;
        if at == known.at {
            known.frames += 1;
            *seen = Some(known);
            return Some(known.on_screen);
        }
    }
    // SAFETY: forwarded.
    unsafe {
        let found = window(connection, number)?;
        let at = translated(connection, number, found.root)?;
        let on_screen = on_screen(connection, found.root, at, found.size)?;
        *seen = Some(Seen {
            connection,
            window: number,
            root: found.root,
            size,
            at,
            on_screen,
            frames: 0,
        });
        Some(on_screen)
    }
}

/// The place on its monitor of a window with this place and size on the root; on the whole screen where no monitor holds its centre.
///
/// # Safety
/// As [`place`].
unsafe fn on_screen(
    connection: Connection,
    root: u32,
    at: (i32, i32),
    (width, height): (u32, u32),
) -> Option<OnScreen> {
    let centre = (at.0 + width as i32 / 2, at.1 + height as i32 / 2);
    let holds = |m: &Monitor| {
        let inside = |at: i32, start: i16, length: u16| {
            (i32::from(start)..i32::from(start) + i32::from(length)).contains(&at)
        };
        inside(centre.0, m.x, m.width) && inside(centre.1, m.y, m.height)
    };
    // SAFETY: forwarded.
    let monitors = unsafe { monitors(connection, root) };
    if let Some(m) = monitors.into_iter().flatten().find(holds) {
        return Some(OnScreen {
            screen: (m.width.into(), m.height.into()),
            at: (at.0 - i32::from(m.x), at.1 - i32::from(m.y)),
        });
    }
    // SAFETY: forwarded.
    let screen = unsafe { window(connection, root) }?.size;
    Some(OnScreen { screen, at })
}
