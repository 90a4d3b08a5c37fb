//! A point as the graphics card gets it.

use crate::read::Point;
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

/// What is drawn where the file has no colour.
const PLAIN: [u8; 3] = [208, 208, 208];
/// Its square, three times, is a float.
const FARTHEST: f32 = 1e18;
/// Of a normal of length 1 along an axis.
const ONE: f32 = 127.0;

/// A point, 24 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Vertex {
    /// From the cloud's origin, in units of the file.
    pub place: [f32; 3],
    /// Red, green and blue of sRGB, and a byte without meaning.
    pub colour: [u8; 4],
    /// Of length 127; the last number is 127 where there is a normal, else 0.
    pub normal: [i8; 4],
    /// In units of the file; 0 where it is not known, below 0 where it is guessed.
    pub radius: f32,
}

impl Vertex {
    /// Of a point. None where it is nowhere: a number is infinite or none, or so far away that the sum of squares is infinite.
    #[must_use]
    pub fn new(point: &Point, origin: DVec3) -> Option<Self> {
        let place = (point.place - origin).as_vec3();
        let is_near = place.abs().max_element() <= FARTHEST;
        if !place.is_finite() || !is_near {
            return None;
        }
        let [r, g, b] = point.colour.unwrap_or(PLAIN);
        let mut vertex = Self {
            place: place.to_array(),
            colour: [r, g, b, 0],
            normal: [0; 4],
            radius: point
                .radius
                .filter(|r| r.is_finite() && *r > 0.0)
                .unwrap_or(0.0),
        };
        if let Some(normal) = point.normal {
            vertex.set_normal(normal);
        }
        Some(vertex)
    }

    /// Its place.
    #[must_use]
    pub fn at(&self) -> Vec3 {
        Vec3::from_array(self.place)
    }

    /// Whether it has a normal.
    #[must_use]
    pub fn has_normal(&self) -> bool {
        self.normal[3] != 0
    }

    /// Gives it a normal of any length; one without direction is none.
    pub fn set_normal(&mut self, normal: Vec3) {
        if let Some(normal) = (normal / normal.abs().max_element()).try_normalize() {
            let [x, y, z] = (normal * ONE).round().to_array().map(|value| value as i8);
            self.normal = [x, y, z, ONE as i8];
        }
    }
}
