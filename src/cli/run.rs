//! `manyview run`
#![forbid(unsafe_code)]

use super::error::CommandError;
use super::layer::LayerArguments;
use super::{Outcome, panel, scratch, tell};
use clap::Args;
use manyview::bench::proof;
use manyview::config::{OptionId, Origin, Settings, Status};
use manyview::launch::{Launch, by_vulkan};
use manyview::report::Summary;
use manyview::window::{Monitor, PanelServer, monitors};
use std::ffi::OsString;
use std::io::Write;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use tempfile::TempDir;

#[derive(Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    layer: LayerArguments,
    /// APP is the ID of a program in Flatpak, such as `org.supertuxproject.SuperTux`
    #[arg(long)]
    flatpak: bool,
    /// The program and its arguments
    #[arg(required = true, trailing_var_arg = true, value_name = "APP")]
    command: Vec<OsString>,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    start(&arguments.layer, &arguments.command, arguments.flatpak)
}

/// Runs a program and its arguments under the layer; `flatpak`: the first word is the ID of one in Flatpak.
pub(super) fn start(layer: &LayerArguments, command: &[OsString], flatpak: bool) -> Outcome {
    let mut settings = layer.settings()?;
    let chosen = panel::choose(&mut settings)?;
    let status = match settings.get(OptionId::Prove) {
        Some(_) => Some(StatusFile::new(&mut settings)?),
        None => None,
    };
    if settings.get(OptionId::Panel).is_some() {
        let socket = PanelServer::place();
        settings.set(
            OptionId::PanelSocket,
            socket.to_string_lossy(),
            Origin::Default,
        );
    }
    let launch = match flatpak {
        true => Launch::in_flatpak(command, &settings)?,
        false => Launch::prepare(command, &settings)?,
    };
    let panel = panel::open(&launch.config)?;
    if let Some(chosen) = chosen {
        tell(&chosen);
    }
    if panel.is_none() && launch.config.output.is_interlaced() {
        // Without a screen the program has no window either.
        let monitors = monitors().unwrap_or_default();
        let resampled = monitors.iter().find_map(Monitor::resamples);
        resampled.iter().for_each(|sentence| tell(sentence));
    }
    if let Some(vulkan) = by_vulkan(command, |name| std::env::var_os(name)) {
        tell(&vulkan);
    }
    let explanation = launch.config.explain.as_ref();
    let before = explanation.map(|explain| stamps(&explain.files()));
    let ended = launch.run(|sentence| tell(&sentence))?;
    drop(panel);
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
    if let Some(status) = status {
        match status.proof() {
            // A closed stderr is no reason to fail.
            Some(proof) => drop(std::io::stderr().write_all(proof::text(&proof).as_bytes())),
            None => tell(&format_args!(
                "nothing is proved: the program has ended too early; give a smaller number with --prove"
            )),
        }
    }
    Ok(ExitCode::from(ended.code()))
}

/// The file in which the layer reports its progress.
pub(super) struct StatusFile {
    /// Dropped with the file.
    _folder: TempDir,
    file: PathBuf,
}

impl StatusFile {
    /// Makes the layer write it into a temporary folder.
    pub(super) fn new(settings: &mut Settings) -> Result<Self, CommandError> {
        let folder = scratch()?;
        let file = folder.path().join("status.json");
        settings.set(OptionId::Status, file.to_string_lossy(), Origin::Default);
        Ok(Self {
            _folder: folder,
            file,
        })
    }

    pub(super) fn file(&self) -> &Path {
        &self.file
    }

    /// The proof in it, once it is there.
    pub(super) fn proof(&self) -> Option<Summary> {
        serde_json::from_value(Status::read(&self.file)?.proof?).ok()
    }
}

/// Tells one version of a file from the next: device, inode and time of the last change.
fn stamps(files: &[PathBuf; 2]) -> [Option<(u64, u64, i64, i64)>; 2] {
    files.each_ref().map(|file| {
        let about = std::fs::metadata(file).ok()?;
        Some((about.dev(), about.ino(), about.mtime(), about.mtime_nsec()))
    })
}
