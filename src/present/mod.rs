//! Captures of the bound framebuffer, and windows with a left and a right buffer.
#![forbid(unsafe_code)]

pub mod capture;
mod stereo;

pub use stereo::Attributes;
