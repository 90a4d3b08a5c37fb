//! Scenes in turns: the bare program, then each configuration, round after round.
#![forbid(unsafe_code)]

use super::super::error::CommandError;
use crate::cli::scratch;
use image::RgbImage;
use indicatif::{ProgressBar, ProgressStyle};
use manyview::bench::protocol::{Hello, Times};
use manyview::bench::{
    AUTO, Bench, BenchError, CONFIGURATIONS, Configuration, EXACT, Limit, PictureError, Preset,
    Row, Scene, Spread, Variant, median, ratios,
};
use manyview::config::{OptionId, Origin};
use manyview::launch::{Launch, Screen, Stepped, Stop, library};
use manyview::metric::Comparison;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Frames before the first turn: programs compile shaders and `auto` searches. The picture of the last one is compared.
const WARM_UP: u32 = 4;
/// A turn draws several frames if the bare program needs less than this for one, ms: the first frame after another program's
/// turn finds its caches cold.
const TURN: f64 = 15.0;
const MOST_OF_A_TURN: u32 = 10;

/// Frames in which `auto` makes its choice.
const TRIAL: u32 = 80;

/// The programs that take turns.
pub(super) struct Group {
    pub(super) scene: &'static Scene,
    /// Pixels of the window.
    pub(super) size: (u32, u32),
    pub(super) views: u32,
    pub(super) variants: Vec<Variant>,
}

/// One program of a group and what it answered.
struct Member {
    stepped: Stepped,
    /// The value of each round, ns.
    wall: Vec<f64>,
    cpu: Vec<f64>,
    gpu: Vec<f64>,
}

impl Member {
    fn new(stepped: Stepped) -> Self {
        Self {
            stepped,
            wall: Vec::new(),
            cpu: Vec::new(),
            gpu: Vec::new(),
        }
    }

    fn turn(&mut self, frames: u32, stop: &mut Stop) -> Result<(), CommandError> {
        let Times { wall, cpu, gpu } = self.stepped.step(frames, stop)?;
        self.wall.push(median(&wall));
        self.cpu.push(median(&cpu));
        if !gpu.is_empty() {
            self.gpu.push(median(&gpu));
        }
        Ok(())
    }
}

/// Measures all groups.
pub(super) fn run(
    groups: &[Group],
    rounds: u32,
    api: &str,
    preset: Option<&'static Preset>,
) -> Result<Bench, CommandError> {
    let date = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
    let mut stop = Stop::watch()?;
    let programs = programs(groups)?;
    let screen = if api == "egl" {
        Screen::None
    } else {
        Screen::find()?
    };
    let mut bench = Bench {
        date,
        command: std::env::args().collect(),
        renderer: String::new(),
        version: String::new(),
        clock: "wall clock to the end of glFinish after the swap",
        rounds,
        warm_up: WARM_UP,
        preset: preset.map(|preset| preset.name),
        rows: Vec::new(),
        limits: Vec::new(),
    };
    let bar = bar(groups
        .iter()
        .map(|group| (group.variants.len() as u64 + 2) + u64::from(rounds))
        .sum());
    for (group, program) in groups.iter().zip(&programs) {
        bar.set_message(format!("{}, {} views", group.scene.name, group.views));
        let runner = Runner {
            group,
            program,
            screen: &screen,
            api,
        };
        let (hello, rows) = runner.measure(rounds, &mut stop, &bar)?;
        Hello {
            renderer: bench.renderer,
            version: bench.version,
        } = hello;
        let first = bench.rows.len();
        bench.rows.extend(rows);
        limit(&mut bench, group);
        for (at, variant) in (first..).zip(&group.variants) {
            let figure = preset.and_then(|preset| {
                preset.figure(group.scene.name, group.views, variant.configuration.name)
            });
            if let Some(figure) = figure {
                bench.compare(at, figure);
            }
        }
    }
    bar.finish_and_clear();
    Ok(bench)
}

/// The program of each group. All are found before the first is started.
fn programs(groups: &[Group]) -> Result<Vec<PathBuf>, CommandError> {
    let scenes = groups.iter().map(|group| group.scene);
    scenes
        .map(|scene| program(scene.name, scene.program))
        .collect()
}

/// Finds the program of a scene.
pub(super) fn program(scene: &'static str, program: &'static str) -> Result<PathBuf, CommandError> {
    let folders = library::scene_folders()?;
    let mut places = folders.iter().map(|folder| folder.join(program));
    places.find(|path| path.is_file()).ok_or_else(|| {
        BenchError::NoScene {
            scene,
            program,
            searched: folders.to_vec(),
        }
        .into()
    })
}

/// A progress bar on stderr, hidden when that is no terminal.
pub(super) fn bar(steps: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{spinner} {wide_bar} {percent} %, {eta} left  {msg}");
    ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// The rate of the bare program; the best one of several runs.
fn limit(bench: &mut Bench, group: &Group) {
    let (scene, (width, height)) = (group.scene.name, group.size);
    let Some(row) = bench.rows.last() else { return };
    let Some((rate, unit)) = group.scene.work.per_second(group.size, row.bare_ms.median) else {
        return;
    };
    let same =
        |limit: &&mut Limit| (limit.scene, limit.width, limit.height) == (scene, width, height);
    match bench.limits.iter_mut().find(same) {
        Some(limit) => limit.rate = limit.rate.max(rate),
        None => bench.limits.push(Limit {
            scene,
            width,
            height,
            rate,
            unit,
        }),
    }
}

struct Runner<'a> {
    group: &'a Group,
    program: &'a Path,
    screen: &'a Screen,
    api: &'a str,
}

impl Runner<'_> {
    fn measure(
        &self,
        rounds: u32,
        stop: &mut Stop,
        bar: &ProgressBar,
    ) -> Result<(Hello, Vec<Row>), CommandError> {
        let folder = scratch()?;
        let exact = Variant {
            configuration: &EXACT,
            view_scale: "1".to_owned(),
            display: self.group.variants.first().and_then(|v| v.display.clone()),
            disabled: None,
        };
        let place = Place::new(folder.path(), "exact");
        self.layered(&exact, &place, stop)?.step(WARM_UP, stop)?;
        let exact = self.picture(&exact, &place)?;
        bar.inc(1);

        let places: Vec<_> = (0..self.group.variants.len())
            .map(|at| Place::new(folder.path(), &at.to_string()))
            .collect();
        let what = format!("{} without the layer", self.group.scene.name);
        let mut bare = Member::new(Stepped::bare(
            self.program,
            &self.arguments(),
            self.screen,
            &what,
            stop,
        )?);
        let warm = bare.stepped.step(WARM_UP, stop)?;
        bar.inc(1);
        let mut members = Vec::new();
        let mut found = Vec::new();
        for (variant, place) in self.group.variants.iter().zip(&places) {
            let taken = self.found(variant, stop)?;
            let taken_variant = Variant {
                configuration: taken.unwrap_or(variant.configuration),
                ..variant.clone()
            };
            found.push(taken);
            let mut stepped = self.layered(&taken_variant, place, stop)?;
            stepped.step(WARM_UP, stop)?;
            members.push(Member::new(stepped));
            bar.inc(1);
        }
        // The first frames compile shaders, so the last one gives the time of a frame.
        let frame = warm
            .wall
            .last()
            .map_or(TURN, |&ns| (ns as f64 * 1e-6).max(1e-3));
        let frames = ((TURN / frame).ceil() as u32).clamp(1, MOST_OF_A_TURN);
        for round in 0..rounds as usize {
            bare.turn(frames, stop)?;
            // The order alternates, so that no program always follows the same one.
            let count = members.len();
            for at in 0..count {
                let at = if round % 2 == 0 { at } else { count - 1 - at };
                if let Some(member) = members.get_mut(at) {
                    member.turn(frames, stop)?;
                }
            }
            bar.inc(1);
        }
        let hello = bare.stepped.hello.clone();
        let mut rows = Vec::new();
        let ran = self.group.variants.iter().zip(found).zip(&places);
        for (member, ((variant, found), place)) in members.into_iter().zip(ran) {
            let picture = self.picture(variant, place)?;
            let compared =
                Comparison::new(&exact, &picture, None).map_err(|error| BenchError::NoPicture {
                    what: self.what(variant),
                    reason: error.to_string(),
                })?;
            let row = self.row(variant, frames, &bare, &member, compared.into(), place);
            rows.extend(row.map(|mut row| {
                row.notes.extend(found.map(|f| format!("takes {}", f.name)));
                row
            }));
        }
        Ok((hello, rows))
    }

    fn row(
        &self,
        variant: &Variant,
        frames_per_round: u32,
        bare: &Member,
        member: &Member,
        picture: PictureError,
        place: &Place,
    ) -> Option<Row> {
        let ms = |ns: &[f64]| Spread::of(&ns.iter().map(|ns| ns * 1e-6).collect::<Vec<_>>());
        let report = Report::read(&place.report);
        Some(Row {
            scene: self.group.scene.name,
            width: self.group.size.0,
            height: self.group.size.1,
            views: self.group.views,
            configuration: variant.name(),
            view_scale: variant.view_scale.clone(),
            disabled: variant.disabled,
            frames_per_round,
            ms: ms(&member.wall)?,
            bare_ms: ms(&bare.wall)?,
            times: Spread::of(&ratios(&member.wall, &bare.wall))?,
            cpu_ms: ms(&member.cpu)?.median,
            bare_cpu_ms: ms(&bare.cpu)?.median,
            gpu_ms: ms(&member.gpu),
            picture,
            view_bytes: report.view_bytes,
            paper: None,
            draws: report.draws,
            fallbacks: report.fallbacks,
            notes: report.notes,
        })
    }

    /// The choice of `auto`, as a configuration of its own, because captures are replayed. None for other configurations.
    fn found(
        &self,
        variant: &Variant,
        stop: &mut Stop,
    ) -> Result<Option<&'static Configuration>, CommandError> {
        if variant.configuration.name != AUTO {
            return Ok(None);
        }
        let cache = scratch()?;
        let settings = variant.settings(&self.group.views.to_string());
        let launch = Launch::prepare(&self.command(), &settings)?;
        let what = self.what(variant);
        let mut stepped = Stepped::trying(&launch, self.screen, cache.path(), &what, stop)?;
        stepped.step(TRIAL, stop)?;
        let kept = std::fs::read_to_string(cache.path().join("manyview/strategies.json"));
        let kept: BTreeMap<String, String> =
            serde_json::from_str(&kept.unwrap_or_default()).unwrap_or_default();
        let name = kept.into_values().next().unwrap_or_default();
        let found = CONFIGURATIONS.iter().find(|known| known.name == name);
        found.map(Some).ok_or_else(|| {
            let reason = "it found no strategy".to_owned();
            BenchError::NoPicture { what, reason }.into()
        })
    }

    fn layered(
        &self,
        variant: &Variant,
        place: &Place,
        stop: &mut Stop,
    ) -> Result<Stepped, CommandError> {
        let mut settings = variant.settings(&self.group.views.to_string());
        for (id, value) in [
            (
                OptionId::CaptureOut,
                place.picture.to_string_lossy().into_owned(),
            ),
            (OptionId::CaptureFrames, WARM_UP.to_string()),
            // The report is written ten times a second, which costs 0.1 % of the time.
            (
                OptionId::Report,
                place.report.to_string_lossy().into_owned(),
            ),
        ] {
            settings.set(id, value, Origin::Default);
        }
        let launch = Launch::prepare(&self.command(), &settings)?;
        Ok(Stepped::layered(
            &launch,
            self.screen,
            &self.what(variant),
            stop,
        )?)
    }

    fn command(&self) -> Vec<OsString> {
        let mut command = vec![self.program.as_os_str().to_owned()];
        command.extend(self.arguments());
        command
    }

    fn arguments(&self) -> Vec<OsString> {
        let (width, height) = self.group.size;
        let size = format!("{width}x{height}");
        let ours = ["--bench", "--api", self.api, "--size", &size];
        self.group
            .scene
            .arguments
            .iter()
            .copied()
            .chain(ours)
            .map(OsString::from)
            .collect()
    }

    /// For messages.
    fn what(&self, variant: &Variant) -> String {
        format!("{} with {}", self.group.scene.name, variant.name())
    }

    fn picture(&self, variant: &Variant, place: &Place) -> Result<RgbImage, CommandError> {
        let picture = image::open(&place.picture).map_err(|error| {
            let notes = Report::read(&place.report).notes;
            BenchError::NoPicture {
                what: self.what(variant),
                reason: notes
                    .into_iter()
                    .next()
                    .unwrap_or_else(|| error.to_string()),
            }
        })?;
        Ok(picture.into_rgb8())
    }
}

/// Paths of the files that a program writes under the layer.
struct Place {
    picture: PathBuf,
    report: PathBuf,
}

impl Place {
    fn new(folder: &Path, name: &str) -> Self {
        Self {
            picture: folder.join(format!("{name}.png")),
            report: folder.join(format!("{name}.json")),
        }
    }
}

/// The fields that are read from the layer's report.
#[derive(Default, serde::Deserialize)]
pub(super) struct Report {
    draws: BTreeMap<String, u64>,
    fallbacks: BTreeMap<String, u64>,
    notes: Vec<String>,
    view_bytes: Option<u64>,
}

impl Report {
    /// Default values if there is no file: the times are valid without it.
    pub(super) fn read(file: &Path) -> Self {
        let text = std::fs::read_to_string(file).unwrap_or_default();
        serde_json::from_str(&text).unwrap_or_default()
    }

    /// Why draws fell back to replay, and other notes.
    pub(super) fn words(self) -> String {
        let reasons: Vec<_> = self.fallbacks.into_keys().chain(self.notes).collect();
        reasons.join("; ")
    }
}
