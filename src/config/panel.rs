//! The thin seam to [`crate::display`]: panels by name or file, and their masks as pictures.
#![forbid(unsafe_code)]

use crate::display::{Display, DisplayError, Kind, MaskError, Placement};
use std::path::Path;

/// The panel that is used when nobody names one.
pub const DEFAULT: &str = "huebner8";

/// A built-in panel, for lists.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Builtin {
    /// Name for `--display`; `N` stands for any number.
    pub name: String,
    /// Native number of views; nothing where the name says it.
    pub views: Option<u32>,
    /// How the panel separates its views.
    pub kind: String,
}

/// Every built-in panel.
#[must_use]
pub fn builtins() -> Vec<Builtin> {
    let example = |name: &str| Display::named(&name.replace('N', "2")).ok();
    let all = Display::NAMES
        .iter()
        .filter_map(|name| example(name).map(|display| (*name, display)));
    all.map(|(name, display)| Builtin {
        name: name.to_owned(),
        views: (!name.contains('N')).then_some(display.views),
        kind: kind(&display.kind).to_owned(),
    })
    .collect()
}

fn kind(kind: &Kind) -> &'static str {
    match kind {
        Kind::Lenticular => "upright lenses, a pixel per view",
        Kind::Huebner(_) => "wavelength-selective filter",
        Kind::Slanted(_) => "slanted lenses",
        Kind::MaskFile { .. } => "mask file",
    }
}

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
    // Only a mask file has a number of views that it cannot do without.
    let Kind::MaskFile { mask, .. } = &display.kind else {
        return Ok(());
    };
    let whole = Placement::full_screen(mask.width(), mask.height());
    display
        .mask(&whole, views)
        .map(drop)
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
