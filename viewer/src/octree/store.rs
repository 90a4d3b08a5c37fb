//! Points that do not fit into memory, in a temporary file.

use super::node::{CELL_BYTES, Node, Piece};
use crate::vertex::Vertex;
use std::fs::File;
use std::io;
use std::os::unix::fs::FileExt;

/// Counts what is in memory, and owns the file. A piece is written once and never moved.
#[derive(Debug)]
pub(super) struct Store {
    file: File,
    /// Its length.
    end: u64,
    /// Bytes of points and cells in memory.
    resident: u64,
    /// At most so many.
    memory: u64,
}

/// Bytes of so many points.
fn bytes(points: usize) -> u64 {
    (points * size_of::<Vertex>()) as u64
}

impl Store {
    pub(super) fn new(memory: u64) -> io::Result<Self> {
        Ok(Self {
            file: tempfile::tempfile()?,
            end: 0,
            resident: 0,
            memory,
        })
    }

    pub(super) fn resident(&self) -> u64 {
        self.resident
    }

    /// Puts a point into a node.
    pub(super) fn push(&mut self, node: &mut Node, point: Vertex) {
        node.points.push(point);
        node.count += 1;
        node.version = node.version.wrapping_add(1);
        self.resident += bytes(1);
    }

    /// All points of a node.
    pub(super) fn points(&self, node: &Node) -> io::Result<Vec<Vertex>> {
        let mut points = Vec::with_capacity(node.count as usize);
        for piece in &node.pieces {
            let mut part = vec![bytemuck::Zeroable::zeroed(); piece.points as usize];
            let raw: &mut [u8] = bytemuck::cast_slice_mut(&mut part);
            self.file.read_exact_at(raw, piece.start)?;
            points.append(&mut part);
        }
        points.extend_from_slice(&node.points);
        Ok(points)
    }

    /// Takes all points out of a node, and makes it an inner one.
    pub(super) fn open(&mut self, node: &mut Node) -> io::Result<Vec<Vertex>> {
        let points = self.points(node)?;
        let in_memory = node.open();
        self.resident += CELL_BYTES;
        self.resident -= bytes(in_memory.len());
        Ok(points)
    }

    /// Takes points out of a node and puts others in their place, all in memory.
    pub(super) fn replace(&mut self, node: &mut Node, points: Vec<Vertex>) {
        self.resident -= bytes(node.points.len());
        self.resident += bytes(points.len());
        node.count = points.len() as u32;
        node.version = node.version.wrapping_add(1);
        node.pieces.clear();
        node.points = points;
    }

    /// Gives the cells back, which only the insertion of points needs.
    pub(super) fn finish(&mut self, nodes: &mut [Node]) {
        for node in nodes {
            if node.cells.take().is_some() {
                self.resident -= CELL_BYTES;
            }
        }
    }

    /// Writes the nodes with the most points in memory to the file, until a half of what is allowed is left.
    pub(super) fn spill(&mut self, nodes: &mut [Node]) -> io::Result<()> {
        if self.resident <= self.memory {
            return Ok(());
        }
        let mut largest: Vec<usize> = (0..nodes.len()).collect();
        largest.sort_unstable_by_key(|&at| std::cmp::Reverse(nodes[at].points.len()));
        for at in largest {
            let node = &mut nodes[at];
            if self.resident <= self.memory / 2 || node.points.is_empty() {
                break;
            }
            self.file
                .write_all_at(bytemuck::cast_slice(&node.points), self.end)?;
            node.pieces.push(Piece {
                start: self.end,
                points: node.points.len() as u32,
            });
            let written = bytes(node.points.len());
            self.end += written;
            self.resident -= written;
            node.points = Vec::new();
        }
        Ok(())
    }
}
