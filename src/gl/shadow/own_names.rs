//! Names of the layer's own textures, in all contexts of a share group: a program that numbers its textures itself may take one that the layer
//! of another context uses (docs/decisions/0014-names-of-our-objects.md).

use super::with;
use crate::gl::TextureName;
use core::sync::atomic::{AtomicBool, Ordering::Relaxed};
use rustc_hash::FxHashSet;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

#[derive(Debug, Default)]
struct Kept {
    textures: Mutex<FxHashSet<TextureName>>,
    taken: AtomicBool,
}

/// The names of one share group.
#[derive(Clone, Debug, Default)]
pub(super) struct OwnNames(Arc<Kept>);

impl OwnNames {
    fn textures(&self) -> MutexGuard<'_, FxHashSet<TextureName>> {
        let textures = self.0.textures.lock();
        textures.unwrap_or_else(PoisonError::into_inner)
    }
}

fn names() -> Option<OwnNames> {
    with(|shadow| shadow.own_names.clone())
}

/// A layer uses the name from now on.
pub(in crate::gl) fn texture_used(name: TextureName) {
    if let Some(names) = names() {
        names.textures().insert(name);
    }
}

/// A layer uses the name no more. False where the program has taken it.
pub(in crate::gl) fn texture_left(name: TextureName) -> bool {
    names().is_none_or(|names| names.textures().remove(&name))
}

/// The program takes a name that a layer of the group uses.
pub(in crate::gl) fn texture_taken(name: TextureName) {
    if let Some(names) = names() {
        names.textures().remove(&name);
        names.0.taken.store(true, Relaxed);
    }
}

/// Whether a layer of the current context's share group uses a texture of this name.
#[must_use]
pub fn is_own_texture(name: TextureName) -> bool {
    names().is_some_and(|names| names.textures().contains(&name))
}

/// Whether the program has taken a name that a layer of the current context's share group used.
#[must_use]
pub fn are_textures_taken() -> bool {
    with(|shadow| shadow.own_names.0.taken.load(Relaxed)) == Some(true)
}
