//! The sources from which the programs of a share group were linked.

use crate::checksum::fnv1a;
use crate::gl::{Active, BlockPlace, Gl, ProgramName, consts as c};
use crate::rewrite::Stage;
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// One shader object of a program when it was linked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShaderSource {
    /// Its type, such as GL_VERTEX_SHADER.
    pub kind: u32,
    /// The same as a stage.
    pub stage: Stage,
    /// All its strings; empty where it has none.
    pub source: Vec<u8>,
}

/// Characters of a line that is quoted.
const QUOTED: usize = 60;

impl ShaderSource {
    /// The first line that has text and is no directive, by which a person knows a shader; none where there is none.
    pub fn first_line(&self) -> Option<String> {
        let text = String::from_utf8_lossy(&self.source);
        let lines = text.lines().map(str::trim);
        let line = lines
            .filter(|line| !line.starts_with('#'))
            .find(|line| line.chars().any(char::is_alphanumeric))?;
        Some(
            line.chars()
                .filter(|c| !c.is_control())
                .take(QUOTED)
                .collect(),
        )
    }

    /// Whether the source has the name of this member of a block more than once, so that it does not just declare it.
    fn reads(&self, member: &str) -> bool {
        let name = member.rsplit('.').next().unwrap_or(member);
        let name = name.split('[').next().unwrap_or(name).as_bytes();
        let is_of_name = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
        let words = self.source.split(|byte| !is_of_name(byte));
        words.filter(|word| *word == name).nth(1).is_some()
    }
}

/// The sources from which a program was linked.
#[derive(Clone, Debug)]
pub struct Linked {
    /// The number of this link, counted over all programs of the share group.
    pub link: u64,
    /// Its shader objects.
    pub sources: Arc<[ShaderSource]>,
    /// A hash of their sources, which is the same in each run of the program.
    pub hash: u64,
}

/// The programs of a share group.
#[derive(Debug, Default)]
pub struct Shaders {
    programs: HashMap<ProgramName, Linked>,
    links: u64,
}

/// Number of changes of uniforms, in all contexts: one without a layer, such as that of a loading thread, may also set uniforms of
/// shared programs. A change in an unrelated share group costs one more read of the uniforms, but makes no picture wrong.
static CHANGES: AtomicU64 = AtomicU64::new(1);

/// Number of times that a program was linked or deleted, in all share groups.
static LINKS: AtomicU64 = AtomicU64::new(1);

/// Notes that a uniform of some program gets another value.
pub fn uniform_changes() {
    CHANGES.fetch_add(1, Ordering::Relaxed);
}

/// The number of changes of uniforms so far.
pub fn uniform_change() -> u64 {
    CHANGES.load(Ordering::Relaxed)
}

/// The number of changes of programs' executables so far.
pub fn link_change() -> u64 {
    LINKS.load(Ordering::Relaxed)
}

/// The sources from which a program has just been linked. `None` if linking failed; the program then keeps its earlier executable.
pub fn sources(gl: &Gl, program: ProgramName) -> Option<Arc<[ShaderSource]>> {
    if gl.program_parameter(program, c::LINK_STATUS) == 0 {
        return None;
    }
    let source = |shader| {
        let kind = gl.shader_parameter(shader, c::SHADER_TYPE) as u32;
        Some(ShaderSource {
            kind,
            stage: stage(kind)?,
            source: gl.shader_source(shader),
        })
    };
    let shaders = gl.attached_shaders(program).into_iter();
    Some(shaders.filter_map(source).collect())
}

impl Shaders {
    /// Notes that a program was linked.
    pub fn linked(&mut self, program: ProgramName, sources: Arc<[ShaderSource]>) {
        self.links += 1;
        LINKS.fetch_add(1, Ordering::Relaxed);
        let hash = hash(&sources);
        let link = self.links;
        self.programs.insert(
            program,
            Linked {
                link,
                sources,
                hash,
            },
        );
    }

    /// Notes that a program got its executable in another way, or is deleted.
    pub fn forget(&mut self, program: ProgramName) {
        LINKS.fetch_add(1, Ordering::Relaxed);
        self.programs.remove(&program);
    }

    /// A program whose sources have this hash.
    pub fn with_hash(&self, hash: u64) -> Option<Linked> {
        let found = self.programs.values().find(|linked| linked.hash == hash);
        found.cloned()
    }

    /// The sources from which a program was linked; `None` if the layer has not seen it linked.
    pub fn of(&self, program: ProgramName) -> Option<Linked> {
        self.programs.get(&program).cloned()
    }
}

/// The 4x4 uniform matrices of a program's own shaders.
#[derive(Debug, Default)]
pub struct Matrices {
    /// Locations of those that are plain uniforms.
    uniforms: Vec<i32>,
    /// Those in blocks.
    in_blocks: Vec<BlockPlace>,
    /// Those of them that some shader reads, as far as its source tells: many programs share one block.
    read: Vec<BlockPlace>,
    /// Locations of the elements of arrays of vectors, which may hold matrices as well: the constants of Direct3D.
    vectors: Vec<Vec<i32>>,
}

impl Matrices {
    /// The matrices of a program that is linked from these sources; only the first of an array.
    pub fn of(gl: &Gl, program: ProgramName, sources: &[ShaderSource]) -> Matrices {
        let mut found = Matrices::default();
        for (index, active) in (0..).zip(gl.active_uniforms(program)) {
            if active.is_vec4() && active.size >= 4 {
                found.vectors.extend(elements(gl, program, &active));
            }
            if active.kind != c::FLOAT_MAT4 {
                continue;
            }
            match gl.uniform_location(program, &active.name) {
                location @ 0.. => {
                    gl.keep_uniform(program, location, active.kind, active.size.max(1) as u32);
                    found.uniforms.push(location);
                }
                _ => {
                    let place = gl.place_in_block(program, index);
                    found.in_blocks.extend(place);
                    if sources
                        .iter()
                        .any(|shader| shader.reads(&active.name.to_string_lossy()))
                    {
                        found.read.extend(place);
                    }
                }
            }
        }
        found
    }

    /// The locations and current values of those that are plain uniforms; values are column-major.
    pub fn uniforms(&self, gl: &Gl, program: ProgramName) -> Vec<(i32, [f32; 16])> {
        let all = self.uniforms.iter();
        all.map(|&at| (at, gl.uniform_matrix(program, at)))
            .collect()
    }

    /// The places of those that are in blocks.
    pub fn in_blocks(&self) -> &[BlockPlace] {
        &self.in_blocks
    }

    /// The places of those in blocks that shaders read.
    pub fn read_in_blocks(&self) -> &[BlockPlace] {
        &self.read
    }

    /// The current value of one of them, numbered as in [`Matrices::values`]. `in_block` gives those in blocks, where it can.
    pub fn value(
        &self,
        gl: &Gl,
        program: ProgramName,
        at: usize,
        in_block: &mut dyn FnMut(BlockPlace) -> Option<[f32; 16]>,
    ) -> Option<[f32; 16]> {
        match self.uniforms.get(at) {
            Some(&location) => Some(gl.uniform_matrix(program, location)),
            None => in_block(*self.in_blocks.get(at - self.uniforms.len())?),
        }
    }

    /// The current values of the arrays of vectors.
    pub fn vectors(&self, gl: &Gl, program: ProgramName) -> impl Iterator<Item = Vec<[f32; 4]>> {
        let vectors = move |locations: &Vec<i32>| {
            let all = locations.iter().map(|&at| gl.uniform_vector(program, at));
            all.collect()
        };
        self.vectors.iter().map(vectors)
    }

    /// The current values of four vectors in a row: the number of the array, and of the first one in it.
    pub fn four_vectors(
        &self,
        gl: &Gl,
        program: ProgramName,
        (array, first): (usize, usize),
    ) -> Option<[[f32; 4]; 4]> {
        let four: &[i32; 4] = self.vectors.get(array)?.get(first..)?.first_chunk()?;
        Some(four.map(|at| gl.uniform_vector(program, at)))
    }

    /// The current values, column-major: those of plain uniforms, and behind them those of `in_block`, 0 where it cannot tell one.
    pub fn values(
        &self,
        gl: &Gl,
        program: ProgramName,
        in_block: &mut dyn FnMut(BlockPlace) -> Option<[f32; 16]>,
    ) -> Vec<[f32; 16]> {
        let uniforms = self.uniforms.iter();
        let mut all: Vec<_> = uniforms.map(|&at| gl.uniform_matrix(program, at)).collect();
        let places = self.in_blocks.iter();
        all.extend(places.map(|&place| in_block(place).unwrap_or_default()));
        all
    }
}

/// The locations of the elements of an array that is a plain uniform. The driver keeps them from now on.
fn elements(gl: &Gl, program: ProgramName, active: &Active) -> Option<Vec<i32>> {
    let left = (1..=active.size.max(1) as u32).rev();
    let located = active.elements().zip(left).map(|(name, left)| {
        let location = gl.uniform_location(program, &name);
        if location >= 0 {
            gl.keep_uniform(program, location, active.kind, left);
        }
        (location >= 0).then_some(location)
    });
    located.collect()
}

/// The textures that a program's own shaders sample, and the images that they load and store.
#[derive(Debug, Default)]
pub struct Samplers {
    /// Locations of samplers, and texture targets.
    uniforms: Vec<(i32, u32)>,
    /// Locations of images.
    images: Vec<i32>,
}

impl Samplers {
    /// The samplers and images of a program that is linked.
    pub fn of(gl: &Gl, program: ProgramName) -> Samplers {
        let mut found = Samplers::default();
        for active in gl.active_uniforms(program) {
            let (target, image) = (sampled(active.kind), is_image(active.kind));
            if target.is_none() && !image {
                continue;
            }
            let left = (1..=active.size.max(1) as u32).rev();
            for (name, left) in active.elements().zip(left) {
                let location = gl.uniform_location(program, &name);
                if location >= 0 {
                    gl.keep_uniform(program, location, active.kind, left);
                }
                match target {
                    _ if location < 0 => {}
                    Some(target) => found.uniforms.push((location, target)),
                    None => found.images.push(location),
                }
            }
        }
        found
    }

    /// The image units in use, counted from 0.
    pub fn image_units(&self, gl: &Gl, program: ProgramName) -> Vec<u32> {
        let all = self.images.iter();
        all.map(|&at| gl.uniform_int(program, at).max(0).unsigned_abs())
            .collect()
    }

    /// The texture units in use, counted from 0, and their targets.
    pub fn units(&self, gl: &Gl, program: ProgramName) -> Vec<(u32, u32)> {
        let all = self.uniforms.iter();
        all.map(|&(at, target)| (gl.uniform_int(program, at).max(0).unsigned_abs(), target))
            .collect()
    }
}

/// The texture target that a sampler type reads; `None` for other types, and for buffer textures.
fn sampled(kind: u32) -> Option<u32> {
    Some(match kind {
        0x8B5D | 0x8B61 | 0x8DC9 | 0x8DD1 => c::TEXTURE_1D,
        0x8B5E | 0x8B62 | 0x8DCA | 0x8DD2 => c::TEXTURE_2D,
        0x8B5F | 0x8DCB | 0x8DD3 => c::TEXTURE_3D,
        0x8B60 | 0x8DC5 | 0x8DCC | 0x8DD4 => c::TEXTURE_CUBE_MAP,
        0x8B63 | 0x8B64 | 0x8DCD | 0x8DD5 => c::TEXTURE_RECTANGLE,
        0x8DC1 | 0x8DC4 | 0x8DCF | 0x8DD7 => c::TEXTURE_2D_ARRAY,
        0x9108..=0x910A => c::TEXTURE_2D_MULTISAMPLE,
        0x910B..=0x910D => c::TEXTURE_2D_MULTISAMPLE_ARRAY,
        0x900C..=0x900F => c::TEXTURE_CUBE_MAP_ARRAY,
        _ => return None,
    })
}

/// Whether a uniform type is an image: GL_IMAGE_1D to GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY.
fn is_image(kind: u32) -> bool {
    (0x904C..=0x906C).contains(&kind)
}

/// The 64-bit FNV-1a hash of all sources with their types.
fn hash(sources: &[ShaderSource]) -> u64 {
    let bytes = sources.iter().flat_map(|shader| {
        let kind = shader.kind.to_le_bytes();
        kind.into_iter().chain(shader.source.iter().copied())
    });
    fnv1a(bytes)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shader_is_known_by_its_first_line() {
        let line = |source: &str| {
            let shader = ShaderSource {
                kind: c::VERTEX_SHADER,
                stage: Stage::Vertex,
                source: source.into(),
            };
            shader.first_line()
        };
        let text = "#version 330\n#define LIGHTS 4\n\n  // Water, \x1b[31mby\tnight\nin vec3 at;\n";
        assert_eq!(line(text).as_deref(), Some("// Water, [31mbynight"));
        assert_eq!(
            line("/*\n * ----\n * sky.vert\n */").as_deref(),
            Some("* sky.vert")
        );
        assert_eq!(
            line(&format!("//{}", "é".repeat(99))).map(|l| l.chars().count()),
            Some(60)
        );
        assert_eq!(line("#version 330\n"), None);
    }

    #[test]
    fn a_member_is_read_where_it_is_named_beside_its_declaration() {
        let shader = |source: &str| ShaderSource {
            kind: c::FRAGMENT_SHADER,
            stage: Stage::Fragment,
            source: source.into(),
        };
        let block = "uniform Camera { mat4 back; mat4 all[2]; } camera;";
        let declared = shader(block);
        assert!(!declared.reads("Camera.back") && !declared.reads("Camera.all[0]"));
        let used = shader(&format!(
            "{block} void main() {{ p = camera.back * q; feedback(); }}"
        ));
        assert!(used.reads("Camera.back") && used.reads("back"));
        assert!(!used.reads("Camera.all[0]"));
    }
}
