//! Amplified draws: one draw for many views, by instances or a geometry shader, with a generated vertex stage.
//!
//! Based on: Luo et al. (GBMVR) and de Sorbier et al. for the geometry shader; instances as in ANGLE's multiview emulation.

use super::fixed_state::FixedState;
use super::fragment_state;
use super::pixel_size::Units;
use super::programs::{Programs, Stages, Uniforms};
use super::state_guard::StateGuard;
use crate::atlas::{Atlas, Tiles as TilePlaces};
use crate::fixed::{self, Amplifier, FixedKey, Primitive, Tiles, Unsupported};
use crate::gl::{Gl, consts as c};
use crate::plan::reason::{Reason, Replayed};
use crate::plan::{Method, Rig, Shear};
use crate::state::State;
use crate::view::ViewIndex;

/// How an amplifier makes a draw, from [`Programs::prepare`].
#[derive(Clone, Copy, Debug)]
pub struct Amplified {
    pub(super) stages: Stages,
    pub(super) batch: u32,
    modelview: [f32; 16],
    /// The primitive mode to draw with, in place of the program's.
    pub mode: u32,
}

impl Programs {
    /// Whether all views can be drawn with one viewport and one scissor.
    ///
    /// # Errors
    /// Why they cannot.
    pub fn allow(state: &State, atlas: &Atlas) -> Result<(), Reason> {
        let (tiles, grid) = (&atlas.tiles, &atlas.tiles.grid);
        let apart = grid.step[1] != 0.0 || grid.step[0] != 0.0 && state.rectangles.scissor_test;
        if apart || !grid.is_full() && tiles.columns > 1 {
            return Err(Reason::Replayed(Replayed::TilesApart));
        }
        Ok(())
    }

    /// Decides how an amplifier makes a draw, and compiles the program if it is new. `material`: glMaterial occurs between glBegin and
    /// glEnd.
    ///
    /// # Errors
    /// Why the draw has to be replayed.
    #[allow(
        clippy::too_many_arguments,
        reason = "the parts of one draw; a struct of them would be built for this call alone"
    )]
    pub fn prepare(
        &mut self,
        gl: &Gl,
        method: Method,
        mode: u32,
        fixed: &FixedState,
        material: bool,
        atlas: &Atlas,
    ) -> Result<Amplified, Reason> {
        let grid = &atlas.tiles.grid;
        let modelview = gl.get_matrix(c::MODELVIEW_MATRIX);
        let (mut key, surroundings) = fixed.for_mode(mode, &modelview, material);
        let geometry = method == Method::Geometry;
        let (primitive, drawn_mode) = if geometry {
            primitive(mode, key.flat)?
        } else {
            (Primitive::default(), mode)
        };
        key.target.tiles = match atlas.tiles.columns {
            1 => Tiles::Layer,
            _ => Tiles::ClipLeftRight,
        };
        key.target.clip = self.clip;
        key.target.primitive = primitive;
        key.target.views = 1;
        if key.target.tiles == Tiles::Layer && atlas.layered().is_none() {
            // There is one view, or the driver has no layered framebuffers.
            return Err(Reason::Fixed(Unsupported::VertexLayer));
        }
        let batch = self.batch(method, &mut key, atlas);
        allow_target(&key, mode, geometry)?;
        surroundings.allow(&key).map_err(Reason::Fixed)?;
        // Measured on llvmpipe 22.3: wide and smooth points and lines are torn after a geometry shader.
        let drawn = surroundings.rasterised;
        let wide = |size: f32, smooth: bool| size != 1.0 || smooth;
        if geometry
            && (drawn.lines && wide(surroundings.line_width, surroundings.line_smooth)
                || drawn.points && wide(surroundings.point_size, surroundings.point_smooth))
        {
            return Err(Reason::Replayed(Replayed::WidePrimitives));
        }
        let fragment = if key.target.discards() || grid.is_sample_aligned() {
            let mut read = fragment_state::read(gl, self.driver, &key).map_err(Reason::Fixed)?;
            read.grid = grid.is_sample_aligned();
            // The driver's own fragment stage is used unless views are cut by discard or the level of detail has to follow the grid.
            Some(read.canonical()).filter(|key| key.discard || key.grid)
        } else {
            None
        };
        let stages = (key.canonical(), fragment);
        self.compile(gl, &key, &stages)?;
        Ok(Amplified {
            modelview,
            stages,
            batch,
            mode: drawn_mode,
        })
    }

    /// Chooses the amplifier, and returns the number of views that one call draws.
    fn batch(&self, method: Method, key: &mut FixedKey, atlas: &Atlas) -> u32 {
        match method {
            Method::Geometry => {
                key.target.amplifier = Amplifier::GeometryInvocations;
                let mut batch = fixed::batch(key, &self.limits);
                if batch == 0 {
                    key.target.amplifier = Amplifier::GeometryLoop;
                    batch = fixed::batch(key, &self.limits);
                }
                // A batch never spans two rows of tiles.
                let per_row = atlas
                    .tiles
                    .columns
                    .max(if key.target.tiles == Tiles::Layer {
                        atlas.tiles.views
                    } else {
                        1
                    });
                let batch = batch.min(per_row).max(1);
                key.target.views = u8::try_from(batch).unwrap_or(u8::MAX);
                batch
            }
            _ => {
                key.target.amplifier = Amplifier::Instanced;
                fixed::batch(key, &self.limits).max(1)
            }
        }
    }

    /// Makes the draw, in one call per batch of views. `call` gets the number of views of its batch, which is the instance count of an
    /// instanced draw.
    #[allow(
        clippy::too_many_arguments,
        reason = "the parts of one draw; a struct of them would be built for this call alone"
    )]
    pub fn draw(
        &mut self,
        gl: &Gl,
        atlas: &mut Atlas,
        state: &State,
        rig: &Rig,
        shear: Option<Shear>,
        fixed: &FixedState,
        how: &Amplified,
        call: &mut dyn FnMut(u32),
    ) {
        let Some(Some(program)) = self.cache.get_mut(&how.stages) else {
            return;
        };
        let key = &how.stages.0;
        let units = match how.stages.1 {
            Some(fragment) if fragment.grid => Units::None,
            _ => Units::Enabled,
        };
        let guard = StateGuard::enter(gl, state, atlas, key, program, units, fixed);
        let tiles = atlas.tiles;
        let layers = key.target.tiles == Tiles::Layer;
        let discards = key.target.discards();
        let modelview = how.modelview;
        let frame = Batch {
            state,
            rig,
            tiles,
            shear,
            modelview,
            discards,
            size: how.batch as usize,
        };
        // The shader chooses a layer; a row of tiles has to be bound.
        let (rows, per_row) = if layers {
            (1, tiles.views)
        } else {
            (tiles.rows, tiles.columns)
        };
        for row in (0..rows).rev() {
            if layers {
                atlas.bind_layered(gl);
            } else {
                atlas.bind_row(gl, row);
            }
            let end = (per_row * (row + 1)).min(tiles.views);
            let views = (per_row * row..end).map(|slot| tiles.view_in(slot));
            let drawn: Vec<ViewIndex> = views.filter(|&view| tiles.draws(view)).collect();
            for views in drawn.chunks(how.batch as usize) {
                if self.resends {
                    program.uploaded = Uniforms::default();
                }
                program.upload(gl, frame.uniforms(views, &guard));
                call(views.len() as u32);
            }
        }
        guard.leave(gl, state, atlas, fixed);
    }
}

/// The inputs for the uniforms of a batch of views.
struct Batch<'a> {
    state: &'a State,
    rig: &'a Rig,
    tiles: TilePlaces,
    shear: Option<Shear>,
    modelview: [f32; 16],
    discards: bool,
    /// The number of views in a batch.
    size: usize,
}

impl Batch<'_> {
    /// Row 0 of P_i · modelview of a view.
    fn first_row(&self, view: ViewIndex) -> [f32; 4] {
        let (state, tiles) = (self.state, &self.tiles);
        let p = projection_of(state, self.rig, self.shear, view);
        if tiles.grid.is_full() {
            return first_row(&p, &self.modelview);
        }
        let p = tiles
            .grid
            .slant_beside(state.rectangles.viewport, &p, view, tiles.own());
        first_row(&p, &self.modelview)
    }

    fn uniforms(&self, views: &[ViewIndex], guard: &StateGuard) -> Uniforms {
        let grid = &self.tiles.grid;
        let mut rows: Vec<[f32; 4]> = views.iter().map(|&v| self.first_row(v)).collect();
        let place = |&view: &ViewIndex| {
            let (layer, x) = self.tiles.place(view);
            if self.discards {
                let [left, right] = guard.limits.map(|limit| x as f32 + limit as f32);
                return [guard.centre(x), 0.0, left, right];
            }
            [guard.centre(x), 0.0, layer as f32, 0.0]
        };
        let mut places: Vec<[f32; 4]> = views.iter().map(place).collect();
        // A geometry shader always makes a whole batch: surplus views are placed outside of the clip volume.
        rows.resize(self.size, OUTSIDE);
        places.resize(self.size, [4.0, 0.0, f32::from(u16::MAX), 0.0]);
        Uniforms {
            rows,
            tiles: places,
            map: [guard.scale, 1.0, 0.0, 0.0],
            clip: guard.clip,
            grid: [grid.across, 0.0, grid.shear, grid.up].map(|n| n as f32),
        }
    }
}

/// Whether primitives of a mode are exact with this target and this way of clipping.
///
/// # Errors
/// Why they are not.
pub(super) fn allow_target(key: &FixedKey, mode: u32, geometry: bool) -> Result<(), Reason> {
    // Without clip distances, other vertices of the draw are clipped than in the program's own draw, which changes the diagonal.
    if key.target.discards() && mode == c::QUADS && !key.flat {
        return Err(Reason::Replayed(Replayed::DiscardedQuads));
    }
    // After a cut the driver would take the colour of a flat triangle from another corner.
    let whole = match key.target.primitive {
        Primitive::Triangles => !key.flat,
        Primitive::Polygon => true,
        _ => false,
    };
    if geometry && key.target.cuts() && !whole {
        return Err(Reason::Replayed(Replayed::CutPrimitives));
    }
    Ok(())
}

/// P_i, for a shift.
pub(super) fn projection_of(
    state: &State,
    rig: &Rig,
    shear: Option<Shear>,
    view: ViewIndex,
) -> [f32; 16] {
    let p = state.matrices.projection;
    shear.map_or(p, |shear| shear.projection(&p, rig.position(view)))
}

/// A row of a projection that places everything outside of the clip volume. Layers that do not exist would not do: llvmpipe draws to the last one in their place.
pub(super) const OUTSIDE: [f32; 4] = [0.0, 0.0, 0.0, 1e30];

/// Row 0 of P · M, both column-major, summed in single precision in the order of Mesa's `matmul4`. The driver computes its own
/// product in this way, and equal bits give equal pixels.
pub(super) fn first_row(p: &[f32; 16], m: &[f32; 16]) -> [f32; 4] {
    [0, 4, 8, 12].map(|column: usize| {
        p[0] * m[column] + p[4] * m[column + 1] + p[8] * m[column + 2] + p[12] * m[column + 3]
    })
}

/// The input primitive of the geometry shader for a primitive mode of the program's, and the mode to draw with.
///
/// Smooth quads and quad strips are refused: the driver cuts a quad along one diagonal or the other, and a smooth colour
/// shows which. Measured on llvmpipe 22.3 (immediate mode and arrays alike): from 0 to 2 where no vertex of the draw is
/// outside the frustum, from 1 to 3 where one is. A geometry shader sees only one quad, so it cannot tell.
///
/// # Errors
/// The mode cannot be drawn by a geometry shader.
pub(super) fn primitive(mode: u32, flat: bool) -> Result<(Primitive, u32), Reason> {
    Ok(match mode {
        c::POINTS => (Primitive::Points, mode),
        c::LINES | c::LINE_STRIP | c::LINE_LOOP => (Primitive::Lines, mode),
        c::TRIANGLES | c::TRIANGLE_STRIP | c::TRIANGLE_FAN => (Primitive::Triangles, mode),
        c::POLYGON => (Primitive::Polygon, c::TRIANGLE_FAN),
        c::QUADS if flat => (Primitive::Quads, c::LINES_ADJACENCY),
        c::QUADS | c::QUAD_STRIP if !flat => {
            return Err(Reason::Replayed(Replayed::SmoothQuads));
        }
        c::QUAD_STRIP => return Err(Reason::Replayed(Replayed::FlatQuadStrips)),
        _ => return Err(Reason::Replayed(Replayed::Adjacency)),
    })
}
