//! Where the layer's own passes draw: in neutral state, outside of the program's queries and conditions.

use super::Layer;
use crate::gl::Gl;
use crate::state::Neutral;

impl Layer {
    /// Runs something of the layer's in neutral state. All state of the program's is as before, framebuffer bindings among it; no query of the
    /// program's counts what is drawn, and no condition leaves it out.
    pub(super) fn in_neutral<R>(
        &mut self,
        gl: &Gl,
        work: impl FnOnce(&mut Self, &Neutral) -> R,
    ) -> R {
        self.queries.pause(gl);
        self.queries.lift_condition(gl);
        let neutral = Neutral::enter(gl, self.state.has.compatibility);
        let done = work(self, &neutral);
        neutral.leave(gl);
        self.rebind(gl);
        self.queries.put_condition(gl);
        self.queries.resume(gl);
        done
    }
}
