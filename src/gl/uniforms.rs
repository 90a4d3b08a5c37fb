//! The values of uniforms, of all types, as they are copied from a program to its variants.

use super::consts as c;
use super::real::Ptr;
use super::{Active, Gl, ProgramName, shadow};

/// What a uniform's values are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Base {
    Float,
    Double,
    Int,
    Uint,
    /// 64 bits.
    Long,
    Ulong,
}

/// Columns and rows of a type of uniforms; one column for what is no matrix.
pub(super) fn shape(kind: u32) -> Option<(Base, u32, u32)> {
    use Base::{Double, Float, Int, Long, Uint, Ulong};
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
        // GL_ARB_gpu_shader_int64.
        0x140E => (Long, 1, 1),
        0x8FE9..=0x8FEB => (Long, 1, kind - 0x8FE9 + 2),
        0x140F => (Ulong, 1, 1),
        0x8FF5..=0x8FF7 => (Ulong, 1, kind - 0x8FF5 + 2),
        // Atomic counters have bindings, no values.
        0x92DB => return None,
        // Samplers and images.
        _ => (Int, 1, 1),
    })
}

impl Active {
    /// Whether its type is GL_FLOAT_VEC4.
    pub fn is_vec4(&self) -> bool {
        shape(self.kind) == Some((Base::Float, 1, 4))
    }
}

impl Gl {
    /// glUseProgram, with the subroutines that the program has chosen.
    pub fn use_program(&self, program: ProgramName) {
        // SAFETY: a context is current.
        unsafe { self.real.glUseProgram(program.0) };
        for (stage, indices) in shadow::subroutines_of(program.0) {
            let (count, all) = (indices.len() as i32, indices.as_ptr() as Ptr);
            // SAFETY: so many indices, which the driver has taken for this program before.
            unsafe { self.real.glUniformSubroutinesuiv(stage, count, all) };
        }
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
            // SAFETY: at most 4 of 8 bytes.
            Base::Long => unsafe { real.glGetUniformi64vARB(program.0, at, p) },
            // SAFETY: at most 4 of 8 bytes.
            Base::Ulong => unsafe { real.glGetUniformui64vARB(program.0, at, p) },
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
                (Base::Long, _, 1) => real.glUniform1i64vARB(to, 1, p),
                (Base::Long, _, 2) => real.glUniform2i64vARB(to, 1, p),
                (Base::Long, _, 3) => real.glUniform3i64vARB(to, 1, p),
                (Base::Long, _, _) => real.glUniform4i64vARB(to, 1, p),
                (Base::Ulong, _, 1) => real.glUniform1ui64vARB(to, 1, p),
                (Base::Ulong, _, 2) => real.glUniform2ui64vARB(to, 1, p),
                (Base::Ulong, _, 3) => real.glUniform3ui64vARB(to, 1, p),
                (Base::Ulong, _, _) => real.glUniform4ui64vARB(to, 1, p),
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

    /// The value of a uniform of type GL_FLOAT_VEC4.
    pub fn uniform_vector(&self, program: ProgramName, location: i32) -> [f32; 4] {
        let [x, y, z, w, ..] = self.uniform_matrix(program, location);
        [x, y, z, w]
    }

    /// The value of a uniform of type GL_FLOAT_MAT4, column-major; what has fewer numbers has zeros behind them.
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
}
