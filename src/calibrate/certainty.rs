//! How well the mask is known over the panel, and what would make it known better.
#![forbid(unsafe_code)]

use super::Setup;
use super::bench::FOCAL_SPREAD;
use super::fringes::{BLOCKS, wrap};
use super::mask::{Mask, Viewers};
use super::sheet::Sheet;
use super::solve::{Problem, Solution};
use glam::DVec2;
use nalgebra::DMatrix;

/// The panel counts as known when this many standard deviations stay within half a view: in simulated photos one fit in
/// some hundreds is off by nearly four...
const SURE: f64 = 4.0;
/// ...on all but this part of it.
pub(super) const UNSURE_PART: f64 = 0.05;
/// What is known to this part counts as told.
pub(super) const TOLD: f64 = 0.1;

/// How well the phase of the mask is known, as standard deviations in views.
#[derive(Clone, Copy, Debug)]
pub struct PhaseError {
    /// The mean over the panel.
    pub mean: f64,
    /// At the worst place of the panel.
    pub worst: f64,
    /// The part of the panel that may be off by more than half a view, at four standard deviations, with the bend and with what the
    /// mask leaves out, 0 to 1.
    pub unsure: f64,
    /// The same without the bend.
    pub unknown: f64,
    /// By how much the fringes of all photos bend together away from the fit, at most, in views.
    pub bend: f64,
}

/// The phase of a mask and what it depends on.
pub(super) struct Certainty<'a> {
    setup: &'a Setup,
    problem: &'a Problem<'a>,
    solution: &'a Solution,
    /// For the viewers of the mask.
    slopes: Slopes,
    /// Those for viewers who sit where the first photo was taken, if others were asked for.
    from_seat: Option<Slopes>,
    bend: Vec<f64>,
    /// What the mask leaves out at each block, in views.
    left: Vec<f64>,
}

impl<'a> Certainty<'a> {
    /// `misses` has the residuals of each photo's blocks, in views.
    pub(super) fn new(
        viewers: &Viewers<'a>,
        mask: &Mask,
        problem: &'a Problem,
        solution: &'a Solution,
        misses: &[Vec<((usize, usize), f64)>],
    ) -> Option<Self> {
        let blocks = (0..BLOCKS).flat_map(|row| (0..BLOCKS).map(move |column| (column, row)));
        let places = blocks.map(|(column, row)| {
            DVec2::new(column as f64, row as f64) / (BLOCKS - 1) as f64 * viewers.layout.frame.size
        });
        let places: Vec<DVec2> = places.collect();
        let at = &solution.minimum.at;
        let slopes = Slopes::new(viewers, viewers.setup.viewer, problem, at, &places)?;
        let from_seat = match viewers.setup.viewer {
            Some(distance) if distance.is_finite() => {
                Some(Slopes::new(viewers, None, problem, at, &places)?)
            }
            _ => None,
        };
        let views = f64::from(viewers.setup.views);
        let sheet = problem.sheet(&solution.minimum.at)?;
        let left = places.iter().map(|&p| match mask.map {
            Some(_) => 0.0,
            None => views * wrap(viewers.phase(&sheet, p) - mask.plane(p)),
        });
        Some(Self {
            left: left.collect(),
            setup: viewers.setup,
            problem,
            solution,
            slopes,
            from_seat,
            bend: bend(misses),
        })
    }

    /// As the photos tell it.
    pub(super) fn phase(&self) -> PhaseError {
        self.with(&self.slopes, &self.solution.minimum.covariance)
    }

    fn with(&self, slopes: &Slopes, covariance: &DMatrix<f64>) -> PhaseError {
        let deviations = slopes.deviations(covariance);
        let count = deviations.len() as f64;
        let off = |bend: f64| {
            let unsure = deviations.iter().zip(&self.bend).zip(&self.left);
            let unsure = unsure
                .filter(|((d, shape), left)| SURE * **d + bend * shape.abs() + left.abs() > 0.5);
            unsure.count() as f64 / count
        };
        PhaseError {
            mean: deviations.iter().sum::<f64>() / count,
            worst: deviations.iter().fold(0.0, |worst, d| worst.max(*d)),
            unsure: off(1.0),
            unknown: off(0.0),
            bend: self
                .bend
                .iter()
                .fold(0.0, |most, bend| most.max(bend.abs())),
        }
    }

    /// The part of the panel that would be unsure if a parameter were told with this standard deviation.
    fn told(&self, parameter: usize, deviation: f64) -> f64 {
        let covariance = &self.solution.minimum.covariance;
        let column = covariance.column(parameter);
        let gain = deviation * deviation + covariance[(parameter, parameter)];
        let told = covariance - column * column.transpose() / gain;
        self.with(&self.slopes, &told).unsure
    }

    /// What would make the mask known: something to tell where that is enough, else more photos. `photos` were given, `focal` is the deviation of the
    /// logarithm of the focal length that they come with.
    pub(super) fn remedy(&self, photos: usize, focal: f64) -> String {
        let phase = self.phase();
        if phase.unknown <= UNSURE_PART {
            return match self.setup.bias {
                false => format!(
                    "the fringes bend by up to {:.1} views, as over a bowed sheet; measure that as well, with --bias",
                    phase.bend
                ),
                true => "the fringes bend in a way that --bias does not follow; take the photos anew, without reflections and sharper"
                    .to_owned(),
            };
        }
        let distance = self.setup.distance.is_some();
        let cone = self.setup.cone.spread <= TOLD;
        let tellable = [
            (
                focal <= TOLD,
                self.problem.focal_at(),
                FOCAL_SPREAD,
                "give --focal, the focal length of the camera as for 35 mm film",
            ),
            (
                distance,
                self.problem.distance_at(),
                Setup::TAPE,
                "measure how far the camera was from the panel in the first photo, and give --distance with --dpi or --screen-mm",
            ),
            (
                cone,
                self.problem.gap_at(),
                Setup::DATA_SHEET,
                "give --cone from the data sheet",
            ),
        ];
        let covariance = &self.solution.minimum.covariance;
        let from_seat = self.from_seat.as_ref();
        if from_seat.is_some_and(|seat| self.with(seat, covariance).unsure <= UNSURE_PART) {
            return "take the first photo from where the viewers are, and leave out --viewer"
                .to_owned();
        }
        let enough = tellable
            .into_iter()
            .find(|(told, at, deviation, _)| !told && self.told(*at, *deviation) <= UNSURE_PART);
        let remedy = match (enough, photos) {
            (Some((.., remedy)), _) => remedy,
            (None, 1) => {
                "take two more photos, from about 10 degrees to the left and to the right, and from other distances"
            }
            (None, _) => {
                "take another photo, from a direction and a distance that the others have not"
            }
        };
        remedy.to_owned()
    }
}

/// How the phase of the mask depends on what was fitted.
struct Slopes {
    /// The parameters that move the phase.
    parameters: Vec<usize>,
    /// By how much each of them does, at each block, in views.
    blocks: Vec<Vec<f64>>,
}

impl Slopes {
    /// For viewers at a distance from the face of the panel, or where the first photo was taken: these move with the distance that is fitted, so it
    /// need not be known.
    fn new(
        viewers: &Viewers,
        distance: Option<f64>,
        problem: &Problem,
        at: &[f64],
        places: &[DVec2],
    ) -> Option<Self> {
        const STEP: f64 = 1e-4;
        let first = distance.is_none().then(|| problem.distance_at());
        let parameters: Vec<usize> = problem.sheet_at().chain(first).collect();
        let moved = |index: usize, step: f64| {
            let mut at = at.to_vec();
            *at.get_mut(index)? += step;
            let distance = problem.viewer(&at, distance)?;
            Some((
                problem.sheet(&at)?,
                Viewers {
                    distance,
                    ..*viewers
                },
            ))
        };
        let both = |index: &usize| Some([moved(*index, STEP)?, moved(*index, -STEP)?]);
        let either: Option<Vec<_>> = parameters.iter().map(both).collect();
        let either = either?;
        let views = f64::from(viewers.setup.views);
        let blocks = places.iter().map(|&p| {
            let slope = |[above, below]: &[(Sheet, Viewers); 2]| {
                let [above, below] = [above, below].map(|(sheet, viewers)| viewers.phase(sheet, p));
                views * (above - below) / (2.0 * STEP)
            };
            either.iter().map(slope).collect()
        });
        Some(Self {
            blocks: blocks.collect(),
            parameters,
        })
    }

    /// Standard deviation of the phase at each block, in views.
    fn deviations(&self, covariance: &DMatrix<f64>) -> Vec<f64> {
        let deviations = self.blocks.iter().map(|slopes| {
            let mut variance = 0.0;
            for (i, a) in self.parameters.iter().zip(slopes) {
                for (j, b) in self.parameters.iter().zip(slopes) {
                    variance += a * b * covariance[(*i, *j)];
                }
            }
            variance.max(0.0).sqrt()
        });
        deviations.collect()
    }
}

/// Residuals that neighbours and photos have in common, by rows: the mean over photos and 3x3 blocks.
fn bend(misses: &[Vec<((usize, usize), f64)>]) -> Vec<f64> {
    let blocks = (0..BLOCKS).flat_map(|row| (0..BLOCKS).map(move |column| (column, row)));
    let smooth = blocks.map(|(column, row)| {
        let near = misses
            .iter()
            .flatten()
            .filter(|((x, y), _)| x.abs_diff(column) <= 1 && y.abs_diff(row) <= 1);
        let (sum, count) = near.fold((0.0, 0.0), |(sum, count), (_, miss)| {
            (sum + miss, count + 1.0)
        });
        sum / f64::max(count, 1.0)
    });
    smooth.collect()
}
