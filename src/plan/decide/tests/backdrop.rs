//! Whether a frame begins with a backdrop, by the frame before it.

use super::*;

/// A frame of so many draws around the eye, a clear, and so many draws elsewhere. Returns whether the next frame expects a backdrop.
fn expected(around: u32, clear: Option<Facts>, after: u32) -> bool {
    let mut frame = Frame::default();
    for _ in 0..around {
        frame.backdrop.observe(&turned());
    }
    clear.iter().for_each(|clear| frame.backdrop.observe(clear));
    for _ in 0..after {
        frame.backdrop.observe(&scene());
    }
    frame.next().backdrop.stage() == BackdropStage::Expected
}

fn turned() -> Facts {
    let mut facts = scene();
    facts.traits.turns = true;
    facts
}

/// A clear of whole buffers, as bits of glClear.
fn cleared(whole: u32) -> Facts {
    let mut facts = scene();
    facts.traits.kind = Kind::Clear {
        depths: whole & c::DEPTH_BUFFER_BIT != 0,
        whole,
    };
    facts.clear.unscissored = true;
    facts
}

#[test]
fn depths_that_are_cleared_after_draws_around_the_eye_make_a_backdrop() {
    let depths = || Some(cleared(c::DEPTH_BUFFER_BIT));
    assert!(expected(5, depths(), 6));
    assert!(!expected(5, None, 6), "its depths stay");
    assert!(!expected(0, depths(), 6), "nothing came before");
    assert!(
        !expected(5, depths(), 5),
        "a weapon over a scene around the eye"
    );
    assert!(!expected(33, depths(), 90), "too many draws");
    assert!(!expected(5, Some(cleared(ALL_BUFFERS)), 6), "it is gone");
    let mut part = cleared(c::DEPTH_BUFFER_BIT);
    part.clear.unscissored = false;
    assert!(!expected(5, Some(part), 6), "some of its depths stay");
}

#[test]
fn a_backdrop_ends_with_the_first_draw_elsewhere() {
    let mut frame = Frame::default();
    frame.backdrop.observe(&turned());
    assert!(frame.backdrop.may_go_on() && frame.backdrop.stage() == BackdropStage::None);
    let mut flat = turned();
    flat.traits.projection = Projection::Orthographic;
    let mut elsewhere = scene();
    elsewhere.traits.target = Target::Framebuffer(1);
    let mut inset = scene();
    inset.traits.viewport = Viewport::Inset;
    for other in [flat, elsewhere, inset] {
        frame.backdrop.observe(&other);
        assert!(frame.backdrop.may_go_on());
    }
    let mut sun = scene();
    sun.traits.depth_state = DepthState::Off;
    frame.backdrop.observe(&sun);
    assert!(frame.backdrop.may_go_on());
    frame.backdrop.observe(&scene());
    assert!(!frame.backdrop.may_go_on());
    // What comes around the eye later is not before the scene.
    frame.backdrop.observe(&turned());
    frame.backdrop.observe(&cleared(c::DEPTH_BUFFER_BIT));
    assert_eq!(frame.next().backdrop.stage(), BackdropStage::None);
}

#[test]
fn what_has_no_depths_begins_no_backdrop() {
    let mut frame = Frame::default();
    let mut sun = scene();
    sun.traits.depth_state = DepthState::Off;
    frame.backdrop.observe(&sun);
    assert!(!frame.backdrop.may_go_on());
}

#[test]
fn a_frame_is_drawn_by_what_the_last_one_was() {
    let mut frame = Frame::default();
    for command in [turned(), cleared(c::DEPTH_BUFFER_BIT), scene(), scene()] {
        frame.backdrop.observe(&command);
        assert_eq!(frame.backdrop.stage(), BackdropStage::None);
    }
    let mut next = frame.next();
    assert_eq!(next.backdrop.stage(), BackdropStage::Expected);
    next.backdrop.observe(&turned());
    assert_eq!(next.backdrop.stage(), BackdropStage::Begun);
    next.backdrop.observe(&cleared(c::DEPTH_BUFFER_BIT));
    assert_eq!(
        next.backdrop.stage(),
        BackdropStage::None,
        "this is the scene"
    );
}
