//! The programs that views are drawn with: those generated for fixed function, and variants of the program's own.

use super::programs::OwnVariants;
use crate::draw::{Driver, FixedState, Programs};
use crate::offscreen::Bound;

/// Programs of the layer's, and what is known of the state that they read.
#[derive(Debug)]
pub(super) struct Variants {
    /// Generated for fixed function.
    pub(super) programs: Programs,
    /// What they read of it.
    pub(super) fixed: Option<FixedState>,
    pub(super) driver: Driver,
    /// Rewritten from the program's own.
    pub(super) own: OwnVariants,
    /// What the draw samples that is being made, as far as the views differ in it.
    pub(super) sampled: Vec<Bound>,
    /// The program, and the changes of uniforms and images, up to which that is known.
    pub(super) sampled_by: Option<(u32, u64, u64)>,
    /// The matrices by which the program computes positions from depths, with their locations.
    pub(super) unprojections: Vec<(i32, [f32; 16])>,
    /// The program has attributes that advance by instances.
    pub(super) divides: bool,
}

impl Variants {
    pub(super) fn new(programs: Programs, driver: Driver) -> Self {
        Variants {
            programs,
            fixed: None,
            driver,
            own: OwnVariants::default(),
            sampled: Vec::new(),
            sampled_by: None,
            unprojections: Vec::new(),
            divides: false,
        }
    }
}
