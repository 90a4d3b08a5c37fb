//! Sizes and places of the scenes.

use super::*;
use crate::synthesis::{Distortions, Pinhole, Reference};

/// Triangles of each scene.
const COUNTS: [(&str, usize); 7] = [
    ("knot", 320_000),
    ("statues", 4_620_800),
    ("coils", 10_248_200),
    ("bars", 114_772),
    ("portal", 87_456),
    ("crowd", 256_600),
    ("temple", 366_252),
];

fn length(at: [f32; 3]) -> f32 {
    at.iter().map(|part| part * part).sum::<f32>().sqrt()
}

#[test]
fn scenes_have_their_triangles_and_lie_in_the_display() {
    assert_eq!(MODELS.len(), COUNTS.len());
    for (model, (name, count)) in MODELS.iter().zip(COUNTS) {
        let surfaces = (model.surfaces)();
        assert_eq!(model.name, name);
        assert_eq!(surfaces.iter().map(Surface::count).sum::<usize>(), count);
        let (mut seen, mut farthest) = (0, 0.0_f32);
        for corner in triangles(&surfaces).inspect(|_| seen += 1).flatten() {
            assert!(corner.at.iter().all(|part| part.is_finite()), "{name}");
            farthest = farthest.max(length(corner.at));
        }
        assert_eq!(seen, count, "{name}");
        assert!((4.5..=RADIUS).contains(&farthest), "{name}: {farthest}");
    }
}

#[test]
fn scenes_are_the_same_every_time() {
    for model in MODELS {
        // The two large ones take seconds, and are made of the same parts.
        if !["statues", "coils"].contains(&model.name) {
            assert_eq!((model.surfaces)(), (model.surfaces)(), "{}", model.name);
        }
    }
}

#[test]
fn what_a_picture_has_seen_lies_on_the_scene() {
    let ball: Vec<Surface> = surface::ball(24, |at| (at.map(|part| part * 3.0), [1.0; 3]));
    let size = [90, 60];
    let camera = Pinhole::through(size, 5.0, [0.0, 0.0, 50.0]);
    let mut picture = Reference::new(size);
    let seen = triangles(&ball).filter_map(|solid| project(&camera, &solid));
    picture.draw(seen, &Distortions::none(size), f64::INFINITY);
    let solids = picture
        .mesh(1e-3)
        .filter_map(|triangle| unproject(&camera, &triangle));
    let corners: Vec<Corner> = solids.flatten().collect();
    assert!(corners.len() > 3 * 600, "{}", corners.len());
    for corner in corners {
        // Of a silhouette sample's square the corners are half a pixel, 0.1 inches, beside it, and go on along the surface, which falls by up to
        // the root of 2 · 3 · 0.2 inches over the last pixel: half of that.
        let length = length(corner.at);
        assert!((2.85..=3.2).contains(&length), "{corner:?}");
        assert!(corner.at[2] > -0.55, "{corner:?}");
    }
}

#[test]
fn a_ball_has_no_gaps() {
    // Each edge of a closed surface belongs to two triangles.
    let surfaces = surface::ball(4, |at| (at, [1.0; 3]));
    let mut edges = std::collections::HashMap::new();
    for [a, b, c] in triangles(&surfaces) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let mut ends = [from, to].map(|corner| corner.at.map(|v| (v * 1e4).round() as i32));
            ends.sort_unstable();
            *edges.entry(ends).or_insert(0) += 1;
        }
    }
    assert_eq!(edges.len(), 6 * 16 * 3);
    assert!(edges.values().all(|&count| count == 2));
}
