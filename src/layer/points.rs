//! Points for all views at once.
//!
//! Where the window is the panel, they are drawn to the samples that this shows, which are taken out of the tiles before the first of them and put back before anything else is
//! drawn or read; the program's own view is replayed as ever. Elsewhere a geometry shader emits each point again for each view, to the layer of that.

use super::draw::{Draw, Send};
use super::own_variants::{Entered, VariantUse};
use super::surfaces::Surfaces;
use super::{Layer, keep_bindings};
use crate::atlas::{Samples, Tiles};
use crate::config::{CaptureWhat, Filter, Output};
use crate::display::{Lens, Placement};
use crate::draw::{
    Current, Drawing, FixedState, POINTS_AT_ONCE, PointProgram, PointRules, Programs, ReplayHazard,
};
use crate::gl::{Gl, VertexArrayName, consts as c};
use crate::interleave::shader::{DEPTH_UNIT, Pass, SEEN_UNIT, Samples as Step, VIEWS_UNIT};
use crate::interleave::{PanelPlacement, Program};
use crate::plan::reason::{Reason, Replayed};
use crate::plan::{Method, Plan};
use crate::state::{BACK, Neutral};
use crate::view::ViewIndex;

/// The most views: as many as the uniforms of the shaders hold.
const VIEWS: u32 = crate::fixed::VIEWS;

/// The samples, and what draws to them.
#[derive(Debug, Default)]
pub(super) struct MultiViewPoints {
    samples: Option<Samples>,
    /// What their views were found for.
    seen: Option<(Placement, Option<Lens>)>,
    /// By [`Step`]; none before they are wanted, and empty where the driver compiles none.
    passes: Option<Vec<(Step, Program)>>,
    rules: Option<PointRules>,
    /// The tiles lack what was drawn to the samples.
    unflushed: bool,
    /// Points that are disks of surfaces.
    pub(super) surfaces: Surfaces,
}

impl MultiViewPoints {
    pub(super) fn samples(&self) -> Option<&Samples> {
        self.samples.as_ref()
    }

    /// Hands the samples over, for deletion.
    pub(super) fn take(&mut self) -> Option<Samples> {
        self.seen = None;
        self.unflushed = false;
        self.samples.take()
    }

    /// The names of the passes.
    pub(super) fn programs(&self) -> impl Iterator<Item = crate::gl::ProgramName> {
        let all = self.passes.iter().flatten();
        all.map(|(_, program)| program.name())
    }
}

impl Layer {
    /// Prepares a draw of points and counts it; none: it has to be replayed, and the reason is counted.
    pub(super) fn prepare_points(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        drawing: &Drawing,
    ) -> Option<PointProgram> {
        if self.is_mono() {
            // All strategies draw such a frame alike.
            self.count_draw(Method::Replay, plan);
            return None;
        }
        if self.state.has.compatibility && gl.is_enabled(c::POINT_SMOOTH) {
            // Their coverage is the driver's. Measured on llvmpipe 22.3: they are torn after a geometry shader.
            self.diagnostics.proving.replayed();
            self.count_draw(Method::Replay, plan);
            self.diagnostics
                .fallback(Reason::Replayed(Replayed::SmoothPoints));
            return None;
        }
        let sampled = match self.may_draw_to_samples(gl, plan) {
            true => self.points_to_samples(gl, plan, drawing).ok(),
            false => None,
        };
        let ready = match sampled {
            Some(how) => Ok(how),
            None => self.points_to_layers(gl, plan, drawing),
        };
        match ready {
            Ok(how) => {
                self.frame.amplifies();
                self.count_draw(Method::Points, plan);
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

    fn points_to_samples(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        drawing: &Drawing,
    ) -> Result<PointProgram, Reason> {
        let how = if plan.variant {
            let program = self.state.in_use.program;
            let variant = self.link_other(gl, program, VariantUse::Points);
            let variant = variant.map_err(Reason::NoPoints)?;
            let units = self.variants.own.units(gl, program);
            let units = units.into_iter().map(|(unit, _)| unit).collect();
            PointProgram::by_variant(variant, units)
        } else {
            let material = drawing.material;
            self.generated(gl, |programs, fixed| {
                programs.prepare_points(gl, fixed, material)
            })?
        };
        match self.points.unflushed || self.gather_samples(gl) {
            true => Ok(how),
            false => Err(Reason::Compile),
        }
    }

    fn points_to_layers(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        drawing: &Drawing,
    ) -> Result<PointProgram, Reason> {
        let framebuffer = self.state.framebuffers.draw;
        let layered = match framebuffer.is_zero() {
            true => self.targets.atlas.layered().is_some(),
            false => {
                let target = self.targets.offscreen.target(gl, framebuffer);
                target.layered().is_some()
            }
        };
        let full = self.targets.atlas.tiles.grid.is_full() || !framebuffer.is_zero();
        let able = layered && !gl.is_es() && self.session.support.point_quads();
        let hindrances = [
            (!full, Replayed::TilesApart),
            (!able, Replayed::NoLayers),
            (self.queries.feeds(), Replayed::Counted),
            (
                self.state.rectangles.are_several(),
                Replayed::PointsInViewports,
            ),
        ];
        if let Some((_, why)) = hindrances.into_iter().find(|(hinders, _)| *hinders) {
            return Err(Reason::Replayed(why));
        }
        if plan.variant {
            let program = self.state.in_use.program;
            let variant = self.link_other(gl, program, VariantUse::PointLayers);
            variant.map_err(Reason::NoPoints)?;
            return Ok(PointProgram::by_variant_to_layers());
        }
        let (views, material) = (self.session.config.views, drawing.material);
        let surfaces = self.session.config.surfaces;
        self.generated(gl, |programs, fixed| {
            programs.prepare_layered_points(gl, fixed, (material, surfaces), views)
        })
    }

    /// Prepares a program that is generated for the state of fixed function.
    fn generated(
        &mut self,
        gl: &Gl,
        prepare: impl FnOnce(&mut Programs, &FixedState) -> Result<PointProgram, Reason>,
    ) -> Result<PointProgram, Reason> {
        self.read_fixed(gl);
        let fixed = self.variants.fixed.as_ref().ok_or(Reason::Compile)?;
        let programs = &mut self.variants.programs;
        let how = prepare(programs, fixed);
        self.state.keep(programs.take_errors());
        self.diagnostics.report.shaders(programs.compiled);
        how
    }

    /// Whether the window's points may be drawn to the samples of the panel now: it shows the views pixel by pixel, and nobody wants whole views.
    fn may_draw_to_samples(&self, gl: &Gl, plan: &Plan) -> bool {
        let (session, tiles, state) = (&self.session, &self.targets.atlas.tiles, &self.state);
        let captured = session.config.capture.as_ref().map(|capture| capture.what);
        let placement = self.placement();
        let panel = self.output() == Output::Panel
            && session.config.filter == Filter::Nearest
            && session.panel.size.is_none()
            && self.window_output().is_none()
            && !gl.is_es()
            && session.support.point_quads()
            && tiles.views <= VIEWS;
        let same = tiles.grid.is_full()
            && [tiles.width, tiles.height] == [placement.width, placement.height];
        let whole = self.targets.undrawn
            || session.config.prove.is_some()
            || captured.is_some_and(|what| what != CaptureWhat::Output);
        // Samples have one value each, and no stencil.
        let plain = state.framebuffers.draw.is_zero()
            && !session.config.surfaces
            && !state.framebuffers.draws_front()
            && !self.targets.atlas.has_front()
            && !self.targets.atlas.multisampled()
            && !state.rectangles.are_several()
            && !self.queries.feeds()
            && !gl.is_enabled(c::STENCIL_TEST);
        let upright =
            !state.has.clip_control || gl.get_integer(c::CLIP_ORIGIN) as u32 != c::UPPER_LEFT;
        // Planes of fixed function cut the corners of quads, unless a generated shader gives them the distance of the point.
        let cut = plan.variant && (0..8).any(|i| gl.is_enabled(c::CLIP_DISTANCE0 + i));
        panel && same && !whole && plain && upright && !cut
    }

    /// Draws points for all views.
    pub(super) fn draw_points(&mut self, gl: &Gl, draw: &mut Draw, how: &PointProgram) {
        match how.is_to_layers() {
            true => self.draw_points_to_layers(gl, draw, how),
            false => self.draw_points_to_samples(gl, draw, how),
        }
    }

    fn draw_points_to_layers(&mut self, gl: &Gl, draw: &mut Draw, how: &PointProgram) {
        self.flush_points(gl);
        self.prove_by_variant(gl, draw);
        let (program, plan) = (self.state.in_use.program, draw.plan);
        let current = match draw.hazard {
            ReplayHazard::Current(effect) => Current::take(gl, effect, false),
            _ => Current::default(),
        };
        let surface = self.surface_of(gl, draw);
        let (send, mut first) = (&mut *draw.send, true);
        let mut call = || {
            // Each batch of views starts from the same current values.
            if !std::mem::take(&mut first) {
                current.put(gl);
            }
            send(Send::InMode(c::POINTS));
        };
        let sizes = match (surface, self.session.config.surfaces) {
            (Some(surface), _) => surface.uniform,
            (None, true) => [0.0, 0.0, self.size_of_points(gl, plan.variant), 0.0],
            (None, false) => [0.0; 4],
        };
        let mut to_layers = |layer: &mut Layer| {
            layer.in_layers(gl, |layer, tiles| {
                if how.is_variant() {
                    layer.draw_points_by_variant(gl, (plan, sizes), tiles, &mut call);
                } else if let Some(fixed) = &layer.variants.fixed {
                    let by = (&layer.known.rig, plan.shear);
                    let programs = &mut layer.variants.programs;
                    let (state, how) = (&layer.state, (how, sizes));
                    programs.draw_layered_points(gl, state, by, tiles, fixed, how, &mut call);
                }
            });
        };
        match surface {
            Some(surface) => self.draw_surface(gl, &surface, to_layers),
            None => to_layers(self),
        }
        gl.use_program(program);
    }

    fn draw_points_by_variant(
        &mut self,
        gl: &Gl,
        (plan, sizes): (&Plan, [f32; 4]),
        tiles: &Tiles,
        call: &mut dyn FnMut(),
    ) {
        let program = self.state.in_use.program;
        let with = VariantUse::PointLayers;
        let Some(Entered { variant, .. }) = self.variants.own.enter(gl, program, with) else {
            return;
        };
        variant.set_sizes(gl, sizes);
        let views: Vec<ViewIndex> = tiles.order().collect();
        for views in views.chunks(POINTS_AT_ONCE as usize) {
            let places = views.iter().map(|&view| self.known.rig.position(view));
            let places: Vec<f64> = places.collect();
            let layers: Vec<u32> = views.iter().map(|&view| tiles.slot(view)).collect();
            variant.set_views(gl, (plan.shear, plan.flat), &places, tiles.stride);
            variant.set_layers(gl, &layers);
            call();
        }
    }

    /// Draws points to the samples of the panel, and in the program's own view.
    fn draw_points_to_samples(&mut self, gl: &Gl, draw: &mut Draw, how: &PointProgram) {
        let current = match draw.hazard {
            ReplayHazard::Current(effect) => Current::take(gl, effect, false),
            _ => Current::default(),
        };
        let (program, plan) = (self.state.in_use.program, draw.plan);
        let views = self.session.config.views;
        if how.is_variant()
            && let Some(Entered { variant, .. }) =
                self.variants.own.enter(gl, program, VariantUse::Points)
        {
            let rig = &self.known.rig;
            let places: Vec<f64> = ViewIndex::all(views)
                .map(|view| rig.position(view))
                .collect();
            let stride = self.targets.atlas.tiles.stride;
            variant.set_views(gl, (plan.shear, plan.flat), &places, stride);
        }
        let rules = *self
            .points
            .rules
            .get_or_insert_with(|| PointRules::ask(gl, self.state.has.compatibility));
        if let Some(samples) = &self.points.samples {
            self.queries.pause(gl);
            let send = &mut *draw.send;
            self.variants.programs.draw_points(
                gl,
                &self.state,
                (samples, self.targets.atlas.flipped),
                (&self.known.rig, plan.shear, views),
                &rules,
                how,
                &mut || send(Send::InMode(c::POINTS)),
            );
            self.queries.resume(gl);
        }
        gl.use_program(program);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, self.targets.atlas.framebuffer());
        self.targets.atlas.forget_row();
        current.put(gl);
        draw.views = Some([].into_iter().collect());
        self.replay_in(gl, draw);
        self.points.unflushed = true;
    }

    /// Takes the samples that the panel shows out of the tiles; false where that cannot be done.
    fn gather_samples(&mut self, gl: &Gl) -> bool {
        self.state.keep_errors(gl);
        let done = self.in_neutral(gl, |layer, neutral| layer.gather(gl, neutral));
        self.drain_own_errors(gl);
        done
    }

    fn gather(&mut self, gl: &Gl, neutral: &Neutral) -> bool {
        let glsl = self.session.support.glsl;
        let passes = self.points.passes.get_or_insert_with(|| {
            let made = Step::ALL.map(|step| {
                let program = Program::new(gl, glsl, Pass::Samples(step));
                program.ok().map(|program| (step, program))
            });
            made.into_iter().flatten().collect()
        });
        if passes.len() < Step::ALL.len() {
            return false;
        }
        let panel = PanelPlacement {
            display: self.session.display(),
            placement: self.placement(),
        };
        let of = (panel.placement, panel.display.lens());
        let interleaver = &mut self.targets.interleaver;
        let Some((period, whole)) =
            interleaver.bind_views(gl, neutral, self.session.config, &panel)
        else {
            return false;
        };
        let vertex_array = interleaver.vertex_array();
        let parts = if whole { 1 } else { 3 };
        let wanted = ([self.state.window.width, self.state.window.height], parts);
        let there = self.points.samples.as_ref();
        if there.is_none_or(|samples| (samples.size, samples.parts) != wanted) {
            if let Some(old) = self.points.take() {
                old.delete(gl);
            }
            let (names, window) = (&mut self.targets.names, &self.state.window);
            let flipped = self.targets.atlas.flipped;
            // The mask is bound at another unit.
            gl.active_texture(c::TEXTURE0 + SEEN_UNIT);
            let made = keep_bindings(gl, || Samples::new(gl, names, window, flipped, parts));
            self.points.samples = made;
        }
        let words = self.sample_words(period, parts, None);
        let (Some(samples), Some(passes)) = (&self.points.samples, &self.points.passes) else {
            return false;
        };
        let [width, height] = samples.size.map(|n| n as i32);
        gl.viewport(0, 0, width * parts as i32, height);
        if self.points.seen != Some(of) {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, samples.seen_framebuffer);
            run(gl, passes, Step::Views, &words, vertex_array);
            self.points.seen = Some(of);
        }
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, samples.framebuffer);
        let atlas = &self.targets.atlas;
        bind_sources(gl, samples, [atlas.sampled(BACK), atlas.depth]);
        with_depths(gl, self.state.window.srgb, || {
            run(gl, passes, Step::Gather, &words, vertex_array);
        });
        true
    }

    /// Puts what was drawn to the samples back into the tiles, if there is any.
    pub fn flush_points(&mut self, gl: &Gl) {
        if !std::mem::take(&mut self.points.unflushed) {
            return;
        }
        self.state.keep_errors(gl);
        self.in_neutral(gl, |layer, _| layer.scatter(gl));
        self.drain_own_errors(gl);
    }

    fn scatter(&mut self, gl: &Gl) {
        let vertex_array = self.targets.interleaver.vertex_array();
        let (Some(samples), Some(passes)) = (&self.points.samples, &self.points.passes) else {
            return;
        };
        let (own, tiles) = (self.targets.atlas.tiles.own(), self.targets.atlas.tiles);
        bind_sources(gl, samples, [samples.color, samples.depth]);
        let parts = samples.parts;
        let srgb = self.state.window.srgb;
        for view in tiles.order().filter(|view| *view != own) {
            let words = self.sample_words([1; 2], parts, Some(view));
            let x = self.targets.atlas.enter(gl, view);
            gl.viewport(x, 0, tiles.width as i32, tiles.height as i32);
            with_depths(gl, srgb, || {
                run(gl, passes, Step::Scatter, &words, vertex_array)
            });
        }
    }

    /// The words of `struct Uniforms` in `shaders/samples.wgsl`.
    fn sample_words(&self, period: [u32; 2], parts: u32, view: Option<ViewIndex>) -> [u32; 12] {
        let atlas = &self.targets.atlas;
        let tiles = &atlas.tiles;
        let left = view.map_or(0, |view| tiles.place(view).1);
        [
            tiles.width,
            tiles.height,
            period[0],
            period[1],
            tiles.stride,
            tiles.columns,
            tiles.views,
            u32::from(atlas.flipped),
            parts,
            view.map_or(0, |view| view.0),
            left,
            0,
        ]
    }
}

fn bind_sources(gl: &Gl, samples: &Samples, [color, depth]: [crate::gl::TextureName; 2]) {
    gl.active_texture(c::TEXTURE0 + SEEN_UNIT);
    gl.bind_texture(c::TEXTURE_2D, samples.seen);
    for (unit, texture) in [(DEPTH_UNIT, depth), (VIEWS_UNIT, color)] {
        gl.active_texture(c::TEXTURE0 + unit);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, texture);
    }
}

fn run(
    gl: &Gl,
    passes: &[(Step, Program)],
    step: Step,
    words: &[u32],
    vertex_array: VertexArrayName,
) {
    if let Some((_, program)) = passes.iter().find(|(known, _)| *known == step) {
        program.bind(gl, words);
        gl.draw_triangle(vertex_array);
    }
}

/// Runs a pass that writes all depths, in neutral state.
fn with_depths(gl: &Gl, srgb: bool, pass: impl FnOnce()) {
    let mask = gl.get_integer(c::DEPTH_WRITEMASK) as u8;
    let func = gl.get_integer(c::DEPTH_FUNC) as u32;
    gl.enable(c::DEPTH_TEST);
    gl.depth_mask(1);
    gl.depth_func(c::ALWAYS);
    if srgb {
        gl.enable_srgb(true);
    }
    pass();
    if srgb {
        gl.enable_srgb(false);
    }
    gl.depth_func(func);
    gl.depth_mask(mask);
    gl.disable(c::DEPTH_TEST);
}
