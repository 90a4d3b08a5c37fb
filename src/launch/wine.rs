//! Programs for Windows: whether their Direct3D comes to the layer.
#![forbid(unsafe_code)]

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// Libraries of Direct3D that DXVK replaces in a Wine prefix.
const LIBRARIES: [&str; 5] = [
    "d3d8.dll",
    "d3d9.dll",
    "d3d10core.dll",
    "d3d11.dll",
    "dxgi.dll",
];
/// What DXVK's libraries have in them and Wine's have not.
const MARK: &[u8] = b"DXVK: ";
/// A larger file is none of them.
const LARGEST: u64 = 64 << 20;

/// For a command that starts a program for Windows, whose prefix translates Direct3D to Vulkan, one sentence that says so and names the remedy. `variable` gives those of
/// the environment.
#[must_use]
pub fn by_vulkan(
    command: &[OsString],
    variable: impl Fn(&str) -> Option<OsString>,
) -> Option<String> {
    let set = |name: &str| variable(name).filter(|value| !value.is_empty());
    let is_windows = |word: &OsString| {
        let path = Path::new(word);
        let name = path.file_name().unwrap_or(OsStr::new("")).to_string_lossy();
        let name = name.to_ascii_lowercase();
        name.ends_with(".exe") || ["wine", "wine64", "proton"].contains(&&*name)
    };
    if !command.iter().any(is_windows) || set("PROTON_USE_WINED3D").is_some_and(|v| v != "0") {
        return None;
    }
    let proton = set("STEAM_COMPAT_DATA_PATH").map(|folder| PathBuf::from(folder).join("pfx"));
    let own = set("WINEPREFIX").map(PathBuf::from);
    let home = || Some(PathBuf::from(set("HOME")?).join(".wine"));
    let prefix = proton.clone().or(own).or_else(home)?;
    let overrides = set("WINEDLLOVERRIDES").unwrap_or_default();
    let overrides = overrides.to_string_lossy().to_lowercase();
    let folders = ["system32", "syswow64"].map(|name| prefix.join("drive_c/windows").join(name));
    let mut files = folders
        .iter()
        .flat_map(|folder| LIBRARIES.map(|name| (folder.join(name), name)));
    let (_, name) = files.find(|(file, name)| {
        !is_built_in(&overrides, name.trim_end_matches(".dll")) && is_dxvk(file)
    })?;
    let remedy = match proton {
        Some(_) => "PROTON_USE_WINED3D=1",
        None => "WINEDLLOVERRIDES=d3d8,d3d9,d3d10core,d3d11,dxgi=b",
    };
    Some(format!(
        "{name} in {} is DXVK, which draws by Vulkan, so Direct3D is shown without views; set {remedy} to have Wine's own, by OpenGL",
        prefix.display()
    ))
}

/// Whether a value of `WINEDLLOVERRIDES`, such as `d3d9,d3d11=b;mshtml=`, gives a library as Wine's own, in lower case.
fn is_built_in(overrides: &str, library: &str) -> bool {
    overrides.split(';').any(|group| {
        let (names, how) = group.split_once('=').unwrap_or((group, ""));
        how.trim_start().starts_with('b') && names.split(',').any(|name| name.trim() == library)
    })
}

fn is_dxvk(file: &Path) -> bool {
    let small = std::fs::metadata(file).is_ok_and(|about| about.len() <= LARGEST);
    small
        && std::fs::read(file).is_ok_and(|bytes| bytes.windows(MARK.len()).any(|part| part == MARK))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_prefix_with_dxvk_is_told_and_the_remedy_named() {
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path().join("drive_c/windows/syswow64");
        std::fs::create_dir_all(&at).unwrap();
        let told = |words: &[&str], variables: &[(&str, &str)]| {
            let command: Vec<OsString> = words.iter().map(OsString::from).collect();
            by_vulkan(&command, |name| match name {
                "WINEPREFIX" => Some(folder.path().into()),
                name => variables
                    .iter()
                    .find(|(known, _)| *known == name)
                    .map(|(_, v)| v.into()),
            })
        };
        let game = ["wine", "game.exe"];
        assert_eq!(told(&game, &[]), None);
        std::fs::write(at.join("d3d9.dll"), b"MZ wine's own").unwrap();
        assert_eq!(told(&game, &[]), None);
        std::fs::write(at.join("d3d9.dll"), b"MZ...DXVK: v2.3...").unwrap();
        let text = told(&game, &[]).expect("told");
        assert!(
            text.contains("d3d9.dll") && text.contains("WINEDLLOVERRIDES"),
            "{text}"
        );
        assert_eq!(told(&["gltron"], &[]), None);
        assert!(told(&["/opt/start.sh", "C:\\Game.EXE"], &[]).is_some());
        assert_eq!(
            told(&game, &[("WINEDLLOVERRIDES", "mshtml=;d3d8,d3d9=b")]),
            None
        );
        assert!(told(&game, &[("WINEDLLOVERRIDES", "d3d9=n,b")]).is_some());
        assert_eq!(told(&game, &[("PROTON_USE_WINED3D", "1")]), None);
    }
}
