//! The place of the sockets: a folder that only the user can enter.
#![forbid(unsafe_code)]

use super::ControlError;
use std::ffi::OsStr;
use std::fs::{self, DirBuilder, Metadata};
use std::io::ErrorKind;
use std::os::unix::fs::{DirBuilderExt, MetadataExt, PermissionsExt};
use std::path::{Path, PathBuf};

/// The variable that names the user's runtime folder.
pub const RUNTIME: &str = "XDG_RUNTIME_DIR";
/// Permissions of the folder.
const FOLDER_MODE: u32 = 0o700;
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

/// The process ID of the program that a socket belongs to. None if the path is not that of a socket.
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
    }

    #[test]
    fn only_the_same_user_may_talk() {
        assert!(may_talk(Some(1000), 1000));
        assert!(!may_talk(Some(1001), 1000));
        assert!(!may_talk(Some(0), 1000));
        assert!(!may_talk(None, 1000));
    }
}
