//! piglit, the tests of OpenGL implementations: the same results with the layer as without it.
//!
//! Most of its tests draw off screen (`-fbo`), where the layer only has to stay out of the way. So there are runs "in windows" as well:
//! there every test draws to framebuffer 0, which the layer redirects. A result that differs and is not in `tests/piglit/known.txt` with
//! its reason is a failure. So is a line of that file that no longer differs, which also shows that the layer was there.

use crate::support;
use crate::support::{Screen, bare, has, layered, own_screen};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::IsTerminal;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Stdio;

/// How piglit's tests are run.
struct Mode {
    /// As in `known.txt`.
    name: &'static str,
    /// The layer's variables; `None`: it is not preloaded.
    layer: Option<&'static [(&'static str, &'static str)]>,
    /// All tests in windows, also those that piglit runs off screen.
    windows: bool,
    /// Not part of `make test`.
    long: bool,
}

const fn bare_mode(name: &'static str, windows: bool) -> Mode {
    Mode {
        name,
        layer: None,
        windows,
        long: false,
    }
}

const fn mode(
    name: &'static str,
    layer: &'static [(&'static str, &'static str)],
    windows: bool,
    long: bool,
) -> Mode {
    Mode {
        name,
        layer: Some(layer),
        windows,
        long,
    }
}

/// Modes; each bare run comes before those that are compared with it.
const MODES: [Mode; 8] = [
    bare_mode("bare", false),
    mode("off", &[("VIEWS", "3"), ("DISABLE", "1")], false, false),
    mode("one", &[("VIEWS", "1")], false, false),
    mode("three", &[("VIEWS", "3")], false, false),
    bare_mode("bare-windows", true),
    mode("three-windows", &[("VIEWS", "3")], true, false),
    mode(
        "geometry-windows",
        &[("VIEWS", "3"), ("STRATEGY", "geometry")],
        true,
        true,
    ),
    mode(
        "instanced-windows",
        &[("VIEWS", "3"), ("STRATEGY", "instanced")],
        true,
        true,
    ),
];

/// A choice of piglit's tests.
#[derive(Clone, Copy)]
enum Tests<'a> {
    /// By name, each in a process of its own.
    Named(&'a [String]),
    /// By name in a collection, several in one process.
    Grouped(&'a [String], &'a str),
    /// Those of a collection that regular expressions match.
    Found(&'a [&'a str], &'a str),
}

/// Tests of fixed function, and those that are programs of their own.
const ALL: Tests<'static> = Tests::Found(
    &[r"spec@!opengl 1\.", r"spec@!opengl 2\.", "fixed"],
    "quick_gl",
);
/// Programs with shaders.
const SHADERS: Tests<'static> = Tests::Found(
    &[
        r"spec@glsl-1\.[123]0@execution",
        r"spec@glsl-3\.30@execution",
    ],
    "quick",
);
/// Mesa 22.3 reads memory that is not its own in this test (valgrind says so without the layer as well): it fails or crashes.
const LEFT_OUT: &str = "polygon-mode-facing";
const SUBSET: &str = include_str!("piglit/subset.txt");
const KNOWN: &str = include_str!("piglit/known.txt");

/// piglit's result of one test.
#[derive(Debug, PartialEq, Eq)]
struct Outcome {
    result: String,
    subtests: BTreeMap<String, String>,
}

type Outcomes = BTreeMap<String, Outcome>;

/// A result that differs from that of the bare run.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Difference {
    mode: &'static str,
    /// Name of the test, and of the subtest after a `#`.
    test: String,
    bare: String,
    layered: String,
}

impl std::fmt::Display for Difference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Difference {
            mode,
            test,
            bare,
            layered,
        } = self;
        write!(f, "{mode} | {test} | {bare} -> {layered}")
    }
}

/// A line of `known.txt`: `MODE,… | TEST | BARE -> LAYERED | REASON`.
struct Known {
    modes: Vec<&'static str>,
    test: &'static str,
    bare: &'static str,
    layered: &'static str,
    reason: &'static str,
}

impl Known {
    fn covers(&self, difference: &Difference) -> bool {
        self.modes.contains(&difference.mode)
            && self.test == difference.test
            && self.bare == difference.bare
            && self.layered == difference.layered
    }
}

/// Lines that are neither empty nor a comment.
fn lines(text: &'static str) -> impl Iterator<Item = &'static str> {
    text.lines()
        .map(str::trim)
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
}

fn known() -> Vec<Known> {
    lines(KNOWN)
        .map(|line| {
            let parts: Vec<_> = line.split(" | ").map(str::trim).collect();
            let [modes, test, results, reason] = parts[..] else {
                panic!("known.txt: not four parts: {line}");
            };
            let (bare, layered) = results.split_once(" -> ").expect("BARE -> LAYERED");
            assert!(!reason.is_empty(), "known.txt: no reason: {line}");
            let modes: Vec<_> = modes.split(',').collect();
            for name in &modes {
                assert!(
                    MODES.iter().any(|m| m.name == *name),
                    "known.txt: no mode {name}"
                );
            }
            Known {
                modes,
                test,
                bare,
                layered,
                reason,
            }
        })
        .collect()
}

/// The folder of piglit's programs and data.
fn piglit_folder() -> PathBuf {
    let there = |path: PathBuf| path.join("bin").is_dir().then_some(path);
    let mut places = fs::read_dir("/usr/lib").expect("/usr/lib").flatten();
    places
        .find_map(|entry| there(entry.path().join("piglit")))
        .or_else(|| there("/usr/lib/piglit".into()))
        .expect("the folder of piglit's programs")
}

/// A folder in place of piglit's own, whose programs are run without `-fbo` and so in windows.
fn windows_folder(folder: &Path) -> PathBuf {
    let (piglit, ours) = (piglit_folder(), folder.join("windows"));
    let _ = fs::remove_dir_all(&ours);
    fs::create_dir_all(ours.join("bin")).expect("a folder");
    let script = format!(
        "#!/bin/sh\nfor word; do shift; [ \"$word\" = -fbo ] || set -- \"$@\" \"$word\"; done\nexec '{}/bin/'\"${{0##*/}}\" \"$@\"\n",
        piglit.display()
    );
    let wrapper = ours.join("wrapper");
    fs::write(&wrapper, script).expect("written");
    fs::set_permissions(&wrapper, fs::Permissions::from_mode(0o755)).expect("executable");
    for entry in fs::read_dir(&piglit).expect("a folder").flatten() {
        if entry.file_name() != "bin" {
            symlink(entry.path(), ours.join(entry.file_name())).expect("a link");
        }
    }
    for entry in fs::read_dir(piglit.join("bin"))
        .expect("a folder")
        .flatten()
    {
        symlink("../wrapper", ours.join("bin").join(entry.file_name())).expect("a link");
    }
    ours
}

/// Runs piglit's tests in a mode.
fn run(mode: &Mode, tests: Tests, name: &str, screen: &Screen, folder: &Path) -> Outcomes {
    let out = folder.join(name);
    let mut command = match mode.layer {
        None => bare("nice"),
        Some(layer) => layered("nice", layer),
    };
    if mode.windows {
        command.env("PIGLIT_BUILD_DIR", windows_folder(folder));
    }
    // One test at a time: windows that cover each other have undefined pixels.
    command
        .args("piglit run -p glx -j 1 --timeout 60 -o -l quiet".split(' '))
        .env("PIGLIT_COMPRESSION", "none");
    // piglit rewrites its progress in one line, which only a terminal can show.
    if !std::io::stderr().is_terminal() {
        command.stdout(Stdio::null());
    }
    if !matches!(tests, Tests::Named(_)) {
        // Thousands of small shaders: several in one process.
        command.args(["--process-isolation", "false"]);
    }
    let collection = match tests {
        Tests::Found(patterns, collection) => {
            for pattern in patterns {
                command.args(["-t", pattern]);
            }
            command.args(["-x", LEFT_OUT]);
            collection
        }
        Tests::Named(names) | Tests::Grouped(names, _) => {
            let list = folder.join(format!("{name}.list"));
            fs::write(&list, names.join("\n") + "\n").expect("written");
            command.arg("--test-list").arg(list);
            match tests {
                Tests::Grouped(_, collection) => collection,
                _ => "quick",
            }
        }
    };
    let start = std::time::Instant::now();
    let status = screen
        .give(command.arg(collection).arg(&out))
        .status()
        .expect("piglit");
    let outcomes = read(&out.join("results.json"));
    eprintln!(
        "piglit: {name}: {} tests, {} s{}",
        outcomes.len(),
        start.elapsed().as_secs(),
        counts(&outcomes)
    );
    assert!(status.success(), "piglit run: {status}");
    outcomes
}

fn counts(outcomes: &Outcomes) -> String {
    let mut counts = BTreeMap::<&str, usize>::new();
    for outcome in outcomes.values() {
        *counts.entry(&outcome.result).or_default() += 1;
    }
    counts
        .iter()
        .map(|(result, n)| format!(", {n} {result}"))
        .collect()
}

fn read(path: &Path) -> Outcomes {
    let text =
        fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let tests = json["tests"].as_object().expect("tests");
    tests
        .iter()
        .map(|(name, test)| {
            let text = |value: &serde_json::Value| value.as_str().map(str::to_owned);
            let subtests = test["subtests"].as_object().into_iter().flatten();
            let outcome = Outcome {
                result: text(&test["result"]).expect("a result"),
                subtests: subtests
                    .filter(|(name, _)| *name != "__type__")
                    .filter_map(|(name, result)| Some((name.clone(), text(result)?)))
                    .collect(),
            };
            (name.clone(), outcome)
        })
        .collect()
}

/// The results that differ: of subtests where both runs reached them, else of tests.
fn differences(mode: &'static str, before: &Outcomes, after: &Outcomes) -> Vec<Difference> {
    let mut found = Vec::new();
    let mut note = |test: String, bare: &str, layered: &str| {
        found.push(Difference {
            mode,
            test,
            bare: bare.to_owned(),
            layered: layered.to_owned(),
        });
    };
    for (test, bare) in before {
        let Some(layered) = after.get(test) else {
            note(test.clone(), &bare.result, "missing");
            continue;
        };
        let mut any = false;
        for (name, result) in &bare.subtests {
            if let Some(other) = layered.subtests.get(name)
                && other != result
            {
                any = true;
                note(format!("{test}#{name}"), result, other);
            }
        }
        if !any && bare.result != layered.result {
            note(test.clone(), &bare.result, &layered.result);
        }
    }
    found
}

/// The result of a test, or of a subtest after a `#`.
fn result<'a>(outcomes: &'a Outcomes, test: &str) -> Option<&'a str> {
    let (test, subtest) = match test.split_once('#') {
        Some((test, subtest)) => (test, Some(subtest)),
        None => (test, None),
    };
    let outcome = outcomes.get(test)?;
    match subtest {
        None => Some(&outcome.result),
        Some(name) => outcome.subtests.get(name).map(String::as_str),
    }
}

/// The tests of piglit that have a difference.
fn tests_of(differences: &[Difference]) -> Vec<String> {
    let names: BTreeSet<_> = differences
        .iter()
        .filter_map(|d| d.test.split('#').next().map(str::to_owned))
        .collect();
    names.into_iter().collect()
}

/// Compares modes on some tests; `MANYVIEW_PIGLIT_MODES=bare-windows,three-windows` asks for these only.
fn check(tests: Tests, name: &str, chosen: impl Fn(&Mode) -> bool) {
    if !has("piglit") {
        return;
    }
    let folder = support::scratch("piglit").join(name);
    fs::create_dir_all(&folder).expect("a folder");
    let screen = own_screen();
    let known = known();
    let (mut unknown, mut expected) = (Vec::new(), Vec::new());
    let mut base = Outcomes::new();
    let mut base_mode = &MODES[0];
    let mut stale = Vec::new();
    let wanted = std::env::var("MANYVIEW_PIGLIT_MODES").ok();
    let chosen = |mode: &&Mode| match &wanted {
        Some(names) => names.split(',').any(|name| name == mode.name),
        None => chosen(mode),
    };
    for mode in MODES.iter().filter(chosen) {
        let outcomes = run(mode, tests, mode.name, &screen, &folder);
        assert!(!outcomes.is_empty(), "piglit ran no test");
        if mode.layer.is_none() {
            (base, base_mode) = (outcomes, mode);
            continue;
        }
        let found = differences(mode.name, &base, &outcomes);
        let (listed, new): (Vec<_>, Vec<_>) = found
            .into_iter()
            .partition(|d| known.iter().any(|k| k.covers(d)));
        for line in &known {
            if line.modes.contains(&mode.name)
                && result(&base, line.test) == Some(line.bare)
                && !listed.iter().any(|d| line.covers(d))
            {
                stale.push(format!("{} | {}", mode.name, line.test));
            }
        }
        expected.extend(listed);
        if new.is_empty() {
            continue;
        }
        // Some tests are nondeterministic without the layer, too: only a result that differs twice counts.
        let again = tests_of(&new);
        let again = match tests {
            Tests::Named(_) => Tests::Named(&again),
            Tests::Found(_, collection) | Tests::Grouped(_, collection) => {
                Tests::Grouped(&again, collection)
            }
        };
        let before = run(base_mode, again, "again-bare", &screen, &folder);
        let after = run(mode, again, "again-layer", &screen, &folder);
        let twice = differences(mode.name, &before, &after);
        for difference in new {
            if twice.contains(&difference) {
                unknown.push(difference);
            } else {
                println!("varies: {difference}");
            }
        }
    }
    for difference in &expected {
        let line = known.iter().find(|k| k.covers(difference));
        let reason = line.map_or("", |k| k.reason);
        println!("known: {difference} | {reason}");
    }
    for difference in &unknown {
        println!("new: {difference}");
    }
    for line in &stale {
        println!("no longer differs: {line}");
    }
    println!(
        "{} known differences, {} new, {} no longer there; {}",
        expected.len(),
        unknown.len(),
        stale.len(),
        folder.display()
    );
    assert!(
        unknown.is_empty() && stale.is_empty(),
        "fix what is new, or add it to tests/piglit/known.txt with the reason; take out what no longer differs"
    );
}

#[test]
fn the_list_of_known_differences_can_be_read() {
    assert_eq!(known().len(), lines(KNOWN).count());
}

#[test]
fn differences_are_found_by_subtest_and_by_test() {
    let outcome = |result: &str, subtests: &[(&str, &str)]| Outcome {
        result: result.to_owned(),
        subtests: subtests
            .iter()
            .map(|&(name, result)| (name.to_owned(), result.to_owned()))
            .collect(),
    };
    let before = Outcomes::from([
        ("a".to_owned(), outcome("pass", &[])),
        (
            "b".to_owned(),
            outcome("fail", &[("x", "pass"), ("y", "fail")]),
        ),
        ("c".to_owned(), outcome("pass", &[("x", "pass")])),
        ("d".to_owned(), outcome("pass", &[])),
    ]);
    let after = Outcomes::from([
        ("a".to_owned(), outcome("pass", &[])),
        (
            "b".to_owned(),
            outcome("fail", &[("x", "fail"), ("y", "fail")]),
        ),
        ("c".to_owned(), outcome("crash", &[])),
    ]);
    let found: Vec<_> = differences("three", &before, &after)
        .iter()
        .map(ToString::to_string)
        .collect();
    assert_eq!(
        found,
        [
            "three | b#x | pass -> fail",
            "three | c | pass -> crash",
            "three | d | pass -> missing",
        ]
    );
}

#[test]
#[ignore = "a minute: make test-long"]
fn a_subset_gives_the_same_results() {
    let tests: Vec<_> = lines(SUBSET).map(str::to_owned).collect();
    check(Tests::Named(&tests), "subset", |mode| !mode.long);
}

#[test]
#[ignore = "minutes: make test-full"]
fn full_piglit_gives_the_same_results() {
    check(ALL, "full", |_| true);
}

#[test]
#[ignore = "half an hour: make test-full"]
fn full_shaders_give_the_same_results() {
    // `geometry` replays programs with shaders.
    check(SHADERS, "shaders", |mode| mode.name != "geometry-windows");
}
