//! `manyview` shows unmodified OpenGL programs on glasses-free 3D panels.
//!
//! The modules follow the flow of a draw call; a module imports only from those above it.
#![deny(unsafe_code)]

pub mod config;
pub mod display;
pub mod fixed;
pub mod interleave;
pub mod metric;
