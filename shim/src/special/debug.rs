//! The program's debug callback.

use crate::context::{real, receiver};
use crate::hooks::before_uncompiled;
use manyview_core::gl::Ptr;

const DEBUG_CALLBACK_FUNCTION: u32 = 0x8244;
const DEBUG_CALLBACK_USER_PARAM: u32 = 0x8245;

pub(crate) unsafe fn glDebugMessageCallback(callback: Ptr, userParam: Ptr) {
    let (function, data) = match receiver() {
        Some(receiver) => receiver.set(callback, userParam),
        None => (callback, userParam),
    };
    // SAFETY: the program's own call, or a function of the same type with its data.
    unsafe { real().glDebugMessageCallback(function, data) };
}

pub(crate) unsafe fn glGetPointerv(pname: u32, params: Ptr) {
    before_uncompiled();
    // SAFETY: the program's own call.
    unsafe { real().glGetPointerv(pname, params) };
    if params.is_null() || ![DEBUG_CALLBACK_FUNCTION, DEBUG_CALLBACK_USER_PARAM].contains(&pname) {
        return;
    }
    if let Some((function, data)) = receiver().map(|receiver| receiver.get())
        && !function.is_null()
    {
        // SAFETY: the driver has written one pointer there.
        unsafe {
            *params.cast::<Ptr>() = if pname == DEBUG_CALLBACK_FUNCTION {
                function
            } else {
                data
            }
        };
    }
}
