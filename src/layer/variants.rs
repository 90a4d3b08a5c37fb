//! The programs that views are drawn with: those generated for fixed function, and variants of the program's own.

use super::programs::OwnVariants;
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
    pub(super) sampled: Arc<[Bound]>,
    /// The program that `sampled` was found for, and the counts of changes of uniforms and of images at that time.
    pub(super) sampled_by: Option<(ProgramName, u64, u64)>,
    /// The program has set some attribute to advance by instances.
    pub(super) divides: bool,
}

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
}
