//! The phase of a panel's lenses, as one affine function of the place.
//!
//! The subpixels that show one view lie near the lines `φ − i/N = a whole number`; tiles whose columns are those lines hold what the
//! panel shows of the view and little else.
#![forbid(unsafe_code)]

use super::{Display, Kind, Number, Placement, Rotation, Slanted};

/// φ, in turns (one turn is one lens, and all views), at the middle of a pixel: `start + x · right + row · down`, for a picture at its
/// place on the screen, `row` from its top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LensPhase {
    /// At the pixel in the left top corner.
    pub start: f64,
    /// Change of the phase per pixel to the right.
    pub right: f64,
    /// Change of the phase per pixel downwards.
    pub down: f64,
    /// Mean over the subpixels of φ·N − i: the place of a view in its part of the turn.
    pub within: f64,
    /// Change of the phase from the middle subpixel to the right one; the left one has the opposite change.
    pub colour: f64,
    /// Pixels show one view each, all of them at the same place in their part of the turn.
    pub exact: bool,
}

impl Display {
    /// None where the views do not follow one such function: tables, hand patterns, pictures, pixels with cells, measured
    /// local errors, panels that are mounted turned.
    #[must_use]
    pub fn lens_phase(&self, placement: &Placement, views: u32) -> Option<LensPhase> {
        if self.rotation != Rotation::None {
            return None;
        }
        let Phase {
            start,
            right,
            down,
            colour,
        } = self.phase(views)?;
        let (x, y) = (f64::from(placement.x), f64::from(placement.y));
        let phase = LensPhase {
            start: start + right * x + down * y,
            right,
            down,
            within: 0.5,
            colour,
            exact: false,
        };
        let (within, concentrated) = phase.mean_within(views);
        Some(LensPhase {
            within,
            exact: concentrated && colour == 0.0,
            ..phase
        })
    }

    /// At the screen's left top pixel.
    fn phase(&self, views: u32) -> Option<Phase> {
        match &self.kind {
            Kind::Lenticular => Some(Phase {
                start: 0.0,
                right: 1.0 / f64::from(views),
                down: 0.0,
                colour: 0.0,
            }),
            Kind::Huebner(_) => Slanted {
                pitch: Number::whole(views.into()),
                ..Slanted::HUEBNER
            }
            .phase(),
            Kind::Slanted(sheet) => sheet.phase(),
            Kind::Integer(steps) => steps.phase(),
            Kind::LookingGlass(device) => device.phase(),
            Kind::Leia(panel) => panel.phase(self.views),
            Kind::Pattern(pattern) => pattern.phase(),
            Kind::MaskFile { .. } | Kind::Wall(_) | Kind::Uncalibrated => None,
        }
    }
}

/// As [`LensPhase`], of the whole screen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Phase {
    pub(super) start: f64,
    pub(super) right: f64,
    pub(super) down: f64,
    /// Change of the phase from the middle subpixel to the right one; the left one has the opposite change.
    pub(super) colour: f64,
}

/// Pixels of a row, and rows, over which means are taken: primes, so that no pitch is met at the same places again and again.
const SAMPLES: (u32, u32) = (101, 31);

impl LensPhase {
    /// The circular mean, as parts just below 1 and just above 0 are neighbours; and whether all are the same.
    fn mean_within(&self, views: u32) -> (f64, bool) {
        let (mut sine, mut cosine, mut count) = (0.0, 0.0, 0.0);
        for row in 0..SAMPLES.1 {
            for x in 0..SAMPLES.0 {
                let middle = self.start + f64::from(x) * self.right + f64::from(row) * self.down;
                for phase in [middle - self.colour, middle, middle + self.colour] {
                    let angle = std::f64::consts::TAU * phase * f64::from(views);
                    sine += angle.sin();
                    cosine += angle.cos();
                    count += 1.0;
                }
            }
        }
        // Spread evenly over the part: its middle.
        if f64::hypot(sine, cosine) < 0.1 * count {
            return (0.5, false);
        }
        let concentrated = f64::hypot(sine, cosine) > (1.0 - 1e-9) * count;
        let mean = f64::atan2(sine, cosine) / std::f64::consts::TAU;
        // A boundary belongs to the view above it.
        let within = if mean < -1e-6 {
            mean + 1.0
        } else {
            mean.max(0.0)
        };
        (within, concentrated)
    }
}
