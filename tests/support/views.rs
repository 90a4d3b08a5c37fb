//! Programs in three views: their output, and the picture of all views of one frame.

use super::{extent, lines, rgb};
use image::RgbImage;
use std::process::Command;

/// The number of views that [`Views::shown`] asks for.
pub(crate) const VIEWS: u32 = 3;

/// The strategy and atlas of the views, and the frame that is kept.
#[derive(Clone, Copy)]
pub(crate) struct Views<'a> {
    pub(crate) atlas: &'a str,
    pub(crate) strategy: &'a str,
    pub(crate) separation: f64,
    pub(crate) convergence: f64,
    /// Counted from 1.
    pub(crate) frame: u32,
}

/// The first frame by replay, for most tests.
pub(crate) const REPLAYED: Views = Views {
    atlas: "side-by-side",
    strategy: "replay",
    separation: 0.4,
    convergence: 4.0,
    frame: 1,
};

impl Views<'_> {
    /// The output of a program that runs without a screen, and its atlas: the views side by side. The command is one of
    /// [`layered`](super::layered).
    pub(crate) fn shown(self, command: &mut Command) -> (String, RgbImage) {
        let folder = tempfile::tempdir().expect("a folder");
        let picture = folder.path().join("frame.png");
        let options = [
            ("VIEWS", VIEWS.to_string()),
            ("ATLAS", self.atlas.to_owned()),
            ("STRATEGY", self.strategy.to_owned()),
            ("SEPARATION", self.separation.to_string()),
            ("CONVERGENCE", self.convergence.to_string()),
            ("CAPTURE_OUT", picture.display().to_string()),
            ("CAPTURE_FRAMES", self.frame.to_string()),
            ("CAPTURE_WHAT", "atlas".to_owned()),
        ];
        command.envs(options.map(|(name, value)| (format!("MANYVIEW_{name}"), value)));
        (lines(command), rgb(&picture))
    }
}

/// The [`extent`] of a colour in each view, the leftmost camera's first.
pub(crate) fn extents(all: &RgbImage, colour: [u8; 3]) -> [[f64; 2]; VIEWS as usize] {
    std::array::from_fn(|view| extent(all, VIEWS, view as u32, colour))
}
