//! How views come about: drawn, or made of others, and how many are drawn then.
#![forbid(unsafe_code)]

use super::parse::choice;
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

/// How views come about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strategy {
    /// The one that draws the program fastest.
    Auto,
    /// The draw itself again, per view.
    Replay,
    /// One instanced draw with a generated vertex shader.
    Instanced,
    /// One draw through a generated geometry shader.
    Geometry,
    /// The scene once, and the other views by its depths.
    DepthImage,
    /// The same, with what an occlusion camera sees behind what is in front.
    Occlusion,
    /// The scene in some views, and the others by the depths of those beside them.
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

/// What is known of what the view hides that another one is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DisocclusionSource {
    /// What is behind it beside it.
    Nothing,
    /// The reference image of an occlusion camera.
    Reference,
    /// What other views that are drawn see.
    Views,
}

/// How many views `--strategy hybrid` draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TrueViews {
    /// Always as many, at least 1.
    Fixed(u32),
    /// As many as leave so many frames per second.
    Rate(f64),
}

/// Frames per second that are held unless others are asked for: those of most screens.
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
    /// Of what views are made instead of drawn; none where they are all drawn.
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
