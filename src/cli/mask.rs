//! `manyview mask`
#![forbid(unsafe_code)]

use super::error::CommandError;
use super::{Outcome, tell};
use clap::Args;
use manyview::config::{Config, OptionId, Settings, panel};
use manyview::launch::writable;
use std::path::PathBuf;
use std::process::ExitCode;

/// A side larger than this is a mistake rather than a panel.
const MAX_SIDE: u32 = 16384;

#[derive(Args)]
pub(crate) struct Arguments {
    /// Panel: a built-in name (see `manyview displays`) or a panel file [default: huebner8]
    #[arg(long, value_name = "NAME|FILE")]
    display: Option<String>,
    /// Number of views, 1 to 256 [default: the panel's own]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    views: Option<String>,
    /// Size of the panel in pixels
    #[arg(long, value_name = "WxH")]
    size: String,
    /// File to write: 16-bit RGB PNG, row 0 on top
    #[arg(long, value_name = "PATH")]
    out: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let mut settings = Settings::default();
    settings.give([
        (OptionId::Display, &arguments.display),
        (OptionId::Views, &arguments.views),
    ]);
    let config = Config::from_settings(&settings)?;
    let size = size(&arguments.size).ok_or_else(|| CommandError::Size(arguments.size.clone()))?;
    writable("the mask", &arguments.out)?;
    panel::write_mask(&config.display, config.views, size, &arguments.out)?;
    tell(&format_args!("wrote {}", arguments.out.display()));
    Ok(ExitCode::SUCCESS)
}

pub(super) fn size(text: &str) -> Option<(u32, u32)> {
    let (width, height) = text.split_once('x')?;
    let side = |text: &str| {
        text.parse()
            .ok()
            .filter(|side| (1..=MAX_SIDE).contains(side))
    };
    Some((side(width)?, side(height)?))
}

#[cfg(test)]
mod tests {
    use super::size;

    #[test]
    fn sizes() {
        assert_eq!(size("1920x1080"), Some((1920, 1080)));
        for wrong in [
            "", "1920", "0x5", "5x0", "5x-1", "5x5x5", "99999x5", "5 x 5",
        ] {
            assert_eq!(size(wrong), None, "{wrong}");
        }
    }
}
