//! One photo, measured on its own: the camera roughly, the edges, the fringes.
#![forbid(unsafe_code)]

use super::bench::Bench;
use super::camera::View;
use super::edges::EdgePoint;
use super::fringes::{Fringes, measure};
use super::locate::{Located, locate};
use super::pattern::Layout;
use super::{CalibrateError, Photo, Setup, rough, shown};
use glam::{DVec2, DVec3};

/// The measurements of one photo, ready for [`super::fit`].
#[derive(Clone, Debug)]
pub struct Sighting {
    pub(super) name: String,
    pub(super) size: (u32, u32),
    pub(super) bench: Bench,
    pub(super) start: View,
    /// Of the panel, panel pixels.
    middle: DVec2,
    pub(super) edges: Vec<EdgePoint>,
    pub(super) fringes: Fringes,
}

impl Sighting {
    /// Finds and measures the pattern of a setup in a photo.
    pub fn new(photo: &Photo, setup: &Setup) -> Result<Self, CalibrateError> {
        setup.check()?;
        let layout = Layout::new(setup);
        let located = locate(photo, &layout.frame).map_err(|error| match error {
            CalibrateError::OtherPattern { photo, seen, .. }
                if seen == rough::code((setup.width, setup.height)) =>
            {
                CalibrateError::Gratings { photo }
            }
            error => error,
        });
        let Located { bench, view, edges } = located?;
        let fringes = measure(photo, &layout, view);
        if !matches!(fringes, Err(CalibrateError::TooSmall { .. })) {
            shown::scaled(photo, &layout.frame, view)?;
            shown::moved(photo, &layout.frame, view)?;
        }
        Ok(Self {
            name: photo.name.clone(),
            size: (photo.width, photo.height),
            bench,
            start: view,
            middle: layout.frame.size / 2.0,
            edges,
            fringes: fringes?,
        })
    }

    /// Where the camera was by the edges alone, from the middle of the panel: to the right, down, and before it, panel pixels.
    pub(super) fn camera_place(&self) -> DVec3 {
        let eye = self.start.pose.eye;
        DVec3::new(eye.x - self.middle.x, eye.y - self.middle.y, -eye.z)
    }

    /// Contrast of the fringes as a part of that of the panel, 0 to 1.
    #[must_use]
    pub fn contrast(&self) -> f64 {
        self.fringes.contrast
    }
}
