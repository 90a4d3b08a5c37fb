//! How a command reaches the screen: what it draws with, in which container, on which desk; for `manyview doctor`.
#![forbid(unsafe_code)]

use super::elf::Class;
use super::wine::by_vulkan;
use crate::bounded;
use serde::Serialize;
use std::ffi::OsString;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Libraries of Windows by which programs draw, in the order in which they count, with what they are called.
const DRAWING: [(&str, &str, Drawn); 11] = [
    ("d3d12.dll", "Direct3D 12", Drawn::Vulkan),
    ("vulkan-1.dll", "Vulkan", Drawn::Vulkan),
    ("d3d11.dll", "Direct3D 11", Drawn::Direct3d),
    ("d3d10_1.dll", "Direct3D 10.1", Drawn::Direct3d),
    ("d3d10.dll", "Direct3D 10", Drawn::Direct3d),
    ("d3d9.dll", "Direct3D 9", Drawn::Direct3d),
    ("d3d8.dll", "Direct3D 8", Drawn::Direct3d),
    (
        "ddraw.dll",
        "DirectDraw and Direct3D up to 7",
        Drawn::Direct3d,
    ),
    ("d3dim700.dll", "Direct3D 7", Drawn::Direct3d),
    ("d3dim.dll", "Direct3D up to 6", Drawn::Direct3d),
    ("opengl32.dll", "OpenGL", Drawn::OpenGl),
];
/// Of a program for Windows, so much is searched for names of libraries.
const SEARCHED: u64 = 256 << 20;
/// Commands that put a program into a container, and what they are.
const CONTAINERS: [(&str, &str); 6] = [
    ("flatpak", "Flatpak"),
    ("bwrap", "bubblewrap"),
    ("_v2-entry-point", "Steam's container"),
    ("pressure-vessel-wrap", "Steam's container"),
    ("run-in-sniper", "Steam's container"),
    ("firejail", "firejail"),
];

/// What draws a program for Windows under Wine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Drawn {
    OpenGl,
    Direct3d,
    Vulkan,
}

/// A program for Windows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Windows {
    /// Its file.
    pub path: PathBuf,
    /// Its class; none where its header is not understood.
    pub class: Option<Class>,
    /// What it draws with, as far as its file names it.
    pub api: Option<String>,
    /// What draws that here: `OpenGL`, `wined3d` or `Vulkan`.
    pub backend: Option<String>,
}

/// How a command reaches the screen.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Way {
    /// The program for Windows that it starts, if it does.
    pub windows: Option<Windows>,
    /// The container that it starts, or this command is in.
    pub container: Option<String>,
    /// `X11`, `Wayland`, or `Wayland, and X11 by XWayland`; none without a desk.
    pub desk: Option<String>,
    /// What the user should change, a sentence each.
    pub advice: Vec<String>,
}

impl Way {
    /// For a program and its arguments. `variable` gives those of the environment.
    #[must_use]
    pub fn of(command: &[OsString], variable: impl Fn(&str) -> Option<OsString>) -> Self {
        let vulkan = by_vulkan(command, &variable);
        let windows = windows(command, vulkan.is_some());
        let mut advice: Vec<String> = vulkan.into_iter().collect();
        if windows
            .as_ref()
            .is_some_and(|found| found.backend.as_deref() == Some("Vulkan") && advice.is_empty())
        {
            advice.push(
                "it draws by Vulkan, which has no views; choose Direct3D 11 or older, or OpenGL, in its settings if it has them"
                    .to_owned(),
            );
        }
        let container = container(command);
        if container.as_deref() == Some("Flatpak") {
            advice.push("start it by `manyview run --flatpak ID`".to_owned());
        }
        if container.as_deref() == Some("firejail") {
            advice.push(
                "firejail keeps the layer out unless its profile allows LD_PRELOAD".to_owned(),
            );
        }
        let inside = || inside(|path| Path::new(path).exists());
        Way {
            windows,
            container: container.or_else(inside),
            desk: desk(&variable),
            advice,
        }
    }
}

fn windows(command: &[OsString], vulkan: bool) -> Option<Windows> {
    let path = command.iter().map(Path::new).find(|path| {
        let extension = path.extension();
        extension.is_some_and(|extension| extension.eq_ignore_ascii_case("exe"))
    })?;
    let mut bytes = Vec::new();
    // A file that cannot be read tells nothing, and the start of the program says why.
    let _ = bounded::open(path).and_then(|file| file.take(SEARCHED).read_to_end(&mut bytes));
    let found = DRAWING
        .iter()
        .find(|(name, ..)| names(&bytes, name.as_bytes()));
    let backend = found.map(|(_, _, drawn)| match drawn {
        Drawn::OpenGl => "OpenGL",
        Drawn::Direct3d if !vulkan => "wined3d",
        Drawn::Direct3d | Drawn::Vulkan => "Vulkan",
    });
    Some(Windows {
        path: path.to_owned(),
        class: class(&bytes),
        api: found.map(|(_, api, _)| (*api).to_owned()),
        backend: backend.map(str::to_owned),
    })
}

/// Whether a file names a library, in whatever case.
fn names(bytes: &[u8], name: &[u8]) -> bool {
    bytes
        .windows(name.len())
        .any(|part| part.eq_ignore_ascii_case(name))
}

/// The class of a program for Windows, by the machine in its header (PE format, COFF file header).
fn class(bytes: &[u8]) -> Option<Class> {
    let at = u32::from_le_bytes(*bytes.get(0x3c..)?.first_chunk()?) as usize;
    let header = bytes.get(at..)?;
    if !bytes.starts_with(b"MZ") || !header.starts_with(b"PE\0\0") {
        return None;
    }
    match u16::from_le_bytes(*header.get(4..)?.first_chunk()?) {
        0x14c => Some(Class::Narrow),
        0x8664 => Some(Class::Wide),
        _ => None,
    }
}

fn container(command: &[OsString]) -> Option<String> {
    let name = |word: &OsString| Some(Path::new(word).file_name()?.to_str()?.to_owned());
    let names: Vec<_> = command.iter().filter_map(name).collect();
    let found = CONTAINERS
        .iter()
        .find(|(known, _)| names.iter().any(|name| name == known));
    found.map(|(_, called)| (*called).to_owned())
}

/// The container that this process is in.
fn inside(there: impl Fn(&str) -> bool) -> Option<String> {
    let known = [
        ("/.flatpak-info", "Flatpak"),
        ("/run/pressure-vessel", "Steam's container"),
        ("/run/.containerenv", "podman or toolbox"),
        ("/.dockerenv", "docker"),
    ];
    let found = known.iter().find(|(path, _)| there(path));
    found.map(|(_, called)| (*called).to_owned())
}

fn desk(variable: impl Fn(&str) -> Option<OsString>) -> Option<String> {
    let set = |name: &str| variable(name).is_some_and(|value| !value.is_empty());
    let desk = match (set("WAYLAND_DISPLAY"), set("DISPLAY")) {
        (true, true) => "Wayland, and X11 by XWayland",
        (true, false) => "Wayland",
        (false, true) => "X11",
        (false, false) => return None,
    };
    Some(desk.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The beginning of a program for Windows of this machine, which names libraries.
    fn program(machine: u16, libraries: &str) -> Vec<u8> {
        let mut bytes = vec![0; 0x80];
        bytes[..2].copy_from_slice(b"MZ");
        bytes[0x3c] = 0x40;
        bytes[0x40..0x44].copy_from_slice(b"PE\0\0");
        bytes[0x44..0x46].copy_from_slice(&machine.to_le_bytes());
        bytes.extend(libraries.as_bytes());
        bytes
    }

    #[test]
    fn a_program_for_windows_is_told_by_its_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("Game.EXE");
        let told = |machine, libraries: &str, variables: &[(&str, &str)]| {
            std::fs::write(&path, program(machine, libraries)).unwrap();
            let command = [OsString::from("wine"), path.clone().into()];
            Way::of(&command, |name| {
                let home = ("HOME", folder.path().to_str().unwrap());
                let all = variables.iter().copied().chain([home]);
                let found = all.into_iter().find(|(known, _)| *known == name);
                found.map(|(_, value)| value.into())
            })
        };
        let way = told(0x14c, "KERNEL32.dll\0D3D9.dll\0", &[("DISPLAY", ":0")]);
        let found = way.windows.unwrap();
        assert_eq!(found.class, Some(Class::Narrow));
        assert_eq!(found.api.as_deref(), Some("Direct3D 9"));
        assert_eq!(found.backend.as_deref(), Some("wined3d"));
        assert_eq!((way.desk.as_deref(), way.advice.len()), (Some("X11"), 0));
        let way = told(0x8664, "d3d12.dll\0d3d11.dll\0", &[]);
        let found = way.windows.unwrap();
        assert_eq!(
            (found.class, found.backend.as_deref()),
            (Some(Class::Wide), Some("Vulkan"))
        );
        assert!(
            way.advice[0].contains("Direct3D 11 or older"),
            "{:?}",
            way.advice
        );
        let system = folder.path().join(".wine/drive_c/windows/system32");
        std::fs::create_dir_all(&system).unwrap();
        std::fs::write(system.join("d3d9.dll"), "DXVK: v2").unwrap();
        let way = told(0x14c, "d3d9.dll\0", &[]);
        assert_eq!(way.windows.unwrap().backend.as_deref(), Some("Vulkan"));
        assert!(
            way.advice[0].contains("WINEDLLOVERRIDES"),
            "{:?}",
            way.advice
        );
        let way = told(0x1c0, "opengl32.dll\0", &[]);
        let found = way.windows.unwrap();
        assert_eq!(
            (found.class, found.backend.as_deref()),
            (None, Some("OpenGL"))
        );
    }

    #[test]
    fn containers_and_desks_are_named() {
        let way = |words: &[&str], variables: &'static [&'static str]| {
            let words: Vec<_> = words.iter().map(OsString::from).collect();
            Way::of(&words, move |name| {
                variables.contains(&name).then(|| "1".into())
            })
        };
        let flatpak = way(
            &["flatpak", "run", "org.example.Game"],
            &["WAYLAND_DISPLAY", "DISPLAY"],
        );
        assert_eq!(flatpak.container.as_deref(), Some("Flatpak"));
        assert!(flatpak.advice[0].contains("run --flatpak"));
        assert!(flatpak.desk.unwrap().contains("XWayland"));
        let steam = way(
            &["/opt/SteamLinuxRuntime/_v2-entry-point", "--", "game"],
            &[],
        );
        assert_eq!(steam.container.as_deref(), Some("Steam's container"));
        assert_eq!((steam.desk, steam.windows), (None, None));
        assert_eq!(
            inside(|path| path == "/.flatpak-info").as_deref(),
            Some("Flatpak")
        );
        assert_eq!(inside(|_| false), None);
    }
}
