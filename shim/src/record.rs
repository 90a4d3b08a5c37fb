//! What is kept of a context of the program.

use crate::drawable::Drawable;
use crate::geometry::Seen;
use crate::provider::Provider;
use crate::viewports::Viewports;
use core::cell::{Cell, OnceCell, RefCell};
use manyview_core::gl::{Gl, Ptr};
use manyview_core::layer::{Frames, Layer};

/// A context of the program: handles are those of one provider.
pub(crate) type Key = (Provider, Ptr);

/// One context of the program, from its first MakeCurrent to its destruction. Only the thread that has it current looks at it.
pub(crate) struct Context {
    pub(crate) key: Key,
    /// Its driver, from when it was first current.
    pub(crate) gl: OnceCell<Gl>,
    pub(crate) drawable: Cell<Drawable>,
    /// Whoever works with it has it alone: a call from inside the layer or the driver finds it borrowed.
    pub(crate) work: RefCell<Work>,
}

/// What hooks work with.
pub(crate) struct Work {
    /// Where the window was, for outputs that follow it.
    pub(crate) seen: Option<Seen>,
    /// Sizes of viewports since the drawable's size was another one.
    pub(crate) viewports: Viewports,
    pub(crate) layer: Option<Layer>,
    /// With one view: only frames are counted and captured.
    pub(crate) frames: Option<Frames>,
}

impl Context {
    pub(crate) fn new(key: Key, drawable: Drawable) -> Context {
        Context {
            key,
            gl: OnceCell::new(),
            drawable: Cell::new(drawable),
            work: RefCell::new(Work {
                seen: None,
                viewports: Viewports::default(),
                layer: None,
                frames: None,
            }),
        }
    }
}
