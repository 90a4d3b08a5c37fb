//! One frame against the truth.

use super::Experiment;
use crate::metric::Comparison;
use crate::synthesis::Reference;
use image::{Rgb, RgbImage};

/// Marks a sample that is missing, as Figure 20 does.
const WHITE: Rgb<u8> = Rgb([255; 3]);

/// A frame compared with the true picture.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Pixels of the true picture that show the scene.
    pub samples: usize,
    /// By pixel: the sample of the truth is missing in the frame.
    pub missing: Vec<bool>,
    /// Samples that are not at their own pixel, including those of silhouettes that lie a pixel off.
    pub displaced: usize,
    /// Pixels where the true picture shows the scene and the frame nothing, %.
    pub holes_percent: f64,
    /// The error of the whole picture, holes black.
    pub all: Comparison,
    /// The error with the missing samples taken from the truth.
    pub present: Comparison,
    /// The error of all pixels where both show the scene.
    pub disparity: Disparity,
    /// The frame itself.
    pub picture: RgbImage,
}

/// Disparity errors of a frame, seen from the farthest viewpoint, pixels. Pixels that show another surface count.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Disparity {
    /// Half of the pixels have no larger error.
    pub median: f64,
    /// 95 % of the pixels have no larger error.
    pub most: f64,
    /// The largest error.
    pub worst: f64,
    /// Pixels with a larger error than [`Disparity::ASKED`], %.
    pub over_percent: f64,
}

impl Disparity {
    /// The bound on a pixel's error, in pixels.
    pub const ASKED: f64 = 0.5;

    /// Statistics of the pixels' errors; all 0 without pixels.
    #[must_use]
    pub fn of(mut parted: Vec<f64>) -> Disparity {
        parted.sort_by(f64::total_cmp);
        let last = parted.len().saturating_sub(1);
        let at = |percent: usize| parted.get(last * percent / 100).copied().unwrap_or(0.0);
        let over = parted.iter().filter(|&&pixels| pixels > Self::ASKED);
        Disparity {
            median: at(50),
            most: at(95),
            worst: at(100),
            over_percent: 100.0 * over.count() as f64 / parted.len().max(1) as f64,
        }
    }
}

impl Frame {
    /// Compares; both pictures are of the experiment's size. None if they have no pixels.
    #[must_use]
    pub fn of(experiment: &Experiment, truth: &Reference, seen: &Reference) -> Option<Frame> {
        let tolerance = experiment.tolerance();
        let (true_depths, depths) = (truth.inverses(), seen.inverses());
        let missing = missing(experiment.size, &true_depths, &depths, tolerance);
        let shown = true_depths.iter().zip(&depths).filter(|(t, _)| **t > 0.0);
        let (mut samples, mut displaced, mut holes) = (0, 0, 0);
        let mut parted = Vec::new();
        for (truth, frame) in shown {
            samples += 1;
            holes += usize::from(*frame <= 0.0);
            let step = f64::from(frame - truth).abs();
            displaced += usize::from(*frame <= 0.0 || step > tolerance);
            if *frame > 0.0 {
                parted.push(step * experiment.parallax());
            }
        }
        let (truth, picture) = (truth.picture().picture, seen.picture().picture);
        let mut present = picture.clone();
        for ((pixel, own), missing) in present.pixels_mut().zip(truth.pixels()).zip(&missing) {
            if *missing {
                *pixel = *own;
            }
        }
        let share = |part: usize| part as f64 / samples.max(1) as f64;
        Some(Frame {
            samples,
            missing,
            displaced,
            holes_percent: 100.0 * share(holes),
            all: Comparison::new(&truth, &picture, None).ok()?,
            present: Comparison::new(&truth, &present, None).ok()?,
            disparity: Disparity::of(parted),
            picture,
        })
    }

    /// Number of missing samples.
    #[must_use]
    pub fn count(&self) -> usize {
        self.missing.iter().filter(|missing| **missing).count()
    }

    /// The frame, darker, with the missing samples in white.
    #[must_use]
    pub fn marked(&self) -> RgbImage {
        let mut picture = self.picture.clone();
        for (pixel, missing) in picture.pixels_mut().zip(&self.missing) {
            *pixel = match missing {
                true => WHITE,
                false => Rgb(pixel.0.map(|part| part / 2)),
            };
        }
        picture
    }
}

/// By pixel: the truth has a sample there, and the frame has no sample of its depth at that pixel or one of the eight around it. Both
/// pictures are sampled at pixels, so the same silhouette may lie a pixel off; only wider holes are seen. Depths are 1/w, 0 for the
/// background.
#[must_use]
pub fn missing([w, h]: [u32; 2], truth: &[f32], frame: &[f32], tolerance: f64) -> Vec<bool> {
    let [w, h] = [w as usize, h as usize];
    let has = |x: usize, y: usize, depth: f32| {
        let own = frame[y * w + x];
        own > 0.0 && f64::from(own - depth).abs() <= tolerance
    };
    let is_missing = |(at, &depth): (usize, &f32)| {
        let (x, y) = (at % w, at / w);
        let columns = x.saturating_sub(1)..(x + 2).min(w);
        let mut rows = y.saturating_sub(1)..(y + 2).min(h);
        depth > 0.0 && !rows.any(|y| columns.clone().any(|x| has(x, y, depth)))
    };
    truth.iter().enumerate().map(is_missing).collect()
}
