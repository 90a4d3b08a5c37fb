//! The report of the layer, for `--report`.
#![forbid(unsafe_code)]

mod counts;
mod disparity;
mod frames;
mod proof;
mod true_views;

pub use counts::Counts;
pub use disparity::Disparity;
pub use proof::{Culprit, Difference, Found, Proof, SpeedUp, Summary, Worst};

use crate::claim::Claims;
use crate::config::{Config, Status, replace};
use crate::gl::Count;
use disparity::Disparities;
use frames::{FrameTimes, Frames, Synthesised};
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// Notes that are kept.
const MOST_NOTES: usize = 100;

/// Counts of one program; written as JSON while it runs.
#[derive(Debug, Default)]
pub struct Report {
    frames: Frames,
    /// By method and class.
    draws: Counts<(&'static str, &'static str)>,
    fallbacks: BTreeMap<String, u64>,
    notes: Vec<String>,
    errors: u64,
    shaders: u64,
    bytes: u64,
    disparities: Disparities,
    /// The proof, if one is asked for.
    pub proof: Option<Proof>,
    names: Names,
    last_write: Option<Instant>,
    /// Which of the user's paths are this process's.
    pub claims: Claims,
}

/// GL names of the layer that are not deleted.
#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Names {
    #[serde(flatten)]
    made: Count,
    lists: u32,
}

/// The JSON file. More than 12 fields: one for each member.
#[derive(Serialize)]
struct Json<'a> {
    frames: u64,
    frames_drawn_once: u64,
    #[serde(skip_serializing_if = "Synthesised::is_none")]
    frames_synthesised: Synthesised,
    /// Milliseconds and number of views drawn, for each of the last frames.
    #[serde(skip_serializing_if = "Option::is_none")]
    true_views: Option<Vec<(f32, u32)>>,
    frame_ms: FrameTimes,
    draws: BTreeMap<&'static str, u64>,
    classes: BTreeMap<&'static str, u64>,
    fallbacks: &'a BTreeMap<String, u64>,
    generated_shaders: u64,
    gl_errors: u64,
    view_bytes: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    disparity: Option<disparity::Json<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    proof: Option<Summary>,
    names: Names,
    notes: &'a [String],
}

impl Report {
    /// Counts a draw by its method and its class.
    #[inline]
    pub fn draw(&mut self, method: &'static str, class: &'static str) {
        self.draws.add((method, class));
    }

    /// Counts draws that were replayed although another strategy was asked for.
    pub fn fallbacks(&mut self, reason: &dyn std::fmt::Display, count: u64) {
        *self.fallbacks.entry(reason.to_string()).or_default() += count;
    }

    /// Adds a note for the user, unless it is there already, or there are too many to be read.
    pub fn note(&mut self, text: String) {
        match self.notes.len() {
            count if count > MOST_NOTES || self.notes.contains(&text) => {}
            MOST_NOTES => self.notes.push("further notes are left out".to_owned()),
            _ => self.notes.push(text),
        }
    }

    /// Counts a GL error that the layer's own set-up raised.
    pub fn error(&mut self) {
        self.errors += 1;
    }

    /// Sets the number of programs that were generated and compiled so far.
    pub fn shaders(&mut self, programs: u64) {
        self.shaders = programs;
    }

    /// Sets the memory of the views' colour, depth and stencil, in bytes.
    pub fn memory(&mut self, bytes: u64) {
        self.bytes = bytes;
    }

    /// Sets the number of GL names that the layer holds in this context; `lists` is that of its share group.
    pub fn names(&mut self, made: Count, lists: u32) {
        self.names = Names { made, lists };
    }

    /// Adds the disparities of a frame.
    pub fn disparity(&mut self, disparity: Disparity) {
        self.disparities.add(disparity);
    }

    /// Counts a frame that is the same in all views and was drawn in one.
    pub fn mono_frame(&mut self) {
        self.frames.mono += 1;
    }

    /// Counts a frame whose views were synthesised, whole or directly into the panel's picture.
    pub fn synthesised(&mut self, into_panel: bool) {
        self.frames.synthesised.count(into_panel);
    }

    /// Frames shown so far.
    pub fn frames(&self) -> u64 {
        self.frames.shown
    }

    /// Takes over what another context has drawn for the frames of this one: its draws, the reasons of those that were replayed, its notes and
    /// its errors.
    pub fn absorb(&mut self, other: &mut Report) {
        for (what, count) in other.draws.take() {
            self.draws.add_many(what, count);
        }
        for (reason, count) in std::mem::take(&mut other.fallbacks) {
            *self.fallbacks.entry(reason).or_default() += count;
        }
        for note in std::mem::take(&mut other.notes) {
            self.note(note);
        }
        self.errors += std::mem::take(&mut other.errors);
    }

    /// Counts a frame that was shown; returns the milliseconds since the one before.
    pub fn frame(&mut self) -> Option<f32> {
        self.frames.show()
    }

    /// Notes the time of a frame in milliseconds, and the number of views that were drawn in it.
    pub fn drew(&mut self, ms: f32, views: u32) {
        self.frames.true_views.frame(ms, views);
    }

    /// After a frame: writes the report, and the status where frames are captured, if they are due. They are after each of the first 10
    /// frames, then ten times a second, because a program may end without notice.
    pub fn write_if_due(&mut self, config: &Config) {
        let since = self.last_write.map(|last| last.elapsed());
        let due =
            self.frames.shown <= 10 || since.is_none_or(|since| since > Duration::from_millis(100));
        if !due {
            return;
        }
        self.last_write = Some(Instant::now());
        // In a proof, the context that has proved a frame writes the status.
        if config.capture.is_some() {
            self.write_status(config, self.frames.shown);
        }
        self.write_report(config);
    }

    /// Writes the status, which tells the launcher how many frames there are, and the report of this frame. The launcher ends the program
    /// after the last frame that it wants.
    pub fn write(&mut self, config: &Config, frames: u64) {
        self.last_write = Some(Instant::now());
        self.write_status(config, frames);
        self.write_report(config);
    }

    /// Writes the status. A file that cannot be written must not disturb the program; the launcher has checked the folders.
    fn write_status(&mut self, config: &Config, frames: u64) {
        if let Some(path) = &config.status {
            let path = self.claims.path(config, path, path.clone());
            let proof = self.proof.as_ref().map(Proof::summary);
            let status = Status {
                frames,
                notes: self.notes.clone(),
                proof: proof.and_then(|proof| serde_json::to_value(proof).ok()),
            };
            let _ = status.write(&path);
        }
    }

    /// Writes the report, and ignores errors likewise.
    fn write_report(&mut self, config: &Config) {
        if let Some(path) = &config.report {
            let path = self.claims.path(config, path, path.clone());
            let _ = replace(&path, self.json().as_bytes());
        }
    }

    /// The report as JSON.
    pub fn json(&self) -> String {
        let json = Json {
            frames: self.frames.shown,
            frames_drawn_once: self.frames.mono,
            frames_synthesised: self.frames.synthesised,
            true_views: self.frames.true_views.json(),
            frame_ms: self.frames.times(),
            draws: self.draws.named(|(method, _)| method),
            classes: self.draws.named(|(_, class)| class),
            fallbacks: &self.fallbacks,
            generated_shaders: self.shaders,
            gl_errors: self.errors,
            view_bytes: self.bytes,
            disparity: self.disparities.json(),
            proof: self.proof.as_ref().map(Proof::summary),
            names: self.names,
            notes: &self.notes,
        };
        serde_json::to_string_pretty(&json).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_note_is_kept_once_and_a_hundred_of_them_are_enough() {
        let mut report = Report::default();
        for number in (0..1000).chain(0..1000) {
            report.note(format!("capture of frame {number} has failed"));
        }
        assert_eq!(report.notes.len(), MOST_NOTES + 1);
        assert_eq!(report.notes[MOST_NOTES], "further notes are left out");
    }
}
