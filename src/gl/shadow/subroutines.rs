//! The subroutines of the program in use. They belong to the context, and glUseProgram forgets them.
#![allow(non_snake_case, reason = "each is the GL command of its name")]

use super::key::Key;
use super::{Shadow, with};
use crate::gl::consts as c;
use crate::gl::real::Ptr;

/// The subroutines that were chosen for a program: by stage, an index for each of its subroutine uniforms.
#[derive(Clone, Debug, Default)]
pub(super) struct Subroutines {
    program: u32,
    chosen: Vec<(u32, Vec<u32>)>,
    /// By stage: how many uniforms and subroutines it has.
    numbers: Vec<(u32, [u32; 2])>,
}

/// The program uses a program, which forgets the subroutines that were chosen.
pub fn forget_subroutines() {
    with(|s| s.subroutines = Subroutines::default());
}

/// The subroutines that the program has chosen for a program, by stage, where it has chosen any since it has used that.
pub(in crate::gl) fn subroutines_of(program: u32) -> Vec<(u32, Vec<u32>)> {
    let known = with(|s| match s.subroutines.program == program {
        true => s.subroutines.chosen.clone(),
        false => Vec::new(),
    });
    known.unwrap_or_default()
}

impl Subroutines {
    /// A stage of a program has so many uniforms and subroutines.
    #[cfg(test)]
    pub(super) fn has(&mut self, program: u32, stage: u32, numbers: [u32; 2]) {
        *self = Subroutines {
            program,
            chosen: Vec::new(),
            numbers: vec![(stage, numbers)],
        };
    }

    /// A program gets another executable.
    pub(super) fn relinked(&mut self, program: u32) {
        if self.program == program {
            *self = Subroutines::default();
        }
    }
}

impl Shadow {
    pub(in crate::gl) unsafe fn glUniformSubroutinesuiv(
        &mut self,
        stage: u32,
        count: i32,
        indices: Ptr,
    ) {
        let program = self.values.known(Key::Value(c::CURRENT_PROGRAM));
        let [program, ..] = program.unwrap_or_else(|| [self.integer(c::CURRENT_PROGRAM), 0, 0, 0]);
        let count = u32::try_from(count).unwrap_or(0);
        if program == 0 || indices.is_null() || self.compiling.is_some() || self.inside {
            return;
        }
        if self.subroutines.program != program {
            self.subroutines = Subroutines {
                program,
                ..Subroutines::default()
            };
        }
        let [uniforms, subroutines] = self.numbers_of_subroutines(program, stage);
        if count != uniforms {
            return; // the driver has refused it
        }
        // SAFETY: so many indices, which the driver has read (the program's array).
        let indices = unsafe { std::slice::from_raw_parts(indices.cast::<u32>(), count as usize) };
        if indices.iter().any(|&index| index >= subroutines) {
            return;
        }
        let indices = indices.to_vec();
        let chosen = &mut self.subroutines.chosen;
        chosen.retain(|(known, _)| *known != stage);
        chosen.push((stage, indices));
    }

    /// How many uniforms and subroutines a stage of a program has.
    fn numbers_of_subroutines(&mut self, program: u32, stage: u32) -> [u32; 2] {
        let known = self.subroutines.numbers.iter();
        if let Some((_, numbers)) = known.into_iter().find(|(known, _)| *known == stage) {
            return *numbers;
        }
        let names = [
            c::ACTIVE_SUBROUTINE_UNIFORM_LOCATIONS,
            c::ACTIVE_SUBROUTINES,
        ];
        let numbers = names.map(|name| {
            let mut v = 0i32;
            // SAFETY: one integer.
            unsafe {
                self.real
                    .glGetProgramStageiv(program, stage, name, (&raw mut v).cast())
            };
            v.max(0) as u32
        });
        self.subroutines.numbers.push((stage, numbers));
        numbers
    }
}
