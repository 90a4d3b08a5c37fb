//! The display file.
#![forbid(unsafe_code)]

use super::mask::{COLUMNS, ROWS};
use super::{CalibrateError, Fit, Setup};
use crate::display::{Bias, Display, Kind, Number, Slanted};
use std::path::Path;

impl Fit {
    /// The description of the panel.
    #[must_use]
    pub fn display(&self, setup: &Setup, name: &str) -> Display {
        let sheet = Slanted {
            pitch: rounded(self.mask.pitch, 8),
            slant: rounded(self.mask.slant, 8),
            offset: rounded(self.mask.offset, 5),
            colours: match &self.colours {
                Some((colours, _)) => colours.map(|colour| rounded(colour, 4)),
                None => [Number::whole(0); 3],
            },
            bias: self.mask.map.as_ref().and_then(|map| {
                let values = map.iter().map(|value| rounded(*value, 4));
                Bias::new(COLUMNS, ROWS, values.collect())
            }),
            order: self.order,
            inverted: setup.inverted,
        };
        Display::new(name, setup.views, Kind::Slanted(sheet))
    }

    /// Writes [`Fit::display`].
    pub fn write(&self, setup: &Setup, name: &str, path: &Path) -> Result<(), CalibrateError> {
        write(&self.display(setup, name), path)
    }
}

/// Writes a slanted sheet as TOML.
pub(super) fn write(display: &Display, path: &Path) -> Result<(), CalibrateError> {
    // Only slanted sheets come here; nothing else has a text.
    let text = display.to_toml().unwrap_or_default();
    std::fs::write(path, text).map_err(|error| CalibrateError::Write {
        what: "the display file",
        file: path.display().to_string(),
        reason: error.to_string(),
    })
}

/// So many digits after the point, which is more than can be measured.
pub(super) fn rounded(value: f64, digits: usize) -> Number {
    // A finite number reads back; nothing else is fitted.
    Number::parse(&format!("{value:.digits$}")).unwrap_or(Number::whole(0))
}
