//! Transform feedback: the vertices of a draw are written once, and the draw is made in all views.
//!
//! While feedback is active, every draw of another view would be written as well. So the program's own call is made first with
//! rasterisation off, which writes, and the views are drawn while feedback is paused. Queries of what comes before rasterisation count the first
//! call alone; the others count the views' own one, as of any draw.

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

/// A command that switches transform feedback.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedbackCommand {
    /// glBeginTransformFeedback of a kind of primitives.
    Begin(u32),
    /// glEndTransformFeedback.
    End,
    /// It is paused or goes on.
    Pause,
    /// Another object is bound, which may be active with another kind of primitives.
    Bind,
}

/// The kind of primitives of a mode of glBegin, as transform feedback has it.
pub(super) fn kind(mode: u32) -> u32 {
    match mode {
        c::POINTS => c::POINTS,
        c::LINES | c::LINE_LOOP | c::LINE_STRIP => c::LINES,
        _ => c::TRIANGLES,
    }
}

impl Layer {
    /// After a command that switches transform feedback.
    pub fn feedback_changed(&mut self, gl: &Gl, command: FeedbackCommand) {
        self.shaders_wrote();
        if !self.session.support.pauses_feedback {
            // The driver cannot be asked.
            match command {
                FeedbackCommand::Begin(_) => self.state.primitives.transform_feedback = true,
                FeedbackCommand::End => self.state.primitives.transform_feedback = false,
                FeedbackCommand::Pause | FeedbackCommand::Bind => {}
            }
            return;
        }
        let active = gl.get_integer(c::TRANSFORM_FEEDBACK_ACTIVE) != 0;
        let on = active && gl.get_integer(c::TRANSFORM_FEEDBACK_PAUSED) == 0;
        self.queries.set_feedback(match on {
            true => Feedback::On,
            false => Feedback::Off,
        });
        let fed = &mut self.queries.fed;
        *fed = match command {
            _ if !active => None,
            // Where feedback is active already, it is an error.
            FeedbackCommand::Begin(kind) => fed.or(Some(kind)),
            FeedbackCommand::Bind => None,
            FeedbackCommand::End | FeedbackCommand::Pause => *fed,
        };
    }

    /// Whether transform feedback is active that refuses primitives of this mode, so that the driver's glBegin begins nothing.
    pub(super) fn feedback_refuses(&self, mode: u32) -> bool {
        self.queries.feeds() && self.queries.fed.is_some_and(|fed| fed != kind(mode))
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
        self.queries.start_writing(gl);
        (draw.send)(Send::AsItIs);
        let refused = self.state.keep_errors(gl);
        self.queries.hold_feedback(gl);
        gl.disable(c::RASTERIZER_DISCARD);
        if !refused {
            show(self, draw);
        }
        // Feedback goes on only with the program that it began with.
        gl.use_program(self.state.in_use.program);
        self.queries.release_feedback(gl);
    }
}
