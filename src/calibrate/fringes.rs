//! The fringes of a photo in the frequency domain: their frequency over the panel, then their phase block by block.
#![forbid(unsafe_code)]

use super::camera::View;
use super::complex::{Complex, argument, conjugate, turn};
use super::levels::levels;
use super::pattern::{Layout, SWING};
use super::{CalibrateError, Photo};
use glam::DVec2;
use std::f64::consts::TAU;

/// Samples over the width of the field, at most and at least; between these one per camera pixel.
const SAMPLES: std::ops::RangeInclusive<f64> = 160.0..=900.0;
/// Fringes are not measured with fewer camera pixels each.
const LEAST_PIXELS: f64 = 6.0;
/// Columns and rows of blocks.
pub(super) const BLOCKS: usize = 11;
/// Half of the width of a block's window, as a part of the field; a window must hold some fringes.
const WINDOW: f64 = 0.09;
/// Parts of the pattern that may be clipped.
const MOST_CLIPPED: f64 = 0.2;
/// Contrast, as a part of that of the panel, below which the lenses cannot have been in focus.
const LEAST_CONTRAST: f64 = 0.02;
/// The frequency must stand out by this factor.
const LEAST_RATIO: f64 = 2.0;

/// The phase at one place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    /// In the picture, pixels.
    pub pixel: DVec2,
    /// Turns, without jumps over a photo; a whole number for all blocks of a photo is free.
    pub phase: f64,
    /// Of R, G and B alone against all together, turns.
    pub colours: [f64; 3],
    /// Column and row.
    pub place: (usize, usize),
}

/// The measurement of one photo.
#[derive(Clone, Debug)]
pub(super) struct Fringes {
    pub blocks: Vec<Block>,
    /// Contrast as a part of that of the panel, 0 to 1.
    pub contrast: f64,
    /// Subpixels from where the pattern has red to where red is seen, towards blue: 0 in the order that is given, 2 in the other one. Blue is as
    /// far beside its place, towards red.
    pub beside: f64,
}

/// The field, sampled evenly: R, G and B, each with black at 0 and white at 1.
struct Field {
    values: Vec<[f32; 3]>,
    /// Samples.
    width: usize,
    height: usize,
    /// Panel coordinates of the field.
    origin: DVec2,
    extent: DVec2,
}

/// The nearest whole number taken away.
pub(super) fn wrap(turns: f64) -> f64 {
    turns - turns.round()
}

/// Measures a photo whose camera is known to a pixel or so.
pub(super) fn measure(
    photo: &Photo,
    layout: &Layout,
    view: View,
) -> Result<Fringes, CalibrateError> {
    let name = || photo.name.clone();
    let s = layout.frame.size;
    let side = |a: DVec2, b: DVec2| Some(view.to_picture(a)?.distance(view.to_picture(b)?));
    let middle = s / 2.0;
    let across = side(middle * DVec2::Y, DVec2::new(s.x, middle.y)).unwrap_or(0.0);
    let down = side(middle * DVec2::X, DVec2::new(middle.x, s.y)).unwrap_or(0.0);
    if down < LEAST_PIXELS * (layout.carrier + layout.reach.y)
        || across < LEAST_PIXELS * 2.0 * layout.reach.x
    {
        return Err(CalibrateError::TooSmall {
            photo: name(),
            width: across,
            fringes: layout.carrier,
        });
    }
    let field = sample(photo, layout, view, across)?;
    let (frequency, ratio) = peak(&field, layout);
    let off = (frequency - DVec2::new(0.0, layout.carrier)).abs();
    if ratio < LEAST_RATIO {
        return Err(CalibrateError::Frequency {
            photo: name(),
            ratio,
        });
    }
    if off.cmpgt(layout.reach - 0.5).any() {
        return Err(CalibrateError::Outside { photo: name() });
    }
    let frequency = refined(&field, layout, frequency);
    let mut found = Vec::new();
    for (column, row) in (0..BLOCKS).flat_map(|row| (0..BLOCKS).map(move |column| (column, row))) {
        let centre = block_centre(&field, column, row);
        let waves = field.demodulated(frequency / s, centre);
        found.push((centre, waves, (column, row)));
    }
    let beside = beside(found.iter().map(|(_, waves, _)| *waves), layout.across);
    // Where each colour really is, so that all add up.
    let other = layout.tells_colours() && beside > 1.0;
    let red = turn(if other { layout.across } else { 0.0 });
    let blue = conjugate(red);
    let found = found.into_iter().map(|(centre, [r, g, b], place)| {
        let waves = [r.rotate(red), g, b.rotate(blue)];
        let all = waves.into_iter().sum::<Complex>() / 3.0;
        (centre, waves, all, place)
    });
    let mut found: Vec<_> = found.collect();
    let mut sizes: Vec<f64> = found.iter().map(|(_, _, all, _)| all.length()).collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    let contrast = 2.0 * median / SWING;
    if contrast < LEAST_CONTRAST {
        return Err(CalibrateError::Contrast {
            photo: name(),
            percent: 100.0 * contrast,
        });
    }
    let count = found.len() as f64;
    found.retain(|(_, _, all, _)| all.length() > 0.35 * median);
    if (found.len() as f64) < 0.7 * count {
        return Err(CalibrateError::Glare {
            photo: name(),
            percent: 100.0 * (1.0 - found.len() as f64 / count),
        });
    }
    let total: Complex = found.iter().map(|(_, _, all, _)| *all).sum();
    let blocks = found
        .into_iter()
        .filter_map(|(centre, waves, all, place)| {
            let phase = argument(all);
            Some(Block {
                pixel: view.to_picture(centre)?,
                phase: (frequency / s).dot(centre)
                    + argument(total)
                    + wrap(phase - argument(total)),
                colours: [0, 1, 2].map(|c| wrap(argument(waves[c]) - phase)),
                place,
            })
        })
        .collect();
    Ok(Fringes {
        blocks,
        contrast,
        beside,
    })
}

/// See [`Fringes::beside`]; `across` turns are two subpixels.
///
/// What a pattern has for a colour on the left appears on the right of a panel with the other order, so its fringes are `across` turns behind.
fn beside(waves: impl Iterator<Item = [Complex; 3]>, across: f64) -> f64 {
    let apart = waves.map(|[r, g, b]| conjugate(g).rotate(r) + conjugate(conjugate(g).rotate(b)));
    -argument(apart.sum()) / across * 2.0
}

fn block_centre(field: &Field, column: usize, row: usize) -> DVec2 {
    let part = |i: usize| WINDOW + (1.0 - 2.0 * WINDOW) * i as f64 / (BLOCKS - 1) as f64;
    field.origin + field.extent * DVec2::new(part(column), part(row))
}

/// The field as the camera sees it.
fn sample(
    photo: &Photo,
    layout: &Layout,
    view: View,
    across: f64,
) -> Result<Field, CalibrateError> {
    let unclear = || CalibrateError::Edges {
        photo: photo.name.clone(),
    };
    let levels = levels(photo, &layout.frame, view).ok_or_else(unclear)?;
    let (from, to) = layout.frame.field();
    let extent = to - from;
    let width = (across * extent.x / layout.frame.size.x).clamp(*SAMPLES.start(), *SAMPLES.end());
    let height = (width * extent.y / extent.x).round() as usize;
    let width = width.round() as usize;
    let mut values = Vec::with_capacity(width * height);
    let mut clipped = 0.0;
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let part = DVec2::new(
            (x as f64 + 0.5) / width as f64,
            (y as f64 + 0.5) / height as f64,
        );
        let pixel = view.to_picture(from + extent * part).ok_or_else(unclear)?;
        let rgb = photo.at(pixel).ok_or_else(unclear)?;
        clipped += photo.clipped(pixel);
        values.push(levels.of(rgb));
    }
    let part = clipped / (width * height) as f64;
    if part > MOST_CLIPPED {
        return Err(CalibrateError::Glare {
            photo: photo.name.clone(),
            percent: 100.0 * part,
        });
    }
    Ok(Field {
        values,
        width,
        height,
        origin: from,
        extent,
    })
}

impl Field {
    /// Amplitude and phase of a frequency (turns per panel pixel) around a place, of each channel, in a Hann window.
    fn demodulated(&self, frequency: DVec2, centre: DVec2) -> [Complex; 3] {
        let (w, h) = (self.width as f64, self.height as f64);
        let size = DVec2::new(w, h);
        let middle = (centre - self.origin) / self.extent * size;
        let half = size * WINDOW;
        let window = |middle: f64, half: f64, n: usize| {
            let from = (middle - half).max(0.0) as usize;
            let to = ((middle + half).ceil() as usize).min(n);
            (from..to).map(move |i| {
                let d = (i as f64 + 0.5 - middle) / half;
                (i, 0.5 + 0.5 * (TAU / 2.0 * d.clamp(-1.0, 1.0)).cos())
            })
        };
        let step = self.extent / size * frequency;
        let start = frequency.dot(self.origin) + 0.5 * step.element_sum();
        let columns: Vec<(usize, f64, Complex)> = window(middle.x, half.x, self.width)
            .map(|(x, weight)| (x, weight, turn(-step.x * x as f64)))
            .collect();
        let (mut waves, mut sums) = ([DVec2::ZERO; 3], [0.0; 3]);
        let (mut carrier, mut total) = (DVec2::ZERO, 0.0);
        for (y, weight_y) in window(middle.y, half.y, self.height) {
            let row = turn(-start - step.y * y as f64);
            for &(x, weight_x, column) in &columns {
                let weight = weight_x * weight_y;
                let wave = row.rotate(column) * weight;
                let Some(values) = self.values.get(y * self.width + x) else {
                    continue;
                };
                for (c, &value) in values.iter().enumerate() {
                    waves[c] += wave * f64::from(value);
                    sums[c] += weight * f64::from(value);
                }
                carrier += wave;
                total += weight;
            }
        }
        // The window does not hold whole fringes: what the mean leaks is taken out.
        [0, 1, 2].map(|c| (waves[c] - carrier * (sums[c] / total)) / total)
    }
}

/// The strongest frequency near the carrier, in turns over the width and height of the panel, and how many times
/// stronger it is than any other that is not beside it. By green, which is in the middle of a pixel whatever the order of the colours.
fn peak(field: &Field, layout: &Layout) -> (DVec2, f64) {
    const STEP: f64 = 0.25;
    let pool = (field.width / 240).max(1).min((field.height / 160).max(1));
    let (width, height) = (field.width / pool, field.height / pool);
    let cell = field.extent / DVec2::new(field.width as f64, field.height as f64) * pool as f64;
    let hann = |i: usize, n: usize| 0.5 - 0.5 * (TAU * (i as f64 + 0.5) / n as f64).cos();
    let mut small = vec![0.0; width * height];
    let (mut sum, mut weights) = (0.0, 0.0);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let rows = (y * pool..).take(pool);
        let cells = rows.flat_map(|row| {
            field
                .values
                .iter()
                .skip(row * field.width + x * pool)
                .take(pool)
        });
        let value: f32 = cells.map(|values| values[1]).sum();
        small[y * width + x] = f64::from(value) / (pool * pool) as f64;
        let weight = hann(x, width) * hann(y, height);
        sum += weight * small[y * width + x];
        weights += weight;
    }
    for (i, value) in small.iter_mut().enumerate() {
        *value = (*value - sum / weights) * hann(i % width, width) * hann(i / width, height);
    }
    let turns = |k: f64, cell: f64, size: f64, i: usize| turn(-k * cell * (i as f64 + 0.5) / size);
    let span = |middle: f64, reach: f64| {
        let steps = (reach / STEP).ceil() as i32;
        (-steps..=steps).map(move |i| middle + STEP * f64::from(i))
    };
    let mut powers = Vec::new();
    for ky in span(layout.carrier, layout.reach.y) {
        let mut columns = vec![DVec2::ZERO; width];
        for (y, row) in small.chunks_exact(width).enumerate() {
            let wave = turns(ky, cell.y, layout.frame.size.y, y);
            for (column, value) in columns.iter_mut().zip(row) {
                *column += wave * *value;
            }
        }
        for kx in span(0.0, layout.reach.x) {
            let waves = columns.iter().enumerate();
            let wave: Complex = waves
                .map(|(x, column)| turns(kx, cell.x, layout.frame.size.x, x).rotate(*column))
                .sum();
            powers.push((DVec2::new(kx, ky), wave.length()));
        }
    }
    let best = powers.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1));
    let (at, amplitude) = best.unwrap_or((DVec2::ZERO, 0.0));
    let share = field.extent / layout.frame.size;
    let next = powers
        .iter()
        .filter(|(k, _)| ((*k - at) * share).abs().max_element() > 3.0)
        .map(|(_, amplitude)| *amplitude)
        .fold(1e-12, f64::max);
    (at, amplitude / next)
}

/// The frequency to a small part of a turn, by a plane through the phases of the blocks.
fn refined(field: &Field, layout: &Layout, frequency: DVec2) -> DVec2 {
    (0..2).fold(frequency, |frequency, _| {
        // The mean turn from a block to the next, over columns and over rows.
        let wave = |column, row| {
            field.demodulated(
                frequency / layout.frame.size,
                block_centre(field, column, row),
            )[1]
        };
        let waves: Vec<Vec<Complex>> = (0..BLOCKS)
            .map(|row| (0..BLOCKS).map(|column| wave(column, row)).collect())
            .collect();
        let (mut right, mut down) = (DVec2::ZERO, DVec2::ZERO);
        for row in &waves {
            for pair in row.windows(2) {
                right += conjugate(pair[0]).rotate(pair[1]);
            }
        }
        for pair in waves.windows(2) {
            for (a, b) in pair[0].iter().zip(&pair[1]) {
                down += conjugate(*a).rotate(*b);
            }
        }
        let pitch = field.extent * (1.0 - 2.0 * WINDOW) / (BLOCKS - 1) as f64 / layout.frame.size;
        frequency + DVec2::new(argument(right), argument(down)) / pitch
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::calibrate::Setup;

    /// A wave on a slope, seen straight on.
    fn field(layout: &Layout, turns: DVec2, start: f64) -> Field {
        let (from, to) = layout.frame.field();
        let (width, height) = (400, 220);
        let extent = to - from;
        let values = (0..width * height).map(|i| {
            let part = DVec2::new((i % width) as f64 + 0.5, (i / width) as f64 + 0.5)
                / DVec2::new(width as f64, height as f64);
            let phase = ((from + extent * part) / layout.frame.size).dot(turns) + start;
            let value = 0.5 + 0.2 * part.x + 0.1 * (TAU * phase).cos();
            [value as f32; 3]
        });
        Field {
            values: values.collect(),
            width,
            height,
            origin: from,
            extent,
        }
    }

    #[test]
    fn frequency_and_phase_of_a_known_wave() {
        let layout = Layout::new(&Setup::new(960, 540, 8, 8.0, 0.66));
        for (x, y, start) in [(2.3, 23.4, 0.1), (-4.6, 26.2, 0.9), (0.0, 24.0, 0.5)] {
            let field = field(&layout, DVec2::new(x, y), start);
            let (found, ratio) = peak(&field, &layout);
            assert!(found.distance(DVec2::new(x, y)) < 0.3, "{found} {ratio}");
            assert!(ratio > 10.0, "{ratio}");
            let found = refined(&field, &layout, found);
            assert!(found.distance(DVec2::new(x, y)) < 0.01, "{found}");
            let centre = block_centre(&field, 3, 7);
            let wave = field.demodulated(found / layout.frame.size, centre)[1];
            assert!(wrap(argument(wave) - start).abs() < 0.01);
            assert!((wave.length() - 0.05).abs() < 0.002);
        }
    }
}
