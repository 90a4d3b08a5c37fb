//! All photos together: the lens sheet, the gap, and every camera.
#![forbid(unsafe_code)]

use super::bench::{Bench, OPTICS, OPTICS_STEPS, POSE, POSE_STEPS, SHAKE};
use super::camera::View;
use super::edges::ALONG;
use super::fringes::{BLOCKS, wrap};
use super::least_squares::{Minimum, minimise, soft};
use super::pattern::Layout;
use super::setup::Guess;
use super::sheet::{NODES, Sheet};
use super::sighting::Sighting;
use super::{CalibrateError, Setup};
use glam::{DVec2, DVec3};
use nalgebra::{DMatrix, DVector};

/// 1/n² of the plate between lenses and pixels, n its index of refraction, and the standard deviation of that: glass and acrylic have 0.40 to 0.46,
/// a sheet with air below it up to 1.
const REFRACTION: f64 = 0.45;
const REFRACTION_SPREAD: f64 = 0.15;
/// Standard deviation of a node of the bias map before it is measured, subpixels.
const BIAS: f64 = 1.0;
/// Of an edge point (panel pixels) and of a block's phase (turns) before their scatter is known.
const EDGE: f64 = 0.4;
const PHASE: f64 = 0.02;
/// Lower bound of every scatter. For the phase this is what windows and vignetting do to all blocks
/// alike; the carrier turns a hundredth of a pixel into as much.
const LEAST_EDGE: f64 = 0.03;
const LEAST_PHASE: f64 = 0.0001;
/// The common error of all points of an edge, which their scatter does not show, panel pixels; and as a part of the scatter,
/// as noise that is cut off at black moves a blurred edge.
const COMMON: f64 = 0.04;
const COMMON_PART: f64 = 0.25;
/// Turns by which a photo may lie beside the first one, tried by steps of the gap within this many spreads.
const GAPS: i32 = 40;
const GAP_REACH: f64 = 3.0;

/// The problem, and how its parameters are laid out: optics, slope, phase, logarithm of the gap, refraction, bias, and of each
/// photo its pose and the shake.
pub(super) struct Problem<'a> {
    pub layout: &'a Layout,
    setup: &'a Setup,
    sightings: &'a [Sighting],
    gap: Guess,
}

/// Parameters of each photo alone.
const OWN: usize = POSE + SHAKE;
/// Where the parameters of the sheet begin, and those of the poses without a bias map.
const SHEET: usize = OPTICS;
const AFTER_SHEET: usize = SHEET + 5;

/// An edge of the frame in a photo.
struct Line {
    /// Side and line, as [`super::edges::EdgePoint`] has them.
    name: (usize, usize),
    /// Place along the line, and how far the panel's edge is missed there, panel pixels.
    misses: Vec<(usize, f64)>,
}

impl Line {
    fn mean(&self) -> f64 {
        let sum: f64 = self.misses.iter().map(|(_, miss)| miss).sum();
        sum / self.misses.len().max(1) as f64
    }

    /// Independent residuals of standard deviation 1, where each point scatters by `scatter` and all are shifted
    /// together by `shift`: the inverse root of their covariance applied.
    fn whitened(&self, scatter: f64, shift: f64) -> impl Iterator<Item = f64> {
        let count = self.misses.len() as f64;
        let taken =
            self.mean() * (1.0 - scatter / (scatter * scatter + count * shift * shift).sqrt());
        self.misses
            .iter()
            .map(move |(_, miss)| (miss - taken) / scatter)
    }
}

/// Scatter of the residuals, and their correlation with their neighbours.
#[derive(Clone, Copy, Debug)]
struct Scatter {
    edge: f64,
    phase: f64,
}

/// The given values of the problem.
pub(super) struct Solution {
    pub minimum: Minimum,
    /// Another number of turns between the photos that is nearly as good.
    pub ambiguous: bool,
    /// Whole turns of each photo.
    turns: Vec<f64>,
}

impl<'a> Problem<'a> {
    pub(super) fn new(layout: &'a Layout, setup: &'a Setup, sightings: &'a [Sighting]) -> Self {
        Self {
            layout,
            setup,
            sightings,
            gap: setup.gap(),
        }
    }

    /// Where the parameters of the sheet are.
    pub(super) fn sheet_at(&self) -> std::ops::Range<usize> {
        SHEET..AFTER_SHEET + self.nodes()
    }

    /// Where the logarithm of the focal length is.
    pub(super) fn focal_at(&self) -> usize {
        0
    }

    /// Where the logarithm of the gap is.
    pub(super) fn gap_at(&self) -> usize {
        SHEET + 3
    }

    /// Where the distance of the first photo is, relative to that at the start.
    pub(super) fn distance_at(&self) -> usize {
        AFTER_SHEET + self.nodes() + 5
    }

    fn nodes(&self) -> usize {
        if self.setup.bias { NODES * NODES } else { 0 }
    }

    pub(super) fn sheet(&self, p: &[f64]) -> Option<Sheet> {
        let [x, y, phase, gap, refraction] = *p.get(SHEET..)?.first_chunk()?;
        let mut bias = [0.0; NODES * NODES];
        let nodes = p.get(AFTER_SHEET..AFTER_SHEET + self.nodes())?;
        bias.iter_mut().zip(nodes).for_each(|(b, p)| *b = *p);
        Some(Sheet {
            slope: DVec2::new(x, y),
            phase,
            gap: self.gap.value * gap.exp(),
            refraction: REFRACTION + refraction,
            bias,
        })
    }

    /// Distance of an eye before the apparent plane of the pixels: of one at this distance from the face of the panel, or of that of the first photo;
    /// panel pixels.
    pub(super) fn viewer(&self, p: &[f64], distance: Option<f64>) -> Option<f64> {
        match distance {
            // From the face of the panel, the pixels are as deep in effective air as the gap is. The cameras' distances have that already.
            Some(distance) => Some(distance + self.sheet(p)?.gap),
            None => Some(-self.view(p, 0)?.pose.eye.z),
        }
    }

    pub(super) fn view(&self, p: &[f64], photo: usize) -> Option<View> {
        let sighting = self.sightings.get(photo)?;
        let own = p.get(AFTER_SHEET + self.nodes() + OWN * photo..)?;
        Some(View {
            optics: sighting.bench.optics(*p.first_chunk()?),
            pose: Bench::pose(sighting.start.pose, *own.first_chunk()?),
            shake: sighting.bench.shake(*own.get(POSE..)?.first_chunk()?),
        })
    }

    /// Phase of the fringes seen at a point of the panel, turns: that of the pattern less that of the lens that the
    /// ray goes through, whose axis is half a turn.
    fn fringe(&self, sheet: &Sheet, eye: DVec3, p: DVec2) -> f64 {
        self.layout.phase(p) - sheet.seen(self.layout, self.setup, eye, p) + 0.5
    }

    /// Measured less expected phase of each block of a photo, turns.
    pub(super) fn misses(
        &self,
        solution: &Solution,
        photo: usize,
    ) -> Option<Vec<((usize, usize), f64)>> {
        self.phases(&solution.minimum.at, &solution.turns, photo)
    }

    fn phases(&self, p: &[f64], turns: &[f64], photo: usize) -> Option<Vec<((usize, usize), f64)>> {
        let (sheet, view) = (self.sheet(p)?, self.view(p, photo)?);
        let blocks = &self.sightings.get(photo)?.fringes.blocks;
        let turns = turns.get(photo)?;
        let miss = |block: &super::fringes::Block| {
            let at = sheet.under(view.pose.eye, view.to_panel(block.pixel)?);
            Some((
                block.place,
                block.phase + turns - self.fringe(&sheet, view.pose.eye, at),
            ))
        };
        blocks.iter().map(miss).collect()
    }

    /// How far the edge points of each line of a photo are off, panel pixels.
    fn edges(&self, p: &[f64], photo: usize) -> Option<Vec<Line>> {
        let (sheet, view) = (self.sheet(p)?, self.view(p, photo)?);
        let mut lines: Vec<Line> = Vec::with_capacity(8);
        for point in &self.sightings.get(photo)?.edges {
            let at = sheet.under(view.pose.eye, view.to_panel(point.pixel)?);
            let miss = point.miss(&self.layout.frame, at);
            let name = (point.side, point.line);
            match lines.last_mut() {
                Some(line) if line.name == name => line.misses.push((point.place, miss)),
                _ => lines.push(Line {
                    name,
                    misses: vec![(point.place, miss)],
                }),
            }
        }
        Some(lines)
    }

    /// Standard deviation of the common error of the points of a line, panel pixels.
    ///
    /// An upright edge is seen where a lens ends, so it is off by up to half a lens; a slanted lens sheet averages that
    /// out along the edge.
    fn shift(&self, line: &Line, scatter: f64) -> f64 {
        let common = COMMON.hypot(COMMON_PART * scatter);
        if line.name.0.is_multiple_of(2) {
            return common;
        }
        let pitch = self.setup.pitch;
        let lenses = self.setup.slant.abs() * self.layout.frame.size.y / pitch;
        let lens = pitch / 3.0 / 12f64.sqrt();
        common.hypot(lens / (std::f64::consts::PI * lenses).max(1.0))
    }

    fn residuals(&self, p: &[f64], turns: &[f64], scatter: Scatter) -> Option<Vec<f64>> {
        let first = self.sightings.first()?;
        let mut all = first.bench.prior(*p.first_chunk()?).to_vec();
        all.push(p.get(SHEET + 3)? / self.gap.spread);
        all.push(p.get(SHEET + 4)? / REFRACTION_SPREAD);
        let nodes = p.get(AFTER_SHEET..AFTER_SHEET + self.nodes())?;
        all.extend(nodes.iter().map(|node| node / BIAS));
        if let Some(distance) = self.setup.distance {
            let seen = -self.view(p, 0)?.pose.eye.z;
            all.push((seen / distance.value).ln() / distance.spread);
        }
        for photo in 0..self.sightings.len() {
            let shake = p.get(AFTER_SHEET + self.nodes() + OWN * photo + POSE..)?;
            all.extend(Bench::steady(*shake.first_chunk()?));
            for line in self.edges(p, photo)? {
                all.extend(
                    line.whitened(scatter.edge, self.shift(&line, scatter.edge))
                        .map(soft),
                );
            }
            let phases = self.phases(p, turns, photo)?;
            all.extend(phases.iter().map(|(_, miss)| soft(miss / scatter.phase)));
        }
        Some(all)
    }

    fn minimum(&self, start: &[f64], turns: &[f64], scatter: Scatter) -> Option<Minimum> {
        let own = [&POSE_STEPS[..], &[0.2; SHAKE]].concat();
        let poses = own.repeat(self.sightings.len());
        let sheet = [0.3, 0.3, 0.1, 0.2, 0.1];
        let steps = [&OPTICS_STEPS[..], &sheet, &vec![BIAS; self.nodes()], &poses].concat();
        minimise(start, &steps, |p| self.residuals(p, turns, scatter))
    }

    /// Solves for everything.
    pub(super) fn solve(&self) -> Result<Solution, CalibrateError> {
        let starts = self.starts().ok_or(CalibrateError::NoFit)?;
        let rough = Scatter {
            edge: EDGE,
            phase: PHASE,
        };
        let solved = starts.iter().filter_map(|(start, turns)| {
            let minimum = self.minimum(start, turns, rough)?;
            Some((minimum, turns))
        });
        let mut solved: Vec<_> = solved.collect();
        solved.sort_by(|a, b| a.0.cost.total_cmp(&b.0.cost));
        let mut solved = solved.into_iter();
        let (mut minimum, turns) = solved.next().ok_or(CalibrateError::NoFit)?;
        let mut scatter = rough;
        for _ in 0..5 {
            scatter = self
                .scatter(&minimum.at, turns)
                .ok_or(CalibrateError::NoFit)?;
            let next = self.minimum(&minimum.at, turns, scatter);
            minimum = next.ok_or(CalibrateError::NoFit)?;
        }
        // Half of the square of four standard deviations.
        let near = |other: &(Minimum, &Vec<f64>)| {
            let other = self.minimum(&other.0.at, other.1, scatter);
            other.is_some_and(|other| other.cost < minimum.cost + 8.0)
        };
        let ambiguous = solved.any(|other| near(&other));
        Ok(Solution {
            minimum,
            ambiguous,
            turns: turns.clone(),
        })
    }

    /// Where the search begins: for the whole turns between the photos that some gap allows, the best gap.
    fn starts(&self) -> Option<Vec<(Vec<f64>, Vec<f64>)>> {
        let count = self.sightings.len();
        let mut found: Vec<(f64, Vec<f64>, Vec<f64>)> = Vec::new();
        for step in -GAPS..=GAPS {
            let log = GAP_REACH * self.gap.spread * f64::from(step) / f64::from(GAPS);
            let gap = self.gap.value * log.exp();
            let (fit, misfit) = self.plane(gap)?;
            let mut cost = misfit / (PHASE * PHASE) + (log / self.gap.spread).powi(2);
            let mut turns = vec![0.0];
            for photo in 1..count {
                let apart = fit[2 + photo] - fit[2];
                turns.push(apart.round());
                cost += (wrap(apart) / PHASE).powi(2);
            }
            let mut p = vec![0.0; AFTER_SHEET + self.nodes() + OWN * count];
            let optics = self
                .sightings
                .iter()
                .map(|s| s.bench.parameters(s.start.optics));
            for (i, value) in optics.flat_map(|optics| optics.into_iter().enumerate()) {
                *p.get_mut(i)? += value / count as f64;
            }
            let sheet = [fit[0], fit[1], fit[2], log, 0.0];
            p.get_mut(SHEET..AFTER_SHEET)?.copy_from_slice(&sheet);
            match found.iter_mut().find(|other| other.2 == turns) {
                Some(other) if other.0 <= cost => {}
                Some(other) => *other = (cost, p, turns),
                None => found.push((cost, p, turns)),
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found.truncate(4);
        Some(found.into_iter().map(|(_, p, turns)| (p, turns)).collect())
    }

    /// For a gap and the cameras of the edges alone, the slope and each photo's own phase, by linear least squares; and
    /// the mean square of the residuals, turns.
    fn plane(&self, gap: f64) -> Option<(DVector<f64>, f64)> {
        let n = 2 + self.sightings.len();
        let (mut normal, mut right) = (DMatrix::zeros(n, n), DVector::zeros(n));
        let sheet = Sheet {
            slope: DVec2::ZERO,
            phase: 0.0,
            gap,
            refraction: REFRACTION,
            bias: [0.0; NODES * NODES],
        };
        let mut rows = Vec::new();
        for (photo, sighting) in self.sightings.iter().enumerate() {
            let view = sighting.start;
            for block in &sighting.fringes.blocks {
                let p = view.to_panel(block.pixel)?;
                let lens = sheet.through(view.pose.eye, p);
                let added = self.layout.phase(p) - self.layout.nominal(lens) + 0.5 - block.phase;
                let place = lens / self.layout.frame.size * 2.0 - 1.0;
                let row = [(0, place.x), (1, place.y), (2 + photo, 1.0)];
                for (i, a) in row {
                    for (j, b) in row {
                        normal[(i, j)] += a * b;
                    }
                    right[i] += a * added;
                }
                rows.push((row, added));
            }
        }
        let fit = normal.cholesky()?.solve(&right);
        let miss = |(row, added): &([(usize, f64); 3], f64)| {
            row.iter().map(|(i, a)| a * fit[*i]).sum::<f64>() - added
        };
        let misfit = rows.iter().map(|row| miss(row).powi(2)).sum::<f64>() / rows.len() as f64;
        Some((fit, misfit))
    }

    fn scatter(&self, p: &[f64], turns: &[f64]) -> Option<Scatter> {
        let (mut edges, mut edge_pairs) = (Vec::new(), Vec::new());
        let (mut phases, mut across, mut down) = (Vec::new(), Vec::new(), Vec::new());
        for photo in 0..self.sightings.len() {
            for line in self.edges(p, photo)? {
                let mean = line.mean();
                edges.extend(line.misses.iter().map(|(_, miss)| miss - mean));
                let pairs = line.misses.windows(2).filter_map(|pair| match pair {
                    [(a, x), (b, y)] if a + 1 == *b => Some((x - mean, y - mean)),
                    _ => None,
                });
                edge_pairs.extend(pairs);
            }
            let found = self.phases(p, turns, photo)?;
            let mut grid = [[None; BLOCKS]; BLOCKS];
            for ((column, row), miss) in &found {
                *grid.get_mut(*row)?.get_mut(*column)? = Some(*miss);
            }
            for row in &grid {
                across.extend(row.windows(2).filter_map(|pair| pair[0].zip(pair[1])));
            }
            for rows in grid.windows(2) {
                let pairs = rows[0].iter().zip(&rows[1]);
                down.extend(pairs.filter_map(|(a, b)| a.zip(*b)));
            }
            phases.extend(found.into_iter().map(|(_, miss)| miss));
        }
        let edge = deviation(&edges).max(LEAST_EDGE) * excess(&edge_pairs, ALONG).sqrt();
        let common = (excess(&across, BLOCKS) * excess(&down, BLOCKS)).sqrt();
        let phase = deviation(&phases).max(LEAST_PHASE) * common;
        Some(Scatter { edge, phase })
    }
}

/// Standard deviation from the median of the sizes, which outliers do not move.
fn deviation(values: &[f64]) -> f64 {
    let mut sizes: Vec<f64> = values.iter().map(|v| v.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    1.4826 * sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
}

/// By how much the variance of a mean over `count` values in a line grows when neighbours have this much in common (a first-order process).
fn excess(pairs: &[(f64, f64)], count: usize) -> f64 {
    let product: f64 = pairs.iter().map(|(a, b)| a * b).sum();
    let square: f64 = pairs.iter().map(|(a, b)| (a * a + b * b) / 2.0).sum();
    let common = (product / square.max(1e-30)).clamp(0.0, 0.95);
    let (mut sum, mut power) = (1.0, 1.0);
    for apart in 1..count {
        power *= common;
        sum += 2.0 * power * (1.0 - apart as f64 / count as f64);
    }
    sum
}
