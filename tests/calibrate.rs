//! Round trips: a display, simulated photos of it, and what `manyview calibrate` makes of them.
#![forbid(unsafe_code)]

#[path = "calibrate/camera.rs"]
mod camera;
#[path = "calibrate/random.rs"]
mod random;
#[path = "calibrate/scene.rs"]
mod scene;

use camera::{Exposure, Sheet, expose};
use manyview::calibrate::{CalibrateError, Fit, Photo, Sighting, fit, pattern};
use random::Random;
use scene::Scene;

const QUALITY: u8 = 70;

/// The part of the subpixels, in per cent, whose phase is off by more than half a view, and the largest error in views.
fn wrong(sheet: &Sheet, found: &Fit) -> (f64, f64) {
    let (mut off, mut all, mut worst) = (0, 0, 0.0f64);
    for row in (0..sheet.size.1).step_by(7) {
        for x in 0..3 * sheet.size.0 {
            let (right, down) = ((f64::from(x) + 0.5) / 3.0, f64::from(row) + 0.5);
            let (c, whole) = ((x % 3) as usize, f64::from(x));
            let truth = sheet.phase(right, down) + sheet.colours[c] / sheet.pitch;
            let bias = found.bias.map_or(0.0, |bias| {
                Sheet {
                    bias,
                    pitch: 1.0,
                    offset: 0.0,
                    ..sheet.clone()
                }
                .phase(right, down)
                    - Sheet {
                        bias: [0.0; 9],
                        pitch: 1.0,
                        offset: 0.0,
                        ..sheet.clone()
                    }
                    .phase(right, down)
            });
            let colour = found.colours.map_or(0.0, |(colours, _)| colours[c]);
            let answer =
                (whole + found.slant * f64::from(row) + found.offset + colour + bias) / found.pitch;
            let apart = answer - truth;
            let apart = (apart - apart.round()).abs() * f64::from(sheet.views);
            off += u32::from(apart > 0.5);
            all += 1;
            worst = worst.max(apart);
        }
    }
    (100.0 * f64::from(off) / f64::from(all), worst)
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
        let sightings: Result<Vec<_>, _> = exposures
            .iter()
            .map(|exposure| sight(&scene, exposure, 20.0, &mut random))
            .collect();
        let sheet = &scene.sheet;
        match sightings {
            Err(error) => println!("{seed}: refused: {error}"),
            Ok(sightings) => match fit(&scene.setup, &sightings) {
                Err(error) => println!("{seed}: refused: {error}"),
                Ok(found) => {
                    let (part, worst) = wrong(sheet, &found);
                    println!("{seed}: wrong {part:.2} % worst {worst:.3} views, {sheet:?} exif {:?}\n {:?}", scene.equivalent, scene.shots[0]);
                    println!("   {:?}", found.residuals);
                    println!("   pitch {} slant {} offset {} gap {} dev {} worst {} unsure {} doubts {:?} cams {:?}", found.pitch, found.slant, found.offset, found.gap*camera::PIXEL, found.deviation, found.worst_deviation, found.unsure, found.doubts, found.cameras);
                }
            },
        }
    }
}
