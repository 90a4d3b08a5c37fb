//! Limits of the driver that matter for generated shaders.

/// Limits and extensions of a context. [`Limits::default`] has the least values of OpenGL 4.6 (tables 23.55 to 23.60)
/// and no extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// `GL_SHADING_LANGUAGE_VERSION` times 100, of the compatibility profile.
    pub glsl: u32,
    /// `GL_MAX_CLIP_DISTANCES`.
    pub clip_distances: u32,
    /// `GL_MAX_VERTEX_OUTPUT_COMPONENTS`.
    pub vertex_output_components: u32,
    /// `GL_MAX_GEOMETRY_INPUT_COMPONENTS`.
    pub geometry_input_components: u32,
    /// `GL_MAX_GEOMETRY_OUTPUT_COMPONENTS`.
    pub geometry_output_components: u32,
    /// `GL_MAX_GEOMETRY_OUTPUT_VERTICES`.
    pub geometry_output_vertices: u32,
    /// `GL_MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS`.
    pub geometry_total_output_components: u32,
    /// `GL_MAX_GEOMETRY_SHADER_INVOCATIONS`; 0 without `GL_ARB_gpu_shader5` and OpenGL 4.0.
    pub geometry_invocations: u32,
    /// `GL_ARB_gpu_shader5` is supported. From GLSL 4.00 on it does not matter.
    pub gpu_shader5: bool,
    /// The extension that lets a vertex shader write `gl_Layer`.
    pub vertex_layer: Option<VertexLayer>,
}

/// Extensions with `gl_Layer` in the vertex shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexLayer {
    /// `GL_ARB_shader_viewport_layer_array`
    ArbShaderViewportLayerArray,
    /// `GL_AMD_vertex_shader_layer`
    AmdVertexShaderLayer,
}

impl VertexLayer {
    /// Name for `#extension`.
    pub const fn extension(self) -> &'static str {
        match self {
            VertexLayer::ArbShaderViewportLayerArray => "GL_ARB_shader_viewport_layer_array",
            VertexLayer::AmdVertexShaderLayer => "GL_AMD_vertex_shader_layer",
        }
    }
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            glsl: 460,
            clip_distances: 8,
            vertex_output_components: 64,
            geometry_input_components: 64,
            geometry_output_components: 128,
            geometry_output_vertices: 256,
            geometry_total_output_components: 1024,
            geometry_invocations: 32,
            gpu_shader5: false,
            vertex_layer: None,
        }
    }
}
