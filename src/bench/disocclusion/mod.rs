//! Samples of the true picture that are missing in views of a depth image, and of an occlusion camera's reference image.
//!
//! Popescu, Rosen and Aliaga, section VIII: "We measure the disocclusion errors present in a frame by rendering a ground truth image from
//! geometry and counting how many ground truth image samples are not present in the frame. We rendered sequences of frames by moving the
//! viewpoint on the edges of an 8'' cube centered at the reference viewpoint." Everything is drawn by the rasteriser of [`crate::synthesis`].

mod frame;
mod outcome;
mod sheet;
#[cfg(test)]
mod tests;

pub use frame::{Disparity, Frame, missing};
pub use outcome::{Outcome, Scene, View, text, write_csv};
pub use sheet::sheet;

use crate::model::{Surface, project, triangles};
use crate::synthesis::{Distortions, Edges, Pinhole, Reference, Splats, Triangle};
use std::time::{Duration, Instant};

/// The paper's share of a depth image's missing samples that stay missing, averaged over its scenes, %.
pub const PAPER: f64 = 4.5;
/// The sources of the frames. The last is the occlusion camera's reference image in twice as many columns and rows.
pub const IMAGES: [&str; 3] = ["depth image", "occlusion camera", "twice as fine"];
/// The pictures that are compared with the truth: a frame of each source, and the truth itself, sampled half a pixel aside. Two sampled pictures may
/// differ as much as this without either being wrong.
pub const FRAMES: [&str; 4] = [IMAGES[0], IMAGES[1], IMAGES[2], "truth, aside"];
/// "The decrease in resolution can be alleviated by increasing the resolution of the reference image" (section IV.C, Figure 15).
const FINER: u32 = 2;

/// Inches from the viewer to the middle of the display.
const DISTANCE: f64 = 50.0;
/// Half the side of the cube, inches.
const HALF: f64 = 4.0;
/// Viewpoints on each of its 12 edges.
const PER_EDGE: u32 = 4;
/// Pixels to an inch of a picture of 720 x 480: the display has some room around it, so that nothing leaves the picture from any viewpoint.
const SCALE: f64 = 42.0;
/// The paper's picture.
const PAPER_SIZE: [f64; 2] = [720.0, 480.0];
/// D of the paper, pixels of its picture.
const RADIUS: f64 = 30.0;
/// α, at most.
const ASYMMETRY: f64 = 4.0;
/// Factor by which splats reach farther than the edges of the cube need.
const MORE: f64 = 1.1;
/// A depth discontinuity opens a hole wider than this at the farthest viewpoint, pixels. Smaller steps are joined.
const STEP: f64 = 4.0;
/// Rays are distorted where a hole this wide opens, pixels.
const EDGE: f64 = 3.5;
/// Two samples differ if their disparities for the farthest viewpoint differ by more than this, pixels.
const TOLERANCE: f64 = 1.0;

/// The parameters of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Experiment {
    /// Columns and rows of every picture.
    pub size: [u32; 2],
}

/// The source of a frame.
#[derive(Clone, Debug)]
pub struct Images {
    /// In the order of [`IMAGES`].
    pub all: [Reference; 3],
    /// Time to draw one view of the geometry.
    pub single: Duration,
    /// Time to find the edges, make the map and draw the reference image, for each of the two. The depths of the single view exist already.
    pub construction: [Duration; 2],
}

impl Experiment {
    /// Pixels to an inch in the plane through the middle of the display.
    fn scale(&self) -> f64 {
        let [w, h] = [0, 1].map(|i| f64::from(self.size[i]) / PAPER_SIZE[i]);
        SCALE * w.min(h)
    }

    /// Disparity for the farthest viewpoint, pixels per unit of 1/w.
    fn parallax(&self) -> f64 {
        self.scale() * DISTANCE * HALF * 2_f64.sqrt()
    }

    /// 1/w of a step between two surfaces.
    #[must_use]
    pub fn step(&self) -> f64 {
        STEP / self.parallax()
    }

    /// 1/w up to which two samples are one.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        TOLERANCE / self.parallax()
    }

    /// The camera at an offset in inches from the reference viewpoint. All look through the same window in the middle of the display.
    #[must_use]
    pub fn camera(&self, [x, y, z]: [f64; 3]) -> Pinhole {
        Pinhole::through(self.size, self.scale(), [x, y, DISTANCE + z])
    }

    /// The picture of the geometry by a camera.
    #[must_use]
    pub fn draw(&self, camera: &Pinhole, scene: &[Surface]) -> Reference {
        self.draw_moved(camera, scene, 0.0)
    }

    /// The same, sampled half a pixel further to the left.
    #[must_use]
    pub fn draw_aside(&self, camera: &Pinhole, scene: &[Surface]) -> Reference {
        self.draw_moved(camera, scene, 0.5)
    }

    /// The same, moved by `by` pixels to the right in the picture.
    fn draw_moved(&self, camera: &Pinhole, scene: &[Surface], by: f64) -> Reference {
        let mut drawn = Reference::new(self.size);
        let moved = |mut triangle: Triangle| {
            triangle.iter_mut().for_each(|vertex| vertex.at[0] += by);
            triangle
        };
        let all = triangles(scene).filter_map(|solid| project(camera, &solid));
        drawn.draw(all.map(moved), &Distortions::none(self.size), f64::INFINITY);
        drawn
    }

    /// The rays of the occlusion camera, from the depth image of the reference viewpoint.
    #[must_use]
    pub fn distortions(&self, depth_image: &Reference) -> Distortions {
        let edges = Edges::of(&depth_image.depth_image(), EDGE / self.parallax());
        let splats = Splats {
            radius: RADIUS * self.scale() / SCALE,
            parallax: self.parallax() * MORE,
            asymmetry: ASYMMETRY,
        };
        Distortions::of(self.size, &edges, &splats)
    }

    /// Makes all images.
    #[must_use]
    pub fn images(&self, scene: &[Surface]) -> Images {
        let start = Instant::now();
        let depth_image = self.draw(&self.camera([0.0; 3]), scene);
        let single = start.elapsed();
        let start = Instant::now();
        let distortions = self.distortions(&depth_image);
        let map = start.elapsed();
        let made = |times: u32| {
            let start = Instant::now();
            let size = self.size.map(|side| times * side);
            let camera = Experiment { size }.camera([0.0; 3]);
            let mut reference = Reference::new(size);
            let all = triangles(scene).filter_map(|solid| project(&camera, &solid));
            reference.draw(all, &distortions, 1.0);
            (reference, map + start.elapsed())
        };
        let ((reference, construction), (finer, finer_construction)) = (made(1), made(FINER));
        Images {
            all: [depth_image, reference, finer],
            single,
            construction: [construction, finer_construction],
        }
    }

    /// The view of an image at an offset in inches from the reference viewpoint.
    #[must_use]
    pub fn seen(&self, image: &Reference, offset: [f64; 3]) -> Reference {
        let own = Experiment { size: image.size() };
        let motion = own.camera([0.0; 3]).to(&self.camera(offset));
        image.seen(self.size, &motion, self.step())
    }
}

/// The viewpoints in inches from the reference viewpoint: in the middle of equal parts of the 12 edges of the cube.
#[must_use]
pub fn viewpoints() -> Vec<[f64; 3]> {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let edges = (0..3).flat_map(|axis| corners.map(|corner| (axis, corner)));
    let parts = edges.flat_map(|edge| (0..PER_EDGE).map(move |part| (edge, part)));
    parts
        .map(|((axis, (a, b)), part)| {
            let mut at = [0.0; 3];
            at[axis] = HALF * (f64::from(2 * part + 1) / f64::from(PER_EDGE) - 1.0);
            at[(axis + 1) % 3] = HALF * a;
            at[(axis + 2) % 3] = HALF * b;
            at
        })
        .collect()
}
