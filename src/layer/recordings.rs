//! What is kept while the program speaks in several commands: between glBegin and glEnd, and while a list compiles and draws.

use super::executed;
use crate::gl::{Ends, Recording};
use crate::state::Immediate;

/// Commands that are held back, or that are halfway through.
#[derive(Debug, Default)]
pub(super) struct Recordings {
    /// The calls since glBegin.
    pub(super) recording: Recording,
    /// Display lists that hold its glBegin or its glEnd.
    pub(super) ends: Ends,
    /// What its calls do to the state.
    pub(super) immediate: Immediate,
    /// The run of a display list that the driver compiles and draws.
    pub(super) executed: Option<executed::Own>,
}
