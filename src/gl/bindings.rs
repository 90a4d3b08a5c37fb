//! The names by which glGet tells what is bound at a target.

use super::consts as c;

/// Texture targets, each with the name of its binding.
const TEXTURES: [(u32, u32); 10] = [
    (c::TEXTURE_1D, c::TEXTURE_BINDING_1D),
    (c::TEXTURE_2D, c::TEXTURE_BINDING_2D),
    (c::TEXTURE_3D, c::TEXTURE_BINDING_3D),
    (c::TEXTURE_CUBE_MAP, c::TEXTURE_BINDING_CUBE_MAP),
    (c::TEXTURE_RECTANGLE, c::TEXTURE_BINDING_RECTANGLE),
    (c::TEXTURE_1D_ARRAY, c::TEXTURE_BINDING_1D_ARRAY),
    (c::TEXTURE_2D_ARRAY, c::TEXTURE_BINDING_2D_ARRAY),
    (c::TEXTURE_CUBE_MAP_ARRAY, c::TEXTURE_BINDING_CUBE_MAP_ARRAY),
    (c::TEXTURE_2D_MULTISAMPLE, c::TEXTURE_BINDING_2D_MULTISAMPLE),
    (
        c::TEXTURE_2D_MULTISAMPLE_ARRAY,
        c::TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY,
    ),
];

/// Buffer targets, each with the name of its binding.
const BUFFERS: [(u32, u32); 14] = [
    (c::ARRAY_BUFFER, c::ARRAY_BUFFER_BINDING),
    (c::ELEMENT_ARRAY_BUFFER, c::ELEMENT_ARRAY_BUFFER_BINDING),
    (c::UNIFORM_BUFFER, c::UNIFORM_BUFFER_BINDING),
    (c::SHADER_STORAGE_BUFFER, c::SHADER_STORAGE_BUFFER_BINDING),
    (c::ATOMIC_COUNTER_BUFFER, c::ATOMIC_COUNTER_BUFFER_BINDING),
    (
        c::TRANSFORM_FEEDBACK_BUFFER,
        c::TRANSFORM_FEEDBACK_BUFFER_BINDING,
    ),
    (c::DRAW_INDIRECT_BUFFER, c::DRAW_INDIRECT_BUFFER_BINDING),
    (
        c::DISPATCH_INDIRECT_BUFFER,
        c::DISPATCH_INDIRECT_BUFFER_BINDING,
    ),
    (c::PIXEL_PACK_BUFFER, c::PIXEL_PACK_BUFFER_BINDING),
    (c::PIXEL_UNPACK_BUFFER, c::PIXEL_UNPACK_BUFFER_BINDING),
    (c::QUERY_BUFFER, c::QUERY_BUFFER_BINDING),
    // The binding has the target's number.
    (c::COPY_READ_BUFFER, c::COPY_READ_BUFFER),
    (c::COPY_WRITE_BUFFER, c::COPY_WRITE_BUFFER),
    (c::TEXTURE_BUFFER, c::TEXTURE_BUFFER),
];

fn binding(all: &[(u32, u32)], target: u32) -> Option<u32> {
    let found = all.iter().find(|(known, _)| *known == target);
    found.map(|(_, binding)| *binding)
}

/// The binding of a texture target; none for what is no such target.
pub fn texture_binding(target: u32) -> Option<u32> {
    binding(&TEXTURES, target)
}

/// Whether glGet tells a texture by this name.
pub(super) fn is_texture_binding(name: u32) -> bool {
    TEXTURES.iter().any(|(_, binding)| *binding == name)
}

/// The binding of a buffer target; none for what is no such target.
pub fn buffer_binding(target: u32) -> Option<u32> {
    binding(&BUFFERS, target)
}
