//! Memory: valgrind's findings in the layer, and what contexts leave behind when they are destroyed. The long run of a game is in
//! tests/soak.rs.
//!
//! Only our own findings count: a report of valgrind's with a frame of `libmanyview.so` in a stack, unless the driver gives the same one
//! without the layer. The reports are in `target/memory`.

use crate::random::build;
use crate::support::{Compiled, bare, compiled, demo, has, layered, lines, scratch};
use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

const OURS: &str = "libmanyview.so";

/// Innermost frames that have to agree for two reports from inside the driver to count as the same.
const DEPTH: usize = 8;

/// One of valgrind's reports.
#[derive(Debug)]
struct Found {
    kind: String,
    what: String,
    /// Innermost frame first, each an object and a function or address in it. The first stack is where the error happened; others say where
    /// the memory comes from.
    stacks: Vec<Vec<String>>,
}

/// The text of the first element of a name.
fn element<'a>(xml: &'a str, name: &str) -> Option<&'a str> {
    let start = xml.find(&format!("<{name}>"))? + name.len() + 2;
    let end = start + xml[start..].find(&format!("</{name}>"))?;
    Some(&xml[start..end])
}

/// The contents of all elements of a name, which do not contain each other.
fn elements<'a>(xml: &'a str, name: &str) -> Vec<&'a str> {
    let close = format!("</{name}>");
    xml.split(&format!("<{name}>"))
        .skip(1)
        .filter_map(|part| part.split(&close).next())
        .collect()
}

fn found(xml: &str) -> Vec<Found> {
    let stack = |stack: &&str| {
        // Drivers have no symbols and another address in each run: a frame is identified by its distance from the first one in the object.
        let mut first: HashMap<&str, i128> = HashMap::new();
        let mut frame = |frame| {
            let part = |name| element(frame, name);
            let object = part("obj").and_then(|path| path.rsplit('/').next());
            let object = object.unwrap_or("?");
            let ip = part("ip")
                .and_then(|ip| i128::from_str_radix(ip.trim_start_matches("0x"), 16).ok());
            let ip = ip.unwrap_or(0);
            let distance = ip - *first.entry(object).or_insert(ip);
            let text = match (part("fn"), part("line")) {
                (Some(function), Some(line)) => {
                    format!("{object} {function} {}:{line}", part("file").unwrap_or("?"))
                }
                (Some(function), None) => format!("{object} {function}"),
                (None, _) => format!("{object} {distance:+}"),
            };
            text.replace("&lt;", "<")
                .replace("&gt;", ">")
                .replace("&amp;", "&")
        };
        elements(stack, "frame")
            .into_iter()
            .map(&mut frame)
            .collect()
    };
    elements(xml, "error")
        .into_iter()
        .map(|error| Found {
            kind: element(error, "kind").unwrap_or("?").to_owned(),
            what: element(error, "what")
                .or_else(|| element(error, "text"))
                .unwrap_or("?")
                .to_owned(),
            stacks: elements(error, "stack").iter().map(stack).collect(),
        })
        .collect()
}

impl Found {
    /// The kind and the innermost frames, up to the first of ours, or all of them without the layer; at most [`DEPTH`]. The limit is needed
    /// because the driver may do deferred work in another call of ours than of the program's.
    fn inside(&self) -> (&str, &[String]) {
        let stack = self.stacks.first().map_or(&[][..], Vec::as_slice);
        let end = stack.iter().position(|frame| is_ours(frame));
        (&self.kind, &stack[..end.unwrap_or(stack.len()).min(DEPTH)])
    }

    fn is_ours(&self) -> bool {
        self.stacks.iter().flatten().any(|frame| is_ours(frame))
    }
}

fn is_ours(frame: &str) -> bool {
    frame.starts_with(OURS)
}

/// The reports under the layer that are not the driver's alone.
fn ours<'a>(bare: &[Found], layer: &'a [Found]) -> Vec<&'a Found> {
    let known: HashSet<(&str, &[String])> = bare
        .iter()
        .flat_map(|f| {
            let (kind, stack) = f.inside();
            (1..=stack.len()).map(move |end| (kind, &stack[..end]))
        })
        .collect();
    layer
        .iter()
        .filter(|f| f.is_ours() && !known.contains(&f.inside()))
        .collect()
}

/// Runs a program under valgrind and returns the findings.
fn watch(name: &str, mut program: Command) -> Vec<Found> {
    let out = scratch("memory").join(format!("{name}.xml"));
    program
        .env_remove("DISPLAY")
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    let status = program.status().expect("valgrind");
    assert!(status.success(), "{name}: {status}: {program:?}");
    let xml = fs::read_to_string(&out).expect("a report");
    assert!(xml.contains("</valgrindoutput>"), "{name}: half a report");
    found(&xml)
}

/// valgrind with its options; the program and its arguments follow.
fn valgrind(name: &str, strategy: Option<&str>) -> Command {
    let mut command = match strategy {
        None => bare("valgrind"),
        Some(strategy) => layered("valgrind", &[("VIEWS", "3"), ("STRATEGY", strategy)]),
    };
    let out = scratch("memory").join(format!("{name}.xml"));
    command
        .args([
            "--tool=memcheck",
            "--leak-check=full",
            "--show-leak-kinds=definite",
            "--errors-for-leak-kinds=definite",
            "--error-limit=no",
            "--num-callers=60",
            // Drivers are unloaded before the report is written.
            "--keep-debuginfo=yes",
            "--xml=yes",
        ])
        .arg(format!("--xml-file={}", out.display()));
    command
}

/// Runs a program bare and under strategies; a finding of ours fails the test.
fn clean(name: &str, program: &Path, arguments: &[&str], strategies: &[&str]) {
    if !has("valgrind") {
        return;
    }
    let run = |strategy: Option<&str>| {
        let name = format!("{name}-{}", strategy.unwrap_or("bare"));
        let mut command = valgrind(&name, strategy);
        command.arg(program).args(arguments);
        watch(&name, command)
    };
    let bare = run(None);
    for strategy in strategies {
        let all = run(Some(strategy));
        let ours = ours(&bare, &all);
        let shown: Vec<String> = ours
            .iter()
            .take(5)
            .map(|f| {
                let stacks: Vec<_> = f.stacks.iter().map(|s| s.join("\n    ")).collect();
                format!(
                    "{}: {}\n    {}",
                    f.kind,
                    f.what,
                    stacks.join("\n  and\n    ")
                )
            })
            .collect();
        assert!(
            ours.is_empty(),
            "{name}, {strategy}: {} of {} reports are ours:\n{}",
            ours.len(),
            all.len(),
            shown.join("\n")
        );
        println!(
            "{name}, {strategy}: {} reports, none of them ours",
            all.len()
        );
    }
}

fn a_demo(name: &str, strategies: &[&str]) {
    let arguments = [
        "--api",
        "egl",
        "--surface",
        "pbuffer",
        "--size",
        "64x48",
        "--frames",
        "3",
    ];
    clean(name, &demo(name), &arguments, strategies);
}

#[test]
#[ignore = "minutes, under valgrind"]
fn full_memory_of_arrays() {
    a_demo("arrays", &["replay", "instanced", "geometry"]);
}

#[test]
#[ignore = "minutes, under valgrind"]
fn full_memory_of_lists() {
    a_demo("lists", &["replay", "geometry"]);
}

#[test]
#[ignore = "minutes, under valgrind"]
fn full_memory_of_points() {
    a_demo("cloud", &["splats"]);
}

#[test]
#[ignore = "minutes, under valgrind"]
fn full_memory_of_copies() {
    a_demo("echo", &["replay"]);
}

/// Legal and illegal calls of all kinds; the last seed has two threads.
#[test]
#[ignore = "minutes, under valgrind"]
fn full_memory_of_random_calls() {
    let program = build::program(false);
    clean(
        "random",
        &program,
        &["--api", "egl", "--seed", "8", "--count", "3"],
        &["replay"],
    );
}

/// Bytes in use that sixty more contexts leave behind.
fn grown(mut program: Command) -> u64 {
    let bytes: Vec<u64> = lines(&mut program)
        .lines()
        .map(|l| l.parse().expect("bytes"))
        .collect();
    assert_eq!(bytes.len(), 2, "{bytes:?}");
    bytes[1].saturating_sub(bytes[0])
}

/// A leak would show: our record of a context takes some kilobytes, a context of the driver hundreds.
#[test]
fn contexts_that_come_and_go_leave_nothing() {
    let program = compiled("contexts", Compiled::Program, &["-lEGL", "-lGL"]);
    let bare = grown(bare(&program));
    for strategy in ["replay", "geometry"] {
        let options = [("VIEWS", "3"), ("STRATEGY", strategy)];
        let layer = grown(layered(&program, &options));
        println!("sixty contexts leave {bare} bytes, under the layer {layer}");
        assert!(
            layer < bare + 60 * 256,
            "sixty contexts leave {bare} bytes, under the layer ({strategy}) {layer}"
        );
    }
}

#[test]
fn what_the_driver_does_without_us_is_not_ours() {
    let error = |kind: &str, objects: &[&str]| {
        let frames: String = objects
            .iter()
            .map(|o| format!("<frame><obj>/lib/{o}</obj><fn>f</fn></frame>"))
            .collect();
        format!("<error>\n<kind>{kind}</kind><what>it</what><stack>{frames}</stack></error>")
    };
    let bare = found(&error("InvalidRead", &["mesa", "mesa", "app"]));
    let count = |objects: &[&str]| ours(&bare, &found(&error("InvalidRead", objects))).len();
    assert_eq!(count(&["mesa", "mesa", OURS, "app"]), 0);
    assert_eq!(count(&["mesa", "glibc", OURS, "app"]), 1);
    assert_eq!(count(&[OURS, "app"]), 1);
    assert_eq!(count(&["mesa", "glibc", "app"]), 0);
}
