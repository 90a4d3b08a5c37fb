//! Buffer objects that pixels are read into.

use super::consts as c;
use super::held::Held;
use super::real::Ptr;
use super::{BufferName, Gl, PixelStore};

/// A sync object of the share group in which it was made: passed when all calls before it are done.
#[derive(Debug)]
pub struct Fence(usize);

/// How depths lie in a buffer, four bytes each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthKind {
    /// 0 to 1.
    Floats,
    /// 0 to `u32::MAX`.
    Integers,
}

impl DepthKind {
    /// The type that glReadPixels has for it.
    pub(super) fn name(self) -> u32 {
        match self {
            Self::Floats => c::FLOAT,
            Self::Integers => c::UNSIGNED_INT,
        }
    }
}

impl Gl {
    /// glFenceSync; none where the context has no sync objects.
    pub fn fence(&self) -> Option<Fence> {
        if !self.since((3, 2), Some((3, 0))) {
            return None;
        }
        // SAFETY: a context is current; the condition and the flags are the only ones there are.
        let sync = unsafe { self.real.glFenceSync(c::SYNC_GPU_COMMANDS_COMPLETE, 0) };
        (!sync.is_null()).then_some(Fence(sync as usize))
    }

    /// Whether a fence of this share group has passed; does not wait.
    pub fn passed(&self, fence: &Fence) -> bool {
        // SAFETY: the sync object is deleted with its `Fence` only.
        let answer = unsafe { self.real.glClientWaitSync(fence.0 as Ptr, 0, 0) };
        [c::ALREADY_SIGNALED, c::CONDITION_SATISFIED].contains(&answer)
    }

    /// glDeleteSync
    pub fn delete_fence(&self, fence: Fence) {
        // SAFETY: as above.
        unsafe { self.real.glDeleteSync(fence.0 as Ptr) };
    }

    /// glBufferData without contents, for pixels to be read into.
    pub fn buffer_data_empty(&self, target: u32, bytes: usize) {
        // SAFETY: a context is current; no data is read.
        unsafe {
            self.real.glBufferData(
                target,
                bytes as isize,
                core::ptr::null_mut(),
                c::STREAM_READ,
            )
        };
    }

    /// glReadPixels of depth into the bound pack buffer, from a byte on, without gaps; says of which kind they are. The driver refuses what does
    /// not fit.
    pub fn read_depth_to_buffer(&self, _: &PixelStore, w: i32, h: i32, at: usize) -> DepthKind {
        let kind = self.depth_kind(DepthKind::Floats);
        if self.get_integer(c::PIXEL_PACK_BUFFER_BINDING) == 0 || !self.reads_depths() {
            return kind;
        }
        // SAFETY: a pack buffer is bound (asked above), so the pointer is an offset into it, which the driver checks.
        unsafe {
            self.real
                .glReadPixels(0, 0, w, h, c::DEPTH_COMPONENT, kind.name(), at as Ptr)
        };
        kind
    }

    /// What [`Gl::read_depth_to_buffer`] has read, 0 to 1.
    pub fn get_buffer_depths(&self, target: u32, at: usize, kind: DepthKind, out: &mut [f32]) {
        self.get_buffer_floats(target, at, out);
        if kind == DepthKind::Integers {
            for depth in out {
                *depth = (f64::from(depth.to_bits()) / f64::from(u32::MAX)) as f32;
            }
        }
    }

    /// The floats of a buffer from a byte on.
    pub fn get_buffer_floats(&self, target: u32, at: usize, out: &mut [f32]) {
        let bytes = core::mem::size_of_val(out);
        // SAFETY: the floats are so many bytes, and any bytes are floats.
        let out = unsafe { core::slice::from_raw_parts_mut(out.as_mut_ptr().cast(), bytes) };
        self.get_buffer_bytes(target, at, out);
    }

    /// glGetBufferSubData, or what OpenGL ES has instead of it.
    fn get_buffer_bytes(&self, target: u32, at: usize, out: &mut [u8]) {
        let bytes = out.len() as isize;
        if self.is_es() {
            // SAFETY: no pointers; what is mapped, or beyond the end of the buffer, gives null and an error.
            let from = unsafe {
                self.real
                    .glMapBufferRange(target, at as isize, bytes, c::MAP_READ_BIT)
            };
            if !from.is_null() {
                // SAFETY: so many bytes are mapped, and they are not ours.
                unsafe {
                    core::ptr::copy_nonoverlapping(from.cast(), out.as_mut_ptr(), out.len());
                    self.real.glUnmapBuffer(target);
                }
            }
            return;
        }
        // SAFETY: room for that many bytes.
        unsafe {
            self.real
                .glGetBufferSubData(target, at as isize, bytes, out.as_mut_ptr().cast())
        };
    }

    /// Reads pixels of the framebuffer that is bound for reading into the pack buffer that is bound: w·h texels of four bytes from x, y on, rows bottom up.
    pub fn read_bgra_to_buffer(&self, _: &PixelStore, [x, y]: [i32; 2], [w, h]: [u32; 2]) {
        if self.get_integer(c::PIXEL_PACK_BUFFER_BINDING) == 0 {
            return;
        }
        let (w, h, null) = (w as i32, h as i32, core::ptr::null_mut());
        // SAFETY: a pack buffer is bound (asked above), so the pointer is an offset into it, which the driver checks.
        unsafe {
            self.real
                .glReadPixels(x, y, w, h, self.bgra(), c::UNSIGNED_BYTE, null)
        };
    }

    /// What [`Gl::read_bgra_to_buffer`] has read: blue, green, red and alpha.
    pub fn get_buffer_bgra(&self, target: u32, out: &mut [u8]) {
        self.get_buffer_bytes(target, 0, out);
        self.swap_to_bgra(out);
    }

    /// glDeleteBuffers of one name.
    pub fn delete_buffer(&self, name: BufferName) {
        // SAFETY: one name.
        unsafe { self.real.glDeleteBuffers(1, (&raw const name) as Ptr) };
        Held::Buffer.count(-1);
    }
}

/// Memory of a buffer that the program has mapped.
#[derive(Debug)]
pub struct Mapping {
    address: usize,
    length: usize,
    /// It stays mapped while the buffer is used (GL_MAP_PERSISTENT_BIT).
    pub stays: bool,
    /// Only what the program flushes is written (GL_MAP_FLUSH_EXPLICIT_BIT).
    pub flushed_by_name: bool,
}

impl Mapping {
    /// Notes a mapping of so many bytes.
    ///
    /// # Safety
    /// The memory stays mapped for as long as the value lives. Where the program may only write, the driver says that reading is undefined;
    /// pages that can be written can be read on all processors that there are drivers for, slowly at worst.
    pub unsafe fn new(address: *const u8, length: usize, access: u32) -> Mapping {
        Mapping {
            address: address as usize,
            length,
            stays: access & c::MAP_PERSISTENT_BIT != 0,
            flushed_by_name: access & c::MAP_FLUSH_EXPLICIT_BIT != 0,
        }
    }

    /// Bytes of it.
    pub fn length(&self) -> usize {
        self.length
    }

    /// The numbers of single precision from the byte `at` on. None where they are not all in the mapping, or not at a multiple of four bytes.
    pub fn numbers(&self, at: usize) -> Option<[f32; 16]> {
        let end = at.checked_add(size_of::<[f32; 16]>())?;
        let from = self.address.checked_add(at)?;
        if end > self.length || !from.is_multiple_of(align_of::<f32>()) {
            return None;
        }
        let numbers = from as *const f32;
        // SAFETY: in the mapping, which is still there (contract). The program may write at the same time, so each number is read once.
        Some(std::array::from_fn(|i| unsafe {
            numbers.add(i).read_volatile()
        }))
    }
}
