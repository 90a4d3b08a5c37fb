//! What is known of the program's camera, and where the cameras of the views stand.

use super::comfort::Comfort;
use crate::config::{Config, Live, Projection};
use crate::plan::{Classifier, Shear};

/// What places the cameras of the views, and what tells the program's camera from other matrices.
#[derive(Debug)]
pub(super) struct Cameras {
    pub(super) classifier: Classifier,
    pub(super) comfort: Comfort,
    /// The shift under which the raster position was set; none where it is one of the window.
    pub(super) raster: Option<Shear>,
    /// The projection under which the raster position was set; none where glWindowPos did it.
    pub(super) raster_placed: Projection,
}

impl Cameras {
    /// Nothing has been drawn. `program` is the name of the program's file.
    pub(super) fn new(config: &Config, live: &Live, program: Option<&str>) -> Self {
        Cameras {
            classifier: Classifier::new(
                &config.profile,
                Some(live.hud_depth),
                program,
                config.explain.is_some(),
            ),
            comfort: Comfort::new(config, live.camera),
            raster: None,
            raster_placed: Projection::None,
        }
    }
}
