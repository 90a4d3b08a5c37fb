//! One draw for many views, by instances or a geometry shader, with a generated vertex stage.
//!
//! Based on: Luo et al. (GBMVR) and de Sorbier et al. for the geometry shader; instances as in ANGLE's multiview emulation.

use super::fixed_state::{Driver, FixedState};
use super::fragment_state;
use super::pixel_size::{PixelSizeGuard, Units};
use super::replay::cut;
use crate::atlas::Atlas;
use crate::fixed::{
    self, Amplifier, Clip, FixedKey, FragmentKey, Limits, Patches, Primitive, Provoking, Tiles,
    Unsupported, generate, generate_fragment, sampler,
};
use crate::gl::{Gl, consts as c};
use crate::plan::{Method, Reason, Rig, Shear};
use crate::state::State;
use std::collections::HashMap;
use std::ffi::CString;

/// The uniforms of `fixed`'s shaders.
#[derive(Debug, Default, PartialEq)]
struct Uniforms {
    /// `mv_view`: row 0 of P_i · modelview.
    rows: Vec<[f32; 4]>,
    /// `mv_tile`.
    tiles: Vec<[f32; 4]>,
    /// `mv_map`.
    map: [f32; 4],
    /// `mv_clip`.
    clip: [f32; 4],
    /// `mv_grid`.
    grid: [f32; 4],
}

#[derive(Debug)]
pub(super) struct Program {
    name: u32,
    patches: Patches,
    views: i32,
    map: i32,
    clip: i32,
    tiles: i32,
    grid: i32,
    pub(super) window: i32,
    pub(super) disparity: i32,
    pub(super) levels: i32,
    /// What the uniforms hold.
    uploaded: Uniforms,
}

/// Canonical keys of a program: the vertex stage, and the fragment stage where that is generated as well.
pub(super) type Stages = (FixedKey, Option<FragmentKey>);

/// The generated programs of one context.
#[derive(Debug)]
pub struct Programs {
    /// What the driver can do.
    pub limits: Limits,
    pub(super) driver: Driver,
    clip: Clip,
    /// All uniforms are sent with each draw.
    resends: bool,
    pub(super) cache: HashMap<Stages, Option<Program>>,
    /// Programs compiled so far.
    pub compiled: u64,
}

/// A draw that an amplifier can make, decided.
#[derive(Clone, Copy, Debug)]
pub struct Amplified {
    stages: Stages,
    batch: u32,
    modelview: [f32; 16],
    /// The mode to draw with instead of the program's.
    pub mode: u32,
}

impl Programs {
    /// For a context. `clip` is for views that lie side by side; `resends`: uniforms that have their value are sent again.
    pub fn new(limits: Limits, driver: Driver, clip: Clip, resends: bool) -> Programs {
        Programs {
            limits,
            driver,
            clip,
            resends,
            cache: HashMap::new(),
            compiled: 0,
        }
    }

    /// Whether all views can be drawn with one viewport and one scissor.
    pub fn allow(state: &State, atlas: &Atlas) -> Result<(), Reason> {
        let (tiles, grid) = (&atlas.tiles, &atlas.tiles.grid);
        let apart = grid.step[1] != 0.0 || grid.step[0] != 0.0 && state.scissor_test;
        if apart || !grid.is_full() && tiles.columns > 1 {
            return Err(Reason::Kind(
                "draws to views whose tiles lie at other places of the window",
            ));
        }
        Ok(())
    }

    /// Whether and how a draw can be made by an amplifier; the program is compiled if it is new.
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
        let modelview = gl.get_floats::<16>(c::MODELVIEW_MATRIX);
        let (mut key, around) = fixed.for_mode(mode, &modelview, material);
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
            // One view, or a driver without layered framebuffers.
            return Err(Reason::Fixed(Unsupported::VertexLayer));
        }
        let batch = match method {
            Method::Geometry => {
                key.target.amplifier = Amplifier::GeometryInvocations;
                let mut batch = fixed::batch(&key, &self.limits);
                if batch == 0 {
                    key.target.amplifier = Amplifier::GeometryLoop;
                    batch = fixed::batch(&key, &self.limits);
                }
                // As few draws as possible, all of the same number of views where that divides evenly.
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
                fixed::batch(&key, &self.limits).max(1)
            }
        };
        // Disabled clip distances other vertices of the draw are clipped than the program's own, and so the cut is another.
        if key.target.discards() && mode == c::QUADS && !key.flat {
            return Err(Reason::Kind(
                "smooth quads under `--clip discard`, which the driver cuts along either diagonal,",
            ));
        }
        // Of a flat triangle's corners the driver would choose another one after a cut.
        let whole = match key.target.primitive {
            Primitive::Triangles => !key.flat,
            Primitive::Polygon => true,
            _ => false,
        };
        if geometry && key.target.cuts() && !whole {
            return Err(Reason::Kind(
                "points, lines, quads and flat triangles under `--clip cut`",
            ));
        }
        around.allow(&key).map_err(Reason::Fixed)?;
        // Measured on llvmpipe 22.3: widened after a geometry shader, they come out in shreds.
        let drawn = around.rasterised;
        let wide = |size: f32, smooth: bool| size != 1.0 || smooth;
        if geometry
            && (drawn.lines && wide(around.line_width, around.line_smooth)
                || drawn.points && wide(around.point_size, around.point_smooth))
        {
            return Err(Reason::Kind(
                "wide and smooth points and lines under `geometry`",
            ));
        }
        let fragment = if key.target.discards() || grid.is_sample_aligned() {
            let mut read = fragment_state::read(gl, self.driver, &key).map_err(Reason::Fixed)?;
            read.grid = grid.is_sample_aligned();
            // The driver's own stage does what needs no level of detail.
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

    /// The names of all programs.
    pub fn names(&self) -> impl Iterator<Item = u32> {
        self.cache.values().flatten().map(|p| p.name)
    }

    pub(super) fn compile(
        &mut self,
        gl: &Gl,
        key: &FixedKey,
        stages: &Stages,
    ) -> Result<(), Reason> {
        match self.cache.get(stages) {
            Some(Some(_)) => return Ok(()),
            Some(None) => return Err(Reason::Compile),
            None => {}
        }
        let shaders = generate(key, &self.limits).map_err(Reason::Fixed)?;
        let fragment = match &stages.1 {
            Some(key) => Some(generate_fragment(key, &self.limits).map_err(Reason::Fixed)?),
            None => None,
        };
        let build = || -> Result<u32, String> {
            let mut stages = vec![gl.compile(c::VERTEX_SHADER, &shaders.vertex)?];
            if let Some(g) = &shaders.geometry {
                stages.push(gl.compile(c::GEOMETRY_SHADER, g)?);
            }
            if let Some([control, evaluation]) = &shaders.tessellation {
                stages.push(gl.compile(c::TESS_CONTROL_SHADER, control)?);
                stages.push(gl.compile(c::TESS_EVALUATION_SHADER, evaluation)?);
            }
            if let Some(f) = &fragment {
                stages.push(gl.compile(c::FRAGMENT_SHADER, f)?);
            }
            gl.link(&stages)
        };
        let program = build().ok().map(|name| Program {
            name,
            patches: shaders.patches,
            views: gl.uniform_location(name, c"mv_view"),
            map: gl.uniform_location(name, c"mv_map"),
            clip: gl.uniform_location(name, c"mv_clip"),
            tiles: gl.uniform_location(name, c"mv_tile"),
            grid: gl.uniform_location(name, c"mv_grid"),
            window: gl.uniform_location(name, c"mv_window"),
            disparity: gl.uniform_location(name, c"mv_disparity"),
            levels: gl.uniform_location(name, c"mv_levels"),
            uploaded: Uniforms::default(),
        });
        if let (Some(program), Some(key)) = (&program, &stages.1) {
            name_units(gl, program.name, key);
        }
        self.compiled += 1;
        let ok = program.is_some();
        self.cache.insert(*stages, program);
        if ok { Ok(()) } else { Err(Reason::Compile) }
    }

    /// Makes the draw. `call` gets the number of views that one call is for: the instance count of an instanced draw.
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
        let around = StateGuard::enter(gl, state, atlas, key, program, units, fixed);
        let tiles = atlas.tiles;
        let layers = key.target.tiles == Tiles::Layer;
        let discards = key.target.discards();
        let modelview = how.modelview;
        let first_row_of = |view: u32| {
            let p = shear.map_or(state.projection, |s| {
                s.projection(&state.projection, rig.position(view))
            });
            if tiles.grid.is_full() {
                return first_row(&p, &modelview);
            }
            let p = tiles
                .grid
                .lean_beside(state.viewport, &p, view, tiles.own());
            first_row(&p, &modelview)
        };
        // Layers are chosen by the shader; a row of tiles is bound.
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
            let views = (per_row * row..end).map(|slot| tiles.slot(slot));
            let drawn: Vec<u32> = views.filter(|&view| tiles.draws(view)).collect();
            for views in drawn.chunks(how.batch as usize) {
                let mut rows: Vec<[f32; 4]> = views.iter().map(|&v| first_row_of(v)).collect();
                let mut places: Vec<[f32; 4]> = views
                    .iter()
                    .map(|&view| {
                        let (layer, x) = tiles.place(view);
                        if discards {
                            let [left, right] = around.limits.map(|limit| x as f32 + limit as f32);
                            return [around.centre(x), 0.0, left, right];
                        }
                        [around.centre(x), 0.0, layer as f32, 0.0]
                    })
                    .collect();
                // A geometry shader always makes a whole batch: what is too much lands in a place that shows nothing.
                rows.resize(how.batch as usize, [0.0; 4]);
                places.resize(how.batch as usize, [4.0, 0.0, f32::from(u16::MAX), 0.0]);
                if self.resends {
                    program.uploaded = Uniforms::default();
                }
                program.upload(
                    gl,
                    Uniforms {
                        rows,
                        tiles: places,
                        map: [around.scale, 1.0, 0.0, 0.0],
                        clip: around.clip,
                        grid: [tiles.grid.across, 0.0, tiles.grid.shear, tiles.grid.up]
                            .map(|n| n as f32),
                    },
                );
                call(views.len() as u32);
            }
        }
        around.leave(gl, state, atlas, fixed);
    }
}

/// Sets the samplers of a program to their units. The program in use is 0, as it is for all fixed function.
fn name_units(gl: &Gl, program: u32, key: &FragmentKey) {
    gl.use_program(program);
    for unit in key.sampled() {
        if let Ok(name) = CString::new(sampler(unit)) {
            gl.uniform_1i(gl.uniform_location(program, &name), unit as i32);
        }
    }
    if key.displaced {
        let map = gl.uniform_location(program, c"mv_distortion_map");
        gl.uniform_1i(map, super::reference::UNIT as i32);
    }
    gl.use_program(0);
}

/// Row 0 of P · M, both column-major, summed in single precision in the order of Mesa's `matmul4`: the driver makes its own
/// product so, and equal bits here make equal pixels.
fn first_row(p: &[f32; 16], m: &[f32; 16]) -> [f32; 4] {
    [0, 4, 8, 12].map(|column: usize| {
        p[0] * m[column] + p[4] * m[column + 1] + p[8] * m[column + 2] + p[12] * m[column + 3]
    })
}

impl Program {
    /// Sets the uniforms that are not set already. `mv_first` stays 0: each call's views begin at index 0.
    fn upload(&mut self, gl: &Gl, new: Uniforms) {
        if self.uploaded.rows != new.rows {
            gl.uniform_4fv(self.views, &new.rows);
        }
        if self.uploaded.tiles != new.tiles {
            gl.uniform_4fv(self.tiles, &new.tiles);
        }
        if self.uploaded.map != new.map {
            gl.uniform_4fv(self.map, &[new.map]);
        }
        if self.uploaded.clip != new.clip {
            gl.uniform_4fv(self.clip, &[new.clip]);
        }
        if self.uploaded.grid != new.grid {
            gl.uniform_4fv(self.grid, &[new.grid]);
        }
        self.uploaded = new;
    }
}

/// What a geometry shader is fed with for a mode, and the mode that does it.
///
/// Smooth quads and quad strips are not among them: the driver cuts a quad in two along one diagonal or the other, and a smooth
/// colour shows which. Measured on llvmpipe 22.3 (immediate mode and arrays alike): from 0 to 2 where no vertex of the draw is
/// outside the frustum, from 1 to 3 where one is, and a geometry shader sees one quad only.
fn primitive(mode: u32, flat: bool) -> Result<(Primitive, u32), Reason> {
    Ok(match mode {
        c::POINTS => (Primitive::Points, mode),
        c::LINES | c::LINE_STRIP | c::LINE_LOOP => (Primitive::Lines, mode),
        c::TRIANGLES | c::TRIANGLE_STRIP | c::TRIANGLE_FAN => (Primitive::Triangles, mode),
        c::POLYGON => (Primitive::Polygon, c::TRIANGLE_FAN),
        c::QUADS if flat => (Primitive::Quads, c::LINES_ADJACENCY),
        c::QUADS | c::QUAD_STRIP if !flat => {
            return Err(Reason::Kind(
                "smooth quads under `geometry`, which the driver cuts along either diagonal,",
            ));
        }
        c::QUAD_STRIP => return Err(Reason::Kind("flat quad strips under `geometry`")),
        _ => return Err(Reason::Kind("primitives with adjacency and patches")),
    })
}

/// State around an amplified draw.
pub(super) struct StateGuard {
    /// Width of the program's viewport over the atlas's.
    scale: f32,
    /// What may be drawn, in NDC of the program's viewport: left, right, bottom, top.
    clip: [f32; 4],
    /// The same left and right in pixels from the left edge of the tile.
    limits: [i32; 2],
    viewport: [i32; 4],
    width: f64,
    /// Viewport and scissor are not the program's.
    placed: bool,
    pixel_sizes: PixelSizeGuard,
    toggled: Vec<(u32, bool)>,
    /// The last-vertex convention was set where the program has the first.
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
        let patches = &program.patches;
        let beside = key.target.tiles == Tiles::ClipLeftRight;
        let width = f64::from(atlas.tiles.texture_width());
        let [vx, vy, vw, vh] = state.viewport;
        let mut clip = [-1.0, 1.0, -1.0, 1.0];
        let mut limits = [0; 2];
        if beside {
            // x: the viewport spans all tiles and clip distances cut at the tile and at the program's viewport and scissor.
            // y: viewport and scissor are the program's own.
            let tile = atlas.tiles.width as i32;
            let (mut left, mut right) = (vx.max(0), vx.saturating_add(vw).min(tile));
            let (mut bottom, mut height) = (0, atlas.tiles.height as i32);
            if state.scissor_test {
                let [sx, sy, sw, sh] = state.scissor;
                (left, right) = (left.max(sx), right.min(sx.saturating_add(sw)));
                (bottom, height) = (sy, sh);
            }
            limits = [left, right];
            let ndc = |x: i32| (f64::from(x - vx) * 2.0 / f64::from(vw.max(1)) - 1.0) as f32;
            clip[0] = if left == vx { -1.0 } else { ndc(left) };
            clip[1] = if right == vx.saturating_add(vw) {
                1.0
            } else {
                ndc(right)
            };
            gl.viewport(0, vy, atlas.tiles.texture_width() as i32, vh);
            if state.scissor_test {
                gl.scissor(0, bottom, atlas.tiles.texture_width() as i32, height);
            }
        }
        let grid = &atlas.tiles.grid;
        let pixel_sizes = PixelSizeGuard::enter(gl, state, grid, units);
        if !grid.is_full() {
            gl.viewport_f(grid.viewport(atlas.tiles.own(), 0, state.viewport));
            if state.scissor_test {
                let [x, y, w, h] = cut(state, &atlas.tiles, atlas.tiles.own(), 0);
                gl.scissor(x, y, w, h);
            }
        }
        gl.use_program(program.name);
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
        set(
            c::VERTEX_PROGRAM_TWO_SIDE,
            fixed.program_two_side,
            patches.two_side,
        );
        set(
            c::PROGRAM_POINT_SIZE,
            fixed.program_point_size,
            patches.point_size,
        );
        if key.target.amplifier != Amplifier::Instanced
            && !matches!(key.target.primitive, Primitive::Points | Primitive::Lines)
        {
            // Measured on llvmpipe 22.3: with smooth lines enabled, a geometry shader's triangles lose their colour.
            set(c::LINE_SMOOTH, fixed.surroundings.line_smooth, false);
            set(c::POINT_SMOOTH, fixed.surroundings.point_smooth, false);
        }
        for i in 0..8u32 {
            set(
                c::CLIP_DISTANCE0 + i,
                fixed.key.clip_planes >> i & 1 != 0,
                patches.clip_distances >> i & 1 != 0,
            );
        }
        let last = patches.last_vertex_convention && fixed.key.provoking == Provoking::First;
        if last {
            gl.provoking_vertex(c::LAST_VERTEX_CONVENTION);
        }
        StateGuard {
            scale: (f64::from(vw) / width) as f32,
            clip,
            limits,
            viewport: state.viewport,
            width,
            placed: beside || !grid.is_full(),
            pixel_sizes,
            toggled,
            last,
        }
    }

    /// Centre of the program's viewport inside the tile at x, in NDC of the atlas.
    fn centre(&self, x: u32) -> f32 {
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
        gl.use_program(0);
        self.pixel_sizes.leave(gl);
        if self.placed {
            let [x, y, w, h] = state.viewport;
            gl.viewport(x, y, w, h);
            if state.scissor_test {
                let [x, y, w, h] = state.scissor;
                gl.scissor(x, y, w, h);
            }
        }
        atlas.bind_row(gl, 0);
    }
}
