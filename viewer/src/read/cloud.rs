//! What every format gives.

use super::error::ReadError;
use glam::{DVec3, Vec3};

/// A point as it is in the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// In units of the file.
    pub place: DVec3,
    /// Red, green and blue of sRGB.
    pub colour: Option<[u8; 3]>,
    /// Of any length.
    pub normal: Option<Vec3>,
    /// In units of the file.
    pub radius: Option<f32>,
}

impl Point {
    /// A point without anything else.
    #[must_use]
    pub fn at(place: DVec3) -> Self {
        Self {
            place,
            colour: None,
            normal: None,
            radius: None,
        }
    }
}

/// The axis that points upwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Up {
    /// That of models.
    Y,
    /// That of scans and maps.
    Z,
    /// The opposite of Y, as in pictures from which Gaussians are made.
    #[value(name = "-y")]
    MinusY,
}

/// An opened file.
pub struct Cloud {
    /// How many points it says it has.
    pub points: Option<u64>,
    /// What its format has upwards.
    pub up: Up,
    /// Which can be read at the same time; together all points.
    pub parts: Vec<Box<dyn Part>>,
}

/// A part of the points of a file.
pub trait Part: Send {
    /// Reads it to its end, and gives its points a few thousand at a time. `give` takes them out of the vector, and returns false where no more are wanted.
    ///
    /// # Errors
    /// The file is not as it should be, from the named place on.
    fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError>;
}

/// So many points are given at a time.
pub(super) const GIVEN: usize = 1 << 14;
