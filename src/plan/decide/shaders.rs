//! Draws with the program's own shaders use a variant of them, which shifts the vertices of each view.

use super::{
    Effect, Facts, Flat, Known, Linked, Method, Plan, Preparation, Settings, Shaders, VariantFacts,
};
use crate::config::{Class, DepthState, Strategy};
use crate::plan::class::Why;
use crate::plan::{Kind, Planes};

/// The plan of a draw with the program's own shaders; `plan` is its plan as if by fixed function.
pub(super) fn plan(
    facts: &Facts,
    known: &mut Known,
    settings: &Settings,
    plan: Plan,
    effects: &mut Vec<Effect>,
) -> Plan {
    let kind = facts.traits.kind;
    let fragments = matches!(kind, Kind::Clear { .. } | Kind::Pixels | Kind::Accum);
    if plan.method == Method::Once || fragments || settings.views < 2 {
        return plan;
    }
    let Shaders::Variant(variant) = &facts.shaders else {
        return plan;
    };
    let camera = variant.camera.or(known.camera);
    if facts.slants() && (camera.is_none() || facts.classed.why == Why::Slanted) {
        let planes = Planes::of(&facts.state);
        return Plan {
            shear: known.rig.orthographic(&facts.projections.matrix, &planes),
            variant: true,
            ..plan
        };
    }
    // Another program's camera is good for this one too.
    let measures = variant.unmeasured
        && (known.camera.is_none() || variant.camera.is_some())
        && is_measurable(facts);
    let plan = Plan { measures, ..plan };
    let Some(camera) = camera else {
        // Menus and other flat draws need none. A sky by the rays of its fragments takes that of the scene, after the first frame.
        if facts.state.depth != DepthState::Off && !facts.unprojects() {
            effects.push(Effect::NoCamera(variant.program));
        }
        return plan;
    };
    known.camera = Some(camera);
    known.rig.latch(&camera);
    let ruled = matches!(facts.classed.why, Why::Rule(_));
    let hud = plan.shear.map_or(Flat::Still, Flat::By);
    let (class, shear, flat) = match facts.classed.class {
        Class::Flat if ruled => (Class::Flat, plan.shear, hud),
        Class::Sky => {
            let shear = known.rig.sky(&camera);
            // A vertex of a box around the eye may have a w of 1. All of a picture without a perspective has.
            let flat = match variant.camera {
                Some(_) if !variant.lost => shear.map_or(Flat::Still, Flat::By),
                _ => Flat::Still,
            };
            (Class::Sky, shear, flat)
        }
        class => {
            let shear = super::plan::of_scene(&facts.classed, &known.rig, &camera);
            let flat = match class {
                Class::Flat => hud,
                _ if fills_depths(facts, variant) => Flat::Scene,
                _ => Flat::Still,
            };
            (Class::Scene, shear, flat)
        }
    };
    Plan {
        class,
        shear,
        variant: true,
        flat,
        ..plan
    }
}

/// Whether the w of a draw's vertices tells how the program sees the scene: it tests depths and is shown, and nothing counts or writes its vertices.
fn is_measurable(facts: &Facts) -> bool {
    facts.state.depth != DepthState::Off
        && facts.traits.target.is_shown()
        && matches!(
            facts.traits.kind,
            Kind::Begin(_) | Kind::Arrays(_) | Kind::Elements(_) | Kind::Other
        )
        && !facts.unprojects()
        && !facts.counted
}

/// Whether a draw with a w of 1 belongs to the scene: the program has a perspective at present, and the draw tests and writes depth. A draw
/// that fills the screen does not write depth.
fn fills_depths(facts: &Facts, variant: &VariantFacts) -> bool {
    facts.state.depth == DepthState::On && !variant.lost
}

/// Turns the replay of a variant into one instanced draw for all views, where possible. Not where each view samples a texture of its own, or
/// a query counts the draw.
pub(super) fn all_at_once(
    facts: &Facts,
    known: &Known,
    settings: &Settings,
    plan: Plan,
) -> Result<Plan, Preparation> {
    let Shaders::Variant(variant) = &facts.shaders else {
        return Ok(plan);
    };
    let wanted = settings.strategy == Strategy::Instanced
        && plan.variant
        && plan.method == Method::Replay
        && matches!(facts.traits.kind, Kind::Arrays(_) | Kind::Elements(_))
        && !facts.reads_views
        && !facts.unprojects()
        && !facts.counted
        && !known.replays_all;
    if !wanted || !facts.destination.layered || variant.divides {
        return Ok(plan);
    }
    match variant.to_layers {
        Linked::Untried => Err(Preparation::LinkLayers {
            program: variant.program,
            all: true,
        }),
        Linked::Refused => Ok(plan),
        Linked::Yes => Ok(Plan {
            method: Method::Instanced,
            reason: None,
            ..plan
        }),
    }
}
