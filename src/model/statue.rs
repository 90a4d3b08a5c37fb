//! Closed, bumpy surfaces with parts before other parts.

use super::noise::bumps;
use super::surface::{Surface, ball, fitted, ring, tube};
use std::f32::consts::{PI, TAU};

const CLAY: [f32; 3] = [0.86, 0.66, 0.46];
const JADE: [f32; 3] = [0.45, 0.78, 0.6];
const BRASS: [f32; 3] = [0.9, 0.74, 0.34];
const IVORY: [f32; 3] = [0.93, 0.89, 0.8];

/// Directions.
const X: [f32; 3] = [1.0, 0.0, 0.0];
const Y: [f32; 3] = [0.0, 1.0, 0.0];
const Z: [f32; 3] = [0.0, 0.0, 1.0];

/// With darker and lighter places.
fn stained(colour: [f32; 3], at: [f32; 3]) -> [f32; 3] {
    let shade = 0.86 + 0.14 * bumps(at.map(|v| v * 3.0), 2);
    colour.map(|part| part * shade)
}

/// A bumpy tube that runs before itself three times: 2 · 320 · 500 triangles.
pub(super) fn knot() -> Vec<Surface> {
    let path = |t: f32| {
        let [once, twice, thrice] = [1.0, 2.0, 3.0].map(|times| f32::sin_cos(t * times * TAU));
        [
            once.0 + 2.0 * twice.0,
            once.1 - 2.0 * twice.1,
            -1.6 * thrice.0,
        ]
    };
    fitted(vec![ring([320, 500], Z, path, |angle, t, middle| {
        // The same at both ends of the turn.
        let at = [middle[0] + angle.cos(), middle[1] + angle.sin(), middle[2]];
        let rough = 0.06 * bumps(at.map(|v| v * 3.0), 4) + 0.05 * (40.0 * t * TAU / 4.0).sin();
        (0.62 + rough, stained(CLAY, at))
    })])
}

/// A standing figure with its feet at y = −3, about 6 inches high. The numbers of cells grow with `fine`.
fn figure(fine: usize, colour: [f32; 3], phase: f32) -> Vec<Surface> {
    let robe = tube(
        [6 * fine, 6 * fine],
        Z,
        |t| [0.12 * (t * TAU + phase).sin(), -3.0 + 5.0 * t, 0.0],
        |angle, t, middle| {
            let shape = 0.95 - 0.5 * t + 0.12 * (t * 9.0 + phase).sin();
            let folds = 0.09 * (11.0 * angle + 3.0 * (t * 5.0 + phase).sin()).sin();
            let rough = 0.03 * bumps([angle.cos() * 3.0, angle.sin() * 3.0, t * 14.0], 3);
            (
                shape * (1.0 + folds) + rough,
                stained(colour, [middle[0], t * 5.0, angle]),
            )
        },
    );
    let head = ball(fine, |direction| {
        let radius = 0.5 + 0.05 * bumps(direction.map(|v| v * 5.0), 4);
        let [x, y, z] = direction.map(|v| v * radius);
        ([x, y * 1.2 + 2.35, z + 0.08], stained(colour, direction))
    });
    // Both arms reach before the robe, and come together.
    let arm = |side: f32| {
        tube(
            [2 * fine, 4 * fine],
            X,
            move |t| {
                let bend = (t * PI).sin();
                [
                    side * (0.55 + 0.75 * bend - 0.35 * t),
                    1.4 - 1.5 * bend + 0.5 * t,
                    0.1 + 1.35 * t + 0.3 * bend,
                ]
            },
            move |angle, t, middle| {
                let folds = 0.03 * (9.0 * t * TAU + angle).sin();
                (0.24 - 0.1 * t + folds, stained(colour, middle))
            },
        )
    };
    let foot = ball(fine, |direction| {
        let [x, y, z] = direction;
        let at = [1.35 * x, -3.1 + 0.3 * y, 1.35 * z];
        (at, stained(IVORY, at))
    });
    let mut parts = head;
    parts.extend(foot);
    parts.extend([robe, arm(-1.0), arm(1.0)]);
    parts
}

/// Four figures of 128 · 95² triangles each, the nearer ones before the others.
pub(super) fn four() -> Vec<Surface> {
    const PLACES: [([f32; 3], f32, f32); 4] = [
        ([-2.7, 0.1, -1.4], 0.35, 0.0),
        ([-1.0, -0.3, 1.6], -0.3, 1.3),
        ([1.0, 0.3, -1.5], 0.1, 2.6),
        ([2.6, -0.2, 1.4], -0.3, 3.9),
    ];
    let mut all = Vec::new();
    for (place, turn, phase) in PLACES {
        let (sin, cos): (f32, f32) = f32::sin_cos(turn);
        all.extend(figure(95, JADE, phase).into_iter().map(|part| {
            part.moved(|[x, y, z]| {
                [
                    place[0] + x * cos + z * sin,
                    place[1] + y,
                    place[2] + z * cos - x * sin,
                ]
            })
        }));
    }
    fitted(all)
}

/// A fluted column within three coils and sixteen tusks.
pub(super) fn coils() -> Vec<Surface> {
    let column = tube(
        [1450, 1450],
        Z,
        |t| [0.0, -4.2 + 8.4 * t, 0.0],
        |angle, t, _| {
            let flutes = 0.13 * (14.0 * angle + 6.0 * (t * 7.0).sin()).sin();
            let rings = 0.12 * (t * 60.0).sin();
            let rough = 0.05 * bumps([angle.cos() * 5.0, angle.sin() * 5.0, t * 30.0], 4);
            let at = [angle.cos() * 2.0, t * 8.0, angle.sin() * 2.0];
            (
                0.95 + 0.3 * (t * 5.0).cos() + flutes + rings + rough,
                stained(IVORY, at),
            )
        },
    );
    let coil = |phase: f32| {
        tube(
            [200, 2860],
            Y,
            move |t| {
                let (sin, cos) = (phase + t * 3.5 * TAU).sin_cos();
                let radius = 2.0 + 0.25 * (t * 20.0).sin();
                [radius * cos, -3.8 + 7.6 * t, radius * sin]
            },
            |angle, t, middle| {
                let beads = 0.03 * (t * 400.0).sin() * (3.0 * angle).cos();
                (0.13 + beads, stained(BRASS, middle))
            },
        )
    };
    let tusk = |number: f32| {
        tube(
            [160, 510],
            Y,
            move |t| {
                let (sin, cos) = (number * 2.4).sin_cos();
                let radius = 0.8 + 2.4 * t;
                let y = -3.2 + 0.4 * number + 0.9 * t * t;
                [radius * cos, y, radius * sin]
            },
            |angle, t, middle| {
                let rough = 0.01 * (30.0 * t + angle).sin();
                (0.17 * (1.05 - t) + rough, stained(CLAY, middle))
            },
        )
    };
    let mut all = vec![column];
    all.extend([0.0, 1.0, 2.0].map(|third| coil(third * TAU / 3.0)));
    all.extend((0..16).map(|number| tusk(number as f32)));
    fitted(all)
}
