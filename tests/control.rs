//! `manyview ctl` and the socket behind it, with programs that draw until they are told to stop.

mod explained;
mod profiles;
pub(crate) mod running;

use crate::support::{
    Compiled, Screen, bare, compiled, extent, layered, own_screen, preloaded, rgb, run,
};
use image::RgbImage;
use running::{LIMIT, Running, ctl, same, stays, until};
use std::io::{BufRead, BufReader, Read, Write};
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::time::Duration;

/// Cameras far enough apart for a visible disparity in 96 pixels.
const CAMERAS: [(&str, &str); 2] = [("SEPARATION", "0.03"), ("CONVERGENCE", "8")];

/// A frame of a program that was started with these options.
fn started(screen: &Screen, options: &[(&str, &str)], what: &str) -> RgbImage {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("started.png");
    let mut all = vec![
        ("CAPTURE_OUT", out.to_str().expect("UTF-8")),
        ("CAPTURE_FRAMES", "3"),
        ("CAPTURE_WHAT", what),
    ];
    all.extend(options);
    let mut running = Running::start(screen, &all);
    until("a picture", || out.exists().then_some(()));
    running.end();
    rgb(&out)
}

#[test]
fn what_is_set_holds_for_the_next_frame() {
    let screen = own_screen();
    let wide = ("SEPARATION", "0.08");
    let eye = [("EYE_SPACING", "0.3"), ("FOCAL_DEPTH", "8")];
    for (strategy, views) in [("replay", "5"), ("instanced", "4"), ("geometry", "5")] {
        let base = [("VIEWS", views), ("STRATEGY", strategy)];
        let before = [&base[..], &CAMERAS[..]].concat();
        let mut running = Running::controlled(&screen, &before);
        let first = running.capture("atlas");
        same(&first, &started(&screen, &before, "atlas"), strategy);

        running.done(&["set", "separation", "0.08"]);
        let after = [&base[..], &[wide, CAMERAS[1]]].concat();
        let wider = running.capture("atlas");
        assert!(wider != first, "{strategy}");
        same(&wider, &started(&screen, &after, "atlas"), strategy);

        running.done(&["set", "hud-depth", "-0.5"]);
        let after = [&after[..], &[("HUD_DEPTH", "-0.5")]].concat();
        let nearer = running.capture("atlas");
        assert!(nearer != wider, "{strategy}");
        same(&nearer, &started(&screen, &after, "atlas"), strategy);

        running.done(&[
            "set",
            "eye-spacing",
            "0.3",
            "focal-depth",
            "8",
            "hud-depth",
            "0",
        ]);
        let after = [&base[..], &eye[..]].concat();
        let placed = running.capture("atlas");
        same(&placed, &started(&screen, &after, "atlas"), strategy);
        assert!(placed != wider, "{strategy}");
        assert_eq!(running.end(), (Some(0), String::new()));
    }
}

#[test]
fn a_program_that_draws_only_when_it_is_uncovered_answers() {
    let screen = own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let options = [&[("CONTROL", "1"), ("VIEWS", "5")][..], &CAMERAS].concat();
    let mut program = layered(running::stays(), &options);
    let running = Running::start_in(folder, &screen, program.env("IDLE", "1"));
    until("a socket", || running.socket().exists().then_some(()));
    let idle = running.capture("view:0");
    assert_eq!(running.done(&["get", "views"]), "5\n");
    let drawn = Running::controlled(&screen, &options).capture("view:0");
    same(&idle, &drawn, "view 0");
}

#[test]
fn what_is_set_holds_for_contexts_that_show_nothing_themselves() {
    let screen = own_screen();
    let program = compiled("widget", Compiled::Program, &["-lEGL", "-lGL"]);
    let options = [
        ("VIEWS", "3"),
        ("CONTROL", "1"),
        ("SEPARATION", "0.2"),
        ("CONVERGENCE", "2"),
    ];
    let folder = tempfile::tempdir().expect("a folder");
    let mut running = Running::start_in(folder, &screen, &mut layered(program, &options));
    until("a socket", || running.socket().exists().then_some(()));
    // A surface at depth 1 moves by 32 columns times the separation.
    for (separation, wanted) in [("0.2", 6.4), ("0.1", 3.2)] {
        running.done(&["set", "separation", separation]);
        let all = running.capture("atlas");
        let [left, own] = [0, 1].map(|view| extent(&all, 3, view, [0, 255, 0]));
        assert!(
            (left[0] - own[0] - wanted).abs() <= 1.5,
            "{left:?}, {own:?}"
        );
    }
    running.end();
}

#[test]
fn another_output_is_shown_as_if_started_with_it() {
    let screen = own_screen();
    let base = [&[("VIEWS", "5")][..], &CAMERAS[..]].concat();
    let mut running = Running::controlled(&screen, &base);
    let panel = running.steady_window();
    for output in ["rows", "checker", "view:1", "anaglyph", "sbs", "panel"] {
        running.done(&["set", "output", output]);
        let with = [&base[..], &[("OUTPUT", output)]].concat();
        let other = Running::start(&screen, &with);
        let expected = other.steady_window();
        drop(other);
        same(&running.steady_window(), &expected, output);
        let captured = running.capture("output");
        same(&captured, &started(&screen, &with, "output"), output);
    }
    same(&running.steady_window(), &panel, "panel again");
    assert_eq!(running.end(), (Some(0), String::new()));
}

#[test]
fn quad_is_not_for_a_window_without_stereo() {
    let screen = own_screen();
    let mut running = Running::controlled(&screen, &[("VIEWS", "3")]);
    let (code, _, stderr) = running.ctl(&["set", "output", "quad", "hud-depth", "0.25"]);
    assert_eq!(code, 2);
    assert!(
        stderr.contains("output is 'quad', but the window has no left and right buffer")
            && stderr.contains("choose another output"),
        "{stderr}"
    );
    assert_eq!(running.done(&["get", "output"]), "panel\n");
    assert_eq!(running.done(&["get", "hud-depth"]), "0.0\n");
    assert_eq!(running.end(), (Some(0), String::new()));
    // Values other than those of the start can be set.
    let mut running = Running::controlled(&screen, &[("OUTPUT", "quad")]);
    assert_eq!(running.done(&["get", "views"]), "2\n");
    running.done(&["set", "hud-depth", "0.25"]);
    running.done(&["set", "output", "half-sbs"]);
    assert_eq!(running.ctl(&["set", "output", "quad"]).0, 2);
    assert_eq!(running.end(), (Some(0), String::new()));
}

/// A library stands for a driver with stereo windows; X shows their left buffer.
#[test]
fn quad_goes_and_comes_back_where_the_window_has_stereo() {
    let screen = own_screen();
    let base = [&[("VIEWS", "3")][..], &CAMERAS[..]].concat();
    let shown = |output| {
        let with = [&base[..], &[("OUTPUT", output)]].concat();
        Running::start(&screen, &with).steady_window()
    };
    let (first, beside) = (shown("view:0"), shown("half-sbs"));
    let driver = compiled("stereo", Compiled::Library, &["-ldl"]);
    let preload = format!("{}:{}", preloaded(), driver.display());
    let with = [&base[..], &[("CONTROL", "1"), ("OUTPUT", "quad")]].concat();
    let mut command = layered(stays(), &with);
    let folder = tempfile::tempdir().expect("a folder");
    let mut running = Running::start_in(folder, &screen, command.env("LD_PRELOAD", preload));
    until("a socket", || running.socket().exists().then_some(()));
    same(&running.steady_window(), &first, "the left eye");
    running.done(&["set", "output", "half-sbs"]);
    same(&running.steady_window(), &beside, "another output");
    running.done(&["set", "output", "quad"]);
    same(&running.steady_window(), &first, "the left eye again");
    assert_eq!(running.end(), (Some(0), String::new()));
}

#[test]
fn get_says_what_is_in_force() {
    let screen = own_screen();
    let mut running = Running::controlled(&screen, &[("VIEWS", "5")]);
    // The focal depth that the layer chose: between near 1 and far 50.
    let chosen: f64 = running
        .done(&["get", "convergence"])
        .trim()
        .parse()
        .expect("a number");
    assert!((chosen - 50f64.sqrt()).abs() < 1e-3, "{chosen}");
    assert_eq!(running.done(&["get", "separation"]), "0.01\n");
    running.done(&["set", "separation", "0.03", "output", "view:3"]);
    assert_eq!(
        running.done(&["get"]),
        format!(
            "auto-depth = 0\nconvergence = {chosen}\nhud-depth = 0.0\nlayer = on\noutput = view:3\nseparation = 0.03\nviews = 5\n"
        )
    );
    running.done(&[
        "set",
        "eye-spacing",
        "0.2",
        "focal-depth",
        "9",
        "hud-depth",
        "0.25",
    ]);
    running.done(&["toggle"]);
    assert_eq!(
        running.done(&["get"]),
        "auto-depth = 0\neye-spacing = 0.2\nfocal-depth = 9.0\nhud-depth = 0.25\nlayer = off\noutput = view:3\nviews = 5\n"
    );
    let (code, _, stderr) = running.ctl(&["get", "separation"]);
    assert_eq!(code, 2);
    assert!(stderr.contains("eye-spacing and focal-depth"), "{stderr}");
    assert_eq!(running.end(), (Some(0), String::new()));
}

#[test]
fn toggle_shows_the_programs_own_picture_and_all_views_again() {
    let screen = own_screen();
    let own = {
        let folder = tempfile::tempdir().expect("a folder");
        let running = Running::start_in(folder, &screen, &mut bare(stays()));
        running.steady_window()
    };
    for views in ["4", "5"] {
        let options = [&[("VIEWS", views)][..], &CAMERAS[..]].concat();
        let mut running = Running::controlled(&screen, &options);
        let panel = running.steady_window();
        assert!(panel != own, "{views}");
        assert_eq!(running.done(&["toggle"]), "layer = off\n");
        same(&running.steady_window(), &own, views);
        same(&running.capture("output"), &own, views);
        assert_eq!(running.done(&["toggle"]), "layer = on\n");
        same(&running.steady_window(), &panel, views);
        assert_eq!(running.end(), (Some(0), String::new()));
    }
}

#[test]
fn pictures_are_whole_files() {
    let screen = own_screen();
    let running = Running::controlled(&screen, &[("VIEWS", "5")]);
    assert_eq!(running.capture("output").dimensions(), (96, 64));
    assert_eq!(running.capture("atlas").dimensions(), (5 * 96, 64));
    assert_eq!(running.capture("view:4").dimensions(), (96, 64));
    let depth = running.path("depth.png");
    let mut command = ctl(running.folder.path());
    // Paths are relative to the folder of `ctl`, not to that of the program.
    command.current_dir(running.folder.path());
    let (code, _, stderr) = run(command.args(["capture", "depth.png", "--what", "depth"]));
    assert_eq!(code, 0, "{stderr}");
    assert!(stderr.contains(depth.to_str().expect("UTF-8")), "{stderr}");
    let depth = image::open(depth).expect("a picture");
    assert_eq!(depth.color(), image::ColorType::L16);
    let frame = |answer: &serde_json::Value| answer["captured"]["frame"].as_u64().expect("a frame");
    let path = running.path("numbered-%d.png");
    let line = format!(r#"{{"capture": {{"path": "{}"}}}}"#, path.display());
    let (first, second) = (running.say(&line), running.say(&line));
    assert!(frame(&first) < frame(&second), "{first} {second}");
    assert!(
        running
            .path(&format!("numbered-{}.png", frame(&second)))
            .is_file()
    );
    let left: Vec<_> = std::fs::read_dir(running.folder.path())
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|e| e == "tmp"))
        .collect();
    assert!(left.is_empty(), "{left:?}");
    running.done(&["set", "output", "quilt"]);
    let mut command = ctl(running.folder.path());
    command.current_dir(running.folder.path());
    let (_, stdout, _) = run(command.args(["capture", "views.png"]));
    let name = running.path("views_qs3x2a1.5.png");
    assert_eq!(stdout.trim_end(), name.to_str().expect("UTF-8"));
    assert_eq!(rgb(&name).dimensions(), (3 * 96, 2 * 64));
}

#[test]
fn what_is_wrong_changes_nothing_and_is_explained_by_one_sentence() {
    let screen = own_screen();
    let options = [&[("VIEWS", "5")][..], &CAMERAS[..]].concat();
    let mut running = Running::controlled(&screen, &options);
    let (atlas, values) = (running.capture("atlas"), running.done(&["get"]));
    let nowhere = running.path("no/such/folder.png");
    for (arguments, part) in [
        (&["set", "separation", "wide"][..], "separation is 'wide'"),
        (
            &["set", "separation", "0.1", "hud-depth", "7"],
            "hud-depth is '7'",
        ),
        (&["set", "separation"], "2 values required"),
        (
            &["set", "separation", "0.1", "convergence"],
            "'convergence' has no value",
        ),
        (&["set", "focal-depth", "3"], "eye-spacing is missing"),
        (&["set", "focal-depth", "-3", "eye-spacing", "1"], "above 0"),
        (&["set", "output", "view:5"], "view 5 of 5"),
        (&["set", "views", "3"], "'views' cannot be set"),
        (&["get", "strategy"], "no value 'strategy'"),
        (
            &["capture", "a.png", "--what", "sound"],
            "capture-what is 'sound'",
        ),
        (
            &["capture", nowhere.to_str().expect("UTF-8")],
            "is not written",
        ),
    ] {
        let (code, stdout, stderr) = running.ctl(arguments);
        assert_eq!((code, &*stdout), (2, ""), "{arguments:?}: {stderr}");
        assert!(stderr.contains(part), "{arguments:?}: {stderr}");
        // Mistakes of the command line are reported by clap.
        assert!(
            stderr.lines().count() == 1 || part.contains("required"),
            "{stderr}"
        );
    }
    for line in [
        "",
        "hello",
        "{}",
        "[1]",
        r#"{"get": 1}"#,
        r#"{"capture": {"path": "a.png"}}"#,
    ] {
        let answer = running.say(line);
        assert!(answer["error"].is_string(), "{line}: {answer}");
    }
    assert_eq!(running.done(&["get"]), values);
    same(&running.capture("atlas"), &atlas, "as before");
    assert_eq!(running.end(), (Some(0), String::new()));
}

#[test]
fn rude_askers_do_no_harm() {
    let screen = own_screen();
    let mut running = Running::controlled(&screen, &[("VIEWS", "5")]);
    // The client leaves before the answer comes: no SIGPIPE.
    for _ in 0..20 {
        let mut stream = running.connect();
        stream
            .write_all(b"{\"get\": \"all\"}\n{\"get\": \"all\"}\n")
            .expect("sent");
    }
    // A line that never ends.
    let mut endless = running.connect();
    let _ = endless.write_all(&[b'x'; 100_000]);
    let mut answer = String::new();
    let _ = BufReader::new(&endless).read_line(&mut answer);
    assert!(answer.contains("more than 4096 bytes"), "{answer}");
    drop(endless);
    // A line in pieces, then the end of the stream.
    let mut pieces = running.connect();
    for piece in ["{\"get\"", ": \"views\"}", "\n{\"get\": \"vie", "ws\"}\n"] {
        pieces.write_all(piece.as_bytes()).expect("sent");
        std::thread::sleep(Duration::from_millis(20));
    }
    pieces.shutdown(std::net::Shutdown::Write).expect("shut");
    let mut answers = String::new();
    pieces.read_to_string(&mut answers).expect("answers");
    assert_eq!(answers, "{\"values\":{\"views\":5}}\n".repeat(2));
    // More clients than there is room for; the program goes on serving the others.
    let mut crowd: Vec<_> = (0..9).map(|_| running.connect()).collect();
    let mut turned_away = String::new();
    crowd[8]
        .read_to_string(&mut turned_away)
        .expect("an answer");
    assert!(turned_away.contains("listens to 8 others"), "{turned_away}");
    writeln!(crowd[0], "{{\"get\": \"views\"}}").expect("sent");
    let mut served = String::new();
    BufReader::new(&crowd[0])
        .read_line(&mut served)
        .expect("an answer");
    assert_eq!(served, "{\"values\":{\"views\":5}}\n");
    drop(crowd);
    until("room again", || {
        (running.ctl(&["get"]).0 == 0).then_some(())
    });
    assert_eq!(running.end(), (Some(0), String::new()));
}

#[test]
fn only_the_user_can_open_the_socket_and_it_goes_with_the_last_context() {
    let screen = own_screen();
    let mut running = Running::controlled(&screen, &[("VIEWS", "5")]);
    let socket = running.socket();
    let mode = |path: &Path| std::fs::metadata(path).expect("there").mode() & 0o7777;
    assert_eq!(mode(&socket), 0o600);
    assert_eq!(mode(socket.parent().expect("a folder")), 0o700);
    assert_eq!(running.end(), (Some(0), String::new()));
    assert!(!socket.exists());
}

#[test]
fn without_being_asked_for_there_is_no_socket() {
    let screen = own_screen();
    for options in [&[("VIEWS", "5")][..], &[("VIEWS", "5"), ("CONTROL", "0")]] {
        let mut running = Running::start(&screen, options);
        // Lets the program show some frames.
        running.window();
        running.window();
        assert!(!running.path("manyview").exists());
        let (code, _, stderr) = running.ctl(&["get"]);
        assert_eq!((code, stderr.lines().count()), (3, 1), "{stderr}");
        assert_eq!(running.end(), (Some(0), String::new()));
    }
}

#[test]
fn in_a_folder_that_others_can_enter_there_is_no_socket() {
    let screen = own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let (inside, file) = (folder.path().join("manyview"), folder.path().join("report"));
    std::fs::create_dir(&inside).expect("made");
    std::fs::set_permissions(&inside, std::fs::Permissions::from_mode(0o755)).expect("set");
    let report = file.to_str().expect("UTF-8");
    let options = [("VIEWS", "5"), ("CONTROL", "1"), ("REPORT", report)];
    let mut command = layered(stays(), &options);
    let mut running = Running::start_in(folder, &screen, &mut command);
    running.window();
    let (code, _, stderr) = running.ctl(&["get"]);
    assert_eq!((code, stderr.lines().count()), (2, 1), "{stderr}");
    assert!(std::fs::read_dir(&inside).expect("there").next().is_none());
    let report = until("a report", || {
        let report = std::fs::read_to_string(&file).ok()?;
        report.contains("has mode 755").then_some(report)
    });
    assert_eq!(report.matches("has mode 755").count(), 1);
    let (code, said) = running.end();
    assert_eq!(code, Some(0));
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(said.contains("has mode 755"), "{said}");
}

#[test]
fn the_command_finds_the_program_and_clears_what_dead_ones_left() {
    let screen = own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let inside = folder.path().join("manyview");
    let (code, _, stderr) = run(ctl(folder.path()).arg("get"));
    assert_eq!((code, stderr.lines().count()), (3, 1), "{stderr}");
    drop(folder);

    let mut running = Running::controlled(&screen, &[("VIEWS", "5")]);
    // A listener that is dropped leaves its file, as a program that is killed does.
    let stale = running.path("manyview/1.sock");
    drop(std::os::unix::net::UnixListener::bind(&stale).expect("bound"));
    assert!(stale.exists() && !inside.exists());
    assert!(running.done(&["get"]).contains("views = 5"));
    assert!(!stale.exists());
    assert!(running.socket().exists());

    let pid = running.pid().to_string();
    assert!(running.done(&["--pid", &pid, "get"]).contains("views = 5"));
    let (code, _, stderr) = running.ctl(&["--pid", "1", "get"]);
    assert_eq!((code, stderr.lines().count()), (3, 1), "{stderr}");

    // A second program beside the first.
    let mut command = layered(stays(), &[("VIEWS", "3"), ("CONTROL", "1")]);
    command
        .arg(running.path("stop"))
        .env("XDG_RUNTIME_DIR", running.folder.path());
    let mut second = screen.give(&mut command).spawn().expect("it starts");
    let socket = running.path(&format!("manyview/{}.sock", second.id()));
    until("a second socket", || socket.exists().then_some(()));
    let (code, _, stderr) = running.ctl(&["get"]);
    assert_eq!((code, stderr.lines().count()), (2, 1), "{stderr}");
    for id in [running.pid(), second.id()] {
        assert!(stderr.contains(&format!("{id} (stays)")), "{stderr}");
    }
    let other = second.id().to_string();
    assert_eq!(running.done(&["--pid", &other, "get", "views"]), "3\n");
    assert_eq!(running.end(), (Some(0), String::new()));
    assert!(second.wait().expect("it ends").success());
}

#[test]
fn a_child_of_the_program_does_not_answer_in_its_place() {
    let program = compiled("splits", Compiled::Program, &["-lOSMesa"]);
    let folder = tempfile::tempdir().expect("a folder");
    let (gone, stop) = (folder.path().join("gone"), folder.path().join("stop"));
    let mut command = layered(program, &[("VIEWS", "5"), ("CONTROL", "1")]);
    command
        .args([&gone, &stop])
        .env("XDG_RUNTIME_DIR", folder.path());
    let mut parent = command.spawn().expect("it starts");
    let socket = folder.path().join(format!("manyview/{}.sock", parent.id()));
    until("a socket", || socket.exists().then_some(()));
    let mut stream = UnixStream::connect(&socket).expect("it listens");
    writeln!(stream, "{{\"get\": \"views\"}}").expect("sent");
    // Only the child draws until `gone` exists: about a hundred frames in this time.
    let short = Some(Duration::from_millis(700));
    stream.set_read_timeout(short).expect("a limit");
    assert!(stream.read(&mut [0; 1]).is_err(), "nobody answers");
    std::fs::write(&gone, "").expect("written");
    stream.set_read_timeout(Some(LIMIT)).expect("a limit");
    let mut answer = String::new();
    BufReader::new(stream)
        .read_line(&mut answer)
        .expect("an answer");
    assert_eq!(answer, "{\"values\":{\"views\":5}}\n");
    assert!(socket.exists(), "the child has not removed it");
    std::fs::write(&stop, "").expect("written");
    assert!(parent.wait().expect("it ends").success());
    assert!(!socket.exists(), "the parent has");
}

#[test]
fn another_user_is_not_heard() {
    let screen = own_screen();
    let mut running = Running::controlled(&screen, &[("VIEWS", "5")]);
    let speaks = compiled("speaks", Compiled::Program, &[]);
    let copy = running.path("speaks");
    std::fs::copy(speaks, &copy).expect("copied");
    // Opens the folders to everybody, so that only the socket itself is left to refuse.
    let open = |path: &Path| {
        std::fs::set_permissions(path, std::fs::Permissions::from_mode(0o777)).expect("set");
    };
    for path in [
        running.folder.path(),
        &running.path("manyview"),
        &running.socket(),
    ] {
        open(path);
    }
    let line = r#"{"get": "views"}"#;
    let own = run(bare(&copy).arg(running.socket()).arg(line));
    assert_eq!(
        own,
        (0, "{\"values\":{\"views\":5}}\n".to_owned(), String::new())
    );
    let mut command = bare("setpriv");
    command
        .args(["--reuid=65534", "--regid=65534", "--clear-groups"])
        .arg(&copy)
        .arg(running.socket())
        .arg(line);
    let (code, stdout, stderr) = run(&mut command);
    if stderr.contains("setpriv:") {
        eprintln!("skipped: only root can be somebody else: {stderr}");
    } else {
        assert_eq!(
            (code, &*stdout, &*stderr),
            (0, "", ""),
            "connected, and not answered"
        );
    }
    assert_eq!(running.end(), (Some(0), String::new()));
}

#[test]
fn a_sheet_is_fitted_while_the_program_runs() {
    let screen = own_screen();
    let base = [&[("DISPLAY", "slanted8")][..], &CAMERAS[..]].concat();
    let mut running = Running::controlled(&screen, &base);
    let before = running.steady_window();
    assert_eq!(running.done(&["get", "slant"]), "2/3\n");
    running.done(&["set", "pitch", "7.5", "slant", "-0.25", "offset", "3"]);
    assert_eq!(running.done(&["get", "pitch"]), "7.5\n");

    let panel = running.path("panel.toml");
    let text = "kind = \"slanted\"\nviews = 8\npitch = 7.5\nslant = -0.25\noffset = 3\n";
    std::fs::write(&panel, text).expect("written");
    let file = [("DISPLAY", panel.to_str().expect("UTF-8"))];
    let with = [&file[..], &CAMERAS[..]].concat();
    let other = Running::start(&screen, &with);
    let expected = other.steady_window();
    drop(other);
    assert!(expected != before, "another sheet is another picture");
    same(&running.steady_window(), &expected, "fitted");
    let (code, _, refused) = running.ctl(&["set", "pitch", "-1", "offset", "0"]);
    assert_eq!(code, 2);
    assert!(refused.contains("pitch is '-1'; give "), "{refused}");
    running.done(&["set", "pitch", "8", "slant", "2/3", "offset", "1"]);
    same(&running.steady_window(), &before, "as it was");
    assert_eq!(running.end(), (Some(0), String::new()));

    let mut other = Running::controlled(&screen, &CAMERAS);
    let (code, _, refused) = other.ctl(&["set", "pitch", "8"]);
    assert_eq!(code, 2);
    assert!(refused.contains("display `huebner8` is none"), "{refused}");
    let (code, _, refused) = other.ctl(&["get", "pitch"]);
    assert_eq!(code, 2);
    assert!(refused.contains("no slanted lens sheet"), "{refused}");
    assert_eq!(other.end(), (Some(0), String::new()));
}
