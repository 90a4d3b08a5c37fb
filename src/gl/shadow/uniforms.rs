//! The values of uniforms, of the programs of a share group.
#![allow(non_snake_case, reason = "each is the GL command of its name")]

use super::Shadow;
use super::change::Change;
use super::key::Key;
use crate::gl::consts as c;
use crate::gl::real::Ptr;
use crate::gl::uniforms::{Base, shape};
use core::sync::atomic::{AtomicU64, Ordering::Relaxed};
use rustc_hash::FxHashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Changes by contexts that have no shadow, such as that of a thread which loads: of which programs, nobody tells.
static UNSEEN: AtomicU64 = AtomicU64::new(0);

/// A uniform, or an element of one that is an array. All elements before it are kept as well.
#[derive(Debug)]
struct Uniform {
    /// Such as GL_FLOAT_VEC4.
    kind: u32,
    /// Elements of its array from this one on.
    left: u32,
    /// Up to 16 numbers by their bits; none where the driver has to be asked.
    value: Option<[u32; 16]>,
    /// [`Program::changes`] at the last change.
    changed: u64,
}

#[derive(Debug, Default)]
struct Program {
    uniforms: FxHashMap<i32, Uniform>,
    changes: u64,
    /// Binding points of its blocks of each kind, by index.
    blocks: [Option<Vec<u32>>; 2],
}

/// A kind of blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BlockKind {
    Uniform,
    Storage,
}

#[derive(Debug, Default)]
struct Values {
    programs: FxHashMap<u32, Program>,
    /// [`UNSEEN`] when it was last compared.
    unseen: u64,
}

/// The values of a share group.
#[derive(Clone, Debug, Default)]
pub(super) struct UniformValues(Arc<Mutex<Values>>);

/// A context without a shadow may have set uniforms.
pub(super) fn unseen() {
    UNSEEN.fetch_add(1, Relaxed);
}

impl Program {
    fn forget(&mut self) {
        self.changes += 1;
        self.blocks = [None, None];
        for uniform in self.uniforms.values_mut() {
            uniform.value = None;
            uniform.changed = self.changes;
        }
    }
}

impl UniformValues {
    fn all(&self) -> MutexGuard<'_, Values> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let unseen = UNSEEN.load(Relaxed);
        if std::mem::replace(&mut all.unseen, unseen) != unseen {
            all.programs.values_mut().for_each(Program::forget);
        }
        all
    }

    pub(super) fn forget_all(&self) {
        self.all().programs.values_mut().for_each(Program::forget);
    }

    pub(super) fn forget(&self, program: u32) {
        let mut all = self.all();
        let program = all.programs.get_mut(&program);
        program.into_iter().for_each(Program::forget);
    }

    /// A program gets another executable, or is deleted.
    pub(super) fn relinked(&self, program: u32) {
        self.all().programs.remove(&program);
    }

    /// Keeps a uniform from now on.
    pub(super) fn keep(&self, program: u32, location: i32, kind: u32, left: u32) {
        let mut all = self.all();
        let program = all.programs.entry(program).or_default();
        let changed = program.changes;
        program.uniforms.entry(location).or_insert(Uniform {
            kind,
            left,
            value: None,
            changed,
        });
    }

    pub(super) fn value(&self, program: u32, location: i32) -> Option<[u32; 16]> {
        let all = self.all();
        all.programs.get(&program)?.uniforms.get(&location)?.value
    }

    pub(super) fn answered(&self, program: u32, location: i32, value: [u32; 16]) {
        let mut all = self.all();
        let program = all.programs.get_mut(&program);
        if let Some(uniform) = program.and_then(|p| p.uniforms.get_mut(&location)) {
            uniform.value = Some(value);
        }
    }

    /// The number of changes of a program, and whether a uniform is known not to have changed since such a number.
    pub(super) fn changes(&self, program: u32) -> u64 {
        let all = self.all();
        all.programs.get(&program).map_or(0, |p| p.changes)
    }

    pub(super) fn is_unchanged(&self, program: u32, location: i32, since: u64) -> bool {
        let all = self.all();
        let program = all.programs.get(&program);
        let uniform = program.and_then(|p| p.uniforms.get(&location));
        uniform.is_some_and(|uniform| uniform.changed <= since)
    }

    pub(super) fn blocks(&self, program: u32, kind: BlockKind) -> Option<Vec<u32>> {
        self.all().programs.get(&program)?.blocks[kind as usize].clone()
    }

    pub(super) fn blocks_are(&self, program: u32, kind: BlockKind, bindings: Vec<u32>) {
        let mut all = self.all();
        all.programs.entry(program).or_default().blocks[kind as usize] = Some(bindings);
    }

    /// glUniformBlockBinding and glShaderStorageBlockBinding.
    fn block_is_bound(&self, program: u32, kind: BlockKind, block: u32, binding: u32) {
        let mut all = self.all();
        let Some(program) = all.programs.get_mut(&program) else {
            return;
        };
        // There are at least so many binding points.
        let points = match kind {
            BlockKind::Uniform => 36,
            BlockKind::Storage => 8,
        };
        let blocks = &mut program.blocks[kind as usize];
        let bound = blocks.as_mut().and_then(|all| all.get_mut(block as usize));
        match bound {
            Some(bound) if binding < points => *bound = binding,
            _ => *blocks = None,
        }
    }
}

/// The values that a command gives to a uniform.
pub(super) struct Given {
    base: Base,
    columns: u32,
    rows: u32,
    /// Elements of an array.
    count: usize,
    /// Rows lie behind each other.
    transposed: bool,
}

impl Shadow {
    /// glUniform and glProgramUniform. `program` is none for that in use.
    ///
    /// # Safety
    /// `values` has as many elements as the driver reads: up to the end of the array of that uniform, if that has as many.
    unsafe fn uniform(&mut self, program: Option<u32>, location: i32, given: &Given, values: Ptr) {
        if self.compiling.is_some() {
            return self.change(Change::ForgetUniforms);
        }
        let Some(program) = program.or_else(|| self.program_in_use()) else {
            return;
        };
        if self.inside {
            return self.uniforms.forget(program);
        }
        let units = self.constant(c::MAX_COMBINED_TEXTURE_IMAGE_UNITS);
        let mut all = self.uniforms.all();
        let Some(program) = all.programs.get_mut(&program) else {
            return;
        };
        let Some(left) = program.uniforms.get(&location).map(|u| u.left as usize) else {
            return;
        };
        program.changes += 1;
        let size = (given.columns * given.rows) as usize;
        let elements = given.count.min(left);
        for (at, element) in (location..).zip(0..elements) {
            let mut words = [0u32; 16];
            if let (Some(words), false) = (words.get_mut(..size), values.is_null()) {
                // SAFETY: an element that the driver has read (contract).
                unsafe {
                    let from = values.cast::<u8>().add(element * size * 4);
                    from.copy_to_nonoverlapping(words.as_mut_ptr().cast(), size * 4);
                };
            }
            if let Some(uniform) = program.uniforms.get_mut(&at) {
                uniform.value = given.value(uniform.kind, &words, units);
                uniform.changed = program.changes;
            }
        }
    }

    /// The program whose uniforms glUniform sets, as far as that is known.
    fn program_in_use(&mut self) -> Option<u32> {
        let key = Key::Value(c::CURRENT_PROGRAM);
        let program = self.values.known(key).map_or_else(
            || {
                let program = self.integer(c::CURRENT_PROGRAM);
                self.answered(key, [program, 0, 0, 0]);
                program
            },
            |[program, ..]| program,
        );
        if program == 0 {
            // It may be one of a pipeline.
            self.uniforms.forget_all();
        }
        (program != 0).then_some(program)
    }

    /// A command sets uniforms in a way that is not followed.
    pub(in crate::gl) unsafe fn uniforms(&mut self) {
        self.change(Change::ForgetUniforms);
    }

    pub(in crate::gl) unsafe fn glUniformBlockBinding(
        &mut self,
        program: u32,
        block: u32,
        binding: u32,
    ) {
        let kind = BlockKind::Uniform;
        self.uniforms.block_is_bound(program, kind, block, binding);
    }

    pub(in crate::gl) unsafe fn glShaderStorageBlockBinding(
        &mut self,
        program: u32,
        block: u32,
        binding: u32,
    ) {
        let kind = BlockKind::Storage;
        self.uniforms.block_is_bound(program, kind, block, binding);
    }
}

impl Given {
    /// What a uniform of a type has after the command; none where the driver has to be asked.
    fn value(&self, kind: u32, words: &[u32; 16], units: u32) -> Option<[u32; 16]> {
        let (base, columns, rows) = shape(kind)?;
        if (base, columns, rows) != (self.base, self.columns, self.rows) {
            return None;
        }
        let mut value = *words;
        if self.transposed {
            let (columns, rows) = (columns as usize, rows as usize);
            for at in 0..columns * rows {
                value[at] = words[at % rows * columns + at / rows];
            }
        }
        let plain = matches!(kind, c::INT | 0x8B53..=0x8B55);
        match base {
            // Drivers have their own words for truth.
            _ if kind == c::BOOL || (0x8B57..=0x8B59).contains(&kind) => None,
            // A driver refuses units that it does not have, and images and others have fewer.
            Base::Int if !plain && value[0] >= units.min(8) => None,
            _ => Some(value),
        }
    }
}

macro_rules! numbers {
    ($($name:ident $program:ident $base:ident $kind:ty: $($v:ident)*;)*) => {$(
        pub(in crate::gl) unsafe fn $name(&mut self, location: i32, $($v: $kind),*) {
            let words = [$(u32::from_ne_bytes($v.to_ne_bytes())),*];
            let given = Given { base: Base::$base, columns: 1, rows: words.len() as u32, count: 1, transposed: false };
            // SAFETY: all that it has.
            unsafe { self.uniform(None, location, &given, words.as_ptr() as Ptr) };
        }

        pub(in crate::gl) unsafe fn $program(&mut self, program: u32, location: i32, $($v: $kind),*) {
            let words = [$(u32::from_ne_bytes($v.to_ne_bytes())),*];
            let given = Given { base: Base::$base, columns: 1, rows: words.len() as u32, count: 1, transposed: false };
            // SAFETY: all that it has.
            unsafe { self.uniform(Some(program), location, &given, words.as_ptr() as Ptr) };
        }
    )*};
}

macro_rules! vectors {
    ($($name:ident $program:ident $base:ident $rows:literal;)*) => {$(
        pub(in crate::gl) unsafe fn $name(&mut self, location: i32, count: i32, value: Ptr) {
            let given = Given { base: Base::$base, columns: 1, rows: $rows, count: count.max(0) as usize, transposed: false };
            // SAFETY: forwarded.
            unsafe { self.uniform(None, location, &given, value) };
        }

        pub(in crate::gl) unsafe fn $program(&mut self, program: u32, location: i32, count: i32, value: Ptr) {
            let given = Given { base: Base::$base, columns: 1, rows: $rows, count: count.max(0) as usize, transposed: false };
            // SAFETY: forwarded.
            unsafe { self.uniform(Some(program), location, &given, value) };
        }
    )*};
}

macro_rules! matrices {
    ($($name:ident $program:ident $columns:literal $rows:literal;)*) => {$(
        pub(in crate::gl) unsafe fn $name(&mut self, location: i32, count: i32, transpose: u8, value: Ptr) {
            let given = Given { base: Base::Float, columns: $columns, rows: $rows, count: count.max(0) as usize, transposed: transpose != 0 };
            // SAFETY: forwarded.
            unsafe { self.uniform(None, location, &given, value) };
        }

        pub(in crate::gl) unsafe fn $program(&mut self, program: u32, location: i32, count: i32, transpose: u8, value: Ptr) {
            let given = Given { base: Base::Float, columns: $columns, rows: $rows, count: count.max(0) as usize, transposed: transpose != 0 };
            // SAFETY: forwarded.
            unsafe { self.uniform(Some(program), location, &given, value) };
        }
    )*};
}

#[allow(clippy::too_many_arguments, reason = "the commands' own")]
impl Shadow {
    numbers! {
        glUniform1f glProgramUniform1f Float f32: x;
        glUniform2f glProgramUniform2f Float f32: x y;
        glUniform3f glProgramUniform3f Float f32: x y z;
        glUniform4f glProgramUniform4f Float f32: x y z w;
        glUniform1i glProgramUniform1i Int i32: x;
        glUniform2i glProgramUniform2i Int i32: x y;
        glUniform3i glProgramUniform3i Int i32: x y z;
        glUniform4i glProgramUniform4i Int i32: x y z w;
        glUniform1ui glProgramUniform1ui Uint u32: x;
        glUniform2ui glProgramUniform2ui Uint u32: x y;
        glUniform3ui glProgramUniform3ui Uint u32: x y z;
        glUniform4ui glProgramUniform4ui Uint u32: x y z w;
    }

    vectors! {
        glUniform1fv glProgramUniform1fv Float 1;
        glUniform2fv glProgramUniform2fv Float 2;
        glUniform3fv glProgramUniform3fv Float 3;
        glUniform4fv glProgramUniform4fv Float 4;
        glUniform1iv glProgramUniform1iv Int 1;
        glUniform2iv glProgramUniform2iv Int 2;
        glUniform3iv glProgramUniform3iv Int 3;
        glUniform4iv glProgramUniform4iv Int 4;
        glUniform1uiv glProgramUniform1uiv Uint 1;
        glUniform2uiv glProgramUniform2uiv Uint 2;
        glUniform3uiv glProgramUniform3uiv Uint 3;
        glUniform4uiv glProgramUniform4uiv Uint 4;
    }

    matrices! {
        glUniformMatrix2fv glProgramUniformMatrix2fv 2 2;
        glUniformMatrix3fv glProgramUniformMatrix3fv 3 3;
        glUniformMatrix4fv glProgramUniformMatrix4fv 4 4;
        glUniformMatrix2x3fv glProgramUniformMatrix2x3fv 2 3;
        glUniformMatrix2x4fv glProgramUniformMatrix2x4fv 2 4;
        glUniformMatrix3x2fv glProgramUniformMatrix3x2fv 3 2;
        glUniformMatrix3x4fv glProgramUniformMatrix3x4fv 3 4;
        glUniformMatrix4x2fv glProgramUniformMatrix4x2fv 4 2;
        glUniformMatrix4x3fv glProgramUniformMatrix4x3fv 4 3;
    }
}
