//! Round trips: a display, simulated photos of it, and the description that `manyview calibrate` finds from them.

mod camera;
mod gallery;
pub(crate) mod random;
mod scene;

use crate::calibrate_glass::{chosen, mapped, on_two_threads};
use camera::{Exposure, Sheet, expose};
use image::RgbImage;
use manyview::calibrate::{CalibrateError, Fit, Guess, Mask, Photo, Setup, Sighting, fit, pattern};
use manyview::display::{Display, Kind};
use random::Random;
use scene::Scene;
use std::collections::BTreeMap;
use std::process::Command;

const QUALITY: u8 = 70;

/// The phase that a fit has the mask of a panel of this size made for, at a point in pixels from the top left corner, in lenses.
fn claimed(found: &Fit, size: (u32, u32)) -> impl Fn(f64, f64) -> f64 + use<> {
    let Mask {
        pitch,
        slant,
        offset,
        map,
        ..
    } = found.mask.clone();
    move |x, y| {
        let plane = 3.0 * x - 0.5 + slant * (y - 0.5) + offset;
        let bias = map.as_ref().map_or(0.0, |map| mapped(map, [x, y], size));
        (plane + bias) / pitch
    }
}

/// Per cent of the subpixels whose phase is off by more than half a view.
fn wrong(sheet: &Sheet, found: &Fit) -> f64 {
    let claim = claimed(found, sheet.size);
    let colours = found.colours.map_or([0.0; 3], |(colours, _)| colours);
    let (mut off, mut all) = (0, 0);
    for row in (0..sheet.size.1).step_by(7) {
        for subpixel in 0..3 * sheet.size.0 {
            let (x, y) = ((f64::from(subpixel) + 0.5) / 3.0, f64::from(row) + 0.5);
            let colour = (subpixel % 3) as usize;
            let apart = claim(x, y) + colours[colour] / found.mask.pitch
                - sheet.phase(x, y)
                - sheet.colours[colour] / sheet.pitch;
            let apart = (apart - apart.round()).abs() * f64::from(sheet.views);
            off += u32::from(apart > 0.5);
            all += 1;
        }
    }
    100.0 * f64::from(off) / f64::from(all)
}

/// The outcome of a round trip; per cent of subpixels off by more than half a view.
#[derive(Clone, Debug)]
enum Outcome {
    Refused(String),
    Flagged,
    Accepted(f64),
}

fn outcome(
    scene: &Scene,
    setup: &Setup,
    sightings: &[&Result<Sighting, CalibrateError>],
) -> Outcome {
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
        Ok(_) => Outcome::Flagged,
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
    for seed in 0..3 {
        let mut random = Random(seed);
        let scene = Scene::random(&mut random);
        let exposures = exposures(&scene, 2, &mut random);
        let sightings = exposures
            .iter()
            .map(|e| sight(&scene, e, 20.0, &mut random));
        let sightings: Vec<_> = sightings.collect();
        let outcome = outcome(&scene, &scene.setup, &sightings.iter().collect::<Vec<_>>());
        let right = matches!(outcome, Outcome::Accepted(wrong) if wrong < 0.5);
        assert!(right, "display {seed}: {outcome:?}, {:?}", scene.sheet);
    }
}

#[test]
fn colours_and_a_bent_sheet_come_back() {
    let mut random = Random(2);
    let mut scene = Scene::random(&mut random);
    scene.sheet.colours = [0.35, -0.05, -0.3];
    scene.sheet.bias = [1.2, -0.9, 1.0, -0.7, 1.2, -1.0, 0.9, -1.1, 0.8];
    let exposures = exposures(&scene, 3, &mut random);
    let sightings = exposures
        .iter()
        .map(|e| sight(&scene, e, 20.0, &mut random));
    let sightings: Vec<_> = sightings.collect::<Result<_, _>>().expect("clear photos");
    let mut asked = scene.setup.clone();
    (asked.colours, asked.bias) = (true, true);
    let found = fit(&asked, &sightings).expect("a fit");
    assert!(found.doubts.is_empty(), "{:?}", found.doubts);
    assert!(wrong(&scene.sheet, &found) < 0.5, "{found:?}");
    let (colours, _) = found.colours.expect("asked for");
    for (found, truth) in colours.iter().zip(scene.sheet.colours) {
        assert!((found - truth).abs() < 0.1, "{colours:?}");
    }
    // The same photos fitted without a bias: the sheet's bias is half a view more than a plane can follow.
    let plain = fit(&scene.setup, &sightings).expect("a fit");
    let missed = wrong(&scene.sheet, &plain);
    assert!(
        missed > 5.0 && !plain.doubts.is_empty(),
        "{missed} %, {:?}",
        plain.doubts
    );
}

#[test]
fn a_mask_for_viewers_shows_them_the_middle_view_everywhere() {
    let mut random = Random(1);
    let scene = Scene::random(&mut random);
    let exposures = exposures(&scene, 2, &mut random);
    let sightings = exposures
        .iter()
        .map(|e| sight(&scene, e, 20.0, &mut random));
    let sightings: Vec<_> = sightings.collect::<Result<_, _>>().expect("clear photos");
    let sheet = &scene.sheet;
    let (width, height) = (f64::from(sheet.size.0), f64::from(sheet.size.1));
    let distance = 600.0 / camera::PIXEL;
    let mut asked = scene.setup.clone();
    asked.viewer = Some(distance);
    let claims = [&scene.setup, &asked].map(|setup| {
        let found = fit(setup, &sightings).expect("a fit");
        claimed(&found, sheet.size)
    });
    // The view farthest from the middle one, in views, that an eye straight before the panel sees.
    let [plain, matched] = claims.map(|claim| {
        let mut farthest = 0.0f64;
        for (x, y) in [
            (5.0, 5.0),
            (955.0, 20.0),
            (480.0, 270.0),
            (20.0, 530.0),
            (940.0, 535.0),
        ] {
            // A point on the axis of a lens; then the pixel that the eye sees under it.
            let x = x + (0.5 - sheet.phase(x, y).rem_euclid(1.0)) * sheet.pitch / 3.0;
            let lean = sheet.gap() / camera::PIXEL / distance;
            let seen = claim(x + (x - width / 2.0) * lean, y + (y - height / 2.0) * lean);
            farthest = farthest.max((seen.rem_euclid(1.0) - 0.5).abs() * f64::from(sheet.views));
        }
        farthest
    });
    assert!(plain > 1.0 && matched < 0.25, "{plain} and {matched} views");
}

/// The error with which a photo of a scene is refused after `change`, or its sighting where it is accepted.
fn refusal(change: impl Fn(&mut Scene)) -> Result<Sighting, CalibrateError> {
    let mut random = Random(2);
    let mut scene = Scene::random(&mut random);
    let picture = pattern(&scene.setup).expect("a pattern");
    change(&mut scene);
    let exposure = expose(&scene.sheet, &picture, &scene.shots[0], &mut random);
    sight(&scene, &exposure, 20.0, &mut random)
}

#[test]
fn photos_that_cannot_answer_are_refused_with_the_reason() {
    type Change = fn(&mut Scene);
    type Expected = fn(&CalibrateError) -> bool;
    let cases: [(&str, Change, Expected); 5] = [
        (
            "blur",
            |scene| scene.shots[0].blur = 12.0,
            |e| {
                matches!(
                    e,
                    CalibrateError::Edges { .. } | CalibrateError::Contrast { .. }
                )
            },
        ),
        (
            "glare",
            |scene| scene.shots[0].lamp = Some([480.0, 200.0, 170.0, 3.0]),
            |e| matches!(e, CalibrateError::Glare { .. }),
        ),
        (
            "a camera too far away",
            |scene| scene.shots[0].eye = scene.shots[0].eye.map(|v| 4.0 * v),
            |e| {
                matches!(
                    e,
                    CalibrateError::TooSmall { .. } | CalibrateError::NoPanel { .. }
                )
            },
        ),
        (
            "another pattern",
            |scene| scene.setup.pitch *= 1.001,
            |e| matches!(e, CalibrateError::OtherPattern { .. }),
        ),
        (
            "a sheet that is far from the nominal one",
            |scene| scene.sheet.pitch *= 1.04,
            |e| {
                matches!(
                    e,
                    CalibrateError::Outside { .. } | CalibrateError::Frequency { .. }
                )
            },
        ),
    ];
    for (name, change, expected) in cases {
        match refusal(change) {
            Err(error) => assert!(expected(&error), "{name}: {error}"),
            Ok(sighting) => panic!("{name} is not noticed: {sighting:?}"),
        }
    }
    // A small disturbance is tolerated.
    let small = refusal(|scene| scene.shots[0].lamp = Some([300.0, 200.0, 40.0, 3.0]));
    assert!(small.is_ok(), "{small:?}");
}

#[test]
fn pictures_without_a_readable_panel_are_refused() {
    let setup = Setup::new(960, 540, 8, 8.0, 0.66);
    let shown = pattern(&setup).expect("a pattern");
    // The pattern itself on black: the photo of a panel without lenses.
    let mut straight = RgbImage::new(1200, 800);
    image::imageops::overlay(&mut straight, &shown, 120, 130);
    let mirrored = image::imageops::flip_horizontal(&straight);
    let photo = |picture: &RgbImage| Photo::from_picture("photo", picture, None);
    let refused = |picture: &RgbImage| Sighting::new(&photo(picture), &setup).map(|s| s.contrast());
    let dark = refused(&RgbImage::new(1200, 800));
    assert!(
        matches!(dark, Err(CalibrateError::NoPanel { .. })),
        "{dark:?}"
    );
    let mirror = refused(&mirrored);
    assert!(
        matches!(mirror, Err(CalibrateError::Mirrored { .. })),
        "{mirror:?}"
    );
    // Without lenses there is no moiré with the pattern.
    let bare = refused(&straight);
    assert!(
        matches!(
            bare,
            Err(CalibrateError::Contrast { .. } | CalibrateError::Frequency { .. })
        ),
        "{bare:?}"
    );
    let nothing = fit(&setup, &[]);
    assert!(matches!(nothing, Err(CalibrateError::NoPhoto)));
    let file = Photo::decode("photo", b"no picture");
    assert!(matches!(file, Err(CalibrateError::Decode { .. })));
}

#[test]
fn the_command_makes_the_pattern_and_fits_photos() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let mut random = Random(0);
    let scene = Scene::random(&mut random);
    let run = |step: &str, rest: &[&std::ffi::OsStr]| {
        let Setup {
            pitch,
            slant,
            views,
            ..
        } = scene.setup;
        let output = Command::new(env!("CARGO_BIN_EXE_manyview"))
            .args(["calibrate", step, "--size", "960x540"])
            .args(["--pitch", &pitch.to_string(), "--views", &views.to_string()])
            .arg(format!("--slant={slant}"))
            .args(rest)
            .output()
            .expect("the command");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        (
            output.status.code(),
            text(&output.stdout),
            text(&output.stderr),
        )
    };
    let (code, _, errors) = run("pattern", &["--out".as_ref(), at("pattern.png").as_ref()]);
    assert_eq!(code, Some(0), "{errors}");
    let picture = image::open(at("pattern.png"))
        .expect("a picture")
        .into_rgb8();
    assert_eq!(picture, pattern(&scene.setup).expect("a pattern"));
    for (name, shot) in ["a.jpg", "b.jpg"].iter().zip(&scene.shots) {
        let exposure = expose(&scene.sheet, &picture, shot, &mut random);
        std::fs::write(at(name), exposure.jpeg(20.0, QUALITY, &mut random)).expect("written");
    }
    let (out, seen, a, b) = (at("panel.toml"), at("fit.png"), at("a.jpg"), at("b.jpg"));
    // For an eye elsewhere one photo does not tell enough; for one where it was taken it does.
    let elsewhere = ["--viewer", "800", "--dpi", "96"].map(AsRef::as_ref);
    let alone = ["--out".as_ref(), out.as_ref(), a.as_ref()];
    let (code, _, errors) = run("fit", &[&elsewhere[..], &alone].concat());
    assert_eq!(code, Some(2), "{errors}");
    assert!(
        errors.contains("the fit is doubtful")
            && errors.contains(
                "take the first photo from where the viewers are, and leave out --viewer"
            )
            && !out.exists(),
        "{errors}"
    );
    let both = [
        "--out".as_ref(),
        out.as_ref(),
        "--picture".as_ref(),
        seen.as_ref(),
        a.as_ref(),
        b.as_ref(),
    ];
    let (code, report, errors) = run("fit", &both);
    assert_eq!(code, Some(0), "{errors}");
    assert!(
        report.contains("residuals  mean") && report.contains("confidence"),
        "{report}"
    );
    assert!(image::open(&seen).expect("a picture").width() > 1000);
    // Of many photos, some may be spoilt.
    std::fs::write(at("spoilt.jpg"), "no picture").expect("written");
    let spoilt = at("spoilt.jpg");
    let many = [&both[..], &[spoilt.as_ref(); 5]].concat();
    let (code, _, errors) = run("fit", &many);
    assert_eq!(code, Some(0), "{errors}");
    assert_eq!(errors.matches("left out: ").count(), 5, "{errors}");
    let display = Display::load(out.to_str().expect("UTF-8")).expect("a display file");
    assert_eq!(display.views, scene.sheet.views);
    let Kind::Slanted(lens) = display.kind else {
        panic!("a slanted sheet");
    };
    let (pitch, slant) = (lens.pitch.to_f64(), lens.slant.to_f64());
    // Without --viewer the mask is for an eye where the first photo was taken, which sees the lenses over pixels that are further apart.
    let [.., distance] = scene.shots[0].eye;
    let expected = scene.sheet.pitch / (1.0 - scene.sheet.gap() / distance);
    assert!((pitch / expected - 1.0).abs() < 1e-4, "{pitch} {expected}");
    assert!((slant - scene.sheet.slant).abs() < 1e-2, "{slant}");
    assert!(lens.inverted, "lenses before the pixels");
}

/// Number of displays of the long test, unless `MANYVIEW_CALIBRATION_DISPLAYS` says another one.
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

fn all_outcomes() -> BTreeMap<u64, Vec<[Outcome; PHOTOS.len()]>> {
    let displays = chosen("MANYVIEW_CALIBRATION_DISPLAYS", DISPLAYS);
    on_two_threads(displays, |seed| (seed, outcomes(seed)))
        .into_iter()
        .collect()
}

/// The quantile of sorted values: the value below which a part (0 to 1) of them lies.
fn rank(sorted: &[f64], part: f64) -> f64 {
    let at = (part * sorted.len() as f64).ceil() as usize;
    sorted.get(at.max(1) - 1).copied().unwrap_or(f64::NAN)
}

#[test]
#[ignore = "200 displays, three photos each: half an hour"]
fn full_calibrate_two_hundred_displays() {
    let all = all_outcomes();
    println!(
        "wrong: % of subpixels off by more than half a view; all: with refused and flagged as 100"
    );
    println!(
        "SNR dB  photos          accepted  flagged  refused  median    p95    max  all: median  silent misses"
    );
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
                    Outcome::Flagged => flagged += 1,
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
