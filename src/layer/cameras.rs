//! The program's camera, as far as it is known, and the cameras of the views.

use super::comfort::Comfort;
use super::image_sums::ImageSums;
use crate::config::{Config, FlatDepth, Live, Projection};
use crate::plan::{Classifier, Shear};

/// The classifier of draws, the measurement of depths that places the cameras of the views, and the raster position.
#[derive(Debug)]
pub(super) struct Cameras {
    pub(super) classifier: Classifier,
    pub(super) comfort: Comfort,
    /// The images that rules for the classifier ask for.
    pub(super) image_sums: ImageSums,
    /// The shift of the projection under which the raster position was set; none where the position does not move with the view.
    raster: Option<Shear>,
    /// The kind of projection under which the raster position was set; [`Projection::None`] where glWindowPos did it.
    raster_placed: Projection,
}

impl Cameras {
    /// Nothing has been drawn. `program` is the name of the program's file.
    pub(super) fn new(config: &Config, live: &Live, program: Option<&str>) -> Self {
        let mut cameras = Cameras {
            classifier: Classifier::new(
                &config.profile,
                Some(live.hud_depth),
                program,
                config.explain.is_some(),
            ),
            comfort: Comfort::new(config, live.camera),
            image_sums: ImageSums::default(),
            raster: None,
            raster_placed: Projection::None,
        };
        cameras.follow(config.views);
        cameras
    }

    /// Has depths read where flat draws follow the scene.
    pub(super) fn follow(&mut self, views: u32) {
        let places = [FlatDepth::Crosshair, FlatDepth::Cursor];
        let follows = views > 1 && places.map(|at| self.classifier.follows(at)).contains(&true);
        self.comfort.follow(follows);
    }

    /// The program has set the raster position to a point of the scene, which moves with the view: under a projection of this kind, whose
    /// shift is given if it has one.
    pub(super) fn place_raster(&mut self, shift: Option<Shear>, kind: Projection) {
        (self.raster, self.raster_placed) = (shift, kind);
    }

    /// The program has set the raster position to a place in the window, which is the same in all views.
    pub(super) fn place_raster_in_window(&mut self) {
        self.place_raster(None, Projection::None);
    }

    /// The shift of the projection under which the raster position was set; none where the position does not move with the view.
    pub(super) fn raster(&self) -> Option<Shear> {
        self.raster
    }

    /// The kind of projection under which the raster position was set; [`Projection::None`] where glWindowPos did it.
    pub(super) fn raster_placed(&self) -> Projection {
        self.raster_placed
    }
}
