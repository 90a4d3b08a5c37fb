//! The surfaces that views are drawn to: the tiles of the window, or the framebuffers that the program's one is split into.

use super::{Atlas, Tiles};
use crate::gl::Gl;
use crate::view::ViewIndex;

/// A surface with a place for each view.
pub trait Surface {
    /// The places of the views.
    fn tiles(&self) -> Tiles;

    /// Binds the framebuffer of a view for drawing and returns the x offset of its tile in pixels.
    fn enter(&mut self, gl: &Gl, view: ViewIndex) -> i32;

    /// Binds a layer for drawing.
    fn bind_row(&mut self, gl: &Gl, row: u32);
}

impl Surface for Atlas {
    fn tiles(&self) -> Tiles {
        self.tiles
    }

    fn enter(&mut self, gl: &Gl, view: ViewIndex) -> i32 {
        Atlas::enter(self, gl, view)
    }

    fn bind_row(&mut self, gl: &Gl, row: u32) {
        Atlas::bind_row(self, gl, row);
    }
}
