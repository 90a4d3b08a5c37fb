//! The version of the language that a text is written in.

use super::scan::Scan;

/// A version of the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Version {
    /// As in `#version`: 110 to 460, in OpenGL ES 100 to 320.
    pub number: u32,
    /// OpenGL ES.
    pub es: bool,
}

impl Version {
    /// From the `#version` of a text. One without is 1.10, or 1.00 in a context of OpenGL ES.
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

    /// At least this one of the desktop's.
    pub(super) fn desktop(self, number: u32) -> bool {
        !self.es && self.number >= number
    }

    /// What `#line` has to say so that the line after it is line `next`: up to 3.20 the number is that of the directive.
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
