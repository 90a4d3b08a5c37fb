//! What views are drawn to: the window's tiles, or framebuffers of the program's that each view has its own of.

use super::{Atlas, Tiles};
use crate::gl::Gl;
use crate::view::ViewIndex;

/// Where each view is drawn.
pub trait Surface {
    /// The places of the views.
    fn tiles(&self) -> Tiles;

    /// Binds what a view is drawn to and answers the x offset of its tile in pixels.
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
