//! Draws that sample or draw to images that are split into one per view: they are replayed. A framebuffer is split when a draw that depends
//! on the view goes to it.

use super::{Facts, Flat, Linked, Method, Plan, Preparation, Settings, Shaders, is_whole};
use crate::config::Class;
use crate::plan::reason::{Reason, Replayed};

/// Adapts a plan to the images that the draw reads and to the framebuffer that it goes to.
pub(super) fn plan(facts: &Facts, settings: &Settings, plan: Plan) -> Result<Plan, Preparation> {
    let destination = &facts.destination;
    if settings.views < 2 || !destination.picture {
        return Ok(plan);
    }
    let mut plan = plan;
    if facts.reads_views {
        // The image of a view is drawn at the same place in that view, without a shift.
        if plan.flat != Flat::Scene {
            plan.flat = Flat::Still;
        }
        if plan.class == Class::Flat {
            plan.shear = None;
        }
        if matches!(plan.method, Method::Instanced | Method::Geometry) {
            plan.method = Method::Replay;
            plan.reason = Some(Reason::Replayed(Replayed::SplitTexture));
        }
    }
    if destination.framebuffer.is_zero() {
        return Ok(plan);
    }
    let whole = is_whole(facts.traits.kind);
    let depends = plan.method != Method::Once && !whole && plan.shear.is_some();
    let split = match (
        facts.reads_views || depends || destination.differs,
        destination.split,
    ) {
        (true, Linked::Untried) => return Err(Preparation::Split(destination.framebuffer)),
        (wanted, split) => wanted && split == Linked::Yes,
    };
    if split
        && plan.variant
        && destination.layered
        && let Shaders::Variant(variant) = facts.shaders
        && variant.to_layer == Linked::Untried
    {
        return Err(Preparation::LinkLayers {
            program: variant.program,
            all: false,
        });
    }
    plan.method = if split { Method::Replay } else { Method::Once };
    plan.reason = None;
    Ok(plan)
}
