//! The OpenGL libraries that a program would load, read from its files without starting it.
#![forbid(unsafe_code)]

use super::elf::{Class, Elf};
use std::collections::{HashMap, HashSet, VecDeque};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Beginnings of the names of OpenGL libraries: those whose functions the layer hooks, and those of OpenGL ES, which it leaves alone.
const FAMILIES: &[&str] = &[
    "libGL.so",
    "libOpenGL.so",
    "libGLX.so",
    "libEGL.so",
    "libOSMesa.so",
    "libGLESv1_CM.so",
    "libGLESv2.so",
];
/// The libraries that programs load by name when they link none.
const USUAL: &[&str] = &[
    "libGL.so.1",
    "libOpenGL.so.0",
    "libEGL.so.1",
    "libOSMesa.so.8",
];
/// The search stops after this many libraries; a browser has some three hundred.
const MAX_LIBRARIES: usize = 2000;

/// One OpenGL library.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct GlLibrary {
    /// The name by which the program asks for it.
    pub name: String,
    /// The file, if it exists.
    pub path: Option<PathBuf>,
    /// The program or library that links it. None if it would be loaded by name.
    pub linked_by: Option<String>,
}

/// The OpenGL libraries that `app` links, directly or through other libraries. Without `app`, those that programs of this class usually load by name.
#[must_use]
pub fn linked_gl(app: Option<&Path>, class: Class) -> Vec<GlLibrary> {
    let cache = Cache::read(class);
    let Some(app) = app else {
        let by_name = |name: &&str| GlLibrary {
            name: (*name).to_owned(),
            path: cache.find(name, &[]),
            linked_by: None,
        };
        return USUAL.iter().map(by_name).collect();
    };
    let mut found = Vec::new();
    let mut seen = HashSet::new();
    let mut queue = VecDeque::from([app.to_owned()]);
    while let Some(path) = queue.pop_front() {
        let Ok(Some(elf)) = Elf::open(&path) else {
            continue;
        };
        let origin = path
            .canonicalize()
            .ok()
            .and_then(|whole| whole.parent().map(Path::to_owned))
            .unwrap_or_default();
        let search: Vec<_> = elf
            .search
            .iter()
            .map(|folder| expand(folder, &origin))
            .collect();
        for name in elf.needed {
            if seen.len() >= MAX_LIBRARIES || !seen.insert(name.clone()) {
                continue;
            }
            let file = cache.find(&name, &search);
            if FAMILIES.iter().any(|family| name.starts_with(family)) {
                let by = path
                    .file_name()
                    .map(|file| file.to_string_lossy().into_owned());
                found.push(GlLibrary {
                    name,
                    path: file,
                    linked_by: by,
                });
            } else {
                queue.extend(file);
            }
        }
    }
    found
}

fn expand(folder: &str, origin: &Path) -> PathBuf {
    let origin = origin.to_string_lossy();
    PathBuf::from(
        folder
            .replace("${ORIGIN}", &origin)
            .replace("$ORIGIN", &origin),
    )
}

/// Where the loader searches: the folders of `LD_LIBRARY_PATH`, and its cache.
struct Cache {
    class: Class,
    folders: Vec<PathBuf>,
    files: HashMap<String, PathBuf>,
}

impl Cache {
    fn read(class: Class) -> Self {
        let folders = std::env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
        let printed = ["ldconfig", "/sbin/ldconfig"].iter().find_map(|program| {
            Command::new(program)
                .arg("-p")
                .output()
                .ok()
                .filter(|output| output.status.success())
        });
        let text = printed
            .map(|output| String::from_utf8_lossy(&output.stdout).into_owned())
            .unwrap_or_default();
        let folders = std::env::split_paths(&folders)
            .filter(|folder| folder != Path::new(""))
            .collect();
        Self {
            class,
            folders,
            files: parse(&text, class),
        }
    }

    /// Finds a library in the order of ld.so(8), but with `DT_RPATH` treated as `DT_RUNPATH`.
    fn find(&self, name: &str, search: &[PathBuf]) -> Option<PathBuf> {
        let folders = self.folders.iter().chain(search);
        let in_folder = folders
            .map(|folder| folder.join(name))
            .find(|path| has_class(path, self.class));
        in_folder.or_else(|| self.files.get(name).cloned())
    }
}

fn has_class(path: &Path, class: Class) -> bool {
    matches!(Elf::open(path), Ok(Some(elf)) if elf.class() == Some(class))
}

/// Parses lines such as `libGL.so.1 (libc6,x86-64) => /lib/x86_64-linux-gnu/libGL.so.1`. The first line for this machine and class counts; the cache names no machine
/// for 32 bits.
fn parse(text: &str, class: Class) -> HashMap<String, PathBuf> {
    let machine = match std::env::consts::ARCH {
        "x86_64" => "x86-64",
        "aarch64" => "AArch64",
        _ => "",
    };
    let mut files = HashMap::new();
    for line in text.lines() {
        let Some((left, path)) = line.trim().split_once(" => ") else {
            continue;
        };
        let Some((name, kind)) = left.split_once(" (") else {
            continue;
        };
        if kind.contains(machine) == (class == Class::Wide) {
            files
                .entry(name.to_owned())
                .or_insert_with(|| PathBuf::from(path));
        }
    }
    files
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(target_arch = "x86_64")]
    fn the_cache_lists_libraries_of_one_class() {
        let text = "2 libs found in cache\n\tlibGL.so.1 (libc6) => /lib32/libGL.so.1\n\tlibGL.so.1 (libc6,x86-64) => /lib/libGL.so.1\n";
        for (class, path) in [
            (Class::Wide, "/lib/libGL.so.1"),
            (Class::Narrow, "/lib32/libGL.so.1"),
        ] {
            let expected = HashMap::from([("libGL.so.1".to_owned(), PathBuf::from(path))]);
            assert_eq!(parse(text, class), expected);
        }
    }

    #[test]
    fn origin_is_expanded() {
        assert_eq!(
            expand("$ORIGIN/../lib", Path::new("/a/bin")),
            Path::new("/a/bin/../lib")
        );
    }
}
