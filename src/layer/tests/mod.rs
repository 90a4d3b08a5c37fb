//! The layer as a whole, on the fake driver.

mod bench;
mod frame;
