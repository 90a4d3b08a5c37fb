//! The shape of the source: who imports whom, where `unsafe` is, how long files are.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Files that may be longer than [`LONGEST`], and why.
const LONG: [(&str, &str); 2] = [
    ("src/gl/table.rs", "generated from the Khronos registry"),
    ("shim/src/entry.rs", "generated from the Khronos registry"),
];
const LONGEST: usize = 600;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All Rust files below a folder of the repository, as paths from its root, with their text.
fn files(folder: &str) -> BTreeMap<PathBuf, String> {
    let mut found = BTreeMap::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).expect("UTF-8");
                let path = path.strip_prefix(root()).expect("below").to_owned();
                found.insert(path, text);
            }
        }
    }
    assert!(!found.is_empty(), "{folder} has Rust files");
    found
}

/// The code of a file without comments, strings left as they are; precise enough to search for words.
fn code(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines()
        .map(|line| line.split("//").next().unwrap_or_default())
        .enumerate()
}

/// The modules of the library, in the order of src/lib.rs.
fn modules() -> Vec<String> {
    let text = fs::read_to_string(root().join("src/lib.rs")).expect("src/lib.rs");
    let names: Vec<_> = code(&text)
        .filter_map(|(_, line)| {
            let rest = line.trim().strip_prefix("pub mod ")?;
            rest.strip_suffix(';').map(str::to_owned)
        })
        .collect();
    assert!(names.len() > 10, "{names:?}");
    names
}

/// The modules that a line names by `crate::`; all of those in `crate::{a, b}`.
fn named(line: &str) -> Vec<String> {
    let word = |text: &str| -> String {
        text.chars()
            .take_while(|c| c.is_ascii_alphanumeric() || *c == '_')
            .collect()
    };
    let mut names = Vec::new();
    for rest in line.split("crate::").skip(1) {
        match rest.strip_prefix('{') {
            Some(group) => {
                let mut depth = 0;
                let mut fresh = true;
                for (at, c) in group.char_indices() {
                    match c {
                        '{' => depth += 1,
                        '}' if depth == 0 => break,
                        '}' => depth -= 1,
                        ',' if depth == 0 => fresh = true,
                        c if fresh && depth == 0 && !c.is_whitespace() => {
                            names.push(word(&group[at..]));
                            fresh = false;
                        }
                        _ => {}
                    }
                }
            }
            None => names.push(word(rest)),
        }
    }
    names
}

#[test]
fn groups_and_single_names_are_found() {
    assert_eq!(named("use crate::gl::{Gl, consts as c};"), ["gl"]);
    assert_eq!(
        named("use crate::{gl::{Gl, consts}, plan, state::State};"),
        ["gl", "plan", "state"]
    );
    assert_eq!(
        named("-> crate::state::Effect { crate::gl::x() }"),
        ["state", "gl"]
    );
    assert!(named("use super::x;").is_empty());
}

#[test]
fn a_module_imports_only_from_those_above_it() {
    let modules = modules();
    let place = |name: &str| modules.iter().position(|module| module == name);
    let mut wrong = Vec::new();
    for (path, text) in files("src") {
        let module = path.iter().nth(1).and_then(|name| name.to_str());
        let module = module.expect("a name").trim_end_matches(".rs");
        // The command and the root may import every module.
        let Some(own) = place(module) else {
            assert!(
                ["lib", "main", "cli"].contains(&module),
                "{} belongs to no module of src/lib.rs",
                path.display()
            );
            continue;
        };
        // A `use` may span several lines: join the whole statement.
        let joined: String = code(&text).flat_map(|(_, line)| [line, " "]).collect();
        for statement in joined.split(';') {
            for name in named(statement) {
                if place(&name).is_some_and(|other| other > own) {
                    wrong.push(format!("{}: {module} uses crate::{name}", path.display()));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Whether a line of code has the word `unsafe` (and not `unsafe_code`).
fn has_unsafe(line: &str) -> bool {
    line.match_indices("unsafe").any(|(at, word)| {
        let part = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let before = line[..at].chars().next_back().is_some_and(part);
        let after = line[at + word.len()..].chars().next().is_some_and(part);
        !before && !after
    })
}

#[test]
fn unsafe_is_where_opengl_is_called_only() {
    assert!(has_unsafe("unsafe { x() }") && !has_unsafe("#![forbid(unsafe_code)]"));
    let mut wrong = Vec::new();
    let mut seen = false;
    let all = ["src", "tests", "viewer"].map(files);
    for (path, text) in all.into_iter().flatten() {
        if path == Path::new("tests/layering.rs") {
            continue;
        }
        // The generator of the tables writes the word into its output.
        let places = [
            "src/gl",
            "tests/registry",
            "viewer/src/draw",
            "viewer/src/app/window.rs",
        ];
        let allowed = places.iter().any(|place| path.starts_with(place));
        for (at, line) in code(&text) {
            if has_unsafe(line) {
                seen |= allowed;
                if !allowed {
                    wrong.push(format!("{}:{}: {}", path.display(), at + 1, line.trim()));
                }
            }
        }
    }
    assert!(seen, "the search finds what is there");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_other_module_forbids_unsafe_code() {
    let missing: Vec<_> = files("src")
        .into_iter()
        .filter(|(path, _)| {
            let parts: Vec<_> = path.iter().filter_map(|part| part.to_str()).collect();
            match parts[..] {
                [_, "lib.rs"] => false,
                [_, _] => true,
                [_, folder, "mod.rs"] => folder != "gl",
                _ => false,
            }
        })
        .filter(|(_, text)| !text.lines().any(|line| line == "#![forbid(unsafe_code)]"))
        .map(|(path, _)| path.display().to_string())
        .collect();
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

#[test]
fn files_are_short() {
    let mut wrong = Vec::new();
    for folder in ["src", "shim", "tests", "viewer"] {
        for (path, text) in files(folder) {
            let lines = text.lines().count();
            let why = LONG.iter().find(|(long, _)| Path::new(long) == path);
            match why {
                None if lines > LONGEST => {
                    wrong.push(format!("{}: {lines} lines", path.display()));
                }
                Some((_, why)) if lines <= LONGEST => {
                    wrong.push(format!("{}: no longer long ({why})", path.display()));
                }
                _ => {}
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
