//! Queries that count what is drawn: only what is drawn in the program's own view is counted.
//!
//! A draw in N views would count N times. So the query is ended before the other views are drawn, and begun again for the own one. A query
//! that is begun again forgets its count. After the first draw a query object of ours therefore continues it, and the program gets the sum.

use super::Layer;
use crate::gl::{Gl, QueryName, consts as c};
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

const TARGETS: [u32; 4] = [
    c::SAMPLES_PASSED,
    c::ANY_SAMPLES_PASSED,
    c::ANY_SAMPLES_PASSED_CONSERVATIVE,
    c::PRIMITIVES_GENERATED,
];

impl Queries {
    /// Whether draws are being counted.
    pub(super) fn active(&self) -> bool {
        !self.active.is_empty()
    }

    /// Something is drawn once instead of per view, so active queries have counted something.
    pub(super) fn drawn(&mut self) {
        self.active.iter_mut().for_each(|a| a.counted = true);
    }

    pub(super) fn pause(&self, gl: &Gl) {
        self.active.iter().for_each(|a| gl.end_query(a.target));
    }

    pub(super) fn resume(&mut self, gl: &Gl) {
        for a in &mut self.active {
            let name = if a.counted {
                let name = self.spare.pop().unwrap_or_else(|| gl.gen_query());
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
}

impl Layer {
    /// After the driver's glBeginQuery.
    pub fn begun_query(&mut self, gl: &Gl, target: u32, query: QueryName) {
        let q = &mut self.queries;
        let known = q.active.iter().any(|a| a.target == target);
        // The driver may have refused it.
        if !TARGETS.contains(&target)
            || known
            || gl.current_query(target) != query
            || query.is_zero()
        {
            return;
        }
        q.forget(query);
        q.active.push(Active {
            target,
            query,
            counted: false,
            more: Vec::new(),
        });
    }

    /// After the driver's glEndQuery.
    pub fn ended_query(&mut self, target: u32) {
        let q = &mut self.queries;
        if let Some(at) = q.active.iter().position(|a| a.target == target) {
            let ended = q.active.swap_remove(at);
            if !ended.more.is_empty() {
                q.more.insert(ended.query, (target, ended.more));
            }
        }
    }

    /// glDeleteQueries.
    pub fn deleted_queries(&mut self, queries: &[QueryName]) {
        queries.iter().for_each(|&q| self.queries.forget(q));
    }

    /// The answer of glGetQueryiv for GL_CURRENT_QUERY of a target, if a query of ours may be active there.
    pub fn current_query(&self, target: u32) -> Option<QueryName> {
        let active = self.queries.active.iter().find(|a| a.target == target);
        active.map(|a| a.query)
    }

    /// Before glBeginConditionalRender: the query for the driver in the place of the program's. The driver asks only whether the result is
    /// zero. So it is a query of ours with another result than zero if there is one, or else the program's. This waits for results, which
    /// every mode allows.
    pub fn condition(&mut self, gl: &Gl, query: QueryName) -> QueryName {
        self.catch_up(gl);
        self.state.keep_errors(gl);
        let q = &self.queries;
        if q.active.iter().any(|a| a.query == query) {
            // The driver refuses the query that is active there.
            return self.asked_query(query);
        }
        let more = q.more.get(&query).map_or(&[][..], |(_, names)| names);
        let counted = |&q: &QueryName| gl.query_object(q, c::QUERY_RESULT) != 0;
        more.iter().copied().find(counted).unwrap_or(query)
    }

    /// After the driver's glBeginConditionalRender.
    pub fn begun_condition(&mut self, gl: &Gl, query: QueryName, mode: u32) {
        match gl.get_error() {
            c::NO_ERROR if !self.compiles() => self.queries.condition = Some((query, mode)),
            c::NO_ERROR => {}
            // Only the first error is kept, as by the driver.
            error if self.state.errors.is_empty() => self.state.errors.push_back(error),
            _ => {}
        }
    }

    /// After the driver's glEndConditionalRender, which leaves no condition, whether there was one or not.
    pub fn ended_condition(&mut self) {
        self.queries.condition = None;
    }

    /// The query to ask the driver about in the place of one of the program's: while a query of ours continues that, ours is the active one.
    pub fn asked_query(&self, query: QueryName) -> QueryName {
        let active = self.queries.active.iter().find(|a| a.query == query);
        active.and_then(|a| a.more.last().copied()).unwrap_or(query)
    }

    /// The part of a result of the program's query that our queries hold, if there are any.
    pub fn query_answer(&self, gl: &Gl, query: QueryName, name: u32) -> Option<Answer> {
        let (target, more) = self.queries.more.get(&query)?;
        // The driver itself writes results into a query buffer, where nothing can be added.
        if self.session.support.version >= (4, 4) && gl.get_integer(c::QUERY_BUFFER_BINDING) != 0 {
            return None;
        }
        let ask = |name| more.iter().map(move |&q| gl.query_object(q, name));
        Some(match name {
            c::QUERY_RESULT | c::QUERY_RESULT_NO_WAIT => match *target {
                c::SAMPLES_PASSED | c::PRIMITIVES_GENERATED => {
                    Answer::Count(ask(c::QUERY_RESULT).map(u64::from).sum())
                }
                _ => Answer::Any(ask(c::QUERY_RESULT).any(|r| r != 0)),
            },
            c::QUERY_RESULT_AVAILABLE => {
                Answer::Available(ask(c::QUERY_RESULT_AVAILABLE).all(|r| r != 0))
            }
            _ => return None,
        })
    }
}
