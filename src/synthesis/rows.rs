//! The distortion map of an occlusion camera whose views stand beside each other: rays are distorted along their rows only.
//!
//! Popescu et al., section IV.C, for viewpoints on a line: a disocclusion of such views lies left or right of its occluder, so a splat is a piece of
//! a row. Places are continuous, not pixels, and discontinuities lie between two pixels. Three rules differ from those of
//! [`super::Distortions`]:
//!
//! - A splat reaches no farther behind its occluder than any view sees.
//! - It ends half of the way to the splat on the other side of its occluder.
//! - α is the least of 1, 2 and 4 with which r/α fits the room on the side of the background. That room is half of the way to the next splat that
//!   distorts in the other direction. If none fits, α is 4 and r shrinks.

use super::distortion::magnitude;
use super::warp::excess;

/// The parameters of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowDistortionMap {
    /// D: the most pixels that the camera reaches behind an occluder.
    pub reach: f64,
    /// Disparity of the outermost view, in pixels per unit of 1/w.
    pub longest: f64,
}

/// The splat of two neighbouring pixels, which share one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowDistortion {
    /// Place of the discontinuity, in pixels from the left.
    pub edge: f64,
    /// r, in pixels; below 0 where the background lies to the left.
    pub radius: f64,
    /// α: reach behind the occluder, over the extent on the side of the background.
    pub asymmetry: f64,
    /// 1/z_n.
    pub near: f64,
    /// 1/z_f.
    pub far: f64,
}

impl RowDistortion {
    /// Pixels to the right by which a point at x and 1/w moves: Equations 1 and 2.
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

/// Neighbouring pixels of a row that share one splat.
const CELL: usize = 2;

/// A depth discontinuity between two pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Discontinuity {
    /// The pixel on its right.
    at: usize,
    /// 1 where the background lies on the right, else -1.
    side: i64,
}

impl RowDistortionMap {
    /// The splats of a row with these values of 1/w, one for every two pixels. None where rays are straight.
    pub fn row(&self, inverses: &[f32]) -> Vec<Option<RowDistortion>> {
        let discontinuities = self.discontinuities(inverses);
        let cells = 0..inverses.len().div_ceil(CELL);
        cells
            .map(|x| self.distortion(inverses, &discontinuities, x))
            .collect()
    }

    /// Discontinuities that the outermost view tears by more than a pixel.
    fn discontinuities(&self, inverses: &[f32]) -> Vec<Discontinuity> {
        let torn = |at: &usize| excess(inverses, at - 1) * self.longest > 1.0;
        let discontinuity = |at: usize| Discontinuity {
            at,
            side: if inverses[at - 1] > inverses[at] {
                1
            } else {
                -1
            },
        };
        (1..inverses.len())
            .filter(torn)
            .map(discontinuity)
            .collect()
    }

    fn distortion(
        &self,
        inverses: &[f32],
        discontinuities: &[Discontinuity],
        x: usize,
    ) -> Option<RowDistortion> {
        let away = |other: &Discontinuity| ((x * CELL + 1) as f64 - other.at as f64).abs();
        let nearest = discontinuities
            .iter()
            .reduce(|a, b| match away(b) < away(a) {
                true => b,
                false => a,
            })?;
        if away(nearest) > self.reach.ceil() {
            return None;
        }
        let [before, after] = [nearest.at - 1, nearest.at].map(|at| f64::from(inverses[at]));
        let (near, far) = (before.max(after), before.min(after));
        // Pixels to the nearest discontinuity on one side of this one that distorts in the other direction.
        let conflict = |side: i64| {
            let apart = |other: &Discontinuity| (other.at as i64 - nearest.at as i64) * side;
            let others = discontinuities
                .iter()
                .filter(|other| other.side != nearest.side);
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

    /// 1/w of a far wall with bars before it.
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
        // A splat does not reach for what no view sees.
        let near = RowDistortionMap {
            longest: 20.0,
            ..DISTORTION_MAP
        };
        let seen = all(bars(&[[30, 70]]), near);
        assert!(seen.len() == 2 && (seen[1] - 9.0).abs() < 1e-5, "{seen:?}");
        // Both sides of one bar share it.
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
    fn what_is_hidden_comes_to_lie_beside_its_occluder() {
        let row = DISTORTION_MAP.row(&bars(&[[30, 70]]));
        let right = row[37].unwrap();
        assert_eq!((right.edge, right.near), (70.0, 0.5));
        // The farthest place that is reached appears at the edge; where the splat ends, nothing moves.
        assert!((58.0 + right.at(58.0, 0.1) - 70.0).abs() < 1e-6);
        assert!(right.at(82.0, 0.1).abs() < 1e-6);
        // The occluder stays.
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
                // The splat of a place is known by cell only.
                prop_assert!(pair[1] >= pair[0] - CELL as f64, "{} at {at}", pair[0] - pair[1]);
            }
        }
    }
}
