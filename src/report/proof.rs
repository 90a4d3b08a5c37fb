//! The results of `--prove`: how much the views and the picture differ from those of replay, and the time of replay.

use crate::metric::{Comparison, Gate};
use image::RgbImage;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Times of frames kept for the medians.
const KEPT: usize = 4096;

/// One picture against that of replay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    compared: Comparison,
    /// Column and row of the worst pixel, from the left and the top.
    at: [u32; 2],
}

impl Difference {
    /// Compares two pictures; `None` if they cannot be compared.
    pub fn new(exact: &RgbImage, shown: &RgbImage) -> Option<Self> {
        let compared = Comparison::new(exact, shown, None).ok()?;
        let (mut worst, mut at) = (0, [0; 2]);
        for ((x, y, a), b) in exact.enumerate_pixels().zip(shown.pixels()) {
            let difference = a.0.iter().zip(&b.0).map(|(a, b)| a.abs_diff(*b)).max();
            if difference > Some(worst) {
                (worst, at) = (difference.unwrap_or(worst), [x, y]);
            }
        }
        Some(Self { compared, at })
    }

    /// The largest difference of a channel, steps of 255.
    pub fn worst(&self) -> u8 {
        self.compared.worst
    }

    /// Column and row of the pixel that has it, from the left and the top.
    pub fn at(&self) -> [u32; 2] {
        self.at
    }

    /// Peak signal-to-noise ratio in dB; infinite for equal pictures.
    pub fn psnr(&self) -> f64 {
        self.compared.psnr
    }
}

/// A pixel that differs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Worst {
    /// Of the channel that differs most, steps of 255.
    pub difference: u8,
    /// Column, from the left.
    pub x: u32,
    /// Row, from the top.
    pub y: u32,
    /// Frame, counted from 1.
    pub frame: u64,
}

/// The result for one view, or for the picture of all views, over all proved frames.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Number of pixels in a frame.
    pub pixels: u64,
    /// Pixels that differ, in the frame where most do.
    pub differing: u64,
    /// Peak signal-to-noise ratio of the worst frame in dB; `None` if all frames are equal, as it is infinite then.
    pub psnr: Option<f64>,
    /// Every frame has passed [`Gate::DESIGN`].
    pub within_gate: bool,
    /// `None` if all frames are equal.
    pub worst: Option<Worst>,
}

impl Found {
    fn add(found: &mut Option<Self>, frame: u64, difference: &Difference) {
        let compared = &difference.compared;
        let found = found.get_or_insert(Self {
            pixels: compared.pixels,
            differing: 0,
            psnr: None,
            within_gate: true,
            worst: None,
        });
        found.pixels = compared.pixels;
        found.differing = found.differing.max(compared.differing);
        found.within_gate &= Gate::DESIGN.check(compared).is_ok();
        if compared.is_equal() {
            return;
        }
        found.psnr = Some(found.psnr.map_or(compared.psnr, |p| p.min(compared.psnr)));
        let [x, y] = difference.at;
        let worst = Worst {
            difference: compared.worst,
            x,
            y,
            frame,
        };
        if found.worst.is_none_or(|w| w.difference < worst.difference) {
            found.worst = Some(worst);
        }
    }
}

/// The draw after which a pixel differed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Culprit {
    /// The pixel.
    #[serde(flatten)]
    pub worst: Worst,
    /// Its view.
    pub view: u32,
    /// Number of the draw in its frame, from 1. Clears are not counted; a clear has the number of the draw before it.
    pub draw: u32,
    /// Command and primitive.
    pub kind: String,
    /// Its class.
    pub class: String,
    /// The method by which it was drawn.
    pub method: String,
    /// The texture that it samples, 0 for none.
    pub texture: u32,
    /// The display list that is called, if one is.
    pub list: Option<u32>,
}

/// The times of the chosen strategy and of replay. They are medians, from a frame's first draw to the end of glFinish after its
/// picture is made.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpeedUp {
    /// ms
    pub chosen_ms: f64,
    /// ms
    pub replay_ms: f64,
    /// `replay_ms / chosen_ms`
    pub times: f64,
    /// Number of frames that were timed by each.
    pub frames: [usize; 2],
}

/// The results of a proof.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Summary {
    /// Frames that were compared.
    pub frames: u64,
    /// Of those, frames that differ.
    pub differing: u64,
    /// Of those, frames that did not begin with a clear: they began with the contents of the window, which are not compared.
    pub carried: u64,
    /// Frames that were not compared, by reason.
    pub skipped: BTreeMap<String, u64>,
    /// Results by view.
    pub views: Vec<Option<Found>>,
    /// Result for the picture that the window shows.
    pub panel: Option<Found>,
    /// The draw that caused the worst pixel of a frame.
    pub draw: Option<Culprit>,
    /// `None` until frames of both kinds were timed.
    pub speed_up: Option<SpeedUp>,
    /// File with the worst view by replay, the difference, and the view as it was shown.
    pub picture: Option<String>,
}

impl Summary {
    /// Whether the views are those of replay, in words.
    pub fn verdict(&self) -> &'static str {
        match () {
            () if self.frames == 0 => "not proved",
            () if self.differing == 0 => "equal",
            () if self.found().all(|found| found.within_gate) => "within the gate",
            () => "beyond the gate",
        }
    }

    /// The results of the views that were compared.
    pub fn found(&self) -> impl Iterator<Item = &Found> {
        self.views.iter().flatten()
    }

    /// Peak signal-to-noise ratio of the worst view in its worst frame, in dB; `None` if no view differs.
    pub fn psnr(&self) -> Option<f64> {
        self.found().filter_map(|f| f.psnr).min_by(f64::total_cmp)
    }
}

/// The proof of one context.
#[derive(Debug, Default)]
pub struct Proof {
    summary: Summary,
    chosen: Vec<f64>,
    replay: Vec<f64>,
}

impl Proof {
    /// Adds a frame that was compared; `carried`: it did not begin with a clear.
    pub fn frame(&mut self, frame: u64, carried: bool, views: &[Difference], panel: &[Difference]) {
        let summary = &mut self.summary;
        summary.frames += 1;
        summary.carried += u64::from(carried);
        let all = || views.iter().chain(panel);
        summary.differing += u64::from(!all().all(|d| d.compared.is_equal()));
        summary.views.resize(views.len(), None);
        for (found, difference) in summary.views.iter_mut().zip(views) {
            Found::add(found, frame, difference);
        }
        for difference in panel {
            Found::add(&mut summary.panel, frame, difference);
        }
    }

    /// Counts a frame that could not be compared.
    pub fn skipped(&mut self, reason: &str) {
        *self.summary.skipped.entry(reason.to_owned()).or_default() += 1;
    }

    /// Peak signal-to-noise ratio of the worst view so far, in dB; infinite if none differs.
    pub fn psnr(&self) -> f64 {
        self.summary.psnr().unwrap_or(f64::INFINITY)
    }

    /// Notes the file with the picture of the worst view.
    pub fn picture(&mut self, file: String) {
        self.summary.picture = Some(file);
    }

    /// Notes the draw that caused the worst pixel of a frame; only that of the worst of all is kept.
    pub fn culprit(&mut self, culprit: Culprit) {
        let known = self.summary.draw.as_ref();
        if known.is_none_or(|k| k.worst.difference < culprit.worst.difference) {
            self.summary.draw = Some(culprit);
        }
    }

    /// The difference of the worst pixel whose draw is known, in steps of 255; 0 if none is.
    pub fn worst_explained(&self) -> u8 {
        let known = self.summary.draw.as_ref();
        known.map_or(0, |known| known.worst.difference)
    }

    /// Adds the time of a frame, in ms.
    pub fn timed(&mut self, by_replay: bool, ms: f64) {
        let times = if by_replay {
            &mut self.replay
        } else {
            &mut self.chosen
        };
        if times.len() < KEPT {
            times.push(ms);
        }
    }

    /// The summary of the results.
    pub fn summary(&self) -> Summary {
        let [chosen, replay] = [&self.chosen, &self.replay].map(|times| median(times));
        let speed_up = chosen
            .zip(replay)
            .map(|(chosen_ms, replay_ms)| SpeedUp {
                chosen_ms,
                replay_ms,
                times: replay_ms / chosen_ms,
                frames: [self.chosen.len(), self.replay.len()],
            })
            .filter(|speed_up| speed_up.times.is_finite());
        Summary {
            speed_up,
            ..self.summary.clone()
        }
    }
}

fn median(times: &[f64]) -> Option<f64> {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    let upper = *sorted.get(middle)?;
    let lower = *sorted.get(sorted.len().div_ceil(2).checked_sub(1)?)?;
    Some((lower + upper) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    fn difference(at: [u32; 2], by: u8) -> Difference {
        let exact = RgbImage::new(100, 100);
        let mut shown = exact.clone();
        shown.put_pixel(at[0], at[1], Rgb([0, by, 0]));
        Difference::new(&exact, &shown).expect("of one size")
    }

    #[test]
    fn the_worst_of_all_frames_is_kept() {
        let mut proof = Proof::default();
        assert_eq!(proof.summary().verdict(), "not proved");
        let equal = difference([0, 0], 0);
        proof.frame(10, true, &[equal, equal], &[]);
        assert_eq!(proof.summary().verdict(), "equal");
        proof.frame(20, false, &[equal, difference([3, 4], 1)], &[]);
        assert_eq!(proof.summary().verdict(), "within the gate");
        proof.frame(30, false, &[equal, difference([5, 6], 90)], &[equal]);
        proof.frame(40, false, &[equal, difference([7, 8], 20)], &[equal]);
        let summary = proof.summary();
        assert_eq!((summary.frames, summary.differing), (4, 3));
        assert_eq!(summary.carried, 1);
        let worst = Worst {
            difference: 90,
            x: 5,
            y: 6,
            frame: 30,
        };
        let found = summary.views[1].as_ref().expect("compared");
        assert_eq!((found.worst, found.differing), (Some(worst), 1));
        let squares = 90.0_f64.powi(2) / 30_000.0;
        let psnr = 10.0 * (255.0_f64.powi(2) / squares).log10();
        assert!((summary.psnr().expect("it differs") - psnr).abs() < 1e-9);
        assert_eq!(summary.views[0].as_ref().and_then(|f| f.worst), None);
    }

    #[test]
    fn the_speed_up_needs_both_kinds_of_frames() {
        let mut proof = Proof::default();
        for ms in [3.0, 1.0, 2.0] {
            proof.timed(false, ms);
        }
        assert_eq!(proof.summary().speed_up, None);
        for ms in [4.0, 8.0] {
            proof.timed(true, ms);
        }
        let told = proof.summary().speed_up.expect("both");
        assert_eq!((told.chosen_ms, told.replay_ms), (2.0, 6.0));
        assert_eq!((told.times, told.frames), (3.0, [3, 2]));
    }
}
