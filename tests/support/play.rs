//! Real programs that are run for a time, and their input.

use crate::support::{Screen, bare};
use rustix::process::{Pid, Signal, kill_process_group};
use serde::Deserialize;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The end of a command.
pub(crate) struct Ended {
    /// The status in words; `None` after success.
    pub(crate) wrong: Option<String>,
    /// Its stderr.
    pub(crate) said: String,
}

/// Runs a command in a process group of its own and ends the whole group after a time.
///
/// `endless`: the program is not expected to end by itself, so ending it is no failure. `meanwhile` is called some fifty times a second
/// with the time since the start, and says whether the program is to run on.
pub(crate) fn run(
    command: &mut Command,
    limit: Duration,
    log: &Path,
    endless: bool,
    mut meanwhile: impl FnMut(Duration) -> bool,
) -> Ended {
    let failed = |wrong: String| Ended {
        wrong: Some(wrong),
        said: String::new(),
    };
    let file = File::create(log).expect("a log");
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(file)
        .process_group(0);
    let mut child = match command.spawn() {
        Ok(child) => child,
        Err(error) => return failed(format!("does not start: {error}")),
    };
    let group = Pid::from_child(&child);
    let start = Instant::now();
    let mut status = None;
    let mut wanted = true;
    while status.is_none() && wanted && start.elapsed() < limit {
        std::thread::sleep(Duration::from_millis(20));
        wanted = meanwhile(start.elapsed());
        status = child.try_wait().expect("a child");
    }
    let wrong = match status {
        Some(status) => match status.signal() {
            Some(signal) => Some(format!("signal {signal}")),
            None if status.success() => None,
            None => Some(format!("status {}", status.code().unwrap_or_default())),
        },
        None if endless => None,
        None => Some(format!("not done after {} s", limit.as_secs())),
    };
    if status.is_none() {
        // Ask politely first: apitrace then writes the rest of its trace.
        let _ = kill_process_group(group, Signal::INT);
        let asked = Instant::now();
        while asked.elapsed() < Duration::from_secs(3) && matches!(child.try_wait(), Ok(None)) {
            std::thread::sleep(Duration::from_millis(20));
        }
    }
    // Its children may still run, even where it does not.
    let _ = kill_process_group(group, Signal::KILL);
    let _ = child.wait();
    let bytes = fs::read(log).unwrap_or_default();
    Ended {
        wrong,
        said: String::from_utf8_lossy(&bytes).into_owned(),
    }
}

/// Games find no sound card and need none.
pub(crate) fn mute(command: &mut Command) -> &mut Command {
    command
        .env("SDL_AUDIODRIVER", "dummy")
        .env("ALSOFT_DRIVERS", "null")
}

/// An input while the program runs.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Input {
    /// Seconds since the start; in the order of the list.
    pub(crate) after: f64,
    /// Arguments of xdotool.
    pub(crate) xdotool: String,
}

/// Sends the program its input at the given times. There is no window manager: the window under the pointer has the keys.
pub(crate) fn play<'a>(inputs: &'a [Input], screen: &'a Screen) -> impl FnMut(Duration) + 'a {
    let mut inputs = inputs.iter().peekable();
    move |time| {
        if let Some(input) = inputs.next_if(|input| time.as_secs_f64() >= input.after) {
            let mut command = bare("xdotool");
            screen.give(&mut command).args(input.xdotool.split(' '));
            // Without the tool the program stays in its menu, as the pictures show.
            let _ = command.stderr(Stdio::null()).status();
        }
    }
}

/// What a variable names, with commas between: all where it is unset or empty, none for `-`.
pub(crate) fn chosen<'a, T>(variable: &str, all: &'a [T], name: impl Fn(&T) -> &str) -> Vec<&'a T> {
    let wanted = std::env::var(variable).unwrap_or_default();
    let wanted: BTreeSet<_> = wanted.split(',').filter(|name| !name.is_empty()).collect();
    let chosen = |one: &&T| wanted.is_empty() || wanted.contains(name(one));
    let chosen: Vec<_> = all.iter().filter(chosen).collect();
    assert!(
        !chosen.is_empty() || wanted.contains("-"),
        "{variable} names none of them"
    );
    chosen
}

/// Installs Debian packages, with spaces between, and what sends the input. One that cannot be had is a failure of its program.
pub(crate) fn install<'a>(packages: impl Iterator<Item = &'a str>) {
    let packages: BTreeSet<_> = packages
        .flat_map(|packages| packages.split(' '))
        .chain(["xdotool"])
        .collect();
    let status = Command::new("sh")
        .args(["scripts/packages.sh", "--optional"])
        .args(packages)
        .status();
    status.expect("sh");
}
