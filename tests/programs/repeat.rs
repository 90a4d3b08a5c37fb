//! Records programs and repeats their traces.

use crate::support::{Screen, bare, layered};
use crate::table::Program;
use rustix::process::{Pid, Signal, kill_process_group};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A trace that takes longer hangs: the slowest programs of the table show 2 frames a second in 8 views.
const PATIENCE: Duration = Duration::from_secs(1200);

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
/// with the time since the start.
fn run(
    command: &mut Command,
    limit: Duration,
    log: &Path,
    endless: bool,
    mut meanwhile: impl FnMut(Duration),
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
    while status.is_none() && start.elapsed() < limit {
        std::thread::sleep(Duration::from_millis(20));
        meanwhile(start.elapsed());
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

/// A program, ready to start, with the variables of its entry in the table.
fn prepared<'a>(command: &'a mut Command, program: &Program, screen: &Screen) -> &'a mut Command {
    screen
        .give(command)
        // Games find no sound card and need none.
        .env("SDL_AUDIODRIVER", "dummy")
        .env("ALSOFT_DRIVERS", "null")
        .envs(&program.env)
}

/// Sends the program its input at the given times. There is no window manager: the window under the pointer has the keys.
fn play<'a>(program: &'a Program, screen: &'a Screen) -> impl FnMut(Duration) + 'a {
    let mut inputs = program.input.iter().peekable();
    move |time| {
        if let Some(input) = inputs.next_if(|input| time.as_secs_f64() >= input.after) {
            let mut command = bare("xdotool");
            screen.give(&mut command).args(input.xdotool.split(' '));
            // Without the tool the program stays in its menu, as the pictures show.
            let _ = command.stderr(Stdio::null()).status();
        }
    }
}

/// Records the first frames of a program, unless a trace is already there.
pub(crate) fn record(program: &Program, screen: &Screen, folder: &Path) -> Result<PathBuf, String> {
    let trace = folder.join("program.trace");
    if trace.is_file() {
        return Ok(trace);
    }
    let full = folder.join("full.trace");
    let mut command = bare("apitrace");
    command
        .args(["trace", "-a", program.api.traced(), "-o"])
        .arg(&full)
        .args(&program.command);
    let limit = Duration::from_secs(program.seconds);
    let ended = run(
        prepared(&mut command, program, screen),
        limit,
        &folder.join("record.log"),
        true,
        play(program, screen),
    );
    let result = trim(&full, &trace, program.frames);
    let _ = fs::remove_file(&full);
    result.map_err(|error| ended.wrong.unwrap_or(error))?;
    Ok(trace)
}

/// Cuts a trace to its first frames.
pub(crate) fn trim(from: &Path, to: &Path, frames: u64) -> Result<(), String> {
    let mut command = bare("apitrace");
    command
        .args(["trim", &format!("--frames=0-{}", frames - 1), "-o"])
        .arg(to)
        .arg(from);
    let output = command.output().map_err(|error| error.to_string())?;
    match output.status.success() && to.is_file() {
        true => Ok(()),
        false => Err("no trace".into()),
    }
}

/// The number of frames in a trace.
pub(crate) fn frames(trace: &Path) -> Option<u64> {
    let output = bare("apitrace").arg("info").arg(trace).output().ok()?;
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).ok()?;
    json["FramesCount"].as_u64()
}

/// How a trace is repeated.
#[derive(Default)]
pub(crate) struct Repeat<'a> {
    /// The layer's variables; `None`: it is not preloaded.
    pub(crate) layer: Option<Vec<(&'a str, String)>>,
    /// Every how many frames a picture is taken, as the program would read it back; 0 for none.
    pub(crate) interval: u64,
}

/// The outcome of a repetition.
pub(crate) struct Repeated {
    pub(crate) ended: Ended,
    /// By file name.
    pub(crate) pictures: BTreeMap<String, PathBuf>,
}

/// Repeats a trace; its files are in a folder of its own.
pub(crate) fn repeat(
    program: &Program,
    trace: &Path,
    how: &Repeat<'_>,
    screen: &Screen,
    folder: &Path,
) -> Repeated {
    let _ = fs::remove_dir_all(folder);
    fs::create_dir_all(folder).expect("a folder");
    let retrace = program.api.retrace();
    let mut command = match &how.layer {
        None => bare(retrace),
        Some(variables) => {
            let variables: Vec<_> = variables
                .iter()
                .map(|(name, value)| (*name, value.as_str()))
                .collect();
            layered(retrace, &variables)
        }
    };
    let shots = folder.join("shots");
    fs::create_dir(&shots).expect("a folder");
    if how.interval > 0 {
        // A path that ends with a separator: the prefix is a folder.
        command.args([
            "-S".to_owned(),
            "*/frame".to_owned(),
            format!("--snapshot-interval={}", how.interval),
            "-s".to_owned(),
            format!("{}/", shots.display()),
        ]);
    }
    let ended = run(
        screen.give(command.arg(trace)),
        PATIENCE,
        &folder.join("log"),
        false,
        |_| {},
    );
    let entries = fs::read_dir(&shots).expect("a folder").flatten();
    let pictures = entries
        .map(|entry| {
            (
                entry.file_name().to_string_lossy().into_owned(),
                entry.path(),
            )
        })
        .collect();
    Repeated { ended, pictures }
}

/// Runs the program itself under the layer for some seconds.
pub(crate) fn live(
    program: &Program,
    variables: &[(&str, &str)],
    seconds: u64,
    screen: &Screen,
    folder: &Path,
) -> Ended {
    let mut command = layered(&program.command[0], variables);
    command.args(&program.command[1..]);
    run(
        prepared(&mut command, program, screen),
        Duration::from_secs(seconds),
        &folder.join("live.log"),
        true,
        play(program, screen),
    )
}

/// Messages about GL errors, and how often each occurs.
pub(crate) fn errors(said: &str) -> BTreeMap<String, u64> {
    let mut found = BTreeMap::new();
    for line in said.lines().filter(|line| line.contains("glGetError")) {
        // The number of the call stands before the colon.
        let text = line.split_once(": ").map_or(line, |(_, text)| text);
        *found.entry(text.to_owned()).or_default() += 1;
    }
    found
}
