//! Splats in groups that do not overlap, for deferred blending (Hübner et al., section 4.4.1, after Zhang and Pajarola 2006).
#![forbid(unsafe_code)]

use super::Splat;
use glam::{DVec3, IVec3};
use rustc_hash::FxHashMap;

/// The group of each splat, and how many there are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Groups {
    /// One number for each splat.
    pub of: Vec<u32>,
    /// K.
    pub count: u32,
}

impl Groups {
    /// Partitions splats so that two of a group never overlap: their spheres do not. Each one gets the first group that none of its neighbours has, in the
    /// order of the splats (a greedy colouring of the graph of neighbours).
    #[must_use]
    pub fn new(splats: &[Splat]) -> Self {
        let largest = splats.iter().map(|splat| splat.radius).fold(0.0, f64::max);
        // Neighbours of a splat are in the cells about its own.
        let cell = |point: DVec3| (point / (2.0 * largest)).floor().as_ivec3();
        let mut cells: FxHashMap<IVec3, Vec<usize>> = FxHashMap::default();
        let mut groups = Self {
            of: Vec::with_capacity(splats.len()),
            count: 0,
        };
        let mut taken = Vec::new();
        for (number, splat) in splats.iter().enumerate() {
            let own = cell(splat.centre);
            taken.clear();
            for around in neighbours(own) {
                for &other in cells.get(&around).into_iter().flatten() {
                    let other_splat = &splats[other];
                    let reach = splat.radius + other_splat.radius;
                    if splat.centre.distance_squared(other_splat.centre) < reach * reach {
                        taken.push(groups.of[other]);
                    }
                }
            }
            let free = (0..).find(|group| !taken.contains(group)).unwrap_or(0);
            groups.of.push(free);
            groups.count = groups.count.max(free + 1);
            cells.entry(own).or_default().push(number);
        }
        groups
    }
}

/// A cell and those about it.
fn neighbours(cell: IVec3) -> impl Iterator<Item = IVec3> {
    let steps = move |axis: i32| (-1..=1).map(move |step| axis.saturating_add(step));
    steps(cell.x).flat_map(move |x| {
        steps(cell.y).flat_map(move |y| steps(cell.z).map(move |z| IVec3::new(x, y, z)))
    })
}
