//! Queries that count what is drawn, and transform feedback that writes it: only what is drawn in the program's own view is counted and written.
//!
//! A draw in N views would count N times. So the query is ended before the other views are drawn, and begun again for the own one. A query
//! that is begun again forgets its count. After the first draw a query object of ours therefore continues it, and the program gets the sum.

use super::Layer;
use super::feedback::Feedback;
use crate::gl::{BufferName, Gl, QueryName, consts as c};
use std::collections::HashMap;

/// Active and ended queries of a context.
#[derive(Debug, Default)]
pub(super) struct Queries {
    active: Vec<Active>,
    /// By the name of the program's query: its target, and our query objects that have continued it.
    more: HashMap<QueryName, (u32, Vec<QueryName>)>,
    spare: Vec<QueryName>,
    /// The query and mode of conditional rendering, while it is on.
    condition: Option<(QueryName, u32)>,
    feedback: Feedback,
    /// The kind of primitives that active transform feedback takes, where it is known.
    pub(super) fed: Option<u32>,
    /// How many pauses are on: passes are made within passes.
    pauses: u32,
}

#[derive(Debug)]
struct Active {
    target: u32,
    query: QueryName,
    counted: bool,
    more: Vec<QueryName>,
}

/// The part of a query's result that our query objects hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// To be added to the count.
    Count(u64),
    /// Whether anything has passed.
    Any(bool),
    /// Whether the rest of the result is available.
    Available(bool),
}

impl Answer {
    /// The whole result, with the driver's part of it.
    #[must_use]
    pub fn with(self, part: u64) -> u64 {
        match self {
            Answer::Count(count) => count.saturating_add(part),
            Answer::Any(any) => u64::from(any || part != 0),
            Answer::Available(all) => u64::from(all && part != 0),
        }
    }
}

/// The place in a buffer that a result of a query is written to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResultPlace {
    /// None for that at GL_QUERY_BUFFER.
    pub buffer: Option<BufferName>,
    /// The first byte.
    pub at: usize,
    /// 4 or 8.
    pub bytes: usize,
    /// The largest number that fits.
    pub most: u64,
}

const TARGETS: [u32; 14] = [
    c::SAMPLES_PASSED,
    c::ANY_SAMPLES_PASSED,
    c::ANY_SAMPLES_PASSED_CONSERVATIVE,
    c::PRIMITIVES_GENERATED,
    c::VERTICES_SUBMITTED,
    c::PRIMITIVES_SUBMITTED,
    c::VERTEX_SHADER_INVOCATIONS,
    c::TESS_CONTROL_SHADER_PATCHES,
    c::TESS_EVALUATION_SHADER_INVOCATIONS,
    c::GEOMETRY_SHADER_INVOCATIONS,
    c::GEOMETRY_SHADER_PRIMITIVES_EMITTED,
    c::FRAGMENT_SHADER_INVOCATIONS,
    c::CLIPPING_INPUT_PRIMITIVES,
    c::CLIPPING_OUTPUT_PRIMITIVES,
];

/// Targets that count without rasterisation as well. Of a draw that transform feedback writes, they count the call that writes: drivers may split
/// primitives differently there.
const BEFORE_RASTERISATION: [u32; 8] = [
    c::PRIMITIVES_GENERATED,
    c::VERTICES_SUBMITTED,
    c::PRIMITIVES_SUBMITTED,
    c::VERTEX_SHADER_INVOCATIONS,
    c::TESS_CONTROL_SHADER_PATCHES,
    c::TESS_EVALUATION_SHADER_INVOCATIONS,
    c::GEOMETRY_SHADER_INVOCATIONS,
    c::GEOMETRY_SHADER_PRIMITIVES_EMITTED,
];

/// Queries that are ended and begun again together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Those of [`BEFORE_RASTERISATION`].
    BeforeRasterisation,
    /// The others.
    Rasterised,
}

fn kind(target: u32) -> Kind {
    match BEFORE_RASTERISATION.contains(&target) {
        true => Kind::BeforeRasterisation,
        false => Kind::Rasterised,
    }
}

impl Queries {
    /// Whether draws are being counted.
    pub(super) fn active(&self) -> bool {
        !self.active.is_empty()
    }

    /// Something is drawn once instead of per view, so active queries have counted something.
    pub(super) fn drawn(&mut self) {
        self.active.iter_mut().for_each(|a| a.counted = true);
    }

    /// Ends queries and pauses transform feedback, before something is drawn that is not the program's own view.
    pub(super) fn pause(&mut self, gl: &Gl) {
        self.pauses += 1;
        if self.pauses > 1 {
            return;
        }
        self.running().iter().for_each(|&kind| self.stop(gl, kind));
        if self.feedback == Feedback::On {
            gl.pause_transform_feedback();
        }
    }

    /// Goes on after [`Queries::pause`]. The program in use has to be the one that it was then.
    pub(super) fn resume(&mut self, gl: &Gl) {
        self.pauses -= 1;
        if self.pauses > 0 {
            return;
        }
        if self.feedback == Feedback::On {
            gl.resume_transform_feedback();
        }
        for &kind in self.running() {
            self.go_on(gl, kind);
        }
    }

    /// The queries that count now, where none is paused.
    fn running(&self) -> &'static [Kind] {
        match self.feedback {
            Feedback::Held => &[Kind::Rasterised],
            Feedback::Off | Feedback::On => &[Kind::BeforeRasterisation, Kind::Rasterised],
        }
    }

    /// The program has switched transform feedback.
    pub(super) fn set_feedback(&mut self, feedback: Feedback) {
        self.feedback = feedback;
    }

    /// Whether draws are written by transform feedback, which can be paused.
    pub(super) fn feeds(&self) -> bool {
        self.feedback == Feedback::On
    }

    /// Before the call that writes a draw by transform feedback, without rasterisation.
    pub(super) fn start_writing(&self, gl: &Gl) {
        self.stop(gl, Kind::Rasterised);
    }

    /// After [`Queries::start_writing`] and that call: pauses transform feedback while the views of the draw are drawn.
    pub(super) fn hold_feedback(&mut self, gl: &Gl) {
        self.stop(gl, Kind::BeforeRasterisation);
        let written = self
            .active
            .iter_mut()
            .filter(|a| kind(a.target) == Kind::BeforeRasterisation);
        written.for_each(|a| a.counted = true);
        gl.pause_transform_feedback();
        self.feedback = Feedback::Held;
        self.go_on(gl, Kind::Rasterised);
    }

    /// Goes on after [`Queries::hold_feedback`].
    pub(super) fn release_feedback(&mut self, gl: &Gl) {
        gl.resume_transform_feedback();
        self.feedback = Feedback::On;
        self.go_on(gl, Kind::BeforeRasterisation);
    }

    /// Ends queries that count what is drawn.
    fn stop(&self, gl: &Gl, which: Kind) {
        let stopped = self.active.iter().filter(|a| kind(a.target) == which);
        stopped.for_each(|a| gl.end_query(a.target));
    }

    /// Goes on after [`Queries::stop`].
    fn go_on(&mut self, gl: &Gl, which: Kind) {
        let stopped = self.active.iter_mut().filter(|a| kind(a.target) == which);
        for a in stopped {
            let name = if a.counted {
                let spare = &mut self.spare;
                let name = spare.pop().unwrap_or_else(|| {
                    let [name, others @ ..] = gl.gen_queries();
                    spare.extend(others);
                    name
                });
                a.more.push(name);
                name
            } else {
                a.query
            };
            a.counted = true;
            gl.begin_query(a.target, name);
        }
    }

    /// Ends the program's conditional rendering, before drawing of ours that must not depend on it.
    pub(super) fn lift_condition(&self, gl: &Gl) {
        if self.condition.is_some() {
            gl.end_conditional_render();
        }
    }

    /// Begins the program's conditional rendering again.
    pub(super) fn put_condition(&self, gl: &Gl) {
        if let Some((query, mode)) = self.condition {
            gl.begin_conditional_render(query, mode);
        }
    }

    fn forget(&mut self, query: QueryName) {
        if let Some((_, names)) = self.more.remove(&query) {
            self.spare.extend(names);
        }
    }

    /// After the driver's glBeginQuery, which it may have refused.
    pub(super) fn begun(&mut self, gl: &Gl, target: u32, query: QueryName) {
        let known = self.active.iter().any(|a| a.target == target);
        if !TARGETS.contains(&target)
            || known
            || gl.current_query(target) != query
            || query.is_zero()
        {
            return;
        }
        self.forget(query);
        self.active.push(Active {
            target,
            query,
            counted: false,
            more: Vec::new(),
        });
    }

    /// After the driver's glEndQuery.
    pub(super) fn ended(&mut self, target: u32) {
        if let Some(at) = self.active.iter().position(|a| a.target == target) {
            let ended = self.active.swap_remove(at);
            if !ended.more.is_empty() {
                self.more.insert(ended.query, (target, ended.more));
            }
        }
    }

    /// The program deletes queries: ours that have continued them can continue others.
    pub(super) fn deleted(&mut self, queries: &[QueryName]) {
        queries.iter().for_each(|&query| self.forget(query));
    }

    /// The program's query that is active at a target, if it is one that ours may continue.
    pub(super) fn current(&self, target: u32) -> Option<QueryName> {
        let active = self.active.iter().find(|a| a.target == target);
        active.map(|a| a.query)
    }

    /// The query to ask the driver about in the place of one of the program's: while a query of ours continues that, ours is the active one.
    pub(super) fn asked(&self, query: QueryName) -> QueryName {
        let active = self.active.iter().find(|a| a.query == query);
        active.and_then(|a| a.more.last().copied()).unwrap_or(query)
    }

    /// The query by which the driver decides conditional rendering in the place of one of the program's. The driver asks only whether the
    /// result is zero. So it is a query of ours with another result than zero if there is one, or else the program's. `result` waits for the
    /// result of a query.
    pub(super) fn deciding(
        &self,
        query: QueryName,
        result: impl Fn(QueryName) -> u32,
    ) -> QueryName {
        if self.active.iter().any(|a| a.query == query) {
            // The driver refuses the query that is active there.
            return self.asked(query);
        }
        let more = self.more.get(&query).map_or(&[][..], |(_, names)| names);
        let counted = more.iter().copied().find(|&name| result(name) != 0);
        counted.unwrap_or(query)
    }

    /// The program renders by a condition from now on: the query that decides, and the mode; or by none.
    pub(super) fn set_condition(&mut self, condition: Option<(QueryName, u32)>) {
        self.condition = condition;
    }

    /// Whether queries of ours hold a part of the result of an ended query of the program's.
    pub(super) fn is_continued(&self, query: QueryName) -> bool {
        self.more.contains_key(&query)
    }

    /// The part of a result of the program's query that our queries hold, if there are any. `result` asks for a value of a query.
    pub(super) fn answer(
        &self,
        query: QueryName,
        name: u32,
        result: impl Fn(QueryName, u32) -> u32,
    ) -> Option<Answer> {
        let (target, more) = self.more.get(&query)?;
        let mut values = more.iter().map(|&query| match name {
            c::QUERY_RESULT_AVAILABLE => result(query, name),
            _ => result(query, c::QUERY_RESULT),
        });
        Some(match name {
            c::QUERY_RESULT | c::QUERY_RESULT_NO_WAIT => match *target {
                c::ANY_SAMPLES_PASSED | c::ANY_SAMPLES_PASSED_CONSERVATIVE => {
                    // All are waited for, so that the result is available from now on.
                    Answer::Any(values.fold(false, |any, value| any | (value != 0)))
                }
                _ => Answer::Count(values.map(u64::from).sum()),
            },
            c::QUERY_RESULT_AVAILABLE => Answer::Available(values.all(|value| value != 0)),
            _ => return None,
        })
    }
}

impl Layer {
    /// After the driver's glBeginQuery.
    pub fn begun_query(&mut self, gl: &Gl, target: u32, query: QueryName) {
        self.queries.begun(gl, target, query);
    }

    /// After the driver's glEndQuery.
    pub fn ended_query(&mut self, target: u32) {
        self.queries.ended(target);
    }

    /// glDeleteQueries.
    pub fn deleted_queries(&mut self, queries: &[QueryName]) {
        self.queries.deleted(queries);
    }

    /// The answer of glGetQueryiv for GL_CURRENT_QUERY of a target, if a query of ours may be active there.
    pub fn current_query(&self, target: u32) -> Option<QueryName> {
        self.queries.current(target)
    }

    /// Before glBeginConditionalRender: the query for the driver in the place of the program's. This waits for results, which every mode
    /// allows.
    pub fn condition(&mut self, gl: &Gl, query: QueryName) -> QueryName {
        self.catch_up(gl);
        self.state.keep_errors(gl);
        let result = |name| gl.query_object(name, c::QUERY_RESULT);
        self.queries.deciding(query, result)
    }

    /// After the driver's glBeginConditionalRender.
    pub fn begun_condition(&mut self, gl: &Gl, query: QueryName, mode: u32) {
        match gl.get_error() {
            c::NO_ERROR if !self.compiles() => self.queries.set_condition(Some((query, mode))),
            c::NO_ERROR => {}
            // Only the first error is kept, as by the driver.
            error if self.state.errors.is_empty() => self.state.errors.push_back(error),
            _ => {}
        }
    }

    /// After the driver's glEndConditionalRender, which leaves no condition, whether there was one or not.
    pub fn ended_condition(&mut self) {
        self.queries.set_condition(None);
    }

    /// The query to ask the driver about in the place of one of the program's.
    pub fn asked_query(&self, query: QueryName) -> QueryName {
        self.queries.asked(query)
    }

    /// Whether our queries hold a part of the result of this query, so that [`Layer::result_to_buffer`] has to write it to buffers.
    pub fn continues_query(&self, query: QueryName) -> bool {
        self.queries.is_continued(query)
    }

    /// Whether the program has bound a buffer that results of queries go to, in place of its memory.
    pub fn has_query_buffer(&self) -> bool {
        !self.blocks.bound_at(c::QUERY_BUFFER).is_zero()
    }

    /// A result of a query goes to a buffer. `call` makes the program's own call with the name of a value: QUERY_RESULT in the place of
    /// QUERY_RESULT_NO_WAIT, so that the driver writes something which can be added to.
    pub fn result_to_buffer(
        &mut self,
        gl: &Gl,
        query: QueryName,
        name: u32,
        place: ResultPlace,
        call: &mut dyn FnMut(u32),
    ) {
        let name = match name {
            c::QUERY_RESULT_NO_WAIT => c::QUERY_RESULT,
            name => name,
        };
        self.state.keep_errors(gl);
        call(name);
        if self.state.keep_errors(gl) {
            return;
        }
        let bound = BufferName(gl.get_integer(c::QUERY_BUFFER_BINDING) as u32);
        let buffer = place.buffer.unwrap_or(bound);
        gl.bind_buffer(c::QUERY_BUFFER, BufferName::ZERO);
        let part = u64::from(gl.query_object(query, name));
        let result = |query, name| gl.query_object(query, name);
        let answer = self.queries.answer(query, name, result);
        gl.bind_buffer(c::QUERY_BUFFER, bound);
        if let Some(answer) = answer {
            let whole = answer.with(part).min(place.most);
            let before = self.copy_bindings(gl, &[]);
            let (all, half) = (whole.to_ne_bytes(), (whole as u32).to_ne_bytes());
            let bytes = if place.bytes == all.len() {
                &all[..]
            } else {
                &half[..]
            };
            // A buffer may be one that only copies can write to.
            let ours = self.scratch(gl, 0, all.len());
            gl.bind_buffer(c::COPY_READ_BUFFER, ours);
            gl.buffer_sub_data(c::COPY_READ_BUFFER, 0, bytes);
            gl.bind_buffer(c::COPY_WRITE_BUFFER, buffer);
            gl.copy_buffer(0, place.at, bytes.len());
            for (target, buffer) in before {
                gl.bind_buffer(target, buffer);
            }
        }
        self.buffers().forget_all(buffer);
        gl.drop_errors();
    }

    /// The part of a result of the program's query that our queries hold, if there are any.
    pub fn query_answer(&self, gl: &Gl, query: QueryName, name: u32) -> Option<Answer> {
        // The driver itself writes results into a query buffer, where nothing can be added.
        let buffers = self.session.support.version >= (4, 4);
        if !self.queries.is_continued(query)
            || buffers && gl.get_integer(c::QUERY_BUFFER_BINDING) != 0
        {
            return None;
        }
        let result = |query, name| gl.query_object(query, name);
        self.queries.answer(query, name, result)
    }
}
