//! The one sheet that explains the beats of all tiles.
#![forbid(unsafe_code)]

use super::spectrum::{Peak, Spectrum};
use crate::display::SubpixelOrder;
use glam::DVec2;

/// Beats of each tile from which sheets are proposed, and the harmonics that these may be of.
const PEAKS: usize = 5;
const HARMONICS: u32 = 8;
/// Pitches that are looked for, subpixels, and the largest slant, subpixels per row.
const PITCHES: std::ops::RangeInclusive<f64> = 1.9..=110.0;
const SLANT: f64 = 3.0;
/// The part of the tiles' strongest beats that a sheet has to explain.
const EXPLAINED: f64 = 0.35;
/// With the colours in the other order, the columns of pixels make a grating `k` look like `k` less a turn in a pixel, and a sheet like its mirror
/// image: a turn in a pixel less its own frequency. A camera that blurs the beats of a fine sheet sees more of those of that mirror image. So where
/// the finer one of the two explains as much as this part of what the coarser one does, this has to explain nearly all. Sheets of more slant have
/// beats apart from those of their mirror image.
const MIRRORED: f64 = 0.5;
const MIRRORED_SLANT: f64 = 0.7;
const NEARLY_ALL: f64 = 0.75;
/// Another sheet explains less than this part of what the best one does.
const OTHER: f64 = 0.96;
/// Sheets count as one when their frequencies differ by fewer waves over a tile.
const SAME: f64 = 1.0;
/// Waves over a tile between a beat and those with columns of one colour.
const COLUMN: f64 = 1.5;
/// Of how many times as fine a sheet the beats may be that the best one has as well.
const FINER: i32 = 4;

/// A sheet: its frequency in turns per panel pixel, and how much it explains.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    frequency: DVec2,
    explained: f64,
    order: SubpixelOrder,
}

/// A sheet that explains the beats: its frequency, the standard deviation of that, turns per panel pixel, and the order of the colours, if they tell it.
pub(super) struct Found {
    pub frequency: DVec2,
    pub spread: DVec2,
    pub order: Option<SubpixelOrder>,
}

/// None where no sheet explains the beats better than all others.
pub(super) fn search(spectra: &[Spectrum]) -> Option<Found> {
    let orders = [SubpixelOrder::Rgb, SubpixelOrder::Bgr];
    let mut all: Vec<Candidate> = orders
        .into_iter()
        .flat_map(|order| Tiles::new(spectra, order).candidates())
        .collect();
    all.sort_by(|a, b| b.explained.total_cmp(&a.explained));
    let best = finest(spectra, &all)?;
    let tiles = Tiles::new(spectra, best.order);
    let (frequency, spread) = tiles.refined(best.frequency)?;
    let explained = tiles.explained(frequency);
    let other = all.iter().find(|other| {
        // A sheet that is so many times as coarse has the same beats and more; were it the right one, these would be seen, too.
        let times = (frequency.x / other.frequency.x).round().max(1.0);
        !tiles.same(times * other.frequency, frequency)
    });
    let only = other.is_none_or(|other| other.explained < OTHER * explained);
    let told = orders.into_iter().all(|order| {
        order == best.order || Tiles::new(spectra, order).explained(frequency) < OTHER * explained
    });
    let mirrored = orders.into_iter().any(|order| {
        let image = DVec2::X - frequency;
        order != best.order
            && image.x > frequency.x
            && (3.0 * image.y / image.x).abs() < MIRRORED_SLANT
            && Tiles::new(spectra, order).explained(image) >= MIRRORED * explained
    });
    let least = match mirrored {
        true => NEARLY_ALL,
        false => EXPLAINED,
    };
    (explained >= least && only).then_some(Found {
        frequency,
        spread,
        order: told.then_some(best.order),
    })
}

/// The sheet that explains most, or where one that is a whole number of times as fine explains as much, that: the coarser one has its
/// beats and, from noise, a little more.
fn finest(spectra: &[Spectrum], all: &[Candidate]) -> Option<Candidate> {
    let best = *all.first()?;
    let tiles = Tiles::new(spectra, best.order);
    let finer = all.iter().filter(|other| {
        let times = (other.frequency.x / best.frequency.x).round() as i32;
        (2..=FINER).contains(&times)
            && other.order == best.order
            && other.explained >= OTHER * best.explained
            && tiles.same(other.frequency, f64::from(times) * best.frequency)
    });
    let finer = finer.max_by(|a, b| a.frequency.x.total_cmp(&b.frequency.x));
    Some(finer.copied().unwrap_or(best))
}

/// The tiles, for one order of the colours.
struct Tiles<'a> {
    spectra: &'a [Spectrum],
    order: SubpixelOrder,
    /// The strongest beats of each.
    peaks: Vec<Vec<Peak>>,
}

impl<'a> Tiles<'a> {
    fn new(spectra: &'a [Spectrum], order: SubpixelOrder) -> Self {
        let peaks = spectra.iter().map(|tile| tile.peaks(order, PEAKS));
        Self {
            spectra,
            order,
            peaks: peaks.collect(),
        }
    }

    fn same(&self, a: DVec2, b: DVec2) -> bool {
        let waves = |tile: &Spectrum| tile.waves(a - b).abs().max_element();
        self.spectra.iter().all(|tile| waves(tile) < SAME)
    }

    /// All sheets that give one of the strongest beats of a tile.
    fn candidates(&self) -> Vec<Candidate> {
        let mut all = Vec::new();
        for (tile, peaks) in self.spectra.iter().zip(&self.peaks) {
            for (peak, harmonic) in peaks
                .iter()
                .flat_map(|peak| (1..=HARMONICS).map(move |harmonic| (peak, harmonic)))
            {
                let frequency = (tile.frequency - peak.frequency) / f64::from(harmonic);
                let slant = 3.0 * frequency.y / frequency.x;
                if frequency.x > 0.0
                    && PITCHES.contains(&(3.0 / frequency.x))
                    && slant.abs() <= SLANT
                {
                    all.push(Candidate {
                        frequency,
                        explained: self.explained(frequency),
                        order: self.order,
                    });
                }
            }
        }
        all
    }

    /// The harmonic of a sheet that is nearest to a grating, whose beat lenses do not break up; and the beat.
    fn beat(tile: &Spectrum, sheet: DVec2) -> Option<(f64, DVec2)> {
        let harmonic = (tile.frequency.dot(sheet) / sheet.length_squared()).round();
        (harmonic >= 1.0).then(|| (harmonic, tile.frequency - harmonic * sheet))
    }

    /// The part of the tiles' strongest beats that lies where a sheet has its beats, 0 to 1.
    fn explained(&self, sheet: DVec2) -> f64 {
        let columns = Self::columns(sheet);
        let told = |tile: &Spectrum, beat: DVec2| {
            let apart = |column: &DVec2| {
                let waves = |d: DVec2| tile.waves(d).length();
                waves(beat - *column) >= COLUMN && waves(beat + *column) >= COLUMN
            };
            columns.iter().all(apart)
        };
        let (mut explained, mut total) = (0.0, 0.0);
        for (tile, peaks) in self.spectra.iter().zip(&self.peaks) {
            let strongest = peaks.iter().find(|peak| told(tile, peak.frequency));
            total += strongest.map_or(0.0, |peak| peak.amplitude);
            let beat = Self::beat(tile, sheet).map(|(_, beat)| beat);
            let beat = beat.filter(|beat| told(tile, *beat));
            explained += beat
                .and_then(|beat| tile.amplitude(self.order, beat))
                .unwrap_or(0.0);
        }
        explained / total
    }

    /// The beats of a sheet with the columns of one colour, whatever the grating. Where red and blue are put where a pixel has them in the other
    /// order, the colours of these do not cancel; where lenses are upright they are coarse, and stronger than all others.
    fn columns(sheet: DVec2) -> Vec<DVec2> {
        let beats = [1.0, 2.0].into_iter().flat_map(|times| {
            let columns = DVec2::X * times;
            let nearest = (columns.dot(sheet) / sheet.length_squared()).round();
            [-1.0, 0.0, 1.0].map(|beside| columns - (nearest + beside) * sheet)
        });
        beats.collect()
    }

    /// The frequency by all tiles, and its standard deviation, turns per panel pixel: the mean of what each says, weighted by amplitude and
    /// harmonic, without those that disagree with most.
    fn refined(&self, sheet: DVec2) -> Option<(DVec2, DVec2)> {
        const ROUNDS: usize = 4;
        const DISAGREES: f64 = 3.0;
        let (mut sheet, mut spread) = (sheet, DVec2::INFINITY);
        for _ in 0..ROUNDS {
            let found = self.spectra.iter().filter_map(|tile| {
                let (harmonic, beat) = Self::beat(tile, sheet)?;
                let peak = tile.near(self.order, beat)?;
                let told = (tile.frequency - peak.frequency) / harmonic;
                Some((told, harmonic, peak.amplitude))
            });
            let found: Vec<(DVec2, f64, f64)> = found.collect();
            // Of a beat, in turns per pixel: the same for all harmonics.
            let scatter = |axis: fn(DVec2) -> f64| {
                let mut sizes: Vec<f64> = found
                    .iter()
                    .map(|(told, harmonic, _)| (axis(*told - sheet) * harmonic).abs())
                    .collect();
                sizes.sort_by(f64::total_cmp);
                sizes.get(sizes.len() / 2).map(|middle| 1.4826 * middle)
            };
            let scatter = DVec2::new(scatter(|d| d.x)?, scatter(|d| d.y)?);
            let (mut sum, mut weights, mut squares, mut count) =
                (DVec2::ZERO, 0.0, DVec2::ZERO, 0.0);
            for (told, harmonic, amplitude) in &found {
                let off = (*told - sheet) * *harmonic;
                if (off.abs() - DISAGREES * scatter).max_element() > 1e-12 {
                    continue;
                }
                let weight = amplitude * harmonic * harmonic;
                sum += *told * weight;
                squares += (off * weight / harmonic).powf(2.0);
                weights += weight;
                count += 1.0;
            }
            if count < 3.0 {
                return None;
            }
            sheet = sum / weights;
            spread = squares.powf(0.5) / weights;
        }
        Some((sheet, spread))
    }
}
