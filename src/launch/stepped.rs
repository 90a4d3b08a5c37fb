//! Scenes that draw frames on request, bare or under the layer, so that several can take turns.
#![forbid(unsafe_code)]

use super::error::LaunchError;
use super::program::{Ended, Launch, without_layer};
use super::screen::Screen;
use super::signals;
use crate::bench::protocol::{Hello, Times};
use crate::config::DISABLE;
use signal_hook::iterator::Signals;
use std::ffi::OsString;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

/// Time limit for one answer. On a CPU, a frame of 4 million triangles in 16 views takes a minute.
const ANSWER_LIMIT: Duration = Duration::from_secs(600);
const POLL: Duration = Duration::from_millis(100);
const END_LIMIT: Duration = Duration::from_secs(2);

/// Settings of glibc's allocator, in bytes, for the bare program and under the layer alike: memory that is freed at the end of a frame stays for the
/// next one. Measured on llvmpipe 22.3 with 800,000 triangles: the driver keeps a frame's triangles in blocks of 64 KiB and frees them once they are
/// drawn. Whether glibc then returns the end of the heap to the system, which takes 25 ms of a frame, depends on other blocks behind them.
const ALLOCATOR: [(&str, &str); 2] = [
    ("MALLOC_MMAP_THRESHOLD_", "33554432"),
    ("MALLOC_TRIM_THRESHOLD_", "134217728"),
];

/// Gives every scene the same settings, so that their times can be compared. Settings of the user stay.
fn keep_freed_memory(command: &mut Command) {
    let own = ALLOCATOR.iter().map(|(name, _)| *name);
    let chosen = own
        .chain(["GLIBC_TUNABLES"])
        .any(|name| std::env::var_os(name).is_some());
    if !chosen {
        command.envs(ALLOCATOR);
    }
}

/// Tells whether the user has asked the launcher to stop.
#[derive(Debug)]
pub struct Stop(Signals);

impl Stop {
    /// Catches the signals from here on.
    pub fn watch() -> Result<Self, LaunchError> {
        signals::catch().map(Self)
    }

    pub(super) fn check(&mut self) -> Result<(), LaunchError> {
        match self.0.pending().next() {
            Some(signal) => Err(LaunchError::Interrupted(signal)),
            None => Ok(()),
        }
    }
}

/// A running scene. It ends when it is dropped, or when this process ends, because its stdin is then closed.
#[derive(Debug)]
pub struct Stepped {
    child: Child,
    /// None once it is closed.
    requests: Option<ChildStdin>,
    answers: Receiver<String>,
    what: String,
    /// The driver that draws, as the scene reported it.
    pub hello: Hello,
}

impl Stepped {
    /// Starts a scene without the layer; `what` is its name in messages.
    pub fn bare(
        program: &Path,
        arguments: &[OsString],
        screen: &Screen,
        what: &str,
        stop: &mut Stop,
    ) -> Result<Self, LaunchError> {
        let command = without_layer(program, arguments);
        Self::start(command, screen, what, stop)
    }

    /// Starts a scene under the layer.
    pub fn layered(
        launch: &Launch,
        screen: &Screen,
        what: &str,
        stop: &mut Stop,
    ) -> Result<Self, LaunchError> {
        Self::start(launch.command()?, screen, what, stop)
    }

    /// Starts a scene under the layer, with `cache` as the folder in which `--strategy auto` keeps its result.
    pub fn trying(
        launch: &Launch,
        screen: &Screen,
        cache: &Path,
        what: &str,
        stop: &mut Stop,
    ) -> Result<Self, LaunchError> {
        let mut command = launch.command()?;
        command.env("XDG_CACHE_HOME", cache);
        Self::start(command, screen, what, stop)
    }

    fn start(
        mut command: Command,
        screen: &Screen,
        what: &str,
        stop: &mut Stop,
    ) -> Result<Self, LaunchError> {
        screen.give(&mut command);
        keep_freed_memory(&mut command);
        command
            // The caller's variable must not turn the layer off in a scene that is measured under it.
            .env_remove(DISABLE)
            // Frames are timed, not shown, so no swap waits for the monitor (the variables of Mesa and of NVIDIA).
            .env("vblank_mode", "0")
            .env("__GL_SYNC_TO_VBLANK", "0")
            // Mesa prints a message in every program that has `vblank_mode` set.
            .env("MESA_DEBUG", "silent")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            // Ctrl-C reaches only the launcher, which ends the scene.
            .process_group(0);
        let mut child = command.spawn().map_err(|source| LaunchError::System {
            doing: "starting a scene",
            source,
        })?;
        let (sender, answers) = mpsc::channel();
        if let Some(stdout) = child.stdout.take() {
            std::thread::spawn(move || {
                let mut lines = BufReader::new(stdout).lines().map_while(Result::ok);
                // The receiver is gone once the scene is dropped.
                lines.try_for_each(|line| sender.send(line))
            });
        }
        let mut stepped = Self {
            requests: child.stdin.take(),
            child,
            answers,
            what: what.to_owned(),
            hello: Hello::default(),
        };
        loop {
            match stepped.line(1, stop)? {
                line if line == Hello::READY => return Ok(stepped),
                line => stepped.hello.hear(&line),
            }
        }
    }

    /// Draws frames and returns their times.
    pub fn step(&mut self, frames: u32, stop: &mut Stop) -> Result<Times, LaunchError> {
        // A scene that has ended is detected when its answer is read.
        if let Some(requests) = &mut self.requests {
            let _ = writeln!(requests, "{frames}").and_then(|()| requests.flush());
        }
        let line = self.line(frames, stop)?;
        let times = Times::read(&line, frames);
        times.ok_or_else(|| {
            let what = self.what.clone();
            LaunchError::SceneAnswer { what, line }
        })
    }

    fn line(&mut self, frames: u32, stop: &mut Stop) -> Result<String, LaunchError> {
        let limit = Instant::now() + ANSWER_LIMIT;
        loop {
            stop.check()?;
            match self.answers.recv_timeout(POLL) {
                Ok(line) => return Ok(line),
                Err(RecvTimeoutError::Timeout) if Instant::now() < limit => {}
                Err(RecvTimeoutError::Timeout) => {
                    let what = self.what.clone();
                    let seconds = ANSWER_LIMIT.as_secs();
                    return Err(LaunchError::SceneSilent {
                        what,
                        frames,
                        seconds,
                    });
                }
                Err(RecvTimeoutError::Disconnected) => {
                    self.end();
                    let how = self
                        .child
                        .wait()
                        .map_or_else(|error| error.to_string(), |status| Ended(status).describe());
                    let what = self.what.clone();
                    return Err(LaunchError::SceneEnded { what, how });
                }
            }
        }
    }

    /// Closes the scene's stdin, which ends it. A scene that does not react is killed.
    fn end(&mut self) {
        self.requests = None;
        let limit = Instant::now() + END_LIMIT;
        while Instant::now() < limit {
            if !matches!(self.child.try_wait(), Ok(None)) {
                return;
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        let _ = self.child.kill();
    }
}

impl Drop for Stepped {
    fn drop(&mut self) {
        self.end();
        let _ = self.child.wait();
    }
}
