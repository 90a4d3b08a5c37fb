//! When depths are captured: those of the scene, before a clear or a flat draw overwrites them.

use super::{Effect, Facts, Known, Preparation, Settings};
use crate::config::{Class, DepthState, Viewport};
use crate::plan::{Kind, Ramp};

fn looked_at(facts: &Facts, settings: &Settings) -> bool {
    // Depths of other framebuffers do not belong to the window's picture.
    settings.measures_depths && facts.destination.is_window()
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
    let take = |depths: &mut super::DepthWatch, effects: &mut Vec<Effect>| {
        if depths.pending && !depths.overwritten {
            depths.pending = false;
            effects.push(Effect::TakeDepths);
        }
    };
    match (facts.traits.kind, facts.classed.class) {
        (Kind::Accum | Kind::Clear { depths: false, .. }, _) | (_, Class::OffScreen) => {}
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
            if depths.pending && facts.state.depth == DepthState::On {
                take(depths, effects);
                depths.overwritten = true;
            }
        }
        (kind, Class::Scene) => {
            let viewport = facts.traits.viewport;
            if viewport == Viewport::Main && kind != Kind::Pixels {
                depths.projection = Some(facts.projections.scene);
            }
            if facts.state.depth != DepthState::On {
                return;
            }
            let ramp = Ramp::of(
                &facts.projections.matrix,
                facts.state.depths,
                facts.state.zero_to_one,
            );
            if let Some(ramp) = ramp {
                depths.pending |= viewport == Viewport::Main;
                effects.push(Effect::MapDepths {
                    ramp,
                    projection: facts.projections.scene,
                    focal: facts.classed.focal,
                    viewport,
                });
            }
        }
    }
}
