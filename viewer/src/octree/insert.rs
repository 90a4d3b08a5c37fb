//! Adds points.

use super::node::{Id, Node};
use super::tree::Octree;
use crate::vertex::Vertex;
use glam::Vec3;
use std::io;

/// A leaf with more points is opened.
const LEAF: u32 = 6_000;
/// A cube is not opened that is so small for its distance from the origin that places in it are all the same.
const SMALLEST: f32 = 64.0 * f32::EPSILON;

impl Octree {
    /// Adds points, whose places are finite.
    ///
    /// # Errors
    /// The temporary file cannot be written.
    pub fn insert(&mut self, points: &[Vertex]) -> io::Result<()> {
        for &point in points {
            while !self.node(self.root).contains(point.at()) {
                self.grow(point.at())?;
            }
            self.put(self.root, point)?;
            self.count += 1;
        }
        self.store.spill(&mut self.nodes)
    }

    /// Puts a point into a node or one below.
    fn put(&mut self, mut at: Id, point: Vertex) -> io::Result<()> {
        let place = point.at();
        loop {
            let node = &mut self.nodes[at as usize];
            if node.is_leaf() {
                self.store.push(node, point);
                if node.count > LEAF && may_open(node) {
                    self.open(at)?;
                }
                return Ok(());
            }
            if node.take_cell(place) {
                self.store.push(node, point);
                return Ok(());
            }
            let octant = node.octant(place);
            at = self.child(at, octant);
        }
    }

    /// Makes a leaf an inner node, and hands its points down.
    fn open(&mut self, id: Id) -> io::Result<()> {
        let node = &mut self.nodes[id as usize];
        for point in self.store.open(node)? {
            self.put(id, point)?;
        }
        Ok(())
    }

    /// The node in an octant, which is made where there is none.
    fn child(&mut self, id: Id, octant: usize) -> Id {
        let next = self.nodes.len() as Id;
        let node = &mut self.nodes[id as usize];
        if let Some(child) = node.children[octant] {
            return child;
        }
        node.children[octant] = Some(next);
        let mut child = Node::new(node.middle(octant), node.half / 2.0);
        child.parent = Some(id);
        self.nodes.push(child);
        next
    }

    /// Puts the root into one of twice its side, towards a point. Some of its points go up, so that the new root has its part of the cloud.
    fn grow(&mut self, towards: Vec3) -> io::Result<()> {
        let old = self.root;
        let id = self.nodes.len() as Id;
        let node = &mut self.nodes[old as usize];
        let away = towards - node.centre;
        let side = |to: f32| if to >= 0.0 { node.half } else { -node.half };
        let centre = node.centre + Vec3::new(side(away.x), side(away.y), side(away.z));
        let mut root = Node::new(centre, node.half * 2.0);
        if node.count == 0 && node.is_leaf() {
            (node.centre, node.half) = (root.centre, root.half);
            return Ok(());
        }
        self.store.open(&mut root)?;
        root.children[root.octant(node.centre)] = Some(old);
        node.parent = Some(id);
        let points = self.store.points(node)?;
        let is_free = |point: &Vertex| root.take_cell(point.at());
        let (up, stay): (Vec<_>, Vec<_>) = points.into_iter().partition(is_free);
        self.store.replace(node, stay);
        self.store.replace(&mut root, up);
        self.nodes.push(root);
        self.root = id;
        Ok(())
    }
}

/// Whether points in the cube are at different places.
fn may_open(node: &Node) -> bool {
    node.half > node.centre.abs().max_element() * SMALLEST && node.half > f32::MIN_POSITIVE * 1e6
}
