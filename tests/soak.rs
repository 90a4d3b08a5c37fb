//! The long run: a game plays its demo again and again, in 8 views under the layer and beside it without the layer. Memory, descriptors and
//! the layer's GL names stay constant, except for the game's own growth.
//!
//! `make soak` plays for `SOAK_MINUTES` (240 unless given). Results are in target/soak, or in `SOAK_FOLDER`: the samples as CSV, a chart,
//! and one line in result.txt. `SOAK_LIBRARY` is the library to test instead of the one just built, so that the next build does not disturb
//! a run of hours. `SOAK_PROGRAM` chooses one of [`PROGRAMS`].

mod chart;
mod judge;

use crate::support;
use crate::support::{Screen, bare, layered, own_screen, scratch};
use judge::{NAMES, Sample};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A game that plays by itself.
struct Program {
    name: &'static str,
    package: &'static str,
    command: &'static [&'static str],
    strategy: &'static str,
}

const PROGRAMS: [Program; 1] = [
    // The demo starts again every 400 frames, which deletes and loads all textures. 10 frames a second leave time on the machine to
    // others.
    Program {
        name: "openarena",
        package: "openarena",
        command: &[
            "/usr/games/openarena",
            "+set",
            "r_fullscreen",
            "0",
            "+set",
            "r_mode",
            "-1",
            "+set",
            "r_customwidth",
            "160",
            "+set",
            "r_customheight",
            "120",
            "+set",
            "s_initsound",
            "0",
            "+set",
            "com_hunkmegs",
            "256",
            "+set",
            "cl_renderer",
            "opengl1",
            "+set",
            "com_maxfps",
            "10",
            "+set",
            "com_maxfpsUnfocused",
            "10",
            "+set",
            "again",
            "demo demo088-test1; wait 400; vstr again",
            "+vstr",
            "again",
        ],
        strategy: "geometry",
    },
];

/// Time between two samples. The report is written as often as frames are shown.
const PAUSE: Duration = Duration::from_secs(5);
/// Time between two lines of progress.
const LINES: Duration = Duration::from_secs(300);

fn wish(name: &str) -> Option<String> {
    std::env::var(name).ok().filter(|value| !value.is_empty())
}

/// One of the two games.
struct Side {
    child: Child,
    report: PathBuf,
    samples: Vec<Sample>,
    _screen: Screen,
    _home: tempfile::TempDir,
}

impl Side {
    fn start(program: &Program, layer: Option<&Path>, report: PathBuf) -> Side {
        let (screen, home) = (own_screen(), tempfile::tempdir().expect("a folder"));
        let options = [
            ("VIEWS", "8"),
            ("STRATEGY", program.strategy),
            ("REPORT", report.to_str().expect("UTF-8")),
        ];
        let mut command = match layer {
            None => bare("nice"),
            Some(library) => {
                let mut command = layered("nice", &options);
                command.env("LD_PRELOAD", library);
                command
            }
        };
        // `nice` and the script both exec, so the child is the game itself.
        command
            .args(["-n", "19"])
            .args(program.command)
            .env("HOME", home.path())
            .env("SDL_AUDIODRIVER", "dummy")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        let child = screen.give(&mut command).spawn().expect("nice");
        Side {
            child,
            report,
            samples: Vec::new(),
            _screen: screen,
            _home: home,
        }
    }

    /// Takes a sample, or returns how the game ended.
    fn look(&mut self, hours: f64) -> Result<(), String> {
        if let Some(status) = self.child.try_wait().expect("a child") {
            let minutes = hours * 60.0;
            return Err(format!("the game ended after {minutes:.0} min: {status}"));
        }
        let process = Path::new("/proc").join(self.child.id().to_string());
        let mut sample = Sample {
            hours,
            memory: memory(&process),
            descriptors: fs::read_dir(process.join("fd")).map_or(0, |d| d.count() as u64),
            ..Sample::default()
        };
        if let Ok(text) = fs::read_to_string(&self.report) {
            let report: serde_json::Value = serde_json::from_str(&text).expect("a report");
            sample.frames = report["frames"].as_u64().expect("frames");
            for (at, name) in NAMES.iter().enumerate() {
                sample.names[at] = report["names"][name].as_u64().expect("a count of names");
            }
        }
        self.samples.push(sample);
        Ok(())
    }
}

impl Drop for Side {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Resident memory in MiB.
fn memory(process: &Path) -> f64 {
    let status = fs::read_to_string(process.join("status")).unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmRSS:"));
    let kibibytes = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kibibytes.unwrap_or(0.0) / 1024.0
}

fn csv(bare: &[Sample], layer: &[Sample]) -> String {
    let mut text = format!(
        "minutes,bare_mib,bare_descriptors,layer_mib,layer_descriptors,frames,{}\n",
        NAMES.join(",")
    );
    for (b, l) in bare.iter().zip(layer) {
        let _ = write!(
            text,
            "{:.2},{:.2},{},{:.2},{},{}",
            l.hours * 60.0,
            b.memory,
            b.descriptors,
            l.memory,
            l.descriptors,
            l.frames
        );
        for count in l.names {
            let _ = write!(text, ",{count}");
        }
        text.push('\n');
    }
    text
}

#[test]
#[ignore = "hours: make soak"]
fn soak_leaves_memory_and_names_as_they_are() {
    let minutes: f64 = wish("SOAK_MINUTES").map_or(240.0, |m| m.parse().expect("minutes"));
    let name = wish("SOAK_PROGRAM");
    let program = PROGRAMS
        .iter()
        .find(|p| name.as_ref().is_none_or(|name| p.name == name))
        .expect("SOAK_PROGRAM names no program");
    let status = Command::new("sh")
        .args(["scripts/packages.sh", "--optional", program.package])
        .status();
    assert!(status.expect("sh").success());
    let folder = wish("SOAK_FOLDER").map_or_else(|| scratch("soak"), PathBuf::from);
    fs::create_dir_all(&folder).expect("a folder");
    let library = wish("SOAK_LIBRARY").map_or_else(support::library, PathBuf::from);
    let file = |end: &str| folder.join(format!("{}{end}", program.name));
    let _ = fs::remove_file(file(".json"));

    let start = Instant::now();
    let mut bare = Side::start(program, None, file("-bare.json"));
    let mut layer = Side::start(program, Some(&library), file(".json"));
    let mut wrong = Vec::new();
    let mut said = start;
    while start.elapsed().as_secs_f64() < minutes * 60.0 && wrong.is_empty() {
        std::thread::sleep(PAUSE);
        let hours = start.elapsed().as_secs_f64() / 3600.0;
        for side in [&mut bare, &mut layer] {
            wrong.extend(side.look(hours).err());
        }
        fs::write(file(".csv"), csv(&bare.samples, &layer.samples)).expect("written");
        if said.elapsed() > LINES {
            said = Instant::now();
            let last = layer.samples.last().copied().unwrap_or_default();
            eprintln!(
                "{:.0} of {minutes} min: {:.0} MiB, {} frames",
                hours * 60.0,
                last.memory,
                last.frames
            );
        }
    }
    let (more, measured) = judge::judge(&bare.samples, &layer.samples);
    wrong.extend(more);
    if layer.samples.last().is_none_or(|s| s.frames == 0) {
        wrong.push("no frame was shown under the layer".to_owned());
    }
    let verdict = match wrong.is_empty() {
        true => "passed".to_owned(),
        false => format!("FAILED: {}", wrong.join("; ")),
    };
    let line = format!(
        "{}, {minutes} min, 8 views, {}: {verdict}; {measured}\n",
        program.name, program.strategy
    );
    let lines: [(&str, &str, &[Sample]); 2] = [
        ("under the layer", "#c22", &layer.samples),
        ("without", "#26c", &bare.samples),
    ];
    let title = format!("{}: resident memory", program.name);
    fs::write(file(".svg"), chart::svg(&title, &lines)).expect("written");
    fs::write(folder.join("result.txt"), &line).expect("written");
    eprint!("{line}");
    assert!(wrong.is_empty(), "{line}");
}
