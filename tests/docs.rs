//! The documents say what the code does.
#![forbid(unsafe_code)]

mod support;

use manyview::config::{Config, OPTIONS, Profile, Settings};
use manyview::display::{Display, Placement};
use manyview::volume::{RotatingScreen, Volume};
use std::path::{Path, PathBuf};
use support::manyview;

const README: &str = include_str!("../README.md");
const ARCHITECTURE: &str = include_str!("../ARCHITECTURE.md");
/// In place of every program that a document starts.
const NO_PROGRAM: &str = "/no/such/program";
const APP_NOT_FOUND: i32 = 127;
/// Of `ctl` where no program listens.
const NOBODY: i32 = 3;
/// Of `calibrate show` without an X server.
const NO_SCREEN: i32 = 3;

#[test]
fn the_readme_has_every_option_variable_and_key() {
    for spec in OPTIONS {
        assert!(
            README.contains(&format!("`{}`", spec.variable))
                || spec.id.is_switch() && README.contains(&format!("`{}=1`", spec.variable)),
            "{}",
            spec.variable
        );
        if let Some(flag) = spec.flag {
            let end = if spec.id.is_switch() { '`' } else { ' ' };
            assert!(README.contains(&format!("`--{flag}{end}")), "--{flag}");
        }
        if let Some(key) = spec.key {
            assert!(README.contains(&format!("| `{key}` |")), "{key}");
        }
    }
}

/// The TOML files that a document shows.
fn toml_blocks(document: &str) -> Vec<&str> {
    let blocks = document.split("```toml\n").skip(1);
    blocks.filter_map(|rest| rest.split("```").next()).collect()
}

/// A block that opens with `# NAME.toml` is that file.
fn file_name(block: &str) -> Option<&str> {
    let first = block.lines().next()?.strip_prefix("# ")?;
    first.ends_with(".toml").then_some(first)
}

#[test]
fn the_descriptions_of_displays_are_accepted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("panel.toml");
    let blocks = toml_blocks(include_str!("../docs/displays.md"));
    assert!(blocks.len() >= 6, "the page shows every kind");
    for block in blocks {
        std::fs::write(&path, block).expect("written");
        let display = Display::load(path.to_str().expect("UTF-8"));
        let display = display.unwrap_or_else(|error| panic!("{error}\n{block}"));
        let views = display.views;
        let whole = Placement::full_screen(32, 16);
        display.mask(&whole, views).expect("a mask");
    }
}

#[test]
fn the_toml_blocks_of_the_readme_are_accepted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("readme.toml");
    let (mut panels, mut options, mut profiles) = (0, 0, 0);
    for block in toml_blocks(README) {
        std::fs::write(&path, block).expect("written");
        if block.lines().any(|line| line.starts_with("kind = ")) {
            Display::load(path.to_str().expect("UTF-8")).expect("a panel");
            panels += 1;
            continue;
        }
        if block.lines().any(|line| line.starts_with("rule = ")) {
            Profile::read(&path).expect("a profile");
            profiles += 1;
            continue;
        }
        let lookup =
            |name: &str| (name == "MANYVIEW_CONFIG").then(|| path.to_string_lossy().into_owned());
        let settings = Settings::from_env(lookup).expect("known keys");
        Config::from_settings(&settings).expect("good values");
        options += 1;
    }
    assert!(
        panels > 0 && options > 0 && profiles > 0,
        "the README shows every kind"
    );
}

/// The lines of a document that are typed into a shell: indented, without what follows a `#`.
fn shell_lines(document: &str) -> impl Iterator<Item = &str> {
    let indented = document
        .lines()
        .filter_map(|line| line.strip_prefix("    "));
    indented.map(|line| line.split(" #").next().unwrap_or(line).trim())
}

#[test]
fn the_commands_of_the_documents_are_accepted() {
    let folder = tempfile::tempdir().expect("a folder");
    for block in toml_blocks(README) {
        if let Some(name) = file_name(block) {
            std::fs::write(folder.path().join(name), block).expect("written");
        }
    }
    // The picture that an earlier line takes of a program.
    let panel = image::RgbImage::new(96, 54);
    panel.save(folder.path().join("panel.png")).expect("saved");
    let quilt = folder.path().join("scene_qs4x2a1.png");
    panel.save(quilt).expect("saved");
    let dark = Volume::of_triangles(&RotatingScreen::POPESCU, &[]).expect("a display");
    let stack = dark.dithered().write(&folder.path().join("slices"));
    stack.expect("written");
    support::library();
    let documents = [
        README,
        ARCHITECTURE,
        include_str!("../CONTRIBUTING.md"),
        include_str!("../examples/README.md"),
    ];
    let lines: Vec<_> = documents
        .into_iter()
        .flat_map(shell_lines)
        .filter_map(|line| line.strip_prefix("manyview "))
        .collect();
    assert!(lines.len() >= 6, "the README shows the command: {lines:?}");
    for line in lines {
        let (options, app) = match line.split_once(" -- ") {
            Some((options, _)) => (options, true),
            None => (line, false),
        };
        let mut command = manyview();
        command
            .current_dir(folder.path())
            .env("XDG_RUNTIME_DIR", folder.path())
            // No window before whoever runs this.
            .env_remove("DISPLAY")
            .args(options.split_whitespace());
        if app {
            command.args(["--", NO_PROGRAM]);
        }
        let output = command.output().expect("the command starts");
        let wanted = match app {
            true => APP_NOT_FOUND,
            false if line.starts_with("ctl ") => NOBODY,
            false if line.starts_with("calibrate show ") => NO_SCREEN,
            false => 0,
        };
        assert_eq!(
            output.status.code(),
            Some(wanted),
            "manyview {line}\n{}",
            String::from_utf8_lossy(&output.stderr)
        );
    }
}

#[test]
fn the_variables_of_the_readme_are_accepted() {
    let lines = shell_lines(README).filter(|line| line.starts_with("LD_PRELOAD="));
    let mut seen = 0;
    for line in lines {
        let value = |name: &str| {
            line.split_whitespace()
                .filter_map(|word| word.split_once('='))
                .find_map(|(key, value)| (key == name).then(|| value.to_owned()))
        };
        for word in line.split_whitespace().filter(|w| w.contains("MANYVIEW_")) {
            let name = word.split('=').next().unwrap_or_default();
            assert!(OPTIONS.iter().any(|spec| spec.variable == name), "{name}");
        }
        Config::from_env(value).expect("good values");
        seen += 1;
    }
    assert!(seen > 0, "the README shows a bare preload");
}

#[test]
fn the_pictures_and_documents_that_are_linked_exist_and_are_small() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let targets = README.split("](").skip(1);
    for target in targets.filter_map(|rest| rest.split(')').next()) {
        if target.starts_with("https://") {
            continue;
        }
        if let Some(heading) = target.strip_prefix('#') {
            let headings = README.lines().filter(|line| line.starts_with('#'));
            let here = headings
                .map(|line| {
                    line.trim_start_matches('#')
                        .trim()
                        .to_lowercase()
                        .replace(' ', "-")
                })
                .any(|line| line == heading);
            assert!(here, "{target}");
            continue;
        }
        let file = std::fs::metadata(root.join(target));
        let file = file.unwrap_or_else(|error| panic!("{target}: {error}"));
        assert!(file.len() < 300_000, "{target} has {} bytes", file.len());
    }
}

/// Files and folders of modules in a folder of sources.
fn modules(folder: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = std::fs::read_dir(&root).expect("sources");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let module = |path: &PathBuf| {
        let source = path.is_dir() || path.extension().is_some_and(|e| e == "rs");
        source.then(|| path.file_stem().expect("a name").to_string_lossy().into())
    };
    paths.filter_map(|path| module(&path)).collect()
}

#[test]
fn the_architecture_names_every_module() {
    let special = ["lib", "main", "cli", "probe"];
    for (folder, prefix) in [("src", ""), ("shim/src", "shim::")] {
        for module in modules(folder) {
            let name = format!("| `{prefix}{module}`");
            let known = special.contains(&module.as_str()) || ARCHITECTURE.contains(&name);
            assert!(known, "ARCHITECTURE.md has no line for {prefix}{module}");
        }
    }
}
