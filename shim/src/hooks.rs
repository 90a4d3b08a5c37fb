//! What the generated hooks call: one function per class of command.

use crate::context::{self, enter};
use manyview_core::gl::Real;

pub(crate) use context::real;
pub(crate) use manyview_core::state::Touch;

/// Classes of draws, as `commands.list` names them.
#[derive(Clone, Copy)]
#[allow(clippy::upper_case_acronyms, reason = "as in commands.list")]
pub(crate) enum Kind {
    CLEAR,
    ARRAYS,
    ACCUM,
}

/// State groups have changed.
#[inline]
pub(crate) fn touch(groups: Touch) {
    context::peek(|l| l.touch(groups));
}

/// A draw: once per view.
pub(crate) fn draw(kind: Kind, call: &mut dyn FnMut(&'static Real)) {
    use manyview_core::plan::Kind as Plan;
    let kind = match kind {
        Kind::CLEAR => Plan::Clear,
        Kind::ARRAYS => Plan::Other,
        Kind::ACCUM => Plan::Accum,
    };
    if enter(|gl, l| l.draw(gl, kind, &mut || call(gl.real()))).is_none() {
        call(real());
    }
}

/// A read from the read framebuffer.
pub(crate) fn read(call: &mut dyn FnMut(&'static Real)) {
    if enter(|gl, l| l.read(gl, &mut || call(gl.real()))).is_none() {
        call(real());
    }
}

/// A call about the framebuffer bound at `target`: about the true one where that is the program's 0.
pub(crate) fn hide<R>(target: u32, call: &mut dyn FnMut(&'static Real) -> R) -> R {
    let mut answer = None;
    enter(|gl, l| l.with_true_zero(gl, target, &mut || answer = Some(call(gl.real()))));
    answer.unwrap_or_else(|| call(real()))
}

/// Immediate mode.
pub(crate) mod imm {
    use crate::context;
    use manyview_core::gl::Recording;
    use manyview_core::state::Effect;

    /// Where to write a call, while calls are recorded.
    #[inline]
    pub(crate) fn recording(slot: usize, effect: Effect) -> Option<&'static mut Recording> {
        if !context::recording() {
            return None;
        }
        // SAFETY: the layer of this thread's context outlives the hook that writes to it, and the reference does not outlive the hook.
        context::peek(|l| unsafe { &mut *core::ptr::from_mut(l.record(slot, effect)) })
    }

    /// Number of values of glMaterial*v.
    pub(crate) fn material_len(pname: u32) -> usize {
        match pname {
            0x1600 | 0x1200..=0x1202 | 0x1602 => 4, // GL_EMISSION, GL_AMBIENT … GL_SPECULAR, GL_AMBIENT_AND_DIFFUSE
            0x1603 => 3,                            // GL_COLOR_INDEXES
            _ => 1,                                 // GL_SHININESS
        }
    }
}
