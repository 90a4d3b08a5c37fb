//! Reads and writes at the addresses that commands are given.

use super::Arg;
use crate::gl::Ptr;
use std::ffi::{CStr, c_char};

/// A type of elements in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    I32,
    U32,
    I64,
    F32,
    F64,
    U8,
}

impl Kind {
    /// By the letters at the end of a command, such as `fv` or `i_v`.
    pub(super) fn of(name: &str) -> Kind {
        let name = name.trim_end_matches("ARB").trim_end_matches("EXT");
        let letters = name.trim_end_matches('v').trim_end_matches("i_");
        match letters {
            l if l.ends_with("64") => Kind::I64,
            l if l.ends_with("ui") => Kind::U32,
            l if l.ends_with("Boolean") => Kind::U8,
            l if l.ends_with('f') || l.ends_with("Float") => Kind::F32,
            l if l.ends_with('d') || l.ends_with("Double") => Kind::F64,
            _ => Kind::I32,
        }
    }
}

/// The address of an argument.
pub(super) fn address(arg: Option<&Arg>) -> Ptr {
    match arg {
        Some(Arg::Ptr(p)) => *p as Ptr,
        _ => core::ptr::null_mut(),
    }
}

/// Elements of a type, as a caller of the command has promised that they lie there; none at null.
pub(super) fn read(from: Ptr, kind: Kind, count: usize) -> Vec<f64> {
    if from.is_null() {
        return Vec::new();
    }
    let element = |at: usize| {
        // SAFETY: the caller of the command gives so many elements of this type.
        unsafe {
            match kind {
                Kind::I32 => from.cast::<i32>().add(at).read_unaligned().into(),
                Kind::U32 => from.cast::<u32>().add(at).read_unaligned().into(),
                Kind::I64 => from.cast::<i64>().add(at).read_unaligned() as f64,
                Kind::F32 => from.cast::<f32>().add(at).read_unaligned().into(),
                Kind::F64 => from.cast::<f64>().add(at).read_unaligned(),
                Kind::U8 => from.cast::<u8>().add(at).read().into(),
            }
        }
    };
    (0..count).map(element).collect()
}

/// Writes elements of a type where a caller of the command wants them.
pub(super) fn write(to: Ptr, kind: Kind, values: &[f64]) {
    if to.is_null() {
        return;
    }
    for (at, &value) in values.iter().enumerate() {
        // SAFETY: the caller of the command has room for as many elements as the name that it asks for has.
        unsafe {
            match kind {
                Kind::I32 => to
                    .cast::<i32>()
                    .add(at)
                    .write_unaligned(value as i64 as i32),
                Kind::U32 => to.cast::<u32>().add(at).write_unaligned(value as u32),
                Kind::I64 => to.cast::<i64>().add(at).write_unaligned(value as i64),
                Kind::F32 => to.cast::<f32>().add(at).write_unaligned(value as f32),
                Kind::F64 => to.cast::<f64>().add(at).write_unaligned(value),
                Kind::U8 => to.cast::<u8>().add(at).write((value != 0.0).into()),
            }
        }
    }
}

/// Bytes, as a caller of the command has promised that they lie there.
pub(super) fn bytes(from: Ptr, count: usize) -> Vec<u8> {
    if from.is_null() {
        return Vec::new();
    }
    // SAFETY: the caller of the command gives so many bytes.
    unsafe { core::slice::from_raw_parts(from.cast::<u8>(), count) }.to_vec()
}

/// Writes bytes where a caller of the command wants them.
pub(super) fn put_bytes(to: Ptr, bytes: &[u8]) {
    if !to.is_null() {
        // SAFETY: the caller of the command has room for so many bytes, and they are not ours.
        unsafe { core::ptr::copy_nonoverlapping(bytes.as_ptr(), to.cast::<u8>(), bytes.len()) };
    }
}

/// A string that ends in NUL.
pub(super) fn string(from: Ptr) -> String {
    if from.is_null() {
        return String::new();
    }
    // SAFETY: the caller of the command gives a string that ends in NUL.
    let text = unsafe { CStr::from_ptr(from as *const c_char) };
    text.to_string_lossy().into_owned()
}

/// Strings of the given lengths, one after the other; those without a length end in NUL.
pub(super) fn strings(count: usize, strings: Ptr, lengths: Ptr) -> Vec<u8> {
    let mut all = Vec::new();
    let lengths = read(lengths, Kind::I32, count);
    for at in 0..count {
        // SAFETY: the caller of the command gives so many addresses.
        let from = unsafe { strings.cast::<Ptr>().add(at).read_unaligned() };
        match lengths.get(at) {
            Some(&length) if length >= 0.0 => all.extend(bytes(from, length as usize)),
            _ => all.extend(string(from).into_bytes()),
        }
    }
    all
}

/// A string as glGet*Name and glGet*Log give it: cut to the room there is, with a NUL, and its length.
pub(super) fn put_string(text: &str, room: i64, length: Ptr, to: Ptr) {
    let room = usize::try_from(room).unwrap_or(0);
    let cut = text.len().min(room.saturating_sub(1));
    if room > 0 {
        let mut all = text.as_bytes().get(..cut).unwrap_or_default().to_vec();
        all.push(0);
        put_bytes(to, &all);
    }
    write(length, Kind::I32, &[cut as f64]);
}
