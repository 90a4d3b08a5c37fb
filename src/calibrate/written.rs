//! The display file.
#![forbid(unsafe_code)]

use super::{CalibrateError, Fit, Setup};
use crate::display::SubpixelOrder;
use std::fmt::Write as _;
use std::path::Path;

impl Fit {
    /// The description of the panel, as TOML.
    #[must_use]
    pub fn to_toml(&self, setup: &Setup, name: &str) -> String {
        let order = match setup.order {
            SubpixelOrder::Rgb => "rgb",
            SubpixelOrder::Bgr => "bgr",
        };
        let name = toml::Value::from(name);
        let mut text = format!(
            "version = 1\nname = {name}\nkind = \"slanted\"\nviews = {}\npitch = {:.8}\nslant = {:.8}\n\
             offset = {:.5}\norder = \"{order}\"\ninverted = {}\n",
            setup.views, self.pitch, self.slant, self.offset, setup.inverted
        );
        let list = |values: &[f64]| {
            let values: Vec<String> = values.iter().map(|value| format!("{value:.4}")).collect();
            values.join(", ")
        };
        // Writing to a String cannot fail.
        if let Some((colours, _)) = &self.colours {
            let _ = writeln!(text, "colour-offsets = [{}]", list(colours));
        }
        if let Some(bias) = &self.bias {
            let _ = write!(
                text,
                "\n[bias]\ncolumns = 3\nrows = 3\nvalues = [{}]\n",
                list(bias)
            );
        }
        text
    }

    /// Writes [`Fit::to_toml`].
    pub fn write(&self, setup: &Setup, name: &str, path: &Path) -> Result<(), CalibrateError> {
        std::fs::write(path, self.to_toml(setup, name)).map_err(|error| CalibrateError::Write {
            what: "the display file",
            file: path.display().to_string(),
            reason: error.to_string(),
        })
    }
}
