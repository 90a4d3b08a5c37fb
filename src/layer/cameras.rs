//! The program's camera, as far as it is known, and the cameras of the views.

use super::comfort::Comfort;
use crate::config::{Config, Live, Projection};
use crate::plan::{Classifier, Shear};

/// The classifier of draws, the measurement of depths that places the cameras of the views, and the raster position.
#[derive(Debug)]
pub(super) struct Cameras {
    pub(super) classifier: Classifier,
    pub(super) comfort: Comfort,
    /// The shift of the projection under which the raster position was set; none where the position does not move with the view.
    pub(super) raster: Option<Shear>,
    /// The kind of projection under which the raster position was set; [`Projection::None`] where glWindowPos did it.
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
