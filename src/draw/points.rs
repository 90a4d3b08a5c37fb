//! Points for all views at once, drawn to the samples that a panel shows (`fixed/points.rs` has the shaders, `atlas/samples.rs` the target).

use super::amplified::{OUTSIDE, first_row, projection_of};
use super::fixed_state::FixedState;
use super::fragment_state;
use super::point_locations::PointLocations;
use super::programs::{DISTORTION_UNIT, Program, Programs, Stages, Uniforms};
use super::state_guard::toggle;
use super::variant::Variant;
use crate::atlas::{Samples, Tiles as TilePlaces};
use crate::fixed::{Amplifier, PointSize, Primitive, Tiles, Unsupported};
use crate::gl::{Gl, TextureName, consts as c};
use crate::plan::reason::Reason;
use crate::plan::{Rig, Shear};
use crate::state::State;
use crate::view::ViewIndex;
use std::sync::Arc;

/// Kind a driver rasterises points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointRules {
    /// Places in a pixel that it rounds to.
    parts: f32,
    /// The largest size.
    most: f32,
    /// The context has points that are not sprites.
    compatibility: bool,
}

impl PointRules {
    /// Asks the current context.
    #[must_use]
    pub fn ask(gl: &Gl, compatibility: bool) -> Self {
        let bits = gl.get_integer(c::SUBPIXEL_BITS).clamp(0, 12);
        PointRules {
            parts: f32::from(1_u16 << bits),
            most: gl.get_floats::<2>(c::ALIASED_POINT_SIZE_RANGE)[1],
            compatibility,
        }
    }
}

/// A program of points for a draw.
#[derive(Clone, Debug)]
pub struct PointProgram(Kind);

#[derive(Clone, Debug)]
enum Kind {
    /// A variant of the program's own, which is in use, and the texture units that it samples.
    Variant(Arc<Variant>, Vec<u32>),
    /// A generated one, with the modelview matrix.
    Generated(Box<Stages>, [f32; 16]),
    /// A variant that emits each point for so many views to their layers.
    VariantToLayers,
    /// The same of a generated one.
    GeneratedToLayers(Box<Stages>, [f32; 16]),
}

/// Views that a variant draws at once, whose outputs all drivers have room for: 1024 numbers for all vertices.
pub const POINTS_AT_ONCE: u32 = 16;

impl PointProgram {
    /// A variant from [`super::point_variant`], which has to be in use for the draw, and the texture units that it samples.
    #[must_use]
    pub fn by_variant(variant: Arc<Variant>, units: Vec<u32>) -> Self {
        PointProgram(Kind::Variant(variant, units))
    }

    /// A variant from [`super::point_variant`] that draws to layers.
    #[must_use]
    pub fn by_variant_to_layers() -> Self {
        PointProgram(Kind::VariantToLayers)
    }

    /// Whether it is a variant, which has to be in use for the draw.
    #[must_use]
    pub fn is_variant(&self) -> bool {
        matches!(self.0, Kind::Variant(..) | Kind::VariantToLayers)
    }

    /// Whether it draws to layers, and not to the samples of a panel.
    #[must_use]
    pub fn is_to_layers(&self) -> bool {
        matches!(self.0, Kind::VariantToLayers | Kind::GeneratedToLayers(..))
    }
}

/// The state of a draw of points that is not the program's: framebuffer, rectangles, capabilities, and the texture of the views.
struct PointGuard {
    toggled: Vec<u32>,
    modes: Option<[u32; 2]>,
    unit: u32,
    active: u32,
    texture: TextureName,
    sampler: u32,
}

/// State that applies to a quad and not to a point; with whether only compatibility contexts have it.
const DISABLED: [(u32, bool); 5] = [
    (c::CULL_FACE, false),
    (c::POLYGON_OFFSET_FILL, false),
    (c::POLYGON_SMOOTH, false),
    (c::POLYGON_STIPPLE, true),
    (c::SAMPLE_ALPHA_TO_COVERAGE, false),
];

impl PointGuard {
    fn enter(gl: &Gl, state: &State, samples: &Samples, unit: u32) -> Self {
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, samples.framebuffer);
        let [width, height] = samples.size.map(|n| n as i32);
        let parts = samples.parts as i32;
        gl.viewport(0, 0, width * parts, height);
        if state.rectangles.scissor_test {
            let [x, y, w, h] = state.rectangles.scissor;
            gl.scissor(x.saturating_mul(parts), y, w.saturating_mul(parts), h);
        }
        let there = |&&(_, compatibility): &&(u32, bool)| !compatibility || state.has.compatibility;
        let disabled = DISABLED.iter().filter(there).map(|entry| entry.0);
        let toggled: Vec<u32> = disabled.filter(|&cap| gl.is_enabled(cap)).collect();
        toggled.iter().for_each(|&cap| gl.disable(cap));
        let [front, back] = gl.get_integers::<2>(c::POLYGON_MODE).map(|m| m as u32);
        // A core context has one mode for both.
        let modes = [front, if state.has.compatibility { back } else { front }];
        let modes = Some(modes).filter(|modes| *modes != [c::FILL; 2]);
        if modes.is_some() {
            gl.polygon_mode(c::FRONT_AND_BACK, c::FILL);
        }
        let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
        gl.active_texture(c::TEXTURE0 + unit);
        let texture = TextureName(gl.get_integer(c::TEXTURE_BINDING_2D) as u32);
        let sampler = match gl.since((3, 3), None) {
            true => gl.get_integer(c::SAMPLER_BINDING) as u32,
            false => 0,
        };
        if sampler != 0 {
            gl.bind_sampler(unit, 0);
        }
        gl.bind_texture(c::TEXTURE_2D, samples.seen);
        gl.active_texture(active);
        PointGuard {
            toggled,
            modes,
            unit,
            active,
            texture,
            sampler,
        }
    }

    fn leave(self, gl: &Gl, state: &State) {
        gl.active_texture(c::TEXTURE0 + self.unit);
        gl.bind_texture(c::TEXTURE_2D, self.texture);
        gl.active_texture(self.active);
        if self.sampler != 0 {
            gl.bind_sampler(self.unit, self.sampler);
        }
        match self.modes {
            Some([front, back]) if front != back => {
                gl.polygon_mode(c::FRONT, front);
                gl.polygon_mode(c::BACK, back);
            }
            Some([mode, _]) => gl.polygon_mode(c::FRONT_AND_BACK, mode),
            None => {}
        }
        self.toggled.iter().for_each(|&cap| gl.enable(cap));
        state.rectangles.put_in_force(gl);
    }
}

/// The uniforms of a draw, but for the shifts.
fn set_uniforms(
    gl: &Gl,
    at: &PointLocations,
    state: &State,
    (samples, flipped): (&Samples, bool),
    rules: &PointRules,
    (views, unit, written): (u32, u32, bool),
) {
    let [vx, vy, vw, vh] = state.rectangles.viewport.map(|n| n as f32);
    let [width, height] = samples.size.map(|n| n as f32);
    let parts = samples.parts as f32;
    let (up, middle) = match flipped {
        true => (-vh / 2.0, height - (vy + vh / 2.0)),
        false => (vh / 2.0, vy + vh / 2.0),
    };
    let sprites = !rules.compatibility || gl.is_enabled(c::POINT_SPRITE);
    let size = match written {
        true => 0.0,
        false => gl.get_floats::<1>(c::POINT_SIZE)[0],
    };
    let upper = gl.get_integer(c::POINT_SPRITE_COORD_ORIGIN) as u32 != c::LOWER_LEFT;
    gl.uniform_4fv(at.target, &[[width * parts, height, parts, views as f32]]);
    gl.uniform_4fv(at.window, &[[vw / 2.0, vx + vw / 2.0, up, middle]]);
    let rule = [f32::from(u8::from(sprites)), rules.parts, rules.most, size];
    gl.uniform_4fv(at.rule, &[rule]);
    gl.uniform_1f(at.rows_down, f32::from(u8::from(flipped)));
    gl.uniform_1f(at.coord_sign, if upper == flipped { 1.0 } else { -1.0 });
    gl.uniform_1i(at.seen, unit as i32);
}

/// Enables the clip distances of a generated shader in place of the program's planes, as bits, or the other way round.
fn switch_planes(gl: &Gl, planes: Option<(u8, u8)>, ours: bool) {
    let Some((planes, distances)) = planes else {
        return;
    };
    for i in 0..u8::BITS {
        let [was, is] = [planes, distances].map(|bits| bits >> i & 1 != 0);
        match (was == is, is == ours) {
            (true, _) => {}
            (_, true) => gl.enable(c::CLIP_DISTANCE0 + i),
            (_, false) => gl.disable(c::CLIP_DISTANCE0 + i),
        }
    }
}

impl Programs {
    /// The program of points of fixed function, which is compiled if it is new.
    ///
    /// # Errors
    /// Why the draw has to be replayed.
    pub fn prepare_points(
        &mut self,
        gl: &Gl,
        fixed: &FixedState,
        material: bool,
    ) -> Result<PointProgram, Reason> {
        let modelview = gl.get_matrix(c::MODELVIEW_MATRIX);
        let (mut key, surroundings) = fixed.for_mode(c::POINTS, &modelview, material);
        key.target.amplifier = Amplifier::Points;
        key.target.tiles = Tiles::Layer;
        key.target.views = 1;
        surroundings.allow(&key).map_err(Reason::Fixed)?;
        let fragment = fragment_state::read(gl, self.driver, &key).map_err(Reason::Fixed)?;
        let sampled = fragment.canonical().sampled().next().is_some();
        if sampled && gl.is_enabled(c::POINT_SPRITE) {
            // Neighbours of a pixel are of other views, so the texture has no level of detail.
            return Err(Reason::Fixed(Unsupported::TextureEnvironment));
        }
        let stages = (key.canonical(), Some(fragment.canonical()));
        self.compile(gl, &key, &stages)?;
        Ok(PointProgram(Kind::Generated(Box::new(stages), modelview)))
    }

    /// The program of points of fixed function that are drawn to layers, of so many views; it is compiled if it is new. `surfaces`: they are disks of surfaces.
    ///
    /// # Errors
    /// Why the draw has to be replayed.
    pub fn prepare_layered_points(
        &mut self,
        gl: &Gl,
        fixed: &FixedState,
        (material, surfaces): (bool, bool),
        views: u32,
    ) -> Result<PointProgram, Reason> {
        let modelview = gl.get_matrix(c::MODELVIEW_MATRIX);
        let (mut key, surroundings) = fixed.for_mode(c::POINTS, &modelview, material);
        key.target.primitive = Primitive::Points;
        key.target.tiles = Tiles::Layer;
        key.target.amplifier = Amplifier::GeometryLoop;
        key.target.views = 1;
        let batch = crate::fixed::batch(&key, &self.limits);
        key.target.views = batch.min(views).clamp(1, POINTS_AT_ONCE) as u8;
        key.target.surface = surfaces;
        surroundings.allow(&key).map_err(Reason::Fixed)?;
        let fragment = match surfaces {
            true => Some(fragment_state::read(gl, self.driver, &key).map_err(Reason::Fixed)?),
            false => None,
        };
        let stages = (key.canonical(), fragment.map(|key| key.canonical()));
        self.compile(gl, &key, &stages)?;
        Ok(PointProgram(Kind::GeneratedToLayers(
            Box::new(stages),
            modelview,
        )))
    }

    /// Draws points to the layers of the framebuffer that is bound, by a program from [`Programs::prepare_layered_points`]. `call` makes the draw for some views. All state
    /// is as before, but for the program in use.
    #[allow(
        clippy::too_many_arguments,
        reason = "the parts of one draw; a struct of them would be built for this call alone"
    )]
    pub fn draw_layered_points(
        &mut self,
        gl: &Gl,
        state: &State,
        (rig, shear): (&Rig, Option<Shear>),
        tiles: &TilePlaces,
        fixed: &FixedState,
        (how, sizes): (&PointProgram, [f32; 4]),
        call: &mut dyn FnMut(),
    ) {
        let Kind::GeneratedToLayers(stages, modelview) = &how.0 else {
            return;
        };
        let Some(Some(program)) = self.cache.get_mut(&**stages) else {
            return;
        };
        gl.use_program(program.name);
        gl.uniform_4fv(program.points.surface, &[sizes]);
        let toggled = toggle(gl, &stages.0, &program.patches, fixed);
        let batch = usize::from(stages.0.target.views.max(1));
        let drawn: Vec<ViewIndex> = tiles.order().collect();
        for views in drawn.chunks(batch) {
            let row =
                |&view: &ViewIndex| first_row(&projection_of(state, rig, shear, view), modelview);
            let mut rows: Vec<[f32; 4]> = views.iter().map(row).collect();
            let layer = |&view: &ViewIndex| [0.0, 0.0, tiles.slot(view) as f32, 0.0];
            let mut places: Vec<[f32; 4]> = views.iter().map(layer).collect();
            // Of a whole batch.
            rows.resize(batch, OUTSIDE);
            places.resize(batch, [0.0; 4]);
            program.upload(
                gl,
                Uniforms {
                    rows,
                    tiles: places,
                    ..Uniforms::default()
                },
            );
            call();
        }
        for (cap, was) in toggled {
            if was { gl.enable(cap) } else { gl.disable(cap) }
        }
    }

    /// Draws points to the samples of a panel. All state is as before, but for the framebuffer and the program in use.
    #[allow(
        clippy::too_many_arguments,
        reason = "the parts of one draw; a struct of them would be built for this call alone"
    )]
    pub fn draw_points(
        &mut self,
        gl: &Gl,
        state: &State,
        target: (&Samples, bool),
        (rig, shear, views): (&Rig, Option<Shear>, u32),
        rules: &PointRules,
        how: &PointProgram,
        call: &mut dyn FnMut(),
    ) {
        let (at, unit, written, planes) = match &how.0 {
            Kind::Variant(variant, units) => {
                let unit = (0..=DISTORTION_UNIT)
                    .rev()
                    .find(|unit| !units.contains(unit));
                let written = gl.is_enabled(c::PROGRAM_POINT_SIZE);
                let unit = unit.unwrap_or(DISTORTION_UNIT);
                (variant.point_locations(), unit, written, None)
            }
            Kind::Generated(stages, modelview) => {
                let Some(Some(program)) = self.cache.get_mut(&**stages) else {
                    return;
                };
                gl.use_program(program.name);
                let rows = |view| first_row(&projection_of(state, rig, shear, view), modelview);
                let rows: Vec<[f32; 4]> = ViewIndex::all(views).map(rows).collect();
                program.upload_rows(gl, rows);
                let (planes, distances) = (stages.0.clip_planes, program.patches.clip_distances);
                let written = stages.0.point == PointSize::Attenuated;
                (
                    program.points,
                    DISTORTION_UNIT,
                    written,
                    Some((planes, distances)),
                )
            }
            Kind::VariantToLayers | Kind::GeneratedToLayers(..) => return,
        };
        let guard = PointGuard::enter(gl, state, target.0, unit);
        switch_planes(gl, planes, true);
        set_uniforms(gl, &at, state, target, rules, (views, unit, written));
        call();
        switch_planes(gl, planes, false);
        guard.leave(gl, state);
    }
}

impl Program {
    /// Sets row 0 of each view's projection times the modelview matrix.
    fn upload_rows(&mut self, gl: &Gl, rows: Vec<[f32; 4]>) {
        if self.uploaded.rows != rows {
            gl.uniform_4fv(self.views_location(), &rows);
            self.uploaded.rows = rows;
        }
    }
}
