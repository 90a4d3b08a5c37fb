//! What is drawn before everything else, such as a weapon.

use super::*;
use crate::plan::decide::Foreground;

fn drawn(foreground: &mut Foreground, range: DepthRange, count: u32) {
    let mut facts = scene();
    facts.traits.range = range;
    (0..count).for_each(|_| foreground.observe(&facts));
}

fn cleared(foreground: &mut Foreground, whole: u32) {
    let mut facts = scene();
    facts.traits.kind = Kind::Clear {
        depths: whole & c::DEPTH_BUFFER_BIT != 0,
        whole,
    };
    facts.classed = classed(Class::Flat);
    foreground.observe(&facts);
}

const ALL: u32 = c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT;

/// A frame of a scene and a weapon in the near part of the depth range.
fn with_range(mut foreground: Foreground, scene: u32, weapon: u32) -> Foreground {
    cleared(&mut foreground, ALL);
    drawn(&mut foreground, DepthRange::Whole, scene);
    drawn(&mut foreground, DepthRange::Near, weapon);
    foreground.next()
}

/// A frame of a scene, a clear of the depths, and a weapon.
fn with_clear(mut foreground: Foreground, scene: u32, weapon: u32) -> Foreground {
    cleared(&mut foreground, ALL);
    drawn(&mut foreground, DepthRange::Whole, scene);
    cleared(&mut foreground, c::DEPTH_BUFFER_BIT);
    drawn(&mut foreground, DepthRange::Whole, weapon);
    foreground.next()
}

#[test]
fn the_near_part_of_the_depth_range_is_known_from_the_second_frame_on() {
    assert!(!Foreground::default().has(DepthRange::Near));
    let known = with_range(Foreground::default(), 10, 2);
    assert!(known.has(DepthRange::Near) && !known.has(DepthRange::Whole));
    // An empty hand says nothing.
    assert!(with_range(known, 10, 0).has(DepthRange::Near));
    // Programs that draw whole frames to one half of the range have no hand, nor have those that draw their scene to it.
    for (scene, weapon) in [(0, 20), (5, 9), (100, 33)] {
        assert!(!with_range(known, scene, weapon).has(DepthRange::Near));
    }
}

#[test]
fn what_follows_a_clear_of_the_depths_is_known_from_the_second_frame_on() {
    let after = |known: Foreground| {
        let mut now = known;
        cleared(&mut now, ALL);
        drawn(&mut now, DepthRange::Whole, 10);
        let before = now.has(DepthRange::Whole);
        cleared(&mut now, c::DEPTH_BUFFER_BIT);
        (before, now.has(DepthRange::Whole))
    };
    assert_eq!(after(Foreground::default()), (false, false));
    let known = with_clear(Foreground::default(), 10, 2);
    assert_eq!(after(known), (false, true));
    assert_eq!(after(with_clear(known, 10, 0)), (false, true));
    // A sky or a distance before the scene.
    for (scene, weapon) in [(2, 10), (5, 5), (100, 33)] {
        assert_eq!(after(with_clear(known, scene, weapon)), (false, false));
    }
    // Other pictures in the frame count for nothing.
    let mut other = known;
    let mut inset = scene();
    inset.traits.viewport = Viewport::Inset;
    other.observe(&inset);
    assert_eq!(other, known);
}

#[test]
fn a_foreground_has_cameras_of_its_own() {
    let camera = Camera::Measured(None);
    let mut rig = Rig::new(5, camera, None);
    rig.set_measured((0.01, 4.0), 1.0, Some((-0.002, -1.0)));
    let mut known = Known::new(rig);
    known.depths.begun = true;
    let mut facts = scene();
    facts.classed.why = Why::Foreground;
    let plan = |facts: &Facts| decided(facts, &known, Strategy::Replay).plan.shear;
    let numbers = |facts: &Facts| plan(facts).map(|s| (s.separation(1.0), s.conv));
    assert_eq!(numbers(&facts), Some((-0.002, -1.0)));
    facts.classed.why = Why::Perspective;
    assert_eq!(numbers(&facts), Some((0.01, 4.0)));
}
