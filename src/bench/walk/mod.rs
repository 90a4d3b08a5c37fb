//! A recorded walk under `--strategy hybrid`: time, number of true views, and error of each frame.
//!
//! The rate is measured in a run of its own, in which no picture is written. Pictures are compared in later runs that draw the same number
//! of views in each frame, so the program has to draw the same frames each time, as a replayed trace does.
#![forbid(unsafe_code)]

mod chart;

pub use chart::write;

use super::error::BenchError;
use super::statistics::Spread;
use serde::Serialize;
use std::path::Path;

/// All of a walk.
#[derive(Debug, Serialize)]
pub struct Walk {
    /// When it began: RFC 3339, UTC.
    pub date: String,
    /// The program and its arguments.
    pub command: Vec<String>,
    /// Frame rate to hold, frames per second.
    pub rate: f64,
    /// N.
    pub views: u32,
    /// In the order of the walk.
    pub frames: Vec<Frame>,
}

/// One frame of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Frame {
    /// Counted from 1.
    pub frame: u64,
    /// From the swap of the frame before to its own, ms.
    pub ms: f64,
    /// The same with all views drawn, in another run.
    pub exact_ms: f64,
    /// Number of true views.
    pub drawn: u32,
    /// PSNR of the shown picture against that with all views drawn, dB; none where they are equal.
    pub psnr: Option<f64>,
    /// Share of its pixels that are disocclusions, %.
    pub hole_percent: f64,
}

impl Walk {
    /// The text that is printed.
    #[must_use]
    pub fn text(&self) -> String {
        let budget = 1e3 / self.rate;
        let held = |ms: &dyn Fn(&Frame) -> f64| {
            let all: Vec<f64> = self.frames.iter().map(ms).collect();
            let within = all.iter().filter(|ms| **ms <= budget).count();
            let part = 100.0 * within as f64 / all.len().max(1) as f64;
            format!(
                "{:.1} frames/s, {part:.0} % of the frames in time",
                1e3 / middle(&all)
            )
        };
        let psnr = self
            .frames
            .iter()
            .map(|frame| frame.psnr.unwrap_or(f64::INFINITY));
        let holes: Vec<f64> = self.frames.iter().map(|frame| frame.hole_percent).collect();
        let mut drawn: Vec<u32> = self.frames.iter().map(|frame| frame.drawn).collect();
        let changes = drawn.windows(2).filter(|pair| pair[0] != pair[1]).count();
        drawn.sort_unstable();
        drawn.dedup();
        let drawn: Vec<String> = drawn.iter().map(u32::to_string).collect();
        format!(
            "{} views, {} frames per second asked for, {} frames\n\
             hybrid        {}\n\
             all drawn     {}\n\
             views drawn   {}; {changes} changes\n\
             worst frame   {:.1} dB, {:.2} % holes (median {:.2} %)\n",
            self.views,
            self.rate,
            self.frames.len(),
            held(&|frame| frame.ms),
            held(&|frame| frame.exact_ms),
            drawn.join(", "),
            psnr.fold(f64::INFINITY, f64::min),
            holes.iter().copied().fold(0.0, f64::max),
            middle(&holes),
        )
    }

    /// One line for each frame.
    pub fn write_csv(&self, file: &Path) -> Result<(), BenchError> {
        let failed = |reason: &dyn std::fmt::Display| BenchError::Write {
            file: file.to_owned(),
            reason: reason.to_string(),
        };
        let mut writer = csv::Writer::from_path(file).map_err(|error| failed(&error))?;
        for frame in &self.frames {
            writer.serialize(frame).map_err(|error| failed(&error))?;
        }
        writer.flush().map_err(|error| failed(&error))
    }
}

/// The median; 0 without any.
fn middle(values: &[f64]) -> f64 {
    Spread::of(values).map_or(0.0, |spread| spread.median)
}

/// Milliseconds and true views of `frames`, from the layer's report, which has the number of all frames and the values of the last of them.
/// None where it lacks a frame.
#[must_use]
pub fn told(
    report: &serde_json::Value,
    frames: std::ops::RangeInclusive<u64>,
) -> Option<Vec<(f64, u32)>> {
    let all = report.get("true_views")?.as_array()?;
    let last = report.get("frames")?.as_u64()?;
    let of = |frame: u64| {
        let back = last.checked_sub(frame)?.checked_add(1)?;
        let at = (all.len() as u64).checked_sub(back)?;
        let pair = all.get(usize::try_from(at).ok()?)?;
        let drawn = pair.get(1)?.as_u64()?;
        Some((pair.get(0)?.as_f64()?, u32::try_from(drawn).ok()?))
    };
    frames.map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn frames_are_counted_from_the_last() {
        // The first frame has no time.
        let report =
            json!({"frames": 5, "true_views": [[10.5, 2], [11.5, 3], [12.5, 3], [13.5, 4]]});
        assert_eq!(told(&report, 3..=4), Some(vec![(11.5, 3), (12.5, 3)]));
        assert_eq!(told(&report, 2..=2), Some(vec![(10.5, 2)]));
        assert_eq!(told(&report, 1..=2), None);
        assert_eq!(told(&report, 5..=6), None);
        assert_eq!(told(&json!({"frames": 5}), 2..=3), None);
    }

    #[test]
    fn a_walk_is_summed_up() {
        let frame = |frame, ms, drawn, psnr, hole_percent| Frame {
            frame,
            ms,
            exact_ms: 3.0 * ms,
            drawn,
            psnr,
            hole_percent,
        };
        let walk = Walk {
            date: String::new(),
            command: Vec::new(),
            rate: 20.0,
            views: 8,
            frames: vec![
                frame(7, 40.0, 3, Some(41.0), 0.5),
                frame(8, 50.0, 3, Some(35.25), 1.5),
                frame(9, 60.0, 2, None, 1.0),
            ],
        };
        let text = walk.text();
        for told in [
            "hybrid        20.0 frames/s, 67 % of the frames in time",
            "all drawn     6.7 frames/s, 0 % of the frames in time",
            "views drawn   2, 3; 1 changes",
            "worst frame   35.2 dB, 1.50 % holes (median 1.00 %)",
        ] {
            assert!(text.contains(told), "{told}: {text}");
        }
    }
}
