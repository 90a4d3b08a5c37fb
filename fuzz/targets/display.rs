//! A description of a display, and its mask.
#![no_main]

use libfuzzer_sys::fuzz_target;
use manyview::display::{Display, Placement};

fuzz_target!(|bytes: &[u8]| {
    let path = manyview_fuzz::file("panel.toml", bytes);
    match Display::load(&path.to_string_lossy()) {
        Ok(display) => {
            let placement = Placement::full_screen(13, 7);
            let _ = display.mask(&placement, display.views);
            let _ = display.fine_mask(&placement, display.views);
        }
        Err(error) => assert!(!error.to_string().contains('\n'), "one line: {error}"),
    }
});
