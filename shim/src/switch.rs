//! Whether the layer is on in this process, which decides where each exported function leads.

use crate::{Address, provider, stderr};
use core::sync::atomic::{AtomicBool, AtomicPtr, Ordering::Relaxed};
use manyview_core::config::{Config, Output, program};
use manyview_core::gl::{NAMES, slot};
use std::sync::{Mutex, OnceLock, PoisonError};

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
#[cfg(not(all(test, feature = "fake-driver")))]
static OFF: AtomicBool = AtomicBool::new(false);
// In tests each thread is a process of its own.
#[cfg(all(test, feature = "fake-driver"))]
thread_local! { static OFF: AtomicBool = const { AtomicBool::new(false) } }

fn with_off<R>(f: impl FnOnce(&AtomicBool) -> R) -> R {
    #[cfg(not(all(test, feature = "fake-driver")))]
    return f(&OFF);
    #[cfg(all(test, feature = "fake-driver"))]
    OFF.with(f)
}

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
                Ok(config)
                    if program::this_program()
                        .is_some_and(|name| config.chosen.leaves_bare(&name)) =>
                {
                    None
                }
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
        _ if off() => Mode::Passive,
        None => Mode::Passive,
        // Depth is read from the atlas, even with one view.
        Some(c) if c.views > 1 || c.output == Output::Rgbd => Mode::Active,
        Some(c) if c.capture.is_some() || c.report.is_some() => Mode::Observe,
        Some(_) => Mode::Passive,
    }
}

/// Prints one line on stderr, where that is possible without harm to the program.
pub(crate) fn say(text: &str) {
    stderr::write(&format!("manyview: {text}\n"));
}

/// As [`say`], but not if the same was said before.
pub(crate) fn say_once(text: &str) {
    static SAID: Mutex<Vec<String>> = Mutex::new(Vec::new());
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    if !said.iter().any(|before| before == text) {
        said.push(text.to_owned());
        drop(said);
        say(text);
    }
}

/// Turns the layer off for the rest of the process. Returns whether it was on.
pub(crate) fn turn_off(why: &str) -> bool {
    let was_on = !with_off(|off| off.swap(true, Relaxed));
    if was_on {
        say(&format!(
            "{why}; the layer is off, the program goes on without it"
        ));
    }
    was_on
}

static ENDING: AtomicBool = AtomicBool::new(false);

extern "C" fn ends() {
    ENDING.store(true, Relaxed);
}

/// Asks to be told when the process ends. Functions given to atexit later run first. So whatever the driver has set up before still works
/// until then. Parts that it sets up later have gone by then, and it must not be asked for a picture any more.
pub(crate) fn watch_the_end() {
    // SAFETY: a function without conditions, in a library that stays loaded.
    unsafe { libc::atexit(ends) };
}

/// Whether the process ends, and the driver with it: the program's calls are passed on, and nothing more is done.
pub(crate) fn ending() -> bool {
    ENDING.load(Relaxed)
}

/// Whether the layer was turned off.
pub(crate) fn off() -> bool {
    with_off(|off| off.load(Relaxed))
}

/// Turns the layer on again for the next program of a test.
#[cfg(all(test, feature = "fake-driver"))]
pub(crate) fn turn_on() {
    with_off(|off| off.store(false, Relaxed));
}

/// The commands that [`Mode::Observe`] hooks.
const OBSERVED: [usize; 21] = [
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
    slot::glFlush,
    slot::glXWaitGL,
    slot::eglWaitGL,
    slot::eglWaitClient,
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
