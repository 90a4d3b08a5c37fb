//! The lens sheet of a panel, as arguments of the steps of `manyview calibrate`.
#![forbid(unsafe_code)]

use super::error::CommandError;
use clap::Args;
use manyview::calibrate::{CalibrateError, Setup, units};
use manyview::config::panel;
use manyview::display::{Display, Kind, MM_PER_INCH};

#[derive(Args)]
pub(super) struct SheetArguments {
    /// Panel as it is thought to be: a built-in name or a file of kind "slanted", with a pitch right to 1 %; without it and --pitch, the
    /// steps find out pitch and slant
    #[arg(long, value_name = "NAME|FILE")]
    display: Option<String>,
    /// In place of --display: subpixels from lens to lens along a row, right to 1 %, or with --dpi or --screen-mm the 0.286mm or 60lpi of a data
    /// sheet
    #[arg(
        long,
        value_name = "P",
        allow_hyphen_values = true,
        conflicts_with = "display",
        requires = "views"
    )]
    pitch: Option<String>,
    /// With --pitch: subpixels per row downwards, or the angle of the lenses such as 12.5deg [default: 0]
    #[arg(
        long,
        value_name = "S",
        allow_hyphen_values = true,
        conflicts_with = "display",
        requires = "pitch"
    )]
    slant: Option<String>,
    /// In place of --display: number of views
    #[arg(long, value_name = "N", conflicts_with = "display")]
    pub(super) views: Option<u32>,
    /// Width and height of the lit part of the panel in mm
    #[arg(long, value_name = "WxH", conflicts_with = "dpi")]
    pub(super) screen_mm: Option<String>,
    /// Pixels per inch of the panel
    #[arg(long, value_name = "N")]
    pub(super) dpi: Option<f64>,
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

    /// What is known of the sheet; none where it is to be found out.
    pub(super) fn setup(&self, (width, height): (u32, u32)) -> Result<Option<Setup>, CommandError> {
        if let Some(Display {
            kind: Kind::Slanted(lens),
            views,
            ..
        }) = self.display()?
        {
            let (pitch, slant) = (lens.pitch.to_f64(), lens.slant.to_f64());
            let mut setup = Setup::new(width, height, views, pitch, slant);
            setup.order = lens.order;
            setup.inverted = lens.inverted;
            return Ok(Some(setup));
        }
        let Some(text) = &self.pitch else {
            return Ok(None);
        };
        let slant = units::slant(self.slant.as_deref().unwrap_or("0"))?;
        let pitch = units::pitch(text, slant, self.pixel_mm((width, height))?)?;
        let views = self.views.unwrap_or(0);
        Ok(Some(Setup::new(width, height, views, pitch, slant)))
    }

    /// Side of a pixel of a panel of this size in pixels, in mm, where it is known.
    pub(super) fn pixel_mm(&self, size: (u32, u32)) -> Result<Option<f64>, CalibrateError> {
        let Some(text) = &self.screen_mm else {
            return Ok(self
                .dpi
                .filter(|dpi| *dpi > 0.0)
                .map(|dpi| MM_PER_INCH / dpi));
        };
        let sides = text.split_once('x').and_then(|(width, height)| {
            let side = |text: &str| {
                text.parse()
                    .ok()
                    .filter(|mm: &f64| (10.0..20000.0).contains(mm))
            };
            Some((side(width)?, side(height)?))
        });
        let wrong = || CalibrateError::ScreenSize { text: text.clone() };
        let (width, height) = sides.ok_or_else(wrong)?;
        let (across, down) = (width / f64::from(size.0), height / f64::from(size.1));
        if (across / down).ln().abs() > 0.02 {
            return Err(wrong());
        }
        Ok(Some((across + down) / 2.0))
    }
}
