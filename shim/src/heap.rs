//! The program's heap, where the driver draws with the processor.

use manyview_core::gl::Gl;
use std::sync::Once;

/// Blocks up to this size come from the heap: as far as glibc would go by itself (DEFAULT_MMAP_THRESHOLD_MAX).
const BLOCK: core::ffi::c_int = 32 << 20;
/// So much may be free at the end of the heap before it goes back to the system. With half of it, which is what glibc would have with blocks of that
/// size, two starts of four still gave memory back in every frame.
const FREE: core::ffi::c_int = 4 * BLOCK;

/// Keeps what the driver frees at the end of a frame for the next one. Measured on llvmpipe 22.3 with 800,000 triangles: it keeps a frame's
/// triangles in blocks of 64 KiB, frees them once they are drawn, glibc gives the end of the heap back to the system, and the next frame gets it page by
/// page, 25 ms of a view. Chance decides what lies behind these blocks, and so a process was fast or slow for as long as it ran. What the user has
/// set stays.
pub(crate) fn keep(gl: &Gl) {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        if !chosen() && gl.is_llvmpipe() {
            set();
        }
    });
}

/// Whether the user has set how this heap grows.
fn chosen() -> bool {
    let own = ["MALLOC_TRIM_THRESHOLD_", "MALLOC_MMAP_THRESHOLD_"];
    let tunables = std::env::var_os("GLIBC_TUNABLES").unwrap_or_default();
    own.into_iter().any(|name| std::env::var_os(name).is_some())
        || tunables.to_string_lossy().contains("glibc.malloc.")
}

#[cfg(target_env = "gnu")]
fn set() {
    // SAFETY: mallopt takes the heap's own lock; it may be called at any time, from any thread.
    unsafe {
        // Either alone ends that glibc finds them by itself; it refuses the first where addresses have 32 bits.
        if libc::mallopt(libc::M_MMAP_THRESHOLD, BLOCK) != 0 {
            libc::mallopt(libc::M_TRIM_THRESHOLD, FREE);
        }
    }
}

#[cfg(not(target_env = "gnu"))]
fn set() {}
