//! Scenes of many plain parts.

use super::noise::{bumps, hash};
use super::surface::{Surface, ball, cuboid, fitted, ring};
use std::f32::consts::TAU;

/// Squares of two colours.
fn checkers(u: f32, v: f32, [a, b]: [[f32; 3]; 2]) -> [f32; 3] {
    match (u.floor() + v.floor()).rem_euclid(2.0) < 1.0 {
        true => a,
        false => b,
    }
}

/// A plain rectangle with checkers a quarter of an inch wide, at z.
fn checkered([left, bottom, right, top]: [f32; 4], z: f32, colours: [[f32; 3]; 2]) -> Surface {
    let cells = |length: f32| (length / 0.025).round() as usize;
    Surface::new(cells(right - left), cells(top - bottom), |u, v| {
        let at = [left + (right - left) * u, bottom + (top - bottom) * v, z];
        (
            at,
            checkers(at[0] * 4.0 + 1e-3, at[1] * 4.0 + 1e-3, colours),
        )
    })
}

/// Seven bars before a wall, 4 inches apart.
pub(super) fn bars() -> Vec<Surface> {
    let wall = checkered(
        [-3.2, -2.8, 3.2, 2.8],
        -2.2,
        [[0.9, 0.9, 0.86], [0.25, 0.3, 0.5]],
    );
    let mut all = vec![wall];
    for number in 0..7 {
        let x = 0.82 * (number as f32 - 3.0);
        let z = 1.9 + 0.12 * (number % 3) as f32;
        let colour = [0.85, 0.3 + 0.07 * number as f32, 0.25];
        all.extend(cuboid([x - 0.2, -2.4, z - 0.2], [x + 0.2, 2.4, z], colour));
    }
    fitted(all)
}

/// A wall with a square window, and behind it a floor that rises row by row with seats on it, a stage and side walls.
pub(super) fn portal() -> Vec<Surface> {
    const STONE: [f32; 3] = [0.62, 0.6, 0.64];
    const SEAT: [f32; 3] = [0.75, 0.2, 0.22];
    const WOOD: [f32; 3] = [0.66, 0.48, 0.3];
    // The wall: four boxes around the window.
    let (inner, outer, front, back) = (1.6, 2.9, 2.3, 2.1);
    let mut all = Vec::new();
    all.extend(cuboid([-outer, inner, back], [outer, outer, front], STONE));
    all.extend(cuboid(
        [-outer, -outer, back],
        [outer, -inner, front],
        STONE,
    ));
    all.extend(cuboid(
        [-outer, -inner, back],
        [-inner, inner, front],
        STONE,
    ));
    all.extend(cuboid([inner, -inner, back], [outer, inner, front], STONE));
    // The room.
    let (side, low, high, end) = (2.7, -2.4, 2.5, -3.0);
    all.push(checkered(
        [-side, low, side, high],
        end,
        [[0.8, 0.76, 0.6], [0.6, 0.55, 0.42]],
    ));
    all.extend(cuboid(
        [-side - 0.1, low, end],
        [-side, high, back],
        [0.5, 0.56, 0.66],
    ));
    all.extend(cuboid(
        [side, low, end],
        [side + 0.1, high, back],
        [0.5, 0.56, 0.66],
    ));
    all.extend(cuboid(
        [-side, high, end],
        [side, high + 0.1, back],
        [0.7, 0.7, 0.7],
    ));
    let rows = 9;
    for row in 0..rows {
        let z = back - 0.4 - 0.5 * row as f32;
        let floor = low + 0.28 * row as f32;
        all.extend(cuboid([-side, low - 0.1, z - 0.5], [side, floor, z], WOOD));
        for seat in 0..12 {
            let x = -side + 0.2 + 0.43 * seat as f32;
            let shade = 0.75 + 0.25 * hash([row, seat, 0]);
            let colour = SEAT.map(|part| part * shade);
            all.extend(cuboid(
                [x, floor, z - 0.35],
                [x + 0.32, floor + 0.14, z - 0.05],
                colour,
            ));
            all.extend(cuboid(
                [x, floor, z - 0.42],
                [x + 0.32, floor + 0.42, z - 0.35],
                colour,
            ));
        }
    }
    fitted(all)
}

/// Small things at random places.
pub(super) fn crowd() -> Vec<Surface> {
    let mut all = Vec::new();
    for number in 0..150 {
        let random = |what| hash([number, what, 77]);
        // Evenly in a ball.
        let (turn, height) = (random(0) * TAU, 2.0 * random(1) - 1.0);
        let far = 4.4 * random(2).cbrt();
        let flat = (1.0 - height * height).sqrt() * far;
        let place = [flat * turn.cos(), height * far, flat * turn.sin()];
        let colour = [3, 4, 5].map(|what| 0.3 + 0.65 * random(what));
        let radius = 0.2 + 0.25 * random(6);
        let (sin, cos) = (random(7) * TAU).sin_cos();
        let parts = match number % 3 {
            0 => ball(16, |direction| {
                let rough = 1.0 + 0.1 * bumps(direction.map(|v| v * 3.0), 2);
                (direction.map(|v| v * radius * rough), colour)
            }),
            1 => vec![ring(
                [16, 64],
                [0.0, 0.0, 1.0],
                |t| {
                    let (sin, cos) = (t * TAU).sin_cos();
                    [radius * cos, radius * sin, 0.0]
                },
                |_, _, _| (radius * 0.25, colour),
            )],
            _ => cuboid([-radius; 3], [radius * 0.6, radius, radius * 0.4], colour),
        };
        all.extend(parts.into_iter().map(|part| {
            part.moved(|[x, y, z]| {
                let ([x, z], y) = ([x * cos + z * sin, z * cos - x * sin], y);
                let (y, z) = (y * cos - z * sin, z * cos + y * sin);
                [place[0] + x, place[1] + y, place[2] + z]
            })
        }));
    }
    fitted(all)
}
