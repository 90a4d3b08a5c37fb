//! The programs that views are drawn with: those generated for fixed function, and variants of the program's own.

use super::own_variants::OwnVariants;
use crate::draw::{Driver, FixedState, Programs};
use crate::gl::ProgramName;
use crate::offscreen::Bound;
use std::sync::Arc;

/// Programs of the layer's, and the state that they read, as far as it is known.
#[derive(Debug)]
pub(super) struct Variants {
    /// Generated for fixed function.
    pub(super) programs: Programs,
    /// The fixed-function state that they read; none before it is first needed.
    pub(super) fixed: Option<FixedState>,
    pub(super) driver: Driver,
    /// Rewritten from the program's own.
    pub(super) own: OwnVariants,
    /// The textures that the last draw sampled and that differ between the views.
    sampled: Arc<[Bound]>,
    /// What `sampled` was found for.
    sampled_by: Option<SampledBy>,
    /// The program has set some attribute to advance by instances.
    divides: bool,
}

/// What the textures of a draw depend on: its program, and the counts of changes of uniforms and of images.
pub(super) type SampledBy = (ProgramName, u64, u64);

impl Variants {
    pub(super) fn new(programs: Programs, driver: Driver) -> Self {
        Variants {
            programs,
            fixed: None,
            driver,
            own: OwnVariants::default(),
            sampled: Arc::default(),
            sampled_by: None,
            divides: false,
        }
    }

    /// The textures of the last draw, if they are those of the next one too: it has the same key, and no texture unit has changed (`stale`).
    /// Otherwise they have to be found and given to [`Variants::sample`].
    pub(super) fn sampled(&mut self, key: SampledBy, stale: bool) -> Option<Arc<[Bound]>> {
        let same = self.sampled_by.replace(key) == Some(key) && !stale;
        same.then(|| self.sampled.clone())
    }

    /// Sets the textures that the draw samples and that differ between the views.
    pub(super) fn sample(&mut self, bound: Vec<Bound>) -> Arc<[Bound]> {
        self.sampled = bound.into();
        self.sampled.clone()
    }

    /// Some attribute is about to advance by instances.
    pub(super) fn divide(&mut self) {
        self.divides = true;
    }

    /// Whether the program has set some attribute to advance by instances.
    pub(super) fn divides(&self) -> bool {
        self.divides
    }

    /// Counts one more variant of a program, and returns the number of programs that were compiled so far.
    pub(super) fn count_compiled(&mut self) -> u64 {
        self.programs.compiled += 1;
        self.programs.compiled
    }
}
