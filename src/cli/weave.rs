//! `manyview weave`
#![forbid(unsafe_code)]

use super::error::CommandError;
use super::mask::size;
use super::{Outcome, tell};
use clap::Args;
use image::RgbImage;
use manyview::config::{AUTO, Config, Filter, OptionId, Origin, Settings};
use manyview::display::{Display, Fit, Kind, Placement, QuiltName};
use manyview::interleave::wall::wall;
use manyview::interleave::{quilt, reference};
use manyview::launch::writable;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Args)]
pub(crate) struct Arguments {
    /// Panel: a built-in name (see `manyview displays`) or a panel file [default: huebner8]
    #[arg(long, value_name = "NAME|FILE")]
    display: Option<String>,
    /// Quilt to read: PNG, named like scene_qs8x6a0.75.png
    #[arg(long = "in", value_name = "PATH")]
    input: PathBuf,
    /// Columns and rows of the quilt [default: what its name says, else the panel's own]
    #[arg(long, value_name = "CxR")]
    quilt: Option<String>,
    /// Number of views, the first ones of the quilt [default: all of them]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    views: Option<String>,
    /// Size of the panel in pixels [default: the panel's own, else that of one view]
    #[arg(long, value_name = "WxH")]
    size: Option<String>,
    /// What a subpixel between two views shows: nearest, blend or gaussian [default: nearest]
    #[arg(long, value_name = "FILTER")]
    filter: Option<String>,
    /// File to write: PNG of the panel's size
    #[arg(long, value_name = "PATH")]
    out: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let mut settings = Settings::default();
    settings.give([
        (OptionId::Display, &arguments.display),
        (OptionId::Views, &arguments.views),
        (OptionId::Filter, &arguments.filter),
    ]);
    settings.set(OptionId::Output, "panel", Origin::CommandLine);
    // A wall needs windows; its picture does not.
    settings.set(OptionId::Panel, AUTO, Origin::Default);
    let display = Config::from_settings(&settings)?.display;
    let wanted = match &arguments.size {
        Some(text) => Some(size(text).ok_or_else(|| CommandError::Size(text.clone()))?),
        None => display.facts.screen,
    };
    let name = name(arguments, &display)?;
    writable("the panel's picture", &arguments.out)?;
    let cut = quilt::cut(&picture(&arguments.input)?, name)?;
    if cut.swapped {
        tell(&format_args!(
            "note: the name says {}x{}, but the views have the aspect that it says as {}x{}, rows before columns as AliceLG reads them",
            name.columns, name.rows, name.rows, name.columns
        ));
    }
    let mut views = cut.views;
    if arguments.views.is_none() {
        settings.set(
            OptionId::Views,
            views.len().to_string(),
            Origin::CommandLine,
        );
    }
    let config = Config::from_settings(&settings)?;
    if views.len() < config.views as usize {
        return Err(CommandError::QuiltViews {
            has: views.len(),
            wanted: config.views,
        });
    }
    views.truncate(config.views as usize);
    let (width, height) = wanted
        .or(views.first().map(RgbImage::dimensions))
        .unwrap_or_default();
    let placement = Placement::full_screen(width, height);
    let mask = match config.filter {
        Filter::Nearest => config.display.mask(&placement, config.views)?,
        _ => config.display.fine_mask(&placement, config.views)?,
    };
    let panel = match (
        &config.display.kind,
        views.first().map(RgbImage::dimensions),
    ) {
        (Kind::Wall(shown), Some(size)) => {
            let nodes = shown.nodes(size, Fit::default());
            wall(&views, &mask, &nodes, shown.node_count().0)?
        }
        _ => reference::filtered(&views, &mask, config.filter)?,
    };
    let refused = |error: image::ImageError| CommandError::Picture {
        file: arguments.out.clone(),
        reason: error.to_string(),
    };
    panel
        .save_with_format(&arguments.out, image::ImageFormat::Png)
        .map_err(refused)?;
    tell(&format_args!(
        "wrote {} ({} views)",
        arguments.out.display(),
        config.views
    ));
    Ok(ExitCode::SUCCESS)
}

/// Columns, rows and aspect of the quilt: from the option, from its name, or from the panel.
fn name(arguments: &Arguments, display: &Display) -> Result<QuiltName, CommandError> {
    if let Some(text) = &arguments.quilt {
        let read = QuiltName::read(&format!("_qs{text}"));
        return read
            .ok()
            .flatten()
            .ok_or_else(|| CommandError::QuiltShape(text.clone()));
    }
    let name = arguments.input.file_name().unwrap_or_default();
    let unknown = || CommandError::QuiltUnknown(arguments.input.clone());
    match (
        QuiltName::read(&name.to_string_lossy())?,
        display.facts.quilt,
    ) {
        (Some(name), _) => Ok(name),
        (None, Some((columns, rows))) => Ok(QuiltName {
            columns,
            rows,
            aspect: None,
        }),
        (None, None) => Err(unknown()),
    }
}

fn picture(path: &Path) -> Result<RgbImage, CommandError> {
    let refused = |reason: String| CommandError::Picture {
        file: path.to_owned(),
        reason,
    };
    let bytes =
        std::fs::read(path).map_err(|error| refused(format!("{error}; give a quilt as PNG")))?;
    image::load_from_memory_with_format(&bytes, image::ImageFormat::Png)
        .map(|picture| picture.into_rgb8())
        .map_err(|error| refused(format!("{error}; give a quilt as PNG")))
}
