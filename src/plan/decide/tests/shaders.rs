//! Draws with the program's own shaders.

use super::*;

#[test]
fn a_scene_goes_by_the_camera_among_the_matrices() {
    let mut facts = with_variant(|_| ());
    facts.projections.fixed = glam::Mat4::IDENTITY.to_cols_array();
    let decision = decided(&facts, &known(), Strategy::Replay);
    let plan = &decision.plan;
    assert!(plan.variant);
    assert_eq!((plan.method, plan.class), (Method::Replay, Class::Scene));
    assert_eq!(plan.shear, decision.known.rig.shear(&perspective()));
    assert!(plan.shear.is_some());
    assert_eq!(plan.flat, Flat::Scene, "it writes depths in perspective");
    assert_eq!(decision.known.camera, Some(perspective()));
    // Without depth writes, vertices with a w of 1 are not shifted.
    facts.state.depth = DepthState::TestOnly;
    let plan = decided(&facts, &known(), Strategy::Replay).plan;
    assert_eq!(plan.flat, Flat::Still);
}

#[test]
fn a_program_without_a_camera_takes_the_last_one() {
    let first = decided(&with_variant(|_| ()), &known(), Strategy::Replay);
    let facts = with_variant(|variant| (variant.camera, variant.lost) = (None, true));
    let next = decided(&facts, &first.known, Strategy::Replay);
    assert!(next.plan.variant);
    assert_eq!(next.plan.flat, Flat::Still, "no perspective of its own");
    let none = decided(&facts, &known(), Strategy::Replay);
    assert!(!none.plan.variant);
    let noted = |decision: &Decision| {
        decision
            .effects
            .iter()
            .any(|e| matches!(e, Effect::NoCamera(_)))
    };
    assert!(noted(&none));
    let rays = with_variant(|variant| {
        (variant.camera, variant.lost, variant.unprojects) = (None, true, true);
    });
    assert!(!noted(&decided(&rays, &known(), Strategy::Replay)));
    // Menus need no camera.
    let mut menu = facts;
    menu.state.depth = DepthState::Off;
    assert!(!noted(&decided(&menu, &known(), Strategy::Replay)));
}

#[test]
fn skies_and_flat_things_by_shaders() {
    let mut facts = with_variant(|_| ());
    facts.classed = classed(Class::Sky);
    let sky = decided(&facts, &known(), Strategy::Replay);
    assert_eq!(sky.plan.class, Class::Sky);
    assert_eq!(sky.plan.shear, sky.known.rig.sky(&perspective()));
    // All of a box moves by as much, whatever its w.
    assert_eq!(sky.plan.flat, sky.plan.shear.map_or(Flat::Still, Flat::By));
    let mut screen = facts;
    screen.shaders = with_variant(|variant| variant.lost = true).shaders;
    let screen = decided(&screen, &sky.known, Strategy::Replay);
    assert_eq!(screen.plan.flat, Flat::Still, "a picture over the screen");
    // A flat draw may still have vertices with a varying w.
    facts.classed = Classed {
        depth: 0.5,
        ..classed(Class::Flat)
    };
    let flat = decided(&facts, &known(), Strategy::Replay).plan;
    assert_eq!(flat.class, Class::Scene);
    assert!(matches!(flat.flat, Flat::By(_)), "{:?}", flat.flat);
    // A rule overrides that.
    facts.classed.why = Why::Rule(1);
    let ruled = decided(&facts, &known(), Strategy::Replay).plan;
    assert_eq!(ruled.class, Class::Flat);
    assert!(ruled.shear.is_some() && matches!(ruled.flat, Flat::By(_)));
    facts.classed = Classed {
        focal: Some(3.0),
        ..classed(Class::Scene)
    };
    let focal = decided(&facts, &known(), Strategy::Replay);
    let about = focal.known.rig.shear_about(&perspective(), 3.0);
    assert_eq!(focal.plan.shear, about);
}

#[test]
fn pixels_and_clears_go_by_no_variant() {
    for kind in [
        Kind::Pixels,
        Kind::Accum,
        Kind::Clear {
            depths: true,
            whole: 0,
        },
    ] {
        let mut facts = with_variant(|_| ());
        facts.traits.kind = kind;
        assert!(!decided(&facts, &known(), Strategy::Replay).plan.variant);
    }
}

#[test]
fn whole_buffers_have_no_shift() {
    for kind in [
        Kind::Accum,
        Kind::Clear {
            depths: true,
            whole: 0,
        },
    ] {
        for class in [Class::Scene, Class::Sky, Class::Flat] {
            let mut facts = scene();
            facts.traits.kind = kind;
            facts.classed = Classed {
                depth: 0.5,
                ..classed(class)
            };
            let plan = decided(&facts, &known(), Strategy::Replay).plan;
            assert_eq!(plan.shear, None, "{class:?}");
        }
    }
}

#[test]
fn all_views_at_once_where_layers_and_instances_are_free() {
    let at_once = |change: &dyn Fn(&mut Facts), known: &Known, strategy: Strategy| {
        let mut facts = with_variant(|variant| variant.to_layers = Linked::Yes);
        facts.destination.layered = true;
        change(&mut facts);
        let plan = decided(&facts, known, strategy).plan;
        let instanced = plan.method == Method::Instanced;
        assert!(!instanced || plan.reason.is_none(), "nothing is refused");
        instanced
    };
    let (known, instanced) = (known(), Strategy::Instanced);
    assert!(at_once(&|_| (), &known, instanced));
    assert!(!at_once(&|_| (), &known, Strategy::Replay));
    assert!(!at_once(
        &|f| f.destination.layered = false,
        &known,
        instanced
    ));
    assert!(!at_once(&|f| f.counted = true, &known, instanced));
    assert!(!at_once(&|f| f.reads_views = true, &known, instanced));
    assert!(!at_once(&|f| f.traits.kind = Kind::List, &known, instanced));
    let replays_all = Known {
        replays_all: true,
        ..known
    };
    assert!(!at_once(&|_| (), &replays_all, instanced));
    let change = |f: &mut Facts, change: &dyn Fn(&mut VariantFacts)| {
        let Shaders::Variant(variant) = &mut f.shaders else {
            panic!("a variant")
        };
        change(variant);
    };
    let unprojects = |f: &mut Facts| change(f, &|v| v.unprojects = true);
    assert!(!at_once(&unprojects, &known, instanced));
    let divided = |f: &mut Facts| change(f, &|v| v.divides = true);
    assert!(!at_once(&divided, &known, instanced));
    let refused = |f: &mut Facts| change(f, &|v| v.to_layers = Linked::Refused);
    assert!(!at_once(&refused, &known, instanced));
}

#[test]
fn a_picture_of_a_view_stands_where_that_view_has_it() {
    let mut facts = scene();
    facts.reads_views = true;
    facts.classed = Classed {
        depth: 0.5,
        ..classed(Class::Flat)
    };
    assert_eq!(decided(&facts, &known(), Strategy::Replay).plan.shear, None);
    // A scene that samples such a texture is still shifted, by replay.
    facts.classed = classed(Class::Scene);
    let plan = decided(&facts, &known(), Strategy::Geometry).plan;
    assert_eq!(plan.method, Method::Replay);
    assert!(plan.shear.is_some());
    assert_eq!(plan.reason, Some(Reason::Replayed(Replayed::SplitTexture)));
    let mut facts = with_variant(|_| ());
    facts.reads_views = true;
    facts.classed = Classed {
        depth: 0.5,
        ..classed(Class::Flat)
    };
    let plan = decided(&facts, &known(), Strategy::Replay).plan;
    assert_eq!(plan.flat, Flat::Still);
}
