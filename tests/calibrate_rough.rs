//! Pitch and slant of displays of which only the size is told, from photos of gratings by an optical simulator that shares nothing with the search.

use crate::calibrate_glass::{chosen, on_two_threads, write};
use crate::optics::displays::{Display, display, small};
use crate::optics::photograph_jpeg;
use crate::optics::scenario::{First, Taking, scenario};
use manyview::calibrate::{Beats, Photo, Rough, Setup, Sighting, pattern, rough, rough_pattern};
use manyview::display::SubpixelOrder;
use std::fmt::Write as _;

/// What the pattern that follows allows: a part, and subpixels per row.
const PITCH: f64 = 0.01;
const SLANT: f64 = 0.02;

/// The finest lenses of the study, subpixels.
const FINEST: f64 = 4.65;

/// Widths of photos of 12 and of 3 Mpx.
const LARGE: u32 = 4032;
const SMALL: u32 = 2016;

/// What one photo of this width tells of a display in a situation, changed by `change`.
fn told(
    name: &str,
    seed: u64,
    wide: u32,
    change: impl Fn(&mut Display),
) -> (Display, Result<Rough, String>) {
    let taking = Taking {
        photos: 1,
        first: First::Anywhere,
        size: [wide, wide * 3 / 4],
        seed,
    };
    let mut scenario = scenario(name, &display(seed), taking).expect("a name");
    change(&mut scenario.display);
    // One ray a pixel also shows what lens blur would have removed, and that matters where lenses are as fine as the pixels of the camera.
    scenario.shots[0].sensor.supersample = true_sheet(&scenario.display).0 < FINEST;
    let panel = &scenario.display.panel;
    let size = (panel.columns as u32, panel.rows as u32);
    let shown = scenario
        .showing
        .apply(panel, &rough_pattern(size).expect("a pattern"));
    let file = photograph_jpeg(&scenario.display, &shown, &scenario.shots[0]).expect("a file");
    let found = Photo::decode_fine("gratings.jpg", &file)
        .and_then(|photo| Beats::new(&photo, size))
        .and_then(|beats| rough(&beats, Setup::CONE));
    (scenario.display, found.map_err(|error| error.to_string()))
}

/// Pitch in subpixels and slant in subpixels per row.
fn true_sheet(display: &Display) -> (f64, f64) {
    let sheet = &display.sheet;
    let pitch = 3.0 * sheet.pitch / sheet.slant.cos() / display.panel.pitch;
    (pitch, -3.0 * sheet.slant.tan())
}

/// Gives a display lenses of this width in subpixels along a row. The thickness is in proportion, so the cone stays.
fn widen(display: &mut Display, subpixels: f64) {
    let (wide, _) = true_sheet(display);
    let sheet = &mut display.sheet;
    for part in [&mut sheet.pitch, &mut sheet.thickness, &mut sheet.gap] {
        *part *= subpixels / wide;
    }
}

/// By how much the pitch is off, as a part, and the slant, subpixels per row.
fn off(display: &Display, found: &Rough) -> (f64, f64) {
    let (pitch, slant) = true_sheet(display);
    (
        (found.pitch / pitch).ln().abs(),
        (found.slant - slant).abs(),
    )
}

#[test]
fn pitch_slant_and_colours_are_found_without_a_data_sheet() {
    type Change = fn(&mut Display);
    let same: Change = |_| ();
    let upright: Change = |display| display.sheet.slant = 0.0;
    let finer: Change = |display| display.sheet.pitch *= 0.6;
    let four: Change = |display| widen(display, 4.0);
    // UHD and FHD, leaning and upright; `full_calibrate_rough_displays` has many more.
    let cases = [
        ("ordinary", 22, SMALL, same, SubpixelOrder::Rgb),
        ("bgr", 12, SMALL, upright, SubpixelOrder::Bgr),
        // Fine lenses, whose mirror image gives more beats that a camera sees.
        ("bgr", 13, LARGE, same, SubpixelOrder::Bgr),
        // Finer ones: of their beats a camera sees only those that a sheet half as fine has as well.
        ("ordinary", 7, LARGE, finer, SubpixelOrder::Rgb),
        // In tiles of the other order red and blue cancel what green shows.
        ("ordinary", 7, LARGE, four, SubpixelOrder::Rgb),
    ];
    on_two_threads(cases.len() as u64, |case| {
        let (name, seed, wide, change, order) = cases[case as usize];
        let (display, found) = told(name, seed, wide, change);
        let found = found.expect(name);
        let (pitch, slant) = off(&display, &found);
        assert!(pitch < PITCH && slant < SLANT, "{name} {seed}: {found:?}");
        assert!(
            pitch < 4.0 * found.pitch_spread && slant < 4.0 * found.slant_spread + 1e-3,
            "{name} {seed}: off by {pitch} and {slant}, {found:?}"
        );
        assert_eq!(found.order, order, "{name} {seed}: {found:?}");
    });
}

/// A screen without lenses, or with ones that blur all, shows the gratings and no beats of one sheet.
#[test]
fn a_panel_without_lenses_has_no_pitch() {
    let (_, found) = told("ordinary", 1, SMALL, |display| display.sheet.spot *= 60.0);
    let error = found.expect_err("no lenses");
    assert!(
        error.contains("no single lens sheet") && error.contains("--pitch"),
        "{error}"
    );
}

#[test]
fn gratings_that_are_shown_scaled_are_noticed() {
    let (_, found) = told("scaled 99.5", 1, SMALL, |_| ());
    let error = found.expect_err("scaled");
    assert!(error.contains("was shown scaled"), "{error}");
}

/// A photo of the wrong one of the two patterns says so.
#[test]
fn the_other_pattern_is_known() {
    let setup = Setup::new(640, 400, 8, 8.0, -1.0);
    let size = (setup.width, setup.height);
    let display = small();
    let taking = Taking {
        photos: 1,
        first: First::Anywhere,
        size: [1008, 756],
        seed: 1,
    };
    let scenario = scenario("ordinary", &display, taking).expect("a name");
    let [gratings, lens] = [rough_pattern(size), pattern(&setup)].map(|picture| {
        let picture = picture.expect("a pattern");
        let file = photograph_jpeg(&display, &picture, &scenario.shots[0]).expect("a file");
        Photo::decode("a.jpg", &file).expect("a photo")
    });
    let error = Sighting::new(&gratings, &setup).expect_err("gratings");
    assert!(error.to_string().contains("leave out --pitch"), "{error}");
    let error = Beats::new(&lens, size).expect_err("the pattern of a lens");
    assert!(error.to_string().contains("give the --display"), "{error}");
}

/// Displays of one row of a table, and how they differ from those of the study.
struct Kind {
    row: &'static str,
    /// The scenario of every fifth display, and of the others.
    scenarios: [&'static str; 2],
    /// Width of a lens in subpixels along a row, if not that of the study.
    lens: Option<f64>,
    displays: u64,
}

const fn lenses(row: &'static str, subpixels: f64) -> Kind {
    Kind {
        row,
        scenarios: ["bgr", "ordinary"],
        lens: Some(subpixels),
        displays: 10,
    }
}

const fn others(row: &'static str, scenario: &'static str) -> Kind {
    Kind {
        row,
        scenarios: [scenario; 2],
        lens: None,
        displays: 10,
    }
}

/// What is found of the displays of a row.
struct Found {
    /// How many of how many, FHD and UHD.
    counts: [[usize; 2]; 2],
    /// Largest error of the pitch, as a part, and of the slant, subpixels per row.
    most: (f64, f64),
}

/// None may be off by more than the next pattern allows; what is not found is refused.
fn found(kind: &Kind) -> Found {
    let all = on_two_threads(kind.displays, |seed| {
        let name = kind.scenarios[usize::from(seed % 5 != 4)];
        let (display, found) = told(name, seed, LARGE, |display| {
            if let Some(subpixels) = kind.lens {
                widen(display, subpixels);
            }
        });
        println!(
            "{}, {name}, display {seed}: {found:?}, true {:?}",
            kind.row,
            true_sheet(&display)
        );
        let found = found.map(|found| off(&display, &found));
        (usize::from(display.panel.columns == 3840), found.ok())
    });
    let counts = [0, 1].map(|panel| {
        let of = || all.iter().filter(|(of, _)| *of == panel);
        [of().filter(|(_, off)| off.is_some()).count(), of().count()]
    });
    let most = |of: fn((f64, f64)) -> f64| {
        let off = all.iter().filter_map(|(_, off)| *off);
        off.map(of).fold(0.0, f64::max)
    };
    let most = (most(|off| off.0), most(|off| off.1));
    assert!(most.0 < PITCH && most.1 < SLANT, "{}: {most:?}", kind.row);
    Found { counts, most }
}

/// All displays of the study, every fifth with blue on the left.
#[test]
#[ignore = "minutes: make calibration"]
fn full_calibrate_rough_displays() {
    let Found { counts, most } = found(&Kind {
        row: "ordinary",
        scenarios: ["bgr", "ordinary"],
        lens: None,
        displays: chosen("MANYVIEW_CALIBRATION_DISPLAYS", 200),
    });
    let [found, displays] = [0, 1].map(|i| counts[0][i] + counts[1][i]);
    let mut table = String::from(
        "| displays | found | pitch off by at most | slant off by at most |\n|---|---|---|---|\n",
    );
    let _ = writeln!(
        table,
        "| {displays} | {found} | {:.2} % | {:.4} subpixels per row |",
        100.0 * most.0,
        most.1
    );
    println!("{table}");
    write("gratings", &table);
    assert!(found as f64 >= 0.95 * displays as f64, "{table}");
}

/// How far it goes beyond them.
#[test]
#[ignore = "minutes: make calibration"]
fn full_calibrate_rough_beyond() {
    let kinds = [
        lenses("lenses of 2.6 subpixels", 2.6),
        lenses("lenses of 3 subpixels", 3.0),
        lenses("lenses of 4 subpixels", 4.0),
        lenses("lenses of 45 subpixels", 45.0),
        lenses("lenses of 75 subpixels", 75.0),
        others("pixels turned by 90 degrees", "turned pixels"),
        others("barriers", "barrier"),
        others("lenses behind the pixels", "lenses behind"),
    ];
    let mut table = String::from(
        "| displays | found on FHD | on UHD | pitch off by at most | slant off by at most |\n|---|---|---|---|---|\n",
    );
    for kind in &kinds {
        let Found { counts, most } = found(kind);
        let [fhd, uhd] = counts.map(|[found, of]| format!("{found} of {of}"));
        let off = match counts[0][0] + counts[1][0] {
            0 => String::from("|"),
            _ => format!("{:.2} % | {:.4} subpixels per row", 100.0 * most.0, most.1),
        };
        let _ = writeln!(table, "| {} | {fhd} | {uhd} | {off} |", kind.row);
    }
    println!("{table}");
    write("gratings beyond", &table);
}
