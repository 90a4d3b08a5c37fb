//! State of draws that the program makes in several commands: between glBegin and glEnd, and while a display list is compiled and executed.

use super::executed;
use crate::draw::ReplayHazard;
use crate::gl::{Ends, ListName, Recording};
use crate::state::{Effect, Immediate};

/// Commands that are recorded, or that are executed while they are compiled.
#[derive(Debug, Default)]
pub(super) struct Recordings {
    /// The calls since glBegin.
    recording: Recording,
    /// Display lists that hold the glBegin or the glEnd of the recording.
    ends: Ends,
    /// How the recorded calls change the current values.
    immediate: Immediate,
    /// The run of a display list that the driver compiles and executes.
    pub(super) executed: Option<executed::Own>,
}

impl Recordings {
    /// A recording begins: nothing is recorded yet.
    pub(super) fn start(&mut self) {
        self.recording.clear();
        self.immediate = Immediate::default();
        self.ends = Ends::default();
    }

    /// Records a call, whose arguments `write` writes.
    #[inline]
    pub(super) fn record(
        &mut self,
        slot: usize,
        effect: Effect,
        write: impl FnOnce(&mut Recording),
    ) {
        self.immediate.note(effect);
        self.recording.call(slot, write);
    }

    /// The recording begins in a display list, which holds its glBegin.
    pub(super) fn opened_by(&mut self, list: ListName) {
        self.ends.opener = list;
        self.immediate.note(Effect::UNKNOWN);
    }

    /// The recording ends in a display list, which holds its glEnd.
    pub(super) fn closed_by(&mut self, list: ListName) {
        self.ends.closer = list;
        self.immediate.note(Effect::UNKNOWN);
    }

    /// Takes the recorded calls out, for a draw; [`Recordings::put`] gives their memory back.
    pub(super) fn take(&mut self) -> Recording {
        std::mem::take(&mut self.recording)
    }

    /// Keeps the memory of a recording for the next one.
    pub(super) fn put(&mut self, recording: Recording) {
        self.recording = recording;
    }

    /// The display lists that hold its glBegin or its glEnd.
    pub(super) fn ends(&self) -> Ends {
        self.ends
    }

    /// Whether the program has called glBegin and glEnd by themselves, in no display list.
    pub(super) fn is_whole(&self) -> bool {
        self.ends == Ends::default()
    }

    /// State that the recorded calls change, and that their second sending would start from.
    pub(super) fn hazard(&self) -> ReplayHazard {
        match self.immediate.must_restore() {
            Effect::NONE => ReplayHazard::None,
            effects => ReplayHazard::Current(effects),
        }
    }

    /// The current values that the recorded calls set.
    pub(super) fn sets(&self) -> Effect {
        self.immediate.sets()
    }

    /// Whether the recorded calls change the material.
    pub(super) fn changes_material(&self) -> bool {
        self.immediate.changes_material()
    }
}
