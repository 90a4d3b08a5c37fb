//! Named situations in which somebody photographs a display.

use super::camera::{Camera, Shake};
use super::displays::Display;
use super::panel::{Layout, Showing};
use super::random::Random;
use super::scene::{Glare, Room};
use super::sensor::Sensor;
use super::sheet::{Kind, Side};
use super::{File, Shot};

/// A situation: the display as it is in it, how the picture gets onto the panel, and the photos.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    pub display: Display,
    pub showing: Showing,
    pub shots: Vec<Shot>,
}

/// How the photos are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taking {
    /// One is from the front. Two add one from about 10 degrees left. Three add one from about 10 degrees right.
    pub photos: usize,
    /// Where the first one is taken; the others are taken where the panel fills about two thirds of the picture.
    pub first: First,
    /// Width and height of the sensor in px.
    pub size: [u32; 2],
    pub seed: u64,
}

/// Where the first photo is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum First {
    /// At the design distance, or further back where the whole panel would not be in the picture: the viewers sit there then.
    Seat,
    /// Where the panel fills about two thirds of the picture, however far away the viewers sit.
    Anywhere,
}

impl Taking {
    /// Three photos of 12 Mpx, the first one from where the viewers sit.
    pub fn new(seed: u64) -> Self {
        Self {
            photos: 3,
            first: First::Seat,
            size: [4032, 3024],
            seed,
        }
    }
}

type Change = fn(&mut Scenario, u64);

/// All situations by name. Each changes the ordinary one.
pub const ALL: [(&str, Change); 20] = [
    ("ordinary", |_, _| {}),
    ("bgr", |s, _| s.display.panel.layout = Layout::bgr()),
    ("scaled 99.5", |s, _| s.showing.scale = 0.995),
    ("scaled 99", |s, _| s.showing.scale = 0.99),
    ("shifted", |s, _| s.showing.shift = [7, 0]),
    ("bowed", bowed),
    ("mild glare", |s, seed| glare(s, seed, 0.07, 0.3)),
    ("strong glare", |s, seed| glare(s, seed, 0.09, 4.0)),
    ("no exif", |s, _| {
        s.shots
            .iter_mut()
            .for_each(|shot| shot.file.claimed_focal = None)
    }),
    ("exif off", exif_off),
    ("roll", |s, seed| {
        s.shots
            .iter_mut()
            .for_each(|shot| shot.camera.roll += sign(seed, 4) * 20f64.to_radians())
    }),
    ("turned pixels", |s, seed| {
        s.display.panel.layout = Layout::rgb().turned(if sign(seed, 5) > 0.0 { 1 } else { 3 })
    }),
    ("turned sheet", |s, seed| {
        s.display.sheet.turn = sign(seed, 6) * 0.15f64.to_radians()
    }),
    ("bright room", |s, _| {
        s.shots.iter_mut().for_each(|shot| shot.room.ambient = 0.4)
    }),
    ("overexposed", |s, _| {
        s.shots
            .iter_mut()
            .for_each(|shot| shot.sensor.exposure *= 3.0)
    }),
    ("shaken", shaken),
    ("barrel", |s, _| {
        s.shots.iter_mut().for_each(|shot| shot.camera.k1 = -0.1)
    }),
    ("messenger", messenger),
    ("lenses behind", |s, _| s.display.sheet.side = Side::Behind),
    ("barrier", barrier),
];

/// The situation of that name, or None where there is none.
pub fn scenario(name: &str, display: &Display, taking: Taking) -> Option<Scenario> {
    let (_, change) = ALL.iter().find(|(known, _)| *known == name)?;
    let mut scenario = ordinary(display, taking);
    change(&mut scenario, taking.seed);
    Some(scenario)
}

/// A dark room, a steady hand, a picture shown pixel by pixel.
fn ordinary(display: &Display, taking: Taking) -> Scenario {
    let mut random = Random::part(taking.seed, 3);
    let equivalent = f64::from(random.whole(24, 28));
    let (k1, k2) = (random.range(-0.01, 0.01), random.range(-0.003, 0.003));
    let [width, height] = taking.size;
    let scale = f64::from(width) / 4032.0;
    let mut display = display.clone();
    let shots = (0..taking.photos).map(|photo| {
        let mut camera = Camera {
            k1,
            k2,
            ..Camera::new(width, height, equivalent)
        };
        let half = display.panel.half();
        // The distance at which the panel fills about two thirds of the picture's width, or less where its height limits.
        let fill = random.range(0.62, 0.72) / [1.0, 1.2, 1.1][photo % 3];
        let distance = [half[0] / f64::from(width), half[1] / f64::from(height)]
            .map(|v| 2.0 * v * camera.focal / fill);
        let mut distance = distance[0].max(distance[1]);
        let seat = photo == 0 && taking.first == First::Seat;
        if seat {
            distance = distance.max(display.eye()[2]);
        }
        let turn = ([0.0, -10.0, 10.0][photo % 3] + random.range(-1.5, 1.5)).to_radians();
        camera.position = [
            distance * turn.sin(),
            random.range(-0.04, 0.04) * distance,
            distance * turn.cos(),
        ];
        if seat {
            display.distance = camera.position[2] - display.sheet.front();
        }
        camera.aim([
            random.range(-0.02, 0.02) * distance,
            random.range(-0.02, 0.02) * distance,
            0.0,
        ]);
        camera.roll = random.range(-2.0, 2.0).to_radians();
        camera.centre = camera.centre.map(|c| c + random.range(-12.0, 12.0) * scale);
        camera.shake = Shake::new(random.range(0.5, 1.5) * scale, random.bits());
        Shot {
            room: Room {
                ambient: 0.003,
                glare: None,
                bezel: random.range(6.0, 15.0),
            },
            sensor: Sensor {
                blur: random.range(0.6, 1.0),
                seed: random.bits(),
                ..Sensor::default()
            },
            file: File {
                quality: random.whole(70, 90) as u8,
                claimed_focal: Some(camera.equivalent()),
                longest: None,
            },
            camera,
        }
    });
    let shots = shots.collect();
    Scenario {
        display,
        showing: Showing::default(),
        shots,
    }
}

/// 1 or -1, as the seed decides.
fn sign(seed: u64, part: u64) -> f64 {
    if Random::part(seed, part).chance(0.5) {
        1.0
    } else {
        -1.0
    }
}

/// The middle of the sheet stands off by 0.05 to 0.3 mm.
fn bowed(scenario: &mut Scenario, seed: u64) {
    let mut random = Random::part(seed, 7);
    scenario.display.sheet.bow.dome = random.range(0.05, 0.3);
    // The corners move both ways, so the sheet needs room there.
    scenario.display.sheet.bow.twist = random.range(-0.05, 0.05);
    scenario.display.sheet.gap = scenario.display.sheet.gap.max(0.05);
}

/// The lamp stands still: its reflection moves from photo to photo.
fn glare(scenario: &mut Scenario, seed: u64, width: f64, level: f32) {
    let mut random = Random::part(seed, 8);
    let half = scenario.display.panel.half();
    let at = half.map(|half| half * random.range(-0.5, 0.5));
    let Some(eye) = scenario.shots.first().map(|shot| shot.camera.position) else {
        return;
    };
    let glare = Glare::seen_at(at, eye, width, level);
    scenario
        .shots
        .iter_mut()
        .for_each(|shot| shot.room.glare = Some(glare));
}

fn exif_off(scenario: &mut Scenario, seed: u64) {
    let factor = 1.0 + 0.2 * sign(seed, 9);
    for shot in &mut scenario.shots {
        shot.file.claimed_focal = shot.file.claimed_focal.map(|focal| focal * factor);
    }
}

/// The picture moves by 9 px of a 12 Mpx photo while it is read, and by up to 2 px while a row is exposed.
fn shaken(scenario: &mut Scenario, seed: u64) {
    let mut random = Random::part(seed, 10);
    for shot in &mut scenario.shots {
        let scale = f64::from(shot.camera.width) / 4032.0;
        shot.camera.shake = Shake::new(9.0 * scale, random.bits());
        shot.sensor.smear = [
            random.range(-2.0, 2.0) * scale,
            random.range(-2.0, 2.0) * scale,
        ];
    }
}

/// Messengers shrink pictures, press them hard and take the EXIF data away.
fn messenger(scenario: &mut Scenario, _: u64) {
    for shot in &mut scenario.shots {
        shot.file = File {
            quality: 60,
            claimed_focal: None,
            longest: Some(1600.min(shot.camera.width * 2 / 5)),
        };
    }
}

/// Slits pass less light, so the camera exposes longer.
fn barrier(scenario: &mut Scenario, seed: u64) {
    let open = Random::part(seed, 11).range(0.15, 0.3);
    scenario.display.sheet.kind = Kind::Slits { open };
    scenario
        .shots
        .iter_mut()
        .for_each(|shot| shot.sensor.exposure *= (0.5 / open as f32).max(1.0));
}

#[cfg(test)]
mod tests {
    use super::super::displays;
    use super::*;

    /// The whole panel is in every photo, in every situation, and each seed gives the same situation again.
    #[test]
    fn the_panel_is_in_the_picture() {
        for seed in 0..6 {
            let display = displays::display(seed);
            for (name, _) in ALL {
                let taking = Taking::new(seed);
                let scenario = scenario(name, &display, taking).expect("a listed name");
                assert_eq!(
                    Some(&scenario),
                    super::scenario(name, &display, taking).as_ref()
                );
                assert_eq!(scenario.shots.len(), 3);
                let [x, y] = display.panel.half();
                for shot in &scenario.shots {
                    for corner in [[x, y, 0.0], [-x, y, 0.0], [x, -y, 0.0], [-x, -y, 0.0]] {
                        let at = shot.camera.project(corner).expect("in front of the camera");
                        let inside = at[0]
                            .min(f64::from(shot.camera.width) - at[0])
                            .min(at[1])
                            .min(f64::from(shot.camera.height) - at[1]);
                        assert!(inside > 40.0, "{name} {seed}: {at:?}");
                    }
                }
            }
        }
        assert!(scenario("no such thing", &displays::small(), Taking::new(1)).is_none());
    }
}
