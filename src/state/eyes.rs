//! Programs that draw a picture for each eye themselves, to the left and the right buffer of a stereo window.
//!
//! Where the driver has no such window, the program gets one without and is told that it has both: the atlas keeps the right eye's picture in the place of the front buffer.

use std::sync::atomic::{AtomicBool, Ordering};

/// The program has asked for a stereo window, and the driver has none.
static GIVEN: AtomicBool = AtomicBool::new(false);

/// Windows have a left and a right buffer from now on, whatever the driver says.
pub fn give_eyes() {
    GIVEN.store(true, Ordering::Relaxed);
}

/// Whether the program was given windows with a left and a right buffer that the driver does not have.
pub fn are_eyes_given() -> bool {
    GIVEN.load(Ordering::Relaxed)
}
