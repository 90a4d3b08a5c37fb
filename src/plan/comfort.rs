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
/// The nearest point of two frames is at about the same distance where the logarithms differ by less: half as far, or twice.
const ALIKE: f64 = std::f64::consts::LN_2;
/// Frames with a scene after which the cameras jump to it, whether or not two of them were alike: two windows in turn never are.
const PATIENCE: u8 = 8;

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
    /// The cameras wait for so many more frames with a scene, at most. Before that they jump to the scene once its nearest point is at about the
    /// same distance in two frames in a row: a world that is still being loaded may show nothing but its clouds, or the player's hand.
    waits: u8,
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
            waits: PATIENCE,
            near: None,
            foreground: None,
        }
    }

    /// Separation and convergence for `seen`, without waiting for a second frame.
    pub fn at_once(kept: Option<Kept>, seen: &Seen, limits: &Limits) -> Option<(f64, f64)> {
        let mut comfort = Comfort::new(kept);
        comfort.waits = 0;
        comfort.track(seen, limits)
    }

    /// What was measured says nothing of the next frame.
    pub fn restart(&mut self) {
        *self = Comfort::new(self.kept);
    }

    /// Separation and convergence after a frame in which `seen` was visible; none before two frames with about the same scene.
    pub fn track(&mut self, seen: &Seen, limits: &Limits) -> Option<(f64, f64)> {
        let near = seen.scene.map(|[_, near]| near);
        let last = std::mem::replace(&mut self.near, near);
        let coming = near.map(|near| coming(last.unwrap_or(near), near));
        if self.waits > 0 {
            self.waits -= u8::from(near.is_some());
            let both = last.zip(near);
            let alike = both.is_some_and(|(last, near)| (near / last).ln().abs() < ALIKE);
            if alike || self.waits == 0 {
                (self.cameras, self.moving, self.waits) = (None, false, 0);
            } else if self.cameras.is_none() {
                return None;
            }
        }
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

    /// Takes cameras for a scene that is not measured.
    pub fn assume(&mut self, seen: &Seen, limits: &Limits) -> Option<(f64, f64)> {
        self.cameras = Comfort::at_once(self.kept, seen, limits);
        self.cameras
    }

    /// A foreground is seen, with `range` as for [`Comfort::foreground`]. From the first time on the cameras wait to jump to those of the scene alone: so far it counted as the nearest part of that.
    pub fn see_foreground(&mut self, range: [f64; 2]) {
        if self.foreground.is_none() {
            self.waits = PATIENCE;
            self.foreground = Some(range);
        }
    }

    /// The cameras of what is drawn before everything else, such as the weapon in a player's hand: it stands between the nearest point of the
    /// scene and its part of the budget. None where the cameras of the scene do that by themselves, or the user has fixed the separation.
    /// `near` is 1/w of the nearest point of the scene, `range` 1/w of the farthest and the nearest point of the foreground.
    ///
    /// Depths keep their order and get no more disparity than by the cameras of the scene. A weapon is as near as the near plane, so cameras that
    /// kept both within the budget would leave nothing of it to the scene. One that is farther than what it covers would stand behind it.
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
        if by_scene(nearest) >= end && far >= near {
            return None;
        }
        // Where its farthest point goes.
        let behind = far < near;
        let begin = match behind {
            true => by_scene(near).max(end),
            false => by_scene(near).clamp(end, by_scene(far).max(0.0)),
        };
        // The disparity is own − slope/w. Where the slope would be more than that of the scene, one end keeps its place.
        let slope = (begin - end) / (nearest - far).max(f64::EPSILON);
        let slope = slope.min(separation * convergence);
        let own = match behind {
            true => begin + slope * far,
            false => end + slope * nearest,
        };
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
mod tests;
