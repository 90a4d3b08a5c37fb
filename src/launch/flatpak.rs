//! Programs in Flatpak: `flatpak run` with the layer in the environment of the sandbox.
//!
//! A sandbox has another `/usr` and another `/tmp`, and shows none of the user's folders unless it is told to (flatpak-run(1)). So the layer's libraries and profiles are copied to the user's
//! cache, and the sandbox gets that folder, those of the sockets, and those of the files that options name.
#![forbid(unsafe_code)]

use super::elf::Class;
use super::error::LaunchError;
use super::library::Libraries;
use super::preload;
use crate::config::{LIBRARY_FILE, OPTIONS, OptionId, PathKind};
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};

/// The command that runs programs in sandboxes.
pub(super) const COMMAND: &str = "flatpak";

/// Copies of the layer's files where a sandbox can see them.
#[derive(Debug)]
struct Copies {
    /// What `LD_PRELOAD` names.
    preload: PathBuf,
    profiles: PathBuf,
    folder: PathBuf,
}

/// The words after `flatpak` for a program with this ID: `variables` are those of the layer, and `given` the program's arguments.
///
/// # Errors
/// The cache of the user cannot be written.
pub(super) fn words(
    id: &OsStr,
    variables: &[(String, String)],
    given: &[OsString],
    libraries: &Libraries,
) -> Result<Vec<OsString>, LaunchError> {
    let home = std::env::var_os("HOME").map(PathBuf::from);
    let home = home.filter(|path| path.is_absolute());
    let cache = home
        .unwrap_or_else(std::env::temp_dir)
        .join(".cache/manyview");
    let old = variables
        .iter()
        .find(|(name, _)| *name == OptionId::Profiles.spec().variable);
    let copies = copy(libraries, old.map(|(_, path)| Path::new(path)), &cache)?;
    let mut words: Vec<OsString> = vec!["run".into()];
    let mut share = |path: &Path, how: &str| {
        let mut word = OsString::from("--filesystem=");
        word.push(path);
        word.push(how);
        words.push(word);
    };
    share(&copies.folder, ":ro");
    let sockets = variables
        .iter()
        .find(|(name, _)| *name == OptionId::Sockets.spec().variable);
    let sockets = sockets.map_or("", |(_, folders)| folders);
    for folder in std::env::split_paths(sockets).filter(|path| path.is_absolute()) {
        share(&folder, "");
    }
    for (folder, path) in named(variables) {
        if std::env::var_os("HOME").is_some_and(|home| Path::new(&home).starts_with(&folder)) {
            return Err(LaunchError::NotWritable {
                purpose: "a file that an option names",
                path,
                reason: "its folder is your whole home, which the sandbox would be shown; give a file in a folder below it"
                    .to_owned(),
            });
        }
        share(&folder, "");
    }
    let launch = variables
        .iter()
        .find(|(name, _)| *name == OptionId::Launch.spec().variable);
    if let Some((_, folder)) = launch {
        share(Path::new(folder), "");
    }
    let mut set = |name: &str, value: &OsStr| {
        let mut word = OsString::from(format!("--env={name}="));
        word.push(value);
        words.push(word);
    };
    set("LD_PRELOAD", &preload::with_library(&copies.preload, None));
    for (name, value) in variables {
        match *name == OptionId::Profiles.spec().variable {
            true => set(name, copies.profiles.as_os_str()),
            false => set(name, OsStr::new(value)),
        }
    }
    words.push(id.to_owned());
    words.extend_from_slice(given);
    Ok(words)
}

/// The folders of the files that options name, each with one of them, without those of sockets and of the layer's own.
fn named(variables: &[(String, String)]) -> Vec<(PathBuf, PathBuf)> {
    let apart = [OptionId::Profiles, OptionId::PanelSocket, OptionId::Launch];
    let rows = OPTIONS
        .iter()
        .filter(|spec| spec.path != PathKind::No && !apart.contains(&spec.id));
    let values = rows.filter_map(|spec| {
        let (_, value) = variables.iter().find(|(name, _)| *name == spec.variable)?;
        Path::new(value).is_absolute().then(|| PathBuf::from(value))
    });
    let mut folders: Vec<(PathBuf, PathBuf)> = values
        .filter_map(|path| Some((path.parent()?.to_owned(), path.clone())))
        .collect();
    folders.sort();
    folders.dedup_by(|next, before| next.0 == before.0);
    folders
}

fn copy(
    libraries: &Libraries,
    profiles: Option<&Path>,
    cache: &Path,
) -> Result<Copies, LaunchError> {
    let failed = |source| LaunchError::System {
        doing: "copying the layer to the cache for Flatpak",
        source,
    };
    let folder = cache.join("flatpak");
    let by_class = folder.join("by-class");
    // As `scripts/by-class.sh` has them; runtimes of Flatpak are laid out as Debian is.
    let classes = [
        (Class::Wide, "lib/x86_64-linux-gnu"),
        (Class::Narrow, "lib/i386-linux-gnu"),
    ];
    for (class, name) in classes {
        if let Some(library) = libraries.of(class) {
            update(library, &by_class.join(name).join(LIBRARY_FILE)).map_err(failed)?;
        }
    }
    let copied = folder.join("profiles");
    for entry in profiles
        .and_then(|path| fs::read_dir(path).ok())
        .into_iter()
        .flatten()
        .flatten()
    {
        update(&entry.path(), &copied.join(entry.file_name())).map_err(failed)?;
    }
    Ok(Copies {
        preload: by_class.join("$LIB").join(LIBRARY_FILE),
        profiles: copied,
        folder,
    })
}

/// Copies a file if it is another one than the copy, in one step: a program may be using the copy.
fn update(from: &Path, to: &Path) -> std::io::Result<()> {
    let about = fs::metadata(from)?;
    if !about.is_file() {
        return Ok(());
    }
    let same = |copy: fs::Metadata| {
        Some(copy.len() == about.len() && copy.modified().ok()? == about.modified().ok()?)
    };
    if fs::metadata(to).ok().and_then(same) == Some(true) {
        return Ok(());
    }
    if let Some(folder) = to.parent() {
        fs::create_dir_all(folder)?;
    }
    let growing = to.with_extension(format!("{}.new", std::process::id()));
    // Not with the mode of the other, which may be closed to writing.
    let mut copy = fs::File::create(&growing)?;
    std::io::copy(&mut fs::File::open(from)?, &mut copy)?;
    copy.set_modified(about.modified()?)?;
    fs::rename(&growing, to)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sandbox_gets_the_folders_of_named_files_and_no_others() {
        let variable =
            |id: OptionId, value: &str| (id.spec().variable.to_owned(), value.to_owned());
        let variables = [
            variable(OptionId::Report, "/home/me/out/report.json"),
            variable(OptionId::Explain, "/home/me/out/why.png"),
            variable(OptionId::Display, "huebner8"),
            variable(OptionId::PanelSocket, "/run/user/1/manyview/panel-1.sock"),
            variable(OptionId::Profiles, "/usr/lib/manyview/profiles"),
            variable(OptionId::Strategy, "replay"),
        ];
        let folders: Vec<_> = named(&variables)
            .into_iter()
            .map(|(folder, _)| folder)
            .collect();
        assert_eq!(folders, [Path::new("/home/me/out")]);
    }

    #[test]
    fn a_copy_follows_what_it_is_of() {
        let folder = tempfile::tempdir().unwrap();
        let [from, to] = ["from", "to/copy"].map(|name| folder.path().join(name));
        let written = || fs::read_to_string(&to).unwrap();
        fs::write(&from, "one").unwrap();
        update(&from, &to).unwrap();
        assert_eq!(written(), "one");
        let about = fs::metadata(&to).unwrap();
        update(&from, &to).unwrap();
        assert_eq!(
            about.modified().unwrap(),
            fs::metadata(&from).unwrap().modified().unwrap()
        );
        fs::write(&from, "another").unwrap();
        update(&from, &to).unwrap();
        assert_eq!(written(), "another");
        assert_eq!(fs::read_dir(folder.path().join("to")).unwrap().count(), 1);
    }
}
