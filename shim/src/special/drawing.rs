//! Immediate mode, vertex arrays, pixels and display lists.

use crate::context::{
    Inside, enter, enter_unflushed, inside, peek, peek_inside, real, recording, set_inside,
};
use crate::hooks::{self, before_uncompiled, compile, draw, imm};
use crate::instead::{instead, instead_unflushed};
use manyview_core::gl::consts::LIST_BASE;
use manyview_core::gl::{Indices, Vertices};
use manyview_core::gl::{ListName, Ptr, list_names, slot};
use manyview_core::layer::{Primitive, Primitives};
use manyview_core::plan::Kind;
use manyview_core::state::{Command, Effect, Run, Touch};

pub(crate) unsafe fn glBegin(mode: u32) {
    let begun = enter_unflushed(|gl, l| l.begin(gl, mode));
    let own = match begun.unwrap_or(Primitive::None) {
        Primitive::None => mode,
        Primitive::Recorded { empty } => {
            set_inside(Inside::Recorded);
            empty
        }
        Primitive::Direct => {
            set_inside(Inside::Direct);
            mode
        }
    };
    // Where calls are recorded, the driver has an empty primitive, so that it reports errors of the program.
    // SAFETY: the program's own call.
    unsafe { real().glBegin(own) };
}

pub(crate) unsafe fn glEnd() {
    compile(Command::End, Touch::NONE);
    // SAFETY: the program's own call.
    unsafe { real().glEnd() };
    if inside() != Inside::Outside {
        set_inside(Inside::Outside);
        enter_unflushed(|gl, l| l.end(gl));
    }
}

/// After lists that may have begun or ended a primitive: brings the driver and the hooks to the same side of glBegin as the program.
fn after_lists() {
    match peek(|l| l.primitive()).unwrap_or(Primitive::None) {
        Primitive::Recorded { empty } => {
            set_inside(Inside::Recorded);
            // SAFETY: a primitive mode; it stays empty.
            unsafe { real().glBegin(empty) };
        }
        Primitive::Direct => set_inside(Inside::Direct),
        Primitive::None => {}
    }
}

fn primitives(p: Primitives, call: &mut dyn FnMut()) {
    instead_unflushed(call, |gl, l, call| l.primitives(gl, p, call));
}

pub(crate) unsafe fn glDrawArrays(mode: u32, first: i32, count: i32) {
    // SAFETY: of the program's draw, used before its call returns.
    let vertices = unsafe { Vertices::new(first, count) };
    // SAFETY: the program's own call.
    primitives(Primitives::Arrays { mode, vertices }, &mut || unsafe {
        real().glDrawArrays(mode, first, count)
    });
}

pub(crate) unsafe fn glDrawElements(mode: u32, count: i32, type_: u32, indices: Ptr) {
    // SAFETY: of the program's draw, used before its call returns.
    let own = unsafe { Indices::new(count, type_, indices) };
    let p = Primitives::Elements { mode, indices: own };
    // SAFETY: the program's own call.
    primitives(p, &mut || unsafe {
        real().glDrawElements(mode, count, type_, indices)
    });
}

pub(crate) unsafe fn glDrawRangeElements(
    mode: u32,
    start: u32,
    end: u32,
    count: i32,
    type_: u32,
    indices: Ptr,
) {
    // SAFETY: of the program's draw, used before its call returns.
    let own = unsafe { Indices::new(count, type_, indices) };
    let p = Primitives::Elements { mode, indices: own };
    // SAFETY: the program's own call.
    primitives(p, &mut || unsafe {
        real().glDrawRangeElements(mode, start, end, count, type_, indices)
    });
}

fn pixels(call: &mut dyn FnMut()) {
    instead(call, |gl, l, call| l.draw(gl, Kind::Pixels, call));
}

pub(crate) unsafe fn glClear(mask: u32) {
    // SAFETY: the program's own call.
    instead(&mut || unsafe { real().glClear(mask) }, |gl, l, call| {
        l.clear(gl, mask, call);
    });
}

pub(crate) unsafe fn glAccum(op: u32, value: f32) {
    // SAFETY: the program's own call.
    let mut call = || unsafe { real().glAccum(op, value) };
    instead(&mut call, |gl, l, call| l.accum(gl, op, value, call));
}

pub(crate) unsafe fn glBitmap(
    width: i32,
    height: i32,
    xorig: f32,
    yorig: f32,
    xmove: f32,
    ymove: f32,
    bitmap: Ptr,
) {
    // SAFETY: the program's own call.
    pixels(&mut || unsafe { real().glBitmap(width, height, xorig, yorig, xmove, ymove, bitmap) });
}

pub(crate) unsafe fn glDrawPixels(width: i32, height: i32, format: u32, type_: u32, pixels_: Ptr) {
    // SAFETY: the program's own call.
    pixels(&mut || unsafe { real().glDrawPixels(width, height, format, type_, pixels_) });
}

pub(crate) unsafe fn glCopyPixels(x: i32, y: i32, width: i32, height: i32, type_: u32) {
    // SAFETY: the program's own call.
    let mut call = || unsafe { real().glCopyPixels(x, y, width, height, type_) };
    instead(&mut call, |gl, l, call| {
        l.copy_pixels(gl, x, width, call);
    });
}

pub(crate) unsafe fn glNewList(list: u32, mode: u32) {
    before_uncompiled();
    let name = enter(|gl, l| l.new_list(gl, ListName(list), mode)).flatten();
    // SAFETY: the program's own call, or the first run of its list.
    unsafe { real().glNewList(name.map_or(list, |name| name.0), mode) };
}

pub(crate) unsafe fn glEndList() {
    // SAFETY: the program's own call.
    unsafe { real().glEndList() };
    enter(|gl, l| l.end_list(gl));
}

pub(crate) unsafe fn glGenLists(range: i32) -> u32 {
    before_uncompiled();
    // SAFETY: the program's own call.
    let first = unsafe { real().glGenLists(range) };
    match u32::try_from(range) {
        Ok(count @ 1..) if first != 0 => {
            enter(|gl, l| l.generated_lists(gl, ListName(first), count))
                .map_or(first, |name| name.0)
        }
        _ => first,
    }
}

pub(crate) unsafe fn glIsList(list: u32) -> u8 {
    before_uncompiled();
    // SAFETY: the program's own call.
    let is = unsafe { real().glIsList(list) };
    // Lists of ours do not exist for the program.
    is & u8::from(peek(|l| l.owns_list(ListName(list))) != Some(true))
}

pub(crate) unsafe fn glDeleteLists(list: u32, range: i32) {
    before_uncompiled();
    // SAFETY: the program's own call.
    unsafe { real().glDeleteLists(list, range) };
    if let Ok(range) = u32::try_from(range) {
        enter(|gl, l| l.deleted_lists(gl, ListName(list), range));
    }
}

pub(crate) unsafe fn glCallList(list: u32) {
    let name = ListName(list);
    if name.is_zero() {
        // No list has this name, so the driver reports an error.
        before_uncompiled();
        // SAFETY: the program's own call.
        return unsafe { real().glCallList(list) };
    }
    if recording() {
        return record_list(name);
    }
    if inside() == Inside::Direct {
        // SAFETY: the program's own call.
        unsafe { real().glCallList(list) };
        return direct_list(name);
    }
    compile(Command::Of(Run::List(name)), Touch::NONE);
    // SAFETY: the program's own call.
    let mut call = || unsafe { real().glCallList(list) };
    instead(&mut call, |gl, l, call| match l.compiles() {
        true => call(),
        false => l.call_lists(gl, Some(&[name]), call),
    });
    after_lists();
}

/// Asks the driver something while calls are recorded. The driver's own primitive is empty, so it can be ended and begun again.
fn outside<R>(ask: impl FnOnce() -> R) -> R {
    let primitive = peek_inside(|l| l.primitive());
    // SAFETY: the driver is between glBegin and glEnd.
    unsafe { real().glEnd() };
    set_inside(Inside::Outside);
    let r = ask();
    set_inside(Inside::Recorded);
    if let Some(Primitive::Recorded { empty }) = primitive {
        // SAFETY: a primitive mode; it stays empty.
        unsafe { real().glBegin(empty) };
    }
    r
}

/// After a list that was called between glBegin and glEnd while calls go to the driver.
fn direct_list(list: ListName) {
    if peek_inside(|l| l.closed_in_driver(list)) == Some(true) {
        set_inside(Inside::Outside);
    }
}

fn record_list(list: ListName) {
    if peek_inside(|l| l.closes(list)) == Some(true) {
        // SAFETY: the driver is between glBegin and glEnd.
        unsafe { real().glEnd() };
        set_inside(Inside::Outside);
        enter(|gl, l| l.close_by_list(gl, list));
        return after_lists();
    }
    imm::record(slot::glCallList, Effect::UNKNOWN, |rec| rec.u32(list.0));
}

pub(crate) unsafe fn glCallLists(n: i32, type_: u32, lists: Ptr) {
    // SAFETY: the program's arrays.
    let names = unsafe { list_names(n, type_, lists) };
    if recording() {
        let Some(names) = names else {
            // The call is wrong, and the driver, which is between glBegin and glEnd as well, reports that.
            // SAFETY: the program's own call.
            return unsafe { real().glCallLists(n, type_, lists) };
        };
        let base = outside(list_base);
        let names = names.into_iter();
        // The lists are called one by one, because one of them may end the primitive.
        // SAFETY: the program's own call, list by list.
        return names.for_each(|n| unsafe { glCallList(n.wrapping_add(base)) });
    }
    compile(Command::Of(Run::Lists), Touch::NONE);
    // SAFETY: the program's own call.
    let mut call = || unsafe { real().glCallLists(n, type_, lists) };
    instead(&mut call, |gl, l, call| {
        if l.compiles() {
            call();
            return l.compiled_names(names.as_deref().unwrap_or_default());
        }
        let base = gl.get_integer(LIST_BASE) as u32;
        let name = |n: u32| ListName(n.wrapping_add(base));
        let names: Option<Vec<ListName>> = names.map(|l| l.into_iter().map(name).collect());
        l.call_lists(gl, names.as_deref(), call);
    });
    after_lists();
}

fn list_base() -> u32 {
    enter(|gl, _| gl.get_integer(LIST_BASE) as u32).unwrap_or(0)
}

/// A hook of a command that clears one draw buffer. The program's first one may name two buffers (GL_FRONT_AND_BACK), which are two
/// draw buffers of the atlas.
macro_rules! clear_buffer {
    ($($name:ident),*) => {$(
        pub(crate) unsafe fn $name(buffer: u32, drawbuffer: i32, value: Ptr) {
            const COLOR: u32 = 0x1800;
            let first = buffer == COLOR && drawbuffer == 0;
            let two = first && peek(|l| l.draws_to_two_buffers()) == Some(true);
            // SAFETY: the program's own call.
            draw(hooks::Kind::CLEAR, &mut |gl| unsafe {
                gl.$name(buffer, drawbuffer, value);
                if two {
                    gl.$name(buffer, 1, value);
                }
            });
        }
    )*};
}

clear_buffer!(glClearBufferfv, glClearBufferiv, glClearBufferuiv);
