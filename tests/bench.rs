//! `manyview bench`: its outputs, and its messages about bad input. No test depends on speed, except by a wide margin.

use crate::support;
use crate::support::{demo, library, manyview, refused, run, screen, succeed};
use manyview::bench::{Bench, PRESETS, PictureError, Row, SCENES, Spread, chart};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

fn json(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).expect("written");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn a_small_run_is_told_in_every_form() {
    library();
    demo("mesh");
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name);
    let screen = screen();
    let mut command = manyview();
    command
        .args("bench --scene mesh-10k --strategy replay-layers,instanced --views 2 --size 96x64 --frames 3".split(' '))
        .arg("--json")
        .arg(file("b.json"))
        .arg("--csv")
        .arg(file("b.csv"))
        .arg("--chart")
        .arg(file("b.png"));
    let output = succeed(screen.give(&mut command));
    let table = String::from_utf8(output.stdout).expect("UTF-8");
    assert!(
        table.contains("replay-layers") && table.contains("million triangles/s"),
        "{table}"
    );

    let bench = json(&file("b.json"));
    assert!(!bench["renderer"].as_str().expect("a renderer").is_empty());
    assert!(bench["date"].as_str().expect("a date").ends_with('Z'));
    assert_eq!(bench["command"][1], "bench");
    let rows = bench["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 2);
    for row in rows {
        assert_eq!(
            (&row["scene"], &row["views"]),
            (&"mesh-10k".into(), &2.into())
        );
        let [low, median, high] =
            ["low", "median", "high"].map(|q| row["times"][q].as_f64().expect("a number"));
        assert!(0.0 < low && low <= median && median <= high, "{row}");
        assert!(row["bare_ms"]["median"].as_f64().expect("a number") > 0.0);
        assert!(
            row["picture"]["ssim"].as_f64().expect("a number") > 0.9,
            "{row}"
        );
        // 96 x 64 pixels of 8 bytes.
        assert_eq!(row["view_bytes"], 2 * 96 * 64 * 8);
    }
    // The configuration that the others are compared with.
    assert_eq!(rows[0]["configuration"], "replay-layers");
    assert_eq!(rows[0]["picture"]["exact"], true);
    assert!(rows[0]["picture"]["psnr"].is_null());
    assert!(
        rows[1]["draws"]["instanced"].as_u64() > Some(0),
        "{}",
        rows[1]["draws"]
    );

    let csv = std::fs::read_to_string(file("b.csv")).expect("written");
    let widths: Vec<_> = csv.lines().map(|line| line.split(',').count()).collect();
    assert_eq!(widths.len(), 3, "{csv}");
    assert!(widths.iter().all(|width| *width == widths[0]), "{csv}");
    image::open(file("b.png")).expect("a picture");
}

fn row(scene: &'static str, configuration: &str, views: u32, times: f64, psnr: Option<f64>) -> Row {
    let spread = |median: f64| Spread {
        median,
        low: 0.9 * median,
        high: 1.2 * median,
    };
    Row {
        scene,
        width: 512,
        height: 384,
        views,
        configuration: configuration.to_owned(),
        view_scale: "1".to_owned(),
        disabled: None,
        frames_per_round: 1,
        ms: spread(10.0 * times),
        bare_ms: spread(10.0),
        times: spread(times),
        cpu_ms: 1.0,
        bare_cpu_ms: 1.0,
        gpu_ms: None,
        picture: PictureError {
            exact: psnr.is_none(),
            psnr,
            ssim: 1.0,
            worst: 0,
            wrong_subpixels_percent: 0.0,
        },
        view_bytes: None,
        paper: None,
        draws: BTreeMap::new(),
        fallbacks: BTreeMap::new(),
        notes: Vec::new(),
    }
}

#[test]
fn savings_are_told_below_the_table() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("b.json");
    let mut command = manyview();
    command.args(["bench", "--scene", "menu,field", "--strategy", "replay"]);
    command.args(["--disable", "mono,frustum", "--size", "256x192"]);
    command.args(["--frames", "3"]).arg("--json").arg(&out);
    library();
    demo("menu");
    let output = succeed(screen().give(&mut command));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let json = json(&out);
    let rows = json["rows"].as_array().expect("rows");
    let ms = |scene: &str, name: &str| {
        let found = |row: &&Value| row["scene"] == scene && row["configuration"] == name;
        let row = rows.iter().find(found).expect("a row");
        row["ms"]["median"].as_f64().expect("a number")
    };
    // Mono frames draw one view of a menu in place of eight: several times faster on any machine.
    let saved = ms("menu", "replay without mono") / ms("menu", "replay");
    assert!(saved > 2.0, "{saved}");
    let lines = text
        .split_once("optimisations:\n")
        .expect("a part of the text")
        .1;
    for start in [
        "  menu, 8 views, replay without mono: ",
        "  menu, 8 views, replay without frustum: ",
        "  field, 8 views, replay without mono: ",
        "  field, 8 views, replay without frustum: ",
    ] {
        assert!(lines.contains(start), "{start:?} in {lines}");
    }
}

#[test]
fn charts_are_pictures_with_all_names() {
    let mut rows = Vec::new();
    for scene in ["fill", "room", "mesh-4m"] {
        for (at, name) in [
            "replay",
            "instanced",
            "geometry",
            "auto",
            "instanced at 0.5",
        ]
        .into_iter()
        .enumerate()
        {
            let psnr = (at > 0).then_some(90.0 - 15.0 * at as f64);
            rows.push(row(scene, name, 8, 8.0 / (at + 1) as f64, psnr));
        }
    }
    for (views, name) in [
        (2, "replay"),
        (2, "instanced"),
        (4, "replay"),
        (4, "instanced"),
    ] {
        let times = if name == "replay" { 1.0 } else { 0.8 };
        let psnr = (name == "replay").then_some(62.0);
        rows.push(row("room", name, views, f64::from(views) * times, psnr));
    }
    let bench = Bench {
        date: "2026-01-01T00:00:00Z".to_owned(),
        command: Vec::new(),
        renderer: "none".to_owned(),
        version: "0".to_owned(),
        clock: "none",
        rounds: 1,
        warm_up: 1,
        preset: None,
        rows,
        limits: Vec::new(),
    };
    let folder = support::scratch("bench-charts");
    let (png, svg) = (folder.join("chart.png"), folder.join("chart.svg"));
    chart::write(&bench, &png).expect("drawn");
    chart::write(&bench, &svg).expect("drawn");
    let picture = support::rgb(&png);
    let colours: std::collections::BTreeSet<_> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(colours.len() > 20, "marks, lines and letters");
    let text = std::fs::read_to_string(&svg).expect("UTF-8");
    assert!(text.starts_with("<svg") && text.trim_end().ends_with("</svg>"));
    assert_eq!(
        text.matches("<text").count(),
        text.matches("</text>").count()
    );
    for name in ["mesh-4m", "instanced at 0.5", "exact", "PSNR"] {
        assert!(text.contains(name), "{name}");
    }
}

#[test]
fn what_cannot_be_measured_is_one_line() {
    for (arguments, part) in [
        (
            &["--scene", "teapot"][..],
            "--scene is 'teapot'; this version knows mesh-10k, ",
        ),
        (
            &["--strategy", "magic"],
            "--strategy is 'magic'; this version knows auto, replay, ",
        ),
        (
            &["--preset", "luo"],
            "--preset is 'luo'; this version knows luo-table1, ",
        ),
        (&["--views", "0"], "--views is '0'"),
        (&["--view-scale", "7"], "--view-scale is '7'"),
        (&["--size", "big"], "--size is 'big'"),
        (
            &["--frames", "0"],
            "--frames is '0'; give a whole number from 1 to 10000",
        ),
        (
            &["--chart", "chart.pdf"],
            "--chart is 'chart.pdf'; give a name that ends in .png or .svg",
        ),
        (
            &["--preset", "popescu-table1", "--display", "rows"],
            "--display does not go with --preset popescu-table1, which starts no program",
        ),
        (
            &["--preset", "popescu-table1", "--frames", "15"],
            "--frames does not go with",
        ),
        (
            &["--preset", "popescu-table1", "--api", "glx"],
            "--api does not go with",
        ),
        (
            &["--preset", "popescu-table1", "--size", "9x6,18x12"],
            "--size has several sizes",
        ),
        (
            &["--preset", "popescu-table1", "--chart", "frames.svg"],
            "--chart is 'frames.svg'; --preset popescu-table1 draws pictures",
        ),
        (
            &["--preset", "huebner-chart1", "--size", "512x512"],
            "--size does not go with --preset huebner-chart1, which starts no program",
        ),
        (
            &["--preset", "huebner-chart1", "--chart", "rates.pdf"],
            "--chart is 'rates.pdf'; give a name that ends in .png or .svg",
        ),
        (
            &["--fps", "30", "--frames", "1..9", "--", "glxgears"],
            "--frames is '1..9'; a walk of --fps takes the last frame or both ends",
        ),
        (
            &["--fps", "30", "--frames", "some", "--", "glxgears"],
            "--frames is 'some'; a walk of --fps takes",
        ),
        (
            &["--chart", "chart.svg", "--", "glxgears"],
            "--chart is drawn of scenes and of walks; leave it out, or give --fps",
        ),
        (
            &["--json", "/no/folder/b.json"],
            "the JSON cannot be written",
        ),
    ] {
        refused(&[&["bench"], arguments].concat(), 2, part);
    }
}

#[test]
fn missing_scenes_are_status_3() {
    // A library without the other files of a build beside it.
    let folder = tempfile::tempdir().expect("a folder");
    let copy = folder.path().join("lib").join("libmanyview.so");
    std::fs::create_dir(folder.path().join("lib")).expect("a folder");
    std::fs::copy(library(), &copy).expect("copied");
    let (status, _, stderr) = run(manyview()
        .args(["bench", "--scene", "fill"])
        .env("MANYVIEW_LIBRARY", &copy));
    assert_eq!(status, 3, "{stderr}");
    assert!(
        stderr.contains("the program fill of the scene fill is not in ")
            && stderr.contains("make demos"),
        "{stderr}"
    );
    assert_eq!(stderr.lines().count(), 1);
}

#[test]
fn the_list_has_all_names() {
    let (status, stdout, _) = run(manyview().args(["bench", "--list"]));
    assert_eq!(status, 0);
    let names = SCENES
        .iter()
        .map(|scene| scene.name)
        .chain(PRESETS.iter().map(|preset| preset.name));
    for name in names {
        assert!(
            stdout
                .lines()
                .any(|line| line.trim_start().starts_with(name)),
            "{name}"
        );
    }
}
