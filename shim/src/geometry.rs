//! Size of a GLX drawable, and where a window lies on the screen.

use crate::provider::{Provider, symbol};
use core::ffi::{CStr, c_ulong, c_void};
use manyview_core::gl::Ptr;
use manyview_core::layer::OnScreen;

/// xcb_get_geometry_reply_t
#[repr(C)]
struct Geometry {
    head: [u8; 8],
    root: u32,
    x: i16,
    y: i16,
    width: u16,
    height: u16,
    border: u16,
    pad: [u8; 2],
}

/// xcb_translate_coordinates_reply_t
#[repr(C)]
struct Translated {
    head: [u8; 12],
    x: i16,
    y: i16,
}

/// xcb_randr_monitor_info_t
#[repr(C)]
#[derive(Clone, Copy)]
struct Monitor {
    head: [u8; 8],
    x: i16,
    y: i16,
    width: u16,
    height: u16,
    millimetres: [u32; 2],
}

/// xcb_randr_monitor_info_iterator_t
#[repr(C)]
struct Monitors {
    data: *const Monitor,
    rest: i32,
    index: i32,
}

/// An xcb_connection_t.
pub(crate) type Connection = Ptr;

/// A function (or a variable) of a library that the driver has loaded.
pub(crate) fn function(library: &CStr, name: &CStr) -> Option<Ptr> {
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

/// The xcb connection of a Display.
///
/// # Safety
/// An open Display.
pub(crate) unsafe fn connection(display: Ptr) -> Option<Connection> {
    let get = function(c"libX11-xcb.so.1", c"XGetXCBConnection")?;
    // SAFETY: the signature of X11/Xlib-xcb.h.
    let connection =
        unsafe { core::mem::transmute::<Ptr, unsafe extern "C" fn(Ptr) -> Ptr>(get)(display) };
    (!connection.is_null()).then_some(connection)
}

/// What a request is answered by; freed here.
///
/// # Safety
/// `reply` is the `xcb_…_reply` that belongs to the cookie, and `R` the beginning of its struct.
unsafe fn answer<R, T>(
    connection: Ptr,
    reply: Ptr,
    cookie: u32,
    read: impl FnOnce(&R) -> T,
) -> Option<T> {
    type Reply = unsafe extern "C" fn(Ptr, u32, *mut *mut c_void) -> *mut c_void;
    let mut error: *mut c_void = core::ptr::null_mut();
    // SAFETY: all these functions have this signature (xcb/xproto.h, xcb/randr.h); a cookie is one u32 in a struct. The reply and the
    // error are allocated by malloc and freed by us.
    unsafe {
        let found = core::mem::transmute::<Ptr, Reply>(reply)(connection, cookie, &mut error);
        let value = (!found.is_null()).then(|| read(&*found.cast::<R>()));
        libc::free(found);
        libc::free(error);
        value
    }
}

/// What a Display was opened with.
///
/// # Safety
/// As [`glx_size`].
pub(crate) unsafe fn display_name(display: Ptr) -> Option<String> {
    let name = function(c"libX11.so.6", c"XDisplayString")?;
    type Name = unsafe extern "C" fn(Ptr) -> *const core::ffi::c_char;
    // SAFETY: the signature of X11/Xlib.h; the string lives as long as the Display.
    unsafe {
        let name = core::mem::transmute::<Ptr, Name>(name)(display);
        (!name.is_null()).then(|| CStr::from_ptr(name).to_string_lossy().into_owned())
    }
}

/// Width, height and root of a window (or the root itself).
unsafe fn window(connection: Ptr, window: u32) -> Option<(u32, u32, u32)> {
    let ask = function(c"libxcb.so.1", c"xcb_get_geometry")?;
    let reply = function(c"libxcb.so.1", c"xcb_get_geometry_reply")?;
    // SAFETY: the signatures of xcb/xproto.h.
    unsafe {
        let cookie = core::mem::transmute::<Ptr, unsafe extern "C" fn(Ptr, u32) -> u32>(ask)(
            connection, window,
        );
        answer(connection, reply, cookie, |r: &Geometry| {
            (r.width.into(), r.height.into(), r.root)
        })
    }
}

unsafe fn window_size(display: Ptr, drawable: c_ulong) -> Option<(u32, u32)> {
    // SAFETY: forwarded.
    unsafe { window(connection(display)?, drawable as u32) }
        .map(|(width, height, _)| (width, height))
}

/// Frames after which monitors are asked again, though the window stays: they may have changed.
const ASK_AGAIN: u32 = 60;

/// What is known of a window since it was last looked at closely.
#[derive(Clone, Copy)]
pub(crate) struct Seen {
    connection: Connection,
    window: u32,
    root: u32,
    size: (u32, u32),
    at: (i32, i32),
    on_screen: OnScreen,
    /// Frames since then.
    frames: u32,
}

/// Where a window lies on the monitor that has its centre. None for what is no window. A frame asks only where the window is, unless
/// that, or its `size`, is another than before.
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
        let (width, height, root) = window(connection, number)?;
        let at = translated(connection, number, root)?;
        let on_screen = on_screen(connection, root, at, (width, height))?;
        *seen = Some(Seen {
            connection,
            window: number,
            root,
            size,
            at,
            on_screen,
            frames: 0,
        });
        Some(on_screen)
    }
}

/// The left top corner of a window on its root.
///
/// # Safety
/// As [`place`].
unsafe fn translated(connection: Connection, window: u32, root: u32) -> Option<(i32, i32)> {
    let translate = function(c"libxcb.so.1", c"xcb_translate_coordinates")?;
    let reply = function(c"libxcb.so.1", c"xcb_translate_coordinates_reply")?;
    type Translate = unsafe extern "C" fn(Ptr, u32, u32, i16, i16) -> u32;
    // SAFETY: the signatures of xcb/xproto.h; forwarded.
    unsafe {
        let cookie =
            core::mem::transmute::<Ptr, Translate>(translate)(connection, window, root, 0, 0);
        answer(connection, reply, cookie, |r: &Translated| {
            (i32::from(r.x), i32::from(r.y))
        })
    }
}

/// Where a window of this place and size on the root lies on its monitor, or on the whole screen.
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
    let (width, height, _) = unsafe { window(connection, root) }?;
    Some(OnScreen {
        screen: (width, height),
        at,
    })
}

/// The monitors of a screen. None where the driver did not load RandR's library, or the server has none.
///
/// # Safety
/// A connection of the program, and the root of one of its screens.
unsafe fn monitors(connection: Ptr, root: u32) -> Option<Vec<Monitor>> {
    const LIBRARY: &CStr = c"libxcb-randr.so.0";
    let ask = function(LIBRARY, c"xcb_randr_get_monitors")?;
    let reply = function(LIBRARY, c"xcb_randr_get_monitors_reply")?;
    let first = function(LIBRARY, c"xcb_randr_get_monitors_monitors_iterator")?;
    let next = function(LIBRARY, c"xcb_randr_monitor_info_next")?;
    // SAFETY: the signatures of xcb/randr.h; the iterator stays inside the reply, which lives until `answer` ends.
    unsafe {
        let cookie = core::mem::transmute::<Ptr, unsafe extern "C" fn(Ptr, u32, u8) -> u32>(ask)(
            connection, root, 1,
        );
        answer(connection, reply, cookie, |r: &c_void| {
            let first =
                core::mem::transmute::<Ptr, unsafe extern "C" fn(*const c_void) -> Monitors>(first);
            let next = core::mem::transmute::<Ptr, unsafe extern "C" fn(*mut Monitors)>(next);
            let mut at = first(r);
            let mut all = Vec::new();
            while at.rest > 0 && !at.data.is_null() {
                all.push(at.data.read_unaligned());
                next(&mut at);
            }
            all
        })
    }
}
