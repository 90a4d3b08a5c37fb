//! Calibrations on the storage of the devices: a Looking Glass that is plugged in is a small drive, too, with `LKG_calibration/visual.json`.
#![forbid(unsafe_code)]

use std::path::{Path, PathBuf};

const MOUNTS: &str = "/proc/self/mounts";
const CALIBRATION: &str = "LKG_calibration/visual.json";
/// What a device may have its storage formatted with. Others are not looked into: a network that does not answer would stop us.
const FORMATS: [&str; 4] = ["vfat", "msdos", "exfat", "fuseblk"];

/// The calibrations of all devices whose storage is mounted.
pub(super) fn calibrations() -> Vec<PathBuf> {
    let mounts = std::fs::read(MOUNTS).unwrap_or_default();
    calibrations_in(&String::from_utf8_lossy(&mounts))
}

/// `mounts`: a line for each mount: source, place, format and more, as `/proc/self/mounts` has them.
fn calibrations_in(mounts: &str) -> Vec<PathBuf> {
    let place = |line: &str| {
        let mut words = line.split(' ').skip(1);
        let (place, format) = (words.next()?, words.next()?);
        FORMATS.contains(&format).then(|| unescaped(place))
    };
    let places = mounts.lines().filter_map(place);
    let mut found: Vec<_> = places
        .map(|place| Path::new(&place).join(CALIBRATION))
        .filter(|file| file.is_file())
        .collect();
    found.sort();
    found.dedup();
    found
}

/// The kernel writes spaces, tabs, line feeds and backslashes as octal numbers.
fn unescaped(place: &str) -> String {
    let codes = [
        ("\\040", " "),
        ("\\011", "\t"),
        ("\\012", "\n"),
        ("\\134", "\\"),
    ];
    codes.iter().fold(place.to_owned(), |text, (code, sign)| {
        text.replace(code, sign)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calibrations_are_found_on_drives_alone() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for name in ["LKG E01234", "net", "empty"] {
            std::fs::create_dir_all(at(name).join("LKG_calibration")).unwrap();
        }
        for name in ["LKG E01234", "net"] {
            std::fs::write(at(name).join(CALIBRATION), "{}").unwrap();
        }
        let line = |name: &str, format: &str| {
            let place = at(name).display().to_string().replace(' ', "\\040");
            format!("/dev/sdb1 {place} {format} ro,relatime 0 0\n")
        };
        let mounts =
            line("LKG E01234", "vfat") + &line("net", "nfs4") + &line("empty", "vfat") + "odd\n";
        assert_eq!(
            calibrations_in(&mounts),
            [at("LKG E01234").join(CALIBRATION)]
        );
    }
}
