//! The name of a quilt, and the views of pictures with such a name.
#![no_main]

use libfuzzer_sys::fuzz_target;
use manyview::display::QuiltName;

fuzz_target!(|bytes: &[u8]| {
    let (size, name) = bytes.split_at(bytes.len().min(8));
    let side = |at: usize| {
        let side = size.get(at..at + 4).and_then(|bytes| bytes.try_into().ok());
        side.map_or(1, u32::from_le_bytes).max(1)
    };
    let size = (side(0), side(4));
    if let Ok(Some(quilt)) = QuiltName::read(&String::from_utf8_lossy(name)) {
        // Aspects are rounded to four digits, once.
        let written = quilt.to_string();
        let again = QuiltName::read(&written).ok().flatten();
        assert_eq!(again.map(|quilt| quilt.to_string()), Some(written));
        let _ = quilt.grid(size).map_err(|error| error.to_string());
    }
});
