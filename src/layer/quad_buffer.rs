//! The picture that each buffer of the true framebuffer 0 gets: a stereo window has one buffer for each eye.

use super::Layer;
use crate::config::Output;
use crate::gl::consts as c;
use crate::state::FRONT;

const NO_STEREO: &str = "output is 'quad', but the window has no left and right buffer (GL_STEREO, which no window of EGL has): the first view is shown; \
                         choose another output, such as anaglyph or half-sbs";

impl Layer {
    /// The buffers of an output, each with the output that is drawn to it; `None` stands for the buffer that is drawn to already. `image` is
    /// the image of the atlas that is shown, its front or back buffer.
    pub(super) fn pictures(&mut self, output: Output, image: u32) -> Vec<(Option<u32>, Output)> {
        let window = &self.state.window;
        if output != Output::Quad {
            return vec![(None, output)];
        }
        if !window.buffers.stereo {
            self.diagnostics.report.note(NO_STEREO.into());
            return vec![(None, Output::View(0))];
        }
        let [left, right] = if image == FRONT || !window.buffers.double_buffered {
            [c::FRONT_LEFT, c::FRONT_RIGHT]
        } else {
            [c::BACK_LEFT, c::BACK_RIGHT]
        };
        let last = self.session.config.views - 1;
        vec![
            (Some(left), Output::View(0)),
            (Some(right), Output::View(last)),
        ]
    }
}
