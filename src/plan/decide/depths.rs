//! When depths are captured: those of the scene, before a clear or a flat draw overwrites them.

use super::{DepthWatch, Effect, Facts, Known, Preparation, Settings};
use crate::config::{Class, DepthState, Viewport};
use crate::plan::class::Target;
use crate::plan::{Kind, Ramp};

fn looked_at(facts: &Facts, settings: &Settings) -> bool {
    // Depths of framebuffers that are no part of the window's picture do not count.
    let shown = matches!(facts.traits.target, Target::Window | Target::Pass(_));
    settings.measures_depths && shown && facts.destination.picture
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
        depths.projection = Some(facts.projections.scene);
    }
    let ramp = Ramp::of(
        &facts.projections.matrix,
        facts.state.depths,
        facts.state.zero_to_one,
    );
    let Some(ramp) = ramp.filter(|_| facts.state.depth == DepthState::On) else {
        return;
    };
    let framebuffer = facts.destination.framebuffer;
    if framebuffer != depths.framebuffer {
        // The scene goes on elsewhere, with depths of its own.
        take(depths, effects);
        effects.push(Effect::ForgetDepths);
        (depths.framebuffer, depths.pending, depths.overwritten) = (framebuffer, false, false);
    }
    depths.pending |= viewport == Viewport::Main;
    effects.push(Effect::MapDepths {
        ramp,
        projection: facts.projections.scene,
        focal: facts.classed.focal,
        foreground: facts.classed.is_foreground(),
        viewport,
    });
}
