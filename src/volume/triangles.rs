//! Volumes of arbitrary triangles.
//!
//! Nearly all triangles of a large scene are smaller than a voxel, and are a single piece. A larger triangle is filled with pieces: linearly in the
//! grid of the voxels where it is nearly linear there, else in space. Triangles near the axis, or that go far around it, are halved before.

use super::display::Place;
use super::fragments::{Fragments, collect};
use super::patch::{Shape, corner, fill_straight, fill_triangle, steps, turned};
use super::{RotatingScreen, Volume, VolumeError};

/// A corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// In display space, inches.
    pub at: [f32; 3],
    /// Red, green and blue, sRGB.
    pub colour: [u8; 3],
}

/// Three corners, in either order.
pub type Triangle = [Vertex; 3];

/// Triangles whose corners are placed together.
const BLOCK: usize = 64;

impl Volume {
    /// The voxels that triangles go through. Parts outside of the sphere are cut off; a triangle with a NaN is left out.
    pub fn of_triangles(
        screen: &RotatingScreen,
        triangles: &[Triangle],
    ) -> Result<Volume, VolumeError> {
        screen.check()?;
        Ok(collect(screen, triangles, |triangles, fragments| {
            for block in triangles.chunks(BLOCK) {
                draw_block(block, fragments);
            }
        }))
    }
}

fn draw_block(triangles: &[Triangle], fragments: &mut Fragments) {
    let cells = fragments.cells;
    let mut points = [[[0.0_f32; BLOCK]; 3]; 3];
    for (at, triangle) in triangles.iter().enumerate() {
        for (points, corner) in points.iter_mut().zip(triangle) {
            for (points, part) in points.iter_mut().zip(corner.at) {
                if let Some(point) = points.get_mut(at) {
                    *point = part * cells.pixels_per_inch;
                }
            }
        }
    }
    let mut places = [[Place::default(); BLOCK]; 3];
    for (places, [x, y, z]) in places.iter_mut().zip(&points) {
        for (((place, &x), &y), &z) in places.iter_mut().zip(x).zip(y).zip(z) {
            *place = cells.place([x, y, z]);
        }
    }
    let [first, second, third] = &places;
    let places = first.iter().zip(second).zip(third);
    for (triangle, ((&a, &b), &c)) in triangles.iter().zip(places) {
        draw(triangle, [a, b, c], fragments);
    }
}

/// A triangle whose corners are at these places.
#[inline(always)]
fn draw(triangle: &Triangle, places: [Place; 3], fragments: &mut Fragments) {
    match Shape::of(&fragments.cells, places) {
        Shape::Straight([a, b, c], spans) if spans <= 1.0 => {
            let middle = Place {
                turn: (a.turn + b.turn + c.turn) / 3.0,
                out: (a.out + b.out + c.out) / 3.0,
                down: (a.down + b.down + c.down) / 3.0,
            };
            let mean = |i: usize| {
                let sum = triangle.iter().map(|v| u32::from(v.colour[i]));
                sum.sum::<u32>() / 3
            };
            fragments.put(middle, mean(0) | mean(1) << 8 | mean(2) << 16);
        }
        Shape::Straight(places, _) => draw_straight(triangle, places, fragments),
        Shape::LinearInSpace | Shape::Cut => draw_in_space(triangle, fragments),
    }
}

#[inline(never)]
fn draw_straight(triangle: &Triangle, places: [Place; 3], fragments: &mut Fragments) {
    let [a, b, c] = places;
    let [top, left, right] = turned([steps(b, c), steps(c, a), steps(a, b)]);
    let corners = [top, top, left, right].map(|i| corner([0.0; 3], triangle[i].colour));
    let places = [places[top], places[top], places[left], places[right]];
    fill_straight(&corners, &places, fragments);
}

#[inline(never)]
fn draw_in_space(triangle: &Triangle, fragments: &mut Fragments) {
    let cells = fragments.cells;
    let [a, b, c] = triangle;
    let place = |v: &Vertex| corner(v.at.map(|part| part * cells.pixels_per_inch), v.colour);
    let corners = [place(a), place(b), place(c)];
    if corners.iter().flatten().all(|v| v.is_finite()) {
        fill_triangle(&corners, fragments);
    }
}
