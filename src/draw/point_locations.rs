//! Uniforms of the programs that draw points for all views at once.

use crate::gl::{Gl, ProgramName};
use std::ffi::CString;

/// Locations of the uniforms that all programs of points have; -1 where one has none.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointLocations {
    pub(super) target: i32,
    pub(super) window: i32,
    pub(super) rule: i32,
    pub(super) rows_down: i32,
    pub(super) coord_sign: i32,
    pub(super) seen: i32,
    pub(super) surface: i32,
}

impl PointLocations {
    /// Those of a program whose added names have this prefix.
    pub(super) fn of(gl: &Gl, program: ProgramName, prefix: &str) -> Self {
        let at = |word: &str| {
            let name = CString::new(format!("{prefix}{word}"));
            name.map_or(-1, |name| gl.uniform_location(program, &name))
        };
        PointLocations {
            target: at("target"),
            window: at("window"),
            rule: at("rule"),
            rows_down: at("rows_down"),
            coord_sign: at("coord_sign"),
            seen: at("seen"),
            surface: at("surface"),
        }
    }
}
