//! Views that are not drawn but made of pictures with depth: what each step has to come to, on the CPU and exactly, and the passes
//! by which the driver makes them (`gpu`).
//!
//! `depth_image` is the plain picture with depths, `warp` makes a view of it. `discontinuity` finds where it would tear, `distortion` distorts
//! the rays of the camera there so that they reach behind what is in front, and `occlusion` projects with such rays, builds the reference image and
//! draws views of it. After: Popescu, Rosen and Aliaga, "3D Display Rendering Acceleration Using Occlusion Camera Reference Images".
//!
//! Depths are 1/w of clip space throughout (0 infinitely far): a disparity is a straight line over it, as is the depth buffer of a perspective
//! projection, and the equations of the paper are written in 1/z. Coordinates are in pixels, x to the right, y downwards, centres at halves.
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
