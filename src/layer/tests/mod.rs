//! The layer as a whole, on the fake driver.

pub(super) mod bench;
mod cameras;
mod canvas;
mod diagnostics;
mod frame;
mod queries;
mod recordings;
mod session;
mod synthesis;
mod targets;
pub(super) mod variants;
