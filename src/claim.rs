//! Which process of a launch writes to a path that the user has named.
//!
//! A game comes with others: a launcher with a window of its own, a second window in a process of its own, a helper. All of them have the layer
//! and the same options. The first that writes to a path has it, and the others add their process ID to the name. A process that has ended makes
//! room for the next one: its file gets its process ID then. [Decision 32](../docs/decisions/0032-one-writer-of-a-path.md) has the reasons.
#![forbid(unsafe_code)]

use crate::checksum::fnv1a;
use crate::config::Config;
use crate::control::place;
use std::ffi::OsStr;
use std::fmt::{self, Display};
use std::io::ErrorKind;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{MetadataExt, symlink};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// The end of a claim's name. A claim is a link, because a link is made in one step together with what it says: whose it is.
const EXTENSION: &str = "claim";

/// What this process may write to of the paths that the user has named.
#[derive(Debug, Default)]
pub struct Claims(Vec<Claim>);

/// How this process stands to a path; it keeps to that.
#[derive(Debug)]
struct Claim {
    named: PathBuf,
    /// The process that this was decided in; a child after fork is another one.
    process: u32,
    role: Role,
}

#[derive(Debug, PartialEq, Eq)]
enum Role {
    /// Files go to the path.
    Owner,
    /// Files go to the path; those that an earlier process of the launch has left there are moved.
    Successor(Earlier),
    /// Files go beside the path.
    Other,
}

/// A process that had the path before and has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Earlier {
    process: u32,
    /// When it got the path, and when it lost it.
    had: [SystemTime; 2],
}

impl Claims {
    /// Where this process writes `file`. `named` is the option's path that `file` follows from; files of one option go together.
    pub fn path(&mut self, config: &Config, named: &Path, file: PathBuf) -> PathBuf {
        let process = std::process::id();
        let found = self.0.iter().position(|claim| claim.named == named);
        let mut claim = match found.map(|at| self.0.swap_remove(at)) {
            Some(claim) if claim.process == process => claim,
            _ => Claim {
                named: named.to_owned(),
                process,
                role: Folder::of(config).map_or(Role::Owner, |folder| folder.role(named)),
            },
        };
        let path = match &mut claim.role {
            Role::Owner => file,
            Role::Other => with_process(&file, process),
            Role::Successor(earlier) => {
                if earlier.wrote(&file) {
                    // If that fails, the file is replaced.
                    let _ = std::fs::rename(&file, with_process(&file, earlier.process));
                }
                file
            }
        };
        self.0.push(claim);
        path
    }
}

impl Earlier {
    fn wrote(&self, file: &Path) -> bool {
        let [from, to] = self.had;
        let changed = std::fs::symlink_metadata(file).and_then(|about| about.modified());
        changed.is_ok_and(|changed| from <= changed && changed < to)
    }
}

/// `a/report.json` for process 7 is `a/report.7.json`.
fn with_process(file: &Path, process: u32) -> PathBuf {
    let extension = file.extension().unwrap_or_default();
    let mut ending = process.to_string();
    if !extension.is_empty() {
        ending = format!("{ending}.{}", extension.to_string_lossy());
    }
    file.with_extension(ending)
}

/// A folder with claims.
struct Folder {
    path: PathBuf,
    /// Its claims are of one launch only, so a file of a process that has ended is of this launch as well.
    of_launch: bool,
}

impl Folder {
    /// That of the launch. Without the launcher nobody knows what belongs together, and claims of all programs are in the user's own folder.
    fn of(config: &Config) -> Option<Folder> {
        if let Some(path) = config.launch.as_ref().filter(|path| path.is_dir()) {
            return Some(Folder {
                path: path.clone(),
                of_launch: true,
            });
        }
        let user = std::fs::metadata("/proc/self").ok()?.uid();
        let path = place::folder(std::env::var_os(place::RUNTIME).as_deref(), user);
        place::prepare(&path, user).ok()?;
        Some(Folder {
            path,
            of_launch: false,
        })
    }

    /// How this process stands to a path. Where no claim can be made or read, it writes to the path.
    fn role(&self, named: &Path) -> Role {
        let Some(own) = Process::of(std::process::id()) else {
            return Role::Owner;
        };
        if !self.of_launch {
            self.sweep();
        }
        let claim = self.claim(named);
        match symlink(own.to_string(), &claim) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            _ => return Role::Owner,
        }
        match Process::read(&claim) {
            // Another context of this process, or what the process was before exec.
            Some(owner) if owner == own => Role::Owner,
            Some(owner) if owner.runs() => Role::Other,
            owner => self.succeed(&claim, own, owner),
        }
    }

    /// Takes the claim of a process that has ended. Two processes that do so at the same moment may both write to the path.
    fn succeed(&self, claim: &Path, own: Process, owner: Option<Process>) -> Role {
        let made = |path: &Path| std::fs::symlink_metadata(path).and_then(|about| about.modified());
        let began = made(claim);
        let growing = claim.with_extension(own.id.to_string());
        let _ = std::fs::remove_file(&growing);
        let taken = symlink(own.to_string(), &growing)
            .and_then(|()| made(&growing))
            .and_then(|now| std::fs::rename(&growing, claim).map(|()| now));
        match (owner, began, taken) {
            (Some(owner), Ok(began), Ok(now)) if self.of_launch => Role::Successor(Earlier {
                process: owner.id,
                had: [began, now],
            }),
            _ => Role::Owner,
        }
    }

    fn claim(&self, named: &Path) -> PathBuf {
        let whole = std::path::absolute(named).unwrap_or_else(|_| named.to_owned());
        // The hash of a path differs between programs of 32 and of 64 bits.
        let bytes = whole.as_os_str().as_bytes().iter().copied();
        let name = format!("{:016x}.{EXTENSION}", fnv1a(bytes));
        self.path.join(name)
    }

    /// Removes claims of processes that have ended, for which nobody else does.
    fn sweep(&self) {
        let entries = std::fs::read_dir(&self.path).into_iter().flatten();
        for path in entries.flatten().map(|entry| entry.path()) {
            if path.extension() == Some(OsStr::new(EXTENSION))
                && !Process::read(&path).is_some_and(Process::runs)
            {
                let _ = std::fs::remove_file(path);
            }
        }
    }
}

/// A process, told from a later one with the same number by the time at which it began. It stays the same through exec.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Process {
    id: u32,
    /// In ticks of the clock since the machine was started.
    began: u64,
}

impl Process {
    /// None if it does not run.
    fn of(id: u32) -> Option<Process> {
        let about = std::fs::read_to_string(format!("/proc/{id}/stat")).ok()?;
        // The name of the program, in brackets, may have anything in it. After it come the state and, 19 fields later, the time.
        let (_, fields) = about.rsplit_once(')')?;
        let mut fields = fields.split_whitespace();
        let ended = matches!(fields.next()?, "Z" | "X");
        let began = fields.nth(18)?.parse().ok()?;
        (!ended).then_some(Process { id, began })
    }

    fn runs(self) -> bool {
        Process::of(self.id) == Some(self)
    }

    /// Whose claim this is.
    fn read(claim: &Path) -> Option<Process> {
        let owner = std::fs::read_link(claim).ok()?;
        let (id, began) = owner.to_str()?.split_once('.')?;
        Some(Process {
            id: id.parse().ok()?,
            began: began.parse().ok()?,
        })
    }
}

impl Display for Process {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.id, self.began)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::process::Command;

    fn folder(path: &Path, of_launch: bool) -> Folder {
        Folder {
            path: path.to_owned(),
            of_launch,
        }
    }

    /// A claim of the process with this number, as it is now.
    fn claimed(folder: &Folder, named: &Path, process: u32) {
        let owner = Process::of(process).expect("it runs");
        symlink(owner.to_string(), folder.claim(named)).expect("a claim");
    }

    /// A claim of a process that is no more.
    fn abandoned(folder: &Folder, named: &Path) {
        let claim = folder.claim(named);
        symlink(format!("{}.1", std::process::id()), claim).expect("a claim");
    }

    #[test]
    fn the_first_process_has_the_path_in_all_its_contexts() {
        let home = tempfile::tempdir().expect("a folder");
        let folder = folder(home.path(), true);
        let named = Path::new("/a/report.json");
        assert_eq!(folder.role(named), Role::Owner);
        assert_eq!(folder.role(named), Role::Owner);
    }

    #[test]
    fn a_process_that_runs_keeps_its_path() {
        for of_launch in [true, false] {
            let home = tempfile::tempdir().expect("a folder");
            let folder = folder(home.path(), of_launch);
            let mut other = Command::new("sleep").arg("60").spawn().expect("it starts");
            claimed(&folder, Path::new("/a/report.json"), other.id());
            assert_eq!(folder.role(Path::new("/a/report.json")), Role::Other);
            assert_eq!(folder.role(Path::new("/a/other.json")), Role::Owner);
            other.kill().expect("ended");
            // Its parent has not asked how it has ended: it is still in the list of processes.
            while Process::of(other.id()).is_some() {
                std::thread::yield_now();
            }
            let next = folder.role(Path::new("/a/report.json"));
            assert_eq!(matches!(next, Role::Successor(_)), of_launch, "{next:?}");
            assert_ne!(next, Role::Other);
            other.wait().expect("gone");
        }
    }

    #[test]
    fn files_of_an_ended_process_of_the_launch_are_moved_and_older_ones_are_not() {
        let home = tempfile::tempdir().expect("a folder");
        let folder = folder(home.path(), true);
        let [old, file] = ["old.json", "new.json"].map(|name| home.path().join(name));
        let tick = || std::thread::sleep(std::time::Duration::from_millis(20));
        std::fs::write(&old, "of yesterday").expect("written");
        tick();
        abandoned(&folder, &file);
        std::fs::write(&file, "of the process before").expect("written");
        tick();
        let role = folder.role(&file);
        let mut claims = Claims(vec![Claim {
            named: file.clone(),
            process: std::process::id(),
            role,
        }]);
        let config = Config::from_settings(&crate::config::Settings::default()).expect("right");
        for target in [&old, &file] {
            assert_eq!(&claims.path(&config, &file, target.clone()), target);
        }
        assert!(old.exists() && !file.exists());
        let moved = with_process(&file, std::process::id());
        let text = std::fs::read_to_string(&moved).expect("moved");
        assert_eq!(text, "of the process before");
        // A file of its own is not moved.
        std::fs::write(&file, "own").expect("written");
        claims.path(&config, &file, file.clone());
        assert!(file.exists());
    }

    #[test]
    fn claims_without_a_launch_do_not_pile_up() {
        let home = tempfile::tempdir().expect("a folder");
        let folder = folder(home.path(), false);
        abandoned(&folder, Path::new("/a/report.json"));
        std::fs::write(home.path().join("1.sock"), "").expect("written");
        assert_eq!(folder.role(Path::new("/b/report.json")), Role::Owner);
        let mut left: Vec<_> = std::fs::read_dir(home.path())
            .expect("a folder")
            .map(|entry| entry.expect("an entry").path())
            .collect();
        left.sort();
        let mut expected = [
            home.path().join("1.sock"),
            folder.claim(Path::new("/b/report.json")),
        ];
        expected.sort();
        assert_eq!(left, expected);
    }

    #[test]
    fn the_number_goes_before_the_extension() {
        for (file, expected) in [
            ("a.b/report.json", "a.b/report.7.json"),
            ("quilt_qs8x6a0.75.png", "quilt_qs8x6a0.75.7.png"),
            ("report", "report.7"),
        ] {
            assert_eq!(with_process(Path::new(file), 7), Path::new(expected));
        }
    }
}
