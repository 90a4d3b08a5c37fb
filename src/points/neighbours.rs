//! How far the neighbours of points are, by a k-d tree.

use glam::Vec3;

/// The neighbour whose distance tells how large a point is: on a square grid it is the first beyond the next ones along the axes.
pub const SIZED_BY: usize = 5;
/// What disks are larger than half of that distance. Points that lie at random leave exp(−6·(COVER/2)²) of a surface uncovered: 0.07 per cent.
pub const COVER: f32 = 2.2;

/// A neighbour of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbour {
    /// Its number.
    pub number: u32,
    /// How far it is.
    pub distance: f32,
}

/// Points in a k-d tree: the middle one of a range parts those before it from those behind it, along the axis in which the range is longest.
#[derive(Debug)]
pub struct Tree {
    places: Vec<(Vec3, u32)>,
    axes: Vec<u8>,
}

impl Tree {
    /// Of points that are finite; others belong to nobody's neighbourhood.
    #[must_use]
    pub fn new(places: &[Vec3]) -> Self {
        let numbered = (0..).zip(places).map(|(number, &place)| (place, number));
        let mut places: Vec<(Vec3, u32)> =
            numbered.filter(|(place, _)| place.is_finite()).collect();
        let mut axes = vec![0; places.len()];
        part(&mut places, &mut axes);
        Tree { places, axes }
    }

    /// The neighbour of a point that tells how large this is: the [`SIZED_BY`]th after those in the very same place, or the last one. None where it is alone.
    #[must_use]
    pub fn sizing(&self, number: u32, place: Vec3) -> Option<Neighbour> {
        let mut nearest = Nearest::default();
        if place.is_finite() {
            self.search(0..self.places.len(), (number, place), &mut nearest);
        }
        let found = nearest.found.get(nearest.count.checked_sub(1)?)?;
        Some(Neighbour {
            number: found.1,
            distance: found.0.sqrt(),
        })
    }

    fn search(
        &self,
        range: std::ops::Range<usize>,
        (number, place): (u32, Vec3),
        nearest: &mut Nearest,
    ) {
        let middle = range.start + range.len() / 2;
        let (Some(&(at, own)), Some(&axis)) = (
            self.places.get(middle).filter(|_| !range.is_empty()),
            self.axes.get(middle),
        ) else {
            return;
        };
        let squared = at.distance_squared(place);
        if own != number && squared > 0.0 {
            nearest.add(squared, own);
        }
        let across = place[usize::from(axis)] - at[usize::from(axis)];
        let sides = [range.start..middle, middle + 1..range.end];
        let [before, behind] = sides;
        let (near, far) = match across < 0.0 {
            true => (before, behind),
            false => (behind, before),
        };
        self.search(near, (number, place), nearest);
        if across * across < nearest.reach() {
            self.search(far, (number, place), nearest);
        }
    }
}

fn part(places: &mut [(Vec3, u32)], axes: &mut [u8]) {
    if places.is_empty() {
        return;
    }
    let ends = places.iter().fold(
        [Vec3::INFINITY, Vec3::NEG_INFINITY],
        |[low, high], (place, _)| [low.min(*place), high.max(*place)],
    );
    let axis = (ends[1] - ends[0]).max_position();
    let middle = places.len() / 2;
    places.select_nth_unstable_by(middle, |(a, _), (b, _)| a[axis].total_cmp(&b[axis]));
    axes[middle] = axis as u8;
    let (before, rest) = places.split_at_mut(middle);
    let (axes_before, axes_rest) = axes.split_at_mut(middle);
    part(before, axes_before);
    part(&mut rest[1..], &mut axes_rest[1..]);
}

/// The nearest points so far, by the squares of their distances.
#[derive(Default)]
struct Nearest {
    found: [(f32, u32); SIZED_BY + 1],
    count: usize,
}

impl Nearest {
    /// Beyond this square of a distance nothing is of interest.
    fn reach(&self) -> f32 {
        match self.count == self.found.len() {
            true => self.found[self.count - 1].0,
            false => f32::INFINITY,
        }
    }

    fn add(&mut self, squared: f32, number: u32) {
        if squared >= self.reach() {
            return;
        }
        let full = self.count == self.found.len();
        let mut at = self.count - usize::from(full);
        while at > 0 && self.found[at - 1].0 > squared {
            self.found[at] = self.found[at - 1];
            at -= 1;
        }
        self.found[at] = (squared, number);
        self.count += usize::from(!full);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::splat::random::Random;

    #[test]
    fn the_neighbours_are_those_that_a_search_of_all_points_finds() {
        let mut random = Random::new(7);
        // Dense in one place and sparse elsewhere, some in one place, some nowhere.
        let mut places: Vec<Vec3> = (0..3000)
            .map(|i| {
                let scale = if i % 3 == 0 { 0.01 } else { 10.0 };
                let mut next = || random.between(-0.5, 0.5) as f32 * scale;
                Vec3::new(next(), next(), next())
            })
            .collect();
        places[10] = places[11];
        places[20] = Vec3::new(f32::NAN, 0.0, 0.0);
        let tree = Tree::new(&places);
        for (number, &place) in (0..).zip(&places) {
            let others = places.iter().filter(|other| other.is_finite());
            let mut all: Vec<f32> = others
                .map(|other| other.distance_squared(place))
                .filter(|&squared| squared > 0.0)
                .collect();
            all.sort_unstable_by(f32::total_cmp);
            let found = tree.sizing(number, place);
            if number == 20 {
                assert_eq!(found, None);
                continue;
            }
            let found = found.expect("a neighbour");
            assert_eq!(found.distance, all[SIZED_BY].sqrt(), "{number}");
            assert_eq!(
                places[found.number as usize].distance(place),
                found.distance
            );
        }
    }

    #[test]
    fn a_point_alone_has_no_neighbour_and_few_points_have_the_last() {
        assert_eq!(Tree::new(&[Vec3::ONE]).sizing(0, Vec3::ONE), None);
        let places = [Vec3::ZERO, Vec3::X, 3.0 * Vec3::X];
        let found = Tree::new(&places).sizing(0, Vec3::ZERO);
        let far = Neighbour {
            number: 2,
            distance: 3.0,
        };
        assert_eq!(found, Some(far));
        assert_eq!(Tree::new(&[]).sizing(0, Vec3::ZERO), None);
    }
}
