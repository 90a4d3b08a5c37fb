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

impl Shadow {
    pub(in crate::gl) unsafe fn glUniformSubroutinesuiv(
        &mut self,
        stage: u32,
        count: i32,
        indices: Ptr,
    ) {
        let program = self.values.known(Key::Value(c::CURRENT_PROGRAM));
        let [program, ..] = program.unwrap_or_else(|| [self.integer(c::CURRENT_PROGRAM), 0, 0, 0]);
        let count = usize::try_from(count).unwrap_or(0);
        if program == 0 || indices.is_null() {
            return;
        }
        // SAFETY: so many indices (the program's array).
        let indices = unsafe { std::slice::from_raw_parts(indices.cast::<u32>(), count) }.to_vec();
        if self.subroutines.program != program {
            self.subroutines = Subroutines {
                program,
                chosen: Vec::new(),
            };
        }
        let chosen = &mut self.subroutines.chosen;
        chosen.retain(|(known, _)| *known != stage);
        chosen.push((stage, indices));
    }
}
