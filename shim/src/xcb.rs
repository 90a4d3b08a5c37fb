//! The requests of xcb and Xlib that the shim makes. Most use xcb, which returns errors as values; an X error through Xlib would end the program.

use crate::loaded::functions;
use core::ffi::{CStr, c_char, c_int, c_uint, c_void};
use manyview_core::gl::Ptr;

/// An xcb_connection_t.
pub(crate) type Connection = Ptr;

/// An xcb_…_cookie_t. It is a struct, because some calling conventions (such as that of 32-bit x86) return a struct differently from a number.
#[repr(C)]
#[derive(Clone, Copy)]
struct Cookie {
    sequence: c_uint,
}

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

/// xcb_query_pointer_reply_t
#[repr(C)]
struct Pointer {
    head: [u8; 20],
    x: i16,
    y: i16,
}

/// xcb_randr_monitor_info_t
#[repr(C)]
#[derive(Clone, Copy)]
pub(crate) struct Monitor {
    head: [u8; 8],
    pub(crate) x: i16,
    pub(crate) y: i16,
    pub(crate) width: u16,
    pub(crate) height: u16,
    millimetres: [u32; 2],
}

/// xcb_randr_monitor_info_iterator_t
#[repr(C)]
struct Monitors {
    data: *const Monitor,
    rest: c_int,
    index: c_int,
}

/// A window, or the root itself.
#[derive(Clone, Copy)]
pub(crate) struct Window {
    /// Width and height in pixels.
    pub(crate) size: (u32, u32),
    pub(crate) root: u32,
}

/// The type of every `xcb_…_reply` function.
type Reply = unsafe extern "C" fn(Connection, Cookie, *mut *mut c_void) -> *mut c_void;

functions!(Xlib, c"libX11.so.6", {
    display_string = c"XDisplayString": unsafe extern "C" fn(Ptr) -> *const c_char,
});

functions!(XlibXcb, c"libX11-xcb.so.1", {
    connection = c"XGetXCBConnection": unsafe extern "C" fn(Ptr) -> Connection,
});

functions!(Core, c"libxcb.so.1", {
    geometry = c"xcb_get_geometry": unsafe extern "C" fn(Connection, u32) -> Cookie,
    geometry_reply = c"xcb_get_geometry_reply": Reply,
    translate = c"xcb_translate_coordinates": unsafe extern "C" fn(Connection, u32, u32, i16, i16) -> Cookie,
    translate_reply = c"xcb_translate_coordinates_reply": Reply,
    pointer = c"xcb_query_pointer": unsafe extern "C" fn(Connection, u32) -> Cookie,
    pointer_reply = c"xcb_query_pointer_reply": Reply,
});

functions!(RandR, c"libxcb-randr.so.0", {
    monitors = c"xcb_randr_get_monitors": unsafe extern "C" fn(Connection, u32, u8) -> Cookie,
    monitors_reply = c"xcb_randr_get_monitors_reply": Reply,
    first = c"xcb_randr_get_monitors_monitors_iterator": unsafe extern "C" fn(*const c_void) -> Monitors,
    next = c"xcb_randr_monitor_info_next": unsafe extern "C" fn(*mut Monitors),
});

/// The xcb connection of a Display.
///
/// # Safety
/// An open Display.
pub(crate) unsafe fn connection(display: Ptr) -> Option<Connection> {
    let xlib = XlibXcb::get()?;
    // SAFETY: forwarded.
    let connection = unsafe { (xlib.connection)(display) };
    (!connection.is_null()).then_some(connection)
}

/// The name that a Display was opened with.
///
/// # Safety
/// An open Display.
pub(crate) unsafe fn display_name(display: Ptr) -> Option<String> {
    let xlib = Xlib::get()?;
    // SAFETY: forwarded; the string lives as long as the Display.
    unsafe {
        let name = (xlib.display_string)(display);
        (!name.is_null()).then(|| CStr::from_ptr(name).to_string_lossy().into_owned())
    }
}

/// Waits for the reply to a request, reads a value from it with `read` and frees it. None on an error.
///
/// # Safety
/// `reply` belongs to the request of the cookie, and `R` is the beginning of its struct.
unsafe fn answer<R, T>(
    connection: Connection,
    reply: Reply,
    cookie: Cookie,
    read: impl FnOnce(&R) -> T,
) -> Option<T> {
    let mut error: *mut c_void = core::ptr::null_mut();
    // SAFETY: forwarded; the reply and the error are allocated by malloc, and freed by whoever asked.
    unsafe {
        let found = reply(connection, cookie, &mut error);
        let value = (!found.is_null()).then(|| read(&*found.cast::<R>()));
        libc::free(found);
        libc::free(error);
        value
    }
}

/// Size and root of a window. None if `window` is not a window.
///
/// # Safety
/// An open connection.
pub(crate) unsafe fn window(connection: Connection, window: u32) -> Option<Window> {
    let xcb = Core::get()?;
    // SAFETY: forwarded; request and reply belong to each other.
    unsafe {
        let cookie = (xcb.geometry)(connection, window);
        answer(connection, xcb.geometry_reply, cookie, |r: &Geometry| {
            Window {
                size: (r.width.into(), r.height.into()),
                root: r.root,
            }
        })
    }
}

/// The top left corner of a window on its root, in pixels.
///
/// # Safety
/// An open connection.
pub(crate) unsafe fn translated(
    connection: Connection,
    window: u32,
    root: u32,
) -> Option<(i32, i32)> {
    let xcb = Core::get()?;
    // SAFETY: forwarded; request and reply belong to each other.
    unsafe {
        let cookie = (xcb.translate)(connection, window, root, 0, 0);
        answer(connection, xcb.translate_reply, cookie, |r: &Translated| {
            (i32::from(r.x), i32::from(r.y))
        })
    }
}

/// Where the pointer is, in pixels from the top left corner of a window.
///
/// # Safety
/// An open connection.
pub(crate) unsafe fn pointer(connection: Connection, window: u32) -> Option<(i32, i32)> {
    let xcb = Core::get()?;
    // SAFETY: forwarded; request and reply belong to each other.
    unsafe {
        let cookie = (xcb.pointer)(connection, window);
        answer(connection, xcb.pointer_reply, cookie, |r: &Pointer| {
            (i32::from(r.x), i32::from(r.y))
        })
    }
}

/// The monitors of a screen. None where the process has not loaded RandR's library, or the server has no RandR.
///
/// # Safety
/// An open connection, and the root of one of its screens.
pub(crate) unsafe fn monitors(connection: Connection, root: u32) -> Option<Vec<Monitor>> {
    let randr = RandR::get()?;
    // SAFETY: forwarded; request and reply belong to each other. The iterator stays inside the reply, which lives until `answer` ends.
    unsafe {
        let cookie = (randr.monitors)(connection, root, 1);
        answer(connection, randr.monitors_reply, cookie, |r: &c_void| {
            let mut at = (randr.first)(r);
            let mut all = Vec::new();
            while at.rest > 0 && !at.data.is_null() {
                all.push(at.data.read_unaligned());
                (randr.next)(&mut at);
            }
            all
        })
    }
}
