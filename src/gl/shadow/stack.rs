//! Stacks of attributes: what glPopAttrib restores.

use super::Entry;
use super::key::Key;

/// One glPushAttrib or glPushClientAttrib.
#[derive(Debug)]
pub(super) struct Pushed {
    /// Its bits.
    pub(super) mask: u32,
    /// The values that have changed since, as they were before.
    pub(super) before: Vec<(Key, Entry)>,
    /// Objects were deleted since, which are not bound again.
    pub(super) deleted: bool,
    /// Only since then values are kept by their index.
    pub(super) before_indices: bool,
    /// The matrix mode, if it was known.
    pub(super) mode: Option<u32>,
}

/// What was pushed. Only changes are saved, so a push costs nothing.
#[derive(Debug, Default)]
pub(super) struct Stack {
    /// The depth of the driver's stack below; none where that is not known.
    pub(super) base: Option<usize>,
    pushed: Vec<Pushed>,
}

impl Stack {
    pub(super) fn len(&self) -> usize {
        self.pushed.len()
    }

    pub(super) fn push(&mut self, mask: u32, mode: Option<u32>) {
        self.pushed.push(Pushed {
            mask,
            before: Vec::new(),
            deleted: false,
            before_indices: false,
            mode,
        });
    }

    pub(super) fn pop(&mut self) -> Option<Pushed> {
        self.pushed.pop()
    }

    /// A value is about to change.
    pub(super) fn save(&mut self, key: Key, entry: &mut Entry) {
        let level = self.pushed.len();
        if let Some(top) = self.pushed.last_mut()
            && entry.level < level
        {
            top.before.push((key, *entry));
            entry.level = level;
        }
    }

    /// Objects are deleted.
    pub(super) fn taint_bindings(&mut self) {
        self.pushed.iter_mut().for_each(|p| p.deleted = true);
    }

    /// From now on values are kept by their index.
    pub(super) fn indices_begin(&mut self) {
        self.pushed.iter_mut().for_each(|p| p.before_indices = true);
    }

    /// All may have changed, the depth too.
    pub(super) fn forget(&mut self) {
        *self = Stack::default();
    }
}
