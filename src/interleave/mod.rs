//! From N views to the picture that is shown.
//!
//! `reference` does it exactly on the CPU and is what the GPU is compared with; `shader` translates the passes of
//! `shaders/*.wgsl` for the program's context, `program` compiles them; `layout` holds what both agree on; `gpu` draws.
#![forbid(unsafe_code)]

mod gpu;
mod layout;
mod program;
pub mod reference;
pub mod shader;
#[cfg(test)]
mod tests;

pub use gpu::{Interleaver, Source, glsl_version};
pub use layout::Layout;
pub use program::Program;

use crate::config::Output;

impl Layout {
    /// The layout of an output of whole views; `None` for the panel. `quilt` is the display's own: columns and rows.
    pub fn of(output: Output, views: u32, quilt: Option<(u32, u32)>) -> Option<Self> {
        match output {
            Output::Panel => None,
            Output::SideBySide => Some(Self::SideBySide),
            Output::Quilt => Some(Self::quilt(views, quilt)),
            Output::View(view) => Some(Self::View(view)),
        }
    }
}
