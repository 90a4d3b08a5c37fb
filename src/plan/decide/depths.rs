//! When depths are captured: those of the scene, before a clear or a flat draw overwrites them.

use super::{DepthWatch, Effect, Facts, Known, Preparation, Rects, Settings};
use crate::config::{Class, DepthState, Viewport};
use crate::plan::Kind;

fn looked_at(facts: &Facts, settings: &Settings) -> bool {
    // Depths of framebuffers that are no part of the window's picture do not count.
    settings.measures_depths && facts.traits.target.is_shown() && facts.destination.picture
}

/// Asks for the depths of the last frame to be measured before the first command of a frame.
pub(super) fn begin(facts: &Facts, known: &Known, settings: &Settings) -> Result<(), Preparation> {
    match looked_at(facts, settings) && !known.depths.begun {
        true => Err(Preparation::MeasureDepths),
        false => Ok(()),
    }
}

/// Updates the knowledge of depths from a command, and asks for a capture before it where it would overwrite them.
pub(super) fn watch(
    facts: &Facts,
    known: &mut Known,
    settings: &Settings,
    effects: &mut Vec<Effect>,
) {
    if !looked_at(facts, settings) {
        return;
    }
    let depths = &mut known.depths;
    let elsewhere = facts.destination.framebuffer != depths.framebuffer;
    match (facts.traits.kind, facts.classed.class) {
        (Kind::Accum | Kind::Clear { depths: false, .. }, _) | (_, Class::OffScreen) => {}
        (Kind::Clear { .. }, _) if elsewhere => {}
        (Kind::Clear { .. }, _) => {
            take(depths, effects);
            // With a scissor only a part of the window is cleared; the depths of the rest stay valid.
            if facts.rects.scissor.is_none() {
                depths.overwritten = false;
                effects.push(Effect::ForgetDepths);
            }
        }
        (_, Class::Sky) => effects.push(Effect::MapSky),
        (_, Class::Flat) => {
            if depths.pending && !elsewhere && facts.state.depth == DepthState::On {
                take(depths, effects);
                depths.overwritten = true;
            }
        }
        (_, Class::Scene) => map(facts, depths, effects),
    }
}

/// Asks for the depths of the scene so far to be captured, unless that was done or something has spoilt them.
fn take(depths: &mut DepthWatch, effects: &mut Vec<Effect>) {
    if depths.pending && !depths.overwritten {
        depths.pending = false;
        effects.push(Effect::TakeDepths);
    }
}

/// A draw of the scene: notes its projection, and its mapping where it writes depths.
fn map(facts: &Facts, depths: &mut DepthWatch, effects: &mut Vec<Effect>) {
    let viewport = facts.traits.viewport;
    if viewport == Viewport::Main && facts.traits.kind != Kind::Pixels {
        depths.projection = Some(facts.scene_projection());
    }
    let Some(ramp) = facts.ramp().filter(|_| facts.state.depth == DepthState::On) else {
        return;
    };
    let framebuffer = facts.destination.framebuffer;
    if framebuffer != depths.framebuffer {
        // The scene goes on elsewhere, with depths of its own.
        take(depths, effects);
        effects.push(Effect::ForgetDepths);
        (depths.framebuffer, depths.pending, depths.overwritten) = (framebuffer, false, false);
        depths.area = [0; 4];
    }
    if viewport == Viewport::Main {
        depths.pending = true;
        depths.area = joined(depths.area, drawn_to(&facts.rects));
    }
    effects.push(Effect::MapDepths {
        ramp,
        projection: facts.scene_projection(),
        focal: facts.classed.focal,
        foreground: facts.classed.is_foreground(),
        viewport,
    });
}

/// The rectangle that draws are limited to: left, bottom, right, top.
fn drawn_to(rects: &Rects) -> [i32; 4] {
    let corners =
        |[x, y, width, height]: [i32; 4]| [x, y, x.saturating_add(width), y.saturating_add(height)];
    let [left, bottom, right, top] = corners(rects.viewport);
    match rects.scissor.map(corners) {
        None => [left, bottom, right, top],
        Some([l, b, r, t]) => [left.max(l), bottom.max(b), right.min(r), top.min(t)],
    }
}

/// The rectangle around two; one without an inside does not count.
fn joined(one: [i32; 4], other: [i32; 4]) -> [i32; 4] {
    let empty = |[left, bottom, right, top]: [i32; 4]| left >= right || bottom >= top;
    match (empty(one), empty(other)) {
        (true, _) => other,
        (_, true) => one,
        _ => [
            one[0].min(other[0]),
            one[1].min(other[1]),
            one[2].max(other[2]),
            one[3].max(other[3]),
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rectangle_of_a_scene_is_around_all_of_its_draws() {
        let rects = |viewport, scissor| Rects {
            viewport,
            scissor,
            window: [100, 50],
        };
        let left = drawn_to(&rects([0, 10, 30, 20], None));
        assert_eq!(left, [0, 10, 30, 30]);
        let right = drawn_to(&rects([0, 0, 100, 50], Some([40, 20, 200, 20])));
        assert_eq!(right, [40, 20, 100, 40]);
        assert_eq!(joined(left, right), [0, 10, 100, 40]);
        // Nothing was drawn there.
        let outside = drawn_to(&rects([0, 0, 10, 10], Some([20, 0, 5, 5])));
        for all in [
            joined(left, outside),
            joined([0; 4], left),
            joined(left, [0; 4]),
        ] {
            assert_eq!(all, left);
        }
    }
}
