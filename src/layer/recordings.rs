//! State of draws that the program makes in several commands: between glBegin and glEnd, and while a display list is compiled and executed.

use super::executed;
use crate::gl::{Ends, Recording};
use crate::state::Immediate;

/// Commands that are recorded, or that are executed while they are compiled.
#[derive(Debug, Default)]
pub(super) struct Recordings {
    /// The calls since glBegin.
    pub(super) recording: Recording,
    /// Display lists that hold the glBegin or the glEnd of the recording.
    pub(super) ends: Ends,
    /// How the recorded calls change the current values.
    pub(super) immediate: Immediate,
    /// The run of a display list that the driver compiles and executes.
    pub(super) executed: Option<executed::Own>,
}
