//! The arrays of fixed function: which current values an array element may set.
//!
//! An element sets those of the arrays that are on. Which ones have ever been on tells enough: programs use the same arrays in each frame, and the
//! values of all others are still known. Only those of vertex array object 0 are followed; programs with others have no array elements.
#![allow(non_snake_case, reason = "each is the GL command of its name")]

use super::Shadow;
use super::key::{COLOR, EDGE, FOG, Key, NORMAL, SECONDARY, UNITS, coordinates, current_bit};
use crate::gl::consts as c;
use crate::gl::real::Ptr;

/// The arrays that have been on in vertex array object 0.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ClientArrays {
    /// Their current values, by [`current_bit`].
    used: u32,
    /// The client's active texture unit was another one than 0.
    units: bool,
}

impl ClientArrays {
    /// Any array may have been on.
    pub(super) fn any(&mut self) {
        self.used = u32::MAX;
    }

    /// A capability is switched on. Mesa 22.3 takes the arrays as capabilities as well.
    pub(super) fn capability_on(&mut self, cap: u32) {
        let arrays = [c::FOG_COORD_ARRAY, c::SECONDARY_COLOR_ARRAY];
        if (c::VERTEX_ARRAY..=c::EDGE_FLAG_ARRAY).contains(&cap) || arrays.contains(&cap) {
            self.any();
        }
    }

    fn on(&mut self, key: Key) {
        self.used |= current_bit(key).map_or(0, |bit| 1 << bit);
    }

    /// Coordinates of the active unit.
    fn coordinates_on(&mut self) {
        let units = if self.units { UNITS } else { 1 };
        (0..units).for_each(|unit| self.on(coordinates(unit)));
    }
}

impl Shadow {
    pub(in crate::gl) unsafe fn glClientActiveTexture(&mut self, texture: u32) {
        self.client_arrays.units |= texture != c::TEXTURE0;
    }

    pub(in crate::gl) unsafe fn glEnableClientState(&mut self, array: u32) {
        let Some(arrays) = self.arrays_of_zero() else {
            return;
        };
        match array {
            c::COLOR_ARRAY => arrays.on(COLOR),
            c::NORMAL_ARRAY => arrays.on(NORMAL),
            c::SECONDARY_COLOR_ARRAY => arrays.on(SECONDARY),
            c::FOG_COORD_ARRAY => arrays.on(FOG),
            c::EDGE_FLAG_ARRAY => arrays.on(EDGE),
            c::TEXTURE_COORD_ARRAY => arrays.coordinates_on(),
            c::VERTEX_ARRAY => {}
            _ => arrays.any(),
        }
    }

    pub(in crate::gl) unsafe fn glInterleavedArrays(&mut self, _: u32, _: i32, _: Ptr) {
        if let Some(arrays) = self.arrays_of_zero() {
            arrays.on(COLOR);
            arrays.on(NORMAL);
            arrays.coordinates_on();
        }
    }

    /// glArrayElement.
    pub(in crate::gl) unsafe fn array_element(&mut self) {
        self.forget_arrays();
    }

    /// The values of all arrays may have changed.
    pub(in crate::gl) fn forget_arrays(&mut self) {
        let set = match self.array_object() {
            Some(0) => self.client_arrays.used,
            _ => u32::MAX,
        };
        self.forget_currents(set);
    }

    /// A generic attribute is switched on. Some drivers let it be a current value as well.
    pub(super) fn attribute_on(&mut self) {
        if let Some(arrays) = self.arrays_of_zero() {
            arrays.any();
        }
    }

    fn array_object(&self) -> Option<u32> {
        let array = self.values.known(Key::Value(c::VERTEX_ARRAY_BINDING));
        array.map(|[array, ..]| array)
    }

    /// None where another vertex array object is bound.
    fn arrays_of_zero(&mut self) -> Option<&mut ClientArrays> {
        let other = self.array_object().is_some_and(|array| array != 0);
        (!other).then_some(&mut self.client_arrays)
    }
}
