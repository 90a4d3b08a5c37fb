//! The exported functions, by name.

use crate::entry::EXPORTS;
use manyview_core::gl::Ptr;

/// The slot and the address of our exported function with this name.
pub(crate) fn export(name: &[u8]) -> Option<(usize, Ptr)> {
    let i = EXPORTS.binary_search_by(|e| e.0.cmp(name)).ok()?;
    let (_, slot, address) = EXPORTS[i];
    Some((slot, address.0.cast_mut().cast()))
}
