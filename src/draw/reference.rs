//! Repeats a draw in the reference image of an occlusion camera, with a generated program or a variant of the program's own.

use super::fixed_state::FixedState;
use super::fragment_state;
use super::pixel_size::Units;
use super::programs::{DISTORTION_UNIT, Programs};
use super::replay::{ReplayHazard, replay};
use super::state_guard::StateGuard;
use super::variant::Variant;
use crate::atlas::{Atlas, ReferenceSurface};
use crate::fixed::{Amplifier, Primitive, Tiles};
use crate::gl::{Gl, TextureName, consts as c};
use crate::plan::{Reason, Rig, Shear};
use crate::state::State;

/// The distortion of the occlusion camera's rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rays {
    /// The distortion map.
    pub map: TextureName,
    /// Disparity over z in NDC, in pixels for one place, as in the map: factor and offset.
    pub disparities: [f32; 2],
}

/// The primitives of a draw of surfaces.
#[derive(Clone, Copy, Debug)]
pub struct Drawing {
    /// The primitive mode; none where there are several, all of which are surfaces.
    pub mode: Option<u32>,
    /// The number of vertices, at least.
    pub vertices: u64,
    /// There are no more.
    pub counted: bool,
    /// The draw can be made with `GL_PATCHES` of three vertices, or of four for quads.
    pub cuts: bool,
    /// It may change the material.
    pub material: bool,
}

impl Drawing {
    /// The patches for tessellation, and the number of their corners; none where the draw cannot be tessellated.
    fn patches(&self) -> Option<(Primitive, i32)> {
        match self.mode.filter(|_| self.cuts)? {
            c::TRIANGLES | c::TRIANGLE_STRIP | c::TRIANGLE_FAN | c::POLYGON => {
                Some((Primitive::Triangles, 3))
            }
            c::QUADS | c::QUAD_STRIP => Some((Primitive::Quads, 4)),
            _ => None,
        }
    }
}

/// Average area of a small triangle, in pixels: half a square of the edge length to which tessellation subdivides.
const SMALL: u64 = 8;

/// Whether triangles of so many vertices may be large: if they covered the whole picture, they would be larger than [`SMALL`] on average.
fn may_be_large(vertices: u64, atlas: &Atlas) -> bool {
    let [width, height] = [atlas.tiles.width, atlas.tiles.height].map(u64::from);
    vertices * SMALL < 3 * width * height
}

impl Rays {
    /// The uniforms `mv_window` and `mv_disparity` of a picture; `sparse`: draw only vertices that the distortion moves.
    fn uniforms(&self, state: &State, atlas: &Atlas, sparse: bool) -> [[f32; 4]; 2] {
        let [x, y, width, height] = state.rectangles.viewport.map(|n| n as f32);
        let (middle, up) = (y + height / 2.0, height / 2.0);
        let rows = match atlas.flipped {
            true => [-up, atlas.tiles.height as f32 - middle],
            false => [up, middle],
        };
        let [factor, added] = self.disparities;
        [
            [width / 2.0, rows[0], x + width / 2.0, rows[1]],
            [factor, added, 2.0 / width, f32::from(u8::from(sparse))],
        ]
    }
}

/// The distortion map, bound to its unit; restores the former binding.
struct Bound {
    unit: u32,
    active: u32,
    was: TextureName,
}

impl Bound {
    fn enter(gl: &Gl, unit: u32, map: TextureName) -> Bound {
        let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
        gl.active_texture(c::TEXTURE0 + unit);
        let was = TextureName(gl.get_integer(c::TEXTURE_BINDING_2D_ARRAY) as u32);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, map);
        gl.active_texture(active);
        Bound { unit, active, was }
    }

    fn leave(self, gl: &Gl) {
        gl.active_texture(c::TEXTURE0 + self.unit);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, self.was);
        gl.active_texture(self.active);
    }
}

/// Makes one draw in the reference image, with the program in use.
fn into_reference(
    gl: &Gl,
    atlas: &mut Atlas,
    state: &State,
    rig: &Rig,
    shear: Option<Shear>,
    hazard: ReplayHazard,
    call: &mut dyn FnMut(),
) {
    let mut surface = ReferenceSurface(atlas);
    replay(
        gl,
        &mut surface,
        state,
        rig,
        shear,
        hazard,
        false,
        &mut |_| call(),
    );
}

/// Repeats a draw in the reference image with a variant of the program's own shaders, which is in use. `units` are the texture units that it
/// samples; `shear` is for vertices that the projection matrix of fixed function places. All state is as before, but for the program in use.
#[allow(
    clippy::too_many_arguments,
    reason = "the parts of one draw; a struct of them would be built for this call alone"
)]
pub fn draw_to_reference(
    gl: &Gl,
    atlas: &mut Atlas,
    state: &State,
    rig: &Rig,
    shear: Option<Shear>,
    (variant, units): (&Variant, &[u32]),
    vertices: u64,
    hazard: ReplayHazard,
    rays: &Rays,
    call: &mut dyn FnMut(),
) {
    let unit = (0..=DISTORTION_UNIT)
        .rev()
        .find(|unit| !units.contains(unit));
    let unit = unit.unwrap_or(DISTORTION_UNIT);
    let sparse = !may_be_large(vertices, atlas);
    variant.set_distortion(gl, unit, rays.uniforms(state, atlas, sparse));
    let map = Bound::enter(gl, unit, rays.map);
    into_reference(gl, atlas, state, rig, shear, hazard, call);
    atlas.bind_row(gl, 0);
    map.leave(gl);
}

impl Programs {
    /// Repeats a draw of fixed-function surfaces in the reference image; all state is as before. Surfaces that may be large are tessellated into
    /// small triangles, since rays are distorted per vertex. `call` makes the draw in a primitive mode.
    ///
    /// # Errors
    /// Why there is no program for the draw; nothing was drawn.
    #[allow(
        clippy::too_many_arguments,
        reason = "the parts of one draw; a struct of them would be built for this call alone"
    )]
    pub fn draw_to_reference(
        &mut self,
        gl: &Gl,
        atlas: &mut Atlas,
        state: &State,
        rig: &Rig,
        shear: Option<Shear>,
        fixed: &FixedState,
        drawing: &Drawing,
        hazard: ReplayHazard,
        rays: &Rays,
        call: &mut dyn FnMut(u32),
    ) -> Result<(), Reason> {
        let modelview = gl.get_matrix(c::MODELVIEW_MATRIX);
        let mode = drawing.mode.unwrap_or(c::TRIANGLES);
        let (mut key, surroundings) = fixed.for_mode(mode, &modelview, drawing.material);
        let large = may_be_large(drawing.vertices, atlas);
        // Under flat shading, the corner that colours a triangle of a strip depends on its position in the strip, which patches do not keep.
        let alone = !key.flat || [c::TRIANGLES, c::QUADS].contains(&mode);
        let cut = large && alone && self.limits.glsl >= 400;
        let patches = drawing.patches().filter(|_| cut);
        key.target.amplifier = Amplifier::Instanced;
        if let Some((primitive, _)) = patches {
            key.target.amplifier = Amplifier::Tessellation;
            key.target.primitive = primitive;
        }
        key.target.tiles = Tiles::DistortedRays;
        surroundings.allow(&key).map_err(Reason::Fixed)?;
        let fragment = fragment_state::read(gl, self.driver, &key).map_err(Reason::Fixed)?;
        let stages = (key.canonical(), Some(fragment.canonical()));
        self.compile(gl, &key, &stages)?;
        let Some(Some(program)) = self.cache.get(&stages) else {
            return Err(Reason::Compile);
        };
        let map = Bound::enter(gl, DISTORTION_UNIT, rays.map);
        let guard = StateGuard::enter(gl, state, atlas, &stages.0, program, Units::None, fixed);
        let [window, disparity] = rays.uniforms(state, atlas, !large);
        gl.uniform_4fv(program.window, &[window]);
        gl.uniform_4fv(program.disparity, &[disparity]);
        let cut = patches.map(|(_, corners)| {
            gl.uniform_1f(
                program.levels,
                self.driver.level(drawing.vertices / corners as u64) as f32,
            );
            let was = gl.get_integer(c::PATCH_VERTICES);
            gl.patch_parameteri(c::PATCH_VERTICES, corners);
            was
        });
        let mode = cut.map_or(mode, |_| c::PATCHES);
        into_reference(gl, atlas, state, rig, shear, hazard, &mut || call(mode));
        if let Some(was) = cut {
            gl.patch_parameteri(c::PATCH_VERTICES, was);
        }
        guard.leave(gl, state, atlas, fixed);
        map.leave(gl);
        Ok(())
    }
}
