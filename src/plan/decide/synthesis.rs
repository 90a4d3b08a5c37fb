//! Which draws belong to a scene that is drawn to some views only. Before any other draw, the other views are synthesised.

use super::{DisparityMapping, Effect, Facts, Known, Method, Plan, ReferenceDraw, Scene};
use super::{Settings, Shaders};
use crate::config::{Class, DepthState, Viewport};
use crate::gl::{TextureName, consts as c};
use crate::plan::class::Why;
use crate::plan::reason::{Hindrance, NotOfScene, Reason};
use crate::plan::{Kind, Ramp};

/// Decides, for a planned command, whether it belongs to the scene. If not, the other views are synthesised before it.
pub(super) fn watch(
    facts: &Facts,
    known: &mut Known,
    settings: &Settings,
    plan: &mut Plan,
    effects: &mut Vec<Effect>,
) {
    let drawn = plan.method != Method::Once && facts.destination.is_window();
    if settings.synthesises && plan.method != Method::Once {
        report_hindrance(facts, known, effects);
    }
    if !settings.synthesises || !drawn {
        return;
    }
    if let Kind::Clear { depths, whole } = facts.traits.kind {
        // Synthesis does not use stencils.
        if depths || whole != c::STENCIL_BUFFER_BIT {
            clear(facts, known, whole, effects);
        }
        return;
    }
    let Some(mut scene) = known.scene else {
        return;
    };
    match belongs(facts, plan, &mut scene, effects) {
        Ok(mapping) => {
            scene.begun = true;
            known.scene = Some(scene);
            let rays = mapping.zip(facts.synthesis.reference);
            let of = scene.mapping.as_ref();
            plan.reference = rays
                .and_then(|(mapping, map)| reference(facts, &mapping, of.unwrap_or(&mapping), map));
        }
        Err(what) => {
            effects.push(Effect::Fallback(Reason::SynthesisedBefore(what)));
            synthesise(known, effects);
        }
    }
}

/// Reports why a draw of the scene is made in each view, where no scene to synthesise from has begun in this frame.
fn report_hindrance(facts: &Facts, known: &Known, effects: &mut Vec<Effect>) {
    let begun = known.scene.is_some() || known.synthesised;
    let hindrance = match facts.destination.is_window() {
        true if begun => return,
        true => known.frame.hindrance,
        false => Hindrance::Framebuffer,
    };
    if facts.is_main_scene() && hindrance != Hindrance::Unwanted {
        effects.push(Effect::Fallback(Reason::NotSynthesised(hindrance)));
    }
}

fn synthesise(known: &mut Known, effects: &mut Vec<Effect>) {
    if known.scene.take().is_some() {
        known.synthesised = true;
        effects.push(Effect::SynthesiseViews);
    }
}

/// A clear begins a scene, or ends it.
fn clear(facts: &Facts, known: &mut Known, whole: u32, effects: &mut Vec<Effect>) {
    let writes =
        |buffer: u32| whole & facts.clear.writable & buffer != 0 && facts.clear.unscissored;
    let all = writes(c::DEPTH_BUFFER_BIT);
    let colours = writes(c::COLOR_BUFFER_BIT);
    // The depths of a sky. Its picture stays, and is behind everything, as that of a sky without depths.
    if let Some(scene) = known.scene
        && scene.is_sky_alone()
        && !scene.shown
        && all
        && !colours
        && facts.clear.depth == scene.clear
    {
        return;
    }
    if let Some(scene) = known.scene
        && scene.begun
        && !((all || colours) && scene.shown)
    {
        effects.push(Effect::Fallback(Reason::SynthesisedBefore(
            NotOfScene::Clear,
        )));
        return synthesise(known, effects);
    }
    if !all || known.synthesised {
        return;
    }
    // Without a clear of colours, the last picture stays visible. The other views do not have it, nor has a view that is drawn for the
    // first time.
    if let Some(hindrance) = facts.synthesis.hindrance {
        known.frame.hindrance = hindrance;
        return synthesise(known, effects);
    }
    if !colours && facts.synthesis.adds_views {
        return synthesise(known, effects);
    }
    // The last picture is cleared, so the other views need no copy of it.
    if std::mem::take(&mut known.mono.active) {
        effects.push(Effect::LeaveMono);
    }
    known.scene = Some(Scene {
        clear: facts.clear.depth,
        ..Scene::default()
    });
    effects.push(Effect::BeginScene {
        depth: facts.clear.depth,
    });
}

/// Whether a draw may be another pass over the last surface, so that its vertices have to be compared with that.
pub fn is_over_candidate(facts: &Facts) -> bool {
    let state = &facts.state;
    let shown = state.depth == DepthState::On && !state.blends;
    facts.classed.class == Class::Scene && !shown && !state.equal && state.depth != DepthState::Off
}

/// The mapping of a draw that belongs to the scene, if it has depths.
///
/// # Errors
/// Why the draw does not belong to the scene.
fn belongs(
    facts: &Facts,
    plan: &Plan,
    scene: &mut Scene,
    effects: &mut Vec<Effect>,
) -> Result<Option<DisparityMapping>, NotOfScene> {
    let (kind, depth) = (facts.traits.kind, facts.state.depth);
    let no = Err;
    if facts.state.stencil {
        return no(NotOfScene::Stencil);
    }
    if facts.state.stipple {
        return no(NotOfScene::Stipple);
    }
    if matches!(kind, Kind::Accum | Kind::Pixels) || facts.reads_views {
        return no(NotOfScene::Pixels);
    }
    if facts.traits.viewport != Viewport::Main {
        return no(NotOfScene::PictureInPicture);
    }
    match plan.class {
        // Those of a backdrop are cleared, and the far end is where the clear has put all.
        Class::Sky
            if depth == DepthState::On
                && !matches!(facts.classed.why, Why::Backdrop | Why::FarEnd) =>
        {
            no(NotOfScene::SkyWithDepths)
        }
        Class::Sky if depth == DepthState::Off && scene.mapping.is_some() => {
            no(NotOfScene::SkyOverScene)
        }
        Class::Sky => {
            scene.add_sky(plan.shear.as_ref(), facts.rects.viewport);
            Ok(None)
        }
        Class::Flat if scene.mapping.is_some() => no(NotOfScene::Flat),
        Class::Flat if plan.shear.is_some() || depth == DepthState::On => {
            no(NotOfScene::FlatElsewhere)
        }
        Class::Flat | Class::OffScreen => Ok(None),
        // A sky by the rays of its fragments. It may write depths: those of the far end, since the scene is drawn over it.
        Class::Scene if facts.unprojects() && scene.mapping.is_none() => {
            scene.add_sky(plan.shear.as_ref(), facts.rects.viewport);
            Ok(None)
        }
        Class::Scene if facts.unprojects() => no(NotOfScene::Rays),
        Class::Scene => of_scene(facts, plan, scene, effects).map(Some),
    }
}

fn of_scene(
    facts: &Facts,
    plan: &Plan,
    scene: &mut Scene,
    effects: &mut Vec<Effect>,
) -> Result<DisparityMapping, NotOfScene> {
    let shear = plan.shear.ok_or(NotOfScene::NoParallax)?;
    let state = &facts.state;
    if facts.slants() {
        return Err(NotOfScene::Orthographic);
    }
    let ramp = Ramp::of(&facts.projections.matrix, state.depths, state.zero_to_one);
    let ramp = ramp.ok_or(NotOfScene::NoDepths)?;
    let shown = state.depth == DepthState::On && !state.blends;
    // Another pass over the last surface has the depths of that surface.
    let over = state.depth != DepthState::Off && facts.synthesis.over_last;
    if !shown && !state.equal && !over {
        return Err(match state.blends {
            true => NotOfScene::Transparent,
            false => NotOfScene::WithoutDepths,
        });
    }
    if shown {
        effects.push(Effect::CaptureSurface);
    }
    let new = DisparityMapping {
        ramp,
        shear,
        viewport: facts.rects.viewport,
    };
    match scene.takes(new) {
        true => Ok(new),
        false if facts.classed.focal.is_some() => Err(NotOfScene::OwnFocalDepth),
        false => Err(NotOfScene::OtherProjection),
    }
}

/// How a draw is repeated in the reference image: fixed-function surfaces, and any draw with the program's own shaders.
/// `scene` is the mapping of the whole scene.
fn reference(
    facts: &Facts,
    mapping: &DisparityMapping,
    scene: &DisparityMapping,
    map: TextureName,
) -> Option<ReferenceDraw> {
    let kind = facts.traits.kind;
    let mode = match kind {
        Kind::Begin(mode) | Kind::Arrays(mode) | Kind::Elements(mode) => Some(mode),
        Kind::Other | Kind::List => None,
        _ => return None,
    };
    // Whether a list has nothing but surfaces is tested later.
    let surfaces = || match mode {
        Some(mode) => (c::TRIANGLES..=c::POLYGON).contains(&mode),
        None => kind == Kind::List,
    };
    let distorts = match facts.shaders {
        Shaders::Fixed => facts.synthesis.fixed_function && surfaces(),
        Shaders::Pipeline => false,
        _ => true,
    };
    if !distorts {
        return None;
    }
    let [near, far] = facts.state.depths;
    let (middle, half) = match facts.state.zero_to_one {
        true => (near, far - near),
        false => ((near + far) / 2.0, (far - near) / 2.0),
    };
    let [scale, offset] = mapping.line(scene).map(|v| v as f32);
    Some(ReferenceDraw {
        mode,
        map,
        disparities: [scale * half, scale * middle + offset],
    })
}
