//! `--strategy occlusion`: what is hidden in the program's own view, for the views that are synthesised from it.
//!
//! Each draw of the scene goes to a reference image as well, by the distorted rays of an occlusion camera, whose map is that of the depths of the
//! frame before: nothing has to be kept until the depths are known, and a sample's place is right whatever map it was moved by. What the
//! map costs where things move is that it reaches behind where they were.
//!
//! Draws that cannot be distorted are missing there: what they hide stays unknown, as it is without this strategy.

use super::programs::{Entered, VariantUse};
use super::synthesis::DisparityMapping;
use super::{Layer, keep_bindings};
use crate::config::Word;
use crate::draw::{Drawing, Rays, ReplayHazard, draw_to_reference};
use crate::gl::{Gl, consts as c};
use crate::interleave::Disparities;
use crate::plan::{Flat, Kind, Plan, Reason};
use crate::present::capture::read_rgb;
use crate::synthesis::Passes;
use image::RgbImage;

/// D, in pixels: the paper's.
pub(super) const REACH: f32 = 30.0;

/// What is known of the reference image.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct ReferenceImage {
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
    pub(super) fn begin_reference(&mut self, gl: &Gl) {
        let framebuffer = self.targets.atlas.reference_framebuffer();
        let reference = &mut self.synthesis.reference;
        reference.on = reference.mapped && framebuffer.is_some();
        if let (true, Some(framebuffer)) = (reference.on, framebuffer) {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer);
            gl.clear(c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT);
            let drawn = self.targets.atlas.framebuffer();
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, drawn);
            self.targets.atlas.forget_row();
        }
    }

    /// A draw of the scene is about to be made; those of surfaces by fixed function can be distorted, and of programs with shaders all.
    pub(super) fn expect_reference(&mut self, kind: Kind, mapping: &DisparityMapping) {
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
        let distorts = self.synthesis.reference.on
            && match (self.state.program, self.state.pipeline) {
                (0, 0) => self.state.compatibility && surfaces(),
                (program, _) => program != 0,
            };
        let map = self
            .targets
            .atlas
            .reference()
            .map(|reference| reference.map);
        if let (true, Some(map)) = (distorts, map) {
            let [near, far] = self.state.classification.depths;
            let (middle, half) = match self.state.classification.zero_to_one {
                true => (near, far - near),
                false => ((near + far) / 2.0, (far - near) / 2.0),
            };
            let [scale, offset] = self.disparity_line(mapping).map(|v| v as f32);
            let rays = Rays {
                map,
                disparities: [scale * half, scale * middle + offset],
            };
            self.synthesis.reference.next = Some(Next { mode, rays });
        }
    }

    /// Before such a draw, if it is one; `drawing` is without its mode. `call` makes it in a mode.
    pub(super) fn draw_to_reference(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        hazard: ReplayHazard,
        drawing: Drawing,
        call: &mut dyn FnMut(u32),
    ) {
        let Some(next) = self.synthesis.reference.next.take() else {
            return;
        };
        let drawing = Drawing {
            mode: next.mode,
            ..drawing
        };
        if self.state.program != 0 {
            return self.draw_variant_to_reference(gl, plan, hazard, &drawing, &next.rays, call);
        }
        self.read_fixed(gl);
        let Some(fixed) = self.variants.fixed else {
            return;
        };
        self.queries.pause(gl);
        let drawn = self.unblended(gl, |layer| {
            layer.variants.programs.draw_to_reference(
                gl,
                &mut layer.targets.atlas,
                &layer.state,
                &layer.cameras.rig,
                plan.shear,
                &fixed,
                &drawing,
                hazard,
                &next.rays,
                call,
            )
        });
        self.diagnostics
            .report
            .shaders(self.variants.programs.compiled);
        match drawn {
            Ok(()) => self.diagnostics.report.draw("reference", plan.class.word()),
            Err(reason) => self.diagnostics.fallbacks.add(reason),
        }
        self.queries.resume(gl);
    }

    /// Such a draw with the program's own shaders.
    fn draw_variant_to_reference(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        hazard: ReplayHazard,
        drawing: &Drawing,
        rays: &Rays,
        call: &mut dyn FnMut(u32),
    ) {
        let (program, rig) = (self.state.program, self.cameras.rig);
        if let Err(why) = self.link_distorting(gl, program) {
            return self.diagnostics.fallbacks.add(Reason::NoReference(why));
        }
        let units = self.units_of(gl, program);
        let units: Vec<u32> = units.into_iter().map(|(unit, _)| unit).collect();
        let mut variants = std::mem::take(&mut self.variants.own);
        if let Some(Entered { variant, .. }) = variants.enter(gl, program, VariantUse::Rays) {
            self.queries.pause(gl);
            // What the projection matrix places is shifted by that.
            let (moved, shifts) = match plan.variant {
                true => (None, (plan.shear, plan.flat)),
                false => (plan.shear, (None, Flat::Still)),
            };
            let tiles = self.targets.atlas.tiles;
            variant.set_views(gl, shifts, &[rig.position(tiles.own())], tiles.stride);
            let mode = drawing.mode.unwrap_or(c::TRIANGLES);
            self.unblended(gl, |layer| {
                draw_to_reference(
                    gl,
                    &mut layer.targets.atlas,
                    &layer.state,
                    &rig,
                    moved,
                    (variant, &units),
                    drawing.vertices,
                    hazard,
                    rays,
                    &mut || call(mode),
                );
            });
            gl.use_program(program);
            self.diagnostics.report.draw("reference", plan.class.word());
            self.queries.resume(gl);
        }
        self.variants.own = variants;
    }

    /// By how much samples are moved is not blended, and written whatever colours the program leaves out.
    fn unblended<R>(&mut self, gl: &Gl, draw: impl FnOnce(&mut Self) -> R) -> R {
        let blends = self.state.classification.blends;
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
        let framebuffer = self.targets.atlas.reference_framebuffer();
        let framebuffer = framebuffer.filter(|_| self.synthesis.reference.on).ok_or(
            "there is no reference image in this frame: `--strategy occlusion` draws one from the second frame of a scene on",
        )?;
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, framebuffer);
        let [width, height] = [
            self.targets.atlas.tiles.width,
            self.targets.atlas.tiles.height,
        ];
        Ok(read_rgb(gl, 0, 0, width, height))
    }

    /// After the own view has been measured: its map, for the next frame. State as for the passes.
    pub(super) fn map_distortion(&mut self, gl: &Gl, disparities: &Disparities) {
        let passes = self.synthesis.passes.as_ref();
        if !passes.is_some_and(Passes::distorts) {
            return;
        }
        if self.targets.atlas.reference().is_none() {
            let (names, window) = (&mut self.targets.names, &self.state.window);
            self.synthesis.reference.refused =
                !keep_bindings(gl, || self.targets.atlas.make_reference(gl, names, window));
            if self.synthesis.reference.refused {
                self.diagnostics.report.note(
                    "what is hidden stays unknown: the driver makes no reference image".into(),
                );
            }
        }
        if let (Some(passes), false) = (&self.synthesis.passes, self.synthesis.reference.refused) {
            self.synthesis.reference.mapped =
                passes.map_distortion(gl, &mut self.targets.atlas, disparities);
        }
    }
}
