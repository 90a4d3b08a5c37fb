//! The value of `LD_PRELOAD`, with our library first and only once.
#![forbid(unsafe_code)]

use crate::config::LIBRARY_FILE;
use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::{OsStrExt, OsStringExt};
use std::path::Path;

/// Puts `library` before the libraries that `LD_PRELOAD` already holds. Other copies of the layer are removed.
#[must_use]
pub fn with_library(library: &Path, before: Option<&OsStr>) -> OsString {
    let mut value = library.as_os_str().as_bytes().to_vec();
    let before = before.map_or(&b""[..], OsStrExt::as_bytes);
    // ld.so(8): items are separated by spaces or colons, and there is no way to escape either.
    for item in before.split(|byte| matches!(byte, b' ' | b':')) {
        let name = item.rsplit(|byte| *byte == b'/').next().unwrap_or(item);
        if !item.is_empty()
            && name != LIBRARY_FILE.as_bytes()
            && item != library.as_os_str().as_bytes()
        {
            value.push(b':');
            value.extend_from_slice(item);
        }
    }
    OsString::from_vec(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn preload(before: &str) -> String {
        let value = with_library(Path::new("/opt/libmanyview.so"), Some(OsStr::new(before)));
        value.into_string().unwrap()
    }

    #[test]
    fn ours_is_first_and_once() {
        assert_eq!(preload(""), "/opt/libmanyview.so");
        assert_eq!(preload("/opt/libmanyview.so"), "/opt/libmanyview.so");
        assert_eq!(
            preload("/old/libmanyview.so:/a.so"),
            "/opt/libmanyview.so:/a.so"
        );
        assert_eq!(
            preload("a.so libmanyview.so  b.so:"),
            "/opt/libmanyview.so:a.so:b.so"
        );
        assert_eq!(with_library(Path::new("/l.so"), None), "/l.so");
    }
}
