//! The w of the vertices of a program that has no camera among its matrices (see [`crate::plan::clip_form`]).

use super::Layer;
use super::draw::{Draw, Send};
use super::own_variants::VariantUse;
use crate::draw::ReplayHazard;
use crate::gl::{Gl, ProgramName, consts as c};

/// Vertices of a draw that are looked at: the first ones.
const MOST: usize = 4096;
/// Queries that count what transform feedback writes: GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, _OVERFLOW and _STREAM_OVERFLOW.
const WRITTEN: [u32; 3] = [0x8C88, 0x82EC, 0x82ED];

impl Layer {
    /// Whether the driver can write the vertices of any draw while other transform feedback waits.
    pub(super) fn measures_w(&self) -> bool {
        let support = &self.session.support;
        // Before, OpenGL ES writes neither indexed draws nor more than the buffer has room for.
        support.pauses_feedback && (!self.state.window.buffers.es || support.version >= (3, 2))
    }

    /// Whether it is time to measure the w of a program's vertices.
    pub(super) fn is_unmeasured(&mut self, program: ProgramName) -> bool {
        let measures = self.measures_w();
        let search = self.variants.own.search_mut(program);
        measures && search.is_some_and(|search| search.is_unmeasured())
    }

    /// Whether that was done for some time, or cannot be, and no camera was found.
    pub(super) fn is_measured_in_vain(&self, program: ProgramName) -> bool {
        let search = self.variants.own.search(program);
        search.is_none_or(|search| search.is_in_vain())
    }

    /// Whether the camera of a program comes from the w of its vertices.
    pub(super) fn is_by_clip_form(&self, program: ProgramName) -> bool {
        let search = self.variants.own.search(program);
        search.is_some_and(|search| search.is_measured())
    }

    /// Measures the w of a draw's vertices, before it is drawn. The next draw of its program uses what is found.
    pub(super) fn measure_w(&mut self, gl: &Gl, draw: &mut Draw) {
        let program = self.state.in_use.program;
        let counted = WRITTEN.iter().any(|&target| gl.counts(target));
        if draw.hazard != ReplayHazard::None || self.queries.feeds() || counted {
            return;
        }
        // Of primitives of another kind than the driver is told, it writes nothing.
        let mode = draw.drawing.mode.unwrap_or(c::TRIANGLES);
        if is_adjacent(mode) {
            return;
        }
        if self.link_other(gl, program, VariantUse::Written).is_err() {
            if let Some(search) = self.variants.own.search_mut(program) {
                search.refuse();
            }
            return;
        }
        self.state.keep_errors(gl);
        self.queries.lift_condition(gl);
        let mut vertices = Vec::new();
        if self
            .variants
            .own
            .enter(gl, program, VariantUse::Written)
            .is_some()
        {
            let send = &mut *draw.send;
            let kind = super::feedback::kind(mode);
            vertices = gl.written_vertices(kind, MOST, &mut || send(Send::AsItIs));
            gl.use_program(program);
        }
        self.queries.put_condition(gl);
        // What the driver says of a draw that it refuses, it says again.
        gl.drop_errors();
        let aspect = self.aspect();
        let search = self.variants.own.search_mut(program);
        if search.is_some_and(|search| search.measure(&vertices, aspect)) {
            let which = self.told_name(program);
            self.diagnostics.report.note(format!(
                "no camera was found in the matrices of the shaders {which}: the views of what they draw are shifted by the w of its vertices"
            ));
        }
    }
}

/// Whether primitives of a mode have vertices beside their own.
fn is_adjacent(mode: u32) -> bool {
    mode >= c::LINES_ADJACENCY
}
