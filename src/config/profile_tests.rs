//! Profiles: the rules that are understood, and the message for each mistake.

use super::profile::*;
use super::{
    Class, Config, ConfigError, DepthRange, DepthState, FlatDepth, OptionId, Projection, Settings,
    Viewport,
};
use proptest::prelude::*;
use std::path::Path;

const WHOLE: &str = r#"
executable = ["room", "room.x86_64"]
hud-depth = 0.25
focal-depth = 64

[[rule]]
executable = "room"
texture = 7
list = [3, 4]
projection = "orthographic"
viewport = "inset"
depth-state = "test-only"
depth-range = "near"
image = "fedcba9876543210"
clear = [1, 2]
after-clear = "1..3"
before-depth = true
shader = "0123456789abcdef"
program = 2
pass = [0, 3]
draw = "5..9"
class = "flat"
depth = -0.5

[[rule]]
draw = 1
class = "off-screen"

[[rule]]
class = "scene"
focal-depth = 2.5
"#;

#[test]
fn every_key_is_understood() {
    let profile = Profile::parse(WHOLE, Path::new("room.toml")).unwrap();
    assert_eq!(profile.executable, ["room", "room.x86_64"]);
    assert_eq!(profile.hud_depth, Some(FlatDepth::At(0.25)));
    assert_eq!(profile.focal_depth, Some(64.0));
    let [first, second, third] = &profile.rules[..] else {
        panic!("{:?}", profile.rules)
    };
    assert_eq!(
        *first,
        Rule {
            executable: vec!["room".to_owned()],
            texture: vec![7],
            image: vec![0xFEDC_BA98_7654_3210],
            list: vec![3, 4],
            projection: Some(Projection::Orthographic),
            viewport: Some(Viewport::Inset),
            depth_state: Some(DepthState::TestOnly),
            depth_range: Some(DepthRange::Near),
            shader: vec![0x0123_4567_89AB_CDEF],
            program: vec![2],
            pass: vec![0, 3],
            draw: Some((5, 9)),
            clear: vec![1, 2],
            after_clear: Some((1, 3)),
            before_depth: Some(true),
            class: Class::Flat,
            depth: Some(FlatDepth::At(-0.5)),
            focal_depth: None,
        }
    );
    assert_eq!(
        (second.draw, second.class),
        (Some((1, 1)), Class::OffScreen)
    );
    assert_eq!((third.class, third.focal_depth), (Class::Scene, Some(2.5)));
}

#[test]
fn a_list_of_lines_is_the_same_as_tables() {
    let lines = "rule = [\n{ draw = \"2..\", class = \"sky\" },\n{ class = \"scene\" },\n]";
    let tables = "[[rule]]\ndraw = \"2..\"\nclass = \"sky\"\n[[rule]]\nclass = \"scene\"";
    let parse = |text| Profile::parse(text, Path::new("")).unwrap();
    assert_eq!(parse(lines), parse(tables));
    assert_eq!(parse(lines).rules[0].draw, Some((2, u32::MAX)));
}

#[test]
fn every_mistake_is_one_clear_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("game.toml");
    let message = |text: &str| {
        std::fs::write(&path, text).unwrap();
        let mut settings = Settings::default();
        let value = path.to_string_lossy();
        settings.set(OptionId::Profile, value, super::Origin::CommandLine);
        let error = Config::from_settings(&settings).unwrap_err();
        assert!(matches!(error, ConfigError::Profile { .. }), "{error:?}");
        let error = error.to_string();
        assert!(!error.contains('\n'), "one line: {error}");
        error.replace(folder.path().to_str().unwrap(), "FOLDER")
    };
    let rule = |keys: &str| format!("rule = [\n{{ class = \"flat\" }},\n{{ {keys} }},\n]");
    let all = [
        "rule = [\n{ class = \"flat\" }\n{ class = \"sky\" }\n]".to_owned(),
        "rules = []".to_owned(),
        "rule = 5".to_owned(),
        "rule = [5]".to_owned(),
        "executable = \"/usr/games/room\"".to_owned(),
        "hud-depth = 1.5".to_owned(),
        rule("texture = 3"),
        rule("class = \"hud\""),
        rule("class = 5"),
        rule("class = \"flat\", texure = 3"),
        rule("class = \"flat\", texture = -1"),
        rule("class = \"flat\", image = 7"),
        rule("class = \"flat\", after-clear = 0"),
        rule("class = \"flat\", before-depth = \"true\""),
        rule("class = \"flat\", list = \"3\""),
        rule("class = \"flat\", projection = \"ortho\""),
        rule("class = \"flat\", depth-state = true"),
        rule("class = \"flat\", draw = 0"),
        rule("class = \"flat\", draw = \"9..5\""),
        rule("class = \"flat\", depth = \"near\""),
        rule("class = \"flat\", depth = -11"),
        rule("class = \"sky\", depth = 0.5"),
        rule("class = \"flat\", depth-range = \"nearest\""),
        rule("class = \"flat\", focal-depth = 20"),
        rule("class = \"scene\", focal-depth = 0"),
        "focal-depth = \"near\"".to_owned(),
    ]
    .map(|text| message(&text));
    insta::assert_snapshot!(all.join("\n"));
}

#[test]
fn profiles_are_found_by_name_and_by_program() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("a-broken.toml", "executable = 5");
    write("room.toml", WHOLE);
    write("other.toml", "executable = \"other\"");
    write("notes.txt", "not a profile");
    let by_name = Profile::named(&[folder.path().to_owned()], "room").unwrap();
    assert_eq!(by_name.rules.len(), 3);
    let by_program = Profile::automatic(&[folder.path().to_owned()], "room.x86_64").unwrap();
    assert_eq!(by_program, by_name);
    assert_eq!(
        Profile::automatic(&[folder.path().to_owned()], "unknown"),
        None
    );
    insta::assert_snapshot!(
        Profile::named(&[folder.path().to_owned()], "rome").unwrap_err(),
        @"there is no profile 'rome'; give a file that ends in .toml, or one of none, a-broken, other, room"
    );
    insta::assert_snapshot!(
        Profile::named(&[], "rome").unwrap_err(),
        @"there is no profile 'rome'; give a file that ends in .toml, or one of none"
    );
}

#[test]
fn a_profile_is_chosen_for_a_program_unless_another_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("room.toml"), WHOLE).unwrap();
    let rules = |profile: Option<&str>| {
        let mut settings = Settings::default();
        let set = |settings: &mut Settings, id, value: &str| {
            settings.set(id, value, super::Origin::Variable);
        };
        set(
            &mut settings,
            OptionId::Profiles,
            folder.path().to_str().unwrap(),
        );
        if let Some(profile) = profile {
            set(&mut settings, OptionId::Profile, profile);
        }
        let mut config = Config::from_settings(&settings).unwrap();
        config.choose_profile(&settings, Some("room".to_owned()));
        config.profile.rules.len()
    };
    assert_eq!(rules(None), 3);
    assert_eq!(rules(Some("none")), 0);
    assert_eq!(rules(Some("room")), 3);
}

#[test]
fn the_profiles_that_come_with_the_library_are_good() {
    let shelf = Path::new(env!("CARGO_MANIFEST_DIR")).join("profiles");
    let mut seen = 0;
    for entry in std::fs::read_dir(shelf).unwrap() {
        let path = entry.unwrap().path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let profile = Profile::read(&path).unwrap();
            assert!(
                !profile.rules.is_empty()
                    || profile.hud_depth.is_some()
                    || profile.focal_depth.is_some()
            );
            seen += 1;
        }
    }
    assert!(seen > 0, "there are profiles");
}

proptest! {
    /// Whatever stands in a file, reading it ends in a profile or in one line.
    #[test]
    fn no_text_makes_a_profile_panic(text in "(rule|class|draw|depth|= |\\[|\\]|\\{|\\}|\"|\\.\\.|[0-9]|-|,|\n|flat|sky){0,30}") {
        if let Err(message) = Profile::parse(&text, Path::new("any.toml")) {
            prop_assert!(!message.is_empty() && !message.contains('\n'), "{message}");
        }
    }

    #[test]
    fn ranges_survive_being_written(first in 1u32..1000, length in 0u32..1000) {
        let last = first + length;
        let text = format!("rule = [{{ draw = \"{first}..{last}\", class = \"scene\" }}]");
        let profile = Profile::parse(&text, Path::new("")).unwrap();
        prop_assert_eq!(profile.rules[0].draw, Some((first, last)));
    }
}
