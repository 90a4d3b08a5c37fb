//! Frames on the fake driver: what is drawn for them, that their state comes back, and what the driver is asked.

use super::super::frame::Frame;
use super::bench::{Bench, MESA, PERSPECTIVE};
use crate::gl::ListName;
use crate::gl::consts as c;
use crate::gl::fake::Fake;
use crate::state::Touch;

fn replayed(options: &[(&str, &str)]) -> Bench {
    let options: Vec<_> = [("VIEWS", "4"), ("STRATEGY", "replay")]
        .into_iter()
        .chain(options.iter().copied())
        .collect();
    let mut bench = Bench::new(&options);
    bench.look();
    bench
}

#[test]
fn a_frame_ends_without_its_list_and_its_draws_but_keeps_what_was_amplified() {
    let mut frame = Frame::default();
    assert_eq!((frame.list(), frame.drawn()), (None, false));
    let list = Some(ListName(3));
    frame.calls(list);
    frame.draws();
    assert_eq!((frame.list(), frame.drawn()), (list, true));
    assert!(!frame.take_amplified(), "it was replayed");
    frame.amplifies();
    // A flush shows a frame whose time is not taken.
    frame.end();
    assert_eq!((frame.list(), frame.drawn()), (None, false));
    assert!(frame.take_amplified());
    assert!(!frame.take_amplified(), "it is taken once");
}

#[test]
fn one_triangle_is_drawn_once_for_each_view() {
    let mut bench = replayed(&[]);
    bench.clear();
    let before = bench.fake.state();
    bench.draw();
    let drawn = bench.drawn("glDrawArrays");
    let places: Vec<f64> = drawn
        .iter()
        .map(|drawn| drawn.state.value(c::VIEWPORT)[0])
        .collect();
    assert_eq!(places, [64.0, 128.0, 192.0, 0.0], "the own view last");
    for drawn in &drawn {
        assert_eq!(
            drawn.state.value(c::SCISSOR_BOX),
            drawn.state.value(c::VIEWPORT)
        );
        assert!(drawn.state.is_enabled(c::SCISSOR_TEST));
    }
    let mut aside: Vec<f64> = drawn
        .iter()
        .map(|drawn| drawn.state.value(c::PROJECTION_MATRIX)[8])
        .collect();
    aside.sort_by(f64::total_cmp);
    let step = aside[1] - aside[0];
    assert!(
        step > 0.0 && aside.iter().sum::<f64>().abs() < 1e-6,
        "{aside:?}"
    );
    assert!(aside.windows(2).all(|w| (w[1] - w[0] - step).abs() < 1e-6));
    bench.fake.assert_restored(&before);
    let matrix = PERSPECTIVE.map(f64::from);
    assert_eq!(bench.fake.value(c::PROJECTION_MATRIX), matrix);
}

#[test]
fn a_swap_draws_the_picture_into_the_window_and_leaves_no_trace() {
    let mut bench = replayed(&[]);
    bench.clear();
    bench.draw();
    let before = bench.fake.state();
    bench.fake.forget();
    bench.swap();
    let drawn = bench.drawn("glDrawArrays");
    assert_eq!(drawn.len(), 1);
    let state = &drawn[0].state;
    assert_eq!(state.value(c::DRAW_FRAMEBUFFER_BINDING), [0.0]);
    assert_eq!(state.value(c::VIEWPORT), [0.0, 0.0, 64.0, 48.0]);
    assert_ne!(state.value(c::CURRENT_PROGRAM), [0.0]);
    assert!(!state.is_enabled(c::DEPTH_TEST));
    bench.fake.assert_restored(&before);
}

#[test]
fn each_strategy_draws_as_often_as_it_says() {
    let cases = [("replay", 4), ("instanced", 1), ("geometry", 1)];
    for (strategy, draws) in cases {
        let mut bench = Bench::new(&[("VIEWS", "4"), ("STRATEGY", strategy)]);
        bench.look();
        bench.frame();
        let before = bench.fake.state();
        bench.fake.forget();
        bench.clear();
        bench.draw();
        let all = bench.fake.draws();
        let count = all.iter().filter(|d| d.call.name.starts_with("glDraw"));
        assert_eq!(count.count(), draws, "{strategy}");
        if strategy == "instanced" {
            assert_eq!(
                bench.fake.lines("glDraw*"),
                ["glDrawArraysInstanced(4, 0, 3, 4)"]
            );
        }
        bench.fake.assert_restored(&before);
        bench.swap();
        bench.fake.assert_restored(&before);
    }
}

/// What the layer asks the driver for each draw of a scene in a steady state. Whatever is listed is one question too many.
#[test]
fn what_a_draw_asks_is_known() {
    let cases: [(&str, &[(&str, usize)]); 3] = [
        ("replay", &[]),
        ("instanced", &[("glGetFloatv GL_MODELVIEW_MATRIX", 1)]),
        ("geometry", &[("glGetFloatv GL_MODELVIEW_MATRIX", 1)]),
    ];
    for (strategy, known) in cases {
        let mut bench = Bench::new(&[("VIEWS", "4"), ("STRATEGY", strategy)]);
        bench.look();
        bench.frame();
        bench.clear();
        bench.draw();
        bench.fake.forget();
        bench.draw();
        let asked = bench.fake.asked();
        let asked: Vec<_> = asked.iter().map(|(what, n)| (what.as_str(), *n)).collect();
        assert_eq!(asked, known, "{strategy}");
    }
}

/// The number of questions for a clear and for a swap.
#[test]
fn what_a_frame_asks_is_known() {
    let mut bench = replayed(&[]);
    bench.frame();
    bench.frame();
    bench.fake.forget();
    bench.clear();
    let total = |bench: &Bench| bench.fake.asked().iter().map(|a| a.1).sum::<usize>();
    assert_eq!(total(&bench), 2, "{:?}", bench.fake.asked());
    bench.draw();
    bench.fake.forget();
    bench.swap();
    assert_eq!(total(&bench), 83, "{:#?}", bench.fake.asked());
}

#[test]
fn a_state_that_nobody_expects_comes_back() {
    for strategy in ["replay", "instanced", "geometry"] {
        for seed in 0..16 {
            let mut bench = Bench::new(&[("VIEWS", "3"), ("STRATEGY", strategy)]);
            bench.look();
            bench.fake.scramble(seed, true);
            bench.layer.touch(Touch::ALL);
            let before = bench.fake.state();
            bench.clear();
            bench.draw();
            let differences = before.differences(&bench.fake.state());
            assert_eq!(differences, [""; 0], "draw, {strategy}, seed {seed}");
            bench.swap();
            let differences = before.differences(&bench.fake.state());
            assert_eq!(differences, [""; 0], "swap, {strategy}, seed {seed}");
        }
    }
}

#[test]
fn contexts_without_fixed_function_run_as_well() {
    let contexts: [fn() -> Fake; 4] = [
        || Fake::new().core().extensions(MESA),
        || Fake::new().version(3, 1).extensions(MESA),
        || Fake::new().es(3, 0),
        || Fake::new().es(3, 2),
    ];
    for context in contexts {
        for seed in 0..6 {
            let mut bench = Bench::on(context(), &[("VIEWS", "3"), ("STRATEGY", "replay")]);
            bench.fake.scramble(seed, false);
            bench.layer.touch(Touch::ALL);
            let before = bench.fake.state();
            bench.frame();
            let version = bench.gl.get_string(c::VERSION);
            let differences = before.differences(&bench.fake.state());
            assert_eq!(differences, [""; 0], "{version}, seed {seed}");
        }
    }
}

#[test]
fn a_frame_makes_no_names_that_it_does_not_give_back() {
    let kinds = [
        "Textures",
        "Framebuffers",
        "Buffers",
        "VertexArrays",
        "Programs",
    ];
    let mut bench = replayed(&[]);
    bench.frame();
    let held = bench.fake.alive(kinds);
    (0..5).for_each(|_| bench.frame());
    assert_eq!(bench.fake.alive(kinds), held);
    let gl = bench.gl;
    bench.layer.resize(&gl, 80, 60);
    bench.frame();
    assert_eq!(bench.fake.alive(kinds), held, "after another size");
}
