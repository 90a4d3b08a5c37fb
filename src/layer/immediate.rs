//! Immediate mode: recorded between glBegin and glEnd, then drawn in all views.

use super::Layer;
use super::draw::{Decided, Draw, Execution, Request, Send};
use super::lists::touch_current_values;
use super::tracked::Primitive;
use crate::atlas::{Tiles, ViewSet};
use crate::config::Optimisation;
use crate::draw::{Drawing, ReplayHazard};
use crate::gl::consts as c;
use crate::gl::{Ends, Gl, ListName, Recording};
use crate::plan::{Bounds, Kind, Plan};
use crate::state::{Begin, Command, Effect, Touch};
use crate::view::ViewIndex;

/// Number of calls between glBegin and glEnd from which on a display list pays. Measured on llvmpipe 22.3 with 8 views: a frame with it takes
/// 0.83 of the time without it at 100,000 triangles, 0.77 at 10,000, and the same at a few hundred.
///
/// Only triangles go to lists: the driver splits quads in lists along the other diagonal than quads in calls.
const MANY: usize = 1000;
/// Number of views from which on a display list pays.
const SEVERAL: usize = 4;

impl Layer {
    /// Before a glBegin: answers where the calls up to glEnd go.
    pub fn begin(&mut self, gl: &Gl, mode: u32) -> Primitive {
        if self.compiles() {
            self.compile(gl, Command::Begin(mode), Touch::NONE);
            return Primitive::None;
        }
        // A mode that does not exist begins nothing.
        if mode > c::PATCHES || self.feedback_refuses(mode) {
            return Primitive::None;
        }
        self.state.refresh(gl);
        if !self.state.makes_pictures() || mode != c::POINTS {
            self.flush_points(gl);
        }
        if !self.state.makes_pictures() || mode > c::POLYGON {
            self.queries.drawn();
            self.state.begin = Begin::Direct;
        } else {
            self.start_recording(mode);
        }
        self.primitive()
    }

    pub(super) fn start_recording(&mut self, mode: u32) {
        self.lists.start();
        self.state.begin = Begin::Recorded(mode);
    }

    /// Records a call between glBegin and glEnd, whose arguments `write` writes.
    #[inline]
    pub fn record(&mut self, slot: usize, effect: Effect, write: impl FnOnce(&mut Recording)) {
        self.lists.record(slot, effect, write);
    }

    /// After the driver's glEnd: makes the recorded calls.
    pub fn end(&mut self, gl: &Gl) {
        let Begin::Recorded(mode) = std::mem::replace(&mut self.state.begin, Begin::Outside) else {
            return;
        };
        let Decided { plan, images } = self.decide(gl, &Request::of(Kind::Begin(mode)));
        let hazard = self.lists.hazard();
        let recording = self.lists.take();
        let (ends, whole) = (self.lists.ends(), self.lists.is_whole());
        let sets = self.lists.sets();
        let mut list = None;
        let drawing = Drawing {
            mode: Some(mode),
            vertices: recording.calls() as u64,
            counted: false,
            cuts: [c::TRIANGLES, c::QUADS].contains(&mode),
            material: self.lists.changes_material(),
        };
        let execution = self.choose(gl, &plan, &drawing, whole);
        let mut views = None;
        if let Execution::Replay = execution {
            let seeing = self.seeing(gl, mode, &plan, &recording);
            list = self.stream(gl, mode, &recording, hazard, seeing);
            views = Some(seeing);
        }
        let mut send = |how| match (how, list) {
            (Send::InMode(mode), _) => gl.replay(mode, &recording, ends),
            (_, Some(list)) => {
                touch_current_values(gl, sets);
                gl.call_list(list);
            }
            (_, None) => gl.replay(mode, &recording, ends),
        };
        let mut draw = Draw {
            plan: &plan,
            images: &images,
            hazard,
            drawing,
            amplifiable: whole,
            views,
            send: &mut send,
        };
        self.execute_by(gl, &mut draw, &execution);
        if let Some(list) = list {
            self.drop_list(gl, list);
        }
        self.lists.put(recording);
        if self.lists.changes_material() {
            self.state.touch(Touch::MATERIAL);
        }
    }

    /// The drawn views in whose frustum some of it may lie. Only triangles are tested: they are clipped at the sides of the frustum before
    /// they become outlines or points (OpenGL 4.6, 13.7), while wide lines and points may reach in from outside.
    fn seeing(&self, gl: &Gl, mode: u32, plan: &Plan, recording: &Recording) -> ViewSet {
        let (all, tiles, state) = (
            self.targets.atlas.tiles.shown,
            &self.targets.atlas.tiles,
            &self.state,
        );
        let unknown = self.lists.sets().has(Effect::UNKNOWN | Effect::ATTRIB);
        let triangles = (c::TRIANGLES..=c::POLYGON).contains(&mode);
        if self.session.config.disabled.has(Optimisation::Frustum)
            || unknown
            || !triangles
            || !tiles.grid.is_full()
            || !state.in_use.program.is_zero()
            || state.in_use.pipeline != 0
        {
            return all;
        }
        let mut bounds = Bounds::EMPTY;
        if !recording.positions(&mut |position| bounds.add(position)) {
            return all;
        }
        let modelview = gl.get_matrix(c::MODELVIEW_MATRIX);
        let sees = |view: &ViewIndex| {
            let p = plan.shear.map_or(state.matrices.projection, |shear| {
                shear.projection(&state.matrices.projection, self.known.rig.position(*view))
            });
            !bounds.outside(&[0, 1, 3].map(|row| product_row(&p, &modelview, row)))
        };
        let seeing: ViewSet = tiles.order().filter(sees).collect();
        // An ARB vertex program puts vertices elsewhere. Asked last, as it is rarely needed.
        let unseen = tiles.order().any(|view| !seeing.has(view));
        if unseen && self.variants.driver.programs && gl.is_enabled(c::VERTEX_PROGRAM_ARB) {
            return all;
        }
        seeing
    }

    /// Compiles many triangles for several views into a display list, so that the driver copies them once. The caller drops the list after
    /// the draw. None where a list does not pay.
    fn stream(
        &mut self,
        gl: &Gl,
        mode: u32,
        recording: &Recording,
        hazard: ReplayHazard,
        views: ViewSet,
    ) -> Option<ListName> {
        let sets = self.lists.sets();
        let pays = !self.session.config.disabled.has(Optimisation::Lists)
            && recording.calls() >= MANY
            && Tiles {
                shown: views,
                ..self.targets.atlas.tiles
            }
            .order()
            .count()
                >= SEVERAL;
        let as_it_is = hazard == ReplayHazard::None
            && self.lists.is_whole()
            && !sets.has(Effect::UNKNOWN | Effect::ATTRIB | Effect::MATERIAL);
        if !pays || !as_it_is || !(c::TRIANGLES..=c::TRIANGLE_FAN).contains(&mode) {
            return None;
        }
        let list = self.list_name(gl);
        gl.new_list(list, c::COMPILE);
        gl.replay(mode, recording, Ends::default());
        gl.end_list();
        Some(list)
    }
}

/// A row of P · M, both column-major.
fn product_row(p: &[f32; 16], m: &[f32; 16], row: usize) -> [f32; 4] {
    [0, 4, 8, 12].map(|column: usize| (0..4).map(|i| p[row + 4 * i] * m[column + i]).sum())
}
