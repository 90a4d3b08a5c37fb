//! Runs a scene to its end and returns its stdout.
#![forbid(unsafe_code)]

use super::error::LaunchError;
use super::program::{Ended, Launch, without_layer};
use super::screen::Screen;
use super::stepped::Stop;
use crate::config::DISABLE;
use std::ffi::OsString;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const LIMIT: Duration = Duration::from_secs(60);
const POLL: Duration = Duration::from_millis(2);

/// Runs a scene without the layer; `what` is its name in messages.
///
/// # Errors
/// If it does not start, does not end, or ends with another status than 0.
pub fn bare(
    program: &Path,
    arguments: &[OsString],
    screen: &Screen,
    what: &str,
    stop: &mut Stop,
) -> Result<String, LaunchError> {
    let command = without_layer(program, arguments);
    run(command, screen, what, stop)
}

/// Runs a scene under the layer.
///
/// # Errors
/// As [`bare`].
pub fn layered(
    launch: &Launch,
    screen: &Screen,
    what: &str,
    stop: &mut Stop,
) -> Result<String, LaunchError> {
    run(launch.command()?, screen, what, stop)
}

fn run(
    mut command: Command,
    screen: &Screen,
    what: &str,
    stop: &mut Stop,
) -> Result<String, LaunchError> {
    screen.give(&mut command);
    command
        .env_remove(DISABLE)
        .env("MESA_DEBUG", "silent")
        .stdin(Stdio::null())
        .stdout(Stdio::piped());
    let system = |doing| move |source| LaunchError::System { doing, source };
    let mut child = command.spawn().map_err(system("starting a scene"))?;
    // A thread of its own reads, because a scene may print more than a pipe holds.
    let said = child.stdout.take().map(|mut stdout| {
        std::thread::spawn(move || {
            let mut text = String::new();
            stdout.read_to_string(&mut text).map(|_| text)
        })
    });
    let limit = Instant::now() + LIMIT;
    let ended = loop {
        match child.try_wait().map_err(system("waiting for a scene"))? {
            Some(status) => break Ok(status),
            None if Instant::now() > limit => break Err(None),
            None => match stop.check() {
                Ok(()) => std::thread::sleep(POLL),
                Err(error) => break Err(Some(error)),
            },
        }
    };
    if ended.is_err() {
        let _ = child.kill();
        let _ = child.wait();
    }
    let what = what.to_owned();
    let status = ended.map_err(|error| {
        error.unwrap_or_else(|| {
            let seconds = LIMIT.as_secs();
            LaunchError::SceneSilent {
                what: what.clone(),
                frames: 1,
                seconds,
            }
        })
    })?;
    if !status.success() {
        let how = Ended(status).describe();
        return Err(LaunchError::SceneEnded { what, how });
    }
    let said = said.and_then(|thread| thread.join().ok());
    said.unwrap_or_else(|| Ok(String::new()))
        .map_err(system("reading what a scene said"))
}
