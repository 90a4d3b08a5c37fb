//! One view: the program draws it itself; frames are only counted and captured.

use super::passes::HIDDEN;
use crate::config::{CaptureWhat, Config};
use crate::gl::{FramebufferName, Gl, consts as c};
use crate::present::capture;
use crate::report::Report;
use crate::state::{Neutral, is_front};

/// Counts and captures of a context with one view.
#[derive(Debug)]
pub struct Frames {
    config: &'static Config,
    width: u32,
    height: u32,
    report: Report,
}

impl Frames {
    /// For a context whose drawable has this size in pixels.
    pub fn new(config: &'static Config, width: u32, height: u32) -> Self {
        Frames {
            config,
            width,
            height,
            report: Report::default(),
        }
    }

    /// The drawable has another size, in pixels.
    pub fn resize(&mut self, width: u32, height: u32) {
        (self.width, self.height) = (width, height);
    }

    /// Whether a flush shows what was drawn: the window is bound, and draws go to its front buffer, or it has no other. Draws are not watched, so a
    /// program that flushes twice after them shows two frames.
    pub fn shows_on_flush(&self, gl: &Gl) -> bool {
        // Windows of OpenGL ES are shown by a swap.
        if gl.is_es() || self.width.max(self.height) <= HIDDEN {
            return false;
        }
        let window = gl.version() < (3, 0) || gl.get_integer(c::DRAW_FRAMEBUFFER_BINDING) == 0;
        window
            && (gl.get_integer(c::DOUBLEBUFFER) == 0
                || is_front(gl.get_integer(c::DRAW_BUFFER) as u32))
    }

    /// Captures the frame if it is wanted, from the front buffer where a flush shows it, or it is in the program's memory (OSMesa).
    pub fn show(&mut self, gl: &Gl, flushed: bool) {
        let frame = self.report.frames() + 1;
        let Some(wanted) = self
            .config
            .capture
            .as_ref()
            .filter(|w| (w.first..=w.last).contains(&frame))
        else {
            return;
        };
        self.report.write(self.config, frame);
        let neutral = Neutral::enter(gl, false, gl.since((4, 1), None));
        let framebuffers = gl.version() >= (3, 0);
        let read = if framebuffers {
            FramebufferName(gl.get_integer(c::READ_FRAMEBUFFER_BINDING) as u32)
        } else {
            FramebufferName::ZERO
        };
        if !read.is_zero() {
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, FramebufferName::ZERO);
        }
        let buffer = flushed.then(|| gl.get_integer(c::READ_BUFFER) as u32);
        if buffer.is_some() {
            gl.read_buffer(c::FRONT);
        }
        let claims = &mut self.report.claims;
        let path = claims.path(self.config, &wanted.out, wanted.path_for(frame));
        let written = match wanted.what {
            CaptureWhat::Depth => capture::write(
                &capture::read_depth(gl, &neutral, 0, 0, self.width, self.height),
                &path,
            ),
            _ => capture::write(
                &capture::read_rgb(gl, &neutral, 0, 0, self.width, self.height),
                &path,
            ),
        };
        if let Err(e) = written {
            self.report.note(format!("capture of frame {frame}: {e}"));
        }
        if let Some(buffer) = buffer {
            gl.read_buffer(buffer);
        }
        if !read.is_zero() {
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, read);
        }
        neutral.leave(gl);
    }

    /// Counts the frame and writes the report where one is asked for.
    pub fn count_frame(&mut self) {
        self.report.frame();
        self.report.write_if_due(self.config);
    }
}
