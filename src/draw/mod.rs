//! Executes a plan: makes the draw for each view. Decides nothing about the program's state any more.
#![forbid(unsafe_code)]

mod amplified;
mod current;
mod fixed_state;
mod fragment_state;
mod pixel_size;
mod point_locations;
mod points;
mod programs;
mod reference;
mod replay;
mod state_guard;
#[cfg(test)]
mod tests;
mod variant;

pub use amplified::Amplified;
pub use current::Current;
pub use fixed_state::{Driver, FixedState, limits};
pub use points::{POINTS_AT_ONCE, PointProgram, PointRules};
pub use programs::Programs;
pub use reference::{Drawing, Rays, draw_to_reference};
pub use replay::{ReplayHazard, cut, enter_own, others, replay, set_tile_viewport};
pub use variant::{Drawn, NoVariant, Variant, VariantKind, drawn, point_variant, writing_variant};
