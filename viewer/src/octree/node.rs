//! A node: a cube.

use crate::vertex::Vertex;
use glam::Vec3;

/// The number of a node.
pub type Id = u32;

/// Cells of an inner node along each axis; each holds one point.
pub const CELLS: u32 = 40;
const WORDS: usize = (CELLS * CELLS * CELLS).div_ceil(u64::BITS) as usize;
/// Of the cells of an inner node.
pub(super) const CELL_BYTES: u64 = WORDS as u64 * 8;

/// Points in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// In bytes.
    pub(super) start: u64,
    pub(super) points: u32,
}

/// A cube and its points.
#[derive(Debug)]
pub struct Node {
    /// Its middle, in the tree's space.
    pub centre: Vec3,
    /// Half of its side.
    pub half: f32,
    /// Points, in memory and in the file.
    pub count: u32,
    /// Changes whenever points are added or taken.
    pub version: u32,
    pub(super) parent: Option<Id>,
    pub(super) children: [Option<Id>; 8],
    /// Points in memory.
    pub(super) points: Vec<Vertex>,
    /// Points in the file.
    pub(super) pieces: Vec<Piece>,
    /// Which cells are taken; a leaf has none, nor has a finished tree.
    pub(super) cells: Option<Box<[u64]>>,
    is_leaf: bool,
}

impl Node {
    pub(super) fn new(centre: Vec3, half: f32) -> Self {
        Self {
            centre,
            half,
            count: 0,
            version: 0,
            parent: None,
            children: [None; 8],
            points: Vec::new(),
            pieces: Vec::new(),
            cells: None,
            is_leaf: true,
        }
    }

    /// Whether it has no nodes below.
    #[must_use]
    pub fn is_leaf(&self) -> bool {
        self.is_leaf
    }

    /// Distance of neighbouring points where nothing below is drawn. Of a leaf it is estimated for a surface through its middle, on which the nodes above
    /// have a quarter of the points of a whole grid.
    #[must_use]
    pub fn spacing(&self) -> f32 {
        let side = 2.0 * self.half;
        if self.is_leaf() {
            let above = (CELLS * CELLS / 4) as f32;
            side / (self.count as f32 + above).sqrt()
        } else {
            side / CELLS as f32
        }
    }

    /// The octant of a point: bits 0 to 2 for x, y and z.
    pub(super) fn octant(&self, place: Vec3) -> usize {
        let from = place - self.centre;
        usize::from(from.x >= 0.0)
            | usize::from(from.y >= 0.0) << 1
            | usize::from(from.z >= 0.0) << 2
    }

    /// The middle of the cube of an octant.
    pub(super) fn middle(&self, octant: usize) -> Vec3 {
        let side = |bit: usize| if octant >> bit & 1 == 1 { 0.5 } else { -0.5 };
        self.centre + Vec3::new(side(0), side(1), side(2)) * self.half
    }

    /// Whether a point is in its cube.
    pub(super) fn contains(&self, place: Vec3) -> bool {
        (place - self.centre).abs().max_element() <= self.half
    }

    /// Takes the cell of a point. False where it is taken, or the node is a leaf.
    pub(super) fn take_cell(&mut self, place: Vec3) -> bool {
        let Some(cells) = &mut self.cells else {
            return false;
        };
        let cell = (place - self.centre + self.half) * (CELLS as f32 / (2.0 * self.half));
        let cell = cell.as_uvec3().min(glam::UVec3::splat(CELLS - 1));
        let number = (cell.x + CELLS * (cell.y + CELLS * cell.z)) as usize;
        let (word, bit) = (number / 64, 1 << (number % 64));
        let free = cells[word] & bit == 0;
        cells[word] |= bit;
        free
    }

    /// Makes it an inner node without points. Returns those that were in memory.
    pub(super) fn open(&mut self) -> Vec<Vertex> {
        self.cells = Some(vec![0; WORDS].into());
        self.is_leaf = false;
        self.count = 0;
        self.pieces.clear();
        std::mem::take(&mut self.points)
    }
}
