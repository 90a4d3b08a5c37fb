//! Any triangles.
//!
//! Nearly all triangles of a large scene are smaller than a voxel, and such a one is a single piece. A larger one is filled with pieces: straight in the
//! grid of the voxels where that bends little, else in space. What is near the axis or goes far around it is halved before.

use super::display::{Cells, Place};
use super::fragments::{Fragments, collect, packed};
use super::patch::{BENT, Corner, Shape, between, corner, extent, fill, steps, steps_in_space};
use super::{RotatingScreen, Volume, VolumeError};

/// A corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// In display space, inches.
    pub at: [f32; 3],
    /// Red, green and blue, sRGB.
    pub colour: [u8; 3],
}

/// Three of them, in either direction.
pub type Triangle = [Vertex; 3];

/// Triangles whose corners are placed together.
const BLOCK: usize = 64;

impl Volume {
    /// The voxels that triangles go through. What is outside of the sphere is cut off; corners that are no numbers make no triangle.
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
        Shape::Bent | Shape::Cut => draw_in_space(triangle, fragments),
    }
}

#[inline(never)]
fn draw_straight(triangle: &Triangle, places: [Place; 3], fragments: &mut Fragments) {
    let corners = [0, 1, 2].map(|i| {
        let Place { turn, out, down } = places[i];
        corner([turn, out, down], triangle[i].colour)
    });
    let steps = |i: usize, j: usize| steps(places[i], places[j]);
    fan(&corners, steps, fragments, |_, [turn, out, down]| Place {
        turn,
        out,
        down,
    });
}

/// Fills a triangle from the corner across its shortest edge.
#[inline(always)]
fn fan(
    corners: &[Corner; 3],
    steps: impl Fn(usize, usize) -> f32,
    fragments: &mut Fragments,
    place: impl Fn(&Cells, [f32; 3]) -> Place,
) {
    let edges = [steps(1, 2), steps(2, 0), steps(0, 1)];
    let top = match edges {
        [a, b, c] if a <= b && a <= c => 0,
        [_, b, c] if b <= c => 1,
        _ => 2,
    };
    let (left, right) = ((top + 1) % 3, (top + 2) % 3);
    let corners = [corners[top], corners[top], corners[left], corners[right]];
    let sides = edges[left].max(edges[right]);
    fill(&corners, [0.0, edges[top], sides], fragments, place);
}

/// A triangle of any size, anywhere.
pub(super) fn draw_in_space(triangle: &Triangle, fragments: &mut Fragments) {
    let cells = fragments.cells;
    let corners = triangle.map(|v| corner(v.at.map(|part| part * cells.pixels_per_inch), v.colour));
    if corners.iter().flatten().any(|v| !v.is_finite()) {
        return;
    }
    let mut rest = vec![corners];
    while let Some(corners) = rest.pop() {
        if outside(&corners, cells.radius) {
            continue;
        }
        let places = corners.map(|c| cells.place([c[0], c[1], c[2]]));
        let (_, down) = extent(places.map(|p| p.down));
        let on_axis = places.iter().all(|p| p.out < 1.0);
        let turns = arc(cells.half_planes as f32, places.map(|p| p.turn));
        if on_axis && down <= 0.5 {
            around_axis(&corners, turns, fragments);
            continue;
        }
        let (longest, length) = longest(&corners);
        let even = matches!(Shape::of(&cells, places), Shape::Straight(..) | Shape::Bent);
        if !even && (on_axis || turns.1 > BENT || length > 2.0 * cells.radius) {
            let [a, b, c] = longest;
            let middle = between(&a, &b, 0.5);
            rest.push([a, middle, c]);
            rest.push([middle, b, c]);
            continue;
        }
        let steps = |i: usize, j: usize| steps_in_space(&cells, places[i], places[j]);
        fan(&corners, steps, fragments, Cells::place);
    }
}

/// The corners in turn, the longest edge first, and its greatest extent.
fn longest(corners: &[Corner; 3]) -> ([Corner; 3], f32) {
    let [a, b, c] = *corners;
    let length = |[a, b, _]: &[Corner; 3]| {
        let parts = a.iter().zip(b).take(3).map(|(a, b)| (a - b).abs());
        parts.fold(0.0, f32::max)
    };
    let turned = [[a, b, c], [b, c, a], [c, a, b]];
    let turned = turned.map(|corners| (corners, length(&corners)));
    let mut longest = turned[0];
    for other in turned {
        if other.1 > longest.1 {
            longest = other;
        }
    }
    longest
}

/// Whether the box around a triangle is outside of the sphere.
fn outside(corners: &[Corner; 3], radius: f32) -> bool {
    let nearest = [0, 1, 2].map(|i| {
        let (least, length) = extent(corners.map(|corner| corner[i]));
        least.max(-(least + length)).max(0.0)
    });
    nearest.iter().map(|part| part * part).sum::<f32>() > radius * radius * 1.0001
}

/// Where the shortest arc over three directions begins, and how long it is, in sectors.
fn arc(all: f32, mut turns: [f32; 3]) -> (f32, f32) {
    turns.sort_by(f32::total_cmp);
    let [a, b, c] = turns;
    let gaps = [(b, b - a), (c, c - b), (a, a + all - c)];
    let mut widest = gaps[0];
    for gap in gaps {
        if gap.1 > widest.1 {
            widest = gap;
        }
    }
    (widest.0, all - widest.1)
}

/// A small triangle no farther than a pixel from the axis: one piece in each sector that it is in, which is all where the axis goes through it.
fn around_axis(corners: &[Corner; 3], (start, length): (f32, f32), fragments: &mut Fragments) {
    let cells = fragments.cells;
    let mean = |i: usize| corners.iter().map(|corner| corner[i]).sum::<f32>() / 3.0;
    let colour = packed([3, 4, 5].map(|i| (mean(i) + 0.5) as u8));
    let all = cells.half_planes as f32;
    // Corners all around the axis leave no gap of half a turn.
    let length = match length >= all / 2.0 {
        true => all - 1.0,
        false => length,
    };
    let count = (start + length).floor() - start.floor();
    for step in 0..=count as u32 {
        let place = Place {
            turn: start + step as f32,
            out: 0.0,
            down: cells.radius - mean(1),
        };
        fragments.put(place, colour);
    }
}
