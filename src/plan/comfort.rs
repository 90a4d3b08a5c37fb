//! Cameras that keep the disparity between neighbouring views within the display's budget, whatever the scene.
//!
//! A point at distance w has the disparity sep·(1 − conv/w) between neighbouring views, in normalised device coordinates (Luo et
//! al., section III, written as in [`super::parallax`]). Two points and their disparities determine sep and conv. The farthest point gets
//! most of the budget and the nearest one a smaller part: behind the panel no disparity exceeds sep itself, but an object that
//! suddenly comes near has its disparity before the panel.
//!
//! Cameras that follow the depths of every frame would make the scene breathe. So they move only when the scene has changed by
//! an eighth, slowly towards more depth and faster towards less. They move at once only where a disparity would come near the end of the
//! budget, the convergence first, because it leaves the depth of the scene as it is. What comes nearer is expected to do so in the next frame as well.

use crate::config::Kept;

/// Parts of the budget that the cameras aim at, behind the panel and before it. In 516 frames of gltron the nearest point came up to 35 %
/// nearer from one frame to the next. With 0.8 on both sides eleven frames left the budget; with these none did.
pub(super) const BEHIND: f64 = 0.75;
pub(super) const BEFORE: f64 = 0.25;
/// Parts of the budget that the last measured depths never exceed.
pub(super) const LIMIT_BEHIND: f64 = 0.9;
pub(super) const LIMIT_BEFORE: f64 = 0.5;
/// Part of the budget that the nearest point does not exceed in the next frame, if it comes nearer by as much again.
const LIMIT_COMING: f64 = 0.7;
/// Part of the budget that the nearest point of a foreground gets, before the panel.
const FOREGROUND: f64 = 0.5;
/// The largest separation, in budgets: the disparity of an infinitely far point. A scene of little depth gets more than one budget until
/// something appears behind it.
const MOST: f64 = 4.0;
/// Differences of separation or convergence, as logarithms: above the first the cameras begin to move, below the second they stop.
const SLACK: f64 = 0.12;
const ARRIVED: f64 = 0.01;
/// Part of the remaining logarithmic way that is covered in one frame: by the separation to less depth, by the separation to more, and by
/// the convergence.
const INWARDS: f64 = 0.15;
const OUTWARDS: f64 = 0.02;
const ALONG: f64 = 0.03;

/// What a display can show between neighbouring views.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Largest disparity, before or behind the panel, in normalised device coordinates.
    pub budget: f64,
    /// From one camera to the next where eyes see the views, over the focal depth.
    pub neighbours: f64,
}

impl Reach {
    /// The limits for a projection; `lens` as [`Limits::lens`].
    #[must_use]
    pub fn limits(self, lens: (f64, f64)) -> Limits {
        Limits {
            budget: self.budget,
            // A projection that turns the picture by a right angle has no A to measure by.
            orthoscopic: match (lens.0 * self.neighbours).abs() {
                0.0 => f64::INFINITY,
                separation => separation,
            },
            lens,
        }
    }
}

/// Limits that the cameras keep to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Largest disparity between neighbouring views, before or behind the panel, in normalised device coordinates.
    pub budget: f64,
    /// Separation at which the scene is as deep as it is wide and high; a shallow scene gets no more.
    pub orthoscopic: f64,
    /// A (see [`super::parallax`]) per unit of row 3, and the length of row 3.
    pub lens: (f64, f64),
}

/// Depths that are visible in a frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seen {
    /// 1/w of the farthest and of the nearest point of the scene.
    pub scene: Option<[f64; 2]>,
    /// Least and largest conv/w of the draws that have a zero parallax of their own.
    pub others: Option<[f64; 2]>,
    /// A sky is visible. It is not drawn farther than [`Comfort::farthest`], so it is within the budget before the cameras have moved.
    pub sky: bool,
}

impl Seen {
    /// For a scene whose depths cannot be read, from the w of the near and the far plane of its projection: something
    /// may be infinitely far, and zero parallax lies between the planes, a third of the way on a logarithmic scale. At their geometric mean what is
    /// near in mu-cade, whose far plane is far beyond all that it draws, is twice as far before the panel.
    pub fn by_planes([near, far]: [f64; 2]) -> Self {
        let zero = (near * near * far).cbrt();
        Seen {
            scene: Some([0.0, (1.0 + BEFORE / BEHIND) / zero]),
            ..Seen::default()
        }
    }

    /// For a scene of which nothing is known but its near plane, in units of clip-space w: it may lie anywhere from there to infinity.
    pub fn behind(near: f64) -> Self {
        Seen {
            scene: Some([0.0, 1.0 / near]),
            ..Seen::default()
        }
    }

    /// The largest disparities at a separation of 1, behind the panel and before it.
    fn reach(&self, convergence: f64) -> [f64; 2] {
        let scene = self.scene.map(|s| s.map(|inverse| convergence * inverse));
        let ratios = scene.into_iter().chain(self.others).flatten();
        ratios.fold([0.0, 0.0], |[behind, before], ratio| {
            [behind.max(1.0 - ratio), before.max(ratio - 1.0)]
        })
    }
}

/// The cameras of [`crate::config::Camera::Measured`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comfort {
    /// The number that the user has fixed.
    kept: Option<Kept>,
    /// Separation and convergence in force.
    cameras: Option<(f64, f64)>,
    moving: bool,
    /// 1/w of the nearest point of the scene in the last frame.
    near: Option<f64>,
    /// 1/w of the farthest and the nearest point of the foreground that its cameras stand for.
    foreground: Option<[f64; 2]>,
}

impl Comfort {
    /// Before the first frame; `kept` is the number that the user has fixed.
    pub fn new(kept: Option<Kept>) -> Self {
        Comfort {
            kept,
            cameras: None,
            moving: false,
            near: None,
            foreground: None,
        }
    }

    /// What was measured says nothing of the next frame.
    pub fn restart(&mut self) {
        *self = Comfort::new(self.kept);
    }

    /// Separation and convergence after a frame in which `seen` was visible; none before the first scene.
    pub fn track(&mut self, seen: &Seen, limits: &Limits) -> Option<(f64, f64)> {
        let near = seen.scene.map(|[_, near]| near);
        let coming = near.map(|near| coming(self.near.unwrap_or(near), near));
        self.near = near;
        let Some(goal) = self.goal(seen, limits) else {
            return self.cameras;
        };
        let (mut separation, mut convergence) = goal;
        if let Some((s, c)) = self.cameras {
            let apart = |from: f64, to: f64| (to / from).ln();
            let (ds, dc) = (apart(s, separation), apart(c, convergence));
            let most = ds.abs().max(dc.abs());
            // A separation of 0 has no logarithm: the cameras jump.
            if !most.is_finite() {
                self.cameras = Some(goal);
                return self.cameras;
            }
            self.moving = most > if self.moving { ARRIVED } else { SLACK };
            let (step, along) = match self.moving {
                false => (0.0, 0.0),
                true if ds < 0.0 => (INWARDS * ds, ALONG * dc),
                true => (OUTWARDS * ds, ALONG * dc),
            };
            separation = s * step.exp();
            convergence = c * along.exp();
        }
        let budget = limits.budget;
        if let Some(kept) = self.kept_separation(convergence, limits) {
            separation = kept;
        } else {
            let most = |[behind, before]: [f64; 2]| {
                (LIMIT_BEHIND * budget / behind).min(LIMIT_BEFORE * budget / before)
            };
            let [behind, _] = seen.reach(convergence);
            separation = separation.min(LIMIT_BEHIND * budget / behind);
            if let (Some(near), Some(coming)) = (near, coming)
                && !self.keeps_convergence()
            {
                let most = |part: f64, inverse: f64| (1.0 + part * budget / separation) / inverse;
                convergence = convergence
                    .min(most(LIMIT_BEFORE, near))
                    .min(most(LIMIT_COMING, coming));
            }
            separation = separation.min(most(seen.reach(convergence)));
        }
        if separation.is_finite() && convergence.is_finite() {
            self.cameras = Some((separation, convergence));
        }
        self.cameras
    }

    /// Depth of a sky under these cameras, as a part of the separation; 1 is infinitely far.
    pub fn farthest(&self, (separation, _): (f64, f64), budget: f64) -> f64 {
        match self.kept {
            Some(Kept::Separation(_) | Kept::EyeSpacing(_)) => 1.0,
            _ => (LIMIT_BEHIND * budget / separation).min(1.0),
        }
    }

    /// A foreground is seen, with `range` as for [`Comfort::foreground`]. The first time the cameras jump to those of the scene alone: so far it counted as the nearest part of that.
    pub fn see_foreground(&mut self, range: [f64; 2]) {
        if self.foreground.is_none() {
            (self.cameras, self.moving) = (None, false);
            self.foreground = Some(range);
        }
    }

    /// The cameras of what is drawn before everything else, such as the weapon in a player's hand: it stands between the nearest point of the
    /// scene and its part of the budget. None where the cameras of the scene keep it within that, or the user has fixed the separation.
    /// `near` is 1/w of the nearest point of the scene, `range` 1/w of the farthest and the nearest point of the foreground.
    ///
    /// Depths keep their order and get no more disparity than by the cameras of the scene. A weapon is as near as the near plane, so cameras that
    /// kept both within the budget would leave nothing of it to the scene.
    pub fn foreground(&mut self, near: f64, range: [f64; 2], budget: f64) -> Option<(f64, f64)> {
        let (separation, convergence) = self.cameras?;
        if let Some(Kept::Separation(_) | Kept::EyeSpacing(_)) = self.kept {
            return None;
        }
        let like = |(new, old): (f64, f64)| (new / old).ln().abs() < SLACK;
        let pairs = |held: [f64; 2]| range.into_iter().zip(held);
        let [far, nearest] = *match self.foreground {
            Some(ref held) if pairs(*held).all(like) => held,
            _ => self.foreground.insert(range),
        };
        let by_scene = |inverse: f64| separation * (1.0 - convergence * inverse);
        let end = -FOREGROUND * budget;
        if by_scene(nearest) >= end {
            return None;
        }
        // Where its farthest point goes.
        let begin = by_scene(near).clamp(end, 0.0);
        // The disparity is own − slope/w. It is `end` at the nearest point.
        let slope = (begin - end) / (nearest - far).max(f64::EPSILON);
        let slope = slope.min(separation * convergence);
        let own = end + slope * nearest;
        // A separation of 0 has no convergence.
        let own = match own.abs() < 1e-6 * budget {
            true => 1e-6 * budget,
            false => own,
        };
        Some((own, slope / own))
    }

    /// The separation, where the user has fixed it or the spacing of the cameras.
    fn kept_separation(&self, convergence: f64, limits: &Limits) -> Option<f64> {
        let (a, scale) = limits.lens;
        match self.kept {
            Some(Kept::Separation(separation)) => Some(separation),
            Some(Kept::EyeSpacing(spacing)) => Some(a * spacing * scale / convergence),
            _ => None,
        }
    }

    fn keeps_convergence(&self) -> bool {
        matches!(self.kept, Some(Kept::Convergence(_) | Kept::FocalDepth(_)))
    }

    /// Where the cameras would stand if the scene stayed as it is.
    fn goal(&self, seen: &Seen, limits: &Limits) -> Option<(f64, f64)> {
        let (_, scale) = limits.lens;
        let [far, near] = seen.scene?;
        let far = if seen.sky { 0.0 } else { far };
        let convergence = match self.kept {
            Some(Kept::Convergence(w)) => w,
            Some(Kept::FocalDepth(depth)) => depth * scale,
            _ => (BEHIND + BEFORE) / (BEHIND * near + BEFORE * far),
        };
        let separation = self.kept_separation(convergence, limits);
        let separation = separation.unwrap_or_else(|| {
            let [behind, before] = seen.reach(convergence);
            let behind = behind.max(1.0 - convergence * far);
            let most = (BEHIND / behind).min(BEFORE / before);
            let most = most.min(MOST) * limits.budget;
            most.min(limits.orthoscopic)
        });
        (separation.is_finite() && convergence.is_finite() && convergence > 0.0)
            .then_some((separation, convergence))
    }
}

/// 1/w of a point in the next frame if it comes nearer by as much as since the last one, at most to half of its distance. One that goes away is
/// taken to stay. `last` and `now` are its 1/w.
fn coming(last: f64, now: f64) -> f64 {
    now / (2.0 - now / last).clamp(0.5, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits {
        budget: 0.005,
        orthoscopic: 0.05,
        lens: (1.5, 1.0),
    };

    fn scene(near: f64, far: f64) -> Seen {
        Seen {
            scene: Some([1.0 / far, 1.0 / near]),
            ..Seen::default()
        }
    }

    fn disparity((separation, convergence): (f64, f64), w: f64) -> f64 {
        separation * (1.0 - convergence / w)
    }

    #[test]
    fn near_and_far_have_their_parts_of_the_budget() {
        for (near, far) in [(1.0, 10.0), (4.0, 5000.0), (0.1, f64::INFINITY)] {
            let cameras = Comfort::new(None).track(&scene(near, far), &LIMITS);
            let cameras = cameras.expect("cameras");
            let (front, back) = (disparity(cameras, near), disparity(cameras, far));
            assert!((front + BEFORE * LIMITS.budget).abs() < 1e-12);
            assert!((back - BEHIND * LIMITS.budget).abs() < 1e-12);
        }
    }

    #[test]
    fn a_flat_scene_is_not_made_deeper_than_it_is() {
        let separation = |orthoscopic| {
            let limits = Limits {
                orthoscopic,
                ..LIMITS
            };
            let cameras = Comfort::new(None).track(&scene(9.99, 10.01), &limits);
            cameras.map(|c| c.0)
        };
        assert_eq!(separation(0.012), Some(0.012));
        assert_eq!(separation(0.05), Some(MOST * LIMITS.budget));
    }

    #[test]
    fn nothing_leaves_the_budget_when_something_comes_near() {
        let mut comfort = Comfort::new(None);
        comfort.track(&scene(5.0, 100.0), &LIMITS);
        for step in 0..100 {
            let near = 5.0 - 0.049 * f64::from(step);
            let seen = scene(near, 100.0);
            let cameras = comfort.track(&seen, &LIMITS).expect("cameras");
            let [behind, before] = seen.reach(cameras.1).map(|r| cameras.0 * r / LIMITS.budget);
            assert!(behind <= LIMIT_BEHIND + 1e-9 && before <= LIMIT_BEFORE + 1e-9);
            // The scene keeps its depth.
            assert!(
                step < 90 || cameras.0 > 0.7 * LIMITS.budget,
                "{step}: {cameras:?}"
            );
        }
        let weapon = Seen {
            others: Some([0.5, 9.0]),
            ..scene(5.0, 100.0)
        };
        let cameras = Comfort::new(None).track(&weapon, &LIMITS).expect("cameras");
        assert!(cameras.0 * 8.0 <= LIMITS.budget);
    }

    #[test]
    fn what_comes_near_is_met_before_it_is_there() {
        // A wall of gltron, 8 frames a second.
        let walls = [8.2, 8.07, 6.26, 4.08, 2.09];
        let mut comfort = Comfort::new(None);
        for (now, next) in walls.into_iter().zip(&walls[1..]) {
            let cameras = comfort.track(&scene(now, 100.0), &LIMITS).expect("cameras");
            let nearest = disparity(cameras, *next);
            assert!(nearest > -LIMITS.budget, "{now}: {nearest}");
        }
        // From 9 to 8 and on to 7.
        assert!((coming(1.0 / 9.0, 1.0 / 8.0) - 1.0 / 7.0).abs() < 1e-12);
        assert_eq!(coming(1.0 / 9.0, 1.0 / 4.0), 1.0 / 2.0, "half its distance");
        assert_eq!(coming(1.0 / 8.0, 1.0 / 9.0), 1.0 / 9.0, "it goes away");
        comfort.track(&Seen::default(), &LIMITS);
        assert_eq!(comfort.near, None, "nothing was seen that could come");
    }

    #[test]
    fn a_sky_that_appears_is_in_the_budget_before_the_cameras_are() {
        let mut comfort = Comfort::new(None);
        let before = comfort.track(&scene(5.0, 8.0), &LIMITS).expect("cameras");
        assert!(before.0 > LIMITS.budget);
        assert!(before.0 * comfort.farthest(before, LIMITS.budget) <= LIMITS.budget);
        let sky = Seen {
            sky: true,
            ..scene(5.0, 8.0)
        };
        let mut now = before;
        for _ in 0..100 {
            now = comfort.track(&sky, &LIMITS).expect("cameras");
        }
        assert_eq!(comfort.farthest(now, LIMITS.budget), 1.0);
        assert!(now.0 < LIMIT_BEHIND * LIMITS.budget);
    }

    #[test]
    fn a_scene_that_trembles_does_not_move_the_cameras() {
        let mut comfort = Comfort::new(None);
        let first = comfort.track(&scene(5.0, 100.0), &LIMITS);
        for step in 0..200 {
            let near = 5.0 + 0.3 * (f64::from(step) * 0.7).sin();
            assert_eq!(comfort.track(&scene(near, 100.0), &LIMITS), first);
        }
    }

    #[test]
    fn another_scene_is_reached_in_small_steps() {
        let mut comfort = Comfort::new(None);
        let mut before = comfort.track(&scene(1.0, 10.0), &LIMITS).expect("cameras");
        let goal = Comfort::new(None).track(&scene(10.0, 1000.0), &LIMITS);
        for _ in 0..400 {
            let now = comfort
                .track(&scene(10.0, 1000.0), &LIMITS)
                .expect("cameras");
            assert!((now.1 / before.1).ln().abs() < 0.08, "{before:?} {now:?}");
            before = now;
        }
        let goal = goal.expect("cameras");
        assert!((before.0 / goal.0).ln().abs() < SLACK && (before.1 / goal.1).ln().abs() < 0.02);
    }

    /// A weapon at a tenth of the scene's distance leaves the scene its budget, and stands before it.
    #[test]
    fn a_foreground_stands_between_the_scene_and_its_part_of_the_budget() {
        for hand in [[1.0, 5.0], [0.01, 5.0], [0.5, 0.6], [4.9, 5.0]] {
            let mut comfort = Comfort::new(None);
            let scene = comfort.track(&scene(4.0, 100.0), &LIMITS).expect("cameras");
            let own = comfort.foreground(0.25, hand, LIMITS.budget);
            let near = disparity(scene, 4.0);
            if disparity(scene, 1.0 / hand[1]) >= -FOREGROUND * LIMITS.budget {
                assert_eq!(own, None);
                continue;
            }
            let [far, nearest] =
                hand.map(|inverse| disparity(own.expect("cameras"), 1.0 / inverse));
            assert!((nearest + FOREGROUND * LIMITS.budget).abs() < 1e-12);
            assert!(
                nearest < far && far <= near + 1e-12,
                "{hand:?}: {far} {near}"
            );
            let by_scene = hand.map(|inverse| disparity(scene, 1.0 / inverse));
            assert!(far - nearest <= by_scene[0] - by_scene[1] + 1e-12);
            // What trembles moves nothing.
            let trembling = hand.map(|inverse| 1.05 * inverse);
            assert_eq!(comfort.foreground(0.25, trembling, LIMITS.budget), own);
        }
        let mut comfort = Comfort::new(Some(Kept::Separation(0.1)));
        comfort.track(&scene(4.0, 100.0), &LIMITS);
        assert_eq!(comfort.foreground(0.25, [1.0, 5.0], LIMITS.budget), None);
    }

    #[test]
    fn what_the_user_sets_stays() {
        let seen = scene(2.0, 50.0);
        let at = |kept| {
            Comfort::new(Some(kept))
                .track(&seen, &LIMITS)
                .expect("cameras")
        };
        assert_eq!(at(Kept::Separation(0.7)).0, 0.7);
        assert_eq!(at(Kept::Convergence(3.0)).1, 3.0);
        assert_eq!(at(Kept::FocalDepth(3.0)).1, 3.0);
        let (separation, convergence) = at(Kept::EyeSpacing(0.2));
        assert!((separation * convergence - 1.5 * 0.2).abs() < 1e-12);
        let (separation, convergence) = at(Kept::Convergence(3.0));
        let [near, far] =
            [2.0, 50.0].map(|w| disparity((separation, convergence), w) / LIMITS.budget);
        assert!((near + BEFORE).abs() < 1e-12 || (far - BEHIND).abs() < 1e-12);
        assert!(near >= -BEFORE - 1e-12 && far <= BEHIND + 1e-12);
    }

    #[test]
    fn cameras_that_were_nothing_are_left_at_once() {
        let mut comfort = Comfort::new(None);
        let nothing = Limits {
            orthoscopic: 0.0,
            ..LIMITS
        };
        for _ in 0..3 {
            let cameras = comfort.track(&scene(2.0, 50.0), &nothing);
            assert_eq!(cameras.map(|c| c.0), Some(0.0));
        }
        let cameras = comfort.track(&scene(2.0, 50.0), &LIMITS);
        assert_eq!(
            cameras,
            Comfort::new(None).track(&scene(2.0, 50.0), &LIMITS)
        );
    }

    #[test]
    fn without_a_scene_nothing_changes() {
        let mut comfort = Comfort::new(None);
        assert_eq!(comfort.track(&Seen::default(), &LIMITS), None);
        let cameras = comfort.track(&scene(2.0, 50.0), &LIMITS);
        assert_eq!(comfort.track(&Seen::default(), &LIMITS), cameras);
    }

    #[test]
    fn a_scene_without_depths_lies_between_the_planes_of_its_projection() {
        let seen = Seen::by_planes([1.0, 1000.0]);
        let [far, near] = seen.scene.expect("a scene");
        assert_eq!(far, 0.0, "something may be infinitely far");
        assert!((near - (1.0 + BEFORE / BEHIND) / 10.0).abs() < 1e-12);
        let cameras = Comfort::new(None).track(&seen, &LIMITS);
        assert!((cameras.expect("cameras").1 - 10.0).abs() < 1e-9);
    }
}
