//! The results, as JSON and as a flat table.

use super::error::BenchError;
use super::preset::Figure;
use super::statistics::Spread;
use crate::metric::Comparison;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// One run of `manyview bench`.
#[derive(Debug, Serialize)]
pub struct Bench {
    /// When it began: RFC 3339, UTC.
    pub date: String,
    /// The command line.
    pub command: Vec<String>,
    /// GL_RENDERER
    pub renderer: String,
    /// GL_VERSION, which names the driver's version.
    pub version: String,
    /// The clock of `ms` and `times`. Where the driver has timer queries, `gpu_ms` is given as well.
    pub clock: &'static str,
    /// Number of turns of each program.
    pub rounds: u32,
    /// Frames that each program drew before the first turn. The last of them is the one whose picture is compared.
    pub warm_up: u32,
    /// The name for `--preset`.
    pub preset: Option<&'static str>,
    /// One for each scene, size, number of views and configuration.
    pub rows: Vec<Row>,
    /// The rates of the bare programs.
    pub limits: Vec<Limit>,
}

/// One configuration of one scene. More than 12 fields: one for each member of the JSON.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Name of the scene.
    pub scene: &'static str,
    /// Pixels of the window.
    pub width: u32,
    /// Pixels of the window.
    pub height: u32,
    /// N
    pub views: u32,
    /// Name of the configuration, with the scale of its views if that is not 1.
    pub configuration: String,
    /// As `--view-scale` has it.
    pub view_scale: String,
    /// The optimisation that was turned off.
    pub disabled: Option<&'static str>,
    /// Frames of a turn; its time is their median.
    pub frames_per_round: u32,
    /// Time of a frame, ms.
    pub ms: Spread,
    /// Time of a frame of the bare program in the same run, ms.
    pub bare_ms: Spread,
    /// Time over that of the bare program in the same round.
    pub times: Spread,
    /// Processor time of the program's own thread for a frame, ms, without the driver's threads.
    pub cpu_ms: f64,
    /// The same for the bare program.
    pub bare_cpu_ms: f64,
    /// GPU time from the first to the last command of a frame, ms, where the driver is hardware with timer queries.
    pub gpu_ms: Option<Spread>,
    /// Error against the exact picture of the same frame.
    pub picture: PictureError,
    /// From the layer's report: memory of the views' colour, depth and stencil; none where there is no report.
    pub view_bytes: Option<u64>,
    /// The result of the paper of the preset.
    pub paper: Option<Paper>,
    /// From the layer's report: draws by method.
    pub draws: BTreeMap<String, u64>,
    /// From the layer's report: draws that fell back to replay, by reason.
    pub fallbacks: BTreeMap<String, u64>,
    /// From the layer's report.
    pub notes: Vec<String>,
}

impl Row {
    /// Whether `other` is the same row without the disabled optimisation.
    #[must_use]
    pub fn is_without(&self, with: &Row) -> bool {
        let scene = |row: &Row| (row.scene, row.width, row.height, row.views);
        let name = self.disabled.and_then(|disabled| {
            self.configuration
                .strip_suffix(&format!(" without {disabled}"))
        });
        scene(self) == scene(with) && name == Some(&with.configuration)
    }
}

/// The error of a picture against the exact one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PictureError {
    /// Whether it is equal bit by bit.
    pub exact: bool,
    /// dB; none for equal pictures, where it is infinite.
    pub psnr: Option<f64>,
    /// At most 1, which it is for equal pictures.
    pub ssim: f64,
    /// Largest difference of a channel, steps of 255.
    pub worst: u8,
    /// Channels of pixels that differ, per cent.
    pub wrong_subpixels_percent: f64,
}

impl From<Comparison> for PictureError {
    fn from(comparison: Comparison) -> Self {
        Self {
            exact: comparison.is_equal(),
            psnr: comparison.psnr.is_finite().then_some(comparison.psnr),
            ssim: comparison.ssim,
            worst: comparison.worst,
            wrong_subpixels_percent: comparison.wrong_subpixels_percent(),
        }
    }
}

/// A paper's numbers beside ours.
#[derive(Debug, Serialize)]
pub struct Paper {
    /// Frame time over that of a single view.
    pub times: Option<f64>,
    /// Speed-up over multi-pass rendering.
    pub speedup: Option<f64>,
    /// Our speed-up over our replay.
    pub our_speedup: Option<f64>,
    /// The statement of the text where there are no numbers.
    pub words: &'static str,
}

/// The rate of a bare program.
#[derive(Debug, Serialize)]
pub struct Limit {
    /// Name of the scene.
    pub scene: &'static str,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Work per second, in `unit`.
    pub rate: f64,
    /// Such as "million triangles/s".
    pub unit: &'static str,
}

impl Bench {
    /// Puts the paper's figure beside a row, once all rows of its group are there.
    pub fn compare(&mut self, at: usize, figure: &Figure) {
        let same = |a: &Row, b: &Row| {
            (a.scene, a.width, a.height, a.views) == (b.scene, b.width, b.height, b.views)
        };
        let Some(row) = self.rows.get(at) else { return };
        let replay = self
            .rows
            .iter()
            .find(|other| same(other, row) && other.configuration == "replay");
        let our_speedup = replay.map(|replay| replay.ms.median / row.ms.median);
        if let Some(row) = self.rows.get_mut(at) {
            row.paper = Some(Paper {
                times: figure.times,
                speedup: figure.speedup,
                our_speedup,
                words: figure.words,
            });
        }
    }

    /// Writes one line for each row.
    pub fn write_csv(&self, file: &Path) -> Result<(), BenchError> {
        let failed = |error: csv::Error| BenchError::Write {
            file: file.to_owned(),
            reason: error.to_string(),
        };
        let mut writer = csv::Writer::from_path(file).map_err(failed)?;
        for row in &self.rows {
            writer.serialize(Line::from(row)).map_err(failed)?;
        }
        writer.flush().map_err(|error| failed(error.into()))
    }
}

/// A row without anything nested, which CSV cannot have.
#[derive(Serialize)]
struct Line<'a> {
    scene: &'a str,
    width: u32,
    height: u32,
    views: u32,
    configuration: &'a str,
    view_scale: &'a str,
    ms: f64,
    ms_low: f64,
    ms_high: f64,
    bare_ms: f64,
    times: f64,
    times_low: f64,
    times_high: f64,
    cpu_ms: f64,
    bare_cpu_ms: f64,
    gpu_ms: Option<f64>,
    exact: bool,
    psnr: Option<f64>,
    ssim: f64,
    worst: u8,
    wrong_subpixels_percent: f64,
    view_bytes: Option<u64>,
    paper_times: Option<f64>,
    paper_speedup: Option<f64>,
    our_speedup: Option<f64>,
    paper_words: &'a str,
    fallbacks: u64,
}

impl<'a> From<&'a Row> for Line<'a> {
    fn from(row: &'a Row) -> Self {
        let paper = row.paper.as_ref();
        Self {
            scene: row.scene,
            width: row.width,
            height: row.height,
            views: row.views,
            configuration: &row.configuration,
            view_scale: &row.view_scale,
            ms: row.ms.median,
            ms_low: row.ms.low,
            ms_high: row.ms.high,
            bare_ms: row.bare_ms.median,
            times: row.times.median,
            times_low: row.times.low,
            times_high: row.times.high,
            cpu_ms: row.cpu_ms,
            bare_cpu_ms: row.bare_cpu_ms,
            gpu_ms: row.gpu_ms.map(|gpu| gpu.median),
            exact: row.picture.exact,
            psnr: row.picture.psnr,
            ssim: row.picture.ssim,
            worst: row.picture.worst,
            wrong_subpixels_percent: row.picture.wrong_subpixels_percent,
            view_bytes: row.view_bytes,
            paper_times: paper.and_then(|paper| paper.times),
            paper_speedup: paper.and_then(|paper| paper.speedup),
            our_speedup: paper.and_then(|paper| paper.our_speedup),
            paper_words: paper.map_or("", |paper| paper.words),
            fallbacks: row.fallbacks.values().sum(),
        }
    }
}
