//! Why a draw cannot go through a generated shader. The caller falls back to replay and counts the reason.

use super::key::{Amplifier, Dialect, FixedKey, PointSize, Primitive, Tiles, UNITS};

/// A reason for the report, which counts draws by the message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, thiserror::Error)]
pub enum Unsupported {
    /// The driver lacks `#version 150 compatibility`, or the version that the amplifier needs.
    #[error("the driver's shading language is {has}, generated shaders need {needed}")]
    ShadingLanguage {
        /// Version that the shaders need.
        needed: u32,
        /// Version that the driver has.
        has: u32,
    },
    /// No extension for `gl_Layer` in a vertex shader.
    #[error("the driver cannot choose a layer in a vertex shader")]
    VertexLayer,
    /// No geometry shader invocations.
    #[error("the driver has no geometry shader invocations")]
    Invocations,
    /// The tile's own clip distances and the program's clip planes are too many.
    #[error("{needed} clip distances are needed, the driver has {limit}")]
    ClipDistances {
        /// Ours and the program's.
        needed: u32,
        /// `GL_MAX_CLIP_DISTANCES`.
        limit: u32,
    },
    /// More varyings than the driver passes between stages.
    #[error("{needed} components per vertex are needed, the driver has {limit}")]
    Components {
        /// Scalars per vertex.
        needed: u32,
        /// The limit that is exceeded.
        limit: u32,
    },
    /// One draw cannot draw that many views; [`batch`](super::batch) is the largest number.
    #[error("{views} views in one draw, the driver can make {limit}")]
    Views {
        /// Asked for.
        views: u32,
        /// Possible.
        limit: u32,
    },
    /// The driver deviates from the specification in a way that is not imitated.
    #[error("the driver lights this material in its own way")]
    DriverQuirk,
    /// `glRenderMode` is not `GL_RENDER`: hits and feedback are those of the program's own view.
    #[error("selection or feedback mode")]
    RenderMode,
    /// Colour-index mode (geometry shaders are undefined, vertex shaders write RGBA).
    #[error("colour-index mode")]
    IndexMode,
    /// Transform feedback would record every view.
    #[error("transform feedback is active")]
    TransformFeedback,
    /// `GL_VERTEX_PROGRAM_ARB` is enabled with a valid program.
    #[error("an assembly vertex program is bound")]
    VertexProgram,
    /// Vertex blending, weights, or another extension of the vertex stage.
    #[error("an extension of the vertex stage is enabled")]
    VertexExtension,
    /// A texture unit beyond those with coordinates in the shader is enabled.
    #[error("a texture unit above {} is enabled", UNITS - 1)]
    TextureUnit,
    /// A depth or integer texture, which the generated fragment stage does not sample.
    #[error("a texture is neither colour nor luminance")]
    TextureFormat,
    /// An environment of another extension, or one that the specification leaves undefined: a decal whose texture is not RGB or
    /// RGBA, or a combination that reads the texture of a unit without one.
    #[error("a texture environment is not one of OpenGL 1.5, or undefined for its textures")]
    TextureEnvironment,
    /// A sampler object is bound, whose filters the generated fragment stage does not use.
    #[error("a sampler object is bound")]
    SamplerObject,
    /// `glMaterial` between `glBegin` and `glEnd`: built-in uniforms hold one material per draw.
    #[error("the material changes inside a primitive")]
    MaterialPerVertex,
    /// `glPolygonMode` other than fill with a quad or a polygon in the geometry shader: inner edges would show.
    #[error("polygon mode is not fill, and the primitive is cut into triangles")]
    PolygonMode,
    /// Edge flags do not pass through a geometry shader (`ARB_geometry_shader4`, issue 9).
    #[error("edge flags with a geometry shader")]
    EdgeFlags,
    /// The stipple pattern restarts with each line that a geometry shader emits.
    #[error("line stipple with a geometry shader")]
    LineStipple,
    /// Clip distances cut a point by its centre, so half of it leaks into the next tile.
    #[error("points larger than a pixel in clipped tiles")]
    WidePoints,
    /// Likewise for lines: they are widened after clipping.
    #[error("lines wider than a pixel in clipped tiles")]
    WideLines,
    /// Antialiased points, lines or polygon edges spread beyond the tile's edge.
    #[error("smooth or multisampled points or lines, or smooth polygons, in clipped tiles")]
    Smooth,
    /// `GL_POINT_FADE_THRESHOLD_SIZE` fades small multisampled points in fixed function only.
    #[error("multisampled points that fade")]
    PointFade,
}

impl Unsupported {
    /// One word for counters and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Unsupported::ShadingLanguage { .. } => "shading-language",
            Unsupported::VertexLayer => "vertex-layer",
            Unsupported::Invocations => "invocations",
            Unsupported::ClipDistances { .. } => "clip-distances",
            Unsupported::Components { .. } => "components",
            Unsupported::Views { .. } => "views",
            Unsupported::DriverQuirk => "driver-quirk",
            Unsupported::RenderMode => "render-mode",
            Unsupported::IndexMode => "index-mode",
            Unsupported::TransformFeedback => "transform-feedback",
            Unsupported::VertexProgram => "vertex-program",
            Unsupported::VertexExtension => "vertex-extension",
            Unsupported::TextureUnit => "texture-unit",
            Unsupported::TextureFormat => "texture-format",
            Unsupported::TextureEnvironment => "texture-environment",
            Unsupported::SamplerObject => "sampler-object",
            Unsupported::MaterialPerVertex => "material-per-vertex",
            Unsupported::PolygonMode => "polygon-mode",
            Unsupported::EdgeFlags => "edge-flags",
            Unsupported::LineStipple => "line-stipple",
            Unsupported::WidePoints => "wide-points",
            Unsupported::WideLines => "wide-lines",
            Unsupported::Smooth => "smooth",
            Unsupported::PointFade => "point-fade",
        }
    }
}

/// Kinds of primitives that the rasteriser gets, by the draw's mode and `glPolygonMode`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rasterised {
    /// Some points.
    pub points: bool,
    /// Some lines.
    pub lines: bool,
    /// Some filled polygons.
    pub polygons: bool,
}

/// State of a draw that does not affect the shader but can make one impossible. [`Default`] is GL's initial state
/// with filled polygons. More than 12 fields: one for each state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings {
    /// `GL_RENDER_MODE` is `GL_RENDER`.
    pub render: bool,
    /// `GL_RGBA_MODE`, true for every framebuffer object.
    pub rgba: bool,
    /// Transform feedback is active and not paused.
    pub transform_feedback: bool,
    /// `GL_VERTEX_PROGRAM_ARB` is enabled.
    pub vertex_program: bool,
    /// `GL_VERTEX_BLEND_ARB`, `GL_VERTEX_WEIGHTING_EXT` and their like are enabled.
    pub vertex_extension: bool,
    /// A unit ≥ [`UNITS`] has an enabled target.
    pub high_texture_unit: bool,
    /// `glMaterial` was called between `glBegin` and `glEnd` of this draw (or of the list).
    pub material_per_vertex: bool,
    /// Primitives that the rasteriser gets.
    pub rasterised: Rasterised,
    /// `GL_POLYGON_MODE` of a face that is not culled is other than `GL_FILL`, and the draw has polygons.
    pub polygon_mode: bool,
    /// `GL_EDGE_FLAG_ARRAY` is enabled or the current edge flag is false, or was set inside the primitive.
    pub edge_flags: bool,
    /// `GL_LINE_STIPPLE`.
    pub line_stipple: bool,
    /// `GL_LINE_WIDTH`.
    pub line_width: f32,
    /// `GL_POINT_SIZE`.
    pub point_size: f32,
    /// `GL_POINT_SIZE_MIN`.
    pub point_size_min: f32,
    /// `GL_POINT_FADE_THRESHOLD_SIZE`.
    pub point_fade_threshold: f32,
    /// `GL_POINT_SMOOTH`.
    pub point_smooth: bool,
    /// `GL_LINE_SMOOTH`.
    pub line_smooth: bool,
    /// `GL_POLYGON_SMOOTH`.
    pub polygon_smooth: bool,
    /// `GL_MULTISAMPLE` is enabled and the draw buffer has samples.
    pub multisample: bool,
}

impl Default for Surroundings {
    fn default() -> Self {
        Self {
            render: true,
            rgba: true,
            transform_feedback: false,
            vertex_program: false,
            vertex_extension: false,
            high_texture_unit: false,
            material_per_vertex: false,
            rasterised: Rasterised {
                polygons: true,
                ..Rasterised::default()
            },
            polygon_mode: false,
            edge_flags: false,
            line_stipple: false,
            line_width: 1.0,
            point_size: 1.0,
            point_size_min: 0.0,
            point_fade_threshold: 1.0,
            point_smooth: false,
            line_smooth: false,
            polygon_smooth: false,
            multisample: false,
        }
    }
}

impl Surroundings {
    /// Whether a draw in this state may use the shader of `key`. The key must not be canonical: a canonical one omits the
    /// dialect where the shader does not depend on it.
    ///
    /// # Errors
    /// The first reason found, in the order of [`Unsupported`].
    pub fn allow(&self, key: &FixedKey) -> Result<(), Unsupported> {
        let geometry = key.target.amplifier != Amplifier::Instanced;
        let clipped = key.target.tiles == Tiles::ClipLeftRight;
        let drawn = self.rasterised;
        // Sizes that vary are taken as large.
        let wide_points = key.point == PointSize::Attenuated
            || self.point_size > 1.0
            || self.point_size_min > 1.0;
        let cut = matches!(
            key.target.primitive,
            Primitive::Polygon | Primitive::Quads | Primitive::QuadStrip
        );
        // A multisampled point or line spreads over the samples around it even when it is one pixel wide (14.4.3,
        // 14.5.4); polygons do not, and their smoothing is then ignored (14.6.6).
        let smooth = (self.point_smooth || self.multisample) && drawn.points
            || (self.line_smooth || self.multisample) && drawn.lines
            || self.polygon_smooth && !self.multisample && drawn.polygons;
        let fades = self.multisample
            && drawn.points
            && key.dialect == Dialect::Specification
            && self.point_fade_threshold > self.point_size_min
            && (key.point == PointSize::Attenuated || self.point_size < self.point_fade_threshold);
        let reasons = [
            (!self.render, Unsupported::RenderMode),
            (!self.rgba, Unsupported::IndexMode),
            (self.transform_feedback, Unsupported::TransformFeedback),
            (self.vertex_program, Unsupported::VertexProgram),
            (self.vertex_extension, Unsupported::VertexExtension),
            (self.high_texture_unit, Unsupported::TextureUnit),
            (self.material_per_vertex, Unsupported::MaterialPerVertex),
            (
                geometry && self.polygon_mode && cut,
                Unsupported::PolygonMode,
            ),
            (
                geometry && self.polygon_mode && self.edge_flags,
                Unsupported::EdgeFlags,
            ),
            (
                geometry && self.line_stipple && drawn.lines,
                Unsupported::LineStipple,
            ),
            (
                clipped && drawn.points && wide_points,
                Unsupported::WidePoints,
            ),
            (
                clipped && drawn.lines && self.line_width > 1.0,
                Unsupported::WideLines,
            ),
            (clipped && smooth, Unsupported::Smooth),
            (fades, Unsupported::PointFade),
        ];
        match reasons.into_iter().find(|&(applies, _)| applies) {
            Some((_, reason)) => Err(reason),
            None => Ok(()),
        }
    }
}
