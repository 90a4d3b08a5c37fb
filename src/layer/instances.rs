//! Draws of a program with shaders of its own, all views at once: a variant with an instance for each view, which chooses its layer.

use super::Layer;
use super::drawing::method_name;
use super::programs::{Entered, VariantUse};
use crate::atlas::Surface;
use crate::config::{Strategy, Word};
use crate::draw::ReplayHazard;
use crate::gl::{Gl, consts as c};
use crate::plan::{Kind, Method, Plan};

impl Layer {
    /// Whether a draw that goes by a variant takes all views by instances. Not where each view samples a texture of its own, or the program
    /// counts what is drawn.
    pub(super) fn by_instances(&mut self, gl: &Gl, kind: Kind, plan: Plan) -> Plan {
        let wanted = self.session.capabilities.strategy == Strategy::Instanced
            && plan.variant
            && plan.method == Method::Replay
            && matches!(kind, Kind::Arrays(_) | Kind::Elements(_))
            && self.variants.sampled.is_empty()
            && !self.queries.active()
            && !self.session.capabilities.together;
        if !wanted || !self.has_layers(gl) || (self.variants.divides && gl.has_divisors()) {
            return plan;
        }
        match self.know_layers(gl, self.state.program, true) {
            true => Plan {
                method: Method::Instanced,
                reason: None,
                ..plan
            },
            false => plan,
        }
    }

    /// Whether what is drawn to has all views as its layers.
    fn has_layers(&mut self, gl: &Gl) -> bool {
        let tiles = &self.targets.atlas.tiles;
        match self.state.framebuffers.draw {
            0 => {
                tiles.columns == 1 && tiles.grid.is_full() && self.targets.atlas.layered().is_some()
            }
            framebuffer => self
                .targets
                .offscreen
                .target(gl, framebuffer)
                .layered()
                .is_some(),
        }
    }

    /// Such a draw; `draw` makes it with a number of instances, `call` as the program does.
    pub(super) fn draw_instances(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        draw: &mut dyn FnMut(i32),
        call: &mut dyn FnMut(),
    ) {
        let (program, rig) = (self.state.program, self.cameras.rig);
        let framebuffer = self.state.framebuffers.draw;
        let shifts = (plan.shear, plan.flat);
        let mut variants = std::mem::take(&mut self.variants.own);
        if self.diagnostics.proving.atlas().is_some()
            && let Some(Entered { variant, .. }) = variants.enter(gl, program, VariantUse::Views)
        {
            let stride = self.targets.atlas.tiles.stride;
            self.prove(gl, None, ReplayHazard::None, &mut |view| {
                variant.set_views(gl, shifts, &[rig.position(view)], stride);
                call();
            });
        }
        let target = self
            .targets
            .offscreen
            .take(framebuffer, self.wanted_views());
        let tiles = target
            .as_ref()
            .map_or(self.targets.atlas.tiles, |target| target.tiles());
        if let Some(Entered { variant, .. }) = variants.enter(gl, program, VariantUse::Instances) {
            let views: Vec<u32> = tiles.order().collect();
            let places: Vec<f64> = views.iter().map(|&view| rig.position(view)).collect();
            let layers: Vec<u32> = views.iter().map(|&view| tiles.slot(view)).collect();
            variant.set_views(gl, shifts, &places, tiles.stride);
            variant.set_layers(gl, &layers);
            match target.as_ref().and_then(|target| target.layered()) {
                Some(name) => gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, name),
                None => self.targets.atlas.bind_layered(gl),
            }
            draw(views.len() as i32);
        } else {
            call();
        }
        gl.use_program(program);
        self.variants.own = variants;
        match target {
            Some(target) => {
                gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer);
                self.targets.offscreen.drawn_to(&target);
                self.targets.offscreen.put(target);
            }
            None => self.targets.atlas.bind_row(gl, 0),
        }
        self.frame.amplifies = true;
        self.diagnostics
            .report
            .draw(method_name(Method::Instanced), plan.class.word());
    }

    /// Some attribute is about to advance by instances.
    pub fn divides(&mut self) {
        self.variants.divides = true;
    }
}
