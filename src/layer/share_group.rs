//! What the contexts of a share group have in common.

use crate::gl::BufferName;
use crate::offscreen::{Images, SharedImages};
use crate::state::{Lists, UniformBuffers};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

#[derive(Debug, Default)]
struct Group {
    lists: Mutex<Lists>,
    images: SharedImages,
    uniform_buffers: Mutex<UniformBuffers>,
    members: AtomicUsize,
}

/// Membership of one context in its share group: from its creation until it is destroyed and its layer is gone.
#[derive(Debug)]
pub struct Member(Arc<Group>);

impl Default for Member {
    /// The membership of a context that shares with none yet.
    fn default() -> Self {
        Member::of(Arc::default())
    }
}

impl Member {
    fn of(group: Arc<Group>) -> Self {
        group.members.fetch_add(1, Ordering::Relaxed);
        Member(group)
    }

    /// The membership of a new context that shares with this one.
    #[must_use]
    pub fn sharing(&self) -> Self {
        Member::of(self.0.clone())
    }

    /// Whether there are other contexts in the group.
    #[must_use]
    pub fn has_others(&self) -> bool {
        self.0.members.load(Ordering::Relaxed) > 1
    }

    /// Display lists, and the programs that were linked.
    pub(super) fn lists(&self) -> MutexGuard<'_, Lists> {
        let lists = self.0.lists.lock();
        lists.unwrap_or_else(PoisonError::into_inner)
    }

    /// Contents of the program's uniform buffers.
    pub(super) fn uniform_buffers(&self) -> MutexGuard<'_, UniformBuffers> {
        let buffers = self.0.uniform_buffers.lock();
        buffers.unwrap_or_else(PoisonError::into_inner)
    }

    /// The driver is about to unmap a buffer that may be of this group.
    pub fn unmapped(&self, buffer: BufferName) {
        self.uniform_buffers().unmapped_by_driver(buffer);
    }

    /// Textures and renderbuffers that differ between the views.
    pub(super) fn images(&self) -> MutexGuard<'_, Images> {
        let images = self.0.images.lock();
        images.unwrap_or_else(PoisonError::into_inner)
    }

    /// The same, as a handle that can be kept.
    pub(super) fn shared_images(&self) -> SharedImages {
        self.0.images.clone()
    }
}

impl Drop for Member {
    fn drop(&mut self) {
        self.0.members.fetch_sub(1, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_context_has_others_while_they_live() {
        let first = Member::default();
        assert!(!first.has_others());
        let second = first.sharing();
        let third = second.sharing();
        drop(first);
        assert!(second.has_others() && third.has_others());
        drop(second);
        assert!(!third.has_others());
        assert!(!Member::default().has_others());
    }
}
