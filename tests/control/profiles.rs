//! `manyview profile`: rules that are read again, values that are written.

use super::running::{Running, same, stays, until};
use super::{CAMERAS, started};
use crate::support::{layered, own_screen};

#[test]
fn rules_are_read_again() {
    let screen = own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("rules.toml");
    let file = path.to_str().expect("UTF-8");
    let write = |text: &str| std::fs::write(&path, text).expect("written");
    let options = [&[("VIEWS", "5"), ("PROFILE", file)][..], &CAMERAS].concat();
    write("hud-depth = 0\n");
    let running = Running::controlled(&screen, &options);
    let before = running.capture("view:0");

    write("hud-depth = -0.5\nrule = [{ projection = \"perspective\", class = \"flat\" }]\n");
    running.done(&["profile", "reload"]);
    let after = running.capture("view:0");
    assert!(before != after, "the scene moves as before");
    same(&after, &started(&screen, &options, "view:0"), "view 0");

    write("rule = [{ class = \"round\" }]\n");
    let (code, _, said) = running.ctl(&["profile", "reload"]);
    assert_eq!(code, 2);
    assert!(said.contains("rule 1: class is 'round'"), "{said}");
    same(&running.capture("view:0"), &after, "the rules before");
}

#[test]
fn values_are_written_into_the_profile_of_the_program() {
    let screen = own_screen();
    let home = tempfile::tempdir().expect("a folder");
    let options = [&[("VIEWS", "5"), ("CONTROL", "1")][..], &CAMERAS].concat();
    let run = || {
        let mut program = layered(stays(), &options);
        program.env("XDG_CONFIG_HOME", home.path());
        let folder = tempfile::tempdir().expect("a folder");
        let running = Running::start_in(folder, &screen, &mut program);
        until("a socket", || running.socket().exists().then_some(()));
        running
    };
    let first = run();
    let (code, _, said) = first.ctl(&["profile", "reload"]);
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("the program has no profile"), "{said}");
    first.done(&["set", "hud-depth", "-0.5"]);
    let (_, _, said) = first.ctl(&["profile", "save"]);
    let saved = home.path().join("manyview/profiles/stays.toml");
    assert!(said.contains(&saved.display().to_string()), "{said}");
    assert!(
        said.contains("separation, convergence"),
        "what it lacks: {said}"
    );
    let text = std::fs::read_to_string(&saved).expect("a profile");
    assert!(
        text.contains("executable = \"stays\"\nhud-depth = -0.5\n"),
        "{text}"
    );

    // A rule by hand stays when values are written again.
    let rule = "rule = [{ class = \"scene\", projection = \"perspective\" }] # all\n";
    std::fs::write(&saved, text + rule).expect("written");
    let second = run();
    assert_eq!(second.done(&["get", "hud-depth"]), "-0.5\n");
    second.done(&["set", "hud-depth", "0.25"]);
    second.done(&["profile", "save"]);
    let text = std::fs::read_to_string(&saved).expect("a profile");
    assert!(
        text.contains("hud-depth = 0.25\n") && text.ends_with(rule),
        "{text}"
    );
}
