//! Examines the environment of a program: the layer, the OpenGL libraries, and the contexts that these give.
//!
//! The helper `manyview-probe API` tries contexts in a process of its own, with the layer preloaded and a time limit. It
//! prints one line of JSON, a [`Probe`]. A driver that crashes ends only the helper.
#![forbid(unsafe_code)]

use super::elf::{Class, Elf};
use super::error::LaunchError;
use super::library::Libraries;
use super::linked::{GlLibrary, linked_gl};
use super::program::preload_value;
use super::ways::Way;
use super::xvfb::Xvfb;
use super::{library, preflight};
use crate::config::{self, OPTIONS};
pub use crate::layer::support::Probe;
use serde::Serialize;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const APIS: &[&str] = &["glx", "egl", "osmesa"];
const PROBE_LIMIT: Duration = Duration::from_secs(20);
/// Prefixes of hooked names. Where one is the beginning of another, the longer one comes first.
const FAMILIES: &[&str] = &["OSMesa", "glX", "egl", "gl", "dl"];

/// Everything that `manyview doctor` reports.
#[derive(Debug, Serialize)]
pub struct Findings {
    /// The program, if one was named.
    pub app: Option<PathBuf>,
    /// Its class; none for a script.
    pub class: Option<Class>,
    /// The layer's library for that class, else the one of 64 bits, or why there is none.
    pub library: Result<PathBuf, String>,
    /// The layer's library for 32-bit programs, if it is there.
    pub narrow: Option<PathBuf>,
    /// Number of hooked names by prefix.
    pub hooks: BTreeMap<String, usize>,
    /// The OpenGL libraries that the program would load.
    pub libraries: Vec<GlLibrary>,
    /// `DISPLAY`, if set.
    pub display: Option<String>,
    /// Whether the contexts were tried on an Xvfb of our own.
    pub own_screen: bool,
    /// Whether `MANYVIEW_DISABLE` keeps the layer out of every program.
    pub disabled: bool,
    /// The contexts that were tried.
    pub probes: Vec<Probe>,
    /// How the program reaches the screen.
    pub way: Way,
}

impl Findings {
    /// Gathers all findings. A program that cannot be started under the layer is an error.
    pub fn gather(command: &[OsString]) -> Result<Self, LaunchError> {
        let app = command.first().map(OsString::as_os_str);
        let (app, class) = app.map(preflight::check_app).transpose()?.unzip();
        let class = class.flatten();
        let libraries = library::find();
        if let (Some(app), Ok(libraries)) = (&app, &libraries) {
            preflight::check_class(app, class, libraries)?;
        }
        let library = libraries.as_ref().map(|found| {
            let of_class = class.and_then(|class| found.of(class));
            of_class.unwrap_or(found.main()).to_owned()
        });
        let hooks = library.as_deref().map(hooks).unwrap_or_default();
        let display = std::env::var("DISPLAY")
            .ok()
            .filter(|display| !display.is_empty());
        let helper = library::probe(class);
        let screen = (display.is_none() && helper.is_some())
            .then(Xvfb::start)
            .and_then(Result::ok);
        let probes = helper.map(|helper| {
            let probe = |api: &&str| probe(&helper, api, libraries.as_ref().ok(), screen.as_ref());
            APIS.iter().map(probe).collect()
        });
        let narrow = libraries
            .as_ref()
            .ok()
            .and_then(|found| found.of(Class::Narrow));
        Ok(Self {
            libraries: linked_gl(app.as_deref(), class.unwrap_or(Class::Wide)),
            narrow: narrow.map(Path::to_owned),
            library: library.map_err(|error| error.to_string()),
            class,
            hooks,
            display,
            own_screen: screen.is_some(),
            disabled: config::disabled(|name| std::env::var(name).ok()),
            probes: probes.unwrap_or_default(),
            way: Way::of(command, |name| std::env::var_os(name)),
            app,
        })
    }

    /// The reason why the layer cannot work here at all. None if it can.
    #[must_use]
    pub fn obstacle(&self) -> Option<String> {
        if let Err(reason) = &self.library {
            return Some(reason.clone());
        }
        let tried = !self.probes.is_empty();
        if tried && self.probes.iter().all(|probe| probe.error.is_some()) {
            return Some(LaunchError::NoOpenGl.to_string());
        }
        if tried && self.probes.iter().all(|probe| probe.strategies.is_empty()) {
            return Some("no OpenGL here can be shown in several views".to_owned());
        }
        let linked = self
            .libraries
            .iter()
            .filter(|library| library.linked_by.is_some());
        let missing = linked.into_iter().find(|library| library.path.is_none());
        missing.map(|library| format!("{} is linked but not installed", library.name))
    }
}

/// Counts the hooked names that the library exports, by prefix.
fn hooks(library: &Path) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    let exports = Elf::open(library)
        .ok()
        .flatten()
        .map(|elf| elf.exports)
        .unwrap_or_default();
    for name in exports {
        if let Some(family) = FAMILIES.iter().find(|family| name.starts_with(**family)) {
            *counts.entry(format!("{family}*")).or_insert(0) += 1;
        }
    }
    counts
}

/// Tries one API with the layer at its defaults, whatever the caller's variables are.
fn probe(helper: &Path, api: &str, libraries: Option<&Libraries>, screen: Option<&Xvfb>) -> Probe {
    let mut command = Command::new(helper);
    command.arg(api).env_remove(config::DISABLE);
    for option in OPTIONS {
        for name in option.variables() {
            command.env_remove(name);
        }
    }
    if let Some(libraries) = libraries {
        command.env("LD_PRELOAD", preload_value(libraries));
    }
    if let Some(screen) = screen {
        command.env("DISPLAY", screen.display());
    }
    answer(command).unwrap_or_else(|error| Probe {
        api: api.to_owned(),
        error: Some(error),
        ..Probe::default()
    })
}

/// Runs the helper to its end and parses its last line.
fn answer(mut command: Command) -> Result<Probe, String> {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null());
    let mut child = command.spawn().map_err(|error| error.to_string())?;
    let limit = Instant::now() + PROBE_LIMIT;
    let status = loop {
        match child.try_wait() {
            Ok(Some(status)) => break status,
            Ok(None) if Instant::now() < limit => std::thread::sleep(Duration::from_millis(10)),
            _ => {
                let _ = child.kill();
                let _ = child.wait();
                return Err(format!("no answer within {} s", PROBE_LIMIT.as_secs()));
            }
        }
    };
    let mut text = String::new();
    if let Some(mut pipe) = child.stdout.take() {
        pipe.read_to_string(&mut text)
            .map_err(|error| error.to_string())?;
    }
    let line = text.lines().next_back().unwrap_or_default();
    serde_json::from_str(line).map_err(|_| format!("the probe ended without an answer ({status})"))
}
