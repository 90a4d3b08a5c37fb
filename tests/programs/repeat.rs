//! Recording a program and repeating its trace.

use crate::support::{Screen, bare, layered};
use crate::table::Program;
use rustix::process::{Pid, Signal, kill_process_group};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A trace that is not repeated after this time hangs: the slowest programs of the table show 2 frames a second in 8 views.
const PATIENCE: Duration = Duration::from_secs(1200);

/// How a command ended.
pub(crate) struct Ended {
    /// Empty if all is well, else the status in words.
    pub(crate) wrong: Option<String>,
    /// Its stderr.
    pub(crate) said: String,
}

/// Runs a command in a process group of its own and ends the whole group after a time.
///
/// `endless`: the program is not expected to end by itself, and no failure if it has to be ended. `meanwhile` is called some
/// fifty times a second with the time since the start.
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
        // Asked first: apitrace writes the rest of its trace then.
        let _ = kill_process_group(group, Signal::INT);
        let asked = Instant::now();
        while asked.elapsed() < Duration::from_secs(3) && matches!(child.try_wait(), Ok(None)) {
            std::thread::sleep(Duration::from_millis(20));
        }
    }
    // What it started may still be there, also if it is not.
    let _ = kill_process_group(group, Signal::KILL);
    let _ = child.wait();
    let bytes = fs::read(log).unwrap_or_default();
    Ended {
        wrong,
        said: String::from_utf8_lossy(&bytes).into_owned(),
    }
}

/// A program, ready to start, with the variables of the table.
fn prepared<'a>(command: &'a mut Command, program: &Program, screen: &Screen) -> &'a mut Command {
    screen
        .give(command)
        // Games find no sound card and need none.
        .env("SDL_AUDIODRIVER", "dummy")
        .env("ALSOFT_DRIVERS", "null")
        .envs(&program.env)
}

/// Gives the program its input when its time has come. There is no window manager: the window under the pointer has the keys.
fn play<'a>(program: &'a Program, screen: &'a Screen) -> impl FnMut(Duration) + 'a {
    let mut inputs = program.input.iter().peekable();
    move |time| {
        if let Some(input) = inputs.next_if(|input| time.as_secs_f64() >= input.after) {
            let mut command = bare("xdotool");
            screen.give(&mut command).args(input.xdotool.split(' '));
            // Without the tool the program stays in its menu, which the pictures show.
            let _ = command.stderr(Stdio::null()).status();
        }
    }
}

/// Records the first frames of a program, unless that was done before.
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

/// The first frames of a trace.
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

/// How many frames a trace has.
pub(crate) fn frames(trace: &Path) -> Option<u64> {
    let output = bare("apitrace").arg("info").arg(trace).output().ok()?;
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).ok()?;
    json["FramesCount"].as_u64()
}

/// How a trace is repeated.
#[derive(Default)]
pub(crate) struct Repeat<'a> {
    /// The layer's variables; none: it is not preloaded.
    pub(crate) layer: Option<Vec<(&'a str, String)>>,
    /// Pictures of every so manieth frame, as the program would read them back; 0 for none.
    pub(crate) interval: u64,
}

/// What came of it.
pub(crate) struct Repeated {
    pub(crate) ended: Ended,
    /// By the name of their file.
    pub(crate) pictures: BTreeMap<String, PathBuf>,
}

/// Repeats a trace; what it leaves is in a folder of its own.
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
        // Ends with a separator: the prefix is a folder.
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

/// Messages about GL errors, and how often each is there.
pub(crate) fn errors(said: &str) -> BTreeMap<String, u64> {
    let mut found = BTreeMap::new();
    for line in said.lines().filter(|line| line.contains("glGetError")) {
        // Before the colon is the number of the call.
        let text = line.split_once(": ").map_or(line, |(_, text)| text);
        *found.entry(text.to_owned()).or_default() += 1;
    }
    found
}
