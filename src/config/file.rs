//! Files that users write.
#![forbid(unsafe_code)]

use crate::bounded;
use std::path::{Path, PathBuf};

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

/// The user's own folder of manyview, in `XDG_CONFIG_HOME` or `~/.config`; it need not be there. None where neither is known.
#[must_use]
pub fn user_folder() -> Option<PathBuf> {
    let absolute = |name: &str| {
        let path = std::env::var_os(name).map(PathBuf::from);
        path.filter(|path| path.is_absolute())
    };
    let configuration =
        absolute("XDG_CONFIG_HOME").or_else(|| Some(absolute("HOME")?.join(".config")));
    Some(configuration?.join("manyview"))
}
