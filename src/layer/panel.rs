//! The picture for the panel's own window. The program's window keeps a picture of its own size.

use super::{Layer, keep_bindings};
use crate::atlas::{PanelFormat, PanelImage};
use crate::config::Output;
use crate::gl::{FramebufferName, Gl, consts as c};
use crate::interleave::Depth;
use crate::state::Neutral;

/// The part of a picture that is on the panel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PanelPicture {
    /// Left and top in pixels of the panel, from its upper left corner.
    pub at: [u32; 2],
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Blue, green, red and a byte without meaning for each pixel; rows from the bottom up.
    pub pixels: Vec<u8>,
}

impl PanelPicture {
    /// The rows from the top down.
    pub fn rows(&self) -> impl Iterator<Item = &[u8]> {
        let row = (self.size[0] as usize * 4).max(1);
        self.pixels.chunks_exact(row).rev()
    }
}

impl Layer {
    /// Sets width and height of the panel's own window, in pixels; none where the output is shown in the program's window. To be called before a frame
    /// is shown.
    pub fn set_panel(&mut self, panel: Option<(u32, u32)>) {
        self.session.panel = panel;
    }

    /// Takes the picture for the panel's own window, if the last frame had one.
    pub fn take_panel_picture(&mut self) -> Option<PanelPicture> {
        self.session.panel_picture.take()
    }

    /// What the program's window shows while the panel has its own, unless that is the program's own view.
    pub(super) fn window_output(&self) -> Option<Output> {
        let config = self.session.config.panel.as_ref();
        config
            .filter(|_| self.session.panel.is_some())
            .and_then(|panel| panel.output)
    }

    /// Draws the output for the panel's own window, and reads it back. Leaves the true framebuffer 0 bound.
    pub(super) fn draw_panel(
        &mut self,
        gl: &Gl,
        image: u32,
        depth: Option<&Depth>,
        neutral: &Neutral,
    ) {
        let Some((width, height)) = self.session.panel else {
            return;
        };
        let placement = self.placement();
        let format = PanelFormat {
            size: (placement.width, placement.height),
            srgb: self.state.window.srgb,
        };
        let Some(framebuffer) = self.panel_framebuffer(gl, format) else {
            return;
        };
        let output = match self.output() {
            // The panel's window has one buffer.
            Output::Quad => Output::View(0),
            output => output,
        };
        gl.bind_framebuffer(c::FRAMEBUFFER, framebuffer);
        self.draw_output(gl, image, depth, neutral, (output, placement));
        // What hangs over the panel's sides is not read.
        let visible = |at: i32, side: u32, panel: u32| {
            let end = (at + side as i32).min(panel as i32);
            [at.max(0), end].map(|edge| edge.max(0).unsigned_abs())
        };
        let [left, right] = visible(placement.x, placement.width, width);
        let [top, bottom] = visible(placement.y, placement.height, height);
        let size = [right.saturating_sub(left), bottom.saturating_sub(top)];
        let from = [
            left as i32 - placement.x,
            placement.y + placement.height as i32 - bottom as i32,
        ];
        let mut picture = PanelPicture {
            at: [left, top],
            size,
            pixels: std::mem::take(&mut self.session.panel_pixels),
        };
        let bytes = size[0] as usize * size[1] as usize * 4;
        picture.pixels.resize(bytes, 0);
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, framebuffer);
        gl.read_bgra(neutral.pixels(), from, size, &mut picture.pixels);
        gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
        self.session.panel_picture = Some(picture);
    }

    /// Gives the memory of a picture back, for the next one.
    pub fn recycle_panel_picture(&mut self, picture: PanelPicture) {
        self.session.panel_pixels = picture.pixels;
    }

    /// The framebuffer of the image for the panel, which is made anew where another one is needed.
    fn panel_framebuffer(&mut self, gl: &Gl, format: PanelFormat) -> Option<FramebufferName> {
        let known = self.targets.panel.as_ref();
        if known.is_none_or(|panel| panel.format() != format) {
            if let Some(old) = self.targets.panel.take() {
                old.delete(gl);
            }
            self.state.keep_errors(gl);
            let names = &mut self.targets.names;
            let made = keep_bindings(gl, || PanelImage::new(gl, names, format));
            // The program must not see the errors of the attempt.
            if gl.drop_errors() > 0 || !made.is_complete() {
                let (width, height) = format.size;
                self.diagnostics.announce(format!(
                    "the driver makes no image of {width} x {height} for the panel's window, which stays as it is"
                ));
            }
            self.targets.panel = Some(made);
        }
        let panel = self.targets.panel.as_ref();
        panel
            .filter(|panel| panel.is_complete())
            .map(PanelImage::framebuffer)
    }
}
