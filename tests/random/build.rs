//! Builds the program that makes random calls.

use crate::support::{Compiled, built};
use std::path::{Path, PathBuf};

/// The program with EGL and GLX, or with OSMesa.
pub(crate) fn program(osmesa: bool) -> PathBuf {
    let (name, window, more): (_, &[&str], &[&str]) = if osmesa {
        (
            "random-osmesa",
            &["window_osmesa"],
            &["-DRANDOM_OSMESA", "-lOSMesa", "-lpthread"],
        )
    } else {
        (
            "random",
            &["window_egl", "window_glx"],
            &["-lEGL", "-lGL", "-lX11", "-lpthread"],
        )
    };
    let common = [
        "main",
        "calls_state",
        "calls_draw",
        "calls_pixels",
        "calls_objects",
        "calls_queries",
        "calls_lists",
        "calls_indexed",
        "calls_captures",
        "worker",
        "dump",
    ];
    let sources: Vec<PathBuf> = common
        .iter()
        .chain(window)
        .map(|name| Path::new("tests/random").join(name).with_extension("c"))
        .collect();
    let sources: Vec<&Path> = sources.iter().map(PathBuf::as_path).collect();
    built(name, &sources, Compiled::Program, more)
}
