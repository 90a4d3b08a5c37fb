//! Points as surfaces, `--splats surface`: each point is a disk that closes the gap to its neighbours.
//!
//! A program's points are wherever its shaders put them, so their places are written down while they are drawn for the first time, in clip space; they are drawn as the
//! program draws them then. Distances between them stay when the camera moves. From time to time the places are written down again: where the distances of some have
//! changed, the cloud is another one.

use super::Layer;
use super::draw::Draw;
use crate::fixed::SURFACE_BINDING;
use crate::gl::{BindingPoint, BoundRange, BufferName, Gl, ProgramName, consts as c};
use crate::plan::camera;
use crate::points::neighbours::{COVER, Neighbour, Tree};
use glam::Vec3;

/// Fewer points are no surface.
const FEWEST: u32 = 64;
/// More are drawn as they are: their places would take 32 bytes each.
const MOST: u32 = 1 << 22;
/// Draws from one check of the distances to the next.
const CHECKED: u32 = 60;
/// Points whose distances are compared, and the change of a distance that is none.
const SAMPLES: usize = 256;
const SAME: std::ops::Range<f32> = 0.8..1.25;
/// A point far from all others is not larger than this, over the median of all.
const LARGEST: f32 = 3.0;
/// Clouds that are kept.
const CLOUDS: usize = 256;
const POINT: BindingPoint = BindingPoint {
    target: c::SHADER_STORAGE_BUFFER,
    index: SURFACE_BINDING,
};
/// Bytes of an element of the storage block.
const ELEMENT: usize = 16;

/// The clouds of one context.
#[derive(Debug, Default)]
pub(super) struct Surfaces {
    clouds: Vec<Cloud>,
    /// The part of a frame that is being drawn, and the number of clouds in it.
    part: (u64, u32),
    drawn: u32,
}

/// A draw of points: the same one in each frame has the same number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Key {
    program: ProgramName,
    count: u32,
    number: u32,
}

/// The points of a draw.
#[derive(Debug)]
struct Cloud {
    key: Key,
    buffer: BufferName,
    /// Some points and what gives them their size; none before they are measured.
    samples: Option<Vec<(usize, Neighbour)>>,
    /// Draws since the distances were compared.
    since: u32,
}

/// What a draw of a surface needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    at: usize,
    measures: bool,
    /// Of the projection: lengths of its rows x and y.
    scale: [f32; 2],
    /// See [`crate::fixed::surface_size`].
    pub(super) uniform: [f32; 4],
}

impl Surfaces {
    /// Hands the buffers over, for deletion.
    pub(super) fn take_buffers(&mut self) -> impl Iterator<Item = BufferName> + '_ {
        self.clouds.drain(..).map(|cloud| cloud.buffer)
    }
}

impl Layer {
    /// The surface that a draw of points to layers belongs to; none where its points are drawn as they are.
    pub(super) fn surface_of(&mut self, gl: &Gl, draw: &Draw) -> Option<Surface> {
        let count = u32::try_from(draw.drawing.vertices).unwrap_or(u32::MAX);
        let wanted = self.session.config.surfaces
            && draw.drawing.counted
            && (FEWEST..=MOST).contains(&count);
        if !wanted || self.state.has.compatibility && gl.is_enabled(c::POINT_SPRITE) {
            return None;
        }
        let program = self.state.in_use.program;
        let taken = |program| gl.storage_bindings(program).contains(&SURFACE_BINDING);
        if draw.plan.variant && taken(program) {
            // A storage block of the program's is bound where the sizes would be.
            return None;
        }
        let projection = match draw.plan.variant {
            true => self.variants.own.projections(program)?[1],
            false => camera::equivalent(&self.state.matrices.projection)?,
        };
        let scale = [projection[0], projection[5]];
        let part = (self.diagnostics.report.frames(), self.known.frame.clears);
        let surfaces = &mut self.points.surfaces;
        if std::mem::replace(&mut surfaces.part, part) != part {
            surfaces.drawn = 0;
        }
        let key = Key {
            program,
            count,
            number: surfaces.drawn,
        };
        surfaces.drawn += 1;
        let at = surfaces.find(gl, key);
        let cloud = surfaces.clouds.get_mut(at)?;
        let known = cloud.samples.is_some();
        let measures = !known || cloud.since >= CHECKED;
        cloud.since = if measures { 0 } else { cloud.since + 1 };
        let width = self.state.rectangles.viewport[2] as f32;
        let size = self.size_of_points(gl, draw.plan.variant);
        Some(Surface {
            at,
            measures,
            scale,
            uniform: [
                if known { scale[0] * width } else { 0.0 },
                f32::from(u8::from(measures)),
                size,
                count as f32,
            ],
        })
    }

    /// The size that a draw gives all its points; 0 where each vertex has its own.
    pub(super) fn size_of_points(&self, gl: &Gl, variant: bool) -> f32 {
        match variant && gl.is_enabled(c::PROGRAM_POINT_SIZE) {
            true => 0.0,
            false => gl.get_floats::<1>(c::POINT_SIZE)[0],
        }
    }

    /// Makes a draw of a surface.
    pub(super) fn draw_surface(
        &mut self,
        gl: &Gl,
        surface: &Surface,
        draw: impl FnOnce(&mut Layer),
    ) {
        let Some(cloud) = self.points.surfaces.clouds.get(surface.at) else {
            return draw(self);
        };
        let buffer = cloud.buffer;
        let before = gl.bound_range(POINT);
        let bound = gl.get_integer(c::SHADER_STORAGE_BUFFER_BINDING) as u32;
        gl.bind_range(POINT, &BoundRange::whole(buffer));
        let written = [c::PROGRAM_POINT_SIZE, c::POINT_SPRITE];
        let there = if self.state.has.compatibility { 2 } else { 1 };
        let enabled: Vec<u32> = written[..there]
            .iter()
            .copied()
            .filter(|&cap| !gl.is_enabled(cap))
            .collect();
        enabled.iter().for_each(|&cap| gl.enable(cap));
        draw(self);
        enabled.iter().for_each(|&cap| gl.disable(cap));
        if surface.measures {
            gl.finish_writes_to_buffers();
            gl.bind_buffer(c::SHADER_STORAGE_BUFFER, buffer);
            if let Some(cloud) = self.points.surfaces.clouds.get_mut(surface.at) {
                cloud.measure(gl, surface.scale);
            }
        }
        gl.bind_range(POINT, &before);
        gl.bind_buffer(c::SHADER_STORAGE_BUFFER, BufferName(bound));
    }
}

impl Surfaces {
    /// The place of a cloud among those that are kept; a new one has room for its points.
    fn find(&mut self, gl: &Gl, key: Key) -> usize {
        if let Some(at) = self.clouds.iter().position(|cloud| cloud.key == key) {
            return at;
        }
        if self.clouds.len() >= CLOUDS {
            gl.delete_buffer(self.clouds.remove(0).buffer);
        }
        let target = c::SHADER_STORAGE_BUFFER;
        let before = BufferName(gl.get_integer(c::SHADER_STORAGE_BUFFER_BINDING) as u32);
        let buffer = gl.gen_buffer();
        gl.bind_buffer(target, buffer);
        gl.buffer_data_for_shaders(target, 2 * key.count as usize * ELEMENT);
        gl.bind_buffer(target, before);
        self.clouds.push(Cloud {
            key,
            buffer,
            samples: None,
            since: 0,
        });
        self.clouds.len() - 1
    }
}

impl Cloud {
    /// Reads the places that the draw has written, and gives the points their sizes where these are not known or no longer right. The buffer is bound.
    fn measure(&mut self, gl: &Gl, [across, up]: [f32; 2]) {
        let target = c::SHADER_STORAGE_BUFFER;
        let count = self.key.count as usize;
        let mut floats = vec![0.0_f32; 4 * count];
        gl.get_buffer_floats(target, count * ELEMENT, &mut floats);
        // From clip space to that of the eye, but for what the picture lies aside of the axis, which changes distances little.
        let place = |p: &[f32]| Vec3::new(p[0] / across, p[1] / up, p[3]);
        let places: Vec<Vec3> = floats.chunks_exact(4).map(place).collect();
        if self
            .samples
            .as_ref()
            .is_some_and(|samples| are_same(samples, &places))
        {
            return;
        }
        let found = neighbours(&places);
        let most = LARGEST * median(&found);
        let radius =
            |found: &Option<Neighbour>| found.map_or(0.0, |n| n.distance.min(most) * COVER / 2.0);
        let sizes: Vec<[f32; 4]> = found.iter().map(|n| [radius(n), 0.0, 0.0, 0.0]).collect();
        gl.buffer_sub_data(target, 0, bytemuck::cast_slice(&sizes));
        let step = (count / SAMPLES).max(1);
        let some = found.iter().enumerate().step_by(step);
        self.samples = Some(some.filter_map(|(at, n)| Some((at, (*n)?))).collect());
    }
}

/// Whether most of some points are as far from their neighbours as they were.
fn are_same(samples: &[(usize, Neighbour)], places: &[Vec3]) -> bool {
    let same = |(at, neighbour): &&(usize, Neighbour)| {
        let ends = [Some(at), Some(&(neighbour.number as usize))];
        let [from, to] = ends.map(|at| at.and_then(|&at| places.get(at)));
        from.zip(to)
            .is_some_and(|(from, to)| SAME.contains(&(from.distance(*to) / neighbour.distance)))
    };
    2 * samples.iter().filter(same).count() >= samples.len()
}

/// The median of the distances.
fn median(found: &[Option<Neighbour>]) -> f32 {
    let mut distances: Vec<f32> = found.iter().flatten().map(|n| n.distance).collect();
    let middle = distances.len() / 2;
    match distances.is_empty() {
        true => 0.0,
        false => *distances.select_nth_unstable_by(middle, f32::total_cmp).1,
    }
}

/// What gives each point its size. On this thread: a program may allow no others.
fn neighbours(places: &[Vec3]) -> Vec<Option<Neighbour>> {
    let tree = Tree::new(places);
    let numbered = (0..).zip(places);
    numbered
        .map(|(number, &place)| tree.sizing(number, place))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square grid of points whose sides are `side`.
    fn grid(side: f32) -> Vec<Vec3> {
        let at = |i: u16| Vec3::new(f32::from(i % 40), f32::from(i / 40), 5.0) * side;
        (0..1600).map(at).collect()
    }

    #[test]
    fn points_of_a_grid_reach_across_its_cells() {
        let places = grid(0.5);
        let found = neighbours(&places);
        // The sixth nearest point of one inside is across a cell.
        let inside = found[20 * 40 + 20].expect("a neighbour");
        assert!((inside.distance - 0.5 * 2.0_f32.sqrt()).abs() < 1e-6);
        let corner = found[0].expect("a neighbour");
        assert!(corner.distance >= inside.distance);
    }

    #[test]
    fn a_cloud_that_moves_is_the_same_and_one_that_grows_is_not() {
        let places = grid(0.5);
        let found = neighbours(&places);
        let samples: Vec<_> = found
            .iter()
            .enumerate()
            .filter_map(|(at, n)| Some((at, (*n)?)))
            .collect();
        let moved: Vec<_> = places.iter().map(|place| *place + Vec3::X).collect();
        assert!(are_same(&samples, &places) && are_same(&samples, &moved));
        assert!(!are_same(&samples, &grid(0.8)) && !are_same(&samples, &[]));
    }
}
