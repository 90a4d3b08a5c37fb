//! The true framebuffer 0, and the state that our own drawing borrows and gives back.
#![forbid(unsafe_code)]

pub mod capture;
mod saved;
mod stereo;

pub use saved::Saved;
pub use stereo::Attributes;
