//! A splat met by the ray of a pixel, in two ways (Hübner et al., section 4.2) and in a third that is shorter.
#![forbid(unsafe_code)]

use super::{Eyes, Splat};
use glam::{DVec2, DVec3};

/// Where a ray meets the disk of a splat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance from the middle of the splat as a share of its radius, 0 to 1.
    pub distance: f64,
    /// Depth: the z of the point.
    pub depth: f64,
}

/// Two directions in the plane of a splat, at right angles to each other and of length 1 (Equation 3).
///
/// The paper takes `u = ‖(0, −n_z, n_y)‖`, which has no direction for a normal along x. There, u is made of x and z.
#[must_use]
pub fn axes(normal: DVec3) -> [DVec3; 2] {
    let across = if normal.y.hypot(normal.z) >= 0.5 {
        DVec3::new(0.0, -normal.z, normal.y)
    } else {
        DVec3::new(-normal.z, 0.0, normal.x)
    };
    let u = across.normalize();
    [u, normal.cross(u)]
}

/// The point in which the ray from a camera through a place of the screen meets the plane of a splat (Equation 4). None where the ray runs along the
/// plane, or meets it nearer than the near plane.
#[must_use]
pub fn on_plane(splat: &Splat, eyes: &Eyes, offset: f64, place: DVec2) -> Option<DVec3> {
    let eye = DVec3::new(offset, 0.0, 0.0);
    let ray = place.extend(eyes.focal) - eye;
    let along = splat.normal.dot(splat.centre - eye) / splat.normal.dot(ray);
    let point = eye + along * ray;
    (point.is_finite() && along > 0.0 && point.z >= eyes.near).then_some(point)
}

/// Where the ray meets the disk, pixel by pixel (the paper's second way).
#[must_use]
pub fn hit(splat: &Splat, eyes: &Eyes, offset: f64, place: DVec2) -> Option<Hit> {
    let point = on_plane(splat, eyes, offset, place)?;
    let distance = (point - splat.centre).length() / splat.radius;
    (distance <= 1.0).then_some(Hit {
        distance,
        depth: point.z,
    })
}

/// The parameters (r, s) of a place of the screen in the plane of a splat (Equation 5), as the paper interpolates them from the corners of a quad: times the
/// number that the division for perspective undoes.
///
/// With x̂ of Equation 4, r·D and s·D are affine in the place of the screen, where `D = n·(x − vp)`. They are affine in the offset of the camera as well:
/// the terms in its square cancel, and those in it times x. So for a splat they are five vectors (r, s, D), whatever the number of views: no view needs
/// parameters of its own, a fragment no division, and nothing becomes infinite where a ray runs along the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// For the middle of the screen and of the cameras.
    base: DVec3,
    /// To be added per unit of x of the screen.
    x: DVec3,
    /// Per unit of y of the screen.
    y: DVec3,
    /// Per unit of the offset of a camera.
    offset: DVec3,
    /// Per unit of y times that of the offset.
    both: DVec3,
    /// n·(p − vp) for the middle camera, and what is added per unit of the offset.
    plane: [f64; 2],
    /// Depth of the screen.
    focal: f64,
}

impl Parameters {
    /// Of a splat, (r, s) in radii.
    #[must_use]
    pub fn new(splat: &Splat, eyes: &Eyes) -> Self {
        let [u, v] = axes(splat.normal);
        let (n, p, focal) = (splat.normal, splat.centre, eyes.focal);
        // r·D = D·(vp − p)·u + n·(p − vp)·(x − vp)·u, with x = (x, y, ξ) and vp = (e, 0, 0).
        let plane = [n.dot(p), -n.x];
        let of = |axis: DVec3| {
            let start = -p.dot(axis);
            [
                n.z * focal * start + plane[0] * axis.z * focal,
                n.x * start + plane[0] * axis.x,
                n.y * start + plane[0] * axis.y,
                -n.x * start + n.z * focal * axis.x - plane[0] * axis.x + plane[1] * axis.z * focal,
                n.y * axis.x - n.x * axis.y,
            ]
        };
        let (r, s) = (of(u), of(v));
        let d = [n.z * focal, n.x, n.y, -n.x, 0.0];
        let part = |i: usize| DVec3::new(r[i] / splat.radius, s[i] / splat.radius, d[i]);
        Self {
            base: part(0),
            x: part(1),
            y: part(2),
            offset: part(3),
            both: part(4),
            plane,
            focal,
        }
    }

    /// (r·D, s·D, D) at a place of the screen, for a camera.
    #[must_use]
    pub fn at(&self, offset: f64, place: DVec2) -> DVec3 {
        self.base
            + self.x * place.x
            + (self.y + self.both * offset) * place.y
            + self.offset * offset
    }

    /// Where the ray meets the disk.
    #[must_use]
    pub fn hit(&self, eyes: &Eyes, offset: f64, place: DVec2) -> Option<Hit> {
        let at = self.at(offset, place);
        let plane = self.plane[0] + self.plane[1] * offset;
        let inside = at.x * at.x + at.y * at.y <= at.z * at.z;
        // Before the near plane: ξ·plane/D < near, without the division.
        let (ahead, side) = (self.focal * plane * at.z.signum(), at.z.abs());
        if !inside || side == 0.0 || ahead < eyes.near * side {
            return None;
        }
        Some(Hit {
            distance: at.x.hypot(at.y) / side,
            depth: ahead / side,
        })
    }
}
