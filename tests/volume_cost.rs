//! The cost of slices from the whole geometry and from reference images of it, how far the two are apart, and how they look.

use crate::support::{geometry, target_folder};
use manyview::bench::disocclusion::Experiment;
use manyview::model::MODELS;
use manyview::volume::{Difference, ReferenceImage, RotatingScreen, Sight, Slices, Volume};
use std::time::Instant;

const SCREEN: RotatingScreen = RotatingScreen::POPESCU;

/// The picture size of the paper.
const EXPERIMENT: Experiment = Experiment { size: [720, 480] };

/// A model, the speed-up that its reference image has to reach, and the per cent of the viewer's pixels that may be lost. The smallest
/// model has no speed-up to reach: its image is finer than itself. A reference image loses half a pixel around silhouettes and surfaces
/// that are seen edge-on, which costs most where things are thin.
const SCENES: [(&str, f64, f64); 3] = [
    ("knot", 0.0, 1.5),
    ("statues", 8.5, 4.5),
    ("coils", 20.0, 7.5),
];

/// Corners of the cube of viewpoints, inches.
const HALF: f64 = 4.0;

/// Largest part of the pixels that may be wrong, %. Samples of distorted rays are farther apart than pixels, and a point interpolated
/// between two of them may lie beside the surface.
const WRONG: f64 = 1.0;

const ROUNDS: usize = 15;

/// Milliseconds from each source to lit voxels (medians of rounds in turns), and the volumes.
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

/// Writes the pictures that are seen from the front, from 4 inches to the left, and from the side.
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

/// The pictures are in `target/volume`.
#[test]
#[ignore = "takes minutes and gigabytes"]
fn cost_of_slices() {
    println!(
        "| model | image | triangles | quads | geometry, ms | voxels | image, ms | voxels | times as fast | construction, ms | missing | lost | wrong | colour | lost from the cube |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    let viewer = [0.0, 0.0, SCREEN.viewer];
    let signs = [-HALF, HALF];
    let cube: Vec<[f64; 3]> = (0..8)
        .map(|at| {
            [
                signs[at & 1],
                signs[at >> 1 & 1],
                SCREEN.viewer + signs[at >> 2],
            ]
        })
        .collect();
    let mut missed = Vec::new();
    for (name, least, most) in SCENES {
        let model = MODELS.iter().find(|model| model.name == name);
        let scene = (model.expect("a model").surfaces)();
        let images = EXPERIMENT.images(&scene);
        let triangles = geometry(&scene);
        drop(scene);
        let camera = EXPERIMENT.camera([0.0; 3]);
        let built = [images.single, images.single + images.construction[0]];
        let kinds = ["depth", "reference"].iter().zip(&images.all).zip(built);
        for ((kind, image), built) in kinds {
            let image = ReferenceImage::of(image, &camera, EXPERIMENT.tolerance());
            let [(slow, whole), (fast, seen)] = measured([
                &|| Volume::of_triangles(&SCREEN, &triangles).expect("a display"),
                &|| Volume::of_reference(&SCREEN, &image).expect("a display"),
            ]);
            let apart =
                |eyes: &[_]| Difference::between(&whole, &seen, eyes).expect("eyes outside");
            let (off, beside) = (apart(&[viewer]), apart(&cube));
            let ratio = slow / fast;
            println!(
                "| {name} | {kind} | {} | {} | {slow:.0} | {} | {fast:.1} | {} | {ratio:.1} | {:.0} | {:.1} % | {:.2} % | {:.2} % | {:.2} | {:.2} % |",
                triangles.len(),
                image.triangles().len() / 2,
                whole.len(),
                seen.len(),
                built.as_secs_f64() * 1e3,
                percent(off.missing, off.seen),
                percent(off.lost, off.seen),
                percent(off.wrong, off.drawn),
                off.colour,
                percent(beside.lost, beside.seen),
            );
            look(&whole.dithered(), &format!("{name}-geometry"));
            look(&seen.dithered(), &format!("{name}-{kind}"));
            let lost = percent(off.lost, off.seen);
            let wrong = percent(off.wrong, off.drawn);
            let slow = *kind == "reference" && ratio < least;
            if slow || lost >= most || wrong >= WRONG {
                missed.push(format!("{name}, {kind}: {ratio:.1} times, {off:?}"));
            }
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}
