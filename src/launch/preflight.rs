//! Checks before the program starts, so that a mistake is one line on stderr and not a picture that never comes.
#![forbid(unsafe_code)]

use super::elf::{Class, Elf};
use super::error::LaunchError;
use super::library::Libraries;
use crate::config::Config;
use rustix::fs::{Access, access, getxattr};
use std::ffi::OsStr;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

/// Finds the program as a shell would, and refuses one that the layer cannot enter. Its class; none for a script, whose programs inherit the layer.
pub fn check_app(name: &OsStr) -> Result<(PathBuf, Option<Class>), LaunchError> {
    let path = find(name)?;
    let Ok(Some(elf)) = Elf::open(&path) else {
        return Ok((path, None));
    };
    match closed(&path, &elf) {
        Some((reason, remedy)) => Err(LaunchError::AppClosed {
            path,
            reason,
            remedy,
        }),
        None => Ok((path, elf.class())),
    }
}

/// Refuses a program of a class that the layer has no library for.
pub(super) fn check_class(
    path: &Path,
    class: Option<Class>,
    libraries: &Libraries,
) -> Result<(), LaunchError> {
    let (reason, remedy) = match class {
        Some(class) if libraries.of(class).is_some() => return Ok(()),
        None => return Ok(()),
        Some(Class::Narrow) => (
            "it is a 32-bit program and the layer's library for those is not there",
            "; `make build-32` makes it",
        ),
        Some(Class::Wide) => (
            "it is a 64-bit program and the layer's library has 32 bits",
            "; `make build` makes one for it",
        ),
    };
    Err(LaunchError::AppClosed {
        path: path.to_owned(),
        reason,
        remedy,
    })
}

/// `cp` leaves out what keeps the loader from preloading; most games have it for a common file of high scores, and run without.
const COPY: &str = "; run a copy of it, which `cp` makes without that";

/// Why the loader would not preload into this program, and what helps. None if it would.
fn closed(path: &Path, elf: &Elf) -> Option<(&'static str, &'static str)> {
    let mode = std::fs::metadata(path).map_or(0, |about| about.permissions().mode());
    let capabilities = getxattr(path, "security.capability", &mut [0_u8; 64]).is_ok();
    if mode & 0o4000 != 0 {
        Some(("it is setuid and the loader ignores LD_PRELOAD", COPY))
    } else if mode & 0o2000 != 0 {
        Some(("it is setgid and the loader ignores LD_PRELOAD", COPY))
    } else if capabilities {
        Some((
            "it has file capabilities and the loader ignores LD_PRELOAD",
            COPY,
        ))
    } else if elf.class().is_none() {
        Some(("it is a program for another machine", ""))
    } else if !elf.has_interpreter {
        Some(("it is statically linked and loads no libraries", ""))
    } else {
        None
    }
}

fn find(name: &OsStr) -> Result<PathBuf, LaunchError> {
    let direct = Path::new(name);
    if name.as_encoded_bytes().contains(&b'/') {
        if !direct.exists() {
            return Err(LaunchError::AppNotFound(direct.display().to_string()));
        }
        return executable(direct).map(|()| direct.to_owned());
    }
    let path = std::env::var_os("PATH").unwrap_or_default();
    let mut refused = None;
    for candidate in std::env::split_paths(&path).map(|folder| folder.join(name)) {
        match executable(&candidate) {
            Ok(()) => return Ok(candidate),
            Err(error) if candidate.is_file() => refused = refused.or(Some(error)),
            Err(_) => {}
        }
    }
    Err(refused.unwrap_or_else(|| LaunchError::AppNotFound(direct.display().to_string())))
}

fn executable(path: &Path) -> Result<(), LaunchError> {
    let no = |reason: String| LaunchError::AppNotExecutable {
        path: path.to_owned(),
        reason,
    };
    let about = std::fs::metadata(path).map_err(|error| no(error.to_string()))?;
    if !about.is_file() {
        return Err(no("it is not a file; give the program itself".to_owned()));
    }
    access(path, Access::EXEC_OK)
        .map_err(|_| no("it is not executable; check its permissions".to_owned()))
}

/// Checks that the folders of report, explanation and pictures exist and are writable.
pub fn check_files(config: &Config) -> Result<(), LaunchError> {
    if let Some(report) = &config.report {
        writable("the report", report)?;
    }
    if let Some(explain) = &config.explain {
        for file in explain.files() {
            writable("the explanation", &file)?;
        }
    }
    if let Some(capture) = &config.capture {
        writable("the picture", &capture.path_for(capture.first))?;
    }
    Ok(())
}

/// Checks that a file can be created or replaced in its folder.
pub fn writable(purpose: &'static str, path: &Path) -> Result<(), LaunchError> {
    let no = |reason: String| LaunchError::NotWritable {
        purpose,
        path: path.to_owned(),
        reason,
    };
    if path.is_dir() || path.file_name().is_none() {
        return Err(no("that is a folder; give the name of a file".to_owned()));
    }
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        return Err(no(format!("there is no folder {}", folder.display())));
    }
    access(folder, Access::WRITE_OK | Access::EXEC_OK)
        .map_err(|_| no(format!("the folder {} is not writable", folder.display())))
}
