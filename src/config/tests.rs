//! Messages, precedence and the way through the environment.

use super::*;
use std::fmt::Write as _;

fn from_pairs(pairs: &[(&str, &str)]) -> Result<Config, ConfigError> {
    Config::from_env(|name| {
        pairs
            .iter()
            .find(|(n, _)| *n == name)
            .map(|(_, v)| (*v).to_owned())
    })
}

fn on_command_line(pairs: &[(OptionId, &str)]) -> Settings {
    let mut settings = Settings::default();
    for (id, value) in pairs {
        settings.set(*id, *value, Origin::CommandLine);
    }
    settings
}

#[test]
fn nothing_set_gives_the_defaults() {
    let config = from_pairs(&[]).unwrap();
    assert_eq!(
        (config.views, config.output, config.camera),
        (8, Output::Panel, Camera::Measured(None))
    );
    assert_eq!(
        (config.strategy, config.atlas),
        (Strategy::Auto, AtlasLayout::SideBySide)
    );
    assert_eq!(
        (config.view_scale, config.report, config.capture),
        (ViewScale::Fixed(1.0), None, None)
    );
    assert_eq!(config.display.name, panel::DEFAULT);
}

#[test]
fn every_message_is_one_clear_sentence() {
    let cases: &[&[(&str, &str)]] = &[
        &[("MANYVIEW_VIEWS", "0")],
        &[("MANYVIEW_VIEWS", "257")],
        &[("MANYVIEW_VIEWS", "-3")],
        &[("MANYVIEW_VIEWS", "eight")],
        &[("MANYVIEW_OUTPUT", "anaglyph:blue")],
        &[("MANYVIEW_OUTPUT", "rows"), ("MANYVIEW_VIEWS", "1")],
        &[("MANYVIEW_OUTPUT", "quad"), ("MANYVIEW_VIEWS", "1")],
        &[("MANYVIEW_PANEL", "auto"), ("MANYVIEW_VIEWS", "1")],
        &[("MANYVIEW_PANEL", "auto"), ("MANYVIEW_PANEL_SIZE", "800")],
        &[("MANYVIEW_FILTER", "smooth")],
        &[("MANYVIEW_FILTER", "blend"), ("MANYVIEW_VIEWS", "256")],
        &[("MANYVIEW_CLIP", "never")],
        &[("MANYVIEW_PROVE", "0")],
        &[("MANYVIEW_PROVE", "10"), ("MANYVIEW_VIEWS", "1")],
        &[("MANYVIEW_OUTPUT", "view:8")],
        &[("MANYVIEW_OUTPUT", "view:x")],
        &[
            ("MANYVIEW_EYE_SPACING", "0.1"),
            ("MANYVIEW_AUTO_DEPTH", "0"),
        ],
        &[("MANYVIEW_FOCAL_DEPTH", "5"), ("MANYVIEW_AUTO_DEPTH", "0")],
        &[("MANYVIEW_AUTO_DEPTH", "yes")],
        &[
            ("MANYVIEW_EYE_SPACING", "0.1"),
            ("MANYVIEW_FOCAL_DEPTH", "0"),
        ],
        &[
            ("MANYVIEW_EYE_SPACING", "0.1"),
            ("MANYVIEW_FOCAL_DEPTH", "-2"),
        ],
        &[
            ("MANYVIEW_EYE_SPACING", "NaN"),
            ("MANYVIEW_FOCAL_DEPTH", "2"),
        ],
        &[
            ("MANYVIEW_EYE_SPACING", "0.1"),
            ("MANYVIEW_FOCAL_DEPTH", "inf"),
        ],
        &[("MANYVIEW_SEPARATION", "0.1"), ("MANYVIEW_AUTO_DEPTH", "0")],
        &[("MANYVIEW_CONVERGENCE", "2"), ("MANYVIEW_AUTO_DEPTH", "0")],
        &[("MANYVIEW_CONVERGENCE", "0")],
        &[
            ("MANYVIEW_SEPARATION", "0.1"),
            ("MANYVIEW_CONVERGENCE", "1e999"),
        ],
        &[
            ("MANYVIEW_SEPARATION", "0.1"),
            ("MANYVIEW_EYE_SPACING", "0.2"),
        ],
        &[("MANYVIEW_STRATEGY", "magic")],
        &[("MANYVIEW_ATLAS", "cube")],
        &[("MANYVIEW_VIEW_SCALE", "0.01")],
        &[("MANYVIEW_VIEW_SCALE", "0")],
        &[("MANYVIEW_VIEW_SCALE", "2")],
        &[("MANYVIEW_VIEW_SCALE", "NaN")],
        &[("MANYVIEW_HUD_DEPTH", "far")],
        &[("MANYVIEW_HUD_DEPTH", "1.5")],
        &[("MANYVIEW_HUD_DEPTH", "NaN")],
        &[("MANYVIEW_PROFILE", "no-such-profile")],
        &[("MANYVIEW_PROFILE", "no-such-file.toml")],
        &[("MANYVIEW_EXPLAIN_FRAME", "3")],
        &[("MANYVIEW_EXPLAIN", "out"), ("MANYVIEW_EXPLAIN_FRAME", "0")],
        &[
            ("MANYVIEW_EXPLAIN", "out"),
            ("MANYVIEW_EXPLAIN_FRAME", "3..4"),
        ],
        &[("MANYVIEW_EXPLAIN", "out"), ("MANYVIEW_VIEWS", "1")],
        &[("MANYVIEW_CONTROL", "yes")],
        &[("MANYVIEW_CONTROL", "1"), ("MANYVIEW_VIEWS", "1")],
        &[("MANYVIEW_CAPTURE_FRAMES", "30")],
        &[
            ("MANYVIEW_CAPTURE_OUT", "a.png"),
            ("MANYVIEW_CAPTURE_FRAMES", "0"),
        ],
        &[
            ("MANYVIEW_CAPTURE_OUT", "a.png"),
            ("MANYVIEW_CAPTURE_FRAMES", "9..3"),
        ],
        &[
            ("MANYVIEW_CAPTURE_OUT", "a.png"),
            ("MANYVIEW_CAPTURE_WHAT", "sound"),
        ],
        &[
            ("MANYVIEW_CAPTURE_OUT", "a.png"),
            ("MANYVIEW_CAPTURE_WHAT", "view:9"),
        ],
        &[("MANYVIEW_TRUE_VIEWS", "3")],
        &[("MANYVIEW_FPS", "30"), ("MANYVIEW_STRATEGY", "replay")],
        &[
            ("MANYVIEW_STRATEGY", "hybrid"),
            ("MANYVIEW_FPS", "30"),
            ("MANYVIEW_TRUE_VIEWS", "3"),
        ],
        &[
            ("MANYVIEW_STRATEGY", "hybrid"),
            ("MANYVIEW_TRUE_VIEWS", "9"),
        ],
        &[
            ("MANYVIEW_STRATEGY", "hybrid"),
            ("MANYVIEW_TRUE_VIEWS", "two"),
        ],
        &[("MANYVIEW_STRATEGY", "hybrid"), ("MANYVIEW_FPS", "0.5")],
        &[("MANYVIEW_STRATEGY", "hybrid"), ("MANYVIEW_FPS", "fast")],
        &[("MANYVIEW_SPLATS", "surface")],
        &[
            ("MANYVIEW_SPLATS", "round"),
            ("MANYVIEW_STRATEGY", "splats"),
        ],
        &[
            ("MANYVIEW_SPLATS", "surface"),
            ("MANYVIEW_STRATEGY", "splats"),
            ("MANYVIEW_PROVE", "10"),
        ],
        &[("MANYVIEW_ONLY", "/usr/games/quake")],
        &[("MANYVIEW_EXCEPT", "setup,,quake")],
        &[("MANYVIEW_CONFIG", "no-such-file.toml")],
    ];
    let mut all = String::new();
    for case in cases {
        let message = from_pairs(case).unwrap_err().to_string();
        assert!(!message.contains('\n'), "one line: {message}");
        writeln!(all, "{message}").unwrap();
    }
    insta::assert_snapshot!(all);
}

#[test]
fn messages_name_the_option_as_it_was_written() {
    let settings = on_command_line(&[(OptionId::EyeSpacing, "0.1"), (OptionId::AutoDepth, "0")]);
    insta::assert_snapshot!(
        Config::from_settings(&settings).unwrap_err(),
        @"--eye-spacing is 0.1 but --focal-depth is missing; give both, or let auto-depth find the other"
    );
}

#[test]
fn toml_messages_name_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wall.toml");
    let message = |text: &str| {
        std::fs::write(&path, text).unwrap();
        let error = from_pairs(&[("MANYVIEW_CONFIG", path.to_str().unwrap())])
            .unwrap_err()
            .to_string();
        assert!(!error.contains('\n'), "one line: {error}");
        error.replace(folder.path().to_str().unwrap(), "FOLDER")
    };
    let all = [
        "views = 0",
        "view = 8",
        "views = [8]",
        "views = true",
        "views = ",
        "auto-depth = false\nfocal-depth = 4.0",
    ]
    .map(message);
    insta::assert_snapshot!(all.join("\n"));
}

#[test]
fn command_line_beats_variable_beats_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.toml");
    std::fs::write(
        &path,
        "views = 3\noutput = \"sbs\"\nstrategy = \"replay\"\nreport = \"r.json\"\ncontrol = true\n",
    )
    .unwrap();
    let variables = |name: &str| match name {
        "MANYVIEW_CONFIG" => Some(path.to_str().unwrap().to_owned()),
        "MANYVIEW_VIEWS" => Some("4".to_owned()),
        "MANYVIEW_OUTPUT" => Some("quilt".to_owned()),
        _ => None,
    };
    let environment = Settings::from_env(variables).unwrap();
    let settings = on_command_line(&[(OptionId::Views, "5")]).over(environment);
    let config = Config::from_settings(&settings).unwrap();
    assert_eq!(
        (config.views, config.output, config.strategy),
        (5, Output::Quilt, Strategy::Replay)
    );
    assert!(config.control);
    assert_eq!(
        config.report,
        Some(folder.path().join("r.json")),
        "relative to the file"
    );
}

#[test]
fn a_stronger_camera_replaces_a_weaker_one_whole() {
    let weaker = on_command_line(&[(OptionId::Separation, "0.1"), (OptionId::Convergence, "3")]);
    let stronger = on_command_line(&[(OptionId::EyeSpacing, "0.2"), (OptionId::FocalDepth, "7")]);
    let config = Config::from_settings(&stronger.over(weaker)).unwrap();
    assert_eq!(
        config.camera,
        Camera::Eye {
            spacing: 0.2,
            focal_depth: 7.0
        }
    );
}

#[test]
fn options_survive_the_way_through_the_environment() {
    let settings = on_command_line(&[
        (OptionId::Views, "5"),
        (OptionId::Output, "view:2"),
        (OptionId::Separation, "-0.05"),
        (OptionId::Convergence, "4"),
        (OptionId::ViewScale, "1"),
        (OptionId::HudDepth, "-0.25"),
        (OptionId::Profile, "none"),
        (OptionId::Explain, "/tmp/why.png"),
        (OptionId::ExplainFrame, "7"),
        (OptionId::Control, "1"),
        (OptionId::CaptureOut, "/tmp/a.png"),
        (OptionId::CaptureFrames, "3..5"),
        (OptionId::CaptureWhat, "atlas"),
    ]);
    let passed = settings.to_env(Path::new("/somewhere"));
    let again = Config::from_env(|name| {
        passed
            .iter()
            .find(|(n, _)| n == name)
            .map(|(_, v)| v.clone())
    });
    assert_eq!(again.unwrap(), Config::from_settings(&settings).unwrap());
}

#[test]
fn paths_are_made_absolute_and_names_are_not() {
    let settings = on_command_line(&[
        (OptionId::Report, "r.json"),
        (OptionId::Display, panel::DEFAULT),
        (OptionId::Profile, "room"),
    ]);
    let passed = settings.to_env(Path::new("/here"));
    assert!(passed.contains(&("MANYVIEW_REPORT".to_owned(), "/here/r.json".to_owned())));
    assert!(passed.contains(&("MANYVIEW_PROFILE".to_owned(), "room".to_owned())));
    assert!(passed.contains(&("MANYVIEW_DISPLAY".to_owned(), panel::DEFAULT.to_owned())));
}

#[test]
fn pictures_are_named_by_frame() {
    let capture = |out: &str, first, last| Capture {
        out: out.into(),
        first,
        last,
        what: CaptureWhat::Output,
    };
    assert_eq!(
        capture("d/a.png", 30, 30).path_for(30),
        Path::new("d/a.png")
    );
    assert_eq!(
        capture("d/a.png", 30, 31).path_for(31),
        Path::new("d/a-000031.png")
    );
    assert_eq!(
        capture("d/a-%d.png", 30, 31).path_for(31),
        Path::new("d/a-31.png")
    );
    assert_eq!(
        capture("d/a-%d.png", 30, 30).path_for(30),
        Path::new("d/a-30.png")
    );
    assert_eq!(
        capture("d.x/a", 1, 2).path_for(2),
        Path::new("d.x/a-000002")
    );
    let quilt = |out: &str, first, last| {
        let capture = capture(out, first, last);
        let path = capture.path_with(31, "_qs8x6a0.75");
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        assert!(capture.is_for(31, &name), "{name}");
        assert_eq!(
            capture.is_for(30, &name),
            first == last && !out.contains("%d")
        );
        path
    };
    for (out, first, last, name) in [
        ("d/a%q.png", 31, 31, "d/a_qs8x6a0.75.png"),
        ("d/a%q.png", 30, 31, "d/a-000031_qs8x6a0.75.png"),
        ("d/a%q-%d.png", 30, 31, "d/a_qs8x6a0.75-31.png"),
        ("d/%d%q", 30, 31, "d/31_qs8x6a0.75"),
    ] {
        assert_eq!(quilt(out, first, last), Path::new(name));
    }
    assert_eq!(
        capture("d/a.png", 1, 1).path_with(1, "_qs8x6a0.75"),
        Path::new("d/a.png")
    );
    let of = capture("d/a%q.png", 1, 1);
    assert_eq!(of.path_for(1), Path::new("d/a.png"));
    for other in [
        "b_qs8x6a0.75.png",
        "a-old.png",
        ".a_qs8x6a0.75.png.12.0.tmp",
        "a_qs8x6a0.75-x.png",
    ] {
        assert!(!of.is_for(1, other), "{other}");
    }
    assert!(!capture("d/a.png", 1, 1).is_for(1, "a_qs8x6a0.75.png"));
    for (out, completed) in [
        ("d/a.png", "d/a%q.png"),
        ("a", "a%q"),
        ("d/a%q.png", "d/a%q.png"),
        ("d/a_qs9x5.png", "d/a_qs9x5.png"),
        ("d/f-%d.png", "d/f-%d%q.png"),
        ("/", "/"),
    ] {
        assert_eq!(Capture::completed(Path::new(out)), Path::new(completed));
    }
}

#[test]
fn disable_means_anything_but_nothing_and_zero() {
    assert!(disabled(|_| Some("1".to_owned())));
    assert!(!disabled(|_| Some("0".to_owned())));
    assert!(!disabled(|_| Some(String::new())));
    assert!(!disabled(|_| None));
}

#[test]
fn status_survives_a_round_trip() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.json");
    assert_eq!(Status::read(&path), None);
    let status = Status {
        frames: 12,
        notes: vec!["the layer turned itself off".to_owned()],
        proof: Some(serde_json::json!({"frames": 3})),
    };
    status.write(&path).unwrap();
    assert_eq!(Status::read(&path), Some(status));
}

/// The lines for former names that somebody used.
fn told(settings: &Settings) -> Vec<String> {
    let lines = settings.renamings().iter();
    lines.map(ToString::to_string).collect()
}

#[test]
fn former_names_are_taken_and_told() {
    const LAST: &str = "this version is the last one that takes the old name";
    let disabled = |settings: &Settings| {
        let config = Config::from_settings(settings).unwrap();
        (
            config.disabled.has(Optimisation::MonoFrames),
            config.disabled.has(Optimisation::Frustum),
        )
    };
    let variables = |name: &str| (name == "MANYVIEW_WITHOUT").then(|| "frustum".to_owned());
    let settings = Settings::from_variables(variables);
    assert_eq!(disabled(&settings), (false, true));
    let line = "MANYVIEW_WITHOUT is now called MANYVIEW_DISABLE_OPTIMISATIONS";
    assert_eq!(told(&settings), [format!("{line}; {LAST}")]);
    // The program gets the present names, so it tells nothing again.
    let passed = settings.to_env(Path::new("/"));
    let expected = (
        "MANYVIEW_DISABLE_OPTIMISATIONS".to_owned(),
        "frustum".to_owned(),
    );
    assert_eq!(passed, [expected]);

    let mut settings = Settings::default();
    settings.command_line(OptionId::Disable, "alike, frustum", true);
    assert_eq!(disabled(&settings), (true, true));
    let lines = [
        format!("--without is now called --disable; {LAST}"),
        format!("alike of --disable is now called mono; {LAST}"),
    ];
    assert_eq!(told(&settings), lines);

    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("options.toml");
    std::fs::write(&file, "without = \"alike\"\n").unwrap();
    let lookup = |name: &str| (name == "MANYVIEW_CONFIG").then(|| file.display().to_string());
    let settings = Settings::from_env(lookup).unwrap();
    assert_eq!(disabled(&settings), (true, false));
    let name = file.display();
    let lines = [
        format!("without in {name} is now called disable; {LAST}"),
        format!("alike of disable in {name} is now called mono; {LAST}"),
    ];
    assert_eq!(told(&settings), lines);
    assert_eq!(
        Config::from_env(lookup).unwrap().renamings,
        settings.renamings()
    );
}

#[test]
fn the_present_name_wins_over_the_former_one() {
    let variables = |name: &str| match name {
        "MANYVIEW_WITHOUT" => Some("frustum".to_owned()),
        "MANYVIEW_DISABLE_OPTIMISATIONS" => Some("mono".to_owned()),
        _ => None,
    };
    let settings = Settings::from_variables(variables);
    assert_eq!(settings.get(OptionId::Disable).unwrap().value, "mono");
    assert_eq!(told(&settings), [""; 0]);
}
