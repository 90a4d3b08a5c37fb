//! Queries: what is counted, and the queries of ours that continue those of the program.

use super::super::Answer;
use super::super::feedback::Feedback;
use super::super::queries::Queries;
use super::bench::Bench;
use crate::gl::fake::{Fake, Scope};
use crate::gl::{Gl, QueryName, consts as c};
use std::collections::HashSet;

/// GL_TIME_ELAPSED, which counts nothing that is drawn.
const TIME_ELAPSED: u32 = 0x88BF;

fn new_query(gl: &Gl) -> QueryName {
    let [query, ..] = gl.gen_queries();
    query
}

struct Counting {
    fake: Fake,
    gl: Gl,
    queries: Queries,
}

impl Counting {
    fn new() -> Counting {
        let fake = Fake::new();
        let gl = fake.gl();
        let queries = Queries::default();
        Counting { fake, gl, queries }
    }

    /// The program begins this query.
    fn begin(&mut self, target: u32, query: QueryName) {
        self.fake.program(|gl| gl.begin_query(target, query));
        self.queries.begun(&self.gl, target, query);
    }

    /// The program begins a new query.
    fn begin_new(&mut self, target: u32) -> QueryName {
        let query = self.fake.program(new_query);
        self.begin(target, query);
        query
    }

    /// The program ends its query.
    fn end(&mut self, target: u32) {
        self.fake.program(|gl| gl.end_query(target));
        self.queries.ended(target);
    }

    /// A draw in several views, of which the own one alone is counted; returns the query that counts it.
    fn draw(&mut self, target: u32) -> QueryName {
        self.queries.pause(&self.gl);
        assert_eq!(self.gl.current_query(target), QueryName::ZERO);
        self.queries.resume(&self.gl);
        self.gl.current_query(target)
    }
}

#[test]
fn a_query_is_continued_by_queries_of_ours() {
    let mut counting = Counting::new();
    let target = c::SAMPLES_PASSED;
    let query = counting.begin_new(target);
    assert!(counting.queries.active());
    // Nothing was counted before the first draw, so the program's own query is begun again.
    assert_eq!(counting.draw(target), query);
    assert_eq!(counting.queries.asked(query), query);
    let first = counting.draw(target);
    let second = counting.draw(target);
    assert!(first != query && second != query && first != second);
    assert_eq!(counting.queries.asked(query), second);
    assert_eq!(counting.queries.current(target), Some(query));
    assert_eq!(counting.queries.current(c::ANY_SAMPLES_PASSED), None);
    assert!(!counting.queries.is_continued(query), "not before its end");
    counting.end(target);
    assert!(!counting.queries.active() && counting.queries.is_continued(query));
    assert_eq!(counting.queries.current(target), None);
    assert_eq!(counting.queries.asked(query), query);
    let result = |name, value| match (name, value) {
        (name, c::QUERY_RESULT) if name == first => 5,
        (name, c::QUERY_RESULT) if name == second => 7,
        _ => 0,
    };
    for name in [c::QUERY_RESULT, c::QUERY_RESULT_NO_WAIT] {
        let answer = counting.queries.answer(query, name, result);
        assert_eq!(answer, Some(Answer::Count(12)));
    }
}

#[test]
fn what_was_drawn_once_is_not_forgotten() {
    let mut counting = Counting::new();
    let query = counting.begin_new(c::SAMPLES_PASSED);
    counting.queries.drawn();
    assert_ne!(counting.draw(c::SAMPLES_PASSED), query);
}

/// Of each draw that transform feedback writes, the call that writes is counted before rasterisation, and the own view after it.
#[test]
fn queries_of_both_kinds_count_what_is_written_and_drawn_once() {
    let mut counting = Counting::new();
    let (samples, primitives) = (c::SAMPLES_PASSED, c::PRIMITIVES_GENERATED);
    counting.queries.set_feedback(Feedback::On);
    let own = [samples, primitives].map(|target| counting.begin_new(target));
    let now = |counting: &Counting| [samples, primitives].map(|t| counting.gl.current_query(t));
    let mut draw = || {
        let gl = counting.gl;
        counting.queries.start_writing(&gl);
        let written = now(&counting);
        counting.queries.hold_feedback(&gl);
        counting.queries.pause(&gl);
        assert_eq!(now(&counting), [QueryName::ZERO; 2], "other views");
        counting.queries.resume(&gl);
        let drawn = now(&counting);
        counting.queries.release_feedback(&gl);
        [written, drawn]
    };
    let none = QueryName::ZERO;
    let mut counted = Vec::new();
    for _ in 0..2 {
        let [written, drawn] = draw();
        assert_eq!([written[0], drawn[1]], [none; 2], "of the other kind");
        counted.extend([written[1], drawn[0]]);
    }
    // A query that is begun again forgets its count.
    assert_eq!(counted[0], own[1]);
    assert!(!counted.contains(&none));
    assert_eq!(counted.iter().collect::<HashSet<_>>().len(), 4);
}

#[test]
fn an_answer_is_of_the_kind_of_its_query() {
    let mut counting = Counting::new();
    let target = c::ANY_SAMPLES_PASSED;
    let query = counting.begin_new(target);
    let [_, first, second] = [0; 3].map(|_| counting.draw(target));
    counting.end(target);
    let answer = |name, values: [u32; 2]| {
        let result = |query, _| values[usize::from(query == second)];
        counting.queries.answer(query, name, result)
    };
    assert_ne!(first, second);
    let (result, available) = (c::QUERY_RESULT, c::QUERY_RESULT_AVAILABLE);
    assert_eq!(answer(result, [0, 0]), Some(Answer::Any(false)));
    assert_eq!(answer(result, [0, 3]), Some(Answer::Any(true)));
    assert_eq!(answer(available, [1, 0]), Some(Answer::Available(false)));
    assert_eq!(answer(available, [1, 1]), Some(Answer::Available(true)));
    // GL_QUERY_TARGET of a query is the same for ours.
    assert_eq!(answer(0x82EA, [1, 1]), None);
    let other = QueryName(query.0 + 100);
    assert_eq!(counting.queries.answer(other, result, |_, _| 1), None);
}

#[test]
fn a_query_that_the_driver_refused_is_not_tracked() {
    let mut counting = Counting::new();
    let target = c::SAMPLES_PASSED;
    let query = counting.fake.program(new_query);
    let (gl, other) = (counting.gl, QueryName(query.0 + 1));
    counting.queries.begun(&gl, target, query);
    assert!(!counting.queries.active(), "the driver has none");
    counting.fake.program(|gl| gl.begin_query(target, query));
    counting.queries.begun(&gl, target, other);
    counting.queries.begun(&gl, target, QueryName::ZERO);
    assert!(!counting.queries.active(), "the driver has another one");
    counting.begin(TIME_ELAPSED, query);
    assert!(!counting.queries.active(), "time is not counted");
    counting.begin(target, query);
    counting.begin(target, other);
    assert_eq!(counting.queries.current(target), Some(query));
    counting.fake.forget();
    counting.queries.pause(&gl);
    assert_eq!(counting.fake.count("glEndQuery"), 1);
}

#[test]
fn names_are_used_again() {
    let mut counting = Counting::new();
    let target = c::PRIMITIVES_GENERATED;
    let query = counting.begin_new(target);
    counting.draw(target);
    let ours = counting.draw(target);
    counting.end(target);
    // The result of a query that is begun again is gone, and with it our part of it.
    counting.begin(target, query);
    assert!(!counting.queries.is_continued(query));
    counting.draw(target);
    assert_eq!(counting.draw(target), ours);
    counting.end(target);
    counting.queries.deleted(&[QueryName(99), query]);
    assert!(!counting.queries.is_continued(query));
    counting.begin_new(target);
    counting.draw(target);
    assert_eq!(counting.draw(target), ours);
    assert_eq!(counting.fake.count("glGenQueries"), 1);
}

#[test]
fn a_condition_is_decided_by_a_query_with_a_result() {
    let mut counting = Counting::new();
    let target = c::SAMPLES_PASSED;
    let query = counting.begin_new(target);
    let [_, first, second] = [0; 3].map(|_| counting.draw(target));
    // The driver refuses the one that is active.
    assert_eq!(counting.queries.deciding(query, |_| 1), second);
    counting.end(target);
    let passed = |wanted| move |query| u32::from(query == wanted);
    assert_eq!(counting.queries.deciding(query, passed(first)), first);
    assert_eq!(counting.queries.deciding(query, passed(second)), second);
    assert_eq!(counting.queries.deciding(query, |_| 0), query);
    let other = QueryName(99);
    assert_eq!(counting.queries.deciding(other, |_| 1), other);
}

#[test]
fn a_condition_is_lifted_while_there_is_one() {
    let Counting {
        fake,
        gl,
        mut queries,
    } = Counting::new();
    let mut lines = |condition| {
        fake.forget();
        queries.set_condition(condition);
        queries.lift_condition(&gl);
        queries.put_condition(&gl);
        fake.lines("gl*")
    };
    let expected = [
        "glEndConditionalRender()",
        "glBeginConditionalRender(3, 36371)",
    ];
    assert_eq!(lines(Some((QueryName(3), 0x8E13))), expected);
    assert_eq!(lines(None), [""; 0]);
}

#[test]
fn a_condition_that_the_driver_refuses_is_none() {
    let mut bench = Bench::new(&[("VIEWS", "2"), ("STRATEGY", "replay")]);
    let gl = bench.gl;
    let lifts = |bench: &Bench| {
        bench.fake.forget();
        bench.layer.queries.lift_condition(&gl);
        bench.fake.count("glEndConditionalRender")
    };
    bench.fake.raise(c::INVALID_OPERATION);
    bench.layer.begun_condition(&gl, QueryName(3), 0);
    assert_eq!(lifts(&bench), 0);
    // The program gets the error.
    assert_eq!(bench.layer.state.errors, [c::INVALID_OPERATION]);
    bench.layer.begun_condition(&gl, QueryName(3), 0);
    assert_eq!(lifts(&bench), 1);
    bench.layer.ended_condition();
    assert_eq!(lifts(&bench), 0);
}

#[test]
fn a_replayed_draw_is_counted_in_the_own_view() {
    let mut bench = Bench::new(&[("VIEWS", "4"), ("STRATEGY", "replay")]);
    let (gl, target) = (bench.gl, c::SAMPLES_PASSED);
    bench.look();
    bench.frame();
    bench.clear();
    let query = bench.fake.program(|gl| {
        let query = new_query(gl);
        gl.begin_query(target, query);
        query
    });
    bench.layer.begun_query(&gl, target, query);
    let mut counts = || {
        bench.fake.forget();
        bench.draw();
        let calls = bench.fake.calls().into_iter();
        let steps = calls.filter_map(|call| match call.name {
            "glEndQuery" => Some("end".to_owned()),
            "glBeginQuery" => Some(format!("begin {}", call.int(1))),
            "glDrawArrays" => Some("draw".to_owned()),
            _ => None,
        });
        steps.collect::<Vec<_>>()
    };
    let mut counting = || {
        let steps = counts();
        let begins = steps[4].clone();
        assert_eq!(steps, ["end", "draw", "draw", "draw", &begins, "draw"]);
        begins
    };
    assert_eq!(counting(), format!("begin {query}"));
    let [first, second] = [counting(), counting()];
    assert_ne!(first, second);
    let asked = bench.layer.asked_query(query);
    assert_eq!(second, format!("begin {asked}"));
    bench.fake.program(|gl| gl.end_query(target));
    bench.layer.ended_query(target);
    let answer = |bench: &Bench| bench.layer.query_answer(&gl, query, c::QUERY_RESULT);
    assert_eq!(answer(&bench), Some(Answer::Count(0)));
    // The driver itself writes to a buffer, where nothing can be added.
    bench
        .fake
        .put(Scope::Context, c::QUERY_BUFFER_BINDING, &[3.0]);
    assert_eq!(answer(&bench), None);
    bench.layer.deleted_queries(&[query]);
    bench.fake.forget();
    assert_eq!(answer(&bench), None);
    assert_eq!(bench.fake.calls(), []);
}
