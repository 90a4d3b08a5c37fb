//! The generated programs of a context, compiled when a draw first needs them.

use super::fixed_state::Driver;
use super::point_locations::PointLocations;
use crate::fixed::{
    Clip, FixedKey, FragmentKey, Limits, Patches, generate, generate_fragment, sampler,
};
use crate::gl::{Gl, ProgramName, consts as c};
use crate::plan::Reason;
use std::collections::HashMap;
use std::ffi::CString;

/// The texture unit of the distortion map: the last one that all drivers with OpenGL 3.0 have. Where a program's own shaders use it, the
/// last unit that they do not use takes its place.
pub(super) const DISTORTION_UNIT: u32 = 31;

/// The uniforms of the shaders that [`crate::fixed`] generates.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Uniforms {
    /// `mv_view`: row 0 of P_i · modelview.
    pub(super) rows: Vec<[f32; 4]>,
    /// `mv_tile`.
    pub(super) tiles: Vec<[f32; 4]>,
    /// `mv_map`.
    pub(super) map: [f32; 4],
    /// `mv_clip`.
    pub(super) clip: [f32; 4],
    /// `mv_grid`.
    pub(super) grid: [f32; 4],
}

/// A generated program and the locations of its uniforms.
#[derive(Debug)]
pub(super) struct Program {
    pub(super) name: ProgramName,
    pub(super) patches: Patches,
    views: i32,
    map: i32,
    clip: i32,
    tiles: i32,
    grid: i32,
    pub(super) window: i32,
    pub(super) disparity: i32,
    pub(super) levels: i32,
    pub(super) points: PointLocations,
    /// The present values of the uniforms.
    pub(super) uploaded: Uniforms,
}

/// Canonical keys of a program: that of the vertex stage, and that of the fragment stage if that is generated as well.
pub(super) type Stages = (FixedKey, Option<FragmentKey>);

/// The generated programs of one context.
#[derive(Debug)]
pub struct Programs {
    /// Limits of the driver.
    pub limits: Limits,
    pub(super) driver: Driver,
    pub(super) clip: Clip,
    /// All uniforms are sent with each draw, even if they have not changed.
    pub(super) resends: bool,
    pub(super) cache: HashMap<Stages, Option<Program>>,
    /// Programs compiled so far.
    pub compiled: u64,
    errors: Vec<u32>,
}

impl Programs {
    /// For a context. `clip`: how tiles beside each other are clipped; `resends`: uniforms that have not changed are sent again.
    pub fn new(limits: Limits, driver: Driver, clip: Clip, resends: bool) -> Programs {
        Programs {
            limits,
            driver,
            clip,
            resends,
            cache: HashMap::new(),
            compiled: 0,
            errors: Vec::new(),
        }
    }

    /// Takes the program's errors that were found before programs were compiled, oldest first.
    #[must_use]
    pub fn take_errors(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.errors)
    }

    /// The names of all programs.
    pub fn names(&self) -> impl Iterator<Item = ProgramName> {
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
        self.errors.extend(gl.take_errors());
        let build = || -> Result<ProgramName, String> {
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
            points: PointLocations::of(gl, name, "mv_"),
            uploaded: Uniforms::default(),
        });
        if let (Some(program), Some(key)) = (&program, &stages.1) {
            name_units(gl, program.name, key);
        }
        // Those of a driver that compiles none.
        gl.drop_errors();
        self.compiled += 1;
        let ok = program.is_some();
        self.cache.insert(*stages, program);
        if ok { Ok(()) } else { Err(Reason::Compile) }
    }
}

/// Sets the samplers of a program to their units. Leaves program 0 in use, as it is for all fixed function.
fn name_units(gl: &Gl, program: ProgramName, key: &FragmentKey) {
    gl.use_program(program);
    for unit in key.sampled() {
        if let Ok(name) = CString::new(sampler(unit)) {
            gl.uniform_1i(gl.uniform_location(program, &name), unit as i32);
        }
    }
    if key.displaced {
        let map = gl.uniform_location(program, c"mv_distortion_map");
        gl.uniform_1i(map, DISTORTION_UNIT as i32);
    }
    gl.use_program(ProgramName::ZERO);
}

impl Program {
    pub(super) fn views_location(&self) -> i32 {
        self.views
    }

    /// Sets the uniforms that have changed. `mv_first` stays 0: the views of each call begin at index 0.
    pub(super) fn upload(&mut self, gl: &Gl, new: Uniforms) {
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
