//! What a new context answers: the initial state of the specification, and limits like those of a desktop driver.

use crate::gl::consts as c;

/// Enumerants that the layer does not use itself.
pub(super) mod more {
    pub(in super::super) const COLOR_CLEAR_VALUE: u32 = 0x0C22;
    pub(in super::super) const STENCIL_CLEAR_VALUE: u32 = 0x0B91;
    pub(in super::super) const LOGIC_OP_MODE: u32 = 0x0BF0;
    pub(in super::super) const BLEND_SRC: u32 = 0x0BE1;
    pub(in super::super) const BLEND_DST: u32 = 0x0BE0;
    pub(in super::super) const STENCIL_FUNC: u32 = 0x0B92;
    pub(in super::super) const STENCIL_REF: u32 = 0x0B97;
    pub(in super::super) const STENCIL_VALUE_MASK: u32 = 0x0B93;
    pub(in super::super) const STENCIL_FAIL: u32 = 0x0B94;
    pub(in super::super) const STENCIL_PASS_DEPTH_FAIL: u32 = 0x0B95;
    pub(in super::super) const STENCIL_PASS_DEPTH_PASS: u32 = 0x0B96;
    pub(in super::super) const QUERY_WAIT: u32 = 0x8E13;
    pub(in super::super) const COPY_WRITE_BUFFER: u32 = 0x8F37;
    pub(in super::super) const SHADER_STORAGE_BUFFER: u32 = 0x90D2;
    pub(in super::super) const SHADER_STORAGE_BUFFER_BINDING: u32 = 0x90D3;
    pub(in super::super) const TEXTURE_BUFFER: u32 = 0x8C2A;
    pub(in super::super) const DRAW_INDIRECT_BUFFER: u32 = 0x8F3F;
    pub(in super::super) const DRAW_INDIRECT_BUFFER_BINDING: u32 = 0x8F43;
    pub(in super::super) const FRAMEBUFFER_DEFAULT: u32 = 0x8218;
    pub(in super::super) const TEXTURE_TARGET: u32 = 0x1006;
}
use more as m;

/// Values that several of an index have: GL's name, how many there are.
const INDEXED: &[(u32, u32)] = &[
    (c::BLEND, 8),
    (c::COLOR_WRITEMASK, 8),
    (c::VIEWPORT, 16),
    (c::SCISSOR_BOX, 16),
    (c::SCISSOR_TEST, 16),
    (c::DEPTH_RANGE, 16),
];

/// How many of a value a context has, each with an index; 0 for one that has none.
pub(super) fn indices(name: u32) -> u32 {
    let found = INDEXED.iter().find(|(indexed, _)| *indexed == name);
    found.map_or(0, |(_, count)| *count)
}

/// Texture targets, what is bound to them, and whether fixed function can be switched to them.
pub(super) const TEXTURES: &[(u32, u32, bool)] = &[
    (c::TEXTURE_1D, c::TEXTURE_BINDING_1D, true),
    (c::TEXTURE_2D, c::TEXTURE_BINDING_2D, true),
    (c::TEXTURE_3D, c::TEXTURE_BINDING_3D, true),
    (c::TEXTURE_CUBE_MAP, c::TEXTURE_BINDING_CUBE_MAP, true),
    (c::TEXTURE_RECTANGLE, c::TEXTURE_BINDING_RECTANGLE, true),
    (c::TEXTURE_1D_ARRAY, c::TEXTURE_BINDING_1D_ARRAY, false),
    (c::TEXTURE_2D_ARRAY, c::TEXTURE_BINDING_2D_ARRAY, false),
    (
        c::TEXTURE_CUBE_MAP_ARRAY,
        c::TEXTURE_BINDING_CUBE_MAP_ARRAY,
        false,
    ),
    (
        c::TEXTURE_2D_MULTISAMPLE,
        c::TEXTURE_BINDING_2D_MULTISAMPLE,
        false,
    ),
    (
        c::TEXTURE_2D_MULTISAMPLE_ARRAY,
        c::TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY,
        false,
    ),
];

/// Targets of buffers, and what is bound to them.
pub(super) const BUFFERS: &[(u32, u32)] = &[
    (c::ARRAY_BUFFER, c::ARRAY_BUFFER_BINDING),
    (c::ELEMENT_ARRAY_BUFFER, c::ELEMENT_ARRAY_BUFFER_BINDING),
    (c::UNIFORM_BUFFER, c::UNIFORM_BUFFER_BINDING),
    (c::PIXEL_PACK_BUFFER, c::PIXEL_PACK_BUFFER_BINDING),
    (c::PIXEL_UNPACK_BUFFER, c::PIXEL_UNPACK_BUFFER_BINDING),
    (c::COPY_READ_BUFFER, c::COPY_READ_BUFFER),
    (m::COPY_WRITE_BUFFER, m::COPY_WRITE_BUFFER),
    (m::SHADER_STORAGE_BUFFER, m::SHADER_STORAGE_BUFFER_BINDING),
    (m::TEXTURE_BUFFER, m::TEXTURE_BUFFER),
    (m::DRAW_INDIRECT_BUFFER, m::DRAW_INDIRECT_BUFFER_BINDING),
];

/// Whether each texture unit has a value of its own.
pub(super) fn is_of_unit(name: u32) -> bool {
    let own = [
        c::SAMPLER_BINDING,
        c::TEXTURE_MATRIX,
        c::TEXTURE_STACK_DEPTH,
        c::CURRENT_TEXTURE_COORDS,
        c::TEXTURE_GEN_S,
        c::TEXTURE_GEN_T,
        c::TEXTURE_GEN_R,
        c::TEXTURE_GEN_Q,
    ];
    let of_targets =
        |&(target, binding, switch): &(u32, u32, bool)| binding == name || switch && target == name;
    own.contains(&name) || TEXTURES.iter().any(of_targets)
}

const IDENTITY: &[f64] = &[
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
];
const WHITE: &[f64] = &[1.0; 4];
const OPAQUE: &[f64] = &[0.0, 0.0, 0.0, 1.0];

/// Initial values that are not a single 0.
const INITIAL: &[(u32, &[f64])] = &[
    (c::VIEWPORT, &[0.0; 4]),
    (c::SCISSOR_BOX, &[0.0; 4]),
    (c::MAX_VIEWPORTS, &[16.0]),
    (c::COLOR_WRITEMASK, WHITE),
    (c::DEPTH_RANGE, &[0.0, 1.0]),
    (c::DEPTH_WRITEMASK, &[1.0]),
    (c::DEPTH_FUNC, &[0x0201 as f64]),
    (c::DEPTH_CLEAR_VALUE, &[1.0]),
    (m::COLOR_CLEAR_VALUE, &[0.0; 4]),
    (c::ACCUM_CLEAR_VALUE, &[0.0; 4]),
    (c::STENCIL_WRITEMASK, &[u32::MAX as f64]),
    (m::STENCIL_VALUE_MASK, &[u32::MAX as f64]),
    (m::STENCIL_FUNC, &[c::ALWAYS as f64]),
    (m::STENCIL_FAIL, &[0x1E00 as f64]),
    (m::STENCIL_PASS_DEPTH_FAIL, &[0x1E00 as f64]),
    (m::STENCIL_PASS_DEPTH_PASS, &[0x1E00 as f64]),
    (m::BLEND_SRC, &[1.0]),
    (m::LOGIC_OP_MODE, &[0x1503 as f64]),
    (c::DITHER, &[1.0]),
    (c::MULTISAMPLE, &[1.0]),
    (c::LINE_WIDTH, &[1.0]),
    (c::POINT_SIZE, &[1.0]),
    (c::POINT_SIZE_MAX, &[255.0]),
    (c::POINT_FADE_THRESHOLD_SIZE, &[1.0]),
    (c::POINT_DISTANCE_ATTENUATION, &[1.0, 0.0, 0.0]),
    (c::POLYGON_MODE, &[c::FILL as f64; 2]),
    (c::PATCH_VERTICES, &[3.0]),
    (c::CULL_FACE_MODE, &[c::BACK as f64]),
    (c::FRONT_FACE, &[0x0901 as f64]),
    (c::SHADE_MODEL, &[c::SMOOTH as f64]),
    (c::PROVOKING_VERTEX, &[c::LAST_VERTEX_CONVENTION as f64]),
    (c::QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION, &[1.0]),
    (c::CLAMP_VERTEX_COLOR, &[1.0]),
    (c::CLIP_ORIGIN, &[0x8CA1 as f64]),
    (c::CLIP_DEPTH_MODE, &[0x935E as f64]),
    (c::ACTIVE_TEXTURE, &[c::TEXTURE0 as f64]),
    (c::CLIENT_ACTIVE_TEXTURE, &[c::TEXTURE0 as f64]),
    (c::MATRIX_MODE, &[c::MODELVIEW as f64]),
    (c::MODELVIEW_MATRIX, IDENTITY),
    (c::PROJECTION_MATRIX, IDENTITY),
    (c::TEXTURE_MATRIX, IDENTITY),
    (c::MODELVIEW_STACK_DEPTH, &[1.0]),
    (c::PROJECTION_STACK_DEPTH, &[1.0]),
    (c::TEXTURE_STACK_DEPTH, &[1.0]),
    (c::RENDER_MODE, &[c::RENDER as f64]),
    (c::CURRENT_COLOR, WHITE),
    (c::CURRENT_SECONDARY_COLOR, OPAQUE),
    (c::CURRENT_NORMAL, &[0.0, 0.0, 1.0]),
    (c::CURRENT_TEXTURE_COORDS, OPAQUE),
    (c::CURRENT_RASTER_POSITION, OPAQUE),
    (c::CURRENT_RASTER_POSITION_VALID, &[1.0]),
    (c::EDGE_FLAG, &[1.0]),
    (c::PACK_ALIGNMENT, &[4.0]),
    (c::UNPACK_ALIGNMENT, &[4.0]),
    (c::FOG_MODE, &[c::EXP as f64]),
    (c::FOG_COORD_SRC, &[c::FRAGMENT_DEPTH as f64]),
    (c::FOG_DISTANCE_MODE_NV, &[c::EYE_PLANE_ABSOLUTE_NV as f64]),
    (c::LIGHT_MODEL_AMBIENT, &[0.2, 0.2, 0.2, 1.0]),
    (c::LIGHT_MODEL_COLOR_CONTROL, &[c::SINGLE_COLOR as f64]),
    (c::COLOR_MATERIAL_FACE, &[c::FRONT_AND_BACK as f64]),
    (c::COLOR_MATERIAL_PARAMETER, &[0x1602 as f64]),
    (c::POSITION, &[0.0, 0.0, 1.0, 0.0]),
    (c::SPOT_CUTOFF, &[180.0]),
    (c::CONSTANT_ATTENUATION, &[1.0]),
    // Of the material; a light's are others, and not looked at.
    (c::AMBIENT, &[0.2, 0.2, 0.2, 1.0]),
    (c::DIFFUSE, &[0.8, 0.8, 0.8, 1.0]),
    (c::SPECULAR, OPAQUE),
    (c::EMISSION, OPAQUE),
    (c::TEXTURE_ENV_MODE, &[c::MODULATE as f64]),
    (c::TEXTURE_GEN_MODE, &[c::EYE_LINEAR as f64]),
    (c::TEXTURE_MIN_FILTER, &[0x2702 as f64]),
    (c::TEXTURE_MAG_FILTER, &[c::LINEAR as f64]),
    (c::TEXTURE_WRAP_S, &[0x2901 as f64]),
    (c::TEXTURE_WRAP_T, &[0x2901 as f64]),
    (c::TEXTURE_WRAP_R, &[0x2901 as f64]),
    (c::TEXTURE_MIN_LOD, &[-1000.0]),
    (c::TEXTURE_MAX_LOD, &[1000.0]),
    (c::TEXTURE_MAX_LEVEL, &[1000.0]),
    (c::TEXTURE_IMMUTABLE_FORMAT, &[0.0]),
    (c::TEXTURE_BORDER_COLOR, &[0.0; 4]),
    (c::TEXTURE_MAX_ANISOTROPY, &[1.0]),
    (c::TEXTURE_SWIZZLE_R, &[c::RED as f64]),
    (c::TEXTURE_SWIZZLE_G, &[0x1904 as f64]),
    (c::TEXTURE_SWIZZLE_B, &[0x1905 as f64]),
    (c::TEXTURE_SWIZZLE_A, &[c::ALPHA as f64]),
    (c::TEXTURE_COMPARE_FUNC, &[c::LEQUAL as f64]),
    (c::DEPTH_TEXTURE_MODE, &[c::LUMINANCE as f64]),
    (c::DEPTH_STENCIL_TEXTURE_MODE, &[c::DEPTH_COMPONENT as f64]),
    // The window.
    (c::DRAW_BUFFER, &[c::BACK as f64]),
    (c::DRAW_BUFFER0, &[c::BACK as f64]),
    (c::READ_BUFFER, &[c::BACK as f64]),
    (c::DOUBLEBUFFER, &[1.0]),
    (c::RED_BITS, &[8.0]),
    (c::GREEN_BITS, &[8.0]),
    (c::BLUE_BITS, &[8.0]),
    (c::ALPHA_BITS, &[8.0]),
    (c::DEPTH_BITS, &[24.0]),
    (c::STENCIL_BITS, &[8.0]),
    // Limits.
    (c::MAX_TEXTURE_SIZE, &[16384.0]),
    (c::MAX_VIEWPORT_DIMS, &[16384.0; 2]),
    (c::MAX_ARRAY_TEXTURE_LAYERS, &[2048.0]),
    (c::MAX_CLIP_DISTANCES, &[8.0]),
    (c::MAX_TEXTURE_UNITS, &[8.0]),
    (c::MAX_TEXTURE_COORDS, &[8.0]),
    (c::MAX_COMBINED_TEXTURE_IMAGE_UNITS, &[96.0]),
    (c::MAX_VERTEX_ATTRIBS, &[16.0]),
    (c::MAX_DRAW_BUFFERS, &[8.0]),
    (c::MAX_COLOR_ATTACHMENTS, &[8.0]),
    (c::MAX_SAMPLES, &[8.0]),
    (c::MAX_ATTRIB_STACK_DEPTH, &[16.0]),
    (c::MAX_CLIENT_ATTRIB_STACK_DEPTH, &[16.0]),
    (c::MAX_MODELVIEW_STACK_DEPTH, &[32.0]),
    (c::MAX_PROJECTION_STACK_DEPTH, &[32.0]),
    (c::MAX_TEXTURE_STACK_DEPTH, &[10.0]),
    (c::MAX_VERTEX_OUTPUT_COMPONENTS, &[64.0]),
    (c::MAX_GEOMETRY_INPUT_COMPONENTS, &[64.0]),
    (c::MAX_GEOMETRY_OUTPUT_COMPONENTS, &[128.0]),
    (c::MAX_GEOMETRY_OUTPUT_VERTICES, &[256.0]),
    (c::MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS, &[1024.0]),
    (c::MAX_GEOMETRY_SHADER_INVOCATIONS, &[32.0]),
    (c::CONTEXT_PROFILE_MASK, &[2.0]),
];

/// Initial values that are a single 0: nothing is bound, switched on or written.
const ZERO: &[u32] = &[
    c::CURRENT_PROGRAM,
    c::PROGRAM_PIPELINE_BINDING,
    c::VERTEX_ARRAY_BINDING,
    c::DRAW_FRAMEBUFFER_BINDING,
    c::READ_FRAMEBUFFER_BINDING,
    c::RENDERBUFFER_BINDING,
    c::SAMPLER_BINDING,
    c::QUERY_BUFFER_BINDING,
    c::UNIFORM_BUFFER_START,
    c::CURRENT_QUERY,
    c::CURRENT_FOG_COORD,
    c::ATTRIB_STACK_DEPTH,
    c::CLIENT_ATTRIB_STACK_DEPTH,
    c::LIST_INDEX,
    c::LIST_MODE,
    c::LIST_BASE,
    c::TRANSFORM_FEEDBACK_ACTIVE,
    c::TRANSFORM_FEEDBACK_PAUSED,
    c::POLYGON_OFFSET_FACTOR,
    c::POLYGON_OFFSET_UNITS,
    c::POLYGON_OFFSET_CLAMP,
    c::POINT_SIZE_MIN,
    c::LIGHT_MODEL_LOCAL_VIEWER,
    c::LIGHT_MODEL_TWO_SIDE,
    c::SHININESS,
    c::SPOT_EXPONENT,
    c::LINEAR_ATTENUATION,
    c::QUADRATIC_ATTENUATION,
    c::TEXTURE_LOD_BIAS,
    c::TEXTURE_BASE_LEVEL,
    c::TEXTURE_COMPARE_MODE,
    c::GENERATE_MIPMAP,
    c::SAMPLES,
    c::SAMPLE_BUFFERS,
    c::STEREO,
    c::CONTEXT_FLAGS,
    c::NUM_PROGRAM_BINARY_FORMATS,
    c::IMAGE_BINDING_NAME,
    c::IMAGE_BINDING_LEVEL,
    c::IMAGE_BINDING_LAYERED,
    c::IMAGE_BINDING_LAYER,
    c::IMAGE_BINDING_ACCESS,
    c::IMAGE_BINDING_FORMAT,
    c::VERTEX_ARRAY_BUFFER_BINDING,
    c::VERTEX_ARRAY_SIZE,
    c::VERTEX_ARRAY_TYPE,
    c::VERTEX_ARRAY_STRIDE,
    c::VERTEX_ATTRIB_ARRAY_ENABLED,
    c::VERTEX_ATTRIB_ARRAY_DIVISOR,
    m::STENCIL_CLEAR_VALUE,
    m::STENCIL_REF,
    m::BLEND_DST,
    m::QUERY_WAIT,
];

/// Capabilities that a new context has switched off.
const OFF: &[u32] = &[
    c::BLEND,
    c::SCISSOR_TEST,
    c::DEPTH_TEST,
    c::STENCIL_TEST,
    c::CULL_FACE,
    c::ALPHA_TEST,
    c::COLOR_LOGIC_OP,
    c::INDEX_LOGIC_OP,
    c::FRAMEBUFFER_SRGB,
    c::RASTERIZER_DISCARD,
    c::POLYGON_STIPPLE,
    c::POLYGON_SMOOTH,
    c::LINE_STIPPLE,
    c::LINE_SMOOTH,
    c::POINT_SMOOTH,
    c::POINT_SPRITE,
    c::SAMPLE_ALPHA_TO_COVERAGE,
    c::SAMPLE_ALPHA_TO_ONE,
    c::SAMPLE_COVERAGE,
    c::SAMPLE_MASK,
    c::POLYGON_OFFSET_FILL,
    c::DEPTH_CLAMP,
    c::COLOR_SUM,
    c::VERTEX_PROGRAM_TWO_SIDE,
    c::PROGRAM_POINT_SIZE,
    c::FRAGMENT_PROGRAM_ARB,
    c::VERTEX_PROGRAM_ARB,
    c::TEXTURE_CUBE_MAP_SEAMLESS,
    c::PRIMITIVE_RESTART,
    c::PRIMITIVE_RESTART_FIXED_INDEX,
    c::LIGHTING,
    c::NORMALIZE,
    c::RESCALE_NORMAL,
    c::COLOR_MATERIAL,
    c::FOG,
    c::VERTEX_ARRAY,
    c::EDGE_FLAG_ARRAY,
];

/// Ranges of names of which each is a capability that is off, or nothing.
const RANGES: &[(u32, u32)] = &[
    (c::CLIP_DISTANCE0, 8),
    (c::LIGHT0, 8),
    (c::DRAW_BUFFER0, 16),
    (c::ACCUM_RED_BITS, 4),
    (c::PACK_SWAP_BYTES, 5),
    (c::UNPACK_SWAP_BYTES, 5),
    (c::PACK_SKIP_IMAGES, 4),
];

/// What a new context has; none for a name that the fake driver does not know.
pub(super) fn default(name: u32) -> Option<Vec<f64>> {
    let initial = INITIAL.iter().find(|(known, _)| *known == name);
    if let Some((_, values)) = initial {
        return Some(values.to_vec());
    }
    let textures = TEXTURES.iter();
    let zero = ZERO.contains(&name)
        || OFF.contains(&name)
        || is_of_unit(name)
        || BUFFERS.iter().any(|&(_, binding)| binding == name)
        || textures.into_iter().any(|&(target, ..)| target == name)
        || RANGES
            .iter()
            .any(|&(first, count)| (first..first + count).contains(&name));
    zero.then(|| vec![0.0])
}
