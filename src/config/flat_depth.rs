//! Where a flat draw stands.
#![forbid(unsafe_code)]

use std::fmt;

/// As far before the panel as anyone may ask for.
const NEAREST: f64 = -10.0;

/// The depth of a flat draw, in parts of the separation at infinity, or what it follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FlatDepth {
    /// 0 on the panel, 1 infinitely far, below 0 before the panel.
    At(f64),
    /// With the scene in the middle of the window, as a crosshair.
    Crosshair,
    /// With the scene under the pointer, as a cursor.
    Cursor,
}

/// What a flat draw can follow.
const WORDS: [(&str, FlatDepth); 2] = [
    ("crosshair", FlatDepth::Crosshair),
    ("cursor", FlatDepth::Cursor),
];

/// On the panel.
impl Default for FlatDepth {
    fn default() -> Self {
        Self::At(0.0)
    }
}

impl FlatDepth {
    /// Infinitely far.
    pub const FARTHEST: f64 = 1.0;

    /// A depth in range.
    #[must_use]
    pub fn at(depth: f64) -> Option<Self> {
        (NEAREST..=Self::FARTHEST)
            .contains(&depth)
            .then_some(Self::At(depth))
    }

    /// The nearest depth that is in range.
    #[must_use]
    pub fn in_range(depth: f64) -> f64 {
        depth.clamp(NEAREST, Self::FARTHEST)
    }

    /// The depth of a word, or of a number in range.
    #[must_use]
    pub fn of(text: &str) -> Option<Self> {
        match WORDS.iter().find(|(word, _)| *word == text) {
            Some((_, depth)) => Some(*depth),
            None => Self::at(text.parse().ok()?),
        }
    }

    /// The word of what it follows; none for a number.
    #[must_use]
    pub fn word(self) -> Option<&'static str> {
        let known = WORDS.iter().find(|(_, depth)| *depth == self);
        known.map(|(word, _)| *word)
    }
}

impl fmt::Display for FlatDepth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::At(depth) => depth.fmt(f),
            other => f.write_str(other.word().unwrap_or_default()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_numbers_come_back() {
        for text in ["0", "-10", "1", "0.25", "crosshair", "cursor"] {
            let depth = FlatDepth::of(text).expect(text);
            assert_eq!(depth.to_string(), text);
            assert_eq!(depth.word().is_none(), matches!(depth, FlatDepth::At(_)));
        }
        for text in ["1.5", "-11", "NaN", "", "scene"] {
            assert_eq!(FlatDepth::of(text), None, "{text}");
        }
    }
}
