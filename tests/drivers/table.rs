//! The table of docs/drivers.md: the main tests on each driver. `MANYVIEW_DRIVERS=softpipe,zink on lavapipe` runs only these; the others keep their
//! rows.

use super::pictures::{Shown, shown};
use super::{Driver, NEWEST, UPRIGHT};
use crate::support::{bare, library, run, scratch, screen, target_folder};
use manyview::metric::Gate;
use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;

const PAGE: &str = "docs/drivers.md";
/// Demos of tests/oracle.rs: fixed function in immediate mode, arrays and display lists.
const FIXED: [&str; 3] = ["teapot", "arrays", "lists"];
/// A demo with shaders of its own.
const SHADERS: [&str; 1] = ["shade"];
/// Columns of tests/oracle.rs, with strategy and scenes.
const EXACT: [(&str, &str, &[&str]); 4] = [
    ("replay", "replay", &FIXED),
    ("instanced", "instanced", &FIXED),
    ("geometry", "geometry", &FIXED),
    ("shaders", "replay", &SHADERS),
];

/// A column of pictures, and tests of the same.
struct Column {
    name: &'static str,
    pictures: &'static [&'static str],
    /// The file of the tests, and their names; all tests of the file if there are none.
    file: Option<(&'static str, &'static [&'static str])>,
}

const MADE: [Column; 5] = [
    Column {
        name: "outputs",
        pictures: &["panel", "blended", "side by side", "anaglyph", "rgbd"],
        file: Some(("outputs", &[])),
    },
    Column {
        name: "view scale",
        pictures: &["view scale"],
        file: Some((
            "sampling",
            &[
                "whole_pixels_are_drawn_where_the_panel_shows_them",
                "textures_keep_their_level_of_detail",
            ],
        )),
    },
    Column {
        name: "depth-image",
        pictures: &["depth-image"],
        file: Some((
            "synthesis",
            &[
                "views_are_those_of_the_reference",
                "a_panel_s_picture_is_that_of_its_views",
            ],
        )),
    },
    Column {
        name: "hybrid",
        pictures: &["hybrid"],
        file: None,
    },
    Column {
        name: "occlusion",
        pictures: &["occlusion"],
        file: Some((
            "occlusion",
            &["the_reference_image_is_that_of_distorted_rays"],
        )),
    },
];

/// Where framebuffers are not upside down as windows are, the driver's own rounding differs. Measured on llvmpipe: at most 300 of 66,000 pixels, of
/// which 2 by more than 8 steps.
const UPRIGHT_GATE: Gate = Gate {
    differing: 0.01,
    over_one_per_million: None,
    outliers_per_million: 48.0,
};

/// Another rasteriser covers other pixels along edges. Pictures of one scene have at least this in common, in decibels.
const SIMILAR: f64 = 30.0;

/// Writes the table, a row after the other, and fails where a driver is not as good as the page promises.
pub(super) fn write(drivers: &[Driver]) {
    let only = std::env::var("MANYVIEW_DRIVERS").unwrap_or_default();
    let chosen = |driver: &&Driver| only.is_empty() || only.split(',').any(|n| n == driver.name);
    let mut wrong = Vec::new();
    for driver in drivers.iter().filter(chosen) {
        let (row, failures) = row(driver);
        println!("{row}");
        replace(drivers, driver, &row);
        let known = |failure: &String| driver.known.iter().any(|k| failure.starts_with(k));
        let new = failures.into_iter().filter(|failure| !known(failure));
        wrong.extend(new.map(|failure| format!("{}: {failure}", driver.name)));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Writes the page with the row of one driver made anew.
fn replace(drivers: &[Driver], driver: &Driver, row: &str) {
    let page = std::fs::read_to_string(PAGE).expect("a page");
    let old = |name: &str| page.lines().find(|l| l.starts_with(&format!("| {name} |")));
    let names = EXACT.iter().map(|(name, ..)| *name);
    let names = names
        .chain(["interleaved by"])
        .chain(MADE.iter().map(|c| c.name));
    let names: Vec<&str> = ["driver", "context"].into_iter().chain(names).collect();
    let mut table = vec![
        format!("| {} |", names.join(" | ")),
        format!("|{}", "---|".repeat(names.len())),
    ];
    table.extend(
        drivers
            .iter()
            .filter_map(|known| match known.name == driver.name {
                true => Some(row.to_owned()),
                false => old(known.name).map(str::to_owned),
            }),
    );
    let (before, rest) = page.split_once("| driver |").expect("a table");
    let after = rest.split_once("\n\n").map_or("", |(_, after)| after);
    let page = format!("{before}{}\n\n{after}", table.join("\n"));
    std::fs::write(PAGE, page).expect("written");
}

/// A row of the table, and what is wrong in it.
fn row(driver: &Driver) -> (String, Vec<String>) {
    let probe = probe(driver);
    let Some(version) = probe["version"].as_str() else {
        let row = format!("| {} | not on this machine |", driver.name);
        return (row, Vec::new());
    };
    let upright = probe["notes"].to_string().contains("flip_y");
    let mut wrong = Vec::new();
    let mut cells = vec![driver.name.to_owned(), version.to_owned()];
    cells.extend(oracle(driver, upright, &mut wrong));
    cells.extend(pictures(driver, upright, &mut wrong));
    (format!("| {} |", cells.join(" | ")), wrong)
}

/// The answer of `manyview-probe` in a context of the driver.
fn probe(driver: &Driver) -> Value {
    library();
    let screen = screen();
    let mut probe = bare(target_folder().join("manyview-probe"));
    probe.envs(driver.variables.iter().copied()).arg("glx");
    let output = screen.give(&mut probe).output().expect("the probe starts");
    serde_json::from_slice(&output.stdout).unwrap_or_default()
}

/// Runs tests of a file on the driver and returns what they print.
fn cargo(driver: &Driver, file: &str, names: &[String]) -> String {
    let cargo = std::env::var("CARGO").unwrap_or("cargo".to_owned());
    let mut command = Command::new(cargo);
    command.envs(driver.variables.iter().copied());
    command.args(["test", "--release", "--no-fail-fast", "--test", file, "--"]);
    command.args(names.first().map(|_| "--exact"));
    let (_, stdout, _) = run(command.args(names));
    stdout
}

/// Cells of strategies that draw all views, from the figures of tests/oracle.rs.
fn oracle(driver: &Driver, upright: bool, wrong: &mut Vec<String>) -> Vec<String> {
    let scenes = FIXED.iter().chain(&SHADERS);
    for file in scenes.clone().flat_map(|scene| figures_of(scene)) {
        let _ = std::fs::remove_file(file);
    }
    let names: Vec<String> = scenes.map(|scene| format!("glx::{scene}")).collect();
    cargo(driver, "oracle", &names);
    let mut cell = |(column, strategy, scenes): (&str, &str, &[&str])| {
        let of_scene = |scene: &&str| {
            let files = figures_of(scene).into_iter();
            let text: String = files
                .filter_map(|file| std::fs::read_to_string(file).ok())
                .collect();
            let lines = text
                .lines()
                .map(|line| serde_json::from_str(line).expect("JSON"));
            lines
                .filter(|line: &Value| line["strategy"] == strategy)
                .collect::<Vec<_>>()
        };
        let figures: Vec<_> = scenes.iter().map(of_scene).collect();
        judged(&figures, strategy, upright).unwrap_or_else(|failure| {
            wrong.push(format!("{column}: {failure}"));
            failure
        })
    };
    EXACT.map(&mut cell).into()
}

/// The files in which tests/oracle.rs leaves the figures of a scene, one for each choice of numbers of views.
fn figures_of(scene: &str) -> Vec<PathBuf> {
    let files = std::fs::read_dir(scratch("oracle/parts")).expect("a folder");
    let start = format!("{scene}-glx-");
    let of_scene = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with(&start)
    };
    files
        .flatten()
        .map(|file| file.path())
        .filter(of_scene)
        .collect()
}

/// The worst of a strategy's figures, of which each scene has one for each layout of the atlas: replay draws both, the others layers alone.
fn judged(scenes: &[Vec<Value>], strategy: &str, upright: bool) -> Result<String, String> {
    let layouts: &[&str] = match strategy {
        "replay" => &["layers", "side-by-side"],
        _ => &["layers"],
    };
    let has = |scene: &[Value], layout: &str| scene.iter().any(|line| line["atlas"] == layout);
    let all = |scene: &Vec<Value>| layouts.iter().all(|layout| has(scene, layout));
    if !scenes.iter().all(all) {
        return Err("no figures".to_owned());
    }
    let figures: Vec<_> = scenes.iter().flatten().collect();
    let worst = |what: &str| {
        let of = |f: &Value| f["same_offset"][what].as_u64().unwrap_or(u64::MAX);
        figures.iter().copied().map(of).max().unwrap_or(u64::MAX)
    };
    let [differing, outliers, coverage] = ["differing", "over_eight", "coverage"].map(worst);
    let pixels = figures[0]["pixels"].as_f64().unwrap_or(1.0);
    let outliers = outliers.max(coverage);
    let within = |gate: &Gate| {
        let most = |share: f64| (share * pixels).ceil() as u64;
        differing <= most(gate.differing) && outliers <= most(gate.outliers_per_million / 1e6)
    };
    let share = format!("{:.2} %", 100.0 * differing as f64 / pixels);
    let mut cell = match differing {
        0 => "equal".to_owned(),
        _ if within(&Gate::DESIGN) => "within the gate".to_owned(),
        _ if upright && within(&UPRIGHT_GATE) => share,
        _ => return Err(format!("{share}, {outliers} pixels by much")),
    };
    let drawn = |f: &Value| f["draws"].as_str().is_some_and(|d| d.contains(strategy));
    if !figures.iter().copied().any(drawn) {
        cell.push_str(", replayed");
    }
    Ok(cell)
}

/// Who interleaves, and how the pictures compare with those of the newest version.
fn pictures(driver: &Driver, upright: bool, wrong: &mut Vec<String>) -> Vec<String> {
    let newest = if upright { UPRIGHT } else { NEWEST };
    let mut cells = vec!["GPU".to_owned()];
    for column in &MADE {
        let made = column
            .pictures
            .iter()
            .map(|name| (name, shown(name, driver)));
        let made: Vec<(&&str, Shown)> = made.collect();
        // The distorted rays of occlusion need GLSL 1.50. Without, it is depth-image.
        let distorts = column.name != "occlusion" || driver.glsl >= 150;
        let undistorted = (!distorts).then(String::new);
        let refusals = made.iter().filter_map(|(_, shown)| shown.refusal.clone());
        let refused = refusals.chain(undistorted).next();
        if let Some(reason) = refused {
            // The passes need GLSL 1.30.
            if driver.glsl >= 130 && distorts {
                wrong.push(format!("{}: {reason}", column.name));
            }
            if column.name == "outputs" {
                "CPU".clone_into(&mut cells[0]);
            } else {
                cells.push("refused".to_owned());
                continue;
            }
        }
        let mut least = f64::INFINITY;
        for (name, shown) in &made {
            let expected = super::pictures::shown(name, &newest);
            if expected.differs(shown) > 0 {
                least = least.min(expected.psnr(shown));
                println!("{}, {name}: {:.1} dB", driver.name, expected.psnr(shown));
            }
        }
        // The CPU may round the other way, and triangles of the reference image are cut by tessellation.
        let uncut = column.name == "occlusion" && driver.glsl < 400;
        let exact = driver.llvmpipe && cells[0] == "GPU" && !uncut;
        if least < if exact { f64::INFINITY } else { SIMILAR } {
            wrong.push(format!("{}: {least:.1} dB", column.name));
        }
        let mut cell = match least {
            f64::INFINITY => "equal".to_owned(),
            least => format!("{least:.0} dB"),
        };
        if let Some((file, names)) = column.file {
            cell.push_str(&format!(", {}", tests(driver, file, names, wrong)));
        }
        cells.push(cell);
    }
    cells
}

/// How many tests of a file pass.
fn tests(driver: &Driver, file: &str, names: &[&str], wrong: &mut Vec<String>) -> String {
    let names: Vec<String> = names.iter().map(|&name| name.to_owned()).collect();
    let text = cargo(driver, file, &names);
    let ended = |how: &str| {
        let named = text.lines().filter_map(|line| line.strip_prefix("test "));
        let named = named.filter_map(|line| line.strip_suffix(how));
        named.map(str::to_owned).collect::<Vec<_>>()
    };
    let (passed, failed) = (ended(" ... ok").len(), ended(" ... FAILED"));
    let count = passed + failed.len();
    if count == 0 {
        wrong.push(format!("{file}: no test ran"));
    }
    wrong.extend(failed.iter().map(|name| format!("{file}: {name} fails")));
    format!("{passed} of {count} tests")
}

#[test]
fn a_scene_has_figures_of_each_layout() {
    let line = |strategy: &str, atlas: &str| {
        let none = serde_json::json!({"differing": 0, "over_eight": 0, "coverage": 0});
        serde_json::json!({"atlas": atlas, "draws": strategy, "pixels": 100, "same_offset": none})
    };
    let both = vec![line("replay", "layers"), line("replay", "side-by-side")];
    let [layers, beside] = [0, 1].map(|at| vec![both[at].clone()]);
    let cell = |scenes: &[Vec<Value>], strategy: &str| judged(scenes, strategy, false);
    assert_eq!(
        cell(&[both.clone(), both.clone()], "replay"),
        Ok("equal".into())
    );
    for lacking in [layers.clone(), beside.clone(), Vec::new()] {
        assert!(cell(&[both.clone(), lacking], "replay").is_err());
    }
    let instanced = vec![line("instanced", "layers")];
    assert_eq!(
        cell(std::slice::from_ref(&instanced), "instanced"),
        Ok("equal".into())
    );
    assert!(cell(&[instanced, beside], "instanced").is_err());
}
