//! One draw for the reference image of an occlusion camera, with a generated program or a variant of the program's own.

use super::fixed_state::FixedState;
use super::fragment_state;
use super::pixel_size::Units;
use super::programs::{DISTORTION_UNIT, Programs};
use super::replay::{ReplayHazard, replay};
use super::state_guard::StateGuard;
use super::variant::Variant;
use crate::atlas::{Atlas, ReferenceSurface};
use crate::fixed::{Amplifier, Primitive, Tiles};
use crate::gl::{Gl, consts as c};
use crate::plan::{Reason, Rig, Shear};
use crate::state::State;

/// What the rays are distorted by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rays {
    /// The distortion map.
    pub map: u32,
    /// Disparities as in the map: factor of z in NDC, and what is added.
    pub disparities: [f32; 2],
}

/// What a draw of surfaces is made of.
#[derive(Clone, Copy, Debug)]
pub struct Drawing {
    /// Of the primitives; none where they are several, and surfaces.
    pub mode: Option<u32>,
    /// How many there are at least.
    pub vertices: u64,
    /// It can be made with `GL_PATCHES` of three vertices, or of four in the place of quads.
    pub cuts: bool,
    /// It may change the material.
    pub material: bool,
}

impl Drawing {
    /// Its patches, and how many corners they have.
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

/// Pixels of a small triangle, on the average: half a square of those edges that triangles are cut to.
const SMALL: u64 = 8;

/// Whether the triangles of so many vertices are not small in the picture, on the whole, wherever they are.
fn few(vertices: u64, atlas: &Atlas) -> bool {
    let [width, height] = [atlas.tiles.width, atlas.tiles.height].map(u64::from);
    vertices * SMALL < 3 * width * height
}

impl Rays {
    /// `mv_window` and `mv_disparity` of a picture; `sparse`: without what is not moved.
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

/// The map in its unit.
struct Bound {
    unit: u32,
    active: u32,
    was: u32,
}

impl Bound {
    fn enter(gl: &Gl, unit: u32, map: u32) -> Bound {
        let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
        gl.active_texture(c::TEXTURE0 + unit);
        let was = gl.get_integer(c::TEXTURE_BINDING_2D_ARRAY) as u32;
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

/// One draw with the program that is in use.
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

/// Draws by a variant of the program's own shaders, which is in use, into the reference image; `units` are those that it samples. All state is as
/// before, but for the program in use. What has no shift by the projection matrix of fixed function has that of the variant.
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
    let sparse = !few(vertices, atlas);
    variant.set_distortion(gl, unit, rays.uniforms(state, atlas, sparse));
    let map = Bound::enter(gl, unit, rays.map);
    into_reference(gl, atlas, state, rig, shear, hazard, call);
    atlas.bind_row(gl, 0);
    map.leave(gl);
}

impl Programs {
    /// Draws surfaces of fixed function into the reference image; all state is as before. Where their vertices are few for the picture they are cut
    /// into small ones. `call` makes the draw, in a mode.
    ///
    /// # Errors
    /// Why there is no such program. Nothing was drawn.
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
        let modelview = gl.get_floats::<16>(c::MODELVIEW_MATRIX);
        let mode = drawing.mode.unwrap_or(c::TRIANGLES);
        let (mut key, around) = fixed.for_mode(mode, &modelview, drawing.material);
        let few = few(drawing.vertices, atlas);
        // Which corner colours a flat one of a strip goes by its place in the strip.
        let alone = !key.flat || [c::TRIANGLES, c::QUADS].contains(&mode);
        let cut = few && alone && self.limits.glsl >= 400;
        let patches = drawing.patches().filter(|_| cut);
        key.target.amplifier = Amplifier::Instanced;
        if let Some((primitive, _)) = patches {
            key.target.amplifier = Amplifier::Tessellation;
            key.target.primitive = primitive;
        }
        key.target.tiles = Tiles::DistortedRays;
        around.allow(&key).map_err(Reason::Fixed)?;
        let fragment = fragment_state::read(gl, self.driver, &key).map_err(Reason::Fixed)?;
        let stages = (key.canonical(), Some(fragment.canonical()));
        self.compile(gl, &key, &stages)?;
        let Some(Some(program)) = self.cache.get(&stages) else {
            return Err(Reason::Compile);
        };
        let map = Bound::enter(gl, DISTORTION_UNIT, rays.map);
        let around = StateGuard::enter(gl, state, atlas, &stages.0, program, Units::None, fixed);
        let [window, disparity] = rays.uniforms(state, atlas, !few);
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
        around.leave(gl, state, atlas, fixed);
        map.leave(gl);
        Ok(())
    }
}
