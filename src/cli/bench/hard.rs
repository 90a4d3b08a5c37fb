//! `manyview bench --hard`: draws the hard cases under every strategy and says which bounds hold.
#![forbid(unsafe_code)]

use super::super::error::CommandError;
use super::{Arguments, write_json};
use crate::cli::{Outcome as Ended, print, scratch, tell};
use image::{RgbImage, imageops};
use indicatif::{ProgressBar, ProgressStyle};
use manyview::atlas::{Grid, Limits, Tiles};
use manyview::bench::hard::{
    self, Bound, CASES, Case, Measure, Outcome, Subject, Verdict, measure, side_by_side,
};
use manyview::bench::{BenchError, CONFIGURATIONS, Configuration, find};
use manyview::config::{AtlasLayout, OptionId, Origin, Settings};
use manyview::launch::{Launch, Screen, Stop, once, writable};
use manyview::view::ViewIndex;
use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Pixels of the window. Markers are 149 rows high, and tiles are a multiple of 32 pixels apart: these touch.
const SIZE: [u32; 2] = [256, 192];
/// Size of the atlas that the oracle assumes. Drivers with a smaller maximum place the views elsewhere.
const LIMITS: Limits = Limits {
    side: 16384,
    layers: 2048,
};
/// The colour of the first of two passes in the scenes `equal-…` and in the gauge.
const RED: [u8; 3] = [255, 0, 0];
const GREEN: [u8; 3] = [0, 255, 0];
/// Counted from 1. In the first frame the layer may not know yet what the program's passes have in common.
const FRAME: u32 = 2;
const SOME_BOUNDS_MISSED: u8 = 1;

pub(super) fn run(arguments: &Arguments) -> Ended {
    let mut cases: Vec<&'static Case> = Vec::new();
    for name in &arguments.case {
        cases.push(find(CASES, |case| case.name, "--case", name)?);
    }
    if cases.is_empty() {
        cases.extend(CASES);
    }
    let mut configurations = Vec::new();
    for name in &arguments.strategy {
        configurations.push(find(
            CONFIGURATIONS,
            |known| known.name,
            "--strategy",
            name,
        )?);
    }
    if configurations.is_empty() {
        configurations.extend(hard::configurations());
    }
    for (purpose, file) in [("the JSON", &arguments.json), ("the CSV", &arguments.csv)] {
        if let Some(file) = file {
            writable(purpose, file)?;
        }
    }
    let outcomes = measured(&cases, &configurations, arguments.api())?;
    print(&hard::text(&outcomes))?;
    if let Some(file) = &arguments.json {
        write_json(&outcomes, file)?;
    }
    if let Some(file) = &arguments.csv {
        hard::write_csv(&outcomes, file)?;
        tell(&format_args!("wrote {}", file.display()));
    }
    let missed = outcomes
        .iter()
        .any(|outcome| outcome.verdict == Verdict::Missed);
    Ok(if missed {
        ExitCode::from(SOME_BOUNDS_MISSED)
    } else {
        ExitCode::SUCCESS
    })
}

fn measured(
    cases: &[&'static Case],
    configurations: &[&'static Configuration],
    api: &str,
) -> Result<Vec<Outcome>, CommandError> {
    let mut stop = Stop::watch()?;
    let program = super::measure::program("hard", "hard")?;
    let screen = if api == "egl" {
        Screen::None
    } else {
        Screen::find()?
    };
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}");
    let bar = ProgressBar::new(cases.len() as u64)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    let mut outcomes = Vec::new();
    for case in cases {
        bar.set_message(case.name);
        match case.subject {
            Subject::NotYet(why) => outcomes.push(not_yet(case, why)),
            Subject::Mask => {
                for bound in case.bounds {
                    outcomes.push(outcome(
                        case,
                        "",
                        bound,
                        bound.most,
                        measure::mask()?,
                        String::new(),
                    ));
                }
            }
            Subject::Scene {
                scene,
                views,
                cameras,
                options,
            } => {
                let folder = scratch()?;
                let mut runner = Runner {
                    case,
                    scene,
                    views,
                    cameras,
                    options,
                    program: &program,
                    screen: &screen,
                    api,
                    folder: folder.path(),
                    stop: &mut stop,
                    drawn: HashMap::new(),
                };
                for configuration in configurations {
                    outcomes.extend(runner.under(configuration)?);
                }
            }
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(outcomes)
}

fn not_yet(case: &Case, why: &str) -> Outcome {
    Outcome {
        case: case.name,
        strategy: "",
        unit: "",
        bound: None,
        measured: None,
        verdict: Verdict::NotYet,
        note: why.to_owned(),
    }
}

fn outcome(
    case: &Case,
    strategy: &'static str,
    bound: &Bound,
    most: f64,
    measured: f64,
    note: String,
) -> Outcome {
    let verdict = if measured <= most {
        Verdict::Held
    } else {
        Verdict::Missed
    };
    let why = hard::why(case.name, strategy).filter(|_| verdict == Verdict::Missed);
    let notes = [note.as_str(), why.unwrap_or_default()];
    let notes: Vec<_> = notes.into_iter().filter(|note| !note.is_empty()).collect();
    Outcome {
        case: case.name,
        strategy,
        unit: bound.measure.unit(),
        bound: Some(most),
        measured: measured.is_finite().then_some(measured),
        verdict,
        note: notes.join("; "),
    }
}

/// One scene: its own pictures, and those under the layer.
struct Runner<'a> {
    case: &'static Case,
    scene: &'static str,
    views: u32,
    cameras: [&'static str; 2],
    options: &'static [(OptionId, &'static str)],
    program: &'a Path,
    screen: &'a Screen,
    api: &'a str,
    folder: &'a Path,
    stop: &'a mut Stop,
    /// By view (None: the program as it is), width of the window, and place in it.
    drawn: HashMap<(Option<u32>, u32, u32), (RgbImage, String)>,
}

/// The results of a run under the layer.
struct Layered {
    views: Vec<RgbImage>,
    said: String,
    note: String,
}

impl Runner<'_> {
    fn under(
        &mut self,
        configuration: &'static Configuration,
    ) -> Result<Vec<Outcome>, CommandError> {
        let layered = match self.layered(configuration) {
            Ok(layered) => layered,
            // The program works without the layer, so its failure is a result.
            Err(CommandError::Bench(error)) => {
                let failed = |bound: &Bound| {
                    let most = bound.under(configuration, self.options);
                    let note = error.to_string();
                    outcome(
                        self.case,
                        configuration.name,
                        bound,
                        most,
                        f64::INFINITY,
                        note,
                    )
                };
                self.oracle(None, SIZE[0], 0)?;
                return Ok(self.case.bounds.iter().map(failed).collect());
            }
            Err(error) => return Err(error),
        };
        let layout = if side_by_side(configuration) && self.options.is_empty() {
            AtlasLayout::SideBySide
        } else {
            AtlasLayout::Layers
        };
        // Today's drivers can make a window of so many views; where one cannot, there are no tiles side by side.
        let tiles = Tiles::new(self.views, SIZE, Grid::FULL, layout, LIMITS);
        let mut outcomes = Vec::new();
        for bound in self.case.bounds {
            let mut worst = if bound.measure == Measure::Answers {
                let (_, said) = self.oracle(None, SIZE[0], 0)?;
                measure::answers(said, &layered.said)
            } else {
                0.0_f64
            };
            for (view, actual) in (0..self.views).zip(&layered.views) {
                let (width, x) = tiles.as_ref().map_or((SIZE[0], 0), |tiles| {
                    (tiles.texture_width(), tiles.place(ViewIndex(view)).1)
                });
                worst = worst.max(self.measure(bound.measure, view, width, x, actual)?);
            }
            let most = bound.under(configuration, self.options);
            let note = layered.note.clone();
            outcomes.push(outcome(
                self.case,
                configuration.name,
                bound,
                most,
                worst,
                note,
            ));
        }
        Ok(outcomes)
    }

    /// One view against its bound; `width` and `x` are the place of its tile.
    fn measure(
        &mut self,
        of: Measure,
        view: u32,
        width: u32,
        x: u32,
        actual: &RgbImage,
    ) -> Result<f64, CommandError> {
        let [spacing, focal] = self
            .cameras
            .map(|number| number.parse().unwrap_or(f64::NAN));
        let eye = (f64::from(view) - (f64::from(self.views) - 1.0) / 2.0) * spacing;
        Ok(match of {
            Measure::Answers | Measure::Mask => 0.0,
            Measure::Missed => measure::area(actual, RED),
            Measure::Place => {
                let (_, said) = self.oracle(None, SIZE[0], 0)?;
                measure::place(actual, &measure::markers(said), eye, focal)
            }
            Measure::Same => measure::differing(&self.oracle(None, SIZE[0], 0)?.0, actual),
            _ => {
                let (expected, _) = self.oracle(Some(view), width, x)?;
                match of {
                    Measure::Steps => measure::worst_step(expected, actual),
                    Measure::Foreign => measure::foreign(expected, actual),
                    Measure::Edge => measure::edge(expected, actual),
                    Measure::Area => measure::area_error(expected, actual, GREEN),
                    Measure::Level => measure::level(expected, actual),
                    _ => measure::differing(expected, actual),
                }
            }
        })
    }

    /// The scene's picture and answers without the layer: one view, or the program as it is.
    fn oracle(
        &mut self,
        view: Option<u32>,
        width: u32,
        x: u32,
    ) -> Result<&(RgbImage, String), CommandError> {
        let key = (view, width, x);
        if !self.drawn.contains_key(&key) {
            let out = self.folder.join("oracle.png");
            let mut arguments = self.arguments();
            let mut add =
                |option: &str, value: &str| arguments.extend([option, value].map(OsString::from));
            if let Some(view) = view {
                add("--view", &format!("{view}/{}", self.views));
                add("--eye-spacing", self.cameras[0]);
                add("--focal-depth", self.cameras[1]);
            }
            if width != SIZE[0] {
                add("--canvas", &format!("{width}x{}", SIZE[1]));
                add("--offset", &format!("{x},0"));
            }
            add("--dump", &out.to_string_lossy());
            let what = format!("{} without the layer", self.case.name);
            let said = once::bare(self.program, &arguments, self.screen, &what, self.stop)?;
            let picture = self.picture(&out, &what)?;
            self.drawn.insert(key, (picture, said));
        }
        Ok(&self.drawn[&key])
    }

    fn layered(&mut self, configuration: &'static Configuration) -> Result<Layered, CommandError> {
        let at = |name: &str| self.folder.join(name);
        let (atlas, report) = (at("atlas.png"), at("report.json"));
        // A picture of an earlier run must not count as one of this run.
        let _ = std::fs::remove_file(&atlas);
        let mut settings = Settings::default();
        let all = configuration.options.iter().chain(self.options);
        for (id, value) in all {
            settings.set(*id, *value, Origin::CommandLine);
        }
        let path = |path: &PathBuf| path.to_string_lossy().into_owned();
        for (id, value) in [
            (OptionId::Views, self.views.to_string()),
            (OptionId::EyeSpacing, self.cameras[0].to_owned()),
            (OptionId::FocalDepth, self.cameras[1].to_owned()),
            (OptionId::CaptureOut, path(&atlas)),
            (OptionId::CaptureFrames, FRAME.to_string()),
            (OptionId::CaptureWhat, "atlas".to_owned()),
            (OptionId::Report, path(&report)),
        ] {
            settings.set(id, value, Origin::CommandLine);
        }
        let mut command = vec![self.program.as_os_str().to_owned()];
        command.extend(self.arguments());
        let launch = Launch::prepare(&command, &settings)?;
        let what = format!("{} with {}", self.case.name, configuration.name);
        let said = once::layered(&launch, self.screen, &what, self.stop)?;
        let atlas = self.picture(&atlas, &what)?;
        let (width, height) = (atlas.width() / self.views, atlas.height());
        let views = (0..self.views)
            .map(|view| imageops::crop_imm(&atlas, view * width, 0, width, height).to_image())
            .collect();
        Ok(Layered {
            views,
            said,
            note: super::measure::Report::read(&report).words(),
        })
    }

    fn arguments(&self) -> Vec<OsString> {
        let (size, frames) = (format!("{}x{}", SIZE[0], SIZE[1]), FRAME.to_string());
        let ours = ["--api", self.api, "--size", &size, "--frames", &frames];
        ["--check", "--case", self.scene]
            .into_iter()
            .chain(ours)
            .map(OsString::from)
            .collect()
    }

    fn picture(&self, file: &Path, what: &str) -> Result<RgbImage, CommandError> {
        let picture = image::open(file).map_err(|error| BenchError::NoPicture {
            what: what.to_owned(),
            reason: error.to_string(),
        })?;
        Ok(picture.into_rgb8())
    }
}
