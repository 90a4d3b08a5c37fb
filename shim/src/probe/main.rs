//! `manyview-probe glx|egl|osmesa`: makes one legacy OpenGL context and says, as one line of JSON, what the layer can do in
//! it. `manyview doctor` runs it with the layer preloaded; it works without as well. Libraries are loaded by name, as many
//! programs do.
//!
//! `manyview-probe interleave [WIDTHxHEIGHT [VIEWS]]`: what the interleave pass costs in an EGL context, one line of JSON for each
//! size, number of views and panel.
//!
//! `manyview-probe rewrite FILE…`: real shaders rewritten, and what the driver says of them before and after; one line of JSON for each shader
//! and each program.

mod egl;
mod glx;
mod interleave;
mod library;
mod osmesa;
mod rewrite;

use manyview_core::gl::{Gl, Ptr, Real, consts as c};
use manyview_core::interleave::Interleaver;
use manyview_core::layer::support::{Probe, Support};
use std::process::ExitCode;

/// The functions of the context that was made. One API per process, so one table.
pub(crate) struct Context {
    real: &'static Real,
    /// A function that the layer hooks, as this process got it.
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
        _ => {
            eprintln!(
                "usage: manyview-probe glx|egl|osmesa|interleave [WIDTHxHEIGHT [VIEWS]]|rewrite FILE…"
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
    // The system takes context, window and connection back with the process.
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
            let names = support.strategies().into_iter().map(str::to_owned);
            probe.strategies = names.collect();
            probe.notes = support.notes();
            let interleaver = Interleaver::new(&gl, &mut Default::default(), support.glsl, None);
            probe.notes.extend(interleaver.note());
        }
        Err(error) => probe.notes.push(error.to_string()),
    }
    probe
}
