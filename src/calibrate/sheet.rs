//! The lens sheet: where rays go through it, and the phase of its lenses.
#![forbid(unsafe_code)]

use super::Setup;
use super::pattern::Layout;
use glam::{DVec2, DVec3};

/// Nodes of the bias map, along each axis.
pub(super) const NODES: usize = 3;

/// The sheet: the correction of the nominal phase, and the plate between lenses and pixels.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    /// Turns by which the phase grows from the middle to the right edge, and to the lower edge.
    pub slope: DVec2,
    /// Turns, in the middle.
    pub phase: f64,
    /// From pixels to lenses for rays near the perpendicular, in effective air (thickness over index), panel pixels.
    pub gap: f64,
    /// 1/n² of the plate, n its index of refraction: 1 is air.
    pub refraction: f64,
    /// Subpixels; rows from the top.
    pub bias: [f64; NODES * NODES],
}

impl Sheet {
    /// Where the ray from an eye to a point of the panel goes through the sheet, panel pixels.
    ///
    /// Within a plate of index n, Snell's law gives the tangent t·cos θ/√(n² − sin² θ) times that of the ray in air, t being its thickness; `gap` is
    /// t/n.
    pub(super) fn through(&self, eye: DVec3, p: DVec2) -> DVec2 {
        let across = (eye.truncate() - p) / -eye.z;
        p + across * (self.gap * self.refracted(across))
    }

    /// The point of the panel that an eye sees where a straight ray, as through air, would meet it.
    pub(super) fn under(&self, eye: DVec3, apparent: DVec2) -> DVec2 {
        let across = (eye.truncate() - apparent) / -eye.z;
        apparent + across * (self.gap * (1.0 - self.refracted(across)))
    }

    /// By how much less than the gap says a ray of this slope in air goes across in the plate.
    fn refracted(&self, across: DVec2) -> f64 {
        let square = across.length_squared();
        // cos² θ and sin² θ of the ray in air.
        let (cos, sin) = (1.0 / (1.0 + square), square / (1.0 + square));
        (cos / (1.0 - self.refraction * sin)).sqrt()
    }

    /// Phase of the lens over that of the nominal one at a point of the sheet, turns.
    pub(super) fn added(&self, layout: &Layout, setup: &Setup, p: DVec2) -> f64 {
        let place = p / layout.frame.size * 2.0 - 1.0;
        let bias: f64 = if setup.bias {
            let weights = weights(p / layout.frame.size);
            weights.iter().zip(self.bias).map(|(w, b)| w * b).sum()
        } else {
            0.0
        };
        place.dot(self.slope) + self.phase + bias / setup.pitch
    }

    /// Phase of the lens through which an eye sees a point of the panel, turns.
    pub(super) fn seen(&self, layout: &Layout, setup: &Setup, eye: DVec3, p: DVec2) -> f64 {
        let lens = self.through(eye, p);
        layout.nominal(lens) + self.added(layout, setup, lens)
    }
}

/// Weights of the nodes of the bias map at a place from (0, 0) to (1, 1).
pub(super) fn weights(place: DVec2) -> [f64; NODES * NODES] {
    let last = (NODES - 1) as f64;
    let hat =
        |at: f64, node: usize| (1.0 - (at.clamp(0.0, 1.0) * last - node as f64).abs()).max(0.0);
    std::array::from_fn(|i| hat(place.x, i % NODES) * hat(place.y, i / NODES))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plate of 3 pixels of glass, by Snell's law and nothing else.
    #[test]
    fn rays_are_refracted() {
        let (index, thickness) = (1.5f64, 3.0);
        let sheet = Sheet {
            slope: DVec2::ZERO,
            phase: 0.0,
            gap: thickness / index,
            refraction: 1.0 / (index * index),
            bias: [0.0; NODES * NODES],
        };
        for degrees in [0.0f64, 10.0, 30.0, 45.0, -45.0] {
            let outside = degrees.to_radians();
            let inside = (outside.sin() / index).asin();
            let eye = DVec3::new(1000.0 * outside.tan(), 0.0, -1000.0);
            let found = sheet.through(eye, DVec2::ZERO);
            let want = thickness * inside.tan();
            assert!((found.x - want).abs() < 1e-12, "{degrees}: {found} {want}");
            // The straight ray meets the panel where it would be in air of the depth of the gap.
            let straight = DVec2::new(want - sheet.gap * outside.tan(), 0.0);
            let eye = straight.extend(0.0) + DVec3::new(outside.tan(), 0.0, -1.0) * 1000.0;
            let under = sheet.under(eye, straight);
            assert!(under.length() < 1e-12, "{degrees}: {under}");
        }
    }
}
