//! A photo of a panel.
#![no_main]

use libfuzzer_sys::fuzz_target;
use manyview::calibrate::Photo;

fuzz_target!(|bytes: &[u8]| {
    if manyview_fuzz::is_small(bytes) {
        let _ = Photo::decode("photo.jpg", bytes).map_err(|error| error.to_string());
    }
});
