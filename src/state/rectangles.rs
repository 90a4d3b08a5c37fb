//! Viewports and scissor rectangles, one or several.
#![forbid(unsafe_code)]

use crate::gl::{Gl, consts as c};

/// Where pictures are drawn. Rectangles are x, y, width, height in the program's window space (origin at the lower left).
#[derive(Clone, Debug, Default)]
pub struct Rectangles {
    /// GL_VIEWPORT (of index 0).
    pub viewport: [i32; 4],
    /// GL_SCISSOR_BOX (of index 0).
    pub scissor: [i32; 4],
    /// GL_SCISSOR_TEST (of index 0).
    pub scissor_test: bool,
    /// By index, where the program has set some by their index. Without that they are all the same, since glViewport and glScissor set all.
    pub indexed: Vec<Indexed>,
}

/// What the primitives of one gl_ViewportIndex are drawn to.
#[derive(Clone, Copy, Debug)]
pub struct Indexed {
    /// x, y, width, height in pixels, which may be fractions.
    pub viewport: [f32; 4],
    /// GL_SCISSOR_BOX.
    pub scissor: [i32; 4],
    /// GL_SCISSOR_TEST.
    pub scissor_test: bool,
}

impl Rectangles {
    /// Asks the driver; by index with `several`.
    pub fn ask(gl: &Gl, several: bool) -> Rectangles {
        let count = if several {
            gl.get_integer(c::MAX_VIEWPORTS) as u32
        } else {
            0
        };
        let indexed = (0..count).map(|index| Indexed {
            viewport: gl.get_floats_indexed(c::VIEWPORT, index),
            scissor: gl.get_integers_indexed(c::SCISSOR_BOX, index),
            scissor_test: gl.is_enabledi(c::SCISSOR_TEST, index),
        });
        Rectangles {
            viewport: gl.get_integers(c::VIEWPORT),
            scissor: gl.get_integers(c::SCISSOR_BOX),
            scissor_test: gl.is_enabled(c::SCISSOR_TEST),
            indexed: indexed.collect(),
        }
    }

    /// Sets again the viewport, and the scissor rectangle where it is in force: all that a draw moves which leaves the scissor test alone.
    pub fn put_in_force(&self, gl: &Gl) {
        if self.are_several() {
            return self.put(gl);
        }
        let [x, y, w, h] = self.viewport;
        gl.viewport(x, y, w, h);
        if self.scissor_test {
            let [x, y, w, h] = self.scissor;
            gl.scissor(x, y, w, h);
        }
    }

    /// Whether the program has set some by their index.
    pub fn are_several(&self) -> bool {
        !self.indexed.is_empty()
    }

    /// Sets all that the program has set, after the layer's own, which enable scissor tests and disable none.
    pub fn put(&self, gl: &Gl) {
        if !self.are_several() {
            let [x, y, w, h] = self.viewport;
            gl.viewport(x, y, w, h);
            let [x, y, w, h] = self.scissor;
            gl.scissor(x, y, w, h);
            if !self.scissor_test {
                gl.disable(c::SCISSOR_TEST);
            }
            return;
        }
        for (index, rectangles) in (0..).zip(&self.indexed) {
            rectangles.put(gl, index);
        }
    }
}

impl Indexed {
    /// Sets the rectangles of an index.
    pub fn put(&self, gl: &Gl, index: u32) {
        let [x, y, w, h] = self.viewport;
        gl.viewport_indexed_f(index, x, y, w, h);
        let [x, y, w, h] = self.scissor;
        gl.scissor_indexed(index, x, y, w, h);
        match self.scissor_test {
            true => gl.enablei(c::SCISSOR_TEST, index),
            false => gl.disablei(c::SCISSOR_TEST, index),
        }
    }
}
