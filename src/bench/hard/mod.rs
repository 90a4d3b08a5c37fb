//! The hard cases: scenes that are most likely to go wrong in several views, each with a bound on the error.
//!
//! Pure: the table, the measurements of pictures, the verdicts. The command draws, and `tests/hard.rs` asserts the verdicts.

mod cases;
pub mod measure;
mod outcome;

use super::configuration::{CONFIGURATIONS, Configuration};
use crate::config::OptionId;
pub use cases::{CASES, MISSES};
pub use outcome::{Outcome, Verdict, text, write_csv};

/// A scene and its bound.
#[derive(Debug)]
pub struct Case {
    /// For `--case`.
    pub name: &'static str,
    /// Why it is hard.
    pub about: &'static str,
    /// What is drawn.
    pub subject: Subject,
    /// The bound.
    pub bounds: &'static [Bound],
    /// The source of the number.
    pub source: &'static str,
}

/// The quantity that a case measures.
#[derive(Debug)]
pub enum Subject {
    /// A scene of the program `hard`.
    Scene {
        /// Its `--case`.
        scene: &'static str,
        /// N
        views: u32,
        /// κ and ξ.
        cameras: [&'static str; 2],
        /// More options of the layer.
        options: &'static [(OptionId, &'static str)],
    },
    /// The mask of a panel of 7680 x 4320 pixels, without any strategy.
    Mask,
    /// Not measured yet, and why.
    NotYet(&'static str),
}

/// A bound that is known to be missed.
#[derive(Debug)]
pub struct Miss {
    /// Name of the case.
    pub case: &'static str,
    /// Names of the configurations.
    pub strategies: &'static [&'static str],
    /// The reason.
    pub why: &'static str,
}

/// The reason for a missed bound, where it is known.
#[must_use]
pub fn why(case: &str, strategy: &str) -> Option<&'static str> {
    let miss = MISSES
        .iter()
        .find(|miss| miss.case == case && miss.strategies.contains(&strategy));
    miss.map(|miss| miss.why)
}

/// A quantity and its largest value.
#[derive(Clone, Copy, Debug)]
pub struct Bound {
    /// The measured value, the worst of all views.
    pub measure: Measure,
    /// Inclusive. Replay into layers makes the program's own calls, so its pictures have to be equal (0).
    pub most: f64,
    /// The same where views lie side by side, so that their vertices round at another place.
    pub side_by_side: f64,
}

/// A quantity. The oracle is the scene's own picture of the view in fixed function, drawn at the place of the layer's view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Pixels that differ from the oracle's, %.
    Differing,
    /// Steps of 255 by which a pixel is off every pixel of the oracle's within one pixel of it: edges may be rounded, colours may not.
    Steps,
    /// Pixels that are more than 8 steps off every pixel of the oracle's within one pixel: leaks and wrong draws.
    Foreign,
    /// Distance of the centre of a marker from its place by the equation of the cameras, pixels.
    Place,
    /// Mean distance of the edges of areas of one colour from the oracle's, pixels.
    Edge,
    /// Pixels that differ from the bare program's own picture, %.
    Same,
    /// Pixels that a second pass has missed: they are still red.
    Missed,
    /// Difference of the green area from the oracle's, %.
    Area,
    /// Difference of the level of detail from the window's.
    Level,
    /// Lines of answers that differ from the bare program's.
    Answers,
    /// Subpixels of the mask whose view differs from that of integer arithmetic, %.
    Mask,
}

impl Measure {
    /// In a table.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Differing => "% of pixels",
            Self::Steps => "steps of 255",
            Self::Foreign => "wrong pixels",
            Self::Place => "px of place",
            Self::Edge => "px of edges",
            Self::Same => "% not the same",
            Self::Missed => "missed pixels",
            Self::Area => "% of area",
            Self::Level => "levels",
            Self::Answers => "answers",
            Self::Mask => "% of subpixels",
        }
    }

    /// Whether it compares with the program's own picture of the view, which replay has to equal bit by bit.
    fn of_oracle(self) -> bool {
        matches!(
            self,
            Self::Differing | Self::Steps | Self::Foreign | Self::Edge | Self::Area
        )
    }
}

impl Bound {
    /// The largest value under a configuration.
    #[must_use]
    pub fn under(&self, configuration: &Configuration, options: &[(OptionId, &str)]) -> f64 {
        let full = !options.iter().any(|(id, _)| *id == OptionId::ViewScale);
        if full && self.measure.of_oracle() && replays(configuration) {
            0.0
        } else if side_by_side(configuration) {
            self.side_by_side
        } else {
            self.most
        }
    }
}

fn value(configuration: &Configuration, id: OptionId) -> Option<&'static str> {
    let mut options = configuration.options.iter();
    options.find(|(of, _)| *of == id).map(|(_, value)| *value)
}

fn replays(configuration: &Configuration) -> bool {
    value(configuration, OptionId::Strategy) == Some("replay")
}

/// Whether the views lie side by side: by default with replay, and on request with strategies that draw all views at once.
#[must_use]
pub fn side_by_side(configuration: &Configuration) -> bool {
    if replays(configuration) {
        value(configuration, OptionId::Atlas) != Some("layers")
    } else {
        value(configuration, OptionId::Clip).is_some()
    }
}

/// The configurations of `manyview bench --hard` without `--strategy`: every exact strategy in every layout that it has.
pub fn configurations() -> impl Iterator<Item = &'static Configuration> {
    // `auto` is one of the others; strategies that draw all views at once use layers by default; and the bounds are those of exact
    // strategies.
    let twice = [
        "auto",
        "depth-image",
        "occlusion",
        "hybrid-2",
        "hybrid-3",
        "hybrid-4",
        "hybrid-1-drawn",
        "hybrid-2-drawn",
        "instanced-layers",
        "geometry-layers",
    ];
    CONFIGURATIONS
        .iter()
        .filter(move |known| !twice.contains(&known.name))
}
