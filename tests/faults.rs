//! A driver that is out of memory: each object and store that the layer makes fails once, and then all of them from some on. The program goes
//! on with its own picture, and nothing is said twice.
//!
//! tests/faults/fails.c is the driver. The program makes no objects but display lists, which it gets, so all that fails is the layer's.

use crate::support::{Compiled, Screen, bare, built, demo, layered, own_screen, preloaded, rgb};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::Command;

/// More objects than any strategy makes.
const MOST: u32 = 400;

/// The number of the signal of a broken pipe.
const SIGPIPE: i32 = 13;
/// The strategies beside replay.
const OTHERS: [&str; 5] = [
    "instanced",
    "geometry",
    "depth-image",
    "occlusion",
    "hybrid",
];

/// The frame that a demo draws, and its stderr.
#[track_caller]
fn drawn(
    mut command: Command,
    screen: &Screen,
    folder: &Path,
    why: &str,
) -> (image::RgbImage, String) {
    let picture = folder.join("picture.png");
    command
        .args(["-k", "2", "20"])
        .arg(demo("gears"))
        .args(["--frames", "3", "--size", "160x120", "--check", "--dump"])
        .arg(&picture);
    let output = screen.give(&mut command).output().expect("it starts");
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.success(),
        "{why}: {}\n{stderr}",
        output.status
    );
    (rgb(&picture), stderr)
}

/// Checks that the layer says nothing twice, and of no fault of its own.
#[track_caller]
fn said_once(stderr: &str, why: &str) {
    let lines = stderr.lines();
    let mut said: Vec<&str> = lines.filter(|l| l.starts_with("manyview: ")).collect();
    assert!(!stderr.contains("internal fault"), "{why}: {stderr}");
    let lines = said.len();
    said.sort_unstable();
    said.dedup();
    assert_eq!(said.len(), lines, "{why}: said twice: {stderr}");
}

/// What the program itself says.
fn without_ours(stderr: &str) -> String {
    let lines = stderr.lines().filter(|l| !l.starts_with("manyview: "));
    lines.collect::<Vec<_>>().join("\n")
}

struct Faults {
    screen: Screen,
    folder: tempfile::TempDir,
    behind: PathBuf,
    expected: image::RgbImage,
}

impl Faults {
    fn new() -> Self {
        let source = Path::new("tests/faults/fails.c");
        let behind = built("fails", &[source], Compiled::Library, &["-ldl"]);
        let (screen, folder) = (own_screen(), tempfile::tempdir().expect("a folder"));
        let (expected, _) = drawn(bare("timeout"), &screen, folder.path(), "bare");
        Faults {
            screen,
            folder,
            behind,
            expected,
        }
    }

    /// Runs the program with a fault. Returns the command that has failed; none where there were fewer calls.
    #[track_caller]
    fn with(&self, strategy: &str, variable: &str, number: u32) -> Option<String> {
        let out = self.folder.path().join("failed");
        let options = [("VIEWS", "5"), ("OUTPUT", "panel"), ("STRATEGY", strategy)];
        let mut command = layered("timeout", &options);
        let both = format!("{}:{}", preloaded(), self.behind.display());
        command
            .env("LD_PRELOAD", both)
            .env(variable, number.to_string())
            .env("FAIL_OUT", &out);
        let why = format!("{strategy}, {variable}={number}");
        let (picture, stderr) = drawn(command, &self.screen, self.folder.path(), &why);
        let failed = std::fs::read_to_string(&out).ok()?;
        std::fs::remove_file(&out).expect("removed");
        let over = manyview::metric::pixels_over(&self.expected, &picture, 0);
        // Smaller views are tried first, and are stretched over what the program reads.
        let smaller = stderr.contains("views of 80 x 60 are drawn");
        assert!(
            over == 0 || smaller,
            "{why} ({failed}): {over} pixels of the frame differ; {stderr}"
        );
        said_once(&stderr, &format!("{why} ({failed})"));
        Some(failed)
    }

    #[track_caller]
    fn each(&self, strategy: &str, variable: &str, step: u32) {
        let mut seen = std::collections::BTreeSet::new();
        let mut number = 1;
        while let Some(failed) = self.with(strategy, variable, number) {
            seen.insert(failed);
            number += step;
            assert!(number < MOST, "{strategy}: {number} objects");
        }
        assert!(seen.len() > 4, "{strategy}: only {seen:?} were made");
    }
}

#[test]
fn each_object_of_a_replay_fails_once() {
    Faults::new().each("replay", "FAIL_AT", 1);
}

#[test]
fn nothing_is_to_be_had_from_some_object_on() {
    Faults::new().each("replay", "FAIL_FROM", 3);
}

/// The driver loses the context at the end of the second frame of six.
#[test]
fn the_context_is_lost() {
    let faults = Faults::new();
    let run = |mut command: Command, preload: &str| {
        command
            .env("LD_PRELOAD", preload)
            .env("LOST_AT", "2")
            .args(["-k", "2", "20"])
            .arg(demo("gears"))
            .args(["--frames", "6", "--size", "160x120", "--check"]);
        let output = faults
            .screen
            .give(&mut command)
            .output()
            .expect("it starts");
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), stderr)
    };
    let behind = faults.behind.display();
    let (code, expected) = run(bare("timeout"), &behind.to_string());
    assert_eq!(code, Some(3), "the program sees it: {expected}");
    for strategy in ["replay"].into_iter().chain(OTHERS) {
        let options = [("VIEWS", "5"), ("OUTPUT", "panel"), ("STRATEGY", strategy)];
        let both = format!("{}:{behind}", preloaded());
        let (code, stderr) = run(layered("timeout", &options), &both);
        assert_eq!(
            (code, without_ours(&stderr)),
            (Some(3), expected.trim_end().to_owned()),
            "{strategy}"
        );
        said_once(&stderr, strategy);
    }
}

/// The X server ends while the program draws: Xlib ends the program.
#[test]
fn the_connection_to_the_x_server_is_lost() {
    let run = |mut command: Command| {
        let screen = own_screen();
        command
            .args(["-k", "2", "20"])
            .arg(demo("gears"))
            .args(["--frames", "1000000", "--size", "160x120"])
            .stderr(std::process::Stdio::piped());
        let mut child = screen.give(&mut command).spawn().expect("it starts");
        std::thread::sleep(std::time::Duration::from_secs(2));
        assert!(child.try_wait().expect("asked").is_none(), "it draws");
        drop(screen);
        let output = child.wait_with_output().expect("it ends");
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_ne!(output.status.code(), Some(124), "it hangs: {stderr}");
        (output.status, stderr)
    };
    // Xlib ends a program with status 1. Where Mesa's driver writes before Xlib reads, the signal of a broken pipe ends it: bare
    // programs end in either way, by chance.
    let as_bare = |status: std::process::ExitStatus| {
        status.code() == Some(1) || status.signal() == Some(SIGPIPE)
    };
    let (status, stderr) = run(bare("timeout"));
    assert!(as_bare(status), "bare: {status}: {stderr}");
    for output in ["panel", "view:1"] {
        let options = [("VIEWS", "5"), ("OUTPUT", output)];
        let (status, stderr) = run(layered("timeout", &options));
        assert!(as_bare(status), "{output}: {status}: {stderr}");
        assert!(
            !stderr.contains("runs without the layer"),
            "{output}: {stderr}"
        );
        said_once(&stderr, output);
    }
}

#[test]
#[ignore = "minutes: make test-long"]
fn each_object_of_other_strategies_fails_once() {
    let faults = Faults::new();
    for strategy in OTHERS {
        faults.each(strategy, "FAIL_AT", 1);
    }
}

#[test]
#[ignore = "minutes: make test-long"]
fn nothing_is_to_be_had_for_other_strategies() {
    let faults = Faults::new();
    for strategy in OTHERS {
        faults.each(strategy, "FAIL_FROM", 1);
    }
}
