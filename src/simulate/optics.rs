//! From the description of a panel to its optics.
#![forbid(unsafe_code)]

use super::{SAME, SimulateError};
use crate::display::{Display, Kind, Number, Rotation, Slanted, SubpixelOrder};

/// In subpixels.
const PIXEL_WIDTH: f64 = 3.0;

/// In subpixels, as pixels are square.
const ROW_HEIGHT: f64 = 3.0;

/// In subpixels: what is farther from a place is another place of the picture.
const FARTHEST: f64 = 48.0;

/// Where the sheet of lenses or slits is, as the viewer sees it.
///
/// Through an axis *before* the pixels an eye to the left sees what lies to the right of the axis; past an axis *behind* them
/// (lit slits, a barrier at the back) it sees what lies to the left of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Before the pixels: within a lens, the view grows to the left.
    Front,
    /// Behind the pixels: within a lens, the view grows to the right.
    Behind,
}

/// A sheet of parallel lenses or slits and the subpixels it belongs to; lengths in subpixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Optics {
    /// Views in one period, at least 1.
    pub views: u32,
    /// From axis to axis along a row, on the pixels, at least 1.
    pub period: f64,
    /// By how much the axes move to the left per row downwards.
    pub slant: f64,
    /// Where the views of lens 0 begin, from the left edge of the panel at the top edge of the panel.
    pub start: f64,
    /// Centres of red, green and blue, from the left edge of their pixel.
    pub centres: [f64; 3],
    /// Which way the views follow each other.
    pub side: Side,
}

impl Optics {
    /// The optics that `display` describes when it shows `views` views.
    ///
    /// A sheet behind the pixels sends the views that lie on the left within a lens to the left, one before them to the right; so that
    /// view 0 is the leftmost, the sheet is put where the description's order of views wants it.
    pub fn of(display: &Display, views: u32) -> Result<Self, SimulateError> {
        let lens = lens(display, views).ok_or_else(|| SimulateError::NoOptics {
            name: display.name.clone(),
        })?;
        let (period, slant) = (lens.pitch.to_f64(), lens.slant.to_f64());
        if views == 0 || period < 1.0 {
            let name = display.name.clone();
            return Err(SimulateError::Narrow { name, period });
        }
        let offset = middle_offset(&lens, views).unwrap_or_else(|| lens.offset.to_f64());
        let places = match lens.order {
            SubpixelOrder::Rgb => [0.5, 1.5, 2.5],
            SubpixelOrder::Bgr => [2.5, 1.5, 0.5],
        };
        let mut centres = places;
        for (centre, moved) in centres.iter_mut().zip(lens.colours) {
            *centre += moved.to_f64();
        }
        Ok(Self {
            views,
            period,
            slant,
            // The description gives the phase at the centre of subpixel 0, half a subpixel and half a row from the corner.
            start: 0.5 + slant / 2.0 - offset,
            centres,
            side: if lens.inverted {
                Side::Front
            } else {
                Side::Behind
            },
        })
    }

    /// Half of the part of a period that one view takes.
    pub(super) fn half_view(&self) -> f64 {
        self.period / f64::from(self.views) / 2.0
    }

    /// Places around one place that an eye cannot tell from it: the fewest, nearest first, among which every view has every
    /// colour, or as nearly as it is to be had within [`FARTHEST`].
    pub(super) fn around(&self) -> Vec<Near> {
        let (lenses, rows) = (
            (FARTHEST / self.period) as i64,
            (FARTHEST / ROW_HEIGHT) as i64,
        );
        let mut places: Vec<_> = (-lenses..=lenses)
            .flat_map(|lens| (-rows..=rows).map(move |row| (lens, row)))
            .map(|(lens, row)| {
                let distance = (lens as f64 * self.period).hypot(row as f64 * ROW_HEIGHT);
                (distance, lens, row)
            })
            .collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        // Where the colour lies beside the line that is seen, modulo a pixel. Any line meets it where no gap is wider than a view.
        let mut phases = Vec::new();
        let mut best = (f64::INFINITY, places.len());
        for (index, &(distance, lens, row)) in places.iter().enumerate() {
            let phase = self.slant * row as f64 - self.period * lens as f64;
            let phase = phase.rem_euclid(PIXEL_WIDTH);
            phases.insert(phases.partition_point(|&other| other < phase), phase);
            let ring_ends = places
                .get(index + 1)
                .is_none_or(|next| next.0 > distance + SAME);
            let gap = widest_gap(&phases).max(2.0 * self.half_view());
            if ring_ends && gap < best.0 - SAME {
                best = (gap, index + 1);
            }
        }
        let reach = places.get(best.1).map_or(FARTHEST, |next| next.0);
        let nearest = places.iter().take(best.1);
        let near = |&(distance, lens, row): &(f64, i64, i64)| Near {
            lens,
            row,
            weight: 1.0 - distance / reach,
        };
        nearest.map(near).filter(|near| near.weight > 0.0).collect()
    }
}

/// The sheet of a display; None where it has none, or an uneven one.
fn lens(display: &Display, views: u32) -> Option<Slanted> {
    if display.rotation != Rotation::None {
        return None;
    }
    let upright = Slanted {
        slant: Number::whole(0),
        offset: Number::whole(0),
        ..Slanted::HUEBNER
    };
    match &display.kind {
        Kind::Lenticular => Some(Slanted {
            pitch: Number::whole(3 * i64::from(views)),
            ..upright
        }),
        Kind::Huebner(order) => Some(Slanted {
            pitch: Number::whole(views.into()),
            order: *order,
            ..Slanted::HUEBNER
        }),
        Kind::Slanted(lens) => lens.bias.is_none().then(|| lens.clone()),
        Kind::LookingGlass(device) if device.cells.is_empty() && !device.flip_x => {
            let (lenses, tilt) = (device.lenses(), device.tilt());
            let (width, height) = (f64::from(device.width), f64::from(device.height));
            // Subpixels from lens to lens, and what a row adds, upwards or downwards.
            let period = 3.0 * width / lenses;
            let slant = if device.flip_y { tilt } else { -tilt } * 3.0 * width / height;
            let v = if device.flip_y { 0.5 } else { height - 0.5 } / height;
            // Of R in the left top pixel; the formula takes the centre of the pixel for it.
            let phase = (0.5 / width + v * tilt) * lenses - device.center;
            Some(Slanted {
                pitch: Number::Float(period),
                slant: Number::Float(slant),
                offset: Number::Float(phase * period),
                order: if device.flip_subpixels {
                    SubpixelOrder::Bgr
                } else {
                    SubpixelOrder::Rgb
                },
                inverted: device.inverted,
                ..upright
            })
        }
        _ => None,
    }
}

/// A place beside another, and how much of its light is taken for the other's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Near {
    /// Lenses to the right.
    pub(super) lens: i64,
    /// Rows down.
    pub(super) row: i64,
    /// Above 0, at most 1.
    pub(super) weight: f64,
}

/// The widest gap between sorted places on a circle of a pixel's width.
fn widest_gap(places: &[f64]) -> f64 {
    let next = places.iter().skip(1).copied();
    let around = places.first().map(|first| first + PIXEL_WIDTH);
    let gaps = places.iter().zip(next.chain(around)).map(|(a, b)| b - a);
    gaps.fold(0.0, f64::max)
}

/// The offset in the middle of all those that give every subpixel the same view; None without exact numbers.
///
/// Phases are rounded down to views. Where the parameters are fractions, phases and boundaries between views are multiples of
/// one step apart, so the sheet may be moved by less than a step without any change, and it stands best in the middle.
fn middle_offset(lens: &Slanted, views: u32) -> Option<f64> {
    let fraction = |number| match number {
        Number::Exact {
            numerator,
            denominator,
        } => Some((i128::from(numerator), i128::from(denominator))),
        Number::Float(_) => None,
    };
    let (slant, offset) = (fraction(lens.slant)?, fraction(lens.offset)?);
    let (numerator, denominator) = fraction(lens.pitch)?;
    let view = (numerator, denominator.checked_mul(i128::from(views))?);
    let unit = slant.1.checked_mul(offset.1)?.checked_mul(view.1)?;
    let whole = |(n, d): (i128, i128)| n.checked_mul(unit.checked_div(d)?);
    let step = divisor(unit, divisor(whole(slant)?, whole(view)?));
    // Phases are rounded up to descending views.
    let middle = if lens.inverted {
        -((-whole(offset)?).div_euclid(step) as f64) - 0.5
    } else {
        whole(offset)?.div_euclid(step) as f64 + 0.5
    };
    Some(middle * step as f64 / unit as f64)
}

/// Greatest common divisor, at least 0.
fn divisor(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { divisor(b, a % b) }
}
