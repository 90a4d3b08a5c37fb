//! What the on-screen display shows.
#![forbid(unsafe_code)]

use std::fmt;

/// A part of the on-screen display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OsdPart {
    /// A value, for a moment after it was changed.
    Values,
    /// Sentences that the user is to see.
    Warnings,
    /// Frames per second, and how many views `hybrid` draws.
    Fps,
    /// A cross in the middle of the picture.
    Crosshair,
}

/// All parts with their words, in the order in which they are shown.
pub(super) const PARTS: [(&str, OsdPart); 4] = [
    ("values", OsdPart::Values),
    ("warnings", OsdPart::Warnings),
    ("fps", OsdPart::Fps),
    ("crosshair", OsdPart::Crosshair),
];

/// The word for no part.
const OFF: &str = "off";

/// The words, for messages.
pub(super) const WORDS: [&str; 5] = ["values", "warnings", "fps", "crosshair", OFF];

/// The parts that are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OsdParts(u8);

impl OsdParts {
    /// No part.
    pub const NONE: Self = Self(0);

    /// Whether a part is shown.
    #[must_use]
    pub fn has(self, part: OsdPart) -> bool {
        self.0 >> (part as u8) & 1 != 0
    }

    /// The parts with one of them shown, or not.
    #[must_use]
    pub fn with(self, part: OsdPart, shown: bool) -> Self {
        let bit = 1 << (part as u8);
        Self(if shown { self.0 | bit } else { self.0 & !bit })
    }

    /// Of words with commas between them; none if one is unknown.
    pub(super) fn of(words: &str) -> Option<Self> {
        if words == OFF {
            return Some(Self::NONE);
        }
        let part = |word: &str| {
            let known = PARTS.iter().find(|(known, _)| *known == word.trim());
            known.map(|(_, part)| *part)
        };
        let mut parts = words.split(',').map(part);
        parts.try_fold(Self::NONE, |parts, part| Some(parts.with(part?, true)))
    }
}

impl Default for OsdParts {
    fn default() -> Self {
        Self::NONE
            .with(OsdPart::Values, true)
            .with(OsdPart::Warnings, true)
    }
}

impl fmt::Display for OsdParts {
    /// As the option is written.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = PARTS.iter().filter(|(_, part)| self.has(*part));
        let words: Vec<_> = shown.map(|(word, _)| *word).collect();
        f.write_str(&if words.is_empty() {
            OFF.to_owned()
        } else {
            words.join(",")
        })
    }
}
