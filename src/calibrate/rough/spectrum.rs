//! The spectrum of a tile as the camera sees it.
#![forbid(unsafe_code)]

use super::super::Photo;
use super::super::camera::View;
use super::super::complex::{Complex, conjugate, turn};
use super::super::levels::Levels;
use super::tiles::Tile;
use crate::display::SubpixelOrder;
use glam::{DVec2, IVec2};
use std::f64::consts::TAU;

/// Samples along a side of a tile, at most and at least; between these one per camera pixel.
const SAMPLES: std::ops::RangeInclusive<f64> = 24.0..=180.0;
/// Frequencies between those whose waves fit into a tile. A Hann window makes a peak two waves wide to either side.
const BETWEEN: f64 = 1.5;
/// The finest beat, turns per sample; finer ones are blurred by camera and file.
const FINEST: f64 = 0.36;
/// Waves over a tile of the coarsest beat, and how near to what shows without a lens a beat may lie.
const COARSEST: f64 = 2.0;
const APART: f64 = 2.5;
/// A part of the side of a tile at its edges that is not used: blur mixes neighbours there.
const MARGIN: f64 = 0.04;

/// Amplitudes over the frequencies of beats; zero where no beat can be told.
#[derive(Clone, Debug)]
pub(super) struct Spectrum {
    /// Frequency of the grating, turns per panel pixel.
    pub frequency: DVec2,
    /// Which colour is leftmost in a pixel of the panel that the tile is drawn for.
    pub order: SubpixelOrder,
    /// From one value to the next, turns per panel pixel.
    step: DVec2,
    /// Values to either side of the frequency 0, to the right and down.
    reach: IVec2,
    /// Of the mean of the colours, rows from the most negative frequency, as a part of white.
    amplitudes: Vec<f32>,
}

/// A beat.
#[derive(Clone, Copy, Debug)]
pub(super) struct Peak {
    /// Turns per panel pixel.
    pub frequency: DVec2,
    /// As a part of white.
    pub amplitude: f64,
}

impl Spectrum {
    /// None where the tile is not in the photo.
    pub(super) fn new(photo: &Photo, view: View, levels: Levels, tile: Tile) -> Option<Self> {
        let from = tile.corner + tile.size * MARGIN;
        let extent = tile.size * (1.0 - 2.0 * MARGIN);
        let middle = view.to_picture(from + extent / 2.0)?;
        let along = |axis: DVec2| {
            let end = view.to_picture(from + extent / 2.0 + extent * axis / 2.0)?;
            Some((2.0 * end.distance(middle)).clamp(*SAMPLES.start(), *SAMPLES.end()) as usize)
        };
        let (width, height) = (along(DVec2::X)?, along(DVec2::Y)?);
        let counts = DVec2::new(width as f64, height as f64);
        let hann = |i: usize, n: usize| 0.5 - 0.5 * (TAU * (i as f64 + 0.5) / n as f64).cos();
        let mut samples = Vec::with_capacity(width * height);
        let (mut sum, mut weights) = (0.0, 0.0);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let part = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) / counts;
            let rgb = levels.of(photo.at(view.to_picture(from + extent * part)?)?);
            let grey = rgb.iter().map(|v| f64::from(*v)).sum::<f64>() / 3.0;
            let weight = hann(x, width) * hann(y, height);
            sum += weight * grey;
            weights += weight;
            samples.push((grey, weight));
        }
        let mean = sum / weights;
        let values = samples
            .iter()
            .map(|(grey, weight)| (grey - mean) * weight / weights);
        let values: Vec<f64> = values.collect();
        let step = 1.0 / (BETWEEN * extent);
        let mut spectrum = Self {
            frequency: tile.frequency,
            order: tile.order,
            step,
            reach: (FINEST * counts * BETWEEN).as_ivec2(),
            amplitudes: Vec::new(),
        };
        let waves = spectrum.transformed(&values, width, step * extent / counts);
        let amplitudes = waves.iter().enumerate().map(|(at, wave)| {
            match spectrum.tells(spectrum.at(at), extent) {
                // The amplitude of a cosine is twice that of its half of the spectrum.
                true => 2.0 * wave.length() as f32,
                false => 0.0,
            }
        });
        spectrum.amplitudes = amplitudes.collect();
        Some(spectrum)
    }

    /// Values in a row.
    fn width(&self) -> usize {
        (2 * self.reach.x + 1) as usize
    }

    /// Frequency of a value.
    fn at(&self, index: usize) -> DVec2 {
        let (x, y) = (index % self.width(), index / self.width());
        (IVec2::new(x as i32, y as i32) - self.reach).as_dvec2() * self.step
    }

    /// Whether a beat of this frequency is not what shows without lenses: brightness that changes slowly, the grating itself, and what it gives with
    /// columns of one colour.
    fn tells(&self, frequency: DVec2, extent: DVec2) -> bool {
        let waves = |d: DVec2| (d * extent).length();
        let k = self.frequency;
        let without = [k, k - DVec2::X, k - 2.0 * DVec2::X];
        waves(frequency) >= COARSEST
            && without
                .iter()
                .all(|k| waves(frequency - *k) >= APART && waves(frequency + *k) >= APART)
    }

    /// The Fourier transform of samples whose phase turns by `turns` times the number of a value from one to the next. They are real, so
    /// opposite frequencies have conjugate values, and half of them are computed.
    fn transformed(&self, values: &[f64], width: usize, turns: DVec2) -> Vec<Complex> {
        let height = values.len() / width;
        let table = |n: usize, reach: i32, turns: f64| {
            let row =
                move |i: i32| (0..n).map(move |x| turn(-turns * f64::from(i) * (x as f64 + 0.5)));
            (0..=reach).flat_map(row).collect::<Vec<Complex>>()
        };
        let across = table(width, self.reach.x, turns.x);
        let rows = values.chunks_exact(width).map(|row| {
            let sum = |wave: &[Complex]| wave.iter().zip(row).map(|(w, v)| *w * *v).sum();
            let right: Vec<Complex> = across.chunks_exact(width).map(sum).collect();
            let left = right.iter().skip(1).rev().map(|v| conjugate(*v));
            left.chain(right.iter().copied()).collect()
        });
        let rows: Vec<Vec<Complex>> = rows.collect();
        let below = table(height, self.reach.y, turns.y);
        let below = below.chunks_exact(height).map(|wave| {
            let mut out = vec![DVec2::ZERO; self.width()];
            for (row, w) in rows.iter().zip(wave) {
                for (out, v) in out.iter_mut().zip(row) {
                    *out += w.rotate(*v);
                }
            }
            out
        });
        let below: Vec<Complex> = below.flatten().collect();
        let above = below.iter().skip(self.width()).rev().map(|v| conjugate(*v));
        above.chain(below.iter().copied()).collect()
    }

    /// How many waves of a frequency there are over the tile, in width and height.
    pub(super) fn waves(&self, frequency: DVec2) -> DVec2 {
        frequency / self.step / BETWEEN
    }

    /// The value nearest to a frequency: its column and row; none outside.
    fn place(&self, frequency: DVec2) -> Option<(usize, usize)> {
        let at = (frequency / self.step).round().as_ivec2() + self.reach;
        let inside = at.cmpge(IVec2::ONE).all() && at.cmplt(2 * self.reach).all();
        inside.then_some((at.x as usize, at.y as usize))
    }

    fn value(&self, x: usize, y: usize) -> f64 {
        let value = self.amplitudes.get(y * self.width() + x);
        f64::from(value.copied().unwrap_or(0.0))
    }

    /// Amplitude at a frequency; none where beats cannot be told.
    pub(super) fn amplitude(&self, frequency: DVec2) -> Option<f64> {
        let (x, y) = self.place(frequency)?;
        let value = self.value(x, y);
        (value > 0.0).then_some(value)
    }

    /// The strongest beats, the first one first.
    pub(super) fn peaks(&self, most: usize) -> Vec<Peak> {
        let (width, height) = (self.width(), (2 * self.reach.y + 1) as usize);
        let inside = (1..height - 1).flat_map(|y| (1..width - 1).map(move |x| (x, y)));
        let mut found: Vec<Peak> = inside.filter_map(|(x, y)| self.peak(x, y)).collect();
        found.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
        found.truncate(most);
        found
    }

    /// The beat near a frequency.
    pub(super) fn near(&self, frequency: DVec2) -> Option<Peak> {
        let (mut x, mut y) = self.place(frequency)?;
        let (width, height) = (self.width(), (2 * self.reach.y + 1) as usize);
        // Up the slope, by two values at most.
        for _ in 0..2 {
            let around = (y - 1..=y + 1).flat_map(|y| (x - 1..=x + 1).map(move |x| (x, y)));
            let best = around.max_by(|a, b| {
                let value = |(x, y): &(usize, usize)| self.value(*x, *y);
                value(a).total_cmp(&value(b))
            })?;
            x = best.0.clamp(1, width - 2);
            y = best.1.clamp(1, height - 2);
        }
        self.peak(x, y)
    }

    /// The peak whose highest value is this one, with its top by a parabola through the logarithms of three values along each axis. None where a value around
    /// is higher, or is not that of a beat: that is the slope of something else, such as of brightness that changes slowly.
    fn peak(&self, x: usize, y: usize) -> Option<Peak> {
        let rows = [0, 1, 2].map(|dy| [0, 1, 2].map(|dx| self.value(x + dx - 1, y + dy - 1)));
        let highest = rows[1][1];
        let is_peak = |value: &f64| *value > 0.0 && *value <= highest;
        if !rows.iter().flatten().all(is_peak) {
            return None;
        }
        let top = |values: [f64; 3]| {
            let [before, here, after] = values.map(f64::ln);
            let bend = before - 2.0 * here + after;
            match bend < -1e-9 {
                true => (0.5 * (before - after) / bend).clamp(-0.5, 0.5),
                false => 0.0,
            }
        };
        let beside = DVec2::new(top(rows[1]), top(rows.map(|row| row[1])));
        Some(Peak {
            frequency: self.at(y * self.width() + x) + beside * self.step,
            amplitude: highest,
        })
    }
}
