//! Vertices that a draw writes to a buffer, by transform feedback.

use super::consts as c;
use super::real::Ptr;
use super::{Gl, ProgramName};
use std::ffi::CStr;

const TRANSFORM_FEEDBACK: u32 = 0x8E22;
const TRANSFORM_FEEDBACK_BINDING: u32 = 0x8E25;
const INTERLEAVED_ATTRIBS: u32 = 0x8C8C;

impl Gl {
    /// Names the output that a program writes, before it is linked.
    pub(super) fn write_output(&self, program: ProgramName, output: &CStr) {
        let names = [output.as_ptr()];
        // SAFETY: one name, which ends in NUL.
        unsafe {
            self.real.glTransformFeedbackVaryings(
                program.0,
                1,
                names.as_ptr() as Ptr,
                INTERLEAVED_ATTRIBS,
            )
        };
    }

    /// Whether a query of a target is active. False for a target that the context does not know.
    pub fn counts(&self, target: u32) -> bool {
        const OVERFLOWS: std::ops::RangeInclusive<u32> = 0x82EC..=0x82ED;
        if OVERFLOWS.contains(&target) && !self.since((4, 6), None) {
            return false;
        }
        !self.current_query(target).is_zero()
    }

    /// What the first vertices of a draw write, at most so many, in the order of its primitives; nothing is rasterised. A program that writes four floats for each vertex has to
    /// be in use. `kind` is the kind of its primitives: GL_POINTS, GL_LINES or GL_TRIANGLES. Waits for the driver. No transform feedback may be going on, paused ones aside, and
    /// the context has objects for it: OpenGL 4.0; OpenGL ES has them from 3.0 on, and writes any draw from 3.2 on.
    pub fn written_vertices(
        &self,
        kind: u32,
        most: usize,
        draw: &mut dyn FnMut(),
    ) -> Vec<[f32; 4]> {
        let target = c::TRANSFORM_FEEDBACK_BUFFER;
        let object = self.get_integer(TRANSFORM_FEEDBACK_BINDING) as u32;
        let bound =
            super::BufferName(self.get_integer(c::TRANSFORM_FEEDBACK_BUFFER_BINDING) as u32);
        let discards = self.is_enabled(c::RASTERIZER_DISCARD);
        let buffer = self.gen_buffer();
        let mut own = 0u32;
        // SAFETY: room for one name; no other pointers.
        unsafe {
            self.real.glGenTransformFeedbacks(1, (&raw mut own).cast());
            self.real.glBindTransformFeedback(TRANSFORM_FEEDBACK, own);
            self.real.glBindBufferBase(target, 0, buffer.0);
        }
        let mut vertices = vec![[0.0f32; 4]; most];
        self.buffer_data_for_shaders(target, size_of_val(vertices.as_slice()));
        self.buffer_sub_data(target, 0, bytemuck::cast_slice(&vertices));
        if !discards {
            self.enable(c::RASTERIZER_DISCARD);
        }
        // SAFETY: no pointers.
        unsafe { self.real.glBeginTransformFeedback(kind) };
        draw();
        // SAFETY: no pointers.
        unsafe { self.real.glEndTransformFeedback() };
        if !discards {
            self.disable(c::RASTERIZER_DISCARD);
        }
        self.get_buffer_floats(target, 0, vertices.as_flattened_mut());
        // SAFETY: one name.
        unsafe {
            self.real
                .glBindTransformFeedback(TRANSFORM_FEEDBACK, object);
            self.real
                .glDeleteTransformFeedbacks(1, (&raw const own) as Ptr);
        }
        self.delete_buffer(buffer);
        self.bind_buffer(target, bound);
        vertices.retain(|vertex| *vertex != [0.0; 4]);
        vertices
    }
}
