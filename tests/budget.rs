//! Questions that the layer asks the driver, and round trips to the X server: none for a draw, and few for a swap. A driver that works on a
//! thread of its own has to catch up at each.
//!
//! tests/budget/counts.c counts them between two late swaps, behind the layer, and in the program alone; the difference is the layer's.

use crate::support::share;
use crate::support::{Compiled, Screen, bare, built, demo, layered, library, own_screen, succeed};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The most calls for each swap, whatever is drawn.
const FOR_A_SWAP: f64 = 8.0;
/// Calls are counted from the first of these swaps to the second one. Before, each kind of operation on matrices is compared with the driver.
const SWAPS: [u32; 2] = [60, 70];

/// A demo with its arguments.
type Scene = &'static [&'static str];

/// One of each kind: lists, fixed function, arrays, uniforms, passes, uniform blocks, immediate mode.
const KINDS: [Scene; 7] = [
    &["gears"],
    &["menu"],
    &["arrays", "--many", "300"],
    &["shade"],
    &["passes"],
    &["crowd"],
    &["blur"],
];

const SCENES: [Scene; 21] = [
    &["arrays"],
    &["arrays", "--many", "1000"],
    &["shade", "--glsl", "330"],
    &["shade", "--toon"],
    &["shade", "--sky"],
    &["shade", "--sky", "--glsl", "330"],
    &["immediate"],
    &["room"],
    &["mirror"],
    &["crowd", "--indirect"],
    &["fill"],
    &["teapot"],
    &["field"],
    &["mesh", "--vbo"],
    &["relief"],
    &["fogtexgen"],
    &["sky"],
    &["points"],
    &["clip"],
    &["echo"],
    &["prims"],
];

/// Scenes on EGL: desktop OpenGL and OpenGL ES.
const ON_EGL: [Scene; 2] = [
    &["gears", "--api", "egl"],
    &["shade", "--api", "egl", "--profile", "es3"],
];

/// Scenes that are known to ask more, the most calls for a swap, and why.
const MORE: [(Scene, f64, &str); 1] = [(
    &["lists"],
    20.0,
    "it executes lists while it compiles them, and after a list only the driver knows the values that it sets, and the raster position",
)];

fn counts() -> PathBuf {
    let source = Path::new("tests/budget/counts.c");
    built("counts", &[source], Compiled::Library, &["-ldl"])
}

/// Runs a demo, and reads what was counted.
fn counted(
    mut command: Command,
    screen: &Screen,
    scene: Scene,
    folder: &Path,
) -> BTreeMap<String, f64> {
    let out = folder.join("counts");
    let [from, to] = SWAPS;
    let frames = (to + 1).to_string();
    let (name, arguments) = scene.split_first().expect("a demo");
    command
        .arg(demo(name))
        .args(arguments)
        .args(["--frames", &frames, "--size", "96x64"])
        .env("COUNT_FROM", from.to_string())
        .env("COUNT_TO", to.to_string())
        .env("COUNT_OUT", &out);
    succeed(screen.give(&mut command));
    let text = std::fs::read_to_string(&out).unwrap_or_else(|e| panic!("{scene:?}: {e}"));
    std::fs::remove_file(&out).expect("removed");
    let line = |line: &str| {
        let (name, count) = line.split_once(' ').expect("a name and a number");
        (name.to_owned(), count.parse().expect("a number"))
    };
    text.lines().map(line).collect()
}

/// Calls of the layer for a swap, with what they are.
fn asked(screen: &Screen, scene: Scene, strategy: &str, counts: &Path) -> (f64, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut alone = bare("env");
    alone.env("LD_PRELOAD", counts);
    let own = counted(alone, screen, scene, folder.path());
    let options = [("VIEWS", "3"), ("OUTPUT", "panel"), ("STRATEGY", strategy)];
    let mut command = layered("env", &options);
    let both = format!("{}:{}", library().display(), counts.display());
    command.env("LD_PRELOAD", both);
    let all = counted(command, screen, scene, folder.path());
    let swaps = f64::from(SWAPS[1] - SWAPS[0]);
    let mut total = 0.0;
    let mut told = String::new();
    for (name, count) in &all {
        let more = (count - own.get(name).copied().unwrap_or(0.0)) / swaps;
        total += more.max(0.0);
        if more > 0.0 {
            told += &format!(" {name} {more}");
        }
    }
    (total, told)
}

#[track_caller]
fn within(scenes: &[Scene], strategies: &[&str]) {
    let (screen, counts) = (own_screen(), counts());
    let mut over = String::new();
    for &scene in scenes.iter().step_by(share::every(3)) {
        for strategy in strategies {
            let (calls, told) = asked(&screen, scene, strategy, &counts);
            if calls > FOR_A_SWAP {
                over += &format!("{scene:?} by {strategy}: {calls} calls a swap:{told}\n");
            }
        }
    }
    assert!(
        over.is_empty(),
        "more than {FOR_A_SWAP} calls a swap:\n{over}"
    );
}

#[test]
fn nothing_is_asked_for_a_draw_that_is_replayed() {
    within(&KINDS, &["replay"]);
}

#[test]
fn nothing_is_asked_on_egl() {
    within(&ON_EGL, &["replay"]);
}

#[test]
#[ignore = "minutes: make test-long"]
fn nothing_is_asked_by_any_strategy() {
    within(&KINDS, &["instanced", "geometry"]);
    within(&SCENES, &["replay", "instanced", "geometry"]);
}

/// Each reason is still one, and asks no more than it did.
#[test]
#[ignore = "minutes: make test-long"]
fn scenes_that_ask_more_are_known() {
    let (screen, counts) = (own_screen(), counts());
    for (scene, most, why) in MORE {
        let (calls, told) = asked(&screen, scene, "replay", &counts);
        assert!(
            calls <= most,
            "{scene:?}: {calls} calls a swap ({why}):{told}"
        );
        assert!(
            calls > FOR_A_SWAP,
            "{scene:?} is within the bound: it is one of SCENES now"
        );
    }
}
