//! The order in which Gaussians are drawn, the farthest first, and their colours as a viewer sees them.

use super::{Gaussians, harmonics};
use glam::{Mat4, Vec3};

/// What one place of the viewer needs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sorted {
    /// Numbers of Gaussians.
    pub order: Vec<u32>,
    /// Of each Gaussian: its colour, 0 and above.
    pub colours: Vec<[f32; 4]>,
}

/// Bits of depth by which Gaussians are told apart, in two steps.
const BITS: u32 = 11;

impl Sorted {
    /// For a viewer at a place with a view matrix (right-handed, the viewer looks along −z).
    #[must_use]
    pub fn new(gaussians: &Gaussians, view: &Mat4, eye: Vec3) -> Self {
        let depth = view.row(2);
        let depths: Vec<f32> = gaussians
            .all
            .iter()
            .map(|one| -depth.dot(one.place.extend(1.0)))
            .collect();
        Self {
            order: farthest_first(&depths),
            colours: colours(gaussians, eye),
        }
    }
}

/// The numbers of depths from the greatest to the least, by two passes of a radix sort.
fn farthest_first(depths: &[f32]) -> Vec<u32> {
    let finite = depths.iter().copied().filter(|depth| depth.is_finite());
    let (least, most) = finite.fold(
        (f32::INFINITY, f32::NEG_INFINITY),
        |(least, most), depth| (least.min(depth), most.max(depth)),
    );
    let top = ((1_u32 << (2 * BITS)) - 1) as f32;
    let scale = top / (most - least).max(f32::MIN_POSITIVE);
    let key = |depth: f32| ((most - depth) * scale).clamp(0.0, top) as u32;
    let keys: Vec<u32> = depths.iter().map(|&depth| key(depth)).collect();
    let mut order: Vec<u32> = (0..depths.len() as u32).collect();
    for step in 0..2 {
        let digit =
            |number: u32| (keys[number as usize] >> (step * BITS) & ((1 << BITS) - 1)) as usize;
        let mut starts = vec![0_u32; 1 << BITS];
        for &number in &order {
            starts[digit(number)] += 1;
        }
        let mut sum = 0;
        for start in &mut starts {
            sum += std::mem::replace(start, sum);
        }
        let mut next = vec![0; order.len()];
        for &number in &order {
            let place = &mut starts[digit(number)];
            next[*place as usize] = number;
            *place += 1;
        }
        order = next;
    }
    order
}

/// The colour of each, as it is seen from a place.
fn colours(gaussians: &Gaussians, eye: Vec3) -> Vec<[f32; 4]> {
    let all = gaussians.all.iter().enumerate();
    all.map(|(number, one)| {
        let direction = (one.place - eye).normalize_or_zero();
        let colour = harmonics::colour(gaussians.colour(number), direction);
        colour.extend(1.0).to_array()
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::farthest_first;

    #[test]
    fn the_farthest_is_first() {
        let depths: Vec<f32> = (0..5000)
            .map(|n| ((n * 7919) % 5000) as f32 * 0.01 - 3.0)
            .collect();
        let order = farthest_first(&depths);
        let sorted: Vec<f32> = order
            .iter()
            .map(|&number| depths[number as usize])
            .collect();
        assert!(sorted.windows(2).all(|pair| pair[0] >= pair[1]));
        assert_eq!(farthest_first(&[]), Vec::<u32>::new());
        assert_eq!(farthest_first(&[1.0, 1.0]).len(), 2);
    }
}
