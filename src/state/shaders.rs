//! What the programs of a share group were linked from.

use crate::gl::{Gl, consts as c};
use crate::rewrite::Stage;
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// One shader object of a program when it was linked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    /// Its stage.
    pub stage: Stage,
    /// All its strings; empty where it has none.
    pub source: Vec<u8>,
}

/// The texts of a program, and which of its links they belong to.
pub type Linked = (u64, Arc<[Text]>);

/// The programs of a share group.
#[derive(Debug, Default)]
pub struct Shaders {
    programs: HashMap<u32, Linked>,
    links: u64,
}

/// Changes of uniforms, in all contexts.
static CHANGES: AtomicU64 = AtomicU64::new(1);

/// A uniform of some program gets another value.
pub fn uniform_changes() {
    CHANGES.fetch_add(1, Ordering::Relaxed);
}

/// How many have changed so far.
pub fn uniform_change() -> u64 {
    CHANGES.load(Ordering::Relaxed)
}

impl Shaders {
    /// After glLinkProgram. A link that failed leaves the executable that was there before.
    pub fn linked(&mut self, gl: &Gl, program: u32) {
        if gl.program_parameter(program, c::LINK_STATUS) == 0 {
            return;
        }
        self.links += 1;
        let texts = gl
            .attached_shaders(program)
            .into_iter()
            .filter_map(|shader| {
                Some(Text {
                    stage: stage(gl.shader_parameter(shader, c::SHADER_TYPE) as u32)?,
                    source: gl.shader_source(shader),
                })
            });
        self.programs.insert(program, (self.links, texts.collect()));
    }

    /// A program got its executable in another way, or is no more.
    pub fn forget(&mut self, program: u32) {
        self.programs.remove(&program);
    }

    /// What a program was linked from; none where that was not seen.
    pub fn of(&self, program: u32) -> Option<Linked> {
        self.programs.get(&program).cloned()
    }
}

fn stage(kind: u32) -> Option<Stage> {
    Some(match kind {
        c::VERTEX_SHADER => Stage::Vertex,
        c::TESS_CONTROL_SHADER => Stage::TessControl,
        c::TESS_EVALUATION_SHADER => Stage::TessEvaluation,
        c::GEOMETRY_SHADER => Stage::Geometry,
        c::FRAGMENT_SHADER => Stage::Fragment,
        c::COMPUTE_SHADER => Stage::Compute,
        _ => return None,
    })
}
