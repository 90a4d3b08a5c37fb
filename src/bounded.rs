//! Reads files that users name. They are read inside the program that the layer lies in, so none may take its memory or make it wait.
#![forbid(unsafe_code)]

use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::Path;

/// Opens a file. Anything else, such as a pipe, could make the program wait for ever.
///
/// # Errors
/// It cannot be opened, or is no regular file.
pub fn open(path: &Path) -> Result<File, Error> {
    if !std::fs::metadata(path)?.is_file() {
        return Err(Error::new(ErrorKind::InvalidInput, "it is not a file"));
    }
    File::open(path)
}

/// The text of a file with at most `most` bytes.
///
/// # Errors
/// As [`open`]; [`ErrorKind::FileTooLarge`] if it is larger; it is not UTF-8.
pub fn text(path: &Path, most: u64) -> Result<String, Error> {
    let mut bytes = Vec::new();
    // The size that the system tells is not asked for: it may be 0, or change.
    open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let reason = format!("it is larger than {most} bytes");
        return Err(Error::new(ErrorKind::FileTooLarge, reason));
    }
    String::from_utf8(bytes)
        .map_err(|_| Error::new(ErrorKind::InvalidData, "stream did not contain valid UTF-8"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_may_have_as_many_bytes_as_are_said() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("a.toml");
        std::fs::write(&file, "12345").expect("written");
        assert_eq!(text(&file, 5).expect("small"), "12345");
        let error = text(&file, 4).expect_err("large");
        assert_eq!(error.kind(), ErrorKind::FileTooLarge);
        assert_eq!(error.to_string(), "it is larger than 4 bytes");
    }

    #[test]
    fn only_files_are_read() {
        for other in ["/dev/zero", "/dev/null", "/"] {
            let error = text(Path::new(other), 4).expect_err("no file");
            assert_eq!(error.to_string(), "it is not a file");
        }
    }
}
