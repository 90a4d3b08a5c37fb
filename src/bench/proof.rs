//! The results of `--prove` as text; and the rows of `manyview bench -- APP`, one for each configuration.

use super::error::BenchError;
use super::table::columns;
use crate::report::{Found, Summary};
use serde::Serialize;
use std::fmt::Write;
use std::path::Path;

/// The table of one run: views, picture, speed-up, the draw that caused the worst pixel, the frames that were not compared.
#[must_use]
pub fn text(proof: &Summary) -> String {
    let mut text = format!(
        "proof: {} frames compared with replay at the size of the window, {} of them differ ({})\n",
        proof.frames,
        proof.differing,
        proof.verdict()
    );
    // Writing to a String cannot fail.
    let _ = match &proof.speed_up {
        Some(s) => writeln!(
            text,
            "speed-up over replay: {:.2} ({:.2} ms a frame against {:.2}, medians of {} and {} frames)",
            s.times, s.chosen_ms, s.replay_ms, s.frames[0], s.frames[1]
        ),
        None => writeln!(
            text,
            "speed-up over replay: not measured, for want of frames between those compared"
        ),
    };
    let named = (0..)
        .zip(&proof.views)
        .map(|(view, found)| (format!("view {view}"), found.as_ref()))
        .chain([("picture".to_owned(), proof.panel.as_ref())]);
    let mut lines = vec![
        ["", "differing", "%", "PSNR", "worst", "x", "y", "frame"]
            .map(str::to_owned)
            .to_vec(),
    ];
    lines.extend(named.filter_map(|(name, found)| Some(cells(name, found?))));
    if lines.len() > 1 {
        text.push_str(&columns(&lines));
    }
    if let Some(draw) = &proof.draw {
        let list = draw
            .list
            .map_or_else(String::new, |l| format!(", list {l}"));
        let _ = writeln!(
            text,
            "the worst pixel of frame {} (view {}, {} {}, by {}) came with draw {}: {}, {}, texture {}{list}, by {}",
            draw.worst.frame,
            draw.view,
            draw.worst.x,
            draw.worst.y,
            draw.worst.difference,
            draw.draw,
            draw.kind,
            draw.class,
            draw.texture,
            draw.method
        );
    }
    if proof.carried > 0 {
        let _ = writeln!(
            text,
            "{} frames did not begin with a clear: what stood in the window before is not compared",
            proof.carried
        );
    }
    for (reason, frames) in &proof.skipped {
        let _ = writeln!(text, "{frames} frames not compared: {reason}");
    }
    if let Some(picture) = &proof.picture {
        let _ = writeln!(text, "the worst view: {picture}");
    }
    text
}

fn decibels(psnr: Option<f64>) -> String {
    psnr.map_or_else(|| "exact".to_owned(), |psnr| format!("{psnr:.1}"))
}

fn cells(name: String, found: &Found) -> Vec<String> {
    let worst = found.worst.unwrap_or_default();
    let place = |number: u64| found.worst.map_or_else(String::new, |_| number.to_string());
    vec![
        name,
        found.differing.to_string(),
        format!("{:.3}", percent(found)),
        decibels(found.psnr),
        worst.difference.to_string(),
        place(worst.x.into()),
        place(worst.y.into()),
        place(worst.frame),
    ]
}

fn percent(found: &Found) -> f64 {
    100.0 * found.differing as f64 / found.pixels.max(1) as f64
}

/// One program under several configurations.
#[derive(Debug, Serialize)]
pub struct Proofs {
    /// When it began, UTC.
    pub date: String,
    /// The program and its arguments.
    pub command: Vec<String>,
    /// One for each configuration.
    pub rows: Vec<ProofRow>,
}

/// One configuration.
#[derive(Debug, Serialize)]
pub struct ProofRow {
    /// Its name, with the scale of the views if that is not 1.
    pub configuration: String,
    /// [`Summary::verdict`].
    pub verdict: &'static str,
    /// The results.
    pub proof: Summary,
    /// Notes of the layer.
    pub notes: Vec<String>,
}

impl Proofs {
    /// The table, and the notes to single rows.
    #[must_use]
    pub fn text(&self) -> String {
        let head = [
            "configuration",
            "speed-up",
            "ms",
            "replay ms",
            "frames",
            "differing",
            "wrong %",
            "PSNR",
            "worst",
            "picture PSNR",
            "verdict",
        ];
        let mut lines = vec![head.map(str::to_owned).to_vec()];
        lines.extend(self.rows.iter().map(ProofRow::cells));
        let mut text = columns(&lines);
        for row in &self.rows {
            let skipped = row.proof.skipped.iter();
            for (reason, frames) in skipped {
                let _ = writeln!(
                    text,
                    "* {}: {frames} frames not compared: {reason}",
                    row.configuration
                );
            }
            if let Some(draw) = &row.proof.draw {
                let _ = writeln!(
                    text,
                    "* {}: the worst pixel of frame {} came with draw {}: {}, {}, by {}",
                    row.configuration,
                    draw.worst.frame,
                    draw.draw,
                    draw.kind,
                    draw.class,
                    draw.method
                );
            }
            for note in &row.notes {
                let _ = writeln!(text, "* {}: {note}", row.configuration);
            }
        }
        text
    }

    /// Writes one line for each row.
    pub fn write_csv(&self, file: &Path) -> Result<(), BenchError> {
        let failed = |error: csv::Error| BenchError::Write {
            file: file.to_owned(),
            reason: error.to_string(),
        };
        let mut writer = csv::Writer::from_path(file).map_err(failed)?;
        for row in &self.rows {
            let proof = &row.proof;
            let speed_up = proof.speed_up.as_ref();
            writer
                .serialize(Line {
                    configuration: &row.configuration,
                    speed_up: speed_up.map(|s| s.times),
                    ms: speed_up.map(|s| s.chosen_ms),
                    replay_ms: speed_up.map(|s| s.replay_ms),
                    frames: proof.frames,
                    differing_frames: proof.differing,
                    wrong_percent: row.wrong(),
                    psnr: proof.psnr(),
                    worst: row.worst(),
                    picture_psnr: proof.panel.as_ref().and_then(|panel| panel.psnr),
                    verdict: row.verdict,
                })
                .map_err(failed)?;
        }
        writer.flush().map_err(|error| failed(error.into()))
    }
}

#[derive(Serialize)]
struct Line<'a> {
    configuration: &'a str,
    speed_up: Option<f64>,
    ms: Option<f64>,
    replay_ms: Option<f64>,
    frames: u64,
    differing_frames: u64,
    wrong_percent: f64,
    psnr: Option<f64>,
    worst: u8,
    picture_psnr: Option<f64>,
    verdict: &'a str,
}

impl ProofRow {
    /// Wrong pixels of the worst view, per cent.
    fn wrong(&self) -> f64 {
        self.proof.found().map(percent).fold(0.0, f64::max)
    }

    /// Largest difference, steps of 255.
    fn worst(&self) -> u8 {
        let worst = self.proof.found().filter_map(|found| found.worst);
        worst.map(|worst| worst.difference).max().unwrap_or(0)
    }

    fn cells(&self) -> Vec<String> {
        let proof = &self.proof;
        let time = |value: Option<f64>| value.map_or_else(|| "?".to_owned(), |v| format!("{v:.2}"));
        let speed_up = proof.speed_up.as_ref();
        let compared = |cell: String| {
            if proof.frames > 0 {
                cell
            } else {
                String::new()
            }
        };
        vec![
            self.configuration.clone(),
            time(speed_up.map(|s| s.times)),
            time(speed_up.map(|s| s.chosen_ms)),
            time(speed_up.map(|s| s.replay_ms)),
            proof.frames.to_string(),
            proof.differing.to_string(),
            compared(format!("{:.3}", self.wrong())),
            compared(decibels(proof.psnr())),
            compared(self.worst().to_string()),
            proof
                .panel
                .as_ref()
                .map_or_else(String::new, |panel| decibels(panel.psnr)),
            self.verdict.to_owned(),
        ]
    }
}
