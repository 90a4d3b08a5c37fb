//! From N views to the picture that is shown.
//!
//! `reference` computes the exact picture on the CPU, with which tests compare the GPU. `pass` names the passes of `shaders/*.wgsl`, `shader`
//! translates them for the program's context, and `program` compiles them. `layout`, `anaglyph`, `depth` and `disparities` hold the parameters of
//! both. `gpu` draws.
#![forbid(unsafe_code)]

mod anaglyph;
pub mod cost;
mod depth;
mod disparities;
mod gpu;
mod layout;
mod pass;
mod picture;
mod program;
#[cfg(feature = "cli")]
pub mod quilt;
pub mod reference;
pub mod shader;
#[cfg(test)]
mod shader_tests;
mod sheet;
mod sources;
#[cfg(test)]
mod tests;
mod uniforms;
pub mod wall;

pub use anaglyph::Matrix;
pub use depth::{Depth, rgbd};
pub use disparities::{Cleared, Disparities, Places};
pub use gpu::{Interleaver, PanelPlacement, Source, bind_reference, glsl_version};
pub use layout::Layout;
pub use picture::Picture;
pub use program::Program;
pub use sources::Sources;

use crate::atlas::Grid;
use crate::config::{Anaglyph, Config, Filter, Interlace, Output};
use crate::display::{Display, DisplayError, Fit, Kind, Mask, Placement, Wall};

/// How the views are arranged in the picture.
#[derive(Clone, Copy, Debug)]
pub enum Form<'a> {
    /// Each subpixel by the mask of a display; by its fine mask where views are filtered.
    Panel(&'a Display, Filter),
    /// Each subpixel by the masks of a wall's panels, where their warps take it in the picture.
    Wall(&'a Wall, Fit),
    /// The first and the last view, by the pixels of the screen.
    Interlaced(Interlace),
    /// Whole views beside each other.
    Layout(Layout),
    /// The first and the last view through coloured glasses.
    Anaglyph(Anaglyph),
    /// The own view beside its depth.
    Rgbd,
}

impl<'a> Form<'a> {
    /// The form of an output.
    pub fn of(config: &'a Config, display: &'a Display, output: Output) -> Self {
        if let Some(layout) = Layout::of(config, output) {
            return Self::Layout(layout);
        }
        match output {
            Output::Interlaced(interlace) => Self::Interlaced(interlace),
            Output::Anaglyph(anaglyph) => Self::Anaglyph(anaglyph),
            Output::Rgbd => Self::Rgbd,
            _ => match &display.kind {
                Kind::Wall(wall) => {
                    let fit = config.panel.as_ref().map(|panel| panel.fit);
                    Self::Wall(wall, fit.unwrap_or_default())
                }
                _ => Self::Panel(display, config.filter),
            },
        }
    }

    /// The grid of sample-aligned tiles: a column, or a row, of texels for each lens of a picture at a place. None where the lenses do not repeat
    /// regularly.
    pub fn sample_aligned(&self, placement: &Placement, views: u32) -> Option<Grid> {
        let window = [placement.width, placement.height];
        match self {
            Self::Panel(display, Filter::Nearest) => {
                let phase = display.lens_phase(placement, views)?;
                Grid::sample_aligned(&phase, window, f64::from(views), 1.0)
            }
            Self::Interlaced(interlace) => {
                let display = Display::named(interlace.display()).ok()?;
                let phase = display.lens_phase(placement, 2)?;
                // The right eye sees the last view.
                Grid::sample_aligned(&phase, window, 2.0, 1.0 / f64::from(views.max(2) - 1))
            }
            _ => None,
        }
    }

    /// Width and height of a tile over those of the picture, such that a tile has as many texels as the picture shows of a view.
    pub fn share(&self, views: u32) -> [f64; 2] {
        let n = f64::from(views);
        match self {
            Self::Panel(display, _) => {
                let whole = Placement::full_screen(1, 1);
                let phase = display.lens_phase(&whole, views);
                // Each colour of a pixel may show another view.
                let shown = phase.map_or(3.0, |phase| if phase.colour == 0.0 { 1.0 } else { 3.0 });
                [(shown / n).sqrt().min(1.0); 2]
            }
            Self::Interlaced(Interlace::Rows) => [1.0, 0.5],
            Self::Interlaced(Interlace::Columns) => [0.5, 1.0],
            Self::Interlaced(Interlace::Checkerboard) => [0.5_f64.sqrt(); 2],
            Self::Layout(layout) => {
                let (columns, rows) = layout.grid(views);
                [1.0 / f64::from(columns), 1.0 / f64::from(rows)]
            }
            Self::Wall(..) | Self::Anaglyph(_) | Self::Rgbd => [1.0; 2],
        }
    }

    /// The mask of a picture at a place. None where the form needs none.
    fn mask(&self, placement: &Placement, views: u32) -> Option<Result<Mask, DisplayError>> {
        let made = match self {
            Self::Panel(display, Filter::Nearest) => display.mask(placement, views),
            Self::Panel(display, _) => display.fine_mask(placement, views),
            Self::Wall(wall, _) => wall.mask(placement, views),
            Self::Interlaced(interlace) => match Display::named(interlace.display()) {
                Ok(display) => display.mask(placement, 2),
                Err(error) => return Some(Err(error)),
            },
            Self::Layout(_) | Self::Anaglyph(_) | Self::Rgbd => return None,
        };
        Some(made.map_err(DisplayError::from))
    }
}
