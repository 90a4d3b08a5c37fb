//! The program's own GLSL programs.

use crate::context::{enter, peek, real};
use crate::hooks::{Touch, before_uncompiled, touch};
use manyview_core::gl::shadow::forget_subroutines;
use manyview_core::gl::{ProgramName, Ptr, consts::DELETE_STATUS};

pub(crate) unsafe fn glLinkProgram(program: u32) {
    before_uncompiled();
    // SAFETY: the program's own call.
    unsafe { real().glLinkProgram(program) };
    enter(|gl, l| l.linked(gl, ProgramName(program)));
}

pub(crate) unsafe fn glProgramBinary(program: u32, format: u32, binary: Ptr, length: i32) {
    before_uncompiled();
    // The driver knows no format 0 and refuses it, so the program links its sources instead.
    let refused = peek(|l| l.refuses_binaries()) == Some(true);
    let format = if refused { 0 } else { format };
    // SAFETY: the program's own call.
    unsafe { real().glProgramBinary(program, format, binary, length) };
    enter(|_, l| l.forget_program(ProgramName(program)));
}

pub(crate) unsafe fn glUseProgram(program: u32) {
    touch(Touch::OBJECTS | Touch::FIXED | Touch::TEXTURE);
    // SAFETY: the program's own call.
    unsafe { real().glUseProgram(program) };
    forget_subroutines();
    if peek(|l| l.has_pending_deletions()) == Some(true) {
        enter(|gl, l| l.delete_pending(gl));
    }
}

pub(crate) unsafe fn glDeleteProgram(program: u32) {
    before_uncompiled();
    if enter(|gl, l| l.defers_deletion(gl, ProgramName(program))) == Some(true) {
        return;
    }
    // SAFETY: the program's own call.
    unsafe { real().glDeleteProgram(program) };
    enter(|gl, l| l.deleted_program(gl, ProgramName(program)));
}

pub(crate) unsafe fn glGetProgramiv(program: u32, pname: u32, params: Ptr) {
    // SAFETY: the program's own call.
    unsafe { real().glGetProgramiv(program, pname, params) };
    if pname == DELETE_STATUS
        && !params.is_null()
        && peek(|l| l.is_pending_deletion(ProgramName(program))) == Some(true)
    {
        // SAFETY: the driver has just written the one value of this name there.
        unsafe { params.cast::<i32>().write_unaligned(1) };
    }
}
