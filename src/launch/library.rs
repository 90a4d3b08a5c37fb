//! Finds the layer's library.
#![forbid(unsafe_code)]

use super::elf::Elf;
use super::error::LaunchError;
use crate::config::{LIBRARY, LIBRARY_FILE};
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

/// Finds the library: the path in `MANYVIEW_LIBRARY`, else beside the command, else in `../lib/manyview` of the command's folder.
pub fn find() -> Result<PathBuf, LaunchError> {
    if let Some(named) = std::env::var_os(LIBRARY).filter(|value| !value.is_empty()) {
        return check(PathBuf::from(named));
    }
    let searched = folders();
    match searched
        .iter()
        .map(|folder| folder.join(LIBRARY_FILE))
        .find(|path| path.is_file())
    {
        Some(path) => check(path),
        None => Err(LaunchError::NoLibrary { searched }),
    }
}

/// The program that makes contexts of its own, to ask drivers and to measure.
pub(super) const PROBE: &str = "manyview-probe";

/// Finds one of our programs, beside the command or in `../lib/manyview` of its folder.
///
/// # Errors
/// It is not there.
pub fn helper(name: &'static str) -> Result<PathBuf, LaunchError> {
    let searched = folders();
    let mut paths = searched.iter().map(|folder| folder.join(name));
    let found = paths.find(|path| path.is_file());
    found.ok_or(LaunchError::NoHelper { name, searched })
}

/// The folders of the scenes of `manyview bench`: `scenes` beside an installed library, and `demos` beside the build folder that holds the
/// library.
pub fn scene_folders() -> Result<[PathBuf; 2], LaunchError> {
    let library = find()?;
    let beside = library.parent().unwrap_or(Path::new("/"));
    let build = beside.parent().unwrap_or(Path::new("/"));
    Ok([beside.join("scenes"), build.join("demos")])
}

fn folders() -> Vec<PathBuf> {
    let executable = std::env::current_exe()
        .and_then(|path| path.canonicalize())
        .unwrap_or_default();
    let beside = executable.parent().map(Path::to_owned).unwrap_or_default();
    let installed = beside
        .parent()
        .map(|prefix| prefix.join("lib/manyview"))
        .unwrap_or_default();
    vec![beside, installed]
}

/// The whole path of a library, after checking that `LD_PRELOAD` can express it and that this machine can load it.
fn check(path: PathBuf) -> Result<PathBuf, LaunchError> {
    let bad = |reason: &str| LaunchError::BadLibrary {
        path: path.clone(),
        reason: reason.to_owned(),
    };
    let whole = path
        .canonicalize()
        .map_err(|error| bad(&error.to_string()))?;
    if has_separator(whole.as_os_str()) {
        return Err(bad(
            "LD_PRELOAD cannot express a path with a space, a colon or a dollar sign",
        ));
    }
    match Elf::open(&whole) {
        Ok(Some(elf)) if elf.is_native() => Ok(whole),
        Ok(_) => Err(bad("it is not a shared library for this machine")),
        Err(error) => Err(bad(&error.to_string())),
    }
}

fn has_separator(path: &OsStr) -> bool {
    path.as_bytes()
        .iter()
        .any(|byte| matches!(byte, b' ' | b':' | b'$'))
}
