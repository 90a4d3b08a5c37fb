//! Finds the layer's library, for programs of 64 and of 32 bits.
//!
//! Where both are there, one `LD_PRELOAD` serves them: the loader replaces `$LIB` in it (ld.so(8)), by `lib/x86_64-linux-gnu`, `lib64`, `lib32` and the like. The folder
//! `by-class` beside the library has links of all these names (`scripts/by-class.sh`), and `64` and `32` beside them.
#![forbid(unsafe_code)]

use super::elf::{Class, Elf};
use super::error::LaunchError;
use crate::config::{LIBRARY, LIBRARY_FILE};
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

/// The folder of the links.
const BY_CLASS: &str = "by-class";

/// The libraries of an installation or of a build.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Libraries {
    /// The one beside which companions lie, and its class.
    main: (PathBuf, Class),
    /// That of the other class.
    other: Option<PathBuf>,
    /// What `LD_PRELOAD` names.
    preload: PathBuf,
}

impl Libraries {
    fn one(path: PathBuf, class: Class) -> Self {
        Libraries {
            preload: path.clone(),
            main: (path, class),
            other: None,
        }
    }

    /// The library of 64-bit programs, or the only one.
    #[must_use]
    pub fn main(&self) -> &Path {
        &self.main.0
    }

    /// That of programs of a class.
    #[must_use]
    pub fn of(&self, class: Class) -> Option<&Path> {
        match class == self.main.1 {
            true => Some(&self.main.0),
            false => self.other.as_deref(),
        }
    }

    /// The item of `LD_PRELOAD` that serves programs of all classes that there is a library for.
    #[must_use]
    pub fn preload(&self) -> &Path {
        &self.preload
    }
}

/// Finds the libraries: the one in `MANYVIEW_LIBRARY`, else those beside the command, else in `../lib/manyview` of the command's folder.
///
/// # Errors
/// There is none, or it cannot be preloaded.
pub fn find() -> Result<Libraries, LaunchError> {
    if let Some(named) = std::env::var_os(LIBRARY).filter(|value| !value.is_empty()) {
        let (path, class) = check(PathBuf::from(named))?;
        return Ok(Libraries::one(path, class));
    }
    let searched = folders();
    let Some(folder) = searched
        .iter()
        .find(|folder| folder.join(LIBRARY_FILE).is_file())
    else {
        return Err(LaunchError::NoLibrary { searched });
    };
    let (path, class) = check(folder.join(LIBRARY_FILE))?;
    let mut found = Libraries::one(path, class);
    let links = found.main().parent().map(|folder| folder.join(BY_CLASS));
    if let Some(links) = links
        && let Ok((narrow, Class::Narrow)) = check(links.join("32").join(LIBRARY_FILE))
        && links.join("64").join(LIBRARY_FILE).is_file()
    {
        found.other = Some(narrow);
        found.preload = links.join("$LIB").join(LIBRARY_FILE);
    }
    Ok(found)
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

/// The program that makes contexts, of the class of a program; none where it is not there.
pub(super) fn probe(class: Option<Class>) -> Option<PathBuf> {
    if class != Some(Class::Narrow) {
        return helper(PROBE).ok();
    }
    let narrow = find().ok()?.of(Class::Narrow)?.with_file_name(PROBE);
    narrow.is_file().then_some(narrow)
}

/// The folders of the scenes of `manyview bench`: `scenes` beside an installed library, and `demos` beside the build folder that holds the
/// library.
pub fn scene_folders() -> Result<[PathBuf; 2], LaunchError> {
    let libraries = find()?;
    let beside = libraries.main().parent().unwrap_or(Path::new("/"));
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

/// The whole path of a library and its class, after checking that `LD_PRELOAD` can express it and that this machine can load it.
fn check(path: PathBuf) -> Result<(PathBuf, Class), LaunchError> {
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
        Ok(Some(elf)) => match elf.class() {
            Some(class) => Ok((whole, class)),
            None => Err(bad("it is not a shared library for this machine")),
        },
        Ok(None) => Err(bad("it is not a shared library for this machine")),
        Err(error) => Err(bad(&error.to_string())),
    }
}

fn has_separator(path: &OsStr) -> bool {
    path.as_bytes()
        .iter()
        .any(|byte| matches!(byte, b' ' | b':' | b'$'))
}
