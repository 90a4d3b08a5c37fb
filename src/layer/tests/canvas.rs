//! Canvases: one for each drawable, kept while it is not current, and the picture that is drawn when it is left.

use super::super::{CurrentDrawable, DrawableId};
use super::bench::Bench;
use crate::gl::consts as c;

const FOUR: [(&str, &str); 2] = [("VIEWS", "4"), ("STRATEGY", "replay")];
const KINDS: [&str; 2] = ["Textures", "Framebuffers"];

/// The first one is that of the bench.
fn drawable(number: u64) -> CurrentDrawable {
    CurrentDrawable {
        id: DrawableId(number),
        size: (64, 48),
    }
}

/// Makes a drawable current that this context alone draws to. `lives` tells which others there are.
fn switch(bench: &mut Bench, to: CurrentDrawable, lives: &dyn Fn(DrawableId) -> bool) {
    let gl = bench.gl;
    bench.layer.leave_drawable(&gl, false);
    bench.layer.switch(&gl, [to; 2], &|_| false, lives);
}

#[test]
fn a_drawable_has_its_atlas_as_long_as_it_lives() {
    let mut bench = Bench::new(&FOUR);
    let first = bench.layer.atlas().framebuffer();
    let one = bench.fake.alive(KINDS);
    switch(&mut bench, drawable(2), &|_| true);
    let second = bench.layer.atlas().framebuffer();
    assert_ne!(second, first);
    let both = bench.fake.alive(KINDS);
    assert!(
        both[0] > one[0] && both[1] == 2 * one[1],
        "{one:?}, {both:?}"
    );
    bench.clear();
    switch(&mut bench, drawable(1), &|_| true);
    assert_eq!(bench.layer.atlas().framebuffer(), first);
    assert!(bench.layer.owns_framebuffer(second));
    assert_eq!(bench.fake.alive(KINDS), both);
    switch(&mut bench, drawable(3), &|id| id != DrawableId(2));
    assert!(!bench.layer.owns_framebuffer(second));
    assert_eq!(bench.fake.alive(KINDS), both);
}

#[test]
fn few_windows_are_kept_that_have_nothing_to_show() {
    let atlases = |shown: bool| {
        let mut bench = Bench::new(&FOUR);
        let [_, one] = bench.fake.alive(KINDS);
        for number in 1..12 {
            switch(&mut bench, drawable(number), &|_| true);
            bench.clear();
            if shown {
                bench.swap();
            }
        }
        let [_, all] = bench.fake.alive(KINDS);
        all / one
    };
    assert_eq!(atlases(true), 5, "the current one, and four others");
    assert_eq!(atlases(false), 11);
}

#[test]
fn who_leaves_a_drawable_draws_its_picture_if_something_was_drawn() {
    let mut bench = Bench::new(&FOUR);
    let pictures = |bench: &mut Bench| {
        bench.fake.forget();
        let gl = bench.gl;
        bench.layer.leave_drawable(&gl, false);
        bench.fake.count("glDrawArrays")
    };
    assert_eq!(pictures(&mut bench), 0);
    bench.clear();
    bench.look();
    bench.draw();
    assert_eq!(pictures(&mut bench), 1);
    assert_eq!(pictures(&mut bench), 0, "the picture is there");
    bench.draw();
    assert_eq!(pictures(&mut bench), 1);
    bench.swap();
    assert_eq!(pictures(&mut bench), 0, "it was shown");
}

#[test]
fn a_context_without_a_drawable_draws_to_the_true_framebuffer() {
    let mut bench = Bench::new(&FOUR);
    let gl = bench.gl;
    let first = bench.layer.atlas().framebuffer();
    switch(&mut bench, CurrentDrawable::NONE, &|_| true);
    assert!(bench.layer.atlas().is_plain());
    let bound = gl.get_integer(c::DRAW_FRAMEBUFFER_BINDING);
    assert_eq!(bound, 0);
    bench.fake.forget();
    bench.look();
    bench.draw();
    assert_eq!(bench.fake.count("glDrawArrays"), 1, "the own view alone");
    switch(&mut bench, drawable(1), &|_| true);
    assert_eq!(bench.layer.atlas().framebuffer(), first);
}

/// Framebuffer 0 is read from another drawable than is drawn to.
#[test]
fn the_drawable_that_is_read_is_bound_for_reading() {
    let mut bench = Bench::new(&FOUR);
    let gl = bench.gl;
    let first = bench.layer.atlas().framebuffer();
    switch(&mut bench, drawable(2), &|_| true);
    let second = bench.layer.atlas().framebuffer();
    let bound = || {
        [c::DRAW_FRAMEBUFFER_BINDING, c::READ_FRAMEBUFFER_BINDING]
            .map(|name| gl.get_integer(name) as u32)
    };
    for (drawables, elsewhere, expected) in [
        ([drawable(2), drawable(1)], None, [second.0, first.0]),
        ([drawable(1), drawable(2)], None, [first.0, second.0]),
        // Another context has drawn to it since, or this one never.
        (
            [drawable(1), drawable(2)],
            Some(DrawableId(2)),
            [first.0, 0],
        ),
        ([drawable(1), drawable(7)], None, [first.0, 0]),
        ([drawable(2), drawable(2)], None, [second.0, second.0]),
    ] {
        let elsewhere = |id| Some(id) == elsewhere;
        bench.layer.switch(&gl, drawables, &elsewhere, &|_| true);
        assert_eq!(bound(), expected, "{drawables:?}");
    }
}

/// The true framebuffer 0 that is drawn to is that of the other one.
#[test]
fn a_drawable_that_is_read_and_gets_no_image_leaves_the_other_one_alone() {
    /// GL_FRAMEBUFFER_UNSUPPORTED.
    const UNSUPPORTED: u32 = 0x8CDD;
    let mut bench = Bench::new(&FOUR);
    let gl = bench.gl;
    bench.clear();
    switch(&mut bench, drawable(2), &|_| true);
    let second = bench.layer.atlas().framebuffer();
    let drawables = [drawable(2), drawable(1)];
    bench.layer.switch(&gl, drawables, &|_| false, &|_| true);
    bench.fake.set_framebuffer_status(UNSUPPORTED);
    bench.fake.forget();
    assert!(bench.layer.make_read_singles(&gl));
    for command in ["glBlitFramebuffer", "glDrawBuffer", "glDrawBuffers"] {
        assert_eq!(bench.fake.count(command), 0, "{command}");
    }
    assert_eq!(bench.layer.atlas().framebuffer(), second);
    assert!(!bench.layer.reads_views());
    let bound = [c::DRAW_FRAMEBUFFER_BINDING, c::READ_FRAMEBUFFER_BINDING];
    let bound = bound.map(|name| gl.get_integer(name) as u32);
    assert_eq!(bound, [second.0, 0]);
}
