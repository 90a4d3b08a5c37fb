//! Counts to which every draw adds, so they have to be cheap: a few kinds, found by a linear search, and turned into text only when
//! they are written.

use std::collections::BTreeMap;

/// The number of occurrences of each of a few kinds.
#[derive(Debug)]
pub struct Counts<T>(Vec<(T, u64)>);

impl<T> Default for Counts<T> {
    fn default() -> Self {
        Counts(Vec::new())
    }
}

impl<T: PartialEq> Counts<T> {
    /// Counts one more.
    #[inline]
    pub fn add(&mut self, what: T) {
        self.add_many(what, 1);
    }

    /// Counts so many more.
    #[inline]
    pub fn add_many(&mut self, what: T, more: u64) {
        match self.0.iter_mut().find(|(known, _)| *known == what) {
            Some((_, count)) => *count += more,
            None => self.0.push((what, more)),
        }
    }

    /// Takes the counts since the last call.
    pub fn take(&mut self) -> impl Iterator<Item = (T, u64)> + '_ {
        self.0.drain(..)
    }

    /// The counts by name; kinds of one name are added up.
    pub(super) fn named<'a>(
        &'a self,
        name: impl Fn(&'a T) -> &'static str,
    ) -> BTreeMap<&'static str, u64> {
        let mut named = BTreeMap::new();
        for (what, count) in &self.0 {
            *named.entry(name(what)).or_default() += count;
        }
        named
    }
}
