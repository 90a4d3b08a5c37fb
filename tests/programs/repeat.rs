//! Records programs and repeats their traces.

use crate::programs::table::Program;
use crate::support::play::{Ended, mute, play, run};
use crate::support::{Screen, bare, layered, target_folder};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// A trace that takes longer hangs: the slowest programs of the table show 2 frames a second in 8 views.
const PATIENCE: Duration = Duration::from_secs(1200);

/// A program, ready to start, with the variables of its entry in the table.
fn prepared<'a>(command: &'a mut Command, program: &Program, screen: &Screen) -> &'a mut Command {
    mute(screen.give(command)).envs(&program.env)
}

/// Gives the program its input while it runs.
fn inputs<'a>(program: &'a Program, screen: &'a Screen) -> impl FnMut(Duration) -> bool + 'a {
    let mut play = play(&program.input, screen);
    move |time| {
        play(time);
        true
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
        inputs(program, screen),
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
        |_| true,
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
    // Where both libraries are built, the program gets that of its class.
    let links = target_folder().join("by-class");
    if links.join("32/libmanyview.so").is_file() {
        command.env("LD_PRELOAD", links.join("$LIB/libmanyview.so"));
    }
    run(
        prepared(&mut command, program, screen),
        Duration::from_secs(seconds),
        &folder.join("live.log"),
        true,
        inputs(program, screen),
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
