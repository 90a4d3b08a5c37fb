//! Display lists: compiled in runs, executed run by run.

use super::Layer;
use super::draw::{Decided, Draw, Request, UNKNOWN};
use crate::draw::{Drawing, ReplayHazard};
use crate::gl::{Gl, ListName, consts as c, slot};
use crate::plan::decide::Demand;
use crate::plan::{Kind, Unrepresentable};
use crate::state::{Begin, Body, Command, Compiling, Effect, Run, Segment, Start, Touch};

/// GL_MAX_LIST_NESTING is at least 64; deeper calls are ignored by the driver too.
const NESTING: u32 = 64;

impl Layer {
    /// glNewList. Returns the name of the driver's list that the first run is compiled into; `None` where the driver will refuse the call,
    /// which then goes to it unchanged.
    pub fn new_list(&mut self, gl: &Gl, list: ListName, mode: u32) -> Option<ListName> {
        let known = [c::COMPILE, c::COMPILE_AND_EXECUTE].contains(&mode) && !list.is_zero();
        if !known || self.state.list.is_some() || self.state.begin != Begin::Outside {
            return None;
        }
        let name = self.list_name(gl);
        self.state.list = Some(Compiling::new(list, mode, name));
        Some(name)
    }

    pub(super) fn list_name(&self, gl: &Gl) -> ListName {
        self.session.group.lists().name(|name| gl.is_list(name))
    }

    /// Deletes a list of ours and keeps its name for another one.
    pub(super) fn drop_list(&self, gl: &Gl, name: ListName) {
        gl.delete_list(name);
        let mut lists = self.session.group.lists();
        lists.spare(name);
    }

    /// Whether a list is being compiled.
    pub fn compiles(&self) -> bool {
        self.state.list.is_some()
    }

    /// Whether the list that is compiled is between glBegin and glEnd, where its run cannot end.
    pub(super) fn within_listed_primitive(&self) -> bool {
        self.state.list.as_ref().is_some_and(|list| list.between)
    }

    /// Whether what is compiled is executed as well (GL_COMPILE_AND_EXECUTE).
    pub fn executes(&self) -> bool {
        self.state.list.as_ref().is_some_and(Compiling::executes)
    }

    /// Notes a command that is about to be compiled, and the state groups that it touches when the list is called. Begins another run where
    /// the command needs one.
    pub fn compile(&mut self, gl: &Gl, command: Command, touch: Touch) {
        let Some(list) = &self.state.list else {
            return;
        };
        if let Some(start) = list.needs_split(command) {
            self.end_run(gl, start, |_| {});
        }
        if let Some(list) = &mut self.state.list {
            let touch = list.note(command, touch);
            if list.start == Start::Now {
                self.state.touch(touch);
            }
        }
    }

    /// Ends the open run, does something outside of lists, and begins another run.
    fn end_run(&mut self, gl: &Gl, start: Start, outside: impl FnOnce(&mut Self)) {
        let Some(mut list) = self.state.list.take() else {
            return;
        };
        gl.end_list();
        if list.used() {
            let name = self.list_name(gl);
            list.split(name);
            self.ended_run(gl, &list);
        }
        outside(self);
        list.start = start;
        if start == Start::Own {
            self.start_own(gl);
        }
        gl.new_list(list.name(), start.mode());
        self.state.list = Some(list);
    }

    /// After a run was closed: executes what the driver has not executed of it.
    fn ended_run(&mut self, gl: &Gl, list: &Compiling) {
        let Some(run) = list.last() else { return };
        match list.start {
            Start::Own => {
                self.finish_own(gl, run.name);
                self.state.touch(run.touch);
            }
            Start::Now => self.state.touch(run.touch),
            Start::Later if list.executes() => {
                self.state.refresh(gl);
                self.segment(gl, run, 1);
            }
            Start::Later => {}
        }
    }

    /// Before a command that is not compiled: executes what GL_COMPILE_AND_EXECUTE has compiled so far. Between glBegin and glEnd nothing can
    /// be executed.
    pub fn catch_up(&mut self, gl: &Gl) {
        let pending = |l: &Compiling| l.start != Start::Now && l.executes() && !l.between;
        if self.state.list.as_ref().is_some_and(pending) {
            self.end_run(gl, Start::Now, |_| {});
        }
    }

    /// Does work of ours that must not be compiled, even while the program compiles a list. Between glBegin and glEnd in a list the work is
    /// left out.
    pub(super) fn outside_list(&mut self, gl: &Gl, work: impl FnOnce(&mut Self)) {
        match &self.state.list {
            None => work(self),
            Some(list) if list.between => {}
            Some(list) => {
                let start = match list.start {
                    Start::Later if !list.executes() => Start::Later,
                    _ => Start::Now,
                };
                self.end_run(gl, start, work);
            }
        }
    }

    /// Notes what a run has to know of the command that was just compiled: the names of glCallLists, without the list base, or arguments (see
    /// [`Segment::names`]).
    pub fn compiled_names(&mut self, names: &[u32]) {
        if let Some(list) = &mut self.state.list {
            list.note_names(names);
        }
    }

    /// After the driver's glEndList: the program's list becomes one that calls its runs.
    pub fn end_list(&mut self, gl: &Gl) {
        // The driver refuses glEndList between glBegin and glEnd.
        if gl.get_integer(c::LIST_INDEX) != 0 {
            return;
        }
        let Some(mut list) = self.state.list.take() else {
            return;
        };
        if list.enables_srgb {
            self.enable_srgb(gl);
        }
        list.finish();
        // Before the new list takes its name: the run may call the list that had that name before.
        self.ended_run(gl, &list);
        let body = list.body();
        gl.new_list(list.list, c::COMPILE);
        for segment in body.iter() {
            gl.call_list(segment.name);
        }
        gl.end_list();
        let unused = self.session.group.lists().define(list.list, body);
        unused.into_iter().for_each(|name| self.drop_list(gl, name));
    }

    /// Whether a display list is one of ours.
    pub fn owns_list(&self, name: ListName) -> bool {
        let lists = self.session.group.lists();
        lists.owns(name)
    }

    /// After the driver's glGenLists, which has returned `first`: returns the first of the names that the driver would have chosen if ours
    /// did not exist.
    pub fn generated_lists(&mut self, gl: &Gl, first: ListName, count: u32) -> ListName {
        let mut lists = self.session.group.lists();
        if self.within_listed_primitive() {
            lists.generated(first, count);
            return first;
        }
        let names = lists.claim(first, count);
        if names == first {
            return first;
        }
        // Another thread may have claimed some of those that the driver has chosen.
        let unclaimed = lists.unclaimed(first, count);
        if unclaimed.len() == count as usize {
            gl.delete_lists(first, count);
        } else {
            unclaimed.into_iter().for_each(|name| gl.delete_list(name));
        }
        drop(lists);
        // The lock is not held here, because the run that ends may ask for a name.
        self.outside_list(gl, |_| {
            for name in names.0..names.0 + count {
                gl.new_list(ListName(name), c::COMPILE);
                gl.end_list();
            }
        });
        names
    }

    /// After the driver has filled lists with a bitmap each (glXUseXFont), also while the program compiles another list.
    pub fn bitmap_lists(&mut self, gl: &Gl, first: ListName, count: u32) {
        let unused = self.session.group.lists().bitmaps(first, count);
        unused.into_iter().for_each(|name| self.drop_list(gl, name));
    }

    /// After the driver's glDeleteLists.
    pub fn deleted_lists(&mut self, gl: &Gl, first: ListName, count: u32) {
        let unused = self.session.group.lists().delete(first, count);
        unused.into_iter().for_each(|name| self.drop_list(gl, name));
    }

    /// glCallList and glCallLists outside of lists. `lists` has the names where they are known; `call` is the driver's own call.
    pub fn call_lists(&mut self, gl: &Gl, lists: Option<&[ListName]>, call: &mut dyn FnMut()) {
        self.frame
            .calls(lists.and_then(|lists| lists.first().copied()));
        self.execute_lists(gl, lists, call);
        self.frame.calls(None);
    }

    fn execute_lists(&mut self, gl: &Gl, lists: Option<&[ListName]>, call: &mut dyn FnMut()) {
        self.state.refresh(gl);
        let bodies = lists.and_then(|names| {
            names
                .iter()
                .map(|&l| self.body(gl, l))
                .collect::<Option<Vec<_>>>()
        });
        let Some(bodies) = bodies else {
            return self.unknown_list(gl, call);
        };
        let segments = || bodies.iter().flat_map(|b| b.iter());
        let balanced = segments().all(Segment::is_balanced);
        // Empty lists as well reach the driver: Mesa 22.3 flushes current values at each call of a list, and a later glPopAttrib
        // restores only what was flushed.
        let empty = segments().next().is_none();
        let plain = !self.state.makes_pictures() && segments().all(|s| s.run.is_plain());
        if balanced && (empty || plain) {
            let touch = segments().fold(Touch::NONE, |t, s| t | s.touch);
            call();
            self.state.touch(touch);
            return;
        }
        if self.text(gl, &bodies, call) {
            return;
        }
        for body in &bodies {
            for segment in body.iter() {
                self.segment(gl, segment, 1);
            }
        }
    }

    /// Text: each list is a letter, and all are one run of the same kind. One call sends them all, as they are. False where they are something else.
    fn text(&mut self, gl: &Gl, bodies: &[Body], call: &mut dyn FnMut()) -> bool {
        let segments = || bodies.iter().flat_map(|b| b.iter());
        let Some(run @ (Run::Draw | Run::Raster)) = segments().next().map(|s| s.run) else {
            return false;
        };
        if !segments().all(|s| s.run == run && s.is_balanced()) {
            return false;
        }
        let touch = segments().fold(Touch::NONE, |t, s| t | s.touch);
        let current = segments().fold(Effect::NONE, |e, s| e | s.immediate.sets());
        let content = Content {
            current,
            primitives: segments().all(|s| s.primitives),
            lines_or_points: segments().any(|s| s.lines_or_points),
            material: segments().any(|s| s.immediate.changes_material()),
        };
        self.run(gl, run, touch, content, &mut || {
            touch_current_values(gl, current);
            call();
        });
        true
    }

    /// The runs of a list: empty for a list that does not exist, `None` where only the driver knows its contents.
    fn body(&self, gl: &Gl, list: ListName) -> Option<Body> {
        let lists = self.session.group.lists();
        let known = lists.body(list);
        known.or_else(|| (!gl.is_list(list)).then(Body::default))
    }

    fn segment(&mut self, gl: &Gl, segment: &Segment, depth: u32) {
        if self.state.begin != Begin::Outside {
            return self.inside(gl, segment);
        }
        if let Some(mode) = segment.opens
            && self.state.makes_pictures()
        {
            self.start_recording(mode);
            self.lists.opened_by(segment.name);
            let touch = self.touched_by_run(gl, segment);
            return self.state.touch(touch);
        }
        match segment.run {
            Run::List(list) => self.nested(gl, &[list], depth),
            Run::Lists => {
                let base = gl.get_integer(c::LIST_BASE) as u32;
                let names = segment.names.iter();
                let names: Vec<ListName> = names.map(|n| ListName(n.wrapping_add(base))).collect();
                let bodies: Option<Vec<Body>> = names.iter().map(|&l| self.body(gl, l)).collect();
                let send = &mut || gl.call_list(segment.name);
                let text =
                    depth < NESTING && bodies.is_some_and(|bodies| self.text(gl, &bodies, send));
                if !text {
                    self.nested(gl, &names, depth);
                }
            }
            Run::State | Run::Draw | Run::Clear | Run::Raster | Run::Read | Run::Copy => {
                self.run_segment(gl, segment);
            }
            _ => self.command_segment(gl, segment),
        }
    }

    /// Executes a run that is a single command, which the layer makes in the program's place.
    fn command_segment(&mut self, gl: &Gl, segment: &Segment) {
        match segment.run {
            // The driver raises the error for a wrong name.
            Run::DrawBuffers if self.draws_to_zero() => {
                let names = segment.names.clone();
                if let Some((several, names)) = names.split_first()
                    && self.draw_buffers(gl, names, *several != 0).is_none()
                {
                    let call = &mut || gl.call_list(segment.name);
                    self.other_draw_buffers(gl, c::DRAW_FRAMEBUFFER, names, call);
                }
            }
            Run::ReadBuffer(buffer) if self.reads_from_zero() => {
                if self.read_buffer(gl, buffer).is_none() {
                    self.with_true_zero(gl, c::READ_FRAMEBUFFER, &mut || {
                        gl.call_list(segment.name)
                    });
                }
            }
            Run::Blit => {
                if let Ok(arguments) = <&[u32; 10]>::try_from(&*segment.names) {
                    let scaled = is_scaled(&arguments.map(|v| v as i32));
                    self.blit(gl, scaled, &mut |from, to| gl.blit(arguments, from, to));
                }
            }
            Run::Texture(write) => {
                self.listed_texture(gl, write, &mut || gl.call_list(segment.name));
            }
            Run::ClearAll => {
                let mask = segment.names.first().copied().unwrap_or(0);
                self.clear(gl, mask, &mut || gl.call_list(segment.name));
            }
            Run::Accum => {
                if let &[op, value] = &*segment.names {
                    let call = &mut || gl.call_list(segment.name);
                    self.accum(gl, op, f32::from_bits(value), call);
                }
            }
            Run::BeginQuery(target, query) => {
                gl.call_list(segment.name);
                self.begun_query(gl, target, query);
            }
            Run::EndQuery(target) => {
                gl.call_list(segment.name);
                self.ended_query(target);
            }
            _ => self.run_segment(gl, segment),
        }
    }

    /// Executes a run of commands that the driver makes.
    fn run_segment(&mut self, gl: &Gl, segment: &Segment) {
        let attribs = (!segment.is_balanced()).then(|| gl.get_integer(c::ATTRIB_STACK_DEPTH));
        let sets = segment.immediate.sets();
        let content = Content {
            current: segment.immediate.must_restore(),
            primitives: segment.primitives,
            lines_or_points: segment.lines_or_points,
            material: segment.immediate.changes_material(),
        };
        let touch = self.touched_by_run(gl, segment);
        self.run(gl, segment.run, touch, content, &mut || {
            touch_current_values(gl, sets);
            gl.call_list(segment.name);
        });
        match (segment.opens, attribs) {
            (Some(_), _) => self.state.begin = Begin::Direct,
            (None, Some(depth)) => self.attribs_after_run(gl, depth, segment),
            _ => {}
        }
    }

    /// Executes a run that is called between glBegin and glEnd.
    fn inside(&mut self, gl: &Gl, segment: &Segment) {
        if self.state.begin == Begin::Direct {
            gl.call_list(segment.name);
            if segment.closes {
                self.state.begin = Begin::Outside;
            }
        } else if segment.closes {
            self.lists.closed_by(segment.name);
            self.end(gl);
        } else {
            let name = segment.name.0;
            self.record(slot::glCallList, Effect::UNKNOWN, |rec| rec.u32(name));
        }
    }

    /// Whether a list that is called within a primitive ends it.
    pub fn closes(&self, list: ListName) -> bool {
        let lists = self.session.group.lists();
        let mut next = list;
        for _ in 0..NESTING {
            let body = lists.body(next);
            match body.as_deref().and_then(<[Segment]>::first) {
                Some(first) if first.closes => return true,
                Some(Segment {
                    run: Run::List(list),
                    ..
                }) => next = *list,
                _ => return false,
            }
        }
        false
    }

    /// Calls a list that ends the primitive that is being recorded. The driver must be outside of glBegin and glEnd.
    pub fn close_by_list(&mut self, gl: &Gl, list: ListName) {
        self.nested(gl, &[list], 0);
    }

    fn nested(&mut self, gl: &Gl, lists: &[ListName], depth: u32) {
        if depth >= NESTING {
            return;
        }
        for &list in lists {
            match self.body(gl, list) {
                Some(body) => body.iter().for_each(|s| self.segment(gl, s, depth + 1)),
                None => self.unknown_list(gl, &mut || gl.call_list(list)),
            }
        }
    }

    /// Calls a list whose contents only the driver knows.
    fn unknown_list(&mut self, gl: &Gl, call: &mut dyn FnMut()) {
        let request = Request {
            demand: Demand::Everything(Unrepresentable::ForeignLists),
            surfaces: false,
            ..Request::of(Kind::List)
        };
        let hazard = ReplayHazard::Anything {
            rects: true,
            projection: true,
            current: Effect::NONE,
        };
        self.draw_list(gl, &request, hazard, UNKNOWN, call);
        self.state.touched = Touch::ALL;
    }

    /// Draws with compiled commands, which are sent as they are.
    fn draw_list(
        &mut self,
        gl: &Gl,
        request: &Request,
        hazard: ReplayHazard,
        drawing: Drawing,
        call: &mut dyn FnMut(),
    ) {
        let Decided { plan, images } = self.decide(gl, request);
        self.execute(
            gl,
            &mut Draw {
                plan: &plan,
                images: &images,
                hazard,
                drawing,
                amplifiable: false,
                views: None,
                send: &mut |_| call(),
            },
        );
    }

    /// Executes one run, or several of the same kind.
    fn run(&mut self, gl: &Gl, run: Run, touch: Touch, content: Content, call: &mut dyn FnMut()) {
        match run {
            Run::Open
            | Run::State
            | Run::List(_)
            | Run::Lists
            | Run::Blit
            | Run::Texture(_)
            | Run::ClearAll
            | Run::Accum
            | Run::BeginQuery(..)
            | Run::EndQuery(_)
            | Run::DrawBuffers
            | Run::ReadBuffer(_) => call(),
            Run::Draw => self.draw_run(gl, touch, content, call),
            Run::Clear => self.draw(
                gl,
                Kind::Clear {
                    depths: true,
                    whole: 0,
                },
                call,
            ),
            Run::Raster => self.draw(gl, Kind::Pixels, call),
            // Only the driver's list knows which columns are read.
            Run::Read => self.read(gl, 0, i32::MAX, call),
            Run::Copy => self.copy_pixels(gl, 0, i32::MAX, call),
        }
        self.state.touch(touch);
        if touch.has(Touch::RASTER) {
            self.placed_raster(gl);
        } else if touch.has(Touch::WINDOW_POS) {
            self.placed_in_window();
        }
    }

    fn draw_run(&mut self, gl: &Gl, touch: Touch, content: Content, call: &mut dyn FnMut()) {
        // The list changes the current matrix, which is the projection.
        let projection = touch.has(Touch::MATRIX) && self.state.matrices.mode == c::PROJECTION;
        let rects = touch.has(Touch::RECTS);
        let request = Request {
            demand: match (projection || rects, content.lines_or_points) {
                (true, _) => Demand::Everything(Unrepresentable::ListOfCameras),
                (false, true) => Demand::LinesOrPoints,
                (false, false) => Demand::None,
            },
            surfaces: content.primitives && !content.lines_or_points,
            ..Request::of(Kind::List)
        };
        let hazard = match (content.current, content.primitives) {
            (Effect::NONE, true) => ReplayHazard::None,
            (current, true) => ReplayHazard::Current(current),
            (current, false) => ReplayHazard::Anything {
                rects,
                projection,
                current,
            },
        };
        let drawing = Drawing {
            material: content.material,
            ..UNKNOWN
        };
        self.draw_list(gl, &request, hazard, drawing, call);
    }
}

/// Contents of runs that draw.
#[derive(Clone, Copy, Debug)]
struct Content {
    /// The current values that they start from and change.
    current: Effect,
    /// They are primitives and current values, and nothing else.
    primitives: bool,
    /// There may be lines or points among them.
    lines_or_points: bool,
    /// They may change the material.
    material: bool,
}

/// Sets a current value to itself. This has to be called before the driver calls a list that sets current values. Some current value,
/// whichever, must have been set by a call since the last such list. Otherwise, at the next change of state, Mesa 22.3 once more sets the
/// values from before the list's vertices.
pub(super) fn touch_current_values(gl: &Gl, sets: Effect) {
    if sets != Effect::NONE {
        gl.touch_current();
    }
}

/// Whether a glBlitFramebuffer with these arguments, in the order of the command, scales or mirrors the picture.
pub fn is_scaled(arguments: &[i32; 10]) -> bool {
    let [x0, y0, x1, y1, to_x0, to_y0, to_x1, to_y1, ..] = *arguments;
    let size = |a: i32, b: i32| b.wrapping_sub(a);
    size(x0, x1) != size(to_x0, to_x1) || size(y0, y1) != size(to_y0, to_y1)
}
