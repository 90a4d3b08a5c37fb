//! `manyview run`
#![forbid(unsafe_code)]

use super::layer::LayerArguments;
use super::{Outcome, tell};
use clap::Args;
use manyview::launch::Launch;
use std::ffi::OsString;
use std::os::unix::fs::MetadataExt;
use std::path::PathBuf;
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
    let explanation = launch.config.explain.as_ref();
    let before = explanation.map(|explain| stamps(&explain.files()));
    let ended = launch.run()?;
    if let (Some(explain), Some(before)) = (explanation, before) {
        let files = explain.files();
        if stamps(&files)
            .iter()
            .zip(&before)
            .all(|(now, old)| now.is_some() && now != old)
        {
            let [picture, list] = files.map(|file| file.display().to_string());
            tell(&format_args!("wrote {picture} and {list}"));
        } else {
            tell(&format_args!(
                "nothing is explained: frame {} was never shown; give an earlier one with --explain-frame",
                explain.frame
            ));
        }
    }
    Ok(ExitCode::from(ended.code()))
}

/// Tells one version of a file from the next: device, inode and time of the last change.
fn stamps(files: &[PathBuf; 2]) -> [Option<(u64, u64, i64, i64)>; 2] {
    files.each_ref().map(|file| {
        let about = std::fs::metadata(file).ok()?;
        Some((about.dev(), about.ino(), about.mtime(), about.mtime_nsec()))
    })
}
