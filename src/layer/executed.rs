//! Draws of GL_COMPILE_AND_EXECUTE: the driver draws the program's own view while it compiles; the compiled run then draws the others.

use super::Layer;
use super::draw::{Decided, Request};
use super::side_effects::Redirection;
use crate::atlas::Surface;
use crate::draw::{Current, enter_own, others};
use crate::gl::{Gl, ImageUnit, ListName, consts as c};
use crate::offscreen::Target;
use crate::plan::decide::Demand;
use crate::plan::{Kind, Method, Shear, Unrepresentable};
use crate::state::Effect;
use std::sync::Arc;

/// A run that is being drawn in the program's own view.
#[derive(Debug)]
pub(super) struct Own {
    shear: Option<Shear>,
    /// Whether it is drawn in the other views as well.
    everywhere: bool,
    /// The current values that the other views start from.
    before: Current,
    /// The program's framebuffer, where each view has its own.
    target: Option<Target>,
    /// What the draw may load from and store to by image units.
    units: Arc<[ImageUnit]>,
}

impl Layer {
    /// Before the driver begins the list of a run that draws.
    pub(super) fn start_own(&mut self, gl: &Gl) {
        let request = Request {
            demand: Demand::Everything(Unrepresentable::CompileAndExecute),
            ..Request::of(Kind::List)
        };
        let Decided { plan, images } = self.decide(gl, &request);
        self.queries.drawn();
        let framebuffer = self.state.framebuffers.draw;
        let mut target = self
            .targets
            .offscreen
            .take(framebuffer, self.wanted_views());
        if !self.state.makes_pictures() || (!framebuffer.is_zero() && target.is_none()) {
            return;
        }
        self.diagnostics.proving.refuse_lists();
        let everywhere = plan.method != Method::Once;
        let shear = plan.shear.filter(|_| everywhere);
        let surface: &mut dyn Surface = match &mut target {
            Some(target) => target,
            None => &mut self.targets.atlas,
        };
        enter_own(gl, surface, &self.state, &self.known.rig, shear);
        self.lists.executed = Some(Own {
            shear,
            everywhere,
            before: Current::take(gl, Effect::ALL, true),
            target,
            units: images.units,
        });
    }

    /// After the driver has ended that list, which is `name`: draws the other views.
    pub(super) fn finish_own(&mut self, gl: &Gl, name: ListName) {
        let Some(mut own) = self.lists.executed.take() else {
            return;
        };
        let after = Current::take(gl, Effect::ALL, true);
        self.refresh_parameters();
        let bound = self.targets.offscreen.bound(gl);
        if own.everywhere {
            self.queries.pause(gl);
        }
        // The own view is drawn.
        let mut redirection = match own.everywhere {
            true => self.redirect(gl, &own.units, Vec::new()),
            false => Redirection::default(),
        };
        let surface: &mut dyn Surface = match &mut own.target {
            Some(target) => target,
            None => &mut self.targets.atlas,
        };
        let drawn = surface.tiles().own();
        others(
            gl,
            surface,
            &self.state,
            &self.known.rig,
            own.shear,
            own.everywhere,
            &mut |view| {
                own.before.put(gl);
                self.targets.offscreen.bind(gl, &bound, view);
                redirection.enter(gl, view, drawn);
                gl.call_list(name);
            },
        );
        if own.everywhere {
            self.targets.offscreen.unbind(gl, &bound);
            redirection.leave(gl);
        }
        if let Some(target) = own.target.take() {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, target.own());
            self.targets.offscreen.drawn_to(&target);
            self.targets.offscreen.put(target);
        }
        if own.everywhere {
            after.put(gl);
            self.queries.resume(gl);
        }
    }
}
