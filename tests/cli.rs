//! The command from its user's side: exit statuses, messages, environment. No OpenGL here.

use crate::support;
use crate::support::{manyview, refused, run};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Stdio};
use tempfile::tempdir;

#[test]
fn bad_options_are_one_line_and_status_2() {
    for (arguments, part) in [
        (&["--views", "0"][..], "--views is '0'"),
        (&["--views", "100000"], "from 1 to 256"),
        (&["--views", "-1"], "--views is '-1'"),
        (&["--display", "no-such.toml"], "--display: "),
        (&["--display", "missing-mask.png"], "--display: "),
        (
            &["--eye-spacing", "0.1", "--auto-depth=0"],
            "--focal-depth is missing",
        ),
        (&["--eye-spacing", "0.1", "--focal-depth", "-1"], "above 0"),
        (&["--eye-spacing", "0.1", "--focal-depth", "nan"], "finite"),
        (
            &[
                "--eye-spacing",
                "1",
                "--focal-depth",
                "5",
                "--separation",
                "1",
            ],
            "keep one of them",
        ),
        (&["--output", "view:8"], "the last is view:7"),
        (
            &["--output", "chequer"],
            "this version knows panel, quilt, sbs, ",
        ),
        (&["--auto-depth=yes"], "give 1 for on or 0 for off"),
        (&["--strategy", "magic"], "replay"),
        (
            &["--view-scale", "0"],
            "give auto, or a number from 0.05 to 1",
        ),
        (&["--config", "no-such.toml"], "No such file"),
        (&["--report", "no-such-folder/r.json"], "there is no folder"),
    ] {
        let arguments = [&["run"], arguments, &["--", "true"]].concat();
        refused(&arguments, 2, part);
    }
}

#[test]
fn capture_refuses_what_it_cannot_write() {
    refused(&["capture", "--", "true"], 2, "--out");
    refused(
        &["capture", "--out", "no-such-folder/a.png", "--", "true"],
        2,
        "there is no folder",
    );
    refused(&["capture", "--out", "/", "--", "true"], 2, "is a folder");
    refused(
        &["capture", "--out", "a.png", "--frame", "0", "--", "true"],
        2,
        "counted from 1",
    );
    refused(
        &[
            "capture", "--out", "a.png", "--what", "view:8", "--", "true",
        ],
        2,
        "view:7",
    );
}

#[test]
fn an_unreadable_panel_file_is_named() {
    let folder = tempdir().expect("a folder");
    let panel = folder.path().join("panel.toml");
    fs::write(&panel, "this is not a panel").expect("written");
    refused(
        &[
            "run",
            "--display",
            panel.to_str().expect("UTF-8"),
            "--",
            "true",
        ],
        2,
        "--display: display `",
    );
    refused(
        &[
            "run",
            "--display",
            folder.path().to_str().expect("UTF-8"),
            "--",
            "true",
        ],
        2,
        "--display: display `",
    );
}

#[test]
fn wrong_variables_are_named_as_variables() {
    let (code, _, stderr) = run(manyview()
        .args(["run", "--", "true"])
        .env("MANYVIEW_VIEWS", "none"));
    assert_eq!(
        (code, stderr.contains("MANYVIEW_VIEWS is 'none'")),
        (2, true),
        "{stderr}"
    );
}

#[test]
fn missing_programs_are_127_and_unusable_ones_126() {
    let folder = tempdir().expect("a folder");
    let plain = folder.path().join("plain");
    fs::write(&plain, "text").expect("written");
    refused(&["run", "--", "no-such-program-anywhere"], 127, "not found");
    refused(&["run", "--", "/no/such/program"], 127, "not found");
    refused(
        &["run", "--", plain.to_str().expect("UTF-8")],
        126,
        "not executable",
    );
    refused(
        &["run", "--", folder.path().to_str().expect("UTF-8")],
        126,
        "not a file",
    );
}

#[test]
fn programs_that_the_layer_cannot_enter_are_refused() {
    let folder = tempdir().expect("a folder");
    let program = |name: &str, change: &dyn Fn(&mut Vec<u8>), mode: u32| {
        let path = folder.path().join(name);
        let mut bytes = fs::read("/bin/true").expect("/bin/true");
        change(&mut bytes);
        fs::write(&path, bytes).expect("written");
        fs::set_permissions(&path, fs::Permissions::from_mode(mode)).expect("mode");
        path.to_str().expect("UTF-8").to_owned()
    };
    let same = |_: &mut Vec<u8>| {};
    for (name, mode) in [("setuid", 0o4755), ("setgid", 0o2755)] {
        let refusal = format!(
            "it is {name} and the loader ignores LD_PRELOAD, so the layer cannot enter it; run a copy of it"
        );
        let path = program(name, &same, mode);
        refused(&["run", "--", &path], 126, &refusal);
        // What it says helps.
        let copy = folder.path().join("copy");
        let copied = Command::new("cp").args([Path::new(&path), &copy]).status();
        assert!(copied.expect("cp").success());
        let mode = fs::metadata(&copy).expect("copied").permissions().mode();
        assert_eq!(mode & 0o6000, 0, "`cp` makes it without that");
    }
    // The header of a 32-bit program and its one segment, which names a loader.
    let narrow = |bytes: &mut Vec<u8>| {
        bytes[4] = 1;
        bytes[18..20].copy_from_slice(&3_u16.to_le_bytes());
        bytes[28..32].copy_from_slice(&52_u32.to_le_bytes());
        bytes[42..46].copy_from_slice(&[32, 0, 1, 0]);
        bytes[52..56].copy_from_slice(&3_u32.to_le_bytes());
    };
    let narrow = program("narrow", &narrow, 0o755);
    // Where the library of 32 bits has been built, it is left out so.
    let mut command = manyview();
    command.args(["run", "--", &narrow]);
    let (code, _, stderr) = run(command.env("MANYVIEW_LIBRARY", support::library()));
    assert_eq!(code, 126, "{stderr}");
    assert!(
        stderr.contains("32-bit") && stderr.contains("make build-32"),
        "{stderr}"
    );
    refused(
        &[
            "run",
            "--",
            &program("foreign", &|bytes| bytes[18] = 0xfe, 0o755),
        ],
        126,
        "another machine",
    );
    // Without program headers there is no interpreter: a statically linked program.
    let alone = program("static", &|bytes| bytes[56..58].fill(0), 0o755);
    refused(&["run", "--", &alone], 126, "statically linked");
}

#[test]
fn a_library_that_is_not_there_is_status_3() {
    let (code, _, stderr) = run(manyview()
        .args(["run", "--", "true"])
        .env("MANYVIEW_LIBRARY", "/no/such/libmanyview.so"));
    assert_eq!((code, stderr.lines().count()), (3, 1), "{stderr}");
}

#[test]
fn the_exit_status_is_the_programs() {
    support::library();
    for (script, status) in [
        ("exit 0", 0),
        ("exit 7", 7),
        ("kill -TERM $$", 143),
        ("kill -KILL $$", 137),
    ] {
        let (code, _, stderr) = run(manyview().args(["run", "--", "sh", "-c", script]));
        assert_eq!(code, status, "{script}: {stderr}");
    }
}

#[test]
fn signals_reach_the_program() {
    support::library();
    let script = "trap 'exit 9' TERM; echo ready; while :; do sleep 0.02; done";
    let mut launcher = manyview();
    let mut child = launcher
        .args(["run", "--", "sh", "-c", script])
        .stdout(Stdio::piped())
        .spawn()
        .expect("starts");
    let mut ready = [0; 6];
    let pipe = child.stdout.as_mut().expect("a pipe");
    std::io::Read::read_exact(pipe, &mut ready).expect("ready");
    // The `kill` that is built into the shell: a small Debian has no other.
    let killed = Command::new("sh")
        .args(["-c", &format!("kill -TERM {}", child.id())])
        .status()
        .expect("kill");
    assert!(killed.success(), "the signal is sent");
    assert_eq!(child.wait().expect("ends").code(), Some(9));
}

#[test]
fn our_library_is_preloaded_first_and_once() {
    let library = support::library().canonicalize().expect("a path");
    let library = library.to_str().expect("UTF-8");
    let other = "libc.so.6";
    let (code, stdout, stderr) = run(manyview()
        .args(["run", "--", "sh", "-c", "echo $LD_PRELOAD"])
        // Where there is a library for 32-bit programs as well, a folder of links is named.
        .env("MANYVIEW_LIBRARY", library)
        .env("LD_PRELOAD", format!("{other}:{library}")));
    assert_eq!(
        (code, stdout.trim_end()),
        (0, format!("{library}:{other}").as_str()),
        "{stderr}"
    );
}

#[test]
fn options_reach_the_program_as_variables() {
    support::library();
    let folder = tempdir().expect("a folder");
    let toml = folder.path().join("m.toml");
    fs::write(&toml, "views = 5\nstrategy = \"replay\"\n").expect("written");
    let script = "echo $MANYVIEW_VIEWS $MANYVIEW_STRATEGY $MANYVIEW_OUTPUT $MANYVIEW_REPORT ${MANYVIEW_CONFIG-none}";
    let (_, stdout, stderr) = run(manyview()
        .current_dir(&folder)
        .args([
            "run", "--config", "m.toml", "--views", "9", "--report", "r.json", "--", "sh", "-c",
            script,
        ])
        .env("MANYVIEW_OUTPUT", "quilt"));
    let report = folder.path().canonicalize().expect("a path").join("r.json");
    assert_eq!(
        stdout.trim_end(),
        format!("9 replay quilt {} none", report.display()),
        "{stderr}"
    );
}

/// A stand-in for the layer: a script that writes what the layer would.
const WRITES: &str = r#"
for frame in 1 2 3; do echo "{\"frames\":$frame,\"notes\":[]}" > "$MANYVIEW_STATUS"; done
echo picture > "$MANYVIEW_CAPTURE_OUT.tmp"; mv "$MANYVIEW_CAPTURE_OUT.tmp" "$MANYVIEW_CAPTURE_OUT"
"#;

#[test]
fn capture_ends_the_program_when_the_picture_is_there() {
    support::library();
    let folder = tempdir().expect("a folder");
    let out = folder.path().join("a.png");
    fs::write(&out, "old").expect("written");
    let script = format!("sleep 0.2; {WRITES} echo $$ > pid; sleep 600");
    let (code, stdout, stderr) = run(capture(
        folder.path(),
        &["--out", "a.png", "--frame", "3"],
        &script,
    ));
    assert_eq!((code, stdout.as_str()), (0, ""), "{stderr}");
    assert_eq!(
        fs::read_to_string(&out).expect("a picture"),
        "picture\n",
        "not the old one"
    );
    let pid = fs::read_to_string(folder.path().join("pid")).unwrap_or_default();
    assert!(
        !Path::new("/proc").join(pid.trim()).join("stat").exists() || pid.is_empty(),
        "the program is gone"
    );
}

#[test]
fn capture_says_how_many_frames_a_program_has_shown() {
    support::library();
    let folder = tempdir().expect("a folder");
    let script = format!(
        "exec {} --api osmesa --frames 9",
        support::demo("gears").display()
    );
    for views in ["1", "3"] {
        let options = ["--out", "a.png", "--frame", "30", "--views", views];
        let (code, _, stderr) = run(capture(folder.path(), &options, &script));
        assert_eq!(code, 4, "{stderr}");
        assert!(
            stderr
                .contains("ended with status 0 after at least 9 frames; frame 30 was never shown"),
            "{views}: {stderr}"
        );
    }
}

#[test]
fn capture_says_how_far_a_program_got() {
    support::library();
    let folder = tempdir().expect("a folder");
    let script = r#"echo '{"frames":12,"notes":["no depth"]}' > "$MANYVIEW_STATUS""#;
    let (code, _, stderr) = run(capture(folder.path(), &["--out", "a.png"], script));
    assert_eq!(code, 4, "{stderr}");
    assert!(
        stderr.contains("ended with status 0 after at least 12 frames; frame 30 was never shown"),
        "{stderr}"
    );
    assert!(stderr.contains("note: no depth"), "{stderr}");
}

#[test]
fn capture_gives_up_and_ends_a_program_that_ignores_it() {
    support::library();
    let folder = tempdir().expect("a folder");
    let script = "trap '' TERM; while :; do sleep 0.1; done";
    let (code, _, stderr) = run(capture(
        folder.path(),
        &["--out", "a.png", "--timeout", "1"],
        script,
    ));
    assert_eq!((code, stderr.contains("within 1 s")), (4, true), "{stderr}");
}

#[test]
fn capture_of_several_frames_waits_for_the_last() {
    support::library();
    let folder = tempdir().expect("a folder");
    let script = "for n in 2 3 4; do echo x > a-00000$n.png; sleep 0.1; done; sleep 600";
    let (code, _, stderr) = run(capture(
        folder.path(),
        &["--out", "a.png", "--frames", "2..4"],
        script,
    ));
    assert_eq!(
        (code, stderr.contains("wrote 3 pictures")),
        (0, true),
        "{stderr}"
    );
}

fn capture<'a>(folder: &Path, options: &[&str], script: &str) -> &'a mut Command {
    // Leaked on purpose: it keeps the calls above on one line.
    let command = Box::leak(Box::new(manyview()));
    // DISPLAY is set but names no server: these scripts need none.
    command
        .current_dir(folder)
        .env("DISPLAY", ":4711")
        .arg("capture")
        .args(options);
    command.args(["--", "sh", "-c", script])
}

#[test]
fn capture_brings_its_own_screen_and_ends_it() {
    support::library();
    let folder = tempdir().expect("a folder");
    // The server is the other child of the command that has started this script.
    let find = "for p in /proc/[0-9]*; do grep -qsx Xvfb $p/comm && grep -qs \"^PPid:.$PPID$\" $p/status && echo ${p#/proc/} > server; done;";
    let script = format!("{find} {WRITES} sleep 600");
    let (code, _, stderr) =
        run(capture(folder.path(), &["--out", "a.png"], &script).env_remove("DISPLAY"));
    assert_eq!(code, 0, "{stderr}");
    // By its process: another server may have the number of the display by now.
    let server = fs::read_to_string(folder.path().join("server")).expect("a server");
    let server: u32 = server.trim().parse().expect("a process");
    let command = fs::read_to_string(format!("/proc/{server}/comm")).unwrap_or_default();
    assert!(!command.starts_with("Xvfb"), "{server} is gone");
}

#[test]
fn displays_lists_the_default_panel() {
    let (code, stdout, _) = run(manyview().arg("displays"));
    assert!(code == 0 && stdout.contains("huebner8"), "{stdout}");
    let (_, stdout, _) = run(manyview().args(["displays", "--json"]));
    let panels: serde_json::Value = serde_json::from_str(&stdout).expect("JSON");
    let panels = panels["built-in"].as_array();
    assert!(panels.is_some_and(|panels| !panels.is_empty()), "{stdout}");
}

#[test]
fn displays_show_what_follows_from_a_description() {
    let show = |display: &str| run(manyview().args(["displays", "show", display]));
    let (code, stdout, _) = show("slanted8");
    assert!(
        code == 0 && stdout.contains("8 subpixels") && stdout.contains("12.5288°"),
        "{stdout}"
    );
    let (code, stdout, _) = show("looking-glass-portrait");
    assert!(
        code == 0 && stdout.contains("8x6") && stdout.contains("1536x2048"),
        "{stdout}"
    );
    // 2 tan 20° / 47.
    assert!(
        stdout.contains("edges") && stdout.contains("20.0000°") && stdout.contains("0.015488"),
        "{stdout}"
    );
    let (_, stdout, _) = run(manyview().args(["displays", "show", "rows", "--json"]));
    let shown: serde_json::Value = serde_json::from_str(&stdout).expect("JSON");
    assert_eq!(shown["views"], "2");
    let (code, _, stderr) = show("no-such");
    assert!(code == 2 && stderr.contains("no-such"), "{stderr}");
}

#[test]
fn a_model_without_calibration_has_quilts_and_no_mask() {
    let mask = [
        "mask",
        "--display",
        "looking-glass-go",
        "--size",
        "64x64",
        "--out",
        "/dev/null",
    ];
    let (code, _, stderr) = run(manyview().args(mask));
    assert!(code == 2 && stderr.contains("calibration"), "{stderr}");
    let panel = [
        "run",
        "--display",
        "looking-glass-go",
        "--output",
        "panel",
        "--",
        "/no/such",
    ];
    let (code, _, stderr) = run(manyview().args(panel));
    assert!(code == 2 && stderr.contains("--output"), "{stderr}");
}

#[test]
fn masks_need_a_size_and_a_place() {
    let mask = |size: &'static str, out: &'static str| ["mask", "--size", size, "--out", out];
    refused(&mask("64", "m.png"), 2, "1920x1080");
    refused(
        &mask("64x32", "no-such-folder/m.png"),
        2,
        "there is no folder",
    );
}

#[test]
fn masks_are_written_as_16_bit_pictures() {
    let folder = tempdir().expect("a folder");
    let arguments = [
        "mask",
        "--display",
        "lenticular-5",
        "--size",
        "10x2",
        "--out",
        "m.png",
    ];
    let (code, stdout, stderr) = run(manyview().current_dir(&folder).args(arguments));
    assert_eq!((code, stdout.as_str()), (0, ""), "{stderr}");
    let image::DynamicImage::ImageRgb16(mask) =
        image::open(folder.path().join("m.png")).expect("a picture")
    else {
        panic!("16-bit RGB");
    };
    assert_eq!(mask.dimensions(), (10, 2));
    assert_eq!(mask.get_pixel(7, 1).0, [2; 3], "column 7 of 5 views");
}

#[test]
fn a_mask_file_with_more_views_than_asked_for_is_refused_before_the_start() {
    let folder = tempdir().expect("a folder");
    let mask = folder.path().join("m.png");
    let out = mask.to_str().expect("UTF-8");
    let (code, ..) = run(manyview().args([
        "mask",
        "--display",
        "lenticular-5",
        "--size",
        "10x2",
        "--out",
        out,
    ]));
    assert_eq!(code, 0);
    refused(
        &["run", "--display", out, "--views", "3", "--", "true"],
        2,
        "at least",
    );
    refused(
        &["run", "--display", "lenticular-300", "--", "true"],
        2,
        "from 1 to 256",
    );
}

#[test]
fn doctor_names_the_libraries() {
    support::library();
    let (_, stdout, stderr) = run(manyview().args(["doctor", "--json"]));
    let findings: serde_json::Value = serde_json::from_str(&stdout).expect("JSON");
    assert!(
        findings["libraries"]
            .as_array()
            .is_some_and(|l| !l.is_empty()),
        "{stdout}{stderr}"
    );
    refused(
        &["doctor", "--", "no-such-program-anywhere"],
        127,
        "not found",
    );
}

#[test]
fn a_former_name_is_told_in_one_line() {
    support::library();
    let told = |arguments: &[&str], variable: Option<(&str, &str)>| {
        let output = manyview()
            .args(arguments)
            .envs(variable)
            .args(["--", "/no/such/program"])
            .output()
            .expect("the command starts");
        assert_eq!(output.status.code(), Some(127), "{arguments:?}");
        let text = String::from_utf8(output.stderr).expect("UTF-8");
        let lines = text.lines().filter(|line| line.contains("now called"));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    let line = |old: &str, new: &str| {
        format!(
            "manyview: {old} is now called {new}; this version is the last one that takes the old name"
        )
    };
    let flag = line("--without", "--disable");
    assert_eq!(told(&["run", "--without", "frustum"], None), [flag]);
    let word = line("alike of --disable", "mono");
    assert_eq!(told(&["run", "--disable", "alike"], None), [word]);
    let variable = line("MANYVIEW_WITHOUT", "MANYVIEW_DISABLE_OPTIMISATIONS");
    let set = Some(("MANYVIEW_WITHOUT", "lists"));
    assert_eq!(told(&["run"], set), [variable]);
    assert_eq!(told(&["run", "--disable", "mono"], None), [""; 0]);
}
