//! The panel's own window, beside that of the program.
#![forbid(unsafe_code)]

use super::Output;
use super::choice::{choice, choices};
use super::error::ConfigError;
use super::options::OptionId;
use super::parse::{check_output, path, written};
use super::settings::Settings;
use crate::display::{Display, Fit, Kind};
use std::path::PathBuf;

/// The monitor that `--panel auto` takes is chosen by its size.
pub const AUTO: &str = "auto";

const FITS: &[(&str, Fit)] = &[
    ("contain", Fit::Contain),
    ("cover", Fit::Cover),
    ("stretch", Fit::Stretch),
];

/// A window that covers the panel's monitor and shows the output; the program keeps its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PanelWindow {
    /// Name or number of the monitor; none: the one of the panel's size.
    pub monitor: Option<String>,
    /// How the picture is fitted to the panel.
    pub fit: Fit,
    /// What the program's window shows; none: the program's own view.
    pub output: Option<Output>,
    /// The socket of the window, once it is open.
    pub socket: Option<PathBuf>,
    /// Width and height of the panel in pixels, where there is no window and a picture is captured.
    pub size: Option<(u32, u32)>,
}

impl PanelWindow {
    /// `shown`: the display and the output; a wall is shown in windows of its panels.
    pub(super) fn from_settings(
        settings: &Settings,
        views: u32,
        shown: (&Display, Output),
    ) -> Result<Option<Self>, ConfigError> {
        let is_wall = matches!(shown.0.kind, Kind::Wall(_)) && shown.1 == Output::Panel;
        let Some((field, monitor)) = settings.field(OptionId::Panel) else {
            for id in [OptionId::Fit, OptionId::WindowOutput] {
                if let Some((field, _)) = settings.field(id) {
                    let panel = field.sibling(OptionId::Panel);
                    return Err(ConfigError::NoPanelWindow { field, panel });
                }
            }
            if is_wall {
                return Err(ConfigError::WallWindow);
            }
            return Ok(None);
        };
        if is_wall && monitor != AUTO {
            return Err(ConfigError::WallMonitor { field });
        }
        if views < 2 {
            let value = monitor.to_owned();
            return Err(ConfigError::OneView { field, value });
        }
        if monitor.is_empty() {
            return Err(ConfigError::NoMonitor { field });
        }
        if let Some((output, "quad")) = settings.field(OptionId::Output) {
            return Err(ConfigError::QuadPanel {
                field: output,
                panel: field,
            });
        }
        Ok(Some(Self {
            monitor: (monitor != AUTO).then(|| monitor.to_owned()),
            fit: choice(settings, OptionId::Fit, FITS)?.unwrap_or_default(),
            output: output(settings, views)?,
            socket: path(settings, OptionId::PanelSocket),
            size: size(settings)?,
        }))
    }
}

fn size(settings: &Settings) -> Result<Option<(u32, u32)>, ConfigError> {
    let Some((field, value)) = settings.field(OptionId::PanelSize) else {
        return Ok(None);
    };
    let side = |text: &str| text.parse().ok().filter(|side| *side > 0).map(u16::into);
    let sides = value.split_once('x');
    let size = sides.and_then(|(width, height)| Some((side(width)?, side(height)?)));
    let value = value.to_owned();
    size.map(Some)
        .ok_or(ConfigError::PanelSize { field, value })
}

fn output(settings: &Settings, views: u32) -> Result<Option<Output>, ConfigError> {
    let id = OptionId::WindowOutput;
    let Some((field, value)) = settings.field(id) else {
        return Ok(None);
    };
    if value == "own" {
        return Ok(None);
    }
    let output = written(&field, value)?;
    if matches!(
        output,
        Output::Panel | Output::Interlaced(_) | Output::Quad | Output::Rgbd
    ) {
        return Err(ConfigError::Choice {
            choices: choices(id),
            field,
            value: value.to_owned(),
        });
    }
    check_output(settings, id, output, views)?;
    Ok(Some(output))
}
