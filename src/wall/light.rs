//! How bright the panels of a wall are against each other, from the white of their pattern in photos.
//!
//! The logarithm of the light in a photo is that of its exposure, of the panel, and of the camera's lens, which darkens towards the corners by a polynomial of
//! the distance from the middle. The wall is made as bright everywhere as its darkest panel (Majumder and Stevens, "Perceptual photometric seamlessness in
//! tiled projection-based displays", 2005).
#![forbid(unsafe_code)]

use super::WallError;
use super::photo::Sighting;
use nalgebra::{DMatrix, DVector};

/// Samples that a panel needs.
const NEEDED: usize = 12;
/// Numbers of the lens.
const LENS: usize = 2;
/// How far a sample may be off, as a share of the light, before it counts less.
const OFF: f64 = 0.03;

/// The share of its light that each of so many panels is to show: 1 for the darkest one.
pub(super) fn lights(photos: &[&Sighting], panels: usize) -> Result<Vec<f64>, WallError> {
    let mut samples = Vec::new();
    for (photo, sighting) in photos.iter().enumerate() {
        let [width, height] = sighting.size;
        let half = width.hypot(height) / 2.0;
        let (mut clipped, mut taken) = (0, 0);
        for seen in &sighting.seen {
            clipped += seen.clipped;
            taken += 9 * seen.light.len();
            for ([x, y], light) in &seen.light {
                let far = ((x - width / 2.0) / half).powi(2) + ((y - height / 2.0) / half).powi(2);
                samples.push((photo, seen.tag.panel, far, light.max(1e-6).ln()));
            }
        }
        if clipped > taken {
            return Err(WallError::Clipped {
                photo: sighting.name.clone(),
            });
        }
    }
    let of = |panel: usize| samples.iter().filter(|sample| sample.1 == panel).count();
    if (0..panels).any(|panel| of(panel) < NEEDED) {
        let photo = photos.first().map(|photo| photo.name.clone());
        return Err(WallError::Clipped {
            photo: photo.unwrap_or_default(),
        });
    }
    // The first panel is the measure, so it has no unknown.
    let unknowns = photos.len() + panels - 1 + LENS;
    let row = |(photo, panel, far, _): &(usize, usize, f64, f64)| {
        let mut row = vec![0.0; unknowns];
        row[*photo] = 1.0;
        if let Some(other) = panel.checked_sub(1) {
            row[photos.len() + other] = 1.0;
        }
        row[unknowns - 2] = *far;
        row[unknowns - 1] = far * far;
        row
    };
    let mut weights = vec![1.0; samples.len()];
    let mut solution = DVector::zeros(unknowns);
    for _ in 0..8 {
        let mut a = DMatrix::zeros(samples.len(), unknowns);
        let mut b = DVector::zeros(samples.len());
        for (i, sample) in samples.iter().enumerate() {
            for (column, value) in row(sample).into_iter().enumerate() {
                a[(i, column)] = value * weights[i];
            }
            b[i] = sample.3 * weights[i];
        }
        let Ok(found) = a.svd(true, true).solve(&b, 1e-9) else {
            break;
        };
        solution = found;
        for (weight, sample) in weights.iter_mut().zip(&samples) {
            let expected: f64 = row(sample)
                .iter()
                .zip(solution.iter())
                .map(|(a, b)| a * b)
                .sum();
            let off = (sample.3 - expected) / OFF;
            *weight = 1.0 / (1.0 + off * off).sqrt();
        }
    }
    let gain = |panel: usize| match panel.checked_sub(1) {
        None => 0.0,
        Some(other) => solution[photos.len() + other],
    };
    let darkest = (0..panels).map(gain).fold(f64::MAX, f64::min);
    Ok((0..panels)
        .map(|panel| (darkest - gain(panel)).exp())
        .collect())
}
