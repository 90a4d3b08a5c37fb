//! Whether the layer is on in this process, which decides where each exported function leads.

use crate::{Address, provider};
use core::sync::atomic::{AtomicBool, AtomicPtr, Ordering::Relaxed};
use manyview_core::config::{Config, Output};
use manyview_core::gl::{NAMES, slot};
use std::io::Write;
use std::sync::OnceLock;

/// How much of the program the layer watches.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Mode {
    /// Nothing is watched: every exported function leads to the driver.
    Passive,
    /// Only frames: the program itself draws the one view, which is captured or counted.
    Observe,
    /// All commands are watched.
    Active,
}

static CONFIG: OnceLock<Option<Config>> = OnceLock::new();
static OFF: AtomicBool = AtomicBool::new(false);

/// The configuration. None where the layer is disabled or an option is wrong, which is reported once on stderr.
pub(crate) fn config() -> Option<&'static Config> {
    CONFIG
        .get_or_init(|| {
            // SAFETY: reads one word of the auxiliary vector.
            if unsafe { libc::getauxval(libc::AT_SECURE) } != 0
                || manyview_core::config::disabled(|name| std::env::var(name).ok())
            {
                return None;
            }
            match Config::from_env(|name| std::env::var(name).ok()) {
                Ok(config) => {
                    let told = config.renamings.iter();
                    told.for_each(|renaming| say(&renaming.to_string()));
                    Some(config)
                }
                Err(e) => {
                    say(&format!("{e}; the program runs without the layer"));
                    None
                }
            }
        })
        .as_ref()
}

/// Sets the configuration for tests, unless the process already has one.
#[cfg(all(test, feature = "fake-driver"))]
pub(crate) fn configure(config: Config) {
    // All tests of a process share the configuration.
    let _ = CONFIG.set(Some(config));
}

/// The mode of this process.
pub(crate) fn mode() -> Mode {
    match config() {
        _ if OFF.load(Relaxed) => Mode::Passive,
        None => Mode::Passive,
        // Depth is read from the atlas, even with one view.
        Some(c) if c.views > 1 || c.output == Output::Rgbd => Mode::Active,
        Some(c) if c.capture.is_some() || c.report.is_some() => Mode::Observe,
        Some(_) => Mode::Passive,
    }
}

/// Prints one line on stderr. Errors are ignored, since stderr may be closed. A socket is left alone: it may be the program's connection
/// to its X server, which got the free descriptor.
pub(crate) fn say(text: &str) {
    // SAFETY: all-zero is a valid stat.
    let mut status: libc::stat = unsafe { core::mem::zeroed() };
    // SAFETY: status is ours.
    let known = unsafe { libc::fstat(libc::STDERR_FILENO, &mut status) } == 0;
    if known && status.st_mode & libc::S_IFMT != libc::S_IFSOCK {
        let _ = writeln!(std::io::stderr(), "manyview: {text}");
    }
}

/// Turns the layer off for the rest of the process. Returns whether it was on.
pub(crate) fn turn_off(why: &str) -> bool {
    let was_on = !OFF.swap(true, Relaxed);
    if was_on {
        say(&format!(
            "{why}; the layer is off, the program goes on without it"
        ));
    }
    was_on
}

/// Whether the layer was turned off.
pub(crate) fn off() -> bool {
    OFF.load(Relaxed)
}

/// The commands that [`Mode::Observe`] hooks.
const OBSERVED: [usize; 17] = [
    slot::glXSwapBuffers,
    slot::glXSwapBuffersMscOML,
    slot::glXMakeCurrent,
    slot::glXMakeContextCurrent,
    slot::glXMakeCurrentReadSGI,
    slot::glXDestroyContext,
    slot::glXGetProcAddress,
    slot::glXGetProcAddressARB,
    slot::eglSwapBuffers,
    slot::eglSwapBuffersWithDamageKHR,
    slot::eglSwapBuffersWithDamageEXT,
    slot::eglMakeCurrent,
    slot::eglDestroyContext,
    slot::eglGetProcAddress,
    slot::OSMesaMakeCurrent,
    slot::OSMesaDestroyContext,
    slot::glFinish,
];

/// Whether a slot leads to our hook in this process.
pub(crate) fn hooked(slot: usize) -> bool {
    match mode() {
        Mode::Passive => false,
        Mode::Observe => OBSERVED.contains(&slot),
        Mode::Active => true,
    }
}

/// Called at the first call of an exported function: decides where the function leads from now on. `entry` is the place that it jumps
/// through, and `hook` its hook.
#[cold]
pub(crate) fn resolve(slot: usize, entry: &AtomicPtr<()>, hook: Option<&Address>) {
    let Some(hook) = hook else { return };
    let driver = if hooked(slot) {
        None
    } else {
        provider::default_symbol(NAMES[slot])
    };
    // A command that the driver lacks stays with the hook, which then does nothing.
    let to = driver.map_or(hook.0.cast_mut(), |p| p.cast());
    entry.store(to, Relaxed);
}
