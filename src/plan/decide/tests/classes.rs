//! The plan of each class under fixed function.

use super::*;

#[test]
fn a_scene_is_replayed_with_the_shift_of_its_projection() {
    let decision = decided(&scene(), &known(), Strategy::Replay);
    assert_eq!(decision.plan.method, Method::Replay);
    assert_eq!(decision.plan.reason, None);
    assert!(decision.plan.shear.is_some());
    assert_eq!(
        decision.plan.shear,
        decision.known.rig.shear(&perspective()),
        "the rig that the first projection has set"
    );
    assert!(known().rig.shear(&perspective()).is_none());
}

#[test]
fn a_picture_in_the_picture_stands_where_the_display_does() {
    let mut facts = scene();
    facts.classed = Classed {
        depth: 0.25,
        why: Why::Orthographic,
        ..classed(Class::Flat)
    };
    let mut pixels = |width: i32, height: i32, viewport: Viewport| {
        facts.rects.viewport = [16, 16, width, height];
        facts.traits.viewport = viewport;
        let plan = decided(&facts, &known(), Strategy::Replay).plan;
        plan.shear.expect("a shift").separation(1.0) * f64::from(width) / 2.0
    };
    let whole = pixels(640, 480, Viewport::Main);
    assert!((pixels(64, 48, Viewport::Inset) - whole).abs() < 1e-9);
    // Half of a split screen has its own scene.
    assert!((pixels(320, 480, Viewport::Main) - whole / 2.0).abs() < 1e-9);
}
