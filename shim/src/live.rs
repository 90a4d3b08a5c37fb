//! What all contexts of the process share: the values that they are to have, and locks that nobody waits for.

use manyview_core::config::Live;
use manyview_core::layer::Layer;
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};

/// None as long as nobody has changed them.
static LIVE: Mutex<Option<Live>> = Mutex::new(None);

/// Gives a context the values of the process; to be called between frames.
pub(crate) fn adopt(layer: &mut Layer) {
    let live = *LIVE.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(live) = live
        && live != layer.live()
    {
        layer.adopt(live);
    }
}

/// The values of a context are those of the process, if they are others than before.
pub(crate) fn changed(layer: &Layer, before: Live) {
    if layer.live() != before {
        *LIVE.lock().unwrap_or_else(PoisonError::into_inner) = Some(layer.live());
    }
}

/// What a lock holds; none while another thread is there, for which no frame waits.
pub(crate) fn free<T>(lock: &Mutex<T>) -> Option<MutexGuard<'_, T>> {
    match lock.try_lock() {
        Ok(held) => Some(held),
        Err(TryLockError::Poisoned(error)) => Some(error.into_inner()),
        Err(TryLockError::WouldBlock) => None,
    }
}
