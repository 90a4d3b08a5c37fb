//! One view: the program draws it itself; frames are only counted and captured.

use crate::config::{CaptureWhat, Config};
use crate::gl::{FramebufferName, Gl, consts as c};
use crate::present::capture;
use crate::report::Report;
use crate::state::Neutral;

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

    /// Captures the frame if it is wanted.
    pub fn show(&mut self, gl: &Gl) {
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
