//! The record of a context of the program.

use crate::drawable::{Drawable, Pair};
use crate::geometry::Seen;
use crate::messages::Receiver;
use crate::provider::Provider;
use crate::viewports::Viewports;
use core::cell::{Cell, OnceCell, RefCell};
use manyview_core::gl::shadow::{ContextShadow, Shared};
use manyview_core::gl::{Gl, Ptr};
use manyview_core::layer::{Frames, Layer};

/// Identifies a context of the program: handles are unique only within a provider.
pub(crate) type Key = (Provider, Ptr);

/// One context of the program, from its first MakeCurrent to its destruction. Only the thread that has it current uses the record.
pub(crate) struct Context {
    pub(crate) key: Key,
    /// The driver's functions, from the first time that the context was current.
    pub(crate) gl: OnceCell<Gl>,
    /// The state that the driver has, as far as it is known.
    pub(crate) shadow: ContextShadow,
    /// Those that it was last current with; none where it was current without any.
    pub(crate) drawables: Cell<Option<Pair>>,
    /// The program's debug callback, once it has set one.
    pub(crate) receiver: OnceCell<&'static Receiver>,
    /// Borrowed by the hook at work: a call from inside the layer or the driver finds it borrowed and passes.
    pub(crate) work: RefCell<Work>,
}

/// The state that hooks work on.
pub(crate) struct Work {
    /// The last known place of the window, for outputs that follow it.
    pub(crate) seen: Option<Seen>,
    /// Sizes of viewports since the last change of the drawable's size.
    pub(crate) viewports: Viewports,
    pub(crate) layer: Option<Box<Layer>>,
    /// The context cannot be shown in several views; it is not tried again.
    pub(crate) refused: bool,
    /// In place of the layer where frames are only counted and captured.
    pub(crate) frames: Option<Frames>,
    /// The end of the process is watched from the first draw on.
    pub(crate) watched: bool,
}

impl Context {
    pub(crate) fn new(key: Key, drawables: Option<Pair>, shared: Shared) -> Context {
        Context {
            key,
            shadow: ContextShadow::new(key.0.real(), shared),
            gl: OnceCell::new(),
            drawables: Cell::new(drawables),
            receiver: OnceCell::new(),
            work: RefCell::new(Work {
                seen: None,
                viewports: Viewports::default(),
                watched: false,
                layer: None,
                refused: false,
                frames: None,
            }),
        }
    }

    /// The drawable that it draws to.
    pub(crate) fn draws_to(&self) -> Option<Drawable> {
        self.drawables.get().map(|drawables| drawables.draw)
    }
}
