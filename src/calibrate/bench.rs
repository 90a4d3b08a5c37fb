//! The camera before it is measured: where the parameters of a fit are zero, and how far they may be off.
#![forbid(unsafe_code)]

use super::Photo;
use super::camera::{ORDERS, Optics, Pose, Shake};
use super::setup::Guess;
use glam::{DQuat, DVec2, DVec3};

/// The assumed focal length where the photo has none, in parts of the longer side.
const FOCAL: Guess = Guess {
    value: 0.9,
    spread: 0.35,
};
/// How well EXIF's focal length is believed; it is rounded to 1 mm, and focusing changes it.
pub(super) const FOCAL_SPREAD: f64 = 0.03;
/// Standard deviations of the unknowns of a camera: k1, k2, and the optical axis in halves of the diagonal.
const DISTORTION_SPREAD: [f64; 2] = [0.05, 0.01];
const CENTRE_SPREAD: f64 = 0.01;
/// Of the slowest movement of the hand during a photo, in thousandths of half of the diagonal: a pixel of a photo of 12 Mpx is 0.4.
const SHAKE_SPREAD: f64 = 0.5;
/// Of the optical axis of a photo from that of the others, in the same unit: where a stabiliser held the lens, a seventh of a degree from its middle.
const AXIS_SPREAD: f64 = 3.0;
/// Parameters of [`Bench::optics`] and of [`Bench::pose`].
pub(super) const OPTICS: usize = 5;
pub(super) const POSE: usize = 6;
/// And of [`Bench::shake`], which follow those of the pose.
pub(super) const SHAKE: usize = 2 * ORDERS;

/// Steps in which the parameters of optics and pose are of the order of one.
pub(super) const OPTICS_STEPS: [f64; OPTICS] = [0.05, 0.02, 0.01, 0.01, 0.01];
pub(super) const POSE_STEPS: [f64; POSE] = [0.02; POSE];

/// The camera before it is measured: where its parameters are zero, and how far they may be off.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bench {
    pub(super) optics: Optics,
    /// Standard deviation of the logarithm of the focal length.
    pub(super) focal_spread: f64,
}

impl Bench {
    pub(super) fn new(photo: &Photo) -> Self {
        let longer = f64::from(photo.width.max(photo.height));
        let (focal, focal_spread) = match photo.focal {
            Some(focal) => (focal, FOCAL_SPREAD),
            None => (FOCAL.value * longer, FOCAL.spread),
        };
        Self {
            optics: Optics {
                focal,
                k1: 0.0,
                k2: 0.0,
                centre: photo.centre(),
                half: photo.half(),
            },
            focal_spread,
        }
    }

    /// The optics that parameters mean: logarithm of the focal length, k1, k2, optical axis.
    pub(super) fn optics(&self, p: [f64; OPTICS]) -> Optics {
        Optics {
            focal: self.optics.focal * p[0].exp(),
            k1: p[1],
            k2: p[2],
            centre: self.optics.centre + DVec2::new(p[3], p[4]) * self.optics.half,
            half: self.optics.half,
        }
    }

    /// The parameters of optics.
    pub(super) fn parameters(&self, optics: Optics) -> [f64; OPTICS] {
        let shift = (optics.centre - self.optics.centre) / self.optics.half;
        let zoom = (optics.focal / self.optics.focal).ln();
        [zoom, optics.k1, optics.k2, shift.x, shift.y]
    }

    /// How unlikely parameters are, in standard deviations.
    pub(super) fn prior(&self, p: [f64; OPTICS]) -> [f64; OPTICS] {
        let [k1, k2] = DISTORTION_SPREAD;
        let spreads = [self.focal_spread, k1, k2, CENTRE_SPREAD, CENTRE_SPREAD];
        [0, 1, 2, 3, 4].map(|i| p[i] / spreads[i])
    }

    /// The movement during a photo that parameters mean, in thousandths of half of the diagonal.
    pub(super) fn shake(&self, p: [f64; SHAKE]) -> Shake {
        let unit = self.optics.half / 1000.0;
        let mut shake = Shake::default();
        let pairs = p.as_chunks::<2>().0;
        for (moved, [x, y]) in shake.by_order.iter_mut().zip(pairs) {
            *moved = DVec2::new(*x, *y) * unit;
        }
        shake
    }

    /// How unlikely such a movement is, in standard deviations: fast movements are smaller than slow ones.
    pub(super) fn steady(p: [f64; SHAKE]) -> [f64; SHAKE] {
        let mut all = p;
        for (order, pair) in (0..).zip(all.as_chunks_mut::<2>().0) {
            let spread = match order {
                0 => AXIS_SPREAD,
                _ => SHAKE_SPREAD / f64::from(order),
            };
            pair.iter_mut().for_each(|moved| *moved /= spread);
        }
        all
    }

    /// The pose that six parameters mean near another: a turn in radians, then a way in distances.
    pub(super) fn pose(start: Pose, p: [f64; POSE]) -> Pose {
        let turn = DQuat::from_scaled_axis(DVec3::new(p[0], p[1], p[2]));
        Pose {
            rotation: turn * start.rotation,
            eye: start.eye + DVec3::new(p[3], p[4], p[5]) * start.eye.z.abs(),
        }
    }
}
