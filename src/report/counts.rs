//! Counts that every draw adds to, so they have to be cheap: a handful of kinds, found by comparing, made text when they are written.

use std::collections::BTreeMap;

/// How often each of a few things came.
#[derive(Debug)]
pub struct Counts<T>(Vec<(T, u64)>);

impl<T> Default for Counts<T> {
    fn default() -> Self {
        Counts(Vec::new())
    }
}

impl<T: PartialEq> Counts<T> {
    /// One more.
    #[inline]
    pub fn add(&mut self, what: T) {
        match self.0.iter_mut().find(|(known, _)| *known == what) {
            Some((_, count)) => *count += 1,
            None => self.0.push((what, 1)),
        }
    }

    /// The counts since the last time.
    pub fn take(&mut self) -> impl Iterator<Item = (T, u64)> + '_ {
        self.0.drain(..)
    }

    /// By text.
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
