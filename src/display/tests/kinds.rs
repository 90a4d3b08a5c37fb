//! Every kind against its formula, written out in plain 128-bit fractions, subpixel by subpixel.

use super::*;

/// Floor of n·fract(numerator / denominator), or its mirror.
fn view(numerator: i128, denominator: i128, n: u32, down: bool) -> u16 {
    let fract = numerator.rem_euclid(denominator);
    let n = i128::from(n);
    if down {
        (n * (denominator - fract) / denominator).min(n - 1) as u16
    } else {
        (n * fract / denominator) as u16
    }
}

/// A description and its phase as a fraction: `phase(x, row, c)`, x and row on the screen, c from the left for RGB colours.
struct Case {
    name: &'static str,
    display: Display,
    size: (u32, u32),
    phase: Box<dyn Fn(i128, i128, usize) -> (i128, i128)>,
    down: bool,
}

fn load(text: &str) -> Display {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.toml");
    fs::write(&path, text).unwrap();
    Display::load(path.to_str().unwrap()).unwrap()
}

/// A lens with rational numbers over one denominator.
fn lens(
    name: &'static str,
    views: u32,
    size: (u32, u32),
    d: i128,
    pitch: i128,
    slant: i128,
    offset: i128,
) -> Case {
    let text = format!(
        "kind = \"slanted\"\nviews = {views}\npitch = \"{pitch}/{d}\"\nslant = \"{slant}/{d}\"\noffset = \"{offset}/{d}\""
    );
    Case {
        name,
        display: load(&text),
        size,
        phase: Box::new(move |x, row, c| (d * (3 * x + c as i128) + slant * row + offset, pitch)),
        down: false,
    }
}

/// z = (u + c/(3W) + v·tilt)·P − center over 6WH·2^56, from the derived numbers alone.
fn looking_glass(name: &'static str, json: &str, cells: bool) -> Case {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("visual.json");
    fs::write(&path, json).unwrap();
    let display = Display::load(path.to_str().unwrap()).unwrap();
    let Kind::LookingGlass(device) = display.kind.clone() else {
        panic!("a Looking Glass");
    };
    let (w, h) = (i128::from(device.width), i128::from(device.height));
    let fixed = |value: f64| (value * 2f64.powi(56)).round() as i128;
    let (p, k) = (device.lenses(), device.lenses() * device.tilt());
    let (flip_x, last) = (device.flip_x, if device.flip_subpixels { 2 } else { 0 });
    let phase = move |x: i128, row: i128, c: usize| {
        let y = h - 1 - row;
        let whole = 6 * w * h;
        let along = fixed(p) * 3 * h * (2 * x + 1) + fixed(k) * 3 * w * (2 * y + 1);
        let colour = if cells {
            let cell = ((x + y) % 2) as usize;
            let [dx, dy] = device.cells[cell][c];
            fixed(p * dx / w as f64 + k * dy / h as f64) * whole
        } else {
            let place = (last - c as i128).abs() * fixed(p) * 2 * h;
            if flip_x { -place } else { place }
        };
        (along + colour - fixed(device.center) * whole, whole << 56)
    };
    Case {
        name,
        size: (device_side(&display).0, device_side(&display).1),
        display,
        phase: Box::new(phase),
        down: true,
    }
}

fn device_side(display: &Display) -> (u32, u32) {
    display.facts.screen.unwrap()
}

fn json(pitch: f64, slope: f64, center: f64, size: (u32, u32), dpi: f64, more: &str) -> String {
    format!(
        r#"{{"serial": "LKG-J0", "pitch": {pitch}, "slope": {slope}, "center": {center}, "viewCone": 40, "invView": 1, "DPI": {dpi},
        "screenW": {}, "screenH": {}{more}}}"#,
        size.0, size.1
    )
}

/// Twelve panels; `full` is 7680x4320, else the masks are small parts of the same screens.
fn cases() -> Vec<Case> {
    let size = (7680, 4320);
    let cells = r#", "CellPatternMode": 1, "subpixelCells": [
        {"ROffsetX": -0.25, "ROffsetY": 0.1, "GOffsetX": 0, "GOffsetY": -0.2, "BOffsetX": 0.3, "BOffsetY": 0},
        {"ROffsetX": 0.2, "ROffsetY": 0, "GOffsetX": 0.01, "GOffsetY": 0.3, "BOffsetX": -0.3, "BOffsetY": 0.125}]"#;
    let huebner = |x: i128, row: i128, c: usize| {
        let t = (row + 1) % 12;
        ((1 + t + t / 3) / 2 + 3 * x + c as i128, 8)
    };
    let lenticular = |x: i128, _: i128, _: usize| (x, 5);
    let integer = |x: i128, row: i128, c: usize| (7 * x + 2 * c as i128 + 5 * row + 3, 96);
    let leia = |x: i128, row: i128, c: usize| {
        // p_over_du 3, p_over_dv 4/5, slant 1/10, offset 1/4; in twentieths of a view.
        let y = 4319 - row;
        let base = 60 * x + 16 * y + (2 * y).rem_euclid(60) + 20 * c as i128;
        (base + 20 - 16 * 4320 + 5, 20 * 12)
    };
    let named = |name: &'static str,
                 display: &str,
                 phase: Box<dyn Fn(i128, i128, usize) -> (i128, i128)>| Case {
        name,
        display: Display::named(display).unwrap_or_else(|_| load(display)),
        size,
        phase,
        down: false,
    };
    vec![
        named("huebner8", "huebner8", Box::new(huebner)),
        named("lenticular-5", "lenticular-5", Box::new(lenticular)),
        lens("a third of a subpixel, 9 views", 9, size, 3, 9, 1, 0),
        lens(
            "just above a third",
            9,
            size,
            3_000_000,
            9_000_000,
            1_000_001,
            0,
        ),
        lens(
            "just below a third",
            9,
            size,
            1_000_000_000,
            3_000_000_000,
            333_333_333,
            0,
        ),
        lens("16/3", 16, size, 3, 16, 2, 1),
        lens(
            "a measured lens",
            28,
            size,
            1_000_000_000,
            18_657_912_347,
            -703_112_951,
            12_345_678_901,
        ),
        looking_glass(
            "8K landscape",
            &json(41.3719462, -6.1034217, 0.66123, size, 280.0, ""),
            false,
        ),
        looking_glass(
            "8K mirrored, B first",
            &json(
                41.37,
                6.1,
                -3.25,
                size,
                280.0,
                r#", "flipImageX": 1, "flipSubp": 1"#,
            ),
            false,
        ),
        looking_glass(
            "8K with cells",
            &json(52.125, -7.25, 0.5, size, 280.0, cells),
            true,
        ),
        named(
            "integer",
            "kind = \"integer\"\nviews = 12\nhorizontal = 7\nsubpixel = 2\nvertical = 5\noffset = 3\nmodulus = 96",
            Box::new(integer),
        ),
        named(
            "leia",
            "kind = \"leia\"\nviews = 12\np-over-du = 3\np-over-dv = 0.8\ncolour-slant = 0.1\noffset = 0.25",
            Box::new(leia),
        ),
    ]
}

fn wrong(case: &Case, at: &Placement) -> u64 {
    let views = case.display.views;
    let mask = case.display.mask(at, views).unwrap();
    let mut wrong = 0;
    for (row, pixels) in (i128::from(at.y)..).zip(mask.rows()) {
        for (x, pixel) in (i128::from(at.x)..).zip(pixels) {
            for (c, &got) in pixel.iter().enumerate() {
                let (numerator, denominator) = (case.phase)(x, row, c);
                wrong += u64::from(got != view(numerator, denominator, views, case.down));
            }
        }
    }
    wrong
}

#[test]
fn parts_of_8k_masks_are_exact() {
    let cases = cases();
    assert_eq!(cases.len(), 12);
    for case in cases {
        for (x, y) in [(0, 0), (3811, 2160), (7560, 4200)] {
            let (screen_width, screen_height) = case.size;
            let at = Placement {
                screen_width,
                screen_height,
                x,
                y,
                width: 120,
                height: 120,
            };
            assert_eq!(wrong(&case, &at), 0, "{} at {x},{y}", case.name);
        }
    }
}

#[test]
#[ignore = "minutes: whole masks of 7680x4320"]
fn whole_8k_masks_are_exact() {
    for case in cases() {
        let at = Placement::full_screen(case.size.0, case.size.1);
        let started = std::time::Instant::now();
        let mask = case.display.mask(&at, case.display.views).unwrap();
        let seconds = started.elapsed().as_secs_f64();
        drop(mask);
        assert_eq!(wrong(&case, &at), 0, "{}", case.name);
        println!(
            "{}: 0 of 99532800 subpixels differ, made in {seconds:.2} s",
            case.name
        );
    }
}

#[test]
fn a_table_has_guards() {
    let display = load(
        "kind = \"integer\"\nviews = 3\nhorizontal = 1\nmodulus = 8\ntable = [0, \"b\", 2, 1]",
    );
    let mask = mask(&display, 9, 1, 3);
    let red: Vec<u16> = mask.data().iter().map(|pixel| pixel[0]).collect();
    assert_eq!(red, [0, 0, GUARD, GUARD, 2, 2, 1, 1, 0]);
    assert!(display.mask(&Placement::full_screen(9, 1), 2).is_err());
}

#[test]
fn colours_and_bias_move_the_phase() {
    let plain = "kind = \"slanted\"\nviews = 8\npitch = 8\nslant = 1\n";
    let moved = load(&format!("{plain}colour-offsets = [0, 2, -1]"));
    let (plain_mask, moved) = (mask(&load(plain), 32, 8, 8), mask(&moved, 32, 8, 8));
    for (a, b) in plain_mask.data().iter().zip(moved.data()) {
        assert_eq!(*b, [a[0], (a[1] + 2) % 8, (a[2] + 7) % 8]);
    }
    // From 0 on the left to 6 on the right; at the centre of a pixel, in steps of 6/32 subpixels.
    let bent = load(&format!(
        "{plain}bias = {{ columns = 2, rows = 2, values = [0, 6, 0, 6] }}"
    ));
    let bent = mask(&bent, 32, 8, 8);
    for row in 0..8 {
        for x in 0..32u32 {
            let bias = 6.0 * (f64::from(x) + 0.5) / 32.0;
            let expected = [0.0, 1.0, 2.0].map(|c| {
                let phase = 3.0 * f64::from(x) + c + f64::from(row) + bias;
                phase.rem_euclid(8.0).floor() as u16
            });
            assert_eq!(bent.at(x, row), Some(expected), "{x} {row}");
        }
    }
}

/// Every number of these sheets is a fraction, so that views change exactly at subpixels, and each phase is one fraction of whole numbers.
#[test]
fn a_bias_of_fractions_is_exact() {
    let (width, height, views) = (96i128, 40i128, 9u32);
    // In 240ths of a subpixel, rows from the top.
    let bias = [[60i128, -80, 5], [0, 48, 240]];
    for inverted in [false, true] {
        let text = format!(
            "kind = \"slanted\"\nviews = {views}\npitch = \"16/3\"\nslant = \"2/3\"\noffset = 0.5\ninverted = {inverted}\n\
             bias = {{ columns = 3, rows = 2, values = [0.25, \"-1/3\", \"1/48\", 0, 0.2, 1] }}"
        );
        let mask = mask(&load(&text), 96, 40, views);
        for (row, pixels) in (0..height).zip(mask.rows()) {
            for (x, pixel) in (0..width).zip(pixels) {
                for (c, &got) in (0..3i128).zip(pixel) {
                    // In parts of 240 · 2w · 2h, the place between two columns and two rows of the map.
                    let (along, down) = (2 * (2 * x + 1), 2 * row + 1);
                    let (left, across) = (along / (2 * width), along % (2 * width));
                    let line = |values: [i128; 3]| {
                        let at = |column: i128| values[column as usize];
                        at(left) * (2 * width - across) + at(left + 1) * across
                    };
                    let moved = line(bias[0]) * (2 * height - down) + line(bias[1]) * down;
                    let parts = 240 * 4 * width * height;
                    let phase = parts * (9 * x + 3 * c + 2 * row) / 3 + parts / 2 + moved;
                    let phase = if inverted { -phase } else { phase };
                    let want = view(phase, parts * 16 / 3, views, false);
                    assert_eq!(got, want, "{x} {row} {c}");
                }
            }
        }
    }
}

#[test]
fn a_constant_bias_is_an_offset() {
    let sheet = |offset: &str, bias: &str| {
        let text = format!(
            "kind = \"slanted\"\nviews = 9\npitch = \"16/3\"\nslant = \"2/3\"\noffset = {offset}\n{bias}"
        );
        mask(&load(&text), 960, 540, 9)
    };
    let even = "bias = { columns = 2, rows = 2, values = [0.25, 0.25, 0.25, 0.25] }";
    assert!(sheet("0.5", even).data() == sheet("0.75", "").data());
}

#[test]
fn inverted_sheets_have_the_views_in_the_other_order() {
    let text = "kind = \"slanted\"\nviews = 8\npitch = \"16/3\"\nslant = \"2/3\"\noffset = 1\ninverted = true";
    let mask = mask(&load(text), 64, 24, 8);
    for (row, pixels) in (0i128..).zip(mask.rows()) {
        for (x, pixel) in (0i128..).zip(pixels) {
            for (c, &got) in (0i128..).zip(pixel) {
                let phase = -(3 * (3 * x + c) + 2 * row + 3);
                assert_eq!(got, view(phase, 16, 8, false), "{x} {row} {c}");
            }
        }
    }
}

#[test]
fn fine_masks_have_the_places_between_views() {
    for case in cases() {
        let views = case.display.views;
        let (screen_width, screen_height) = case.size;
        let at = Placement {
            screen_width,
            screen_height,
            x: 3811,
            y: 2160,
            width: 60,
            height: 40,
        };
        let fine = case.display.fine_mask(&at, views).unwrap();
        let whole = case.display.mask(&at, views).unwrap();
        for (fine, whole) in fine
            .data()
            .as_flattened()
            .iter()
            .zip(whole.data().as_flattened())
        {
            assert_eq!(fine / FINE, *whole, "{}", case.name);
        }
        let steps: std::collections::BTreeSet<u16> = fine
            .data()
            .as_flattened()
            .iter()
            .map(|step| step % FINE)
            .collect();
        let flat = matches!(case.display.kind, Kind::Huebner(_) | Kind::Lenticular);
        assert_eq!(steps == [FINE / 2].into(), flat, "{}", case.name);
    }
    let table = load(
        "kind = \"integer\"\nviews = 3\nhorizontal = 1\nmodulus = 8\ntable = [0, \"b\", 2, 1]",
    );
    let fine = table.fine_mask(&Placement::full_screen(4, 1), 3).unwrap();
    assert_eq!(fine.data()[1..3], [[128; 3], [GUARD; 3]]);
    assert!(table.fine_mask(&Placement::full_screen(4, 1), 256).is_err());
}

#[test]
fn turned_panels_are_turned_masks() {
    let upright = mask(
        &load("kind = \"slanted\"\nviews = 9\npitch = 9\nslant = \"2/3\""),
        40,
        30,
        9,
    );
    for degrees in [90, 180, 270] {
        let turned = load(&format!(
            "kind = \"slanted\"\nviews = 9\npitch = 9\nslant = \"2/3\"\nrotation = {degrees}"
        ));
        let (width, height) = if degrees == 180 { (40, 30) } else { (30, 40) };
        let whole = mask(&turned, width, height, 9);
        for y in 0..30 {
            for x in 0..40 {
                let (tx, ty) = match degrees {
                    90 => (29 - y, x),
                    180 => (39 - x, 29 - y),
                    _ => (y, 39 - x),
                };
                assert_eq!(whole.at(tx, ty), upright.at(x, y), "{degrees}°, {x} {y}");
            }
        }
        let part = Placement {
            screen_width: width,
            screen_height: height,
            x: 3,
            y: 5,
            width: 11,
            height: 13,
        };
        let part = turned.mask(&part, 9).unwrap();
        for y in 0..13 {
            for x in 0..11 {
                assert_eq!(part.at(x, y), whole.at(x + 3, y + 5), "{degrees}°");
            }
        }
    }
}

#[test]
fn cell_patterns_and_mirrored_rows() {
    let size = (64, 32);
    let cell = |dx: f64| {
        format!(
            r#"{{"ROffsetX": {dx}, "ROffsetY": 0, "GOffsetX": {dx}, "GOffsetY": 0, "BOffsetX": {dx}, "BOffsetY": 0}}"#
        )
    };
    let cells: Vec<String> = [0.0, 0.25, 0.5, 0.75].map(cell).to_vec();
    for (mode, cell_of) in [
        (0, (|_, _| 0) as fn(u32, u32) -> u32),
        (1, |x, y| (x + y) % 2),
        (2, |x, _| x % 2),
        (3, |x, y| (y + 2 * (x % 2)) % 4),
        (4, |_, y| y % 2),
    ] {
        for flip in [0, 1] {
            // Devices write numbers in one of two ways.
            let mode = [format!("{mode}"), format!(r#"{{"value": {mode}.0}}"#)];
            let mode = &mode[flip];
            let more = format!(
                r#", "CellPatternMode": {mode}, "flipImageY": {flip}, "subpixelCells": [{}]"#,
                cells.join(",")
            );
            let display =
                looking_glass("cells", &json(1.0, 8.0, 0.0, size, 4.0, &more), false).display;
            let Kind::LookingGlass(device) = &display.kind else {
                panic!()
            };
            let (p, tilt) = (device.lenses(), device.tilt());
            let mask = mask(&display, 64, 32, 7);
            for row in 0..32 {
                for x in 0..64 {
                    let y = 31 - row;
                    let v = f64::from(if flip == 1 { row } else { y }) + 0.5;
                    let dx = 0.25 * f64::from(cell_of(x, y));
                    let z = ((f64::from(x) + 0.5 + dx) / 64.0 + v / 32.0 * tilt) * p;
                    let place = 7.0 * (1.0 - (z - z.floor()));
                    if (place - place.round()).abs() > 1e-9 {
                        assert_eq!(
                            mask.at(x, row),
                            Some([place as u16; 3]),
                            "mode {mode} at {x},{y}"
                        );
                    }
                }
            }
        }
    }
}
