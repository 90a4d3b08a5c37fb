//! The calibration of a Looking Glass, and its mask.
#![no_main]

use libfuzzer_sys::fuzz_target;
use manyview::display::{Display, Placement};

fuzz_target!(|bytes: &[u8]| {
    let path = manyview_fuzz::file("visual.json", bytes);
    match Display::load(&path.to_string_lossy()) {
        Ok(display) => {
            let _ = display.mask(&Placement::full_screen(13, 7), display.views);
        }
        Err(error) => assert!(!error.to_string().contains('\n'), "one line: {error}"),
    }
});
