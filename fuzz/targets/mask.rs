//! The picture of a mask.
#![no_main]

use libfuzzer_sys::fuzz_target;
use manyview::display::Mask;

fuzz_target!(|bytes: &[u8]| {
    if manyview_fuzz::is_small(bytes) {
        let path = manyview_fuzz::file("mask.png", bytes);
        match Mask::from_png(path) {
            Ok(mask) => drop(mask.views_shown()),
            Err(error) => assert!(!error.to_string().contains('\n'), "one line: {error}"),
        }
    }
});
