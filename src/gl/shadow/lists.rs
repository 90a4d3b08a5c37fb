//! What display lists change when they are called.

use super::change::{Change, Summary};
use rustc_hash::FxHashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// One of the driver's display lists.
#[derive(Debug)]
struct Compiled {
    changes: Arc<[Change]>,
    summary: Summary,
}

/// The changes that each of the driver's display lists makes. Shared by the contexts that share lists.
#[derive(Clone, Debug, Default)]
pub(super) struct CompiledLists(Arc<Mutex<FxHashMap<u32, Compiled>>>);

impl CompiledLists {
    fn all(&self) -> MutexGuard<'_, FxHashMap<u32, Compiled>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn compiled(&self, list: u32, changes: Vec<Change>, summary: Summary) {
        let changes = changes.into();
        self.all().insert(list, Compiled { changes, summary });
    }

    /// What a list may do; anything, where it was not compiled here.
    pub(super) fn summary(&self, list: u32) -> Summary {
        let all = self.all();
        all.get(&list)
            .map_or(Summary::ANYTHING, |list| list.summary)
    }

    pub(super) fn deleted(&self, first: u32, count: u32) {
        let gone = first..first.saturating_add(count);
        let mut all = self.all();
        match count as usize > all.len() {
            true => all.retain(|list, _| !gone.contains(list)),
            false => gone.for_each(|list| {
                all.remove(&list);
            }),
        }
    }

    /// None for a list that was not compiled here: one that does not exist, or that only the driver knows.
    pub(super) fn changes(&self, list: u32) -> Option<Arc<[Change]>> {
        self.all().get(&list).map(|list| list.changes.clone())
    }
}
