//! The state guard of an amplified draw: sets viewport, scissor, capabilities and pixel sizes, and restores the program's.

use super::fixed_state::FixedState;
use super::pixel_size::{PixelSizeGuard, Units};
use super::programs::Program;
use super::replay::cut;
use crate::atlas::Atlas;
use crate::fixed::{Amplifier, FixedKey, Patches, Primitive, Provoking, Tiles};
use crate::gl::{Gl, ProgramName, consts as c};
use crate::state::State;

/// The region of a tile that may be drawn to, as in [`StateGuard`].
struct Region {
    clip: [f32; 4],
    limits: [i32; 2],
}

impl Default for Region {
    fn default() -> Self {
        Region {
            clip: [-1.0, 1.0, -1.0, 1.0],
            limits: [0; 2],
        }
    }
}

impl Region {
    /// Sets viewport and scissor for tiles beside each other. Along x, the viewport spans all tiles, and clip distances cut at the tile and at
    /// the program's viewport and scissor. Along y, viewport and scissor are the program's own.
    fn beside(gl: &Gl, state: &State, atlas: &Atlas) -> Region {
        let [vx, vy, vw, vh] = state.rectangles.viewport;
        let tile = atlas.tiles.width as i32;
        let (mut left, mut right) = (vx.max(0), vx.saturating_add(vw).min(tile));
        let (mut bottom, mut height) = (0, atlas.tiles.height as i32);
        if state.rectangles.scissor_test {
            let [sx, sy, sw, sh] = state.rectangles.scissor;
            (left, right) = (left.max(sx), right.min(sx.saturating_add(sw)));
            (bottom, height) = (sy, sh);
        }
        let ndc = |x: i32| (f64::from(x - vx) * 2.0 / f64::from(vw.max(1)) - 1.0) as f32;
        let ends = [
            if left == vx { -1.0 } else { ndc(left) },
            if right == vx.saturating_add(vw) {
                1.0
            } else {
                ndc(right)
            },
        ];
        let all = atlas.tiles.texture_width() as i32;
        gl.viewport(0, vy, all, vh);
        if state.rectangles.scissor_test {
            gl.scissor(0, bottom, all, height);
        }
        Region {
            clip: [ends[0], ends[1], -1.0, 1.0],
            limits: [left, right],
        }
    }
}

/// Enables and disables capabilities as the generated program needs them; returns those that changed, with their former values.
pub(super) fn toggle(
    gl: &Gl,
    key: &FixedKey,
    patches: &Patches,
    fixed: &FixedState,
) -> Vec<(u32, bool)> {
    let mut toggled = Vec::new();
    let mut set = |cap, was: bool, is: bool| {
        if was != is {
            if is {
                gl.enable(cap)
            } else {
                gl.disable(cap)
            }
            toggled.push((cap, was));
        }
    };
    set(c::COLOR_SUM, fixed.color_sum, patches.color_sum);
    let two_side = c::VERTEX_PROGRAM_TWO_SIDE;
    set(two_side, fixed.program_two_side, patches.two_side);
    let point_size = c::PROGRAM_POINT_SIZE;
    set(point_size, fixed.program_point_size, patches.point_size);
    if key.target.amplifier != Amplifier::Instanced
        && !matches!(key.target.primitive, Primitive::Points | Primitive::Lines)
    {
        // Measured on llvmpipe 22.3: with smooth lines enabled, the triangles of a geometry shader lose their colour.
        set(c::LINE_SMOOTH, fixed.surroundings.line_smooth, false);
        set(c::POINT_SMOOTH, fixed.surroundings.point_smooth, false);
    }
    for i in 0..8u32 {
        let (was, is) = (fixed.key.clip_planes, patches.clip_distances);
        set(c::CLIP_DISTANCE0 + i, was >> i & 1 != 0, is >> i & 1 != 0);
    }
    toggled
}

/// The state guard of an amplified draw.
pub(super) struct StateGuard {
    /// Width of the program's viewport over the width of a layer of the atlas.
    pub(super) scale: f32,
    /// The region of a tile that may be drawn to, in NDC of the program's viewport: left, right, bottom, top.
    pub(super) clip: [f32; 4],
    /// The left and the right of it, in pixels from the left edge of the tile.
    pub(super) limits: [i32; 2],
    viewport: [i32; 4],
    width: f64,
    /// Viewport and scissor differ from the program's.
    placed: bool,
    pixel_sizes: PixelSizeGuard,
    toggled: Vec<(u32, bool)>,
    /// The last-vertex convention is set in place of the program's first-vertex convention.
    last: bool,
}

impl StateGuard {
    pub(super) fn enter(
        gl: &Gl,
        state: &State,
        atlas: &Atlas,
        key: &FixedKey,
        program: &Program,
        units: Units,
        fixed: &FixedState,
    ) -> StateGuard {
        let beside = key.target.tiles == Tiles::ClipLeftRight;
        let width = f64::from(atlas.tiles.texture_width());
        let region = match beside {
            true => Region::beside(gl, state, atlas),
            false => Region::default(),
        };
        let grid = &atlas.tiles.grid;
        let pixel_sizes = PixelSizeGuard::enter(gl, state, grid, units);
        if !grid.is_full() {
            gl.viewport_f(grid.viewport(atlas.tiles.own(), 0, state.rectangles.viewport));
            if state.rectangles.scissor_test {
                let [x, y, w, h] = cut(state, &atlas.tiles, atlas.tiles.own(), 0);
                gl.scissor(x, y, w, h);
            }
        }
        gl.use_program(program.name);
        let toggled = toggle(gl, key, &program.patches, fixed);
        let last =
            program.patches.last_vertex_convention && fixed.key.provoking == Provoking::First;
        if last {
            gl.provoking_vertex(c::LAST_VERTEX_CONVENTION);
        }
        StateGuard {
            scale: (f64::from(state.rectangles.viewport[2]) / width) as f32,
            clip: region.clip,
            limits: region.limits,
            viewport: state.rectangles.viewport,
            width,
            placed: beside || !grid.is_full(),
            pixel_sizes,
            toggled,
            last,
        }
    }

    /// Centre, along x, of the program's viewport in the tile at the offset `x` in pixels, in NDC of the atlas.
    pub(super) fn centre(&self, x: u32) -> f32 {
        let [vx, _, vw, _] = self.viewport;
        ((2.0 * (f64::from(x) + f64::from(vx)) + f64::from(vw)) / self.width - 1.0) as f32
    }

    pub(super) fn leave(self, gl: &Gl, state: &State, atlas: &mut Atlas, _fixed: &FixedState) {
        for (cap, was) in self.toggled {
            if was { gl.enable(cap) } else { gl.disable(cap) }
        }
        if self.last {
            gl.provoking_vertex(c::FIRST_VERTEX_CONVENTION);
        }
        gl.use_program(ProgramName::ZERO);
        self.pixel_sizes.leave(gl);
        if self.placed {
            state.rectangles.put_in_force(gl);
        }
        atlas.bind_row(gl, 0);
    }
}
