//! The measurements of `manyview bench` and their presentation: scenes, configurations, presets, statistics, tables, charts.
//!
//! Pure: nothing here starts a program. [`crate::launch::Stepped`] does, and the command puts the two together: it keeps the bare
//! program and the program under each configuration alive side by side and lets them draw in turns.
#![forbid(unsafe_code)]

pub mod chart;
mod configuration;
pub mod disocclusion;
mod error;
pub mod hard;
mod outcome;
mod pareto;
mod preset;
pub mod proof;
pub mod protocol;
mod scene;
pub mod splats;
mod statistics;
pub mod table;
pub mod walk;

pub use configuration::{
    AUTO, CONFIGURATIONS, Configuration, DEFAULT_CONFIGURATIONS, EXACT, Variant,
};
pub use error::BenchError;
pub use outcome::{Bench, Limit, Paper, PictureError, Row};
pub use pareto::front;
pub use preset::{Figure, PRESETS, Preset};
pub use proof::{ProofRow, Proofs};
pub use scene::{DEFAULT_SCENES, SCENES, Scene, Work};
pub use statistics::{Spread, median, ratios};

/// Finds rows of a table by names that a user gave; `option` is where.
pub fn find<'a, T>(
    table: &'a [T],
    name: impl Fn(&T) -> &str,
    option: &'static str,
    given: &str,
) -> Result<&'a T, BenchError> {
    let found = table.iter().find(|row| name(row) == given);
    found.ok_or_else(|| BenchError::Unknown {
        option,
        value: given.to_owned(),
        known: table.iter().map(&name).collect::<Vec<_>>().join(", "),
    })
}
