//! Which contexts share objects: the display lists of a share group are known to all of its layers.

use crate::provider::Provider;
use manyview_core::gl::Ptr;
use manyview_core::layer::SharedLists;
use std::sync::{Mutex, PoisonError};

struct Created {
    provider: Provider,
    handle: Ptr,
    lists: SharedLists,
}

// SAFETY: the handle is only compared.
unsafe impl Send for Created {}

static CREATED: Mutex<Vec<Created>> = Mutex::new(Vec::new());

/// The program has created a context that shares with another one, or with none (null).
pub(crate) fn created(provider: Provider, handle: Ptr, share: Ptr) {
    if handle.is_null() {
        return;
    }
    let lists = if share.is_null() {
        SharedLists::default()
    } else {
        lists(provider, share)
    };
    let mut all = CREATED.lock().unwrap_or_else(PoisonError::into_inner);
    // A driver gives the handle of a destroyed context out again.
    all.retain(|c| (c.provider, c.handle) != (provider, handle));
    all.push(Created {
        provider,
        handle,
        lists,
    });
}

/// The program has destroyed a context; the others of its share group keep the lists.
pub(crate) fn destroyed(provider: Provider, handle: Ptr) {
    let mut all = CREATED.lock().unwrap_or_else(PoisonError::into_inner);
    all.retain(|c| (c.provider, c.handle) != (provider, handle));
}

/// The display lists of a context's share group.
pub(crate) fn lists(provider: Provider, handle: Ptr) -> SharedLists {
    let mut all = CREATED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(c) = all
        .iter()
        .find(|c| (c.provider, c.handle) == (provider, handle))
    {
        return c.lists.clone();
    }
    // Created by a function that is not hooked.
    let lists = SharedLists::default();
    all.push(Created {
        provider,
        handle,
        lists: lists.clone(),
    });
    lists
}
