//! Finds the driver's functions: one table per provider.

use core::ffi::{CStr, c_char, c_void};
use core::sync::atomic::{AtomicPtr, Ordering::Relaxed};
use manyview_core::gl::{Ptr, Real};

/// The kind of library that made a context. The functions of one do not work with contexts of the other: libOSMesa has a whole GL of
/// its own, while libGL, libOpenGL, libEGL and libGLES share glvnd's dispatch.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Provider {
    /// GLX and EGL.
    Gl,
    /// Off-screen Mesa.
    OsMesa,
}

static GL: Real = Real::new(load_gl);
static OSMESA: Real = Real::new(load_osmesa);

impl Provider {
    /// The table of the driver's functions.
    pub(crate) fn real(self) -> &'static Real {
        #[cfg(all(test, feature = "fake-driver"))]
        if let Some(fake) = crate::tests::driver() {
            return fake;
        }
        match self {
            Provider::Gl => &GL,
            Provider::OsMesa => &OSMESA,
        }
    }

    fn libraries(self) -> &'static [&'static CStr] {
        match self {
            Provider::Gl => &[
                c"libGL.so.1",
                c"libOpenGL.so.0",
                c"libGLX.so.0",
                c"libEGL.so.1",
                c"libGLESv2.so.2",
            ],
            Provider::OsMesa => &[c"libOSMesa.so.8", c"libOSMesa.so.6", c"libOSMesa.so"],
        }
    }

    /// Whether one of its libraries is in the process.
    pub(crate) fn loaded(self) -> bool {
        self.libraries().iter().any(|l| !handle(l).is_null())
    }
}

/// Whether the process has a library for the API that a name belongs to, by its prefix.
pub(crate) fn has(name: &[u8]) -> bool {
    match name {
        [b'e', b'g', b'l', ..] => !handle(c"libEGL.so.1").is_null(),
        [b'g', b'l', b'X', ..] => [c"libGL.so.1", c"libGLX.so.0"]
            .iter()
            .any(|l| !handle(l).is_null()),
        [b'O', ..] => Provider::OsMesa.loaded(),
        _ => Provider::Gl.loaded() || Provider::OsMesa.loaded(),
    }
}

unsafe extern "C" {
    fn dlvsym(handle: *mut c_void, name: *const c_char, version: *const c_char) -> *mut c_void;
}

/// The symbol versions of dlsym in C libraries, by architecture.
#[cfg(target_arch = "x86_64")]
const DLSYM_VERSIONS: [&CStr; 2] = [c"GLIBC_2.2.5", c"GLIBC_2.34"];
#[cfg(target_arch = "x86")]
const DLSYM_VERSIONS: [&CStr; 2] = [c"GLIBC_2.0", c"GLIBC_2.34"];
#[cfg(not(any(target_arch = "x86_64", target_arch = "x86")))]
const DLSYM_VERSIONS: [&CStr; 2] = [c"GLIBC_2.17", c"GLIBC_2.34"];

type Dlsym = unsafe extern "C" fn(*mut c_void, *const c_char) -> *mut c_void;

static NEXT: AtomicPtr<c_void> = AtomicPtr::new(core::ptr::null_mut());

/// The dlsym behind ours: that of another preloaded library, if there is one, else that of the C library. It is looked up by version with
/// dlvsym, because a call of dlsym would reach our own.
pub(crate) fn next_dlsym() -> Option<Dlsym> {
    let mut p = NEXT.load(Relaxed);
    if p.is_null() {
        // SAFETY: dlvsym with constant strings.
        let libc = DLSYM_VERSIONS
            .iter()
            .map(|v| unsafe { dlvsym(libc::RTLD_NEXT, c"dlsym".as_ptr(), v.as_ptr()) })
            .find(|p| !p.is_null())?;
        // SAFETY: the symbol is dlsym.
        let dlsym = unsafe { core::mem::transmute::<*mut c_void, Dlsym>(libc) };
        // SAFETY: dlsym with a constant string.
        let next = unsafe { dlsym(libc::RTLD_NEXT, c"dlsym".as_ptr()) };
        p = if next.is_null() || own(next) {
            libc
        } else {
            next
        };
        NEXT.store(p, Relaxed);
    }
    // SAFETY: only addresses of dlsym functions are stored.
    Some(unsafe { core::mem::transmute::<*mut c_void, Dlsym>(p) })
}

/// Calls the dlsym behind ours.
pub(crate) fn symbol(handle: *mut c_void, name: &CStr) -> Ptr {
    match next_dlsym() {
        // SAFETY: a handle of the dynamic linker (or RTLD_NEXT) and a string.
        Some(dlsym) => unsafe { dlsym(handle, name.as_ptr()) },
        None => core::ptr::null_mut(),
    }
}

/// Base address and file name of the object that holds an address.
fn object(p: *const c_void) -> Option<(usize, Vec<u8>)> {
    // SAFETY: all-zero is a valid Dl_info.
    let mut info: libc::Dl_info = unsafe { core::mem::zeroed() };
    // SAFETY: any address may be asked about; info is ours.
    if unsafe { libc::dladdr(p, &mut info) } == 0 || info.dli_fname.is_null() {
        return None;
    }
    // SAFETY: the dynamic linker's string.
    let file = unsafe { CStr::from_ptr(info.dli_fname) }.to_bytes();
    let base = file.rsplit(|&b| b == b'/').next().unwrap_or(file);
    Some((info.dli_fbase as usize, base.to_vec()))
}

/// Whether an address lies in this library.
pub(crate) fn own(p: *const c_void) -> bool {
    static MARK: u8 = 0;
    match (object(p), object((&raw const MARK).cast())) {
        (Some(a), Some(b)) => a.0 == b.0,
        _ => false,
    }
}

/// The provider in whose library an address lies. Look-alikes of GL (such as ANGLE's libEGL) have other file names, or our lookups do
/// not find them.
pub(crate) fn provider_of(p: *const c_void) -> Option<Provider> {
    let (_, file) = object(p)?;
    let starts = |prefix: &str| file.starts_with(prefix.as_bytes());
    if starts("libOSMesa.") {
        return Some(Provider::OsMesa);
    }
    let gl = [
        "libGL.",
        "libGLX",
        "libOpenGL.",
        "libEGL",
        "libGLES",
        "libGLdispatch.",
        "libnvidia-gl",
        "libglapi.",
    ];
    gl.iter().any(|g| starts(g)).then_some(Provider::Gl)
}

fn handle(library: &CStr) -> *mut c_void {
    // SAFETY: a string; NOLOAD only finds what is there.
    unsafe { libc::dlopen(library.as_ptr(), libc::RTLD_NOLOAD | libc::RTLD_LAZY) }
}

/// The symbol that the program would get without us.
pub(crate) fn default_symbol(name: &CStr) -> Option<Ptr> {
    let p = symbol(libc::RTLD_NEXT, name);
    if !p.is_null() && !own(p) {
        return Some(p);
    }
    let found = if Provider::Gl.loaded() {
        load_gl(name)
    } else {
        load_osmesa(name)
    };
    (!found.is_null()).then_some(found)
}

fn load(provider: Provider, name: &CStr) -> Ptr {
    // The next one in load order comes first, so that other preloaded hooks of the same function stay in the chain.
    let p = symbol(libc::RTLD_NEXT, name);
    if !p.is_null() && !own(p) && provider_of(p).is_none_or(|q| q == provider) {
        return p;
    }
    provider
        .libraries()
        .iter()
        .map(|l| handle(l))
        .filter(|h| !h.is_null())
        .map(|h| symbol(h, name))
        .find(|p| !p.is_null() && !own(*p))
        .unwrap_or(core::ptr::null_mut())
}

fn load_gl(name: &CStr) -> Ptr {
    let p = load(Provider::Gl, name);
    if !p.is_null() {
        return p;
    }
    // Extension functions may have no symbols. Those of a window system are known only to its own library.
    let functions: &[&CStr] = match name.to_bytes() {
        [b'e', b'g', b'l', ..] => &[c"eglGetProcAddress"],
        [b'g', b'l', b'X', ..] => &[c"glXGetProcAddressARB"],
        [b'g', b'l', ..] => &[c"glXGetProcAddressARB", c"eglGetProcAddress"],
        _ => return p,
    };
    by_address_function(Provider::Gl, functions, name)
}

fn load_osmesa(name: &CStr) -> Ptr {
    let p = load(Provider::OsMesa, name);
    if p.is_null() {
        by_address_function(Provider::OsMesa, &[c"OSMesaGetProcAddress"], name)
    } else {
        p
    }
}

fn by_address_function(provider: Provider, functions: &[&CStr], name: &CStr) -> Ptr {
    for f in functions {
        let f = load(provider, f);
        if f.is_null() {
            continue;
        }
        // SAFETY: the GetProcAddress functions take a string and give an address.
        let f =
            unsafe { core::mem::transmute::<Ptr, unsafe extern "C" fn(*const c_char) -> Ptr>(f) };
        // SAFETY: a string that ends in NUL.
        let p = unsafe { f(name.as_ptr()) };
        if !p.is_null() && !own(p) {
            return p;
        }
    }
    core::ptr::null_mut()
}
