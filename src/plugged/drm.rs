//! Monitors as the kernel knows them, for sessions whose X server tells nothing or is not there.
#![forbid(unsafe_code)]

use crate::window::Monitor;
use std::path::Path;

pub(super) const FOLDER: &str = "/sys/class/drm";

/// The connected monitors, in the order of their names. `folder`: [`FOLDER`]. Where they are on the screen the kernel does not know.
pub(super) fn monitors(folder: &Path) -> Vec<Monitor> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut found: Vec<_> = entries.filter_map(|entry| monitor(&entry.path())).collect();
    found.sort_by(|a, b| a.name.cmp(&b.name));
    found
}

/// A folder such as `card0-DP-1`.
fn monitor(folder: &Path) -> Option<Monitor> {
    let (card, name) = folder.file_name()?.to_str()?.split_once('-')?;
    let status = std::fs::read_to_string(folder.join("status")).ok()?;
    if !card.starts_with("card") || status.trim() != "connected" {
        return None;
    }
    let modes = std::fs::read_to_string(folder.join("modes")).unwrap_or_default();
    Some(Monitor {
        name: name.to_owned(),
        at: (0, 0),
        size: modes.lines().next().and_then(size).unwrap_or((0, 0)),
        primary: false,
        density: 1000,
        edid: std::fs::read(folder.join("edid")).unwrap_or_default(),
    })
}

/// The first mode is the monitor's own. It may end with a letter, as `1920x1080i`.
fn size(mode: &str) -> Option<(u32, u32)> {
    let (width, height) = mode.split_once('x')?;
    let height = height.trim_end_matches(|letter: char| !letter.is_ascii_digit());
    Some((width.parse().ok()?, height.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn connected_monitors_are_found() {
        let folder = tempfile::tempdir().unwrap();
        for (name, status, modes) in [
            ("card0-HDMI-A-1", "connected\n", "1920x1080i\n1280x720\n"),
            ("card0-DP-1", "disconnected\n", ""),
            ("card1-DP-2", "connected\n", ""),
            ("card0", "connected\n", ""),
            ("renderD128", "connected\n", ""),
        ] {
            let place = folder.path().join(name);
            std::fs::create_dir(&place).unwrap();
            std::fs::write(place.join("status"), status).unwrap();
            std::fs::write(place.join("modes"), modes).unwrap();
        }
        std::fs::write(folder.path().join("card0-HDMI-A-1/edid"), "EDID").unwrap();
        let found = monitors(folder.path());
        let short: Vec<_> = found
            .iter()
            .map(|m| (m.name.as_str(), m.size, m.edid.len()))
            .collect();
        assert_eq!(short, [("DP-2", (0, 0), 0), ("HDMI-A-1", (1920, 1080), 4)]);
    }
}
