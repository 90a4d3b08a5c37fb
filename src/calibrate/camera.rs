//! A camera before the panel.
//!
//! Panel space: pixels from the top left corner of the panel, x right, y down, z into the panel, so an eye before it has
//! a negative z. Camera space: x right, y down, z forward. Picture space: pixels from the top left corner.
#![forbid(unsafe_code)]

use glam::{DMat3, DQuat, DVec2, DVec3};
use nalgebra::{SMatrix, SVector};

/// The values that are the same in all photos.
#[derive(Clone, Copy, Debug)]
pub(super) struct Optics {
    /// Focal length, picture pixels.
    pub focal: f64,
    /// Radial distortion: `straight = bent·(1 + k1·bent² + k2·bent⁴)`, radii in halves of the picture's diagonal.
    pub k1: f64,
    /// See `k1`.
    pub k2: f64,
    /// Where the optical axis meets the picture, pixels.
    pub centre: DVec2,
    /// Half of the diagonal of the picture, pixels.
    pub half: f64,
}

/// Where the camera was.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    /// From panel to camera space.
    pub rotation: DQuat,
    /// Panel space.
    pub eye: DVec3,
}

/// Polynomials of [`Shake`].
pub(super) const ORDERS: usize = 5;

/// Where the picture lies on the sensor, and its movement while that is read row by row: an unsteady hand, or a lens that makes up for one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Shake {
    /// Picture pixels in x and y, of the Legendre polynomials of order 0 to 4 over the rows.
    pub by_order: [DVec2; ORDERS],
}

impl Shake {
    /// How far the picture had moved when the row was read that is this part of half of the diagonal below the middle.
    fn at(&self, part: f64) -> DVec2 {
        // The rows of a picture of 4:3 end at 0.6 of half of the diagonal.
        let t = (part / 0.6).clamp(-1.2, 1.2);
        let (mut before, mut now) = (0.0, 1.0);
        let mut sum = DVec2::ZERO;
        for (order, moved) in (0..).zip(&self.by_order) {
            sum += *moved * now;
            let n = f64::from(order);
            let next = ((2.0 * n + 1.0) * t * now - n * before) / (n + 1.0);
            (before, now) = (now, next);
        }
        sum
    }
}

/// A photo's camera.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub optics: Optics,
    pub pose: Pose,
    pub shake: Shake,
}

impl View {
    /// From the picture to the panel; None behind or beside it.
    pub(super) fn to_panel(self, pixel: DVec2) -> Option<DVec2> {
        let Optics {
            focal,
            k1,
            k2,
            centre,
            half,
        } = self.optics;
        let still = pixel - self.shake.at((pixel.y - centre.y) / half);
        let bent = (still - centre) / half;
        let square = bent.length_squared();
        let straight = bent * (1.0 + square * (k1 + k2 * square)) * half / focal;
        let ray = self.pose.rotation.inverse() * straight.extend(1.0);
        let steps = -self.pose.eye.z / ray.z;
        (steps.is_finite() && steps > 0.0).then(|| (self.pose.eye + ray * steps).truncate())
    }

    /// From the panel to the picture; None behind the camera.
    pub(super) fn to_picture(self, point: DVec2) -> Option<DVec2> {
        let Optics {
            focal,
            k1,
            k2,
            centre,
            half,
        } = self.optics;
        let seen = self.pose.rotation * (point.extend(0.0) - self.pose.eye);
        if seen.z <= 0.0 {
            return None;
        }
        let straight = seen.truncate() / seen.z * focal / half;
        // Contracts by a factor of about 2·k1·r² each time.
        let bent = (0..8).fold(straight, |bent, _| {
            let square = bent.length_squared();
            straight / (1.0 + square * (k1 + k2 * square))
        });
        let still = centre + bent * half;
        // The row where a point ends up is nearly that where it would be in a steady hand.
        Some(still + self.shake.at((still.y - centre.y) / half))
    }
}

/// The plane-to-plane map that takes four points to four others; None when three are on a line.
pub(super) fn homography(from: [DVec2; 4], to: [DVec2; 4]) -> Option<DMat3> {
    let mut rows = SMatrix::<f64, 8, 8>::zeros();
    let mut right = SVector::<f64, 8>::zeros();
    for (i, (p, q)) in from.into_iter().zip(to).enumerate() {
        let first = [p.x, p.y, 1.0, 0.0, 0.0, 0.0, -q.x * p.x, -q.x * p.y];
        let second = [0.0, 0.0, 0.0, p.x, p.y, 1.0, -q.y * p.x, -q.y * p.y];
        for (row, values, value) in [(2 * i, first, q.x), (2 * i + 1, second, q.y)] {
            rows.row_mut(row).copy_from_slice(&values);
            right[row] = value;
        }
    }
    let h = rows.lu().solve(&right)?;
    let map = DMat3::from_cols_array(&[h[0], h[3], h[6], h[1], h[4], h[7], h[2], h[5], 1.0]);
    map.is_finite().then_some(map)
}

/// Applies a homography.
pub(super) fn mapped(map: DMat3, point: DVec2) -> DVec2 {
    let p = map * point.extend(1.0);
    p.truncate() / p.z
}

/// The pose that a homography from panel to picture means, for straight optics (Zhang 2000, section 3.1).
pub(super) fn pose(map: DMat3, optics: Optics) -> Option<Pose> {
    let undo = |column: DVec3| {
        ((column.truncate() - optics.centre * column.z) / optics.focal).extend(column.z)
    };
    let (a, b, t) = (undo(map.x_axis), undo(map.y_axis), undo(map.z_axis));
    let scale = 2.0 / (a.length() + b.length());
    // The panel's corner is before the camera.
    let scale = if t.z < 0.0 { -scale } else { scale };
    let (x, y) = ((a * scale).try_normalize()?, b * scale);
    let z = x.cross(y).try_normalize()?;
    let rotation = DMat3::from_cols(x, z.cross(x), z);
    let eye = -(rotation.transpose() * (t * scale));
    (eye.is_finite() && eye.z < 0.0).then(|| Pose {
        rotation: DQuat::from_mat3(&rotation),
        eye,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> View {
        View {
            optics: Optics {
                focal: 1300.0,
                k1: 0.02,
                k2: -0.003,
                centre: DVec2::new(760.0, 495.0),
                half: 900.0,
            },
            pose: Pose {
                rotation: DQuat::from_rotation_y(0.2) * DQuat::from_rotation_x(-0.1),
                eye: DVec3::new(300.0, 400.0, -2000.0),
            },
            shake: Shake::default(),
        }
    }

    #[test]
    fn there_and_back() {
        for (x, y) in [(0.0, 0.0), (960.0, 10.0), (400.0, 540.0)] {
            let point = DVec2::new(x, y);
            let back = view()
                .to_picture(point)
                .and_then(|pixel| view().to_panel(pixel));
            assert!(
                back.is_some_and(|back| back.distance(point) < 1e-6),
                "{back:?}"
            );
        }
    }

    #[test]
    fn a_pose_from_four_corners() {
        let mut view = view();
        (view.optics.k1, view.optics.k2) = (0.0, 0.0);
        let corners = [(0.0, 0.0), (960.0, 0.0), (960.0, 540.0), (0.0, 540.0)].map(DVec2::from);
        let seen = corners.map(|corner| view.to_picture(corner).unwrap());
        let found = pose(homography(corners, seen).unwrap(), view.optics).unwrap();
        assert!(found.eye.distance(view.pose.eye) < 1e-5, "{found:?}");
        assert!(found.rotation.angle_between(view.pose.rotation) < 1e-7);
    }
}
