//! Views that are synthesised from depth images instead of drawn: an exact reference of each step on the CPU, and the passes of the driver (`gpu`).
//!
//! `depth_image` is a picture with depths; `warp` synthesises a view from it. `discontinuity` finds where such a view would tear. `distortion`
//! distorts the rays of the camera there, so that they reach behind the occluder. `occlusion` projects with such rays, builds the reference image
//! and draws views of it. After: Popescu, Rosen and Aliaga, "3D Display Rendering Acceleration Using Occlusion Camera Reference Images".
//!
//! Depths are 1/w of clip space throughout; 0 is infinitely far. Disparities and the depth buffer of a perspective projection are linear in 1/w,
//! and the equations of the paper are written in 1/z. Coordinates are in pixels, x to the right, y downwards, centres at halves.
#![forbid(unsafe_code)]

mod depth_image;
mod discontinuity;
mod distortion;
mod gpu;
mod mesh;
mod occlusion;
mod pinhole;
mod raster;
mod rows;
#[cfg(test)]
mod tests;
mod warp;

pub use depth_image::{DepthImage, DepthImageError, Shift};
pub use discontinuity::{Edge, Edges};
pub use distortion::{Distortion, Distortions, Splats};
pub use gpu::Passes;
pub use occlusion::{Reference, Triangle, Vertex};
pub use pinhole::{Motion, Pinhole};
pub use rows::{RowDistortion, RowDistortionMap};
pub use warp::{View, warp};
