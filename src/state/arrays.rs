//! Arrays of vertices that the program promises not to change, by glLockArraysEXT.

/// Whether it does, and since when.
#[derive(Clone, Copy, Debug, Default)]
pub struct Arrays {
    locks: u64,
    locked: bool,
}

impl Arrays {
    /// glLockArraysEXT or glUnlockArraysEXT.
    pub fn lock(&mut self, locked: bool) {
        self.locks += u64::from(locked);
        self.locked = locked;
    }

    /// Which lock they are under; none where they may change.
    pub fn locked(&self) -> Option<u64> {
        self.locked.then_some(self.locks)
    }
}
