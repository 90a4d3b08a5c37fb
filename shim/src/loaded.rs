//! Functions of the libraries that the program or the driver has loaded. They are looked up once.

use crate::provider::symbol;
use core::ffi::CStr;
use manyview_core::gl::Ptr;

/// A function (or a variable) of a library that the program or the driver has loaded. The library stays loaded from then on.
pub(crate) fn function(library: &CStr, name: &CStr) -> Option<Ptr> {
    // SAFETY: a string; NOLOAD only finds what is there.
    let handle = unsafe { libc::dlopen(library.as_ptr(), libc::RTLD_NOLOAD | libc::RTLD_LAZY) };
    if handle.is_null() {
        return None;
    }
    let p = symbol(handle, name);
    (!p.is_null()).then_some(p)
}

/// Defines a table of functions of one library. They are looked up at each use until all are found, and then never again.
macro_rules! functions {
    ($table:ident, $library:literal, { $($field:ident = $name:literal: $kind:ty),+ $(,)? }) => {
        struct $table {
            $($field: $kind),+
        }

        impl $table {
            fn get() -> Option<&'static $table> {
                static TABLE: std::sync::OnceLock<$table> =
                    std::sync::OnceLock::new();
                if let Some(table) = TABLE.get() {
                    return Some(table);
                }
                let table = $table {
                    // SAFETY: functions of these names have these signatures (X11/Xlib.h, X11/Xlib-xcb.h, xcb/xproto.h, xcb/randr.h, wayland-client-core.h,
                    // xkbcommon/xkbcommon.h).
                    $($field: unsafe { core::mem::transmute::<Ptr, $kind>($crate::loaded::function($library, $name)?) }),+
                };
                Some(TABLE.get_or_init(|| table))
            }
        }
    };
}
pub(crate) use functions;
