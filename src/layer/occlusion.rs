//! `--strategy occlusion`: what is hidden in the program's own view, for the views that are made of it.
//!
//! Each draw of the scene goes to a reference image as well, by the bent rays of an occlusion camera, whose map is that of the depths of the
//! frame before: nothing has to be kept until the depths are known, and a sample's place is right whatever map it was moved by. What the
//! map costs where things move is that it reaches behind where they were.
//!
//! Draws that cannot be bent are missing there: what they hide stays unknown, as it is without this strategy.

use super::programs::{Entered, With};
use super::synthesis::Look;
use super::{Layer, keep_bindings};
use crate::config::Word;
use crate::draw::{Again, Drawing, Rays, draw_bent};
use crate::gl::{Gl, consts as c};
use crate::interleave::Heights;
use crate::plan::{Flat, Kind, Plan, Reason};
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
    /// Of the primitives, where that is known.
    mode: Option<u32>,
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

    /// A draw of the scene is about to be made; those of surfaces by fixed function can be bent, and of programs with shaders all.
    pub(super) fn expect_bent(&mut self, kind: Kind, look: &Look) {
        let mode = match kind {
            Kind::Begin(mode) | Kind::Arrays(mode) | Kind::Elements(mode) => Some(mode),
            Kind::Other | Kind::List => None,
            _ => return,
        };
        // A list is drawn there if it has nothing but surfaces.
        let surfaces = || match mode {
            Some(mode) => (c::TRIANGLES..=c::POLYGON).contains(&mode),
            None => kind == Kind::List,
        };
        let bends = self.synthesis.bent.on
            && match (self.state.program, self.state.pipeline) {
                (0, 0) => self.state.compatibility && surfaces(),
                (program, _) => program != 0,
            };
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

    /// Before such a draw, if it is one; `drawing` is without its mode. `call` makes it in a mode.
    pub(super) fn draw_bent(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        again: Again,
        drawing: Drawing,
        call: &mut dyn FnMut(u32),
    ) {
        let Some(next) = self.synthesis.bent.next.take() else {
            return;
        };
        let drawing = Drawing {
            mode: next.mode,
            ..drawing
        };
        if self.state.program != 0 {
            return self.draw_bent_twin(gl, plan, again, &drawing, &next.rays, call);
        }
        self.read_fixed(gl);
        let Some(fixed) = self.fixed else { return };
        self.queries.pause(gl);
        let drawn = self.unblended(gl, |layer| {
            layer.programs.draw_bent(
                gl,
                &mut layer.atlas,
                &layer.state,
                &layer.rig,
                plan.shear,
                &fixed,
                &drawing,
                again,
                &next.rays,
                call,
            )
        });
        self.report.shaders(self.programs.compiled);
        match drawn {
            Ok(()) => self.report.draw("reference", plan.class.word()),
            Err(reason) => self.fallbacks.add(reason),
        }
        self.queries.resume(gl);
    }

    /// Such a draw with the program's own shaders.
    fn draw_bent_twin(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        again: Again,
        drawing: &Drawing,
        rays: &Rays,
        call: &mut dyn FnMut(u32),
    ) {
        let (program, rig) = (self.state.program, self.rig);
        if let Err(why) = self.know_bent(gl, program) {
            return self.fallbacks.add(Reason::Unbent(why));
        }
        let units = self.units_of(gl, program);
        let units: Vec<u32> = units.into_iter().map(|(unit, _)| unit).collect();
        let mut twins = std::mem::take(&mut self.twins);
        if let Some(Entered { twin, .. }) = twins.enter(gl, program, With::Rays) {
            self.queries.pause(gl);
            // What the projection matrix places is shifted by that.
            let (moved, shifts) = match plan.twin {
                true => (None, (plan.shear, plan.flat)),
                false => (plan.shear, (None, Flat::Still)),
            };
            let tiles = self.atlas.tiles;
            twin.place(gl, shifts, &[rig.place(tiles.own())], tiles.stride);
            let mode = drawing.mode.unwrap_or(c::TRIANGLES);
            self.unblended(gl, |layer| {
                draw_bent(
                    gl,
                    &mut layer.atlas,
                    &layer.state,
                    &rig,
                    moved,
                    (twin, &units),
                    drawing.vertices,
                    again,
                    rays,
                    &mut || call(mode),
                );
            });
            gl.use_program(program);
            self.report.draw("reference", plan.class.word());
            self.queries.resume(gl);
        }
        self.twins = twins;
    }

    /// By how much samples are moved is not blended, and written whatever colours the program leaves out.
    fn unblended<R>(&mut self, gl: &Gl, draw: impl FnOnce(&mut Self) -> R) -> R {
        let blends = self.state.look.blends;
        if blends {
            gl.disablei(c::BLEND, 1);
        }
        let mask: [i32; 4] = gl.get_integers_indexed(c::COLOR_WRITEMASK, 1);
        if mask[0] == 0 {
            gl.color_maski(1, 1, 1, 1, 1);
        }
        let done = draw(self);
        if blends {
            gl.enablei(c::BLEND, 1);
        }
        if mask[0] == 0 {
            let [r, g, b, a] = mask.map(|on| u8::from(on != 0));
            gl.color_maski(1, r, g, b, a);
        }
        done
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
