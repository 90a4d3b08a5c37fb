//! State that hooks report call by call, because the program sets it often and the driver would have to be asked for it.

use super::Layer;
use crate::gl::{ListName, consts as c};
use crate::state::{Begin, Touch};

/// Whether the program is between glBegin and glEnd, and in which primitive the driver is, so that it answers as the program expects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Primitive {
    /// Outside glBegin and glEnd.
    None,
    /// The calls are recorded. The driver is in an empty primitive, so that it refuses commands that are not allowed there. The mode of that
    /// is never the program's, because Mesa 22.3 loses a fan after an empty fan, but for points under transform feedback.
    Recorded {
        /// The mode of the empty primitive.
        empty: u32,
    },
    /// The calls go to the driver, which is in the program's primitive.
    Direct,
}

/// The mode of the driver's empty primitive, for a mode of the program. Transform feedback refuses the modes of another kind of primitives.
fn empty(mode: u32, feedback: bool) -> u32 {
    match mode {
        c::POINTS if feedback => c::POINTS,
        c::POINTS => c::LINES,
        _ if !feedback => c::POINTS,
        c::LINES => c::LINE_STRIP,
        c::LINE_LOOP | c::LINE_STRIP => c::LINES,
        c::TRIANGLES => c::TRIANGLE_STRIP,
        _ => c::TRIANGLES,
    }
}

impl Layer {
    /// Whether the program is between glBegin and glEnd, and where its calls go then.
    pub fn primitive(&self) -> Primitive {
        match self.state.begin {
            Begin::Outside => Primitive::None,
            Begin::Recorded(mode) => Primitive::Recorded {
                empty: empty(mode, self.queries.feeds()),
            },
            Begin::Direct => Primitive::Direct,
        }
    }

    /// After a list was called between glBegin and glEnd, with calls that go to the driver. Returns whether it has ended the primitive (see
    /// [`Layer::closes`]).
    pub fn closed_in_driver(&mut self, list: ListName) -> bool {
        let closes = self.closes(list);
        if closes {
            self.state.begin = Begin::Outside;
        }
        closes
    }

    /// After a glMatrixMode that was not compiled. The driver may refuse other modes than these, so it is asked for the mode when that
    /// matters.
    pub fn matrix_mode(&mut self, mode: u32) {
        match mode {
            c::MODELVIEW | c::PROJECTION | c::TEXTURE => self.state.matrices.mode = mode,
            _ => {
                self.touch(Touch::MODE | Touch::DSA_MATRIX);
            }
        }
    }

    /// After glRenderMode; the driver refuses what is no mode.
    pub fn render_mode(&mut self, mode: u32) {
        if [c::RENDER, c::FEEDBACK, c::SELECT].contains(&mode) {
            self.state.primitives.render_mode = mode;
        }
    }

    /// Takes the oldest of the program's errors that the layer has taken out of the driver's queue.
    pub fn take_error(&mut self) -> Option<u32> {
        self.state.errors.pop_front()
    }

    /// Whether the window's new size may be taken over now: not inside a primitive or a display list of the program's.
    pub fn can_resize(&self) -> bool {
        self.state.begin == Begin::Outside && self.state.list.is_none()
    }
}
