//! Writes files in one step: a reader never sees half of one, and nothing that lies in the way is written to.
#![forbid(unsafe_code)]

use std::fs::{File, OpenOptions};
use std::io::{BufWriter, Error, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// How many names are tried for the file that grows; others are taken by processes that were killed while they wrote.
const NAMES: u32 = 64;

/// Replaces a file by one with these contents.
///
/// # Errors
/// See [`replace_by`].
pub fn replace(path: &Path, contents: &[u8]) -> std::io::Result<()> {
    replace_by(path, |file| file.write_all(contents))
}

/// Replaces a file by one that `write` writes: to a new file beside it, which then gets its name. Links are replaced, not followed.
///
/// # Errors
/// The file cannot be made, `write` fails, or `path` is there and is neither a file nor a link, such as a device. The old file is then as
/// it was.
pub fn replace_by(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> std::io::Result<()>,
) -> std::io::Result<()> {
    if let Ok(there) = std::fs::symlink_metadata(path)
        && !(there.is_file() || there.is_symlink())
    {
        return Err(Error::new(
            ErrorKind::InvalidInput,
            "it is not a regular file",
        ));
    }
    let (growing, file) = new_beside(path)?;
    let mut file = BufWriter::new(file);
    let written = write(&mut file)
        .and_then(|()| file.flush())
        .and_then(|()| std::fs::rename(&growing, path));
    if written.is_err() {
        // The first error counts.
        let _ = std::fs::remove_file(&growing);
    }
    written
}

/// Makes a file that was not there, in the folder of `path`: `.NAME.PROCESS.N.tmp`.
fn new_beside(path: &Path) -> std::io::Result<(PathBuf, File)> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let process = std::process::id();
    let mut taken = Error::from(ErrorKind::AlreadyExists);
    for n in 0..NAMES {
        let growing = path.with_file_name(format!(".{name}.{process}.{n}.tmp"));
        // A new file is never a link to another one.
        match OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(&growing)
        {
            Ok(file) => return Ok((growing, file)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => taken = error,
            Err(error) => return Err(error),
        }
    }
    Err(taken)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).expect("a folder");
        let name = |entry: std::io::Result<std::fs::DirEntry>| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        };
        let mut names: Vec<String> = entries.map(name).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_replaced_and_nothing_is_left() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.json");
        for text in ["one", "two"] {
            replace(&path, text.as_bytes()).expect("written");
            assert_eq!(std::fs::read_to_string(&path).expect("a file"), text);
        }
        assert_eq!(names(folder.path()), ["a.json"]);
    }

    #[test]
    fn what_lies_in_the_way_is_left_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        let (path, other) = (folder.path().join("a.json"), folder.path().join("other"));
        std::fs::write(&other, "precious").expect("written");
        let process = std::process::id();
        for n in 0..3 {
            let growing = folder.path().join(format!(".a.json.{process}.{n}.tmp"));
            symlink(&other, growing).expect("a link");
        }
        symlink(&other, &path).expect("a link");
        replace(&path, b"ours").expect("written");
        assert_eq!(std::fs::read_to_string(&other).expect("a file"), "precious");
        assert_eq!(std::fs::read_to_string(&path).expect("a file"), "ours");
        assert!(!path.is_symlink());
    }

    #[test]
    fn a_device_is_not_replaced() {
        let error = replace(Path::new("/dev/null"), b"ours").expect_err("a device");
        assert_eq!(error.to_string(), "it is not a regular file");
    }

    #[test]
    fn a_failed_write_leaves_the_old_file_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.json");
        replace(&path, b"old").expect("written");
        let fails = replace_by(&path, |file| {
            file.write_all(b"half")?;
            Err(Error::other("the disk is full"))
        });
        assert!(fails.is_err());
        assert_eq!(std::fs::read_to_string(&path).expect("a file"), "old");
        assert_eq!(names(folder.path()), ["a.json"]);
    }
}
