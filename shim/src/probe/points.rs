//! Splats drawn by the GPU, compared with their reference.

use crate::egl;
use manyview_core::gl::Gl;
use manyview_core::interleave::glsl_version;
use manyview_core::points::{Renderer, charts, compare, cost};
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

/// Numbers of points, sides of the picture and views: those of the charts of Hübner et al., and more views.
const CASES: [(u32, u32, u32); 8] = [
    (303_000, 256, 8),
    (303_000, 512, 8),
    (303_000, 1024, 8),
    (137_000, 512, 8),
    (1_100_000, 512, 8),
    (1_100_000, 512, 48),
    (1_100_000, 1024, 8),
    (1_100_000, 1024, 48),
];

/// Prints the times of opaque splats, a line for each case; or of one number of points, side and number of views.
pub(crate) fn costs() -> ExitCode {
    let cases = match words().as_deref() {
        Some([]) => CASES.to_vec(),
        Some([points, size, views]) if *views >= 2 => vec![(*points, *size, *views)],
        _ => return usage("points-cost [POINTS SIZE VIEWS]"),
    };
    print_all(cases, |gl, renderer, case| {
        cost::measure(gl, renderer, case)
            .and_then(|measured| text(serde_json::to_string(&measured)))
    })
}

/// Prints times and errors of blended splats, a line for each number of points and side.
pub(crate) fn chart() -> ExitCode {
    let cases = match words().as_deref() {
        Some(words) if !words.is_empty() && words.len() % 2 == 0 => {
            words.chunks(2).map(|pair| (pair[0], pair[1])).collect()
        }
        _ => return usage("points-chart POINTS SIZE [POINTS SIZE]…"),
    };
    print_all(cases, |gl, renderer, case| {
        charts::measure(gl, renderer, case)
            .and_then(|measured| text(serde_json::to_string(&measured)))
    })
}

/// The numbers after the name of what is measured.
fn words() -> Option<Vec<u32>> {
    let words = std::env::args().skip(2);
    words.map(|word| word.parse().ok()).collect()
}

fn usage(line: &str) -> ExitCode {
    eprintln!("usage: manyview-probe {line}");
    ExitCode::from(2)
}

fn text(json: serde_json::Result<String>) -> Result<String, String> {
    json.map_err(|error| error.to_string())
}

fn print_all<T>(
    cases: Vec<T>,
    measure: impl Fn(&Gl, &Renderer, T) -> Result<String, String>,
) -> ExitCode {
    match print_each(cases, measure) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn print_each<T>(
    cases: Vec<T>,
    measure: impl Fn(&Gl, &Renderer, T) -> Result<String, String>,
) -> Result<(), String> {
    let context = egl::context()?;
    // SAFETY: the context was just made current on this thread and stays so until the process ends.
    let gl = unsafe { Gl::new(context.real) };
    let renderer = Renderer::new(&gl, glsl_version(&gl))?;
    for case in cases {
        println!("{}", measure(&gl, &renderer, case)?);
    }
    Ok(())
}
