//! A file of options.
#![no_main]

use libfuzzer_sys::fuzz_target;
use manyview::config::{Config, OptionId, Origin, Settings};

fuzz_target!(|bytes: &[u8]| {
    let path = manyview_fuzz::file("options.toml", bytes);
    let mut settings = Settings::default();
    settings.set(
        OptionId::Config,
        path.to_string_lossy(),
        Origin::CommandLine,
    );
    match settings.with_file() {
        Ok(settings) => {
            let _ = Config::from_settings(&settings).map_err(|error| error.to_string());
        }
        Err(error) => drop(error.to_string()),
    }
});
