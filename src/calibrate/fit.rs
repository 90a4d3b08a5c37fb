//! The result, with its residuals and its uncertainty.
#![forbid(unsafe_code)]

use super::certainty::{Certainty, PhaseError, TOLD, UNSURE_PART};
use super::mask::{Mask, Viewers};
use super::pattern::Layout;
use super::sheet::NODES;
use super::solve::{Problem, Solution};
use super::{CalibrateError, Setup, Sighting};
use crate::display::SubpixelOrder;

/// Root mean square of the residuals, turns, above which the model does not describe the photo.
const LARGEST_RESIDUAL: f64 = 0.08;

/// Subpixels by which red and blue may lie beside their places in the order that is given, and in the other one, which the filters of a camera make look
/// nearer.
const GIVEN: f64 = 0.25;
const OTHER: f64 = 0.3;

/// A lens sheet measured.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The mask.
    pub mask: Mask,
    /// From pixels to lenses, in effective air, panel pixels.
    pub gap: f64,
    /// Which colour is leftmost in a pixel: as measured, or as given where the photos do not tell.
    pub order: SubpixelOrder,
    /// The order was measured.
    pub order_measured: bool,
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
        let size = self.layout.frame.size;
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
                eye: [eye.x - size.x / 2.0, eye.y - size.y / 2.0, -eye.z],
                contrast: sighting.fringes.contrast,
            });
        }
        let viewers = Viewers {
            layout: self.layout,
            setup: self.setup,
            distance: self
                .problem
                .viewer(&self.solution.minimum.at, self.setup.viewer)?,
        };
        let mask = viewers.mask(&sheet);
        let all: Vec<f64> = misses.iter().flatten().map(|(_, miss)| *miss).collect();
        let residuals = Residuals::of(&all);
        let (order, order_measured) = self.order();
        let certainty = Certainty::new(&viewers, &mask, self.problem, self.solution, &misses)?;
        let mut fit = Fit {
            gap: sheet.gap,
            order,
            order_measured,
            colours: self.setup.colours.then(|| self.colours(mask.pitch)),
            bias: self.setup.bias.then_some(sheet.bias),
            mask,
            cameras,
            residuals,
            phase: certainty.phase(),
            doubts: Vec::new(),
            misses,
        };
        fit.doubts = self.doubts(&fit, &certainty);
        Some(fit)
    }

    /// The mean of [`super::fringes::Fringes::beside`].
    fn beside(&self) -> f64 {
        let sum: f64 = self.sightings.iter().map(|s| s.fringes.beside).sum();
        sum / self.sightings.len() as f64
    }

    /// The order of the colours, and whether the photos tell it.
    fn order(&self) -> (SubpixelOrder, bool) {
        let beside = self.beside();
        let given = self.setup.order;
        let other = match given {
            SubpixelOrder::Rgb => SubpixelOrder::Bgr,
            SubpixelOrder::Bgr => SubpixelOrder::Rgb,
        };
        if !self.layout.tells_colours() {
            return (given, false);
        }
        match beside > 1.0 {
            true => (other, (beside - 2.0).abs() <= OTHER),
            false => (given, beside.abs() <= GIVEN),
        }
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

    fn doubts(&self, fit: &Fit, certainty: &Certainty) -> Vec<String> {
        let mut doubts = Vec::new();
        if fit.phase.unsure > UNSURE_PART {
            let focal = self.sightings.iter().map(|s| s.bench.focal_spread);
            let focal = focal.fold(f64::INFINITY, f64::min);
            doubts.push(format!(
                "{:.0} % of the panel may be off by more than half a view; {}",
                100.0 * fit.phase.unsure,
                certainty.remedy(self.sightings.len(), focal)
            ));
        }
        if self.solution.ambiguous {
            let told = self.setup.cone.spread <= TOLD;
            let cone = if told { "" } else { "give --cone, or " };
            doubts.push(format!(
                "two gaps fit as well; {cone}take another photo nearer to the front"
            ));
        }
        if fit.residuals.rms > LARGEST_RESIDUAL * f64::from(self.setup.views) {
            doubts.push(
                "the residuals are large; take sharper photos, or ask for --bias if the sheet is bent"
                    .into(),
            );
        }
        // On a sheet of great slant, pixels that are turned look nearly like a row of red, green and blue, or of blue, green and red.
        let tells_colours = self.layout.tells_colours();
        if tells_colours && !fit.order_measured && !self.setup.colours {
            doubts.push(format!(
                "red and blue lie {:.1} subpixels beside their places in a row of red, green and blue, as where pixels are turned by 90 degrees; measure where they lie, with --colours",
                self.beside().abs()
            ));
        }
        if self.setup.colours && !tells_colours {
            doubts.push(
                "the lenses are too upright to tell the colours apart; leave out --colours".into(),
            );
        }
        doubts
    }
}
