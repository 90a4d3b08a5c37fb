//! Random sequences of legal and illegal GL calls: the state, errors and pixels that a program can read are the same without the layer and
//! with it.
//!
//! `tests/random` makes them, each from a seed alone. A failure names the seeds and how to repeat one: `--trace` prints its
//! calls, `--drop` leaves out some of them (the head of `tests/random/main.c`).
#![forbid(unsafe_code)]

mod support;

#[path = "random/build.rs"]
mod build;

use std::path::Path;
use std::process::{Command, Stdio};
use support::{Screen, bare, layered, own_screen};

/// Classes of calls that no sequence has together: after a swap the front buffer of a window is partly undefined. There Mesa 22.3 reads the
/// earlier content, the layer the picture that was shown.
const APART: [&str; 2] = ["front", "swaps"];

/// Seeds that are known to differ, and the reason.
const KNOWN: [(u64, &str); 6] = [
    (104_533, COLOUR),
    (
        104_549,
        "a list with a whole primitive is called within another: Mesa draws neither, the layer the outer one",
    ),
    (
        105_854,
        "Mesa draws nothing of a list whose first normal stands within its second primitive; here such a list is a piece of the program's",
    ),
    (
        108_300,
        "after a draw of no instances Mesa gives a list an earlier colour, if the glColor before it was compiled into another",
    ),
    (108_733, COLOUR),
    (109_793, COLOUR),
];
const COLOUR: &str =
    "Mesa alone sets the colour from before a list's vertices again after it (docs/measured.md)";

/// Sequences in one process; a crash loses only these.
const BATCH: u64 = 50;
/// Number of sequences in a hundred that may be nondeterministic in Mesa alone ([`is_nondeterministic`]).
const NONDETERMINISTIC_PER_CENT: u64 = 3;
/// How often a sequence that differs is repeated.
const AGAIN: usize = 8;
/// How many failures are shown.
const SHOWN: usize = 5;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Api {
    Egl,
    Glx,
    OsMesa,
}

/// One program, bare or under the layer.
struct Side<'a> {
    screen: Option<&'a Screen>,
    program: &'a Path,
    api: Api,
    atlas: Option<&'a str>,
    strategy: &'a str,
}

impl Side<'_> {
    fn command(&self, first: u64, count: u64, without: &str, more: &[&str]) -> Command {
        let mut command = match self.atlas {
            None => bare(self.program),
            Some(atlas) => layered(
                self.program,
                &[
                    ("VIEWS", "3"),
                    ("STRATEGY", self.strategy),
                    ("ATLAS", atlas),
                ],
            ),
        };
        command
            .args(["--api", if self.api == Api::Glx { "glx" } else { "egl" }])
            .args(["--seed", &first.to_string(), "--count", &count.to_string()])
            .args(["--without", without])
            .args(more)
            // Most of the time goes into compiling shaders that draw a few triangles each.
            .env("GALLIVM_PERF", "nopt")
            .stderr(Stdio::null());
        if let Some(screen) = self.screen {
            screen.give(&mut command);
        }
        command
    }

    /// The lines of some seeds, and whether all went through without a crash.
    fn lines(&self, mut command: Command) -> (Vec<String>, bool) {
        let output = command.output().expect("it starts");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        // Shaders draw within the gate of `metric`, not bit by bit: with them only state and errors are compared.
        let told = |line: &str| match line.split_once(" pixels ") {
            Some((told, _)) if self.strategy != "replay" => told.to_owned(),
            _ => line.to_owned(),
        };
        (text.lines().map(told).collect(), output.status.success())
    }
}

/// The seed of a line of results.
fn seed(line: &str) -> Option<u64> {
    line.strip_prefix("seed ")?.split(' ').next()?.parse().ok()
}

/// The first line that differs for one seed, with every result printed.
fn explain(bare: &Side, layer: &Side, seed: u64, without: &str) -> String {
    let lines = |side: &Side| side.lines(side.command(seed, 1, without, &["--verbose"]));
    let (expected, actual) = (lines(bare), lines(layer));
    let first = expected.0.iter().zip(&actual.0).find(|(a, b)| a != b);
    let what = match first {
        Some((a, b)) => format!("  bare:  {a}\n  layer: {b}"),
        None => format!("  {} and {} lines", expected.0.len(), actual.0.len()),
    };
    let end = if actual.1 { "" } else { " (it crashed)" };
    format!(
        "seed {seed}{end}:\n{what}\n  {:?}",
        layer.command(seed, 1, without, &["--trace"])
    )
}

/// Whether Mesa alone gives other answers, and the layer differs in nothing else: when calls come in between that no program could notice
/// (`--disturb`), when lists are compiled in pieces (`--apart`), or when the sequence is repeated. Some results of Mesa 22.3 depend on
/// earlier draws: the texture coordinates of pictures, the edges of a loop, the state that glPopAttrib restores, the current values after a
/// list; others depend on uninitialised memory. Such a sequence has no right answer.
fn is_nondeterministic(
    bare: &Side,
    layer: &Side,
    (first, seed): (u64, u64),
    without: &str,
) -> bool {
    let by_itself = answers(bare, layer, (seed, seed), without);
    let in_its_batch = || answers(bare, layer, (first, seed), without);
    match by_itself {
        Answers::Differ => false,
        Answers::Vary => true,
        // Memory that an earlier sequence of the same process has left is not the same each time.
        Answers::Agree => first < seed && in_its_batch() == Answers::Vary,
    }
}

/// What the program answers without the layer and with it.
#[derive(PartialEq, Eq)]
enum Answers {
    /// The same, each time.
    Agree,
    /// Other answers without the layer, too, wherever those with it differ.
    Vary,
    /// Other answers with the layer than without it.
    Differ,
}

/// The answers to the sequence of one seed, with those of the seeds from `first` on before it in the same process.
fn answers(bare: &Side, layer: &Side, (first, of): (u64, u64), without: &str) -> Answers {
    let words = |side: &Side, more: &[&str]| -> Vec<String> {
        let (lines, _) = side.lines(side.command(first, of + 1 - first, without, more));
        let own = lines.iter().filter(|line| seed(line) == Some(of));
        let words = own.flat_map(|line| line.split(' '));
        words.map(str::to_owned).collect()
    };
    let expected = words(bare, &[]);
    let actual = words(layer, &[]);
    let mut others: Vec<_> = (0..AGAIN).map(|_| words(bare, &[])).collect();
    let repeats = others.iter().all(|words| *words == expected);
    // A difference in the runs that follow alone is no excuse while the bare answer repeats and equals the layer's.
    if expected == actual && repeats {
        return Answers::Agree;
    }
    others.extend([words(bare, &["--disturb"]), words(bare, &["--apart"])]);
    let other = |i: usize| others.iter().any(|words| words[i] != expected[i]);
    let vary = others
        .iter()
        .chain([&actual])
        .all(|w| w.len() == expected.len())
        && (0..expected.len()).all(|i| actual[i] == expected[i] || other(i));
    match vary {
        true => Answers::Vary,
        false => Answers::Differ,
    }
}

fn compare(api: Api, atlas: &str, strategy: &str, seeds: std::ops::Range<u64>) {
    compare_without("", api, atlas, strategy, seeds);
}

fn compare_without(
    without: &str,
    api: Api,
    atlas: &str,
    strategy: &str,
    seeds: std::ops::Range<u64>,
) {
    let screen = (api == Api::Glx).then(own_screen);
    let program = build::program(api == Api::OsMesa);
    let side = |atlas| Side {
        screen: screen.as_ref(),
        program: &program,
        api,
        atlas,
        strategy,
    };
    let (bare, layer) = (side(None), side(Some(atlas)));
    let run =
        |side: &Side, first: u64, count: u64| side.lines(side.command(first, count, without, &[]));
    // The first seed of the process, and the seed that differs.
    let mut wrong: Vec<(u64, u64)> = Vec::new();
    let mut compared = 0;
    let mut first = seeds.start;
    while first < seeds.end {
        let count = BATCH.min(seeds.end - first);
        let (expected, (actual, fine)) = std::thread::scope(|scope| {
            let expected = scope.spawn(|| run(&bare, first, count));
            let actual = run(&layer, first, count);
            (expected.join().expect("no panic").0, actual)
        });
        // Mesa itself crashes at times; the run goes on with the next sequence.
        let reached = expected.last().and_then(|line| seed(line));
        let end = reached.map_or(first, |last| last + 1);
        compared += end - first;
        let differ = expected.iter().filter(|line| !actual.contains(line));
        let differ = differ.filter_map(|line| seed(line));
        wrong.extend(differ.map(|seed| (first, seed)));
        if !fine && actual.len() < expected.len() {
            let last = actual.last().and_then(|line| seed(line));
            wrong.push((first, last.map_or(first, |last| last + 1)));
        }
        first = if end < first + count { end + 1 } else { end };
    }
    assert!(
        compared * 100 >= (seeds.end - seeds.start) * 99,
        "only {compared} sequences went through without the layer"
    );
    wrong.sort_unstable();
    wrong.dedup();
    wrong.retain(|(_, seed)| !KNOWN.iter().any(|(known, _)| known == seed));
    let found = wrong.len() as u64;
    wrong.retain(|&seeds| !is_nondeterministic(&bare, &layer, seeds, without));
    let nondeterministic = found - wrong.len() as u64;
    let shown: Vec<String> = wrong
        .iter()
        .take(SHOWN)
        .map(|&(_, seed)| explain(&bare, &layer, seed, without))
        .collect();
    assert!(
        wrong.is_empty(),
        "{} of {compared} sequences differ: {wrong:?}\n{}",
        wrong.len(),
        shown.join("\n")
    );
    assert!(
        nondeterministic * 100 <= compared.max(100) * NONDETERMINISTIC_PER_CENT,
        "Mesa alone is nondeterministic on {nondeterministic} of {compared} sequences"
    );
    println!(
        "{compared} sequences are the same, but {nondeterministic} on which Mesa alone is nondeterministic"
    );
}

#[test]
fn random_calls_side_by_side() {
    compare(Api::Egl, "side-by-side", "replay", 0..200);
}

#[test]
fn random_calls_in_layers() {
    compare(Api::Egl, "layers", "replay", 10_000..10_100);
}

#[test]
fn random_calls_in_windows() {
    let [front, _] = APART;
    compare_without(front, Api::Glx, "side-by-side", "replay", 20_000..20_050);
}

#[test]
fn random_calls_with_front_buffers() {
    let [_, swaps] = APART;
    compare_without(swaps, Api::Glx, "side-by-side", "replay", 21_000..21_030);
    compare_without(swaps, Api::Glx, "layers", "replay", 21_030..21_050);
}

#[test]
fn random_calls_in_memory() {
    compare(Api::OsMesa, "side-by-side", "replay", 30_000..30_050);
}

#[test]
fn random_calls_by_geometry_shader() {
    compare(Api::Egl, "layers", "geometry", 42_100..42_150);
}

#[test]
fn random_calls_by_instances() {
    compare(Api::Egl, "layers", "instanced", 41_000..41_050);
}

#[test]
fn random_calls_by_depth_images() {
    compare(Api::Egl, "side-by-side", "depth-image", 43_000..43_060);
    compare(Api::Egl, "layers", "depth-image", 43_060..43_090);
    compare(Api::OsMesa, "side-by-side", "depth-image", 43_090..43_110);
}

#[test]
fn random_calls_by_several_true_views() {
    compare(Api::Egl, "side-by-side", "hybrid", 45_000..45_060);
    compare(Api::Egl, "layers", "hybrid", 45_060..45_090);
    compare(Api::OsMesa, "side-by-side", "hybrid", 45_090..45_110);
}

#[test]
fn random_calls_by_an_occlusion_camera() {
    compare(Api::Egl, "side-by-side", "occlusion", 44_000..44_060);
    compare(Api::Egl, "layers", "occlusion", 44_060..44_090);
    compare(Api::OsMesa, "side-by-side", "occlusion", 44_090..44_110);
}

#[test]
#[ignore = "minutes"]
fn full_ten_thousand_random_sequences() {
    compare(Api::Egl, "side-by-side", "replay", 100_000..110_000);
}
