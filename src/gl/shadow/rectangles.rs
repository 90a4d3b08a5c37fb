//! Viewports, scissor rectangles and depth ranges that are set by their index.
#![allow(non_snake_case, reason = "each is the GL command of its name")]

use super::Shadow;
use super::change::Change;
use super::key::Key;
use super::values::{floats, read};
use crate::gl::consts as c;
use crate::gl::real::Ptr;

/// Indices that are kept. Drivers have 16.
pub(super) const INDICES: u32 = 16;

/// A viewport, unless the driver may cut it or refuses it.
pub(super) fn viewport([x, y, width, height]: [f32; 4]) -> Option<[u32; 4]> {
    let within = [x, y].iter().all(|v| v.abs() <= 4096.0) && width.max(height) <= 8192.0;
    floats([x, y, width, height]).filter(|_| within && width.min(height) >= 0.0)
}

/// A scissor rectangle, unless the driver refuses it.
fn scissor(rectangle: [i32; 4]) -> Option<[u32; 4]> {
    let [_, _, width, height] = rectangle;
    (width.min(height) >= 0).then_some(rectangle.map(|v| v as u32))
}

impl Shadow {
    pub(in crate::gl) unsafe fn glViewportIndexedf(
        &mut self,
        index: u32,
        x: f32,
        y: f32,
        w: f32,
        h: f32,
    ) {
        self.rectangle(c::VIEWPORT, index, viewport([x, y, w, h]));
    }

    pub(in crate::gl) unsafe fn glViewportIndexedfv(&mut self, index: u32, v: Ptr) {
        // SAFETY: the program's array of four.
        unsafe { self.rectangles(c::VIEWPORT, [index, 1], v, viewport) };
    }

    pub(in crate::gl) unsafe fn glViewportArrayv(&mut self, first: u32, count: i32, v: Ptr) {
        let count = u32::try_from(count).unwrap_or(0);
        // SAFETY: the program's array of four for each index.
        unsafe { self.rectangles(c::VIEWPORT, [first, count], v, viewport) };
    }

    pub(in crate::gl) unsafe fn glScissorIndexed(
        &mut self,
        index: u32,
        left: i32,
        bottom: i32,
        width: i32,
        height: i32,
    ) {
        let value = scissor([left, bottom, width, height]);
        self.rectangle(c::SCISSOR_BOX, index, value);
    }

    pub(in crate::gl) unsafe fn glScissorIndexedv(&mut self, index: u32, v: Ptr) {
        // SAFETY: the program's array of four.
        unsafe { self.rectangles(c::SCISSOR_BOX, [index, 1], v, scissor) };
    }

    pub(in crate::gl) unsafe fn glScissorArrayv(&mut self, first: u32, count: i32, v: Ptr) {
        let count = u32::try_from(count).unwrap_or(0);
        // SAFETY: the program's array of four for each index.
        unsafe { self.rectangles(c::SCISSOR_BOX, [first, count], v, scissor) };
    }

    /// The command sets depth ranges by their index, or the depth that is cleared to.
    pub(in crate::gl) unsafe fn depths(&mut self) {
        for name in [c::DEPTH_RANGE, c::DEPTH_CLEAR_VALUE] {
            self.change(Change::Put(Key::Value(name), None));
        }
    }

    /// Sets the rectangles of some indices, the first one and their number. A driver that refuses one takes none of them.
    ///
    /// # Safety
    /// The array has four numbers for each of them.
    unsafe fn rectangles<T: Copy>(
        &mut self,
        name: u32,
        [first, count]: [u32; 2],
        v: Ptr,
        of: fn([T; 4]) -> Option<[u32; 4]>,
    ) {
        let value = |at: u32| {
            let four = v.wrapping_byte_add(at as usize * size_of::<[T; 4]>());
            // SAFETY: four numbers (contract), unless there is no array.
            unsafe { read::<T, 4>(four) }.and_then(of)
        };
        let count = count.min(INDICES);
        let taken = !v.is_null() && first.saturating_add(count) <= INDICES;
        let values: Option<Vec<_>> = match taken {
            true => (0..count).map(value).collect(),
            false => None,
        };
        for at in 0..count {
            let value = values.as_ref().map(|values| values[at as usize]);
            self.rectangle(name, first.wrapping_add(at), value);
        }
    }

    fn rectangle(&mut self, name: u32, index: u32, value: Option<[u32; 4]>) {
        if !std::mem::replace(&mut self.rectangles_by_index, true) {
            self.attribs.indices_begin();
        }
        self.change(Change::Put(Key::At(name, index), value));
        if index == 0 {
            // Whole numbers are answered for it.
            self.change(Change::Put(Key::Value(name), None));
        }
    }

    /// After a rectangle was set for all indices.
    pub(super) fn spread(&mut self, key: Key, value: Option<[u32; 4]>) {
        let (name, value) = match key {
            Key::Value(c::VIEWPORT) => {
                let as_floats = |words: [u32; 4]| words.map(|v| (v as i32 as f32).to_bits());
                (c::VIEWPORT, value.map(as_floats))
            }
            Key::Value(c::SCISSOR_BOX) => (c::SCISSOR_BOX, value),
            _ => return,
        };
        (0..INDICES).for_each(|index| self.put(Key::At(name, index), value));
    }
}
