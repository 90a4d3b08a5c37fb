//! Where the panel is in a photo: the camera roughly, the edges, and the code that says which picture is shown.
#![forbid(unsafe_code)]

use super::bench::{Bench, OPTICS_STEPS, POSE, POSE_STEPS};
use super::camera::{Shake, View, mapped, pose};
use super::edges::{EdgePoint, POINTS, edges};
use super::frame::{Frame, IN_FRAME, IN_RING};
use super::least_squares::{minimise, soft};
use super::{CalibrateError, Photo, find};
use glam::DVec2;

/// Of an edge point, before its scatter is known, panel pixels.
const EDGE: f64 = 0.4;

/// A panel found in a photo.
pub(super) struct Located {
    pub bench: Bench,
    /// By the edges alone.
    pub view: View,
    pub edges: Vec<EdgePoint>,
}

/// Finds the frame in a photo, and checks its code.
pub(super) fn locate(photo: &Photo, frame: &Frame) -> Result<Located, CalibrateError> {
    let unclear = || CalibrateError::Edges {
        photo: photo.name.clone(),
    };
    let map = find::find(photo, frame)?;
    let bench = Bench::new(photo);
    let mut view = View {
        optics: bench.optics,
        pose: pose(map, bench.optics).ok_or_else(unclear)?,
        shake: Shake::default(),
    };
    let mut points = edges(photo, frame, |p| Some(mapped(map, p)));
    for _ in 0..3 {
        check(&points).ok_or_else(unclear)?;
        view = camera(frame, &bench, view, &points).ok_or_else(unclear)?;
        points = edges(photo, frame, |p| view.to_picture(p));
    }
    check(&points).ok_or_else(unclear)?;
    view = camera(frame, &bench, view, &points).ok_or_else(unclear)?;
    let seen = code(photo, frame, view).ok_or_else(unclear)?;
    if seen != frame.code {
        return Err(CalibrateError::OtherPattern {
            photo: photo.name.clone(),
            seen,
            expected: frame.code,
        });
    }
    Ok(Located {
        bench,
        view,
        edges: points,
    })
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
fn camera(frame: &Frame, bench: &Bench, start: View, points: &[EdgePoint]) -> Option<View> {
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
            let miss = point.miss(frame, camera.to_panel(point.pixel)?);
            all.push(soft(miss / EDGE));
        }
        Some(all)
    })?;
    view(&fit.at)
}

/// The code in the picture; None when its cells cannot be seen.
fn code(photo: &Photo, frame: &Frame, view: View) -> Option<u16> {
    let mean = |points: &mut dyn Iterator<Item = DVec2>| {
        let (mut sum, mut count) = (0.0, 0.0);
        for p in points {
            sum += photo.grey(view.to_picture(p)?)?;
            count += 1.0;
        }
        Some(sum / count)
    };
    let mut code = 0;
    for (bit, cell) in frame.bits().enumerate() {
        let cell: Vec<DVec2> = cell.collect();
        // The frame beside the cell tells white there, the dark corners of the ring tell black.
        let part = cell.iter().map(|p| p.x).sum::<f64>() / cell.len() as f64 / frame.size.x;
        let beside = (-6..=6).map(|i| 1.0 - part + 0.003 * f64::from(i));
        let white = mean(&mut beside.map(|part| frame.along(2, part, IN_FRAME)))?;
        let dark = [0.215, 0.225, 0.775, 0.785];
        let black = mean(&mut dark.iter().map(|&part| frame.along(2, part, IN_RING)))?;
        let bright = mean(&mut cell.into_iter())? > 0.5 * (white + black);
        code |= u16::from(bright) << bit;
    }
    Some(code)
}
