//! Storage blocks and atomic counters of programs, and the buffers that are bound to them.

use super::consts as c;
use super::real::Ptr;
use super::{BufferName, Gl, ProgramName, shadow};

/// A place at which a buffer is bound for shaders that write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BindingPoint {
    /// GL_SHADER_STORAGE_BUFFER or GL_ATOMIC_COUNTER_BUFFER.
    pub target: u32,
    /// Counted from 0.
    pub index: u32,
}

/// The part of a buffer that is bound at a [`BindingPoint`], in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundRange {
    /// 0 for none.
    pub buffer: BufferName,
    /// The first byte.
    pub start: usize,
    /// None for the whole buffer.
    pub size: Option<usize>,
}

impl BoundRange {
    /// A whole buffer.
    #[must_use]
    pub fn whole(buffer: BufferName) -> Self {
        BoundRange {
            buffer,
            start: 0,
            size: None,
        }
    }

    /// So many bytes of a buffer.
    #[must_use]
    pub fn part(buffer: BufferName, start: usize, size: usize) -> Self {
        BoundRange {
            buffer,
            start,
            size: Some(size),
        }
    }
}

impl Gl {
    /// Whether the context has storage blocks and tells of them.
    pub fn tells_storage_blocks(&self) -> bool {
        let asks = self.has_extension("GL_ARB_program_interface_query")
            && self.has_extension("GL_ARB_shader_storage_buffer_object");
        self.since((4, 3), Some((3, 1))) || asks
    }

    fn resources(&self, program: ProgramName, kind: u32, name: u32) -> u32 {
        let mut v = 0i32;
        // SAFETY: one integer.
        unsafe {
            self.real
                .glGetProgramInterfaceiv(program.0, kind, name, (&raw mut v).cast())
        };
        v.max(0) as u32
    }

    fn resource_binding(&self, program: ProgramName, kind: u32, at: u32) -> u32 {
        let (property, mut v) = (c::BUFFER_BINDING, 0i32);
        // SAFETY: one property is read and one integer is written; the length is not asked for.
        unsafe {
            self.real.glGetProgramResourceiv(
                program.0,
                kind,
                at,
                1,
                (&raw const property) as Ptr,
                1,
                core::ptr::null_mut(),
                (&raw mut v).cast(),
            )
        };
        v.max(0) as u32
    }

    /// The binding points of the resources of a kind that a program has, by index.
    fn resource_bindings(&self, program: ProgramName, kind: u32) -> Vec<u32> {
        let count = self.resources(program, kind, c::ACTIVE_RESOURCES);
        let bindings = (0..count).map(|at| self.resource_binding(program, kind, at));
        bindings.collect()
    }

    /// The names of the resources of a kind that a program has, by index.
    pub(super) fn resource_names(&self, program: ProgramName, kind: u32) -> Vec<Vec<u8>> {
        let longest = self.resources(program, kind, c::MAX_NAME_LENGTH);
        let one = |at| {
            let mut name = vec![0u8; longest.max(1) as usize];
            let mut got = 0i32;
            // SAFETY: a buffer of the length given, and one integer.
            unsafe {
                self.real.glGetProgramResourceName(
                    program.0,
                    kind,
                    at,
                    name.len() as i32,
                    (&raw mut got).cast(),
                    name.as_mut_ptr().cast(),
                )
            };
            name.truncate(got.max(0) as usize);
            name
        };
        let count = self.resources(program, kind, c::ACTIVE_RESOURCES);
        (0..count).map(one).collect()
    }

    /// The names of a program's storage blocks, by index; an array of blocks has one for each element, such as `name[2]`.
    pub fn storage_blocks(&self, program: ProgramName) -> Vec<String> {
        let names = self.resource_names(program, c::SHADER_STORAGE_BLOCK);
        let text = |name: &Vec<u8>| String::from_utf8_lossy(name).into_owned();
        names.iter().map(text).collect()
    }

    /// The binding points of a program's storage blocks, by index.
    pub fn storage_bindings(&self, program: ProgramName) -> Vec<u32> {
        shadow::storage_bindings(program.0, || {
            self.resource_bindings(program, c::SHADER_STORAGE_BLOCK)
        })
    }

    /// The binding points of a program's atomic counters.
    pub fn counter_bindings(&self, program: ProgramName) -> Vec<u32> {
        self.resource_bindings(program, c::ATOMIC_COUNTER_BUFFER)
    }

    /// glShaderStorageBlockBinding
    pub fn storage_block_binding(&self, program: ProgramName, block: u32, binding: u32) {
        // SAFETY: no pointers.
        unsafe {
            self.real
                .glShaderStorageBlockBinding(program.0, block, binding)
        };
    }

    /// What is bound at a binding point.
    pub fn bound_range(&self, point: BindingPoint) -> BoundRange {
        let [binding, start, size] = match point.target {
            c::SHADER_STORAGE_BUFFER => [
                c::SHADER_STORAGE_BUFFER_BINDING,
                c::SHADER_STORAGE_BUFFER_START,
                c::SHADER_STORAGE_BUFFER_SIZE,
            ],
            _ => [
                c::ATOMIC_COUNTER_BUFFER_BINDING,
                c::ATOMIC_COUNTER_BUFFER_START,
                c::ATOMIC_COUNTER_BUFFER_SIZE,
            ],
        };
        let [buffer] = self.get_integers_indexed::<1>(binding, point.index);
        let bytes = |name| {
            let mut v = 0i64;
            // SAFETY: one integer of 64 bits.
            unsafe {
                self.real
                    .glGetInteger64i_v(name, point.index, (&raw mut v).cast())
            };
            usize::try_from(v).unwrap_or(0)
        };
        let size = bytes(size);
        BoundRange {
            buffer: BufferName(buffer.max(0) as u32),
            start: bytes(start),
            size: (size > 0).then_some(size),
        }
    }

    /// glBindBufferRange, or glBindBufferBase of a whole buffer. The buffer is bound at the target as well.
    pub fn bind_range(&self, point: BindingPoint, range: &BoundRange) {
        let BindingPoint { target, index } = point;
        let name = range.buffer.0;
        // SAFETY: no pointers.
        unsafe {
            match range.size {
                Some(size) => {
                    let start = range.start as isize;
                    self.real
                        .glBindBufferRange(target, index, name, start, size as isize);
                }
                None => self.real.glBindBufferBase(target, index, name),
            }
        }
    }

    /// The bytes of the buffer that is bound at a target.
    pub fn buffer_size(&self, target: u32) -> usize {
        let mut v = 0i32;
        // SAFETY: one integer.
        unsafe {
            self.real
                .glGetBufferParameteriv(target, c::BUFFER_SIZE, (&raw mut v).cast())
        };
        v.max(0) as usize
    }

    /// glBufferData without contents, for shaders to write to.
    pub fn buffer_data_for_shaders(&self, target: u32, bytes: usize) {
        let none = core::ptr::null_mut();
        // SAFETY: no data is read.
        unsafe {
            self.real
                .glBufferData(target, bytes as isize, none, c::DYNAMIC_COPY)
        };
    }

    /// glBufferSubData
    pub fn buffer_sub_data(&self, target: u32, at: usize, data: &[u8]) {
        // SAFETY: as many bytes as it says.
        unsafe {
            self.real.glBufferSubData(
                target,
                at as isize,
                data.len() as isize,
                data.as_ptr() as Ptr,
            )
        };
    }

    /// glCopyBufferSubData from a byte of GL_COPY_READ_BUFFER to one of GL_COPY_WRITE_BUFFER.
    pub fn copy_buffer(&self, from: usize, to: usize, bytes: usize) {
        let (read, write) = (c::COPY_READ_BUFFER, c::COPY_WRITE_BUFFER);
        // SAFETY: no pointers.
        unsafe {
            self.real
                .glCopyBufferSubData(read, write, from as isize, to as isize, bytes as isize)
        };
    }

    /// What shaders have stored to images is there for copies of textures.
    pub fn finish_writes_to_textures(&self) {
        // SAFETY: no pointers.
        unsafe { self.real.glMemoryBarrier(c::TEXTURE_UPDATE_BARRIER_BIT) };
    }

    /// What shaders have written is there for copies from and to buffers.
    pub fn finish_writes_to_buffers(&self) {
        // SAFETY: no pointers.
        unsafe { self.real.glMemoryBarrier(c::BUFFER_UPDATE_BARRIER_BIT) };
    }
}
