//! Windows that cover a monitor, where each pixel of a picture is a pixel of the monitor.
//!
//! The panel's own window ([`PanelServer`]) is one of a Wayland compositor where there is one, else of an X server. [`Window`], for calibration, takes
//! keys and is one of an X server.
#![forbid(unsafe_code)]

mod error;
mod monitor;
mod panel;
mod surface;
mod wayland;
mod x11;

pub use error::WindowError;
pub use monitor::Monitor;
pub use panel::PanelServer;
pub use x11::{Event, Window, wake};

use surface::Surface;

/// The monitors of the Wayland compositor, or of the X server where there is none.
///
/// # Errors
/// There is neither, or it fails.
pub fn monitors() -> Result<Vec<Monitor>, WindowError> {
    match wayland::Compositor::find() {
        Some(compositor) => Ok(compositor?.monitors()),
        None => x11::monitors(),
    }
}

/// The monitor that the panel's window would cover; see [`PanelServer::open`].
///
/// # Errors
/// As [`monitors`], or there is no such monitor.
pub fn monitor_for(
    wanted: Option<&str>,
    panel: Option<(u32, u32)>,
) -> Result<Monitor, WindowError> {
    monitor::choose(monitors()?, ("--panel", wanted), panel)
}

/// Opens a black window over the monitor that the user has named, else over the one of the panel's size, else over the primary one. It takes no keys.
fn open(
    title: &str,
    wanted: Option<&str>,
    panel: Option<(u32, u32)>,
) -> Result<Box<dyn Surface>, WindowError> {
    match wayland::Compositor::find() {
        Some(compositor) => compositor?.open(title, wanted, panel),
        None => x11::panel(title, wanted, panel),
    }
}
