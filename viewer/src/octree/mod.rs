//! Points in an octree whose upper nodes hold some of them, evenly spread, and whose lower nodes hold the rest: a picture from afar needs the upper ones alone.
//!
//! In the manner of M. Schütz, "Potree: rendering large point clouds in web browsers" (2016): the points of a node and those of all above it belong
//! together. Points come in any order while the tree is drawn, so a node takes the first in each cell of its grid and hands the others down.

mod choose;
mod insert;
mod node;
mod store;
#[cfg(test)]
mod tests;
mod tree;

pub use choose::{Choice, Chosen, Look};
pub use node::{CELLS, Id, Node};
pub use tree::Octree;
