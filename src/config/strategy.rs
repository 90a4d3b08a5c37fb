//! Strategies: which views are drawn, and which are synthesised.
#![forbid(unsafe_code)]

use super::choice::choice;
use super::{Config, ConfigError, OptionId, Settings};

const STRATEGIES: &[(&str, Strategy)] = &[
    ("auto", Strategy::Auto),
    ("replay", Strategy::Replay),
    ("instanced", Strategy::Instanced),
    ("geometry", Strategy::Geometry),
    ("depth-image", Strategy::DepthImage),
    ("occlusion", Strategy::Occlusion),
    ("hybrid", Strategy::Hybrid),
];

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

/// Frames per second unless others are asked for: the rate of most screens.
const RATE: f64 = 60.0;

impl Strategy {
    /// None where all views are drawn.
    #[must_use]
    pub fn disocclusion_source(self) -> Option<DisocclusionSource> {
        match self {
            Strategy::DepthImage => Some(DisocclusionSource::Nothing),
            Strategy::Occlusion => Some(DisocclusionSource::Reference),
            Strategy::Hybrid => Some(DisocclusionSource::Views),
            Strategy::Auto | Strategy::Replay | Strategy::Instanced | Strategy::Geometry => None,
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

pub(super) fn chosen(settings: &Settings) -> Result<Strategy, ConfigError> {
    let given = choice(settings, OptionId::Strategy, STRATEGIES)?;
    Ok(given.unwrap_or(Strategy::Auto))
}

pub(super) fn true_views(
    settings: &Settings,
    strategy: Strategy,
    views: u32,
) -> Result<TrueViews, ConfigError> {
    let count = settings.field(OptionId::TrueViews);
    let rate = settings.field(OptionId::Fps);
    let given = count.as_ref().or(rate.as_ref()).map(|(field, _)| field);
    if let (Some(field), false) = (given, strategy == Strategy::Hybrid) {
        return Err(ConfigError::NotHybrid {
            field: field.clone(),
            remedy: field.sibling(OptionId::Strategy),
        });
    }
    match (count, rate) {
        (Some((count, _)), Some((rate, _))) => Err(ConfigError::TrueViewsAndRate { count, rate }),
        (Some((field, value)), None) => match value.parse() {
            Ok(count) if (1..=views).contains(&count) => Ok(TrueViews::Fixed(count)),
            _ => Err(ConfigError::TrueViews {
                field,
                value: value.to_owned(),
                views,
            }),
        },
        (None, Some((field, value))) => match value.parse() {
            Ok(rate) if (1.0..=1000.0).contains(&rate) => Ok(TrueViews::Rate(rate)),
            _ => Err(ConfigError::Rate {
                field,
                value: value.to_owned(),
            }),
        },
        (None, None) => Ok(TrueViews::Rate(RATE)),
    }
}
