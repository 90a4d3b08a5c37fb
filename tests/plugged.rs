//! The panel that is plugged in or set up is the one that `manyview run` shows on.

use crate::support;
use crate::support::x::User;
use crate::support::{Compiled, Screen, compiled, manyview, run, sized_screen};
use serde_json::Value;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const LIMIT: Duration = Duration::from_secs(60);
/// Both monitors have the size of the panel, so that only its name tells it.
const SIZE: [i16; 2] = [300, 400];
/// Colours and depths of a view.
const VIEW_BYTES: u64 = 64 * 64 * 8;
const SERIAL: &str = "LKG-P01234";

/// The command as a user types it: no display in a variable.
fn plain() -> Command {
    let mut command = manyview();
    command.env_remove("MANYVIEW_DISPLAY");
    command
}

fn still() -> PathBuf {
    compiled("still", Compiled::Program, &["-lEGL", "-lGL"])
}

/// An EDID whose name and serial number are those of a Looking Glass.
fn edid() -> Vec<u8> {
    let mut block = vec![0, 255, 255, 255, 255, 255, 255, 0];
    block.resize(128, 0);
    for (start, tag, text) in [(54, 0xfc, "LKG-P"), (72, 0xff, SERIAL)] {
        block[start + 3] = tag;
        block[start + 5..start + 18].fill(b' ');
        block[start + 5..start + 5 + text.len()].copy_from_slice(text.as_bytes());
        block[start + 5 + text.len()] = b'\n';
    }
    block
}

fn calibration(folder: &Path) -> String {
    let [width, height] = SIZE;
    let text = format!(
        r#"{{"serial": "{SERIAL}", "pitch": 50, "slope": -7, "center": 0, "DPI": 300, "screenW": {width}, "screenH": {height}}}"#
    );
    let file = folder.join("visual.json");
    fs::write(&file, text).expect("a file");
    file.display().to_string()
}

/// A desk with the panel on its right.
fn desk() -> Screen {
    let screen = sized_screen((600, 400));
    let user = User::at(screen.display());
    user.add_monitor("desk", [0, 0, SIZE[0], SIZE[1]]);
    user.plug_in("glass", [SIZE[0], 0, SIZE[0], SIZE[1]], &edid());
    screen
}

/// Starts the program, and ends it once its window of the panel is there, or at once where none is to come. Returns the place of that
/// window, the number of views and what was said.
fn shown(screen: &Screen, command: &mut Command, window: bool) -> (Option<[i16; 2]>, u64, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("report.json");
    let command = command.arg("--report").arg(&report);
    let command = command.arg("--").arg(still()).args(["64", "64"]);
    let command = command.stdin(Stdio::piped()).stderr(Stdio::piped());
    let mut child: Child = screen.give(command).spawn().expect("it starts");
    let user = User::at(screen.display());
    let limit = Instant::now() + LIMIT;
    let place = loop {
        match user.window("manyview") {
            Some(found) => break Some(user.place(found)),
            None if !window => break None,
            None => assert!(Instant::now() < limit, "a window"),
        }
        std::thread::sleep(Duration::from_millis(20));
    };
    std::thread::sleep(Duration::from_millis(500));
    drop(child.stdin.take());
    let mut said = String::new();
    let errors = child.stderr.as_mut().expect("a pipe");
    errors.read_to_string(&mut said).expect("text");
    assert!(child.wait().expect("it ends").success(), "{said}");
    let report = fs::read_to_string(&report).expect("a report");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let bytes = report["view_bytes"].as_u64().expect("bytes");
    (place, bytes / VIEW_BYTES, said)
}

/// Sets a panel up in a folder of configurations of its own.
fn set_up(folder: &TempDir, arguments: &[&str]) {
    let (code, _, said) = run(plain()
        .env("XDG_CONFIG_HOME", folder.path())
        .args(["displays", "use"])
        .args(arguments));
    assert_eq!(code, 0, "{said}");
}

#[test]
fn a_display_is_shown_on_the_monitor_that_has_its_serial_number() {
    let (screen, folder) = (desk(), tempfile::tempdir().expect("a folder"));
    let display = calibration(folder.path());
    let arguments = ["run", "--panel", "auto", "--display", &display];
    let (place, views, said) = shown(&screen, plain().args(arguments), true);
    assert_eq!(place, Some([SIZE[0], 0]), "{said}");
    assert_eq!((views, said.as_str()), (48, ""));
}

#[test]
fn a_panel_that_is_set_up_is_shown_on_until_it_is_forgotten() {
    let (screen, folder) = (desk(), tempfile::tempdir().expect("a folder"));
    let run_here = || {
        let mut command = plain();
        command.env("XDG_CONFIG_HOME", folder.path()).arg("run");
        command
    };
    set_up(&folder, &[&calibration(folder.path()), "--panel", "auto"]);
    let (place, views, said) = shown(&screen, &mut run_here(), true);
    assert_eq!(place, Some([SIZE[0], 0]), "{said}");
    assert_eq!((views, said.as_str()), (48, ""));
    // What is given goes first.
    let (place, views, _) = shown(&screen, run_here().args(["--display", "columns"]), false);
    assert_eq!((place, views), (None, 2));

    set_up(&folder, &["lenticular-5"]);
    let (place, views, _) = shown(&screen, &mut run_here(), false);
    assert_eq!((place, views), (None, 5));

    let mut forget = plain();
    let forget = forget.env("XDG_CONFIG_HOME", folder.path());
    assert_eq!(run(forget.args(["displays", "forget"])).0, 0);
    // The calibration of the Looking Glass is on no drive here.
    let (place, views, said) = shown(&screen, &mut run_here(), false);
    assert_eq!((place, views), (None, 2));
    assert!(
        said.starts_with(&format!("manyview: {SERIAL} is plugged in")),
        "{said}"
    );
    assert_eq!(said.lines().count(), 1, "{said}");
}

#[test]
fn without_a_panel_an_anaglyph_is_shown_and_said_to_be_one() {
    let screen = sized_screen((600, 400));
    let (place, views, said) = shown(&screen, plain().arg("run"), false);
    assert_eq!((place, views), (None, 2));
    assert!(
        said.starts_with("manyview: no panel is plugged in or set up, so this is an anaglyph"),
        "{said}"
    );
    assert_eq!(said.lines().count(), 1, "{said}");
    // Pictures are taken of the default panel, wherever they are taken.
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("a.png");
    let mut capture = plain();
    let capture = capture.args(["capture", "--frame", "2", "--what", "atlas", "--out"]);
    let capture = capture.arg(&out).arg("--").arg(still()).args(["64", "64"]);
    let (code, _, said) = run(capture);
    assert_eq!((code, said.lines().count()), (0, 1), "{said}");
    assert_eq!(support::rgb(&out).width(), 8 * 64);
}

#[test]
fn a_mistake_is_one_line_all_the_same() {
    let (code, _, said) = run(plain().args(["run", "--", "/no/such/program"]));
    assert_eq!((code, said.lines().count()), (127, 1), "{said}");
}

#[test]
fn displays_lists_what_is_plugged_in_and_set_up() {
    let (screen, folder) = (desk(), tempfile::tempdir().expect("a folder"));
    let list = |more: &[&str]| {
        let mut command = plain();
        let command = command
            .env("XDG_CONFIG_HOME", folder.path())
            .arg("displays");
        let (code, stdout, said) = run(screen.give(command.args(more)));
        assert_eq!((code, said.as_str()), (0, ""));
        stdout
    };
    let text = list(&[]);
    assert!(text.contains("glass  300x400  LKG-P01234"), "{text}");
    assert!(
        text.contains("desk   300x400\n") && text.contains("SET UP\nnothing;"),
        "{text}"
    );
    set_up(&folder, &["rows", "--panel", "glass"]);
    let text = list(&[]);
    assert!(
        text.contains("SET UP\nrows, in a window of its own on monitor glass\n"),
        "{text}"
    );
    let found: Value = serde_json::from_str(&list(&["--json"])).expect("JSON");
    assert_eq!(found["monitors"][1]["name"], SERIAL);
    assert_eq!(found["set-up"]["display"], "rows");
}

#[test]
fn what_cannot_be_set_up_is_one_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let refused = |arguments: &[&str], part: &str| {
        let mut command = plain();
        let command = command.env("XDG_CONFIG_HOME", folder.path());
        let (code, _, said) = run(command.args(arguments));
        assert_eq!((code, said.lines().count()), (2, 1), "{said}");
        assert!(said.contains(part), "{said}");
    };
    refused(&["displays", "use", "looking-glass-go"], "visual.json");
    refused(&["displays", "use", "no-such"], "no-such");
    fs::create_dir(folder.path().join("manyview")).expect("a folder");
    fs::write(folder.path().join("manyview/panel.toml"), "display = 3").expect("a file");
    refused(&["run", "--", "true"], "manyview displays use");
    fs::write(
        folder.path().join("manyview/panel.toml"),
        "display = '/gone.toml'",
    )
    .expect("a file");
    refused(&["run", "--", "true"], "display in");
}

#[test]
fn one_view_needs_no_panel() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = plain();
    command
        .env("XDG_CONFIG_HOME", folder.path())
        .args(["run", "--views", "1", "--", "true"]);
    let (status, _, said) = run(&mut command);
    assert_eq!((status, said.as_str()), (0, ""));
}
