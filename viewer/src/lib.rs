//! A viewer of point clouds: an ordinary OpenGL program that draws one view, which the layer draws once per view as it does any other's.
//!
//! Points go from a file ([`read`]) into a tree ([`octree`], filled by [`load`]), from which each frame takes as many as it has time for ([`pace`]). The nodes that
//! it takes are completed by normals and sizes ([`normals`], by the threads of [`prepare`]) and drawn ([`draw`]). Gaussians ([`gaussian`]) are
//! sorted and drawn whole. [`app`] is the window with its keys and mouse.

pub mod app;
pub mod camera;
pub mod draw;
mod extent;
pub mod gaussian;
pub mod load;
pub mod normals;
pub mod octree;
pub mod pace;
pub mod prepare;
mod quiet;
pub mod random;
pub mod read;
pub mod vertex;
