//! The GLSL version of a source.

use super::scan::Scan;

/// A version of GLSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Version {
    /// As in `#version`: 110 to 460, in OpenGL ES 100 to 320.
    pub number: u32,
    /// OpenGL ES.
    pub es: bool,
}

impl Version {
    /// Reads the `#version` of a source. The default is 1.10, or 1.00 in a context of OpenGL ES.
    pub(super) fn of(scan: &Scan, es_context: bool) -> Self {
        let written = scan.directives.iter().find_map(|directive| {
            let first = directive.tokens.start;
            if *scan.called(directive) != *b"version" {
                return None;
            }
            let number = scan.number(first + 2)?;
            let es = number == 100 || *scan.name(first + 3) == *b"es";
            Some(Self { number, es })
        });
        written.unwrap_or(Self {
            number: if es_context { 100 } else { 110 },
            es: es_context,
        })
    }

    /// Whether this is desktop GLSL of at least this version.
    pub(super) fn desktop(self, number: u32) -> bool {
        !self.es && self.number >= number
    }

    /// The number for a `#line` after which the next line is line `next`. Before GLSL 3.30 the number is that of the directive itself.
    pub(super) fn line_directive(self, next: usize) -> usize {
        if self.es || self.number >= 330 {
            next
        } else {
            next.saturating_sub(1)
        }
    }

    /// Precision for a declaration that must not depend on the program's own default.
    pub(super) fn highp(self) -> &'static str {
        if self.es { "highp " } else { "" }
    }
}
