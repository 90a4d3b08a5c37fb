//! An X server of our own for programs that want a window where there is no screen; it ends with us.
#![forbid(unsafe_code)]

use super::error::LaunchError;
use rustix::process::{Pid, Signal, kill_process};
use std::io::{BufRead, BufReader};
use std::os::unix::process::CommandExt;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::mpsc;
use std::time::{Duration, Instant};

const SCREEN: &str = "1920x1200x24";
const START_LIMIT: Duration = Duration::from_secs(30);
const END_LIMIT: Duration = Duration::from_secs(2);

/// A running Xvfb. Dropping it ends exactly this one.
#[derive(Debug)]
pub struct Xvfb {
    child: Child,
    display: String,
    /// Kept open: the server writes its display number here.
    _number: BufReader<ChildStdout>,
}

impl Xvfb {
    /// Starts a server on the first free display and waits until it accepts programs.
    pub fn start() -> Result<Self, LaunchError> {
        let mut child = Command::new("Xvfb")
            // The server picks the number itself and writes it to descriptor 1, our pipe: no guessing, no race.
            .args([
                "-displayfd",
                "1",
                "-screen",
                "0",
                SCREEN,
                "-nolisten",
                "tcp",
                "-noreset",
            ])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            // Ctrl-C is for us; we end the server after the program.
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

/// Reads the first line of the server; a server that hangs before it is given up after [`START_LIMIT`].
fn wait_for_number(child: &mut Child) -> Option<(u32, BufReader<ChildStdout>)> {
    let mut pipe = BufReader::new(child.stdout.take()?);
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        let mut line = String::new();
        let read = pipe.read_line(&mut line);
        // Nobody listens any more after the limit; then the pipe may as well close.
        let _ = sender.send(read.map(|_| (line, pipe)));
    });
    let (line, pipe) = receiver.recv_timeout(START_LIMIT).ok()?.ok()?;
    Some((line.trim().parse().ok()?, pipe))
}

/// Asks first, so that the server removes its lock and socket.
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
