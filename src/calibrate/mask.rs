//! The mask that a sheet needs: its phase at every pixel for an eye on the axis of the panel, as a plane and what is left of it.
#![forbid(unsafe_code)]

use super::Setup;
use super::pattern::Layout;
use super::sheet::Sheet;
use glam::DVec2;

/// Columns and rows of the map of what a plane leaves. They hold the nodes of a measured bias; with half as many along each
/// axis, masks of 32 to 56 views were off by up to 0.07 views more.
pub(super) const COLUMNS: usize = 17;
pub(super) const ROWS: usize = 9;
/// Views by which a plane may be off before the map is written.
const LEAST: f64 = 0.1;

/// Where the viewers are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Viewers<'a> {
    pub layout: &'a Layout,
    pub setup: &'a Setup,
    /// On the axis of the panel, panel pixels; infinite for the phase of the sheet itself.
    pub distance: f64,
}

impl Viewers<'_> {
    /// Phase of the mask at a point of the panel, turns.
    pub(super) fn phase(&self, sheet: &Sheet, p: DVec2) -> f64 {
        let eye = (self.layout.frame.size / 2.0).extend(-self.distance);
        match self.distance.is_finite() {
            true => sheet.seen(self.layout, self.setup, eye, p),
            false => sheet.seen(self.layout, self.setup, p.extend(-1.0), p),
        }
    }

    /// The mask of a sheet.
    pub(super) fn mask(&self, sheet: &Sheet) -> Mask {
        let size = self.layout.frame.size;
        let places = || (0..COLUMNS * ROWS).map(place);
        let phases: Vec<f64> = places()
            .map(|place| self.phase(sheet, (place + 1.0) / 2.0 * size))
            .collect();
        let sum = |weight: &dyn Fn(DVec2) -> f64| {
            let terms = places().zip(&phases).map(|(at, phase)| weight(at) * phase);
            terms.sum::<f64>()
        };
        let squares = |axis: fn(DVec2) -> f64| places().map(|at| axis(at).powi(2)).sum::<f64>();
        // The places lie evenly around the middle, so that the three numbers of the plane do not depend on each other.
        let slope = DVec2::new(
            sum(&|at| at.x) / squares(|at| at.x),
            sum(&|at| at.y) / squares(|at| at.y),
        );
        let middle = sum(&|_| 1.0) / phases.len() as f64;
        let growth = slope * 2.0 / size;
        let pitch = 3.0 / growth.x;
        let left = places()
            .zip(&phases)
            .map(|(at, phase)| (phase - middle - at.dot(slope)) * pitch);
        let left: Vec<f64> = left.collect();
        let most = left
            .iter()
            .fold(0.0, |most: f64, left| most.max(left.abs()));
        let slant = growth.y * pitch;
        let centre = size / 2.0;
        let offset = middle * pitch - (3.0 * centre.x - 0.5) - slant * (centre.y - 0.5);
        Mask {
            viewer: self.distance,
            pitch,
            slant,
            offset: offset.rem_euclid(pitch),
            map: (most * f64::from(self.setup.views) / pitch > LEAST).then_some(left),
        }
    }
}

/// A place of the map, from (-1, -1) at the left top to (1, 1).
fn place(index: usize) -> DVec2 {
    let along = |i: usize, count: usize| 2.0 * i as f64 / (count - 1) as f64 - 1.0;
    DVec2::new(
        along(index % COLUMNS, COLUMNS),
        along(index / COLUMNS, ROWS),
    )
}

/// A mask, in subpixels.
#[derive(Clone, Debug)]
pub struct Mask {
    /// Distance of the viewers, panel pixels.
    pub viewer: f64,
    /// From lens to lens along a row.
    pub pitch: f64,
    /// Added per row.
    pub slant: f64,
    /// 0 to the pitch.
    pub offset: f64,
    /// Added to the phase at 17x9 places over the screen, rows from the top: what the plane of the numbers above leaves. None where that is less than a
    /// tenth of a view.
    pub map: Option<Vec<f64>>,
}

impl Mask {
    /// Phase at a point of the panel without the map, turns.
    pub(super) fn plane(&self, p: DVec2) -> f64 {
        (3.0 * p.x - 0.5 + self.slant * (p.y - 0.5) + self.offset) / self.pitch
    }
}
