//! The method of a draw, and the reason where it is not the requested one.

use super::*;

fn method(facts: &Facts, strategy: Strategy) -> (Method, Option<Reason>) {
    let plan = decided(facts, &known(), strategy).plan;
    (plan.method, plan.reason)
}

fn of(kind: Kind) -> Facts {
    let mut facts = scene();
    facts.traits.kind = kind;
    facts
}

#[test]
fn arrays_by_fixed_function_are_amplified() {
    for kind in [Kind::Arrays(c::TRIANGLES), Kind::Elements(c::QUADS)] {
        assert_eq!(
            method(&of(kind), Strategy::Instanced),
            (Method::Instanced, None)
        );
        assert_eq!(
            method(&of(kind), Strategy::Geometry),
            (Method::Geometry, None)
        );
        for strategy in [Strategy::Replay, Strategy::Auto, Strategy::DepthImage] {
            assert_eq!(method(&of(kind), strategy), (Method::Replay, None));
        }
    }
    assert_eq!(
        method(&of(Kind::Begin(c::TRIANGLES)), Strategy::Geometry).0,
        Method::Geometry
    );
}

#[test]
fn what_only_replay_knows_is_replayed_and_says_so() {
    let why = |facts: &Facts, strategy: Strategy| {
        let (method, reason) = method(facts, strategy);
        assert_eq!(method, Method::Replay);
        reason
    };
    for strategy in [Strategy::Instanced, Strategy::Geometry] {
        let lists = why(&of(Kind::List), strategy);
        assert_eq!(lists, Some(Reason::Replayed(Replayed::Lists)));
        let other = why(&of(Kind::Other), strategy);
        assert_eq!(other, Some(Reason::Replayed(Replayed::OtherCommands)));
        // Such a replay needs no reason.
        assert_eq!(why(&of(Kind::Pixels), strategy), None);
        let mut own = scene();
        own.shaders = Shaders::WithoutVariant(ProgramName(2));
        assert_eq!(why(&own, strategy), Some(Reason::Program));
    }
    let begun = why(&of(Kind::Begin(c::TRIANGLES)), Strategy::Instanced);
    assert_eq!(begun, Some(Reason::Replayed(Replayed::Immediate)));
}

#[test]
fn points_are_drawn_once_where_that_is_wanted() {
    let points = [
        Kind::Begin(c::POINTS),
        Kind::Arrays(c::POINTS),
        Kind::Elements(c::POINTS),
    ];
    for kind in points {
        assert_eq!(method(&of(kind), Strategy::Splats), (Method::Points, None));
        assert_eq!(method(&of(kind), Strategy::Replay), (Method::Replay, None));
    }
    for kind in [Kind::Arrays(c::LINES), Kind::List, Kind::Pixels] {
        assert_eq!(method(&of(kind), Strategy::Splats), (Method::Replay, None));
    }
    let why = |change: &dyn Fn(&mut Facts)| {
        let mut facts = of(Kind::Arrays(c::POINTS));
        change(&mut facts);
        let (method, reason) = method(&facts, Strategy::Splats);
        assert_eq!(method, Method::Replay);
        reason
    };
    let replayed = |why| Some(Reason::Replayed(why));
    assert_eq!(
        why(&|facts| facts.counted = true),
        replayed(Replayed::Counted)
    );
    assert_eq!(
        why(&|facts| facts.destination.front = true),
        replayed(Replayed::NoLayers)
    );
    assert_eq!(
        why(&|facts| facts.reads_views = true),
        replayed(Replayed::SplitTexture)
    );
    assert_eq!(
        why(&|facts| facts.shaders = Shaders::WithoutVariant(ProgramName(2))),
        Some(Reason::Program)
    );
}

#[test]
fn drivers_that_lack_something_are_named() {
    let of = |strategy, change: fn(&mut Settings)| {
        let mut settings = settings(strategy);
        change(&mut settings);
        let decision = decide(&scene(), &known(), &settings).expect("a decision");
        let Decision { plan, .. } = decision;
        assert_eq!(plan.method, Method::Replay);
        plan.reason
    };
    let why = of(Strategy::Instanced, |s| s.instanced = false);
    assert_eq!(why, Some(Reason::Driver(Missing::Instancing)));
    let why = of(Strategy::Geometry, |s| s.geometry = false);
    assert_eq!(why, Some(Reason::Driver(Missing::GeometryShaders)));
}

#[test]
fn counted_draws_are_replayed() {
    let mut facts = scene();
    facts.counted = true;
    let (method, why) = method(&facts, Strategy::Geometry);
    assert_eq!(method, Method::Replay);
    assert_eq!(why, Some(Reason::Replayed(Replayed::Counted)));
}

#[test]
fn reasons_become_effects_for_the_report() {
    let mut facts = scene();
    facts.counted = true;
    let decision = decided(&facts, &known(), Strategy::Geometry);
    assert!(matches!(decision.effects[..], [.., Effect::Fallback(_)]));
    let none = decided(&scene(), &known(), Strategy::Geometry).effects;
    assert!(!none.iter().any(|e| matches!(e, Effect::Fallback(_))));
}

#[test]
fn passes_that_meet_in_every_pixel_go_the_same_way() {
    let mut apart = settings(Strategy::Geometry);
    apart.same_depths = false;
    let mut facts = scene();
    let before = decide(&facts, &known(), &apart).expect("a decision");
    assert_eq!(before.plan.method, Method::Geometry);
    assert!(!before.known.replays_all);
    facts.state.equal = true;
    let equal = decide(&facts, &before.known, &apart).expect("a decision");
    assert_eq!(equal.plan.method, Method::Replay);
    // From then on all draws are replayed.
    facts.state.equal = false;
    let after = decide(&facts, &equal.known, &apart).expect("a decision");
    assert_eq!(after.plan.method, Method::Replay);
    assert!(after.known.replays_all);
    // Not where the depths are equal anyway, nor because of a draw to another framebuffer.
    facts.state.equal = true;
    let same = decided(&facts, &known(), Strategy::Geometry);
    assert!(!same.known.replays_all);
    facts.destination.framebuffer = FramebufferName(4);
    facts.classed = classed(Class::OffScreen);
    let elsewhere = decide(&facts, &known(), &apart).expect("a decision");
    assert!(!elsewhere.known.replays_all);
}

#[test]
fn depths_are_those_of_replay_by_strategy_and_driver() {
    for strategy in [
        Strategy::Replay,
        Strategy::Auto,
        Strategy::DepthImage,
        Strategy::Occlusion,
        Strategy::Hybrid,
    ] {
        assert!(has_depths_of_replay(strategy, false, true));
    }
    assert!(has_depths_of_replay(Strategy::Instanced, true, false));
    assert!(!has_depths_of_replay(Strategy::Instanced, false, false));
    assert!(!has_depths_of_replay(Strategy::Instanced, true, true));
    assert!(!has_depths_of_replay(Strategy::Geometry, true, false));
}

#[test]
fn what_makes_no_picture_is_drawn_once() {
    for strategy in [Strategy::Replay, Strategy::Instanced, Strategy::Geometry] {
        let mut facts = scene();
        facts.traits.target = Target::Nothing;
        facts.classed = classed(Class::OffScreen);
        facts.destination.picture = false;
        let decision = decided(&facts, &known(), strategy);
        assert_eq!(decision.plan, Plan::once(&facts));
        assert_eq!(decision.effects, []);
    }
}
