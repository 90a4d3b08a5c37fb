//! An X server of our own, for programs that need a window where there is no screen.
#![forbid(unsafe_code)]

use super::error::LaunchError;
use rustix::process::{Pid, Signal, kill_process};
use std::io::{BufRead, BufReader};
use std::os::unix::process::CommandExt;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::mpsc;
use std::time::{Duration, Instant};

/// Pixels of the screen, unless others are asked for.
const SCREEN: (u16, u16) = (1920, 1200);
const START_LIMIT: Duration = Duration::from_secs(30);
const END_LIMIT: Duration = Duration::from_secs(2);

/// A running Xvfb. Dropping it ends exactly this process.
#[derive(Debug)]
pub struct Xvfb {
    child: Child,
    display: String,
    /// The pipe to which the server writes its display number. It stays open.
    _number: BufReader<ChildStdout>,
}

impl Xvfb {
    /// Starts a server on the first free display and waits until it accepts programs.
    pub fn start() -> Result<Self, LaunchError> {
        Self::sized(SCREEN)
    }

    /// The same with a screen of this width and height, pixels.
    pub fn sized((width, height): (u16, u16)) -> Result<Self, LaunchError> {
        let mut child = Command::new("Xvfb")
            // The server itself chooses a free number and writes it to descriptor 1, which is our pipe. So there is no race for a number.
            .args([
                "-displayfd",
                "1",
                "-screen",
                "0",
                &format!("{width}x{height}x24"),
                "-nolisten",
                "tcp",
                "-noreset",
            ])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            // Ctrl-C reaches only the launcher, which ends the server after the program.
            .process_group(0)
            .spawn()
            .map_err(|error| LaunchError::NoDisplay {
                reason: format!("does not start ({error})"),
            })?;
        match wait_for_number(&mut child) {
            Some((number, pipe)) => Ok(Self {
                child,
                display: format!(":{number}"),
                _number: pipe,
            }),
            None => {
                end(&mut child);
                let reason = "gave no display number (`Xvfb -displayfd 1` says why)".to_owned();
                Err(LaunchError::NoDisplay { reason })
            }
        }
    }

    /// The value for `DISPLAY`.
    #[must_use]
    pub fn display(&self) -> &str {
        &self.display
    }
}

impl Drop for Xvfb {
    fn drop(&mut self) {
        end(&mut self.child);
    }
}

/// Reads the display number that the server prints. None if it prints none within [`START_LIMIT`].
fn wait_for_number(child: &mut Child) -> Option<(u32, BufReader<ChildStdout>)> {
    let mut pipe = BufReader::new(child.stdout.take()?);
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        let mut line = String::new();
        let read = pipe.read_line(&mut line);
        // After the limit the receiver is gone, and the pipe may close.
        let _ = sender.send(read.map(|_| (line, pipe)));
    });
    let (line, pipe) = receiver.recv_timeout(START_LIMIT).ok()?.ok()?;
    Some((line.trim().parse().ok()?, pipe))
}

/// Ends the server, with SIGTERM first so that it removes its lock and socket.
fn end(child: &mut Child) {
    let limit = Instant::now() + END_LIMIT;
    if let Ok(None) = child.try_wait() {
        let _ = kill_process(Pid::from_child(child), Signal::TERM);
    }
    while Instant::now() < limit {
        if !matches!(child.try_wait(), Ok(None)) {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    let _ = child.kill();
    let _ = child.wait();
}
