//! The words for the class of a draw and for the state that decides it; profiles and plans share them.
#![forbid(unsafe_code)]

/// The class of a draw, which decides how its views differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Class {
    /// No parallax of its own: head-up displays, fonts, cursors, full-screen quads. The whole draw stands at one depth.
    Flat,
    /// Infinitely far.
    Sky,
    /// Each vertex has its own depth.
    Scene,
    /// No picture for the viewer: shadow maps, lightmaps, render targets. Drawn once.
    OffScreen,
}

/// The kind of the projection matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// Row 3 depends on the position.
    Perspective,
    /// Row 3 is (0, 0, 0, k).
    Orthographic,
    /// The identity.
    None,
}

/// How a draw uses the depth buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthState {
    /// Tests and writes.
    On,
    /// Neither: without the test GL does not write either.
    Off,
    /// Tests, and writes nothing.
    TestOnly,
}

/// Which part of the depth buffer a draw's depths go to, by glDepthRange.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthRange {
    /// All of it.
    Whole,
    /// From the near end, not to the far one: before all draws to the whole range.
    Near,
    /// The far hundredth alone: behind everything.
    Far,
    /// Anything else.
    Part,
}

/// How much of the window the viewport covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Viewport {
    /// The window, or a part that may hold a scene of its own.
    Main,
    /// Less than a quarter of both the window's width and its height: a picture in the picture.
    Inset,
}

/// Which draws without perspective are sheared by their depths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OrthographicDraws {
    /// Those that are seen from an oblique direction, in programs without perspective.
    #[default]
    Auto,
    /// None.
    Flat,
    /// All that are tested against depths.
    Scene,
}

/// A value that is written as a word.
pub trait Word: Copy + PartialEq + 'static {
    /// Every value with its word.
    const WORDS: &'static [(&'static str, Self)];

    /// The word of this value.
    fn word(self) -> &'static str {
        // Every value has a word (tested); the fallback only keeps this total.
        Self::WORDS
            .iter()
            .find(|(_, value)| *value == self)
            .map_or("", |(word, _)| word)
    }

    /// The value of a word.
    fn of(word: &str) -> Option<Self> {
        Self::WORDS
            .iter()
            .find(|(known, _)| *known == word)
            .map(|(_, value)| *value)
    }
}

impl Word for Class {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("flat", Self::Flat),
        ("sky", Self::Sky),
        ("scene", Self::Scene),
        ("off-screen", Self::OffScreen),
    ];
}

impl Word for Projection {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("perspective", Self::Perspective),
        ("orthographic", Self::Orthographic),
        ("none", Self::None),
    ];
}

impl Word for DepthState {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("on", Self::On),
        ("off", Self::Off),
        ("test-only", Self::TestOnly),
    ];
}

impl Word for Viewport {
    const WORDS: &'static [(&'static str, Self)] = &[("main", Self::Main), ("inset", Self::Inset)];
}

impl Word for DepthRange {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("whole", Self::Whole),
        ("near", Self::Near),
        ("far", Self::Far),
        ("part", Self::Part),
    ];
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round_trip<T: Word + std::fmt::Debug>(values: &[T]) {
        for &value in values {
            assert_eq!(T::of(value.word()), Some(value));
        }
        assert_eq!(values.len(), T::WORDS.len());
        assert_eq!(T::of("nonsense"), None);
    }

    #[test]
    fn every_value_has_a_word() {
        round_trip(&[Class::Flat, Class::Sky, Class::Scene, Class::OffScreen]);
        round_trip(&[
            Projection::Perspective,
            Projection::Orthographic,
            Projection::None,
        ]);
        round_trip(&[Viewport::Main, Viewport::Inset]);
        round_trip(&[
            DepthRange::Whole,
            DepthRange::Near,
            DepthRange::Far,
            DepthRange::Part,
        ]);
        round_trip(&[DepthState::On, DepthState::Off, DepthState::TestOnly]);
    }
}
