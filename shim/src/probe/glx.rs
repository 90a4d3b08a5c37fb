//! A GLX context for a window that is never shown. Signatures: X11/Xlib.h, X11/Xutil.h, GL/glx.h.

use crate::Context;
use crate::library::{function, load, symbol};
use core::ffi::{CStr, c_char, c_int, c_long, c_uint, c_ulong};
use libloading::Library;
use manyview_core::gl::{Ptr, Real};
use std::sync::OnceLock;

/// GLX_RGBA; GLX_DEPTH_SIZE: 1; GLX_DOUBLEBUFFER; None
const DOUBLE: [c_int; 5] = [4, 12, 1, 5, 0];
/// GLX_RGBA; None
const ANY: [c_int; 2] = [4, 0];
const INPUT_OUTPUT: c_uint = 1;
const ALLOC_NONE: c_int = 0;
/// CWBorderPixel and CWColormap
const VALUES: c_ulong = 1 << 3 | 1 << 13;

/// XVisualInfo
#[repr(C)]
struct VisualInfo {
    visual: Ptr,
    id: c_ulong,
    screen: c_int,
    depth: c_int,
    class: c_int,
    masks: [c_ulong; 3],
    colormap_size: c_int,
    bits_per_rgb: c_int,
}

/// XSetWindowAttributes. More than 12 fields: Xlib's.
#[repr(C)]
struct Attributes {
    background_pixmap: c_ulong,
    background_pixel: c_ulong,
    border_pixmap: c_ulong,
    border_pixel: c_ulong,
    bit_gravity: c_int,
    win_gravity: c_int,
    backing_store: c_int,
    backing_planes: c_ulong,
    backing_pixel: c_ulong,
    save_under: c_int,
    event_mask: c_long,
    do_not_propagate_mask: c_long,
    override_redirect: c_int,
    colormap: c_ulong,
    cursor: c_ulong,
}

type OpenDisplay = unsafe extern "C" fn(*const c_char) -> Ptr;
type DefaultScreen = unsafe extern "C" fn(Ptr) -> c_int;
type RootWindow = unsafe extern "C" fn(Ptr, c_int) -> c_ulong;
type CreateColormap = unsafe extern "C" fn(Ptr, c_ulong, Ptr, c_int) -> c_ulong;
type CreateWindow = unsafe extern "C" fn(
    Ptr,
    c_ulong,
    c_int,
    c_int,
    c_uint,
    c_uint,
    c_uint,
    c_int,
    c_uint,
    Ptr,
    c_ulong,
    *mut Attributes,
) -> c_ulong;
type ChooseVisual = unsafe extern "C" fn(Ptr, c_int, *mut c_int) -> *mut VisualInfo;
type CreateContext = unsafe extern "C" fn(Ptr, *mut VisualInfo, Ptr, c_int) -> Ptr;
type MakeCurrent = unsafe extern "C" fn(Ptr, c_ulong, Ptr) -> c_int;
type GetProcAddress = unsafe extern "C" fn(*const c_char) -> Ptr;

static SOURCE: OnceLock<(&'static Library, GetProcAddress)> = OnceLock::new();
static REAL: Real = Real::new(|name| Some(find(name)));

fn find(name: &CStr) -> Ptr {
    let Some((library, get)) = SOURCE.get() else {
        return core::ptr::null_mut();
    };
    let linked = symbol(library, name);
    if linked.is_null() {
        // SAFETY: a string that ends in NUL.
        unsafe { get(name.as_ptr()) }
    } else {
        linked
    }
}

/// Makes a direct context current with a window of one pixel.
pub(crate) fn context() -> Result<Context, String> {
    let x11 = load("libX11.so.6")?;
    let gl = load("libGL.so.1")?;
    let get = function!(gl, c"glXGetProcAddressARB", GetProcAddress);
    SOURCE.get_or_init(|| (gl, get));
    let open = function!(x11, c"XOpenDisplay", OpenDisplay);
    let choose = function!(gl, c"glXChooseVisual", ChooseVisual);
    let create = function!(gl, c"glXCreateContext", CreateContext);
    let make_current = function!(gl, c"glXMakeCurrent", MakeCurrent);
    let screen = function!(x11, c"XDefaultScreen", DefaultScreen);
    // SAFETY: null stands for the variable DISPLAY.
    let display = unsafe { open(core::ptr::null()) };
    if display.is_null() {
        let name = std::env::var("DISPLAY").unwrap_or_default();
        return Err(if name.is_empty() {
            "DISPLAY is not set".to_owned()
        } else {
            format!("no X server answers at {name}")
        });
    }
    // SAFETY: an open display.
    let screen = unsafe { screen(display) };
    let (mut double, mut any) = (DOUBLE, ANY);
    // SAFETY: an open display and its screen; a list that ends in None.
    let mut visual = unsafe { choose(display, screen, double.as_mut_ptr()) };
    if visual.is_null() {
        // SAFETY: as above.
        visual = unsafe { choose(display, screen, any.as_mut_ptr()) };
    }
    if visual.is_null() {
        return Err("the X server has no visual for OpenGL".to_owned());
    }
    // SAFETY: an open display, its screen and a visual of it.
    let window = unsafe { window(x11, display, screen, visual) }?;
    // SAFETY: a visual of this display; no context to share with; 1 asks for direct rendering.
    let context = unsafe { create(display, visual, core::ptr::null_mut(), 1) };
    if context.is_null() {
        return Err("glXCreateContext gives no context".to_owned());
    }
    // SAFETY: window and context were just made with the same visual.
    if unsafe { make_current(display, window, context) } == 0 {
        return Err("glXMakeCurrent fails".to_owned());
    }
    Ok(Context {
        real: &REAL,
        sample: symbol(gl, c"glXMakeCurrent"),
    })
}

/// A window of one pixel, not mapped.
///
/// # Safety
/// An open display, its screen and a visual that glXChooseVisual gave for them.
unsafe fn window(
    x11: &Library,
    display: Ptr,
    screen: c_int,
    visual: *mut VisualInfo,
) -> Result<c_ulong, String> {
    let root = function!(x11, c"XRootWindow", RootWindow);
    let colormap = function!(x11, c"XCreateColormap", CreateColormap);
    let create = function!(x11, c"XCreateWindow", CreateWindow);
    // SAFETY: glXChooseVisual gave it and it is not freed.
    let visual = unsafe { &*visual };
    // SAFETY: all-zero is a valid XSetWindowAttributes.
    let mut attributes: Attributes = unsafe { core::mem::zeroed() };
    // SAFETY: an open display and its screen.
    let root = unsafe { root(display, screen) };
    // SAFETY: display, window and visual belong together.
    attributes.colormap = unsafe { colormap(display, root, visual.visual, ALLOC_NONE) };
    // SAFETY: as above; `attributes` lives across the call and holds what VALUES names.
    let window = unsafe {
        create(
            display,
            root,
            0,
            0,
            1,
            1,
            0,
            visual.depth,
            INPUT_OUTPUT,
            visual.visual,
            VALUES,
            &raw mut attributes,
        )
    };
    if window == 0 {
        return Err("the X server gives no window".to_owned());
    }
    Ok(window)
}
