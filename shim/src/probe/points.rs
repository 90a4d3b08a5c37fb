//! Splats drawn by the GPU, compared with their reference.

use crate::egl;
use manyview_core::gl::Gl;
use manyview_core::points::compare;
use std::process::ExitCode;

/// Prints what was found.
pub(crate) fn run() -> ExitCode {
    match found() {
        Ok(line) => {
            println!("{line}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn found() -> Result<String, String> {
    let context = egl::context()?;
    // SAFETY: the context was just made current on this thread and stays so until the process ends.
    let gl = unsafe { Gl::new(context.real) };
    let mut found = serde_json::to_value(compare::compare(&gl)?).map_err(|e| e.to_string())?;
    found["errors"] = gl.take_errors().into();
    Ok(found.to_string())
}
