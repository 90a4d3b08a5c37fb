//! A draw plus state in, a [`Plan`] value out: which views, which parallax, which strategy. Calls no GL.
#![forbid(unsafe_code)]

pub mod camera;
pub mod class;
pub mod clip_form;
pub mod comfort;
pub mod cut;
pub mod decide;
pub mod depths;
pub mod frustum;
mod governor;
pub mod orthographic;
pub mod parallax;
pub mod reason;
pub mod trial;

pub use class::{Classed, Classifier, SceneDepths, Traits};
pub use comfort::Comfort;
pub use cut::{Cuts, Pose};
pub use decide::{Decision, Facts, Flat, Known, Method, Plan, Preparation, Settings, decide};
pub use depths::{DepthMappings, Ramp};
pub use frustum::Bounds;
pub use governor::Governor;
pub use orthographic::{Planes, Slant, Slanting};
pub use parallax::{Along, Rig, Shear};
pub use reason::{Reason, Unrepresentable};
pub use trial::Trial;

/// The kind of the program's command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// glBegin … glEnd of one primitive mode.
    Begin(u32),
    /// glDrawArrays of one mode.
    Arrays(u32),
    /// glDrawElements of one mode.
    Elements(u32),
    /// Any other draw from arrays, rectangles, evaluator meshes.
    Other,
    /// glClear and its kin.
    Clear {
        /// It clears depths as well; assumed where the call does not say so.
        depths: bool,
        /// The buffers, as bits of glClear, that it certainly clears where no mask is set.
        whole: u32,
    },
    /// Display lists.
    List,
    /// glDrawPixels, glBitmap and glCopyPixels, which draw at the raster position.
    Pixels,
    /// Accumulation buffer.
    Accum,
}
