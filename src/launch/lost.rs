//! Programs of a launch that draw by OpenGL and do not have the layer: a script has taken it from their environment, or their container does not show it.
#![forbid(unsafe_code)]

use super::elf::{Class, Elf};
use super::library::Libraries;
use crate::config::LIBRARY_FILE;
use std::collections::{HashMap, HashSet};
use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Libraries by which programs draw.
const DRAWING: [&str; 4] = ["/libGL.so", "/libGLX.so", "/libEGL.so", "/libOSMesa.so"];
/// The first looks, which are near each other, and the pause between the later ones.
const NEAR: u32 = 30;
const PAUSES: [Duration; 2] = [Duration::from_secs(1), Duration::from_secs(10)];

/// Looks at the processes that come from one.
#[derive(Debug)]
pub(super) struct Lost {
    root: u32,
    libraries: Libraries,
    /// Processes that were without the layer at the last look: they may be about to load it.
    seen: HashSet<u32>,
    told: HashSet<PathBuf>,
    looks: u32,
}

/// A process as /proc has it.
#[derive(Debug)]
struct Process {
    parent: u32,
    name: String,
}

impl Lost {
    /// For the process that was started.
    pub(super) fn new(root: u32, libraries: Libraries) -> Self {
        Lost {
            root,
            libraries,
            seen: HashSet::new(),
            told: HashSet::new(),
            looks: 0,
        }
    }

    /// Until the next look.
    pub(super) fn pause(&self) -> Duration {
        PAUSES[usize::from(self.looks >= NEAR)]
    }

    /// A sentence for each program that is found for the first time.
    pub(super) fn look(&mut self) -> Vec<String> {
        self.looks = self.looks.saturating_add(1);
        let all = processes();
        let mut sentences = Vec::new();
        let mut bare = HashSet::new();
        for (&number, process) in &all {
            if !comes_from(&all, number, self.root) || !draws_bare(number) {
                continue;
            }
            bare.insert(number);
            if !self.seen.contains(&number) {
                continue;
            }
            let path = fs::read_link(format!("/proc/{number}/exe")).unwrap_or_default();
            if self.told.insert(path.clone()) {
                let why = self.reason(&all, number, process, &path);
                sentences.push(format!(
                    "{} (process {number}) draws by OpenGL without the layer: {why}",
                    process.name
                ));
            }
        }
        self.seen = bare;
        sentences
    }

    fn reason(
        &self,
        all: &HashMap<u32, Process>,
        number: u32,
        process: &Process,
        path: &Path,
    ) -> String {
        let inside = PathBuf::from(format!("/proc/{number}/root"));
        let within = inside.join(path.strip_prefix("/").unwrap_or(path));
        let class = Elf::open(&within)
            .ok()
            .flatten()
            .and_then(|elf| elf.class());
        if class == Some(Class::Narrow) && self.libraries.of(Class::Narrow).is_none() {
            return "it is a 32-bit program and the layer's library for those is not there (`make build-32` makes it)".to_owned();
        }
        if !has_preload(number) {
            let parent = all.get(&process.parent);
            let by = parent.map_or("what started it", |parent| &parent.name);
            return format!(
                "LD_PRELOAD was taken from its environment; have {by} keep it, or put `manyview run --` before the program there"
            );
        }
        let library = self.libraries.main();
        if fs::metadata(inside.join(library.strip_prefix("/").unwrap_or(library))).is_err() {
            return format!(
                "its container does not show {}; give it that folder",
                library.parent().unwrap_or(library).display()
            );
        }
        "the loader ignores LD_PRELOAD there, as it does for setuid programs; put a copy in its place, which `cp` makes without that".to_owned()
    }
}

/// The processes of this system that can be looked at.
fn processes() -> HashMap<u32, Process> {
    let entries = fs::read_dir("/proc").into_iter().flatten().flatten();
    let numbers = entries.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    numbers
        .filter_map(|number: u32| {
            let text = fs::read_to_string(format!("/proc/{number}/stat")).ok()?;
            Some((number, stat(&text)?))
        })
        .collect()
}

/// proc(5): number (name) state parent …; the name may have brackets.
fn stat(text: &str) -> Option<Process> {
    let (first, rest) = text.rsplit_once(')')?;
    let (_, name) = first.split_once('(')?;
    let parent = rest.split_whitespace().nth(1)?.parse().ok()?;
    Some(Process {
        parent,
        name: name.to_owned(),
    })
}

fn comes_from(all: &HashMap<u32, Process>, mut number: u32, root: u32) -> bool {
    // No chain is longer than there are processes.
    for _ in 0..=all.len() {
        if number == root {
            return true;
        }
        match all.get(&number) {
            Some(process) => number = process.parent,
            None => return false,
        }
    }
    false
}

/// Whether a process has a library of OpenGL and not the layer.
fn draws_bare(number: u32) -> bool {
    let Ok(maps) = fs::read_to_string(format!("/proc/{number}/maps")) else {
        return false;
    };
    DRAWING.iter().any(|name| maps.contains(name)) && !maps.contains(LIBRARY_FILE)
}

fn has_preload(number: u32) -> bool {
    let environment = fs::read(format!("/proc/{number}/environ")).unwrap_or_default();
    let mut variables = environment.split(|&byte| byte == 0);
    variables.any(|variable| {
        let value = variable.strip_prefix(b"LD_PRELOAD=").map(OsStr::from_bytes);
        value.is_some_and(|value| value.to_string_lossy().contains(LIBRARY_FILE))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_process_is_known_by_its_line_whatever_its_name() {
        let process = stat("4711 (a) b (c)) S 12 4711 4711 0 -1 4194304").expect("a process");
        assert_eq!((process.parent, &*process.name), (12, "a) b (c)"));
        assert!(stat("").is_none() && stat("1 (x) S").is_none());
        let own = processes();
        let me = std::process::id();
        let parent = own.get(&me).expect("this process").parent;
        assert!(comes_from(&own, me, parent) && comes_from(&own, me, me));
        assert!(!comes_from(&own, parent, me));
    }
}
