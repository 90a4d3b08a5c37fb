//! Frames that are the same in all views.

use super::*;

const COLOURS: u32 = c::COLOR_BUFFER_BIT;
const DEPTHS: u32 = c::DEPTH_BUFFER_BIT;
const STENCILS: u32 = c::STENCIL_BUFFER_BIT;

fn clear(whole: u32, writable: u32) -> Facts {
    let mut facts = scene();
    facts.traits.kind = Kind::Clear {
        depths: true,
        whole,
    };
    facts.classed = classed(Class::Flat);
    facts.clear = ClearFacts {
        writable,
        unscissored: true,
        depth: 1.0,
    };
    facts
}

fn mono() -> Known {
    let mut known = known();
    known.mono.active = true;
    known
}

fn next(facts: &Facts, known: &Known) -> Decision {
    decided(facts, known, Strategy::Replay)
}

fn same(same: u32) -> Known {
    let mut known = known();
    known.mono.same = same;
    known
}

#[test]
fn a_scene_ends_it() {
    let decision = next(&scene(), &mono());
    assert_eq!(decision.effects, [Effect::LeaveMono]);
    assert!(!decision.known.mono.active);
    assert_eq!(decision.known.mono.same, STENCILS);
    // This happens once.
    assert_eq!(next(&scene(), &decision.known).effects, []);
}

#[test]
fn a_stencil_test_leaves_nothing_the_same() {
    let mut facts = scene();
    facts.state.stencil = true;
    assert_eq!(next(&facts, &mono()).known.mono.same, 0);
    let mut list = scene();
    list.traits.kind = Kind::List;
    assert_eq!(next(&list, &mono()).known.mono.same, 0, "it may set one");
}

#[test]
fn menus_and_clears_do_not_end_it() {
    let mut menu = scene();
    menu.classed = classed(Class::Flat);
    for facts in [menu, clear(COLOURS, COLOURS)] {
        let decision = next(&facts, &mono());
        assert_eq!(decision.effects, []);
        assert_eq!(decision.known.mono, mono().mono);
    }
}

#[test]
fn whatever_depends_on_the_view_ends_it() {
    let flat = |change: &dyn Fn(&mut Facts)| {
        let mut facts = scene();
        facts.classed = classed(Class::Flat);
        change(&mut facts);
        next(&facts, &mono()).effects == [Effect::LeaveMono]
    };
    assert!(!flat(&|_| ()));
    assert!(flat(&|f| f.classed.depth = 0.5), "stands elsewhere");
    assert!(flat(&|f| f.reads_views = true));
    assert!(flat(&|f| f.traits.kind = Kind::Accum));
    assert!(!flat(&|f| f.traits.kind = Kind::Pixels));
    assert!(flat(&|f| {
        f.traits.kind = Kind::Pixels;
        f.projections.raster_moves = true;
    }));
    assert!(!flat(&|f| f.traits.kind = Kind::List));
    assert!(flat(&|f| {
        f.traits.kind = Kind::List;
        f.destination.copies = true;
    }));
    assert!(!flat(&|f| f.projections.raster_moves = true));
}

#[test]
fn what_goes_elsewhere_or_once_is_no_matter() {
    let mut elsewhere = scene();
    elsewhere.destination.framebuffer = FramebufferName(3);
    elsewhere.destination.split = Linked::Yes;
    assert_eq!(next(&elsewhere, &mono()).effects, []);
    let mut once = scene();
    once.classed = classed(Class::OffScreen);
    assert_eq!(next(&once, &mono()).effects, []);
}

#[test]
fn clears_make_buffers_the_same_again() {
    let after = |facts: &Facts, before: u32| next(facts, &same(before)).known.mono.same;
    let all = COLOURS | DEPTHS | STENCILS;
    assert_eq!(after(&clear(all, all), 0), all);
    assert_eq!(after(&clear(COLOURS | DEPTHS, all), 0), COLOURS | DEPTHS);
    assert_eq!(after(&clear(all, DEPTHS), STENCILS), STENCILS | DEPTHS);
    let mut part = clear(all, all);
    part.rects.scissor = Some([0, 0, 8, 8]);
    assert_eq!(after(&part, 0), 0);
    let mut front = clear(all, all);
    front.destination.front = true;
    assert_eq!(after(&front, 0), 0);
    // Bits that belong to no buffer are ignored.
    assert_eq!(after(&clear(!0, !0), 0), all);
}

#[test]
fn a_draw_that_could_not_be_repeated_is_lost_unless_all_is_mono() {
    let mut mono = Mono::default();
    mono.lose();
    assert_eq!(mono.same, 0);
    let mut active = Mono {
        active: true,
        ..Mono::default()
    };
    active.lose();
    assert_eq!(active.same, ALL_BUFFERS);
}
