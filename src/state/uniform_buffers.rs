//! The contents of the program's uniform buffers, in which its cameras may be: a copy of what the program has written, so that the driver
//! need not be asked.
//!
//! What the layer cannot follow (written by shaders, through a mapping that is not seen, or before the buffer was bound to a block) is
//! unknown until it is read from the driver once.

use crate::gl::{BufferName, Mapping};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// The largest part of one buffer that is followed, in bytes from its beginning.
const LARGEST: usize = 1 << 22;

/// The most places of matrices in one buffer.
const PLACES: usize = 1024;

/// The largest part of a mapping, in bytes, that is taken as a whole.
const SMALL: usize = 1 << 14;

/// Bytes of a matrix of single precision.
const MATRIX: usize = 64;

/// Number of changes of uniform buffers, their contents and their bindings, in all contexts.
static CHANGES: AtomicU64 = AtomicU64::new(1);

/// Notes that a uniform block of some program may have other contents.
pub fn block_changes() {
    CHANGES.fetch_add(1, Ordering::Relaxed);
}

/// The number of changes of uniform blocks so far.
pub fn block_change() -> u64 {
    CHANGES.load(Ordering::Relaxed)
}

/// Number of changes of the binding points of programs' blocks, in all contexts.
static BINDINGS: AtomicU64 = AtomicU64::new(1);

/// Notes glUniformBlockBinding.
pub fn binding_changes() {
    BINDINGS.fetch_add(1, Ordering::Relaxed);
    block_changes();
}

/// The number of calls of glUniformBlockBinding so far.
pub fn binding_change() -> u64 {
    BINDINGS.load(Ordering::Relaxed)
}

/// Number of times that some buffer got another store, in all contexts.
static STORES: AtomicU64 = AtomicU64::new(1);

/// Notes that a buffer gets another store.
pub fn store_changes() {
    STORES.fetch_add(1, Ordering::Relaxed);
}

/// The number of stores that buffers have got so far.
pub fn store_change() -> u64 {
    STORES.load(Ordering::Relaxed)
}

/// What is known of the matrix at a place of a buffer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Found {
    /// Its 16 numbers, in the order in which they lie in the buffer.
    Matrix([f32; 16]),
    /// The driver has to be asked.
    Unknown,
    /// The driver cannot be asked now, because the buffer is mapped.
    Mapped,
}

/// The contents of one buffer.
#[derive(Debug, Default)]
struct Contents {
    bytes: Vec<u8>,
    /// Whether each of them is what the driver has.
    known: Vec<bool>,
    mapping: Option<(Mapping, usize)>,
    /// Bytes of its store; none where it got that before it was followed.
    size: Option<usize>,
    /// Where matrices were asked for. Of much that the program writes through a mapping only these are taken, because such memory is slow to
    /// read.
    wanted: BTreeSet<usize>,
}

/// The uniform buffers of a share group.
#[derive(Debug, Default)]
pub struct UniformBuffers {
    contents: FxHashMap<BufferName, Contents>,
    /// Buffers that are bound where shaders may write to them, followed or not.
    written_by_shaders: FxHashSet<BufferName>,
}

impl Contents {
    /// The bytes from `at` on, `length` of them; none beyond the part that is followed.
    fn part(&mut self, at: usize, length: usize) -> Option<Range<usize>> {
        let end = at.checked_add(length).filter(|&end| end <= LARGEST)?;
        if self.bytes.len() < end {
            self.bytes.resize(end, 0);
            self.known.resize(end, false);
        }
        Some(at..end)
    }

    fn write(&mut self, at: usize, data: &[u8]) {
        let data = &data[..data.len().min(LARGEST.saturating_sub(at))];
        if let Some(part) = self.part(at, data.len()) {
            self.bytes[part.clone()].copy_from_slice(data);
            self.known[part].fill(true);
        }
    }

    fn forget(&mut self, part: Range<usize>) {
        let end = part.end.min(self.known.len());
        if let Some(known) = self.known.get_mut(part.start..end) {
            known.fill(false);
        }
    }

    fn forget_all(&mut self) {
        self.known.fill(false);
    }

    fn matrix(&self, at: usize) -> Found {
        if let Some((mapping, from)) = &self.mapping {
            let numbers = at.checked_sub(*from).and_then(|at| mapping.numbers(at));
            return match numbers.filter(|_| mapping.stays) {
                Some(numbers) => Found::Matrix(numbers),
                None => Found::Mapped,
            };
        }
        let part = at..at + MATRIX;
        match (self.bytes.get(part.clone()), self.known.get(part)) {
            (Some(bytes), Some(known)) if known.iter().all(|&known| known) => {
                Found::Matrix(numbers(bytes))
            }
            _ => Found::Unknown,
        }
    }
}

fn numbers(bytes: &[u8]) -> [f32; 16] {
    let mut all = [0.0; 16];
    let values = bytes
        .chunks_exact(4)
        .map(|b| f32::from_ne_bytes([b[0], b[1], b[2], b[3]]));
    all.iter_mut()
        .zip(values)
        .for_each(|(to, value)| *to = value);
    all
}

impl UniformBuffers {
    /// The program binds a buffer to uniform blocks: it is followed from now on.
    pub fn follow(&mut self, buffer: BufferName) {
        if !buffer.is_zero() {
            self.contents.entry(buffer).or_default();
        }
    }

    /// Whether a buffer is followed.
    pub fn follows(&self, buffer: BufferName) -> bool {
        self.contents.contains_key(&buffer)
    }

    /// Runs `change` on a buffer, if that is followed, and notes the change.
    fn changed(&mut self, buffer: BufferName, change: impl FnOnce(&mut Contents)) {
        if let Some(contents) = self.contents.get_mut(&buffer) {
            change(contents);
            block_changes();
        }
    }

    /// The program gives a buffer another store of so many bytes, with these contents if any are given.
    pub fn replaced(&mut self, buffer: BufferName, size: usize, data: Option<&[u8]>) {
        self.changed(buffer, |contents| {
            contents.size = Some(size);
            contents.bytes.clear();
            contents.known.clear();
            contents.mapping = None;
            if let Some(data) = data {
                contents.write(0, &data[..data.len().min(LARGEST)]);
            }
        });
    }

    /// Bytes of a buffer's store, where they are known.
    pub fn size(&self, buffer: BufferName) -> Option<usize> {
        self.contents.get(&buffer)?.size
    }

    /// Writes to a buffer, from a byte on.
    pub fn written(&mut self, buffer: BufferName, at: usize, data: &[u8]) {
        self.changed(buffer, |contents| contents.write(at, data));
    }

    /// Notes the matrix that the driver has in a buffer, from a byte on.
    pub fn read(&mut self, buffer: BufferName, at: usize, matrix: &[f32; 16]) {
        if let Some(contents) = self.contents.get_mut(&buffer) {
            contents.write(at, &bytes(matrix));
        }
    }

    /// Bytes of a buffer may be anything now.
    pub fn forget(&mut self, buffer: BufferName, part: Range<usize>) {
        self.changed(buffer, |contents| contents.forget(part));
    }

    /// All bytes of a buffer may be anything now.
    pub fn forget_all(&mut self, buffer: BufferName) {
        self.changed(buffer, Contents::forget_all);
    }

    /// Copies bytes from a buffer to another one.
    pub fn copied(
        &mut self,
        (from, at): (BufferName, usize),
        (to, to_at): (BufferName, usize),
        length: usize,
    ) {
        let source = self.contents.get(&from).and_then(|contents| {
            let part = at..at.checked_add(length)?;
            let known = contents.known.get(part.clone())?.iter().all(|&known| known);
            known.then(|| contents.bytes.get(part).map(<[u8]>::to_vec))?
        });
        self.changed(to, |contents| match source {
            Some(data) => contents.write(to_at, &data),
            None => contents.forget(to_at..to_at.saturating_add(length)),
        });
    }

    /// The program has mapped bytes of a buffer, from `at` on.
    pub fn mapped(&mut self, buffer: BufferName, at: usize, mapping: Mapping) {
        if mapping.stays {
            // It may be bound to blocks later, and no call tells of what is written.
            self.follow(buffer);
        }
        self.changed(buffer, |contents| contents.mapping = Some((mapping, at)));
    }

    /// The program has flushed bytes of a mapping, counted from its beginning.
    pub fn flushed(&mut self, buffer: BufferName, at: usize, length: usize) {
        self.changed(buffer, |contents| {
            let Some((mapping, from)) = contents.mapping.take() else {
                return;
            };
            if !mapping.stays {
                take(contents, &mapping, from, at..at.saturating_add(length));
            }
            contents.mapping = Some((mapping, from));
        });
    }

    /// The program is about to unmap a buffer.
    pub fn unmapped(&mut self, buffer: BufferName) {
        self.changed(buffer, |contents| {
            let Some((mapping, from)) = contents.mapping.take() else {
                return contents.forget_all();
            };
            // Otherwise only what was flushed is written, and that was taken then.
            if mapping.stays || !mapping.flushed_by_name {
                take(contents, &mapping, from, 0..mapping.length());
            }
        });
    }

    /// The driver is about to unmap a buffer, whose contents do not matter.
    pub fn unmapped_by_driver(&mut self, buffer: BufferName) {
        self.changed(buffer, |contents| contents.mapping = None);
    }

    /// A buffer is bound where shaders may write to it.
    pub fn bound_to_be_written(&mut self, buffer: BufferName) {
        self.written_by_shaders.insert(buffer);
    }

    /// Shaders may have written to the buffers that are bound for that. Returns whether any of them is followed.
    pub fn shaders_wrote(&mut self) -> bool {
        let mut any = false;
        for buffer in &self.written_by_shaders {
            if let Some(contents) = self.contents.get_mut(buffer) {
                contents.forget_all();
                any = true;
            }
        }
        if any {
            block_changes();
        }
        any
    }

    /// Whether a buffer is bound where shaders may write to it.
    pub fn is_written_by_shaders(&self, buffer: BufferName) -> bool {
        self.written_by_shaders.contains(&buffer)
    }

    /// The program has deleted a buffer.
    pub fn deleted(&mut self, buffer: BufferName) {
        self.contents.remove(&buffer);
        self.written_by_shaders.remove(&buffer);
    }

    /// The matrix in a buffer, from a byte on.
    pub fn matrix(&mut self, buffer: BufferName, at: usize) -> Found {
        let Some(contents) = self.contents.get_mut(&buffer) else {
            return Found::Unknown;
        };
        if contents.wanted.len() < PLACES {
            contents.wanted.insert(at);
        }
        contents.matrix(at)
    }

    /// Whether any buffer is mapped.
    pub fn has_mappings(&self) -> bool {
        self.contents.values().any(|c| c.mapping.is_some())
    }

    /// Whether a buffer may change without a call.
    pub fn is_live(&self, buffer: BufferName) -> bool {
        let mapping = self
            .contents
            .get(&buffer)
            .and_then(|contents| contents.mapping.as_ref());
        mapping.is_some_and(|(mapping, _)| mapping.stays)
    }
}

/// Takes what the program has written through a mapping that begins at the byte `from` of the buffer: all of a small part, and of a large one
/// the matrices that were asked for; the rest is unknown. `part` is of the mapping.
fn take(contents: &mut Contents, mapping: &Mapping, from: usize, part: Range<usize>) {
    let part = from.saturating_add(part.start)..from + part.end.min(mapping.length());
    if part.start >= part.end {
        return;
    }
    contents.forget(part.clone());
    let last = part.end.saturating_sub(MATRIX);
    let places: Vec<usize> = if part.len() <= SMALL {
        part.clone()
            .step_by(MATRIX)
            .map(|at| at.min(last))
            .collect()
    } else {
        contents.wanted.range(part.clone()).copied().collect()
    };
    let within = |at: &usize| *at >= part.start && at + MATRIX <= part.end;
    for at in places.into_iter().filter(within) {
        if let Some(numbers) = mapping.numbers(at - from) {
            contents.write(at, &bytes(&numbers));
        }
    }
}

fn bytes(numbers: &[f32; 16]) -> [u8; MATRIX] {
    let mut all = [0; MATRIX];
    let values = numbers.iter().flat_map(|number| number.to_ne_bytes());
    all.iter_mut().zip(values).for_each(|(to, byte)| *to = byte);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: BufferName = BufferName(1);
    const TWO: BufferName = BufferName(2);

    fn filled(value: f32) -> Vec<u8> {
        [value; 16].iter().flat_map(|v| v.to_ne_bytes()).collect()
    }

    fn buffers() -> UniformBuffers {
        let mut buffers = UniformBuffers::default();
        buffers.follow(ONE);
        buffers.follow(TWO);
        buffers
    }

    #[test]
    fn what_was_not_written_is_unknown() {
        let mut all = buffers();
        assert_eq!(all.matrix(ONE, 0), Found::Unknown);
        all.replaced(ONE, 64, Some(&filled(1.0)));
        assert_eq!(all.matrix(ONE, 0), Found::Matrix([1.0; 16]));
        assert_eq!(all.matrix(ONE, 4), Found::Unknown);
        all.written(ONE, 64, &filled(2.0));
        assert_eq!(all.matrix(ONE, 64), Found::Matrix([2.0; 16]));
        all.forget(ONE, 127..128);
        assert_eq!(all.matrix(ONE, 64), Found::Unknown);
        all.replaced(ONE, 64, None);
        assert_eq!(all.matrix(ONE, 0), Found::Unknown);
        all.read(ONE, 0, &[3.0; 16]);
        assert_eq!(all.matrix(ONE, 0), Found::Matrix([3.0; 16]));
        all.deleted(ONE);
        assert!(!all.follows(ONE));
    }

    #[test]
    fn places_are_noted_where_matrices_are_asked_for() {
        let mut all = buffers();
        all.read(ONE, 0, &[3.0; 16]);
        assert_eq!(all.matrix(ONE, 64), Found::Unknown);
        let wanted = all.contents[&ONE].wanted.iter().copied();
        assert_eq!(wanted.collect::<Vec<_>>(), [64]);
    }

    #[test]
    fn copies_take_what_is_known_and_what_is_not() {
        let mut all = buffers();
        all.replaced(ONE, 64, Some(&filled(1.0)));
        all.replaced(TWO, 64, Some(&filled(2.0)));
        all.copied((ONE, 0), (TWO, 64), 64);
        assert_eq!(all.matrix(TWO, 64), Found::Matrix([1.0; 16]));
        all.copied((BufferName(9), 0), (TWO, 0), 4);
        assert_eq!(all.matrix(TWO, 0), Found::Unknown);
        assert_eq!(all.matrix(TWO, 64), Found::Matrix([1.0; 16]));
    }

    #[test]
    fn what_shaders_may_write_is_forgotten() {
        let mut all = buffers();
        all.replaced(ONE, 64, Some(&filled(1.0)));
        assert!(!all.shaders_wrote());
        all.bound_to_be_written(ONE);
        assert!(all.shaders_wrote());
        assert_eq!(all.matrix(ONE, 0), Found::Unknown);
    }

    #[test]
    fn a_change_is_counted_where_a_buffer_is_followed() {
        let mut all = buffers();
        let before = block_change();
        all.written(ONE, LARGEST - 4, &filled(1.0));
        assert!(block_change() > before);
        assert_eq!(all.matrix(ONE, LARGEST - 4), Found::Unknown);
    }
}
