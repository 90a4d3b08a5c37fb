//! Immediate mode between glBegin and glEnd, kept as it came, so that it can be sent again for every view.

use super::consts as c;
use super::object_names::ListName;
use super::real::{Ptr, Real};
use super::shadow;
use super::table::{note_one, replay_one, sets, slot};

/// The slots of glVertex* are the first ones.
const LAST_VERTEX: usize = slot::glVertex4hvNV;
/// Of those with two and three numbers, eight each: by 64-bit and 32-bit floats, 32-bit and 16-bit integers, each also by pointer.
const LAST_PLAIN: usize = slot::glVertex3sv;
const _: () = assert!(
    slot::glVertex2d == 0 && slot::glVertex3d == 8 && LAST_PLAIN == 15 && LAST_VERTEX == 29
);

/// The calls between one glBegin and its glEnd: per call the slot of the command, then its arguments in words of 32 bits;
/// arrays lie inline. 64-bit elements start on even words, because the driver may read them by pointer.
#[derive(Debug, Default)]
pub struct Recording {
    words: Vec<u32>,
    calls: usize,
    /// Where the calls that give a vertex stand.
    vertices: Vec<u32>,
    /// Where the last call of each current value stands.
    last: [Option<u32>; VALUES],
    /// Some call may set any current value.
    any: bool,
    /// Some call is an array element.
    elements: bool,
}

/// Texture units whose coordinates the shadow keeps.
const UNITS: usize = shadow::UNITS as usize;
/// Current values that the shadow keeps: colour, normal, secondary colour, fog coordinate, edge flag, coordinates of the units.
const VALUES: usize = 5 + UNITS;

/// Which current value a recorded call sets.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sets {
    Nothing,
    /// That of this place in `Recording::last`.
    Value(usize),
    /// The coordinates of the texture unit that its first argument names.
    Unit,
    /// Those of the arrays that are on.
    Arrays,
    /// Any.
    Any,
}

macro_rules! small {
    ($($t:ident)*) => { $(
        #[inline]
        #[doc = concat!("Writes one ", stringify!($t), ".")]
        pub fn $t(&mut self, v: $t) { self.words.push(v as u32); }
    )* };
}

impl Recording {
    /// Forgets the calls, keeps the memory.
    pub fn clear(&mut self) {
        self.words.clear();
        self.vertices.clear();
        self.calls = 0;
        self.last = [None; VALUES];
        self.any = false;
        self.elements = false;
    }

    /// Number of calls recorded.
    pub fn calls(&self) -> usize {
        self.calls
    }

    /// Records one call, whose arguments `write` writes.
    #[inline]
    pub fn call(&mut self, slot: usize, write: impl FnOnce(&mut Recording)) {
        let at = self.words.len() as u32;
        if slot <= LAST_VERTEX {
            self.vertices.push(at);
        }
        self.words.push(slot as u32);
        self.calls += 1;
        write(self);
        match sets(slot) {
            Sets::Nothing => {}
            Sets::Value(value) => self.last[value] = Some(at),
            Sets::Unit => {
                let target = self.words.get(at as usize + 1).copied().unwrap_or_default();
                match target.wrapping_sub(c::TEXTURE0) as usize {
                    unit @ 0..UNITS => self.last[VALUES - UNITS + unit] = Some(at),
                    _ => self.any = true,
                }
            }
            Sets::Arrays => self.elements = true,
            Sets::Any => self.any = true,
        }
    }

    small!(u8 i8 u16 i16 u32 i32);

    /// Writes one f32.
    #[inline]
    pub fn f32(&mut self, v: f32) {
        self.words.push(v.to_bits());
    }

    /// Writes one f64.
    #[inline]
    pub fn f64(&mut self, v: f64) {
        self.u64(v.to_bits());
    }

    /// Writes one u64.
    #[inline]
    pub fn u64(&mut self, v: u64) {
        self.align();
        self.words.extend([v as u32, (v >> 32) as u32]);
    }

    fn align(&mut self) {
        if self.words.len() % 2 == 1 {
            self.words.push(0);
        }
    }

    /// Writes `len` elements.
    ///
    /// # Safety
    /// `data` points to `len` readable elements, or is null.
    #[inline]
    pub unsafe fn slice<T: Copy>(&mut self, data: *const T, len: usize) {
        let len = if data.is_null() { 0 } else { len };
        let words = (len * size_of::<T>()).div_ceil(4);
        self.words.push(words as u32);
        self.align();
        let start = self.words.len();
        self.words.resize(start + words, 0);
        // SAFETY: source readable for len elements (caller).
        // SAFETY: destination was just resized to at least as many bytes.
        // SAFETY: the program's memory and our vector do not overlap.
        unsafe {
            core::ptr::copy_nonoverlapping(
                data.cast::<u8>(),
                self.words[start..].as_mut_ptr().cast::<u8>(),
                len * size_of::<T>(),
            )
        }
    }

    /// Gives all positions of the vertices that glVertex* gave. False where some are not of two or three numbers.
    pub fn positions(&self, each: &mut dyn FnMut([f32; 3])) -> bool {
        for &start in &self.vertices {
            let mut r = Reader {
                words: &self.words,
                at: start as usize,
            };
            let slot = r.u32() as usize;
            if slot > LAST_PLAIN {
                return false;
            }
            let (count, form) = (2 + slot / 8, slot % 8);
            if form % 2 == 1 {
                // The length, then the elements.
                r.u32();
                r.at += r.at % 2;
            }
            let mut position = [0.0; 3];
            for value in position.iter_mut().take(count) {
                *value = match form {
                    0 | 1 => r.f64() as f32,
                    2 | 3 => r.f32(),
                    4 | 5 => r.i32() as f32,
                    6 => f32::from(r.i16()),
                    // Two in a word.
                    _ => return false,
                };
            }
            each(position);
        }
        true
    }

    /// Makes all recorded calls again.
    ///
    /// # Safety
    /// The context they were recorded in is current, between glBegin and glEnd.
    pub unsafe fn replay(&self, real: &Real) {
        let mut r = Reader {
            words: &self.words,
            at: 0,
        };
        while r.at < self.words.len() {
            let slot = r.u32() as usize;
            // SAFETY: the slot number of a recorded call stands here; the arguments follow.
            if !unsafe { replay_one(real, slot, &mut r) } {
                return;
            }
        }
        shadow::noted(|s| {
            if self.any {
                return s.forget_current();
            }
            for at in self.last.into_iter().flatten() {
                let mut r = Reader {
                    words: &self.words,
                    at: at as usize,
                };
                let slot = r.u32() as usize;
                // SAFETY: as above.
                unsafe { note_one(s, slot, &mut r) };
            }
            if self.elements {
                s.forget_arrays();
            }
        });
    }
}

/// Lists that begin and end a primitive in the place of glBegin and glEnd; 0 for none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ends {
    /// Has glBegin without glEnd.
    pub opener: ListName,
    /// Has glEnd without glBegin.
    pub closer: ListName,
}

/// Reads the words of a [`Recording`] back in the order of writing.
pub(super) struct Reader<'a> {
    words: &'a [u32],
    at: usize,
}

macro_rules! small_read {
    ($($t:ident)*) => { $(
        #[inline]
        pub(super) fn $t(&mut self) -> $t { self.word() as $t }
    )* };
}

impl Reader<'_> {
    #[inline]
    fn word(&mut self) -> u32 {
        let w = self.words.get(self.at).copied().unwrap_or(0);
        self.at += 1;
        w
    }

    small_read!(u8 i8 u16 i16 u32 i32);

    #[inline]
    pub(super) fn f32(&mut self) -> f32 {
        f32::from_bits(self.word())
    }

    #[inline]
    pub(super) fn f64(&mut self) -> f64 {
        f64::from_bits(self.u64())
    }

    #[inline]
    pub(super) fn u64(&mut self) -> u64 {
        self.at += self.at % 2;
        u64::from(self.word()) | u64::from(self.word()) << 32
    }

    #[inline]
    pub(super) fn slice(&mut self) -> Ptr {
        let words = self.word() as usize;
        self.at += self.at % 2;
        let p = self
            .words
            .get(self.at..)
            .map_or(core::ptr::null(), <[u32]>::as_ptr);
        self.at += words;
        p as Ptr
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_come_back_as_written() {
        let mut w = Recording::default();
        w.call(7, |w| {
            w.f32(-1.5);
            w.i16(-3);
            w.f64(1e300);
            // SAFETY: three doubles of this frame.
            unsafe { w.slice([1.0f64, 2.0, 3.0].as_ptr(), 3) };
            w.u8(200);
        });
        let mut r = Reader {
            words: &w.words,
            at: 0,
        };
        assert_eq!((r.u32(), r.f32(), r.i16(), r.f64()), (7, -1.5, -3, 1e300));
        let p = r.slice() as *const f64;
        // SAFETY: the three doubles written above, aligned to 8 bytes only if the vector is: read unaligned.
        let read = unsafe {
            [
                p.read_unaligned(),
                p.add(1).read_unaligned(),
                p.add(2).read_unaligned(),
            ]
        };
        assert_eq!(read, [1.0, 2.0, 3.0]);
        assert_eq!(r.u8(), 200);
        assert_eq!(r.at, w.words.len());
    }
}
