//! Pictures of splats, subpixel by subpixel.
#![forbid(unsafe_code)]

use super::disk::{Hit, hit};
use super::groups::Groups;
use super::{Eyes, Screen, Splat};
use crate::display::Mask;
use glam::DVec2;
use image::{Rgb, RgbImage};

/// How splats that overlap become one surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface<'a> {
    /// The nearest splat is seen as it is.
    Opaque,
    /// All splats that are at most this much (ε, in units of camera space) behind the nearest one are blended: the usual 2 + 1 passes.
    Blended(f64),
    /// Of each group the nearest splat, and of these all that are at most ε behind the nearest one: deferred blending in 1 + 1 passes (Figures
    /// 12 and 13).
    Deferred {
        /// ε.
        behind: f64,
        /// The groups of the splats.
        groups: &'a Groups,
        /// The colours of a pixel have the mean of their depths, as in the paper; else each its own.
        averaged: bool,
    },
}

/// The weight of a splat at a distance from its middle, as a share of its radius: 1 there and 0 at its edge, without a step.
#[must_use]
pub fn weight(distance: f64) -> f64 {
    let left = (1.0 - distance * distance).max(0.0);
    left * left
}

/// The picture of a panel: each subpixel shows what the ray of its view meets. Black subpixels of the mask and rays that meet nothing are black.
#[must_use]
pub fn picture(
    splats: &[Splat],
    (eyes, screen): (&Eyes, &Screen),
    mask: &Mask,
    surface: Surface<'_>,
) -> RgbImage {
    RgbImage::from_fn(screen.size.0, screen.size.1, |x, y| {
        let place = screen.place([f64::from(x) + 0.5, f64::from(y) + 0.5]);
        let views = mask.at(x, y).unwrap_or_default();
        let views = views.map(|view| Some(u32::from(view)).filter(|view| *view < eyes.views));
        let seen = views.map(|view| {
            let offset = view.map(|view| eyes.offset(view));
            offset.map_or_else(Vec::new, |offset| met(splats, eyes, offset, place))
        });
        let colours = match surface {
            Surface::Deferred {
                behind,
                groups,
                averaged,
            } => deferred(splats, &seen, (behind, groups, averaged)),
            Surface::Opaque => [0, 1, 2].map(|c| opaque(splats, &seen[c], c)),
            Surface::Blended(behind) => [0, 1, 2].map(|c| blended(splats, &seen[c], behind, c)),
        };
        Rgb(colours.map(|colour| (colour.clamp(0.0, 1.0) * 255.0).round() as u8))
    })
}

/// The splats that a ray meets, by number.
fn met(splats: &[Splat], eyes: &Eyes, offset: f64, place: DVec2) -> Vec<(usize, Hit)> {
    let all = splats.iter().enumerate();
    all.filter_map(|(number, splat)| Some((number, hit(splat, eyes, offset, place)?)))
        .collect()
}

fn nearest<'a>(met: impl Iterator<Item = &'a (usize, Hit)>) -> Option<&'a (usize, Hit)> {
    met.min_by(|a, b| a.1.depth.total_cmp(&b.1.depth))
}

fn opaque(splats: &[Splat], met: &[(usize, Hit)], channel: usize) -> f64 {
    nearest(met.iter()).map_or(0.0, |(number, _)| {
        f64::from(splats[*number].colour[channel])
    })
}

/// The mean of colours by their weights; black without any.
fn mean<'a>(splats: &[Splat], met: impl Iterator<Item = &'a (usize, Hit)>, channel: usize) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for (number, hit) in met {
        let weight = weight(hit.distance);
        sum += weight * f64::from(splats[*number].colour[channel]);
        weights += weight;
    }
    if weights > 0.0 { sum / weights } else { 0.0 }
}

fn blended(splats: &[Splat], met: &[(usize, Hit)], behind: f64, channel: usize) -> f64 {
    let front = nearest(met.iter()).map_or(f64::INFINITY, |(_, hit)| hit.depth);
    let near = met.iter().filter(|(_, hit)| hit.depth <= front + behind);
    mean(splats, near, channel)
}

/// What the images of the groups hold of a pixel, put together.
fn deferred(
    splats: &[Splat],
    seen: &[Vec<(usize, Hit)>; 3],
    (behind, groups, averaged): (f64, &Groups, bool),
) -> [f64; 3] {
    // For each group what its image holds in each colour.
    let images: Vec<[Option<(usize, Hit)>; 3]> = (0..groups.count)
        .map(|group| {
            let of_group = |met: &Vec<(usize, Hit)>| {
                nearest(met.iter().filter(|(number, _)| groups.of[*number] == group)).copied()
            };
            let mut image = seen.each_ref().map(of_group);
            let depths: Vec<f64> = image.iter().flatten().map(|(_, hit)| hit.depth).collect();
            if averaged && !depths.is_empty() {
                let mean = depths.iter().sum::<f64>() / depths.len() as f64;
                for (_, hit) in image.iter_mut().flatten() {
                    hit.depth = mean;
                }
            }
            image
        })
        .collect();
    let depths = |channel: usize| {
        let all = images.iter().filter_map(move |image| image[channel]);
        all.map(|(_, hit)| hit.depth).fold(f64::INFINITY, f64::min)
    };
    let fronts = [0, 1, 2].map(depths);
    [0, 1, 2].map(|channel| {
        let front = if averaged {
            fronts.iter().copied().fold(f64::INFINITY, f64::min)
        } else {
            fronts[channel]
        };
        let all = images.iter().filter_map(|image| image[channel].as_ref());
        let near = all.filter(|(_, hit)| hit.depth <= front + behind);
        mean(splats, near, channel)
    })
}
