//! The thin seam to [`crate::display`]: panels by name or file, and their masks as pictures.
#![forbid(unsafe_code)]

use crate::display::{Display, DisplayError, MaskError, Placement};
use std::path::Path;

/// The panel that is used when nobody names one.
pub const DEFAULT: &str = "huebner8";

/// True if `name` is a built-in panel rather than a path.
#[must_use]
pub fn is_builtin(name: &str) -> bool {
    !matches!(Display::named(name), Err(DisplayError::Unknown { .. }))
}

/// Loads a panel by name or file; the error is one sentence that names it and the remedy.
pub fn load(name_or_path: &str) -> Result<Display, String> {
    Display::load(name_or_path).map_err(|error| error.to_string())
}

/// Checks that a panel can show `views` views; the error is one sentence.
pub fn check_views(display: &Display, views: u32) -> Result<(), String> {
    display
        .check_views(views)
        .map_err(|error| error.to_string())
}

/// Writes the mask of a panel for `views` views as a 16-bit PNG; the error is one sentence that names the file.
pub fn write_mask(
    display: &Display,
    views: u32,
    (width, height): (u32, u32),
    out: &Path,
) -> Result<(), MaskError> {
    display
        .mask(&Placement::full_screen(width, height), views)?
        .to_png(out)
}
