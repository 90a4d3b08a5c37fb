//! `manyview run`
#![forbid(unsafe_code)]

use super::Outcome;
use super::layer::LayerArguments;
use clap::Args;
use manyview::launch::Launch;
use std::ffi::OsString;
use std::process::ExitCode;

#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    layer: LayerArguments,
    /// The program and its arguments
    #[arg(required = true, trailing_var_arg = true, value_name = "APP")]
    command: Vec<OsString>,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let launch = Launch::prepare(&arguments.command, &arguments.layer.settings()?)?;
    Ok(ExitCode::from(launch.run()?.code()))
}
