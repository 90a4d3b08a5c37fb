//! The place of the sockets: a folder that only the user can enter.
//!
//! A program in a container may have another runtime folder and another `/tmp` than the user. So the launcher makes several folders, of which the program takes the first that is there: what is
//! private to a container is empty.
#![forbid(unsafe_code)]

use super::ControlError;
use std::ffi::{OsStr, OsString};
use std::fs::{self, DirBuilder, Metadata};
use std::io::ErrorKind;
use std::os::unix::fs::{DirBuilderExt, MetadataExt, PermissionsExt};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};

/// The variable that names the user's runtime folder.
pub const RUNTIME: &str = "XDG_RUNTIME_DIR";
/// The variable by which a Flatpak program knows its name.
pub const FLATPAK: &str = "FLATPAK_ID";
/// Permissions of the folder.
const FOLDER_MODE: u32 = 0o700;
/// Larger than the ID of any process (proc(5), pid_max), and the most containers in which programs have the same one.
const NO_PROCESS: u32 = 1 << 22;
const CONTAINERS: u32 = 64;
/// Permissions of a socket.
const SOCKET_MODE: u32 = 0o600;

/// The folder for a user; `runtime` is the value of [`RUNTIME`]. A value that is not a folder of the user's (after `su`, say) counts as
/// not set.
#[must_use]
pub fn folder(runtime: Option<&OsStr>, user: u32) -> PathBuf {
    let own = |path: &&Path| {
        path.is_absolute() && fs::metadata(path).is_ok_and(|m| m.is_dir() && m.uid() == user)
    };
    match runtime.map(Path::new).filter(own) {
        Some(path) => path.join("manyview"),
        None => PathBuf::from(format!("/tmp/manyview-{user}")),
    }
}

/// The folder below the user's home, which most containers share.
#[must_use]
pub fn shared_folder(home: Option<&OsStr>) -> Option<PathBuf> {
    let home = home.map(Path::new).filter(|path| path.is_absolute())?;
    Some(home.join(".cache/manyview/sockets"))
}

/// The folder of a Flatpak program below the user's runtime folder, which is the same inside and outside.
#[must_use]
pub fn flatpak_folder(runtime: Option<&OsStr>, id: &OsStr) -> Option<PathBuf> {
    let runtime = runtime.map(Path::new).filter(|path| path.is_absolute())?;
    Some(runtime.join("app").join(id).join("manyview"))
}

/// The folder of a program that nobody has started for the user. `variable` gives those of its environment.
fn alone(variable: impl Fn(&str) -> Option<OsString>, user: u32) -> PathBuf {
    let runtime = variable(RUNTIME);
    let flatpak = variable(FLATPAK).and_then(|id| flatpak_folder(runtime.as_deref(), &id));
    let there = |path: &PathBuf| path.parent().is_some_and(Path::is_dir);
    let flatpak = flatpak.filter(there);
    flatpak.unwrap_or_else(|| folder(runtime.as_deref(), user))
}

/// The folder in which a program listens: the first of those that the launcher has `given` and that are there, in a container too; else one of its own, which is made.
///
/// # Errors
/// It cannot be made, or is not the user's alone.
pub fn choose(
    given: &[PathBuf],
    variable: impl Fn(&str) -> Option<OsString>,
    user: u32,
) -> Result<PathBuf, ControlError> {
    let mut there = given
        .iter()
        .filter(|path| matches!(check(path, user), Ok(true)));
    if let Some(path) = there.next() {
        return Ok(path.clone());
    }
    let own = alone(variable, user);
    prepare(&own, user).map(|()| own)
}

/// The folders in which programs may listen, also those in containers: the user's own, that below home, and those of Flatpak programs.
pub fn all(variable: impl Fn(&str) -> Option<OsString>, user: u32) -> Vec<PathBuf> {
    let runtime = variable(RUNTIME);
    let apps = runtime.as_ref().map(|path| Path::new(path).join("app"));
    let apps = apps.and_then(|path| fs::read_dir(path).ok());
    let apps = apps.into_iter().flatten().flatten();
    let flatpak = apps.map(|app| app.path().join("manyview"));
    let mut all = vec![folder(runtime.as_deref(), user)];
    all.extend(shared_folder(variable("HOME").as_deref()));
    all.extend(flatpak);
    all.retain(|path| path.is_dir());
    all
}

/// Makes the folders that the launcher gives to a program, the better one first. Where one cannot be made, the program takes the other.
pub fn give(variable: impl Fn(&str) -> Option<OsString>, user: u32) -> Vec<PathBuf> {
    let own = folder(variable(RUNTIME).as_deref(), user);
    let shared = shared_folder(variable("HOME").as_deref());
    let made = |path: &PathBuf| {
        // What prepare says of its folder is what counts.
        let _ = path.parent().map(fs::create_dir_all);
        prepare(path, user).is_ok()
    };
    let all = std::iter::once(own).chain(shared);
    all.filter(made).collect()
}

/// Makes the folder if it does not exist, and checks that it is the user's alone.
pub fn prepare(folder: &Path, user: u32) -> Result<(), ControlError> {
    match DirBuilder::new().mode(FOLDER_MODE).create(folder) {
        Err(error) if error.kind() != ErrorKind::AlreadyExists => Err(wrong(
            folder,
            format!("cannot be made ({})", reason(&error)),
        )),
        _ => check(folder, user).map(drop),
    }
}

/// Whether the folder exists. An error if it is not the user's alone, so that others could have put something into it.
pub fn check(folder: &Path, user: u32) -> Result<bool, ControlError> {
    let about = match fs::symlink_metadata(folder) {
        Ok(about) => about,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(false),
        Err(error) => {
            return Err(wrong(
                folder,
                format!("cannot be looked at ({})", reason(&error)),
            ));
        }
    };
    match flaw(&about, user) {
        None => Ok(true),
        Some(flaw) => Err(wrong(folder, flaw)),
    }
}

fn flaw(about: &Metadata, user: u32) -> Option<String> {
    let mode = about.mode() & 0o777;
    if !about.is_dir() {
        Some("is a link or a file".to_owned())
    } else if about.uid() != user {
        Some(format!("belongs to user {}", about.uid()))
    } else if mode != FOLDER_MODE {
        Some(format!("has mode {mode:o} instead of {FOLDER_MODE:o}"))
    } else {
        None
    }
}

fn wrong(folder: &Path, reason: String) -> ControlError {
    ControlError::Folder {
        path: folder.to_owned(),
        reason,
    }
}

fn reason(error: &std::io::Error) -> String {
    error.kind().to_string()
}

/// Lets only the user open a socket.
pub fn close_to_others(socket: &Path) -> std::io::Result<()> {
    fs::set_permissions(socket, fs::Permissions::from_mode(SOCKET_MODE))
}

/// The path of the socket of a program.
#[must_use]
pub fn socket(folder: &Path, pid: u32) -> PathBuf {
    folder.join(format!("{pid}.sock"))
}

/// The path for the socket of a program. A program in another container may have the same process ID: where it listens, the path has a number that no process has.
#[must_use]
pub fn free_socket(folder: &Path, pid: u32) -> PathBuf {
    let numbers = (0..CONTAINERS).map(|n| pid + n * NO_PROCESS);
    let mut paths = numbers.map(|number| socket(folder, number));
    let free = paths.find(|path| UnixStream::connect(path).is_err());
    free.unwrap_or_else(|| socket(folder, pid))
}

/// The number of a socket in its name: the process ID of the program that it belongs to, in its own container, or another number. None if the path is not that of a socket.
#[must_use]
pub fn pid(socket: &Path) -> Option<u32> {
    let name = socket.file_name()?.to_str()?;
    name.strip_suffix(".sock")?.parse().ok()
}

/// Whether a peer may send requests: only the user who runs the program may, not even root.
#[must_use]
pub fn may_talk(peer: Option<u32>, user: u32) -> bool {
    peer == Some(user)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The user who runs the tests.
    fn user(folder: &Path) -> u32 {
        fs::metadata(folder).unwrap().uid()
    }

    #[test]
    fn the_folder_is_the_users_own_or_in_tmp() {
        let home = tempfile::tempdir().unwrap();
        let user = user(home.path());
        let runtime = Some(home.path().as_os_str());
        assert_eq!(folder(runtime, user), home.path().join("manyview"));
        let other = PathBuf::from(format!("/tmp/manyview-{}", user + 1));
        assert_eq!(folder(runtime, user + 1), other);
        let tmp = PathBuf::from(format!("/tmp/manyview-{user}"));
        assert_eq!(folder(None, user), tmp);
        assert_eq!(folder(Some(OsStr::new("")), user), tmp);
        assert_eq!(folder(Some(OsStr::new("relative")), user), tmp);
        assert_eq!(folder(Some(OsStr::new("/no/such/folder")), user), tmp);
    }

    #[test]
    fn a_program_in_a_container_takes_a_folder_that_is_the_same_outside() {
        let outside = tempfile::tempdir().unwrap();
        let user = user(outside.path());
        let [runtime, home, private] = ["runtime", "home", "private"].map(|name| {
            let path = outside.path().join(name);
            fs::create_dir(&path).unwrap();
            path
        });
        let environment = |runtime: &Path, id: Option<&str>| {
            let (runtime, home) = (runtime.to_owned(), home.clone());
            let id = id.map(OsString::from);
            move |name: &str| match name {
                RUNTIME => Some(runtime.clone().into_os_string()),
                "HOME" => Some(home.clone().into_os_string()),
                FLATPAK => id.clone(),
                _ => None,
            }
        };
        let taken = |given: &[PathBuf], runtime: &Path, id| {
            choose(given, environment(runtime, id), user).unwrap()
        };
        let given = give(environment(&runtime, None), user);
        let shared = home.join(".cache/manyview/sockets");
        assert_eq!(given, [runtime.join("manyview"), shared.clone()]);
        assert_eq!(taken(&given, &runtime, None), runtime.join("manyview"));
        // Not by the launcher: nothing but its own folder counts.
        assert_eq!(taken(&[], &private, None), private.join("manyview"));
        let app = runtime.join("app/org.example.Game");
        fs::create_dir_all(&app).unwrap();
        assert_eq!(
            taken(&[], &runtime, Some("org.example.Game")),
            app.join("manyview")
        );
        // In a container that shows the home alone.
        fs::remove_dir_all(runtime.join("manyview")).unwrap();
        assert_eq!(taken(&given, &runtime, None), shared);
        prepare(&runtime.join("manyview"), user).unwrap();
        let mut found = all(environment(&runtime, None), user);
        found.sort();
        assert_eq!(
            found,
            [shared, app.join("manyview"), runtime.join("manyview")]
        );
    }

    #[test]
    fn only_a_folder_that_is_the_users_alone_will_do() {
        let home = tempfile::tempdir().unwrap();
        let user = user(home.path());
        let path = home.path().join("manyview");
        assert_eq!(check(&path, user), Ok(false));
        prepare(&path, user).unwrap();
        prepare(&path, user).unwrap();
        assert_eq!(check(&path, user), Ok(true));
        assert_eq!(fs::metadata(&path).unwrap().mode() & 0o7777, 0o700);
        let message = |path: &Path, user| prepare(path, user).unwrap_err().to_string();
        assert!(message(&path, user + 1).contains("belongs to user"));
        fs::set_permissions(&path, fs::Permissions::from_mode(0o770)).unwrap();
        assert!(message(&path, user).contains("mode 770"));
        fs::set_permissions(&path, fs::Permissions::from_mode(0o700)).unwrap();
        let link = home.path().join("link");
        std::os::unix::fs::symlink(&path, &link).unwrap();
        assert!(message(&link, user).contains("link"));
        fs::write(home.path().join("file"), "").unwrap();
        assert!(message(&home.path().join("file"), user).contains("file"));
        assert!(message(&home.path().join("no/such"), user).contains("cannot be made"));
    }

    #[test]
    fn sockets_are_named_by_their_program() {
        let path = socket(Path::new("/run/user/7/manyview"), 4711);
        assert_eq!(path, Path::new("/run/user/7/manyview/4711.sock"));
        assert_eq!(pid(&path), Some(4711));
        assert_eq!(pid(Path::new("/x/4711.sock.tmp")), None);
        assert_eq!(pid(Path::new("/x/a.sock")), None);
        let folder = tempfile::tempdir().unwrap();
        let first = free_socket(folder.path(), 2);
        assert_eq!(first, folder.path().join("2.sock"));
        let _listens = std::os::unix::net::UnixListener::bind(&first).unwrap();
        let second = free_socket(folder.path(), 2);
        assert_ne!(second, first);
        assert!(pid(&second) > Some(4_194_304), "{second:?}");
    }

    #[test]
    fn only_the_same_user_may_talk() {
        assert!(may_talk(Some(1000), 1000));
        assert!(!may_talk(Some(1001), 1000));
        assert!(!may_talk(Some(0), 1000));
        assert!(!may_talk(None, 1000));
    }
}
