//! Files that users write.
#![forbid(unsafe_code)]

use std::path::Path;

/// A TOML file of options is never larger.
const MAX_FILE_BYTES: u64 = 64 * 1024;

/// The text of a file; the error says why there is none.
pub(super) fn read_capped(path: &Path) -> Result<String, String> {
    let about = std::fs::metadata(path).map_err(|error| error.to_string())?;
    if !about.is_file() {
        return Err("it is not a file".to_owned());
    }
    if about.len() > MAX_FILE_BYTES {
        return Err(format!("it is larger than {MAX_FILE_BYTES} bytes"));
    }
    std::fs::read_to_string(path).map_err(|error| error.to_string())
}

/// A message of several lines as one.
pub(super) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
