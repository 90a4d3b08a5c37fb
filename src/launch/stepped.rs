//! A scene that draws frames on request, bare or under the layer; several of them can take turns.
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

/// For one answer. A frame of 4 million triangles in 16 views by a CPU takes a minute.
const ANSWER_LIMIT: Duration = Duration::from_secs(600);
const POLL: Duration = Duration::from_millis(100);
const END_LIMIT: Duration = Duration::from_secs(2);

/// How glibc's allocator is set for the bare program and under the layer alike, in bytes: what is freed at the end of a frame stays for the
/// next one. Measured on llvmpipe 22.3 with 800,000 triangles: the driver keeps a frame's triangles in blocks of 64 KiB and frees them once they are
/// drawn; whether glibc then gives the end of the heap back to the system, 25 ms of a frame, depends on what lies behind them.
const ALLOCATOR: [(&str, &str); 2] = [
    ("MALLOC_MMAP_THRESHOLD_", "33554432"),
    ("MALLOC_TRIM_THRESHOLD_", "134217728"),
];

/// The same settings for every scene, so that their times compare. What the user has set stays.
fn keep_freed_memory(command: &mut Command) {
    let own = ALLOCATOR.iter().map(|(name, _)| *name);
    let chosen = own
        .chain(["GLIBC_TUNABLES"])
        .any(|name| std::env::var_os(name).is_some());
    if !chosen {
        command.envs(ALLOCATOR);
    }
}

/// Whether the user wants us to stop.
#[derive(Debug)]
pub struct Stop(Signals);

impl Stop {
    /// Watches from here on.
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

/// A running scene. It ends when it is dropped, or when we end: its stdin is closed then.
#[derive(Debug)]
pub struct Stepped {
    child: Child,
    /// None once it is closed.
    requests: Option<ChildStdin>,
    answers: Receiver<String>,
    what: String,
    /// What draws.
    pub hello: Hello,
}

impl Stepped {
    /// Starts a scene without the layer; `what` is what messages call it.
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
        Self::start(launch.command(), screen, what, stop)
    }

    /// Starts a scene under the layer that keeps what `--strategy auto` finds in a folder of ours.
    pub fn trying(
        launch: &Launch,
        screen: &Screen,
        cache: &Path,
        what: &str,
        stop: &mut Stop,
    ) -> Result<Self, LaunchError> {
        let mut command = launch.command();
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
            // Bare is without the layer, and under the layer is not bare.
            .env_remove(DISABLE)
            // Frames are timed, not shown: nothing waits for the monitor (Mesa's name for it, and NVIDIA's).
            .env("vblank_mode", "0")
            .env("__GL_SYNC_TO_VBLANK", "0")
            // Mesa tells every program that the first of them is set.
            .env("MESA_DEBUG", "silent")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            // Ctrl-C is for us; we end the scene.
            .process_group(0);
        let mut child = command.spawn().map_err(|source| LaunchError::System {
            doing: "starting a scene",
            source,
        })?;
        let (sender, answers) = mpsc::channel();
        if let Some(stdout) = child.stdout.take() {
            std::thread::spawn(move || {
                let mut lines = BufReader::new(stdout).lines().map_while(Result::ok);
                // Nobody listens once the scene is dropped.
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

    /// Draws frames and answers their times.
    pub fn step(&mut self, frames: u32, stop: &mut Stop) -> Result<Times, LaunchError> {
        // A scene that has ended is found out by its silence.
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

    /// The end of its stdin is the end of a scene; one that is deaf is killed.
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
