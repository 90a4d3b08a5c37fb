//! The programs' own GLSL programs.

use crate::context::{enter, real};
use crate::hooks::ask;
use manyview_core::gl::Ptr;

pub(crate) unsafe fn glLinkProgram(program: u32) {
    ask();
    // SAFETY: the program's own call.
    unsafe { real().glLinkProgram(program) };
    enter(|gl, l| l.linked(gl, program));
}

pub(crate) unsafe fn glProgramBinary(program: u32, format: u32, binary: Ptr, length: i32) {
    ask();
    // SAFETY: the program's own call.
    unsafe { real().glProgramBinary(program, format, binary, length) };
    enter(|_, l| l.forget_program(program));
}

pub(crate) unsafe fn glDeleteProgram(program: u32) {
    ask();
    // SAFETY: the program's own call.
    unsafe { real().glDeleteProgram(program) };
    enter(|gl, l| l.deleted_program(gl, program));
}
