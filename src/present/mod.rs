//! The true framebuffer 0, and the state that our own drawing borrows and gives back.
#![forbid(unsafe_code)]

pub mod capture;
mod stereo;

pub use stereo::Attributes;
