//! All drawables of the program, and which context has drawn their newest contents.

use crate::drawable::Drawable;
use crate::provider::Provider;
use crate::record::Key;
use core::ffi::c_ulong;
use manyview_core::gl::Ptr;
use manyview_core::layer::DrawableId;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The identity of the program's memory (OSMesa), of which a context has one at a time.
const MEMORY: DrawableId = DrawableId(0);

/// The handles of a drawable, as numbers because other threads read them: that of its display, and its own.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Handles {
    Glx(usize, c_ulong),
    Egl(usize, usize),
}

struct Entry {
    handles: Handles,
    id: DrawableId,
    /// The context that has drawn what the drawable holds; none where that was shown, and may be anything.
    newest: Option<(Provider, usize)>,
}

struct Drawables {
    last: u64,
    entries: Vec<Entry>,
}

static DRAWABLES: Mutex<Drawables> = Mutex::new(Drawables {
    last: 0,
    entries: Vec::new(),
});

fn drawables() -> MutexGuard<'static, Drawables> {
    DRAWABLES.lock().unwrap_or_else(PoisonError::into_inner)
}

fn handles(drawable: Drawable) -> Option<Handles> {
    match drawable {
        Drawable::Glx(display, drawable) => Some(Handles::Glx(display as usize, drawable)),
        Drawable::Egl(display, surface) => Some(Handles::Egl(display as usize, surface as usize)),
        Drawable::Memory(..) => None,
    }
}

/// The identity of a drawable, which it gets when it is first current.
pub(crate) fn id(drawable: Drawable) -> DrawableId {
    let Some(handles) = handles(drawable) else {
        return MEMORY;
    };
    let mut drawables = drawables();
    if let Some(known) = drawables.entries.iter().find(|e| e.handles == handles) {
        return known.id;
    }
    drawables.last += 1;
    let id = DrawableId(drawables.last);
    drawables.entries.push(Entry {
        handles,
        id,
        newest: None,
    });
    id
}

/// The identity of a drawable that has been current.
pub(crate) fn known(drawable: Drawable) -> Option<DrawableId> {
    let handles = handles(drawable)?;
    let drawables = drawables();
    let mut entries = drawables.entries.iter();
    entries.find(|e| e.handles == handles).map(|e| e.id)
}

/// Whether the program still has a drawable. Of a window that is its own drawable nobody tells when it is destroyed.
pub(crate) fn lives(id: DrawableId) -> bool {
    id == MEMORY || drawables().entries.iter().any(|e| e.id == id)
}

/// A context has drawn the newest contents of a drawable, or (none) they were shown.
pub(crate) fn drawn_by(id: DrawableId, context: Option<Key>) {
    let mut drawables = drawables();
    if let Some(entry) = drawables.entries.iter_mut().find(|e| e.id == id) {
        entry.newest = context.map(|(provider, handle)| (provider, handle as usize));
    }
}

/// Whether another context has drawn the newest contents of a drawable.
pub(crate) fn drawn_elsewhere(id: DrawableId, (provider, handle): Key) -> bool {
    let drawables = drawables();
    let found = drawables.entries.iter().find(|e| e.id == id);
    let newest = found.and_then(|e| e.newest);
    newest.is_some_and(|newest| newest != (provider, handle as usize))
}

/// The program has destroyed a drawable.
pub(crate) fn gone(drawable: Drawable) {
    let handles = handles(drawable);
    drawables().entries.retain(|e| Some(e.handles) != handles);
}

/// The program has ended the use of an EGLDisplay, and of all its surfaces.
pub(crate) fn terminated(display: Ptr) {
    let of = display as usize;
    let is_of = |e: &Entry| matches!(e.handles, Handles::Egl(display, _) if display == of);
    drawables().entries.retain(|e| !is_of(e));
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::ptr::without_provenance_mut;

    fn window(number: c_ulong) -> Drawable {
        Drawable::Glx(without_provenance_mut(0x77), number)
    }

    #[test]
    fn a_drawable_with_the_handle_of_another_one_is_not_that() {
        let first = id(window(0x31));
        assert_eq!(id(window(0x31)), first);
        assert_ne!(id(window(0x32)), first);
        gone(window(0x31));
        assert!(!lives(first) && known(window(0x31)).is_none());
        assert_ne!(id(window(0x31)), first);
    }

    #[test]
    fn contents_belong_to_the_context_that_has_drawn_last() {
        let context = |number| (Provider::Gl, without_provenance_mut(number));
        let id = id(window(0x41));
        assert!(!drawn_elsewhere(id, context(1)));
        drawn_by(id, Some(context(1)));
        assert!(!drawn_elsewhere(id, context(1)) && drawn_elsewhere(id, context(2)));
        drawn_by(id, None);
        assert!(!drawn_elsewhere(id, context(2)));
    }

    #[test]
    fn surfaces_go_with_their_display() {
        let surface = |display, handle| {
            Drawable::Egl(
                without_provenance_mut(display),
                without_provenance_mut(handle),
            )
        };
        let ids = [(0x51, 1), (0x52, 1)].map(|(display, handle)| id(surface(display, handle)));
        terminated(without_provenance_mut(0x51));
        assert_eq!(ids.map(lives), [false, true]);
    }
}
