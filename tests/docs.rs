//! The documents agree with the code: commands run, options exist, blocks of TOML are accepted, links lead somewhere.

use crate::support;
use crate::support::manyview;
use manyview::config::{Config, OPTIONS, OptionSpec, PathKind, Profile, Scope, Settings};
use manyview::display::{Display, Placement};
use manyview::volume::{RotatingScreen, Volume};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// Stands in for every program that a document starts.
const NO_PROGRAM: &str = "/no/such/program";
const APP_NOT_FOUND: i32 = 127;
/// Status of `ctl` where no program listens.
const NOBODY: i32 = 3;
/// Status of `calibrate show` without an X server.
const NO_SCREEN: i32 = 3;
/// Status of a command whose file is not there; its message names the file.
const NO_FILE: i32 = 2;

/// A document of the repository.
struct Document {
    /// Relative to the root.
    path: PathBuf,
    text: String,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: impl Into<PathBuf>) -> Document {
    let path = path.into();
    let text = std::fs::read_to_string(root().join(&path));
    let text = text.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    Document { path, text }
}

/// The Markdown files below a folder of the repository, in the order of their names.
fn markdown(folder: &str) -> Vec<Document> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(root().join(folder)).expect("a folder") {
        let name = entry.expect("an entry").file_name();
        let path = Path::new(folder).join(name);
        if root().join(&path).is_dir() {
            found.extend(markdown(path.to_str().expect("UTF-8")));
        } else if path.extension().is_some_and(|e| e == "md") {
            found.push(read(path));
        }
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    found
}

/// The user's documents: the README and the pages of the book.
fn manual() -> Vec<Document> {
    let mut manual = vec![read("README.md")];
    manual.extend(markdown("docs"));
    manual
}

/// The user's documents and the developer's.
fn documents() -> Vec<Document> {
    let others = ["ARCHITECTURE.md", "CONTRIBUTING.md", "examples/README.md"];
    manual()
        .into_iter()
        .chain(others.into_iter().map(read))
        .collect()
}

/// The README is a first page; the rest of the manual is in the book.
const README_LINES: usize = 150;

#[test]
fn the_readme_is_short() {
    let lines = read("README.md").text.lines().count();
    assert!(
        lines <= README_LINES,
        "README.md has {lines} lines: move something into docs/"
    );
}

#[test]
fn every_page_is_in_the_summary() {
    let summary = read("docs/SUMMARY.md").text;
    for page in markdown("docs") {
        let path = page.path.strip_prefix("docs").expect("a page");
        let path = path.to_str().expect("UTF-8");
        let listed = path == "SUMMARY.md" || links(&summary).any(|link| link == path);
        assert!(listed, "docs/SUMMARY.md has no link to {path}");
    }
}

/// The table of docs/options.md stands between these lines.
const TABLE: [&str; 2] = [
    "<!-- generated: BLESS=1 cargo test --test all docs:: -->\n\n",
    "\n<!-- end of what is generated -->",
];

/// Text for a cell: options as code, bars escaped.
fn cell(text: &str) -> String {
    let code = |word: &str| {
        let name = word.trim_end_matches([',', ';', '.', ')']);
        match name.starts_with("--") {
            true => format!("`{name}`{}", &word[name.len()..]),
            false => word.to_owned(),
        }
    };
    let words: Vec<_> = text.split(' ').map(code).collect();
    words.join(" ").replace('|', "\\|")
}

/// A list of code words, the last one after `or`.
fn code_list(words: &[&str]) -> String {
    let words: Vec<_> = words.iter().map(|word| format!("`{word}`")).collect();
    match words.as_slice() {
        [most @ .., last] if !most.is_empty() => format!("{} or {last}", most.join(", ")),
        words => words.concat(),
    }
}

fn row(spec: &OptionSpec) -> String {
    let code = |text: &str| format!("`{}`", text.replace('|', "\\|"));
    let switch = spec.id.is_switch();
    let option = spec.flag.map(|flag| match switch {
        true => code(&format!("--{flag}")),
        false => code(&format!("--{flag} {}", spec.value_name())),
    });
    let option = option.map(|option| match spec.scope {
        Scope::Capture => option + " (capture)",
        Scope::Layer | Scope::Variable => option,
    });
    let variable = match switch {
        true => code(&format!("{}=1", spec.variable)),
        false => code(spec.variable),
    };
    let mut text = cell(spec.help);
    if !spec.value.is_empty() && !spec.choices.is_empty() {
        text = format!("{text}: {}", code_list(spec.choices));
    }
    let default = match spec.default {
        "" => String::new(),
        word if spec.choices.contains(&word) || spec.path == PathKind::NameOrFile => code(word),
        words => cell(words),
    };
    if !default.is_empty() {
        text = format!("{text}; {default} unless given");
    }
    if let Some(alias) = spec.alias {
        text = format!("{text}; also `--{alias}`");
    }
    text.push('.');
    if !spec.manual.is_empty() {
        text = format!("{text} {}", cell(spec.manual));
    }
    format!(
        "| {} | {variable} | {} | {text} |\n",
        option.unwrap_or_default(),
        spec.key.map(code).unwrap_or_default(),
    )
}

#[test]
fn the_table_of_options_is_that_of_the_code() {
    let mut table = "| option | variable | key | meaning |\n|---|---|---|---|\n".to_owned();
    table.extend(OPTIONS.iter().map(row));
    let Document { path, text } = read("docs/options.md");
    let [start, end] = TABLE;
    let (before, rest) = text.split_once(start).expect("the line before the table");
    let (now, after) = rest.split_once(end).expect("the line after the table");
    if std::env::var_os("BLESS").is_some() {
        let text = format!("{before}{start}{table}{end}{after}");
        std::fs::write(root().join(path), text).expect("written");
        return;
    }
    let same = now == table;
    assert!(
        same,
        "docs/options.md is not what src/config/options.rs says: run BLESS=1 cargo test --test all docs::, and commit the page"
    );
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
    let page = read("docs/displays.md");
    let blocks = toml_blocks(&page.text);
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
fn the_toml_blocks_of_the_manual_are_accepted() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("block.toml");
    let (mut panels, mut options, mut profiles) = (0, 0, 0);
    let manual = manual();
    let blocks = || manual.iter().flat_map(|page| toml_blocks(&page.text));
    // Some name others.
    for (name, block) in blocks().filter_map(|block| Some((file_name(block)?, block))) {
        std::fs::write(folder.path().join(name), block).expect("written");
    }
    for block in blocks() {
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
        "the manual shows every kind"
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
    let documents = documents();
    let blocks = documents.iter().flat_map(|page| toml_blocks(&page.text));
    for block in blocks {
        if let Some(name) = file_name(block) {
            std::fs::write(folder.path().join(name), block).expect("written");
        }
    }
    // The files that earlier commands of the documents write.
    let rough = Display::named("slanted8").expect("a display").to_toml();
    std::fs::write(folder.path().join("rough.toml"), rough.expect("a text")).expect("written");
    let panel = image::RgbImage::new(96, 54);
    panel.save(folder.path().join("panel.png")).expect("saved");
    let quilt = folder.path().join("scene_qs4x2a1.png");
    panel.save(quilt).expect("saved");
    let dark = Volume::of_triangles(&RotatingScreen::POPESCU, &[]).expect("a display");
    let stack = dark.dithered().write(&folder.path().join("slices"));
    stack.expect("written");
    support::library();
    let lines: Vec<_> = documents
        .iter()
        .flat_map(|document| shell_lines(&document.text))
        .filter_map(|line| line.strip_prefix("manyview "))
        .collect();
    assert!(lines.len() >= 40, "the manual shows the command: {lines:?}");
    let mut done = HashSet::new();
    for line in lines.into_iter().filter(|line| done.insert(*line)) {
        let (options, app) = match line.split_once(" -- ") {
            Some((options, _)) => (options, true),
            None => (line, false),
        };
        let mut command = manyview();
        command
            .current_dir(folder.path())
            .env("XDG_RUNTIME_DIR", folder.path())
            .env("XDG_CONFIG_HOME", folder.path().join("configuration"))
            .env("HOME", folder.path())
            // Opens no window on the screen of the person who runs the tests.
            .env_remove("DISPLAY")
            .args(options.split_whitespace());
        if app {
            command.args(["--", NO_PROGRAM]);
        }
        let output = command.output().expect("the command starts");
        let wanted = match app {
            true => APP_NOT_FOUND,
            false if line.starts_with("ctl ") || line.starts_with("profile ") => NOBODY,
            false if line.starts_with("calibrate show ") => NO_SCREEN,
            false if line.starts_with("wall show ") => NO_SCREEN,
            false if line.starts_with("calibrate fit ") => NO_FILE,
            false if line.starts_with("wall fit ") => NO_FILE,
            false if line.starts_with("points ") => NO_FILE,
            false => 0,
        };
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(
            output.status.code(),
            Some(wanted),
            "manyview {line}\n{error}"
        );
        let file = [".jpg", "scan."].iter().any(|name| error.contains(name));
        let names = wanted != NO_FILE || file;
        assert!(names, "manyview {line}\n{error}");
    }
}

#[test]
fn the_variables_of_the_manual_are_accepted() {
    let manual = manual();
    let lines = manual.iter().flat_map(|page| shell_lines(&page.text));
    let mut seen = 0;
    for line in lines.filter(|line| line.starts_with("LD_PRELOAD=")) {
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
    assert!(seen > 0, "the manual shows a bare preload");
}

/// Where the links of a document lead, in the order of the text.
fn links(document: &str) -> impl Iterator<Item = &str> {
    let targets = document.split("](").skip(1);
    targets.filter_map(|rest| rest.split(')').next())
}

/// The anchors of a document's headings, as renderers of Markdown make them.
fn anchors(document: &str) -> Vec<String> {
    let headings = document.lines().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| {
        let kept = heading.chars().filter_map(|c| match c {
            ' ' => Some('-'),
            '-' | '_' => Some(c),
            _ => c.is_alphanumeric().then(|| c.to_ascii_lowercase()),
        });
        kept.collect()
    };
    headings
        .map(|line| anchor(line.trim_start_matches('#').trim()))
        .collect()
}

#[test]
fn the_links_of_the_documents_lead_somewhere() {
    for Document { path, text } in documents() {
        let folder = path.parent().expect("a folder");
        for target in links(&text).filter(|target| !target.starts_with("https://")) {
            let here = path.display();
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let file = match file {
                "" => path.clone(),
                file => folder.join(file),
            };
            assert!(root().join(&file).exists(), "{here}: {target}");
            if !heading.is_empty() {
                let known = anchors(&read(file).text).iter().any(|a| a == heading);
                assert!(known, "{here}: {target}");
            }
        }
    }
}

#[test]
fn the_pictures_of_the_readme_are_small() {
    let readme = read("README.md");
    for target in links(&readme.text).filter(|target| target.ends_with(".png")) {
        let size = std::fs::metadata(root().join(target)).expect("a picture");
        assert!(size.len() < 300_000, "{target} has {} bytes", size.len());
    }
}

/// Limits of what a newcomer reads before the code: bytes, and lines of the table of words.
const ARCHITECTURE_BYTES: usize = 15 * 1024;
const WORDS: usize = 20;

#[test]
fn the_architecture_is_short() {
    let text = read("ARCHITECTURE.md").text;
    assert!(
        text.len() <= ARCHITECTURE_BYTES,
        "ARCHITECTURE.md has {} bytes: a reason goes to docs/decisions, a figure to docs/measured.md",
        text.len()
    );
    let words = text.split("\n## Words\n").nth(1).expect("the words");
    let words = words.split("\n## ").next().unwrap_or_default();
    let lines = words.lines().filter(|line| !line.is_empty()).count();
    assert!(
        lines <= WORDS,
        "ARCHITECTURE.md explains words on {lines} lines: use the field's word instead"
    );
}

/// Whether some source file ends with this path, or some folder does.
fn is_source(path: &str, sources: &[String]) -> bool {
    let tail = format!("/{path}");
    let within = format!("/{}/", path.trim_end_matches('/'));
    sources
        .iter()
        .any(|file| file.ends_with(&tail) || file.contains(&within))
}

/// All files of the repository that a text may name, with a leading slash.
fn sources(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else {
            found.push(format!(
                "/{}",
                path.strip_prefix(root()).expect("below").display()
            ));
        }
    }
    found
}

#[test]
fn the_files_that_the_developers_pages_name_are_there() {
    let folders = [
        "src", "shim", "shaders", "docs", "tests", "examples", "profiles", "viewer",
    ];
    let mut known: Vec<_> = folders
        .iter()
        .flat_map(|f| sources(&root().join(f)))
        .collect();
    known.push("/Makefile".to_owned());
    let mut pages = markdown("docs/decisions");
    pages.push(read("ARCHITECTURE.md"));
    pages.push(read("CONTRIBUTING.md"));
    for Document { path, text } in pages {
        // Every other part is between backticks.
        let code = text.split('`').skip(1).step_by(2);
        let names = code.filter(|code| {
            let plain = |c: char| c.is_ascii_alphanumeric() || "_./-".contains(c);
            let ends = [".rs", ".wgsl", ".list"]
                .iter()
                .any(|end| code.ends_with(end));
            code.chars().all(plain) && ends
        });
        for name in names {
            assert!(is_source(name, &known), "{}: {name}", path.display());
        }
    }
}

/// Folders of the repository, and how the names of files there end that comments may give.
const NAMED: [(&str, &str); 6] = [
    ("src/", ".rs"),
    ("shim/", ".rs"),
    ("shaders/", ".wgsl"),
    ("tests/", ".rs"),
    ("docs/", ".md"),
    // It is not in the repository, so nothing in it can be named.
    ("notes/", ""),
];

/// The comment on a line of Rust, WGSL or C, or else nothing. A line within a comment of C begins with a star or is not seen.
fn comment(line: &str) -> &str {
    let begins = |mark: &str| line.starts_with(mark) || line.contains(&format!(" {mark}"));
    match ["//", "/*"].into_iter().find(|mark| begins(mark)) {
        Some(mark) => line.split_once(mark).map_or("", |(_, comment)| comment),
        None if line.trim_start().starts_with("* ") => line,
        None => "",
    }
}

#[test]
fn the_files_that_comments_name_are_there() {
    let folders = ["src", "shim", "shaders", "tests", "examples", "viewer"];
    let all = folders.iter().flat_map(|f| sources(&root().join(f)));
    let commented = |path: &String| {
        let ends = [".rs", ".wgsl", ".c", ".h"];
        ends.iter().any(|end| path.ends_with(end))
    };
    let mut missing = Vec::new();
    for path in all.filter(commented) {
        let path = path.trim_start_matches('/');
        let text = read(path).text;
        let other = |c: char| !c.is_ascii_alphanumeric() && !"_./-".contains(c);
        for word in text.lines().flat_map(|line| comment(line).split(other)) {
            let word = word.trim_end_matches('.');
            let named = |(folder, end): &(&str, &str)| {
                word.len() > folder.len() + end.len()
                    && word.starts_with(folder)
                    && word.ends_with(end)
            };
            if NAMED.iter().any(named) && !root().join(word).exists() {
                missing.push(format!("{path}: {word}"));
            }
        }
    }
    assert!(
        missing.is_empty(),
        "not in the repository: {}",
        missing.join(", ")
    );
}
