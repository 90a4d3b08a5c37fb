//! Random sequences of legal and illegal GL calls: the state, errors and pixels that a program can read are the same without the layer and
//! with it.
//!
//! `tests/random` makes them, each from a seed alone. A failure names the seeds and how to repeat one: `--trace` prints its
//! calls, `--drop` leaves out some of them (the head of `tests/random/main.c`).

pub(crate) mod build;

use crate::support::share;
use crate::support::{Screen, bare, layered, own_screen};
use std::path::Path;
use std::process::{Command, Stdio};

/// Classes of calls that no sequence has together: after a swap the front buffer of a window is partly undefined. There Mesa 22.3 reads the
/// earlier content, the layer the picture that was shown.
const APART: [&str; 2] = ["front", "swaps"];

/// Seeds that are known to differ, and the reason.
const KNOWN: [(u64, &str); 18] = [
    (63_298, DRAW_BUFFER),
    (65_024, FOLLOWS),
    (104_533, COLOUR),
    (106_362, COLOUR),
    (108_248, DRAW_BUFFER),
    (109_350, CURRENT),
    (109_738, DRAW_BUFFER),
    (109_793, COLOUR),
    (109_958, DRAW_BUFFER),
    (111_753, ZOOM),
    (111_843, DRAW_BUFFER),
    (112_359, CURRENT),
    (112_430, DRAW_BUFFER),
    (113_980, COLOUR),
    (114_633, WITHIN),
    (114_770, COLOUR),
    (114_801, DRAW_BUFFER),
    (115_141, DRAW_BUFFER),
];
const COLOUR: &str =
    "Mesa alone sets the colour from before a list's vertices again after it (docs/measured.md)";
const FOLLOWS: &str =
    "Mesa alone lets a material within a list's primitive override one that follows the colour";
const CURRENT: &str = "Mesa alone keeps a current value that glPopAttrib should restore, if a list has set it that calls glPushAttrib";
const WITHIN: &str = "a list with a whole primitive is called within another, which is an error: Mesa draws neither and makes the other calls of \
    the list, the layer makes those for each view (docs/limits.md)";
const ZOOM: &str = "in 32 bits: Mesa alone rounds the edges of zoomed pixels otherwise at another place in the framebuffer (docs/limits.md)";
const DRAW_BUFFER: &str = "Mesa alone keeps the draw buffer of framebuffer 0 with the drawable, if another framebuffer is bound while \
    the drawable is exchanged; the layer keeps it with the context";

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

/// The number of calls of a line of results.
fn calls(line: &str) -> Option<u64> {
    let (_, rest) = line.split_once(" calls ")?;
    rest.split(' ').next()?.parse().ok()
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
/// (`--disturb`), when lists are compiled in pieces (`--apart`), when new memory holds something else (`MALLOC_PERTURB_` of the C library), or
/// when the sequence is repeated. Some results of Mesa 22.3 depend on
/// earlier draws: the texture coordinates of pictures, the edges of a loop, the state that glPopAttrib restores, the current values after a
/// list; others depend on uninitialised memory. Such a sequence has no right answer.
fn is_nondeterministic(bare: &Side, layer: &Side, wrong: &Wrong, without: &str) -> bool {
    let words = |side: &Side, more: &[&str]| {
        let (lines, _) = side.lines(side.command(wrong.seed, 1, without, more));
        words(&lines.join(" "))
    };
    let expected = words(bare, &[]);
    let actual = words(layer, &[]);
    let mut others: Vec<_> = (0..AGAIN).map(|_| words(bare, &[])).collect();
    let repeats = others.iter().all(|words| *words == expected);
    // A difference in those other runs alone is no excuse while the bare answer repeats and equals the layer's.
    if expected == actual && repeats {
        return varies_in_its_batch(bare, wrong, without);
    }
    others.extend([words(bare, &["--disturb"]), words(bare, &["--apart"])]);
    let memory = |byte: &str| {
        let mut command = bare.command(wrong.seed, 1, without, &[]);
        command.env("MALLOC_PERTURB_", byte);
        let (lines, _) = bare.lines(command);
        self::words(&lines.join(" "))
    };
    others.extend(["85", "170"].map(memory));
    explains(&others, &expected, &actual)
}

/// Whether Mesa alone gives other answers wherever the layer has, when the sequence follows on those before it in the same process: they leave
/// memory that is not the same each time. A sequence without an answer was not reached by the layer, which nothing excuses.
fn varies_in_its_batch(bare: &Side, wrong: &Wrong, without: &str) -> bool {
    let Some([expected, actual]) = &wrong.answers else {
        return false;
    };
    let answer = || {
        let count = wrong.seed + 1 - wrong.first;
        let (lines, _) = bare.lines(bare.command(wrong.first, count, without, &[]));
        let own = lines.iter().find(|line| seed(line) == Some(wrong.seed));
        words(own.map_or("", String::as_str))
    };
    let others: Vec<_> = (0..AGAIN).map(|_| answer()).collect();
    explains(&others, &words(expected), &words(actual))
}

fn words(line: &str) -> Vec<String> {
    line.split(' ').map(str::to_owned).collect()
}

/// Whether each word that differs is another one in some other run as well.
fn explains(others: &[Vec<String>], expected: &[String], actual: &[String]) -> bool {
    let mut all = others.iter().map(Vec::len).chain([actual.len()]);
    let other = |i: usize| others.iter().any(|words| words[i] != expected[i]);
    all.all(|len| len == expected.len())
        && (0..expected.len()).all(|i| actual[i] == expected[i] || other(i))
}

/// A sequence with other answers under the layer.
struct Wrong {
    /// The first seed of its process.
    first: u64,
    seed: u64,
    /// Its lines without the layer and with it, if both were reached.
    answers: Option<[String; 2]>,
}

/// The first of some seeds, in the ordinary run.
fn some(seeds: std::ops::Range<u64>) -> std::ops::Range<u64> {
    seeds.start..seeds.start + (seeds.end - seeds.start) / share::every(4) as u64
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
    let mut wrong: Vec<Wrong> = Vec::new();
    let (mut compared, mut called) = (0, 0);
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
        called += expected.iter().filter_map(|line| calls(line)).sum::<u64>();
        let differ = expected.iter().filter(|line| !actual.contains(line));
        wrong.extend(differ.filter_map(|line| {
            let seed = seed(line)?;
            let with = actual.iter().find(|with| self::seed(with) == Some(seed));
            let answers = with.map(|with| [line.clone(), with.clone()]);
            Some(Wrong {
                first,
                seed,
                answers,
            })
        }));
        if !fine && actual.len() < expected.len() {
            let last = actual.last().and_then(|line| seed(line));
            wrong.push(Wrong {
                first,
                seed: last.map_or(first, |last| last + 1),
                answers: None,
            });
        }
        first = if end < first + count { end + 1 } else { end };
    }
    assert!(
        compared * 100 >= (seeds.end - seeds.start) * 99,
        "only {compared} sequences went through without the layer"
    );
    wrong.sort_by_key(|wrong| wrong.seed);
    wrong.dedup_by_key(|wrong| wrong.seed);
    wrong.retain(|wrong| !KNOWN.iter().any(|(known, _)| *known == wrong.seed));
    let found = wrong.len() as u64;
    wrong.retain(|wrong| !is_nondeterministic(&bare, &layer, wrong, without));
    let nondeterministic = found - wrong.len() as u64;
    let shown: Vec<String> = wrong
        .iter()
        .take(SHOWN)
        .map(|wrong| explain(&bare, &layer, wrong.seed, without))
        .collect();
    assert!(
        wrong.is_empty(),
        "{} of {compared} sequences differ: {:?}\n{}",
        wrong.len(),
        wrong.iter().map(|wrong| wrong.seed).collect::<Vec<_>>(),
        shown.join("\n")
    );
    assert!(
        nondeterministic * 100 <= compared.max(100) * NONDETERMINISTIC_PER_CENT,
        "Mesa alone is nondeterministic on {nondeterministic} of {compared} sequences"
    );
    println!(
        "{compared} sequences of {called} calls are the same, but {nondeterministic} on which Mesa alone is nondeterministic"
    );
}

#[test]
fn random_calls_side_by_side() {
    compare(Api::Egl, "side-by-side", "replay", some(0..100));
}

#[test]
fn random_calls_in_layers() {
    compare(Api::Egl, "layers", "replay", some(10_000..10_050));
}

/// What is drawn to the samples of a panel is put back before anything else.
#[test]
fn random_calls_with_points_once() {
    compare(Api::Egl, "layers", "splats", some(30_000..30_040));
}

#[test]
fn random_calls_in_windows() {
    let [front, _] = APART;
    compare_without(
        front,
        Api::Glx,
        "side-by-side",
        "replay",
        some(20_000..20_050),
    );
}

#[test]
fn random_calls_with_front_buffers() {
    let [_, swaps] = APART;
    compare_without(
        swaps,
        Api::Glx,
        "side-by-side",
        "replay",
        some(21_000..21_030),
    );
    compare_without(swaps, Api::Glx, "layers", "replay", some(21_030..21_050));
}

#[test]
#[ignore = "a minute: make test-long"]
fn random_calls_of_further_seeds() {
    compare(Api::Egl, "side-by-side", "replay", 100..200);
    compare(Api::Egl, "layers", "replay", 10_050..10_100);
}

/// A context draws to several drawables and reads from others, in 30 of 100 sequences of this test and of the others.
#[test]
#[ignore = "a minute: make test-long"]
fn random_calls_to_several_drawables() {
    let [front, swaps] = APART;
    compare(Api::Egl, "layers", "replay", 63_000..63_300);
    compare_without(front, Api::Glx, "side-by-side", "replay", 64_000..64_100);
    compare_without(swaps, Api::Glx, "layers", "replay", 65_000..65_100);
}

#[test]
fn random_calls_in_memory() {
    compare(Api::OsMesa, "side-by-side", "replay", some(30_000..30_050));
}

#[test]
fn random_calls_by_geometry_shader() {
    compare(Api::Egl, "layers", "geometry", some(42_100..42_150));
}

#[test]
fn random_calls_by_instances() {
    compare(Api::Egl, "layers", "instanced", some(41_000..41_050));
}

#[test]
fn random_calls_by_depth_images() {
    compare(
        Api::Egl,
        "side-by-side",
        "depth-image",
        some(43_000..43_030),
    );
    compare(Api::Egl, "layers", "depth-image", some(43_060..43_080));
    compare(
        Api::OsMesa,
        "side-by-side",
        "depth-image",
        some(43_090..43_100),
    );
}

#[test]
fn random_calls_by_several_true_views() {
    compare(Api::Egl, "side-by-side", "hybrid", some(45_000..45_030));
    compare(Api::Egl, "layers", "hybrid", some(45_060..45_080));
    compare(Api::OsMesa, "side-by-side", "hybrid", some(45_090..45_100));
}

#[test]
fn random_calls_by_an_occlusion_camera() {
    compare(Api::Egl, "side-by-side", "occlusion", some(44_000..44_030));
    compare(Api::Egl, "layers", "occlusion", some(44_060..44_080));
    compare(
        Api::OsMesa,
        "side-by-side",
        "occlusion",
        some(44_090..44_100),
    );
}

/// 15,400 sequences in all, more than two million calls.
mod full_ten_thousand {
    use super::{APART, Api, compare, compare_without};

    #[test]
    #[ignore = "many minutes: make random"]
    fn in_windows_side_by_side() {
        let [front, _] = APART;
        compare_without(front, Api::Glx, "side-by-side", "replay", 100_000..101_000);
    }

    #[test]
    #[ignore = "many minutes: make random"]
    fn in_windows_in_layers() {
        let [_, swaps] = APART;
        compare_without(swaps, Api::Glx, "layers", "replay", 101_000..102_000);
    }

    #[test]
    #[ignore = "many minutes: make random"]
    fn in_memory_side_by_side() {
        compare(Api::OsMesa, "side-by-side", "replay", 102_000..103_000);
    }

    #[test]
    #[ignore = "many minutes: make random"]
    fn in_memory_in_layers() {
        compare(Api::OsMesa, "layers", "replay", 103_000..104_000);
    }

    #[test]
    #[ignore = "many minutes: make random"]
    fn side_by_side() {
        compare(Api::Egl, "side-by-side", "replay", 104_000..107_000);
    }

    #[test]
    #[ignore = "many minutes: make random"]
    fn further_side_by_side() {
        compare(Api::Egl, "side-by-side", "replay", 110_000..112_000);
    }

    #[test]
    #[ignore = "many minutes: make random"]
    fn in_layers() {
        compare(Api::Egl, "layers", "replay", 107_000..110_000);
    }

    #[test]
    #[ignore = "many minutes: make random"]
    fn further_in_layers() {
        compare(Api::Egl, "layers", "replay", 112_000..115_400);
    }
}
