//! What the contexts of a share group have in common.

use crate::gl::BufferName;
use crate::gl::shadow::Shared;
use crate::offscreen::{Images, SharedImages};
use crate::report::Report;
use crate::state::{Lists, UniformBuffers, block_changes};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

#[derive(Debug, Default)]
struct Group {
    lists: Mutex<Lists>,
    images: SharedImages,
    uniform_buffers: Mutex<UniformBuffers>,
    unshown: Mutex<Report>,
    members: AtomicUsize,
    kept: Shared,
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

    /// What is kept of the driver's state that its contexts share.
    #[must_use]
    pub fn kept(&self) -> Shared {
        self.0.kept.clone()
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

    /// What contexts have drawn that show nothing themselves, for the report of the next one that shows a frame.
    pub(super) fn unshown(&self) -> MutexGuard<'_, Report> {
        let report = self.0.unshown.lock();
        report.unwrap_or_else(PoisonError::into_inner)
    }

    /// A context of the group that has no layer is about to unmap a buffer.
    pub fn unmapped(&self, buffer: BufferName) {
        let mut buffers = self.uniform_buffers();
        buffers.unmapped_by_driver(buffer);
        buffers.forget_all(buffer);
    }

    /// A context of the group that has no layer is about to delete a buffer.
    pub fn deleted(&self, buffer: BufferName) {
        self.uniform_buffers().deleted(buffer);
        block_changes();
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
    use crate::state::{Found, block_change};

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

    #[test]
    fn a_buffer_is_unmapped_and_deleted_in_its_own_group() {
        const ONE: BufferName = BufferName(1);
        let (first, other) = (Member::default(), Member::default());
        for member in [&first, &other] {
            let mut buffers = member.uniform_buffers();
            buffers.follow(ONE);
            buffers.read(ONE, 0, &[1.0; 16]);
        }
        let sharing = first.sharing();
        sharing.unmapped(ONE);
        assert_eq!(first.uniform_buffers().matrix(ONE, 0), Found::Unknown);
        let before = block_change();
        sharing.deleted(ONE);
        assert!(block_change() > before);
        assert!(!first.uniform_buffers().follows(ONE));
        let found = other.uniform_buffers().matrix(ONE, 0);
        assert_eq!(found, Found::Matrix([1.0; 16]));
    }
}
