//! Arguments of commands, as they are kept.

use crate::gl::consts as c;
use crate::gl::real::Ptr;

/// One integer.
pub(super) fn one(value: u32) -> Option<[u32; 4]> {
    Some([value, 0, 0, 0])
}

/// Floats, by their bits.
pub(super) fn floats<const K: usize>(values: [f32; K]) -> Option<[u32; 4]> {
    let mut words = [0; 4];
    for (word, value) in words.iter_mut().zip(values) {
        *word = value.to_bits();
    }
    // What is no number is no matter to be guessed.
    values.iter().all(|v| v.is_finite()).then_some(words)
}

/// Values of a program's array.
///
/// # Safety
/// It has so many.
pub(super) unsafe fn read<T: Copy, const K: usize>(values: Ptr) -> Option<[T; K]> {
    // SAFETY: forwarded.
    (!values.is_null()).then(|| unsafe { values.cast::<[T; K]>().read_unaligned() })
}

/// The values that state takes, for names that have a list of them. None for other names.
fn enumerants(name: u32) -> Option<&'static [u32]> {
    Some(match name {
        c::TEXTURE_ENV_MODE => &[
            c::MODULATE,
            c::DECAL,
            c::BLEND,
            c::REPLACE,
            c::ADD,
            c::COMBINE,
        ],
        c::FOG_COORD_SRC => &[c::FOG_COORDINATE, c::FRAGMENT_DEPTH],
        c::FOG_DISTANCE_MODE_NV => &[c::EYE_RADIAL_NV, c::EYE_PLANE, c::EYE_PLANE_ABSOLUTE_NV],
        c::TEXTURE_GEN_MODE => &[
            c::OBJECT_LINEAR,
            c::EYE_LINEAR,
            c::SPHERE_MAP,
            c::REFLECTION_MAP,
            c::NORMAL_MAP,
        ],
        c::LIGHT_MODEL_COLOR_CONTROL => &[c::SINGLE_COLOR, c::SEPARATE_SPECULAR_COLOR],
        _ => return None,
    })
}

/// A value that is one of those that its name takes, or unknown.
pub(super) fn enumerant(name: u32, value: u32) -> Option<[u32; 4]> {
    enumerants(name)?.contains(&value).then_some(one(value)?)
}
