//! Buffer objects: what the program writes to uniform buffers, in which its cameras may be.

use crate::context::{current_key, peek, real};
use crate::hooks::{before_uncompiled, uniform};
use crate::shares;
use core::slice::from_raw_parts;
use manyview_core::gl::{BoundRange, BufferName, Mapping, Ptr, buffer_binding, consts as c};
use manyview_core::layer::BufferRef;
use manyview_core::state::{UniformBuffers, binding_changes, store_changes};

/// Runs `change` on the contents of a buffer, if the layer follows them.
fn change(which: BufferRef, change: impl FnOnce(&mut UniformBuffers, BufferName)) {
    peek(|l| l.change_buffer(which, change));
}

/// Bytes that the program gives to the driver; none where it gives none.
///
/// # Safety
/// `data` is null or points to `size` bytes, which nobody writes meanwhile.
unsafe fn bytes<'a>(data: Ptr, size: isize) -> Option<&'a [u8]> {
    let size = usize::try_from(size).ok().filter(|_| !data.is_null())?;
    // SAFETY: forwarded.
    Some(unsafe { from_raw_parts(data.cast::<u8>(), size) })
}

pub(crate) unsafe fn glUniformBlockBinding(
    program: u32,
    uniformBlockIndex: u32,
    uniformBlockBinding: u32,
) {
    uniform();
    // SAFETY: the program's own call.
    unsafe { real().glUniformBlockBinding(program, uniformBlockIndex, uniformBlockBinding) };
    binding_changes();
}

pub(crate) unsafe fn glShaderStorageBlockBinding(
    program: u32,
    storageBlockIndex: u32,
    storageBlockBinding: u32,
) {
    uniform();
    // SAFETY: the program's own call.
    unsafe { real().glShaderStorageBlockBinding(program, storageBlockIndex, storageBlockBinding) };
}

pub(crate) unsafe fn glBindBuffer(target: u32, buffer: u32) {
    before_uncompiled();
    // SAFETY: the program's own call.
    unsafe { real().glBindBuffer(target, buffer) };
    peek(|l| l.binds_buffer(target, BufferName(buffer)));
}

pub(crate) unsafe fn glBindBufferBase(target: u32, index: u32, buffer: u32) {
    // SAFETY: the program's own call.
    unsafe { real().glBindBufferBase(target, index, buffer) };
    let range = BoundRange::whole(BufferName(buffer));
    peek(|l| l.binds_buffer_at(target, index, range, true));
}

pub(crate) unsafe fn glBindBufferRange(
    target: u32,
    index: u32,
    buffer: u32,
    offset: isize,
    size: isize,
) {
    // SAFETY: the program's own call.
    unsafe { real().glBindBufferRange(target, index, buffer, offset, size) };
    let range = part(buffer, offset, size);
    peek(|l| l.binds_buffer_at(target, index, range, true));
}

/// A part of a buffer as the program gives it. One that begins before the buffer, which the driver refuses, has no bytes, as others that it refuses.
fn part(buffer: u32, offset: isize, size: isize) -> BoundRange {
    let start = usize::try_from(offset);
    let size = usize::try_from(size).unwrap_or(0);
    let size = if start.is_ok() { size } else { 0 };
    BoundRange::part(BufferName(buffer), start.unwrap_or(0), size)
}

/// Binding points that every driver has at a target with binding points.
const FEW: u32 = 8;

/// Notes the buffers that several binding points get.
///
/// # Safety
/// The arrays have `count` elements, or are null.
unsafe fn bound_to_many(
    target: u32,
    first: u32,
    count: i32,
    buffers: Ptr,
    [offsets, sizes]: [Ptr; 2],
) {
    for at in 0..usize::try_from(count).unwrap_or(0) {
        // SAFETY: forwarded.
        let (buffer, bytes) = unsafe {
            let buffer =
                (!buffers.is_null()).then(|| buffers.cast::<u32>().add(at).read_unaligned());
            let bytes = [offsets, sizes].map(|bytes: Ptr| {
                (!bytes.is_null()).then(|| bytes.cast::<isize>().add(at).read_unaligned())
            });
            (buffer.unwrap_or(0), bytes)
        };
        let range = match bytes {
            // The driver may refuse the call as a whole.
            _ if first.saturating_add(count.max(0) as u32) > FEW => part(buffer, 0, 0),
            [Some(offset), Some(size)] if buffer != 0 => part(buffer, offset, size),
            _ => BoundRange::whole(BufferName(buffer)),
        };
        peek(|l| l.binds_buffer_at(target, first.saturating_add(at as u32), range, false));
    }
}

pub(crate) unsafe fn glBindBuffersBase(target: u32, first: u32, count: i32, buffers: Ptr) {
    // SAFETY: the program's own call, and its array.
    unsafe {
        real().glBindBuffersBase(target, first, count, buffers);
        bound_to_many(target, first, count, buffers, [core::ptr::null_mut(); 2]);
    }
}

pub(crate) unsafe fn glBindBuffersRange(
    target: u32,
    first: u32,
    count: i32,
    buffers: Ptr,
    offsets: Ptr,
    sizes: Ptr,
) {
    // SAFETY: the program's own call, and its arrays.
    unsafe {
        real().glBindBuffersRange(target, first, count, buffers, offsets, sizes);
        bound_to_many(target, first, count, buffers, [offsets, sizes]);
    }
}

pub(crate) unsafe fn glDeleteBuffers(n: i32, buffers: Ptr) {
    before_uncompiled();
    let count = usize::try_from(n).unwrap_or(0);
    if count > 0 && !buffers.is_null() {
        // SAFETY: the program's array of names.
        let names = unsafe { from_raw_parts(buffers.cast_const().cast::<BufferName>(), count) };
        if peek(|l| l.deletes_buffers(names)).is_none()
            && let Some(key) = current_key()
        {
            names.iter().for_each(|&name| shares::deleted(key, name));
        }
    }
    // SAFETY: the program's own call.
    unsafe { real().glDeleteBuffers(n, buffers) };
}

/// A buffer gets another store, by `call`.
///
/// # Safety
/// As for [`bytes`].
unsafe fn replaced(which: BufferRef, size: isize, data: Ptr, call: impl FnOnce()) {
    // It is unmapped by that. What another context has mapped to stay cannot get another store.
    let which = match peek(|l| l.has_mappings()) {
        Some(true) => found(which),
        _ => which,
    };
    change(which, UniformBuffers::unmapped_by_driver);
    call();
    store_changes();
    // SAFETY: forwarded.
    let data = unsafe { bytes(data, size) };
    let size = usize::try_from(size).unwrap_or(0);
    change(which, |all, name| all.replaced(name, size, data));
}

/// Bytes of a buffer are written, by `call`.
///
/// # Safety
/// As for [`bytes`].
unsafe fn written(which: BufferRef, offset: isize, size: isize, data: Ptr, call: impl FnOnce()) {
    call();
    // SAFETY: forwarded.
    if let (Some(data), Ok(at)) = (unsafe { bytes(data, size) }, usize::try_from(offset)) {
        change(which, |all, name| {
            // The driver has refused what does not fit, and has read none of it.
            if all
                .size(name)
                .is_none_or(|size| at.saturating_add(data.len()) <= size)
            {
                all.written(name, at, data);
            }
        });
    }
}

/// Hooks of a command that names its buffer by a target (first) or a name.
macro_rules! store {
    ($($name:ident($first:ident, $is:path);)*) => {$(
        pub(crate) unsafe fn $name($first: u32, size: isize, data: Ptr, usage: u32) {
            before_uncompiled();
            // SAFETY: the program's own call and its data.
            unsafe { replaced($is($first), size, data, || real().$name($first, size, data, usage)) };
        }
    )*};
}

/// The name of a buffer, as commands give it.
fn named(name: u32) -> BufferRef {
    BufferRef::Named(BufferName(name))
}

/// The target at which a buffer is bound.
fn bound(target: u32) -> BufferRef {
    BufferRef::Bound(target)
}

/// The buffer that the driver has bound at a target.
fn asked(target: u32) -> BufferName {
    let Some(binding) = buffer_binding(target) else {
        return BufferName::ZERO;
    };
    let mut name = 0i32;
    // SAFETY: one integer.
    unsafe { real().glGetIntegerv(binding, (&raw mut name).cast()) };
    BufferName(name as u32)
}

/// The same buffer by its name where the layer does not know which one is bound: for commands that end or make a mapping. What is written at
/// that target otherwise is indices.
fn found(which: BufferRef) -> BufferRef {
    match which {
        BufferRef::Bound(c::ELEMENT_ARRAY_BUFFER) => {
            BufferRef::Named(asked(c::ELEMENT_ARRAY_BUFFER))
        }
        known => known,
    }
}

store! {
    glBufferData(target, bound);
    glNamedBufferData(buffer, named);
    glNamedBufferDataEXT(buffer, named);
    glBufferStorage(target, bound);
    glNamedBufferStorage(buffer, named);
}

/// Hooks of a command that writes the program's bytes to a buffer.
macro_rules! sub_data {
    ($($name:ident($first:ident, $is:path);)*) => {$(
        pub(crate) unsafe fn $name($first: u32, offset: isize, size: isize, data: Ptr) {
            before_uncompiled();
            // SAFETY: the program's own call and its data.
            unsafe { written($is($first), offset, size, data, || real().$name($first, offset, size, data)) };
        }
    )*};
}

sub_data! {
    glBufferSubData(target, bound);
    glNamedBufferSubData(buffer, named);
}

/// Hooks of a command that copies between buffers.
macro_rules! copies {
    ($($name:ident($is:path);)*) => {$(
        pub(crate) unsafe fn $name(from: u32, to: u32, readOffset: isize, writeOffset: isize, size: isize) {
            // SAFETY: the program's own call.
            unsafe { real().$name(from, to, readOffset, writeOffset, size) };
            let [at, to_at, length] = [readOffset, writeOffset, size].map(|n| usize::try_from(n).unwrap_or(0));
            let source = peek(|l| l.buffer_name($is(from))).unwrap_or_default();
            change($is(to), |all, name| all.copied((source, at), (name, to_at), length));
        }
    )*};
}

copies! {
    glCopyBufferSubData(bound);
    glCopyNamedBufferSubData(named);
    glNamedCopyBufferSubDataEXT(named);
}

/// Hooks of a command after which all bytes of a buffer may be anything.
macro_rules! forgets {
    ($($name:ident($first:ident: $is:path $(, $arg:ident: $kind:ty)*);)*) => {$(
        pub(crate) unsafe fn $name($first: u32 $(, $arg: $kind)*) {
            // SAFETY: the program's own call.
            unsafe { real().$name($first $(, $arg)*) };
            change($is($first), UniformBuffers::forget_all);
        }
    )*};
}

forgets! {
    glInvalidateBufferData(buffer: named);
    glInvalidateBufferSubData(buffer: named, offset: isize, length: isize);
    glClearBufferData(target: bound, internalformat: u32, format: u32, kind: u32, data: Ptr);
    glClearNamedBufferData(buffer: named, internalformat: u32, format: u32, kind: u32, data: Ptr);
    glClearNamedBufferDataEXT(buffer: named, internalformat: u32, format: u32, kind: u32, data: Ptr);
    glClearBufferSubData(target: bound, internalformat: u32, offset: isize, size: isize, format: u32, kind: u32, data: Ptr);
    glClearNamedBufferSubData(buffer: named, internalformat: u32, offset: isize, size: isize, format: u32, kind: u32, data: Ptr);
    glClearNamedBufferSubDataEXT(buffer: named, internalformat: u32, offset: isize, size: isize, format: u32, kind: u32, data: Ptr);
}

/// The program has mapped bytes of a buffer, from `offset` on; without a length, all of it.
fn mapped(which: BufferRef, offset: isize, length: Option<isize>, access: u32, memory: Ptr) {
    let (Ok(at), false) = (usize::try_from(offset), memory.is_null()) else {
        return;
    };
    if access & c::MAP_WRITE_BIT == 0 {
        return;
    }
    let length = length.and_then(|length| usize::try_from(length).ok());
    let which = found(which);
    peek(|l| {
        l.maps_buffer(which, at, length, |length| {
            // SAFETY: the driver has just mapped so many bytes. The hooks of all commands that unmap them take the mapping away first, in
            // contexts without a layer by `unmapped_unseen`.
            unsafe { Mapping::new(memory.cast_const().cast(), length, access) }
        });
    });
}

/// The driver is about to unmap a buffer for a context without a layer.
#[cold]
fn unmapped_unseen(which: BufferRef) {
    let name = match which {
        BufferRef::Named(name) => name,
        BufferRef::Bound(target) => asked(target),
    };
    if let Some(key) = current_key() {
        shares::unmapped(key, name);
    }
}

/// Takes the mapping of a buffer away, with what was written to it, before the driver unmaps it.
fn unmaps(which: BufferRef) {
    let which = found(which);
    if peek(|l| l.change_buffer(which, UniformBuffers::unmapped)).is_none() {
        unmapped_unseen(which);
    }
}

/// Hooks of a command that maps a whole buffer.
macro_rules! maps {
    ($($name:ident($first:ident: $is:path);)*) => {$(
        pub(crate) unsafe fn $name($first: u32, access: u32) -> Ptr {
            // SAFETY: the program's own call.
            let memory = unsafe { real().$name($first, access) };
            let access = if access == c::READ_ONLY { 0 } else { c::MAP_WRITE_BIT };
            mapped($is($first), 0, None, access, memory);
            memory
        }
    )*};
}

maps! {
    glMapBuffer(target: bound);
    glMapNamedBuffer(buffer: named);
    glMapNamedBufferEXT(buffer: named);
}

/// Hooks of a command that maps a part of a buffer.
macro_rules! maps_range {
    ($($name:ident($first:ident: $is:path);)*) => {$(
        pub(crate) unsafe fn $name($first: u32, offset: isize, length: isize, access: u32) -> Ptr {
            // SAFETY: the program's own call.
            let memory = unsafe { real().$name($first, offset, length, access) };
            mapped($is($first), offset, Some(length), access, memory);
            memory
        }
    )*};
}

maps_range! {
    glMapBufferRange(target: bound);
    glMapNamedBufferRange(buffer: named);
    glMapNamedBufferRangeEXT(buffer: named);
}

/// Hooks of a command that flushes a part of a mapping.
macro_rules! flushes {
    ($($name:ident($first:ident: $is:path);)*) => {$(
        pub(crate) unsafe fn $name($first: u32, offset: isize, length: isize) {
            // SAFETY: the program's own call.
            unsafe { real().$name($first, offset, length) };
            if let (Ok(at), Ok(length)) = (usize::try_from(offset), usize::try_from(length)) {
                change(found($is($first)), |all, name| all.flushed(name, at, length));
            }
        }
    )*};
}

flushes! {
    glFlushMappedBufferRange(target: bound);
    glFlushMappedNamedBufferRange(buffer: named);
    glFlushMappedNamedBufferRangeEXT(buffer: named);
}

/// Hooks of a command that unmaps a buffer.
macro_rules! unmaps {
    ($($name:ident($first:ident: $is:path);)*) => {$(
        pub(crate) unsafe fn $name($first: u32) -> u8 {
            unmaps($is($first));
            // SAFETY: the program's own call.
            unsafe { real().$name($first) }
        }
    )*};
}

unmaps! {
    glUnmapBuffer(target: bound);
    glUnmapNamedBuffer(buffer: named);
    glUnmapNamedBufferEXT(buffer: named);
}

/// Hooks of a command before which shaders may have written to buffers.
macro_rules! barrier {
    ($($name:ident),*) => {$(
        pub(crate) unsafe fn $name(barriers: u32) {
            // SAFETY: the program's own call.
            unsafe { real().$name(barriers) };
            peek(|l| l.shaders_wrote());
        }
    )*};
}

barrier!(glMemoryBarrier, glMemoryBarrierByRegion);
