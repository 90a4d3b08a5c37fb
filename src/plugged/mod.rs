//! Panels that are plugged into this machine, and the one that the user has set up.
//!
//! A monitor names itself by its EDID. A Looking Glass has its calibration on a storage of its own, which is mounted as a small drive.
//! `manyview run` without an option shows on the panel that is set up ([`Chosen`]), else on the one that is plugged in ([`Plugged::panel`]).
#![forbid(unsafe_code)]

mod chosen;
mod drm;
mod edid;
mod storage;

pub use chosen::{Chosen, ChosenError};
pub use edid::Edid;

use crate::display::{Display, Kind};
use crate::window::{Monitor, monitors};
use std::path::{Path, PathBuf};

/// How the EDID of a Looking Glass begins its name.
const LOOKING_GLASS: &str = "LKG";

/// Parts of the names of tracked panels of two views, by model; nobody publishes a description of their lenses.
const TRACKED: [(&str, &str); 5] = [
    ("ASV15", "Acer SpatialLabs View"),
    ("ASV27", "Acer SpatialLabs View Pro"),
    ("PSV27", "Acer Predator SpatialLabs View"),
    ("G90X", "Samsung Odyssey 3D"),
    ("ELF-SR", "Sony Spatial Reality Display"),
];

/// A monitor and what it says of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Attached {
    /// The monitor.
    pub monitor: Monitor,
    /// Its name plate, if it has one.
    pub edid: Option<Edid>,
}

/// A calibration that lies on the storage of a device.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// The file.
    pub file: PathBuf,
    /// What is in it; else why it cannot be used, in one sentence.
    pub display: Result<Display, String>,
}

/// Everything that is plugged in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plugged {
    /// All monitors.
    pub monitors: Vec<Attached>,
    /// All calibrations.
    pub calibrations: Vec<Calibration>,
}

/// The panel that is plugged in.
#[derive(Clone, Debug, PartialEq)]
pub enum Panel {
    /// A Looking Glass.
    Calibrated {
        /// Its calibration.
        file: PathBuf,
        /// Its name.
        name: String,
        /// Its monitor, where it is known and another one is there for the program.
        monitor: Option<String>,
    },
    /// A Looking Glass without its calibration: its name.
    Uncalibrated(String),
    /// There is none.
    None,
}

impl Attached {
    fn new(monitor: Monitor) -> Self {
        let edid = Edid::read(&monitor.edid);
        Self { monitor, edid }
    }

    /// Its name, and its serial number where that says more.
    #[must_use]
    pub fn name(&self) -> Option<String> {
        let edid = self.edid.as_ref()?;
        match (edid.name.as_str(), edid.serial.as_str()) {
            ("", "") => Some(edid.maker.clone()),
            (name, serial) if serial.starts_with(name) => Some(serial.to_owned()),
            (name, _) => Some(name.to_owned()),
        }
    }

    fn is_looking_glass(&self) -> bool {
        let name = self.edid.as_ref().map(|edid| &edid.name);
        name.is_some_and(|name| name.starts_with(LOOKING_GLASS))
    }

    /// The model of a tracked panel of two views, if it is one.
    #[must_use]
    pub fn tracked(&self) -> Option<&'static str> {
        let name = &self.edid.as_ref()?.name;
        let known = TRACKED.iter().find(|(part, _)| name.contains(part));
        known.map(|(_, model)| *model)
    }

    fn has_serial(&self, serial: &str) -> bool {
        let plate = self.edid.as_ref().filter(|_| !serial.is_empty());
        plate.is_some_and(|edid| {
            [&edid.name, &edid.serial]
                .iter()
                .any(|text| *text == serial)
        })
    }

    /// It has the pixels of the display, upright or turned.
    fn has_size_of(&self, display: &Display) -> bool {
        let (width, height) = self.monitor.size;
        let screen = display.facts.screen;
        screen == Some((width, height)) || screen == Some((height, width))
    }
}

impl Calibration {
    fn read(file: PathBuf) -> Self {
        let display = Display::load(&file.to_string_lossy()).map_err(|error| error.to_string());
        Self { file, display }
    }

    /// The name of the device: its serial number where it has one.
    #[must_use]
    pub fn name(&self) -> String {
        let serial = self.display.as_ref().ok().and_then(serial);
        serial
            .filter(|serial| !serial.is_empty())
            .map_or("Looking Glass".to_owned(), str::to_owned)
    }
}

/// The serial number of a Looking Glass.
fn serial(display: &Display) -> Option<&str> {
    match &display.kind {
        Kind::LookingGlass(device) => Some(&device.serial),
        _ => None,
    }
}

impl Plugged {
    /// Looks at the monitors of the X server, or of the kernel without one, and at mounted drives.
    #[must_use]
    pub fn find() -> Self {
        let kernel = drm::monitors(Path::new(drm::FOLDER));
        let mut found = monitors().unwrap_or_else(|_| kernel.clone());
        for monitor in found.iter_mut().filter(|monitor| monitor.edid.is_empty()) {
            if let Some(same) = kernel.iter().find(|known| known.name == monitor.name) {
                monitor.edid.clone_from(&same.edid);
            }
        }
        Self {
            monitors: found.into_iter().map(Attached::new).collect(),
            calibrations: storage::calibrations()
                .into_iter()
                .map(Calibration::read)
                .collect(),
        }
    }

    /// The monitor that is a display: the one with its serial number, else the only Looking Glass of its size, else the only one.
    #[must_use]
    pub fn monitor_of(&self, display: &Display) -> Option<&Attached> {
        let serial = serial(display)?;
        if let Some(named) = self
            .monitors
            .iter()
            .find(|monitor| monitor.has_serial(serial))
        {
            return Some(named);
        }
        let glasses = || {
            self.monitors
                .iter()
                .filter(|monitor| monitor.is_looking_glass())
        };
        only(glasses().filter(|monitor| monitor.has_size_of(display))).or_else(|| only(glasses()))
    }

    /// The calibration of a monitor that is a Looking Glass.
    #[must_use]
    pub fn calibration_of(&self, monitor: &Attached) -> Option<&Calibration> {
        self.calibrations.iter().find(|calibration| {
            let display = calibration.display.as_ref().ok();
            display.and_then(|display| self.monitor_of(display)) == Some(monitor)
        })
    }

    /// The panel that is plugged in; of several the first one.
    #[must_use]
    pub fn panel(&self) -> Panel {
        for calibration in &self.calibrations {
            let Ok(display) = &calibration.display else {
                continue;
            };
            let monitor = self.monitor_of(display).filter(|_| self.monitors.len() > 1);
            return Panel::Calibrated {
                file: calibration.file.clone(),
                name: calibration.name(),
                monitor: monitor.map(|attached| attached.monitor.name.clone()),
            };
        }
        let glass = self
            .monitors
            .iter()
            .find(|monitor| monitor.is_looking_glass());
        match glass.and_then(Attached::name) {
            Some(name) => Panel::Uncalibrated(name),
            None => Panel::None,
        }
    }
}

/// The only item, if there is no second one.
fn only<T>(mut items: impl Iterator<Item = T>) -> Option<T> {
    let first = items.next()?;
    items.next().is_none().then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn monitor(name: &str, size: (u32, u32), plate: Option<(&str, &str)>) -> Attached {
        let edid = plate.map(|(name, serial)| Edid {
            maker: "LLG".to_owned(),
            name: name.to_owned(),
            serial: serial.to_owned(),
        });
        let monitor = Monitor {
            name: name.to_owned(),
            at: (0, 0),
            size,
            primary: false,
            density: 1000,
            edid: Vec::new(),
        };
        Attached { monitor, edid }
    }

    fn calibration(serial: &str, (width, height): (u32, u32)) -> Calibration {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("visual.json");
        let text = format!(
            r#"{{"serial": "{serial}", "pitch": 50, "slope": -7, "center": 0, "DPI": 300, "screenW": {width}, "screenH": {height}}}"#
        );
        std::fs::write(&file, text).unwrap();
        let read = Calibration::read(file);
        assert!(read.display.is_ok());
        Calibration {
            file: PathBuf::from(format!("/media/{serial}")),
            ..read
        }
    }

    fn shown(plugged: &Plugged) -> (String, Option<String>) {
        match plugged.panel() {
            Panel::Calibrated { name, monitor, .. } => (name, monitor),
            other => panic!("{other:?}"),
        }
    }

    const GO: (u32, u32) = (1440, 2560);

    #[test]
    fn a_device_is_found_by_its_serial_number_its_size_or_as_the_only_one() {
        let desk = monitor("eDP-1", (1920, 1080), Some(("PANEL", "")));
        let go = monitor("DP-1", GO, Some(("LKG-E", "LKG-E1")));
        let other = monitor("DP-2", GO, Some(("LKG-E", "LKG-E2")));
        let turned = monitor("DP-3", (2560, 1440), Some(("LKG", "")));
        let plugged = |monitors: &[&Attached], serial| Plugged {
            monitors: monitors.iter().copied().cloned().collect(),
            calibrations: vec![calibration(serial, GO)],
        };
        let at = |monitors: &[&Attached], serial| shown(&plugged(monitors, serial)).1;
        assert_eq!(at(&[&desk, &go, &other], "LKG-E2").as_deref(), Some("DP-2"));
        assert_eq!(at(&[&desk, &go], "LKG-E9").as_deref(), Some("DP-1"));
        assert_eq!(at(&[&desk, &turned], "LKG-E9").as_deref(), Some("DP-3"));
        // Two of the same size: which one it is, nobody knows.
        assert_eq!(at(&[&desk, &go, &other], "LKG-E9"), None);
        // The program has no other monitor.
        assert_eq!(at(&[&go], "LKG-E1"), None);
        assert_eq!(at(&[&desk], "LKG-E1"), None);
        let found = plugged(&[&desk, &go], "LKG-E1");
        assert_eq!(
            found.calibration_of(&go).map(Calibration::name).as_deref(),
            Some("LKG-E1")
        );
        assert_eq!(found.calibration_of(&desk), None);
    }

    #[test]
    fn a_broken_calibration_is_none() {
        let desk = monitor("eDP-1", (1920, 1080), None);
        let go = monitor("DP-1", GO, Some(("LKG-E", "LKG-E1")));
        let broken = Calibration {
            file: PathBuf::from("/media/x"),
            display: Err("broken".to_owned()),
        };
        let mut plugged = Plugged {
            monitors: vec![desk.clone(), go],
            calibrations: vec![broken, calibration("LKG-E1", GO)],
        };
        assert_eq!(shown(&plugged).0, "LKG-E1");
        plugged.calibrations.truncate(1);
        let named = Panel::Uncalibrated("LKG-E1".to_owned());
        assert_eq!(plugged.panel(), named);
        plugged.monitors = vec![desk];
        assert_eq!(plugged.panel(), Panel::None);
    }

    #[test]
    fn tracked_panels_are_known_by_name() {
        let acer = monitor("DP-1", (3840, 2160), Some(("ASV27-2P", "")));
        assert_eq!(acer.tracked(), Some("Acer SpatialLabs View Pro"));
        let office = monitor("DP-1", (3840, 2160), Some(("U2720Q", "")));
        assert_eq!(
            (office.tracked(), office.name().as_deref()),
            (None, Some("U2720Q"))
        );
        assert_eq!(monitor("DP-1", (1, 1), None).name(), None);
    }
}
