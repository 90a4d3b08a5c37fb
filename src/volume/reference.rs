//! A reference image of a scene, drawn as the mesh of its samples.
//!
//! Popescu et al., section VI: each sample is joined to its neighbours. The mesh is never stored. A sample is placed in the grid of the
//! voxels once for all its neighbours, and each four samples form a bilinear surface there.

use super::display::{Cells, Place};
use super::fragments::{Fragments, collect, packed};
use super::patch::{
    Shape, corner, fill_anywhere, fill_in_space, fill_straight, fill_triangle, folded,
};
use super::{RotatingScreen, Vertex, Volume, VolumeError};
use std::ops::Range;

/// The neighbours that a sample is joined to, as one surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joined {
    /// Neither the right nor the lower one.
    Neither,
    /// The right one.
    Right,
    /// The lower one.
    Below,
    /// Both.
    Both,
}

impl Joined {
    /// From the two conditions.
    pub fn of(right: bool, below: bool) -> Joined {
        match (right, below) {
            (false, false) => Joined::Neither,
            (true, false) => Joined::Right,
            (false, true) => Joined::Below,
            (true, true) => Joined::Both,
        }
    }

    fn right(self) -> bool {
        matches!(self, Joined::Right | Joined::Both)
    }

    fn below(self) -> bool {
        matches!(self, Joined::Below | Joined::Both)
    }
}

/// The sample of a pixel of a reference image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// In display space, inches.
    pub at: [f32; 3],
    /// Red, green and blue, sRGB.
    pub colour: [u8; 3],
    /// The neighbours that it is joined to.
    pub joined: Joined,
}

/// A picture of the surfaces that a viewer can see, one sample a pixel, from any camera: a depth image or that of an occlusion camera.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceImage {
    pub(super) size: [u32; 2],
    pub(super) samples: Vec<Option<Sample>>,
}

impl ReferenceImage {
    /// `samples` are in rows from the top.
    pub fn new(
        size: [u32; 2],
        samples: Vec<Option<Sample>>,
    ) -> Result<ReferenceImage, VolumeError> {
        let [width, height] = size;
        if samples.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(VolumeError::Samples {
                samples: samples.len(),
                width,
                height,
            });
        }
        Ok(ReferenceImage { size, samples })
    }

    /// Columns and rows.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// In rows from the top.
    pub fn samples(&self) -> &[Option<Sample>] {
        &self.samples
    }

    /// The triangles of the mesh, two for each four samples that are joined all around. [`Volume::of_reference`] draws the same surfaces
    /// faster.
    pub fn triangles(&self) -> Vec<super::Triangle> {
        let width = self.size[0] as usize;
        let rows = self.samples.chunks(width.max(1));
        let pairs = rows.clone().zip(rows.skip(1));
        let quads = pairs.flat_map(|(upper, lower)| {
            (0..width.saturating_sub(1)).filter_map(move |x| quad(upper, lower, x))
        });
        quads
            .flat_map(|[a, b, c, d]| [[a, b, d], [a, d, c]])
            .map(|triangle| {
                triangle.map(|sample| Vertex {
                    at: sample.at,
                    colour: sample.colour,
                })
            })
            .collect()
    }
}

/// A sample and its neighbours to the right, below and across, if the four are joined all around.
#[inline(always)]
fn quad(upper: &[Option<Sample>], lower: &[Option<Sample>], x: usize) -> Option<[Sample; 4]> {
    let corner = |row: &[Option<Sample>], x: usize| row.get(x).copied().flatten();
    let (a, c) = (corner(upper, x)?, corner(lower, x)?);
    if a.joined != Joined::Both || !c.joined.right() {
        return None;
    }
    let (b, d) = (corner(upper, x + 1)?, corner(lower, x + 1)?);
    b.joined.below().then_some([a, b, c, d])
}

impl Volume {
    /// The voxels of the mesh of a reference image, and those of samples without a triangle.
    pub fn of_reference(
        screen: &RotatingScreen,
        image: &ReferenceImage,
    ) -> Result<Volume, VolumeError> {
        screen.check()?;
        let width = image.size[0] as usize;
        let rows: Vec<usize> = (0..image.size[1] as usize).collect();
        Ok(collect(screen, &rows, |rows, fragments| {
            let row = |y: usize| {
                let rest = image.samples.get(y * width..).unwrap_or_default();
                rest.get(..width).unwrap_or_default()
            };
            let (Some(&first), cells) = (rows.first(), fragments.cells) else {
                return;
            };
            let [mut upper, mut lower] = [Row::new(width), Row::new(width)];
            lower.place(&cells, row(first));
            if first > 0 {
                upper.place(&cells, row(first - 1));
                mark(row(first - 1), row(first), &upper, &mut lower);
            }
            for &y in rows {
                std::mem::swap(&mut upper, &mut lower);
                lower.place(&cells, row(y + 1));
                draw_row(row(y), row(y + 1), &mut upper, &mut lower, fragments);
            }
        }))
    }
}

/// One row of samples in the grid of the voxels.
struct Row {
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
    places: Vec<Place>,
    /// Samples that belong to a surface.
    used: Vec<bool>,
    /// From the first sample with a depth to the last one.
    filled: Range<usize>,
}

impl Row {
    fn new(width: usize) -> Row {
        Row {
            x: vec![0.0; width],
            y: vec![0.0; width],
            z: vec![0.0; width],
            places: vec![Place::default(); width],
            used: vec![false; width],
            filled: 0..0,
        }
    }

    fn place(&mut self, cells: &Cells, samples: &[Option<Sample>]) {
        self.used.fill(false);
        let first = samples.iter().position(Option::is_some).unwrap_or(0);
        let end = samples.iter().rposition(Option::is_some);
        self.filled = first..end.map_or(first, |last| last + 1);
        let range = || self.filled.clone();
        let (x, y, z) = (
            &mut self.x[range()],
            &mut self.y[range()],
            &mut self.z[range()],
        );
        let points = x.iter_mut().zip(y.iter_mut()).zip(z.iter_mut());
        for (sample, ((x, y), z)) in samples[range()].iter().zip(points) {
            let at = sample.map_or([0.0; 3], |sample| sample.at);
            [*x, *y, *z] = at.map(|part| part * cells.pixels_per_inch);
        }
        let points = x.iter().zip(y.iter()).zip(z.iter());
        for (place, ((&x, &y), &z)) in self.places[range()].iter_mut().zip(points) {
            *place = cells.place([x, y, z]);
        }
    }
}

/// Marks the samples of two rows that belong to surfaces between the rows.
fn mark(above: &[Option<Sample>], below: &[Option<Sample>], upper: &Row, lower: &mut Row) {
    for x in upper.filled.clone() {
        if quad(above, below, x).is_some() {
            lower.used[x..x + 2].fill(true);
        }
    }
}

/// Draws the surfaces between two rows, and the single samples of the upper one.
fn draw_row(
    above: &[Option<Sample>],
    below: &[Option<Sample>],
    upper: &mut Row,
    lower: &mut Row,
    fragments: &mut Fragments,
) {
    for x in upper.filled.clone() {
        if let Some(samples) = quad(above, below, x) {
            upper.used[x..x + 2].fill(true);
            lower.used[x..x + 2].fill(true);
            let places = [
                upper.places[x],
                upper.places[x + 1],
                lower.places[x],
                lower.places[x + 1],
            ];
            draw_quad(&samples, places, fragments);
        } else if let (false, Some(sample)) = (upper.used[x], above[x]) {
            fragments.put(upper.places[x], packed(sample.colour));
        }
    }
}

#[inline(always)]
fn draw_quad([a, b, c, d]: &[Sample; 4], places: [Place; 4], fragments: &mut Fragments) {
    let cells = fragments.cells;
    let shape = Shape::of(&cells, places);
    let place = |sample: &Sample| {
        let at = sample.at.map(|part| part * cells.pixels_per_inch);
        corner(at, sample.colour)
    };
    let corners = [place(a), place(b), place(c), place(d)];
    match shape {
        Shape::Straight(places, _) => fill_straight(&corners, &places, fragments),
        Shape::LinearInSpace => fill_in_space(&corners, &places, fragments),
        Shape::Cut => {
            if corners.iter().flatten().any(|v| !v.is_finite()) {
                return;
            }
            if folded(&cells, &corners) {
                let [a, b, c, d] = corners;
                fill_triangle(&[a, b, d], fragments);
                fill_triangle(&[a, d, c], fragments);
            } else {
                fill_anywhere(&corners, fragments);
            }
        }
    }
}
