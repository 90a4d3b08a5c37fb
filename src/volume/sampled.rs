//! Reference images of known cameras, as the source of slices.

use super::{Joined, ReferenceImage, Sample};
use crate::synthesis::{Pinhole, Reference};

impl ReferenceImage {
    /// The reference image of a camera in display space, with straight or distorted rays; `threshold` is the step in 1/w from which surfaces are not joined
    /// (see [`crate::synthesis::Edges::of`]). Samples at infinity are left out.
    pub fn of(image: &Reference, camera: &Pinhole, threshold: f64) -> ReferenceImage {
        let sample = |(vertex, [right, below]): (crate::synthesis::Vertex, [bool; 2])| {
            let place = camera.unproject(vertex.at, vertex.inverse);
            (vertex.inverse > 0.0).then(|| Sample {
                at: place.map(|part| part as f32),
                colour: vertex.colour.map(|v| v.round().clamp(0.0, 255.0) as u8),
                joined: Joined::of(right, below),
            })
        };
        let samples = image.joined(threshold).map(|joined| sample(joined?));
        ReferenceImage {
            size: image.size(),
            samples: samples.collect(),
        }
    }

    /// Appends another image of the same width below this one, without joining the two.
    pub fn over(mut self, other: ReferenceImage) -> ReferenceImage {
        let width = self.size[0] as usize;
        let last = self.samples.len().saturating_sub(width);
        for sample in self.samples.iter_mut().skip(last).flatten() {
            sample.joined = match sample.joined {
                Joined::Right | Joined::Both => Joined::Right,
                Joined::Neither | Joined::Below => Joined::Neither,
            };
        }
        self.samples.extend(other.samples);
        self.size[1] += other.size[1];
        self
    }
}
