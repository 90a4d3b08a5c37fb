//! Splats drawn by the GPU, compared with their reference.

use crate::egl;
use manyview_core::gl::Gl;
use manyview_core::interleave::glsl_version;
use manyview_core::points::{Renderer, compare, cost};
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

/// Numbers of points, sides of the picture and views of the charts of Hübner et al., and more views.
const CHARTS: [(u32, u32, u32); 8] = [
    (303_000, 256, 8),
    (303_000, 512, 8),
    (303_000, 1024, 8),
    (137_000, 512, 8),
    (1_100_000, 512, 8),
    (1_100_000, 512, 48),
    (1_100_000, 1024, 8),
    (1_100_000, 1024, 48),
];

/// Prints the times of the charts, a line for each; or of one number of points, side and number of views.
pub(crate) fn costs() -> ExitCode {
    let words: Vec<_> = std::env::args().skip(2).map(|word| word.parse()).collect();
    let cases = match words.as_slice() {
        [] => CHARTS.to_vec(),
        [Ok(points), Ok(size), Ok(views @ 2..)] => vec![(*points, *size, *views)],
        _ => {
            eprintln!("usage: manyview-probe points-cost [POINTS SIZE VIEWS]");
            return ExitCode::from(2);
        }
    };
    let context = match egl::context() {
        Ok(context) => context,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    // SAFETY: the context was just made current on this thread and stays so until the process ends.
    let gl = unsafe { Gl::new(context.real) };
    let renderer = match Renderer::new(&gl, glsl_version(&gl)) {
        Ok(renderer) => renderer,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    for case in cases {
        let cost = cost::measure(&gl, &renderer, case)
            .and_then(|cost| serde_json::to_string(&cost).map_err(|error| error.to_string()));
        match cost {
            Ok(line) => println!("{line}"),
            Err(error) => {
                eprintln!("{error}");
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}
