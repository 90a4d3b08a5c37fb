//! Plausible displays that a seed determines.

use super::panel::Panel;
use super::random::Random;
use super::sheet::{Bow, Kind, Sheet, Side};
use super::vector::V3;

/// A display: what it is, and what its data sheet says.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    pub panel: Panel,
    pub sheet: Sheet,
    /// Number of views in a period.
    pub views: u32,
    /// Horizontal angle that the views fill, for a point in the middle of the panel.
    pub cone: f64,
    /// Design distance in mm from the outermost face to the eye.
    pub distance: f64,
    /// Pitch of the data sheet in mm, at right angles to the axes.
    pub nominal_pitch: f64,
    /// Slant of the data sheet; see [`Sheet::slant`] for its sign.
    pub nominal_slant: f64,
}

impl Display {
    /// The eye on the axis at the design distance.
    pub fn eye(&self) -> V3 {
        [0.0, 0.0, self.sheet.front() + self.distance]
    }

    /// Columns in a row from one axis to the next, by the data sheet. Times 3 it is the pitch in subpixels.
    pub fn nominal_columns(&self) -> f64 {
        self.nominal_pitch / self.nominal_slant.cos() / self.panel.pitch
    }

    /// Columns to the right by which an axis leads per row downwards, by the data sheet.
    pub fn nominal_lean(&self) -> f64 {
        self.nominal_slant.tan()
    }
}

/// Thickness of glass in mm with which one period fills the cone, when the air gap is given.
///
/// At half of the cone the ray must move by half of the horizontal period: `thickness * tan(inside) + gap * tan(cone / 2)` with
/// `sin(cone / 2) = index * sin(inside)`.
pub fn thickness_for(cone: f64, columns_mm: f64, index: f64, gap: f64) -> f64 {
    let sine = (cone / 2.0).sin() / index;
    let inside = sine / (1.0 - sine * sine).sqrt();
    (columns_mm / 2.0 - gap * (cone / 2.0).tan()) / inside
}

/// Deviation of a spot that sends the share `crosstalk` of its light beyond a subpixel of this width.
///
/// The tails beyond `z` deviations hold the share `2 (1 - Φ(z))`; `z` is found by halving. 5 % is 1.96 deviations, 25 % is 1.15.
pub fn spot_for(crosstalk: f64, width: f64) -> f64 {
    // The integral of the density from 0 to z by Simpson's rule.
    let inside = |z: f64| {
        let density = |x: f64| (-x * x / 2.0).exp() / std::f64::consts::TAU.sqrt();
        let term = |i: u32| {
            density(z * f64::from(i) / 64.0)
                * if i.is_multiple_of(64) {
                    1.0
                } else {
                    f64::from(2 + 2 * (i % 2))
                }
        };
        2.0 * (0..=64).map(term).sum::<f64>() * z / 192.0
    };
    let (mut low, mut high) = (0.01, 6.0);
    for _ in 0..50 {
        let middle = (low + high) / 2.0;
        if 1.0 - inside(middle) > crosstalk {
            low = middle
        } else {
            high = middle
        }
    }
    width / 2.0 / low
}

/// A display as sold, with lenses before the pixels. Equal seeds give equal displays.
///
/// 5 to 60 views, a cone of 22 to 50 degrees, UHD of 24 to 32 inches or FHD of 13 to 27, a pitch that is off by up to 0.7 % and a
/// slant that is off by up to 0.002 columns per row.
pub fn display(seed: u64) -> Display {
    let mut random = Random::part(seed, 1);
    let panel = if random.chance(0.6) {
        Panel::new(3840, 2160, random.pick(&[24.0, 27.0, 28.0, 31.5, 32.0]))
    } else {
        Panel::new(1920, 1080, random.pick(&[13.3, 15.6, 21.5, 24.0, 27.0]))
    };
    let views = random.whole(5, 60);
    let cone = random.range(22.0, 50.0).to_radians();
    let lean = random.pick(&[
        1.0 / 3.0,
        -1.0 / 3.0,
        1.0 / 6.0,
        -1.0 / 6.0,
        0.66,
        -0.66,
        0.22,
        -0.22,
    ]);
    let subpixels =
        (f64::from(views) * random.range(0.35, 1.1)).clamp(4.7, random.range(14.0, 26.0));
    make(panel, views, cone, lean, subpixels, &mut random)
}

/// A small panel of 640 by 400 pixels with 8 views, for quick tests. Its pitch and slant are those of the data sheet.
pub fn small() -> Display {
    let panel = Panel {
        pitch: 0.25,
        ..Panel::new(640, 400, 10.0)
    };
    let mut display = make(
        panel,
        8,
        24f64.to_radians(),
        1.0 / 3.0,
        8.0,
        &mut Random::new(1),
    );
    display.sheet.pitch = display.nominal_pitch;
    display.sheet.slant = display.nominal_slant;
    display.sheet.gap = 0.0;
    display.sheet.index = 1.5;
    display.sheet.thickness =
        thickness_for(display.cone, display.nominal_columns() * 0.25, 1.5, 0.0);
    display.distance = 500.0;
    display
}

fn make(
    panel: Panel,
    views: u32,
    cone: f64,
    lean: f64,
    subpixels: f64,
    random: &mut Random,
) -> Display {
    let nominal_slant = lean.atan();
    let columns_mm = subpixels / 3.0 * panel.pitch;
    let nominal_pitch = columns_mm * nominal_slant.cos();
    let index = if random.chance(0.5) {
        1.5
    } else {
        random.range(1.45, 1.6)
    };
    let gap = if random.chance(0.5) {
        0.0
    } else {
        random.range(0.03, 0.25) * columns_mm / 2.0 / (cone / 2.0).tan()
    };
    let sheet = Sheet {
        kind: Kind::Lenses,
        side: Side::Before,
        pitch: nominal_pitch * (1.0 + random.range(-0.007, 0.007)),
        slant: (lean + random.range(-0.002, 0.002)).atan(),
        turn: 0.0,
        offset: random.unit(),
        index,
        thickness: thickness_for(cone, columns_mm, index, gap),
        gap,
        bow: Bow {
            half: panel.half(),
            ..Bow::FLAT
        },
        spot: spot_for(random.range(0.05, 0.25), panel.pitch / 3.0),
    };
    Display {
        panel,
        sheet,
        views,
        cone,
        distance: random.range(400.0, 1200.0),
        nominal_pitch,
        nominal_slant,
    }
}

#[cfg(test)]
mod tests {
    use super::super::vector::unit;
    use super::*;

    #[test]
    fn seeds_determine_plausible_displays() {
        for seed in 0..60 {
            let one = display(seed);
            assert_eq!(one, display(seed));
            assert!((one.sheet.pitch / one.nominal_pitch - 1.0).abs() <= 0.007);
            assert!(
                (0.3..12.0).contains(&one.sheet.thickness),
                "{} mm",
                one.sheet.thickness
            );
            assert!((4.6..26.1).contains(&(one.nominal_columns() * 3.0)));
        }
        assert_ne!(display(1), display(2));
    }

    /// A ray at half of the cone, within the horizontal plane, moves by half of the horizontal period.
    #[test]
    fn one_period_fills_the_cone() {
        for seed in 0..20 {
            let display = display(seed);
            let (sin, cos) = (display.cone / 2.0).sin_cos();
            let (spot, _) = display
                .sheet
                .pass(unit([sin, 0.0, -cos]), [0.0, 0.0])
                .expect("no total reflection");
            assert!((spot[0] - display.nominal_columns() * display.panel.pitch / 2.0).abs() < 1e-9);
        }
    }

    /// 1.96 deviations enclose 95 %.
    #[test]
    fn spots_of_a_crosstalk() {
        assert!((spot_for(0.05, 1.0) - 0.5 / 1.959_964).abs() < 1e-4);
        assert!((spot_for(0.25, 1.0) - 0.5 / 1.150_349).abs() < 1e-4);
    }
}
