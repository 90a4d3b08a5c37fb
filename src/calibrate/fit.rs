//! The result, with its residuals and its uncertainty.
#![forbid(unsafe_code)]

use super::fringes::BLOCKS;
use super::pattern::Layout;
use super::solve::{NODES, Problem, Sheet, Solution, weights};
use super::{CalibrateError, Setup, Sighting};
use glam::DVec2;

/// The panel counts as known when this many standard deviations stay within half a view: in simulated photos one fit in
/// some hundreds is off by nearly four...
const SURE: f64 = 4.0;
/// ...on all but this part of it.
const UNSURE_PART: f64 = 0.05;
/// Root mean square of the residuals, turns, above which the model does not describe the photo.
const LARGEST_RESIDUAL: f64 = 0.08;

/// How well the phase of the mask is known, as standard deviations in views.
#[derive(Clone, Copy, Debug)]
pub struct PhaseError {
    /// The mean over the panel.
    pub mean: f64,
    /// At the worst place of the panel.
    pub worst: f64,
    /// The part of the panel that may be off by more than half a view, at four standard deviations, 0 to 1.
    pub unsure: f64,
}

/// A lens sheet measured.
#[derive(Clone, Debug)]
pub struct Fit {
    /// Subpixels from lens to lens along a row; for the viewers' distance where the setup has one.
    pub pitch: f64,
    /// Subpixels per row.
    pub slant: f64,
    /// Subpixels, 0 to the pitch.
    pub offset: f64,
    /// From pixels to lenses, in effective air, panel pixels.
    pub gap: f64,
    /// Subpixels to add to the phase of red, green and blue, and the standard deviation of each.
    pub colours: Option<([f64; 3], [f64; 3])>,
    /// Subpixels to add to the phase, at 3x3 places over the screen, rows from the top.
    pub bias: Option<[f64; NODES * NODES]>,
    /// Where each photo was taken.
    pub cameras: Vec<Camera>,
    /// The residuals of the fit.
    pub residuals: Residuals,
    /// How well the phase of the mask is known.
    pub phase: PhaseError,
    /// Reasons to doubt the fit, each with the remedy; empty for a good fit.
    pub doubts: Vec<String>,
    /// Residual of each block of each photo, in views: column and row of 11, then the value.
    pub(super) misses: Vec<Vec<((usize, usize), f64)>>,
}

/// Where a photo was taken.
#[derive(Clone, Debug)]
pub struct Camera {
    /// The photo.
    pub name: String,
    /// From the middle of the panel, panel pixels: to the right, down, and before it.
    pub eye: [f64; 3],
    /// Contrast of the fringes, 0 to 1.
    pub contrast: f64,
}

/// Measured less expected phase of the fringes over all blocks of all photos, in views.
#[derive(Clone, Copy, Debug)]
pub struct Residuals {
    /// Mean.
    pub mean: f64,
    /// Root mean square.
    pub rms: f64,
    /// Largest size.
    pub max: f64,
}

impl Residuals {
    fn of(values: &[f64]) -> Self {
        let count = values.len().max(1) as f64;
        Self {
            mean: values.iter().sum::<f64>() / count,
            rms: (values.iter().map(|v| v * v).sum::<f64>() / count).sqrt(),
            max: values.iter().fold(0.0, |max, v| max.max(v.abs())),
        }
    }
}

/// Solves for the sheet and all cameras. A fit that cannot be trusted says so in [`Fit::doubts`].
pub fn fit(setup: &Setup, sightings: &[Sighting]) -> Result<Fit, CalibrateError> {
    setup.check()?;
    let first = sightings.first().ok_or(CalibrateError::NoPhoto)?;
    if let Some(other) = sightings.iter().find(|s| s.size != first.size) {
        return Err(CalibrateError::Sizes {
            photo: other.name.clone(),
            width: other.size.0,
            height: other.size.1,
            first_width: first.size.0,
            first_height: first.size.1,
        });
    }
    let layout = Layout::new(setup);
    let problem = Problem::new(&layout, setup, sightings);
    let solution = problem.solve()?;
    Answer {
        setup,
        layout: &layout,
        problem: &problem,
        solution: &solution,
        sightings,
    }
    .fit()
    .ok_or(CalibrateError::NoFit)
}

struct Answer<'a> {
    setup: &'a Setup,
    layout: &'a Layout,
    problem: &'a Problem<'a>,
    solution: &'a Solution,
    sightings: &'a [Sighting],
}

impl Answer<'_> {
    fn fit(&self) -> Option<Fit> {
        let views = f64::from(self.setup.views);
        let sheet = self.problem.sheet(&self.solution.minimum.at)?;
        let size = self.layout.size;
        // Turns per pixel to the right and down, of the sheet; then of the mask.
        let growth =
            DVec2::new(3.0, self.setup.slant) / self.setup.pitch + sheet.slope * 2.0 / size;
        let growth = growth * (1.0 - self.lean(&sheet));
        let pitch = 3.0 / growth.x;
        let slant = growth.y * pitch;
        let middle = size / 2.0;
        let phase = self.layout.nominal(middle) + sheet.phase;
        let offset = phase * pitch - (3.0 * middle.x - 0.5) - slant * (middle.y - 0.5);
        let mut misses = Vec::new();
        let mut cameras = Vec::new();
        for (photo, sighting) in self.sightings.iter().enumerate() {
            let mut found = self.problem.misses(self.solution, photo)?;
            found.iter_mut().for_each(|(_, miss)| *miss *= views);
            misses.push(found);
            let eye = self
                .problem
                .view(&self.solution.minimum.at, photo)?
                .pose
                .eye;
            cameras.push(Camera {
                name: sighting.name.clone(),
                eye: [eye.x - middle.x, eye.y - middle.y, -eye.z],
                contrast: sighting.fringes.contrast,
            });
        }
        let all: Vec<f64> = misses.iter().flatten().map(|(_, miss)| *miss).collect();
        let residuals = Residuals::of(&all);
        let phase = self.phase_error(&sheet, &misses)?;
        let mut fit = Fit {
            pitch,
            slant,
            offset: offset.rem_euclid(pitch),
            gap: sheet.gap,
            colours: self.setup.colours.then(|| self.colours(pitch)),
            bias: self.setup.bias.then_some(sheet.bias),
            cameras,
            residuals,
            phase,
            doubts: Vec::new(),
            misses,
        };
        fit.doubts = self.doubts(&fit);
        Some(fit)
    }

    /// By how much the phase of the mask grows slower than that of the sheet, for viewers at a finite distance.
    fn lean(&self, sheet: &Sheet) -> f64 {
        let viewer = self.setup.viewer;
        viewer.map_or(0.0, |distance| sheet.gap / (distance + sheet.gap))
    }

    /// How well the phase of the mask is known over the panel, in views.
    fn phase_error(
        &self,
        sheet: &Sheet,
        misses: &[Vec<((usize, usize), f64)>],
    ) -> Option<PhaseError> {
        let covariance = &self.solution.minimum.covariance;
        let first = self.problem.sheet_at();
        let views = f64::from(self.setup.views);
        let lean = self.lean(sheet);
        let smooth = smoothed(misses);
        let (mut mean, mut worst, mut unsure) = (0.0, 0.0f64, 0.0);
        for (column, row) in (0..BLOCKS).flat_map(|row| (0..BLOCKS).map(move |c| (c, row))) {
            let part = DVec2::new(column as f64, row as f64) / (BLOCKS - 1) as f64;
            let place = part * 2.0 - 1.0;
            let p = part * self.layout.size;
            let over = self.layout.nominal(p) - self.layout.nominal(self.layout.size / 2.0)
                + place.dot(sheet.slope);
            let mut slopes = vec![
                place.x * (1.0 - lean),
                place.y * (1.0 - lean),
                1.0,
                -over * lean * (1.0 - lean),
            ];
            if self.setup.bias {
                slopes.extend(weights(part).map(|weight| weight / self.setup.pitch));
            }
            let mut variance = 0.0;
            for (i, a) in slopes.iter().enumerate() {
                for (j, b) in slopes.iter().enumerate() {
                    variance += a * b * covariance.get((first + i, first + j))?;
                }
            }
            let deviation = views * variance.max(0.0).sqrt();
            mean += deviation;
            worst = worst.max(deviation);
            let shape = smooth.get(row)?.get(column)?.abs();
            unsure += f64::from(u8::from(SURE * deviation + shape > 0.5));
        }
        let count = (BLOCKS * BLOCKS) as f64;
        Some(PhaseError {
            mean: mean / count,
            worst,
            unsure: unsure / count,
        })
    }

    /// Where the colours lie, from their fringes against those of all colours together, subpixels.
    fn colours(&self, pitch: f64) -> ([f64; 3], [f64; 3]) {
        let blocks = || self.sightings.iter().flat_map(|s| &s.fringes.blocks);
        let count = blocks().count().max(1) as f64;
        let found = [0, 1, 2].map(|c: usize| {
            let mean = blocks().map(|block| block.colours[c]).sum::<f64>() / count;
            let square = blocks().map(|block| (block.colours[c] - mean).powi(2));
            // A higher phase of the lens is a lower one of the fringes.
            (-mean * pitch, pitch * square.sum::<f64>().sqrt() / count)
        });
        let shift = found.iter().map(|(value, _)| value).sum::<f64>() / 3.0;
        (
            found.map(|(value, _)| value - shift),
            found.map(|(_, deviation)| deviation),
        )
    }

    fn doubts(&self, fit: &Fit) -> Vec<String> {
        let mut doubts = Vec::new();
        if fit.phase.unsure > UNSURE_PART {
            let remedy = if self.sightings.len() == 1 {
                "take another photo from 10 degrees to the side and another distance, or give --cone and --focal"
            } else {
                "take another photo, straight from the front, and give --focal if the photos do not say it"
            };
            doubts.push(format!(
                "{:.0} % of the panel may be off by more than half a view; {remedy}",
                100.0 * fit.phase.unsure
            ));
        }
        if self.solution.ambiguous {
            doubts.push(
                "two gaps fit as well; give --cone, or take another photo nearer to the front"
                    .into(),
            );
        }
        if fit.residuals.rms > LARGEST_RESIDUAL * f64::from(self.setup.views) {
            doubts.push(
                "the residuals are large; take sharper photos, or ask for --bias if the sheet is bent"
                    .into(),
            );
        }
        // Each colour's pixels are seen in turn along a lens; their beat must be finer than the fringes.
        let beat = self.setup.slant.abs() * self.layout.size.y / 3.0;
        if self.setup.colours && beat < 2.0 * self.layout.carrier {
            doubts.push(
                "the lenses are too upright to tell the colours apart; leave out --colours".into(),
            );
        }
        doubts
    }
}

/// Residuals that neighbours and photos have in common: the mean over photos and 3x3 blocks.
fn smoothed(misses: &[Vec<((usize, usize), f64)>]) -> [[f64; BLOCKS]; BLOCKS] {
    let mut smooth = [[0.0; BLOCKS]; BLOCKS];
    for (row, values) in smooth.iter_mut().enumerate() {
        for (column, value) in values.iter_mut().enumerate() {
            let near: Vec<f64> = misses
                .iter()
                .flatten()
                .filter(|((x, y), _)| x.abs_diff(column) <= 1 && y.abs_diff(row) <= 1)
                .map(|(_, miss)| *miss)
                .collect();
            *value = near.iter().sum::<f64>() / near.len().max(1) as f64;
        }
    }
    smooth
}
