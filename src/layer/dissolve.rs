//! The layer is off: the program goes on with its own framebuffer 0.

use super::orphans::delete_orphans;
use super::{Layer, with_raw_copies};
use crate::gl::{FramebufferName, Gl, consts as c};
use crate::state::Compiling;

impl Layer {
    /// Whether a draw has been sent for other views, and not yet for the program's own. So it is where a fault has interrupted a replay.
    pub fn owes_own_view(&self) -> bool {
        self.frame.owes_own_view()
    }

    /// Gives the program its framebuffer 0 back, with what its own view shows, and deletes all objects of the layer. `fault`: a hook was
    /// interrupted, so that what it had set in the driver is still in force.
    pub fn dissolve(mut self, gl: &Gl, fault: bool) {
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
        self.give_framebuffer(gl);
        if let Some(list) = list {
            reopen(gl, list);
        }
        let group = self.session.group.clone();
        self.leave();
        delete_orphans(gl, &group);
        while gl.get_error() != c::NO_ERROR {}
    }

    /// Sets what a draw changes for a view to what the program has set.
    fn put_interrupted_state(&mut self, gl: &Gl) {
        gl.use_program(self.state.in_use.program);
        gl.enable(c::SCISSOR_TEST);
        self.state.rectangles.put(gl);
    }

    /// Copies the program's own view to the true framebuffer 0.
    fn show_own_view(&mut self, gl: &Gl) {
        let own = self.targets.atlas.tiles.own();
        self.take_single(gl, own);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, FramebufferName::ZERO);
        let [w, h] = [self.state.window.width, self.state.window.height].map(|n| n as i32);
        // Depths can be copied only where the formats are the same; the error of another one is dropped.
        for mask in [
            c::COLOR_BUFFER_BIT,
            c::DEPTH_BUFFER_BIT,
            c::STENCIL_BUFFER_BIT,
        ] {
            gl.blit_framebuffer(0, 0, w, h, 0, 0, w, h, mask, c::NEAREST);
        }
    }

    /// Binds the true framebuffer 0 where the program has framebuffer 0 bound, with the program's draw and read buffers.
    fn give_framebuffer(&mut self, gl: &Gl) {
        let f = &self.state.framebuffers;
        gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
        match f.draw_buffers.as_slice() {
            // The plain call takes names that stand for two buffers, the other one does not.
            [one] if !gl.is_es() => gl.draw_buffer(*one),
            several => gl.draw_buffers(several),
        }
        gl.read_buffer(f.read_buffer);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, f.draw);
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, f.read);
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
