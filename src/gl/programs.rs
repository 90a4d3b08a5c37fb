//! Programs of shaders: what they were linked from, and the values of their uniforms.

use super::consts as c;
use super::real::Ptr;
use super::{BufferName, Gl, ProgramName, ShaderName, shadow};
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

/// What a uniform's values are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Base {
    Float,
    Double,
    Int,
    Uint,
}

/// Columns and rows of a type of uniforms; one column for what is no matrix.
pub(super) fn shape(kind: u32) -> Option<(Base, u32, u32)> {
    use Base::{Double, Float, Int, Uint};
    Some(match kind {
        c::FLOAT => (Float, 1, 1),
        0x8B50..=0x8B52 => (Float, 1, kind - 0x8B50 + 2),
        c::INT | c::BOOL => (Int, 1, 1),
        0x8B53..=0x8B55 => (Int, 1, kind - 0x8B53 + 2),
        0x8B57..=0x8B59 => (Int, 1, kind - 0x8B57 + 2),
        c::UNSIGNED_INT => (Uint, 1, 1),
        0x8DC6..=0x8DC8 => (Uint, 1, kind - 0x8DC6 + 2),
        0x8B5A..=0x8B5C => (Float, kind - 0x8B5A + 2, kind - 0x8B5A + 2),
        // 2x3 2x4 3x2 3x4 4x2 4x3, columns first.
        0x8B65 => (Float, 2, 3),
        0x8B66 => (Float, 2, 4),
        0x8B67 => (Float, 3, 2),
        0x8B68 => (Float, 3, 4),
        0x8B69 => (Float, 4, 2),
        0x8B6A => (Float, 4, 3),
        c::DOUBLE => (Double, 1, 1),
        0x8FFC..=0x8FFE => (Double, 1, kind - 0x8FFC + 2),
        0x8F46..=0x8F48 => (Double, kind - 0x8F46 + 2, kind - 0x8F46 + 2),
        0x8F49 => (Double, 2, 3),
        0x8F4A => (Double, 2, 4),
        0x8F4B => (Double, 3, 2),
        0x8F4C => (Double, 3, 4),
        0x8F4D => (Double, 4, 2),
        0x8F4E => (Double, 4, 3),
        // Atomic counters have bindings, no values.
        0x92DB => return None,
        // Samplers and images.
        _ => (Int, 1, 1),
    })
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
        let ask = |name| {
            let mut v = 0i32;
            // SAFETY: one integer.
            unsafe {
                self.real.glGetProgramInterfaceiv(
                    program.0,
                    c::PROGRAM_OUTPUT,
                    name,
                    (&raw mut v).cast(),
                )
            };
            v.max(0)
        };
        let (count, longest) = (ask(c::ACTIVE_RESOURCES), ask(c::MAX_NAME_LENGTH));
        let mut buffer = vec![0u8; longest.max(1) as usize];
        let one = |at| {
            let mut got = 0i32;
            // SAFETY: a buffer of the length given, and one integer.
            unsafe {
                self.real.glGetProgramResourceName(
                    program.0,
                    c::PROGRAM_OUTPUT,
                    at,
                    buffer.len() as i32,
                    (&raw mut got).cast(),
                    buffer.as_mut_ptr().cast(),
                )
            };
            CString::new(buffer.get(..got.max(0) as usize)?).ok()
        };
        (0..count as u32).filter_map(one).collect()
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
    ) -> Result<ProgramName, String> {
        self.link_with(shaders, |program| {
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

    /// Gives a uniform of the program in use the value that one of another program has, of the same type; one element.
    pub fn copy_uniform(&self, kind: u32, from: (ProgramName, i32), to: i32) {
        let Some((base, columns, rows)) = shape(kind) else {
            return;
        };
        let (program, at) = from;
        let real = self.real;
        // Room for the largest, a matrix of 4 x 4 doubles.
        let mut v = [0u64; 16];
        let p: Ptr = v.as_mut_ptr().cast();
        match base {
            // SAFETY: at most 16 of 8 bytes.
            Base::Double => unsafe { real.glGetUniformdv(program.0, at, p) },
            _ => {
                let words = shadow::uniform(program.0, at, || {
                    let mut v = [0u32; 16];
                    let p: Ptr = v.as_mut_ptr().cast();
                    // SAFETY: at most 16 of 4 bytes.
                    unsafe {
                        match base {
                            Base::Int => real.glGetUniformiv(program.0, at, p),
                            Base::Uint => real.glGetUniformuiv(program.0, at, p),
                            _ => real.glGetUniformfv(program.0, at, p),
                        }
                    };
                    v
                });
                for (two, pair) in v.iter_mut().zip(words.chunks_exact(2)) {
                    let [a, b] = [pair[0], pair[1]].map(u32::to_ne_bytes);
                    *two = u64::from_ne_bytes([a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]]);
                }
            }
        }
        // SAFETY: the type says how many values are read, at most 16 of 8 bytes.
        unsafe {
            match (base, columns, rows) {
                (Base::Float, 1, 1) => real.glUniform1fv(to, 1, p),
                (Base::Float, 1, 2) => real.glUniform2fv(to, 1, p),
                (Base::Float, 1, 3) => real.glUniform3fv(to, 1, p),
                (Base::Float, 1, 4) => real.glUniform4fv(to, 1, p),
                (Base::Float, 2, 2) => real.glUniformMatrix2fv(to, 1, 0, p),
                (Base::Float, 3, 3) => real.glUniformMatrix3fv(to, 1, 0, p),
                (Base::Float, 4, 4) => real.glUniformMatrix4fv(to, 1, 0, p),
                (Base::Float, 2, 3) => real.glUniformMatrix2x3fv(to, 1, 0, p),
                (Base::Float, 2, 4) => real.glUniformMatrix2x4fv(to, 1, 0, p),
                (Base::Float, 3, 2) => real.glUniformMatrix3x2fv(to, 1, 0, p),
                (Base::Float, 3, 4) => real.glUniformMatrix3x4fv(to, 1, 0, p),
                (Base::Float, 4, 2) => real.glUniformMatrix4x2fv(to, 1, 0, p),
                (Base::Float, 4, 3) => real.glUniformMatrix4x3fv(to, 1, 0, p),
                (Base::Int, _, 1) => real.glUniform1iv(to, 1, p),
                (Base::Int, _, 2) => real.glUniform2iv(to, 1, p),
                (Base::Int, _, 3) => real.glUniform3iv(to, 1, p),
                (Base::Int, _, _) => real.glUniform4iv(to, 1, p),
                (Base::Uint, _, 1) => real.glUniform1uiv(to, 1, p),
                (Base::Uint, _, 2) => real.glUniform2uiv(to, 1, p),
                (Base::Uint, _, 3) => real.glUniform3uiv(to, 1, p),
                (Base::Uint, _, _) => real.glUniform4uiv(to, 1, p),
                (Base::Double, 1, 1) => real.glUniform1dv(to, 1, p),
                (Base::Double, 1, 2) => real.glUniform2dv(to, 1, p),
                (Base::Double, 1, 3) => real.glUniform3dv(to, 1, p),
                (Base::Double, 1, 4) => real.glUniform4dv(to, 1, p),
                (Base::Double, 2, 2) => real.glUniformMatrix2dv(to, 1, 0, p),
                (Base::Double, 3, 3) => real.glUniformMatrix3dv(to, 1, 0, p),
                (Base::Double, 4, 4) => real.glUniformMatrix4dv(to, 1, 0, p),
                (Base::Double, 2, 3) => real.glUniformMatrix2x3dv(to, 1, 0, p),
                (Base::Double, 2, 4) => real.glUniformMatrix2x4dv(to, 1, 0, p),
                (Base::Double, 3, 2) => real.glUniformMatrix3x2dv(to, 1, 0, p),
                (Base::Double, 3, 4) => real.glUniformMatrix3x4dv(to, 1, 0, p),
                (Base::Double, 4, 2) => real.glUniformMatrix4x2dv(to, 1, 0, p),
                (Base::Double, 4, 3) => real.glUniformMatrix4x3dv(to, 1, 0, p),
                _ => {}
            }
        }
    }

    /// The value of a uniform that is one integer, such as the unit of a sampler.
    pub fn uniform_int(&self, program: ProgramName, location: i32) -> i32 {
        let words = shadow::uniform(program.0, location, || {
            let mut v = [0u32; 16];
            // SAFETY: room for the most integers that a location has.
            unsafe {
                self.real
                    .glGetUniformiv(program.0, location, v.as_mut_ptr().cast())
            };
            v
        });
        words[0] as i32
    }

    /// Keeps the values of a uniform that calls set, or of an element of an array that has `left` elements from there on. All elements before
    /// it have to be kept as well.
    pub fn keep_uniform(&self, program: ProgramName, location: i32, kind: u32, left: u32) {
        shadow::keep_uniform(program.0, location, kind, left);
    }

    /// A number that grows with changes of a program's uniforms.
    pub fn uniform_changes(&self, program: ProgramName) -> u64 {
        shadow::uniform_changes(program.0)
    }

    /// Whether a uniform is known not to have changed since [`Gl::uniform_changes`] was this number.
    pub fn is_uniform_unchanged(&self, program: ProgramName, location: i32, since: u64) -> bool {
        shadow::is_uniform_unchanged(program.0, location, since)
    }

    /// glUniformMatrix4fv, column-major.
    pub fn set_uniform_matrix(&self, location: i32, m: &[f32; 16]) {
        // SAFETY: 16 values.
        unsafe {
            self.real
                .glUniformMatrix4fv(location, 1, 0, m.as_ptr() as Ptr)
        };
    }

    /// The value of a uniform of type GL_FLOAT_MAT4, column-major.
    pub fn uniform_matrix(&self, program: ProgramName, location: i32) -> [f32; 16] {
        let words = shadow::uniform(program.0, location, || {
            let mut v = [0u32; 16];
            // SAFETY: 16 values, as its type says.
            unsafe {
                self.real
                    .glGetUniformfv(program.0, location, v.as_mut_ptr().cast())
            };
            v
        });
        words.map(f32::from_bits)
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

    /// The buffer that is bound to a binding point of uniform blocks, and the byte at which the blocks begin.
    pub fn uniform_binding(&self, binding: u32) -> (BufferName, usize) {
        let [buffer] = self.get_integers_indexed::<1>(c::UNIFORM_BUFFER_BINDING, binding);
        let [start] = self.get_integers_indexed::<1>(c::UNIFORM_BUFFER_START, binding);
        (BufferName(buffer.max(0) as u32), start.max(0) as usize)
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
