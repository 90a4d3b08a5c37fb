//! Execute: sends one [`Draw`] to the driver by the method that was decided, or by replay where that method turns out to be impossible.

use super::super::Layer;
use super::super::own_variants::{Entered, VariantUse};
use super::super::side_effects::Redirection;
use super::super::targets::Targets;
use super::{Draw, Images, Send};
use crate::atlas::{Surface, Tiles};
use crate::draw::{
    Amplified, Current, Drawing, FixedState, PointProgram, Programs, ReplayHazard, Variant, replay,
};
use crate::gl::{Gl, Object, consts as c};
use crate::offscreen::Target;
use crate::plan::{Method, Plan, camera};
use crate::state::Touch;
use crate::view::ViewIndex;

/// How a draw is executed, once it is known what is possible.
#[allow(
    clippy::large_enum_variant,
    reason = "one at a time, on the stack; a box would be an allocation for each draw"
)]
pub(in crate::layer) enum Execution {
    /// One call, as the program has made it.
    Once,
    /// View by view.
    Replay,
    /// By a variant of the program's own shaders, an instance for each view.
    Instances,
    /// By a generated program.
    Amplified(Amplified),
    /// Points for all views at once.
    Points(PointProgram),
}

impl Layer {
    /// Makes a draw.
    pub(in crate::layer) fn execute(&mut self, gl: &Gl, draw: &mut Draw) {
        let execution = self.choose(gl, draw.plan, &draw.drawing, draw.amplifiable);
        self.execute_by(gl, draw, &execution);
    }

    /// Chooses how a draw is executed, and counts it if a generated program was to amplify it. `amplifiable`: it may be sent in another
    /// primitive mode, or instanced.
    pub(in crate::layer) fn choose(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        drawing: &Drawing,
        amplifiable: bool,
    ) -> Execution {
        match (plan.method, drawing.mode) {
            (Method::Once, _) => Execution::Once,
            (Method::Replay, _) => Execution::Replay,
            (Method::Instanced, Some(_)) if plan.variant => Execution::Instances,
            (Method::Instanced | Method::Geometry, Some(mode)) if amplifiable => {
                let how = self.amplify(gl, plan, mode, drawing.material);
                how.map_or(Execution::Replay, Execution::Amplified)
            }
            (Method::Points, Some(c::POINTS)) if amplifiable => {
                let how = self.prepare_points(gl, plan, drawing);
                how.map_or(Execution::Replay, Execution::Points)
            }
            (Method::Instanced | Method::Geometry | Method::Points, _) => {
                self.count_draw(Method::Replay, plan);
                Execution::Replay
            }
        }
    }

    /// Makes a draw as [`Layer::choose`] has chosen.
    pub(in crate::layer) fn execute_by(&mut self, gl: &Gl, draw: &mut Draw, execution: &Execution) {
        if !matches!(execution, Execution::Points(how) if !how.is_to_layers()) {
            self.flush_points(gl);
        }
        if draw.plan.measures {
            self.measure_w(gl, draw);
        }
        let written = self.queries.feeds();
        // Otherwise no view is drawn, and what GL_FEEDBACK or GL_SELECT tells is told once.
        let feeds = written && self.state.primitives.render_mode == c::RENDER;
        if written && self.has_copies() {
            // What is written comes from the program's own textures.
            self.write_back_textures(gl);
        }
        match draw.hazard {
            ReplayHazard::None if feeds => {
                self.feed(gl, draw, |layer, draw| layer.send_by(gl, draw, execution));
            }
            // A second sending would start from the state that the first one has left.
            ReplayHazard::Current(_) | ReplayHazard::Anything { .. } if feeds => {
                self.queries.drawn();
                (draw.send)(Send::AsItIs);
            }
            _ => self.send_by(gl, draw, execution),
        }
    }

    fn send_by(&mut self, gl: &Gl, draw: &mut Draw, execution: &Execution) {
        match execution {
            Execution::Once => self.once(gl, draw.images, &mut || (draw.send)(Send::AsItIs)),
            Execution::Replay => self.replay_in(gl, draw),
            Execution::Instances => self.draw_instances(gl, draw),
            Execution::Amplified(how) => self.draw_amplified(gl, draw, how),
            Execution::Points(how) => self.draw_points(gl, draw, how),
        }
    }

    /// Makes the call once, in the program's own view only.
    fn once(&mut self, gl: &Gl, images: &Images, call: &mut dyn FnMut()) {
        // What is stored to an image is the program's own texture again.
        let stores = !images.units.is_empty() && self.stores_to_images();
        for unit in images
            .units
            .iter()
            .filter(|unit| stores && unit.is_written())
        {
            self.written(gl, Object::Texture(unit.texture));
        }
        if self.has_copies() && (images.differ() || self.state.primitives.transform_feedback) {
            self.write_back_textures(gl);
        }
        // Feedback and selection draw nothing, and report places in the program's own viewport.
        if self.state.draws_to_window() && self.state.primitives.render_mode == c::RENDER {
            // The tiles beside it are other views'.
            self.scissored(gl, self.targets.atlas.tiles.own(), 0, call);
        } else {
            call();
        }
    }

    /// Draws view by view, in the views that may see the draw, and to the reference image.
    pub(in crate::layer) fn replay_in(&mut self, gl: &Gl, draw: &mut Draw) {
        let all = self.targets.atlas.tiles.shown;
        self.targets.atlas.tiles.shown = draw.views.unwrap_or(all);
        if draw.plan.reference.is_some() {
            self.draw_to_reference(gl, draw);
        }
        self.replay(gl, draw);
        self.targets.atlas.tiles.shown = all;
    }

    fn replay(&mut self, gl: &Gl, draw: &mut Draw) {
        let framebuffer = self.state.framebuffers.draw;
        let shown = self.wanted_views();
        match self.targets.offscreen.take(framebuffer, shown) {
            Some(target) => self.replay_split(gl, draw, target),
            None => self.replay_by(gl, draw, None, VariantUse::Views),
        }
    }

    /// Draws to a framebuffer of which each view has its own: to the layers of one framebuffer where a variant chooses among them, or for a
    /// clear.
    fn replay_split(&mut self, gl: &Gl, draw: &mut Draw, mut target: Target) {
        let layered = target.layered();
        let clears = draw.hazard == ReplayHazard::Clear;
        let chooses = draw.plan.variant && self.chooses_layers(self.state.in_use.program);
        let layered = layered.filter(|_| clears || chooses);
        if let Some(name) = layered {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, name);
        }
        target.take_layers(layered.is_some());
        match layered {
            // A clear reaches all layers at once.
            Some(_) if !draw.plan.variant => (draw.send)(Send::AsItIs),
            Some(_) => self.replay_by(gl, draw, Some(&mut target), VariantUse::Layers),
            None => self.replay_by(gl, draw, Some(&mut target), VariantUse::Views),
        }
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, self.state.framebuffers.draw);
        self.targets.offscreen.drawn_to(&target);
        self.targets.offscreen.put(target);
    }

    /// Draws view by view to `target`, or to the window without one; with the program's variant where the plan says so.
    fn replay_by(
        &mut self,
        gl: &Gl,
        draw: &mut Draw,
        target: Option<&mut Target>,
        with: VariantUse,
    ) {
        let (plan, program) = (draw.plan, self.state.in_use.program);
        let entered = match plan.variant {
            true => self.variants.own.enter(gl, program, with),
            false => None,
        };
        let (rig, own) = (self.known.rig, self.targets.atlas.tiles);
        let tiles = target.as_ref().map_or(own, |target| target.tiles());
        let shear = plan.shear.filter(|_| !plan.variant);
        let prepare = |view: ViewIndex| {
            if let Some(Entered { variant, layers }) = &entered {
                let place = rig.position(view);
                set_view(gl, variant, draw.images, plan, place, tiles.stride);
                if *layers {
                    variant.set_layers(gl, &[tiles.slot(view)]);
                }
            }
        };
        let send = &mut *draw.send;
        let mut call = |view: ViewIndex| {
            prepare(view);
            send(Send::AsItIs);
        };
        self.prove(gl, shear, draw.hazard, draw.images, &mut call);
        let sent = self.send_views(gl, target, plan, draw.hazard, draw.images, &mut call);
        if entered.is_some() {
            gl.use_program(program);
        }
        if !sent {
            self.known.mono.lose();
            self.diagnostics.report.note(
                "the program's attribute stack was full: some draws are in its own view only"
                    .into(),
            );
        }
    }

    /// Sends a draw for each view with its images. The program's queries count the own view alone. False where the attribute stack was full
    /// and the draw is in the own view only.
    fn send_views(
        &mut self,
        gl: &Gl,
        target: Option<&mut Target>,
        plan: &Plan,
        hazard: ReplayHazard,
        images: &Images,
        call: &mut dyn FnMut(ViewIndex),
    ) -> bool {
        let mut redirection = match hazard {
            ReplayHazard::Clear => Redirection::default(),
            _ => {
                let blocks = self.view_blocks(gl, plan.shear, &images.unprojections);
                self.redirect(gl, &images.units, blocks)
            }
        };
        let shear = plan.shear.filter(|_| !plan.variant);
        let Layer {
            targets,
            state,
            known,
            queries,
            frame,
            ..
        } = self;
        let Targets {
            atlas, offscreen, ..
        } = targets;
        let surface: &mut dyn Surface = match target {
            Some(target) => target,
            None => atlas,
        };
        let (own, mut paused) = (surface.tiles().own(), true);
        queries.pause(gl);
        frame.owe_own_view(true);
        let each = &mut |view| {
            if view == own && std::mem::take(&mut paused) {
                queries.resume(gl);
                frame.owe_own_view(false);
            }
            offscreen.bind(gl, &images.bound, view);
            redirection.enter(gl, view, own);
            call(view);
        };
        let sent = replay(gl, surface, state, &known.rig, shear, hazard, true, each);
        frame.owe_own_view(false);
        offscreen.unbind(gl, &images.bound);
        redirection.leave(gl);
        sent
    }

    /// Draws all views at once, by a variant that has an instance for each view and chooses its layer.
    fn draw_instances(&mut self, gl: &Gl, draw: &mut Draw) {
        let (plan, program, rig) = (draw.plan, self.state.in_use.program, self.known.rig);
        self.prove_by_variant(gl, draw);
        self.in_layers(gl, |layer, tiles| {
            let entered = layer.variants.own.enter(gl, program, VariantUse::Instances);
            if let (Some(Entered { variant, .. }), Some(mode)) = (entered, draw.drawing.mode) {
                let count = set_all_views(gl, &variant, plan, &rig, tiles);
                (draw.send)(Send::Instances { mode, count });
            } else {
                (draw.send)(Send::AsItIs);
            }
        });
        gl.use_program(program);
        self.frame.amplifies();
        self.count_draw(Method::Instanced, plan);
    }

    /// Runs `work` with the framebuffer bound whose layers are the views, that of the window or of a framebuffer of the program's. It gets the places of the views.
    pub(in crate::layer) fn in_layers(&mut self, gl: &Gl, work: impl FnOnce(&mut Self, &Tiles)) {
        let framebuffer = self.state.framebuffers.draw;
        let shown = self.wanted_views();
        let target = self.targets.offscreen.take(framebuffer, shown);
        let own = self.targets.atlas.tiles;
        let tiles = target.as_ref().map_or(own, |target| target.tiles());
        match target.as_ref().and_then(|target| target.layered()) {
            Some(name) => gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, name),
            None => self.targets.atlas.bind_layered(gl),
        }
        work(self, &tiles);
        match target {
            Some(target) => {
                gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer);
                self.targets.offscreen.drawn_to(&target);
                self.targets.offscreen.put(target);
            }
            None => self.targets.atlas.bind_row(gl, 0),
        }
    }

    /// Draws for a proof, view by view, with the program's variant where the plan says so.
    pub(in crate::layer) fn prove_by_variant(&mut self, gl: &Gl, draw: &mut Draw) {
        if self.diagnostics.proving.atlas().is_none() {
            return;
        }
        let (program, plan) = (self.state.in_use.program, draw.plan);
        let (rig, stride) = (self.known.rig, self.targets.atlas.tiles.stride);
        let entered = match plan.variant {
            true => self.variants.own.enter(gl, program, VariantUse::Views),
            false => None,
        };
        let (shear, shifts) = (
            plan.shear.filter(|_| !plan.variant),
            (plan.shear, plan.flat),
        );
        let send = &mut *draw.send;
        self.prove(gl, shear, draw.hazard, draw.images, &mut |view| {
            if let Some(Entered { variant, .. }) = &entered {
                variant.set_views(gl, shifts, &[rig.position(view)], stride);
            }
            send(Send::AsItIs);
        });
        gl.use_program(program);
    }

    /// Reads the fixed-function state where it is not known.
    pub(in crate::layer) fn read_fixed(&mut self, gl: &Gl) {
        let (touched, samples) = (self.state.touched, self.state.window.samples);
        if touched.has(Touch::FIXED) || self.variants.fixed.is_none() {
            self.variants.fixed = Some(FixedState::read(gl, self.variants.driver, samples));
        } else if touched.has(Touch::MATERIAL)
            && let Some(fixed) = &mut self.variants.fixed
        {
            fixed.reread_material(gl);
        }
        self.state.touched = touched.without(Touch::FIXED | Touch::MATERIAL);
    }

    /// Prepares an amplified draw and counts it; `None`: it has to be replayed, and the reason is counted.
    fn amplify(&mut self, gl: &Gl, plan: &Plan, mode: u32, material: bool) -> Option<Amplified> {
        self.read_fixed(gl);
        let atlas = &self.targets.atlas;
        let fixed = self.variants.fixed.as_ref()?;
        let programs = &mut self.variants.programs;
        let how = Programs::allow(&self.state, atlas)
            .and_then(|()| programs.prepare(gl, plan.method, mode, fixed, material, atlas));
        self.state.keep(programs.take_errors());
        self.diagnostics.report.shaders(programs.compiled);
        match how {
            Ok(how) => {
                self.frame.amplifies();
                self.count_draw(plan.method, plan);
                Some(how)
            }
            Err(reason) => {
                self.diagnostics.proving.replayed();
                self.count_draw(Method::Replay, plan);
                self.diagnostics.fallback(reason);
                None
            }
        }
    }

    /// Draws by a generated program, in one call or a few.
    fn draw_amplified(&mut self, gl: &Gl, draw: &mut Draw, how: &Amplified) {
        let (plan, send) = (draw.plan, &mut *draw.send);
        self.prove(gl, plan.shear, draw.hazard, draw.images, &mut |_| {
            send(Send::AsItIs);
        });
        // Several calls (many views, several layers) each start from the same current values.
        let current = match draw.hazard {
            ReplayHazard::Current(e) => Current::take(gl, e, false),
            _ => Current::default(),
        };
        let instanced = plan.method == Method::Instanced;
        let mut first = true;
        let mut call = |count: u32| {
            if !std::mem::take(&mut first) {
                current.put(gl);
            }
            let mode = how.mode;
            send(match instanced {
                true => Send::Instances { mode, count },
                false => Send::InMode(mode),
            });
        };
        let Some(fixed) = &self.variants.fixed else {
            return;
        };
        self.variants.programs.draw(
            gl,
            &mut self.targets.atlas,
            &self.state,
            &self.known.rig,
            plan.shear,
            fixed,
            how,
            &mut call,
        );
    }
}

/// Sets the uniforms of a variant in use for one view: its shift, and the matrices that unproject depths, for a camera at `place` (see
/// [`crate::plan::Rig::position`]).
fn set_view(gl: &Gl, variant: &Variant, images: &Images, plan: &Plan, place: f64, stride: u32) {
    variant.set_views(gl, (plan.shear, plan.flat), &[place], stride);
    for (location, m) in &images.unprojections.uniforms {
        let moved = plan
            .shear
            .map(|shear| camera::unprojection(m, &shear, place));
        variant.set_matrix(gl, *location, &moved.unwrap_or(*m));
    }
}

/// Sets the uniforms of a variant in use for all views that are drawn, each with its layer. Returns the number of views.
fn set_all_views(
    gl: &Gl,
    variant: &Variant,
    plan: &Plan,
    rig: &crate::plan::Rig,
    tiles: &Tiles,
) -> u32 {
    let views: Vec<ViewIndex> = tiles.order().collect();
    let places: Vec<f64> = views.iter().map(|&view| rig.position(view)).collect();
    let layers: Vec<u32> = views.iter().map(|&view| tiles.slot(view)).collect();
    variant.set_views(gl, (plan.shear, plan.flat), &places, tiles.stride);
    variant.set_layers(gl, &layers);
    views.len() as u32
}
