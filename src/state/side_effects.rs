//! Where the shaders of a program write to memory: that happens once for each draw of the program's, whatever number of views is drawn.

use super::ShaderSource;
use crate::gl::{BindingPoint, Gl, ProgramName, consts as c};
use crate::rewrite::{MemoryWrites, facts};

/// The memory that a program's draws write to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SideEffects {
    /// It cannot be told which of the buffers that are bound for writing are written.
    pub everything: bool,
    /// Images may be written.
    pub images: bool,
    /// Indices of storage blocks that are written.
    blocks: Vec<usize>,
    /// Binding points of atomic counters.
    counters: Vec<u32>,
}

impl SideEffects {
    /// Whatever is bound may be written.
    pub const ANYTHING: SideEffects = SideEffects {
        everything: true,
        images: true,
        blocks: Vec::new(),
        counters: Vec::new(),
    };

    /// Those of a program that is linked from these sources; none where they are not known.
    pub fn of(gl: &Gl, program: ProgramName, sources: Option<&[ShaderSource]>) -> Self {
        let of_source = |shader: &ShaderSource| match shader.source.as_slice() {
            // SPIR-V.
            [] => None,
            source => facts(source, gl.is_es()).ok(),
        };
        let writes = sources.and_then(|all| {
            all.iter()
                .try_fold(MemoryWrites::default(), |writes, shader| {
                    Some(writes.and(of_source(shader)?.writes))
                })
        });
        match writes {
            Some(writes) if writes.is_empty() => SideEffects::default(),
            Some(writes) if gl.tells_storage_blocks() && !writes.unclear => {
                let names = gl.storage_blocks(program).into_iter().enumerate();
                let written = names.filter(|(_, name)| {
                    let block = name.split('[').next().unwrap_or_default();
                    writes.blocks.contains(block)
                });
                SideEffects {
                    everything: false,
                    images: writes.images,
                    blocks: written.map(|(at, _)| at).collect(),
                    counters: match writes.counters {
                        true => gl.counter_bindings(program),
                        false => Vec::new(),
                    },
                }
            }
            _ => SideEffects::ANYTHING,
        }
    }

    /// Whether nothing is written.
    pub fn is_empty(&self) -> bool {
        *self == SideEffects::default()
    }

    /// The binding points of the buffers that are written, where it is known which.
    pub fn points(&self, gl: &Gl, program: ProgramName) -> Vec<BindingPoint> {
        let mut points: Vec<BindingPoint> = Vec::new();
        if !self.blocks.is_empty() {
            let bindings = gl.storage_bindings(program);
            let written = self.blocks.iter().filter_map(|&at| bindings.get(at));
            points.extend(written.map(|&index| BindingPoint {
                target: c::SHADER_STORAGE_BUFFER,
                index,
            }));
        }
        points.extend(self.counters.iter().map(|&index| BindingPoint {
            target: c::ATOMIC_COUNTER_BUFFER,
            index,
        }));
        points.sort_unstable_by_key(|point| (point.target, point.index));
        points.dedup();
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gl::fake::Fake;
    use crate::rewrite::Stage;

    fn of(source: &str) -> SideEffects {
        let shader = ShaderSource {
            kind: c::FRAGMENT_SHADER,
            stage: Stage::Fragment,
            source: source.into(),
        };
        let fake = Fake::new();
        SideEffects::of(&fake.gl(), ProgramName(1), Some(&[shader]))
    }

    #[test]
    fn what_is_not_known_may_write_anything() {
        let fake = Fake::new();
        let unknown = SideEffects::of(&fake.gl(), ProgramName(1), None);
        assert_eq!(unknown, SideEffects::ANYTHING);
        // SPIR-V has no source.
        assert_eq!(of(""), SideEffects::ANYTHING);
        let hidden = "#version 430\n#define OUT buffer\nOUT B { int a; };\nvoid main() { a = 1; }";
        assert_eq!(of(hidden), SideEffects::ANYTHING);
        assert!(
            of("#version 430\nout vec4 colour; void main() { colour = vec4(1.0); }").is_empty()
        );
        let stores = "#version 430\nvoid main() { imageStore(image, ivec2(0), vec4(1.0)); }";
        assert!(of(stores).images && !of(stores).everything);
    }
}
