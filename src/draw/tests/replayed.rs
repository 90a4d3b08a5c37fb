//! Replay: the draw itself, once per view.

use super::super::{ReplayHazard, enter_own, others, replay};
use super::{Stage, sheared};
use crate::atlas::{Grid, ViewSet};
use crate::config::AtlasLayout::{Layers, SideBySide};
use crate::gl::fake::Fake;
use crate::gl::{FramebufferName, Vertices, consts as c};
use crate::state::{Effect, Rectangles};
use crate::view::ViewIndex;

impl Stage {
    /// Replays something that leaves the state as the program's own call does.
    fn replay(&mut self, hazard: ReplayHazard, call: &mut dyn FnMut(ViewIndex)) -> bool {
        self.replay_and(hazard, true, call)
    }

    fn replay_and(
        &mut self,
        hazard: ReplayHazard,
        keeps_state: bool,
        call: &mut dyn FnMut(ViewIndex),
    ) -> bool {
        let (gl, shear) = (self.gl, self.shear());
        let (atlas, state, rig) = (&mut self.atlas, &self.state, &self.rig);
        replay(&gl, atlas, state, rig, shear, hazard, keeps_state, call)
    }
}

const LIST: ReplayHazard = ReplayHazard::Anything {
    rects: true,
    projection: false,
    current: Effect::COLOR,
};

#[test]
fn every_view_has_its_tile_and_its_camera() {
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    stage.program(|gl| gl.viewport(8, 4, 40, 40));
    let gl = stage.gl;
    let before = stage.fake.state();
    let mut views = Vec::new();
    assert!(stage.replay(ReplayHazard::None, &mut |view| {
        views.push(view);
        gl.draw_arrays(c::TRIANGLES, Vertices::without_arrays(0, 3));
    }));
    let order: Vec<ViewIndex> = stage.atlas.tiles.order().collect();
    assert_eq!((&views, views.last()), (&order, Some(&ViewIndex(1))));
    let drawn = stage.fake.draws();
    assert_eq!(drawn.len(), 4);
    for (drawn, &view) in drawn.iter().zip(&views) {
        let (_, x) = stage.atlas.tiles.place(view);
        let x = f64::from(x);
        assert_eq!(drawn.state.value(c::VIEWPORT), [x + 8.0, 4.0, 40.0, 40.0]);
        assert_eq!(drawn.state.value(c::SCISSOR_BOX), [x, 0.0, 64.0, 48.0]);
        assert!(drawn.state.is_enabled(c::SCISSOR_TEST));
        assert!((sheared(drawn) - stage.aside(view)).abs() < 1e-6);
    }
    stage.fake.assert_restored(&before);
    assert!(stage.fake.asked().is_empty(), "{:?}", stage.fake.asked());
}

#[test]
fn the_scissor_of_the_program_is_cut_to_the_tile() {
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    stage.program(|gl| {
        gl.enable(c::SCISSOR_TEST);
        gl.scissor(-10, 40, 30, 100);
    });
    let before = stage.fake.state();
    let gl = stage.gl;
    stage.replay(ReplayHazard::None, &mut |_| {
        gl.draw_arrays(c::POINTS, Vertices::without_arrays(0, 1))
    });
    for (drawn, view) in stage.fake.draws().iter().zip(stage.atlas.tiles.order()) {
        let (_, x) = stage.atlas.tiles.place(view);
        assert_eq!(
            drawn.state.value(c::SCISSOR_BOX),
            [x.into(), 40.0, 20.0, 8.0]
        );
    }
    stage.fake.assert_restored(&before);
    assert_eq!(
        stage.fake.count("glDisable") + stage.fake.count("glEnable"),
        0
    );
}

#[test]
fn layers_need_neither_viewport_nor_scissor() {
    let mut stage = Stage::new(Layers, Grid::FULL);
    let before = stage.fake.state();
    let gl = stage.gl;
    stage.replay(ReplayHazard::None, &mut |_| {
        gl.draw_arrays(c::POINTS, Vertices::without_arrays(0, 1))
    });
    let drawn = stage.fake.draws();
    let bound = drawn
        .iter()
        .map(|d| FramebufferName(d.state.value(c::DRAW_FRAMEBUFFER_BINDING)[0] as u32));
    let order = stage.atlas.tiles.order();
    let expected: Vec<FramebufferName> = order.map(|view| stage.atlas.target(view).0).collect();
    assert_eq!(bound.collect::<Vec<_>>(), expected);
    assert_eq!(
        stage.fake.count("glViewport") + stage.fake.count("glScissor"),
        0
    );
    stage.fake.assert_restored(&before);
}

#[test]
fn what_is_flat_keeps_the_projection() {
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    let (gl, state, rig) = (stage.gl, &stage.state, &stage.rig);
    let before = stage.fake.state();
    replay(
        &gl,
        &mut stage.atlas,
        state,
        rig,
        None,
        ReplayHazard::None,
        true,
        &mut |_| {
            gl.draw_arrays(c::POINTS, Vertices::without_arrays(0, 1));
        },
    );
    assert_eq!(
        (
            stage.fake.count("glLoad*"),
            stage.fake.count("glMatrixMode")
        ),
        (0, 0)
    );
    stage.fake.assert_restored(&before);
}

#[test]
fn a_clear_without_a_scissor_is_one_for_each_layer() {
    for (layout, scissor, clears) in [
        (SideBySide, false, 1),
        (SideBySide, true, 4),
        (Layers, false, 4),
        (Layers, true, 4),
    ] {
        let mut stage = Stage::new(layout, Grid::FULL);
        if scissor {
            stage.program(|gl| gl.enable(c::SCISSOR_TEST));
        }
        let (gl, before) = (stage.gl, stage.fake.state());
        stage.replay(ReplayHazard::Clear, &mut |_| gl.clear(c::COLOR_BUFFER_BIT));
        assert_eq!(stage.fake.draws().len(), clears, "{layout:?}, {scissor}");
        stage.fake.assert_restored(&before);
    }
}

#[test]
fn a_view_that_nobody_sees_is_not_drawn() {
    for layout in [SideBySide, Layers] {
        let mut stage = Stage::new(layout, Grid::FULL);
        stage.atlas.tiles.shown = [ViewIndex(3)].into_iter().collect::<ViewSet>();
        let (gl, before) = (stage.gl, stage.fake.state());
        let mut views = Vec::new();
        stage.replay(ReplayHazard::None, &mut |view| views.push(view));
        assert_eq!(views, [3, 1].map(ViewIndex));
        stage.replay(ReplayHazard::Clear, &mut |_| gl.clear(c::COLOR_BUFFER_BIT));
        let clears = if layout == Layers { 2 } else { 1 };
        assert_eq!(stage.fake.draws().len(), clears);
        stage.fake.assert_restored(&before);
    }
}

#[test]
fn each_sending_starts_from_the_same_values() {
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    stage.program(|gl| gl.color_4f(0.5, 0.25, 1.0, 1.0));
    let gl = stage.gl;
    let mut seen = Vec::new();
    let fake = Fake::value;
    let hazard = ReplayHazard::Current(Effect::COLOR | Effect::NORMAL);
    let (shear, state, rig) = (stage.shear(), &stage.state, &stage.rig);
    replay(
        &gl,
        &mut stage.atlas,
        state,
        rig,
        shear,
        hazard,
        true,
        &mut |_| {
            let values = [c::CURRENT_COLOR, c::CURRENT_NORMAL];
            seen.extend(values.map(|name| fake(&stage.fake, name)));
            gl.color_4f(0.0, 1.0, 0.0, 1.0);
            gl.normal_3f(1.0, 0.0, 0.0);
        },
    );
    let first = [vec![0.5, 0.25, 1.0, 1.0], vec![0.0, 0.0, 1.0]];
    assert_eq!(seen.len(), 8);
    assert!(seen.chunks(2).all(|seen| seen == first), "{seen:?}");
    assert_eq!(stage.fake.value(c::CURRENT_COLOR), [0.0, 1.0, 0.0, 1.0]);
    assert_eq!(stage.fake.value(c::CURRENT_NORMAL), [1.0, 0.0, 0.0]);
    assert_eq!(stage.fake.count("glGetFloatv"), 2, "one for each value");
}

#[test]
fn a_list_leaves_what_the_programs_own_call_leaves() {
    let list = |gl: &crate::gl::Gl| {
        gl.color_4f(0.0, 1.0, 0.0, 1.0);
        gl.viewport(0, 0, 20, 20);
        gl.enable(c::FOG);
        gl.matrix_mode(c::MODELVIEW);
        gl.push_matrix();
        gl.load_matrix(&[3.0; 16]);
        gl.push_attrib(c::CURRENT_BIT);
        gl.draw_arrays(c::TRIANGLES, Vertices::without_arrays(0, 3));
    };
    let alone = {
        let mut stage = Stage::new(SideBySide, Grid::FULL);
        stage.program(list);
        stage.fake.state()
    };
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    let gl = stage.gl;
    let mut seen = Vec::new();
    let (shear, state, rig) = (stage.shear(), &stage.state, &stage.rig);
    replay(
        &gl,
        &mut stage.atlas,
        state,
        rig,
        shear,
        LIST,
        true,
        &mut |_| {
            let state = stage.fake.state();
            let depth = state.value(c::MODELVIEW_STACK_DEPTH);
            seen.push((
                state.value(c::CURRENT_COLOR),
                depth,
                state.is_enabled(c::FOG),
            ));
            list(&gl);
        },
    );
    assert_eq!(seen, vec![(vec![1.0; 4], vec![1.0], false); 4]);
    let owned = |state: &crate::gl::fake::Snapshot| {
        [c::VIEWPORT, c::SCISSOR_BOX].map(|name| state.value(name))
    };
    let after = stage.fake.state();
    assert_eq!(owned(&after), owned(&alone));
    let differences = alone.differences(&after);
    assert_eq!(differences, [""; 0]);
}

#[test]
fn a_full_attribute_stack_leaves_the_own_view_alone() {
    for keeps_state in [true, false] {
        let mut stage = Stage::new(SideBySide, Grid::FULL);
        stage.program(|gl| (0..16).for_each(|_| gl.push_attrib(c::CURRENT_BIT)));
        let before = stage.fake.state();
        let mut views = Vec::new();
        assert!(!stage.replay_and(LIST, keeps_state, &mut |view| views.push(view)));
        let own: &[ViewIndex] = if keeps_state { &[ViewIndex(1)] } else { &[] };
        assert_eq!(views, own);
        stage.fake.assert_restored(&before);
    }
}

#[test]
fn what_leaves_nothing_leaves_nothing() {
    for hazard in [LIST, ReplayHazard::Current(Effect::COLOR)] {
        let mut stage = Stage::new(SideBySide, Grid::FULL);
        let (gl, before) = (stage.gl, stage.fake.state());
        stage.replay_and(hazard, false, &mut |_| gl.color_4f(0.0, 1.0, 0.0, 1.0));
        stage.fake.assert_restored(&before);
    }
}

#[test]
fn a_picture_at_the_raster_position_moves_with_its_view() {
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    stage.program(|gl| gl.window_pos_2i(10, 10));
    let before = stage.fake.state();
    let mut places = Vec::new();
    let gl = stage.gl;
    let (state, rig) = (&stage.state, &stage.rig);
    let hazard = ReplayHazard::Raster(None);
    replay(
        &gl,
        &mut stage.atlas,
        state,
        rig,
        None,
        hazard,
        true,
        &mut |_| {
            places.push(stage.fake.value(c::CURRENT_RASTER_POSITION)[0]);
        },
    );
    assert_eq!(places, [74.0, 138.0, 202.0, 10.0]);
    stage.fake.assert_restored(&before);
    // The raster position moves with a point of the scene: w is 1 and zero parallax is at 2, so it moves by minus the view's separation.
    let hazard = ReplayHazard::Raster(stage.shear());
    places.clear();
    let (state, rig) = (&stage.state, &stage.rig);
    replay(
        &gl,
        &mut stage.atlas,
        state,
        rig,
        None,
        hazard,
        true,
        &mut |_| {
            places.push(stage.fake.value(c::CURRENT_RASTER_POSITION)[0]);
        },
    );
    // View 0 is 1.5 places left of the middle and shifted by -(-1.5 · 0.25) · 32 = 12 pixels; views 1 and 2 by 4 and -4. The position of
    // view 3 leaves the viewport.
    assert_eq!(places, [64.0 + 22.0, 138.0 + -4.0, 10.0 + 4.0]);
    stage.fake.assert_restored(&before);
}

/// Places, relative to their tiles, where a draw at the raster position `x` is sent, in a viewport of 32 pixels that begins at 8.
fn raster_places(x: i32) -> Vec<f64> {
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    stage.program(|gl| {
        gl.viewport(8, 0, 32, 48);
        gl.window_pos_2i(x, 10);
    });
    let before = stage.fake.state();
    let hazard = ReplayHazard::Raster(stage.shear());
    let mut places = Vec::new();
    let gl = stage.gl;
    replay(
        &gl,
        &mut stage.atlas,
        &stage.state,
        &stage.rig,
        None,
        hazard,
        true,
        &mut |_| {
            let tile = stage.fake.value(c::SCISSOR_BOX)[0];
            places.push(stage.fake.value(c::CURRENT_RASTER_POSITION)[0] - tile);
        },
    );
    stage.fake.assert_restored(&before);
    places
}

#[test]
fn a_raster_position_is_valid_within_the_viewport() {
    // The views are shifted by 6, 2, -2 and -6 pixels; the own one, which is view 1, is sent last.
    let aside = |places: Vec<f64>| places.len();
    assert_eq!(aside(raster_places(24)), 4);
    assert_eq!(aside(raster_places(10)), 3, "view 3 leaves at the left");
    assert_eq!(aside(raster_places(36)), 3, "view 0 leaves at the right");
    // The own view is always sent, so that the program finds the position that it expects; it shows nothing where the position leaves.
    let places = raster_places(39);
    assert_eq!(places.len(), 3);
    let own = places.last().copied().unwrap_or_default();
    assert!(own > 64.0, "{places:?}");
}

#[test]
fn what_begins_in_the_own_view_ends_in_the_others() {
    for layout in [SideBySide, Layers] {
        for wanted in [true, false] {
            let mut stage = Stage::new(layout, Grid::FULL);
            let (gl, before, shear) = (stage.gl, stage.fake.state(), stage.shear());
            let (state, rig) = (&stage.state, &stage.rig);
            enter_own(&gl, &mut stage.atlas, state, rig, shear);
            gl.draw_arrays(c::POINTS, Vertices::without_arrays(0, 1));
            let mut views = Vec::new();
            others(
                &gl,
                &mut stage.atlas,
                state,
                rig,
                shear,
                wanted,
                &mut |view| {
                    views.push(view);
                },
            );
            assert_eq!(views.len(), if wanted { 3 } else { 0 });
            let own = &stage.fake.draws()[0];
            assert!((sheared(own) - stage.aside(ViewIndex(1))).abs() < 1e-6);
            stage.fake.assert_restored(&before);
        }
    }
}

#[test]
fn several_viewports_are_in_each_tile_and_come_back() {
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    stage.program(|gl| {
        gl.viewport_indexed_f(1, 0.5, 0.0, 8.0, 8.0);
        gl.scissor_indexed(2, 1, 2, 3, 4);
        gl.enablei(c::SCISSOR_TEST, 2);
    });
    stage.state.rectangles = Rectangles::ask(&stage.gl, true);
    let before = stage.fake.state();
    stage.replay(ReplayHazard::None, &mut |_| ());
    stage.fake.assert_restored(&before);
    // In the tiles of four views, and where it was.
    let mut placed = stage.fake.lines("glViewportIndexedf*");
    placed.retain(|line| line.contains("(1, "));
    placed.sort();
    placed.dedup();
    assert_eq!(placed.len(), 4, "{placed:?}");
}

#[test]
fn attributes_are_pushed_where_their_changes_are_not_known() {
    for (effect, pushes, asks) in [
        (Effect::UNKNOWN, true, true),
        (Effect::ATTRIB, true, false),
        (Effect::COLOR, false, true),
        (Effect::NORMAL, false, false),
    ] {
        let mut stage = Stage::new(SideBySide, Grid::FULL);
        stage.replay(ReplayHazard::Current(effect), &mut |_| {});
        let pushed = stage.fake.count("glPushAttrib");
        assert_eq!(pushed, if pushes { 3 } else { 0 }, "{effect:?}");
        assert_eq!(stage.fake.count("glPopAttrib"), pushed);
        let flushed = stage.fake.count("glCallList");
        assert_eq!(flushed, usize::from(pushes), "before the first push");
        let asked = stage.fake.asked();
        let colour = asked.iter().any(|(what, _)| what.contains("CURRENT_COLOR"));
        assert_eq!(colour, asks, "{effect:?}: {asked:?}");
    }
}

#[test]
fn materials_that_follow_the_colour_are_asked_for_where_attributes_are_pushed() {
    for (effect, asks) in [
        (Effect::COLOR, false),
        (Effect::COLOR | Effect::ATTRIB, true),
    ] {
        let mut stage = Stage::new(SideBySide, Grid::FULL);
        stage.replay(ReplayHazard::Current(effect), &mut |_| {});
        let follows = stage.fake.lines("glIsEnabled*");
        assert_eq!(!follows.is_empty(), asks, "{effect:?}: {follows:?}");
    }
}
