//! `manyview` shows unmodified OpenGL programs on glasses-free 3D panels.
//!
//! The modules follow the flow of a draw call (see ARCHITECTURE.md); a module imports only from those above it in this list.
#![deny(unsafe_code)]

// The blank lines keep the order: rustfmt sorts modules that are adjacent.

pub mod view;

pub mod bounded;

pub mod display;

pub mod splat;

#[cfg(feature = "cli")]
pub mod calibrate;

#[cfg(feature = "cli")]
pub mod wall;

pub mod config;

pub mod control;

pub mod checksum;

pub mod claim;

pub mod fixed;

pub mod rewrite;

#[allow(unsafe_code, reason = "the one place that talks to the driver")]
pub mod gl;

pub mod metric;

pub mod report;

#[cfg(feature = "cli")]
pub mod simulate;

pub mod state;

pub mod plan;

pub mod atlas;

pub mod offscreen;

pub mod draw;

pub mod interleave;

pub mod points;

pub mod osd;

pub mod accumulation;

pub mod synthesis;

pub mod volume;

#[cfg(feature = "cli")]
pub mod model;

pub mod present;

pub mod layer;

#[cfg(feature = "cli")]
pub mod window;

#[cfg(feature = "cli")]
pub mod plugged;

#[cfg(feature = "cli")]
pub mod bench;

#[cfg(feature = "cli")]
pub mod launch;

// The tests of all modules use it, so it has no place in the order.
#[cfg(test)]
#[path = "../tests/support/share.rs"]
mod share;
