//! Pictures that the layer's passes make of one scene.

use super::Driver;
use crate::support::{demo, manyview, rgb, screen, succeed};
use image::RgbImage;
use manyview::metric::{Comparison, pixels_over};
use serde_json::Value;

/// Names of pictures, and the options of the layer that make them.
pub(super) const PICTURES: [(&str, &[&str]); 9] = [
    ("panel", &["--strategy", "replay"]),
    ("blended", &["--strategy", "replay", "--filter", "blend"]),
    ("side by side", &["--strategy", "replay", "--output", "sbs"]),
    (
        "anaglyph",
        &["--strategy", "replay", "--output", "anaglyph"],
    ),
    ("rgbd", &["--strategy", "replay", "--output", "rgbd"]),
    (
        "view scale",
        &["--strategy", "replay", "--view-scale", "auto"],
    ),
    ("depth-image", &["--strategy", "depth-image"]),
    ("hybrid", &["--strategy", "hybrid", "--true-views", "3"]),
    ("occlusion", &["--strategy", "occlusion"]),
];

/// A picture on one driver.
pub(super) struct Shown {
    picture: RgbImage,
    /// Why the CPU interleaved, all views were drawn or the reference image was not.
    pub(super) refusal: Option<String>,
}

impl Shown {
    /// The number of pixels that differ.
    pub(super) fn differs(&self, other: &Shown) -> u64 {
        pixels_over(&self.picture, &other.picture, 0)
    }

    /// In decibels.
    pub(super) fn psnr(&self, other: &Shown) -> f64 {
        let compared = Comparison::new(&self.picture, &other.picture, None);
        compared.expect("pictures of one size").psnr
    }
}

/// The picture of this name, of the second frame of the gears in 8 views.
pub(super) fn shown(name: &str, driver: &Driver) -> Shown {
    let named = PICTURES.iter().find(|(known, _)| *known == name);
    let (_, options) = named.expect("a picture of this name");
    let folder = tempfile::tempdir().expect("a folder");
    let [out, report] = ["picture.png", "report.json"].map(|file| folder.path().join(file));
    let mut command = manyview();
    command.envs(driver.variables.iter().copied());
    command.args(["capture", "--frame", "2", "--views", "8"]);
    command.args(["--separation", "0.02", "--convergence", "9"]);
    command.arg("--out").arg(&out).arg("--report").arg(&report);
    command.args(*options).arg("--").arg(demo("gears"));
    succeed(screen().give(command.args(["--frames", "3", "--size", "300x220"])));
    let text = std::fs::read_to_string(&report).expect("a report");
    Shown {
        picture: rgb(&out),
        refusal: refusal(&serde_json::from_str(&text).expect("JSON")),
    }
}

fn refusal(report: &Value) -> Option<String> {
    let notes = report["notes"].as_array().into_iter().flatten();
    let note = |note: &Value| note.as_str().map(str::to_owned);
    let refused = |note: &String| {
        [
            "by the CPU",
            "all views are drawn",
            "views are drawn at the size",
        ]
        .iter()
        .any(|part| note.contains(part))
    };
    let fallbacks = report["fallbacks"].as_object().into_iter().flatten();
    notes
        .filter_map(note)
        .find(refused)
        .or_else(|| fallbacks.map(|(reason, _)| reason.clone()).next())
}
