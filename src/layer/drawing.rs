//! A draw call of the program: refresh, plan, execute, count.

mod corners;

use super::programs::{Entered, VariantUse};
use super::{Layer, Support};
use crate::atlas::Surface;
use crate::config::{Class, Output, Projection, Strategy, Word};
use crate::draw::{Amplified, Drawing, FixedState, Programs, ReplayHazard, replay};
use crate::gl::{Gl, Indices, consts as c};
use crate::offscreen::Target;
use crate::plan::class::Why;
use crate::plan::{Classed, Kind, Method, Plan, Ramp, Shear, plan};
use crate::state::{Command, Run, Touch};
use corners::corners;

/// A draw from arrays that may be instanced. Counts, types and modes are GL's.
#[derive(Clone, Copy, Debug)]
pub enum Primitives {
    /// glDrawArrays.
    Arrays {
        /// Primitive mode.
        mode: u32,
        /// First vertex.
        first: i32,
        /// Number of vertices.
        count: i32,
    },
    /// glDrawElements and glDrawRangeElements.
    Elements {
        /// Primitive mode.
        mode: u32,
        /// Number of indices.
        count: i32,
        /// GL_UNSIGNED_BYTE, _SHORT or _INT.
        kind: u32,
        /// The program's pointer.
        indices: Indices,
    },
}

/// A draw of which nothing is known.
pub(super) const UNKNOWN: Drawing = Drawing {
    mode: None,
    vertices: 0,
    cuts: false,
    material: false,
};

/// The key of the report for a method.
pub(super) fn method_name(m: Method) -> &'static str {
    match m {
        Method::Once => "once",
        Method::Replay => "replay",
        Method::Instanced => "instanced",
        Method::Geometry => "geometry",
    }
}

/// The run of a display list that a draw belongs to.
fn run(kind: Kind) -> Run {
    match kind {
        Kind::Clear { .. } => Run::Clear,
        Kind::Pixels => Run::Raster,
        Kind::Begin(_)
        | Kind::Arrays(_)
        | Kind::Elements(_)
        | Kind::Other
        | Kind::List
        | Kind::Accum => Run::Draw,
    }
}

impl Primitives {
    fn mode(&self) -> u32 {
        match *self {
            Primitives::Arrays { mode, .. } | Primitives::Elements { mode, .. } => mode,
        }
    }

    /// What it is made of.
    fn drawing(&self, gl: &Gl, support: &Support) -> Drawing {
        let (Primitives::Arrays { count, .. } | Primitives::Elements { count, .. }) = *self;
        let (mode, count) = (self.mode(), count.max(0).unsigned_abs());
        let lists = || match *self {
            Primitives::Arrays { first, .. } => first >= 0,
            Primitives::Elements { indices, .. } => gl.has_own_indices(indices),
        };
        Drawing {
            mode: Some(mode),
            vertices: u64::from(count),
            cuts: [c::TRIANGLES, c::QUADS].contains(&mode) || !support.restarts(gl) && lists(),
            material: false,
        }
    }

    /// The draw in another mode; as patches also if it is not of triangles or quads by themselves.
    fn send(&self, gl: &Gl, mode: u32) {
        let (Primitives::Arrays { count, .. } | Primitives::Elements { count, .. }) = *self;
        let count_up = count.max(0).unsigned_abs();
        let list = match mode {
            c::PATCHES => corners(self.mode(), count_up),
            _ => None,
        };
        match (*self, list) {
            (Primitives::Arrays { first, count, .. }, None) => gl.draw_arrays(mode, first, count),
            (Primitives::Arrays { first, .. }, Some(mut list)) => {
                let first = first.max(0).unsigned_abs();
                list.iter_mut()
                    .for_each(|at| *at = at.saturating_add(first));
                gl.draw_listed(mode, &list);
            }
            (
                Primitives::Elements {
                    count,
                    kind,
                    indices,
                    ..
                },
                None,
            ) => gl.draw_elements(mode, count, kind, indices),
            (Primitives::Elements { kind, indices, .. }, Some(mut list)) => {
                if let Some(own) = gl.own_indices(count_up, kind, indices) {
                    let own: Vec<u32> = own.collect();
                    list.iter_mut()
                        .for_each(|at| *at = own.get(*at as usize).copied().unwrap_or(0));
                    gl.draw_listed(mode, &list);
                }
            }
        }
    }
}

impl Layer {
    /// Any draw that the driver can be asked to make again; `call` makes it.
    pub fn draw(&mut self, gl: &Gl, kind: Kind, call: &mut dyn FnMut()) {
        if self.compiles() {
            self.compile(gl, Command::Of(run(kind)), Touch::NONE);
            return call();
        }
        let mut plan = self.plan(gl, kind);
        if plan.method == Method::Once {
            return self.once(gl, call);
        }
        let hazard = match kind {
            Kind::Clear { .. } => ReplayHazard::Clear,
            // The position moves, and the projection matters no more.
            Kind::Pixels if plan.class == Class::Scene => {
                plan.shear = None;
                ReplayHazard::Raster(self.cameras.raster)
            }
            Kind::Pixels => ReplayHazard::Raster(plan.shear.take()),
            _ => ReplayHazard::None,
        };
        self.draw_to_reference(gl, &plan, hazard, UNKNOWN, &mut |_| call());
        self.replay(gl, &plan, hazard, &mut |_| call());
    }

    /// A draw from arrays; `call` is the program's own.
    pub fn primitives(&mut self, gl: &Gl, primitives: Primitives, call: &mut dyn FnMut()) {
        let kind = match primitives {
            Primitives::Arrays { mode, .. } => Kind::Arrays(mode),
            Primitives::Elements { mode, .. } => Kind::Elements(mode),
        };
        if self.compiles() {
            return self.draw(gl, kind, call);
        }
        self.synthesis.surfaces.next = Some(primitives);
        let plan = self.plan(gl, kind);
        self.synthesis.surfaces.next = None;
        match plan.method {
            Method::Once => self.once(gl, call),
            Method::Replay => {
                if self.synthesis.reference.next.is_some() {
                    let drawing = primitives.drawing(gl, &self.session.support);
                    self.draw_to_reference(gl, &plan, ReplayHazard::None, drawing, &mut |mode| {
                        primitives.send(gl, mode);
                    });
                }
                self.replay(gl, &plan, ReplayHazard::None, &mut |_| call());
            }
            Method::Instanced if plan.variant => {
                let mut draw = |views: i32| match primitives {
                    Primitives::Arrays { mode, first, count } => {
                        gl.draw_arrays_instanced(mode, first, count, views)
                    }
                    Primitives::Elements {
                        mode,
                        count,
                        kind,
                        indices,
                    } => gl.draw_elements_instanced(mode, count, kind, indices, views),
                };
                self.draw_instances(gl, &plan, &mut draw, call);
            }
            Method::Instanced | Method::Geometry => {
                let Some(how) = self.amplify(gl, &plan, primitives.mode(), false) else {
                    return self.replay(gl, &plan, ReplayHazard::None, &mut |_| call());
                };
                self.prove(gl, plan.shear, ReplayHazard::None, &mut |_| call());
                let instanced = plan.method == Method::Instanced;
                let mut draw = |views: u32| match primitives {
                    Primitives::Arrays { first, count, .. } if instanced => {
                        gl.draw_arrays_instanced(how.mode, first, count, views as i32)
                    }
                    Primitives::Elements {
                        count,
                        kind,
                        indices,
                        ..
                    } if instanced => {
                        gl.draw_elements_instanced(how.mode, count, kind, indices, views as i32)
                    }
                    Primitives::Arrays { first, count, .. } => {
                        gl.draw_arrays(how.mode, first, count)
                    }
                    Primitives::Elements {
                        count,
                        kind,
                        indices,
                        ..
                    } => gl.draw_elements(how.mode, count, kind, indices),
                };
                self.amplified(gl, &plan, &how, &mut draw);
            }
        }
    }

    /// Reads the state of fixed function, where it is not known.
    pub(super) fn read_fixed(&mut self, gl: &Gl) {
        if self.state.touched.has(Touch::FIXED) || self.variants.fixed.is_none() {
            self.variants.fixed = Some(FixedState::read(
                gl,
                self.variants.driver,
                self.state.window.samples,
            ));
        } else if self.state.touched.has(Touch::MATERIAL)
            && let Some(fixed) = &mut self.variants.fixed
        {
            fixed.reread_material(gl);
        }
        self.state.touched = self.state.touched.without(Touch::FIXED | Touch::MATERIAL);
    }

    /// Prepares an amplified draw and counts it; `None`: it has to be replayed, and the reason is counted.
    pub(super) fn amplify(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        mode: u32,
        material: bool,
    ) -> Option<Amplified> {
        self.read_fixed(gl);
        let fixed = self.variants.fixed.as_ref()?;
        let how = Programs::allow(&self.state, &self.targets.atlas).and_then(|()| {
            self.variants.programs.prepare(
                gl,
                plan.method,
                mode,
                fixed,
                material,
                &self.targets.atlas,
            )
        });
        self.diagnostics
            .report
            .shaders(self.variants.programs.compiled);
        match how {
            Ok(how) => {
                self.frame.amplifies = true;
                self.diagnostics
                    .report
                    .draw(method_name(plan.method), plan.class.word());
                Some(how)
            }
            Err(reason) => {
                self.diagnostics.proving.replayed();
                self.diagnostics
                    .report
                    .draw(method_name(Method::Replay), plan.class.word());
                self.diagnostics.fallbacks.add(reason);
                None
            }
        }
    }

    pub(super) fn amplified(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        how: &Amplified,
        draw: &mut dyn FnMut(u32),
    ) {
        if let Some(fixed) = &self.variants.fixed {
            self.variants.programs.draw(
                gl,
                &mut self.targets.atlas,
                &self.state,
                &self.cameras.rig,
                plan.shear,
                fixed,
                how,
                draw,
            );
        }
    }

    pub(super) fn plan(&mut self, gl: &Gl, kind: Kind) -> Plan {
        self.explain_last(gl);
        self.state.refresh(gl);
        self.hold(gl, kind);
        let (facts, classed) = self.classify(gl, kind);
        if classed.class == Class::Scene {
            self.cameras.rig.latch(&self.state.projection);
            if self.output() == Output::Rgbd && self.frame.nearer_is_larger.is_none() {
                self.state.read_classification(gl, Touch::RANGE);
                let look = &self.state.classification;
                let ramp = Ramp::of(&self.projections()[0], look.depths, look.zero_to_one);
                self.frame.nearer_is_larger = ramp.map(|ramp| ramp.nearer_is_larger());
            }
        }
        self.watch_depths(gl, kind, &classed);
        self.watch_equal_depths(gl);
        let plan = plan(
            kind,
            &self.state,
            &self.cameras.rig,
            &self.session.capabilities,
            &classed,
        );
        let plan = self.plan_shaders(gl, kind, &classed, plan);
        let plan = self.track_pass(gl, kind, self.uncounted(plan));
        let plan = self.by_instances(gl, kind, plan);
        self.watch_synthesis(gl, kind, &plan, &classed);
        self.watch_mono(gl, kind, &plan);
        let told = match classed.why {
            Why::Rule(_) => classed,
            _ if plan.variant => Classed {
                class: plan.class,
                why: Why::Shaders,
                ..classed
            },
            _ => classed,
        };
        self.explain_this(&facts, &told);
        self.prove_this(gl, &facts, &plan);
        if plan.method == Method::Once {
            self.queries.drawn();
        } else {
            self.frame.drawn = true;
        }
        // An amplified draw is counted when it is known that it can be made.
        if matches!(plan.method, Method::Once | Method::Replay) {
            self.diagnostics
                .report
                .draw(method_name(plan.method), plan.class.word());
        }
        if let Some(reason) = &plan.reason {
            self.diagnostics.fallbacks.add(reason.clone());
        }
        plan
    }

    /// Some draws of a program are always replayed, such as those of display lists. Instances in layers have the very depths that
    /// these have; views beside each other and what comes out of a geometry shader do not, so from the first draw with GL_EQUAL on
    /// all draws go the same way. A pass before that one, in the program's first frame, is not made again.
    fn watch_equal_depths(&mut self, gl: &Gl) {
        let same_depths = match self.session.capabilities.strategy {
            Strategy::Replay
            | Strategy::Auto
            | Strategy::DepthImage
            | Strategy::Occlusion
            | Strategy::Hybrid => true,
            Strategy::Instanced => {
                self.session.config.clip.is_none() && self.session.support.layers()
            }
            Strategy::Geometry => false,
        };
        if same_depths || self.session.capabilities.together || !self.state.draws_to_window() {
            return;
        }
        self.state.read_classification(gl, Touch::DEPTH);
        self.session.capabilities.together = self.state.classification.equal;
    }

    pub(super) fn replay(
        &mut self,
        gl: &Gl,
        plan: &Plan,
        hazard: ReplayHazard,
        call: &mut dyn FnMut(u32),
    ) {
        let (program, framebuffer) = (self.state.program, self.state.framebuffers.draw);
        if let Some(target) = self
            .targets
            .offscreen
            .take(framebuffer, self.wanted_views())
        {
            return self.replay_aside(gl, target, plan, hazard, call);
        }
        let mut variants = std::mem::take(&mut self.variants.own);
        match plan
            .variant
            .then(|| variants.enter(gl, program, VariantUse::Views))
            .flatten()
        {
            Some(Entered { variant, .. }) => {
                let (rig, stride) = (self.cameras.rig, self.targets.atlas.tiles.stride);
                let unproject = self.unproject(plan);
                self.replay_by(gl, None, None, hazard, &mut |view| {
                    let shifts = (plan.shear, plan.flat);
                    variant.set_views(gl, shifts, &[rig.position(view)], stride);
                    unproject(gl, variant, rig.position(view));
                    call(view);
                });
                gl.use_program(program);
            }
            None => {
                let shear = plan.shear.filter(|_| !plan.variant);
                self.replay_by(gl, None, shear, hazard, call);
            }
        }
        self.variants.own = variants;
    }

    /// To a target that each view has its own of, or the window, with this shift of the projection.
    pub(super) fn replay_by(
        &mut self,
        gl: &Gl,
        target: Option<&mut Target>,
        shear: Option<Shear>,
        hazard: ReplayHazard,
        call: &mut dyn FnMut(u32),
    ) {
        self.prove(gl, shear, hazard, call);
        // Of what queries count, only the own view is counted.
        let bound = std::mem::take(&mut self.variants.sampled);
        let surface: &mut dyn Surface = match target {
            Some(target) => target,
            None => &mut self.targets.atlas,
        };
        let mut queries = std::mem::take(&mut self.queries);
        let (own, mut paused) = (surface.tiles().own(), true);
        queries.pause(gl);
        let sent = replay(
            gl,
            surface,
            &self.state,
            &self.cameras.rig,
            shear,
            hazard,
            true,
            &mut |view| {
                if view == own && std::mem::take(&mut paused) {
                    queries.resume(gl);
                }
                self.targets.offscreen.bind(gl, &bound, view);
                call(view);
            },
        );
        self.queries = queries;
        self.targets.offscreen.unbind(gl, &bound);
        self.variants.sampled = bound;
        if !sent {
            self.targets.mono.lose();
            self.diagnostics.report.note(
                "the program's attribute stack was full: some draws are in its own view only"
                    .into(),
            );
        }
    }

    /// glRasterPos, after the driver's own: the position stands for a point of the scene and moves with the view.
    pub fn placed_raster(&mut self, gl: &Gl) {
        self.state.refresh(gl);
        self.cameras.raster = self.cameras.rig.shear(&self.state.projection);
        self.cameras.raster_placed = self.state.projection_kind();
    }

    /// glWindowPos: the position is one of the window.
    pub fn placed_in_window(&mut self) {
        self.cameras.raster = None;
        self.cameras.raster_placed = Projection::None;
    }

    /// State groups that a command touches; false where it is compiled into a list instead.
    #[inline]
    pub fn touch(&mut self, groups: Touch) -> bool {
        if self.state.list.is_some() {
            return false;
        }
        self.state.touch(groups);
        true
    }
}
