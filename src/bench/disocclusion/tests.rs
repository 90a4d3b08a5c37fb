//! Missing samples of scenes where their number can be computed.

use super::*;
use crate::model::MODELS;

/// A small picture, to keep the tests fast.
const EXPERIMENT: Experiment = Experiment { size: [180, 120] };

/// A rectangle in the plane z.
fn rectangle([left, bottom, right, top]: [f32; 4], z: f32, colour: [f32; 3]) -> Surface {
    Surface::new(1, 1, |u, v| {
        let at = [left + (right - left) * u, bottom + (top - bottom) * v, z];
        (at, colour)
    })
}

/// A column 2 inches before the middle of the display, and a wall 3 behind it.
fn column() -> Vec<Surface> {
    vec![
        rectangle([-6.0, -4.0, 6.0, 4.0], -3.0, [0.2, 0.5, 0.9]),
        rectangle([-1.0, -4.5, 1.0, 4.5], 2.0, [0.9, 0.4, 0.2]),
    ]
}

fn frame(scene: &[Surface], image: &Reference, offset: [f64; 3]) -> Frame {
    let truth = EXPERIMENT.draw(&EXPERIMENT.camera(offset), scene);
    let seen = EXPERIMENT.seen(image, offset);
    Frame::of(&EXPERIMENT, &truth, &seen).expect("pixels")
}

#[test]
fn nothing_is_missing_at_the_reference_viewpoint() {
    let scene = column();
    let images = EXPERIMENT.images(&scene);
    let own = frame(&scene, &images.all[0], [0.0; 3]);
    assert!(own.samples > 4000);
    assert_eq!((own.count(), own.displaced), (0, 0));
    assert!(own.all.is_equal() && own.holes_percent == 0.0);
    assert_eq!(frame(&scene, &images.all[1], [0.0; 3]).count(), 0);
}

#[test]
fn a_depth_image_lacks_what_the_column_has_hidden() {
    let scene = column();
    let [depth_image, reference, finer] = EXPERIMENT.images(&scene).all;
    for right in [-4.0, 4.0] {
        let depth = frame(&scene, &depth_image, [right, 0.0, 0.0]);
        // The column moves by 4·(2/48) to one side in the window, the wall by 4·(3/53) to the other: the strip between, as high as the
        // wall is in the window, and a pixel narrower on all sides where its ends may be a pixel off.
        let strip = 10.5 * 4.0 * (2.0 / 48.0 + 3.0 / 53.0);
        let height = 10.5 * 8.0 * 50.0 / 53.0;
        let expected = (strip - 2.0) * height;
        let count = depth.count() as f64;
        assert!(
            (count - expected).abs() <= 1.5 * height,
            "{count} of {expected}"
        );
        // All missing samples are holes, except for the two pixel columns at the sides.
        assert!(depth.holes_percent * depth.samples as f64 / 100.0 >= count);
        for reference in [&reference, &finer] {
            let occlusion = frame(&scene, reference, [right, 0.0, 0.0]);
            assert!(
                occlusion.count() * 20 <= depth.count(),
                "{}",
                occlusion.count()
            );
            assert!(occlusion.all.psnr > depth.all.psnr + 3.0);
        }
    }
}

#[test]
fn a_sample_may_be_a_pixel_off_and_not_two() {
    let size = [6, 1];
    let truth = [0.0, 0.2, 0.2, 0.2, 0.0, 0.0];
    let off = |by: usize| -> usize {
        let mut frame = [0.0; 6];
        frame[1 + by..4 + by].fill(0.2);
        missing(size, &truth, &frame, 0.01)
            .iter()
            .filter(|m| **m)
            .count()
    };
    assert_eq!([off(0), off(1), off(2)], [0, 0, 1]);
    // A sample of another depth does not count.
    assert_eq!(
        missing(size, &truth, &[0.25; 6], 0.01)
            .iter()
            .filter(|m| **m)
            .count(),
        3
    );
}

#[test]
fn a_disparity_leaves_out_nothing_but_holes() {
    let all: Vec<f64> = (0..=100).rev().map(f64::from).collect();
    let disparity = Disparity::of(all);
    let expected = Disparity {
        median: 50.0,
        most: 95.0,
        worst: 100.0,
        over_percent: 10_000.0 / 101.0,
    };
    assert_eq!(disparity, expected);
    // Where the frame lacks the column it shows the wall, whose depth differs far more than a sample's may.
    let scene = column();
    let wall = EXPERIMENT.draw(&EXPERIMENT.camera([0.0; 3]), &scene[..1]);
    let frame = frame(&scene, &wall, [0.0; 3]);
    assert_eq!(frame.disparity.median, 0.0);
    let parts = EXPERIMENT.parallax() * (1.0 / 48.0 - 1.0 / 53.0);
    assert!((frame.disparity.worst - parts).abs() < 1e-2, "{parts}");
    let holes = frame.holes_percent * frame.samples as f64 / 100.0;
    let column = frame.displaced as f64 - holes;
    let shown = frame.samples as f64 - holes;
    assert!(column > 0.1 * shown, "{column} of {shown}");
    assert!((frame.disparity.over_percent - 100.0 * column / shown).abs() < 1e-9);
}

#[test]
fn the_truth_aside_parts_at_silhouettes_alone() {
    let scene = column();
    let camera = EXPERIMENT.camera([0.0; 3]);
    let truth = EXPERIMENT.draw(&camera, &scene);
    let aside = EXPERIMENT.draw_aside(&camera, &scene);
    let frame = Frame::of(&EXPERIMENT, &truth, &aside).expect("pixels");
    assert_eq!((frame.count(), frame.disparity.median), (0, 0.0));
    // The column's left side goes from 79.06 to 79.56, past the middle of a pixel, in all rows that the wall has; its right side from 100.94
    // to 101.44, past none.
    let off = frame.disparity.over_percent * frame.samples as f64 / 100.0;
    let rows = 10.5 * 8.0 * 50.0 / 53.0;
    assert!((off - rows).abs() <= 2.0, "{off} of {rows} rows");
}

#[test]
fn viewpoints_lie_on_the_edges_of_the_cube() {
    let all = viewpoints();
    assert_eq!(all.len(), 48);
    for at in &all {
        assert_eq!(
            at.iter().filter(|part| part.abs() == HALF).count(),
            2,
            "{at:?}"
        );
        assert!(at.iter().all(|part| part.abs() <= HALF));
    }
    let mut sorted: Vec<_> = all.iter().map(|at| at.map(|part| part as i32)).collect();
    sorted.sort_unstable();
    sorted.dedup();
    assert_eq!(sorted.len(), 48);
}

#[test]
fn a_small_run_is_told_twice_the_same() {
    let model = MODELS
        .iter()
        .find(|model| model.name == "bars")
        .expect("bars");
    let told = || {
        let scene = (model.surfaces)();
        let images = EXPERIMENT.images(&scene);
        let at = [4.0, -4.0, 1.0];
        let aside = EXPERIMENT.draw_aside(&EXPERIMENT.camera(at), &scene);
        let truth = EXPERIMENT.draw(&EXPERIMENT.camera(at), &scene);
        let made = images.all.iter().map(|image| EXPERIMENT.seen(image, at));
        let frames = made.chain([aside]).enumerate().map(|(image, seen)| {
            let frame = Frame::of(&EXPERIMENT, &truth, &seen).expect("pixels");
            View::new(model.name, at, image, &frame)
        });
        let views: Vec<View> = frames.collect();
        let mut row = Scene::new(model.name, 7, &EXPERIMENT, &images, &views);
        row.single_ms = 1.0;
        for (made, ms) in row.references.iter_mut().zip([2.5, 4.25]) {
            made.construction_ms = ms;
        }
        let outcome = Outcome {
            date: String::new(),
            command: Vec::new(),
            preset: "popescu-table1",
            scenes: vec![row],
            views,
        };
        let sheet = sheet(&EXPERIMENT, &scene, &images, &outcome.views).expect("pictures");
        (text(&outcome), sheet)
    };
    let (text, sheet) = told();
    assert_eq!(told(), (text.clone(), sheet.clone()));
    assert_eq!(sheet.dimensions(), (7 * 180, 120));
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 7, "{text}");
    assert!(lines[6].contains("truth, aside"), "{text}");
    assert!(lines[0].starts_with("means of 1 viewpoints"), "{text}");
    assert!(lines[3].contains("(4, -4, 1)"), "{text}");
    for (line, times) in lines[4..].iter().zip(["2.50", "4.25"]) {
        assert!(line.ends_with(times) && line.contains(" 4.5 "), "{text}");
    }
}
