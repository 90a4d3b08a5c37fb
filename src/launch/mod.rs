//! Starts a program under the layer: checks before the start, its environment, and its end.
//!
//! Only the command uses this module; the preloaded library is built without it.
#![forbid(unsafe_code)]

mod capture;
mod doctor;
pub mod elf;
mod error;
mod flatpak;
pub mod library;
mod linked;
mod lost;
pub mod measured;
pub mod once;
mod preflight;
mod preload;
mod program;
mod proving;
mod screen;
mod signals;
mod stepped;
mod ways;
mod wine;
mod xvfb;

pub use capture::{CaptureJob, Captured};
pub use doctor::{Findings, Probe};
pub use error::LaunchError;
pub use linked::{GlLibrary, linked_gl};
pub use preflight::{check_app, check_files, writable};
pub use preload::with_library;
pub use program::{Ended, Launch};
pub use proving::ProveJob;
pub use screen::Screen;
pub use stepped::{Stepped, Stop};
pub use ways::Way;
pub use wine::by_vulkan;
pub use xvfb::Xvfb;
