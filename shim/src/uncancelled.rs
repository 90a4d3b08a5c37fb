//! Holds off the cancellation of a thread.

use core::ffi::c_int;

unsafe extern "C" {
    fn pthread_setcancelstate(state: c_int, before: *mut c_int) -> c_int;
}

/// PTHREAD_CANCEL_DISABLE, the same in all C libraries of Linux.
const DISABLED: c_int = 1;

/// While it lives, the thread is not cancelled. A request (pthread_cancel) waits for the next cancellation point afterwards.
pub(crate) struct Uncancelled {
    before: c_int,
}

impl Uncancelled {
    pub(crate) fn new() -> Self {
        let mut before = 0;
        // SAFETY: one integer of ours.
        unsafe { pthread_setcancelstate(DISABLED, &mut before) };
        Uncancelled { before }
    }
}

impl Drop for Uncancelled {
    fn drop(&mut self) {
        let mut ours = 0;
        // SAFETY: the state from before, and one integer of ours.
        unsafe { pthread_setcancelstate(self.before, &mut ours) };
    }
}
