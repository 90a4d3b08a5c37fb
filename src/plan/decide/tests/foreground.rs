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
    assert!(!Foreground::default().has(FramebufferName::ZERO, DepthRange::Near));
    let known = with_range(Foreground::default(), 10, 2);
    assert!(
        known.has(FramebufferName::ZERO, DepthRange::Near)
            && !known.has(FramebufferName::ZERO, DepthRange::Whole)
    );
    // An empty hand says nothing.
    assert!(with_range(known, 10, 0).has(FramebufferName::ZERO, DepthRange::Near));
    // Programs that draw whole frames to one half of the range have no hand, nor have those that draw their scene to it.
    for (scene, weapon) in [(0, 20), (5, 9), (100, 33)] {
        assert!(!with_range(known, scene, weapon).has(FramebufferName::ZERO, DepthRange::Near));
    }
}

#[test]
fn what_follows_a_clear_of_the_depths_is_known_from_the_second_frame_on() {
    let after = |known: Foreground| {
        let mut now = known;
        cleared(&mut now, ALL);
        drawn(&mut now, DepthRange::Whole, 10);
        let before = now.has(FramebufferName::ZERO, DepthRange::Whole);
        cleared(&mut now, c::DEPTH_BUFFER_BIT);
        (before, now.has(FramebufferName::ZERO, DepthRange::Whole))
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

/// The picture of a framebuffer, and the window's after it.
#[test]
fn other_framebuffers_of_the_frame_do_not_hide_it() {
    const PASS: FramebufferName = FramebufferName(7);
    let command = |foreground: &mut Foreground, framebuffer: FramebufferName, kind: Kind| {
        let mut facts = scene();
        facts.traits.kind = kind;
        facts.traits.target = Target::Pass(framebuffer.0);
        facts.destination.framebuffer = framebuffer;
        foreground.observe(&facts);
    };
    let clear = |whole| Kind::Clear {
        depths: true,
        whole,
    };
    let draw = scene().traits.kind;
    let mut known = Foreground::default();
    command(&mut known, PASS, clear(ALL));
    (0..10).for_each(|_| command(&mut known, PASS, draw));
    // The depths of another framebuffer are cleared, and something is drawn there.
    let mut shadowed = known;
    command(
        &mut shadowed,
        FramebufferName(9),
        clear(c::DEPTH_BUFFER_BIT),
    );
    command(&mut shadowed, PASS, draw);
    let mut shadowed = shadowed.next();
    command(&mut shadowed, PASS, clear(ALL));
    command(&mut shadowed, PASS, draw);
    command(&mut shadowed, PASS, clear(c::DEPTH_BUFFER_BIT));
    assert!(!shadowed.has(PASS, DepthRange::Whole));
    command(&mut known, PASS, clear(c::DEPTH_BUFFER_BIT));
    command(&mut known, PASS, draw);
    // The window is cleared for the picture.
    cleared(&mut known, ALL);
    let mut known = known.next();
    command(&mut known, PASS, clear(ALL));
    command(&mut known, PASS, draw);
    assert!(!known.has(PASS, DepthRange::Whole));
    command(&mut known, PASS, clear(c::DEPTH_BUFFER_BIT));
    assert!(known.has(PASS, DepthRange::Whole));
    assert!(!known.has(FramebufferName(9), DepthRange::Whole));
    // A clear of a part, as for a picture in the picture, ends nothing.
    let mut part = scene();
    part.traits.kind = clear(ALL);
    part.rects.scissor = Some([0, 0, 9, 9]);
    let before = known;
    known.observe(&part);
    assert_eq!(known, before);
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
