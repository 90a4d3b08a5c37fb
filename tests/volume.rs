//! `manyview volume` from its user's side, and slices of a reference image against those of the geometry.

use crate::support::{demo, geometry, manyview, refused, rgb, run, succeed};
use image::RgbImage;
use manyview::bench::disocclusion::Experiment;
use manyview::model::MODELS;
use manyview::volume::{
    Difference, ReferenceImage, RotatingScreen, Slices, Triangle, Vertex, Volume,
};
use std::ffi::OsString;
use std::fs;
use tempfile::tempdir;

const SMALL: RotatingScreen = RotatingScreen {
    slices: 30,
    pixels: 96,
    ..RotatingScreen::POPESCU
};

/// A folder with a stack: a white square to the right of the middle, at a right angle to the viewer's direction.
fn stack_of_a_square() -> tempfile::TempDir {
    let folder = tempdir().expect("a folder");
    let corner = |x: f32, y: f32| Vertex {
        at: [x, y, 0.5],
        colour: [255; 3],
    };
    let square: [Triangle; 2] = [
        [corner(1.0, -1.0), corner(3.0, -1.0), corner(3.0, 1.0)],
        [corner(1.0, -1.0), corner(3.0, 1.0), corner(1.0, 1.0)],
    ];
    let slices = Volume::of_triangles(&SMALL, &square)
        .expect("a display")
        .dithered();
    slices.write(&folder.path().join("stack")).expect("written");
    folder
}

#[test]
fn an_eye_sees_a_stack() {
    let folder = stack_of_a_square();
    let simulate = |rest: &[&str]| {
        let (code, stdout, stderr) = run(manyview()
            .current_dir(&folder)
            .args(["volume", "simulate", "stack", "--out", "seen.png"])
            .args(rest));
        assert_eq!((code, stdout.as_str()), (0, ""), "{stderr}");
        assert_eq!(stderr, "manyview: wrote seen.png\n");
        let seen = image::open(folder.path().join("seen.png"));
        seen.expect("a picture").into_rgb8()
    };
    let lit = |picture: &image::RgbImage, x, y| picture.get_pixel(x, y).0[0] > 60;
    let seen = simulate(&[]);
    assert_eq!(seen.dimensions(), (720, 480));
    // An inch has some 46 pixels.
    assert!(lit(&seen, 452, 240) && !lit(&seen, 268, 240) && !lit(&seen, 452, 340));
    assert_eq!(simulate(&["--eye", "0,0,50in"]), seen, "the viewer");
    let behind = simulate(&["--eye", "0, 0, -50"]);
    assert!(lit(&behind, 268, 240) && !lit(&behind, 452, 240));
    let small = simulate(&["--size", "96x96", "--sphere"]);
    assert_eq!(small.dimensions(), (96, 96));
    assert!(small.get_pixel(48, 2).0[0] > 0, "the sphere's top");
}

#[test]
fn what_cannot_be_simulated_is_one_line_and_status_2() {
    let folder = stack_of_a_square();
    let place = |name: &str| {
        let path = folder.path().join(name);
        path.to_str().expect("UTF-8").to_owned()
    };
    let (stack, out) = (place("stack"), place("seen.png"));
    let with = |stack: &str, rest: &[&str], part: &str| {
        let arguments = ["volume", "simulate", stack, "--out", &out];
        refused(&[&arguments, rest].concat(), 2, part);
    };
    for eye in ["", "left", "0,50", "0,0,nan", "0,0,0,50"] {
        with(&stack, &["--eye", eye], "such as -4,0,50");
    }
    with(&stack, &["--eye", "0,0,5"], "give a place at least 5.25 in");
    with(&stack, &["--size", "720"], "such as 720x480");
    with(&place("none"), &[], "display.toml: No such file");
    with(&place(""), &[], "name a folder that slices were written to");
    fs::remove_file(place("stack/slice-007.png")).expect("removed");
    with(&stack, &[], "slice-007.png: No such file");
    let nowhere = [
        "volume",
        "simulate",
        &stack,
        "--out",
        "no-such-folder/a.png",
    ];
    refused(&nowhere, 2, "there is no folder");
    assert!(!fs::exists(&out).expect("known"), "nothing is written");
}

#[test]
fn a_reference_image_has_what_its_viewer_sees() {
    let screen = RotatingScreen::POPESCU;
    let experiment = Experiment { size: [720, 480] };
    let scene = (MODELS[0].surfaces)();
    let camera = experiment.camera([0.0; 3]);
    let drawn = experiment.draw(&camera, &scene);
    let image = ReferenceImage::of(&drawn, &camera, experiment.step());
    let triangles = geometry(&scene);
    let whole = Volume::of_triangles(&screen, &triangles).expect("a display");
    let seen = Volume::of_reference(&screen, &image).expect("a display");
    assert!(seen.len() * 2 < whole.len(), "much is hidden");
    let at = |eye| Difference::between(&whole, &seen, &[eye]).expect("an eye outside");
    let front = at([0.0, 0.0, screen.viewer]);
    assert!(front.lost * 50 < front.seen, "{front:?}");
    assert!(
        front.wrong * 50 < front.drawn && front.colour < 5.0,
        "{front:?}"
    );
    let side = at([screen.viewer, 0.0, 0.0]);
    assert!(
        side.lost * 3 > side.seen,
        "it is not for other places: {side:?}"
    );
}

/// The sixth frame of a demo as slices, and what eyes at these places see of them, 960x640.
fn sliced(demonstration: &[&str], of: &str, eyes: &[&str]) -> Vec<RgbImage> {
    let folder = tempdir().expect("a folder");
    let stack = folder.path().join("stack");
    let mut command = manyview();
    command.args(["volume", "slice", "--frame", "6", "--of", of, "--out"]);
    command.arg(&stack).arg("--").args(started(demonstration));
    let said = succeed(command.env_remove("DISPLAY"));
    let said = String::from_utf8(said.stderr).expect("text");
    assert!(said.contains("wrote 198 slices to "), "{said}");
    let slices = Slices::read(&stack).expect("a stack");
    assert_eq!(*slices.screen(), RotatingScreen::POPESCU);
    let seen = eyes.iter().map(|eye| {
        let out = folder.path().join("seen.png");
        let mut command = manyview();
        command.args(["volume", "simulate", "--size", "960x640", "--eye", eye]);
        succeed(command.arg(&stack).arg("--out").arg(&out));
        rgb(&out)
    });
    seen.collect()
}

/// The command that starts a demo without a screen.
fn started(demonstration: &[&str]) -> Vec<OsString> {
    let (name, arguments) = demonstration.split_first().expect("a demo");
    let mut command = vec![demo(name).into_os_string()];
    let more = [
        "--api",
        "egl",
        "--surface",
        "pbuffer",
        "--size",
        "400x300",
        "--frames",
        "7",
    ];
    command.extend(arguments.iter().chain(&more).map(OsString::from));
    command
}

/// The sum of a square of pixels around one, by channel.
fn around(picture: &RgbImage, [x, y]: [u32; 2], reach: u32) -> [u32; 3] {
    let mut sum = [0; 3];
    for y in y.saturating_sub(reach)..(y + reach + 1).min(picture.height()) {
        for x in x.saturating_sub(reach)..(x + reach + 1).min(picture.width()) {
            let pixel = picture.get_pixel(x, y).0;
            sum = [0, 1, 2].map(|i| sum[i] + u32::from(pixel[i]));
        }
    }
    sum
}

fn brightest(sum: [u32; 3]) -> usize {
    (0..3).max_by_key(|&i| sum[i]).unwrap_or(0)
}

#[test]
fn the_viewer_sees_the_programs_own_picture() {
    let gears = ["gears"];
    let seen = &sliced(&gears, "reference", &["0,0,50"])[0];
    let folder = tempdir().expect("a folder");
    let out = folder.path().join("own.png");
    let mut command = manyview();
    command.args(["capture", "--frame", "6", "--views", "1", "--out"]);
    command.arg(&out).arg("--").args(started(&gears));
    succeed(command.env_remove("DISPLAY"));
    let own = rgb(&out);
    // Pixels per inch at the middle of the display: of the simulated picture, whose sphere takes 0.96 of the height, and of the program's
    // picture, whose corners touch the sphere 2.5 inches farther back.
    let simulated = 0.96 * 320.0 * (2500.0_f64 - 25.0).sqrt() / 5.0 / 50.0;
    let program = 250.0 / (18.75_f64.sqrt() * 50.0 / 52.5);
    let at = |x: u32, y: u32| {
        let from = [(x, 200.0, 480.0), (y, 150.0, 320.0)];
        from.map(|(v, own, seen)| (seen + (f64::from(v) + 0.5 - own) * simulated / program) as u32)
    };
    let (mut drawn, mut dark, mut other, mut empty, mut lit) = (0, 0, 0, 0, 0);
    for y in 4..296 {
        for x in 4..396 {
            let pixels = (y - 3..=y + 3).flat_map(|y| (x - 3..=x + 3).map(move |x| (x, y)));
            let covered = pixels.filter(|&(x, y)| own.get_pixel(x, y).0 != own.get_pixel(0, 0).0);
            // A voxel is about a pixel of these pictures; edges may reach two pixels farther.
            match covered.count() {
                49 => {
                    let light = around(seen, at(x, y), 2);
                    drawn += 1;
                    dark += u32::from(light == [0; 3]);
                    let wanted = brightest(around(&own, [x, y], 2));
                    other += u32::from(brightest(light) != wanted);
                }
                0 => {
                    empty += 1;
                    lit += u32::from(around(seen, at(x, y), 0) != [0; 3]);
                }
                _ => {}
            }
        }
    }
    println!("{drawn} drawn, {dark} dark, {other} of another colour; {empty} empty, {lit} lit");
    assert!(drawn > 5000 && empty > 50_000, "{drawn} {empty}");
    assert!(dark * 200 < drawn, "{dark} of {drawn} are dark");
    assert!(other * 50 < drawn, "{other} of {drawn} have another colour");
    assert!(lit * 1000 < empty, "{lit} of {empty} are lit");
}

#[test]
fn what_is_hidden_from_the_program_is_there_for_eyes_beside_the_viewer() {
    let gaps = ["hard", "--case", "gaps"];
    let eyes = ["-4,0,50", "4,0,50"];
    // Squares of the wall, which fills the picture, in which no voxel is lit.
    let holes = |of: &str| {
        let seen = sliced(&gaps, of, &eyes);
        let dark = |seen: &RgbImage| {
            let all = (190..450)
                .step_by(5)
                .flat_map(|y| (300..660).step_by(5).map(move |x| [x, y]));
            all.filter(|at| around(seen, *at, 2) == [0; 3]).count()
        };
        seen.iter().map(dark).sum::<usize>()
    };
    let [own, reference] = ["own", "reference"].map(holes);
    println!("dark: {own} of the own view, {reference} of the reference image");
    assert!(own > 300, "{own}");
    assert!(reference * 5 < own, "{reference} of {own}");
}

#[test]
fn what_cannot_be_sliced_is_one_line_and_status_2() {
    let folder = tempdir().expect("a folder");
    let out = folder.path().join("stack");
    let out = out.to_str().expect("UTF-8");
    let with = |rest: &[&str], part: &str| {
        let arguments = ["volume", "slice", "--out", out];
        refused(&[&arguments, rest, &["--", "true"]].concat(), 2, part);
    };
    with(&["--strategy", "replay"], "give occlusion or leave it out");
    with(&["--frame", "3..5"], "give one frame such as 30");
    with(&["--frame", "1"], "a frame from 2 on");
    with(&["--views", "0"], "--views");
    let into = |folder: &str, part: &str| {
        refused(&["volume", "slice", "--out", folder, "--", "true"], 2, part);
    };
    into("src", "which is no part of a stack");
    into("no-such-folder/stack", "is not there");
    // A program whose frames have no depth.
    let mut command = manyview();
    command.args(["volume", "slice", "--frame", "4", "--out", out, "--"]);
    let (code, _, said) = run(command.args(started(&["prims"])).env_remove("DISPLAY"));
    println!("{said}");
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("nothing to make slices of"), "{said}");
    assert!(!fs::exists(out).expect("known"), "nothing is written");
}
