//! Strategies: which views are drawn, and which are synthesised.
#![forbid(unsafe_code)]

use super::Config;
use super::words::words;

/// Strategies by their words.
pub(super) const STRATEGIES: &[(&str, Strategy)] = &[
    ("auto", Strategy::Auto),
    ("replay", Strategy::Replay),
    ("instanced", Strategy::Instanced),
    ("geometry", Strategy::Geometry),
    ("splats", Strategy::Splats),
    ("depth-image", Strategy::DepthImage),
    ("occlusion", Strategy::Occlusion),
    ("hybrid", Strategy::Hybrid),
];

/// The words alone.
pub(super) const WORDS: [&str; STRATEGIES.len()] = words(STRATEGIES, &[]);

/// How the views are drawn or synthesised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strategy {
    /// The exact strategy that draws the program fastest.
    Auto,
    /// The draw itself again, per view.
    Replay,
    /// One instanced draw with a generated vertex shader.
    Instanced,
    /// One draw through a generated geometry shader.
    Geometry,
    /// Points once for all views, straight into what a panel shows; everything else by replay.
    Splats,
    /// The scene in one view; the other views are synthesised from its depths.
    DepthImage,
    /// The same, with the reference image of an occlusion camera for the disocclusions.
    Occlusion,
    /// The scene in some views; the others are synthesised from those beside them.
    Hybrid,
}

impl Strategy {
    /// By its name.
    #[must_use]
    pub fn named(name: &str) -> Option<Strategy> {
        let all = STRATEGIES.iter();
        all.copied().find(|s| s.0 == name).map(|s| s.1)
    }
}

impl std::fmt::Display for Strategy {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let named = STRATEGIES.iter().find(|s| s.1 == *self);
        f.write_str(named.map_or("", |s| s.0))
    }
}

/// The source of colours for the disocclusions of a synthesised view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DisocclusionSource {
    /// The background beside them.
    Nothing,
    /// The reference image of an occlusion camera.
    Reference,
    /// The other views that are drawn.
    Views,
}

/// How many views `--strategy hybrid` draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TrueViews {
    /// A fixed number, at least 1.
    Fixed(u32),
    /// As many as allow these frames per second.
    Rate(f64),
}

/// How a draw is repeated for the views that are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repetition {
    /// The call once per view.
    Calls,
    /// Instances of one call.
    Instances,
    /// A geometry shader.
    GeometryShader,
}

impl Strategy {
    /// How the draws of a strategy are repeated. `auto` is in force as one of the others; views that are not synthesised are drawn by calls.
    #[must_use]
    pub fn repetition(self) -> Repetition {
        match self {
            Strategy::Instanced => Repetition::Instances,
            Strategy::Geometry => Repetition::GeometryShader,
            Strategy::Auto
            | Strategy::Replay
            | Strategy::Splats
            | Strategy::DepthImage
            | Strategy::Occlusion
            | Strategy::Hybrid => Repetition::Calls,
        }
    }

    /// None where all views are drawn.
    #[must_use]
    pub fn disocclusion_source(self) -> Option<DisocclusionSource> {
        match self {
            Strategy::DepthImage => Some(DisocclusionSource::Nothing),
            Strategy::Occlusion => Some(DisocclusionSource::Reference),
            Strategy::Hybrid => Some(DisocclusionSource::Views),
            Strategy::Auto
            | Strategy::Replay
            | Strategy::Instanced
            | Strategy::Geometry
            | Strategy::Splats => None,
        }
    }
}

impl Config {
    /// The source of disocclusions where views are synthesised; none where all are drawn.
    #[must_use]
    pub fn synthesis(&self) -> Option<DisocclusionSource> {
        self.strategy
            .disocclusion_source()
            .filter(|_| self.views > 1)
    }
}
