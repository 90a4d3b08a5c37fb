//! What the targets share: files, because the code that is tested reads files.
#![forbid(unsafe_code)]

use std::cell::OnceCell;
use std::path::PathBuf;
use tempfile::TempDir;

thread_local! {
    static FOLDER: OnceCell<TempDir> = const { OnceCell::new() };
}

/// Memory, where the system has it as a folder: disks take a thousand times as long.
const MEMORY: &str = "/dev/shm";

/// Writes a file of this name into a folder of this process, and returns its path. It is the only file in it, so that paths in it lead nowhere.
pub fn file(name: &str, contents: &[u8]) -> PathBuf {
    FOLDER.with(|folder| {
        let folder = folder.get_or_init(|| {
            let memory = tempfile::tempdir_in(MEMORY).or_else(|_| tempfile::tempdir());
            memory.expect("a folder")
        });
        let path = folder.path().join(name);
        std::fs::write(&path, contents).expect("written");
        path
    })
}

/// Pixels of the largest picture that is decoded: larger ones are slow and tell nothing new.
const MOST_PIXELS: u64 = 1 << 18;

/// Whether a picture is small enough to be decoded often. One whose size cannot be read is.
pub fn is_small(bytes: &[u8]) -> bool {
    let reader = image::ImageReader::new(std::io::Cursor::new(bytes)).with_guessed_format();
    let size = reader.ok().and_then(|reader| reader.into_dimensions().ok());
    size.is_none_or(|(width, height)| u64::from(width) * u64::from(height) <= MOST_PIXELS)
}
