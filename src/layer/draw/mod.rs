//! The path of a draw: observe → decide → apply → execute → observers.
//!
//! A hook calls [`Layer::draw`], [`Layer::primitives`] or a similar method, which makes a [`Request`]. `observe` reads the state that a
//! decision depends on; [`crate::plan::decide`] decides; `apply` makes targets and variants ready; `execute` sends one [`Draw`] to the
//! driver; `observers` report it.

mod apply;
mod corners;
mod execute;
mod observe;
mod observers;
mod primitives;
#[cfg(test)]
mod tests;

pub(super) use execute::Execution;
pub use primitives::Primitives;

use super::Layer;
use super::unprojections::Unprojections;
use crate::atlas::ViewSet;
use crate::config::Class;
use crate::draw::{Drawing, ReplayHazard};
use crate::gl::{Gl, ImageUnit};
use crate::offscreen::Bound;
use crate::plan::decide::Demand;
use crate::plan::{Kind, Method, Plan, decide};
use crate::state::{Command, Run, Touch};
use std::sync::Arc;

/// How often a command is observed and decided at most. Each preparation changes a fact, and there are fewer kinds of them than rounds.
const ROUNDS: usize = 12;

/// A command, as a hook gives it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Request {
    pub(super) kind: Kind,
    /// The arguments of a draw from arrays.
    pub(super) primitives: Option<Primitives>,
    pub(super) demand: Demand,
    /// It may be repeated in the reference image. Display lists are only if they are surfaces and current values alone: generated shaders do
    /// not follow other changes of state within a list, and lines cannot be drawn there.
    pub(super) surfaces: bool,
}

impl Request {
    pub(super) fn of(kind: Kind) -> Self {
        Request {
            kind,
            primitives: None,
            demand: Demand::None,
            surfaces: true,
        }
    }
}

/// The textures and matrices of a draw of which each view has its own.
#[derive(Clone, Debug)]
pub(super) struct Images {
    /// The textures that the draw samples and that differ between the views.
    pub(super) bound: Arc<[Bound]>,
    pub(super) unprojections: Arc<Unprojections>,
    /// What the draw may load from and store to by image units.
    pub(super) units: Arc<[ImageUnit]>,
    /// Some of those differ between the views.
    pub(super) units_differ: bool,
}

impl Images {
    /// Whether the draw reads what differs between the views.
    pub(super) fn differ(&self) -> bool {
        self.units_differ || !self.bound.is_empty()
    }
}

/// A command that was decided, and for which everything is ready.
#[derive(Clone, Debug)]
pub(super) struct Decided {
    pub(super) plan: Plan,
    pub(super) images: Images,
}

/// How a draw is sent to the driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Send {
    /// As the program has sent it.
    AsItIs,
    /// With another primitive mode.
    InMode(u32),
    /// Instanced.
    Instances {
        /// The primitive mode.
        mode: u32,
        /// Number of instances.
        count: u32,
    },
}

/// A draw on its way to the driver, with all that its execution needs.
pub(super) struct Draw<'a> {
    pub(super) plan: &'a Plan,
    pub(super) images: &'a Images,
    /// State that the draw changes, and that its second sending would start from.
    pub(super) hazard: ReplayHazard,
    /// Its primitives.
    pub(super) drawing: Drawing,
    /// It may be sent in another primitive mode, or instanced.
    pub(super) amplifiable: bool,
    /// Those of the drawn views in whose frustum some of it may lie; none: all.
    pub(super) views: Option<ViewSet>,
    pub(super) send: &'a mut dyn FnMut(Send),
}

/// A draw of which nothing is known.
pub(super) const UNKNOWN: Drawing = Drawing {
    mode: None,
    vertices: 0,
    counted: false,
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
        Method::Points => "splats",
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

impl Layer {
    /// Any draw that can be repeated; `call` makes it.
    pub fn draw(&mut self, gl: &Gl, kind: Kind, call: &mut dyn FnMut()) {
        if self.compiles() {
            self.compile(gl, Command::Of(run(kind)), Touch::NONE);
            return call();
        }
        let Decided { mut plan, images } = self.decide(gl, &Request::of(kind));
        let hazard = match kind {
            Kind::Clear { .. } => ReplayHazard::Clear,
            // The raster position is shifted, and the projection no longer matters.
            Kind::Pixels if plan.class == Class::Scene => {
                plan.shear = None;
                ReplayHazard::Raster(self.cameras.raster())
            }
            Kind::Pixels => ReplayHazard::Raster(plan.shear.take()),
            _ => ReplayHazard::None,
        };
        self.execute(
            gl,
            &mut Draw {
                plan: &plan,
                images: &images,
                hazard,
                drawing: UNKNOWN,
                amplifiable: false,
                views: None,
                send: &mut |_| call(),
            },
        );
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
        let request = Request {
            primitives: Some(primitives),
            ..Request::of(kind)
        };
        let Decided { plan, images } = self.decide(gl, &request);
        let drawing = match plan.reference.is_some() {
            true => primitives.drawing(gl, &self.session.support),
            false => Drawing {
                mode: Some(primitives.mode()),
                vertices: u64::from(primitives.count()),
                counted: true,
                ..UNKNOWN
            },
        };
        self.execute(
            gl,
            &mut Draw {
                plan: &plan,
                images: &images,
                hazard: ReplayHazard::None,
                drawing,
                amplifiable: true,
                views: None,
                send: &mut |how| primitives.send(gl, how, call),
            },
        );
    }

    /// Observes, decides and applies. The draw can be executed then.
    pub(super) fn decide(&mut self, gl: &Gl, request: &Request) -> Decided {
        self.explain_last(gl);
        self.state.refresh(gl);
        for round in 0..ROUNDS {
            let (facts, images) = self.observe(gl, request);
            if round == 0 {
                self.watch_cuts(gl, &facts);
            }
            match decide(&facts, &self.known, &self.settings()) {
                Ok(decision) => {
                    self.apply(gl, request, decision.effects);
                    self.known = decision.known;
                    self.observe_decision(gl, &facts, &decision.plan);
                    let plan = decision.plan;
                    return Decided { plan, images };
                }
                Err(preparation) => self.prepare(gl, preparation),
            }
        }
        self.undecided(gl, request)
    }

    /// Plans a draw that was not ready after all rounds: it is drawn once, in the program's own view.
    fn undecided(&mut self, gl: &Gl, request: &Request) -> Decided {
        self.diagnostics.report.note(
            "some draws are in the program's own view only: what they need was never ready".into(),
        );
        let (facts, images) = self.observe(gl, request);
        self.known.mono.lose();
        Decided {
            plan: Plan::once(&facts),
            images,
        }
    }

    /// After the driver's glRasterPos: the position stands for a point of the scene and moves with the view.
    pub fn placed_raster(&mut self, gl: &Gl) {
        self.state.refresh(gl);
        let shift = self.known.rig.shear(&self.state.matrices.projection);
        self.cameras
            .place_raster(shift, self.state.projection_kind());
    }

    /// After the driver's glWindowPos: the position is a place in the window and is the same in all views.
    pub fn placed_in_window(&mut self) {
        self.cameras.place_raster_in_window();
    }

    /// Marks state groups that a command touches as stale; false where the command is compiled into a list instead.
    #[inline]
    pub fn touch(&mut self, groups: Touch) -> bool {
        if self.state.list.is_some() {
            return false;
        }
        self.state.touch(groups);
        true
    }
}
