//! The results as text, JSON and CSV.

use super::{Experiment, FRAMES, Frame, IMAGES, Images, PAPER};
use crate::bench::error::BenchError;
use crate::bench::table::columns;
use crate::metric::Comparison;
use serde::Serialize;
use std::path::Path;
use std::time::Duration;

/// All of a run.
#[derive(Debug, Serialize)]
pub struct Outcome {
    /// When it began: RFC 3339, UTC.
    pub date: String,
    /// The command line.
    pub command: Vec<String>,
    /// The name for `--preset`.
    pub preset: &'static str,
    /// One for each scene.
    pub scenes: Vec<Scene>,
    /// One for each scene, viewpoint and image.
    pub views: Vec<View>,
}

/// A scene, and the time to make its images.
#[derive(Clone, Debug, Serialize)]
pub struct Scene {
    /// Name of the model.
    pub scene: &'static str,
    /// Of the geometry.
    pub triangles: usize,
    /// Pixels of every picture.
    pub width: u32,
    /// Pixels of every picture.
    pub height: u32,
    /// One view of the geometry, ms.
    pub single_ms: f64,
    /// Of the reference images.
    pub references: Vec<Made>,
    /// The share that is left in the paper, on average of its scenes, %.
    pub paper_left_percent: f64,
}

/// A reference image of a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Made {
    /// Of [`IMAGES`].
    pub image: &'static str,
    /// Time to make it, ms, without the depths that it starts from.
    pub construction_ms: f64,
    /// Its missing samples over the depth image's, of all viewpoints together, %. None where no sample is missing.
    pub left_percent: Option<f64>,
}

/// A frame of one image. More than 12 fields: one for each member of the JSON.
#[derive(Clone, Debug, Serialize)]
pub struct View {
    /// Name of the model.
    pub scene: &'static str,
    /// Inches to the right of the reference viewpoint.
    pub right: f64,
    /// Inches above it.
    pub up: f64,
    /// Inches farther from the display; negative: nearer.
    pub farther: f64,
    /// Of [`FRAMES`].
    pub image: &'static str,
    /// Pixels of the true picture that show the scene.
    pub samples: usize,
    /// Samples that are not in the frame.
    pub missing: usize,
    /// Samples that are not at their own pixel.
    pub displaced: usize,
    /// Pixels with nothing, in per cent of the samples.
    pub holes_percent: f64,
    /// dB; none for equal pictures, where it is infinite.
    pub psnr: Option<f64>,
    /// At most 1.
    pub ssim: f64,
    /// With the missing samples taken from the truth.
    pub present_psnr: Option<f64>,
    /// The same.
    pub present_ssim: f64,
    /// Disparity error of pixels that are no holes, the median, pixels.
    pub disparity_median: f64,
    /// The 95 % quantile.
    pub disparity_95: f64,
    /// The worst.
    pub disparity_max: f64,
    /// Share of the pixels that are no holes with an error of more than half a pixel, %.
    pub disparity_over_half_percent: f64,
}

impl View {
    /// Of a frame; `image` is a number of [`FRAMES`].
    #[must_use]
    pub fn new(scene: &'static str, at: [f64; 3], image: usize, frame: &Frame) -> View {
        let psnr = |comparison: &Comparison| Some(comparison.psnr).filter(|psnr| psnr.is_finite());
        View {
            scene,
            right: at[0],
            up: at[1],
            farther: at[2],
            image: FRAMES.get(image).copied().unwrap_or_default(),
            samples: frame.samples,
            missing: frame.count(),
            displaced: frame.displaced,
            holes_percent: frame.holes_percent,
            psnr: psnr(&frame.all),
            ssim: frame.all.ssim,
            present_psnr: psnr(&frame.present),
            present_ssim: frame.present.ssim,
            disparity_median: frame.disparity.median,
            disparity_95: frame.disparity.most,
            disparity_max: frame.disparity.worst,
            disparity_over_half_percent: frame.disparity.over_percent,
        }
    }
}

impl Scene {
    /// Of its views.
    #[must_use]
    pub fn new(
        scene: &'static str,
        triangles: usize,
        experiment: &Experiment,
        images: &Images,
        views: &[View],
    ) -> Scene {
        let missing = |image: &str| {
            let of = views.iter().filter(|view| view.image == image);
            of.map(|view| view.missing).sum::<usize>()
        };
        let [straight, distorted @ ..] = IMAGES;
        let depth = missing(straight);
        let made = |(image, time): (&'static str, &Duration)| Made {
            image,
            construction_ms: 1e3 * time.as_secs_f64(),
            left_percent: (depth > 0).then(|| 100.0 * missing(image) as f64 / depth as f64),
        };
        Scene {
            scene,
            triangles,
            width: experiment.size[0],
            height: experiment.size[1],
            single_ms: 1e3 * images.single.as_secs_f64(),
            references: distorted
                .into_iter()
                .zip(&images.construction)
                .map(made)
                .collect(),
            paper_left_percent: PAPER,
        }
    }
}

/// The viewpoint with the most missing samples of an image.
#[must_use]
pub(super) fn worst<'a>(views: &'a [View], scene: &str, image: &str) -> Option<&'a View> {
    let own = views
        .iter()
        .filter(|view| view.scene == scene && view.image == image);
    own.max_by_key(|view| view.missing)
}

/// The table: a line for each image of a scene, means of the viewpoints.
#[must_use]
pub fn text(outcome: &Outcome) -> String {
    let head = [
        "scene",
        "size",
        "triangles",
        "image",
        "samples",
        "missing",
        "left %",
        "paper's %",
        "worst",
        "at",
        "holes %",
        "PSNR",
        "SSIM",
        "present: PSNR",
        "SSIM",
        "px: 50 %",
        "95 %",
        "max",
        "> 0.5 px %",
        "times",
    ];
    let mut lines = vec![head.map(str::to_owned).to_vec()];
    for scene in &outcome.scenes {
        lines.extend(FRAMES.map(|image| cells(scene, image, &outcome.views)));
    }
    let views = outcome.views.len() / FRAMES.len() / outcome.scenes.len().max(1);
    format!(
        "means of {views} viewpoints on the edges of the cube; worst: inches to the right, up and away from the display; px: disparity error of what is not a hole, max of all; truth, aside: sampled half a pixel to the left; times: construction over a single view; --csv: each view\n\n{}",
        columns(&lines)
    )
}

fn cells(scene: &Scene, image: &str, views: &[View]) -> Vec<String> {
    let own: Vec<&View> = views
        .iter()
        .filter(|view| view.scene == scene.scene && view.image == image)
        .collect();
    let mean = |of: &dyn Fn(&View) -> f64| {
        own.iter().map(|view| of(view)).sum::<f64>() / own.len().max(1) as f64
    };
    let most = |of: &dyn Fn(&View) -> f64| own.iter().map(|view| of(view)).fold(0.0, f64::max);
    let psnr = |of: &dyn Fn(&View) -> Option<f64>| match own.iter().any(|view| of(view).is_some()) {
        true => {
            let all: Vec<f64> = own.iter().filter_map(|view| of(view)).collect();
            format!("{:.1}", all.iter().sum::<f64>() / all.len() as f64)
        }
        false => "exact".to_owned(),
    };
    let (worst, at) = worst(views, scene.scene, image).map_or_else(Default::default, |view| {
        let at = format!("({}, {}, {})", view.right, view.up, view.farther);
        (view.missing.to_string(), at)
    });
    let reference = scene.references.iter().find(|made| made.image == image);
    let of_reference = |cell: &dyn Fn(&Made) -> String| reference.map_or_else(String::new, cell);
    vec![
        scene.scene.to_owned(),
        format!("{}x{}", scene.width, scene.height),
        scene.triangles.to_string(),
        image.to_owned(),
        format!("{:.0}", mean(&|view| view.samples as f64)),
        format!("{:.0}", mean(&|view| view.missing as f64)),
        of_reference(&|made| {
            let left = made.left_percent;
            left.map_or("-".to_owned(), |left| format!("{left:.1}"))
        }),
        of_reference(&|_| format!("{:.1}", scene.paper_left_percent)),
        worst,
        at,
        format!("{:.2}", mean(&|view| view.holes_percent)),
        psnr(&|view| view.psnr),
        format!("{:.4}", mean(&|view| view.ssim)),
        psnr(&|view| view.present_psnr),
        format!("{:.4}", mean(&|view| view.present_ssim)),
        format!("{:.2}", mean(&|view| view.disparity_median)),
        format!("{:.2}", mean(&|view| view.disparity_95)),
        format!("{:.1}", most(&|view| view.disparity_max)),
        format!("{:.2}", mean(&|view| view.disparity_over_half_percent)),
        of_reference(&|made| format!("{:.2}", made.construction_ms / scene.single_ms)),
    ]
}

/// Writes one line for each scene, viewpoint and image.
///
/// # Errors
/// If the file cannot be written.
pub fn write_csv(views: &[View], file: &Path) -> Result<(), BenchError> {
    let bad = |error: csv::Error| BenchError::Write {
        file: file.to_owned(),
        reason: error.to_string(),
    };
    let mut csv = csv::Writer::from_path(file).map_err(bad)?;
    for view in views {
        csv.serialize(view).map_err(bad)?;
    }
    csv.flush().map_err(|error| bad(error.into()))
}
