//! `manyview bench`: its options; `measure` does the work.
#![forbid(unsafe_code)]

mod disocclusion;
mod hard;
mod measure;
mod prove;
mod splats;
mod walk;

use super::error::CommandError;
use super::layer::variable;
use super::mask::size;
use super::{Outcome, json, print, tell};
use clap::Args;
use manyview::bench::hard::CASES;
use manyview::bench::{
    BenchError, CONFIGURATIONS, DEFAULT_CONFIGURATIONS, DEFAULT_SCENES, PRESETS, Preset, SCENES,
    Scene, Variant, chart, find, table,
};
use manyview::config::{Config, Optimisation, OptionId, Settings};
use manyview::launch::writable;
use measure::Group;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Size of the window in pixels unless given: that of the demos.
const SIZE: (u32, u32) = (512, 384);
const VIEWS: &str = "8";
const FRAMES: &str = "15";
const MOST_FRAMES: u32 = 10_000;

#[derive(Args)]
pub(crate) struct Arguments {
    /// Scene to draw, several by commas or by giving it again [default: mesh-100k,draws-3000,fill,room]
    #[arg(
        long,
        value_name = "NAME",
        value_delimiter = ',',
        conflicts_with = "preset"
    )]
    scene: Vec<String>,
    /// Configuration of the layer, see --list [default: replay,instanced,geometry]
    #[arg(
        long,
        value_name = "NAME",
        value_delimiter = ',',
        conflicts_with = "preset"
    )]
    strategy: Vec<String>,
    /// Number of views [default: 8]
    #[arg(
        long,
        value_name = "N",
        value_delimiter = ',',
        conflicts_with = "preset",
        allow_hyphen_values = true
    )]
    views: Vec<String>,
    /// Size of a view over the size of the window [default: 1]
    #[arg(
        long,
        value_name = "F",
        value_delimiter = ',',
        conflicts_with = "preset",
        allow_hyphen_values = true
    )]
    view_scale: Vec<String>,
    /// Panel whose picture is made, as for `run` [default: that of the layer]
    #[arg(long, value_name = "NAME|FILE")]
    display: Option<String>,
    /// Measure each configuration once more without an optimisation of the layer, see `run --disable`
    #[arg(
        long,
        value_name = "unseen|mono|lists|uniforms|frustum",
        value_delimiter = ',',
        conflicts_with = "preset"
    )]
    disable: Vec<String>,
    /// The former name of --disable
    #[arg(long, hide = true, value_delimiter = ',', conflicts_with_all = ["preset", "disable"])]
    without: Vec<String>,
    /// Size of the window in pixels [default: 512x384, or the preset's]
    #[arg(long, value_name = "WxH", value_delimiter = ',')]
    size: Vec<String>,
    /// How often each program has its turn [default: 15]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    frames: Option<String>,
    /// Hold so many frames per second of your own program by hybrid, and tell of each frame how many views that drew and how far its picture is off; the
    /// program has to draw the same frames each time, as a replayed trace does
    #[arg(long, value_name = "F", requires = "command", conflicts_with_all = ["strategy", "disable", "without", "view_scale"], allow_hyphen_values = true)]
    fps: Option<String>,
    /// An experiment of a paper, with the paper's figures beside ours, see --list
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// Where the scenes draw: a window, or off screen with EGL, which needs no X server [default: glx]
    #[arg(long, value_name = "glx|egl", value_parser = ["glx", "egl"])]
    api: Option<String>,
    /// Write everything that was measured
    #[arg(long, value_name = "FILE.json")]
    json: Option<PathBuf>,
    /// Write one line for each scene, number of views and configuration
    #[arg(long, value_name = "FILE.csv")]
    csv: Option<PathBuf>,
    /// Draw time against error, one panel for each scene
    #[arg(long, value_name = "FILE.png|FILE.svg")]
    chart: Option<PathBuf>,
    /// Draw the hard cases under every strategy and compare them with their bounds; status 1 if one is missed
    #[arg(long, conflicts_with_all = ["scene", "preset", "views", "view_scale", "display", "disable", "without", "size", "frames", "chart", "list"])]
    hard: bool,
    /// Hard case to draw, several by commas or by giving it again [default: all of them]
    #[arg(long, value_name = "NAME", value_delimiter = ',', requires = "hard")]
    case: Vec<String>,
    /// List scenes, configurations, presets and hard cases, and measure nothing
    #[arg(long)]
    list: bool,
    /// A program of your own and its arguments: each configuration is proved on so many --frames of it
    #[arg(last = true, value_name = "APP", conflicts_with_all = ["scene", "preset", "size", "disable", "without"])]
    command: Vec<OsString>,
}

impl Arguments {
    fn api(&self) -> &str {
        self.api.as_deref().unwrap_or("glx")
    }
}

/// Warns of former names: in these options, and in the variables, which apply to the caller's own program.
fn tell_renamings(arguments: &Arguments) {
    let mut settings = Settings::default();
    if !arguments.without.is_empty() {
        settings.command_line(OptionId::Disable, &arguments.without.join(","), true);
    } else {
        settings.command_line(OptionId::Disable, &arguments.disable.join(","), false);
    }
    if !arguments.command.is_empty() {
        settings = settings.over(Settings::from_variables(variable));
        // A broken file is reported where it is used.
        settings = settings.clone().with_file().unwrap_or(settings);
    }
    for renaming in settings.renamings() {
        tell(renaming);
    }
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    if arguments.list {
        return print(&list());
    }
    tell_renamings(arguments);
    if arguments.hard {
        return hard::run(arguments);
    }
    let preset = match &arguments.preset {
        Some(name) => Some(find(PRESETS, |preset| preset.name, "--preset", name)?),
        None => None,
    };
    if let Some(preset) = preset.filter(|preset| !preset.splats.is_empty()) {
        splats::check(arguments, preset)?;
        check_files(arguments)?;
        return splats::run(arguments, preset);
    }
    if let Some(preset) = preset.filter(|preset| preset.draws_models()) {
        let size = disocclusion::check(arguments, preset, sizes(arguments, Some(preset))?)?;
        check_files(arguments)?;
        return disocclusion::run(arguments, preset, size);
    }
    if let Some(rate) = &arguments.fps {
        check_files(arguments)?;
        return walk::run(arguments, rate);
    }
    let frames = arguments.frames.as_deref().unwrap_or(FRAMES);
    let Some(rounds) = frames
        .parse()
        .ok()
        .filter(|frames| (1..=MOST_FRAMES).contains(frames))
    else {
        return Err(BenchError::Frames(frames.to_owned()).into());
    };
    if !arguments.command.is_empty() {
        if arguments.chart.is_some() {
            return Err(BenchError::NoChart.into());
        }
        check_files(arguments)?;
        return prove::run(arguments, rounds);
    }
    let groups = groups(arguments, preset)?;
    check_files(arguments)?;
    let bench = measure::run(&groups, rounds, arguments.api(), preset)?;
    if let Some(preset) = preset {
        print(&format!("{}: {}\n\n", preset.name, preset.about))?;
    }
    print(&table::text(&bench))?;
    if let Some(file) = &arguments.json {
        write_json(&bench, file)?;
    }
    if let Some(file) = &arguments.csv {
        bench.write_csv(file)?;
        tell(&format_args!("wrote {}", file.display()));
    }
    if let Some(file) = &arguments.chart {
        chart::write(&bench, file)?;
        tell(&format_args!("wrote {}", file.display()));
    }
    Ok(ExitCode::SUCCESS)
}

/// Checks that the files can be written before anything is measured.
fn check_files(arguments: &Arguments) -> Result<(), CommandError> {
    for (purpose, file) in [
        ("the JSON", &arguments.json),
        ("the CSV", &arguments.csv),
        ("the chart", &arguments.chart),
    ] {
        if let Some(file) = file {
            writable(purpose, file)?;
        }
    }
    if let Some(file) = &arguments.chart {
        chart::Format::of(file)?;
    }
    Ok(())
}

/// Writes the results as JSON, and says so.
fn write_json(measured: &impl serde::Serialize, file: &Path) -> Result<(), CommandError> {
    std::fs::write(file, json(measured)?).map_err(|error| unwritten(file, &error))?;
    tell(&format_args!("wrote {}", file.display()));
    Ok(())
}

fn unwritten(file: &Path, reason: &dyn std::fmt::Display) -> CommandError {
    BenchError::Write {
        file: file.to_owned(),
        reason: reason.to_string(),
    }
    .into()
}

/// The groups that are measured together, checked. Each is one scene, size and number of views, drawn in turns by all configurations.
fn groups(
    arguments: &Arguments,
    preset: Option<&'static Preset>,
) -> Result<Vec<Group>, CommandError> {
    let names = |given: &[String],
                 presets: fn(&Preset) -> &'static [&'static str],
                 default: &[&str]|
     -> Vec<String> {
        match preset {
            Some(preset) => owned(presets(preset)),
            None => or_default(given, default),
        }
    };
    let mut scenes: Vec<&'static Scene> = Vec::new();
    for name in names(&arguments.scene, |preset| preset.scenes, DEFAULT_SCENES) {
        scenes.push(find(SCENES, |scene| scene.name, "--scene", &name)?);
    }
    let sizes = sizes(arguments, preset)?;
    let mut disabled = Vec::new();
    for name in arguments.disable.iter().chain(&arguments.without) {
        let name = OptionId::Disable.spec().present_word(name);
        disabled.push(find(&Optimisation::ALL, |known| known.0, "--disable", name)?.0);
    }
    let mut variants = Vec::new();
    for name in names(
        &arguments.strategy,
        |preset| preset.configurations,
        DEFAULT_CONFIGURATIONS,
    ) {
        let configuration = find(CONFIGURATIONS, |known| known.name, "--strategy", &name)?;
        for view_scale in names(&arguments.view_scale, |_| &["1"], &["1"]) {
            let with = Variant {
                configuration,
                view_scale,
                display: arguments.display.clone(),
                disabled: None,
            };
            variants.push(with.clone());
            variants.extend(disabled.iter().map(|&disabled| Variant {
                disabled: Some(disabled),
                ..with.clone()
            }));
        }
    }
    let views = names(&arguments.views, |preset| preset.views, &[VIEWS]);
    let mut groups = Vec::new();
    for scene in scenes {
        for &size in &sizes {
            for text in &views {
                let mut number = 1;
                for variant in &variants {
                    number = Config::from_settings(&variant.settings(text))?.views;
                }
                groups.push(Group {
                    scene,
                    size,
                    views: number,
                    variants: variants.clone(),
                });
            }
        }
    }
    Ok(groups)
}

/// The given values, else those of the preset, else the default.
fn sizes(
    arguments: &Arguments,
    preset: Option<&'static Preset>,
) -> Result<Vec<(u32, u32)>, CommandError> {
    let mut sizes = Vec::new();
    for text in &arguments.size {
        sizes.push(size(text).ok_or_else(|| CommandError::Size(text.clone()))?);
    }
    if sizes.is_empty() {
        sizes.push(preset.map_or(SIZE, |preset| preset.size));
    }
    Ok(sizes)
}

/// The given values, else the default.
fn or_default(given: &[String], default: &[&str]) -> Vec<String> {
    match given {
        [] => owned(default),
        given => given.to_vec(),
    }
}

fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn list() -> String {
    let line = |name: &str, about: &str| vec![format!("  {name}"), about.to_owned()];
    let mut lines = vec![vec!["scenes".to_owned()]];
    lines.extend(SCENES.iter().map(|scene| line(scene.name, scene.about)));
    lines.push(vec!["configurations".to_owned()]);
    lines.extend(
        CONFIGURATIONS
            .iter()
            .map(|known| line(known.name, known.about)),
    );
    lines.push(vec!["presets".to_owned()]);
    lines.extend(PRESETS.iter().map(|preset| line(preset.name, preset.about)));
    lines.push(vec!["hard cases".to_owned()]);
    lines.extend(CASES.iter().map(|case| line(case.name, case.about)));
    table::columns(&lines)
}
