//! Program variants: a variant draws the views in place of one of the program's own GLSL programs, and is linked from rewritten shaders.
//! The program's own object stays as it is and answers all queries of the program.

use super::point_locations::PointLocations;
use crate::gl::{Active, Gl, ProgramName, ShaderName, consts as c};
use crate::plan::{Along, Flat, Shear};
use crate::rewrite::{
    Amplifier, Names, Options, PointsTo, Refusal, Stage, Target, Uniform, VertexLayer, facts,
    points, rewrite,
};
use crate::state::ShaderSource;
use std::borrow::Cow;
use std::ffi::{CStr, CString};
use std::sync::Arc;

/// How a variant draws the views.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariantKind {
    /// One at a time, to the bound framebuffer and viewport.
    Alone,
    /// One at a time, to a layer that the shader chooses.
    Layer(VertexLayer),
    /// All at once, up to so many: an instance for each view, to the layer of that view.
    Instances(VertexLayer, u32),
    /// In the reference image of an occlusion camera, by distorted rays; also for vertices that the projection matrix of fixed function places.
    DistortedRays,
}

/// How the draws of a program get their views.
#[derive(Debug)]
pub enum Drawn {
    /// The projection matrix of fixed function places its vertices; the layer loads P_i there.
    ByMatrix,
    /// A variant shifts its vertices.
    ByVariant(Arc<Variant>),
}

/// Why a program has no variant. Its draws are then the same in all views.
#[derive(Debug, thiserror::Error)]
pub enum NoVariant {
    /// A source cannot be rewritten.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// There is no source: a binary, SPIR-V, or a program that was linked before the layer saw it.
    #[error("the source of its shaders is not known")]
    NoSource,
    /// Subroutines are context state that the layer does not track.
    #[error("it has subroutines")]
    Subroutines,
    /// It is a compute program, which draws nothing.
    #[error("it is a compute program")]
    Computes,
    /// There is no vertex stage in which vertices could be shifted.
    #[error("it has no vertex shader")]
    NoVertex,
    /// Rays can be distorted in a vertex shader only, and a later stage places the vertices.
    #[error("its vertices are placed after the vertex stage")]
    Stages,
    /// Fixed function makes the colours.
    #[error("it has no fragment shader")]
    NoFragment,
    /// Its shaders have side effects, which a further draw would repeat.
    #[error("it writes to images, buffers or counters")]
    Effects,
    /// There is no free location for another output, or it cannot be found.
    #[error("the outputs of its fragment shader are several, or not known")]
    Outputs,
    /// No name for a variable between the stages is free in both.
    #[error("its shaders have names that clash with the layer's")]
    Names,
    /// The driver refuses the rewritten shaders, with this log.
    #[error("the driver refused the rewritten shaders: {0}")]
    Driver(String),
}

/// A linked variant, with the locations of the layer's uniforms; -1 where it has none.
#[derive(Debug)]
pub struct Variant {
    name: ProgramName,
    shift: i32,
    tile: i32,
    views: i32,
    across: i32,
    up: i32,
    /// The uniforms of distorted rays: the distortion map, the place of its texels, disparities.
    distortion: [i32; 3],
    /// The program's uniforms: type, location in the program, location in the variant; one entry for each element of an array.
    uniforms: Vec<(u32, i32, i32)>,
    /// Its vertices lie at the far end of the depths, as those of a sky do.
    far_end: bool,
    /// By index of a uniform block in the program: its index in the variant.
    blocks: Vec<Option<u32>>,
    /// The same of storage blocks.
    storage: Vec<Option<u32>>,
    points: PointLocations,
}

/// Finds how the draws of a program get their views, and links its variant where it needs one. `sources` are the sources that the program was
/// linked from. Leaves the program's state as it is.
///
/// # Errors
/// Why there is no variant.
pub fn drawn(
    gl: &Gl,
    program: ProgramName,
    sources: &[ShaderSource],
    kind: VariantKind,
) -> Result<Drawn, NoVariant> {
    let last = last_stage(sources)?;
    let (amplifier, target, views) = match kind {
        VariantKind::Alone => (Amplifier::Replay, Target::Whole, 1),
        VariantKind::Layer(by) => (Amplifier::Replay, Target::Layer(by), 1),
        VariantKind::Instances(by, views) => (Amplifier::Instanced, Target::Layer(by), views),
        VariantKind::DistortedRays => (Amplifier::Replay, Target::DistortedRays, 1),
    };
    let distorts = kind == VariantKind::DistortedRays;
    if distorts && last != Stage::Vertex {
        return Err(NoVariant::Stages);
    }
    let options = Options {
        amplifier,
        target,
        views,
        es: gl.is_es(),
    };
    let mut rewritten = Rewritten::of(sources, last, &options)?;
    if rewritten.projection && !distorts {
        return Ok(Drawn::ByMatrix);
    }
    let shift = rewritten.shift.take().ok_or(NoVariant::NoVertex)?;
    let mut outputs = outputs(gl, program);
    if distorts {
        rewritten.add_displacement(gl, &shift, &mut outputs)?;
    }
    let variant = rewritten.link(gl, program, &outputs, None, &shift)?;
    Ok(Drawn::ByVariant(Arc::new(variant)))
}

/// Links the variant of a program that draws points for all views at once (see [`crate::rewrite::points`]); `to`: where. `compatibility`: of the context's profile.
///
/// # Errors
/// Why there is no such variant.
pub fn point_variant(
    gl: &Gl,
    program: ProgramName,
    sources: &[ShaderSource],
    to: PointsTo,
    compatibility: bool,
) -> Result<Variant, NoVariant> {
    last_stage(sources)?;
    let of = |stage: Stage| sources.iter().find(|shader| shader.stage == stage);
    let [Some(vertex), Some(fragment)] = [of(Stage::Vertex), of(Stage::Fragment)] else {
        return Err(NoVariant::NoFragment);
    };
    if sources.len() > 2 {
        return Err(NoVariant::Stages);
    }
    let new = points(&vertex.source, &fragment.source, to, compatibility)?;
    let rewritten = Rewritten {
        sources: vec![
            (vertex.kind, vertex.source.as_slice().into()),
            (c::GEOMETRY_SHADER, new.geometry.as_bytes().into()),
            (fragment.kind, new.fragment.into()),
        ],
        ..Rewritten::default()
    };
    rewritten.link(gl, program, &outputs(gl, program), None, &new.names)
}

/// Links a program that draws as the program's own does, and writes an output of its vertex shader by transform feedback.
///
/// # Errors
/// Why there is none.
pub fn writing_variant(
    gl: &Gl,
    program: ProgramName,
    sources: &[ShaderSource],
    output: &CStr,
) -> Result<Variant, NoVariant> {
    if last_stage(sources)? != Stage::Vertex {
        return Err(NoVariant::Stages);
    }
    let mut rewritten = Rewritten::default();
    for shader in sources {
        if !facts(&shader.source, gl.is_es())?.writes.is_empty() {
            return Err(NoVariant::Effects);
        }
        let text = shader.source.as_slice().into();
        rewritten.sources.push((shader.kind, text));
    }
    let names = Names::default();
    rewritten.link(gl, program, &outputs(gl, program), Some(output), &names)
}

/// The last stage that writes positions of vertices.
fn last_stage(sources: &[ShaderSource]) -> Result<Stage, NoVariant> {
    if sources.is_empty() || sources.iter().any(|shader| shader.source.is_empty()) {
        return Err(NoVariant::NoSource);
    }
    if sources.iter().any(|shader| shader.stage == Stage::Compute) {
        return Err(NoVariant::Computes);
    }
    let rank = |stage: Stage| match stage {
        Stage::Vertex => 1,
        Stage::TessEvaluation => 2,
        Stage::Geometry => 3,
        _ => 0,
    };
    let stages = sources.iter().map(|shader| shader.stage);
    stages
        .max_by_key(|&stage| rank(stage))
        .filter(|&stage| rank(stage) > 0)
        .ok_or(NoVariant::NoVertex)
}

/// The rewritten sources of a program's shaders.
#[derive(Default)]
struct Rewritten<'a> {
    /// The sources, each with the kind of its shader.
    sources: Vec<(u32, Cow<'a, [u8]>)>,
    /// The projection matrix of fixed function places the vertices.
    projection: bool,
    /// The layer's names in the stage that shifts vertices, and in the fragment stage, if that reads window coordinates.
    shift: Option<Names>,
    window: Option<Names>,
    /// The vertices lie at the far end of the depths.
    far_end: bool,
    /// The fragment stage writes built-in outputs, such as gl_FragColor.
    built_in: bool,
}

impl<'a> Rewritten<'a> {
    fn of(sources: &'a [ShaderSource], last: Stage, options: &Options) -> Result<Self, NoVariant> {
        // Each view would write to memory.
        let repeats =
            options.target == Target::DistortedRays || options.amplifier == Amplifier::Instanced;
        let mut all = Rewritten::default();
        for shader in sources {
            if shader.stage != last && shader.stage != Stage::Fragment {
                let facts = facts(&shader.source, options.es)?;
                if facts.subroutines {
                    return Err(NoVariant::Subroutines);
                }
                if repeats && !facts.writes.is_empty() {
                    return Err(NoVariant::Effects);
                }
                all.projection |= facts.projection;
                all.sources
                    .push((shader.kind, shader.source.as_slice().into()));
                continue;
            }
            let new = rewrite(&shader.source, shader.stage, options)?;
            if new.facts.subroutines {
                return Err(NoVariant::Subroutines);
            }
            if repeats && !new.facts.writes.is_empty() {
                return Err(NoVariant::Effects);
            }
            let changed = matches!(new.text, Cow::Owned(_));
            if shader.stage == Stage::Fragment {
                all.built_in |= new.facts.writes_built_in();
                all.window = changed.then_some(new.names).or(all.window);
            } else {
                all.projection |= new.facts.projection;
                all.far_end = new.facts.far_end;
                all.shift = changed.then_some(new.names).or(all.shift);
            }
            all.sources.push((shader.kind, new.text));
        }
        Ok(all)
    }

    /// Adds the displacement of samples as a further output at location 1, and the function that distorts rays as a further vertex shader.
    fn add_displacement(
        &mut self,
        gl: &Gl,
        shift: &Names,
        outputs: &mut Vec<(CString, u32)>,
    ) -> Result<(), NoVariant> {
        let window = self.window.as_ref().ok_or(NoVariant::NoFragment)?;
        if window != shift {
            return Err(NoVariant::Names);
        }
        let one = outputs.len() <= 1 && outputs.iter().all(|(_, at)| *at == 0);
        let free = self.built_in || one && gl.tells_outputs();
        if !free {
            return Err(NoVariant::Outputs);
        }
        outputs.push((
            CString::new(window.displacement_output()).unwrap_or_default(),
            1,
        ));
        let distortion = shift.ray_distortion().into_bytes();
        self.sources.push((c::VERTEX_SHADER, distortion.into()));
        Ok(())
    }

    fn compile(&self, gl: &Gl) -> Result<Vec<ShaderName>, NoVariant> {
        let mut shaders = Vec::with_capacity(self.sources.len());
        for (kind, source) in &self.sources {
            match gl.compile(*kind, source) {
                Ok(shader) => shaders.push(shader),
                Err(log) => {
                    shaders
                        .into_iter()
                        .for_each(|shader| gl.delete_shader(shader));
                    return Err(NoVariant::Driver(log));
                }
            }
        }
        Ok(shaders)
    }

    /// Links the sources with the attributes of `program` where it has them, and its fragment outputs at `outputs`. `written`: an output of the vertex shader that transform feedback writes.
    fn link(
        &self,
        gl: &Gl,
        program: ProgramName,
        outputs: &[(CString, u32)],
        written: Option<&CStr>,
        names: &Names,
    ) -> Result<Variant, NoVariant> {
        let shaders = self.compile(gl)?;
        let attributes = locations(gl.active_attributes(program), |name| {
            gl.attribute_location(program, name)
        });
        let name = gl
            .link_at(&shaders, &attributes, outputs, written)
            .map_err(NoVariant::Driver)?;
        Ok(Variant::of(gl, program, name, names, self))
    }
}

fn locations(actives: Vec<Active>, location: impl Fn(&CStr) -> i32) -> Vec<(CString, u32)> {
    let place = |active: Active| {
        let at = u32::try_from(location(&active.name)).ok()?;
        Some((active.name, at))
    };
    actives.into_iter().filter_map(place).collect()
}

/// By index of a storage block in a program: its index in the variant.
fn same_storage_blocks(gl: &Gl, program: ProgramName, variant: ProgramName) -> Vec<Option<u32>> {
    // OpenGL ES has no command for it: the source alone says where a block is bound.
    if gl.is_es() || !gl.tells_storage_blocks() {
        return Vec::new();
    }
    let [from, to] = [program, variant].map(|of| gl.storage_blocks(of));
    let same = |name: &String| to.iter().position(|other| other == name);
    let all = from.iter().map(|name| same(name).map(|at| at as u32));
    all.collect()
}

/// The outputs that a program's fragment shader declares, with their locations. NVIDIA's driver tells of built-in ones too, which no program
/// may bind.
fn outputs(gl: &Gl, program: ProgramName) -> Vec<(CString, u32)> {
    let names = gl.program_outputs(program).into_iter();
    let names = names.filter(|name| !name.as_bytes().starts_with(b"gl_"));
    let place = |name: CString| {
        let at = u32::try_from(gl.output_location(program, &name)).ok()?;
        Some((name, at))
    };
    names.filter_map(place).collect()
}

impl Variant {
    fn of(
        gl: &Gl,
        program: ProgramName,
        name: ProgramName,
        shift: &Names,
        rewritten: &Rewritten,
    ) -> Variant {
        let ours = |names: &Names, uniform| {
            let uniform = CString::new(names.uniform(uniform)).unwrap_or_default();
            gl.uniform_location(name, &uniform)
        };
        let window = |uniform| {
            rewritten
                .window
                .as_ref()
                .map_or(-1, |names| ours(names, uniform))
        };
        let mut uniforms = Vec::new();
        for active in gl.active_uniforms(program) {
            let left = (1..=active.size.max(1) as u32).rev();
            for (element, left) in active.elements().zip(left) {
                let [from, to] = [program, name].map(|of| gl.uniform_location(of, &element));
                if from >= 0 {
                    gl.keep_uniform(program, from, active.kind, left);
                }
                if from >= 0 && to >= 0 {
                    uniforms.push((active.kind, from, to));
                }
            }
        }
        let blocks = gl.block_bindings(program).len() as u32;
        Variant {
            name,
            far_end: rewritten.far_end,
            shift: ours(shift, Uniform::Shift),
            tile: ours(shift, Uniform::Tile),
            views: ours(shift, Uniform::Views),
            across: window(Uniform::Across),
            up: window(Uniform::Up),
            distortion: [Uniform::DistortionMap, Uniform::Window, Uniform::Disparity]
                .map(|uniform| ours(shift, uniform)),
            uniforms,
            blocks: (0..blocks)
                .map(|at| gl.same_block(program, at, name))
                .collect(),
            storage: same_storage_blocks(gl, program, name),
            points: PointLocations::of(gl, name, &shift.prefix()),
        }
    }

    /// The program object of the variant.
    pub fn name(&self) -> ProgramName {
        self.name
    }

    /// The locations of the uniforms of a variant from [`point_variant`].
    pub(super) fn point_locations(&self) -> PointLocations {
        self.points
    }

    /// Sets how points are surfaces (see [`crate::fixed::surface_size`]); the variant is in use.
    pub fn set_sizes(&self, gl: &Gl, sizes: [f32; 4]) {
        gl.uniform_4fv(self.points.surface, &[sizes]);
    }

    /// Copies the values of the program's uniforms and block bindings to the variant, which has to be in use: of uniforms those that may have
    /// changed since an earlier call, which has returned `since` (0 for the first).
    pub fn copy_uniforms(&self, gl: &Gl, program: ProgramName, since: u64) -> u64 {
        // A change by another thread meanwhile is copied by the next call.
        let now = gl.uniform_changes(program) + 1;
        for &(kind, from, to) in &self.uniforms {
            if since == 0 || !gl.is_uniform_unchanged(program, from, since - 1) {
                gl.copy_uniform(kind, (program, from), to);
            }
        }
        let bindings = gl.block_bindings(program);
        for (binding, block) in bindings.into_iter().zip(&self.blocks) {
            if let Some(block) = *block {
                gl.uniform_block_binding(self.name, block, binding);
            }
        }
        if !self.storage.is_empty() {
            let bindings = gl.storage_bindings(program);
            for (binding, block) in bindings.into_iter().zip(&self.storage) {
                if let Some(block) = *block {
                    gl.storage_block_binding(self.name, block, binding);
                }
            }
        }
        now
    }

    /// Sets a matrix, by its location in the program; the variant has to be in use.
    pub fn set_matrix(&self, gl: &Gl, location: i32, m: &[f32; 16]) {
        let found = self.uniforms.iter().find(|(_, from, _)| *from == location);
        if let Some((_, _, to)) = found {
            gl.set_uniform_matrix(*to, m);
        }
    }

    /// Sets the layers of the views that are drawn next; the variant has to be in use and of a kind that chooses layers.
    pub fn set_layers(&self, gl: &Gl, layers: &[u32]) {
        let tiles: Vec<_> = layers.iter().map(|&l| [0.0, 0.0, l as f32, 0.0]).collect();
        gl.uniform_4fv(self.tile, &tiles);
        if self.views >= 0 {
            gl.uniform_1i(self.views, layers.len() as i32);
        }
    }

    /// Whether the program's vertices lie at the far end of the depths.
    pub fn is_at_far_end(&self) -> bool {
        self.far_end
    }

    /// Sets the distortion of rays: the texture unit of the map, the place of its texels, disparities. The variant has to be in use and of the
    /// kind [`VariantKind::DistortedRays`].
    pub(super) fn set_distortion(&self, gl: &Gl, unit: u32, [window, disparities]: [[f32; 4]; 2]) {
        let [at_map, at_window, at_disparity] = self.distortion;
        gl.uniform_1i(at_map, unit as i32);
        gl.uniform_4fv(at_window, &[window]);
        gl.uniform_4fv(at_disparity, &[disparities]);
    }

    /// Sets the shifts of the views that are drawn next; the variant has to be in use. `shear` is the shift of the scene, `flat` that of
    /// vertices with a w of 1; `places` are the positions of the views (see [`crate::plan::Rig::position`]); `stride`: pixels from tile to tile.
    pub fn set_views(
        &self,
        gl: &Gl,
        (shear, flat): (Option<Shear>, Flat),
        places: &[f64],
        stride: u32,
    ) {
        let shift = |&place: &f64| {
            let sep = |shear: &Shear| shear.separation(place);
            let scene = shear.map_or((0.0, 0.0), |s| (sep(&s), sep(&s) * s.conv));
            if shear.is_some_and(|shear| shear.along == Along::Z) {
                return [scene.0 as f32, scene.1 as f32, 0.0, 2.0];
            }
            // The last number: corners of the screen stay.
            let (flat, corners) = match flat {
                Flat::Still => (0.0, 0.0),
                Flat::By(shear) => (sep(&shear), 0.0),
                Flat::Scene => (scene.0 - scene.1, 1.0),
            };
            [scene.0 as f32, scene.1 as f32, flat as f32, corners]
        };
        let shifts: Vec<_> = places.iter().map(shift).collect();
        gl.uniform_4fv(self.shift, &shifts);
        if self.across >= 0 {
            gl.uniform_4fv(self.across, &[[1.0, 0.0, stride as f32, 0.0]]);
            gl.uniform_4fv(self.up, &[[0.0, 1.0, 0.0, 0.0]]);
        }
    }
}
