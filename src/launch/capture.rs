//! Runs a program until the requested pictures are on disk.
#![forbid(unsafe_code)]

use super::error::LaunchError;
use super::program::{Ended, Launch};
use super::screen::Screen;
use super::signals;
use crate::config::{Capture, Status};
use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process_group, waitid};
use std::collections::HashMap;
use std::io::IsTerminal;
use std::os::unix::fs::MetadataExt;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const POLL: Duration = Duration::from_millis(20);
const END_LIMIT: Duration = Duration::from_secs(2);

/// One capture.
#[derive(Debug)]
pub struct CaptureJob<'a> {
    /// The checked program, with the capture among its options.
    pub launch: &'a Launch,
    /// The pictures.
    pub capture: &'a Capture,
    /// The file in which the layer reports its status.
    pub status: &'a Path,
    /// Time limit for all pictures.
    pub timeout: Duration,
}

/// The result of a capture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Captured {
    /// The pictures, in the order of frames.
    pub files: Vec<PathBuf>,
    /// Notes of the layer for the user.
    pub notes: Vec<String>,
}

/// Identifies a version of a file: device, inode, seconds and nanoseconds of its last change.
type Stamp = (u64, u64, i64, i64);

impl CaptureJob<'_> {
    /// Starts the program, waits for the pictures and ends the program. `progress` gets the number of pictures so far, and the number of
    /// frames if it is known.
    pub fn run(&self, mut progress: impl FnMut(u64, Option<u64>)) -> Result<Captured, LaunchError> {
        let mut signals = signals::catch()?;
        let screen = Screen::find()?;
        let before = stamps(self.capture);
        let mut program = self.start(&screen)?;
        let limit = Instant::now() + self.timeout;
        let mut next = self.capture.first;
        let mut files = Vec::new();
        loop {
            // Checked before the files are listed, so that a picture which the program wrote just before its end counts.
            let ended = program.ended();
            while next <= self.capture.last
                && let Some(file) = self.new_file(next, &before)
            {
                files.push(file);
                next += 1;
            }
            let status = Status::read(self.status);
            progress(
                next - self.capture.first,
                status.as_ref().map(|status| status.frames),
            );
            if next > self.capture.last {
                drop(program);
                return Ok(Captured {
                    files,
                    notes: self.notes(),
                });
            }
            if let Some(ended) = ended {
                return Err(LaunchError::EndedEarly {
                    how: ended.describe(),
                    seen: self.seen(next),
                    wanted: next,
                });
            }
            if let Some(signal) = signals.pending().next() {
                return Err(LaunchError::Interrupted(signal));
            }
            if Instant::now() > limit {
                let seconds = self.timeout.as_secs();
                return Err(LaunchError::TimedOut {
                    wanted: next,
                    seconds,
                    seen: self.seen(next),
                });
            }
            std::thread::sleep(POLL);
        }
    }

    /// Notes of the layer for the user, also after a failure.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        Status::read(self.status)
            .map(|status| status.notes)
            .unwrap_or_default()
    }

    fn start(&self, screen: &Screen) -> Result<Program, LaunchError> {
        let mut command = self.launch.command()?;
        screen.give(&mut command);
        Program::start(self.launch, command)
    }

    /// The picture of a frame, once it exists. The folder is searched for quilts, because the layer adds columns and rows to their names.
    fn new_file(&self, frame: u64, before: &HashMap<PathBuf, Stamp>) -> Option<PathBuf> {
        let is_new = |path: &PathBuf| stamp(path).is_some_and(|now| before.get(path) != Some(&now));
        let plain = self.capture.path_for(frame);
        if is_new(&plain) {
            return Some(plain);
        }
        if !self.capture.names_quilts() {
            return None;
        }
        entries(self.capture).find(|path| {
            let name = path.file_name().unwrap_or_default();
            self.capture.is_for(frame, &name.to_string_lossy()) && is_new(path)
        })
    }

    /// How many frames the program has shown, in words. "At least", because the layer reports only ten times a second.
    fn seen(&self, next: u64) -> String {
        let pictures = next - self.capture.first;
        match Status::read(self.status) {
            Some(Status { frames: 1, .. }) => "at least 1 frame".to_owned(),
            Some(status) => format!("at least {} frames", status.frames),
            None if pictures > 0 => format!("frame {}", next - 1),
            None => "an unknown number of frames".to_owned(),
        }
    }
}

/// The program and all others in its process group. They are ended when it is dropped.
pub(super) struct Program {
    child: Child,
    ended: Option<Ended>,
}

impl Program {
    pub(super) fn start(launch: &Launch, mut command: Command) -> Result<Self, LaunchError> {
        // The program leads a group of its own, so that the programs that it starts end with it. Such a group is in the background, where a
        // read from the terminal would stop it.
        command.process_group(0);
        if std::io::stdin().is_terminal() {
            command.stdin(Stdio::null());
        }
        launch
            .spawn(command)
            .map(|child| Self { child, ended: None })
    }

    pub(super) fn ended(&mut self) -> Option<Ended> {
        if self.ended.is_none() {
            self.ended = self.child.try_wait().ok().flatten().map(Ended);
        }
        self.ended
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let group = Pid::from_child(&self.child);
        if self.ended.is_some() {
            return;
        }
        // With NOWAIT an ended program stays a zombie, so its number, which is also the group's, is not given to another process.
        let peek = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
        let limit = Instant::now() + END_LIMIT;
        let _ = kill_process_group(group, Signal::TERM);
        while Instant::now() < limit && matches!(waitid(WaitId::Pid(group), peek), Ok(None)) {
            std::thread::sleep(Duration::from_millis(10));
        }
        let _ = kill_process_group(group, Signal::KILL);
        let _ = self.child.wait();
    }
}

/// The versions of the files that are already in the folder of the pictures.
fn stamps(capture: &Capture) -> HashMap<PathBuf, Stamp> {
    entries(capture)
        .filter_map(|path| stamp(&path).map(|stamp| (path, stamp)))
        .collect()
}

/// The files in the folder of the pictures.
fn entries(capture: &Capture) -> impl Iterator<Item = PathBuf> {
    let first = capture.path_for(capture.first);
    let folder = first.parent().unwrap_or(Path::new("")).to_owned();
    let listed = if folder == Path::new("") {
        Path::new(".")
    } else {
        &folder
    };
    let entries = std::fs::read_dir(listed).into_iter().flatten().flatten();
    entries.map(move |entry| folder.join(entry.file_name()))
}

fn stamp(path: &Path) -> Option<Stamp> {
    let about = std::fs::metadata(path).ok()?;
    Some((about.dev(), about.ino(), about.mtime(), about.mtime_nsec()))
}
