//! Slices from the samples of a running program.

use super::place::Box;
use super::samples::{Head, MAGIC, NOTHING, Picture, Samples};
use super::{ReferenceImage, RotatingScreen, VolumeError};
use crate::synthesis::{Reference, Vertex};

/// A depth within this distance of the clear depth is that of a clear: one of 24 bits is read back with an error of one step.
const STEP: f32 = 1e-7;

/// Neighbours are joined if their disparities differ by no more than this for the farthest eye, pixels. Four, as in views of the bench,
/// joins separate surfaces by sheets: 2 to 14 % of the voxels of its models then had no surface near them, with one less than 1 %.
const JOIN_DISPARITY: f64 = 1.0;

/// The source of slices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The reference image, and the samples of the own view that are missing there.
    Reference,
    /// The own view alone.
    Own,
}

impl Samples {
    /// Reads the samples from a file.
    pub fn read(bytes: &[u8]) -> Result<Samples, VolumeError> {
        let no = |reason: &str| VolumeError::Shown {
            reason: reason.to_owned(),
        };
        let mut parts = bytes.splitn(3, |&byte| byte == b'\n');
        let mut line = || parts.next().and_then(|line| std::str::from_utf8(line).ok());
        let other = "the layer's library wrote another kind of file; build it and the command with `make build`";
        if line() != Some(MAGIC) {
            return Err(no(other));
        }
        let head = line().unwrap_or_default();
        if let Some(why) = head.strip_prefix(NOTHING) {
            return Err(no(why));
        }
        let head: Head = serde_json::from_str(head).map_err(|_| no(other))?;
        let planes = parts.next().unwrap_or_default();
        let pixels = head.size.map(u64::from).iter().product::<u64>();
        if pixels.checked_mul(18) != Some(planes.len() as u64) || pixels == 0 {
            return Err(no(
                "the file has not as many samples as it says; run it again",
            ));
        }
        let pixels = pixels as usize;
        let mut rest = planes;
        let mut take = |count: usize| {
            let (plane, after) = rest.split_at_checked(count).unwrap_or_default();
            rest = after;
            plane
        };
        let mut picture = || (take(3 * pixels).to_vec(), floats(take(4 * pixels)));
        let (own, reference) = (picture(), picture());
        let moved = floats(take(4 * pixels));
        Ok(Samples {
            head,
            own,
            reference,
            moved,
        })
    }

    /// 1/w at a depth; none where no draw has covered the pixel.
    fn inverse(&self, depth: f32) -> Option<f64> {
        let Head { clear, before, .. } = self.head;
        if (depth - clear).abs() < STEP {
            return None;
        }
        let depth = f64::from(depth);
        let before = before.filter(|before| match before.line[0] > 0.0 {
            true => depth >= before.to,
            false => depth <= before.to,
        });
        let [slope, offset] = before.map_or(self.head.line, |before| before.line);
        Some((slope * depth + offset).max(0.0))
    }

    /// Samples by pixel, where the undistorted camera projects them.
    fn samples<'a>(
        &'a self,
        (colours, depths): &'a Picture,
        moved: &'a [f32],
    ) -> impl Iterator<Item = Option<Vertex>> + 'a {
        let width = self.head.size[0].max(1) as usize;
        let pixels = colours.chunks_exact(3).zip(depths).enumerate();
        pixels.map(move |(at, (colour, &depth))| {
            let moved = moved.get(at).copied().map_or(0.0, f64::from);
            let [x, y] = [at % width, at / width].map(|i| i as f64 + 0.5);
            Some(Vertex {
                at: [x - moved, y],
                inverse: self.inverse(depth)?,
                colour: [0, 1, 2].map(|i| f64::from(colour[i])),
            })
        })
    }

    /// The samples in display space, in a box in the middle of the display. With `focal` the plane of zero parallax is
    /// that of the display's axis; else the scene fills the box.
    pub fn image(
        &self,
        screen: &RotatingScreen,
        source: Source,
        focal: bool,
    ) -> Result<ReferenceImage, VolumeError> {
        screen.check()?;
        let mut depths: Vec<f64> = self
            .samples(&self.own, &[])
            .flatten()
            .map(|v| v.inverse)
            .collect();
        depths.sort_by(f64::total_cmp);
        let middle = focal.then(|| 1.0 / self.head.focal);
        let place = Box::of(
            screen,
            self.head.size[1],
            self.head.viewport,
            &depths,
            middle,
        );
        let place = place.ok_or_else(|| VolumeError::Shown {
            reason: "nothing in its picture has a depth; give another frame".to_owned(),
        })?;
        let put = |picture, moved| -> Vec<Option<Vertex>> {
            let samples = self.samples(picture, moved).map(|sample| {
                let vertex: Vertex = sample?;
                let inverse = place.inverse(vertex.inverse);
                (inverse > 0.0).then_some(Vertex { inverse, ..vertex })
            });
            samples.collect()
        };
        let threshold = JOIN_DISPARITY / place.parallax(screen);
        let size = self.head.size;
        let of = |image: &Reference| ReferenceImage::of(image, &place.camera, threshold);
        let mut own = put(&self.own, &[]);
        if source == Source::Own {
            return Ok(of(&Reference::of(size, own)));
        }
        let reference = Reference::of(size, put(&self.reference, &self.moved));
        let motion = place.camera.to(&place.camera);
        let seen = reference.seen(size, &motion, threshold).inverses();
        for (own, seen) in own.iter_mut().zip(seen.into_iter().map(f64::from)) {
            let has = |own: &Vertex| seen > 0.0 && (own.inverse - seen).abs() <= threshold;
            *own = own.filter(|own| !has(own));
        }
        Ok(of(&reference).over(of(&Reference::of(size, own))))
    }
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    let four = bytes
        .chunks_exact(4)
        .filter_map(|four| four.try_into().ok());
    four.map(f32::from_le_bytes).collect()
}
