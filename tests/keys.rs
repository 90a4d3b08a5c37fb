//! `--keys`: keys that change the views of a running program, which receives them as well.

use crate::control::running::{Running, same, until};
use crate::support::x::{ALT, CONTROL, User};
use crate::support::{Screen, own_screen, rgb};
use std::path::PathBuf;

const PAGE_UP: u32 = 0xff55;
const PAGE_DOWN: u32 = 0xff56;
const HOME: u32 = 0xff50;
const END: u32 = 0xff57;
const CAMERAS: [(&str, &str); 2] = [("SEPARATION", "0.03"), ("CONVERGENCE", "8")];

/// A program, the user before it, and its window, which has no focus yet.
fn start(screen: &Screen, options: &[(&str, &str)]) -> (Running, User, u32) {
    let all = [options, &CAMERAS[..]].concat();
    let running = Running::controlled(screen, &all);
    let user = User::at(screen.display());
    let window = until("a window", || user.windows().first().copied());
    // The first frame opens the keys, and an answer comes after a frame.
    running.done(&["get"]);
    (running, user, window)
}

fn value(running: &Running, name: &str) -> String {
    running.done(&["get", name]).trim().to_owned()
}

fn letter(letter: char) -> u32 {
    u32::from(letter)
}

#[test]
fn keys_change_the_views_and_the_program_gets_them() {
    let screen = own_screen();
    let (mut running, user, window) = start(&screen, &[("KEYS", "1")]);
    let separation = || value(&running, "separation");
    let press = |key| user.press(&[CONTROL, ALT, key]);
    press(PAGE_UP);
    assert_eq!(separation(), "0.03", "the keys are somebody else's");
    let other = user.open(user.root);
    user.focus(other);
    press(PAGE_UP);
    assert_eq!(separation(), "0.03", "another window has the keys");

    user.focus(window);
    user.press(&[PAGE_UP]);
    user.press(&[CONTROL, PAGE_UP]);
    user.press(&[ALT, PAGE_UP]);
    assert_eq!(separation(), "0.03", "not both of Ctrl and Alt");
    press(PAGE_UP);
    assert_eq!(separation(), "0.033");
    press(PAGE_DOWN);
    press(PAGE_DOWN);
    assert_eq!(separation(), "0.0272727");
    press(HOME);
    assert_eq!(value(&running, "convergence"), "8.8");
    press(END);
    assert_eq!(value(&running, "convergence"), "8.0");
    press(letter('k'));
    assert_eq!(value(&running, "hud-depth"), "0.05");
    press(letter('j'));
    press(letter('j'));
    assert_eq!(value(&running, "hud-depth"), "-0.05");
    press(letter('o'));
    assert_eq!(value(&running, "output"), "quilt");
    press(letter('m'));
    assert_eq!(value(&running, "layer"), "off");
    press(letter('m'));
    assert_eq!(value(&running, "layer"), "on");

    let inside = user.open(window);
    user.focus(inside);
    press(PAGE_UP);
    assert_eq!(separation(), "0.03", "a window within the program's");

    let got = std::fs::read_to_string(running.path("keys")).expect("keys");
    let got: Vec<_> = got.lines().filter(|key| !key.starts_with("ffe")).collect();
    // The last key went to the inner window, which is ours: X sends it to nobody else.
    let expected = [
        "ff55", "ff55", "ff55", "ff55", "ff56", "ff56", "ff50", "ff57", "6b", "6a", "6a", "6f",
        "6d", "6d",
    ];
    assert_eq!(got, expected, "all that was pressed while it had the keys");
    assert_eq!(running.end(), (Some(0), String::new()));
}

#[test]
fn a_picture_is_named_by_program_time_and_frame() {
    let screen = own_screen();
    let (mut running, user, window) = start(&screen, &[("KEYS", "1")]);
    user.focus(window);
    let before = running.capture("output");
    user.press(&[CONTROL, ALT, letter('c')]);
    let written = || -> Option<PathBuf> {
        let files = std::fs::read_dir(running.folder.path())
            .expect("a folder")
            .flatten();
        let mut paths = files.map(|file| file.path());
        paths.find(|path| path.extension().is_some_and(|extension| extension == "png"))
    };
    let path = until("a picture", written);
    let name = path
        .file_name()
        .expect("a name")
        .to_string_lossy()
        .into_owned();
    let parts: Vec<_> = name.trim_end_matches(".png").split('-').collect();
    assert!(
        matches!(parts[..], ["stays", day, time, frame] if day.len() == 8 && time.len() == 6 && frame.len() == 6),
        "{name}"
    );
    same(&rgb(&path), &before, "the picture");
    let (code, said) = running.end();
    assert_eq!((code, said.lines().count()), (Some(0), 1), "{said}");
    assert!(
        said.starts_with("manyview: wrote ") && said.contains(&name),
        "{said}"
    );
}

#[test]
fn keys_are_bound_anew_and_a_preset_lasts_as_long_as_its_key() {
    const F9: u32 = 0xffc6;
    const F10: u32 = 0xffc7;
    let screen = own_screen();
    let options = [
        ("BIND", "F9=toggle,F10=hold:preset:2,Ctrl+Alt+m=none"),
        ("PRESETS", "0.05:4,0.06:16"),
        ("RAMP", "0"),
    ];
    let (mut running, user, window) = start(&screen, &options);
    user.focus(window);
    let separation = || value(&running, "separation");
    user.press(&[F9]);
    assert_eq!(value(&running, "layer"), "off");
    user.press(&[CONTROL, F9]);
    assert_eq!(value(&running, "layer"), "off", "another key");
    user.press(&[F9]);
    user.press(&[CONTROL, ALT, letter('m')]);
    assert_eq!(value(&running, "layer"), "on", "nothing is bound to it");
    user.hold(F10, true);
    assert_eq!(separation(), "0.06");
    assert_eq!(value(&running, "convergence"), "16.0");
    user.hold(F10, false);
    assert_eq!(separation(), "0.03", "as before");
    // The next one, and round.
    for wanted in ["0.05", "0.06", "0.05"] {
        user.press(&[CONTROL, ALT, letter('p')]);
        assert_eq!(separation(), wanted);
    }
    running.done(&["preset", "2"]);
    assert_eq!(separation(), "0.06");
    assert_eq!(running.end(), (Some(0), String::new()));
}

#[test]
fn without_the_option_nothing_is_opened_and_nothing_happens() {
    let screen = own_screen();
    let sockets = |running: &Running| {
        let folder = format!("/proc/{}/fd", running.pid());
        let links = std::fs::read_dir(folder).expect("a folder").flatten();
        let targets = links.filter_map(|link| std::fs::read_link(link.path()).ok());
        let open = targets.filter(|to| to.to_string_lossy().starts_with("socket:"));
        open.count()
    };
    // The sockets of `manyview ctl`, which has just been answered, close in one of the next frames.
    let sockets = |running: &Running| {
        let samples = (0..20).map(|_| {
            std::thread::sleep(std::time::Duration::from_millis(25));
            sockets(running)
        });
        samples.min().expect("samples")
    };
    let (mut with, _, _) = start(&screen, &[("KEYS", "1")]);
    let most = sockets(&with);
    assert_eq!(with.end(), (Some(0), String::new()));
    let (mut running, user, window) = start(&screen, &[]);
    assert_eq!(sockets(&running) + 1, most, "one connection more with keys");
    user.focus(window);
    user.press(&[CONTROL, ALT, PAGE_UP]);
    assert_eq!(value(&running, "separation"), "0.03");
    assert_eq!(running.end(), (Some(0), String::new()));
}
