//! One photo, measured on its own: the camera roughly, the edges, the fringes.
#![forbid(unsafe_code)]

use super::camera::{ORDERS, Optics, Pose, Shake, View, mapped, pose};
use super::edges::{EdgePoint, POINTS, edges};
use super::fringes::{Fringes, measure};
use super::least_squares::{minimise, soft};
use super::pattern::{IN_FRAME, IN_RING, Layout};
use super::setup::Guess;
use super::{CalibrateError, Photo, Setup, find, shown};
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
/// Of an edge point, before its scatter is known, panel pixels.
const EDGE: f64 = 0.4;
/// Parameters of [`Bench::optics`] and of [`Bench::pose`].
pub(super) const OPTICS: usize = 5;
pub(super) const POSE: usize = 6;
/// And of [`Bench::shake`], which follow those of the pose.
pub(super) const SHAKE: usize = 2 * ORDERS;

/// The measurements of one photo, ready for [`super::fit`].
#[derive(Clone, Debug)]
pub struct Sighting {
    pub(super) name: String,
    pub(super) size: (u32, u32),
    pub(super) bench: Bench,
    pub(super) start: View,
    /// Of the panel, panel pixels.
    middle: DVec2,
    pub(super) edges: Vec<EdgePoint>,
    pub(super) fringes: Fringes,
}

/// The camera before it is measured: where its parameters are zero, and how far they may be off.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bench {
    optics: Optics,
    /// Standard deviation of the logarithm of the focal length.
    pub(super) focal_spread: f64,
}

impl Bench {
    fn new(photo: &Photo) -> Self {
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

/// Steps in which the parameters of optics and pose are of the order of one.
pub(super) const OPTICS_STEPS: [f64; OPTICS] = [0.05, 0.02, 0.01, 0.01, 0.01];
pub(super) const POSE_STEPS: [f64; POSE] = [0.02; POSE];

impl Sighting {
    /// Finds and measures the pattern of a setup in a photo.
    pub fn new(photo: &Photo, setup: &Setup) -> Result<Self, CalibrateError> {
        setup.check()?;
        let layout = Layout::new(setup);
        let unclear = || CalibrateError::Edges {
            photo: photo.name.clone(),
        };
        let map = find::find(photo, &layout)?;
        let bench = Bench::new(photo);
        let mut view = View {
            optics: bench.optics,
            pose: pose(map, bench.optics).ok_or_else(unclear)?,
            shake: Shake::default(),
        };
        let mut points = edges(photo, &layout, |p| Some(mapped(map, p)));
        for _ in 0..3 {
            check(&points).ok_or_else(unclear)?;
            view = camera(&layout, &bench, view, &points).ok_or_else(unclear)?;
            points = edges(photo, &layout, |p| view.to_picture(p));
        }
        check(&points).ok_or_else(unclear)?;
        view = camera(&layout, &bench, view, &points).ok_or_else(unclear)?;
        let seen = code(photo, &layout, view).ok_or_else(unclear)?;
        if seen != layout.code {
            return Err(CalibrateError::OtherPattern {
                photo: photo.name.clone(),
                seen,
                expected: layout.code,
            });
        }
        let fringes = measure(photo, &layout, view);
        if !matches!(fringes, Err(CalibrateError::TooSmall { .. })) {
            shown::check(photo, &layout, view)?;
        }
        Ok(Self {
            name: photo.name.clone(),
            size: (photo.width, photo.height),
            bench,
            start: view,
            middle: layout.size / 2.0,
            edges: points,
            fringes: fringes?,
        })
    }

    /// Where the camera was by the edges alone, from the middle of the panel: to the right, down, and before it, panel pixels.
    pub(super) fn camera_place(&self) -> DVec3 {
        let eye = self.start.pose.eye;
        DVec3::new(eye.x - self.middle.x, eye.y - self.middle.y, -eye.z)
    }

    /// Contrast of the fringes as a part of that of the panel, 0 to 1.
    #[must_use]
    pub fn contrast(&self) -> f64 {
        self.fringes.contrast
    }
}

/// Enough points on each line.
fn check(points: &[EdgePoint]) -> Option<()> {
    let least = POINTS / 8 * 6 / 10;
    let enough = |side, line| {
        let on = points.iter().filter(|p| (p.side, p.line) == (side, line));
        on.count() >= least
    };
    let all = (0..4).all(|side| enough(side, 0) && enough(side, 1));
    all.then_some(())
}

/// The camera from the edges alone.
fn camera(layout: &Layout, bench: &Bench, start: View, points: &[EdgePoint]) -> Option<View> {
    let view = |p: &[f64]| {
        let (optics, pose) = p.split_first_chunk()?;
        Some(View {
            optics: bench.optics(*optics),
            pose: Bench::pose(start.pose, *pose.first_chunk()?),
            shake: Shake::default(),
        })
    };
    let from = [&bench.parameters(start.optics)[..], &[0.0; POSE]].concat();
    let steps = [&OPTICS_STEPS[..], &POSE_STEPS[..]].concat();
    let fit = minimise(&from, &steps, |p| {
        let camera = view(p)?;
        let mut all = bench.prior(*p.first_chunk()?).to_vec();
        for point in points {
            let miss = point.miss(layout, camera.to_panel(point.pixel)?);
            all.push(soft(miss / EDGE));
        }
        Some(all)
    })?;
    view(&fit.at)
}

/// The code in the picture; None when its cells cannot be seen.
fn code(photo: &Photo, layout: &Layout, view: View) -> Option<u16> {
    let mean = |points: &mut dyn Iterator<Item = DVec2>| {
        let (mut sum, mut count) = (0.0, 0.0);
        for p in points {
            sum += photo.grey(view.to_picture(p)?)?;
            count += 1.0;
        }
        Some(sum / count)
    };
    let mut code = 0;
    for (bit, cell) in layout.bits().enumerate() {
        let cell: Vec<DVec2> = cell.collect();
        // The frame beside the cell tells white there, the dark corners of the ring tell black.
        let part = cell.iter().map(|p| p.x).sum::<f64>() / cell.len() as f64 / layout.size.x;
        let beside = (-6..=6).map(|i| 1.0 - part + 0.003 * f64::from(i));
        let white = mean(&mut beside.map(|part| layout.along(2, part, IN_FRAME)))?;
        let dark = [0.215, 0.225, 0.775, 0.785];
        let black = mean(&mut dark.iter().map(|&part| layout.along(2, part, IN_RING)))?;
        let bright = mean(&mut cell.into_iter())? > 0.5 * (white + black);
        code |= u16::from(bright) << bit;
    }
    Some(code)
}
