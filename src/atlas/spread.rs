//! Tiles whose texels are not the window's pixels, stretched to the window's size: for reads, and for a change of the grid.

use super::{Atlas, Names, ViewSet};
use crate::gl::{FramebufferName, Gl, consts as c};
use crate::state::Window;
use crate::view::ViewIndex;

const ALL: u32 = c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT | c::STENCIL_BUFFER_BIT;

impl Atlas {
    /// Stretches a view's tile over a framebuffer of the window's size, each pixel from the nearest texel or a neighbour of it. Binds the
    /// single-sampled tile for reading and that framebuffer for drawing; the scissor test must be off.
    pub(super) fn spread(&self, gl: &Gl, view: ViewIndex, to: FramebufferName) {
        self.resolve(gl, &ViewSet::ALL, ALL);
        let (from, x) = self.readable(view);
        let (tiles, grid) = (&self.tiles, &self.tiles.grid);
        let [_, height] = tiles.window.map(|side| side as i32);
        let [corner_x, corner_y] = grid.corner(view);
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
        // The left and the right edge of the tile at a row of the window, in pixels of the window.
        let ends = |row: i32| {
            let aside = grid.shear * (f64::from(row) + 0.5) + corner_x;
            [0.0, f64::from(tiles.width)]
                .map(|column| ((column - aside) / grid.across).round() as i32)
        };
        let mut first = 0;
        while first < height {
            let [left, right] = ends(first);
            let alike = |row: &i32| ends(*row) == [left, right];
            let next = (first + 1..height)
                .take_while(alike)
                .last()
                .map_or(first + 1, |row| row + 1);
            let [low, high] = if grid.shear == 0.0 {
                [0, tiles.height as i32]
            } else {
                [first, next].map(|row| (grid.up * f64::from(row) + corner_y).round() as i32)
            };
            let [bottom, top] = if grid.shear == 0.0 {
                [low, high].map(|row| ((f64::from(row) - corner_y) / grid.up).round() as i32)
            } else {
                [first, next]
            };
            let width = tiles.width as i32;
            if high > low {
                gl.blit_framebuffer(
                    x,
                    low,
                    x + width,
                    high,
                    left,
                    bottom,
                    right,
                    top,
                    ALL,
                    c::NEAREST,
                );
            }
            first = if grid.shear == 0.0 { height } else { next };
        }
    }

    /// Copies the contents of `other`, an atlas of the same window with another grid or layout. Between grids they pass through the window's
    /// pixels, so detail may be lost. Changes the bindings that [`Atlas::new`] does and those of framebuffers; the scissor test must be off.
    pub fn copy_spread(&mut self, gl: &Gl, other: &mut Atlas, names: &mut Names, window: &Window) {
        if self.tiles.grid == other.tiles.grid {
            return self.copy_views(gl, other);
        }
        if self.multisampled() {
            // A blit to a multisampled framebuffer cannot stretch, so the contents are lost.
            return;
        }
        other.make_singles(gl, names, window, false);
        let [width, height] = self.tiles.window.map(|side| side as i32);
        for view in self.tiles.order() {
            other.take_single(gl, view, c::COLOR_ATTACHMENT0);
            let (to, x) = self.target(view);
            let (right, top) = (x + self.tiles.width as i32, self.tiles.height as i32);
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
            gl.blit_framebuffer(0, 0, width, height, x, 0, right, top, ALL, c::NEAREST);
        }
    }

    fn copy_views(&self, gl: &Gl, other: &Atlas) {
        let (w, h) = (self.tiles.width as i32, self.tiles.height as i32);
        for view in self.tiles.order() {
            let ((from, x), (to, to_x)) = (other.target(view), self.target(view));
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
            gl.blit_framebuffer(x, 0, x + w, h, to_x, 0, to_x + w, h, ALL, c::NEAREST);
        }
    }
}
