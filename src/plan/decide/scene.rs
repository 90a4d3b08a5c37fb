//! The scene: draws in perspective and, where views are synthesised, the draws that share one depth image.

use super::{Facts, Known, Settings, is_perspective, is_whole};
use crate::config::{Class, DepthState};
use crate::plan::{Kind, Ramp, Shear};

/// The scene that has been drawn to some views since their depths were cleared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scene {
    /// Its mapping from depths to disparities; none before the first draw in perspective.
    pub mapping: Option<DisparityMapping>,
    /// The mapping of objects before everything else, such as a weapon in the hand, which use a part of the depth range; and the depth up to
    /// which it holds.
    pub before: Option<(DisparityMapping, f64)>,
    /// It has a sky, infinitely far behind it.
    pub sky: bool,
    /// Shift of that sky, in pixels, for a camera one place further; none where it is the same in all views.
    pub sky_motion: Option<f64>,
    /// Something has been drawn since the clear.
    pub begun: bool,
    /// The depth of pixels on which nothing is drawn.
    pub clear: f32,
    /// It has been shown at a swap, and no other view was synthesised from it in the atlas.
    pub shown: bool,
}

/// The mapping from window depths to disparities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisparityMapping {
    /// The mapping from depths to distances.
    pub ramp: Ramp,
    /// The mapping from distances to the shift of a view.
    pub shear: Shear,
    /// The viewport in the window: x, y, width, height in pixels.
    pub viewport: [i32; 4],
}

impl DisparityMapping {
    fn is_like(&self, other: &DisparityMapping) -> bool {
        self.ramp.is_like(&other.ramp)
            && self.viewport == other.viewport
            && self.shear.conv == other.shear.conv
            && self.shear.separation(1.0) == other.shear.separation(1.0)
    }

    /// Shift of an infinitely far point, in pixels, for a camera one place further.
    pub fn far(&self) -> f64 {
        far(&self.shear, self.viewport)
    }

    /// Disparity towards the viewer, from where an infinitely far point of the scene is shown, over window depth, in pixels for one place:
    /// slope and offset. `scene` is the mapping of the scene that this is a part of.
    pub fn line(&self, scene: &DisparityMapping) -> [f64; 2] {
        let (far, of_scene) = (self.far(), scene.far());
        let [slope, offset] = self.ramp.line().map(|v| far * self.shear.conv * v);
        [slope, offset + of_scene - far].map(|v| v * of_scene.signum())
    }
}

/// Shift of an infinitely far point, in pixels of a viewport, for a camera one place further.
fn far(shear: &Shear, [_, _, width, _]: [i32; 4]) -> f64 {
    shear.separation(1.0) * f64::from(width) / 2.0
}

impl Scene {
    /// Adds a sky that is drawn with this shift in this viewport.
    pub(super) fn add_sky(&mut self, shear: Option<&Shear>, viewport: [i32; 4]) {
        self.sky = true;
        let motion = shear.map(|shear| far(shear, viewport));
        self.sky_motion = self.sky_motion.or(motion);
    }

    /// Shift of an infinitely far point, in pixels, for a camera one place further; none where all views show the same.
    pub fn motion(&self) -> Option<f64> {
        self.mapping
            .map_or(self.sky_motion, |mapping| Some(mapping.far()))
    }

    /// Disparity over window depth, in pixels for one place: slope and offset (see [`DisparityMapping::line`]). A sky alone has none.
    pub fn line(&self) -> [f64; 2] {
        self.mapping
            .map_or([0.0; 2], |mapping| mapping.line(&mapping))
    }

    /// Whether a sky has been drawn, and nothing that has a place.
    pub(super) fn is_sky_alone(&self) -> bool {
        self.sky && self.mapping.is_none()
    }

    /// Whether a draw with this mapping belongs to the scene. The first mapping becomes that of the scene.
    pub fn takes(&mut self, new: DisparityMapping) -> bool {
        let known = self.mapping.get_or_insert(new);
        if known.is_like(&new) {
            return true;
        }
        let first = *known;
        if let Some((before, _)) = self.before {
            return before.is_like(&new);
        }
        if first.viewport != new.viewport {
            return false;
        }
        // The weapon's draw may come before or after the rest.
        self.before = match (
            first.ramp.nearer_part(&new.ramp),
            new.ramp.nearer_part(&first.ramp),
        ) {
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

/// Updates the knowledge of the frame and its camera from a command.
pub(super) fn observe(facts: &Facts, known: &mut Known, settings: &Settings) {
    let clear = is_whole(facts.traits.kind);
    let shown = facts.traits.target.is_shown();
    known.lens = facts.projections.lens.or(known.lens);
    known.frame.draws = facts.traits.draw;
    known.frame.backdrop.observe(facts);
    known.frame.foreground.observe(facts);
    known.frame.orthographic.observe(facts);
    if shown {
        let behind = facts.classed.class == Class::Sky;
        if let Kind::Clear { depths: true, .. } = facts.traits.kind {
            known.frame.clears += 1;
            known.frame.draws_before_clear = known.frame.draws;
        }
        if clear {
            known.frame.wrote_depth = false;
        } else if is_perspective(facts) && facts.traits.first && !behind {
            known.frame.wrote_depth = facts.traits.depth_state == DepthState::On;
        }
    }
    if facts.classed.class != Class::Scene {
        return;
    }
    known.rig.latch(&facts.projections.fixed);
    if settings.shows_depth && known.frame.nearer_is_larger.is_none() {
        let ramp = facts.ramp();
        known.frame.nearer_is_larger = ramp.map(|ramp| ramp.nearer_is_larger());
    }
}
