//! Calibration against an optical simulator that shares nothing with the fit: rays through sheets of glass, a phone's camera, files as they come.
//!
//! `make calibration` takes the whole table; the ordinary run a few displays.

use crate::optics::compare::{Sampling, compare};
use crate::optics::displays::{Display, display, small};
use crate::optics::eye::Truth;
use crate::optics::photograph_jpeg;
use crate::optics::random::Random;
use crate::optics::scenario::{ALL, First, Scenario, Taking, scenario};
use image::RgbImage;
use manyview::calibrate::{Beats, Fit, Photo, Setup, Sighting, fit, pattern, rough, rough_pattern};
use manyview::display::SubpixelOrder;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::atomic::{AtomicU64, Ordering};

/// What the owner of a display knows of it: the data sheet; and where the viewers sit, if no photo is from there.
fn setup(display: &Display, first: First) -> Setup {
    let panel = &display.panel;
    let mut setup = Setup::new(
        panel.columns as u32,
        panel.rows as u32,
        display.views,
        3.0 * display.nominal_columns(),
        -3.0 * display.nominal_lean(),
    );
    setup.viewer = match first {
        First::Seat => None,
        First::Anywhere => Some(display.distance / panel.pitch),
    };
    setup
}

/// A mask's map of 17x9 places at a point of a panel, pixels from the top left corner.
pub(crate) fn mapped(map: &[f64], [x, y]: [f64; 2], (width, height): (u32, u32)) -> f64 {
    let cell = |at: f64, size: u32, cells: f64| {
        let at = (at / f64::from(size) * cells).clamp(0.0, cells - 1e-6);
        (at as usize, at.fract())
    };
    let ((i, u), (j, v)) = (cell(x, width, 16.0), cell(y, height, 8.0));
    let line = |j: usize| map[17 * j + i] * (1.0 - u) + map[17 * j + i + 1] * u;
    line(j) * (1.0 - v) + line(j + 1) * v
}

/// The view of a subpixel that the mask of a fit has, from 0 to N.
fn view(found: &Fit, setup: &Setup, (x, row, colour): (usize, usize, usize)) -> f64 {
    let place = match found.order {
        SubpixelOrder::Rgb => colour,
        SubpixelOrder::Bgr => 2 - colour,
    };
    let middle = [x, row].map(|at| at as f64 + 0.5);
    let map = found.mask.map.as_ref();
    let bias = map.map_or(0.0, |map| mapped(map, middle, (setup.width, setup.height)));
    let colours = found.colours.map_or(0.0, |(colours, _)| colours[colour]);
    let phase =
        (3 * x + place) as f64 + found.mask.slant * row as f64 + found.mask.offset + bias + colours;
    let phase = phase / found.mask.pitch;
    let phase = if setup.inverted { -phase } else { phase };
    phase.rem_euclid(1.0) * f64::from(setup.views)
}

/// What came of the photos of one display.
struct Outcome {
    accepted: bool,
    /// Per cent of the subpixels whose view is off by more than half a view, and of those that still are without a constant; none without a fit.
    wrong: Option<[f64; 2]>,
    /// The verdict in words.
    said: String,
}

/// What comes of the first few photos of a scenario, for each number of them.
fn outcomes(scenario: &Scenario, setup: &Setup, counts: &[usize]) -> Vec<Outcome> {
    let picture: RgbImage = pattern(setup).expect("a pattern");
    let shown = scenario.showing.apply(&scenario.display.panel, &picture);
    let sightings = scenario.shots.iter().enumerate().map(|(number, shot)| {
        let file = photograph_jpeg(&scenario.display, &shown, shot).expect("a file");
        Photo::decode(&format!("photo {number}"), &file)
            .and_then(|photo| Sighting::new(&photo, setup))
            .map_err(|error| error.to_string())
    });
    let sightings: Vec<Result<Sighting, String>> = sightings.collect();
    let truth = Truth::new(&scenario.display);
    let outcome = |count: usize| {
        let sightings = sightings.iter().take(count).cloned();
        let sightings: Vec<Sighting> = sightings.collect::<Result<_, _>>()?;
        let found = fit(setup, &sightings).map_err(|error| error.to_string())?;
        let compared = compare(
            &truth,
            |x, row, colour| view(&found, setup, (x, row, colour)),
            Sampling::default(),
        );
        let said = format!(
            "{}; unsure {:.0} %, phase ± {:.2}, residuals {:.3}, order {:?} {}, viewer {:.0}",
            found.doubts.join("; "),
            100.0 * found.phase.unsure,
            found.phase.worst,
            found.residuals.rms,
            found.order,
            found.order_measured,
            found.mask.viewer,
        );
        Ok(Outcome {
            accepted: found.doubts.is_empty(),
            wrong: Some([compared.wrong, compared.wrong_after_offset].map(|share| 100.0 * share)),
            said,
        })
    };
    let refused = |said: String| Outcome {
        accepted: false,
        wrong: None,
        said,
    };
    let all = counts
        .iter()
        .map(|&count| outcome(count).unwrap_or_else(refused));
    all.collect()
}

/// Photos of 3 Mpx: a display whose views are not too fine for them.
const SEED: u64 = 7;
const SMALL: [u32; 2] = [2016, 1512];

fn taken(name: &str, photos: usize, first: First) -> Outcome {
    taken_for(name, photos, first, |_| ())
}

fn taken_for(name: &str, photos: usize, first: First, ask: fn(&mut Setup)) -> Outcome {
    let taking = Taking {
        photos,
        first,
        size: SMALL,
        seed: SEED,
    };
    let scenario = scenario(name, &display(SEED), taking).expect("a name");
    let mut setup = setup(&scenario.display, first);
    ask(&mut setup);
    let all = outcomes(&scenario, &setup, &[photos]);
    all.into_iter().next().expect("an outcome")
}

#[test]
fn a_sheet_of_glass_comes_back() {
    for first in [First::Seat, First::Anywhere] {
        let outcome = taken("ordinary", 3, first);
        assert!(outcome.accepted, "{first:?}: {}", outcome.said);
        let [wrong, _] = outcome.wrong.expect("a fit");
        assert!(wrong < 1.0, "{first:?}: {wrong} %: {}", outcome.said);
    }
}

#[test]
fn blue_on_the_left_is_measured() {
    let outcome = taken("bgr", 3, First::Seat);
    assert!(outcome.accepted, "{}", outcome.said);
    assert!(outcome.said.contains("order Bgr true"), "{}", outcome.said);
    let [wrong, _] = outcome.wrong.expect("a fit");
    assert!(wrong < 1.0, "{wrong} %: {}", outcome.said);
}

#[test]
fn pixels_that_are_turned_are_noticed() {
    let outcome = taken("turned pixels", 3, First::Seat);
    assert!(!outcome.accepted, "{}", outcome.said);
    let said = "as where pixels are turned by 90 degrees; measure where they lie, with --colours";
    assert!(outcome.said.contains(said), "{}", outcome.said);
    let outcome = taken_for("turned pixels", 3, First::Seat, |setup| {
        setup.colours = true;
    });
    assert!(outcome.accepted, "{}", outcome.said);
    let [wrong, _] = outcome.wrong.expect("a fit");
    assert!(wrong < 1.0, "{wrong} %: {}", outcome.said);
}

/// Behind upright lenses each colour is a column of its own, and photos do not tell where they lie: that is no reason for doubt.
#[test]
fn upright_lenses_are_accepted() {
    let mut display = display(SEED);
    (display.sheet.slant, display.nominal_slant) = (0.0, 0.0);
    let taking = Taking {
        photos: 3,
        first: First::Seat,
        size: SMALL,
        seed: SEED,
    };
    let scenario = scenario("ordinary", &display, taking).expect("a name");
    let setup = setup(&scenario.display, First::Seat);
    let outcome = outcomes(&scenario, &setup, &[3]).remove(0);
    assert!(outcome.accepted, "{}", outcome.said);
    assert!(outcome.said.contains("order Rgb false"), "{}", outcome.said);
    let [wrong, _] = outcome.wrong.expect("a fit");
    assert!(wrong < 1.0, "{wrong} %: {}", outcome.said);
}

/// Files with a few other bytes, many of them cut off, of which some can be read and a few show the pattern: nothing panics.
fn spoilt(count: u64) {
    let display = small();
    let setup = setup(&display, First::Seat);
    let taking = Taking {
        photos: 1,
        first: First::Anywhere,
        size: [504, 378],
        seed: SEED,
    };
    let scenario = scenario("ordinary", &display, taking).expect("a name");
    let size = (setup.width, setup.height);
    let pictures = [pattern(&setup), rough_pattern(size)].map(|picture| {
        let picture = picture.expect("a pattern");
        photograph_jpeg(&scenario.display, &picture, &scenario.shots[0]).expect("a file")
    });
    let folder = std::fs::read_dir("fuzz/seeds/photo").expect("seeds");
    let mut paths: Vec<_> = folder.map(|entry| entry.expect("a file").path()).collect();
    paths.sort();
    let files: Vec<Vec<u8>> = paths
        .iter()
        .map(|path| std::fs::read(path).expect("a seed"))
        .collect();
    let files: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
    let mut random = Random::new(SEED);
    let (mut read, mut seen) = (0, 0);
    for number in 0..count {
        // A photo of the pattern takes a thousand times as long as a small file.
        let mut file = match number % 400 {
            0 => pictures[0].clone(),
            200 => pictures[1].clone(),
            _ => random.pick(&files).to_vec(),
        };
        for _ in 0..random.whole(1, 8) {
            let at = random.bits() as usize % file.len();
            file[at] = random.bits() as u8;
        }
        if random.chance(0.2) {
            file.truncate(random.bits() as usize % file.len());
        }
        let decode = match number % 400 {
            200 => Photo::decode_fine,
            _ => Photo::decode,
        };
        if let Ok(photo) = decode("spoilt", &file) {
            read += 1;
            let shows = match number % 400 {
                200 => Beats::new(&photo, size)
                    .map(|beats| drop(rough(&beats, Setup::CONE)))
                    .is_ok(),
                _ => Sighting::new(&photo, &setup).is_ok(),
            };
            seen += u64::from(shows);
        }
    }
    println!("{count} spoilt files: {read} read, {seen} show the pattern");
    assert!(read > 0 && seen > 0, "{read} read, {seen} seen");
}

#[test]
fn spoilt_photos_do_no_harm() {
    spoilt(2000);
}

#[test]
#[ignore = "minutes: make calibration"]
fn full_a_million_spoilt_photos_do_no_harm() {
    spoilt(1_000_000);
}

#[test]
fn a_pattern_that_is_not_shown_pixel_for_pixel_is_noticed() {
    for (name, part) in [
        ("scaled 99.5", "was shown scaled"),
        ("scaled 99", "was shown scaled"),
        ("shifted", "beside its place"),
    ] {
        let outcome = taken(name, 1, First::Seat);
        assert!(outcome.said.contains(part), "{name}: {}", outcome.said);
    }
}

/// Seconds that this thread has had a processor.
fn processor_time() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").expect("Linux");
    let nanoseconds = text.split_whitespace().next().expect("a number");
    nanoseconds.parse::<f64>().expect("a number") * 1e-9
}

/// A UHD panel in photos of 12 Mpx: reading and measuring them, and the fit, in seconds of processor time a photo.
#[test]
#[ignore = "nothing else may run: make calibration"]
fn full_calibrate_glass_takes_two_seconds_a_photo() {
    const MOST: f64 = 2.0;
    let scenario = scenario("ordinary", &display(0), Taking::new(0)).expect("a name");
    let panel = &scenario.display.panel;
    let size = (panel.columns as u32, panel.rows as u32);
    assert_eq!(size, (3840, 2160));
    let files = |picture: RgbImage| {
        let shown = scenario.showing.apply(panel, &picture);
        let shots = scenario.shots.iter();
        let files =
            shots.map(|shot| photograph_jpeg(&scenario.display, &shown, shot).expect("a file"));
        files.collect::<Vec<Vec<u8>>>()
    };
    let setup = setup(&scenario.display, First::Seat);
    let photos = files(pattern(&setup).expect("a pattern"));
    let begin = processor_time();
    let sightings = photos.iter().map(|file| {
        let photo = Photo::decode("photo", file)?;
        Sighting::new(&photo, &setup)
    });
    let sightings: Vec<Sighting> = sightings.collect::<Result<_, _>>().expect("clear photos");
    let seen = processor_time();
    fit(&setup, &sightings).expect("a fit");
    let end = processor_time();
    let gratings = files(rough_pattern(size).expect("a pattern")).remove(0);
    let rough_begin = processor_time();
    let photo = Photo::decode_fine("gratings", &gratings).expect("a photo");
    let beats = Beats::new(&photo, size).expect("beats");
    rough(&beats, Setup::CONE).expect("a sheet");
    let rough = processor_time() - rough_begin;
    let count = photos.len() as f64;
    let (measured, fitted) = ((seen - begin) / count, (end - seen) / count);
    println!(
        "a photo of 12 Mpx: {measured:.2} s to read and measure, {fitted:.2} s of the fit; one of gratings {rough:.2} s"
    );
    assert!(measured + fitted < MOST && rough < MOST);
}

/// Displays of the long test, and seeds of each scenario.
const DISPLAYS: u64 = 200;
const SEEDS: u64 = 10;
/// Per cent of the subpixels that may be off by more than half a view.
const WRONG: f64 = 5.0;

/// A scenario, where the first photo is taken, how many are used, each number a line of its own, and what the user asks for.
#[derive(Clone, Copy)]
struct Case {
    name: &'static str,
    first: First,
    counts: &'static [usize],
    ask: Ask,
}

/// What a user asks for.
type Ask = fn(&mut Setup);

/// What messages ask the user for, in the scenarios in which they do.
const REMEDIES: [(&str, &str, Ask); 2] = [
    ("bowed", "--bias", |setup| setup.bias = true),
    ("turned pixels", "--colours", |setup| setup.colours = true),
];

/// One line of the study.
struct Row {
    photos: usize,
    outcome: Outcome,
}

/// A whole number that a person sets for a shorter study.
pub(crate) fn chosen(variable: &str, default: u64) -> u64 {
    let text = std::env::var(variable).ok();
    text.and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// What comes of work with each of so many displays, on two threads, in the order of their seeds.
pub(crate) fn on_two_threads<T: Send>(displays: u64, work: impl Fn(u64) -> T + Sync) -> Vec<T> {
    let next = AtomicU64::new(0);
    let some = || {
        let mut done = Vec::new();
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed >= displays {
                return done;
            }
            done.push((seed, work(seed)));
        }
    };
    let mut all: Vec<(u64, T)> = std::thread::scope(|scope| {
        let threads = [scope.spawn(some), scope.spawn(some)];
        let done = threads.into_iter().map(|thread| thread.join());
        done.flat_map(|done| done.expect("no panic")).collect()
    });
    all.sort_by_key(|(seed, _)| *seed);
    all.into_iter().map(|(_, of)| of).collect()
}

/// Photographs displays, and tells each.
fn study(case: Case, displays: u64) -> Vec<Row> {
    let wide = chosen("MANYVIEW_CALIBRATION_WIDTH", 4032) as u32;
    let work = |seed| {
        let taking = Taking {
            photos: case.counts.iter().copied().max().unwrap_or(1),
            first: case.first,
            size: [wide, wide * 3 / 4],
            seed,
        };
        let scenario = scenario(case.name, &display(seed), taking).expect("a name");
        let mut setup = setup(&scenario.display, case.first);
        (case.ask)(&mut setup);
        let all = outcomes(&scenario, &setup, case.counts);
        let rows = case.counts.iter().zip(all).map(|(&photos, outcome)| {
            let verdict = if outcome.accepted {
                "accepted"
            } else {
                "refused"
            };
            let wrong = outcome
                .wrong
                .map(|[all, rest]| format!("{all:.1} % wrong, {rest:.1} % without a constant"));
            let wrong = wrong.unwrap_or_default();
            println!(
                "{}, display {seed} of {} views, {photos} photos: {verdict}, {wrong}; {}",
                case.name, scenario.display.views, outcome.said
            );
            Row { photos, outcome }
        });
        rows.collect::<Vec<Row>>()
    };
    let rows = on_two_threads(displays, work);
    let mut rows: Vec<Row> = rows.into_iter().flatten().collect();
    rows.sort_by_key(|row| row.photos);
    rows
}

/// Writes a part of docs/calibrated.md, between lines that name it.
pub(crate) fn write(name: &str, table: &str) {
    let path = "docs/calibrated.md";
    let text = std::fs::read_to_string(path).expect("the page");
    let (begin, end) = (
        format!("<!-- {name} -->\n\n"),
        format!("\n<!-- end of {name} -->"),
    );
    let from = text.find(&begin).expect("the part") + begin.len();
    let to = text.find(&end).expect("its end");
    std::fs::write(path, format!("{}{table}{}", &text[..from], &text[to..])).expect("written");
}

/// In words, for a table.
fn from(first: First) -> &'static str {
    match first {
        First::Seat => "where the viewers sit",
        First::Anywhere => "elsewhere, with --viewer",
    }
}

/// Half an hour on two cores: of the fits that are right most are accepted, and no accepted one is wrong.
#[test]
#[ignore = "half an hour: make calibration"]
fn full_calibrate_glass_displays() {
    let displays = chosen("MANYVIEW_CALIBRATION_DISPLAYS", DISPLAYS);
    let mut table = String::from(
        "| displays | photos | first photo | accepted | of them wrong | refused | of them right | right ones accepted |\n|---|---|---|---|---|---|---|---|\n",
    );
    let mut missed = Vec::new();
    let study = |first: First, counts: &'static [usize], displays: u64| {
        let name = "ordinary";
        let case = Case {
            name,
            first,
            counts,
            ask: |_| (),
        };
        study(case, displays)
    };
    let (seat, elsewhere) = (
        study(First::Seat, &[1, 2, 3], displays),
        study(First::Anywhere, &[3], displays.div_ceil(4)),
    );
    let lines = [
        (1, First::Seat, 0.0),
        (2, First::Seat, 75.0),
        (3, First::Seat, 90.0),
        (3, First::Anywhere, 0.0),
    ];
    for (photos, first, least) in lines {
        let all = match first {
            First::Seat => &seat,
            First::Anywhere => &elsewhere,
        };
        let rows: Vec<&Row> = all.iter().filter(|row| row.photos == photos).collect();
        let right = |row: &&Row| row.outcome.wrong.is_some_and(|[wrong, _]| wrong <= WRONG);
        let accepted = rows.iter().filter(|row| row.outcome.accepted);
        let accepted: Vec<&Row> = accepted.copied().collect();
        let wrong = accepted.iter().filter(|row| !right(row)).count();
        let all_right = rows.iter().filter(|row| right(row)).count();
        let good = accepted.len() - wrong;
        let share = 100.0 * good as f64 / all_right.max(1) as f64;
        let _ = writeln!(
            table,
            "| {} | {photos} | {} | {} | {wrong} | {} | {} | {share:.0} % |",
            rows.len(),
            from(first),
            accepted.len(),
            rows.len() - accepted.len(),
            all_right - good,
        );
        if wrong > 0 || share < least {
            missed.push(format!(
                "{photos} photos, {}: {wrong} wrong ones accepted, {share:.0} % of the right ones",
                from(first)
            ));
        }
    }
    println!("{table}");
    write("displays", &table);
    assert!(missed.is_empty(), "{}", missed.join("; "));
}

/// Half an hour on two cores: what becomes of photos that are taken in other ways, and what the user reads.
#[test]
#[ignore = "half an hour: make calibration"]
fn full_calibrate_glass_scenarios() {
    let seeds = chosen("MANYVIEW_CALIBRATION_SEEDS", SEEDS);
    let mut table = String::from(
        "| scenario | accepted | most wrong of these | right ones refused | what is said most |\n|---|---|---|---|---|\n",
    );
    let mut missed = Vec::new();
    let plain = ALL.map(|(name, _)| (name, name.to_owned(), (|_| ()) as Ask));
    let asked = REMEDIES.map(|(name, option, ask)| (name, format!("{name}, {option}"), ask));
    for (name, title, ask) in plain.into_iter().chain(asked) {
        let case = Case {
            name,
            first: First::Seat,
            counts: &[3],
            ask,
        };
        let rows = study(case, seeds);
        let wrong = |row: &Row| row.outcome.wrong.map_or(100.0, |[wrong, _]| wrong);
        let (accepted, refused): (Vec<&Row>, Vec<&Row>) =
            rows.iter().partition(|row| row.outcome.accepted);
        let most = accepted.iter().map(|row| wrong(row)).fold(0.0, f64::max);
        let right = refused.iter().filter(|row| wrong(row) <= WRONG).count();
        let mut said = BTreeMap::<String, usize>::new();
        for row in &refused {
            // Photos and figures differ from display to display.
            let words = row.outcome.said.split(';').next().unwrap_or_default();
            let words: String = words.chars().filter(|c| !c.is_ascii_digit()).collect();
            *said.entry(words).or_default() += 1;
        }
        let said = said.into_iter().max_by_key(|(_, count)| *count);
        let said = said.map(|(words, _)| words).unwrap_or_default();
        let _ = writeln!(
            table,
            "| {title} | {} of {} | {most:.1} % | {right} | {said} |",
            accepted.len(),
            rows.len()
        );
        if most > WRONG {
            missed.push(format!("{title}: {most:.1} % wrong"));
        }
    }
    println!("{table}");
    write("scenarios", &table);
    assert!(missed.is_empty(), "{}", missed.join("; "));
}
