//! All contexts of the program that have been current, and the threads that have them current.

use crate::record::{Context, Key};
use core::ffi::c_int;
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How long a thread waits for another one, which has released a context in the driver but not yet here.
const HANDOVER: Duration = Duration::from_secs(1);

struct Entry {
    key: Key,
    context: *mut Context,
    /// The thread that has it current.
    thread: Option<c_int>,
    /// The program has destroyed the context. The thread that has it current frees the record.
    destroyed: bool,
}

struct Registry {
    contexts: Vec<Entry>,
    /// Contexts without a record that have been current.
    unseen: Vec<Key>,
}

// SAFETY: handles are only compared. A context is dereferenced by the one thread that its entry names, and freed by whoever takes its
// entry out of the list, once no thread has it; both happen under the mutex.
unsafe impl Send for Registry {}

static CONTEXTS: Mutex<Registry> = Mutex::new(Registry {
    contexts: Vec::new(),
    unseen: Vec::new(),
});
static RELEASED: Condvar = Condvar::new();

/// The record of a context that the driver has made current on this thread; `make` makes the record of a new one. It belongs to this thread
/// until [`release`]. None where another thread still has it after [`HANDOVER`]. The driver lets only one thread have a context, so the other
/// one should be about to release it, unless its calls bypass our hooks.
pub(crate) fn take(key: Key, make: impl FnOnce() -> Context) -> Option<*mut Context> {
    // SAFETY: no arguments.
    let this = unsafe { libc::gettid() };
    let until = Instant::now() + HANDOVER;
    let mut registry = CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    loop {
        let known = registry
            .contexts
            .iter_mut()
            .find(|e| e.key == key && !e.destroyed);
        let Some(entry) = known else { break };
        if entry
            .thread
            .is_none_or(|thread| thread == this || is_gone(thread))
        {
            entry.thread = Some(this);
            return Some(entry.context);
        }
        if Instant::now() >= until {
            return None;
        }
        let waited = RELEASED.wait_timeout(registry, HANDOVER / 20);
        registry = waited.unwrap_or_else(PoisonError::into_inner).0;
    }
    let made = make();
    if forget_unseen(&mut registry, key) {
        made.shadow.changed();
    }
    let context = Box::into_raw(Box::new(made));
    registry.contexts.push(Entry {
        key,
        context,
        thread: Some(this),
        destroyed: false,
    });
    Some(context)
}

/// Whether a context of the program has a record.
pub(crate) fn knows(key: Key) -> bool {
    let registry = CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    registry
        .contexts
        .iter()
        .any(|e| e.key == key && !e.destroyed)
}

/// Notes that a context is current on a thread that does not get its record, so that its calls are not followed.
pub(crate) fn note_unseen(key: Key) {
    let mut registry = CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    forget_unseen(&mut registry, key);
    if !tell_changed(&registry, key) {
        registry.unseen.push(key);
    }
}

/// Whether a context without a record has been current, which is asked once.
fn forget_unseen(registry: &mut Registry, key: Key) -> bool {
    let before = registry.unseen.len();
    registry.unseen.retain(|unseen| *unseen != key);
    registry.unseen.len() != before
}

/// Another context has given state to this one.
pub(crate) fn changed(key: Key) {
    let registry = CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    tell_changed(&registry, key);
}

/// Tells the record of a context that its state was changed otherwise than by calls that are followed. False where it has no record.
fn tell_changed(registry: &Registry, key: Key) -> bool {
    let mut all = registry.contexts.iter();
    let known = all.find(|e| e.key == key && !e.destroyed);
    if let Some(entry) = known {
        // SAFETY: records in the list are freed only after they are taken out of it, under the lock; other threads have shared references
        // alone.
        unsafe { &*entry.context }.shadow.changed();
    }
    known.is_some()
}

/// The number of threads that have a context.
pub(crate) fn threads() -> usize {
    let registry = CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    registry
        .contexts
        .iter()
        .filter(|e| e.thread.is_some())
        .count()
}

/// Whether a thread has ended. A thread that ends with a context current never releases it.
fn is_gone(thread: c_int) -> bool {
    // SAFETY: signal 0 only asks whether the thread is there.
    let found = unsafe { libc::syscall(libc::SYS_tgkill, libc::getpid(), thread, 0) };
    found != 0 && std::io::Error::last_os_error().raw_os_error() == Some(libc::ESRCH)
}

/// Gives back a context that this thread has. Returns the record if the program has destroyed the context meanwhile.
///
/// # Safety
/// `context` is from [`take`] on this thread, which has no reference to it any more.
pub(crate) unsafe fn release(context: *mut Context) -> Option<Box<Context>> {
    let mut registry = CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    let at = registry
        .contexts
        .iter()
        .position(|e| e.context == context)?;
    let entry = registry.contexts.get_mut(at)?;
    entry.thread = None;
    let gone = entry.destroyed;
    if gone {
        registry.contexts.swap_remove(at);
    }
    drop(registry);
    RELEASED.notify_all();
    // SAFETY: made by `take`; out of the list, and on no thread (contract).
    gone.then(|| unsafe { Box::from_raw(context) })
}

/// Notes that the program destroys a context. Returns its record if no thread has it, and whether no other context is left.
pub(crate) fn destroy(key: Key) -> (Option<Box<Context>>, bool) {
    let mut registry = CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    let found = registry
        .contexts
        .iter()
        .position(|e| e.key == key && !e.destroyed);
    forget_unseen(&mut registry, key);
    let mut unused = None;
    if let Some(entry) = found.and_then(|at| registry.contexts.get_mut(at)) {
        entry.destroyed = true;
        unused = entry.thread.is_none().then_some(entry.context);
    }
    if unused.is_some() {
        registry.contexts.retain(|e| Some(e.context) != unused);
    }
    let last = registry.contexts.iter().all(|e| e.destroyed);
    drop(registry);
    // SAFETY: made by `take`; out of the list, and no thread has it.
    (unused.map(|c| unsafe { Box::from_raw(c) }), last)
}

/// Whether the program has destroyed a context that a thread still has.
pub(crate) fn is_destroyed(context: *const Context) -> bool {
    let registry = CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    let mut all = registry.contexts.iter();
    all.any(|e| core::ptr::eq(e.context, context) && e.destroyed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawable::{Drawable, Pair};
    use crate::provider::Provider;
    use manyview_core::gl::shadow::Shared;

    fn key(handle: usize) -> Key {
        (Provider::Gl, core::ptr::without_provenance_mut(handle))
    }

    fn made(key: Key) -> Context {
        let drawables = Pair::of(Drawable::Memory(1, 1));
        Context::new(key, Some(drawables), Shared::default())
    }

    fn taken(key: Key) -> Option<usize> {
        take(key, || made(key)).map(|context| context.addr())
    }

    #[test]
    fn a_context_goes_from_thread_to_thread() {
        let key = key(0x10);
        let first = take(key, || made(key)).expect("a new one");
        // SAFETY: of this thread.
        assert!(unsafe { release(first) }.is_none());
        let handle = key.1.addr();
        let other = std::thread::spawn(move || taken(self::key(handle)));
        assert_eq!(other.join().expect("no panic"), Some(first.addr()));
        // The thread ended with the context current.
        assert_eq!(taken(key), Some(first.addr()));
        // SAFETY: of this thread.
        assert!(unsafe { release(first) }.is_none());
        assert!(destroy(key).0.is_some());
    }

    #[test]
    fn what_another_thread_has_is_not_taken() {
        let key = key(0x20);
        let first = take(key, || made(key)).expect("a new one");
        let handle = key.1.addr();
        let other = std::thread::spawn(move || taken(self::key(handle)));
        assert_eq!(other.join().expect("no panic"), None);
        assert!(destroy(key).0.is_none(), "this thread has it");
        assert!(is_destroyed(first));
        let new = taken(key).expect("another context of the same handle");
        assert_ne!(new, first.addr());
        // SAFETY: of this thread.
        assert!(unsafe { release(first) }.is_some());
    }
}
