//! What slices cost from the whole geometry and from a reference image of it, how far these are apart, and how both look.
#![forbid(unsafe_code)]

mod support;

use manyview::volume::{Difference, RotatingScreen, Sight, Slices, Triangle, Volume};
use std::time::Instant;
use support::surfaces::{depth_image, statue, statues};
use support::target_folder;

const SCREEN: RotatingScreen = RotatingScreen::POPESCU;

/// Of the paper's reference images.
const SIZE: [u32; 2] = [720, 480];

/// Inches along z up to which samples are of one surface.
const STEP: f32 = 0.3;

/// A name, what makes the scene, of how many triangles, and by how much the reference image has to be faster.
type Scene = (&'static str, fn(u32) -> Vec<Triangle>, u32, f64);

/// The sizes of Table 1; nothing is asked of the smallest, whose image is finer than itself.
const SCENES: [Scene; 3] = [
    ("statue-small", statue, 321_000, 0.0),
    ("statues", statues, 4_603_000, 8.5),
    ("statue", statue, 10_252_000, 20.0),
];

const ROUNDS: usize = 9;

/// Milliseconds of both ways to lit voxels, medians of rounds in turns, and the voxels.
fn measured(ways: [&dyn Fn() -> Volume; 2]) -> [(f64, Volume); 2] {
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..ROUNDS {
        for (way, times) in ways.iter().zip(&mut times) {
            let start = Instant::now();
            std::hint::black_box(way().dithered());
            times.push(start.elapsed().as_secs_f64() * 1e3);
        }
    }
    [0, 1].map(|way| {
        times[way].sort_by(f64::total_cmp);
        (times[way][ROUNDS / 2], ways[way]())
    })
}

/// What is seen from the front, 4 inches to the left, and from the side.
fn look(slices: &Slices, name: &str) {
    let folder = target_folder().with_file_name("volume");
    std::fs::create_dir_all(&folder).expect("a folder");
    let places = [
        ("front", [0.0, 0.0, 50.0]),
        ("left", [-4.0, 0.0, 50.0]),
        ("side", [-50.0, 0.0, 0.0]),
    ];
    for (place, eye) in places {
        let sight = Sight {
            eye,
            sphere: true,
            ..Sight::of_viewer(&SCREEN)
        };
        let seen = sight.see(slices).expect("outside of the display");
        let file = folder.join(format!("{name}-{place}.png"));
        seen.save(file).expect("saved");
    }
}

fn percent(part: usize, whole: usize) -> f64 {
    100.0 * part as f64 / whole.max(1) as f64
}

/// Its pictures are in `target/volume`.
#[test]
#[ignore = "takes a minute and gigabytes"]
fn cost_of_slices() {
    println!(
        "| scene | triangles | quads | geometry, ms | voxels | reference, ms | voxels | times as fast | missing | lost | wrong | colour |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
    for (name, scene, triangles, least) in SCENES {
        let triangles = scene(triangles);
        let image = depth_image(&SCREEN, &triangles, SIZE, STEP);
        let [(geometry, whole), (reference, seen)] = measured([
            &|| Volume::of_triangles(&SCREEN, &triangles).expect("a display"),
            &|| Volume::of_reference(&SCREEN, &image).expect("a display"),
        ]);
        let viewer = [0.0, 0.0, SCREEN.viewer];
        let off = Difference::between(&whole, &seen, &[viewer]).expect("an eye outside");
        let ratio = geometry / reference;
        println!(
            "| {name} | {} | {} | {geometry:.0} | {} | {reference:.1} | {} | {ratio:.1} | {:.1} % | {:.2} % | {:.2} % | {:.2} |",
            triangles.len(),
            image.triangles().len() / 2,
            whole.len(),
            seen.len(),
            percent(off.missing, off.seen),
            percent(off.lost, off.seen),
            percent(off.wrong, off.drawn),
            off.colour,
        );
        look(&whole.dithered(), &format!("{name}-geometry"));
        look(&seen.dithered(), &format!("{name}-reference"));
        assert!(ratio >= least, "{name}: {ratio}");
        assert!(percent(off.lost, off.seen) < 3.0, "{name}: {off:?}");
        assert!(percent(off.wrong, off.drawn) < 2.0, "{name}: {off:?}");
    }
}
