//! The rules of a profile.
#![no_main]

use libfuzzer_sys::fuzz_target;
use manyview::config::Profile;
use std::path::Path;

fuzz_target!(|text: &str| {
    if let Err(error) = Profile::parse(text, Path::new("profile.toml")) {
        assert!(!error.contains('\n'), "one line: {error}");
    }
});
