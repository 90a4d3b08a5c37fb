//! Which windows of X are behind the drawables of glXCreateWindow.

use core::ffi::c_ulong;
use manyview_core::gl::Ptr;
use std::sync::{Mutex, PoisonError};

/// Display, drawable and window. A program has few of them.
static WINDOWS: Mutex<Vec<(usize, c_ulong, c_ulong)>> = Mutex::new(Vec::new());

/// The program has made a drawable for a window.
pub(crate) fn made(display: Ptr, drawable: c_ulong, window: c_ulong) {
    gone(display, drawable);
    let mut windows = WINDOWS.lock().unwrap_or_else(PoisonError::into_inner);
    windows.push((display as usize, drawable, window));
}

/// It has destroyed it.
pub(crate) fn gone(display: Ptr, drawable: c_ulong) {
    let mut windows = WINDOWS.lock().unwrap_or_else(PoisonError::into_inner);
    windows.retain(|w| (w.0, w.1) != (display as usize, drawable));
}

/// The window behind a drawable; a window is its own drawable.
pub(crate) fn behind(display: Ptr, drawable: c_ulong) -> c_ulong {
    let windows = WINDOWS.lock().unwrap_or_else(PoisonError::into_inner);
    let found = windows
        .iter()
        .find(|w| (w.0, w.1) == (display as usize, drawable));
    found.map_or(drawable, |w| w.2)
}
