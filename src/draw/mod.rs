//! Executes a plan: the draw, once per view. Never looks at the program's state again.
#![forbid(unsafe_code)]

mod amplified;
mod bent;
mod current;
mod fixed_state;
mod fragment_state;
mod replay;
mod tuned;
mod twin;

pub use amplified::{Amplified, Programs};
pub use bent::{Drawing, Rays, draw_bent};
pub use current::Current;
pub use fixed_state::{Driver, FixedState, limits};
pub use replay::{Again, cut, enter_own, others, place, replay, unplace};
pub use twin::{Drawn, NoTwin, Twin, Way, drawn};
