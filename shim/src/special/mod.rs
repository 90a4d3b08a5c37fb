//! Hooks that are written by hand, each under the name of its command.
#![allow(
    non_snake_case,
    clippy::missing_safety_doc,
    clippy::too_many_arguments,
    reason = "the API's names; the contract of each is the API's"
)]

mod buffers;
mod debug;
mod drawing;
mod framebuffer;
mod presents;
mod programs;
mod queries;
mod state;
mod visuals;
mod window;

pub(crate) use buffers::*;
pub(crate) use debug::*;
pub(crate) use drawing::*;
pub(crate) use framebuffer::*;
pub(crate) use presents::*;
pub(crate) use programs::*;
pub(crate) use queries::*;
pub(crate) use state::*;
pub(crate) use visuals::*;
pub(crate) use window::*;
