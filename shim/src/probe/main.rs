//! `manyview-probe glx|egl|osmesa` makes one legacy OpenGL context and prints, as one line of JSON, what the layer can do in
//! it. `manyview doctor` runs it with the layer preloaded; it also works without. It loads libraries by name, as many
//! programs do.
//!
//! `manyview-probe interleave [WIDTHxHEIGHT [VIEWS]]` measures the cost of the interleave pass in an EGL context, and prints one line
//! of JSON for each size, number of views and panel.
//!
//! `manyview-probe rewrite FILE…` rewrites real shaders and gives them to the driver before and after. It prints one line of JSON for each
//! shader and each program.
//!
//! `manyview-probe passes` gives the layer's own passes to the driver, in every version of the shading language that its contexts have. It
//! prints one line of JSON for each kind of context and version.
//!
//! `manyview-probe points` draws random splats and compares each with its reference. It prints one line of JSON.

mod egl;
mod glx;
mod interleave;
mod library;
mod osmesa;
mod passes;
mod points;
mod rewrite;

use manyview_core::gl::{Gl, Ptr, Real, consts as c};
use manyview_core::interleave::Interleaver;
use manyview_core::layer::support::{Probe, Support};
use std::process::ExitCode;

/// A context that was made current. A process uses one API, so there is one table of functions.
pub(crate) struct Context {
    real: &'static Real,
    /// The address of a hooked function, as this process got it.
    sample: Ptr,
}

fn main() -> ExitCode {
    let api = std::env::args().nth(1).unwrap_or_default();
    let made = match api.as_str() {
        "glx" => glx::context(),
        "egl" => egl::context(),
        "osmesa" => osmesa::context(),
        "interleave" => return interleave::run(),
        "rewrite" => return rewrite::run(),
        "passes" => return passes::run(),
        "points" => return points::run(),
        "points-cost" => return points::costs(),
        "points-chart" => return points::chart(),
        _ => {
            eprintln!(
                "usage: manyview-probe glx|egl|osmesa|passes|points|interleave [WIDTHxHEIGHT [VIEWS]]|rewrite FILE…"
            );
            return ExitCode::from(2);
        }
    };
    let mut probe = match made {
        // SAFETY: the context was just made current on this thread and stays so until the process ends.
        Ok(context) => unsafe { ask(&context) },
        Err(error) => Probe {
            error: Some(error),
            ..Probe::default()
        },
    };
    probe.api = api;
    match serde_json::to_string(&probe) {
        Ok(line) => println!("{line}"),
        Err(_) => return ExitCode::FAILURE,
    }
    // The system frees context, window and connection with the process.
    ExitCode::SUCCESS
}

/// # Safety
/// The context is current on this thread.
unsafe fn ask(context: &Context) -> Probe {
    // SAFETY: forwarded.
    let gl = unsafe { Gl::new(context.real) };
    let mut probe = Probe {
        version: Some(gl.get_string(c::VERSION)),
        renderer: Some(gl.get_string(c::RENDERER)),
        hooked: library::lies_in(context.sample, "libmanyview.so"),
        ..Probe::default()
    };
    match Support::ask(&gl) {
        Ok(support) => {
            let names = support
                .strategies(gl.is_es())
                .into_iter()
                .map(str::to_owned);
            probe.strategies = names.collect();
            probe.notes = support.notes(gl.is_es());
            let interleaver =
                Interleaver::new(&gl, &mut Default::default(), support.glsl, false, None);
            probe.notes.extend(interleaver.note());
        }
        Err(error) => probe.notes.push(error.to_string()),
    }
    probe
}
