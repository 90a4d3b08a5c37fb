//! Where most of a cloud is.

use glam::Vec3;

/// The middle and the radius of a ball that holds most of some places. `outside`: the share at each end of each axis that is left out: many clouds have a few
/// points far away.
#[must_use]
pub(crate) fn extent(places: impl Iterator<Item = Vec3> + Clone, outside: f32) -> (Vec3, f32) {
    let axis = |axis: usize| {
        let mut all: Vec<f32> = places.clone().map(|place| place[axis]).collect();
        all.sort_unstable_by(f32::total_cmp);
        let last = all.len() as f32 - 1.0;
        let at = |share: f32| all.get((last * share) as usize).copied().unwrap_or(0.0);
        [at(outside), at(1.0 - outside)]
    };
    let [x, y, z] = [axis(0), axis(1), axis(2)];
    let (low, high) = (Vec3::new(x[0], y[0], z[0]), Vec3::new(x[1], y[1], z[1]));
    let radius = (high - low).length() / 2.0;
    let smallest = (high.abs().max_element() * f32::EPSILON).max(f32::MIN_POSITIVE);
    ((low + high) / 2.0, radius.max(smallest))
}

#[cfg(test)]
mod tests {
    use super::extent;
    use glam::Vec3;

    #[test]
    fn a_few_places_far_away_do_not_count() {
        let line = (0..1000).map(|n| Vec3::new(n as f32, 7.0, 0.0));
        let far = [Vec3::splat(1e9), Vec3::splat(-1e9)];
        let (middle, radius) = extent(line.chain(far), 0.01);
        assert!(
            (middle - Vec3::new(499.5, 7.0, 0.0)).length() < 2.0,
            "{middle}"
        );
        assert!((480.0..=500.0).contains(&radius), "{radius}");
        assert_eq!(
            extent(std::iter::empty(), 0.01),
            (Vec3::ZERO, f32::MIN_POSITIVE)
        );
    }
}
