//! The layer is off: the program goes on with its own framebuffer 0.

use super::orphans::delete_orphans;
use super::{Layer, with_raw_copies};
use crate::gl::{Gl, consts as c};
use crate::state::{BACK, Compiling};

impl Layer {
    /// Whether a draw has been sent for other views, and not yet for the program's own. So it is where a fault has interrupted a replay.
    pub fn owes_own_view(&self) -> bool {
        self.frame.owes_own_view()
    }

    /// Gives the program its framebuffer 0 back, with what its own view shows, and deletes all objects of the layer. `fault`: a hook was
    /// interrupted, so that what it had set in the driver is still in force.
    pub fn dissolve(mut self: Box<Self>, gl: &Gl, fault: bool) {
        self.state.keep_errors(gl);
        if fault {
            self.put_interrupted_state(gl);
        }
        let list = self.state.list.take();
        if list.is_some() {
            gl.end_list();
        }
        self.targets.offscreen.write_back(gl);
        with_raw_copies(gl, || self.show_own_view(gl));
        self.apply_plain_buffers(gl);
        if let Some(list) = list {
            reopen(gl, list);
        }
        let group = self.session.group.clone();
        self.leave();
        delete_orphans(gl, &group);
        gl.drop_errors();
    }

    /// Sets what a draw changes for a view to what the program has set.
    fn put_interrupted_state(&mut self, gl: &Gl) {
        gl.use_program(self.state.in_use.program);
        gl.enable(c::SCISSOR_TEST);
        self.state.rectangles.put(gl);
        self.put_write_bindings(gl);
    }

    /// Copies the program's own view to the true framebuffer 0, unless that is another drawable's. The scissor test must be off.
    pub(super) fn show_own_view(&mut self, gl: &Gl) {
        if !self.is_plain() && !self.canvases.is_aside() {
            self.reading(gl, BACK, |layer| layer.targets.atlas.export(gl));
        }
    }
}

/// Begins the program's list once more, with what it has so far. Commands that a list of GL_COMPILE_AND_EXECUTE has executed are executed
/// again, because the driver can only continue the list in the mode in which it was begun.
fn reopen(gl: &Gl, mut list: Compiling) {
    list.finish();
    gl.new_list(list.list, list.mode);
    for run in list.body().iter() {
        gl.call_list(run.name);
    }
}
