//! Finds the driver's functions: one table per provider.

use core::ffi::{CStr, c_char, c_int, c_void};
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

    /// Further libraries of its kind, in which programs look for functions.
    fn more_libraries(self) -> &'static [&'static CStr] {
        match self {
            Provider::Gl => &[c"libGLESv1_CM.so.1", c"libGLdispatch.so.0"],
            Provider::OsMesa => &[],
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

/// The provider in whose library an address lies. A program may have libraries of its own with such names (ANGLE's libEGL.so), also in a
/// namespace of the linker, so it is the loaded object that counts.
pub(crate) fn provider_of(p: *const c_void) -> Option<Provider> {
    let object = linked_object(p)?;
    let holds = |provider: &Provider| {
        let all = provider.libraries().iter().chain(provider.more_libraries());
        all.into_iter().any(|library| handle(library) == object)
    };
    [Provider::Gl, Provider::OsMesa].into_iter().find(holds)
}

/// Whether a file, without its folder, is named as one of GL's own libraries, which call each other.
pub(crate) fn is_name_of_gl(file: &[u8]) -> bool {
    const BEGINNINGS: [&str; 9] = [
        "libGL.so",
        "libGLX",
        "libGLdispatch.so",
        "libGLES",
        "libEGL",
        "libOpenGL.so",
        "libOSMesa.so",
        "libnvidia-",
        "libglapi.so",
    ];
    BEGINNINGS.iter().any(|b| file.starts_with(b.as_bytes()))
}

/// Whether an address lies in a library that is named as one of GL's.
pub(crate) fn is_named_as_gl(p: *const c_void) -> bool {
    object(p).is_some_and(|(_, file)| is_name_of_gl(&file))
}

unsafe extern "C" {
    fn dladdr1(
        address: *const c_void,
        info: *mut libc::Dl_info,
        extra: *mut *mut c_void,
        flags: c_int,
    ) -> c_int;
}

const RTLD_DL_LINKMAP: c_int = 2;

/// The linker's record of the object that holds an address. A handle of dlopen is the address of such a record (glibc).
fn linked_object(p: *const c_void) -> Option<*mut c_void> {
    // SAFETY: all-zero is a valid Dl_info.
    let mut info: libc::Dl_info = unsafe { core::mem::zeroed() };
    let mut record = core::ptr::null_mut();
    // SAFETY: any address may be asked about; the others are ours.
    let found = unsafe { dladdr1(p, &mut info, &mut record, RTLD_DL_LINKMAP) };
    (found != 0 && !record.is_null()).then_some(record)
}

type Dlopen = unsafe extern "C" fn(*const c_char, c_int) -> *mut c_void;

/// A library that is loaded, and null for one that is not. It is asked of the dlopen behind ours: a wrapper in front of this library may
/// answer with itself.
fn handle(library: &CStr) -> *mut c_void {
    static BEHIND: AtomicPtr<c_void> = AtomicPtr::new(core::ptr::null_mut());
    let mut p = BEHIND.load(Relaxed);
    if p.is_null() {
        p = symbol(libc::RTLD_NEXT, c"dlopen");
        BEHIND.store(p, Relaxed);
    }
    if p.is_null() {
        return p;
    }
    // SAFETY: the symbol is dlopen.
    let dlopen = unsafe { core::mem::transmute::<*mut c_void, Dlopen>(p) };
    // SAFETY: a string; NOLOAD only finds what is there.
    unsafe { dlopen(library.as_ptr(), libc::RTLD_NOLOAD | libc::RTLD_LAZY) }
}

/// The symbol that the program would get without us.
pub(crate) fn default_symbol(name: &CStr) -> Option<Ptr> {
    let p = symbol(libc::RTLD_NEXT, name);
    if !p.is_null() && !own(p) {
        return Some(p);
    }
    let found = if Provider::Gl.loaded() {
        find_gl(name)
    } else {
        find_osmesa(name)
    };
    (!found.is_null()).then_some(found)
}

fn load(provider: Provider, name: &CStr) -> Ptr {
    // The next one in load order comes first, so that other preloaded hooks of the same function stay in the chain.
    let p = symbol(libc::RTLD_NEXT, name);
    let fits = || match provider_of(p) {
        Some(other) => other == provider,
        None => !is_named_as_gl(p),
    };
    if !p.is_null() && !own(p) && fits() {
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

/// See [`Real::new`].
fn load_gl(name: &CStr) -> Option<Ptr> {
    let found = find_gl(name);
    (!found.is_null() || has(name.to_bytes())).then_some(found)
}

/// See [`Real::new`].
fn load_osmesa(name: &CStr) -> Option<Ptr> {
    let found = find_osmesa(name);
    (!found.is_null() || Provider::OsMesa.loaded()).then_some(found)
}

fn find_gl(name: &CStr) -> Ptr {
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

fn find_osmesa(name: &CStr) -> Ptr {
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
