//! An OSMesa context, which draws to memory. Signatures: GL/osmesa.h.

use crate::Context;
use crate::library::{function, load, symbol};
use core::ffi::{CStr, c_int, c_uint};
use libloading::Library;
use manyview_core::gl::{Ptr, Real};
use std::sync::OnceLock;

const NAMES: [&str; 3] = ["libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"];
const OSMESA_RGBA: c_uint = 0x1908;
const UNSIGNED_BYTE: c_uint = 0x1401;

static LIBRARY: OnceLock<&'static Library> = OnceLock::new();
static REAL: Real = Real::new(|name| Some(find(name)));

fn find(name: &CStr) -> Ptr {
    LIBRARY
        .get()
        .map_or(core::ptr::null_mut(), |library| symbol(library, name))
}

type Create = unsafe extern "C" fn(c_uint, c_int, c_int, c_int, Ptr) -> Ptr;
type MakeCurrent = unsafe extern "C" fn(Ptr, Ptr, c_uint, c_int, c_int) -> u8;

/// Makes a context current that draws to a single pixel.
pub(crate) fn context() -> Result<Context, String> {
    let library = NAMES.iter().find_map(|name| load(name).ok());
    let library = library.ok_or_else(|| format!("{} is not installed", NAMES[0]))?;
    let library = *LIBRARY.get_or_init(|| library);
    let create = function!(library, c"OSMesaCreateContextExt", Create);
    let make_current = function!(library, c"OSMesaMakeCurrent", MakeCurrent);
    let pixel: &'static mut [u8; 4] = Box::leak(Box::new([0; 4]));
    // SAFETY: a format, sizes in bits, no context to share with.
    let context = unsafe { create(OSMESA_RGBA, 24, 8, 0, core::ptr::null_mut()) };
    if context.is_null() {
        return Err("OSMesaCreateContextExt gives no context".to_owned());
    }
    // SAFETY: the context was just made.
    // SAFETY: one RGBA pixel of 4 bytes, never given back.
    if unsafe { make_current(context, pixel.as_mut_ptr().cast(), UNSIGNED_BYTE, 1, 1) } == 0 {
        return Err("OSMesaMakeCurrent fails".to_owned());
    }
    Ok(Context {
        real: &REAL,
        sample: symbol(library, c"OSMesaMakeCurrent"),
    })
}
