//! Amplified draws: all views by one draw, with generated shaders.

use super::super::amplified::{allow_target, first_row, primitive};
use super::super::{Amplified, Driver, FixedState, Programs, limits};
use super::Stage;
use crate::atlas::Grid;
use crate::config::AtlasLayout::{Layers, SideBySide};
use crate::config::{AtlasLayout, Clip};
use crate::fixed::{Amplifier, FixedKey, Primitive, Target, Tiles, Unsupported};
use crate::gl::fake::{Fake, Scope};
use crate::gl::{Gl, ProgramName, Vertices, consts as c};
use crate::plan::Method;
use crate::plan::reason::{Reason, Replayed};
use crate::share;
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, RngSeed};

pub(super) struct Drawing {
    pub(super) stage: Stage,
    pub(super) programs: Programs,
    pub(super) fixed: FixedState,
}

impl Drawing {
    pub(super) fn new(stage: Stage, clip: Clip, resends: bool) -> Drawing {
        Drawing::with(stage, clip, resends, 450)
    }

    fn with(stage: Stage, clip: Clip, resends: bool, glsl: u32) -> Drawing {
        let (gl, driver) = (stage.gl, Driver::ask(&stage.gl));
        let limits = limits(&gl, glsl);
        let programs = Programs::new(limits, driver, clip, resends);
        let fixed = FixedState::read(&gl, driver, 0);
        Drawing {
            stage,
            programs,
            fixed,
        }
    }

    fn prepare(&mut self, method: Method) -> Result<Amplified, Reason> {
        self.prepare_mode(method, c::TRIANGLES)
    }

    fn prepare_mode(&mut self, method: Method, mode: u32) -> Result<Amplified, Reason> {
        let Drawing {
            stage,
            programs,
            fixed,
        } = self;
        programs.prepare(&stage.gl, method, mode, fixed, false, &stage.atlas)
    }

    /// The views that each call is for.
    fn draw(&mut self, method: Method) -> Vec<u32> {
        let how = self.prepare(method).expect("a program");
        self.send(&how)
    }

    fn send(&mut self, how: &Amplified) -> Vec<u32> {
        let shear = self.stage.shear();
        let Drawing {
            stage,
            programs,
            fixed,
        } = self;
        let (gl, mut counts) = (stage.gl, Vec::new());
        let (state, rig) = (&stage.state, &stage.rig);
        programs.draw(
            &gl,
            &mut stage.atlas,
            state,
            rig,
            shear,
            fixed,
            how,
            &mut |views| {
                counts.push(views);
                gl.draw_arrays_instanced(how.mode, Vertices::without_arrays(0, 3), views as i32);
            },
        );
        counts
    }
}

fn drawing(layout: AtlasLayout, clip: Clip, resends: bool) -> Drawing {
    let fake = Fake::new().extensions(["GL_ARB_shader_viewport_layer_array", "GL_ARB_gpu_shader5"]);
    Drawing::new(Stage::on(fake, layout, Grid::FULL), clip, resends)
}

#[test]
fn one_call_draws_all_views_and_leaves_no_trace() {
    for layout in [SideBySide, Layers] {
        for method in [Method::Instanced, Method::Geometry] {
            let mut drawing = drawing(layout, Clip::Distances, false);
            let before = drawing.stage.fake.state();
            assert_eq!(drawing.draw(method), [4], "{layout:?} {method:?}");
            drawing.stage.fake.assert_restored(&before);
            let drawn = &drawing.stage.fake.draws()[0].state;
            let program = ProgramName(drawn.value(c::CURRENT_PROGRAM)[0] as u32);
            assert_eq!(drawing.programs.names().collect::<Vec<_>>(), [program]);
            let distances = (0..2).all(|at| drawn.is_enabled(c::CLIP_DISTANCE0 + at));
            assert_eq!(distances, layout == SideBySide);
            let places = (0..4).map(|at| {
                let fake = &drawing.stage.fake;
                fake.uniform(program, &format!("mv_view[{at}]"))[2]
            });
            // Row 0 of each projection, in the order of the slots.
            let tiles = &drawing.stage.atlas.tiles;
            let expected = (0..4).map(|slot| drawing.stage.aside(tiles.view_in(slot)));
            assert!(
                places
                    .zip(expected)
                    .all(|(is, wanted)| (is - wanted).abs() < 1e-6)
            );
        }
    }
}

#[test]
fn a_second_draw_sends_nothing_that_is_there() {
    for (resends, sent) in [(false, 0), (true, 5)] {
        let mut drawing = drawing(SideBySide, Clip::Distances, resends);
        drawing.draw(Method::Instanced);
        drawing.stage.fake.forget();
        drawing.draw(Method::Instanced);
        let fake = &drawing.stage.fake;
        assert_eq!(fake.count("glUniform*"), sent);
        assert_eq!(fake.count("glCompile*") + fake.count("glLink*"), 0);
        assert_eq!(drawing.programs.compiled, 1);
        // The present cost: one query for each draw.
        let known = [("glGetFloatv GL_MODELVIEW_MATRIX".to_owned(), 1)];
        assert_eq!(fake.asked(), known);
    }
}

#[test]
fn an_odd_state_comes_back() {
    let clips = [Clip::Distances, Clip::Discard, Clip::Both, Clip::Cut];
    let mut drawn_at_all = 0;
    let seeds = 120 / share::every(4);
    for seed in 0..seeds {
        let layout = [SideBySide, Layers][seed % 2];
        let mut stage = drawing(layout, Clip::Distances, false).stage;
        let seed = seed as u64;
        stage.fake.scramble(seed, true);
        // Fixed function draws with no program.
        stage.program(|gl| gl.use_program(ProgramName::ZERO));
        for clip in clips {
            for method in [Method::Instanced, Method::Geometry] {
                let mut drawing = Drawing::new(stage, clip, false);
                let before = drawing.stage.fake.state();
                if drawing.prepare(method).is_ok() {
                    drawing.draw(method);
                    drawn_at_all += 1;
                }
                let differences = before.differences(&drawing.stage.fake.state());
                assert_eq!(
                    differences, [""; 0],
                    "{layout:?} {clip:?} {method:?} seed {seed}"
                );
                stage = drawing.stage;
            }
        }
    }
    assert!(drawn_at_all > seeds, "{drawn_at_all}");
}

#[test]
fn a_shader_that_the_driver_refuses_is_tried_once() {
    let mut drawing = drawing(SideBySide, Clip::Distances, false);
    drawing.stage.fake.refuse_shaders("mv_view");
    let before = drawing.stage.fake.alive(["Programs"]);
    for _ in 0..2 {
        let refused = drawing.prepare(Method::Instanced);
        assert!(matches!(refused, Err(Reason::Compile)));
    }
    assert_eq!(drawing.stage.fake.count("glCompileShader"), 1);
    assert_eq!(drawing.stage.fake.alive(["Programs"]), before);
}

const SIZE: [i32; 2] = [64, 48];

/// The columns of a view's tile that a draw can reach, from the left to before the right, by the program's viewport and scissor.
fn shown(viewport: [i32; 4], scissor: Option<[i32; 4]>) -> [i32; 2] {
    let [x, _, width, _] = viewport;
    let (left, right) = (x.max(0), (x + width).min(SIZE[0]));
    scissor.map_or([left, right], |[x, _, width, _]| {
        [left.max(x), right.min(x + width)]
    })
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-3
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 200 / share::every(4) as u32,
        rng_seed: RngSeed::Fixed(26),
        rng_algorithm: RngAlgorithm::ChaCha,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// A vertex lands in the tile of its view where the program's viewport puts it, and is clipped where the program's picture ends.
    #[test]
    fn vertices_land_in_their_tile(
        x in -20..40i32, y in -20..40i32, width in 1..80i32, height in 1..80i32,
        scissor in proptest::option::of([-5..60i32, -5..40i32, 0..70i32, 0..70i32]),
        at in -1.0..1.0f64, layers in any::<bool>(), discard in any::<bool>(), rows in any::<bool>(),
    ) {
        let viewport = [x, y, width, height];
        let fake = Fake::new().extensions(["GL_ARB_shader_viewport_layer_array"]);
        let layout = if layers { Layers } else { SideBySide };
        let side = if rows { 128 } else { 4096 };
        let mut stage = Stage::within(fake, layout, Grid::FULL, side);
        stage.program(|gl| {
            let [x, y, width, height] = viewport;
            gl.viewport(x, y, width, height);
            if let Some([x, y, width, height]) = scissor {
                gl.enable(c::SCISSOR_TEST);
                gl.scissor(x, y, width, height);
            }
        });
        let clip = if discard { Clip::Discard } else { Clip::Distances };
        let mut drawing = Drawing::new(stage, clip, false);
        let mut counts = Vec::new();
        let mut wrong: Vec<String> = Vec::new();
        let how = drawing.prepare(Method::Instanced).expect("a program");
        let Drawing { stage, programs, fixed } = &mut drawing;
        let (gl, tiles, before) = (stage.gl, stage.atlas.tiles, stage.fake.state());
        let mut next = 0;
        let per_row = if layers { 4 } else { tiles.columns };
        // Rows are drawn from the last to the first.
        let order: Vec<u32> = (0..4 / per_row).rev().flat_map(|row| per_row * row..per_row * (row + 1)).collect();
        let fake = &stage.fake;
        programs.draw(&gl, &mut stage.atlas, &stage.state, &stage.rig, None, fixed, &how, &mut |views| {
            counts.push(views);
            let program = ProgramName(fake.value(c::CURRENT_PROGRAM)[0] as u32);
            let uniform = |name: &str| fake.uniform(program, name);
            let texture = f64::from(tiles.texture_width());
            // A layer has the program's own viewport, so `mv_map` is not set.
            let map = uniform("mv_map");
            if map.is_empty() != layers {
                wrong.push(format!("{map:?}"));
            }
            let [left, right] = shown(viewport, scissor);
            for index in 0..views {
                let view = tiles.view_in(order[next]);
                next += 1;
                let (layer, tile) = tiles.place(view);
                let place = uniform(&format!("mv_tile[{index}]"));
                if let [scale, up, ..] = map[..] {
                    let pixel = (scale * at + place[0] + 1.0) / 2.0 * texture;
                    let wanted = f64::from(tile) + f64::from(x) + (at + 1.0) / 2.0 * f64::from(width);
                    if !near(pixel, wanted) || up != 1.0 {
                        wrong.push(format!("view {view}: {pixel} for {wanted}"));
                    }
                }
                let rest = match (layers, discard) {
                    (true, _) => [f64::from(layer), 0.0],
                    (_, true) => [left, right].map(|end| f64::from(tile as i32 + end)),
                    _ => [f64::from(layer), 0.0],
                };
                if place[2..] != rest {
                    wrong.push(format!("view {view}: {place:?}, not {rest:?}"));
                }
            }
            let after = uniform(&format!("mv_tile[{views}]"));
            if after != [4.0, 0.0, 65535.0, 0.0] {
                wrong.push(format!("{after:?}"));
            }
            let ends = uniform("mv_clip");
            if ends.is_empty() != (layers || discard) {
                wrong.push(format!("{ends:?}"));
            }
            if let [from, to, ..] = ends[..] {
                let cut = [from, to].map(|end| f64::from(x) + (end + 1.0) / 2.0 * f64::from(width));
                if !near(cut[0], left.into()) || !near(cut[1], right.into()) || ends[2..] != [-1.0, 1.0] {
                    wrong.push(format!("cut at {cut:?}, not from {left} to {right}"));
                }
            }
            let value = |name| fake.value(name);
            let (area, cut) = match layers {
                true => (viewport, scissor),
                false => {
                    let all = tiles.texture_width() as i32;
                    ([0, y, all, height], scissor.map(|[_, y, _, height]| [0, y, all, height]))
                }
            };
            if value(c::VIEWPORT) != area.map(f64::from) {
                wrong.push(format!("viewport {:?} for {area:?}", value(c::VIEWPORT)));
            }
            if cut.is_some_and(|cut| value(c::SCISSOR_BOX) != cut.map(f64::from)) {
                wrong.push(format!("scissor {:?} for {cut:?}", value(c::SCISSOR_BOX)));
            }
        });
        prop_assert_eq!(wrong, Vec::<String>::new());
        prop_assert_eq!(counts, vec![per_row; 4 / per_row as usize]);
        stage.fake.assert_restored(&before);
    }
}

#[test]
fn a_batch_is_as_large_as_the_driver_allows() {
    let driver = |limits: &[(u32, f64)], extension: &'static str| {
        let fake = Fake::new().extensions(["GL_ARB_shader_viewport_layer_array", extension]);
        limits
            .iter()
            .fold(fake, |fake, &(name, value)| fake.limit(name, &[value]))
    };
    let drawn = |fake: Fake, glsl: u32| {
        let stage = Stage::on(fake, Layers, Grid::FULL);
        let mut drawing = Drawing::with(stage, Clip::Distances, false, glsl);
        let how = drawing.prepare(Method::Geometry).expect("a program");
        let target = how.stages.0.target;
        assert_eq!(u32::from(target.views), how.batch);
        (target.amplifier, drawing.draw(Method::Geometry))
    };
    let (invocations, looped) = (Amplifier::GeometryInvocations, Amplifier::GeometryLoop);
    let five = "GL_ARB_gpu_shader5";
    assert_eq!(drawn(driver(&[], five), 450), (invocations, vec![4]));
    let three = [(c::MAX_GEOMETRY_SHADER_INVOCATIONS, 3.0)];
    assert_eq!(drawn(driver(&three, five), 450), (invocations, vec![3, 1]));
    // Without invocations, the shader makes all views in a loop with three vertices for each.
    assert_eq!(drawn(driver(&[], ""), 330), (looped, vec![4]));
    let six = [(c::MAX_GEOMETRY_OUTPUT_VERTICES, 6.0)];
    assert_eq!(drawn(driver(&six, ""), 330), (looped, vec![2, 2]));
}

#[test]
fn tiles_and_scissors_at_other_places_are_refused() {
    let with = |step: [f64; 2], scissor: bool, layout, across: f64| {
        let grid = Grid {
            across,
            step,
            ..Grid::FULL
        };
        let mut stage = Stage::new(layout, grid);
        stage.state.rectangles.scissor_test = scissor;
        Programs::allow(&stage.state, &stage.atlas).is_ok()
    };
    assert!(with([0.0; 2], false, SideBySide, 1.0));
    assert!(with([0.0; 2], true, SideBySide, 1.0));
    assert!(with([0.25, 0.0], false, Layers, 0.5));
    assert!(!with([0.25, 0.0], true, Layers, 0.5));
    assert!(!with([0.0, 0.25], false, Layers, 0.5));
    assert!(!with([0.0; 2], false, SideBySide, 0.5));
    assert!(with([0.0; 2], false, Layers, 0.5));
}

#[test]
fn geometry_shaders_are_fed_by_the_mode() {
    for flat in [false, true] {
        let feeds = [
            (c::POINTS, Primitive::Points),
            (c::LINES, Primitive::Lines),
            (c::LINE_STRIP, Primitive::Lines),
            (c::LINE_LOOP, Primitive::Lines),
            (c::TRIANGLES, Primitive::Triangles),
            (c::TRIANGLE_STRIP, Primitive::Triangles),
            (c::TRIANGLE_FAN, Primitive::Triangles),
        ];
        for (mode, expected) in feeds {
            assert!(matches!(primitive(mode, flat), Ok(found) if found == (expected, mode)));
        }
        let polygon = (Primitive::Polygon, c::TRIANGLE_FAN);
        assert!(matches!(primitive(c::POLYGON, flat), Ok(found) if found == polygon));
        let patches = primitive(c::PATCHES, flat);
        assert_eq!(patches, Err(Reason::Replayed(Replayed::Adjacency)));
    }
    let quads = (Primitive::Quads, c::LINES_ADJACENCY);
    assert!(matches!(primitive(c::QUADS, true), Ok(found) if found == quads));
    for mode in [c::QUADS, c::QUAD_STRIP] {
        let smooth = primitive(mode, false);
        assert_eq!(smooth, Err(Reason::Replayed(Replayed::SmoothQuads)));
    }
    let strip = primitive(c::QUAD_STRIP, true);
    assert_eq!(strip, Err(Reason::Replayed(Replayed::FlatQuadStrips)));
}

#[test]
fn what_would_be_cut_otherwise_is_refused() {
    let key = |tiles, clip, flat, primitive| FixedKey {
        flat,
        target: Target {
            tiles,
            clip,
            primitive,
            ..Target::default()
        },
        ..FixedKey::default()
    };
    let triangles = Primitive::Triangles;
    for clip in [Clip::Discard, Clip::Both] {
        let of = |tiles, flat, mode| {
            allow_target(&key(tiles, clip, flat, triangles), mode, false).is_ok()
        };
        assert!(!of(Tiles::ClipLeftRight, false, c::QUADS));
        assert!(of(Tiles::ClipLeftRight, true, c::QUADS));
        assert!(of(Tiles::ClipLeftRight, false, c::TRIANGLES));
        assert!(of(Tiles::Layer, false, c::QUADS));
    }
    let all = [
        (Primitive::Points, [false, false]),
        (Primitive::Lines, [false, false]),
        (Primitive::Triangles, [true, false]),
        (Primitive::Polygon, [true, true]),
        (Primitive::Quads, [false, false]),
    ];
    for (primitive, allowed) in all {
        for (flat, allowed) in [false, true].into_iter().zip(allowed) {
            let of = |tiles, clip, geometry| {
                let key = key(tiles, clip, flat, primitive);
                allow_target(&key, c::TRIANGLES, geometry).is_ok()
            };
            assert_eq!(of(Tiles::ClipLeftRight, Clip::Cut, true), allowed);
            assert!(of(Tiles::ClipLeftRight, Clip::Cut, false));
            assert!(of(Tiles::ClipLeftRight, Clip::Distances, true));
            assert!(of(Tiles::Layer, Clip::Cut, true));
        }
    }
}

#[test]
fn the_first_row_is_that_of_the_product() {
    let p: [f32; 16] = std::array::from_fn(|i| (i * i % 11) as f32 + 0.5);
    let m: [f32; 16] = std::array::from_fn(|i| (i * 7 % 13) as f32 - 3.0);
    let product = glam::Mat4::from_cols_array(&p) * glam::Mat4::from_cols_array(&m);
    assert_eq!(first_row(&p, &m), product.row(0).to_array());
}

#[test]
fn wide_lines_and_points_do_not_go_through_a_geometry_shader() {
    type Case = (fn(&Gl), u32, bool);
    let cases: [Case; 8] = [
        (|gl| gl.line_width(2.0), c::LINES, false),
        (|gl| gl.enable(c::LINE_SMOOTH), c::LINES, false),
        (|gl| gl.point_size(2.0), c::POINTS, false),
        (|gl| gl.enable(c::POINT_SMOOTH), c::POINTS, false),
        (|gl| gl.line_width(2.0), c::TRIANGLES, true),
        (|gl| gl.point_size(2.0), c::TRIANGLES, true),
        (|gl| gl.point_size(2.0), c::LINES, true),
        (|gl| gl.line_width(2.0), c::POINTS, true),
    ];
    for (program, mode, allowed) in cases {
        let mut stage = drawing(Layers, Clip::Distances, false).stage;
        stage.program(program);
        let mut drawing = Drawing::new(stage, Clip::Distances, false);
        let prepare = |drawing: &mut Drawing, method| {
            let Drawing {
                stage,
                programs,
                fixed,
            } = drawing;
            programs.prepare(&stage.gl, method, mode, fixed, false, &stage.atlas)
        };
        let refused = matches!(
            prepare(&mut drawing, Method::Geometry),
            Err(Reason::Replayed(Replayed::WidePrimitives))
        );
        assert_eq!(refused, !allowed);
        assert!(prepare(&mut drawing, Method::Instanced).is_ok());
    }
}

#[test]
fn without_layers_there_is_nothing_to_choose() {
    let fake = Fake::new().version(3, 1);
    let mut drawing = Drawing::new(Stage::on(fake, Layers, Grid::FULL), Clip::Distances, false);
    assert_eq!(drawing.stage.atlas.layered(), None);
    let refused = drawing.prepare(Method::Instanced);
    assert!(matches!(
        refused,
        Err(Reason::Fixed(Unsupported::VertexLayer))
    ));
}

#[test]
fn a_flat_polygon_has_its_first_vertex_where_the_shader_looks() {
    for (mode, convention, during) in [
        (
            c::POLYGON,
            c::FIRST_VERTEX_CONVENTION,
            c::LAST_VERTEX_CONVENTION,
        ),
        (
            c::POLYGON,
            c::LAST_VERTEX_CONVENTION,
            c::LAST_VERTEX_CONVENTION,
        ),
        (
            c::TRIANGLES,
            c::FIRST_VERTEX_CONVENTION,
            c::FIRST_VERTEX_CONVENTION,
        ),
    ] {
        let mut stage = drawing(SideBySide, Clip::Distances, false).stage;
        let flat = f64::from(c::FLAT);
        stage.fake.put(Scope::Context, c::SHADE_MODEL, &[flat]);
        stage.program(|gl| gl.provoking_vertex(convention));
        let mut drawing = Drawing::new(stage, Clip::Distances, false);
        let before = drawing.stage.fake.state();
        let how = drawing
            .prepare_mode(Method::Geometry, mode)
            .expect("a program");
        drawing.send(&how);
        drawing.stage.fake.assert_restored(&before);
        let drawn = drawing.stage.fake.draws();
        assert_eq!(
            drawn[0].state.value(c::PROVOKING_VERTEX),
            [f64::from(during)]
        );
    }
}
