//! `libmanyview.so`: the exported symbols, the guard around them and the tables of the driver's functions. It decides nothing: the
//! work of a hook is in `manyview_core::layer`.

#[macro_use]
mod export;
mod caller;
mod context;
mod control;
mod deep;
mod dl;
mod drawable;
mod drawables;
#[rustfmt::skip]
#[allow(non_snake_case, unreachable_pub, unused_unsafe, clippy::missing_safety_doc, clippy::too_many_arguments, clippy::not_unsafe_ptr_arg_deref, reason = "generated; the names and signatures are the API's own, the contract of each is the API's")]
mod entry;
mod exports;
mod fault;
mod geometry;
mod hooks;
mod instead;
mod keys;
mod limiter;
mod live;
mod loaded;
mod messages;
mod panel;
mod provider;
mod record;
mod registry;
mod shares;
mod signals;
mod socket;
mod special;
mod stderr;
mod switch;
#[cfg(all(test, feature = "fake-driver"))]
mod tests;
mod uncancelled;
mod viewports;
mod windows;
mod xcb;

/// The address of a function in a static table.
#[derive(Clone, Copy)]
pub(crate) struct Address(*const ());

// SAFETY: the address of a function is the same in every thread.
unsafe impl Sync for Address {}
