//! A scene that is kept apart: no rule and no number of the synthesis was chosen on it.

use super::noise::bumps;
use super::surface::{Surface, ball, cuboid, fitted, tube};

const MARBLE: [f32; 3] = [0.88, 0.86, 0.8];
const STEP: [f32; 3] = [0.66, 0.62, 0.56];
const BRONZE: [f32; 3] = [0.45, 0.62, 0.5];

/// A fluted column of 2 · 96 · 120 triangles on the floor at y = −2.2, tapering upwards.
fn column([x, z]: [f32; 2]) -> Vec<Surface> {
    let shaft = tube(
        [96, 120],
        [0.0, 0.0, 1.0],
        |t| [x, -2.15 + 4.0 * t, z],
        |angle, t, _| {
            let flutes = 0.02 * (16.0 * angle).sin();
            (0.3 - 0.06 * t + flutes, MARBLE)
        },
    );
    let slab = |low: f32, high: f32| {
        cuboid(
            [x - 0.38, low, z - 0.38],
            [x + 0.38, high, z + 0.38],
            MARBLE,
        )
    };
    let mut all = slab(-2.2, -2.05);
    all.extend(slab(1.75, 1.9));
    all.push(shaft);
    all
}

/// Fourteen columns around a bronze on a pedestal, on three steps and below a roof of beams, turned and seen from a little above.
pub(super) fn temple() -> Vec<Surface> {
    let mut all = Vec::new();
    for number in 0..4 {
        let x = 1.7 * (number as f32 - 1.5);
        all.extend([-2.4, 2.4].into_iter().flat_map(|z| column([x, z])));
    }
    for z in [-0.8, 0.8] {
        all.extend([-2.55, 2.55].into_iter().flat_map(|x| column([x, z])));
    }
    all.extend([-0.85, 0.85].into_iter().flat_map(|x| column([x, -1.0])));
    for step in 0..3 {
        let [out, top] = [0.25 * step as f32, -2.2 - 0.25 * step as f32];
        all.extend(cuboid(
            [-3.1 - out, top - 0.25, -2.95 - out],
            [3.1 + out, top, 2.95 + out],
            STEP,
        ));
    }
    for z in [-2.4, 2.4] {
        all.extend(cuboid([-3.0, 1.9, z - 0.35], [3.0, 2.35, z + 0.35], STEP));
    }
    for number in 0..7 {
        let x = 0.95 * (number as f32 - 3.0);
        all.extend(cuboid([x - 0.13, 2.35, -2.8], [x + 0.13, 2.6, 2.8], MARBLE));
    }
    all.extend(cuboid([-0.5, -2.2, -0.3], [0.5, -1.3, 0.7], STEP));
    all.extend(ball(60, |direction| {
        let radius = 0.8 + 0.25 * bumps(direction.map(|v| v * 2.5), 4);
        let [x, y, z] = direction.map(|v| v * radius);
        ([x, y - 0.6, z + 0.2], BRONZE)
    }));
    let (sin, cos): (f32, f32) = 0.4_f32.sin_cos();
    let (fall, level): (f32, f32) = 0.25_f32.sin_cos();
    let turned = all.into_iter().map(|part| {
        part.moved(|[x, y, z]| {
            let [x, z] = [x * cos + z * sin, z * cos - x * sin];
            [x, y * level - z * fall, z * level + y * fall]
        })
    });
    fitted(turned.collect())
}
