//! Compiles and links every pass of the layer, in every version of the shading language that a context has.

use crate::egl::{self, Kind};
use manyview_core::gl::{Gl, consts as c};
use manyview_core::interleave::shader::{GlslVersion, Pass};
use manyview_core::interleave::{Program, glsl_version};
use serde_json::json;
use std::process::ExitCode;

/// A core profile gets the same text as a context without one.
const KINDS: [(&str, Kind); 2] = [("legacy", Kind::Legacy), ("es", Kind::Es)];

/// Prints a line for each kind of context and each version. Kinds that the driver does not have are named on stderr. Fails where a pass does.
pub(crate) fn run() -> ExitCode {
    let mut failed = false;
    for (name, kind) in KINDS {
        match egl::make(kind) {
            // SAFETY: the context was just made current on this thread and stays so until the next one is.
            Ok(context) => failed |= every(name, &unsafe { Gl::new(context.real) }),
            Err(error) => eprintln!("{name}: {error}"),
        }
    }
    if failed {
        ExitCode::FAILURE
    } else {
        ExitCode::SUCCESS
    }
}

/// Whether a pass fails in the current context.
fn every(kind: &str, gl: &Gl) -> bool {
    let newest = glsl_version(gl);
    let mut any = false;
    for version in GlslVersion::SUPPORTED {
        let number = match version {
            GlslVersion::Desktop(number) if !gl.is_es() => u32::from(number),
            GlslVersion::Embedded(number) if gl.is_es() => u32::from(number),
            _ => continue,
        };
        if number > newest {
            continue;
        }
        let (mut linked, mut failed) = (0, Vec::new());
        for pass in Pass::all() {
            match Program::new(gl, number, pass) {
                Ok(program) => {
                    gl.delete_program(program.name());
                    linked += 1;
                }
                Err(error) => failed.push(format!("{pass:?}: {error}")),
            }
        }
        any |= !failed.is_empty();
        let line = json!({
            "context": kind, "version": gl.get_string(c::VERSION), "renderer": gl.get_string(c::RENDERER),
            "glsl": version.to_string(), "linked": linked, "failed": failed,
        });
        println!("{line}");
    }
    any
}
