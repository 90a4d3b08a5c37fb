//! Loads libraries by name, and finds functions in them.

use core::ffi::{CStr, c_void};
use libloading::Library;
use manyview_core::gl::Ptr;

/// Loads a library for the life of the process.
pub(crate) fn load(name: &str) -> Result<&'static Library, String> {
    // SAFETY: a system library of OpenGL or X11; its initialisers are what every program of its kind runs.
    match unsafe { Library::new(name) } {
        Ok(library) => Ok(Box::leak(Box::new(library))),
        Err(_) => Err(format!("{name} is not installed")),
    }
}

/// The address of a function of a library, null if it has none of that name.
pub(crate) fn symbol(library: &Library, name: &CStr) -> Ptr {
    // SAFETY: the address is only kept, not called, as a pointer.
    unsafe { library.get::<*mut c_void>(name.to_bytes_with_nul()) }
        .map_or(core::ptr::null_mut(), |symbol| *symbol)
}

/// Whether an address lies in a library with this file name.
pub(crate) fn lies_in(address: Ptr, file: &str) -> bool {
    // SAFETY: all-zero is a valid Dl_info.
    let mut info: libc::Dl_info = unsafe { core::mem::zeroed() };
    // SAFETY: any address may be asked about.
    // SAFETY: info is ours and lives across the call.
    if unsafe { libc::dladdr(address, &mut info) } == 0 || info.dli_fname.is_null() {
        return false;
    }
    // SAFETY: the dynamic linker's string, which ends in NUL and lives as long as the library.
    let path = unsafe { CStr::from_ptr(info.dli_fname) }.to_bytes();
    path.rsplit(|&byte| byte == b'/').next() == Some(file.as_bytes())
}

/// A function of a library by name, with its type. If the library has none, the enclosing function returns an `Err` that names it.
macro_rules! function {
    ($library:expr, $name:literal, $type:ty) => {{
        let pointer = $crate::library::symbol($library, $name);
        if pointer.is_null() {
            return Err(format!("the library has no {}", $name.to_string_lossy()));
        }
        // SAFETY: not null, and the function of this name has this signature (the caller's header).
        unsafe { core::mem::transmute::<manyview_core::gl::Ptr, $type>(pointer) }
    }};
}
pub(crate) use function;
