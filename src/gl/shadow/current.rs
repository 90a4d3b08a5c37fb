//! Current values of vertices: colour, normal, texture coordinates, secondary colour, fog coordinate, edge flag.
//!
//! Of what a program draws between glBegin and glEnd, only the last call of each value is noted ([`super::note_recorded`]).
#![allow(non_snake_case, reason = "each is the GL command of its name")]

use super::Shadow;
use super::change::Change;
use super::key::{COLOR, EDGE, FOG, Key, NORMAL, SECONDARY, UNITS, coordinates, current_bit};
use super::values::{floats, read};
use crate::gl::consts as c;
use crate::gl::real::Ptr;

/// Equal answers after which the driver's conversion of bytes counts as proven.
const PROOFS: u8 = 32;

/// Whether bytes become floats as they do here: divided by 255. Drivers are believed once they have answered so often enough.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bytes {
    proofs: u8,
    /// What the driver should answer, if bytes have set this value last.
    guess: Option<(Key, [u32; 4])>,
}

impl Bytes {
    /// The driver has answered.
    pub(super) fn compare(&mut self, key: Key, value: [u32; 4]) {
        let Some((_, guess)) = self.guess.filter(|(guessed, _)| *guessed == key) else {
            return;
        };
        self.guess = None;
        let trivial = |word: &u32| [0.0, 1.0].contains(&f32::from_bits(*word));
        if guess != value {
            self.proofs = 0;
        } else if !guess.iter().all(trivial) {
            self.proofs = self.proofs.saturating_add(1);
        }
    }
}

macro_rules! numbers {
    ($key:expr, $rest:expr; $($name:ident($kind:ty; $($arg:ident)+);)*) => { $(
        pub(in crate::gl) unsafe fn $name(&mut self, $($arg: $kind),+) {
            self.current($key, &[$($arg as f32),+], $rest);
        }
    )* };
}

macro_rules! arrays {
    ($key:expr, $rest:expr; $($name:ident($kind:ty; $len:literal);)*) => { $(
        pub(in crate::gl) unsafe fn $name(&mut self, v: Ptr) {
            // SAFETY: the program's array, which has so many.
            match unsafe { read::<$kind, $len>(v) } {
                Some(values) => self.current($key, &values.map(|v| v as f32), $rest),
                None => self.unknown($key),
            }
        }
    )* };
}

macro_rules! units {
    ($($name:ident($kind:ty; $($arg:ident)+);)*) => { $(
        pub(in crate::gl) unsafe fn $name(&mut self, target: u32, $($arg: $kind),+) {
            self.coordinates_of(target, Some(&[$($arg as f32),+]));
        }
    )* };
}

macro_rules! unit_arrays {
    ($($name:ident($kind:ty; $len:literal);)*) => { $(
        pub(in crate::gl) unsafe fn $name(&mut self, target: u32, v: Ptr) {
            // SAFETY: the program's array, which has so many.
            let values = unsafe { read::<$kind, $len>(v) }.map(|values| values.map(|v| v as f32));
            self.coordinates_of(target, values.as_ref().map(|values| values.as_slice()));
        }
    )* };
}

/// What a command that gives fewer values leaves.
const OPAQUE: [f32; 4] = [0.0, 0.0, 0.0, 1.0];
const ZERO: [f32; 4] = [0.0; 4];

#[allow(
    trivial_numeric_casts,
    clippy::unnecessary_cast,
    reason = "one macro for all kinds of numbers"
)]
impl Shadow {
    numbers! { COLOR, OPAQUE;
        glColor3f(f32; red green blue);
        glColor4f(f32; red green blue alpha);
        glColor3d(f64; red green blue);
        glColor4d(f64; red green blue alpha);
    }
    arrays! { COLOR, OPAQUE;
        glColor3fv(f32; 3);
        glColor4fv(f32; 4);
        glColor3dv(f64; 3);
        glColor4dv(f64; 4);
    }
    numbers! { NORMAL, ZERO;
        glNormal3f(f32; nx ny nz);
        glNormal3d(f64; nx ny nz);
    }
    arrays! { NORMAL, ZERO;
        glNormal3fv(f32; 3);
        glNormal3dv(f64; 3);
    }
    numbers! { SECONDARY, ZERO;
        glSecondaryColor3f(f32; red green blue);
        glSecondaryColor3d(f64; red green blue);
    }
    arrays! { SECONDARY, ZERO;
        glSecondaryColor3fv(f32; 3);
        glSecondaryColor3dv(f64; 3);
    }
    numbers! { FOG, ZERO;
        glFogCoordf(f32; coord);
        glFogCoordd(f64; coord);
    }
    arrays! { FOG, ZERO;
        glFogCoordfv(f32; 1);
        glFogCoorddv(f64; 1);
    }
    numbers! { coordinates(0), OPAQUE;
        glTexCoord1f(f32; s);
        glTexCoord2f(f32; s t);
        glTexCoord3f(f32; s t r);
        glTexCoord4f(f32; s t r q);
        glTexCoord1d(f64; s);
        glTexCoord2d(f64; s t);
        glTexCoord3d(f64; s t r);
        glTexCoord4d(f64; s t r q);
        glTexCoord1i(i32; s);
        glTexCoord2i(i32; s t);
        glTexCoord3i(i32; s t r);
        glTexCoord4i(i32; s t r q);
        glTexCoord1s(i16; s);
        glTexCoord2s(i16; s t);
        glTexCoord3s(i16; s t r);
        glTexCoord4s(i16; s t r q);
    }
    arrays! { coordinates(0), OPAQUE;
        glTexCoord1fv(f32; 1);
        glTexCoord2fv(f32; 2);
        glTexCoord3fv(f32; 3);
        glTexCoord4fv(f32; 4);
        glTexCoord1dv(f64; 1);
        glTexCoord2dv(f64; 2);
        glTexCoord3dv(f64; 3);
        glTexCoord4dv(f64; 4);
        glTexCoord1iv(i32; 1);
        glTexCoord2iv(i32; 2);
        glTexCoord3iv(i32; 3);
        glTexCoord4iv(i32; 4);
        glTexCoord1sv(i16; 1);
        glTexCoord2sv(i16; 2);
        glTexCoord3sv(i16; 3);
        glTexCoord4sv(i16; 4);
    }
    units! {
        glMultiTexCoord1f(f32; s);
        glMultiTexCoord2f(f32; s t);
        glMultiTexCoord3f(f32; s t r);
        glMultiTexCoord4f(f32; s t r q);
        glMultiTexCoord1d(f64; s);
        glMultiTexCoord2d(f64; s t);
        glMultiTexCoord3d(f64; s t r);
        glMultiTexCoord4d(f64; s t r q);
    }
    unit_arrays! {
        glMultiTexCoord1fv(f32; 1);
        glMultiTexCoord2fv(f32; 2);
        glMultiTexCoord3fv(f32; 3);
        glMultiTexCoord4fv(f32; 4);
        glMultiTexCoord1dv(f64; 1);
        glMultiTexCoord2dv(f64; 2);
        glMultiTexCoord3dv(f64; 3);
        glMultiTexCoord4dv(f64; 4);
    }

    pub(in crate::gl) unsafe fn glColor3ub(&mut self, red: u8, green: u8, blue: u8) {
        self.bytes([red, green, blue, 255]);
    }

    pub(in crate::gl) unsafe fn glColor4ub(&mut self, red: u8, green: u8, blue: u8, alpha: u8) {
        self.bytes([red, green, blue, alpha]);
    }

    pub(in crate::gl) unsafe fn glColor3ubv(&mut self, v: Ptr) {
        // SAFETY: the program's array of three.
        match unsafe { read::<u8, 3>(v) } {
            Some([red, green, blue]) => self.bytes([red, green, blue, 255]),
            None => self.unknown(COLOR),
        }
    }

    pub(in crate::gl) unsafe fn glColor4ubv(&mut self, v: Ptr) {
        // SAFETY: the program's array of four.
        match unsafe { read::<u8, 4>(v) } {
            Some(bytes) => self.bytes(bytes),
            None => self.unknown(COLOR),
        }
    }

    pub(in crate::gl) unsafe fn glEdgeFlag(&mut self, flag: u8) {
        let value = [u32::from(flag != 0), 0, 0, 0];
        self.change(Change::Put(EDGE, Some(value)));
    }

    pub(in crate::gl) unsafe fn glEdgeFlagv(&mut self, flag: Ptr) {
        // SAFETY: the program's flag.
        match unsafe { read::<u8, 1>(flag) } {
            // SAFETY: no pointers.
            Some([flag]) => unsafe { self.glEdgeFlag(flag) },
            None => self.unknown(EDGE),
        }
    }

    /// A colour by a command that drivers convert in ways of their own.
    pub(in crate::gl) unsafe fn other_color(&mut self) {
        self.unknown(COLOR);
    }

    /// As [`Shadow::other_color`], for a normal.
    pub(in crate::gl) unsafe fn other_normal(&mut self) {
        self.unknown(NORMAL);
    }

    /// As [`Shadow::other_color`], for a secondary colour.
    pub(in crate::gl) unsafe fn other_secondary(&mut self) {
        self.unknown(SECONDARY);
    }

    /// As [`Shadow::other_color`], for a fog coordinate.
    pub(in crate::gl) unsafe fn other_fog(&mut self) {
        self.unknown(FOG);
    }

    /// As [`Shadow::other_color`], for the coordinates of unit 0.
    pub(in crate::gl) unsafe fn other_coordinates(&mut self) {
        self.unknown(coordinates(0));
    }

    /// As [`Shadow::other_color`], for the coordinates of some unit.
    pub(in crate::gl) unsafe fn other_units(&mut self) {
        self.forget_units();
    }

    /// A call that may set any of them.
    pub(in crate::gl) unsafe fn any_current(&mut self) {
        if let Some(list) = &mut self.compiling {
            list.evaluates = true;
        }
        self.forget_current();
    }

    /// Arrays are drawn. In a display list they become vertices, which leave their values behind; elsewhere they do not, or leave what the
    /// specification does not define.
    pub(in crate::gl) unsafe fn listed_arrays(&mut self) {
        if self.compiling.is_some() {
            self.forget_arrays();
        }
    }

    /// Any of them may have changed.
    pub(in crate::gl) fn forget_current(&mut self) {
        self.forget_currents(u32::MAX);
    }

    /// Those of a set, by [`current_bit`], may have changed.
    pub(super) fn forget_currents(&mut self, set: u32) {
        let units = (0..UNITS).map(coordinates);
        for key in [COLOR, NORMAL, SECONDARY, FOG, EDGE]
            .into_iter()
            .chain(units)
        {
            if current_bit(key).is_some_and(|bit| set & 1 << bit != 0) {
                self.unknown(key);
            }
        }
    }

    fn forget_units(&mut self) {
        (0..UNITS).for_each(|unit| self.unknown(coordinates(unit)));
    }

    fn current(&mut self, key: Key, values: &[f32], rest: [f32; 4]) {
        let mut all = rest;
        all[..values.len()].copy_from_slice(values);
        self.change(Change::Put(key, floats(all)));
    }

    fn unknown(&mut self, key: Key) {
        self.change(Change::Put(key, None));
    }

    fn coordinates_of(&mut self, target: u32, values: Option<&[f32]>) {
        let unit = target.wrapping_sub(c::TEXTURE0);
        match values {
            Some(values) if unit < UNITS => self.current(coordinates(unit), values, OPAQUE),
            _ => self.forget_units(),
        }
    }

    fn bytes(&mut self, bytes: [u8; 4]) {
        let value = bytes.map(|byte| (f32::from(byte) / 255.0).to_bits());
        let sure = self.bytes.proofs >= PROOFS;
        self.change(Change::Put(COLOR, sure.then_some(value)));
        self.bytes.guess = (!sure && self.compiling.is_none()).then_some((COLOR, value));
    }
}
