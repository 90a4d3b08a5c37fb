//! Immediate mode, arrays, pixels, display lists.

use crate::context::{enter, real, recording, set_recording};
use core::slice::from_raw_parts;
use manyview_core::gl::api::Indices;
use manyview_core::gl::{Ptr, slot};
use manyview_core::layer::Primitives;
use manyview_core::plan::Kind;
use manyview_core::state::{Begin, Effect};

pub(crate) unsafe fn glBegin(mode: u32) {
    match enter(|gl, l| l.begin(gl, mode)) {
        Some(true) => set_recording(true),
        // SAFETY: the program's own call.
        _ => unsafe { real().glBegin(mode) },
    }
}

pub(crate) unsafe fn glEnd() {
    set_recording(false);
    if enter(|gl, l| l.end(gl)) != Some(true) {
        // SAFETY: the program's own call.
        unsafe { real().glEnd() };
        enter(|_, l| l.ended());
    }
}

fn primitives(p: Primitives, call: &mut dyn FnMut()) {
    if enter(|gl, l| l.primitives(gl, p, call)).is_none() {
        call();
    }
}

pub(crate) unsafe fn glDrawArrays(mode: u32, first: i32, count: i32) {
    // SAFETY: the program's own call.
    primitives(Primitives::Arrays { mode, first, count }, &mut || unsafe {
        real().glDrawArrays(mode, first, count)
    });
}

pub(crate) unsafe fn glDrawElements(mode: u32, count: i32, type_: u32, indices: Ptr) {
    // SAFETY: used before the program's call returns.
    let indices_ = unsafe { Indices::new(indices) };
    let p = Primitives::Elements {
        mode,
        count,
        kind: type_,
        indices: indices_,
    };
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
    // SAFETY: used before the program's call returns.
    let indices_ = unsafe { Indices::new(indices) };
    let p = Primitives::Elements {
        mode,
        count,
        kind: type_,
        indices: indices_,
    };
    // SAFETY: the program's own call.
    primitives(p, &mut || unsafe {
        real().glDrawRangeElements(mode, start, end, count, type_, indices)
    });
}

fn pixels(call: &mut dyn FnMut()) {
    if enter(|gl, l| l.draw(gl, Kind::Pixels, call)).is_none() {
        call();
    }
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
    pixels(&mut || unsafe { real().glCopyPixels(x, y, width, height, type_) });
}

pub(crate) unsafe fn glNewList(list: u32, mode: u32) {
    let known = [0x1300, 0x1301].contains(&mode) && list != 0;
    let mode = enter(|_, l| {
        if known && l.state.list.is_none() && l.state.begin == Begin::Outside {
            l.new_list(list, mode)
        } else {
            mode
        }
    })
    .unwrap_or(mode);
    // SAFETY: the program's own call.
    unsafe { real().glNewList(list, mode) };
}

pub(crate) unsafe fn glEndList() {
    // SAFETY: the program's own call.
    unsafe { real().glEndList() };
    if let Some(Some(list)) = enter(|_, l| l.end_list()) {
        // GL_COMPILE_AND_EXECUTE was compiled only: executed now, in every view.
        // SAFETY: the list was just compiled.
        unsafe { glCallList(list) };
    }
}

pub(crate) unsafe fn glCallList(list: u32) {
    if recording() {
        record_list(list);
        return;
    }
    // SAFETY: the program's own call.
    let mut call = || unsafe { real().glCallList(list) };
    if enter(|gl, l| l.call_lists(gl, Some(&[list]), &mut call)).is_none() {
        call();
    }
}

fn record_list(list: u32) {
    if let Some(r) = crate::hooks::imm::recording(slot::glCallList, Effect::UNKNOWN) {
        r.u32(list);
    }
}

/// Names of lists as glCallLists reads them, without the list base.
///
/// # Safety
/// `lists` points to `n` elements of the type.
unsafe fn list_names(n: i32, kind: u32, lists: Ptr) -> Option<Vec<u32>> {
    let n = usize::try_from(n).ok()?;
    if lists.is_null() {
        return None;
    }
    // SAFETY: n elements of the type (caller); bytes are read unaligned.
    unsafe {
        let bytes = |k: usize| from_raw_parts(lists as *const u8, n * k).chunks_exact(k);
        Some(match kind {
            0x1400 => bytes(1).map(|b| b[0] as i8 as u32).collect(), // GL_BYTE
            0x1401 => bytes(1).map(|b| u32::from(b[0])).collect(),   // GL_UNSIGNED_BYTE
            0x1402 => bytes(2)
                .map(|b| i16::from_ne_bytes([b[0], b[1]]) as u32)
                .collect(), // GL_SHORT
            0x1403 => bytes(2)
                .map(|b| u32::from(u16::from_ne_bytes([b[0], b[1]])))
                .collect(), // GL_UNSIGNED_SHORT
            0x1404 | 0x1405 => bytes(4)
                .map(|b| u32::from_ne_bytes([b[0], b[1], b[2], b[3]]))
                .collect(), // GL_INT, GL_UNSIGNED_INT
            0x1406 => bytes(4)
                .map(|b| f32::from_ne_bytes([b[0], b[1], b[2], b[3]]) as i32 as u32)
                .collect(), // GL_FLOAT
            0x1407 => bytes(2)
                .map(|b| u32::from(b[0]) << 8 | u32::from(b[1]))
                .collect(), // GL_2_BYTES
            0x1408 => bytes(3)
                .map(|b| u32::from_be_bytes([0, b[0], b[1], b[2]]))
                .collect(), // GL_3_BYTES
            0x1409 => bytes(4)
                .map(|b| u32::from_be_bytes([b[0], b[1], b[2], b[3]]))
                .collect(), // GL_4_BYTES
            _ => return None,
        })
    }
}

pub(crate) unsafe fn glCallLists(n: i32, type_: u32, lists: Ptr) {
    // SAFETY: the program's arrays.
    let names = unsafe { list_names(n, type_, lists) };
    let base = enter(|gl, l| {
        if l.state.list.is_none() {
            gl.get_integer(0x0B32) as u32
        } else {
            0
        }
    })
    .unwrap_or(0); // GL_LIST_BASE
    let names = names.map(|l| {
        l.into_iter()
            .map(|x| x.wrapping_add(base))
            .collect::<Vec<u32>>()
    });
    if recording() {
        names.unwrap_or_default().into_iter().for_each(record_list);
        return;
    }
    // SAFETY: the program's own call.
    let mut call = || unsafe { real().glCallLists(n, type_, lists) };
    if enter(|gl, l| l.call_lists(gl, names.as_deref(), &mut call)).is_none() {
        call();
    }
}
