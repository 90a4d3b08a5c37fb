//! Disparities between neighbouring views, frame by frame.

use serde::Serialize;
use std::collections::VecDeque;

/// Number of frames whose cameras the report lists.
const LISTED: usize = 600;
/// Frames kept for medians.
const KEPT: usize = 4096;

/// The disparities of one frame. They are in pixels of the window, positive behind the panel.
#[derive(Clone, Copy, Debug)]
pub struct Disparity {
    /// Which frame, counted from 1.
    pub frame: u64,
    /// Separation and convergence that the frame was drawn with.
    pub cameras: (f64, f64),
    /// Of the nearest point.
    pub least: f64,
    /// Of the point at the median of 1/w.
    pub middle: f64,
    /// Of the farthest point.
    pub most: f64,
    /// The budget of the display.
    pub budget: f64,
    /// Millimetres per pixel.
    pub mm_per_px: Option<f64>,
    /// 1/w of the nearest and the farthest point of the scene.
    pub ends: [f64; 2],
    /// Pixels per unit of normalised device coordinates.
    pub px: f64,
}

impl Disparity {
    /// The disparities of the scene's ends under other cameras.
    fn under(&self, (separation, convergence): (f64, f64)) -> [f64; 2] {
        let at = |inverse: f64| separation * (1.0 - convergence * inverse) * self.px;
        self.ends.map(at)
    }
}

/// All frames of a program.
#[derive(Debug, Default)]
pub(super) struct Disparities {
    frames: u64,
    over: u64,
    least: f64,
    most: f64,
    middles: Vec<f64>,
    changes: Vec<f64>,
    budget: f64,
    mm_per_px: Option<f64>,
    last: Option<Disparity>,
    listed: VecDeque<Listed>,
}

#[derive(Debug, Serialize)]
struct Listed {
    frame: u64,
    separation: f64,
    convergence: f64,
    px: [f64; 3],
}

#[derive(Serialize)]
pub(super) struct Json<'a> {
    budget_px: f64,
    budget_mm: Option<f64>,
    px: Summary,
    mm: Option<Summary>,
    frames: u64,
    frames_over_budget: u64,
    change_px: Changes,
    last_frames: &'a VecDeque<Listed>,
}

#[derive(Serialize)]
struct Summary {
    min: f64,
    median: f64,
    max: f64,
}

/// Change of the disparity of a point from one frame to the next, by the cameras alone; in pixels between neighbouring views.
#[derive(Serialize)]
struct Changes {
    median: f64,
    p95: f64,
    max: f64,
}

impl Disparities {
    pub(super) fn add(&mut self, d: Disparity) {
        if self.frames == 0 {
            (self.least, self.most) = (d.least, d.most);
        }
        self.least = self.least.min(d.least);
        self.most = self.most.max(d.most);
        self.over += u64::from(d.least.abs().max(d.most.abs()) > d.budget);
        (self.budget, self.mm_per_px) = (d.budget, d.mm_per_px);
        keep(&mut self.middles, self.frames, d.middle);
        // The step from zero separation to the first cameras does not count as a change.
        if let Some(last) = self.last.filter(|last| last.cameras.0 != 0.0) {
            let (before, now) = (d.under(last.cameras), d.under(d.cameras));
            let moved = before.iter().zip(now).map(|(b, n)| (b - n).abs());
            keep(&mut self.changes, self.frames, moved.fold(0.0, f64::max));
        }
        if self.listed.len() == LISTED {
            self.listed.pop_front();
        }
        self.listed.push_back(Listed {
            frame: d.frame,
            separation: d.cameras.0,
            convergence: d.cameras.1,
            px: [d.least, d.middle, d.most],
        });
        self.last = Some(d);
        self.frames += 1;
    }

    pub(super) fn json(&self) -> Option<Json<'_>> {
        self.last?;
        let px = Summary {
            min: self.least,
            median: part(&self.middles, 0.5),
            max: self.most,
        };
        Some(Json {
            budget_px: self.budget,
            budget_mm: self.mm_per_px.map(|mm| mm * self.budget),
            mm: self.mm_per_px.map(|mm| Summary {
                min: px.min * mm,
                median: px.median * mm,
                max: px.max * mm,
            }),
            px,
            frames: self.frames,
            frames_over_budget: self.over,
            change_px: Changes {
                median: part(&self.changes, 0.5),
                p95: part(&self.changes, 0.95),
                max: part(&self.changes, 1.0),
            },
            last_frames: &self.listed,
        })
    }
}

fn keep(values: &mut Vec<f64>, frame: u64, value: f64) {
    if values.len() < KEPT {
        values.push(value);
    } else if let Some(slot) = values.get_mut(frame as usize % KEPT) {
        *slot = value;
    }
}

/// The quantile at `part`, from 0 to 1; 0 without values.
fn part(values: &[f64], part: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let at = (sorted.len().max(1) - 1) as f64 * part;
    sorted.get(at as usize).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(cameras: (f64, f64), least: f64, most: f64) -> Disparity {
        Disparity {
            frame: 1,
            cameras,
            least,
            middle: (least + most) / 2.0,
            most,
            budget: 1.5,
            mm_per_px: Some(0.1),
            ends: [0.5, 0.1],
            px: 100.0,
        }
    }

    #[test]
    fn frames_are_summed_up() {
        let mut all = Disparities::default();
        assert!(all.json().is_none());
        all.add(frame((0.0, 0.0), 0.0, 0.0));
        all.add(frame((0.02, 4.0), -1.0, 1.0));
        all.add(frame((0.02, 4.0), -2.0, 1.2));
        all.add(frame((0.03, 4.0), -1.0, 1.0));
        let json = all.json().unwrap();
        assert_eq!((json.px.min, json.px.max, json.px.median), (-2.0, 1.2, 0.0));
        assert_eq!((json.frames, json.frames_over_budget), (4, 1));
        assert!((json.mm.unwrap().min + 0.2).abs() < 1e-12);
        // From 0.02 to 0.03: 0.01·(1 − 4·0.5)·100 = −1 px for the nearest, 0.6 px for the farthest point.
        assert!((json.change_px.max - 1.0).abs() < 1e-9 && json.change_px.median == 0.0);
    }
}
