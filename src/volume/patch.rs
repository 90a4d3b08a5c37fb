//! Triangles and quads, filled with pieces that are no farther apart than a voxel.

use super::display::{Cells, Place};
use super::fragments::Fragments;

/// A surface over no more sectors than this is a straight line in them, to a fifth of a pixel.
pub(super) const BENT: f32 = 1.5;

/// Over an angle no wider, in radians, and a distance from the axis that changes by no larger part than this, steps in space are even enough.
const NARROW: f32 = 0.25;

/// Three coordinates, three channels, and two that are 0: loops over eight become vectors.
pub(super) type Corner = [f32; 8];

pub(super) fn corner([x, y, z]: [f32; 3], colour: [u8; 3]) -> Corner {
    let [r, g, b] = colour.map(f32::from);
    [x, y, z, r, g, b, 0.0, 0.0]
}

/// How a surface between some corners lies in the grid of the voxels.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape<const N: usize> {
    /// As good as straight, with all corners within one turn, and its greatest extent in voxels.
    Straight([Place; N], f32),
    /// Straight in space only.
    Bent,
    /// Too large for even steps, too near to the axis, or no surface.
    Cut,
}

impl<const N: usize> Shape<N> {
    /// Over an angle δ a chord is up to r·δ²/8 nearer to the axis than its ends, and the angle of a line at the distance d from the axis is
    /// asin(d/r): to the second order its middle is off by a sixteenth of a sector where r changes by a quarter.
    #[inline(always)]
    pub(super) fn of(cells: &Cells, mut places: [Place; N]) -> Shape<N> {
        let half = cells.half_planes as f32 / 2.0;
        let (_, mut turns) = extent(places.map(|p| p.turn));
        if turns > half {
            // Across half plane 0.
            for place in &mut places {
                place.turn += if place.turn < half { 2.0 * half } else { 0.0 };
            }
            turns = extent(places.map(|p| p.turn)).1;
        }
        let (near, out) = extent(places.map(|p| p.out));
        let (_, down) = extent(places.map(|p| p.down));
        // Comparisons with what is no number are false.
        let even = near >= cells.sectors_per_radian && out <= NARROW * near;
        if !(even && down <= 2.0 * cells.radius) {
            return Shape::Cut;
        }
        if turns <= BENT {
            Shape::Straight(places, turns.max(out).max(down))
        } else if turns <= NARROW * cells.sectors_per_radian {
            Shape::Bent
        } else {
            Shape::Cut
        }
    }
}

/// The least of some numbers, and how far the greatest is from it.
#[inline(always)]
pub(super) fn extent<const N: usize>(values: [f32; N]) -> (f32, f32) {
    let (mut least, mut greatest) = (values[0], values[0]);
    for value in values {
        least = if value < least { value } else { least };
        greatest = if value > greatest { value } else { greatest };
    }
    (least, greatest - least)
}

/// Steps of a voxel along a line that is straight in the grid.
#[inline(always)]
pub(super) fn steps(a: Place, b: Place) -> f32 {
    let greater = |a: f32, b: f32| if a > b { a } else { b };
    let (turn, out) = ((a.turn - b.turn).abs(), (a.out - b.out).abs());
    greater(greater(turn, out), (a.down - b.down).abs())
}

/// Steps along a line in space: the distance from the axis changes with the angle as well.
pub(super) fn steps_in_space(cells: &Cells, a: Place, b: Place) -> f32 {
    let turn = (a.turn - b.turn).abs();
    let turn = turn.min(cells.half_planes as f32 - turn);
    (turn + (a.out - b.out).abs()).max((a.down - b.down).abs())
}

/// Puts pieces over the surface between corners that lie like those of a picture: left and right above, left and right below. `upper`, `lower` and
/// `sides` are the steps along its edges.
#[inline(always)]
pub(super) fn fill(
    [a, b, c, d]: &[Corner; 4],
    [upper, lower, sides]: [f32; 3],
    fragments: &mut Fragments,
    place: impl Fn(&Cells, [f32; 3]) -> Place,
) {
    let cells = fragments.cells;
    let mut put = |at: &Corner| {
        let colour = |i: usize| (at[i] + 0.5) as u32;
        let colour = colour(3) | colour(4) << 8 | colour(5) << 16;
        fragments.put(place(&cells, [at[0], at[1], at[2]]), colour);
    };
    let rows = count(sides);
    for row in 0..rows {
        let v = (row as f32 + 0.5) / rows as f32;
        let columns = count(upper + (lower - upper) * v);
        let (left, right) = (between(a, c, v), between(b, d, v));
        if columns == 1 {
            put(&between(&left, &right, 0.5));
            continue;
        }
        for column in 0..columns {
            put(&between(
                &left,
                &right,
                (column as f32 + 0.5) / columns as f32,
            ));
        }
    }
}

/// Whole steps, none longer than a voxel.
#[inline(always)]
fn count(steps: f32) -> u32 {
    ((steps + 0.999_99) as u32).max(1)
}

#[inline(always)]
pub(super) fn between(a: &Corner, b: &Corner, share: f32) -> Corner {
    let mut mixed = *a;
    for (a, b) in mixed.iter_mut().zip(b) {
        *a += (b - *a) * share;
    }
    mixed
}
