//! Which monitor is the panel.
#![forbid(unsafe_code)]

use super::WindowError;
use x11rb::connection::Connection;
use x11rb::protocol::randr::ConnectionExt as _;
use x11rb::protocol::xproto::{AtomEnum, ConnectionExt as _, Screen};
use x11rb::rust_connection::RustConnection;

/// A monitor of an X screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Monitor {
    /// The name that `xrandr --listmonitors` prints.
    pub name: String,
    /// Top left corner on the X screen, in pixels.
    pub at: (i16, i16),
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// The user has made it the primary monitor.
    pub primary: bool,
    /// What it says of itself, its EDID; empty where the server does not tell.
    pub edid: Vec<u8>,
}

/// The monitors of the X server.
///
/// # Errors
/// There is no X server, or it fails.
pub fn monitors() -> Result<Vec<Monitor>, WindowError> {
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
            edid: Vec::new(),
        });
    }
    Ok(found)
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

/// The monitor with the `wanted` name or number from 0. Without `wanted`, the first of the panel's size, else the primary one, else the first.
pub(super) fn choose(
    mut monitors: Vec<Monitor>,
    (option, wanted): (&'static str, Option<&str>),
    panel: Option<(u32, u32)>,
) -> Result<Monitor, WindowError> {
    let at = match wanted {
        Some(wanted) => monitors
            .iter()
            .position(|monitor| monitor.name == wanted)
            .or_else(|| wanted.parse().ok().filter(|&at| at < monitors.len()))
            .ok_or_else(|| WindowError::Monitor {
                option,
                wanted: wanted.to_owned(),
                known: list(&monitors),
            })?,
        None => {
            let of_size = |monitor: &Monitor| Some(monitor.size) == panel;
            let primary = |monitor: &Monitor| monitor.primary;
            let found = monitors.iter().position(of_size);
            found
                .or_else(|| monitors.iter().position(primary))
                .unwrap_or(0)
        }
    };
    Ok(monitors.swap_remove(at))
}

fn list(monitors: &[Monitor]) -> String {
    let words = monitors.iter().enumerate().map(|(at, monitor)| {
        let (width, height) = monitor.size;
        format!("{at} or {} ({width}x{height})", monitor.name)
    });
    words.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two() -> Vec<Monitor> {
        let monitor = |name: &str, x, size, primary| Monitor {
            name: name.to_owned(),
            at: (x, 0),
            size,
            primary,
            edid: Vec::new(),
        };
        vec![
            monitor("DP-1", 0, (1920, 1080), false),
            monitor("eDP-1", 1920, (1280, 800), true),
            monitor("HDMI-1", 3200, (3840, 2160), false),
        ]
    }

    #[test]
    fn the_panel_is_found_by_name_number_size_or_rank() {
        let name = |wanted, panel| choose(two(), ("--monitor", wanted), panel).unwrap().name;
        assert_eq!(name(Some("DP-1"), Some((3840, 2160))), "DP-1");
        assert_eq!(name(Some("2"), None), "HDMI-1");
        assert_eq!(name(None, Some((3840, 2160))), "HDMI-1");
        assert_eq!(name(None, Some((800, 600))), "eDP-1");
        assert_eq!(name(None, None), "eDP-1");
        let mut equals = two();
        equals[1].primary = false;
        assert_eq!(
            choose(equals, ("--monitor", None), None).unwrap().name,
            "DP-1"
        );
    }

    #[test]
    fn another_monitor_is_refused_with_those_that_are_there() {
        for wanted in ["DP-2", "3", "-1", ""] {
            let error = choose(two(), ("--monitor", Some(wanted)), None)
                .unwrap_err()
                .to_string();
            assert_eq!(
                error,
                format!(
                    "--monitor '{wanted}': there is no such monitor; give one of 0 or DP-1 (1920x1080), \
                     1 or eDP-1 (1280x800), 2 or HDMI-1 (3840x2160)"
                )
            );
        }
    }
}
