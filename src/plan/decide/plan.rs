//! How a command is drawn: its shift between the views, and its method.

use super::{Facts, Known, Rects, Settings};
use crate::config::{Class, Repetition, Viewport};
use crate::gl::TextureName;
use crate::plan::class::Classed;
use crate::plan::reason::{Missing, Reason, Replayed};
use crate::plan::{Kind, Planes, Rig, Shear};

/// How the views are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Method {
    /// The call goes to the driver once, as it is.
    Once,
    /// The call once per view.
    Replay,
    /// One instanced draw.
    Instanced,
    /// One draw through a geometry shader.
    Geometry,
    /// Points, drawn once for all views to the samples that a panel shows.
    Points,
}

/// The plan of one command.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// How the views are drawn.
    pub method: Method,
    /// The class of the draw.
    pub class: Class,
    /// The shift of the views; none for a draw that is the same in all of them.
    pub shear: Option<Shear>,
    /// It is drawn with a variant of the program's own shaders.
    pub variant: bool,
    /// Under a variant, how vertices with a w of 1 in clip space are shifted.
    pub flat: Flat,
    /// Why it is not drawn by the requested strategy.
    pub reason: Option<Reason>,
    /// How it is repeated in the reference image of an occlusion camera, if it is.
    pub reference: Option<ReferenceDraw>,
    /// The w of its vertices is measured with it, for a program without a camera among its matrices (see [`crate::plan::clip_form`]).
    pub measures: bool,
}

impl Plan {
    /// The command goes to the driver once, as it is.
    pub fn once(facts: &Facts) -> Plan {
        Plan {
            method: Method::Once,
            class: facts.classed.class,
            shear: None,
            variant: false,
            flat: Flat::Still,
            reason: None,
            reference: None,
            measures: false,
        }
    }
}

/// A draw to the reference image, by distorted rays (see [`crate::synthesis`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceDraw {
    /// The primitive mode, where it is known.
    pub mode: Option<u32>,
    /// The distortion map.
    pub map: TextureName,
    /// Disparity over z in NDC, in pixels for one place: factor and offset.
    pub disparities: [f32; 2],
}

/// How a variant shifts vertices whose w is 1 in clip space: they may belong to the scene, or to a draw without depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flat {
    /// Not at all: they are the same in all views.
    Still,
    /// As a whole, such as the HUD.
    By(Shear),
    /// Like the rest of the scene.
    Scene,
}

/// The plan of a fixed-function draw, by its class and the requested strategy.
pub(super) fn of_fixed_function(facts: &Facts, known: &Known, settings: &Settings) -> Plan {
    let (kind, classed, rig) = (facts.traits.kind, &facts.classed, &known.rig);
    let class = classed.class;
    let plan = Plan::once(facts);
    if class == Class::OffScreen {
        return plan;
    }
    let p = &facts.projections.fixed;
    let shear = match class {
        _ if super::is_whole(kind) => None,
        Class::Scene if facts.slants() => rig.orthographic(p, &Planes::of(&facts.state)),
        Class::Scene => of_scene(classed, rig, p),
        Class::Sky => rig.sky(p),
        Class::Flat => {
            let magnified = magnified(facts.traits.viewport, &facts.rects);
            rig.at_depth(p, classed.depth * magnified)
        }
        Class::OffScreen => None,
    };
    let (method, reason) = match method(facts, known, settings) {
        Ok(method) => (method, None),
        Err(reason) => (Method::Replay, reason),
    };
    Plan {
        method,
        shear,
        reason,
        ..plan
    }
}

/// The shift of a draw of the scene under a projection.
pub(super) fn of_scene(classed: &Classed, rig: &Rig, p: &[f32; 16]) -> Option<Shear> {
    match classed.focal {
        Some(focal) => rig.shear_about(p, focal),
        None if classed.is_foreground() => rig.foreground(p),
        None => rig.shear(p),
    }
}

/// Factor of a shift in a small viewport, so that it is as wide in pixels as in the whole window: a picture in the picture then
/// stands at the depth of the display around it.
fn magnified(viewport: Viewport, rects: &Rects) -> f64 {
    match viewport {
        Viewport::Main => 1.0,
        Viewport::Inset => f64::from(rects.window[0]) / f64::from(rects.viewport[2].max(1)),
    }
}

/// The method of the requested strategy.
///
/// # Errors
/// The draw has to be replayed; with a reason, if the report is to name one.
fn method(facts: &Facts, known: &Known, settings: &Settings) -> Result<Method, Option<Reason>> {
    let kind = facts.traits.kind;
    let wish = match settings.strategy.repetition() {
        Repetition::Calls => return Err(None),
        Repetition::Instances => Method::Instanced,
        Repetition::GeometryShader => Method::Geometry,
    };
    match kind {
        Kind::Clear { .. } | Kind::Pixels | Kind::Accum => return Err(None),
        _ if known.replays_all => {
            return Err(Some(Reason::Replayed(Replayed::EqualDepths)));
        }
        Kind::List => return Err(Some(Reason::Replayed(Replayed::Lists))),
        Kind::Other => {
            return Err(Some(Reason::Replayed(Replayed::OtherCommands)));
        }
        Kind::Begin(_) if wish == Method::Instanced => {
            return Err(Some(Reason::Replayed(Replayed::Immediate)));
        }
        _ => {}
    }
    if facts.shaders.programmed() {
        return Err(Some(Reason::Program));
    }
    match wish {
        Method::Instanced if !settings.instanced => Err(Some(Reason::Driver(Missing::Instancing))),
        Method::Geometry if !settings.geometry => {
            Err(Some(Reason::Driver(Missing::GeometryShaders)))
        }
        m => Ok(m),
    }
}

/// Replays a draw inside a query: a draw that makes all views at once would count them all.
pub(super) fn uncounted(facts: &Facts, plan: Plan) -> Plan {
    match plan.method {
        Method::Instanced | Method::Geometry if facts.counted => Plan {
            method: Method::Replay,
            reason: Some(Reason::Replayed(Replayed::Counted)),
            ..plan
        },
        _ => plan,
    }
}
