//! `manyview budget`
#![forbid(unsafe_code)]

use super::{Outcome, print};
use clap::Args;
use manyview::config::{Config, OptionId, Settings};

#[derive(Args)]
pub(crate) struct Arguments {
    /// Panel: a built-in name (see `manyview displays`) or a panel file [default: huebner8]
    #[arg(long, value_name = "NAME|FILE")]
    display: Option<String>,
    /// Number of views, 1 to 256 [default: the panel's own]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    views: Option<String>,
    /// Width of the picture in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1920)]
    width: u32,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let mut settings = Settings::default();
    settings.give([
        (OptionId::Display, &arguments.display),
        (OptionId::Views, &arguments.views),
    ]);
    let config = Config::from_settings(&settings)?;
    let budget = config.display.budget(config.views, arguments.width);
    print(&format!("{:.3}\n", budget.px))
}
