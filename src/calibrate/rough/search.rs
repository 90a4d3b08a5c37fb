//! The one sheet that explains the beats of all tiles.
//!
//! Half of the tiles are drawn for a panel with red on the left of a pixel, half for one with blue there. The right half shows the beats of the sheet, and from it
//! comes the frequency. In the other half red and blue have changed places, and each beat is weaker by a known part: that is the proof. To the wrong
//! half a sheet looks like its mirror image, a turn in a pixel less its own frequency, and of a fine sheet a camera sees more of the beats of that one,
//! but then the other half does not fit.
#![forbid(unsafe_code)]

use super::spectrum::{Peak, Spectrum};
use crate::display::SubpixelOrder;
use glam::DVec2;
use std::f64::consts::TAU;
use std::ops::RangeInclusive;

/// Beats of each tile from which sheets are proposed, and the harmonics that these may be of.
const PEAKS: usize = 5;
const HARMONICS: u32 = 8;
/// The largest slant that is looked for, subpixels per row.
const SLANT: f64 = 3.0;
/// Proposed sheets that are looked at more closely, of those that explain most.
const TRIED: usize = 30;
/// The part of the tiles' strongest beats that a sheet has to explain. Without lenses noise looks as if one explained up to 0.16.
const EXPLAINED: f64 = 0.2;
/// Beats of a harmonic are on average at least so strong a part of those of its multiples. Measured: 0.77 and more; of sheets that are a whole number of times as fine 0.11 and less.
const HARMONIC: f64 = 0.3;
/// How the beats in tiles of the other order have to agree with what is expected of them: least correlation, and bounds of the factor between them. Measured:
/// 0.92 to 1 and 0.71 to 1.25; of mirror images 0.17 to 0.76 and 0.13 to 0.31, and on a panel whose pixels are turned 0.9 and 1.44. The factor is least for lenses
/// of four subpixels, where red and blue cancel what green shows, and the camera blurs those more.
const CORRELATION: f64 = 0.9;
const FACTOR: RangeInclusive<f64> = 0.5..=1.25;
/// Sheets count as one when their frequencies differ by fewer waves over a tile.
const SAME: f64 = 1.0;
/// Waves over a tile between a beat and those with columns of one colour.
const COLUMN: f64 = 1.5;

/// A sheet: its frequency in turns per panel pixel, and how much it explains.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    frequency: DVec2,
    explained: f64,
    order: SubpixelOrder,
}

/// A sheet that explains the beats: its frequency, the standard deviation of that, turns per panel pixel, and the order of the colours.
pub(super) struct Found {
    pub frequency: DVec2,
    pub spread: DVec2,
    pub order: SubpixelOrder,
}

/// The sheet of one of these pitches, subpixels, that explains the beats of both orders; none where no sheet does.
pub(super) fn search(spectra: &[Spectrum], pitches: &RangeInclusive<f64>) -> Option<Found> {
    let rgb = Tiles::new(spectra, SubpixelOrder::Rgb);
    let bgr = Tiles::new(spectra, SubpixelOrder::Bgr);
    let mut all = rgb.candidates(pitches);
    all.extend(bgr.candidates(pitches));
    all.sort_by(|a, b| b.explained.total_cmp(&a.explained));
    let mut tried: Vec<Candidate> = Vec::new();
    for candidate in all {
        let (tiles, others) = match candidate.order {
            SubpixelOrder::Rgb => (&rgb, &bgr),
            SubpixelOrder::Bgr => (&bgr, &rgb),
        };
        let again = |other: &Candidate| {
            other.order == candidate.order && tiles.same(other.frequency, candidate.frequency)
        };
        if tried.iter().any(again) {
            continue;
        }
        if tried.len() == TRIED {
            break;
        }
        tried.push(candidate);
        let found = tiles.refined(candidate.frequency).filter(|(frequency, _)| {
            tiles.explained(*frequency) >= EXPLAINED
                && tiles.has_harmonics(*frequency)
                && tiles.has_colours(others, *frequency)
        });
        if let Some((frequency, spread)) = found {
            return Some(Found {
                frequency,
                spread,
                order: candidate.order,
            });
        }
    }
    None
}

/// The tiles that are drawn for one order of the colours.
struct Tiles<'a> {
    order: SubpixelOrder,
    /// Of each tile, with its strongest beats.
    beats: Vec<(&'a Spectrum, Vec<Peak>)>,
}

impl<'a> Tiles<'a> {
    fn new(spectra: &'a [Spectrum], order: SubpixelOrder) -> Self {
        let tiles = spectra.iter().filter(|tile| tile.order == order);
        Self {
            order,
            beats: tiles.map(|tile| (tile, tile.peaks(PEAKS))).collect(),
        }
    }

    fn same(&self, a: DVec2, b: DVec2) -> bool {
        let waves = |tile: &Spectrum| tile.waves(a - b).abs().max_element();
        self.beats.iter().all(|(tile, _)| waves(tile) < SAME)
    }

    /// All sheets that give one of the strongest beats of a tile.
    fn candidates(&self, pitches: &RangeInclusive<f64>) -> Vec<Candidate> {
        let mut all = Vec::new();
        for (tile, peaks) in &self.beats {
            for (peak, harmonic) in peaks
                .iter()
                .flat_map(|peak| (1..=HARMONICS).map(move |harmonic| (peak, harmonic)))
            {
                let frequency = (tile.frequency - peak.frequency) / f64::from(harmonic);
                let slant = 3.0 * frequency.y / frequency.x;
                if frequency.x > 0.0
                    && pitches.contains(&(3.0 / frequency.x))
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
        for (tile, peaks) in &self.beats {
            let strongest = peaks.iter().find(|peak| told(tile, peak.frequency));
            total += strongest.map_or(0.0, |peak| peak.amplitude);
            let beat = Self::beat(tile, sheet).map(|(_, beat)| beat);
            let beat = beat.filter(|beat| told(tile, *beat));
            explained += beat.and_then(|beat| tile.amplitude(beat)).unwrap_or(0.0);
        }
        explained / total
    }

    /// The beats of a sheet with the columns of one colour, whatever the grating. Where lenses are upright they are coarse, and where the colours are not as
    /// bright as each other they do not cancel.
    fn columns(sheet: DVec2) -> Vec<DVec2> {
        let beats = [1.0, 2.0].into_iter().flat_map(|times| {
            let columns = DVec2::X * times;
            let nearest = (columns.dot(sheet) / sheet.length_squared()).round();
            [-1.0, 0.0, 1.0].map(|beside| columns - (nearest + beside) * sheet)
        });
        beats.collect()
    }

    /// Whether the beats are of all harmonics of a sheet. Those of one that is a whole number of times as fine are the multiples of that number alone, and lenses blur
    /// multiples more.
    fn has_harmonics(&self, sheet: DVec2) -> bool {
        let seen = self.beats.iter().filter_map(|(tile, _)| {
            let (harmonic, beat) = Self::beat(tile, sheet)?;
            Some((harmonic as u32, tile.amplitude(beat)?))
        });
        let seen: Vec<(u32, f64)> = seen.collect();
        (2..=HARMONICS).all(|times| {
            let (multiples, rest): (Vec<_>, Vec<_>) = seen
                .iter()
                .partition(|(harmonic, _)| harmonic.is_multiple_of(times));
            let mean = |beats: &[(u32, f64)]| {
                let sum: f64 = beats.iter().map(|(_, amplitude)| amplitude).sum();
                sum / beats.len() as f64
            };
            multiples.is_empty() || mean(&rest) >= HARMONIC * mean(&multiples)
        })
    }

    /// Whether the beats in the tiles of the other order are those of the sheet, weaker by as much as colours that have changed places make them. Places of three
    /// subpixels, two of which are off by two subpixels to either side, leave `(1 + 2 cos(2π 2/3 k)) / 3` of a grating with `k` turns per pixel.
    fn has_colours(&self, others: &Tiles, sheet: DVec2) -> bool {
        let (mut product, mut expected, mut seen) = (0.0, 0.0, 0.0);
        for (tile, _) in &self.beats {
            let mut others = others.beats.iter().map(|(other, _)| other);
            let twin = others.find(|other| other.frequency == tile.frequency);
            let beat = Self::beat(tile, sheet).map(|(_, beat)| beat);
            let pair = twin
                .zip(beat)
                .and_then(|(twin, beat)| tile.amplitude(beat).zip(twin.amplitude(beat)));
            if let Some((strong, weak)) = pair {
                let left = (1.0 + 2.0 * (TAU * 2.0 / 3.0 * tile.frequency.x).cos()) / 3.0;
                let strong = strong * left.abs();
                product += strong * weak;
                expected += strong * strong;
                seen += weak * weak;
            }
        }
        product >= CORRELATION * (expected * seen).sqrt() && FACTOR.contains(&(product / expected))
    }

    /// The frequency by all tiles, and its standard deviation, turns per panel pixel: the mean of what each says, weighted by amplitude and
    /// harmonic, without those that disagree with most.
    fn refined(&self, sheet: DVec2) -> Option<(DVec2, DVec2)> {
        const ROUNDS: usize = 4;
        const DISAGREES: f64 = 3.0;
        let (mut sheet, mut spread) = (sheet, DVec2::INFINITY);
        for _ in 0..ROUNDS {
            let found = self.beats.iter().filter_map(|(tile, _)| {
                let (harmonic, beat) = Self::beat(tile, sheet)?;
                let peak = tile.near(beat)?;
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
