//! The results of the cases: verdicts, table, CSV.

use crate::bench::error::BenchError;
use crate::bench::table::columns;
use serde::Serialize;
use std::fmt::Write;
use std::path::Path;

/// Whether a bound holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// It holds.
    Held,
    /// It is missed.
    Missed,
    /// There is nothing to measure; the note says why.
    NotYet,
}

/// One bound of one case under one configuration.
#[derive(Clone, Debug, Serialize)]
pub struct Outcome {
    /// Name of the case.
    pub case: &'static str,
    /// Name of the configuration; empty where the case has none.
    pub strategy: &'static str,
    /// The measured value, in its unit.
    pub unit: &'static str,
    /// The largest value, inclusive.
    pub bound: Option<f64>,
    /// The worst of all views. None where it is infinite: nothing to measure was found.
    pub measured: Option<f64>,
    /// Whether it holds.
    pub verdict: Verdict,
    /// Why there is nothing to measure, or which draws fell back to another strategy and why.
    pub note: String,
}

impl Outcome {
    fn cells(&self) -> Vec<String> {
        let number = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), short);
        let verdict = match self.verdict {
            Verdict::Held => "held",
            Verdict::Missed => "missed",
            Verdict::NotYet => "not yet",
        };
        let words = [self.case, self.strategy].map(str::to_owned);
        let numbers = [number(self.bound), number(self.measured)];
        let rest = [self.unit, verdict, &self.note].map(str::to_owned);
        words.into_iter().chain(numbers).chain(rest).collect()
    }
}

/// Four significant digits, at most four decimals.
fn short(value: f64) -> String {
    let digits = if value >= 100.0 { 1 } else { 4 };
    let text = format!("{value:.digits$}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The table, and how many bounds hold.
#[must_use]
pub fn text(outcomes: &[Outcome]) -> String {
    let head = [
        "case", "strategy", "bound", "measured", "of", "verdict", "note",
    ];
    let mut lines = vec![head.map(str::to_owned).to_vec()];
    lines.extend(outcomes.iter().map(Outcome::cells));
    let mut text = columns(&lines);
    let count = |verdict| outcomes.iter().filter(|o| o.verdict == verdict).count();
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "\n{} held, {} missed, {} not yet",
        count(Verdict::Held),
        count(Verdict::Missed),
        count(Verdict::NotYet)
    );
    text
}

/// Writes one line for each bound.
///
/// # Errors
/// If the file cannot be written.
pub fn write_csv(outcomes: &[Outcome], file: &Path) -> Result<(), BenchError> {
    let bad = |error: csv::Error| BenchError::Write {
        file: file.to_owned(),
        reason: error.to_string(),
    };
    let mut csv = csv::Writer::from_path(file).map_err(bad)?;
    for outcome in outcomes {
        csv.serialize(outcome).map_err(bad)?;
    }
    csv.flush().map_err(|error| bad(error.into()))
}
