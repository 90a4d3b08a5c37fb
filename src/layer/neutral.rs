//! The state guard of the layer's own passes: they draw in neutral state, outside of the program's queries and conditional rendering.

use super::Layer;
use crate::gl::Gl;
use crate::state::{Neutral, Touch};

impl Layer {
    /// Runs `work` in neutral state. Afterwards all state of the program's is as before, framebuffer bindings included. No query of the
    /// program's counts what `work` draws, and no conditional rendering of the program's leaves it out.
    pub(super) fn in_neutral<R>(
        &mut self,
        gl: &Gl,
        work: impl FnOnce(&mut Self, &Neutral) -> R,
    ) -> R {
        self.flush_points(gl);
        self.yield_taken_names(gl);
        self.queries.pause(gl);
        self.queries.lift_condition(gl);
        let state = &self.state;
        let several = state.touched.has(Touch::VIEWPORTS) || state.rectangles.are_several();
        let neutral = Neutral::enter(gl, state.has.compatibility, several);
        let done = work(self, &neutral);
        neutral.leave(gl);
        self.rebind(gl);
        self.queries.put_condition(gl);
        self.queries.resume(gl);
        done
    }
}
