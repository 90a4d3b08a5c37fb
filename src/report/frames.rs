//! Frames: their number by kind, and their times.

use super::true_views::TrueViews;
use serde::Serialize;
use std::time::Instant;

/// Frame times kept for the median.
const KEPT: usize = 4096;

/// The frames of one context.
#[derive(Debug, Default)]
pub(super) struct Frames {
    /// Frames shown.
    pub(super) shown: u64,
    /// Number of those that are the same in all views.
    pub(super) mono: u64,
    /// Number of those whose views were synthesised.
    pub(super) synthesised: Synthesised,
    /// Time and number of true views of each of the last ones.
    pub(super) true_views: TrueViews,
    /// Milliseconds of the last ones, in any order.
    times: Vec<f32>,
    last: Option<Instant>,
}

/// Number of frames whose scene was drawn in some views, from which the others were synthesised.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(super) struct Synthesised {
    /// Synthesised subpixel by subpixel, directly into the panel's picture.
    into_panel: u64,
    /// Synthesised as whole views.
    into_tiles: u64,
}

impl Synthesised {
    pub(super) fn is_none(&self) -> bool {
        self.into_panel == 0 && self.into_tiles == 0
    }

    pub(super) fn count(&mut self, into_panel: bool) {
        match into_panel {
            true => self.into_panel += 1,
            false => self.into_tiles += 1,
        }
    }
}

/// Milliseconds of a frame.
#[derive(Serialize)]
pub(super) struct FrameTimes {
    median: f32,
    p95: f32,
}

impl Frames {
    /// Counts a frame that was shown; returns the milliseconds since the one before.
    pub(super) fn show(&mut self) -> Option<f32> {
        let now = Instant::now();
        let ms = self
            .last
            .map(|last| now.duration_since(last).as_secs_f32() * 1e3);
        if let Some(ms) = ms {
            if self.times.len() < KEPT {
                self.times.push(ms);
            } else if let Some(slot) = self.times.get_mut(self.shown as usize % KEPT) {
                *slot = ms;
            }
        }
        self.last = Some(now);
        self.shown += 1;
        ms
    }

    /// Median and 95th percentile, 0 before there are two frames.
    pub(super) fn times(&self) -> FrameTimes {
        let mut sorted = self.times.clone();
        sorted.sort_by(f32::total_cmp);
        let at = |q: f64| {
            sorted
                .get(((sorted.len().max(1) - 1) as f64 * q) as usize)
                .copied()
                .unwrap_or(0.0)
        };
        FrameTimes {
            median: at(0.5),
            p95: at(0.95),
        }
    }
}
