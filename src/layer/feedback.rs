//! Transform feedback: the vertices of a draw are written once, and the draw is made in all views.
//!
//! While feedback is active, every draw of another view would be written as well. So the program's own call is made first with
//! rasterisation off, which writes, and the views are drawn while feedback is paused. Queries that count primitives count the views'
//! own one, as of any draw, and that of written primitives counts the first call alone.

use super::Layer;
use super::draw::{Draw, Send};
use crate::gl::{Gl, consts as c};

/// Transform feedback of the context, as the program has set it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Feedback {
    /// Draws are not written.
    #[default]
    Off,
    /// Draws are written.
    On,
    /// The views of a draw are drawn, which was written before.
    Held,
}

impl Layer {
    /// After a command that begins, ends, pauses or resumes transform feedback, or binds another object for it. `begun`: the command was
    /// glBeginTransformFeedback, or else glEndTransformFeedback, as far as the driver cannot be asked.
    pub fn feedback_changed(&mut self, gl: &Gl, begun: Option<bool>) {
        self.shaders_wrote();
        if !self.session.support.pauses_feedback {
            if let Some(begun) = begun {
                self.state.primitives.transform_feedback = begun;
            }
            return;
        }
        let on = gl.get_integer(c::TRANSFORM_FEEDBACK_ACTIVE) != 0
            && gl.get_integer(c::TRANSFORM_FEEDBACK_PAUSED) == 0;
        self.queries.set_feedback(match on {
            true => Feedback::On,
            false => Feedback::Off,
        });
    }

    /// Makes a draw that is written by transform feedback: writes it, and then draws the views by `show`.
    pub(super) fn feed(
        &mut self,
        gl: &Gl,
        draw: &mut Draw,
        show: impl FnOnce(&mut Self, &mut Draw),
    ) {
        if gl.is_enabled(c::RASTERIZER_DISCARD) {
            self.queries.drawn();
            return (draw.send)(Send::AsItIs);
        }
        self.state.keep_errors(gl);
        gl.enable(c::RASTERIZER_DISCARD);
        self.queries.stop_counting(gl);
        (draw.send)(Send::AsItIs);
        let refused = self.state.keep_errors(gl);
        self.queries.hold_feedback(gl);
        self.queries.count_again(gl);
        gl.disable(c::RASTERIZER_DISCARD);
        if !refused {
            show(self, draw);
        }
        // Feedback goes on only with the program that it began with.
        gl.use_program(self.state.in_use.program);
        self.queries.release_feedback(gl);
    }
}
