//! Points are drawn once for all views, where the strategy is `splats`.

use super::{Facts, Method, Plan, Settings, Shaders};
use crate::config::Strategy;
use crate::gl::consts as c;
use crate::plan::Kind;
use crate::plan::reason::{Reason, Replayed};

/// Turns the replay of points into one draw. What the driver and the window exclude is found when the draw is made.
pub(super) fn plan(facts: &Facts, settings: &Settings, plan: Plan) -> Plan {
    let points = matches!(
        facts.traits.kind,
        Kind::Begin(c::POINTS) | Kind::Arrays(c::POINTS) | Kind::Elements(c::POINTS)
    );
    let wanted = settings.strategy == Strategy::Splats && settings.views > 1 && points;
    if !wanted || plan.method != Method::Replay {
        return plan;
    }
    let replayed = |why| Some(Reason::Replayed(why));
    let reason = match &facts.shaders {
        _ if facts.destination.front => replayed(Replayed::NoLayers),
        _ if facts.counted => replayed(Replayed::Counted),
        _ if facts.reads_views || facts.unprojects() => replayed(Replayed::SplitTexture),
        Shaders::Fixed => None,
        Shaders::Variant(_) if plan.variant => None,
        _ => Some(Reason::Program),
    };
    let method = match reason {
        None => Method::Points,
        Some(_) => plan.method,
    };
    Plan {
        method,
        reason,
        ..plan
    }
}
