//! Pitch and slant of a lens sheet of which nothing is known, from photos of many gratings; pure, without GL.
//!
//! The pattern of the finest measurement is that of a lens whose pitch is known to 1 %. Where no data sheet says it, another picture comes first: tiles,
//! each with a grating of a frequency `k`. The sheet samples what lies under it at its own frequency `f`, so in a tile one sees
//! the beats `k − m·f`, of which the coarsest is that of the nearest harmonic `m`. One `f` explains the beats of all tiles (`search.rs`). Each grating is drawn for
//! both orders of the colours; the tiles of the wrong order are the proof.
//!
//! Frequencies are turns per panel pixel, to the right and down. From a distance `Z` the sheet seems coarser by `1 / (1 − g/Z)` (see [`super`]), of which
//! the usual gap `g` is taken out.
#![forbid(unsafe_code)]

mod search;
mod spectrum;
mod tiles;

use super::levels::levels;
use super::locate::{Located, locate};
use super::written::{rounded, write};
use super::{CalibrateError, Guess, Photo, Setup, shown};
use crate::display::{Display, Kind, Number, Slanted, SubpixelOrder};
use image::RgbImage;
use spectrum::Spectrum;
use std::path::Path;

/// Three standard deviations have to be within what the finer pattern allows: a part of the pitch, and subpixels per row.
const PITCH_ERROR: f64 = 0.01;
const SLANT_ERROR: f64 = 0.02;
const SURE: f64 = 3.0;

/// The beats in one photo, ready for [`rough`].
#[derive(Clone, Debug)]
pub struct Beats {
    name: String,
    size: (u32, u32),
    /// Of the camera from the panel, panel pixels, and the standard deviation of its logarithm.
    distance: Guess,
    spectra: Vec<Spectrum>,
}

/// A lens sheet as far as a photo of gratings tells it.
#[derive(Clone, Copy, Debug)]
pub struct Rough {
    /// Subpixels from lens to lens along a row.
    pub pitch: f64,
    /// Subpixels per row.
    pub slant: f64,
    /// Standard deviation of the logarithm of the pitch.
    pub pitch_spread: f64,
    /// Standard deviation of the slant, subpixels per row.
    pub slant_spread: f64,
    /// Which colour is leftmost in a pixel.
    pub order: SubpixelOrder,
}

/// The picture of gratings for a panel of this size in pixels; row 0 on top.
pub fn rough_pattern(size: (u32, u32)) -> Result<RgbImage, CalibrateError> {
    super::setup::check_size(size)?;
    Ok(tiles::picture(size))
}

/// Says in a photo that it is of the gratings for a panel of this size.
pub(super) fn code(size: (u32, u32)) -> u16 {
    tiles::frame(size).code
}

impl Beats {
    /// Finds the picture of gratings in a photo and measures the beats. The photo has to be read by [`Photo::load_fine`].
    pub fn new(photo: &Photo, size: (u32, u32)) -> Result<Self, CalibrateError> {
        super::setup::check_size(size)?;
        let frame = tiles::frame(size);
        let located = locate(photo, &frame).map_err(|error| match error {
            CalibrateError::OtherPattern { photo, .. } => CalibrateError::NoGratings { photo },
            error => error,
        });
        let Located { view, bench, .. } = located?;
        shown::scaled(photo, &frame, view)?;
        let unclear = || CalibrateError::Edges {
            photo: photo.name.clone(),
        };
        let levels = levels(photo, &frame, view).ok_or_else(unclear)?;
        let spectra = tiles::tiles(&frame)
            .map(|tile| Spectrum::new(photo, view, levels, tile))
            .collect::<Option<_>>();
        Ok(Self {
            name: photo.name.clone(),
            size,
            distance: Guess {
                value: -view.pose.eye.z,
                spread: bench.focal_spread,
            },
            spectra: spectra.ok_or_else(unclear)?,
        })
    }
}

impl Rough {
    /// As many views as a lens has subpixels, where a display may have as many.
    #[must_use]
    pub fn views(&self) -> u32 {
        (self.pitch.round() as u32).clamp(*Setup::VIEWS.start(), *Setup::VIEWS.end())
    }

    /// Writes it as a display, whose offset is not known.
    pub fn write(&self, views: u32, name: &str, path: &Path) -> Result<(), CalibrateError> {
        let sheet = Slanted {
            pitch: rounded(self.pitch, 4),
            slant: rounded(self.slant, 4),
            offset: Number::whole(0),
            colours: [Number::whole(0); 3],
            bias: None,
            order: self.order,
            inverted: true,
        };
        write(&Display::new(name, views, Kind::Slanted(sheet)), path)
    }
}

/// The sheet that explains the beats; `cone` is the angle over which its views are seen once, in degrees.
pub fn rough(beats: &Beats, cone: Guess) -> Result<Rough, CalibrateError> {
    let photo = || beats.name.clone();
    let none = || CalibrateError::NoSheet { photo: photo() };
    let (width, height) = beats.size;
    let found = search::search(&beats.spectra, &super::setup::pitches(width)).ok_or_else(none)?;
    let (f, spread) = (found.frequency, found.spread);
    let (pitch, slant) = (3.0 / f.x, 3.0 * f.y / f.x);
    let mut setup = Setup::new(width, height, 2, pitch, slant);
    setup.cone = cone;
    let gap = setup.gap();
    let part = gap.value / beats.distance.value;
    let rough = Rough {
        pitch: pitch * (1.0 - part),
        slant,
        pitch_spread: (spread.x / f.x).hypot(part * gap.spread.hypot(beats.distance.spread)),
        slant_spread: (3.0 * spread.y).hypot(slant * spread.x) / f.x,
        order: found.order,
    };
    let sure = SURE * rough.pitch_spread < PITCH_ERROR && SURE * rough.slant_spread < SLANT_ERROR;
    sure.then_some(rough).ok_or_else(|| CalibrateError::Unsure {
        photo: photo(),
        percent: 100.0 * rough.pitch_spread,
        slant: rough.slant_spread,
    })
}
