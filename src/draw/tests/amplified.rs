//! All views by one draw, with generated shaders.

use super::super::{Amplified, Driver, FixedState, Programs, limits};
use super::Stage;
use crate::atlas::Grid;
use crate::config::AtlasLayout::{Layers, SideBySide};
use crate::config::{AtlasLayout, Clip};
use crate::gl::Vertices;
use crate::gl::consts as c;
use crate::gl::fake::Fake;
use crate::plan::{Method, Reason};

pub(super) struct Drawing {
    pub(super) stage: Stage,
    pub(super) programs: Programs,
    pub(super) fixed: FixedState,
}

impl Drawing {
    pub(super) fn new(stage: Stage, clip: Clip, resends: bool) -> Drawing {
        let (gl, driver) = (stage.gl, Driver::ask(&stage.gl));
        let limits = limits(&gl, 450);
        let programs = Programs::new(limits, driver, clip, resends);
        let fixed = FixedState::read(&gl, driver, 0);
        Drawing {
            stage,
            programs,
            fixed,
        }
    }

    fn prepare(&mut self, method: Method) -> Result<Amplified, Reason> {
        let Drawing {
            stage,
            programs,
            fixed,
        } = self;
        programs.prepare(&stage.gl, method, c::TRIANGLES, fixed, false, &stage.atlas)
    }

    /// The views that each call is for.
    fn draw(&mut self, method: Method) -> Vec<u32> {
        let how = self.prepare(method).expect("a program");
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
            &how,
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
            let program = drawn.value(c::CURRENT_PROGRAM)[0] as u32;
            assert_eq!(drawing.programs.names().collect::<Vec<_>>(), [program]);
            let distances = (0..2).all(|at| drawn.is_enabled(c::CLIP_DISTANCE0 + at));
            assert_eq!(distances, layout == SideBySide);
            let places = (0..4).map(|at| {
                let fake = &drawing.stage.fake;
                fake.uniform(program, &format!("mv_view[{at}]"))[2]
            });
            // Row 0 of each projection, in the order of the slots.
            let tiles = &drawing.stage.atlas.tiles;
            let expected = (0..4).map(|slot| drawing.stage.aside(tiles.slot(slot)));
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
        // The figure of today: one question for each draw.
        let known = [("glGetFloatv GL_MODELVIEW_MATRIX".to_owned(), 1)];
        assert_eq!(fake.asked(), known);
    }
}

#[test]
fn an_odd_state_comes_back() {
    let clips = [Clip::Distances, Clip::Discard, Clip::Both, Clip::Cut];
    let mut drawn_at_all = 0;
    for seed in 0..120 {
        let layout = [SideBySide, Layers][seed % 2];
        let mut stage = drawing(layout, Clip::Distances, false).stage;
        let seed = seed as u64;
        stage.fake.scramble(seed, true);
        // Fixed function draws with no program.
        stage.program(|gl| gl.use_program(0));
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
    assert!(drawn_at_all > 100, "{drawn_at_all}");
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
