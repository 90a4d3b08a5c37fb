//! Triangles and quads, filled with pieces that are no farther apart than a voxel.

use super::display::{Cells, Place, rounded};
use super::fragments::{Fragments, packed};

/// Over at most this many sectors a surface is linear in the grid, to a fifth of a pixel.
pub(super) const LINEAR_SECTORS: f32 = 1.5;

/// Up to this angle, in radians, and this relative change of the distance from the axis, steps in space are even enough.
const NARROW: f32 = 0.25;

/// Pixels from the axis; a nearer point has no useful direction.
const AXIS: f32 = 0.5;

/// Pieces that are computed together.
const LANES: usize = 8;

/// Three coordinates, three channels, and two zeros: loops over eight are vectorised.
pub(super) type Corner = [f32; 8];

#[inline(always)]
pub(super) fn corner([x, y, z]: [f32; 3], colour: [u8; 3]) -> Corner {
    let [r, g, b] = colour;
    [x, y, z, f32::from(r), f32::from(g), f32::from(b), 0.0, 0.0]
}

/// The shape of a surface between some corners in the grid of the voxels.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape<const N: usize> {
    /// Nearly linear in the grid, with all corners within one turn; and its greatest extent in voxels.
    Straight([Place; N], f32),
    /// Linear in space only.
    LinearInSpace,
    /// Too large for even steps, too near to the axis, or no surface at all.
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
            // The surface crosses half plane 0.
            for place in &mut places {
                place.turn += if place.turn < half { 2.0 * half } else { 0.0 };
            }
            turns = extent(places.map(|p| p.turn)).1;
        }
        let (near, out) = extent(places.map(|p| p.out));
        let (_, down) = extent(places.map(|p| p.down));
        // Comparisons with NaN are false.
        let even = near >= AXIS && out <= NARROW * near;
        if !(even && down <= 2.0 * cells.radius) {
            return Shape::Cut;
        }
        if turns <= LINEAR_SECTORS {
            Shape::Straight(places, turns.max(out).max(down))
        } else if turns <= NARROW * cells.sectors_per_radian {
            Shape::LinearInSpace
        } else {
            Shape::Cut
        }
    }
}

/// The least of some numbers, and the range up to the greatest.
#[inline(always)]
pub(super) fn extent<const N: usize>(values: [f32; N]) -> (f32, f32) {
    let (mut least, mut greatest) = (values[0], values[0]);
    for value in values {
        least = if value < least { value } else { least };
        greatest = if value > greatest { value } else { greatest };
    }
    (least, greatest - least)
}

/// Steps of a voxel along a line that is linear in the grid.
#[inline(always)]
pub(super) fn steps(a: Place, b: Place) -> f32 {
    let greater = |a: f32, b: f32| if a > b { a } else { b };
    let (turn, out) = ((a.turn - b.turn).abs(), (a.out - b.out).abs());
    greater(greater(turn, out), (a.down - b.down).abs())
}

/// Steps along a line in space. At distance r from the axis the angle changes by h/r² from pixel to pixel, with h the distance of the
/// line's nearest point. This exceeds the average by no more than the ratio of the ends' distances. The distance changes with the angle as
/// well, and in a slice the line has no gaps.
#[inline(always)]
fn steps_in_space(cells: &Cells, a: Place, b: Place) -> f32 {
    let turn = (a.turn - b.turn).abs();
    let turn = turn.min(cells.half_planes as f32 - turn);
    let out = (a.out - b.out).abs();
    let faster = turn * (out / a.out.min(b.out)).min(1.0);
    (turn + out.max(faster)).max((a.down - b.down).abs())
}

/// Steps along the upper edge, along the lower edge, and along the longer of the other two. Corners are in the order of a picture.
#[inline(always)]
fn edges([a, b, c, d]: &[Place; 4], steps: impl Fn(Place, Place) -> f32) -> [f32; 3] {
    let sides = (steps(*a, *c), steps(*b, *d));
    let longer = if sides.0 > sides.1 { sides.0 } else { sides.1 };
    [steps(*a, *b), steps(*c, *d), longer]
}

/// Adds pieces over a surface that is linear in the grid. Corners are in the order of a picture: left and right above, left and right
/// below.
#[inline(always)]
pub(super) fn fill_straight(corners: &[Corner; 4], places: &[Place; 4], fragments: &mut Fragments) {
    let mut placed = *corners;
    for (corner, place) in placed.iter_mut().zip(places) {
        [corner[0], corner[1], corner[2]] = [place.turn, place.out, place.down];
    }
    let edges = edges(places, steps);
    fill(&placed, edges, fragments, |_, [turn, out, down]| Place {
        turn,
        out,
        down,
    });
}

/// The same for a surface that is linear in space; corners are in pixels.
#[inline(never)]
pub(super) fn fill_in_space(corners: &[Corner; 4], places: &[Place; 4], fragments: &mut Fragments) {
    let cells = fragments.cells;
    let edges = edges(places, |a, b| steps_in_space(&cells, a, b));
    fill(corners, edges, fragments, Cells::place);
}

/// The same for a surface of any size, anywhere.
pub(super) fn fill_anywhere(corners: &[Corner; 4], fragments: &mut Fragments) {
    let cells = fragments.cells;
    if outside(corners, cells.radius) {
        return;
    }
    let [a, b, c, d] = corners;
    let place = |at: &Corner| cells.place([at[0], at[1], at[2]]);
    let places = [place(a), place(b), place(c), place(d)];
    match Shape::of(&cells, places) {
        Shape::Straight(places, _) => return fill_straight(corners, &places, fragments),
        Shape::LinearInSpace => return fill_in_space(corners, &places, fragments),
        Shape::Cut => {}
    }
    let (_, down) = extent(places.map(|p| p.down));
    let on_axis = places.iter().all(|p| p.out < 1.0);
    let turns = arc(cells.half_planes as f32, places.map(|p| p.turn));
    if on_axis && down <= 0.5 {
        return around_axis(corners, turns, fragments);
    }
    let large = places.iter().any(|p| p.out > 2.0 * cells.radius) || down > 2.0 * cells.radius;
    if !(on_axis || large) && turns.1 <= LINEAR_SECTORS {
        // Within a sector or two uneven steps do no harm.
        return fill_in_space(corners, &places, fragments);
    }
    // The height matters only in these cases.
    let high = on_axis || large;
    let length = |a: &Corner, b: &Corner| {
        let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        x * x + z * z + if high { y * y } else { 0.0 }
    };
    let across = length(a, b).max(length(c, d));
    let along = length(a, c).max(length(b, d));
    if across > along {
        let (upper, lower) = (between(a, b, 0.5), between(c, d, 0.5));
        fill_anywhere(&[*a, upper, *c, lower], fragments);
        fill_anywhere(&[upper, *b, lower, *d], fragments);
    } else {
        let (left, right) = (between(a, c, 0.5), between(b, d, 0.5));
        fill_anywhere(&[*a, *b, left, right], fragments);
        fill_anywhere(&[left, right, *c, *d], fragments);
    }
}

/// The same for a triangle.
pub(super) fn fill_triangle(corners: &[Corner; 3], fragments: &mut Fragments) {
    let length = |i: usize, j: usize| {
        let parts = corners[i].iter().zip(&corners[j]).take(3);
        parts.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
    };
    let turned = turned([length(1, 2), length(2, 0), length(0, 1)]);
    let [top, left, right] = turned.map(|i| corners[i]);
    fill_anywhere(&[top, top, left, right], fragments);
}

/// The corners, beginning with the one opposite the shortest edge. An edge has the index of the corner opposite to it.
#[inline(always)]
pub(super) fn turned(edges: [f32; 3]) -> [usize; 3] {
    match edges {
        [a, b, c] if a <= b && a <= c => [0, 1, 2],
        [_, b, c] if b <= c => [1, 2, 0],
        _ => [2, 0, 1],
    }
}

/// Whether the two triangles between corners may lie a sector beside the bilinear surface: near the axis the deviation of the diagonal, up
/// to a quarter of the twist, matters.
pub(super) fn folded(cells: &Cells, [a, b, c, d]: &[Corner; 4]) -> bool {
    let (mut twist, mut near) = (0.0, 0.0);
    for i in [0, 2] {
        let off = d[i] - c[i] - b[i] + a[i];
        let (least, length) = extent([a[i], b[i], c[i], d[i]]);
        let nearest = least.max(-(least + length)).max(0.0);
        twist += off * off;
        near += nearest * nearest;
    }
    let sectors = cells.sectors_per_radian / 4.0;
    twist * sectors * sectors > near
}

/// Whether the bounding box of the corners is outside of the sphere.
fn outside([a, b, c, d]: &[Corner; 4], radius: f32) -> bool {
    let mut far = 0.0;
    for i in 0..3 {
        let (least, length) = extent([a[i], b[i], c[i], d[i]]);
        let nearest = least.max(-(least + length)).max(0.0);
        far += nearest * nearest;
    }
    far > radius * radius * 1.0001
}

/// A small surface no farther than a pixel from the axis: one piece in each of its sectors, which are all where the axis passes through it.
fn around_axis(corners: &[Corner; 4], (start, length): (f32, f32), fragments: &mut Fragments) {
    let cells = fragments.cells;
    let all = cells.half_planes as f32;
    let mean = |i: usize| corners.iter().map(|corner| corner[i]).sum::<f32>() / 4.0;
    let colour = packed([3, 4, 5].map(|i| (mean(i) + 0.5) as u8));
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

/// Start and length of the shortest arc that covers some directions, in sectors.
fn arc(all: f32, mut turns: [f32; 4]) -> (f32, f32) {
    turns.sort_by(f32::total_cmp);
    let [a, b, c, d] = turns;
    let gaps = [(b, b - a), (c, c - b), (d, d - c), (a, a + all - d)];
    let mut widest = gaps[0];
    for gap in gaps {
        if gap.1 > widest.1 {
            widest = gap;
        }
    }
    (widest.0, all - widest.1)
}

/// Adds pieces over the surface between corners. The numbers of steps are for the upper edge, the lower one, and the longer of the others.
#[inline(always)]
fn fill(
    corners: &[Corner; 4],
    [upper, lower, sides]: [f32; 3],
    fragments: &mut Fragments,
    place: impl Fn(&Cells, [f32; 3]) -> Place,
) {
    let rows = count(sides);
    let high = 1.0 / rows as f32;
    let mut points = [[0.0; LANES]; 2];
    let mut pending = 0;
    for row in 0..rows {
        let down = (row as f32 + 0.5) * high;
        let columns = count(upper + (lower - upper) * down);
        let wide = 1.0 / columns as f32;
        for column in 0..columns {
            let [right, below] = &mut points;
            (right[pending], below[pending]) = ((column as f32 + 0.5) * wide, down);
            pending += 1;
            if pending == LANES || column + 1 == columns && row + 1 == rows {
                put(corners, &points, pending, fragments, &place);
                pending = 0;
            }
        }
    }
}

/// Adds pieces at some points, given as fractions of the way to the right and down.
#[inline(always)]
fn put(
    [a, b, c, d]: &[Corner; 4],
    [right, below]: &[[f32; LANES]; 2],
    count: usize,
    fragments: &mut Fragments,
    place: impl Fn(&Cells, [f32; 3]) -> Place,
) {
    let cells = fragments.cells;
    let mut parts = [[0.0; LANES]; 6];
    for (i, parts) in parts.iter_mut().enumerate() {
        let (across, along) = (b[i] - a[i], c[i] - a[i]);
        let twist = d[i] - c[i] - across;
        for ((part, right), below) in parts.iter_mut().zip(right).zip(below) {
            *part = a[i] + across * right + (along + twist * right) * below;
        }
    }
    let [x, y, z, red, green, blue] = &parts;
    let mut places = [Place::default(); LANES];
    for (((place_at, &x), &y), &z) in places.iter_mut().zip(x).zip(y).zip(z) {
        *place_at = place(&cells, [x, y, z]);
    }
    let mut colours = [0; LANES];
    for (((colour, &red), &green), &blue) in colours.iter_mut().zip(red).zip(green).zip(blue) {
        *colour = rounded(red) | rounded(green) << 8 | rounded(blue) << 16;
    }
    fragments.put_all(&places, &colours, count);
}

/// A whole number of steps, none longer than a voxel.
#[inline(always)]
fn count(steps: f32) -> u32 {
    ((steps + 0.999_99) as u32).max(1)
}

#[inline(always)]
fn between(a: &Corner, b: &Corner, share: f32) -> Corner {
    let mut mixed = *a;
    for (a, b) in mixed.iter_mut().zip(b) {
        *a += (b - *a) * share;
    }
    mixed
}
