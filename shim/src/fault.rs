//! Panics of our own: caught, and told in one line.

use core::panic::AssertUnwindSafe;
use std::sync::{Mutex, PoisonError};
#[cfg(not(test))]
use std::{panic::PanicHookInfo, sync::Once};

/// Where the last panic was, and its message.
static LAST: Mutex<Option<String>> = Mutex::new(None);
#[cfg(not(test))]
static INSTALLED: Once = Once::new();

#[cfg(not(test))]
/// Keeps what a panic says, in place of the hook of the standard library, which writes to stderr whatever that is.
fn keep(about: &PanicHookInfo) {
    let place = about
        .location()
        .map(|l| format!(" at {}:{}", l.file(), l.line()));
    let payload = about.payload();
    let words = payload.downcast_ref::<&str>().copied();
    let words = words.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    let words = words.map(|words| format!(": {words}"));
    let text = format!("{}{}", place.unwrap_or_default(), words.unwrap_or_default());
    *LAST.lock().unwrap_or_else(PoisonError::into_inner) = Some(text.replace('\n', " "));
}

/// Runs `work`. A panic gives the sentence that tells it.
pub(crate) fn catch<R>(work: impl FnOnce() -> R) -> Result<R, String> {
    // The hook is that of this library's own copy of the standard library, so no other code in the process uses it.
    #[cfg(not(test))]
    INSTALLED.call_once(|| std::panic::set_hook(Box::new(keep)));
    std::panic::catch_unwind(AssertUnwindSafe(work)).map_err(|_| {
        let about = LAST.lock().unwrap_or_else(PoisonError::into_inner).take();
        format!("internal fault{}", about.unwrap_or_default())
    })
}
