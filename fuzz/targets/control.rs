//! Requests to a running program, as they arrive: in parts of any length.
#![no_main]

use libfuzzer_sys::fuzz_target;
use manyview::control::{self, Lines};

fuzz_target!(|bytes: &[u8]| {
    let mut lines = Lines::default();
    let part = usize::from(bytes.first().copied().unwrap_or(0)) + 1;
    for part in bytes.chunks(part) {
        let room = lines.room();
        lines.push(&part[..part.len().min(room)]);
        while let Some(line) = lines.take() {
            let Ok(line) = line else { return };
            let _ = control::order(&line).map_err(|error| error.to_string());
        }
    }
});
