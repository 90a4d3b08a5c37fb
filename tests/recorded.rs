//! Programs that were not written for the layer: recorded once with apitrace, repeated with and without it. The middle view of 7 is the
//! program's own, so by replay every frame that is read back has the same bytes.
//!
//! The very first frame is left out: it shows an undefined buffer and varies without the layer as well.

use crate::support;
use crate::support::{Screen, bare, has, layered, record, rgb, screen, succeed};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Stdio;

/// A program to record.
struct Program {
    /// Program and arguments.
    command: &'static [&'static str],
    /// apitrace's name of the API.
    api: &'static str,
    /// The command that repeats its trace.
    retrace: &'static str,
    /// Seconds until it has shown some dozens of frames.
    seconds: u32,
}

const fn glx(command: &'static [&'static str], seconds: u32) -> Program {
    Program {
        command,
        api: "gl",
        retrace: "glretrace",
        seconds,
    }
}

/// xscreensaver's programs take their context from EGL and draw in fixed function.
const fn egl(command: &'static [&'static str]) -> Program {
    Program {
        command,
        api: "egl",
        retrace: "eglretrace",
        seconds: 5,
    }
}

/// Name and bytes of the picture of each frame.
type Pictures = BTreeMap<String, Vec<u8>>;

fn repeat(
    program: &Program,
    trace: &Path,
    layer: bool,
    screen: &Screen,
    folder: &Path,
) -> Pictures {
    let name = if layer { "layer" } else { "bare" };
    let out = folder.join(name);
    std::fs::create_dir(&out).expect("a folder");
    let report = folder.join("report.json");
    let mut command = if layer {
        layered(
            program.retrace,
            &[
                ("VIEWS", "7"),
                ("STRATEGY", "replay"),
                ("REPORT", report.to_str().expect("UTF-8")),
            ],
        )
    } else {
        bare(program.retrace)
    };
    // A path that ends with a separator: the prefix is a folder.
    let prefix = format!("{}/", out.display());
    command
        .args(["-S", "*/frame", "-s", &prefix])
        .arg(trace)
        .stdout(Stdio::null());
    succeed(screen.give(&mut command));
    if layer {
        let text = std::fs::read_to_string(&report).expect("a report: the layer was on");
        let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let replayed = report["draws"]["replay"].as_u64();
        assert!(replayed.is_some_and(|draws| draws > 20), "{text}");
    }
    std::fs::read_dir(&out)
        .expect("a folder")
        .flatten()
        .map(|entry| {
            let bytes = std::fs::read(entry.path()).expect("a picture");
            (entry.file_name().to_string_lossy().into_owned(), bytes)
        })
        .collect()
}

#[track_caller]
fn check(program: &Program) {
    let name = Path::new(program.command[0]);
    let there = match name.is_absolute() {
        true => name.is_file(),
        false => has(program.command[0]),
    };
    if !there {
        eprintln!(
            "skipped: {} is not installed (make test-long)",
            name.display()
        );
        return;
    }
    if !has("apitrace") || !has(program.retrace) {
        return;
    }
    let screen = screen();
    let folder = tempfile::tempdir().expect("a folder");
    let trace = record(
        &screen,
        program.command,
        program.seconds,
        program.api,
        folder.path(),
    );
    let expected = repeat(program, &trace, false, &screen, folder.path());
    let actual = repeat(program, &trace, true, &screen, folder.path());
    assert!(expected.len() > 10, "{} frames", expected.len());
    assert_eq!(
        expected.keys().collect::<Vec<_>>(),
        actual.keys().collect::<Vec<_>>(),
        "the same frames"
    );
    let wrong: Vec<_> = expected
        .iter()
        .skip(1)
        .filter(|(name, bytes)| actual[*name] != **bytes)
        .map(|(name, _)| name)
        .collect();
    if let Some(first) = wrong.first() {
        let at = |kind: &str| rgb(&folder.path().join(kind).join(first));
        let (before, after) = (at("bare"), at("layer"));
        let path = support::scratch("recorded").join(format!(
            "{}.png",
            name.file_name()
                .map_or_else(Default::default, |n| n.to_string_lossy())
        ));
        manyview::metric::triptych(&before, &after)
            .save(&path)
            .expect("written");
        panic!(
            "{} of {} frames differ: {wrong:?}; {}",
            wrong.len(),
            expected.len() - 1,
            path.display()
        );
    }
    // The last picture is not one plain colour.
    let (last, _) = expected.last_key_value().expect("frames");
    let picture = rgb(&folder.path().join("bare").join(last));
    assert!(
        picture
            .pixels()
            .any(|pixel| pixel != picture.get_pixel(0, 0)),
        "an empty picture"
    );
    println!("{}: {} frames equal", name.display(), expected.len() - 1);
}

#[test]
fn glxgears() {
    check(&glx(&["glxgears", "-geometry", "300x220"], 3));
}

macro_rules! long {
    ($($name:ident: $program:expr;)*) => { $(
        #[test]
        #[ignore = "needs packages of make test-long"]
        fn $name() {
            check(&$program);
        }
    )* };
}

long! {
    gltron: glx(&["/usr/games/gltron", "-2", "-i", "-s"], 6);
    atlantis: egl(&["/usr/libexec/xscreensaver/atlantis", "--window", "--geometry", "320x240"]);
    atunnel: egl(&["/usr/libexec/xscreensaver/atunnel", "--window", "--geometry", "320x240"]);
    cage: egl(&["/usr/libexec/xscreensaver/cage", "--window", "--geometry", "320x240"]);
    gears: egl(&["/usr/libexec/xscreensaver/gears", "--window", "--geometry", "320x240"]);
    morph3d: egl(&["/usr/libexec/xscreensaver/morph3d", "--window", "--geometry", "320x240"]);
}
