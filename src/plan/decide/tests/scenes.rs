//! Scenes that are drawn to some views only, and where the others are synthesised.

use super::*;
use crate::plan::class::Target;
use crate::plan::reason::{Hindrance, NotOfScene};

fn synthesising() -> Settings {
    Settings {
        synthesises: true,
        ..settings(Strategy::Occlusion)
    }
}

fn next(facts: &Facts, known: &Known) -> Decision {
    decide(facts, known, &synthesising()).expect("a decision")
}

fn clear(whole: u32) -> Facts {
    let mut facts = scene();
    facts.traits.kind = Kind::Clear {
        depths: true,
        whole,
    };
    facts.classed = classed(Class::Flat);
    facts.clear = ClearFacts {
        writable: ALL_BUFFERS,
        unscissored: true,
        depth: 0.75,
    };
    facts
}

/// A scene that a clear of everything has begun.
fn begun() -> Known {
    next(&clear(ALL_BUFFERS), &known()).known
}

fn drawn() -> Known {
    next(&scene(), &begun()).known
}

/// Why a draw does not belong to the scene; none where it does.
fn parted(facts: &Facts, known: &Known) -> Option<NotOfScene> {
    let decision = next(facts, known);
    let why = decision.effects.iter().find_map(|effect| match effect {
        Effect::Fallback(Reason::SynthesisedBefore(why)) => Some(*why),
        _ => None,
    });
    let synthesised = decision.effects.contains(&Effect::SynthesiseViews);
    assert_eq!(synthesised, why.is_some());
    assert_eq!(decision.known.scene.is_none(), why.is_some());
    assert_eq!(decision.known.synthesised, why.is_some());
    why
}

#[test]
fn a_clear_of_the_depths_begins_a_scene() {
    let decision = next(&clear(ALL_BUFFERS), &known());
    assert_eq!(decision.effects, [Effect::BeginScene { depth: 0.75 }]);
    let begun = decision.known.scene.expect("a scene");
    assert_eq!(begun.clear, 0.75);
    assert!(!begun.begun && begun.mapping.is_none());
    let mut mono = known();
    mono.mono.active = true;
    let decision = next(&clear(ALL_BUFFERS), &mono);
    assert_eq!(
        decision.effects,
        [Effect::LeaveMono, Effect::BeginScene { depth: 0.75 }]
    );
    assert!(!decision.known.mono.active);
}

#[test]
fn other_clears_begin_none() {
    let begins = |facts: &Facts| next(facts, &known()).known.scene.is_some();
    assert!(begins(&clear(c::DEPTH_BUFFER_BIT)));
    assert!(!begins(&clear(c::COLOR_BUFFER_BIT)));
    assert!(!begins(&clear(c::STENCIL_BUFFER_BIT)));
    let mut masked = clear(ALL_BUFFERS);
    masked.clear.writable = c::COLOR_BUFFER_BIT;
    assert!(!begins(&masked));
    let mut part = clear(ALL_BUFFERS);
    part.clear.unscissored = false;
    assert!(!begins(&part));
    let mut impossible = clear(ALL_BUFFERS);
    impossible.synthesis.hindrance = Some(Hindrance::Buffers);
    assert!(!begins(&impossible));
    // A view that is drawn for the first time has no earlier picture.
    let mut new_view = clear(c::DEPTH_BUFFER_BIT);
    new_view.synthesis.adds_views = true;
    assert!(!begins(&new_view));
    new_view.traits.kind = clear(ALL_BUFFERS).traits.kind;
    assert!(begins(&new_view));
    let mut late = known();
    late.synthesised = true;
    assert!(next(&clear(ALL_BUFFERS), &late).known.scene.is_none());
    let asks_nothing = decided(&clear(ALL_BUFFERS), &known(), Strategy::Replay);
    assert!(asks_nothing.known.scene.is_none());
}

#[test]
fn a_scene_that_was_drawn_ends_at_the_next_clear() {
    assert_eq!(
        parted(&clear(ALL_BUFFERS), &drawn()),
        Some(NotOfScene::Clear)
    );
    // Nothing is lost where the scene was shown and is cleared wholly.
    let mut shown = drawn();
    shown.scene.as_mut().expect("a scene").shown = true;
    let again = next(&clear(ALL_BUFFERS), &shown);
    assert_eq!(again.effects, [Effect::BeginScene { depth: 0.75 }]);
    let colours = next(&clear(c::COLOR_BUFFER_BIT), &shown);
    assert!(colours.known.scene.is_some());
    let mut part = clear(ALL_BUFFERS);
    part.clear.unscissored = false;
    assert_eq!(parted(&part, &shown), Some(NotOfScene::Clear));
    // A second clear before any draw does not end the scene.
    assert!(
        next(&clear(c::COLOR_BUFFER_BIT), &begun())
            .known
            .scene
            .is_some()
    );
}

#[test]
fn draws_of_the_scene_belong_to_it() {
    let decision = next(&scene(), &begun());
    assert_eq!(decision.effects, [Effect::CaptureSurface]);
    let scene_now = decision.known.scene.expect("a scene");
    assert!(scene_now.begun);
    let mapping = scene_now.mapping.expect("a mapping");
    assert_eq!(mapping.viewport, [0, 0, 640, 480]);
    let far = mapping.shear.separation(1.0) * 320.0;
    assert_eq!(mapping.far(), far);
    // At the plane of zero parallax, the disparity is that of infinity.
    let [slope, offset] = mapping.line(&mapping);
    let [a, b] = mapping.ramp.line();
    let size = far.abs() * mapping.shear.conv;
    assert_eq!([slope, offset], [size * a, size * b]);
}

#[test]
fn what_does_not_belong_has_its_reason() {
    let of = |known: &Known, change: &dyn Fn(&mut Facts)| {
        let mut facts = scene();
        change(&mut facts);
        parted(&facts, known)
    };
    let (begun, drawn) = (begun(), drawn());
    assert_eq!(of(&drawn, &|_| ()), None);
    let why = of(&drawn, &|f| f.state.stencil = true);
    assert_eq!(why, Some(NotOfScene::Stencil));
    let why = of(&drawn, &|f| f.state.stipple = true);
    assert_eq!(why, Some(NotOfScene::Stipple));
    let pictures = Some(NotOfScene::Pixels);
    assert_eq!(of(&drawn, &|f| f.reads_views = true), pictures);
    assert_eq!(of(&drawn, &|f| f.traits.kind = Kind::Pixels), pictures);
    assert_eq!(of(&drawn, &|f| f.traits.kind = Kind::Accum), pictures);
    let inset = of(&drawn, &|f| f.traits.viewport = Viewport::Inset);
    assert_eq!(inset, Some(NotOfScene::PictureInPicture));
    let blends = of(&drawn, &|f| f.state.blends = true);
    assert_eq!(blends, Some(NotOfScene::Transparent));
    let tests = of(&drawn, &|f| f.state.depth = DepthState::TestOnly);
    assert_eq!(tests, Some(NotOfScene::WithoutDepths));
    let off = of(&drawn, &|f| {
        f.state.depth = DepthState::Off;
        f.synthesis.over_last = true;
    });
    assert_eq!(off, Some(NotOfScene::WithoutDepths));
    let viewport = of(&drawn, &|f| f.rects.viewport = [0, 0, 320, 480]);
    assert_eq!(viewport, Some(NotOfScene::OtherProjection));
    let focal = of(&drawn, &|f| f.classed.focal = Some(2.0));
    assert_eq!(focal, Some(NotOfScene::OwnFocalDepth));
    let slants = of(&drawn, &|f| *f = super::orthographic::oblique());
    assert_eq!(slants, Some(NotOfScene::Orthographic));
    let flat = |f: &mut Facts| f.classed = classed(Class::Flat);
    assert_eq!(of(&drawn, &flat), Some(NotOfScene::Flat));
    // Before the scene a flat draw belongs to it, if it lies on the panel and writes no depths.
    let flat_early = |depth: DepthState, stands: f64| {
        of(&begun, &|f| {
            flat(f);
            f.classed.depth = stands;
            f.state.depth = depth;
        })
    };
    let elsewhere = Some(NotOfScene::FlatElsewhere);
    assert_eq!(flat_early(DepthState::Off, 0.0), None);
    assert_eq!(flat_early(DepthState::On, 0.0), elsewhere);
    assert_eq!(flat_early(DepthState::Off, 0.5), elsewhere);
}

/// A sky by the rays of its fragments has the depths of the far end. After the scene it is drawn in each view.
#[test]
fn skies_by_rays_stand_behind_the_scene() {
    let facts = with_variant(|variant| variant.unprojects = true);
    assert_eq!(parted(&facts, &begun()), None);
    let known = next(&facts, &begun()).known;
    assert!(known.scene.is_some_and(|scene| scene.sky));
    assert_eq!(parted(&facts, &drawn()), Some(NotOfScene::Rays));
}

#[test]
fn skies_stand_behind_the_scene() {
    let sky = |known: &Known, depth: DepthState| {
        let mut facts = scene();
        facts.classed = classed(Class::Sky);
        facts.state.depth = depth;
        parted(&facts, known)
    };
    assert_eq!(sky(&begun(), DepthState::Off), None);
    assert_eq!(
        sky(&drawn(), DepthState::Off),
        Some(NotOfScene::SkyOverScene)
    );
    assert_eq!(sky(&drawn(), DepthState::TestOnly), None);
    assert_eq!(
        sky(&begun(), DepthState::On),
        Some(NotOfScene::SkyWithDepths)
    );
    let mut facts = scene();
    facts.classed = classed(Class::Sky);
    facts.state.depth = DepthState::Off;
    let known = next(&facts, &begun()).known;
    assert!(known.scene.is_some_and(|scene| scene.sky));
}

#[test]
fn the_depths_of_a_backdrop_are_cleared_within_the_scene() {
    let mut facts = scene();
    facts.classed = Classed {
        why: Why::Backdrop,
        ..classed(Class::Sky)
    };
    assert_eq!(parted(&facts, &begun()), None);
    let sky = next(&facts, &begun()).known;
    let mut depths = clear(c::DEPTH_BUFFER_BIT);
    let after = next(&depths, &sky);
    assert!(!after.effects.contains(&Effect::SynthesiseViews));
    assert!(after.known.scene.is_some_and(|scene| scene.sky));
    // A picture that was shown is one of an earlier frame.
    let mut shown = sky;
    shown.scene.as_mut().expect("a scene").shown = true;
    let again = next(&depths, &shown).known.scene.expect("a scene");
    assert!(!again.sky);
    // Not to another depth, nor after something that has a place.
    depths.clear.depth = 0.5;
    let other = next(&depths, &sky);
    assert!(other.effects.contains(&Effect::SynthesiseViews));
    let scene = next(&scene(), &sky).known;
    let later = next(&clear(c::DEPTH_BUFFER_BIT), &scene);
    assert!(later.effects.contains(&Effect::SynthesiseViews));
}

#[test]
fn passes_over_a_surface_have_its_depths() {
    let mut over = scene();
    over.state.depth = DepthState::TestOnly;
    over.state.blends = true;
    assert!(is_over_candidate(&over));
    assert!(parted(&over, &drawn()).is_some());
    over.synthesis.over_last = true;
    assert_eq!(parted(&over, &drawn()), None);
    let mut equal = scene();
    equal.state.blends = true;
    equal.state.equal = true;
    assert!(!is_over_candidate(&equal), "nothing to be compared");
    assert_eq!(parted(&equal, &drawn()), None);
    assert!(!is_over_candidate(&scene()));
    let mut off = over;
    off.state.depth = DepthState::Off;
    assert!(!is_over_candidate(&off));
    let mut tests_only = scene();
    tests_only.state.depth = DepthState::TestOnly;
    assert!(is_over_candidate(&tests_only), "opaque, without depths");
    tests_only.classed = classed(Class::Flat);
    assert!(!is_over_candidate(&tests_only));
}

#[test]
fn the_reference_image_gets_surfaces() {
    let reference = |change: &dyn Fn(&mut Facts)| {
        let mut facts = scene();
        facts.synthesis.reference = Some(TextureName(9));
        facts.synthesis.fixed_function = true;
        change(&mut facts);
        next(&facts, &begun()).plan.reference
    };
    let drawn = reference(&|_| ()).expect("a draw");
    assert_eq!(
        (drawn.mode, drawn.map),
        (Some(c::TRIANGLES), TextureName(9))
    );
    let mapping = self::drawn().scene.and_then(|scene| scene.mapping);
    let mapping = mapping.expect("a mapping");
    let [scale, offset] = mapping.line(&mapping).map(|v| v as f32);
    assert_eq!(drawn.disparities, [scale * 0.5, scale * 0.5 + offset]);
    // Over z in NDC disparities are the same, whatever the depth range.
    let close = |other: ReferenceDraw| {
        let pairs = other.disparities.into_iter().zip(drawn.disparities);
        pairs
            .into_iter()
            .all(|(a, b)| (a - b).abs() <= 1e-4 * b.abs())
    };
    let of_state = |change: &dyn Fn(&mut ClassificationState)| {
        reference(&|f| change(&mut f.state)).expect("a draw")
    };
    assert!(close(of_state(&|s| s.zero_to_one = true)));
    assert!(close(of_state(&|s| s.depths = [0.25, 0.5])));
    assert!(close(of_state(&|s| {
        s.depths = [0.75, 0.25];
        s.zero_to_one = true;
    })));
    let mode = |mode: u32| move |f: &mut Facts| f.traits.kind = Kind::Begin(mode);
    assert_eq!(reference(&mode(c::LINES)), None);
    assert_eq!(reference(&mode(c::POINTS)), None);
    assert!(reference(&mode(c::POLYGON)).is_some());
    assert!(reference(&|f| f.traits.kind = Kind::List).is_some_and(|r| r.mode.is_none()));
    assert_eq!(reference(&|f| f.traits.kind = Kind::Other), None);
    assert_eq!(reference(&|f| f.synthesis.fixed_function = false), None);
    assert_eq!(reference(&|f| f.synthesis.reference = None), None);
    assert_eq!(reference(&|f| f.shaders = Shaders::Pipeline), None);
    let own = |kind: Kind| {
        move |f: &mut Facts| {
            f.shaders = Shaders::WithoutVariant(ProgramName(2));
            f.traits.kind = kind;
        }
    };
    assert!(reference(&own(Kind::Other)).is_some());
    assert!(reference(&own(Kind::Arrays(c::LINES))).is_some());
}

#[test]
fn a_weapon_in_a_part_of_the_depth_range_stands_before_the_scene() {
    let of = |range: [f32; 2]| {
        let mut facts = scene();
        facts.state.depths = range;
        facts
    };
    let whole = next(&of([0.0, 1.0]), &begun()).known;
    let hand = next(&of([0.0, 0.3]), &whole);
    let scene = hand.known.scene.expect("one scene");
    let (before, to) = scene.before.expect("something before it");
    assert!((to - 0.3).abs() < 1e-6, "{to}");
    assert!(before.ramp != scene.mapping.expect("a mapping").ramp);
    // And the other way round.
    let hand = next(&of([0.0, 0.3]), &begun()).known;
    let both = next(&of([0.0, 1.0]), &hand).known.scene.expect("one scene");
    assert_eq!(both, scene);
    // A third depth range counts as another projection.
    assert!(parted(&of([0.0, 0.1]), &whole).is_none());
    let mut third = next(&of([0.0, 0.3]), &whole).known;
    third.synthesised = false;
    assert_eq!(
        parted(&of([0.0, 0.1]), &third),
        Some(NotOfScene::OtherProjection)
    );
}

#[test]
fn frames_know_whether_something_in_perspective_wrote_depth() {
    let wrote_depth = |change: &dyn Fn(&mut Facts), known: &Known| {
        let mut facts = scene();
        change(&mut facts);
        decided(&facts, known, Strategy::Replay)
            .known
            .frame
            .wrote_depth
    };
    let known = known();
    assert!(wrote_depth(&|_| (), &known));
    assert!(!wrote_depth(
        &|f| f.traits.depth_state = DepthState::Off,
        &known
    ));
    assert!(!wrote_depth(
        &|f| f.traits.projection = Projection::Orthographic,
        &known
    ));
    assert!(!wrote_depth(&|f| f.classed.class = Class::Sky, &known));
    assert!(!wrote_depth(&|f| f.traits.first = false, &known));
    assert!(!wrote_depth(
        &|f| f.traits.target = Target::Framebuffer(1),
        &known
    ));
    let mut after = known;
    after.frame.wrote_depth = true;
    let cleared = |f: &mut Facts| *f = clear(ALL_BUFFERS);
    assert!(!wrote_depth(&cleared, &after));
    let mut counted = scene();
    counted.traits.draw = 7;
    let decision = decided(&counted, &known, Strategy::Replay);
    assert_eq!(decision.known.frame.draws, 7);
}

#[test]
fn lenses_are_remembered_where_a_pass_shows_them() {
    let mut facts = scene();
    facts.projections.lens = Some(1.5);
    let first = decided(&facts, &known(), Strategy::Replay).known;
    assert_eq!(first.lens, Some(1.5));
    facts.projections.lens = None;
    assert_eq!(
        decided(&facts, &first, Strategy::Replay).known.lens,
        Some(1.5)
    );
}

/// Why no view of a draw's scene is synthesised; none where views are, or may be.
fn hindered(facts: &Facts, known: &Known) -> Option<Hindrance> {
    let decision = next(facts, known);
    decision.effects.iter().find_map(|effect| match effect {
        Effect::Fallback(Reason::NotSynthesised(why)) => Some(*why),
        _ => None,
    })
}

#[test]
fn a_scene_that_each_view_gets_says_why() {
    assert_eq!(hindered(&scene(), &known()), Some(Hindrance::NoClear));
    assert_eq!(hindered(&scene(), &begun()), None);
    let mut late = known();
    late.synthesised = true;
    assert_eq!(hindered(&scene(), &late), None, "it was told before");
    let mut clear = clear(ALL_BUFFERS);
    clear.synthesis.hindrance = Some(Hindrance::Buffers);
    let after = next(&clear, &known()).known;
    assert_eq!(hindered(&scene(), &after), Some(Hindrance::Buffers));
    clear.synthesis.hindrance = Some(Hindrance::Unwanted);
    let after = next(&clear, &known()).known;
    assert_eq!(hindered(&scene(), &after), None);
    let mut pass = scene();
    pass.traits.target = Target::Pass(1);
    pass.destination.framebuffer = FramebufferName(9);
    pass.destination.differs = true;
    pass.destination.split = Linked::Yes;
    assert_eq!(hindered(&pass, &begun()), Some(Hindrance::Framebuffer));
    let mut flat = scene();
    flat.classed = classed(Class::Flat);
    assert_eq!(hindered(&flat, &known()), None);
    let replayed = decided(&scene(), &known(), Strategy::Replay);
    assert_eq!(replayed.effects, []);
}
