//! An EGL context for a pbuffer, on the default display or without any. Signatures: EGL/egl.h, EGL/eglext.h.

use crate::Context;
use crate::library::{function, load, symbol};
use core::ffi::{CStr, c_char, c_int, c_uint};
use libloading::Library;
use manyview_core::gl::{Ptr, Real};
use std::sync::OnceLock;

const EGL_OPENGL_API: c_uint = 0x30A2;
const EGL_OPENGL_ES_API: c_uint = 0x30A0;
const EGL_NONE: c_int = 0x3038;
const EGL_MAJOR_VERSION: c_int = 0x3098;
const EGL_MINOR_VERSION: c_int = 0x30FB;
const EGL_PROFILE_MASK: c_int = 0x30FD;
const EGL_PLATFORM_SURFACELESS_MESA: c_uint = 0x31DD;
/// EGL_SURFACE_TYPE: EGL_PBUFFER_BIT; EGL_RENDERABLE_TYPE: EGL_OPENGL_BIT; EGL_DEPTH_SIZE: 1
const CONFIG: [c_int; 7] = [0x3033, 1, 0x3040, 8, 0x3025, 1, EGL_NONE];
/// The same with EGL_OPENGL_ES2_BIT.
const ES_CONFIG: [c_int; 7] = [0x3033, 1, 0x3040, 4, 0x3025, 1, EGL_NONE];
/// EGL_WIDTH and EGL_HEIGHT: 1
const PBUFFER: [c_int; 5] = [0x3057, 1, 0x3056, 1, EGL_NONE];

type GetProcAddress = unsafe extern "C" fn(*const c_char) -> Ptr;
type GetDisplay = unsafe extern "C" fn(Ptr) -> Ptr;
type GetPlatformDisplay = unsafe extern "C" fn(c_uint, Ptr, *const c_int) -> Ptr;
type Initialize = unsafe extern "C" fn(Ptr, *mut c_int, *mut c_int) -> c_uint;
type BindApi = unsafe extern "C" fn(c_uint) -> c_uint;
type ChooseConfig = unsafe extern "C" fn(Ptr, *const c_int, *mut Ptr, c_int, *mut c_int) -> c_uint;
type CreatePbuffer = unsafe extern "C" fn(Ptr, Ptr, *const c_int) -> Ptr;
type CreateContext = unsafe extern "C" fn(Ptr, Ptr, Ptr, *const c_int) -> Ptr;
type MakeCurrent = unsafe extern "C" fn(Ptr, Ptr, Ptr, Ptr) -> c_uint;

struct Source {
    get: GetProcAddress,
    /// The library of GL, for drivers whose eglGetProcAddress knows only extensions.
    gl: Option<&'static Library>,
}

static SOURCE: OnceLock<Source> = OnceLock::new();
static REAL: Real = Real::new(|name| Some(find(name)));

pub(crate) fn find(name: &CStr) -> Ptr {
    let Some(source) = SOURCE.get() else {
        return core::ptr::null_mut();
    };
    let linked = source
        .gl
        .map_or(core::ptr::null_mut(), |library| symbol(library, name));
    if linked.is_null() {
        // SAFETY: a string that ends in NUL.
        unsafe { (source.get)(name.as_ptr()) }
    } else {
        linked
    }
}

/// The API and profile of a context.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// The context of a program that asks for no version.
    Legacy,
    Compatibility,
    Core,
    Es,
}

impl Kind {
    fn api(self) -> c_uint {
        match self {
            Kind::Es => EGL_OPENGL_ES_API,
            _ => EGL_OPENGL_API,
        }
    }

    /// Lists of attributes to try, the newest version first.
    fn attributes(self) -> Vec<Vec<c_int>> {
        let versions: &[(c_int, c_int)] = match self {
            Kind::Legacy => return vec![vec![EGL_NONE]],
            Kind::Es => &[(3, 2), (3, 1), (3, 0), (2, 0)],
            _ => &[(4, 6), (4, 5), (4, 3), (4, 2), (3, 3), (3, 2)],
        };
        let list = |&(major, minor): &(c_int, c_int)| {
            let mut list = vec![EGL_MAJOR_VERSION, major, EGL_MINOR_VERSION, minor];
            match self {
                Kind::Core => list.extend([EGL_PROFILE_MASK, 1]),
                Kind::Compatibility => list.extend([EGL_PROFILE_MASK, 2]),
                Kind::Legacy | Kind::Es => {}
            }
            list.push(EGL_NONE);
            list
        };
        versions.iter().map(list).collect()
    }
}

/// Makes a desktop OpenGL context current with a pbuffer of one pixel.
pub(crate) fn context() -> Result<Context, String> {
    make(Kind::Legacy)
}

/// Makes a new context current with a pbuffer of one pixel. A context that was current before is not destroyed.
pub(crate) fn make(kind: Kind) -> Result<Context, String> {
    let egl = load("libEGL.so.1")?;
    let get = function!(egl, c"eglGetProcAddress", GetProcAddress);
    let gl = ["libOpenGL.so.0", "libGL.so.1"];
    let gl = gl.iter().find_map(|name| load(name).ok());
    SOURCE.get_or_init(|| Source { get, gl });
    let display = display(egl, get)?;
    let bind_api = function!(egl, c"eglBindAPI", BindApi);
    let choose = function!(egl, c"eglChooseConfig", ChooseConfig);
    let pbuffer = function!(egl, c"eglCreatePbufferSurface", CreatePbuffer);
    let create = function!(egl, c"eglCreateContext", CreateContext);
    let make_current = function!(egl, c"eglMakeCurrent", MakeCurrent);
    let none = core::ptr::null_mut();
    let (mut config, mut count) = (none, 0);
    // SAFETY: no pointers.
    if unsafe { bind_api(kind.api()) } == 0 {
        return Err("EGL has no such API here".to_owned());
    }
    let wanted = if kind == Kind::Es { ES_CONFIG } else { CONFIG };
    // SAFETY: an initialised display; a list that ends in EGL_NONE; room for one configuration and one number.
    let chosen = unsafe { choose(display, wanted.as_ptr(), &raw mut config, 1, &raw mut count) };
    if chosen == 0 || count < 1 {
        return Err("EGL has no configuration with a pbuffer for OpenGL".to_owned());
    }
    // SAFETY: display and configuration from above; a list that ends in EGL_NONE.
    let surface = unsafe { pbuffer(display, config, PBUFFER.as_ptr()) };
    let context = kind.attributes().iter().find_map(|list| {
        // SAFETY: as above; no context to share with.
        let context = unsafe { create(display, config, none, list.as_ptr()) };
        (!context.is_null()).then_some(context)
    });
    let Some(context) = context.filter(|_| !surface.is_null()) else {
        return Err("EGL gives no context for OpenGL".to_owned());
    };
    // SAFETY: all three were just made.
    if unsafe { make_current(display, surface, surface, context) } == 0 {
        return Err("eglMakeCurrent fails".to_owned());
    }
    Ok(Context {
        real: &REAL,
        sample: symbol(egl, c"eglMakeCurrent"),
    })
}

/// The default display, or Mesa's surfaceless one.
fn display(egl: &Library, get: GetProcAddress) -> Result<Ptr, String> {
    let get_display = function!(egl, c"eglGetDisplay", GetDisplay);
    let initialize = function!(egl, c"eglInitialize", Initialize);
    // SAFETY: EGL_DEFAULT_DISPLAY is null.
    let default = unsafe { get_display(core::ptr::null_mut()) };
    let (mut major, mut minor) = (0, 0);
    // SAFETY: a display; room for two numbers.
    if !default.is_null() && unsafe { initialize(default, &raw mut major, &raw mut minor) } != 0 {
        return Ok(default);
    }
    // SAFETY: a string that ends in NUL.
    let platform = unsafe { get(c"eglGetPlatformDisplayEXT".as_ptr()) };
    if platform.is_null() {
        return Err("EGL has no display".to_owned());
    }
    // SAFETY: the function of this name has this signature.
    let platform = unsafe { core::mem::transmute::<Ptr, GetPlatformDisplay>(platform) };
    let none = core::ptr::null_mut();
    // SAFETY: this platform takes no native display; no attributes.
    let display = unsafe { platform(EGL_PLATFORM_SURFACELESS_MESA, none, core::ptr::null()) };
    // SAFETY: a display; room for two numbers.
    if !display.is_null() && unsafe { initialize(display, &raw mut major, &raw mut minor) } != 0 {
        return Ok(display);
    }
    Err("EGL has no display".to_owned())
}
