//! Which values are kept, and what saves and restores them.

use crate::gl::bindings::is_texture_binding;
use crate::gl::consts as c;

/// One value of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Key {
    /// What glGet answers to this name.
    Value(u32),
    /// What glGet answers to this name, for an index.
    At(u32, u32),
    /// Whether this capability is on.
    Cap(u32),
    /// Whether this capability is on for an index.
    CapAt(u32, u32),
    /// What glGet answers to this name while a texture unit is active, counted from 0.
    Unit(u32, u32),
    /// Whether this capability of a texture unit is on.
    UnitCap(u32, u32),
    /// glGetTexEnv of GL_TEXTURE_ENV: name, unit.
    TexEnv(u32, u32),
    /// GL_TEXTURE_GEN_MODE: coordinate, unit.
    TexGen(u32, u32),
    /// glGetLight: light, name. Of GL_POSITION, only w is kept.
    Light(u32, u32),
    /// glGetMaterial: face, name.
    Material(u32, u32),
    /// A bit for each generic attribute: what glGetVertexAttrib answers to this name, while this vertex array object is bound.
    Attributes(u32, u32),
}

/// What glGet answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::gl) enum Form {
    Integers,
    Floats,
}

/// How a name that glGet takes is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kept {
    /// It never changes.
    Constant,
    /// One value of a context.
    Value,
    /// One value of each texture unit.
    Unit,
}

/// Texture units whose coordinates are kept. Mesa takes those of further units for them.
pub(in crate::gl) const UNITS: u32 = 8;

pub(super) const COLOR: Key = Key::Value(c::CURRENT_COLOR);
pub(super) const NORMAL: Key = Key::Value(c::CURRENT_NORMAL);
pub(super) const SECONDARY: Key = Key::Value(c::CURRENT_SECONDARY_COLOR);
pub(super) const FOG: Key = Key::Value(c::CURRENT_FOG_COORD);
pub(super) const EDGE: Key = Key::Value(c::EDGE_FLAG);

/// The current coordinates of a texture unit, counted from 0.
pub(super) const fn coordinates(unit: u32) -> Key {
    Key::Unit(c::CURRENT_TEXTURE_COORDS, unit)
}

/// The colour, as a set of [`current_bit`]s.
pub(super) const COLOR_BIT: u32 = 1;

/// The bit of a current value in a set of them; none for a key of other state.
pub(super) fn current_bit(key: Key) -> Option<u32> {
    Some(match key {
        COLOR => 0,
        NORMAL => 1,
        SECONDARY => 2,
        FOG => 3,
        EDGE => 4,
        Key::Unit(c::CURRENT_TEXTURE_COORDS, unit) if unit < UNITS => 5 + unit,
        _ => return None,
    })
}

/// Whether glGet answers a current value to this name.
pub(super) fn is_current(name: u32) -> bool {
    name == c::CURRENT_TEXTURE_COORDS || current_bit(Key::Value(name)).is_some()
}

/// How many of the values that a name has are kept: the alpha of a secondary colour is set by no command.
pub(super) fn kept_of(name: u32) -> usize {
    match name {
        c::CURRENT_NORMAL | c::CURRENT_SECONDARY_COLOR => 3,
        c::CURRENT_FOG_COORD => 1,
        _ => 4,
    }
}

/// Bits of glPushAttrib that the constants of the layer lack.
pub(super) mod bits {
    pub(in super::super) const POINT: u32 = 0x2;
    pub(in super::super) const LINE: u32 = 0x4;
    pub(in super::super) const POLYGON: u32 = 0x8;
    pub(in super::super) const FOG: u32 = 0x80;
    pub(in super::super) const VIEWPORT: u32 = 0x800;
    pub(in super::super) const ENABLE: u32 = 0x2000;
    pub(in super::super) const LIST: u32 = 0x2_0000;
    pub(in super::super) const SCISSOR: u32 = 0x8_0000;
    /// Of glPushClientAttrib, moved to where glPushAttrib has none.
    pub(in super::super) const CLIENT_PIXELS: u32 = 1 << 30;
    pub(in super::super) const CLIENT_ARRAYS: u32 = 1 << 31;
}

/// How a name is kept, and in which form the driver is asked for it. None for one that is not kept.
pub(super) fn kept(name: u32) -> Option<(Kept, Form)> {
    use Form::{Floats, Integers};
    Some(match name {
        c::MAX_TEXTURE_SIZE
        | c::MAX_VIEWPORT_DIMS
        | c::MAX_VIEWPORTS
        | c::MAX_CLIP_DISTANCES
        | c::MAX_ATTRIB_STACK_DEPTH
        | c::MAX_TEXTURE_COORDS
        | c::MAX_TEXTURE_UNITS
        | c::MAX_COMBINED_TEXTURE_IMAGE_UNITS
        | c::MAX_DRAW_BUFFERS
        | c::MAX_VERTEX_ATTRIBS => (Kept::Constant, Integers),
        c::VIEWPORT
        | c::SCISSOR_BOX
        | c::CURRENT_PROGRAM
        | c::PROGRAM_PIPELINE_BINDING
        | c::DEPTH_WRITEMASK
        | c::DEPTH_FUNC
        | c::CLIP_DEPTH_MODE
        | c::CLIP_ORIGIN
        | c::POINT_SPRITE_COORD_ORIGIN
        | c::COLOR_WRITEMASK
        | c::STENCIL_WRITEMASK
        | c::POLYGON_MODE
        | c::ACTIVE_TEXTURE
        | c::VERTEX_ARRAY_BINDING
        | c::LIST_BASE
        | c::SHADE_MODEL
        | c::PROVOKING_VERTEX
        | c::LIGHT_MODEL_LOCAL_VIEWER
        | c::LIGHT_MODEL_TWO_SIDE
        | c::LIGHT_MODEL_COLOR_CONTROL
        | c::COLOR_MATERIAL_FACE
        | c::COLOR_MATERIAL_PARAMETER
        | c::CLAMP_VERTEX_COLOR
        | c::FOG_COORD_SRC
        | c::FOG_DISTANCE_MODE_NV
        | c::QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION
        | c::CULL_FACE_MODE
        | c::FRONT_FACE
        | c::EDGE_FLAG => (Kept::Value, Integers),
        _ if is_pixel_store(name) || is_buffer(name) => (Kept::Value, Integers),
        c::DEPTH_RANGE
        | c::DEPTH_CLEAR_VALUE
        | c::LINE_WIDTH
        | c::POINT_SIZE
        | c::POINT_SIZE_MIN
        | c::POINT_FADE_THRESHOLD_SIZE
        | c::POINT_DISTANCE_ATTENUATION
        | c::ACCUM_CLEAR_VALUE
        | c::CURRENT_COLOR
        | c::CURRENT_NORMAL
        | c::CURRENT_SECONDARY_COLOR
        | c::CURRENT_FOG_COORD => (Kept::Value, Floats),
        c::CURRENT_TEXTURE_COORDS => (Kept::Unit, Floats),
        c::SAMPLER_BINDING => (Kept::Unit, Integers),
        _ if is_texture_binding(name) => (Kept::Unit, Integers),
        _ => return None,
    })
}

pub(super) fn is_pixel_store(name: u32) -> bool {
    (c::PACK_SWAP_BYTES..=c::PACK_ALIGNMENT).contains(&name)
        || (c::UNPACK_SWAP_BYTES..=c::UNPACK_ALIGNMENT).contains(&name)
        || [
            c::PACK_SKIP_IMAGES,
            c::PACK_IMAGE_HEIGHT,
            c::UNPACK_SKIP_IMAGES,
            c::UNPACK_IMAGE_HEIGHT,
        ]
        .contains(&name)
}

/// Whether a buffer is bound by this name, of those that are asked for.
pub(super) fn is_buffer(name: u32) -> bool {
    [
        c::PIXEL_PACK_BUFFER_BINDING,
        c::PIXEL_UNPACK_BUFFER_BINDING,
        c::QUERY_BUFFER_BINDING,
    ]
    .contains(&name)
}

/// Whether a capability belongs to the active texture unit.
pub(super) fn is_of_unit(cap: u32) -> bool {
    [
        c::TEXTURE_1D,
        c::TEXTURE_2D,
        c::TEXTURE_3D,
        c::TEXTURE_CUBE_MAP,
        c::TEXTURE_RECTANGLE,
    ]
    .contains(&cap)
        || (c::TEXTURE_GEN_S..=c::TEXTURE_GEN_S + 3).contains(&cap)
}

/// Capabilities that have a value for each draw buffer or viewport.
pub(super) const INDEXED: [u32; 2] = [c::BLEND, c::SCISSOR_TEST];

/// Whether a capability has a value for each draw buffer or viewport.
pub(super) fn is_indexed(cap: u32) -> bool {
    INDEXED.contains(&cap)
}

/// Whether a parameter of the material of a face follows the colour while these are GL_COLOR_MATERIAL_FACE and GL_COLOR_MATERIAL_PARAMETER.
pub(in crate::gl) fn drives([faces, parameter]: [u32; 2], face: u32, name: u32) -> bool {
    let both = parameter == c::AMBIENT_AND_DIFFUSE && [c::AMBIENT, c::DIFFUSE].contains(&name);
    [face, c::FRONT_AND_BACK].contains(&faces) && (parameter == name || both)
}

impl Key {
    /// Whether it is the name of an object that is bound, which a driver may refuse.
    pub(super) fn binding(self) -> Option<u32> {
        match self {
            Key::Value(
                name @ (c::CURRENT_PROGRAM | c::PROGRAM_PIPELINE_BINDING | c::VERTEX_ARRAY_BINDING),
            ) => Some(name),
            Key::Value(name) if is_buffer(name) => Some(name),
            Key::Unit(name, _) if name != c::CURRENT_TEXTURE_COORDS => Some(name),
            _ => None,
        }
    }

    /// Whether glPushClientAttrib saves it, not glPushAttrib.
    pub(super) fn is_of_client(self) -> bool {
        match self {
            Key::Value(name) => {
                name == c::VERTEX_ARRAY_BINDING || is_pixel_store(name) || is_buffer(name)
            }
            Key::Attributes(..) => true,
            _ => false,
        }
    }

    /// Whether it is kept only once values are set by their index.
    pub(super) fn is_by_index(self) -> bool {
        matches!(
            self,
            Key::CapAt(..) | Key::At(c::VIEWPORT | c::SCISSOR_BOX, _)
        )
    }

    /// The bits of glPushAttrib with which glPopAttrib is certain to restore it (OpenGL 4.6 compatibility, table 21.1 and the tables of state;
    /// measured where drivers differ), and those with which it may.
    pub(super) fn saved_with(self) -> (u32, u32) {
        const LIGHTING: u32 = c::LIGHTING_BIT;
        match self {
            // Mesa 22.3 does not restore all of them.
            _ if current_bit(self).is_some() => (0, c::CURRENT_BIT),
            Key::Value(name) => match name {
                c::VIEWPORT | c::DEPTH_RANGE => (bits::VIEWPORT, 0),
                c::SCISSOR_BOX => (bits::SCISSOR, 0),
                c::DEPTH_WRITEMASK | c::DEPTH_FUNC | c::DEPTH_CLEAR_VALUE => {
                    (c::DEPTH_BUFFER_BIT, 0)
                }
                c::CLIP_DEPTH_MODE | c::CLIP_ORIGIN => (0, c::TRANSFORM_BIT),
                c::COLOR_WRITEMASK => (c::COLOR_BUFFER_BIT, 0),
                c::STENCIL_WRITEMASK => (c::STENCIL_BUFFER_BIT, 0),
                c::POLYGON_MODE | c::CULL_FACE_MODE | c::FRONT_FACE => (bits::POLYGON, 0),
                c::ACTIVE_TEXTURE => (c::TEXTURE_BIT, 0),
                c::LIST_BASE => (bits::LIST, 0),
                c::ACCUM_CLEAR_VALUE => (c::ACCUM_BUFFER_BIT, 0),
                c::SHADE_MODEL
                | c::LIGHT_MODEL_LOCAL_VIEWER
                | c::LIGHT_MODEL_TWO_SIDE
                | c::LIGHT_MODEL_COLOR_CONTROL
                | c::COLOR_MATERIAL_FACE
                | c::COLOR_MATERIAL_PARAMETER => (LIGHTING, 0),
                c::FOG_COORD_SRC => (bits::FOG, 0),
                c::LINE_WIDTH => (bits::LINE, 0),
                c::POINT_SIZE
                | c::POINT_SIZE_MIN
                | c::POINT_FADE_THRESHOLD_SIZE
                | c::POINT_DISTANCE_ATTENUATION
                | c::POINT_SPRITE_COORD_ORIGIN => (bits::POINT, 0),
                c::VERTEX_ARRAY_BINDING => (0, bits::CLIENT_ARRAYS),
                c::CURRENT_PROGRAM | c::PROGRAM_PIPELINE_BINDING => (0, 0),
                _ if is_pixel_store(name) => (bits::CLIENT_PIXELS, 0),
                _ if is_buffer(name) => (0, bits::CLIENT_PIXELS | bits::CLIENT_ARRAYS),
                _ => (0, u32::MAX),
            },
            Key::At(c::COLOR_WRITEMASK, _) => (c::COLOR_BUFFER_BIT, 0),
            Key::At(..) => (0, u32::MAX),
            Key::Cap(cap) | Key::CapAt(cap, _) => match cap {
                c::DEPTH_TEST => (c::DEPTH_BUFFER_BIT | bits::ENABLE, 0),
                c::STENCIL_TEST => (c::STENCIL_BUFFER_BIT | bits::ENABLE, 0),
                c::BLEND | c::ALPHA_TEST => (c::COLOR_BUFFER_BIT | bits::ENABLE, 0),
                c::SCISSOR_TEST => (bits::SCISSOR | bits::ENABLE, 0),
                c::CULL_FACE | c::POLYGON_STIPPLE | c::POLYGON_SMOOTH => {
                    (bits::POLYGON | bits::ENABLE, 0)
                }
                c::LIGHTING | c::COLOR_MATERIAL => (LIGHTING | bits::ENABLE, 0),
                c::FOG => (bits::FOG | bits::ENABLE, 0),
                c::LINE_SMOOTH | c::LINE_STIPPLE => (bits::LINE | bits::ENABLE, 0),
                c::POINT_SMOOTH => (bits::POINT | bits::ENABLE, 0),
                c::NORMALIZE | c::RESCALE_NORMAL => (c::TRANSFORM_BIT | bits::ENABLE, 0),
                _ if (c::CLIP_PLANE0..c::CLIP_PLANE0 + 8).contains(&cap) => {
                    (c::TRANSFORM_BIT | bits::ENABLE, 0)
                }
                _ if (c::LIGHT0..c::LIGHT0 + 8).contains(&cap) => (LIGHTING | bits::ENABLE, 0),
                _ => (0, u32::MAX),
            },
            Key::UnitCap(..) => (c::TEXTURE_BIT | bits::ENABLE, 0),
            Key::Unit(c::SAMPLER_BINDING, _) => (0, c::TEXTURE_BIT),
            Key::Unit(..) | Key::TexEnv(..) | Key::TexGen(..) => (c::TEXTURE_BIT, 0),
            Key::Light(..) | Key::Material(..) => (LIGHTING, 0),
            Key::Attributes(..) => (0, bits::CLIENT_ARRAYS),
        }
    }
}
