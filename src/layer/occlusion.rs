//! `--strategy occlusion`: what is hidden in the program's own view, for the views that are made of it.
//!
//! Each draw of the scene goes to a reference image as well, by the bent rays of an occlusion camera, whose map is that of the depths of the
//! frame before: nothing has to be kept until the depths are known, and a sample's place is right whatever map it was moved by. What the
//! map costs where things move is that it reaches behind where they were.
//!
//! Draws that cannot be bent are missing there: what they hide stays unknown, as it is without this strategy.

use super::synthesis::Look;
use super::{Layer, keep_bindings};
use crate::config::Word;
use crate::draw::{Again, Rays};
use crate::gl::{Gl, consts as c};
use crate::interleave::Heights;
use crate::plan::{Kind, Plan};
use crate::present::capture::read_rgb;
use crate::synthesis::Passes;
use image::RgbImage;

/// D, in pixels: the paper's.
pub(super) const REACH: f32 = 30.0;

/// What is known of the reference image.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Bent {
    /// The driver makes no reference image.
    refused: bool,
    /// The map is that of the frame before.
    mapped: bool,
    /// The scene that is being drawn goes to the reference image.
    pub(super) on: bool,
    /// The next draw goes there.
    pub(super) next: Option<Next>,
}

/// A draw that is about to be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Next {
    mode: u32,
    rays: Rays,
}

impl Layer {
    /// A scene begins, with its depths cleared.
    pub(super) fn begin_bent(&mut self, gl: &Gl) {
        let framebuffer = self.atlas.bent_framebuffer();
        let bent = &mut self.synthesis.bent;
        bent.on = bent.mapped && framebuffer.is_some();
        if let (true, Some(framebuffer)) = (bent.on, framebuffer) {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer);
            gl.clear(c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT);
            let drawn = self.atlas.framebuffer();
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, drawn);
            self.atlas.forget_row();
        }
    }

    /// A draw of the scene is about to be made; those of surfaces by fixed function can be bent.
    pub(super) fn expect_bent(&mut self, kind: Kind, look: &Look) {
        let (Kind::Begin(mode) | Kind::Arrays(mode) | Kind::Elements(mode)) = kind else {
            return;
        };
        let bends = self.synthesis.bent.on
            && self.state.compatibility
            && self.state.program == 0
            && self.state.pipeline == 0
            && (c::TRIANGLES..=c::POLYGON).contains(&mode);
        let map = self.atlas.bent().map(|bent| bent.map);
        if let (true, Some(map)) = (bends, map) {
            let [near, far] = self.state.look.depths;
            let (middle, half) = match self.state.look.zero_to_one {
                true => (near, far - near),
                false => ((near + far) / 2.0, (far - near) / 2.0),
            };
            let [scale, offset] = self.height_line(look).map(|v| v as f32);
            let rays = Rays {
                map,
                heights: [scale * half, scale * middle + offset],
            };
            self.synthesis.bent.next = Some(Next { mode, rays });
        }
    }

    /// Before such a draw, if it is one, of so many vertices, which may change the material; `call` makes it in a mode.
    pub(super) fn draw_bent(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        again: Again,
        (vertices, material): (u64, bool),
        call: &mut dyn FnMut(u32),
    ) {
        let Some(next) = self.synthesis.bent.next.take() else {
            return;
        };
        self.read_fixed(gl);
        let Some(fixed) = &self.fixed else { return };
        self.queries.pause(gl);
        let blends = self.state.look.blends;
        if blends {
            gl.disablei(c::BLEND, 1);
        }
        let drawn = self.programs.draw_bent(
            gl,
            &mut self.atlas,
            &self.state,
            &self.rig,
            plan.shear,
            (fixed, material),
            (next.mode, vertices),
            again,
            &next.rays,
            call,
        );
        if blends {
            gl.enablei(c::BLEND, 1);
        }
        self.report.shaders(self.programs.compiled);
        match drawn {
            Ok(()) => self.report.draw("reference", plan.class.word()),
            Err(reason) => self.fallbacks.add(reason),
        }
        self.queries.resume(gl);
    }

    /// The reference image, row 0 on top. Changes the read framebuffer.
    pub(super) fn reference_image(&self, gl: &Gl) -> Result<RgbImage, String> {
        let framebuffer = self.atlas.bent_framebuffer();
        let framebuffer = framebuffer.filter(|_| self.synthesis.bent.on).ok_or(
            "there is no reference image in this frame: `--strategy occlusion` draws one from the second frame of a scene on",
        )?;
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, framebuffer);
        let [width, height] = [self.atlas.tiles.width, self.atlas.tiles.height];
        Ok(read_rgb(gl, 0, 0, width, height))
    }

    /// After the own view has been measured: its map, for the next frame. State as for the passes.
    pub(super) fn map_bends(&mut self, gl: &Gl, heights: &Heights) {
        let passes = self.synthesis.passes.as_ref();
        if !passes.is_some_and(Passes::bends) {
            return;
        }
        if self.atlas.bent().is_none() {
            let (names, window) = (&mut self.names, &self.state.window);
            self.synthesis.bent.refused =
                !keep_bindings(gl, || self.atlas.make_bent(gl, names, window));
            if self.synthesis.bent.refused {
                self.report.note(
                    "what is hidden stays unknown: the driver makes no reference image".into(),
                );
            }
        }
        if let (Some(passes), false) = (&self.synthesis.passes, self.synthesis.bent.refused) {
            self.synthesis.bent.mapped = passes.bend(gl, &mut self.atlas, heights);
        }
    }
}
