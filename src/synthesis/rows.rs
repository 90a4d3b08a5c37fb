//! The distortion map of an occlusion camera whose views stand beside each other: rays are distorted along their rows alone.
//!
//! Popescu et al., section IV.C, for viewpoints on a line: what such views uncover lies left and right of its occluder, so a splat is a
//! piece of a row. Places are taken as they are and not by pixel, and discontinuities lie between two pixels. Three rules differ from those of
//! [`super::Distortions`]: a splat reaches no farther behind than any view sees; it ends half of the way to one on the other side of
//! what is in front; and α is the least of 1, 2 and 4 by which it has room on the side of the background, r/α, half of the way to the next
//! one that distorts against it.

use super::distortion::magnitude;
use super::warp::excess;

/// What is chosen, and how far views stand apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowDistortionMap {
    /// D: pixels behind what is in front that the camera reaches at most.
    pub reach: f64,
    /// Pixels by which the outermost view parts what differs by 1 in 1/w.
    pub longest: f64,
}

/// The splat that has two pixels beside each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowDistortion {
    /// Where the discontinuity lies, in pixels from the left.
    pub edge: f64,
    /// r, in pixels; below 0 where what is behind lies to the left.
    pub radius: f64,
    /// α: on the side of the background it takes so much less than it reaches behind.
    pub asymmetry: f64,
    /// 1/z_n.
    pub near: f64,
    /// 1/z_f.
    pub far: f64,
}

impl RowDistortion {
    /// Pixels to the right by which something at a place and 1/w moves: Equations 1 and 2.
    pub fn at(&self, x: f64, inverse: f64) -> f64 {
        let (side, r) = (self.radius.signum(), self.radius.abs());
        let from = (x - self.edge) * side;
        if from < -r {
            return 0.0;
        }
        let depth = (self.near - inverse) / (self.near - self.far);
        side * magnitude(from, r, self.asymmetry) * depth.clamp(0.0, 1.0)
    }
}

/// Pixels that one splat has together.
const CELL: usize = 2;

/// A step in depth between two pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Step {
    /// The pixel on its right side.
    at: usize,
    /// 1 where what is behind lies on the right, else -1.
    side: i64,
}

impl RowDistortionMap {
    /// The splat of each two pixels of a row with these values of 1/w.
    pub fn row(&self, inverses: &[f32]) -> Vec<Option<RowDistortion>> {
        let steps = self.steps(inverses);
        let cells = 0..inverses.len().div_ceil(CELL);
        cells
            .map(|x| self.distortion(inverses, &steps, x))
            .collect()
    }

    /// Steps that the outermost view tears by a pixel or more.
    fn steps(&self, inverses: &[f32]) -> Vec<Step> {
        let torn = |at: &usize| excess(inverses, at - 1) * self.longest > 1.0;
        let step = |at: usize| Step {
            at,
            side: if inverses[at - 1] > inverses[at] {
                1
            } else {
                -1
            },
        };
        (1..inverses.len()).filter(torn).map(step).collect()
    }

    fn distortion(&self, inverses: &[f32], steps: &[Step], x: usize) -> Option<RowDistortion> {
        let away = |step: &Step| ((x * CELL + 1) as f64 - step.at as f64).abs();
        let nearest = steps.iter().reduce(|a, b| match away(b) < away(a) {
            true => b,
            false => a,
        })?;
        if away(nearest) > self.reach.ceil() {
            return None;
        }
        let [before, after] = [nearest.at - 1, nearest.at].map(|at| f64::from(inverses[at]));
        let (near, far) = (before.max(after), before.min(after));
        // To the nearest one that distorts the other way, on a side of this one.
        let conflict = |side: i64| {
            let apart = |other: &Step| (other.at as i64 - nearest.at as i64) * side;
            let others = steps.iter().filter(|other| other.side != nearest.side);
            let apart = others.map(apart).filter(|&apart| apart > 0);
            apart.min().map_or(f64::INFINITY, |apart| apart as f64)
        };
        let seen = self.longest * (near - far) + 1.0;
        let wanted = self.reach.min(seen).min(conflict(-nearest.side) / 2.0);
        let room = conflict(nearest.side) / 2.0;
        let fits = [1.0, 2.0].into_iter().find(|a| wanted <= room * a);
        let asymmetry = fits.unwrap_or(4.0);
        let radius = wanted.min(room * asymmetry);
        Some(RowDistortion {
            edge: nearest.at as f64,
            radius: radius * nearest.side as f64,
            asymmetry,
            near,
            far,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const DISTORTION_MAP: RowDistortionMap = RowDistortionMap {
        reach: 12.0,
        longest: 100.0,
    };

    /// Of a far wall with bars before it.
    fn bars(places: &[[usize; 2]]) -> Vec<f32> {
        let near = |x: &usize| places.iter().any(|[from, to]| (*from..*to).contains(x));
        (0..96).map(|x| if near(&x) { 0.5 } else { 0.1 }).collect()
    }

    #[test]
    fn splats_reach_as_far_as_they_may() {
        let all = |row: Vec<f32>, map: RowDistortionMap| {
            let mut radii: Vec<f64> = map.row(&row).iter().flatten().map(|b| b.radius).collect();
            radii.dedup();
            radii
        };
        assert_eq!(all(bars(&[[30, 70]]), DISTORTION_MAP), [-12.0, 12.0]);
        // What no view sees is not reached for.
        let near = RowDistortionMap {
            longest: 20.0,
            ..DISTORTION_MAP
        };
        let seen = all(bars(&[[30, 70]]), near);
        assert!(seen.len() == 2 && (seen[1] - 9.0).abs() < 1e-5, "{seen:?}");
        // Two sides of one bar.
        assert_eq!(all(bars(&[[40, 46]]), DISTORTION_MAP), [-3.0, 3.0]);
        // A gap of 4 pixels, between bars that are wide enough.
        assert_eq!(
            all(bars(&[[10, 40], [44, 80]]), DISTORTION_MAP),
            [-12.0, 8.0, -8.0, 12.0]
        );
    }

    #[test]
    fn splats_take_the_room_that_they_have() {
        for (gap, asymmetry) in [(30, 1.0), (24, 1.0), (16, 2.0), (9, 4.0), (4, 4.0)] {
            let row = DISTORTION_MAP.row(&bars(&[[10, 40], [40 + gap, 90]]));
            assert_eq!(row[20].unwrap().asymmetry, asymmetry, "{gap}");
        }
    }

    #[test]
    fn what_is_hidden_comes_to_lie_beside_what_hides_it() {
        let row = DISTORTION_MAP.row(&bars(&[[30, 70]]));
        let right = row[37].unwrap();
        assert_eq!((right.edge, right.near), (70.0, 0.5));
        // The farthest that is reached appears at the edge; where the splat ends nothing moves.
        assert!((58.0 + right.at(58.0, 0.1) - 70.0).abs() < 1e-6);
        assert!(right.at(82.0, 0.1).abs() < 1e-6);
        // What is in front stays.
        assert_eq!(right.at(69.0, 0.5), 0.0);
        assert_eq!(right.at(57.9, 0.1), 0.0);
    }

    proptest! {
        #[test]
        fn rays_to_what_is_infinitely_far_cross_by_no_more_than_a_cell(
            inverses in proptest::collection::vec(0.0f32..1.0, 8..80),
            reach in 1.0f64..40.0,
        ) {
            let map = RowDistortionMap { reach, longest: 60.0 };
            let row = map.row(&inverses);
            let moved = (0..row.len() * 8).map(|at| {
                let x = (at as f64 + 0.5) / 8.0;
                let distortion = row[x as usize / CELL];
                x + distortion.map_or(0.0, |distortion| distortion.at(x, 0.0))
            });
            let moved: Vec<f64> = moved.collect();
            for (at, pair) in moved.windows(2).enumerate() {
                // Which splat has a place is known by cell.
                prop_assert!(pair[1] >= pair[0] - CELL as f64, "{} at {at}", pair[0] - pair[1]);
            }
        }
    }
}
