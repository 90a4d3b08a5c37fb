//! Whether the panel shows the pattern pixel for pixel: not scaled, and not moved.
#![forbid(unsafe_code)]

use super::camera::View;
use super::frame::{EDGES, Frame, IN_FRAME, IN_MARKS, IN_RING, ROWS};
use super::{CalibrateError, Photo};
use glam::DVec2;
use std::ops::Range;

/// Rows of one pixel, white and black in turn, have half of the light. Scaled, they are grey, which on a panel is much less.
const LEAST_ROWS: f64 = 0.43;
/// A mark at the panel's edge is missed if it has less than this part of the light of that on the opposite side, which has at least so much of white.
const MISSED: f64 = 0.3;
const SEEN: f64 = 0.15;

/// The names of the sides, in the order of the clock from the top.
const SIDES: [&str; 4] = ["top", "right", "bottom", "left"];

/// Refuses a photo of a pattern that was shown scaled.
pub(super) fn scaled(photo: &Photo, frame: &Frame, view: View) -> Result<(), CalibrateError> {
    let light = Light { photo, frame, view };
    // Where nothing can be read the fringes say what is wrong.
    let rows = [1, 3].map(|side| light.of(side, ROWS, IN_MARKS));
    match rows {
        [Some(right), Some(left)] if (right + left) / 2.0 < LEAST_ROWS => {
            Err(CalibrateError::Scaled {
                photo: photo.name.clone(),
            })
        }
        _ => Ok(()),
    }
}

/// Refuses a photo of a pattern that was shown beside its place.
pub(super) fn moved(photo: &Photo, frame: &Frame, view: View) -> Result<(), CalibrateError> {
    let light = Light { photo, frame, view };
    let edges = [0, 1, 2, 3].map(|side| {
        let ends = EDGES.map(|range| light.of(side, range, frame.edge / frame.band / 2.0));
        ends.into_iter().flatten().sum::<f64>() / 2.0
    });
    for (side, name) in SIDES.into_iter().enumerate() {
        let opposite = edges[(side + 2) % 4];
        if opposite > SEEN && edges[side] < MISSED * opposite {
            return Err(CalibrateError::Moved {
                photo: photo.name.clone(),
                side: name,
            });
        }
    }
    Ok(())
}

struct Light<'a> {
    photo: &'a Photo,
    frame: &'a Frame,
    view: View,
}

impl Light<'_> {
    /// Mean light along a part of a side, at a depth in bands: 0 is that of the ring, 1 that of the frame on the same side.
    fn of(&self, side: usize, range: Range<f64>, depth: f64) -> Option<f64> {
        let [seen, white, black] = [
            (range.clone(), depth),
            (0.3..0.7, IN_FRAME),
            (0.21..0.235, IN_RING),
        ]
        .map(|(range, depth)| self.mean(side, range, depth));
        let (white, black) = (white?, black?);
        (white > black).then_some(())?;
        Some((seen? - black) / (white - black))
    }

    fn mean(&self, side: usize, range: Range<f64>, depth: f64) -> Option<f64> {
        const ALONG: usize = 240;
        // The middle of what is drawn, so that blur at its ends does not count.
        let length = range.end - range.start;
        let mut sum = 0.0;
        for i in 0..ALONG {
            let part = range.start + length * (0.1 + 0.8 * (i as f64 + 0.5) / ALONG as f64);
            let at: DVec2 = self.frame.along(side, part, depth);
            sum += self.photo.grey(self.view.to_picture(at)?)?;
        }
        Some(sum / ALONG as f64)
    }
}
