//! Programs of shaders: what they were linked from, and the values of their uniforms.

use super::consts as c;
use super::real::Ptr;
use super::{BoundRange, BufferName, Gl, ProgramName, ShaderName, shadow};
use std::ffi::{CStr, CString};

/// An active uniform or attribute.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Active {
    /// As the driver has it: arrays end in `[0]`.
    pub name: CString,
    /// Such as GL_FLOAT_VEC4.
    pub kind: u32,
    /// Elements of an array, else 1.
    pub size: i32,
}

impl Active {
    /// The name of each element.
    pub fn elements(&self) -> impl Iterator<Item = CString> {
        let text = self.name.to_string_lossy();
        let stem = text.strip_suffix("[0]").unwrap_or(&text).to_owned();
        (0..self.size.max(1)).map(move |at| match self.size {
            ..=1 => self.name.clone(),
            _ => CString::new(format!("{stem}[{at}]")).unwrap_or_default(),
        })
    }
}

/// Where a uniform matrix of a block lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlockPlace {
    /// Index of the block in its program.
    pub block: u32,
    /// Bytes from the beginning of the block.
    pub offset: usize,
    /// Its rows lie behind each other, rather than its columns.
    pub row_major: bool,
}

impl BlockPlace {
    /// A column-major matrix as it lies in the block, or the other way round.
    pub fn laid_out(&self, m: [f32; 16]) -> [f32; 16] {
        match self.row_major {
            true => std::array::from_fn(|i| m[i % 4 * 4 + i / 4]),
            false => m,
        }
    }
}

impl Gl {
    /// glGetProgramiv
    pub fn program_parameter(&self, program: ProgramName, name: u32) -> i32 {
        let mut v = [0i32; 4];
        // SAFETY: no name asked for here gives more than three integers.
        unsafe {
            self.real
                .glGetProgramiv(program.0, name, v.as_mut_ptr().cast())
        };
        v[0]
    }

    /// glGetShaderiv
    pub fn shader_parameter(&self, shader: ShaderName, name: u32) -> i32 {
        let mut v = 0i32;
        // SAFETY: one integer.
        unsafe { self.real.glGetShaderiv(shader.0, name, (&raw mut v).cast()) };
        v
    }

    /// The shader objects of a program.
    pub fn attached_shaders(&self, program: ProgramName) -> Vec<ShaderName> {
        let count = self.program_parameter(program, c::ATTACHED_SHADERS);
        let mut names = vec![0u32; count.max(0) as usize];
        let mut got = 0i32;
        // SAFETY: room for as many names as there are.
        unsafe {
            self.real.glGetAttachedShaders(
                program.0,
                count.max(0),
                (&raw mut got).cast(),
                names.as_mut_ptr().cast(),
            )
        };
        names.truncate(got.max(0) as usize);
        names.into_iter().map(ShaderName).collect()
    }

    /// The text of a shader, empty where it has none.
    pub fn shader_source(&self, shader: ShaderName) -> Vec<u8> {
        let length = self
            .shader_parameter(shader, c::SHADER_SOURCE_LENGTH)
            .max(0);
        let mut text = vec![0u8; length as usize];
        let mut got = 0i32;
        // SAFETY: a buffer of the length given.
        unsafe {
            self.real.glGetShaderSource(
                shader.0,
                length,
                (&raw mut got).cast(),
                text.as_mut_ptr().cast(),
            )
        };
        text.truncate(got.max(0) as usize);
        text
    }

    /// The active uniforms of a program, those in blocks among them.
    pub fn active_uniforms(&self, program: ProgramName) -> Vec<Active> {
        let longest = self.program_parameter(program, c::ACTIVE_UNIFORM_MAX_LENGTH);
        let count = self.program_parameter(program, c::ACTIVE_UNIFORMS);
        let ask = |at, length, got: Ptr, size: Ptr, kind: Ptr, name: Ptr| {
            // SAFETY: `actives` gives room for a name of that length, and for one of each of the others.
            unsafe {
                self.real
                    .glGetActiveUniform(program.0, at, length, got, size, kind, name)
            }
        };
        actives(count, longest, &ask)
    }

    /// Whether an attribute that is enabled advances by instances.
    pub fn has_divisors(&self) -> bool {
        let all = self.get_integer(c::MAX_VERTEX_ATTRIBS).clamp(1, 32) as u32;
        let array = self.get_integer(c::VERTEX_ARRAY_BINDING) as u32;
        let bits = |name| {
            shadow::attributes(name, array, || {
                let on = (0..all).filter(|&at| self.vertex_attribute(at, name) != 0);
                on.fold(0, |bits, at| bits | 1 << at)
            })
        };
        let divided = bits(c::VERTEX_ATTRIB_ARRAY_DIVISOR);
        divided != 0 && divided & bits(c::VERTEX_ATTRIB_ARRAY_ENABLED) != 0
    }

    /// glGetVertexAttribiv of one value.
    fn vertex_attribute(&self, at: u32, name: u32) -> i32 {
        let mut v = [0i32; 4];
        // SAFETY: room for one value.
        unsafe {
            self.real
                .glGetVertexAttribiv(at, name, v.as_mut_ptr().cast())
        };
        v[0]
    }

    /// The active attributes of a program.
    pub fn active_attributes(&self, program: ProgramName) -> Vec<Active> {
        let longest = self.program_parameter(program, c::ACTIVE_ATTRIBUTE_MAX_LENGTH);
        let count = self.program_parameter(program, c::ACTIVE_ATTRIBUTES);
        let ask = |at, length, got: Ptr, size: Ptr, kind: Ptr, name: Ptr| {
            // SAFETY: as above.
            unsafe {
                self.real
                    .glGetActiveAttrib(program.0, at, length, got, size, kind, name)
            }
        };
        actives(count, longest, &ask)
    }

    /// glGetAttribLocation
    pub fn attribute_location(&self, program: ProgramName, name: &CStr) -> i32 {
        // SAFETY: a string that ends in NUL.
        unsafe {
            self.real
                .glGetAttribLocation(program.0, name.as_ptr() as Ptr)
        }
    }

    /// glGetFragDataLocation
    pub fn output_location(&self, program: ProgramName, name: &CStr) -> i32 {
        // SAFETY: a string that ends in NUL.
        unsafe {
            self.real
                .glGetFragDataLocation(program.0, name.as_ptr() as Ptr)
        }
    }

    /// Whether the context can tell what a program's fragment shader writes. The texts of OpenGL ES say where, if there is more than one.
    pub fn tells_outputs(&self) -> bool {
        let asks = self.since((4, 3), None) || self.has_extension("GL_ARB_program_interface_query");
        asks && !self.is_es()
    }

    /// The names of what a program's fragment shader writes; empty where the context cannot tell.
    pub fn program_outputs(&self, program: ProgramName) -> Vec<CString> {
        if !self.tells_outputs() {
            return Vec::new();
        }
        let names = self.resource_names(program, c::PROGRAM_OUTPUT).into_iter();
        names.filter_map(|name| CString::new(name).ok()).collect()
    }

    /// glUniformBlockBinding
    pub fn uniform_block_binding(&self, program: ProgramName, block: u32, binding: u32) {
        // SAFETY: a context is current.
        unsafe { self.real.glUniformBlockBinding(program.0, block, binding) }
    }

    /// A program of compiled shaders with attributes and fragment outputs at these places, linked; the log on failure. The shaders are
    /// released either way.
    pub fn link_at(
        &self,
        shaders: &[ShaderName],
        attributes: &[(CString, u32)],
        outputs: &[(CString, u32)],
        written: Option<&CStr>,
    ) -> Result<ProgramName, String> {
        self.link_with(shaders, |program| {
            if let Some(output) = written {
                self.write_output(program, output);
            }
            for (name, at) in attributes {
                // SAFETY: a string that ends in NUL.
                unsafe {
                    self.real
                        .glBindAttribLocation(program.0, *at, name.as_ptr() as Ptr)
                };
            }
            for (name, at) in outputs {
                // SAFETY: as above.
                unsafe {
                    self.real
                        .glBindFragDataLocation(program.0, *at, name.as_ptr() as Ptr)
                };
            }
        })
    }

    /// Where an active uniform matrix lies that is in a block. None for others.
    pub fn place_in_block(&self, program: ProgramName, at: u32) -> Option<BlockPlace> {
        let ask = |name| {
            let mut v = 0i32;
            // SAFETY: one index, one integer.
            unsafe {
                self.real.glGetActiveUniformsiv(
                    program.0,
                    1,
                    (&raw const at) as Ptr,
                    name,
                    (&raw mut v).cast(),
                )
            };
            v
        };
        Some(BlockPlace {
            block: u32::try_from(ask(c::UNIFORM_BLOCK_INDEX)).ok()?,
            offset: usize::try_from(ask(c::UNIFORM_OFFSET)).ok()?,
            row_major: ask(c::UNIFORM_IS_ROW_MAJOR) != 0,
        })
    }

    /// What is bound to a binding point of uniform blocks.
    pub fn uniform_binding(&self, binding: u32) -> BoundRange {
        let ask = |name| self.get_integers_indexed::<1>(name, binding)[0].max(0);
        let size = ask(c::UNIFORM_BUFFER_SIZE) as usize;
        BoundRange {
            buffer: BufferName(ask(c::UNIFORM_BUFFER_BINDING) as u32),
            start: ask(c::UNIFORM_BUFFER_START) as usize,
            size: (size > 0).then_some(size),
        }
    }

    /// 16 numbers of single precision in a buffer, from a byte on. Waits for the driver, and may raise an error.
    pub fn buffer_matrix(&self, buffer: BufferName, at: usize) -> [f32; 16] {
        let before = BufferName(self.get_integer(c::COPY_READ_BUFFER) as u32);
        self.bind_buffer(c::COPY_READ_BUFFER, buffer);
        let mut v = [0f32; 16];
        self.get_buffer_floats(c::COPY_READ_BUFFER, at, &mut v);
        self.bind_buffer(c::COPY_READ_BUFFER, before);
        v
    }

    /// The binding points of a program's uniform blocks, by index.
    pub fn block_bindings(&self, program: ProgramName) -> Vec<u32> {
        shadow::block_bindings(program.0, || {
            let count = self
                .program_parameter(program, c::ACTIVE_UNIFORM_BLOCKS)
                .max(0) as u32;
            let binding = |at| {
                let mut v = 0i32;
                // SAFETY: one integer.
                unsafe {
                    self.real.glGetActiveUniformBlockiv(
                        program.0,
                        at,
                        c::UNIFORM_BLOCK_BINDING,
                        (&raw mut v).cast(),
                    )
                };
                v as u32
            };
            (0..count).map(binding).collect()
        })
    }

    /// The index of a block of another program in this one.
    pub fn same_block(&self, from: ProgramName, at: u32, to: ProgramName) -> Option<u32> {
        let mut name = [0u8; 1024];
        let mut got = 0i32;
        // SAFETY: a buffer of the length given, which the driver ends with a NUL; it is read as a string that does.
        let index = unsafe {
            self.real.glGetActiveUniformBlockName(
                from.0,
                at,
                name.len() as i32,
                (&raw mut got).cast(),
                name.as_mut_ptr().cast(),
            );
            self.real.glGetUniformBlockIndex(to.0, name.as_ptr() as Ptr)
        };
        (index != u32::MAX).then_some(index)
    }
}

/// What glGetActiveUniform and glGetActiveAttrib tell. `ask` takes index and length of the buffer, then pointers to the length of the
/// name, the size, the type and the name.
fn actives(count: i32, longest: i32, ask: &dyn Fn(u32, i32, Ptr, Ptr, Ptr, Ptr)) -> Vec<Active> {
    let mut buffer = vec![0u8; longest.max(1) as usize];
    let one = |at| {
        let (mut got, mut size, mut kind) = (0i32, 0i32, 0u32);
        ask(
            at,
            buffer.len() as i32,
            (&raw mut got).cast(),
            (&raw mut size).cast(),
            (&raw mut kind).cast(),
            buffer.as_mut_ptr().cast(),
        );
        let name = buffer.get(..got.max(0) as usize)?;
        let name = CString::new(name).ok()?;
        Some(Active { name, kind, size })
    };
    (0..count.max(0) as u32).filter_map(one).collect()
}
