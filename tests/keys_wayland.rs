//! `--keys` in a program of Wayland: one more keyboard of the program's own connection gets what the program gets.

use crate::support::wayland::{Compositor, Monitor, has_sway};
use crate::support::{has, library, manyview};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const MONITOR: Monitor = Monitor {
    size: (640, 480),
    turned: "normal",
    scale: "1",
};
const LIMIT: Duration = Duration::from_secs(30);
/// Of Mesa's programs, one for Wayland.
const PROGRAM: &str = "es2gears_wayland";

#[test]
fn keys_of_a_compositor_change_the_views() {
    if !has_sway() || !has("wtype") || !has(PROGRAM) {
        eprintln!(
            "skipped: sway, grim, wtype or {PROGRAM} is missing (Debian packages of these names, and mesa-utils-bin)"
        );
        return;
    }
    library();
    let compositor = Compositor::sway(&[MONITOR]);
    let home = tempfile::tempdir().expect("a folder");
    let mut command = manyview();
    command.args([
        "run",
        "--views",
        "3",
        "--display",
        "huebner8",
        "--control",
        "--keys",
    ]);
    command.args([
        "--separation",
        "0.03",
        "--convergence",
        "8",
        "--bind",
        "F9=hold:toggle",
    ]);
    command.arg("--").arg(PROGRAM).env("HOME", home.path());
    let child = compositor.give(&mut command).stdout(Stdio::null());
    let child = child.stderr(Stdio::piped()).spawn().expect("manyview");
    let value = |name: &str| {
        let mut command = manyview();
        command.args(["ctl", "get", name]).env("HOME", home.path());
        let output = compositor.give(&mut command).output().expect("manyview");
        String::from_utf8(output.stdout)
            .expect("UTF-8")
            .trim()
            .to_owned()
    };
    let type_keys = |words: &[&str]| {
        let mut command = Command::new("wtype");
        // The keyboard is there while wtype is, and the program learns of it by its next frames.
        let typed = compositor.give(&mut command).args(["-s", "1500"]);
        let status = typed.args(words).args(["-s", "300"]).status();
        assert!(status.expect("wtype").success(), "{words:?}");
    };
    let until = |what: &str, wanted: &str, name: &str| {
        let limit = Instant::now() + LIMIT;
        while value(name) != wanted {
            assert!(
                Instant::now() < limit,
                "{what}: {} is no {wanted}",
                value(name)
            );
            std::thread::sleep(Duration::from_millis(100));
        }
    };
    until("the program runs", "0.03", "separation");
    type_keys(&["-k", "Page_Up"]);
    type_keys(&["-M", "ctrl", "-M", "alt", "-k", "Page_Up"]);
    until("with Ctrl and Alt alone", "0.033", "separation");
    std::thread::scope(|scope| {
        let held = scope.spawn(|| type_keys(&["-P", "F9", "-s", "3000", "-p", "F9"]));
        until("while it is held", "off", "layer");
        held.join().expect("typed");
    });
    until("let go", "on", "layer");
    // It is forwarded to the program, which holds the pipe as well.
    let pid = rustix::process::Pid::from_child(&child);
    let _ = rustix::process::kill_process(pid, rustix::process::Signal::TERM);
    let output = child.wait_with_output().expect("ended");
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!told.contains("keys are off"), "{told}");
}
