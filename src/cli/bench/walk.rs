//! `manyview bench --fps F -- APP`: the user's own program, held at a rate by `hybrid`.
#![forbid(unsafe_code)]

use super::super::error::CommandError;
use super::super::layer::variable;
use super::super::run::StatusFile;
use super::super::{Outcome, print, scratch, tell};
use super::{Arguments, measure, unwritten, write_json};
use image::RgbImage;
use manyview::bench::BenchError;
use manyview::bench::walk::{Frame, Walk, told, write};
use manyview::config::{Config, OptionId, Origin, Settings, TrueViews};
use manyview::launch::{CaptureJob, Launch};
use manyview::metric::Comparison;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, SystemTime};

/// Frames unless given.
const FRAMES: &str = "2..200";
/// As many frames as the layer's report holds.
const MOST: u64 = 900;
/// For one run of the program.
const LIMIT: Duration = Duration::from_secs(900);

/// The request for one run of the program.
struct Run<'a> {
    arguments: &'a Arguments,
    scratch: &'a Path,
    /// Under the options of the layer.
    options: &'a [(OptionId, &'a str)],
}

impl<'a> Run<'a> {
    fn by<'b>(&self, options: &'b [(OptionId, &'b str)]) -> Run<'b>
    where
        'a: 'b,
    {
        Run { options, ..*self }
    }

    /// Writes pictures of frames; returns their files and the report.
    fn pictures(
        &self,
        name: &str,
        frames: &RangeInclusive<u64>,
    ) -> Result<(BTreeMap<u64, PathBuf>, serde_json::Value), CommandError> {
        let mut settings = Settings::default();
        let report = self.scratch.join("report.json");
        let out = self.scratch.join(format!("{name}-%d.png"));
        let range = format!("{}..{}", frames.start(), frames.end());
        let of_paths = [(OptionId::Report, &report), (OptionId::CaptureOut, &out)];
        for (id, path) in of_paths {
            settings.set(id, path.to_string_lossy(), Origin::CommandLine);
        }
        settings.set(OptionId::CaptureFrames, range, Origin::CommandLine);
        for (id, value) in self.options {
            settings.set(*id, *value, Origin::CommandLine);
        }
        let status = StatusFile::new(&mut settings)?;
        let settings = given(self.arguments, settings)?;
        let launch = Launch::prepare(&self.arguments.command, &settings)?;
        let Some(capture) = &launch.config.capture else {
            return Err(CommandError::NoPicture);
        };
        let job = CaptureJob {
            launch: &launch,
            capture,
            status: status.file(),
            timeout: LIMIT,
        };
        let files = job.run(|_, _| {})?.files;
        let report = std::fs::read_to_string(&report).unwrap_or_default();
        let report = serde_json::from_str(&report).unwrap_or_default();
        Ok((frames.clone().zip(files).collect(), report))
    }

    /// Milliseconds and true views of frames, in a run that writes no pictures.
    fn times(&self, frames: &RangeInclusive<u64>) -> Result<Vec<(f64, u32)>, CommandError> {
        // The picture ends the run; the report then has the frame before it.
        let end = frames.end() + 1;
        let (_, report) = self.pictures("end", &(end..=end))?;
        let notes = report["notes"].as_array().and_then(|notes| notes.last());
        let views = told(&report, frames.clone());
        views.ok_or_else(|| {
            let note = notes.and_then(|note| note.as_str());
            let reason = note.unwrap_or("`manyview run --strategy hybrid --report` says why");
            BenchError::NoWalk(reason.to_owned()).into()
        })
    }
}

/// The options of the command over those of the environment.
fn given(arguments: &Arguments, mut settings: Settings) -> Result<Settings, CommandError> {
    let views = arguments.views.first().map(String::as_str);
    let ours = [
        (OptionId::Views, views),
        (OptionId::Display, arguments.display.as_deref()),
    ];
    for (id, value) in ours {
        if let Some(value) = value {
            settings.set(id, value, Origin::CommandLine);
        }
    }
    // Pictures of several runs are compared, so the cameras stand still unless the user places them.
    let mut still = Settings::default();
    still.set(OptionId::AutoDepth, "0", Origin::Default);
    Ok(settings.over(Settings::from_env(variable)?).over(still))
}

/// `200` or `100..400`.
fn frames(text: &str) -> Result<RangeInclusive<u64>, BenchError> {
    let range = match text.split_once("..") {
        Some((first, last)) => (first.parse().ok(), last.parse().ok()),
        None => (Some(2), text.parse().ok()),
    };
    match range {
        (Some(first), Some(last)) if (2..=last).contains(&first) && last - first < MOST => {
            Ok(first..=last)
        }
        _ => Err(BenchError::WalkFrames(text.to_owned())),
    }
}

pub(super) fn run(arguments: &Arguments, rate: &str) -> Outcome {
    let frames = frames(arguments.frames.as_deref().unwrap_or(FRAMES))?;
    let scratch = scratch()?;
    let hybrid = (OptionId::Strategy, "hybrid");
    let walk = Run {
        arguments,
        scratch: scratch.path(),
        options: &[],
    };
    // Checks the rate before anything is started.
    let mut asked = Settings::default();
    asked.set(OptionId::Strategy, "hybrid", Origin::CommandLine);
    asked.set(OptionId::Fps, rate, Origin::CommandLine);
    let config = Config::from_settings(&given(arguments, asked)?)?;
    let TrueViews::Rate(fps) = config.true_views else {
        return Err(BenchError::NoWalk("leave MANYVIEW_TRUE_VIEWS out".to_owned()).into());
    };
    let all = config.views.to_string();
    let bar = measure::bar(3);
    bar.set_message("at the rate");
    let held = walk.by(&[hybrid, (OptionId::Fps, rate)]).times(&frames)?;
    bar.inc(1);
    bar.set_message("all views drawn");
    let drawn_all = [hybrid, (OptionId::TrueViews, &*all)];
    let exact_times = walk.by(&drawn_all).times(&frames)?;
    bar.inc(1);
    let (exact, _) = walk.by(&drawn_all).pictures("exact", &frames)?;
    bar.inc(1);
    let levels: BTreeSet<u32> = held.iter().map(|(_, drawn)| *drawn).collect();
    bar.inc_length(2 * levels.len() as u64);
    let mut pictures = BTreeMap::new();
    for level in levels {
        bar.set_message(format!("{level} views drawn"));
        let text = level.to_string();
        for holes in ["fill", "mark"] {
            let options = [
                hybrid,
                (OptionId::TrueViews, &*text),
                (OptionId::Holes, holes),
            ];
            let (files, _) = walk
                .by(&options)
                .pictures(&format!("{holes}-{level}"), &frames)?;
            pictures.insert((level, holes), files);
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    let read = |files: Option<&BTreeMap<u64, PathBuf>>, frame: u64| {
        let file = files.and_then(|files| files.get(&frame));
        let file = file.ok_or_else(|| BenchError::NoWalk(format!("frame {frame} is missing")))?;
        let picture = image::open(file).map_err(|error| unwritten(file, &error))?;
        Ok::<RgbImage, CommandError>(picture.into_rgb8())
    };
    let mut rows = Vec::new();
    for ((frame, (ms, drawn)), (exact_ms, _)) in frames.zip(held).zip(exact_times) {
        let truth = read(Some(&exact), frame)?;
        let [filled, marked] =
            ["fill", "mark"].map(|holes| read(pictures.get(&(drawn, holes)), frame));
        let (filled, marked) = (filled?, marked?);
        let holes = filled.pixels().zip(marked.pixels());
        let holes = holes.filter(|(filled, marked)| filled != marked).count();
        let compared = Comparison::new(&truth, &filled, None);
        let psnr = compared.map_or(0.0, |compared| compared.psnr);
        rows.push(Frame {
            frame,
            ms,
            exact_ms,
            drawn,
            psnr: psnr.is_finite().then_some(psnr),
            hole_percent: 100.0 * holes as f64 / f64::from(truth.width() * truth.height()),
        });
    }
    let command = arguments.command.iter();
    let walk = Walk {
        date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        command: command
            .map(|word| word.to_string_lossy().into_owned())
            .collect(),
        rate: fps,
        views: config.views,
        frames: rows,
    };
    print(&walk.text())?;
    save(arguments, &walk)?;
    Ok(ExitCode::SUCCESS)
}

fn save(arguments: &Arguments, walk: &Walk) -> Result<(), CommandError> {
    if let Some(file) = &arguments.json {
        write_json(walk, file)?;
    }
    if let Some(file) = &arguments.csv {
        walk.write_csv(file)?;
        tell(&format_args!("wrote {}", file.display()));
    }
    if let Some(file) = &arguments.chart {
        write(walk, file)?;
        tell(&format_args!("wrote {}", file.display()));
    }
    Ok(())
}
