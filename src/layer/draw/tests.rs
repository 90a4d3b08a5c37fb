//! The facts of a command, and the requests of hooks, on the fake driver.
#![forbid(unsafe_code)]

use super::Request;
use crate::config::Projection;
use crate::gl::{FramebufferName, ListName, consts as c};
use crate::layer::tests::bench::Bench;
use crate::layer::tests::variants::program;
use crate::plan::class::Target;
use crate::plan::decide::{Linked, Shaders};
use crate::plan::{Facts, Kind};
use crate::state::Touch;

const CLEAR: Kind = Kind::Clear {
    depths: true,
    whole: c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT,
};
const TRIANGLES: Kind = Kind::Arrays(c::TRIANGLES);

fn bench(options: &[(&str, &str)]) -> Bench {
    let options = [("VIEWS", "4")].into_iter().chain(options.iter().copied());
    let mut bench = Bench::new(&options.collect::<Vec<_>>());
    bench.look();
    bench
}

impl Bench {
    fn facts(&mut self, kind: Kind) -> Facts {
        let gl = self.gl;
        self.layer.state.refresh(&gl);
        self.layer.observe(&gl, &Request::of(kind)).0
    }
}

#[test]
fn a_scissor_box_around_the_window_cuts_nothing_off() {
    let mut bench = bench(&[]);
    assert!(bench.facts(CLEAR).clear.unscissored);
    bench.set(Touch::RECTS, |gl| gl.enable(c::SCISSOR_TEST));
    for (scissor, whole) in [
        ([0, 0, 64, 48], true),
        ([-5, -7, 69, 55], true),
        ([-5, -7, 68, 55], false),
        ([-5, -7, 69, 54], false),
        ([0, 0, 63, 48], false),
        ([0, 0, 64, 47], false),
        ([1, 0, 64, 48], false),
        ([0, 1, 64, 48], false),
    ] {
        let [x, y, w, h] = scissor;
        bench.set(Touch::RECTS, |gl| gl.scissor(x, y, w, h));
        assert_eq!(bench.facts(CLEAR).clear.unscissored, whole, "{scissor:?}");
        assert_eq!(bench.facts(TRIANGLES).rects.scissor, Some(scissor));
    }
    bench.set(Touch::RECTS, |gl| gl.disable(c::SCISSOR_TEST));
    assert!(bench.facts(CLEAR).clear.unscissored);
    assert_eq!(bench.facts(TRIANGLES).rects.scissor, None);
}

#[test]
fn draws_are_counted_and_know_what_came_before_them() {
    let mut bench = bench(&[]);
    bench.clear();
    let traits = bench.facts(TRIANGLES).traits;
    assert_eq!((traits.draw, traits.first), (1, true));
    assert_eq!(traits.projection, Projection::Perspective);
    bench.draw();
    let traits = bench.facts(TRIANGLES).traits;
    assert_eq!((traits.draw, traits.first), (2, false));
    assert_eq!((traits.clear, traits.after_clear), (1, 2));
    // A clear is not counted, and begins anew.
    let traits = bench.facts(CLEAR).traits;
    assert_eq!((traits.draw, traits.first), (1, true));
    bench.clear();
    let traits = bench.facts(TRIANGLES).traits;
    assert_eq!((traits.draw, traits.first), (2, true));
    assert_eq!((traits.clear, traits.after_clear), (2, 1));
}

#[test]
fn a_draw_of_a_list_says_so() {
    let mut bench = bench(&[]);
    assert_eq!(bench.facts(TRIANGLES).traits.list, None);
    bench.layer.frame.calls(Some(ListName(7)));
    assert_eq!(bench.facts(TRIANGLES).traits.list, Some(ListName(7)));
}

#[test]
fn the_raster_position_says_by_which_projection_it_was_placed() {
    let mut bench = bench(&[]);
    assert_eq!(bench.facts(Kind::Pixels).traits.raster, Projection::None);
    let gl = bench.gl;
    bench.layer.placed_raster(&gl);
    let placed = bench.facts(Kind::Pixels);
    assert_eq!(placed.traits.raster, Projection::Perspective);
    bench.layer.placed_in_window();
    assert_eq!(bench.facts(Kind::Pixels).traits.raster, Projection::None);
}

#[test]
fn a_program_is_told_by_its_number_where_somebody_asks() {
    for (options, asked) in [(&[][..], false), (&[("EXPLAIN", "explained")][..], true)] {
        let mut bench = bench(options);
        let fixed = bench.facts(TRIANGLES).traits;
        assert_eq!((fixed.program, fixed.shader), (0, 0));
        program(&mut bench);
        bench.layer.touch(Touch::OBJECTS);
        let traits = bench.facts(TRIANGLES).traits;
        assert_eq!(traits.program > 0, asked);
        assert_eq!(traits.shader != 0, asked);
    }
}

#[test]
fn draws_say_where_they_go() {
    let mut bench = bench(&[]);
    let window = bench.facts(TRIANGLES);
    assert_eq!(window.traits.target, Target::Window);
    assert!(window.destination.picture && window.destination.is_window());
    let own = bench.fake.program(|gl| gl.gen_framebuffer());
    bench.bind(own);
    let aside = bench.facts(TRIANGLES);
    // It has no images, so it cannot hold a part of the window's picture.
    assert!(matches!(aside.traits.target, Target::Framebuffer(_)));
    assert_eq!(aside.destination.framebuffer, own);
    assert!(!aside.destination.is_window());
    bench.bind(FramebufferName::ZERO);
    assert_eq!(bench.facts(TRIANGLES).traits.target, Target::Window);
}

#[test]
fn a_clear_begins_a_scene_and_a_draw_does_not() {
    let options = [("STRATEGY", "depth-image"), ("OUTPUT", "panel")];
    let mut bench = bench(&options);
    let (clear, draw) = (bench.facts(CLEAR), bench.facts(TRIANGLES));
    assert_eq!(clear.synthesis.hindrance, None);
    assert!(!clear.synthesis.over_last && !draw.synthesis.over_last);
    bench.clear();
    bench.draw();
    assert!(bench.layer.known.scene.is_some_and(|scene| scene.begun));
    bench.fake.forget();
    bench.draw();
    assert_eq!(
        bench.drawn("glDrawArrays").len(),
        1,
        "in the own view alone"
    );
    // A draw that writes no depths, of vertices that cannot be compared, ends the scene.
    bench.set(Touch::DEPTH, |gl| gl.depth_mask(0));
    bench.fake.forget();
    bench.draw();
    assert!(bench.layer.known.scene.is_none() && bench.layer.known.synthesised);
}

#[test]
fn a_request_that_is_no_surface_has_no_reference_image() {
    let mut bench = bench(&[("STRATEGY", "occlusion"), ("OUTPUT", "panel")]);
    // The map is that of the frame before.
    for _ in 0..3 {
        bench.frame();
    }
    bench.clear();
    let gl = bench.gl;
    bench.layer.state.refresh(&gl);
    let mut request = Request::of(Kind::List);
    let with = bench.layer.observe(&gl, &request).0;
    assert!(with.synthesis.reference.is_some());
    request.surfaces = false;
    let without = bench.layer.observe(&gl, &request).0;
    assert_eq!(without.synthesis.reference, None);
}

/// The report's draws by method, and by class.
fn counted(bench: &Bench) -> [serde_json::Value; 2] {
    let report = bench.layer.diagnostics.report.json();
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    ["draws", "classes"].map(|key| report[key].clone())
}

#[test]
fn each_draw_is_counted_once_by_the_method_that_made_it() {
    // Clears are always replayed, so they count for `replay` only.
    for (strategy, count) in [("replay", 3), ("instanced", 2), ("geometry", 2)] {
        let mut bench = bench(&[("STRATEGY", strategy)]);
        bench.clear();
        bench.draw();
        bench.draw();
        let [draws, classes] = counted(&bench);
        assert_eq!(draws[strategy], count, "{draws}");
        assert_eq!(classes["scene"], 2, "{classes}");
        assert_eq!(classes["flat"], 1, "{classes}");
    }
}

#[test]
fn a_scene_in_a_framebuffer_of_the_program_is_drawn_in_each_view() {
    let mut bench = bench(&[("STRATEGY", "replay")]);
    bench.frame();
    let (own, ..) = bench.fake.framebuffer(64, 48);
    bench.bind(own);
    bench.clear();
    let before = bench.fake.state();
    bench.fake.forget();
    bench.draw();
    let drawn = bench.drawn("glDrawArrays");
    assert_eq!(drawn.len(), 4);
    let mut framebuffers: Vec<_> = drawn
        .iter()
        .map(|drawn| drawn.state.value(c::DRAW_FRAMEBUFFER_BINDING)[0] as u32)
        .collect();
    // Each view has a framebuffer like it, and the own one's is written back before somebody reads the program's.
    assert!(!framebuffers.contains(&own.0), "{framebuffers:?}");
    framebuffers.sort_unstable();
    framebuffers.dedup();
    assert_eq!(framebuffers.len(), 4, "{framebuffers:?}");
    bench.fake.assert_restored(&before);
}

#[test]
fn only_surfaces_of_fixed_function_are_asked_how_they_are_filled() {
    let options = [("VIEW_SCALE", "auto"), ("OUTPUT", "panel")];
    let mut bench = bench(&options);
    assert!(!bench.layer.targets.atlas.tiles.grid.is_full());
    let filled = bench.facts(TRIANGLES).grid.expect("a grid");
    assert!(filled.aligned && !filled.outlined && !filled.stippled);
    bench.set(Touch::ALL, |gl| gl.polygon_mode(c::FRONT_AND_BACK, c::LINE));
    assert!(bench.facts(TRIANGLES).grid.expect("a grid").outlined);
    assert!(!bench.facts(Kind::Pixels).grid.expect("a grid").outlined);
    bench.set(Touch::ALL, |gl| gl.enable(c::POLYGON_STIPPLE));
    let stippled = bench.facts(TRIANGLES).grid.expect("a grid");
    // Such a draw has another atlas anyway, so nothing more is asked.
    assert!(stippled.stippled && !stippled.outlined);
    program(&mut bench);
    bench.layer.touch(Touch::OBJECTS);
    let shaded = bench.facts(TRIANGLES).grid.expect("a grid");
    assert!(!shaded.stippled && !shaded.outlined);
}

#[test]
fn a_clear_is_asked_for_the_buffers_that_it_clears() {
    let mut bench = bench(&[("STRATEGY", "depth-image"), ("OUTPUT", "panel")]);
    let both = c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT;
    for whole in [0, c::COLOR_BUFFER_BIT, c::DEPTH_BUFFER_BIT, both] {
        let kind = Kind::Clear {
            depths: true,
            whole,
        };
        assert_eq!(bench.facts(kind).clear.writable, whole);
    }
}

#[test]
fn the_modelview_is_read_only_where_a_rule_needs_it() {
    let mut bench = bench(&[]);
    bench.frame();
    bench.clear();
    bench.draw();
    bench.layer.touch(Touch::MODELVIEW);
    bench.fake.forget();
    bench.facts(TRIANGLES);
    let asked = bench.fake.asked();
    let modelview = |(call, _): &(String, usize)| call.contains("MODELVIEW_MATRIX");
    assert!(!asked.iter().any(modelview), "{asked:?}");
    // Without the depth test the draw may be a sky.
    bench.clear();
    bench.set(Touch::DEPTH, |gl| gl.disable(c::DEPTH_TEST));
    bench.layer.touch(Touch::MODELVIEW);
    bench.fake.forget();
    bench.facts(TRIANGLES);
    let asked = bench.fake.asked();
    assert!(asked.iter().any(modelview), "{asked:?}");
}

/// A modelview that is left over from fixed function says nothing about a program that places its vertices itself.
#[test]
fn the_modelview_turns_fixed_function_alone() {
    let mut bench = bench(&[]);
    bench.frame();
    bench.clear();
    bench.set(Touch::DEPTH, |gl| gl.disable(c::DEPTH_TEST));
    let turned = glam::Mat4::from_rotation_y(0.3).to_cols_array();
    bench.set(Touch::MODELVIEW, |gl| gl.load_matrix(&turned));
    assert!(bench.facts(TRIANGLES).traits.is_around_eye());
    let (program, gl) = (program(&mut bench), bench.gl);
    bench.layer.link_variant(&gl, program);
    bench.layer.touch(Touch::OBJECTS);
    let facts = bench.facts(TRIANGLES);
    assert!(matches!(facts.shaders, Shaders::Variant(_)));
    assert!(!facts.traits.is_around_eye());
}

#[test]
fn selection_asks_nothing_of_the_programs_framebuffer() {
    let mut bench = bench(&[("STRATEGY", "replay")]);
    bench.frame();
    let (own, ..) = bench.fake.framebuffer(64, 48);
    bench.bind(own);
    bench.clear();
    bench.draw();
    let split = bench.facts(TRIANGLES).destination;
    assert!(split.picture && split.differs);
    assert_eq!(split.split, Linked::Yes);
    bench.layer.render_mode(c::SELECT);
    let selected = bench.facts(TRIANGLES).destination;
    assert!(!selected.picture && !selected.differs);
    assert_eq!(selected.split, Linked::Untried);
}

#[test]
fn depths_are_shown_by_one_output_alone() {
    for (output, shown) in [("panel", false), ("rgbd", true)] {
        let bench = bench(&[("STRATEGY", "replay"), ("OUTPUT", output)]);
        assert_eq!(bench.layer.settings().shows_depth, shown, "{output}");
    }
}

/// A pass over the surface that was drawn last is known by the positions of its vertices, where those are in the program's memory.
#[test]
fn a_surface_is_asked_where_its_vertices_are() {
    let mut bench = bench(&[("STRATEGY", "depth-image"), ("OUTPUT", "panel")]);
    for _ in 0..2 {
        bench.frame();
    }
    bench.clear();
    bench.fake.forget();
    bench.draw();
    let asked = bench.fake.asked();
    let arrays = |(call, _): &(String, usize)| call.contains("VERTEX_ARRAY");
    assert!(asked.iter().any(arrays), "{asked:?}");
}

#[test]
fn what_was_drawn_for_each_view_is_sampled_for_each_view() {
    for views in ["2", "4"] {
        let mut bench = Bench::new(&[("VIEWS", views), ("STRATEGY", "replay")]);
        bench.look();
        bench.frame();
        let (gl, (own, texture, _)) = (bench.gl, bench.fake.framebuffer(64, 48));
        bench.bind(own);
        bench.clear();
        bench.draw();
        bench.bind(FramebufferName::ZERO);
        bench.set(Touch::ALL, |gl| {
            gl.enable(c::TEXTURE_2D);
            gl.bind_texture(c::TEXTURE_2D, texture);
        });
        bench.layer.state.refresh(&gl);
        let request = Request::of(TRIANGLES);
        let (facts, images) = bench.layer.observe(&gl, &request);
        assert_eq!(images.bound.len(), 1, "{views} views");
        assert!(facts.destination.is_window());
        // Selection makes no picture, so it samples nothing.
        bench.layer.render_mode(c::SELECT);
        let (_, images) = bench.layer.observe(&gl, &request);
        assert_eq!(images.bound.len(), 0);
    }
}

#[test]
fn a_layer_is_chosen_only_where_each_view_has_one_of_the_windows_size() {
    for (atlas, scale, layered) in [
        ("layers", "1", true),
        ("layers", "0.5", false),
        ("side-by-side", "1", false),
        ("side-by-side", "0.5", false),
    ] {
        let mut bench = bench(&[
            ("STRATEGY", "replay"),
            ("ATLAS", atlas),
            ("VIEW_SCALE", scale),
        ]);
        let (program, gl) = (program(&mut bench), bench.gl);
        bench.layer.touch(Touch::OBJECTS);
        bench.layer.link_variant(&gl, program);
        let facts = bench.facts(TRIANGLES);
        assert_eq!(facts.destination.layered, layered, "{atlas}, {scale}");
        // The program's shaders have a camera, and it is not lost.
        assert_eq!(facts.traits.projection, Projection::Perspective);
    }
}
