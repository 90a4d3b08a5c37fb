//! The tree itself.

use super::node::{Id, Node};
use super::store::Store;
use crate::extent::extent;
use crate::vertex::Vertex;
use glam::{DVec3, Vec3};
use std::io;

/// The tree.
#[derive(Debug)]
pub struct Octree {
    /// Of the file's space, where the tree's own begins.
    origin: DVec3,
    pub(super) nodes: Vec<Node>,
    pub(super) root: Id,
    pub(super) store: Store,
    /// Points in it.
    pub(super) count: u64,
}

impl Octree {
    /// An empty tree about a point that holds so many bytes of points in memory, the rest in a temporary file.
    ///
    /// # Errors
    /// There can be no temporary file.
    pub fn new(origin: DVec3, size: f32, memory: u64) -> io::Result<Self> {
        let half = if size.is_finite() && size > 0.0 {
            size / 2.0
        } else {
            1.0
        };
        Ok(Self {
            origin,
            nodes: vec![Node::new(Vec3::ZERO, half)],
            root: 0,
            store: Store::new(memory)?,
            count: 0,
        })
    }

    /// Where the tree's own space begins in that of the file.
    #[must_use]
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// How many points it has.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Bytes of it that are in memory.
    #[must_use]
    pub fn resident(&self) -> u64 {
        self.store.resident()
    }

    /// No more points come.
    pub fn finish(&mut self) {
        self.store.finish(&mut self.nodes);
    }

    /// A node.
    #[must_use]
    pub fn node(&self, id: Id) -> &Node {
        &self.nodes[id as usize]
    }

    /// The points of a node.
    ///
    /// # Errors
    /// The temporary file cannot be read.
    pub fn points(&self, id: Id) -> io::Result<Vec<Vertex>> {
        self.store.points(self.node(id))
    }

    /// The points of a node, and after them those of nodes above it that are in its cube or near it. Returns how many are its own.
    ///
    /// # Errors
    /// The temporary file cannot be read.
    pub fn points_about(&self, id: Id) -> io::Result<(Vec<Vertex>, usize)> {
        let mut points = self.points(id)?;
        let own = points.len();
        let node = self.node(id);
        let (centre, reach) = (node.centre, node.half * NEAR);
        let mut above = node.parent;
        while let Some(id) = above {
            let around = self.points(id)?;
            let inside = |point: &Vertex| (point.at() - centre).abs().max_element() <= reach;
            points.extend(around.into_iter().filter(inside));
            above = self.node(id).parent;
        }
        Ok((points, own))
    }

    /// The middle and the radius of a ball that holds most of the cloud: a few points far away, which many scans have, are left out.
    #[must_use]
    pub fn extent(&self) -> (Vec3, f32) {
        let points = self.points(self.root).unwrap_or_default();
        extent(points.iter().map(Vertex::at), FAR)
    }
}

/// The share of a cloud at each end of an axis that may be far away.
const FAR: f32 = 0.01;
/// By how much the surroundings of a node are larger than it.
const NEAR: f32 = 1.1;
