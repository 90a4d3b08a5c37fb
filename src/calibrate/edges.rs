//! The edges of the frame at subpixel accuracy.
#![forbid(unsafe_code)]

use super::Photo;
use super::frame::{FRAME, Frame};
use glam::DVec2;

/// Places along each line.
pub(super) const ALONG: usize = 40;
/// Samples over an edge.
const ACROSS: usize = 23;
/// Half of the length over which an edge is looked for, in bands; the frame is one band thick.
const REACH: f64 = 0.42;
/// Samples over which a place is averaged along its line.
const MEAN: usize = 16;

/// A point of an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgePoint {
    /// In the picture, pixels.
    pub pixel: DVec2,
    /// Side of the panel, in the order of the clock from the top.
    pub side: usize,
    /// 0 for the outer edge of the frame, 1 for the inner one.
    pub line: usize,
    /// Place along the line, counted.
    pub place: usize,
}

impl EdgePoint {
    /// How far a point of the panel is inside of this edge, panel pixels.
    pub(super) fn miss(&self, frame: &Frame, p: DVec2) -> f64 {
        let depth = match self.side {
            0 => p.y,
            1 => frame.size.x - p.x,
            2 => frame.size.y - p.y,
            _ => p.x,
        };
        depth - (FRAME + self.line as f64) * frame.band
    }
}

/// Edge points near where `project` (panel to picture) expects them.
pub(super) fn edges(
    photo: &Photo,
    frame: &Frame,
    project: impl Fn(DVec2) -> Option<DVec2>,
) -> Vec<EdgePoint> {
    let mut found = Vec::new();
    for (side, line) in (0..4).flat_map(|side| [(side, 0), (side, 1)]) {
        for place in 0..ALONG {
            let point = edge(photo, frame, &project, side, line, place);
            found.extend(point.map(|pixel| EdgePoint {
                pixel,
                side,
                line,
                place,
            }));
        }
    }
    found
}

/// How many points there would be at best.
pub(super) const POINTS: usize = 8 * ALONG;

/// The step is where the area under the profile puts it: symmetric blur does not move it.
fn edge(
    photo: &Photo,
    frame: &Frame,
    project: &impl Fn(DVec2) -> Option<DVec2>,
    side: usize,
    line: usize,
    place: usize,
) -> Option<DVec2> {
    let width = 0.86 / ALONG as f64;
    let start = 0.07 + width * place as f64;
    let mut profile = [0.0; ACROSS];
    for (i, value) in profile.iter_mut().enumerate() {
        let depth = FRAME + line as f64 + REACH * (2.0 * i as f64 / (ACROSS - 1) as f64 - 1.0);
        for j in 0..MEAN {
            let part = start + width * (j as f64 + 0.5) / MEAN as f64;
            *value += photo.grey(project(frame.along(side, part, depth))?)? / MEAN as f64;
        }
    }
    let end = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (outer, inner) = (end(&profile[..5]), end(&profile[ACROSS - 5..]));
    let (dark, bright) = if line == 0 {
        (outer, inner)
    } else {
        (inner, outer)
    };
    if dark > 0.75 * bright || bright < 0.01 {
        return None;
    }
    let step = 2.0 * REACH / (ACROSS - 1) as f64;
    let area: f64 = profile.iter().map(|v| (v - inner) / (outer - inner)).sum();
    // Ends count half: the trapezoid rule.
    let depth = -REACH
        + step
            * (area
                - 0.5 * (profile[0] - inner) / (outer - inner)
                - 0.5 * (profile[ACROSS - 1] - inner) / (outer - inner));
    (depth.abs() < 0.8 * REACH)
        .then(|| project(frame.along(side, start + width / 2.0, FRAME + line as f64 + depth)))
        .flatten()
}
