//! The scene: what is drawn in perspective, and, where views are synthesised, what belongs to one picture with depths.

use super::{Facts, Known, Settings, is_perspective, is_whole};
use crate::config::{Class, DepthRange, DepthState};
use crate::plan::class::Target;
use crate::plan::{Ramp, Shear};

/// What has been drawn to some views since their depths were cleared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scene {
    /// What it is projected by.
    pub mapping: Option<DisparityMapping>,
    /// What stands before everything, by the same projection in a part of the depth range, and up to which depth.
    pub before: Option<(DisparityMapping, f64)>,
    /// Something stands infinitely far behind it.
    pub sky: bool,
    /// Something else than a clear has been drawn.
    pub begun: bool,
    /// The depth of what nothing is drawn on.
    pub clear: f32,
    /// It has been shown, and no other view has it.
    pub shown: bool,
}

/// How depths become disparities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisparityMapping {
    /// From depths to distances.
    pub ramp: Ramp,
    /// From distances to the shift of a view.
    pub shear: Shear,
    /// x, y, width, height in the window, in pixels.
    pub viewport: [i32; 4],
}

impl DisparityMapping {
    fn is_like(&self, other: &DisparityMapping) -> bool {
        self.ramp.is_like(&other.ramp)
            && self.viewport == other.viewport
            && self.shear.conv == other.shear.conv
            && self.shear.separation(1.0) == other.shear.separation(1.0)
    }

    /// Pixels by which a camera one place further sees what is infinitely far to the side.
    pub fn far(&self) -> f64 {
        self.shear.separation(1.0) * f64::from(self.viewport[2]) / 2.0
    }

    /// Disparities over depths, in pixels for one place: slope and offset.
    pub fn line(&self) -> [f64; 2] {
        let size = self.far().abs() * self.shear.conv;
        self.ramp.line().map(|v| size * v)
    }
}

impl Scene {
    /// Whether what is projected so belongs to it.
    pub fn takes(&mut self, new: DisparityMapping) -> bool {
        let known = self.mapping.get_or_insert(new);
        if known.is_like(&new) {
            return true;
        }
        let first = *known;
        if let Some((before, _)) = self.before {
            return before.is_like(&new);
        }
        if first.viewport != new.viewport
            || first.shear.separation(1.0) != new.shear.separation(1.0)
        {
            return false;
        }
        // Either may come first.
        self.before = match (first.ramp.beyond(&new.ramp), new.ramp.beyond(&first.ramp)) {
            (Some(depth), _) => Some((new, depth)),
            (_, Some(depth)) => {
                self.mapping = Some(new);
                Some((first, depth))
            }
            _ => None,
        };
        self.before.is_some()
    }
}

/// Takes note of what a command tells of the frame and its camera.
pub(super) fn observe(facts: &Facts, known: &mut Known, settings: &Settings) {
    let clear = is_whole(facts.traits.kind);
    let shown = matches!(facts.traits.target, Target::Window | Target::Pass(_));
    known.lens = facts.projections.lens.or(known.lens);
    known.frame.draws = facts.traits.draw;
    if shown {
        let behind = facts.traits.range == DepthRange::Far;
        if clear {
            known.frame.deep = false;
        } else if is_perspective(facts) && facts.traits.first && !behind {
            known.frame.deep = facts.traits.depth_state == DepthState::On;
        }
    }
    if facts.classed.class != Class::Scene {
        return;
    }
    known.rig.latch(&facts.projections.fixed);
    if settings.shows_depth && known.frame.nearer_is_larger.is_none() {
        let ramp = Ramp::of(
            &facts.projections.matrix,
            facts.state.depths,
            facts.state.zero_to_one,
        );
        known.frame.nearer_is_larger = ramp.map(|ramp| ramp.nearer_is_larger());
    }
}
