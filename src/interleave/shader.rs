//! The output passes of `shaders/*.wgsl`, validated and translated by naga to the GLSL of a program's context.
//!
//! The uniforms are a WGSL `var<immediate>`, which naga writes as plain uniforms (`glUniform*` by name), not as a block, so no
//! buffer and no indexed binding of the application's is touched. The translation flips nothing (no
//! `ADJUST_COORDINATE_SPACE`): the shaders are written for OpenGL's window space, y upwards.
#![forbid(unsafe_code)]

pub use super::pass::{Group, Pass, Points, SampleAligned, Samples, Step, Synthesis, Texels};
pub use super::uniforms::{MaskUniforms, Uniforms};
use crate::config::DisocclusionSource;
use naga::back::glsl;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use std::collections::HashMap;
use std::sync::{LazyLock, Mutex, PoisonError};

const COVER: &str = include_str!("../../shaders/cover.wgsl");
const COMMON: &str = include_str!("../../shaders/common.wgsl");
const ATLAS: &str = include_str!("../../shaders/atlas.wgsl");
const MASK: &str = include_str!("../../shaders/mask.wgsl");
const INTERLEAVE: &str = include_str!("../../shaders/interleave.wgsl");
const TEXELS: &str = include_str!("../../shaders/texels.wgsl");
const SAMPLE_ALIGNED: &str = include_str!("../../shaders/sample_aligned.wgsl");
const LAYOUT: &str = include_str!("../../shaders/layout.wgsl");
const ANAGLYPH: &str = include_str!("../../shaders/anaglyph.wgsl");
const RGBD: &str = include_str!("../../shaders/rgbd.wgsl");
const DISPARITY: &str = include_str!("../../shaders/disparity.wgsl");
const PYRAMID: &str = include_str!("../../shaders/pyramid.wgsl");
const VIEW: &str = include_str!("../../shaders/view.wgsl");
const PLAIN: &str = include_str!("../../shaders/plain.wgsl");
const BETWEEN: &str = include_str!("../../shaders/between.wgsl");
const REFERENCE: &str = include_str!("../../shaders/reference.wgsl");
const DISTORTION: &str = include_str!("../../shaders/distortion.wgsl");
const THROUGH: &str = include_str!("../../shaders/through.wgsl");
const THROUGH_REFERENCE: &str = include_str!("../../shaders/through_reference.wgsl");
const WALL: &str = include_str!("../../shaders/wall.wgsl");
const COPY: &str = include_str!("../../shaders/copy.wgsl");
const POINTS: &str = include_str!("../../shaders/points.wgsl");
const DEFERRED: &str = include_str!("../../shaders/deferred.wgsl");
const COMPOSE: &str = include_str!("../../shaders/compose.wgsl");
const SUBPIXELS: &str = include_str!("../../shaders/subpixels.wgsl");
const SAMPLES: &str = include_str!("../../shaders/samples.wgsl");
const ACCUMULATE: &str = include_str!("../../shaders/accumulate.wgsl");

/// Texture unit of the views: a 2D array texture.
pub const VIEWS_UNIT: u32 = 0;
/// Texture unit of the mask: RGBA8UI or RGBA16UI, NEAREST, row 0 on top.
pub const MASK_UNIT: u32 = 1;

/// Texture unit of the depths of the views: a 2D array texture.
pub const DEPTH_UNIT: u32 = 2;

/// Texture unit of the range of disparities that rays can meet: a 2D array texture; see `shaders/disparity.wgsl`.
pub const RAY_RANGE_UNIT: u32 = 3;
/// Texture unit of the disparity range of blocks: a 2D array texture.
pub const BLOCK_BOUNDS_UNIT: u32 = 4;
/// Texture unit of the views of samples: a 2D texture; see `shaders/samples.wgsl`.
pub const SEEN_UNIT: u32 = 3;
/// Texture units of the depth discontinuities of blocks, and of the blocks near them; see `shaders/distortion.wgsl`.
pub const STEPS_UNITS: [u32; 2] = [5, 6];
/// Texture units of the reference image of an occlusion camera: distortion map, colours, depths, and distortions of the samples in pixels.
pub const REFERENCE_UNITS: [u32; 4] = [5, 6, 7, 8];

/// Texture unit of the nodes of a wall: a 2D texture of floats; see `shaders/wall.wgsl`.
pub const WARP_UNIT: u32 = 9;

/// A shader stage of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// One triangle over the window, three vertices; of splats six vertices for each. No attributes.
    Vertex,
    /// The pass itself.
    Fragment,
}

/// The `#version` of a context.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GlslVersion {
    /// As GL_SHADING_LANGUAGE_VERSION × 100, such as 330.
    Desktop(u16),
    /// ES, such as 300.
    Embedded(u16),
}

impl GlslVersion {
    /// All versions that can be written.
    pub const SUPPORTED: [Self; 14] = [
        Self::Desktop(130),
        Self::Desktop(140),
        Self::Desktop(150),
        Self::Desktop(330),
        Self::Desktop(400),
        Self::Desktop(410),
        Self::Desktop(420),
        Self::Desktop(430),
        Self::Desktop(440),
        Self::Desktop(450),
        Self::Desktop(460),
        Self::Embedded(300),
        Self::Embedded(310),
        Self::Embedded(320),
    ];

    /// The newest supported version that is no newer than the context's. None below 130 and ES 300.
    pub fn for_context(self) -> Option<Self> {
        let rank = |version| match version {
            Self::Desktop(number) => (0, number),
            Self::Embedded(number) => (1, number),
        };
        let (family, newest) = rank(self);
        Self::SUPPORTED
            .into_iter()
            .filter(|&version| rank(version).0 == family && rank(version).1 <= newest)
            .max_by_key(|&version| rank(version).1)
    }
}

impl std::fmt::Display for GlslVersion {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Desktop(number) => write!(f, "GLSL {number}"),
            Self::Embedded(number) => write!(f, "GLSL ES {number}"),
        }
    }
}

/// A translated stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Translated {
    /// GLSL, beginning with `#version`.
    pub source: String,
    /// Sampler uniforms to be set with `glUniform1i`, sorted by unit.
    pub textures: Vec<TextureBinding>,
    /// Plain uniforms to be set with `glUniform1uiv`, `glUniform2uiv` or `glUniform4fv` from [`Uniforms::words`] and the like.
    pub uniforms: Vec<UniformSlot>,
}

/// A sampler of the shader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextureBinding {
    /// Name in the GLSL.
    pub name: String,
    /// One of the units of this module, such as [`VIEWS_UNIT`]; for the accumulation passes, the binding in `shaders/accumulate.wgsl`.
    pub unit: u32,
}

/// One uniform of the shader. One that the linker dropped has location -1, which OpenGL ignores.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UniformSlot {
    /// Name in the GLSL.
    pub name: String,
    /// First of its words.
    pub first: usize,
    /// 1 (uint), 2 (uvec2) or 4 (vec4 of floats).
    pub count: usize,
}

impl UniformSlot {
    /// The part of [`Uniforms::words`] that belongs to the uniform.
    pub fn of<'w>(&self, words: &'w [u32]) -> Option<&'w [u32]> {
        words.get(self.first..self.first.checked_add(self.count)?)
    }
}

/// Why a pass cannot be translated.
#[derive(Debug, thiserror::Error)]
pub enum ShaderError {
    /// The version is below what naga writes.
    #[error("{0} is too old for the output passes; they need GLSL 130 or GLSL ES 300")]
    Version(GlslVersion),
    /// The WGSL of the pass is wrong.
    #[error("the {pass:?} pass is not valid WGSL: {reason}")]
    Wgsl {
        /// The pass.
        pass: Pass,
        /// The text of naga's error.
        reason: String,
    },
    /// The version lacks a feature.
    #[error("the {pass:?} pass cannot be written as {version}: {reason}")]
    Glsl {
        /// The pass.
        pass: Pass,
        /// The version asked for.
        version: GlslVersion,
        /// The text of naga's error.
        reason: String,
    },
}

/// Stages of passes, by what they were translated from and to.
type Translations = HashMap<(Pass, Stage, GlslVersion), Translated>;

/// What was translated in this process. Its contexts mostly have the same version, and a translation takes milliseconds.
static TRANSLATED: LazyLock<Mutex<Translations>> = LazyLock::new(Mutex::default);

/// Translates one stage of a pass to GLSL. `version` is that of the context; the newest supported one up to it is written.
pub fn translate(
    pass: Pass,
    stage: Stage,
    version: GlslVersion,
) -> Result<Translated, ShaderError> {
    let version = version.for_context().ok_or(ShaderError::Version(version))?;
    let translated = || TRANSLATED.lock().unwrap_or_else(PoisonError::into_inner);
    let key = (pass, stage, version);
    if let Some(known) = translated().get(&key) {
        return Ok(known.clone());
    }
    let new = with_stack(|| translate_anew(pass, stage, version))?;
    translated().insert(key, new.clone());
    Ok(new)
}

/// Runs `work` in a thread with a stack of its own, where there can be one: naga needs much, and the program's thread may have little.
fn with_stack<R: Send>(work: impl Fn() -> R + Sync) -> R {
    const BYTES: usize = 1 << 21;
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(BYTES);
        let started = thread.spawn_scoped(scope, &work);
        match started.map(|thread| thread.join()) {
            Ok(Ok(done)) => done,
            Ok(Err(panic)) => std::panic::resume_unwind(panic),
            Err(_) => work(),
        }
    })
}

fn translate_anew(
    pass: Pass,
    stage: Stage,
    version: GlslVersion,
) -> Result<Translated, ShaderError> {
    let wgsl = |reason: String| ShaderError::Wgsl { pass, reason };
    let glsl_error = |e: glsl::Error| ShaderError::Glsl {
        pass,
        version,
        reason: e.to_string(),
    };
    let text = source(pass);
    let module = naga::front::wgsl::parse_str(&text).map_err(|e| wgsl(e.emit_to_string(&text)))?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::IMMEDIATES)
        .validate(&module)
        .map_err(|e| wgsl(e.emit_to_string(&text)))?;
    let options = glsl::Options {
        version: match version {
            // 140 is the oldest that naga writes; all that the passes use of it is in 130, too.
            GlslVersion::Desktop(number) => glsl::Version::Desktop(number.max(140)),
            GlslVersion::Embedded(number) => glsl::Version::new_gles(number),
        },
        writer_flags: glsl::WriterFlags::empty(),
        ..glsl::Options::default()
    };
    let (shader_stage, entry_point) = match stage {
        Stage::Vertex => (naga::ShaderStage::Vertex, vertex_entry(pass)),
        Stage::Fragment => (naga::ShaderStage::Fragment, entry(pass)),
    };
    let pipeline = glsl::PipelineOptions {
        shader_stage,
        entry_point: entry_point.into(),
        multiview: None,
    };
    let mut source = String::new();
    // All fetches lie inside their textures by construction, see common.wgsl.
    let bounds = naga::proc::BoundsCheckPolicies::default();
    let reflection = glsl::Writer::new(&mut source, &module, &info, &options, &pipeline, bounds)
        .map_err(glsl_error)?
        .write()
        .map_err(glsl_error)?;

    if let GlslVersion::Desktop(number @ 130..150) = version {
        // naga writes "core" here, but profiles begin with GLSL 150 and Mesa refuses the word before.
        let body = source.split_once('\n').map_or("", |(_, body)| body);
        source = format!("#version {number}\n{body}");
    }

    let mut textures: Vec<_> = reflection
        .texture_mapping
        .into_iter()
        .filter_map(|(name, mapping)| {
            let variable = module.global_variables.try_get(mapping.texture).ok()?;
            Some(TextureBinding {
                name,
                unit: variable.binding?.binding,
            })
        })
        .collect();
    textures.sort_by_key(|texture| texture.unit);
    let uniforms = reflection
        .immediates_items
        .into_iter()
        .map(|item| UniformSlot {
            name: item.access_path,
            first: item.offset as usize / 4,
            count: item.size_bytes as usize / 4,
        })
        .collect();
    Ok(Translated {
        source,
        textures,
        uniforms,
    })
}

/// The entry point of the vertex stage of a pass.
fn vertex_entry(pass: Pass) -> &'static str {
    match pass {
        Pass::Points(Points::Group(Group::Rays)) => "disk_corner",
        Pass::Points(Points::Group(Group::Parameters)) => "parameters_corner",
        Pass::Points(_) => "corner",
        _ => "cover",
    }
}

/// The entry point of a pass.
fn entry(pass: Pass) -> &'static str {
    match pass {
        Pass::Interleave => "interleave",
        Pass::Texels(Texels::Subpixels) => "subpixels",
        Pass::Texels(Texels::SubpixelsOfOneLayer) => "subpixels_of_one_layer",
        Pass::Texels(Texels::Pixels) => "pixels",
        Pass::SampleAligned(SampleAligned::Pixels) => "lens_pixels",
        Pass::SampleAligned(SampleAligned::Texels) => "lens_texels",
        Pass::Layout => "arrange",
        Pass::Whole => "whole",
        Pass::Anaglyph => "anaglyph",
        Pass::Rgbd => "rgbd",
        Pass::Wall => "wall",
        Pass::Copy => "copied",
        Pass::Accumulate(Step::Fill) => "fill",
        Pass::Accumulate(Step::Copy) => "copy",
        Pass::Accumulate(Step::Load) => "load",
        Pass::Accumulate(Step::Accumulate) => "accumulate",
        Pass::Accumulate(Step::Multiply) => "multiply",
        Pass::Accumulate(Step::Add) => "add",
        Pass::Accumulate(Step::Return) => "give_back",
        Pass::Subpixels => "join_subpixels",
        Pass::Points(Points::Subpixels) => "points_subpixels",
        Pass::Points(Points::Pixels) => "points_pixels",
        Pass::Points(Points::View) => "points_view",
        Pass::Points(Points::Group(Group::Subpixels)) => "deferred_subpixels",
        Pass::Points(Points::Group(Group::View)) => "deferred_view",
        Pass::Points(Points::Group(Group::Rays)) => "deferred_rays",
        Pass::Points(Points::Group(Group::Parameters)) => "deferred_parameters",
        Pass::Compose => "compose",
        Pass::Samples(Samples::Views) => "seen_views",
        Pass::Samples(Samples::Gather) => "gather",
        Pass::Samples(Samples::Scatter) => "scatter",
        Pass::Synthesis(Synthesis::BlockBounds) => "block_bounds",
        Pass::Synthesis(Synthesis::RowMaxima) => "row_maxima",
        Pass::Synthesis(Synthesis::RayRange) => "ray_range",
        Pass::Synthesis(Synthesis::Steps) => "steps",
        Pass::Synthesis(Synthesis::Splats) => "splats",
        Pass::Synthesis(Synthesis::DistortionMap) => "distortion_map",
        Pass::Synthesis(Synthesis::View(_)) => "view",
        Pass::Synthesis(REFERENCE_PANEL) => "panel_subpixels_reference",
        Pass::Synthesis(Synthesis::Panel { whole: false, .. }) => "panel_subpixels",
        Pass::Synthesis(Synthesis::Panel { whole: true, .. }) => "panel_pixels",
    }
}

/// The WGSL of a pass. WGSL has no includes, so the files are joined.
pub(super) fn source(pass: Pass) -> String {
    match pass {
        Pass::Interleave => [COVER, COMMON, ATLAS, MASK, INTERLEAVE].join("\n"),
        Pass::Texels(_) => [COVER, COMMON, ATLAS, MASK, TEXELS].join("\n"),
        Pass::SampleAligned(_) => [COVER, COMMON, ATLAS, MASK, SAMPLE_ALIGNED].join("\n"),
        Pass::Layout | Pass::Whole => [COVER, COMMON, ATLAS, LAYOUT].join("\n"),
        Pass::Anaglyph => [COVER, COMMON, ATLAS, ANAGLYPH].join("\n"),
        Pass::Rgbd => [COVER, COMMON, ATLAS, RGBD].join("\n"),
        Pass::Wall => [COVER, COMMON, ATLAS, MASK, WALL].join("\n"),
        Pass::Copy => [COVER, COPY].join("\n"),
        Pass::Accumulate(_) => [COVER, ACCUMULATE].join("\n"),
        Pass::Points(Points::Group(_)) => [POINTS, MASK, DEFERRED].join("\n"),
        Pass::Points(_) => [POINTS, MASK].join("\n"),
        Pass::Compose => [COVER, COMPOSE].join("\n"),
        Pass::Samples(_) => [COVER, SAMPLES, MASK].join("\n"),
        Pass::Subpixels => [COVER, SUBPIXELS].join("\n"),
        Pass::Synthesis(Synthesis::Steps | Synthesis::Splats | Synthesis::DistortionMap) => {
            [COVER, COMMON, ATLAS, DISPARITY, PLAIN, DISTORTION].join("\n")
        }
        Pass::Synthesis(REFERENCE_PANEL) => [
            COVER,
            COMMON,
            ATLAS,
            MASK,
            DISPARITY,
            REFERENCE,
            THROUGH_REFERENCE,
        ]
        .join("\n"),
        Pass::Synthesis(Synthesis::Panel { source, .. }) => [
            COVER,
            COMMON,
            ATLAS,
            MASK,
            DISPARITY,
            disocclusion_wgsl(source),
            THROUGH,
        ]
        .join("\n"),
        Pass::Synthesis(Synthesis::View(source)) => [
            COVER,
            COMMON,
            ATLAS,
            DISPARITY,
            disocclusion_wgsl(source),
            VIEW,
        ]
        .join("\n"),
        Pass::Synthesis(Synthesis::BlockBounds | Synthesis::RowMaxima | Synthesis::RayRange) => {
            [COVER, COMMON, ATLAS, DISPARITY, PLAIN, PYRAMID].join("\n")
        }
    }
}

/// The panel's picture whose subpixels ask the reference image one after another.
const REFERENCE_PANEL: Synthesis = Synthesis::panel(false, DisocclusionSource::Reference);

/// The functions that see disocclusions, by their source.
fn disocclusion_wgsl(source: DisocclusionSource) -> &'static str {
    match source {
        DisocclusionSource::Nothing => PLAIN,
        DisocclusionSource::Reference => REFERENCE,
        DisocclusionSource::Views => BETWEEN,
    }
}
