//! Which monitor is the panel.
#![forbid(unsafe_code)]

use super::WindowError;

/// A monitor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Monitor {
    /// The name that `xrandr --listmonitors` or `wlr-randr` prints.
    pub name: String,
    /// Top left corner on the desk, in pixels.
    pub at: (i16, i16),
    /// Width and height in its own pixels, as it is turned.
    pub size: (u32, u32),
    /// The user has made it the primary monitor; under Wayland there is none.
    pub primary: bool,
    /// Its pixels for a thousand of the desk: 1000 where the desk is not scaled.
    pub density: u32,
    /// What it says of itself, its EDID; empty where nobody tells.
    pub edid: Vec<u8>,
}

impl Monitor {
    /// For a monitor on which windows are resampled, one sentence that says what becomes of pictures there.
    #[must_use]
    pub fn resamples(&self) -> Option<String> {
        (self.density != 1000).then(|| {
            format!(
                "monitor {} is scaled by {}, so a picture in the program's window is resampled there and its views are mixed up; \
                 give --panel, which draws the monitor's own pixels, or set its scale to 1",
                self.name,
                f64::from(self.density) / 1000.0
            )
        })
    }

    /// [`WindowError::TooLarge`] for a picture that is larger than the monitor.
    pub fn check(&self, picture: (u32, u32)) -> Result<(), WindowError> {
        if picture.0 > self.size.0 || picture.1 > self.size.1 {
            return Err(WindowError::TooLarge {
                picture,
                monitor: self.name.clone(),
                size: self.size,
            });
        }
        Ok(())
    }
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
            density: 1000,
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
    fn a_scaled_monitor_is_told_with_the_remedy() {
        let mut monitor = two().remove(0);
        assert_eq!(monitor.resamples(), None);
        monitor.density = 1250;
        let told = monitor.resamples().unwrap();
        assert!(told.contains("DP-1 is scaled by 1.25") && told.contains("--panel"));
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
