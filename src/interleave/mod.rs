//! From N views to the picture that is shown.
//!
//! `reference` does it exactly on the CPU and is what the GPU is compared with; `shader` translates the passes of
//! `shaders/*.wgsl` for the program's context, `program` compiles them; `layout`, `anaglyph` and `depth` hold what both agree on; `gpu` draws.
#![forbid(unsafe_code)]

mod anaglyph;
pub mod cost;
mod depth;
mod gpu;
mod layout;
mod program;
#[cfg(feature = "cli")]
pub mod quilt;
pub mod reference;
pub mod shader;
mod sheet;
#[cfg(test)]
mod tests;

pub use anaglyph::Matrix;
pub use depth::{Depth, rgbd};
pub use gpu::{Glass, Interleaver, Source, glsl_version};
pub use layout::Layout;
pub use program::Program;

use crate::config::{Anaglyph, Config, Filter, Interlace, Output};
use crate::display::{Display, DisplayError, Mask, Placement};

/// How a picture is made of the views.
#[derive(Clone, Copy, Debug)]
pub enum Form<'a> {
    /// Each subpixel by the mask of a display; finely, where views are filtered.
    Panel(&'a Display, Filter),
    /// The first and the last view by pixels of the screen.
    Eyes(Interlace),
    /// Whole views beside each other.
    Layout(Layout),
    /// The first and the last view through coloured glasses.
    Anaglyph(Anaglyph),
    /// The own view beside its depth.
    Rgbd,
}

impl<'a> Form<'a> {
    /// What an output is made by.
    pub fn of(config: &'a Config, display: &'a Display, output: Output) -> Self {
        match output {
            Output::Panel => Self::Panel(display, config.filter),
            Output::Interlaced(interlace) => Self::Eyes(interlace),
            Output::SideBySide { half } => Self::Layout(Layout::SideBySide { half }),
            Output::TopBottom { half } => Self::Layout(Layout::TopBottom { half }),
            Output::Quilt => Self::Layout(Layout::quilt(config.views, config.display.facts.quilt)),
            Output::View(view) => Self::Layout(Layout::View(view)),
            Output::Anaglyph(anaglyph) => Self::Anaglyph(anaglyph),
            // The left eye's; the right one's is shown beside it, in another buffer.
            Output::Quad => Self::Layout(Layout::View(0)),
            Output::Rgbd => Self::Rgbd,
        }
    }

    /// The mask of a picture at a place; none where none is needed.
    fn mask(&self, placement: &Placement, views: u32) -> Option<Result<Mask, DisplayError>> {
        let made = match self {
            Self::Panel(display, Filter::Nearest) => display.mask(placement, views),
            Self::Panel(display, _) => display.fine_mask(placement, views),
            Self::Eyes(interlace) => match Display::named(interlace.display()) {
                Ok(display) => display.mask(placement, 2),
                Err(error) => return Some(Err(error)),
            },
            Self::Layout(_) | Self::Anaglyph(_) | Self::Rgbd => return None,
        };
        Some(made.map_err(DisplayError::from))
    }
}
