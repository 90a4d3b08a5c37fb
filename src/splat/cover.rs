//! The part of the screen in which a splat can be seen from any camera.
#![forbid(unsafe_code)]

use super::{Eyes, Splat};
use glam::DVec2;

/// A rectangle of the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cover {
    /// Its lower left corner.
    pub low: DVec2,
    /// Its upper right corner.
    pub high: DVec2,
}

impl Cover {
    /// Whether a place is in it.
    #[must_use]
    pub fn contains(&self, place: DVec2) -> bool {
        self.low.cmple(place).all() && place.cmple(self.high).all()
    }
}

/// The quad of the paper (Equation 6): of a disk that faces the viewer, wider by `vd·(d − ξ)/d`.
///
/// The paper calls that the worst orientation. It is not: the near part of a tilted disk is enlarged more, and a large splat near the camera leaves the
/// quad. [`cover`] is exact for every orientation. For points that are small for their depth both are nearly the same. With p nearer than
/// the screen, the offset of the paper is negative; its size is meant.
#[must_use]
pub fn facing(splat: &Splat, eyes: &Eyes) -> Option<Cover> {
    let (p, r) = (splat.centre, splat.radius);
    let scale = eyes.focal / p.z;
    let aside = eyes.eccentricity() * (p.z / eyes.focal - 1.0).abs();
    let half = DVec2::new(r + aside, r) * scale;
    let middle = p.truncate() * scale;
    (p.z > 0.0).then_some(Cover {
        low: middle - half,
        high: middle + half,
    })
}

/// The smallest rectangle that holds the disk in the views of all cameras. None where the whole disk is nearer than the near plane; endless where a
/// part is.
///
/// A line of sight with the slope t = (X − e)/Z touches the disk p + r·(u cos φ + v sin φ) where the plane with the normal m = (−1, 0, t) does:
/// `(m·p)² = r²·(|m|² − (m·n)²)`, a quadratic equation in t. A point (X, Y, Z) is seen at `ξX/Z + e·(1 − ξ/Z)`, which is linear in e, so the outermost
/// cameras bound all of them. The same in y, for which all cameras are one.
#[must_use]
pub fn cover(splat: &Splat, eyes: &Eyes) -> Option<Cover> {
    let (p, n, r) = (splat.centre, splat.normal, splat.radius);
    let tilt = r * (n.x * n.x + n.y * n.y).sqrt();
    if p.z + tilt < eyes.near {
        return None;
    }
    let endless = Cover {
        low: DVec2::NEG_INFINITY,
        high: DVec2::INFINITY,
    };
    if p.z - tilt < eyes.near {
        return Some(endless);
    }
    let end = eyes.eccentricity();
    let across = [-end, end].map(|offset| {
        let [low, high] = slopes([p.x - offset, p.z], [n.x, n.z], r);
        [low, high].map(|slope| slope * eyes.focal + offset)
    });
    let [low, high] = slopes([p.y, p.z], [n.y, n.z], r).map(|slope| slope * eyes.focal);
    Some(Cover {
        low: DVec2::new(across[0][0].min(across[1][0]), low),
        high: DVec2::new(across[0][1].max(across[1][1]), high),
    })
}

/// The least and the largest slope of lines from the eye to a disk that is before it whole: its middle and its normal along this axis and along z.
fn slopes([p, z]: [f64; 2], [n, nz]: [f64; 2], r: f64) -> [f64; 2] {
    // a·t² − 2b·t + c = 0 of (t·z − p)² = r²·(1 + t² − (t·nz − n)²). The root of b² − a·c in a form that does not subtract what is nearly the same.
    let a = z * z - r * r * (1.0 - nz * nz);
    let b = p * z + r * r * n * nz;
    let aside = z * n - p * nz;
    let root = z * z + p * p - aside * aside - r * r * (1.0 - n * n - nz * nz);
    // Less than zero by rounding, for a disk that is seen from its edge.
    let root = r * root.max(0.0).sqrt();
    [(b - root) / a, (b + root) / a]
}
