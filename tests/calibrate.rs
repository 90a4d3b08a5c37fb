//! Round trips: a display, simulated photos of it, and what `manyview calibrate` makes of them.
#![forbid(unsafe_code)]

#[path = "calibrate/camera.rs"]
mod camera;
#[path = "calibrate/random.rs"]
mod random;
#[path = "calibrate/scene.rs"]
mod scene;

use camera::{Exposure, Sheet, expose};
use manyview::calibrate::{CalibrateError, Fit, Guess, Photo, Setup, Sighting, fit, pattern};
use random::Random;
use scene::Scene;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};

const QUALITY: u8 = 70;

/// The part of the subpixels, in per cent, whose phase is off by more than half a view.
fn wrong(sheet: &Sheet, found: &Fit) -> f64 {
    let mut claimed = sheet.clone();
    (claimed.pitch, claimed.slant, claimed.offset) = (found.pitch, found.slant, found.offset);
    claimed.bias = found.bias.unwrap_or_default();
    claimed.colours = found.colours.map_or([0.0; 3], |(colours, _)| colours);
    let (mut off, mut all) = (0, 0);
    for row in (0..sheet.size.1).step_by(7) {
        for subpixel in 0..3 * sheet.size.0 {
            let (x, y) = ((f64::from(subpixel) + 0.5) / 3.0, f64::from(row) + 0.5);
            let colour = (subpixel % 3) as usize;
            let phase = |sheet: &Sheet| sheet.phase(x, y) + sheet.colours[colour] / sheet.pitch;
            let apart = phase(&claimed) - phase(sheet);
            let apart = (apart - apart.round()).abs() * f64::from(sheet.views);
            off += u32::from(apart > 0.5);
            all += 1;
        }
    }
    100.0 * f64::from(off) / f64::from(all)
}

/// What became of a round trip; per cent of subpixels off by more than half a view.
#[derive(Clone, Debug)]
enum Outcome {
    Refused(String),
    Flagged(f64),
    Accepted(f64),
}

fn outcome(scene: &Scene, setup: &Setup, sightings: &[&Result<Sighting, CalibrateError>]) -> Outcome {
    let mut good = Vec::new();
    for sighting in sightings {
        match sighting {
            Ok(sighting) => good.push(sighting.clone()),
            Err(error) => return Outcome::Refused(error.to_string()),
        }
    }
    match fit(setup, &good) {
        Err(error) => Outcome::Refused(error.to_string()),
        Ok(found) if found.doubts.is_empty() => Outcome::Accepted(wrong(&scene.sheet, &found)),
        Ok(found) => Outcome::Flagged(wrong(&scene.sheet, &found)),
    }
}

fn sight(
    scene: &Scene,
    exposure: &Exposure,
    snr: f64,
    random: &mut Random,
) -> Result<Sighting, CalibrateError> {
    let photo = Photo::decode("photo", &exposure.jpeg(snr, QUALITY, random))?;
    Sighting::new(&photo.with_equivalent(scene.equivalent), &scene.setup)
}

fn exposures(scene: &Scene, count: usize, random: &mut Random) -> Vec<Exposure> {
    let picture = pattern(&scene.setup).expect("a pattern");
    let shots = scene.shots.iter().take(count);
    shots
        .map(|shot| expose(&scene.sheet, &picture, shot, random))
        .collect()
}

#[test]
fn a_few_displays_come_back() {
    for seed in 0..4 {
        let mut random = Random(seed);
        let scene = Scene::random(&mut random);
        let exposures = exposures(&scene, 2, &mut random);
        let sightings = exposures.iter().map(|e| sight(&scene, e, 20.0, &mut random));
        let sightings: Vec<_> = sightings.collect();
        let outcome = outcome(&scene, &scene.setup, &sightings.iter().collect::<Vec<_>>());
        let right = matches!(outcome, Outcome::Accepted(wrong) if wrong < 0.5);
        assert!(right, "display {seed}: {outcome:?}, {:?}", scene.sheet);
    }
}

/// Displays of the long test.
const DISPLAYS: u64 = 200;
const NOISE: [f64; 4] = [6.0, 10.0, 20.0, 30.0];
const PHOTOS: [&str; 4] = ["1", "1, cone known", "2", "3"];

/// All outcomes of a display, by noise and photos.
fn outcomes(seed: u64) -> Vec<[Outcome; PHOTOS.len()]> {
    let mut random = Random(seed);
    let scene = Scene::random(&mut random);
    let exposures = exposures(&scene, 3, &mut random);
    let mut known = scene.setup.clone();
    known.cone = Guess {
        value: scene.sheet.cone * random.between(0.97, 1.03),
        spread: 0.03,
    };
    NOISE
        .iter()
        .map(|&snr| {
            let sightings = exposures.iter().map(|e| sight(&scene, e, snr, &mut random));
            let sightings: Vec<_> = sightings.collect();
            let all: Vec<_> = sightings.iter().collect();
            [
                outcome(&scene, &scene.setup, &all[..1]),
                outcome(&scene, &known, &all[..1]),
                outcome(&scene, &scene.setup, &all[..2]),
                outcome(&scene, &scene.setup, &all),
            ]
        })
        .collect()
}

/// Two threads; each display is its own seed.
fn all_outcomes() -> BTreeMap<u64, Vec<[Outcome; PHOTOS.len()]>> {
    let next = AtomicU64::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed >= DISPLAYS {
                return done;
            }
            done.push((seed, outcomes(seed)));
        }
    };
    std::thread::scope(|scope| {
        let threads = [scope.spawn(work), scope.spawn(work)];
        let done = threads.into_iter().flat_map(|t| t.join().expect("no panic"));
        done.collect()
    })
}

/// The value below which a part of the sorted values lies.
fn rank(sorted: &[f64], part: f64) -> f64 {
    let at = (part * sorted.len() as f64).ceil() as usize;
    sorted.get(at.max(1) - 1).copied().unwrap_or(f64::NAN)
}

#[test]
#[ignore = "200 displays, three photos each: half an hour"]
fn full_calibrate_two_hundred_displays() {
    let all = all_outcomes();
    println!("wrong: % of subpixels off by more than half a view; all: with refused and flagged as 100");
    println!("SNR dB  photos          accepted  flagged  refused  median    p95    max  all: median  silent misses");
    let mut silent = Vec::new();
    let mut bounds = Vec::new();
    for (i, snr) in NOISE.iter().enumerate() {
        for (j, photos) in PHOTOS.iter().enumerate() {
            let (mut good, mut every, mut flagged, mut refused) = (vec![], vec![], 0, 0);
            let before = silent.len();
            for (seed, outcomes) in &all {
                let name = format!("display {seed}, {snr} dB, photos {photos}");
                every.push(100.0);
                match &outcomes[i][j] {
                    Outcome::Refused(why) => {
                        refused += 1;
                        println!("{name}: {why}");
                    }
                    Outcome::Flagged(_) => flagged += 1,
                    Outcome::Accepted(wrong) => {
                        good.push(*wrong);
                        every.pop();
                        every.push(*wrong);
                        if *wrong > 5.0 {
                            silent.push(format!("{name}: {wrong:.1} %"));
                        }
                    }
                }
            }
            good.sort_by(f64::total_cmp);
            every.sort_by(f64::total_cmp);
            let median = rank(&every, 0.5);
            println!(
                "{snr:>6}  {photos:<14}  {:>8}  {flagged:>7}  {refused:>7}  {:>6.2} {:>6.2} {:>6.2}  {median:>11.2}  {:>13}",
                good.len(),
                rank(&good, 0.5),
                rank(&good, 0.95),
                rank(&good, 1.0),
                silent.len() - before,
            );
            if *snr >= 20.0 && *photos == "2" && median > 0.5 {
                bounds.push(format!("{snr} dB, two photos: median {median:.2} %"));
            }
        }
    }
    assert!(bounds.is_empty(), "{bounds:?}");
    assert!(silent.is_empty(), "{silent:#?}");
}
