//! The lens sheet of a panel, as arguments of the steps of `manyview calibrate`.
#![forbid(unsafe_code)]

use super::error::CommandError;
use clap::Args;
use manyview::calibrate::{CalibrateError, Setup};
use manyview::config::panel;
use manyview::display::{Display, Kind};

#[derive(Args)]
pub(super) struct SheetArguments {
    /// Panel as it is thought to be: a built-in name or a file of kind "slanted", with a pitch right to 1 %
    #[arg(long, value_name = "NAME|FILE", required_unless_present = "pitch")]
    display: Option<String>,
    /// In place of --display: subpixels from lens to lens, right to 1 %
    #[arg(long, value_name = "P", conflicts_with = "display", requires = "views")]
    pitch: Option<f64>,
    /// With --pitch: subpixels per row downwards
    #[arg(
        long,
        value_name = "S",
        default_value_t = 0.0,
        allow_hyphen_values = true,
        conflicts_with = "display"
    )]
    slant: f64,
    /// With --pitch: number of views
    #[arg(long, value_name = "N", conflicts_with = "display")]
    views: Option<u32>,
}

impl SheetArguments {
    /// The sheet before calibration; none where only numbers are given.
    pub(super) fn display(&self) -> Result<Option<Display>, CalibrateError> {
        let Some(name) = &self.display else {
            return Ok(None);
        };
        let display = panel::load(name).map_err(|reason| CalibrateError::Display { reason })?;
        if let Kind::Slanted(_) = display.kind {
            return Ok(Some(display));
        }
        let reason = format!(
            "display `{name}` is no slanted lens sheet; give one of kind \"slanted\", or --pitch, --slant and --views"
        );
        Err(CalibrateError::Display { reason })
    }

    pub(super) fn setup(&self, (width, height): (u32, u32)) -> Result<Setup, CommandError> {
        let Some(Display {
            kind: Kind::Slanted(lens),
            views,
            ..
        }) = self.display()?
        else {
            let (pitch, views) = (self.pitch.unwrap_or(0.0), self.views.unwrap_or(0));
            return Ok(Setup::new(width, height, views, pitch, self.slant));
        };
        let (pitch, slant) = (lens.pitch.to_f64(), lens.slant.to_f64());
        let mut setup = Setup::new(width, height, views, pitch, slant);
        setup.order = lens.order;
        setup.inverted = lens.inverted;
        Ok(setup)
    }
}
