//! The panel of docs/gallery.md with a wrong description, and two photos of it.

use super::QUALITY;
use super::camera::{Sheet, expose};
use super::random::Random;
use super::scene::{PANEL, Scene};
use crate::support;
use manyview::calibrate::{Setup, pattern};
use std::fs;

/// The owner's assumption about the pitch: 0.4 % off, as sheets vary in production.
const PITCH: f64 = 8.0;
const SLANT: f64 = 0.66;

fn description(name: &str, pitch: f64, slant: f64, offset: f64) -> String {
    format!(
        "name = \"{name}\"\nkind = \"slanted\"\nviews = 8\npitch = {pitch}\nslant = {slant}\noffset = {offset}\ninverted = true\n"
    )
}

/// Writes `described.toml`, `true.toml`, `front.jpg` and `side.jpg` for scripts/gallery.sh.
#[test]
#[ignore = "`make gallery` runs it"]
fn gallery_photos() {
    let folder = support::scratch("gallery");
    let mut random = Random(8);
    let mut scene = Scene::random(&mut random);
    scene.sheet = Sheet {
        views: 8,
        pitch: 8.032,
        slant: 0.667,
        offset: 2.4,
        cone: 30.0,
        ..scene.sheet
    };
    let setup = Setup::new(PANEL.0, PANEL.1, scene.sheet.views, PITCH, SLANT);
    let shown = pattern(&setup).expect("a pattern");
    for (name, shot) in ["front.jpg", "side.jpg"].iter().zip(&scene.shots) {
        let exposure = expose(&scene.sheet, &shown, shot, &mut random);
        let photo = exposure.jpeg(20.0, QUALITY, &mut random);
        fs::write(folder.join(name), photo).expect("written");
    }
    let sheet = &scene.sheet;
    // The phase of the photos counts from the middle of subpixels, like that of displays.
    let truth = description("true", sheet.pitch, sheet.slant, sheet.offset);
    fs::write(folder.join("true.toml"), truth).expect("written");
    fs::write(
        folder.join("described.toml"),
        description("described", PITCH, SLANT, 0.0),
    )
    .expect("written");
}
