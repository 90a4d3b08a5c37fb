//! The monitors of an X server, by RandR.
#![forbid(unsafe_code)]

use crate::window::{Monitor, WindowError};
use x11rb::connection::Connection;
use x11rb::protocol::randr::{ConnectionExt as _, MonitorInfo};
use x11rb::protocol::xproto::{AtomEnum, ConnectionExt as _, Screen};
use x11rb::rust_connection::RustConnection;

/// The monitors of the X server.
///
/// # Errors
/// There is no X server, or it fails.
pub(in crate::window) fn monitors() -> Result<Vec<Monitor>, WindowError> {
    let (connection, number) = RustConnection::connect(None)?;
    let screen = connection.setup().roots.get(number).cloned();
    all(&connection, &screen.ok_or(WindowError::Colours)?)
}

/// All monitors. Where the server reports none, the whole screen counts as one.
pub(super) fn all(
    connection: &impl Connection,
    screen: &Screen,
) -> Result<Vec<Monitor>, WindowError> {
    let mut found = Vec::new();
    // A server without RandR 1.5 answers with an error.
    if let Ok(reply) = connection
        .randr_get_monitors(screen.root, true)
        .map_err(x11rb::errors::ReplyError::from)
        .and_then(|cookie| cookie.reply())
    {
        for monitor in reply.monitors {
            let name = connection.get_atom_name(monitor.name)?.reply()?.name;
            found.push(Monitor {
                name: String::from_utf8_lossy(&name).into_owned(),
                at: (monitor.x, monitor.y),
                size: (monitor.width.into(), monitor.height.into()),
                primary: monitor.primary,
                density: density(connection, &monitor).unwrap_or(1000),
                edid: edid(connection, &monitor.outputs)?,
            });
        }
    }
    if found.is_empty() {
        found.push(Monitor {
            name: "screen".to_owned(),
            at: (0, 0),
            size: (
                screen.width_in_pixels.into(),
                screen.height_in_pixels.into(),
            ),
            primary: true,
            density: 1000,
            edid: Vec::new(),
        });
    }
    Ok(found)
}

/// See [`Monitor::density`]: the server may scale what a monitor shows (`xrandr --scale`).
fn density(connection: &impl Connection, monitor: &MonitorInfo) -> Option<u32> {
    let [output, ..] = monitor.outputs[..] else {
        return None;
    };
    let output = connection
        .randr_get_output_info(output, 0)
        .ok()?
        .reply()
        .ok()?;
    let crtc = connection
        .randr_get_crtc_info(output.crtc, 0)
        .ok()?
        .reply()
        .ok()?;
    let transform = connection.randr_get_crtc_transform(output.crtc).ok()?;
    // A fixed-point number of 16 bits before and after the point: how many pixels of the desk one of the monitor takes.
    let across = transform.reply().ok()?.current_transform.matrix11;
    let whole = f64::from(1 << 16) / f64::from(across);
    (crtc.width > 0 && across > 0).then(|| (whole * 1000.0).round() as u32)
}

/// The EDID of the first output that has one.
fn edid(connection: &impl Connection, outputs: &[u32]) -> Result<Vec<u8>, WindowError> {
    const NAME: &[u8] = b"EDID";
    /// Four bytes each; extensions are not needed.
    const UNITS: u32 = 32;
    let property = connection.intern_atom(true, NAME)?.reply()?.atom;
    for &output in outputs.iter().filter(|_| property != x11rb::NONE) {
        let any: u32 = AtomEnum::ANY.into();
        let asked =
            connection.randr_get_output_property(output, property, any, 0, UNITS, false, false)?;
        // An output without it answers with nothing.
        if let Ok(reply) = asked.reply()
            && !reply.data.is_empty()
        {
            return Ok(reply.data);
        }
    }
    Ok(Vec::new())
}
