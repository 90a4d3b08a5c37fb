//! What an eye sees of the panel, and which view of a perfect mask each subpixel belongs to.

use super::displays::Display;
use super::light::{Light, Spread};
use super::sheet::{Kind, Side};
use super::vector::V3;
use image::{Rgb, RgbImage};

/// The light that reaches an eye in a direction from the panel's surface at `at` (panel space, mm).
///
/// `direction` is a unit vector away from the eye. `footprint` in mm is the width of the panel that the ray stands for.
pub fn see(
    display: &Display,
    light: &Light,
    direction: V3,
    at: [f64; 2],
    footprint: f64,
) -> [f32; 3] {
    let (panel, sheet) = (&display.panel, &display.sheet);
    let (sin, cos) = sheet.angle().sin_cos();
    let height = (footprint / panel.pitch) as f32;
    let dark = [0.0; 3];
    match sheet.side {
        Side::Before => {
            let Some(chief) = sheet.chief(direction, at) else {
                return dark;
            };
            let columns = |mm: f64| (mm / (panel.pitch * cos)) as f32;
            let (spread, open) = match sheet.kind {
                Kind::Lenses => (Spread::Bell(columns(sheet.spot)), 1.0),
                Kind::Slits { open } => {
                    // The share of the footprint that lies in the slit, both measured across the axis.
                    let half = footprint * cos / sheet.pitch / 2.0;
                    let covered = (chief.across + half).min(open / 2.0)
                        - (chief.across - half).max(-open / 2.0);
                    (
                        Spread::Even(columns(open * sheet.pitch)),
                        (covered / (2.0 * half)).clamp(0.0, 1.0),
                    )
                }
            };
            if open == 0.0 {
                return dark;
            }
            light
                .spot(panel.pixel(chief.spot), height, (sin / cos) as f32, spread)
                .map(|v| v * open as f32)
        }
        Side::Behind => {
            let Some((line, _)) = sheet.pass(direction, at) else {
                return dark;
            };
            let per_pixel = panel.pitch / sheet.pitch;
            let slope = [(per_pixel * cos) as f32, (-per_pixel * sin) as f32];
            let (spread, strength) = match sheet.kind {
                Kind::Lenses => (Spread::Bell((sheet.spot / sheet.pitch) as f32), 1.0),
                Kind::Slits { open } => (Spread::Even(open as f32), open as f32),
            };
            light.lit(
                panel.pixel(at),
                height,
                sheet.periods([line[0], line[1]]),
                slope,
                spread,
                strength,
            )
        }
    }
}

/// Which view each subpixel of a display belongs to for one eye, by ray tracing.
///
/// The views fill one period. View numbers are continuous from 0 to `display.views` and grow with viewing positions from left to
/// right. The eye sees the middle of the views, `views / 2`, over the whole panel. View `k` of a mask of whole views is what lies from
/// `k` to `k + 1`.
#[derive(Clone, Copy, Debug)]
pub struct Truth<'a> {
    pub display: &'a Display,
    /// Panel space in mm.
    pub eye: V3,
}

impl<'a> Truth<'a> {
    /// For an eye on the axis at the display's design distance.
    pub fn new(display: &'a Display) -> Self {
        Self {
            display,
            eye: display.eye(),
        }
    }

    /// Fraction of a period, from 0 to 1, at which a subpixel's centre lies. At 0 the eye sees it in the middle of its lens or line.
    pub fn phase(&self, column: usize, row: usize, colour: usize) -> f64 {
        let at = self.display.panel.subpixel(column, row, colour);
        self.display
            .sheet
            .phase(self.eye, at)
            .map_or(f64::NAN, |phase| phase - phase.floor())
    }

    /// View of a subpixel, from 0 to the number of views.
    pub fn view_of(&self, column: usize, row: usize, colour: usize) -> f64 {
        let phase = self.phase(column, row, colour);
        // An eye that moves to the right sees more to the left through a lens, and sees pixels more to the right lit by a line.
        let position = match self.display.sheet.side {
            Side::Before => 0.5 - phase,
            Side::Behind => 0.5 + phase,
        };
        (position - position.floor()) * f64::from(self.display.views)
    }

    /// Horizontal position in mm, in the plane and at the height of the eye, from which the subpixel is seen in the middle of the lens
    /// or line that is nearest for the eye.
    pub fn seen_from(&self, column: usize, row: usize, colour: usize) -> Option<f64> {
        let at = self.display.panel.subpixel(column, row, colour);
        let [start, y, z] = self.eye;
        let phase = |x: f64| self.display.sheet.phase([x, y, z], at);
        let goal = phase(start)?.round();
        let (mut old, mut x) = (start, start + 1.0);
        let mut old_miss = phase(old)? - goal;
        for _ in 0..30 {
            let miss = phase(x)? - goal;
            if miss.abs() < 1e-10 || miss == old_miss {
                break;
            }
            let next = x - miss * (x - old) / (miss - old_miss);
            (old, old_miss, x) = (x, miss, next);
        }
        Some(x)
    }

    /// A picture whose subpixels have the code value that `code` gives for their view.
    pub fn picture(&self, code: impl Fn(f64) -> u8) -> RgbImage {
        RgbImage::from_fn(
            self.display.panel.columns as u32,
            self.display.panel.rows as u32,
            |x, y| {
                Rgb(std::array::from_fn(|colour| {
                    code(self.view_of(x as usize, y as usize, colour))
                }))
            },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::displays;
    use super::super::vector::{sub, unit};
    use super::*;

    /// Light that an eye sees over the panel on a grid of 9 by 9 places, each the mean over a few periods.
    fn looks(display: &Display, shown: &RgbImage, eye: V3) -> Vec<f32> {
        let light = Light::new(&display.panel, shown);
        let half = display.panel.half();
        let place = |i: usize, half: f64| (i as f64 / 4.0 - 1.0) * half * 0.93;
        let mean = |x: f64, y: f64| {
            let places = (0..400).map(|i| {
                let at = [
                    x + (i % 20) as f64 * display.sheet.pitch / 7.3,
                    y + (i / 20) as f64 * display.panel.pitch * 0.37,
                ];
                let direction = unit(sub([at[0], at[1], display.sheet.front()], eye));
                see(display, &light, direction, at, 3.0 * display.panel.pitch)
                    .iter()
                    .sum::<f32>()
                    / 3.0
            });
            places.sum::<f32>() / 400.0
        };
        (0..81)
            .map(|i| mean(place(i % 9, half[0]), place(i / 9, half[1])))
            .collect()
    }

    /// Three of eight views are white. Their eye sees white all over, and black from half a cone away; with lenses it sees about
    /// the full white.
    #[test]
    fn the_views_of_an_eye_look_white_from_there_only() {
        for side in [Side::Before, Side::Behind] {
            for kind in [Kind::Lenses, Kind::Slits { open: 0.15 }] {
                let mut display = displays::small();
                (display.sheet.side, display.sheet.kind) = (side, kind);
                display.panel.layout = super::super::panel::Layout::bgr();
                display.sheet.gap = 0.2;
                display.sheet.turn = 0.01;
                display.sheet.bow = super::super::sheet::Bow {
                    dome: 0.1,
                    twist: 0.05,
                    half: display.panel.half(),
                };
                let eye = [40.0, -20.0, display.distance];
                let truth = Truth {
                    display: &display,
                    eye,
                };
                let shown = truth.picture(|view| if (view - 4.0).abs() < 1.5 { 255 } else { 0 });
                let full = if kind == Kind::Lenses { 1.0 } else { 0.15 };
                let white = looks(&display, &shown, eye);
                let aside = display.distance * (display.cone / 2.0).tan();
                let black = looks(&display, &shown, [eye[0] + aside, eye[1], eye[2]]);
                let least = white.iter().copied().fold(f32::MAX, f32::min) / full;
                let most = black.iter().copied().fold(0.0, f32::max) / full;
                assert!(
                    least > 0.75 && most < 0.1,
                    "{side:?} {kind:?}: {least} {most}"
                );
            }
        }
    }

    /// A view number is a viewing position: a narrow cone is linear, so both definitions agree and grow to the right.
    #[test]
    fn views_are_viewing_positions() {
        for side in [Side::Before, Side::Behind] {
            let mut display = displays::small();
            display.sheet.side = side;
            let truth = Truth::new(&display);
            let zone = 2.0 * display.distance * (display.cone / 2.0).tan();
            for (column, row, colour) in
                [(300, 200, 0), (310, 205, 1), (333, 180, 2), (350, 240, 1)]
            {
                let view = truth.view_of(column, row, colour) / f64::from(display.views) - 0.5;
                let seen = truth
                    .seen_from(column, row, colour)
                    .expect("no total reflection")
                    / zone;
                assert!((view - seen).abs() < 0.02, "{side:?}: {view} {seen}");
            }
        }
    }
}
