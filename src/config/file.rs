//! Files that users write.
#![forbid(unsafe_code)]

use crate::bounded;
use std::path::Path;

/// A TOML file of options is never larger.
const MAX_FILE_BYTES: u64 = 64 * 1024;

/// The text of a file; the error says why there is none.
pub(super) fn read_capped(path: &Path) -> Result<String, String> {
    bounded::text(path, MAX_FILE_BYTES).map_err(|error| error.to_string())
}

/// A message of several lines as one.
pub(super) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
