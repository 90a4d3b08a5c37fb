//! Decides one command. In: the facts of the command, and the knowledge from earlier ones. Out: a plan, the effects that precede it, and
//! the new knowledge. Calls no GL.
//!
//! Each rule has its file. A rule reads [`Facts`], reads and changes [`Known`], and may ask for a [`Preparation`] where a fact is missing.
#![forbid(unsafe_code)]

mod backdrop;
mod depths;
mod effect;
mod eyes;
mod facts;
mod foreground;
mod grid;
mod known;
mod mono;
mod orthographic;
mod pass;
mod plan;
mod points;
mod scene;
mod shaders;
mod synthesis;
#[cfg(test)]
mod tests;

pub use backdrop::Backdrop;
pub use effect::{Detail, Effect, Preparation};
pub use facts::{
    ClearFacts, Demand, Destination, Facts, GridFacts, Linked, Projections, Rects, Shaders,
    SynthesisFacts, VariantFacts,
};
pub use foreground::Foreground;
pub use grid::retreat;
pub use known::{DepthWatch, Frame, Known, Settings};
pub use mono::{ALL_BUFFERS, Mono};
pub use orthographic::OrthographicWatch;
pub use plan::{Flat, Method, Plan, ReferenceDraw};
pub use scene::{DisparityMapping, Scene};
pub use synthesis::is_over_candidate;

use super::Kind;
use super::class::{Classed, Why};
use crate::config::{Class, Projection, Repetition, Strategy};
use crate::state::Touch;

/// The decision about one command.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// How the command is drawn.
    pub plan: Plan,
    /// The effects to apply before the draw, in this order.
    pub effects: Vec<Effect>,
    /// The knowledge for the next command.
    pub known: Known,
}

/// Decides how a command is drawn.
///
/// # Errors
/// A [`Preparation`] that has to be made first; the command is then observed and decided again. Each is asked for at most once a command.
pub fn decide(facts: &Facts, known: &Known, settings: &Settings) -> Result<Decision, Preparation> {
    let mut known = *known;
    let mut effects = Vec::new();
    if let Some((detail, why)) = grid::demanded(facts) {
        return Err(Preparation::ChangeGrid(detail, why));
    }
    if facts.destination.eyes {
        scene::observe(facts, &mut known, settings);
        return Ok(eyes::decide(facts, known));
    }
    if let Shaders::Unlinked(program) = facts.shaders
        && settings.views > 1
    {
        return Err(Preparation::LinkVariant(program));
    }
    depths::begin(facts, &known, settings)?;
    scene::observe(facts, &mut known, settings);
    depths::watch(facts, &mut known, settings, &mut effects);
    watch_equal_depths(facts, &mut known, settings);
    let plan = plan::of_fixed_function(facts, &known, settings);
    let plan = shaders::plan(facts, &mut known, settings, plan, &mut effects);
    let plan = plan::uncounted(facts, plan);
    let plan = pass::plan(facts, settings, plan)?;
    let plan = points::plan(facts, settings, plan);
    let mut plan = shaders::all_at_once(facts, &known, settings, plan)?;
    synthesis::watch(facts, &mut known, settings, &mut plan, &mut effects);
    mono::watch(facts, &mut known, &plan, &mut effects);
    if let Some(reason) = &plan.reason {
        effects.push(Effect::Fallback(reason.clone()));
    }
    Ok(Decision {
        plan,
        effects,
        known,
    })
}

/// The groups of state that a decision reads, beside those of [`super::Classifier::needs`]. The class is known by then.
pub fn needs(
    kind: Kind,
    classed: &Classed,
    shaders: &Shaders,
    known: &Known,
    settings: &Settings,
) -> Touch {
    let mut needs = Touch::NONE;
    let mut add = |wanted: bool, groups: Touch| {
        if wanted {
            needs = needs | groups;
        }
    };
    let scene = classed.class == Class::Scene;
    let clear = matches!(kind, Kind::Clear { .. } | Kind::Accum);
    let direction = settings.shows_depth && known.frame.nearer_is_larger.is_none();
    add(scene && direction, Touch::RANGE);
    add(
        scene && settings.measures_depths,
        Touch::RANGE | Touch::DEPTH,
    );
    let flat = classed.class == Class::Flat && !clear;
    add(
        flat && settings.measures_depths && known.depths.pending,
        Touch::DEPTH,
    );
    add(!settings.same_depths && !known.replays_all, Touch::DEPTH);
    add(
        classed.why == Why::Slanted || scene && ruled(classed),
        Touch::RANGE | Touch::DEPTH,
    );
    let variant = matches!(shaders, Shaders::Variant(_));
    add(variant && !clear, Touch::DEPTH);
    let synthesises = settings.synthesises && known.scene.is_some() && !clear;
    add(synthesises, Touch::RANGE | Touch::DEPTH | Touch::COVER);
    add(mono::asks_stencil(known), Touch::COVER);
    needs
}

/// Detects programs that draw over their own depths with GL_EQUAL. Some draws are always replayed, such as those of display lists.
/// Instances in layers have exactly the depths of replay; tiles beside each other and geometry shaders do not. So from the first draw
/// with GL_EQUAL on, all draws are replayed. An earlier pass, in the program's first frame, is not drawn again.
fn watch_equal_depths(facts: &Facts, known: &mut Known, settings: &Settings) {
    if !settings.same_depths && !known.replays_all && facts.destination.is_window() {
        known.replays_all = facts.state.equal;
    }
}

/// Whether a strategy draws with exactly the depths of replay. `layers`: the driver can choose layers in a vertex shader; `distances`:
/// the user chose a way of clipping (`--clip`), so the tiles lie beside each other.
pub fn has_depths_of_replay(strategy: Strategy, layers: bool, distances: bool) -> bool {
    match strategy.repetition() {
        Repetition::Calls => true,
        Repetition::Instances => layers && !distances,
        Repetition::GeometryShader => false,
    }
}

/// Whether a command writes whole buffers rather than primitives.
fn is_whole(kind: Kind) -> bool {
    matches!(kind, Kind::Clear { .. } | Kind::Accum)
}

/// Whether a rule of the profile gave a draw its class.
fn ruled(classed: &Classed) -> bool {
    matches!(classed.why, Why::Rule(_))
}

/// Whether a command draws in perspective.
fn is_perspective(facts: &Facts) -> bool {
    facts.traits.projection == Projection::Perspective
}
