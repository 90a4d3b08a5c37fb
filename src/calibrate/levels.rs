//! White and black of each colour in a photo, by the frame and the ring: white balance, ambient light and exposure are out.
#![forbid(unsafe_code)]

use super::Photo;
use super::camera::View;
use super::frame::{Frame, IN_FRAME, IN_RING};

/// Of R, G and B, in the photo's light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Levels {
    pub white: [f32; 3],
    pub black: [f32; 3],
}

impl Levels {
    /// The light of a photo with black at 0 and white at 1.
    pub(super) fn of(&self, rgb: [f32; 3]) -> [f32; 3] {
        [0, 1, 2].map(|c: usize| (rgb[c] - self.black[c]) / (self.white[c] - self.black[c]))
    }
}

/// None where frame and ring do not differ clearly.
pub(super) fn levels(photo: &Photo, frame: &Frame, view: View) -> Option<Levels> {
    let mean = |depth: f64, parts: &[f64]| {
        let mut sum = [0.0f32; 3];
        let mut count = 0.0;
        for (side, &part) in (0..4).flat_map(|side| parts.iter().map(move |part| (side, part))) {
            let rgb = photo.at(view.to_picture(frame.along(side, part, depth))?)?;
            sum.iter_mut().zip(rgb).for_each(|(sum, v)| *sum += v);
            count += 1.0;
        }
        Some(sum.map(|sum| sum / count))
    };
    let parts = |from: f64, to: f64| (0..60).map(move |i| from + (to - from) * f64::from(i) / 59.0);
    let inner: Vec<f64> = parts(0.08, 0.92).collect();
    let ring: Vec<f64> = parts(0.21, 0.235).chain(parts(0.765, 0.79)).collect();
    let mut white = [0.0f32; 3];
    for depth in [-0.2, -0.1, 0.0, 0.1, 0.2] {
        let one = mean(IN_FRAME + depth, &inner)?;
        white.iter_mut().zip(one).for_each(|(w, v)| *w += v / 5.0);
    }
    let black = mean(IN_RING, &ring)?;
    let clear = white.iter().zip(black).all(|(w, b)| *w >= 1.15 * b + 0.003);
    clear.then_some(Levels { white, black })
}
