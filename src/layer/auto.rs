//! `--strategy auto`: drives a [`Trial`] with the frames of the program, and keeps the outcome for the next start.

use super::Layer;
use crate::bounded;
use crate::config::{Config, Strategy, replace};
use crate::gl::{Gl, consts as c};
use crate::plan::Trial;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The trial of a context, and the time at which its last frame was done.
#[derive(Debug)]
pub(super) struct Auto {
    trial: Trial,
    last: Option<Instant>,
    /// The key of the outcome: the driver, the program and the number of views, which it depends on.
    key: String,
    /// The file of outcomes; none where there is no place for it.
    file: Option<PathBuf>,
}

/// Number of outcomes at which the file is begun anew.
const KEPT: usize = 1000;
/// Bytes of the file of outcomes; a larger one is not ours, and is begun anew.
const MOST_BYTES: u64 = 1 << 20;

impl Auto {
    /// None where the user has chosen a strategy, or there is one view. Frames that are captured or explained have to be the same in each
    /// run, so such a run uses replay alone.
    pub(super) fn new(
        gl: &Gl,
        config: &Config,
        program: Option<&str>,
        all: &[Strategy],
    ) -> Option<Auto> {
        if config.strategy != Strategy::Auto || config.views < 2 {
            return None;
        }
        let key = format!(
            "{} | {} | {} | {} views",
            gl.get_string(c::RENDERER),
            gl.get_string(c::VERSION),
            program.unwrap_or("?"),
            config.views
        );
        let file = file();
        let known = read(file.as_deref())
            .get(&key)
            .and_then(|name| Strategy::named(name));
        let repeatable = config.capture.is_some() || config.explain.is_some();
        let candidates = match known {
            _ if repeatable => vec![Strategy::Replay],
            // A proof is of one strategy, so no other is tried.
            _ if config.prove.is_some() => vec![known.unwrap_or(Strategy::Replay)],
            _ => all.to_vec(),
        };
        Some(Auto {
            trial: Trial::new(candidates, known),
            last: None,
            key,
            file,
        })
    }

    pub(super) fn strategy(&self) -> Strategy {
        self.trial.strategy()
    }
}

impl Layer {
    /// After a frame was drawn into the true framebuffer 0: counts its time, and may choose another strategy for the next one.
    pub(super) fn time_frame(&mut self, gl: &Gl) {
        // The accumulation buffer and the front buffer do not move with the views: while there is one, no other strategy is tried.
        if !self.targets.back_alone() {
            return;
        }
        let mono = self.is_mono();
        let Some(auto) = &mut self.session.auto else {
            return;
        };
        if auto.trial.measures() {
            gl.finish();
        }
        let now = Instant::now();
        let Some(last) = auto.last.replace(now) else {
            return;
        };
        // All strategies draw a mono frame alike.
        if mono {
            return;
        }
        let ms = now.duration_since(last).as_secs_f32() * 1e3;
        let made = self.frame.take_amplified();
        if let Some(found) = auto.trial.frame(ms, made) {
            keep(auto.file.as_deref(), &auto.key, found);
            self.diagnostics
                .report
                .note(format!("auto: {found} is the fastest here"));
        }
        let next = auto.trial.strategy();
        if next != self.session.strategy && !self.diagnostics.proving.replays() {
            self.session.strategy = next;
            self.remake(gl);
        }
    }
}

/// Path of the file of outcomes, in the cache folder of the environment; none where that is not set to an absolute path.
fn file() -> Option<PathBuf> {
    let folder = |name: &str| {
        std::env::var_os(name)
            .filter(|value| !value.is_empty())
            .map(PathBuf::from)
    };
    let cache = folder("XDG_CACHE_HOME").or_else(|| Some(folder("HOME")?.join(".cache")))?;
    cache
        .is_absolute()
        .then(|| cache.join("manyview").join("strategies.json"))
}

/// Strategies by key; empty where the file cannot be read.
fn read(file: Option<&Path>) -> BTreeMap<String, String> {
    let text = file.and_then(|file| bounded::text(file, MOST_BYTES).ok());
    text.and_then(|text| serde_json::from_str(&text).ok())
        .unwrap_or_default()
}

/// Adds an outcome to the file, for the next start. If it cannot be written, the next start tries again.
fn keep(file: Option<&Path>, key: &str, found: Strategy) {
    let Some(file) = file else { return };
    let mut all = read(Some(file));
    if all.len() >= KEPT {
        all.clear();
    }
    all.insert(key.to_owned(), found.to_string());
    let Ok(text) = serde_json::to_string_pretty(&all) else {
        return;
    };
    let folder = file.parent().map(std::fs::create_dir_all);
    if matches!(folder, Some(Ok(()))) {
        // Without the file, the next start tries again.
        let _ = replace(file, text.as_bytes());
    }
}
