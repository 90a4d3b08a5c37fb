//! When depths are captured.

use super::*;

fn measured() -> Settings {
    Settings {
        measures_depths: true,
        ..settings(Strategy::Replay)
    }
}

fn begun() -> Known {
    let mut known = known();
    known.depths.begun = true;
    known
}

fn next(facts: &Facts, known: &Known) -> Decision {
    decide(facts, known, &measured()).expect("a decision")
}

fn clear(depths: bool) -> Facts {
    let mut facts = scene();
    facts.traits.kind = Kind::Clear { depths, whole: 0 };
    facts.classed = classed(Class::Flat);
    facts
}

fn flat(depth: DepthState) -> Facts {
    let mut facts = scene();
    facts.classed = classed(Class::Flat);
    facts.state.depth = depth;
    facts
}

#[test]
fn a_scene_maps_its_depths() {
    let decision = next(&scene(), &begun());
    let [
        Effect::MapDepths {
            projection,
            viewport,
            focal,
            ..
        },
        ..,
    ] = decision.effects[..]
    else {
        panic!("{:?}", decision.effects)
    };
    assert_eq!(projection, perspective());
    assert_eq!((viewport, focal), (Viewport::Main, None));
    assert!(decision.known.depths.pending);
    assert_eq!(decision.known.depths.projection, Some(perspective()));
    // Nobody measures depths.
    let quiet = decided(&scene(), &begun(), Strategy::Replay);
    assert!(!quiet.known.depths.pending);
}

#[test]
fn an_inset_is_mapped_and_waits_for_no_picture() {
    let mut facts = scene();
    facts.traits.viewport = Viewport::Inset;
    let decision = next(&facts, &begun());
    assert!(matches!(decision.effects[0], Effect::MapDepths { .. }));
    assert!(!decision.known.depths.pending);
    assert_eq!(decision.known.depths.projection, None);
}

#[test]
fn a_scene_without_depths_of_its_own_maps_none() {
    let mut facts = scene();
    facts.state.depth = DepthState::TestOnly;
    let decision = next(&facts, &begun());
    assert!(!decision.known.depths.pending);
    assert_eq!(decision.known.depths.projection, Some(perspective()));
    let maps = |e: &Effect| matches!(e, Effect::MapDepths { .. });
    assert!(!decision.effects.iter().any(maps));
}

#[test]
fn the_picture_is_taken_before_a_clear_and_once() {
    let drawn = next(&scene(), &begun()).known;
    let cleared = next(&clear(true), &drawn);
    assert_eq!(
        cleared.effects[..2],
        [Effect::TakeDepths, Effect::ForgetDepths]
    );
    let again = next(&clear(true), &cleared.known);
    assert_eq!(again.effects[0], Effect::ForgetDepths);
    // Colours alone spoil nothing.
    assert!(next(&clear(false), &drawn).known.depths.pending);
    // A clear of a part of the window leaves the rest valid.
    let mut part = clear(true);
    part.rects.scissor = Some([0, 0, 10, 10]);
    let part = next(&part, &drawn);
    assert!(part.effects.contains(&Effect::TakeDepths));
    assert!(!part.effects.contains(&Effect::ForgetDepths));
}

/// A scene in a framebuffer whose picture ends up in the window.
#[test]
fn the_depths_of_a_pass_are_taken_from_its_framebuffer() {
    let in_framebuffer = |mut facts: Facts, name: u32| {
        facts.traits.target = Target::Pass(name);
        facts.destination.framebuffer = FramebufferName(name);
        facts.destination.split = Linked::Yes;
        facts
    };
    let drawn = next(&in_framebuffer(scene(), 7), &begun());
    let maps = |e: &Effect| matches!(e, Effect::MapDepths { .. });
    assert!(drawn.effects.iter().any(maps));
    assert_eq!(drawn.known.depths.framebuffer, FramebufferName(7));
    // What happens in the window leaves them as they are.
    let shown = next(&flat(DepthState::On), &drawn.known);
    assert!(shown.known.depths.pending && !shown.known.depths.overwritten);
    let cleared = next(&clear(true), &shown.known);
    assert!(cleared.known.depths.pending);
    // A clear of the framebuffer does not.
    let own = next(&in_framebuffer(clear(true), 7), &cleared.known);
    assert_eq!(own.effects[..2], [Effect::TakeDepths, Effect::ForgetDepths]);
    // Neither does a scene elsewhere: the pictures are taken one after the other.
    let other = next(&scene(), &cleared.known);
    assert_eq!(
        other.effects[..2],
        [Effect::TakeDepths, Effect::ForgetDepths]
    );
    assert!(other.known.depths.pending);
    assert_eq!(other.known.depths.framebuffer, FramebufferName::ZERO);
}

#[test]
fn what_is_flat_spoils_the_depths_where_it_writes_them() {
    let drawn = next(&scene(), &begun()).known;
    for harmless in [DepthState::Off, DepthState::TestOnly] {
        let decision = next(&flat(harmless), &drawn);
        assert!(!decision.known.depths.overwritten && decision.known.depths.pending);
    }
    let overwritten = next(&flat(DepthState::On), &drawn);
    assert!(overwritten.effects.contains(&Effect::TakeDepths));
    assert!(overwritten.known.depths.overwritten && !overwritten.known.depths.pending);
    // Later draws are ignored until the depths are cleared.
    let more = next(&scene(), &overwritten.known);
    let cleared = next(&clear(true), &more.known);
    assert!(!cleared.effects.contains(&Effect::TakeDepths));
    assert!(!cleared.known.depths.overwritten);
    // Before any scene there is nothing to spoil.
    assert!(
        !next(&flat(DepthState::On), &begun())
            .known
            .depths
            .overwritten
    );
}

#[test]
fn a_sky_is_told() {
    let mut facts = scene();
    facts.classed = classed(Class::Sky);
    assert_eq!(next(&facts, &begun()).effects[0], Effect::MapSky);
}

#[test]
fn the_direction_of_depths_is_that_of_the_first_scene() {
    let shows = Settings {
        shows_depth: true,
        ..settings(Strategy::Replay)
    };
    let of = |facts: &Facts, known: &Known| {
        let decision = decide(facts, known, &shows).expect("a decision");
        decision.known
    };
    let usual = of(&scene(), &known());
    assert_eq!(usual.frame.nearer_is_larger, Some(false));
    let mut reversed = scene();
    reversed.state.depths = [1.0, 0.0];
    assert_eq!(of(&reversed, &known()).frame.nearer_is_larger, Some(true));
    assert_eq!(of(&reversed, &usual).frame.nearer_is_larger, Some(false));
    let nobody = decided(&scene(), &known(), Strategy::Replay).known;
    assert_eq!(nobody.frame.nearer_is_larger, None);
}

#[test]
fn state_is_read_only_where_something_depends_on_it() {
    let asked = |kind: Kind, class: Class, known: &Known, settings: &Settings| {
        needs(kind, &classed(class), &Shaders::Fixed, known, settings)
    };
    let draw = Kind::Arrays(c::TRIANGLES);
    let mut differing = known();
    differing.mono.same = 0;
    let plain = settings(Strategy::Replay);
    assert_eq!(asked(draw, Class::Scene, &differing, &plain), Touch::NONE);
    assert_eq!(asked(draw, Class::Flat, &differing, &plain), Touch::NONE);
    let depths = Touch::RANGE | Touch::DEPTH;
    assert_eq!(asked(draw, Class::Scene, &differing, &measured()), depths);
    assert_eq!(
        asked(draw, Class::Flat, &differing, &measured()),
        Touch::NONE
    );
    let mut pending = differing;
    pending.depths.pending = true;
    assert_eq!(
        asked(draw, Class::Flat, &pending, &measured()),
        Touch::DEPTH
    );
    let clear = Kind::Clear {
        depths: true,
        whole: 0,
    };
    assert_eq!(
        asked(clear, Class::Flat, &pending, &measured()),
        Touch::NONE
    );
    let shows = Settings {
        shows_depth: true,
        ..plain
    };
    assert_eq!(asked(draw, Class::Scene, &differing, &shows), Touch::RANGE);
    assert_eq!(asked(draw, Class::Flat, &differing, &shows), Touch::NONE);
    let mut told = differing;
    told.frame.nearer_is_larger = Some(false);
    assert_eq!(asked(draw, Class::Scene, &told, &shows), Touch::NONE);
    let apart = Settings {
        same_depths: false,
        ..plain
    };
    assert_eq!(asked(draw, Class::Flat, &differing, &apart), Touch::DEPTH);
    let mut replays_all = differing;
    replays_all.replays_all = true;
    assert_eq!(asked(draw, Class::Flat, &replays_all, &apart), Touch::NONE);
    let synthesises = Settings {
        synthesises: true,
        ..plain
    };
    assert_eq!(
        asked(draw, Class::Scene, &differing, &synthesises),
        Touch::NONE
    );
    let mut synthesised = differing;
    synthesised.scene = Some(Scene::default());
    let cover = depths | Touch::COVER;
    assert_eq!(asked(draw, Class::Scene, &synthesised, &synthesises), cover);
    assert_eq!(
        asked(clear, Class::Flat, &synthesised, &synthesises),
        Touch::NONE
    );
    // The stencil test decides whether the stencils of the views stay the same.
    assert_eq!(asked(draw, Class::Scene, &known(), &plain), Touch::COVER);
    let variant = Shaders::Variant(VariantFacts {
        far_end: false,
        program: ProgramName(1),
        camera: None,
        lost: true,
        unmeasured: false,
        to_layer: Linked::Untried,
        to_layers: Linked::Untried,
        divides: false,
        unprojects: false,
    });
    let scene = classed(Class::Scene);
    assert_eq!(
        needs(draw, &scene, &variant, &differing, &plain),
        Touch::DEPTH
    );
}
