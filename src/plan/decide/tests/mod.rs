//! Decisions without a driver: facts in, plans, effects and preparations out.
#![allow(clippy::wildcard_imports, reason = "tests of the parent's rules")]

use super::*;
use crate::config::{Camera, DepthRange, DepthState, Viewport};
use crate::gl::{FramebufferName, ProgramName, TextureName, consts as c};
use crate::plan::Rig;
use crate::plan::class::{BackdropStage, Target, Traits, Why};
use crate::plan::reason::{Missing, Reason, Replayed, Unrepresentable};
use crate::state::ClassificationState;

mod backdrop;
mod classes;
mod depths;
mod foreground;
mod mono;
mod orthographic;
mod preparations;
mod scenes;
mod shaders;
mod strategies;

/// A perspective projection with near plane 1 and far plane 100, column-major.
pub(super) fn perspective() -> [f32; 16] {
    let (near, far) = (1.0_f32, 100.0_f32);
    let mut p = [0.0; 16];
    [p[0], p[5], p[11]] = [1.5, 2.0, -1.0];
    [p[10], p[14]] = [(far + near) / (near - far), 2.0 * far * near / (near - far)];
    p
}

/// A draw of a scene by fixed function: triangles to a window of 640×480, in perspective, with depths.
pub(super) fn scene() -> Facts {
    let state = ClassificationState {
        depth: DepthState::On,
        ..ClassificationState::default()
    };
    Facts {
        traits: Traits {
            kind: Kind::Arrays(c::TRIANGLES),
            target: Target::Window,
            draw: 1,
            clear: 0,
            after_clear: 1,
            list: None,
            raster: Projection::None,
            projection: Projection::Perspective,
            viewport: Viewport::Main,
            centred: true,
            depth_state: DepthState::On,
            range: DepthRange::Whole,
            texture: TextureName::ZERO,
            image: 0,
            program: 0,
            shader: 0,
            turns: false,
            far_end: false,
            slants: false,
            first: true,
            backdrop: BackdropStage::None,
            foreground: false,
        },
        classed: classed(Class::Scene),
        projections: Projections {
            fixed: perspective(),
            matrix: perspective(),
            scene: perspective(),
            lens: None,
            raster_moves: false,
        },
        rects: Rects {
            viewport: [0, 0, 640, 480],
            scissor: None,
            window: [640, 480],
        },
        shaders: Shaders::Fixed,
        state,
        destination: Destination {
            framebuffer: FramebufferName::ZERO,
            picture: true,
            differs: false,
            split: Linked::Untried,
            layered: false,
            front: false,
            copies: false,
            eyes: false,
        },
        grid: None,
        clear: ClearFacts::default(),
        synthesis: SynthesisFacts::default(),
        counted: false,
        reads_views: false,
    }
}

/// The same, with shaders of the program's own.
pub(super) fn with_variant(change: impl FnOnce(&mut VariantFacts)) -> Facts {
    let mut variant = VariantFacts {
        far_end: false,
        program: ProgramName(3),
        camera: Some(perspective()),
        lost: false,
        unmeasured: false,
        to_layer: Linked::Untried,
        to_layers: Linked::Untried,
        divides: false,
        unprojects: false,
    };
    change(&mut variant);
    let mut facts = scene();
    facts.shaders = Shaders::Variant(variant);
    facts
}

pub(super) fn classed(class: Class) -> Classed {
    Classed {
        class,
        depth: 0.0,
        focal: None,
        why: Why::Perspective,
    }
}

/// Five views, cameras that fit the first projection.
pub(super) fn known() -> Known {
    Known::new(Rig::new(5, Camera::Auto, None))
}

pub(super) fn settings(strategy: Strategy) -> Settings {
    Settings {
        strategy,
        instanced: true,
        geometry: true,
        same_depths: true,
        views: 5,
        shows_depth: false,
        measures_depths: false,
        synthesises: false,
    }
}

pub(super) fn decided(facts: &Facts, known: &Known, strategy: Strategy) -> Decision {
    decide(facts, known, &settings(strategy)).expect("a decision, and nothing to be prepared")
}
