//! Which contexts share objects, so that all layers of a share group know its common state.

use crate::provider::Provider;
use crate::record::Key;
use manyview_core::gl::{BufferName, Ptr};
use manyview_core::layer::Member;
use std::sync::{Arc, Mutex, PoisonError};

struct Created {
    provider: Provider,
    handle: Ptr,
    member: Arc<Member>,
}

// SAFETY: the handle is only compared.
unsafe impl Send for Created {}

static CREATED: Mutex<Vec<Created>> = Mutex::new(Vec::new());

/// The program has created a context that shares with another one, or with none (null).
pub(crate) fn created(provider: Provider, handle: Ptr, share: Ptr) {
    if handle.is_null() {
        return;
    }
    let member = match share.is_null() {
        true => Member::default(),
        false => member(provider, share).sharing(),
    };
    let mut all = CREATED.lock().unwrap_or_else(PoisonError::into_inner);
    // A driver may reuse the handle of a destroyed context.
    all.retain(|c| (c.provider, c.handle) != (provider, handle));
    all.push(Created {
        provider,
        handle,
        member: Arc::new(member),
    });
}

/// The program has destroyed a context. The others keep their shared state.
pub(crate) fn destroyed(provider: Provider, handle: Ptr) {
    let mut all = CREATED.lock().unwrap_or_else(PoisonError::into_inner);
    all.retain(|c| (c.provider, c.handle) != (provider, handle));
}

/// A context without a layer is about to unmap a buffer.
pub(crate) fn unmapped(context: Key, buffer: BufferName) {
    in_group(context, |member| member.unmapped(buffer));
}

/// A context without a layer is about to delete a buffer.
pub(crate) fn deleted(context: Key, buffer: BufferName) {
    in_group(context, |member| member.deleted(buffer));
}

/// Runs `change` on the record of a context in its share group. A context whose creation was not seen shares with none.
fn in_group(context: Key, change: impl FnOnce(&Member)) {
    let all = CREATED.lock().unwrap_or_else(PoisonError::into_inner);
    let mut all = all.iter();
    if let Some(found) = all.find(|c| (c.provider, c.handle) == context) {
        change(&found.member);
    }
}

/// The record of a context in its share group. It is made here for a context whose creation was not seen.
pub(crate) fn member(provider: Provider, handle: Ptr) -> Arc<Member> {
    let mut all = CREATED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(c) = all
        .iter()
        .find(|c| (c.provider, c.handle) == (provider, handle))
    {
        return c.member.clone();
    }
    // The context was created by a function that is not hooked.
    let member: Arc<Member> = Arc::default();
    all.push(Created {
        provider,
        handle,
        member: member.clone(),
    });
    member
}
