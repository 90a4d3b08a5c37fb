//! Passes of the program outside the window: they are drawn once where all views are the same, or else once per view, into framebuffers of
//! the view's own and with textures of its own (see [`crate::offscreen`]).
//!
//! A framebuffer is taken as a part of the window's picture, with one image per view, as soon as a part of the scene is drawn into it in
//! perspective, and its viewport or its camera has the aspect ratio of the window. Shadow maps, cube faces and light maps have neither.
//! Whatever samples, copies or blits from one that differs between the views makes its own target differ.

use super::{Layer, keep_bindings};
use crate::gl::{FramebufferName, Gl, ProgramName, consts as c};
use crate::offscreen::Bound;
use crate::plan::camera;
use crate::plan::class::Target;
use crate::plan::decide::Shaders;
use crate::state::{Touch, uniform_change};
use std::sync::Arc;

/// Longer side, in pixels, up to which a window is taken as one that nobody looks at.
pub(super) const HIDDEN: u32 = 16;

impl Layer {
    /// The target of a draw. If it is a pass whose camera may be the window's, also A of that camera (see [`crate::plan::parallax`]). The
    /// state must have been refreshed.
    pub(super) fn target(&mut self, gl: &Gl, shaders: &Shaders) -> (Target, Option<f64>) {
        let name = self.state.framebuffers.draw;
        if !self.state.makes_pictures() {
            return (Target::Nothing, None);
        }
        if name.is_zero() {
            return (Target::Window, None);
        }
        let number = self.targets.offscreen.number(gl, name);
        let (pass, lens) = match self.session.config.views {
            0 | 1 => (false, None),
            _ => self.is_pass(gl, name, shaders),
        };
        match pass {
            true => (Target::Pass(number), lens),
            false => (Target::Framebuffer(number), None),
        }
    }

    /// Whether a draw into a framebuffer of the program's, with the current camera, is a part of the window's picture; and A of that camera,
    /// where it may be the window's.
    fn is_pass(
        &mut self,
        gl: &Gl,
        framebuffer: FramebufferName,
        shaders: &Shaders,
    ) -> (bool, Option<f64>) {
        let camera = match shaders {
            Shaders::Variant(variant) => variant.camera,
            _ => camera::equivalent(&self.state.matrices.projection),
        };
        let target = self.targets.offscreen.target(gl, framebuffer);
        if target.is_cube() || target.attachments.is_empty() {
            return (false, None);
        }
        let alone = target.is_depth_only();
        let [_, _, width, height] = self.state.rectangles.viewport.map(i64::from);
        let [w, h] = self.picture_size();
        // Within a pixel, since half of an odd size is rounded.
        let fits = (width * h - height * w).abs() <= w.max(h);
        let Some(camera) = camera else {
            return (fits, None);
        };
        let a = f64::from(camera[0]);
        if alone && width == height {
            // A square depth map is a shadow map, unless its camera has the window's A.
            let lens = self.known.lens;
            return (
                lens.is_some_and(|lens| (a - lens).abs() <= 0.01 * lens),
                None,
            );
        }
        let pass = fits || camera::fits(&camera, self.aspect());
        (pass, pass.then_some(a))
    }

    /// Width and height, in pixels, of the picture that is drawn: those of the window, or of the viewport where the window is hidden.
    fn picture_size(&self) -> [i64; 2] {
        let window = [self.state.window.width, self.state.window.height].map(i64::from);
        let [_, _, width, height] = self.state.rectangles.viewport.map(i64::from);
        match self.is_hidden() && width > 0 && height > 0 {
            true => [width, height],
            false => window,
        }
    }

    /// Whether the context draws for another one: its own window, such as those of toolkits' widgets, serves only to make it current.
    pub fn is_hidden(&self) -> bool {
        let window = &self.state.window;
        window.width.max(window.height) <= HIDDEN
    }

    /// Width over height of the picture.
    pub(super) fn aspect(&self) -> f64 {
        let [w, h] = self.picture_size().map(|side| side as f64);
        w / h
    }

    /// The textures with an image per view that a draw reads.
    pub(super) fn sampled(&mut self, gl: &Gl) -> Arc<[Bound]> {
        self.refresh_parameters();
        let program = self.state.in_use.program;
        let changes = self.targets.offscreen.changes();
        let key = (program, uniform_change(), changes);
        let stale = self.state.touched.has(Touch::UNITS);
        if let Some(sampled) = self.variants.sampled(key, stale) {
            return sampled;
        }
        self.state.touched = self.state.touched.without(Touch::UNITS);
        let bound = match program {
            _ if self.targets.offscreen.is_empty() => Vec::new(),
            ProgramName::ZERO => {
                let all = self.targets.offscreen.bound(gl);
                // A fragment program samples what it names, fixed function what is enabled.
                let fixed = self.state.has.compatibility
                    && self.state.in_use.pipeline == 0
                    && !gl.is_enabled(c::FRAGMENT_PROGRAM_ARB);
                match fixed {
                    true => self.targets.offscreen.enabled_among(gl, all),
                    false => all,
                }
            }
            program => {
                let units = self.units_of(gl, program);
                self.targets.offscreen.bound_among(gl, units.into_iter())
            }
        };
        self.variants.sample(bound)
    }

    /// Splits a framebuffer of the program's: each view gets one like it. False where the driver makes none.
    pub(super) fn split(&mut self, gl: &Gl, framebuffer: FramebufferName) -> bool {
        if self.targets.offscreen.is_made(gl, framebuffer) {
            return true;
        }
        if self.targets.offscreen.is_refused(gl, framebuffer) {
            return false;
        }
        self.state.keep_errors(gl);
        let split = keep_bindings(gl, || {
            self.targets
                .offscreen
                .split(gl, &mut self.targets.names, framebuffer)
        });
        self.drain_own_errors(gl);
        if !split {
            self.diagnostics.report.note(format!(
                "the driver makes no other framebuffer like the program's {framebuffer}: what is drawn there is the same in all views"
            ));
        }
        split
    }
}
