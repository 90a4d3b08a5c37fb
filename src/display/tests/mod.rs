//! Masks against independent tables, exact against big numbers, files and messages.
#![forbid(unsafe_code)]

use super::*;
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, RngSeed};
use std::fs;

mod fuzz;
mod kinds;
mod turns;
mod vectors;
mod wall;
mod written;

fn seeded(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(20_26),
        rng_algorithm: RngAlgorithm::ChaCha,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

fn mask(display: &Display, width: u32, height: u32, views: u32) -> Mask {
    display
        .mask(&Placement::full_screen(width, height), views)
        .unwrap()
}

fn slanted(pitch: Number, slant: Number, offset: Number) -> Slanted {
    Slanted {
        pitch,
        slant,
        offset,
        ..Slanted::HUEBNER
    }
}

fn ratio(n: i64, d: i64) -> Number {
    Number::ratio(n, d).unwrap()
}

/// v_R for yoffset 0 to 11 where xoffset is 0, worked out by hand from equation 9.
const DIAGONAL: [u16; 12] = [0, 1, 1, 2, 3, 3, 4, 5, 5, 6, 7, 7];

#[test]
fn huebner_is_the_table_of_the_paper() {
    let got = mask(&Display::default(), 24, 24, 8);
    for row in 0..24u16 {
        for x in 0..24u16 {
            // Fragment y counts from the bottom: the top row is y = 23, so 24 − y is 1 there and 24 at the bottom.
            let y = 23 - row;
            let red = DIAGONAL[usize::from((24 - y) % 12)] + 3 * x;
            let expected = [red % 8, (red + 1) % 8, (red + 2) % 8];
            assert_eq!(
                got.at(x.into(), row.into()),
                Some(expected),
                "column {x}, row {row}"
            );
        }
    }
    // The top left corner, written out.
    assert_eq!(got.data()[..3], [[1, 2, 3], [4, 5, 6], [7, 0, 1]]);
    assert_eq!(got.at(0, 23), Some([0, 1, 2]));
}

#[test]
fn huebner_phase_belongs_to_the_screen() {
    let whole = mask(&Display::default(), 64, 50, 8);
    let part = Placement {
        screen_width: 64,
        screen_height: 50,
        x: 13,
        y: 7,
        width: 20,
        height: 30,
    };
    let part = Display::default().mask(&part, 8).unwrap();
    for row in 0..30 {
        for x in 0..20 {
            assert_eq!(part.at(x, row), whole.at(x + 13, row + 7));
        }
    }
}

#[test]
fn pictures_hanging_over_the_left_edge_continue_the_pattern() {
    for name in ["huebner8", "slanted8", "lenticular-5"] {
        let display = Display::named(name).unwrap();
        let n = display.views;
        let over = Placement {
            screen_width: 48,
            screen_height: 48,
            x: -120,
            y: -120,
            width: 130,
            height: 140,
        };
        let over = display.mask(&over, n).unwrap();
        let whole = mask(&display, 48, 48, n);
        assert_eq!(over.at(125, 130), whole.at(5, 10), "{name}");
        assert_eq!(
            over.at(5, 10),
            whole.at(5, 10),
            "{name}: 120 is a multiple of the period"
        );
    }
}

#[test]
fn slanted8_is_huebner8() {
    let slanted = Display::named("slanted8").unwrap();
    assert_eq!(
        mask(&slanted, 48, 48, 8),
        mask(&Display::default(), 48, 48, 8)
    );
}

#[test]
fn every_view_of_every_count_is_shown() {
    for views in [1u16, 2, 3, 5, 7, 8, 9, 17, 45] {
        let all = (0..views).collect();
        let huebner = mask(&Display::default(), 64, 160, views.into());
        assert_eq!(huebner.views_shown(), all);
        let lens = Kind::Slanted(slanted(
            ratio(i64::from(views), 1),
            ratio(2, 3),
            ratio(0, 1),
        ));
        let lens = Display {
            kind: lens,
            ..Display::default()
        };
        assert_eq!(mask(&lens, 64, 160, views.into()).views_shown(), all);
        assert_eq!(
            mask(&lens, 64, 1, 2).views_shown().len(),
            if views == 1 { 1 } else { 2 }
        );
    }
}

#[test]
fn huebner_diagonals_repeat_only_after_whole_periods() {
    for (views, period) in [(8u32, 12), (6, 9), (2, 3), (5, 15), (9, 27), (17, 51)] {
        let got = mask(&Display::default(), 1, 4 * period, views);
        let red: Vec<u16> = got.data().iter().map(|p| p[0]).collect();
        for (upper, lower) in red.iter().zip(&red[1..]) {
            let step = (u32::from(*lower) + views - u32::from(*upper)) % views;
            assert!(step <= 1, "a row climbs by 0 or 1 view, N = {views}");
        }
        // Two views in three rows, also across the period.
        for (upper, lower) in red.iter().zip(&red[3..]) {
            assert_eq!(
                (u32::from(*upper) + 2) % views,
                u32::from(*lower),
                "N = {views}"
            );
        }
    }
}

#[test]
fn bgr_swaps_the_colours() {
    let bgr = Display {
        kind: Kind::Huebner(SubpixelOrder::Bgr),
        ..Display::default()
    };
    assert_eq!(mask(&bgr, 9, 9, 8).data()[..2], [[3, 2, 1], [6, 5, 4]]);
    let kind = Kind::Slanted(Slanted {
        order: SubpixelOrder::Bgr,
        ..Slanted::HUEBNER
    });
    assert_eq!(
        mask(
            &Display {
                kind,
                ..bgr.clone()
            },
            9,
            9,
            8
        ),
        mask(&bgr, 9, 9, 8)
    );
}

#[test]
fn lenticular_is_x_mod_n() {
    for n in [1u32, 2, 5, 8, 17] {
        let got = mask(
            &Display::named(&format!("lenticular-{n}")).unwrap(),
            40,
            3,
            n,
        );
        for (i, pixel) in got.data().iter().enumerate() {
            assert_eq!(*pixel, [(i % 40 % n as usize) as u16; 3]);
        }
    }
}

#[test]
fn numbers_keep_what_was_written() {
    assert_eq!(Number::parse(" 16/3 "), Some(ratio(16, 3)));
    assert_eq!(Number::parse("-4/-6"), Some(ratio(2, 3)));
    assert_eq!(Number::parse("5.25"), Some(ratio(21, 4)));
    assert_eq!(Number::parse("-0.50"), Some(ratio(-1, 2)));
    assert_eq!(Number::from_f64(0.1), Some(ratio(1, 10)));
    assert_eq!(
        Number::from_f64(std::f64::consts::PI),
        Some(Number::Float(std::f64::consts::PI))
    );
    assert_eq!(Number::parse("1e3"), Some(Number::Float(1000.0)));
    for bad in ["", "x", "1/0", "1/2/3", "inf", "nan", "1/x", "."] {
        assert_eq!(Number::parse(bad), None, "{bad}");
    }
    assert_eq!(
        Number::parse("9223372036854775807/-1"),
        Some(ratio(-i64::MAX, 1))
    );
    assert!(matches!(
        Number::parse("-9223372036854775808/3"),
        Some(Number::Float(_))
    ));
}

#[test]
fn a_third_of_a_subpixel_never_tips_over() {
    // Slant 1/3, N = 9, one view per third of a subpixel: here a floor of floats is wrong for many subpixels.
    let lens = slanted(ratio(3, 1), ratio(1, 3), ratio(0, 1));
    assert!(lens.is_exact());
    let got = lens.mask(&Placement::full_screen(30, 90), 9).unwrap();
    for (row, pixels) in got.rows().enumerate() {
        for (x, pixel) in pixels.iter().enumerate() {
            for (c, view) in pixel.iter().enumerate() {
                assert_eq!(usize::from(*view), (3 * (3 * x + c) + row) % 9);
            }
        }
    }
}

#[test]
fn what_has_no_common_unit_is_rounded() {
    let fine = Number::ratio(1, 999_999_937).unwrap();
    let other = Number::ratio(7_999_999_999, 999_999_929).unwrap();
    let half = Number::ratio(499_999_946, 999_999_893).unwrap();
    let rounded = slanted(other, fine, half);
    assert!(!rounded.is_exact());
    assert!(!slanted(Number::Float(5.5), ratio(1, 2), ratio(0, 1)).is_exact());
    // Its numbers are near 8 and 0: away from boundaries it is that lens.
    let near = slanted(ratio(8, 1), ratio(0, 1), ratio(1, 2));
    let at = Placement::full_screen(64, 4);
    assert_eq!(rounded.mask(&at, 8).unwrap(), near.mask(&at, 8).unwrap());
}

proptest! {
    #![proptest_config(seeded(200))]

    /// ⌊N·fract(phase)⌋ without remainders: multiply everything out in 128 bits.
    #[test]
    fn exact_lens_equals_big_fractions(
        (pn, pd) in (1i64..4000, 1i64..200), (sn, sd) in (-3000i64..3000, 1i64..200),
        (on, od) in (-9000i64..9000, 1i64..200), views in 1u32..300,
        x in -70_000i32..70_000, y in -70_000i32..70_000,
    ) {
        let lens = slanted(ratio(pn, pd), ratio(sn, sd), ratio(on, od));
        prop_assert!(lens.is_exact());
        let at = Placement { screen_width: 5, screen_height: 5, x, y, width: 5, height: 3 };
        let got = lens.mask(&at, views).unwrap();
        let [pn, pd, sn, sd, on, od] = [pn, pd, sn, sd, on, od].map(i128::from);
        for (row, pixels) in (i128::from(y)..).zip(got.rows()) {
            for (subpixel, view) in (3 * i128::from(x)..).zip(pixels.as_flattened()) {
                // phase = a / b
                let a = (subpixel * sd * od + sn * row * od + on * sd) * pd;
                let b = sd * od * pn;
                let fract = a - a.div_euclid(b) * b;
                prop_assert_eq!(i128::from(*view), i128::from(views) * fract / b);
            }
        }
    }

    #[test]
    fn masks_survive_their_png(width in 1u32..40, height in 1u32..40, seed in any::<u64>()) {
        let data = (0..u64::from(width * height)).map(|i| {
            let bits = (seed ^ i).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            [bits as u16, (bits >> 16) as u16, if i % 5 == 0 { GUARD } else { (bits >> 32) as u16 }]
        });
        let before = Mask::new(width, height, data.collect()).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mask.png");
        before.to_png(&path).unwrap();
        prop_assert_eq!(Mask::from_png(&path).unwrap(), before);
    }
}

#[test]
fn mask_files_are_big_endian_16_bit_rgb() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.png");
    Mask::new(2, 1, vec![[1, 256, GUARD], [7, 0, 3]])
        .unwrap()
        .to_png(&path)
        .unwrap();
    let picture = image::open(&path).unwrap();
    let picture = picture.as_rgb16().expect("16-bit RGB");
    assert_eq!(picture.as_raw(), &[1, 256, 65535, 7, 0, 3]);
}

#[test]
fn mask_displays_are_cropped_to_the_window() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("panel.png");
    let whole = mask(&Display::default(), 40, 30, 8);
    whole.to_png(&path).unwrap();
    fs::write(
        folder.path().join("panel.toml"),
        "kind = \"mask\"\nmask = \"panel.png\"\n",
    )
    .unwrap();
    for file in ["panel.png", "panel.toml"] {
        let display = Display::load(folder.path().join(file).to_str().unwrap()).unwrap();
        assert_eq!((display.name.as_str(), display.views), ("panel", 8));
        assert_eq!(mask(&display, 40, 30, 8), whole);
        assert_eq!(mask(&display, 40, 30, 9), whole);
        let part = Placement {
            screen_width: 40,
            screen_height: 30,
            x: 11,
            y: 4,
            width: 29,
            height: 20,
        };
        let expected = Display::default().mask(&part, 8).unwrap();
        assert_eq!(display.mask(&part, 8).unwrap(), expected);
    }
}

#[test]
fn descriptions_give_displays() {
    let folder = tempfile::tempdir().unwrap();
    let load = |text: &str| {
        let path = folder.path().join("x.toml");
        fs::write(&path, text).unwrap();
        Display::load(path.to_str().unwrap()).unwrap()
    };
    let got = load(
        "name = \"A\"\nkind = \"slanted\"\nviews = 9\npitch = \"16/3\"\nslant = 0.5\noffset = -1\norder = \"bgr\"",
    );
    let mut lens = slanted(ratio(16, 3), ratio(1, 2), ratio(-1, 1));
    lens.order = SubpixelOrder::Bgr;
    assert_eq!(got, Display::new("A", 9, Kind::Slanted(lens)));
    assert_eq!(load("kind = \"huebner\"").views, 8);
    let got = load("kind = \"lenticular\"\nviews = 5");
    assert_eq!(got, Display::new("x", 5, Kind::Lenticular));
    assert_eq!(Display::load("huebner8").unwrap(), Display::default());
}

#[test]
fn mask_pictures_of_screens_and_of_windows() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("panel.png");
    let whole = mask(&Display::default(), 40, 30, 8);
    whole.to_png(&path).unwrap();
    let display = Display::load(path.to_str().unwrap()).unwrap();
    // Hanging over the left and the lower edge: what is on the screen is the screen's, the rest is black.
    let over = Placement {
        screen_width: 40,
        screen_height: 30,
        x: -7,
        y: 20,
        width: 20,
        height: 15,
    };
    let over = display.mask(&over, 8).unwrap();
    for row in 0..15 {
        for x in 0..20u32 {
            let on_screen = x.checked_sub(7).and_then(|x| whole.at(x, row + 20));
            assert_eq!(over.at(x, row), Some(on_screen.unwrap_or([GUARD; 3])));
        }
    }
    // On a larger screen it is that of a window of its size.
    let window = Placement {
        screen_width: 1920,
        screen_height: 1200,
        x: 300,
        y: -5,
        width: 40,
        height: 30,
    };
    assert_eq!(display.mask(&window, 8).unwrap(), whole);
}

/// All messages of this module in one snapshot: whoever changes one sees them side by side.
#[test]
fn messages() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let mut said = Vec::new();
    let mut say = |what: &str, message: String| {
        let message = message.replace(&at(""), "");
        assert!(!message.contains('\n'), "one line: {message}");
        said.push(format!("{what}\n    {message}"));
    };
    for name in [
        "lenticular-0",
        "lenticular-x",
        "lenticular-70000",
        "huebner9",
        "no/such.toml",
        "no.png",
    ] {
        say(name, Display::load(name).unwrap_err().to_string());
    }
    let slanted = "kind = \"slanted\"\nviews = 8\npitch = 8\n";
    let texts = [
        "pitch = -3\nkind = \"slanted\"\nviews = 8".to_owned(),
        "pitch = 2000000.0\nkind = \"slanted\"".into(),
        "pitch = \"16:3\"\nkind = \"slanted\"".into(),
        "pitch = nan\nkind = \"slanted\"".into(),
        "kind = \"slanted\"\nviews = 8".into(),
        "kind = \"slanted\"\npitch = 8".into(),
        format!("{slanted}slant = true"),
        format!("{slanted}offset = \"1/0\""),
        format!("{slanted}order = \"grb\""),
        format!("{slanted}mask = \"m.png\""),
        "kind = \"lenticular\"\nviews = 0".into(),
        "kind = \"lenticular\"\nviews = 5.0".into(),
        "kind = \"lenticular\"\nviews = 5\norder = \"bgr\"".into(),
        "kind = \"barrier\"".into(),
        "kind = 3".into(),
        "name = \"\"\nkind = \"huebner\"".into(),
        "views = 8".into(),
        "kind = \"mask\"".into(),
        "kind = \"mask\"\nmask = \"absent.png\"".into(),
        "kind = \"huebner\"\npich = 8".into(),
        "version = 2\nkind = \"huebner\"".into(),
        "kind = \"huebner\"\nrotation = 45".into(),
        "kind = \"huebner\"\nscreen = \"1920:1080\"".into(),
        "kind = \"huebner\"\ndpi = -1".into(),
        "kind = \"huebner\"\ncone = \"wide\"".into(),
        "kind = \"huebner\"\nspacing = \"middle\"".into(),
        "kind = \"huebner\"\nquilt = [8, 6]".into(),
        format!("{slanted}colour-offsets = [0, 1]"),
        format!("{slanted}bias = {{ columns = 2, rows = 2, values = [0, 1] }}"),
        "kind = \"pattern\"\npattern = [\"LR\", \"L\"]".into(),
        "kind = \"pattern\"\npattern = [\"LR\"]\nsubpixels = 1".into(),
        "kind = \"integer\"\nviews = 8\nhorizontal = 1.5\nmodulus = 8".into(),
        "kind = \"integer\"\nviews = 8\nhorizontal = 1\nmodulus = 0".into(),
        "kind = \"integer\"\nviews = 8\nhorizontal = 1\nmodulus = 8\ntable = [0, \"x\"]".into(),
        "kind = \"leia\"\nviews = 8\np-over-du = 0".into(),
        "kind = \"looking-glass\"\ncalibration = 3".into(),
        "kind = \n".into(),
    ];
    for text in texts {
        fs::write(at("x.toml"), &text).unwrap();
        say(
            &text.replace('\n', "; "),
            Display::load(&at("x.toml")).unwrap_err().to_string(),
        );
    }

    let calibration =
        r#"{"pitch": 50, "slope": 5, "center": 0, "DPI": 300, "screenW": 1536, "screenH": 2048}"#;
    for (from, to) in [
        ("50", "\"x\""),
        ("\"pitch\": 50, ", ""),
        ("50", "49999"),
        ("50", "2000"),
        ("5,", "0.01,"),
        ("1536", "{\"value\": 0}"),
        ("}", ", \"CellPatternMode\": 5}"),
        ("}", ", \"CellPatternMode\": 3, \"subpixelCells\": []}"),
        ("}", ", \"subpixelCells\": [1]}"),
        ("}", ", \"invView\": \"yes\"}"),
        ("}", ", \"serial\": 5}"),
        ("}", ""),
    ] {
        fs::write(at("x.json"), calibration.replacen(from, to, 1)).unwrap();
        match Display::load(&at("x.json")) {
            Ok(_) => say(&format!("json {from} -> {to}"), "is fine".into()),
            Err(error) => say(&format!("json {from} -> {to}"), error.to_string()),
        }
    }
    let model = Display::named("looking-glass-go").unwrap();
    let error = model.mask(&Placement::full_screen(4, 4), 66).unwrap_err();
    say("a model", error.to_string());
    let rows = Display::named("rows").unwrap();
    let error = rows.mask(&Placement::full_screen(4, 4), 1).unwrap_err();
    say("rows in one view", error.to_string());

    image::RgbImage::new(2, 2).save(at("rgb8.png")).unwrap();
    image::ImageBuffer::<image::Rgba<u16>, _>::new(2, 2)
        .save(at("rgba16.png"))
        .unwrap();
    image::ImageBuffer::<image::Luma<u16>, _>::new(2, 2)
        .save(at("grey16.png"))
        .unwrap();
    fs::write(at("text.png"), "not a picture").unwrap();
    let whole = mask(&Display::default(), 4, 4, 8);
    whole.to_png(at("good.png")).unwrap();
    let good = fs::read(at("good.png")).unwrap();
    fs::write(at("short.png"), &good[..60]).unwrap();
    let mut palette = good.clone();
    (palette[24], palette[25]) = (8, 3);
    fs::write(at("palette.png"), &palette).unwrap();
    fs::create_dir(at("folder.png")).unwrap();
    for name in [
        "rgb8.png",
        "rgba16.png",
        "grey16.png",
        "palette.png",
        "text.png",
        "short.png",
        "folder.png",
    ] {
        say(name, Display::load(&at(name)).unwrap_err().to_string());
    }
    for name in ["long.toml", "long.json"] {
        fs::write(at(name), vec![b'#'; (1 << 21) + 1]).unwrap();
        say(name, Display::load(&at(name)).unwrap_err().to_string());
    }
    let bad = "kind = \"mask\"\nviews = 5\nmask = \"good.png\"";
    fs::write(at("x.toml"), bad).unwrap();
    say(
        "8 views for 5",
        Display::load(&at("x.toml")).unwrap_err().to_string(),
    );

    let good = Display::load(&at("good.png")).unwrap();
    let full = Placement::full_screen;
    say(
        "--views 3",
        good.mask(&full(4, 4), 3).unwrap_err().to_string(),
    );
    for (width, height) in [(5, 4), (3, 4), (4, 5)] {
        let error = good.mask(&full(width, height), 8).unwrap_err();
        say(&format!("{width}x{height} for 4x4"), error.to_string());
    }
    let window = Placement {
        screen_width: 9,
        screen_height: 8,
        x: 2,
        y: 1,
        width: 5,
        height: 4,
    };
    let error = good.mask(&window, 8).unwrap_err();
    say("a window of 5x4 on 9x8", error.to_string());
    let display = Display::default();
    say(
        "--views 0",
        display.mask(&full(4, 4), 0).unwrap_err().to_string(),
    );
    say(
        "--views 65536",
        display.mask(&full(4, 4), 65_536).unwrap_err().to_string(),
    );
    for (width, height) in [
        (0, 4),
        (4, 0),
        (32_769, 1),
        (8192, 8193),
        (32_768, 32_768),
        (u32::MAX, u32::MAX),
    ] {
        say(
            "size",
            display
                .mask(&full(width, height), 8)
                .unwrap_err()
                .to_string(),
        );
    }
    say(
        "write",
        whole.to_png(at("no/such/m.png")).unwrap_err().to_string(),
    );
    insta::assert_snapshot!(said.join("\n"));
}
