//! The place of a program's scene in the display.
//!
//! A program has an eye space in units of its own, and its field of view is mostly wider than the 11° of the display. So the scene is not
//! scaled equally in all directions, but so that the display's viewer sees the program's own picture: 1/distance from the viewer is linear in
//! 1/w. That is a projective map. Lines stay lines, planes stay planes, and infinity gets a finite place. From beside the
//! viewer, points have the parallax that they have from beside the program's camera.
//!
//! The picture's corners, as far back as half a radius behind the axis, touch the sphere; the scene lies between there and as far before the axis. Samples
//! that are farther or nearer than all but one in 200 do not count. Parts outside of the sphere are cut off there.

use super::RotatingScreen;
use crate::synthesis::Pinhole;

/// Extent of the box before and behind the axis, in radii.
const DEPTH: f64 = 0.5;

/// One sample in this many is left out at the far and at the near end.
const OUTLIERS: usize = 200;

/// Least range of 1/w in the box, as a part of that in its middle, so that a flat scene stays flat.
const LEAST: f64 = 0.1;

/// Distance of the farthest eye to the side of the viewer, inches, as in the paper.
const SIDE: f64 = 4.0;

/// From the samples of a camera to display space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Box {
    /// The viewer as a camera that sees the program's picture; its 1/w are in inches.
    pub(super) camera: Pinhole,
    /// Slope and offset of 1/distance (in 1/inches) over 1/w.
    line: [f64; 2],
    /// Pixels per inch in the plane of the axis.
    scale: f64,
}

impl Box {
    /// For a picture so many pixels high, with a viewport as GL has it, and the 1/w of its samples from the far to the near ones. `middle`: the 1/w that
    /// is in the plane of the axis, if that is given. None where nothing has a depth.
    pub(super) fn of(
        screen: &RotatingScreen,
        height: u32,
        [left, low, wide, high]: [i32; 4],
        depths: &[f64],
        middle: Option<f64>,
    ) -> Option<Box> {
        let (viewer, deep) = (screen.viewer, DEPTH * screen.radius);
        let outliers = depths.len() / OUTLIERS;
        let (far, near) = (
            *depths.get(outliers)?,
            *depths.get(depths.len().checked_sub(outliers + 1)?)?,
        );
        let [behind, axis, before] = [viewer + deep, viewer, viewer - deep].map(|z| 1.0 / z);
        let slope = match middle {
            Some(middle) => {
                let least = 0.5 * LEAST * middle;
                let [nearer, farther] = [near - middle, middle - far].map(|part| part.max(least));
                ((before - axis) / nearer).min((axis - behind) / farther)
            }
            None => (before - behind) / (near - far).max(0.5 * LEAST * (near + far)),
        };
        let offset = match middle {
            Some(middle) => axis - slope * middle,
            // A flat scene stands in the middle.
            None => 0.5 * (before + behind - slope * (near + far)),
        };
        let [left, low, wide, high] = [left, low, wide, high].map(f64::from);
        let corner = (screen.radius.powi(2) - deep.powi(2)).sqrt() * viewer / (viewer + deep);
        let scale = 0.5 * wide.hypot(high) / corner;
        let whole = [slope, offset, scale].iter().all(|v| v.is_finite());
        (whole && near > 0.0 && wide > 0.0 && high > 0.0).then_some(Box {
            camera: Pinhole {
                eye: [0.0, 0.0, viewer],
                focal: scale * viewer,
                centre: [left + wide / 2.0, f64::from(height) - low - high / 2.0],
            },
            line: [slope, offset],
            scale,
        })
    }

    /// 1/distance from the viewer, in 1/inches.
    pub(super) fn inverse(&self, inverse: f64) -> f64 {
        self.line[0] * inverse + self.line[1]
    }

    /// Disparity for the farthest eye, pixels per unit of 1/inches.
    pub(super) fn parallax(&self, screen: &RotatingScreen) -> f64 {
        self.scale * screen.viewer * SIDE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCREEN: RotatingScreen = RotatingScreen::POPESCU;
    const VIEWPORT: [i32; 4] = [0, 0, 640, 480];

    fn place(depths: &[f64], middle: Option<f64>) -> Box {
        Box::of(&SCREEN, 480, VIEWPORT, depths, middle).expect("a scene")
    }

    fn z(place: &Box, inverse: f64) -> f64 {
        place
            .camera
            .unproject([320.0, 240.0], place.inverse(inverse))[2]
    }

    #[test]
    fn a_scene_fills_the_box_and_its_corners_touch_the_sphere() {
        let place = place(&[0.1, 0.2, 0.5], None);
        assert!((z(&place, 0.5) - 2.5).abs() < 1e-9);
        assert!((z(&place, 0.1) + 2.5).abs() < 1e-9);
        let corner = place.camera.unproject([0.0, 0.0], place.inverse(0.1));
        let far = corner.iter().map(|v| v * v).sum::<f64>().sqrt();
        assert!((far - 5.0).abs() < 1e-9, "{corner:?}");
        assert!(corner[0] < 0.0 && corner[1] > 0.0);
    }

    #[test]
    fn zero_parallax_is_in_the_plane_of_the_axis_where_it_is_given() {
        for middle in [0.1, 0.3, 0.5] {
            let place = place(&[0.1, 0.2, 0.5], Some(middle));
            assert!(z(&place, middle).abs() < 1e-9);
            let ends = [0.1, 0.5].map(|inverse| z(&place, inverse));
            assert!(ends[0] >= -2.5 - 1e-9 && ends[1] <= 2.5 + 1e-9, "{ends:?}");
            let fits = ends.iter().any(|end| (end.abs() - 2.5).abs() < 1e-9);
            assert!(fits, "{ends:?}");
        }
    }

    #[test]
    fn outliers_do_not_count_and_what_is_flat_stays_flat() {
        let mut depths = vec![0.2; 398];
        depths.insert(0, 0.0);
        depths.push(9.0);
        let place = place(&depths, None);
        assert!(z(&place, 0.2).abs() < 0.2);
        assert!((z(&place, 0.21) - z(&place, 0.19)).abs() > 4.0);
    }

    #[test]
    fn nothing_stands_nowhere() {
        for depths in [&[][..], &[0.0]] {
            assert_eq!(Box::of(&SCREEN, 480, VIEWPORT, depths, None), None);
        }
        assert_eq!(Box::of(&SCREEN, 480, [0; 4], &[0.5], None), None);
    }
}
