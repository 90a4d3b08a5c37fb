//! Values that all contexts of the process share, and locks on which no frame waits.

use manyview_core::config::{Live, Profile};
use manyview_core::layer::Layer;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};

/// The values of the process. None as long as none was changed.
static LIVE: Mutex<Option<Live>> = Mutex::new(None);

/// The profile of the process. None as long as the first one is in force.
static PROFILE: Mutex<Option<Arc<Profile>>> = Mutex::new(None);

/// Gives a context the values and the profile of the process. It has to be called between frames.
pub(crate) fn adopt(layer: &mut Layer) {
    let profile = PROFILE
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .clone();
    if let Some(profile) = profile
        && !Arc::ptr_eq(&profile, layer.profile())
    {
        layer.adopt_profile(profile);
    }
    let live = *LIVE.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(live) = live
        && live != layer.live()
    {
        layer.adopt(live);
    }
}

/// Makes the values of a context those of the process if they differ from `before`.
pub(crate) fn changed(layer: &Layer, before: Live) {
    if layer.live() != before {
        *LIVE.lock().unwrap_or_else(PoisonError::into_inner) = Some(layer.live());
    }
}

/// Makes the profile of a context that of the process if it is another than `before`.
pub(crate) fn profile_changed(layer: &Layer, before: &Arc<Profile>) {
    if !Arc::ptr_eq(layer.profile(), before) {
        let profile = Some(Arc::clone(layer.profile()));
        *PROFILE.lock().unwrap_or_else(PoisonError::into_inner) = profile;
    }
}

/// Takes a lock without waiting. None while another thread holds it.
pub(crate) fn free<T>(lock: &Mutex<T>) -> Option<MutexGuard<'_, T>> {
    match lock.try_lock() {
        Ok(held) => Some(held),
        Err(TryLockError::Poisoned(error)) => Some(error.into_inner()),
        Err(TryLockError::WouldBlock) => None,
    }
}
