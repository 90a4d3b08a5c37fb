//! Which drawable it is, and which one framebuffer 0 is read from.

/// Which drawable of the process it is. A number is never given to another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct DrawableId(pub u64);

/// What framebuffer 0 is read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reading {
    /// The canvas that is drawn to.
    Drawn,
    /// The parked canvas of another drawable.
    Parked(DrawableId),
    /// The true framebuffer 0: another drawable, which this context has not drawn to, or another one has since.
    True,
}
