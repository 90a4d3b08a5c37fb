//! The picture for the panel's own window. The program's window keeps a picture of its own size.
//!
//! A picture is read back without waiting for the driver: it arrives with one of the next frames. Programs that show frames rarely get theirs at once,
//! since waiting costs them little, and since the next frame may never come.

use super::{Layer, keep_bindings};
use crate::atlas::{PanelFormat, PanelImage, PanelPlace};
use crate::config::Output;
use crate::display::Placement;
use crate::gl::{FramebufferName, Gl, consts as c};
use crate::interleave::Depth;
use crate::present::capture;
use crate::state::Neutral;
use image::RgbImage;
use image::imageops::replace;
use std::time::{Duration, Instant};

/// A program that has shown no frame for so long waits for its picture.
const RARE: Duration = Duration::from_millis(50);

/// Whether the panel's window takes the picture of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Takes {
    /// At once.
    #[default]
    Now,
    /// When it has shown those that it has.
    Later,
    /// Never: it shows another window of the program, or there is none and pictures are only captured.
    Never,
}

/// What the layer knows of the panel's own window.
#[derive(Debug, Default)]
pub(super) struct Panel {
    /// Width and height in pixels; none where the program's window is on the panel.
    pub(super) size: Option<(u32, u32)>,
    takes: Takes,
    /// For the window, until it is taken.
    frame: Option<PanelFrame>,
    /// Memory for the next picture.
    pixels: Vec<u8>,
    /// When the last frame was shown.
    shown: Option<Instant>,
}

/// What a frame gives to the panel's own window.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PanelFrame {
    /// A picture, of this frame or of one before.
    pub picture: Option<PanelPicture>,
    /// The picture of this frame comes later, or is left out because the window is behind.
    pub is_behind: bool,
}

/// The part of a picture that is on the panel.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PanelPicture {
    /// Where it is.
    pub place: PanelPlace,
    /// Blue, green, red and a byte without meaning for each pixel; rows from the bottom up.
    pub pixels: Vec<u8>,
}

impl PanelPicture {
    /// The rows from the top down.
    pub fn rows(&self) -> impl Iterator<Item = &[u8]> {
        let row = (self.place.size[0] as usize * 4).max(1);
        self.pixels.chunks_exact(row).rev()
    }
}

impl Layer {
    /// Sets width and height of the panel's own window, in pixels; none where the output is shown in the program's window. To be called before a frame
    /// is shown.
    pub fn set_panel(&mut self, size: Option<(u32, u32)>, takes: Takes) {
        (self.session.panel.size, self.session.panel.takes) = (size, takes);
    }

    /// Takes what the last frame has for the panel's own window.
    pub fn take_panel_frame(&mut self) -> Option<PanelFrame> {
        self.session.panel.frame.take()
    }

    /// Gives the memory of a picture back, for the next one.
    pub fn recycle_panel_picture(&mut self, picture: PanelPicture) {
        self.session.panel.pixels = picture.pixels;
    }

    /// What the program's window shows while the panel has its own, unless that is the program's own view.
    pub(super) fn window_output(&self) -> Option<Output> {
        let config = self.session.config.panel.as_ref();
        config
            .filter(|_| self.session.panel.size.is_some())
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
        let Some(panel) = self.session.panel.size else {
            return;
        };
        if self.session.panel.takes == Takes::Never {
            // What is on its way is older than what the panel shows then.
            if let Some(panel) = &mut self.targets.panel {
                panel.forget(gl);
            }
            return;
        }
        let now = Instant::now();
        let before = self.session.panel.shown.replace(now);
        let rare = before.is_none_or(|before| now - before >= RARE);
        let mut picture = self.arrived(gl);
        let mut is_behind = self.session.panel.takes == Takes::Later && !rare;
        if !is_behind {
            let Some((output, placement)) = self.draw_on_panel(gl, image, depth, neutral) else {
                return;
            };
            let size = (placement.width, placement.height);
            self.draw_osd(gl, neutral, image, (output, size.into()));
            let (place, from) = visible([placement.x, placement.y], size, panel);
            let sent = !rare && self.send(gl, neutral, from, place);
            if !sent {
                picture = Some(self.read_picture(gl, neutral, from, place));
            }
            is_behind = sent;
            gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
        }
        self.session.panel.frame = Some(PanelFrame { picture, is_behind });
    }

    /// Draws the output into the image for the panel, and binds that. None where the driver makes no such image.
    fn draw_on_panel(
        &mut self,
        gl: &Gl,
        image: u32,
        depth: Option<&Depth>,
        neutral: &Neutral,
    ) -> Option<(Output, Placement)> {
        let placement = self.placement();
        let format = PanelFormat {
            size: (placement.width, placement.height),
            srgb: self.state.window.srgb,
        };
        let framebuffer = self.panel_framebuffer(gl, format)?;
        let output = match self.output() {
            // The panel's window has one buffer.
            Output::Quad => Output::View(0),
            output => output,
        };
        gl.bind_framebuffer(c::FRAMEBUFFER, framebuffer);
        self.draw_output(gl, image, depth, neutral, (output, placement));
        Some((output, placement))
    }

    /// The picture of the whole panel, without the on-screen display. None where the panel has no window of its own. Changes the framebuffers that
    /// are bound.
    pub(super) fn panel_picture(
        &mut self,
        gl: &Gl,
        image: u32,
        depth: Option<&Depth>,
        neutral: &Neutral,
    ) -> Option<RgbImage> {
        let (width, height) = self.session.panel.size?;
        let (_, placement) = self.draw_on_panel(gl, image, depth, neutral)?;
        let drawn = capture::read_rgb(gl, neutral, 0, 0, placement.width, placement.height);
        let mut whole = RgbImage::new(width, height);
        replace(&mut whole, &drawn, placement.x.into(), placement.y.into());
        Some(whole)
    }

    /// The picture of a frame before, if one has arrived.
    fn arrived(&mut self, gl: &Gl) -> Option<PanelPicture> {
        let panel = self.targets.panel.as_mut()?;
        let mut pixels = std::mem::take(&mut self.session.panel.pixels);
        match panel.receive(gl, &mut pixels) {
            Some(place) => Some(PanelPicture { place, pixels }),
            None => {
                self.session.panel.pixels = pixels;
                None
            }
        }
    }

    /// Starts to read the picture. False where the driver cannot do that without waiting.
    fn send(&mut self, gl: &Gl, neutral: &Neutral, from: [i32; 2], place: PanelPlace) -> bool {
        let Some(panel) = &mut self.targets.panel else {
            return false;
        };
        if !panel.has_buffers() && gl.since((3, 2), Some((3, 0))) {
            self.state.keep_errors(gl);
            panel.make_buffers(gl);
            if gl.drop_errors() > 0 {
                return false;
            }
        }
        panel.send(gl, neutral, from, place)
    }

    /// Reads the picture, which waits for the driver.
    fn read_picture(
        &mut self,
        gl: &Gl,
        neutral: &Neutral,
        from: [i32; 2],
        place: PanelPlace,
    ) -> PanelPicture {
        let mut pixels = std::mem::take(&mut self.session.panel.pixels);
        pixels.resize(place.bytes(), 0);
        if let Some(panel) = &mut self.targets.panel {
            panel.forget(gl);
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, panel.framebuffer());
            gl.read_bgra(neutral.pixels(), from, place.size, &mut pixels);
        }
        PanelPicture { place, pixels }
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

/// The part of a picture that is on the panel, where it may hang over the panel's sides, and where that part begins in the picture: x and y from its lower
/// left corner. `at`: left and top on the panel; all in pixels.
fn visible(at: [i32; 2], size: (u32, u32), panel: (u32, u32)) -> (PanelPlace, [i32; 2]) {
    let part = |at: i32, side: u32, panel: u32| {
        let end = (at + side as i32).min(panel as i32);
        [at.max(0), end].map(|edge| edge.max(0).unsigned_abs())
    };
    let [left, right] = part(at[0], size.0, panel.0);
    let [top, bottom] = part(at[1], size.1, panel.1);
    let place = PanelPlace {
        at: [left, top],
        size: [right.saturating_sub(left), bottom.saturating_sub(top)],
    };
    let from = [left as i32 - at[0], at[1] + size.1 as i32 - bottom as i32];
    (place, from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_hangs_over_the_panel_is_not_read() {
        let inside = visible([10, 20], (30, 40), (100, 100));
        assert_eq!(
            inside.0,
            PanelPlace {
                at: [10, 20],
                size: [30, 40]
            }
        );
        assert_eq!(inside.1, [0, 0]);
        let over = visible([-10, -20], (120, 150), (100, 100));
        assert_eq!(
            over.0,
            PanelPlace {
                at: [0, 0],
                size: [100, 100]
            }
        );
        // 30 rows hang over at the bottom.
        assert_eq!(over.1, [10, 30]);
    }
}
