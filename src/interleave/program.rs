//! A pass as a GL program.

use super::shader::{self, GlslVersion, Pass, Stage};
use crate::gl::{Gl, ProgramName, consts as c};
use std::ffi::CString;

/// A compiled pass.
#[derive(Debug)]
pub struct Program {
    name: ProgramName,
    /// Location and words of each uniform.
    uniforms: Vec<(i32, shader::UniformSlot)>,
}

impl Program {
    /// For a context whose shading language has this version × 100. The error is the text of naga or of the driver.
    pub fn new(gl: &Gl, glsl: u32, pass: Pass) -> Result<Program, String> {
        let number = glsl.min(u32::from(u16::MAX)) as u16;
        let version = match gl.is_es() {
            true => GlslVersion::Embedded(number),
            false => GlslVersion::Desktop(number),
        };
        let vertex = shader::translate(pass, Stage::Vertex, version).map_err(|e| e.to_string())?;
        let fragment =
            shader::translate(pass, Stage::Fragment, version).map_err(|e| e.to_string())?;
        let v = gl.compile(c::VERTEX_SHADER, &vertex.source)?;
        let f = gl.compile(c::FRAGMENT_SHADER, &fragment.source)?;
        let name = gl.link(&[v, f])?;
        let current = ProgramName(gl.get_integer(c::CURRENT_PROGRAM) as u32);
        let location = |n: &str| CString::new(n).map_or(-1, |n| gl.uniform_location(name, &n));
        gl.use_program(name);
        for t in vertex.textures.iter().chain(&fragment.textures) {
            gl.uniform_1i(location(&t.name), t.unit as i32);
        }
        gl.use_program(current);
        // Uniforms that the pass does not read have no location.
        let uniforms = vertex.uniforms.into_iter().chain(fragment.uniforms);
        let uniforms = uniforms
            .map(|u| (location(&u.name), u))
            .filter(|&(location, _)| location >= 0)
            .collect();
        Ok(Program { name, uniforms })
    }

    /// The GL name.
    pub fn name(&self) -> ProgramName {
        self.name
    }

    /// Makes the program current and sets its uniforms from these words.
    pub fn bind(&self, gl: &Gl, words: &[u32]) {
        gl.use_program(self.name);
        for (location, slot) in &self.uniforms {
            match slot.of(words) {
                Some(&[a]) => gl.uniform_1ui(*location, a),
                Some(&[a, b]) => gl.uniform_2ui(*location, a, b),
                Some(&[a, b, c, d]) => {
                    gl.uniform_4fv(*location, &[[a, b, c, d].map(f32::from_bits)])
                }
                _ => {}
            }
        }
    }
}
