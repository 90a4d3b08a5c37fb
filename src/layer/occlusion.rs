//! `--strategy occlusion`: samples that are hidden in the program's own view, for the views that are synthesised from it.
//!
//! Each draw of the scene goes to a reference image as well, by the distorted rays of an occlusion camera. The distortion map is made from
//! the depths of the previous frame, so that no draw has to wait for the depths of its own frame. The image keeps by how much each sample was
//! moved, so the place of a sample is right whatever map has moved it. Where things move, the map reaches behind their earlier places, so a
//! thin strip there stays unknown.
//!
//! Draws that cannot be distorted are missing in the reference image: their hidden parts stay unknown, as they are without this strategy.

use super::draw::{Draw, Send};
use super::own_variants::{Entered, VariantUse};
use super::{Layer, keep_bindings};
use crate::config::Word;
use crate::draw::{Drawing, Rays, draw_to_reference};
use crate::gl::{Gl, ProgramName, consts as c};
use crate::interleave::Disparities;
use crate::plan::{Flat, Reason};
use crate::present::capture::read_rgb;
use crate::state::Neutral;
use crate::synthesis::Passes;
use image::RgbImage;

/// How far distorted rays reach behind an occluder at most, in pixels: D of Popescu, Rosen and Aliaga, with the value of the paper.
pub(super) const REACH: f32 = 30.0;

/// State of the reference image.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct ReferenceImage {
    /// The driver makes no reference image.
    refused: bool,
    /// There is a distortion map, of the previous frame.
    mapped: bool,
    /// The scene that is being drawn goes to the reference image.
    on: bool,
}

impl ReferenceImage {
    /// A scene begins, and goes to the reference image if there is a distortion map and an image (`made`). Returns whether it does.
    pub(super) fn begin(&mut self, made: bool) -> bool {
        self.on = self.mapped && made;
        self.on
    }

    /// Whether the scene that is being drawn goes to the reference image.
    pub(super) fn is_on(&self) -> bool {
        self.on
    }

    /// Whether the driver has made a distortion map for the next frame.
    pub(super) fn set_mapped(&mut self, mapped: bool) {
        self.mapped = mapped;
    }
}

impl Layer {
    /// A scene begins with a clear of its depths: clears the reference image as well, if the scene goes there.
    pub(super) fn begin_reference(&mut self, gl: &Gl) {
        let framebuffer = self.targets.atlas.reference_framebuffer();
        let on = self.synthesis.reference.begin(framebuffer.is_some());
        if let (true, Some(framebuffer)) = (on, framebuffer) {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer);
            gl.clear(c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT);
            let drawn = self.targets.atlas.framebuffer();
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, drawn);
            self.targets.atlas.forget_row();
        }
    }

    /// Repeats a draw in the reference image, if the plan says so.
    pub(super) fn draw_to_reference(&mut self, gl: &Gl, draw: &mut Draw) {
        let Some(next) = draw.plan.reference else {
            return;
        };
        let drawing = Drawing {
            mode: next.mode,
            ..draw.drawing
        };
        let rays = Rays {
            map: next.map,
            disparities: next.disparities,
        };
        let drawn = match self.state.in_use.program {
            ProgramName::ZERO => self.draw_surface_to_reference(gl, draw, &drawing, &rays),
            _ => self.draw_variant_to_reference(gl, draw, &drawing, &rays),
        };
        match drawn {
            Ok(()) => {
                let class = draw.plan.class.word();
                self.diagnostics.report.draw("reference", class);
            }
            Err(reason) => self.diagnostics.fallback(reason),
        }
    }

    /// Repeats a draw by fixed function there, with a generated program.
    fn draw_surface_to_reference(
        &mut self,
        gl: &Gl,
        draw: &mut Draw,
        drawing: &Drawing,
        rays: &Rays,
    ) -> Result<(), Reason> {
        self.read_fixed(gl);
        let Some(fixed) = self.variants.fixed else {
            return Ok(());
        };
        let (shear, hazard, send) = (draw.plan.shear, draw.hazard, &mut *draw.send);
        self.queries.pause(gl);
        let drawn = self.unblended(gl, |layer| {
            layer.variants.programs.draw_to_reference(
                gl,
                &mut layer.targets.atlas,
                &layer.state,
                &layer.known.rig,
                shear,
                &fixed,
                drawing,
                hazard,
                rays,
                &mut |mode| send(Send::InMode(mode)),
            )
        });
        self.state.keep(self.variants.programs.take_errors());
        let compiled = self.variants.programs.compiled;
        self.diagnostics.report.shaders(compiled);
        self.queries.resume(gl);
        drawn
    }

    /// Repeats a draw with the program's own shaders there, with their variant that distorts rays.
    fn draw_variant_to_reference(
        &mut self,
        gl: &Gl,
        draw: &mut Draw,
        drawing: &Drawing,
        rays: &Rays,
    ) -> Result<(), Reason> {
        let (program, rig) = (self.state.in_use.program, self.known.rig);
        let linked = self.link_other(gl, program, VariantUse::Rays);
        linked.map_err(Reason::NoReference)?;
        let units = self.units_of(gl, program);
        let units: Vec<u32> = units.into_iter().map(|(unit, _)| unit).collect();
        let entered = self.variants.own.enter(gl, program, VariantUse::Rays);
        let Some(Entered { variant, .. }) = entered else {
            return Ok(());
        };
        self.queries.pause(gl);
        let plan = draw.plan;
        // Vertices that the projection matrix places are shifted by that matrix.
        let (moved, shifts) = match plan.variant {
            true => (None, (plan.shear, plan.flat)),
            false => (plan.shear, (None, Flat::Still)),
        };
        let tiles = self.targets.atlas.tiles;
        let own = rig.position(tiles.own());
        variant.set_views(gl, shifts, &[own], tiles.stride);
        let (hazard, send) = (draw.hazard, &mut *draw.send);
        let how = drawing.mode.map_or(Send::AsItIs, Send::InMode);
        self.unblended(gl, |layer| {
            draw_to_reference(
                gl,
                &mut layer.targets.atlas,
                &layer.state,
                &rig,
                moved,
                (&variant, &units),
                drawing.vertices,
                hazard,
                rays,
                &mut || send(how),
            );
        });
        gl.use_program(program);
        self.queries.resume(gl);
        Ok(())
    }

    /// Runs `draw` with blending and colour mask off for the second attachment, which holds by how much each sample is moved.
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

    /// The reference image, row 0 on top. Changes the read framebuffer. Fails where this frame has no reference image.
    pub(super) fn reference_image(&self, gl: &Gl, neutral: &Neutral) -> Result<RgbImage, String> {
        let framebuffer = self.targets.atlas.reference_framebuffer();
        let framebuffer = framebuffer.filter(|_| self.synthesis.reference.is_on()).ok_or(
            "there is no reference image in this frame: `--strategy occlusion` draws one from the second frame of a scene on",
        )?;
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, framebuffer);
        let [width, height] = [
            self.targets.atlas.tiles.width,
            self.targets.atlas.tiles.height,
        ];
        Ok(read_rgb(gl, neutral, 0, 0, width, height))
    }

    /// After the own view has been measured: makes the distortion map for the next frame. The state is neutral.
    pub(super) fn map_distortion(&mut self, gl: &Gl, neutral: &Neutral, disparities: &Disparities) {
        let passes = self.synthesis.passes.as_ref();
        if !passes.is_some_and(Passes::distorts) {
            return;
        }
        if self.targets.atlas.reference().is_none() {
            self.state.keep_errors(gl);
            let (names, window) = (&mut self.targets.names, &self.state.window);
            let made = keep_bindings(gl, || self.targets.atlas.make_reference(gl, names, window));
            self.synthesis.reference.refused = gl.drop_errors() > 0 || !made;
            if self.synthesis.reference.refused {
                self.diagnostics.report.note(
                    "what is hidden stays unknown: the driver makes no reference image".into(),
                );
            }
        }
        if let (Some(passes), false) = (&self.synthesis.passes, self.synthesis.reference.refused) {
            let mapped = passes.map_distortion(gl, neutral, &mut self.targets.atlas, disparities);
            self.synthesis.reference.set_mapped(mapped);
        }
    }
}
