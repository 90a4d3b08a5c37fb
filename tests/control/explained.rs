//! Frames that are explained on request.

use super::CAMERAS;
use super::running::{Running, same, until};
use crate::support::{own_screen, rgb};

/// The next frame is explained, then the program goes on as before.
#[test]
fn a_frame_is_explained_while_the_program_runs() {
    let screen = own_screen();
    let options = [&[("VIEWS", "3")][..], &CAMERAS[..]].concat();
    let mut running = Running::controlled(&screen, &options);
    let before = running.steady_window();
    let list = |name: &str| {
        let path = running.path(name);
        running.done(&["explain", path.to_str().expect("UTF-8")]);
        std::fs::read_to_string(path.with_extension("txt")).expect("a list")
    };
    let [first, second] = ["first.png", "second"].map(list);
    let classes = |list: &str| {
        let lines = list.lines().filter(|line| line.contains("class = "));
        lines.map(|line| line[30..].to_owned()).collect::<Vec<_>>()
    };
    assert!(
        !classes(&first).is_empty() && first.contains("scene"),
        "{first}"
    );
    assert_eq!(classes(&first), classes(&second));
    // As if it had been asked for at the start, with all traits of the draws.
    let path = running.path("started.png");
    let asked = ("EXPLAIN", path.to_str().expect("UTF-8"));
    let all = [&options[..], &[asked, ("EXPLAIN_FRAME", "2")]].concat();
    let mut started = Running::controlled(&screen, &all);
    let list = path.with_extension("txt");
    until("a list", || list.exists().then_some(()));
    started.end();
    let list = std::fs::read_to_string(list).expect("a list");
    assert_eq!(classes(&first), classes(&list));
    for name in ["first.png", "second.png"] {
        let picture = rgb(&running.path(name));
        assert!(picture.width() == 96 && picture.height() > 64, "{name}");
    }
    same(&running.steady_window(), &before, "explained");
    // One line, and nothing is left to be explained.
    let wrong = running.say(r#"{"explain": {"path": "/nowhere/here/why.png"}}"#);
    assert!(
        wrong["error"]
            .as_str()
            .is_some_and(|e| e.contains("is not written")),
        "{wrong}"
    );
    same(&running.steady_window(), &before, "not explained");
    assert_eq!(running.end(), (Some(0), String::new()));
}
