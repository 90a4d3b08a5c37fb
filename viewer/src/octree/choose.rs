//! Which nodes are drawn.

use super::node::Id;
use super::tree::Octree;
use glam::{Mat4, Vec3, Vec4};
use std::cmp::Ordering;
use std::collections::{BinaryHeap, VecDeque};

/// A camera, as far as the choice of nodes needs it.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Where it is, in the tree's space.
    pub eye: Vec3,
    /// From the tree's space to clip coordinates.
    pub clip: Mat4,
    /// Pixels that a length of one has at a distance of one.
    pub pixels: f32,
}

/// A node that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chosen {
    /// Its number.
    pub id: Id,
    /// Bit i: what is in octant i is drawn as well.
    pub mask: u8,
    /// Bit i: there is more in octant i, drawn or not.
    pub below: u8,
    /// The place in the list of the first of its nodes below, which follow each other.
    pub first: u32,
    /// Middle and half of the side of its cube, in the tree's space.
    pub cube: Vec4,
}

/// What a frame draws.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Choice {
    /// A node comes before those below it.
    pub drawn: Vec<Chosen>,
    /// Nodes that would be drawn, and are not ready, the most urgent first.
    pub missing: Vec<Id>,
    /// There are more, for which the budget is too small.
    pub is_limited: bool,
}

/// Neighbouring points are not drawn closer to each other than so many pixels.
const FINEST: f32 = 0.7;
/// What is so far outside of the picture, as a share of its width, other views may see.
const ASIDE: f32 = 0.15;

struct Candidate {
    id: Id,
    /// Distance of neighbouring points in pixels.
    pixels: f32,
}

impl Octree {
    /// The nodes that are drawn with at most so many points: those first whose points are farthest apart in the picture. A node comes before those below
    /// it, and is there where they are. `ready`: whether a node can be drawn already.
    #[must_use]
    pub fn choose(&self, look: &Look, budget: u64, ready: &dyn Fn(Id) -> bool) -> Choice {
        let mut drawn = vec![false; self.nodes.len()];
        let mut choice = Choice::default();
        let mut left = budget;
        let mut heap = BinaryHeap::new();
        heap.extend(self.candidate(self.root, look));
        while let Some(Candidate { id, pixels }) = heap.pop() {
            let node = self.node(id);
            if u64::from(node.count) > left {
                choice.is_limited = true;
                break;
            }
            left -= u64::from(node.count);
            if !ready(id) {
                choice.missing.push(id);
                continue;
            }
            drawn[id as usize] = true;
            if pixels >= FINEST {
                let below = node.children.iter().flatten();
                heap.extend(below.filter_map(|&child| self.candidate(child, look)));
            }
        }
        choice.drawn = self.list(&drawn);
        choice
    }

    /// A node, if it can be seen.
    fn candidate(&self, id: Id, look: &Look) -> Option<Candidate> {
        let node = self.node(id);
        let radius = node.half * 3.0_f32.sqrt();
        let rows = [0, 1, 2, 3].map(|row| look.clip.row(row));
        let wide = 1.0 + ASIDE;
        let planes = [
            rows[3] * wide + rows[0],
            rows[3] * wide - rows[0],
            rows[3] + rows[1],
            rows[3] - rows[1],
            rows[3] + rows[2],
        ];
        let outside =
            |plane: Vec4| plane.dot(node.centre.extend(1.0)) < -radius * plane.truncate().length();
        if planes.into_iter().any(outside) {
            return None;
        }
        // The nearest point of its ball; a camera in it sees it at its own size.
        let distance = ((node.centre - look.eye).length() - radius).max(node.half * 0.1);
        let pixels = node.spacing() * look.pixels / distance;
        Some(Candidate { id, pixels })
    }

    /// The drawn nodes, level by level, so that those below one follow each other.
    fn list(&self, drawn: &[bool]) -> Vec<Chosen> {
        let mut list = Vec::new();
        let mut queue = VecDeque::new();
        if drawn[self.root as usize] {
            queue.push_back(self.root);
        }
        let mut next = queue.len() as u32;
        while let Some(id) = queue.pop_front() {
            let (mut mask, mut below, first) = (0, 0, next);
            for (octant, child) in self.node(id).children.iter().enumerate() {
                below |= u8::from(child.is_some()) << octant;
                if let Some(child) = child.filter(|&child| drawn[child as usize]) {
                    mask |= 1 << octant;
                    queue.push_back(child);
                    next += 1;
                }
            }
            let node = self.node(id);
            list.push(Chosen {
                id,
                mask,
                below,
                first,
                cube: node.centre.extend(node.half),
            });
        }
        list
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        self.pixels
            .total_cmp(&other.pixels)
            .then(other.id.cmp(&self.id))
    }
}
