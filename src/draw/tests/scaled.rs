//! Tiles with fewer texels than the window has pixels: state that is measured in pixels is scaled, and restored.

use super::super::{ReplayHazard, replay};
use super::Stage;
use crate::atlas::Grid;
use crate::config::AtlasLayout::SideBySide;
use crate::gl::consts as c;
use crate::gl::fake::{Drawn, Scope};
use crate::gl::{Gl, Vertices};

fn half() -> Grid {
    Grid::scaled([32, 24], [64, 48])
}

/// The draws of one view with the state that a program has set.
fn drawn(hazard: ReplayHazard, program: impl FnOnce(&Gl)) -> Vec<Drawn> {
    let mut stage = Stage::new(SideBySide, half());
    stage.program(program);
    let (gl, before, shear) = (stage.gl, stage.fake.state(), stage.shear());
    let (state, rig) = (&stage.state, &stage.rig);
    replay(
        &gl,
        &mut stage.atlas,
        state,
        rig,
        shear,
        hazard,
        true,
        &mut |_| {
            gl.draw_arrays(c::TRIANGLES, Vertices::without_arrays(0, 3));
        },
    );
    stage.fake.assert_restored(&before);
    stage.fake.draws()
}

#[test]
fn viewport_scissor_and_widths_are_half_as_large() {
    let drawn = drawn(ReplayHazard::None, |gl| {
        gl.viewport(8, 4, 40, 40);
        gl.line_width(3.0);
        gl.point_size(5.0);
        gl.enable(c::SCISSOR_TEST);
        gl.scissor(10, 10, 20, 20);
    });
    assert_eq!(drawn.len(), 4);
    let state = &drawn[3].state;
    assert_eq!(state.value(c::VIEWPORT), [4.0, 2.0, 20.0, 20.0]);
    assert_eq!(state.value(c::SCISSOR_BOX), [5.0, 5.0, 10.0, 10.0]);
    assert_eq!(state.value(c::LINE_WIDTH), [1.5]);
    assert_eq!(state.value(c::POINT_SIZE), [2.5]);
}

#[test]
fn an_offset_keeps_its_units_and_halves_its_factor() {
    for on in [true, false] {
        let drawn = drawn(ReplayHazard::None, |gl| {
            gl.polygon_offset(4.0, 3.0);
            if on {
                gl.enable(c::POLYGON_OFFSET_FILL);
            }
        });
        let value = |name| drawn[0].state.value(name)[0];
        let factor = if on { 2.0 } else { 4.0 };
        assert_eq!(value(c::POLYGON_OFFSET_FACTOR), factor);
        assert_eq!(value(c::POLYGON_OFFSET_UNITS), 3.0);
    }
}

#[test]
fn a_clamped_offset_keeps_its_clamp() {
    let mut stage = Stage::new(SideBySide, half());
    stage.state.has.offset_clamp = true;
    stage.program(|gl| {
        gl.polygon_offset_clamp(4.0, 3.0, 0.5);
        gl.enable(c::POLYGON_OFFSET_FILL);
    });
    let (gl, before) = (stage.gl, stage.fake.state());
    let (state, rig) = (&stage.state, &stage.rig);
    replay(
        &gl,
        &mut stage.atlas,
        state,
        rig,
        None,
        ReplayHazard::None,
        true,
        &mut |_| {
            gl.draw_arrays(c::TRIANGLES, Vertices::without_arrays(0, 3));
        },
    );
    let drawn = stage.fake.draws();
    assert_eq!(drawn[0].state.value(c::POLYGON_OFFSET_CLAMP), [0.5]);
    stage.fake.assert_restored(&before);
}

#[test]
fn textures_that_are_switched_on_are_sharper() {
    const LIST: ReplayHazard = ReplayHazard::Anything {
        rects: false,
        projection: false,
        current: crate::state::Effect::NONE,
    };
    let program = |gl: &Gl| {
        for (unit, bias) in [(0, 0.5), (2, 0.25), (3, 0.75)] {
            gl.active_texture(c::TEXTURE0 + unit);
            gl.tex_envf(c::TEXTURE_FILTER_CONTROL, c::TEXTURE_LOD_BIAS, bias);
        }
        gl.enable(c::TEXTURE_2D);
        gl.active_texture(c::TEXTURE0);
        gl.enable(c::TEXTURE_CUBE_MAP);
        gl.active_texture(c::TEXTURE0 + 1);
    };
    let biases = |drawn: &Drawn| {
        [0, 1, 2, 3].map(|unit| drawn.state.get(Scope::Unit(unit), c::TEXTURE_LOD_BIAS)[0])
    };
    let level = half().level_bias();
    let (on, all) = (drawn(ReplayHazard::None, program), drawn(LIST, program));
    assert_eq!(biases(&on[0]), [0.5 + level, 0.0, 0.25, 0.75 + level]);
    assert_eq!(
        biases(&all[0]),
        [0.5, 0.0, 0.25, 0.75].map(|bias| bias + level)
    );
}

/// The queries of the pixel-size guard for each draw; state that is tracked would need none.
#[test]
fn what_the_guard_asks_is_known() {
    let mut stage = Stage::new(SideBySide, half());
    let gl = stage.gl;
    let (state, rig) = (&stage.state, &stage.rig);
    replay(
        &gl,
        &mut stage.atlas,
        state,
        rig,
        None,
        ReplayHazard::None,
        true,
        &mut |_| {},
    );
    let asked: usize = stage.fake.asked().iter().map(|(_, count)| count).sum();
    // Two widths, GL_POLYGON_OFFSET_FILL, the active unit, the number of units, five targets of each of eight units.
    assert_eq!(asked, 2 + 1 + 1 + 1 + 8 * 5);
}
