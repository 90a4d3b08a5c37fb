//! A draw call of the program: refresh, plan, execute, count.

use super::Layer;
use crate::draw::{Again, Amplified, Current, FixedState, replay};
use crate::gl::api::Indices;
use crate::gl::{Gl, Recording, consts as c};
use crate::plan::{Kind, Method, Plan, plan};
use crate::state::{Begin, Effect, Immediate, Touch};

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

/// The key of the report for a method.
fn method_name(m: Method) -> &'static str {
    match m {
        Method::Once => "once",
        Method::Replay => "replay",
        Method::Instanced => "instanced",
        Method::Geometry => "geometry",
    }
}

/// The key of the report for what a draw is.
fn class(plan: &Plan) -> &'static str {
    match (plan.method, plan.shear) {
        (Method::Once, _) => "off screen",
        (_, Some(_)) => "scene",
        (_, None) => "flat",
    }
}

impl Primitives {
    fn mode(&self) -> u32 {
        match *self {
            Primitives::Arrays { mode, .. } | Primitives::Elements { mode, .. } => mode,
        }
    }
}

impl Layer {
    /// Any draw that the driver can be asked to make again; `call` makes it.
    pub fn draw(&mut self, gl: &Gl, kind: Kind, call: &mut dyn FnMut()) {
        let plan = self.plan(gl, kind);
        if plan.method == Method::Once {
            return call();
        }
        let again = match kind {
            Kind::Clear => Again::Clear,
            Kind::Pixels => Again::Raster,
            _ => Again::Same,
        };
        self.replay(gl, &plan, again, call);
    }

    /// A draw from arrays; `call` is the program's own.
    pub fn primitives(&mut self, gl: &Gl, primitives: Primitives, call: &mut dyn FnMut()) {
        let kind = match primitives {
            Primitives::Arrays { mode, .. } => Kind::Arrays(mode),
            Primitives::Elements { mode, .. } => Kind::Elements(mode),
        };
        let plan = self.plan(gl, kind);
        match plan.method {
            Method::Once => call(),
            Method::Replay => self.replay(gl, &plan, Again::Same, call),
            Method::Instanced | Method::Geometry => {
                let Some(how) = self.amplify(gl, &plan, primitives.mode(), false) else {
                    return self.replay(gl, &plan, Again::Same, call);
                };
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

    /// Prepares an amplified draw and counts it; `None`: it has to be replayed, and the reason is counted.
    fn amplify(&mut self, gl: &Gl, plan: &Plan, mode: u32, material: bool) -> Option<Amplified> {
        if self.state.touched.has(Touch::FIXED) || self.fixed.is_none() {
            self.fixed = Some(FixedState::read(gl, self.driver, self.state.window.samples));
        } else if self.state.touched.has(Touch::MATERIAL)
            && let Some(fixed) = &mut self.fixed
        {
            fixed.reread_material(gl);
        }
        self.state.touched = self.state.touched.without(Touch::FIXED | Touch::MATERIAL);
        let fixed = self.fixed.as_ref()?;
        let how = self
            .programs
            .prepare(gl, plan.method, mode, fixed, material, &self.atlas);
        self.report.shaders(self.programs.compiled);
        match how {
            Ok(how) => {
                self.report.draw(method_name(plan.method), class(plan));
                Some(how)
            }
            Err(reason) => {
                self.report.draw(method_name(Method::Replay), class(plan));
                self.report.fallback(&reason);
                None
            }
        }
    }

    fn amplified(&mut self, gl: &Gl, plan: &Plan, how: &Amplified, draw: &mut dyn FnMut(u32)) {
        if let Some(fixed) = &self.fixed {
            self.programs.draw(
                gl,
                &mut self.atlas,
                &self.state,
                &self.rig,
                plan.shear,
                fixed,
                how,
                draw,
            );
        }
    }

    fn plan(&mut self, gl: &Gl, kind: Kind) -> Plan {
        self.state.refresh(gl);
        if self.state.draws_to_window() {
            self.rig.latch(&self.state.projection);
        }
        let plan = plan(kind, &self.state, &self.rig, &self.means);
        if plan.method != Method::Once {
            self.drawn = true;
        }
        // An amplified draw is counted when it is known that it can be made.
        if matches!(plan.method, Method::Once | Method::Replay) {
            self.report.draw(method_name(plan.method), class(&plan));
        }
        if let Some(r) = &plan.reason {
            self.report.fallback(r);
        }
        plan
    }

    fn replay(&mut self, gl: &Gl, plan: &Plan, again: Again, call: &mut dyn FnMut()) {
        if !replay(
            gl,
            &mut self.atlas,
            &self.state,
            &self.rig,
            plan.shear,
            again,
            call,
        ) {
            self.report.note(
                "the program's attribute stack was full: some draws are in its own view only"
                    .into(),
            );
        }
    }

    /// glBegin: answers whether the calls up to glEnd are to be recorded; if not, they go to the driver, glBegin first.
    pub fn begin(&mut self, gl: &Gl, mode: u32) -> bool {
        self.state.refresh(gl);
        if !self.state.draws_to_window() || mode > c::POLYGON {
            self.state.begin = Begin::Direct;
            return false;
        }
        self.recording.clear();
        self.immediate = Immediate::default();
        self.state.begin = Begin::Recorded(mode);
        true
    }

    /// Where a call between glBegin and glEnd is written.
    #[inline]
    pub fn record(&mut self, slot: usize, effect: Effect) -> &mut Recording {
        self.immediate.note(effect);
        self.recording.call(slot);
        &mut self.recording
    }

    /// glEnd; answers false where it is the driver's own.
    pub fn end(&mut self, gl: &Gl) -> bool {
        let Begin::Recorded(mode) = std::mem::replace(&mut self.state.begin, Begin::Outside) else {
            return false;
        };
        let plan = self.plan(gl, Kind::Begin(mode));
        let again = match self.immediate.must_restore() {
            Effect::NONE => Again::Same,
            effects => Again::Current(effects),
        };
        let recording = std::mem::take(&mut self.recording);
        let amplified = match plan.method {
            Method::Instanced | Method::Geometry => {
                self.amplify(gl, &plan, mode, self.immediate.changes_material())
            }
            Method::Once | Method::Replay => None,
        };
        match amplified {
            Some(how) => {
                // Several calls (many views, several layers) each start from the same current values.
                let current = match again {
                    Again::Current(e) => Current::take(gl, e),
                    _ => Current::default(),
                };
                let mut first = true;
                self.amplified(gl, &plan, &how, &mut |_| {
                    if !std::mem::take(&mut first) {
                        current.put(gl);
                    }
                    gl.replay(how.mode, &recording);
                });
            }
            None => self.replay(gl, &plan, again, &mut || gl.replay(mode, &recording)),
        }
        self.recording = recording;
        if self.immediate.changes_material() {
            self.touch(Touch::MATERIAL);
        }
        true
    }

    /// After a glEnd that went to the driver.
    pub fn ended(&mut self) {
        self.state.begin = Begin::Outside;
    }

    /// glNewList: what touches state from now on does so when the list is called. Answers the mode for the driver.
    pub fn new_list(&mut self, list: u32, mode: u32) -> u32 {
        self.list_touch = Touch::NONE;
        self.state.list = Some((list, mode == c::COMPILE_AND_EXECUTE));
        if mode == c::COMPILE_AND_EXECUTE {
            c::COMPILE
        } else {
            mode
        }
    }

    /// glEndList, after the driver's own; answers the list that must now be called.
    pub fn end_list(&mut self) -> Option<u32> {
        let (list, execute) = self.state.list.take()?;
        self.lists.insert(list, self.list_touch);
        execute.then_some(list)
    }

    /// State groups that a command touches: at once, or when the list that is being compiled is called.
    #[inline]
    pub fn touch(&mut self, groups: Touch) {
        if self.state.list.is_some() {
            // The matrix mode at the time of the call is not known.
            let groups = if groups.has(Touch::MATRIX) {
                Touch::DSA_MATRIX
            } else {
                groups
            };
            self.list_touch = self.list_touch | groups;
        } else {
            self.state.touch(groups);
        }
    }

    /// glCallList, glCallLists: `lists` are the names where they are known.
    pub fn call_lists(&mut self, gl: &Gl, lists: Option<&[u32]>, call: &mut dyn FnMut()) {
        if self.state.list.is_some() {
            self.touch(Touch::ALL);
            return call();
        }
        let touches = match lists {
            Some(l) => l.iter().fold(Touch::NONE, |t, l| {
                t | self.lists.get(l).copied().unwrap_or(Touch::ALL)
            }),
            None => Touch::ALL,
        };
        let plan = self.plan(gl, Kind::List);
        if plan.method == Method::Once {
            call();
        } else {
            let matrix = touches.has(Touch::PROJECTION) && self.state.matrix_mode == c::PROJECTION;
            let again = Again::Anything {
                rects: touches.has(Touch::RECTS),
                projection: matrix || touches.has(Touch::MODE),
            };
            self.replay(gl, &plan, again, call);
        }
        self.state.touched = Touch::ALL;
    }
}
