//! Queries that count samples or primitives. They count those of one view instead of all.

use crate::context::{enter, peek, real};
use crate::hooks::{before_uncompiled, compile};
use crate::instead::instead_at;
use core::slice::from_raw_parts;
use manyview_core::gl::consts::CURRENT_QUERY;
use manyview_core::gl::{BufferName, Ptr, QueryName};
use manyview_core::layer::{Answer, ResultPlace};
use manyview_core::state::{Command, Run, Touch};

/// Hooks of the commands that begin and end a query, under the names of OpenGL and of the extension of OpenGL ES.
macro_rules! counted {
    ($begin:ident, $end:ident) => {
        pub(crate) unsafe fn $begin(target: u32, id: u32) {
            let query = QueryName(id);
            let compiled = compile(Command::Of(Run::BeginQuery(target, query)), Touch::NONE);
            // SAFETY: the program's own call.
            unsafe { real().$begin(target, id) };
            if !compiled {
                enter(|gl, l| l.begun_query(gl, target, query));
            }
        }

        pub(crate) unsafe fn $end(target: u32) {
            let compiled = compile(Command::Of(Run::EndQuery(target)), Touch::NONE);
            // SAFETY: the program's own call.
            unsafe { real().$end(target) };
            if !compiled {
                enter(|_, l| l.ended_query(target));
            }
        }
    };
}

counted!(glBeginQuery, glEndQuery);
counted!(glBeginQueryEXT, glEndQueryEXT);

/// Index 0 of a target is the target itself. Others count further streams of vertices, which are the program's own affair.
pub(crate) unsafe fn glBeginQueryIndexed(target: u32, index: u32, id: u32) {
    before_uncompiled();
    // SAFETY: the program's own call.
    unsafe { real().glBeginQueryIndexed(target, index, id) };
    if index == 0 {
        enter(|gl, l| l.begun_query(gl, target, QueryName(id)));
    }
}

pub(crate) unsafe fn glEndQueryIndexed(target: u32, index: u32) {
    before_uncompiled();
    // SAFETY: the program's own call.
    unsafe { real().glEndQueryIndexed(target, index) };
    if index == 0 {
        enter(|_, l| l.ended_query(target));
    }
}

pub(crate) unsafe fn glGetQueryIndexediv(target: u32, index: u32, pname: u32, params: Ptr) {
    match index {
        // SAFETY: the program's own arguments.
        0 => unsafe { glGetQueryiv(target, pname, params) },
        // SAFETY: the program's own call.
        _ => unsafe { real().glGetQueryIndexediv(target, index, pname, params) },
    }
}

pub(crate) unsafe fn glDeleteQueries(n: i32, ids: Ptr) {
    let names = match usize::try_from(n) {
        // SAFETY: n names (the program's array), copied before the driver runs.
        Ok(n) if !ids.is_null() => unsafe { from_raw_parts(ids as *const QueryName, n) }.to_vec(),
        _ => Vec::new(),
    };
    // SAFETY: the program's own call.
    unsafe { real().glDeleteQueries(n, ids) };
    enter(|_, l| l.deleted_queries(&names));
}

/// A hook of glGetQuery*, which returns the program's query where one of ours is active.
macro_rules! query_target {
    ($name:ident) => {
        pub(crate) unsafe fn $name(target: u32, pname: u32, params: Ptr) {
            // SAFETY: the program's own call.
            unsafe { real().$name(target, pname, params) };
            if pname == CURRENT_QUERY
                && !params.is_null()
                && let Some(Some(query)) = peek(|l| l.current_query(target))
            {
                // SAFETY: the driver has written one value there.
                unsafe { *params.cast::<i32>() = query.0 as i32 };
            }
        }
    };
}

query_target!(glGetQueryiv);
query_target!(glGetQueryivEXT);

pub(crate) unsafe fn glBeginConditionalRender(id: u32, mode: u32) {
    let query = QueryName(id);
    let part = enter(|gl, l| l.condition(gl, query)).unwrap_or(query);
    // SAFETY: the program's own call, or on a query of ours.
    unsafe { real().glBeginConditionalRender(part.0, mode) };
    enter(|gl, l| l.begun_condition(gl, part, mode));
}

pub(crate) unsafe fn glEndConditionalRender() {
    // SAFETY: the program's own call.
    unsafe { real().glEndConditionalRender() };
    enter(|_, l| l.ended_condition());
}

/// The part of a result that our queries hold, to be merged with the driver's part in the program's memory.
fn more(query: QueryName, pname: u32, params: Ptr) -> Option<Answer> {
    let answer = enter(|gl, l| l.query_answer(gl, query, pname)).flatten()?;
    (!params.is_null()).then_some(answer)
}

macro_rules! query_object {
    ($name:ident, $value:ty) => {
        pub(crate) unsafe fn $name(id: u32, pname: u32, params: Ptr) {
            before_uncompiled();
            let query = QueryName(id);
            if continues(query) && peek(|l| l.has_query_buffer()) == Some(true) {
                let place = place::<$value>(None, params as usize, <$value>::MAX as u64);
                // SAFETY: the program's own call.
                let call = &mut |pname| unsafe { real().$name(id, pname, params) };
                return instead_at(pname, call, |gl, l, call| {
                    l.result_to_buffer(gl, query, pname, place, call);
                });
            }
            let asked = peek(|l| l.asked_query(query)).unwrap_or(query);
            // SAFETY: the program's own call.
            unsafe { real().$name(asked.0, pname, params) };
            if let Some(answer) = more(query, pname, params) {
                // SAFETY: the driver has written one value there.
                let value = unsafe { &mut *params.cast::<$value>() };
                let whole = answer.with(u64::try_from(*value).unwrap_or(0));
                *value = <$value>::try_from(whole).unwrap_or(<$value>::MAX);
            }
        }
    };
}

query_object!(glGetQueryObjectiv, i32);
query_object!(glGetQueryObjectuiv, u32);
query_object!(glGetQueryObjectuivEXT, u32);
query_object!(glGetQueryObjecti64v, i64);
query_object!(glGetQueryObjectui64v, u64);

/// Whether queries of ours hold a part of the result of an ended one.
fn continues(query: QueryName) -> bool {
    peek(|l| l.continues_query(query)) == Some(true)
}

fn place<T>(buffer: Option<BufferName>, at: usize, most: u64) -> ResultPlace {
    ResultPlace {
        buffer,
        at,
        bytes: size_of::<T>(),
        most,
    }
}

/// Hooks of the commands that write results of queries to buffers that they name.
macro_rules! query_buffer_object {
    ($name:ident, $value:ty) => {
        pub(crate) unsafe fn $name(id: u32, buffer: u32, pname: u32, offset: isize) {
            before_uncompiled();
            // SAFETY: the program's own call.
            let call = &mut |pname| unsafe { real().$name(id, buffer, pname, offset) };
            let query = QueryName(id);
            if !continues(query) {
                return call(pname);
            }
            let at = usize::try_from(offset).unwrap_or(0);
            let place = place::<$value>(Some(BufferName(buffer)), at, <$value>::MAX as u64);
            instead_at(pname, call, |gl, l, call| {
                l.result_to_buffer(gl, query, pname, place, call);
            });
        }
    };
}

query_buffer_object!(glGetQueryBufferObjectiv, i32);
query_buffer_object!(glGetQueryBufferObjectuiv, u32);
query_buffer_object!(glGetQueryBufferObjecti64v, i64);
query_buffer_object!(glGetQueryBufferObjectui64v, u64);
