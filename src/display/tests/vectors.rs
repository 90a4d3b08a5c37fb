//! Views that others give, or that follow by hand from published formulas.

use super::*;

fn written(text: &str, file: &str) -> Display {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(file);
    fs::write(&path, text).unwrap();
    Display::load(path.to_str().unwrap()).unwrap()
}

fn device(pitch: f64, slope: f64, center: f64, (w, h): (u32, u32), dpi: f64) -> String {
    format!(
        r#"{{"serial": "LKG-PTEST", "pitch": {{"value": {pitch}}}, "slope": {{"value": {slope}}}, "center": {{"value": {center}}},
        "viewCone": {{"value": 40}}, "invView": {{"value": 1}}, "verticalAngle": {{"value": 0}}, "DPI": {{"value": {dpi}}},
        "screenW": {{"value": {w}}}, "screenH": {{"value": {h}}}, "flipImageX": {{"value": 0}}, "flipImageY": {{"value": 0}},
        "flipSubp": {{"value": 0}}}}"#
    )
}

/// A Portrait whose numbers are public.
fn portrait() -> Display {
    let text = device(
        52.594_383_239_746_094,
        -7.211_529_254_913_33,
        0.402_773_827_314_376_83,
        (1536, 2048),
        324.0,
    );
    written(&text, "visual.json")
}

/// An 8.9" whose numbers are public.
fn small() -> Display {
    let text = device(
        49.818_042_755_126_95,
        5.044_347_763_061_523,
        0.176_902_174_949_646,
        (2560, 1600),
        338.0,
    );
    written(&text.replace("LKG-P", "LKG-2K"), "visual.json")
}

#[test]
fn looking_glass_views_of_the_notes() {
    let display = portrait();
    assert_eq!((display.views, display.facts.quilt), (48, Some((8, 6))));
    let mask = mask(&display, 1536, 2048, 48);
    // Rows count from the bottom there.
    assert_eq!(mask.at(0, 2047), Some([16, 13, 10]));
    assert_eq!(mask.at(768, 2047 - 1024), Some([32, 29, 27]));
    let display = small();
    assert_eq!(display.views, 45);
    let mask = super::mask(&display, 2560, 1600, 45);
    assert_eq!(mask.at(1280, 1599 - 800), Some([4, 2, 0]));
}

#[test]
fn looking_glass_derived_numbers_of_the_notes() {
    let of = |display: &Display| match &display.kind {
        Kind::LookingGlass(device) => (device.lenses(), device.tilt(), device.width),
        _ => panic!("a Looking Glass"),
    };
    let near = |a: f64, b: f64, digits: i32| (a - b).abs() < 0.6 * 10f64.powi(-digits);
    let (p, tilt, width) = of(&portrait());
    assert!(
        near(p, 246.973_180, 6) && near(tilt, -0.184_889_125, 9),
        "{p} {tilt}"
    );
    assert!(near(3.0 * f64::from(width) / p, 18.6579, 4));
    let (p, tilt, width) = of(&small());
    assert!(
        near(p, 370.117_407, 6) && near(tilt, 0.123_901_053, 9),
        "{p} {tilt}"
    );
    assert!(near(3.0 * f64::from(width) / p, 20.7502, 4));
}

/// A model, a calibration of one of its devices, and the views of some pixels: x, row from the top, R, G and B. By `scripts/golden-masks.py`.
#[derive(serde::Deserialize)]
struct Golden {
    model: String,
    quilt: (u32, u32),
    calibration: serde_json::Value,
    pixels: Vec<(i32, i32, u16, u16, u16)>,
}

#[test]
fn every_looking_glass_has_its_mask() {
    let all: Vec<Golden> = serde_json::from_str(include_str!("looking_glass.json")).unwrap();
    for golden in &all {
        let name = &golden.model;
        let display = written(&golden.calibration.to_string(), "visual.json");
        let model = Display::named(name).unwrap();
        assert_eq!(display.facts.quilt, Some(golden.quilt), "{name}");
        assert_eq!(display.facts, model.facts, "{name}");
        let (width, height) = display.facts.screen.unwrap();
        assert!(golden.pixels.len() > 35, "{name}");
        for &(x, y, red, green, blue) in &golden.pixels {
            let whole = Placement::full_screen(width, height);
            let place = Placement {
                x,
                y,
                width: 1,
                height: 1,
                ..whole
            };
            let mask = display.mask(&place, display.views).unwrap();
            assert_eq!(mask.at(0, 0), Some([red, green, blue]), "{name} {x} {y}");
        }
    }
    for builtin in crate::display::builtins() {
        let tested = all.iter().any(|golden| golden.model == builtin.name);
        assert_eq!(
            tested,
            builtin.name.starts_with("looking-glass-"),
            "{}",
            builtin.name
        );
    }
}

#[test]
fn the_generic_eight_view_formula() {
    // view = ⌊3x + slope·y + shift + c⌋ mod 8 with the slopes that sources name.
    for (numerator, denominator) in [(2u64, 3u64), (4, 5), (40, 51)] {
        let text = format!(
            "kind = \"slanted\"\nviews = 8\npitch = 8\nslant = \"{numerator}/{denominator}\"\noffset = 4"
        );
        let mask = mask(&written(&text, "x.toml"), 48, 120, 8);
        for (row, pixels) in (0u64..).zip(mask.rows()) {
            for (x, pixel) in (0u64..).zip(pixels) {
                let expected = [0, 1, 2].map(|c| {
                    let whole = (numerator * row) / denominator;
                    ((3 * x + c + 4 + whole) % 8) as u16
                });
                assert_eq!(*pixel, expected, "{numerator}/{denominator} {x} {row}");
            }
        }
    }
}

#[test]
fn patterns_that_people_asked_for() {
    let all = [
        "LRLRLR",
        "LRRLLR",
        "LLLRRR",
        "LRbLRbb",
        "LLbRRbb",
        "LLLRRRb",
        "LRLRLRLR",
        "LLRRLLRR",
        "LLLbRRRb",
        "LLLLRRRR",
        "LRLRLRLRb",
        "LLRRbLLRR",
        "LLLbRRRbb",
        "LLLLRRRRb",
    ];
    for letters in all {
        let view = |place: usize| match letters.as_bytes()[place % letters.len()] {
            b'L' => 0,
            b'R' => 1,
            _ => GUARD,
        };
        let text = format!("kind = \"pattern\"\npattern = [\"{letters}\"]");
        let pixels = mask(&written(&text, "x.toml"), 40, 3, 2);
        let subpixels = mask(
            &written(&format!("{text}\nsubpixels = true"), "x.toml"),
            40,
            3,
            2,
        );
        for row in 0..3 {
            for x in 0..40u32 {
                let x3 = 3 * x as usize;
                assert_eq!(pixels.at(x, row), Some([view(x as usize); 3]), "{letters}");
                let expected = [view(x3), view(x3 + 1), view(x3 + 2)];
                assert_eq!(subpixels.at(x, row), Some(expected), "{letters}");
            }
        }
    }
}

#[test]
fn rows_columns_and_checkerboard() {
    for (name, view) in [
        ("rows", (|_, y| y % 2) as fn(u32, u32) -> u32),
        ("columns", |x, _| x % 2),
        ("checkerboard", |x, y| (x + y) % 2),
    ] {
        let display = Display::named(name).unwrap();
        for (left, top) in [(0, 0), (1, 0), (0, 1), (7, 4)] {
            let at = Placement {
                screen_width: 64,
                screen_height: 48,
                x: left as i32,
                y: top as i32,
                width: 20,
                height: 10,
            };
            let mask = display.mask(&at, 2).unwrap();
            for (row, pixels) in (top..).zip(mask.rows()) {
                for (x, pixel) in (left..).zip(pixels) {
                    assert_eq!(*pixel, [view(x, row) as u16; 3], "{name} at {left},{top}");
                }
            }
        }
    }
}
