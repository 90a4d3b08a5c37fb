//! Runs `ffcheck` and parses its output.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The result of one case: a line of `ffcheck`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Difference {
    pub(crate) worst: u64,
    pub(crate) over1: u64,
    pub(crate) over8: u64,
    pub(crate) differ: u64,
    pub(crate) coverage: u64,
    pub(crate) covered: u64,
    pub(crate) pixels: u64,
    /// Sum of the squared differences of red, green and blue.
    pub(crate) squares: u64,
}

impl Difference {
    pub(crate) fn parse(line: &str) -> Option<(usize, Self)> {
        let mut words = line.split(' ');
        let number = words.next()?.parse().ok()?;
        let mut found = Self::default();
        for word in words {
            let (name, value) = word.split_once('=')?;
            let value = value.parse().ok()?;
            match name {
                "worst" => found.worst = value,
                "over1" => found.over1 = value,
                "over8" => found.over8 = value,
                "differ" => found.differ = value,
                "coverage" => found.coverage = value,
                "covered" => found.covered = value,
                "pixels" => found.pixels = value,
                "squares" => found.squares = value,
                _ => return None,
            }
        }
        Some((number, found))
    }

    pub(crate) fn add(&mut self, other: Self) {
        self.worst = self.worst.max(other.worst);
        self.over1 += other.over1;
        self.over8 += other.over8;
        self.differ += other.differ;
        self.coverage += other.coverage;
        self.covered += other.covered;
        self.pixels += other.pixels;
        self.squares += other.squares;
    }
}

/// Builds `ffcheck`, again when its source is newer.
fn build() -> PathBuf {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixed/ffcheck.c");
    let binary = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ffcheck");
    let time = |path: &Path| path.metadata().and_then(|data| data.modified()).ok();
    if time(&binary).is_none_or(|built| time(&source).is_none_or(|written| written > built)) {
        // Another test may build it at the same time.
        let fresh = binary.with_extension(std::process::id().to_string());
        let status = Command::new("cc")
            .args(["-std=c11", "-D_GNU_SOURCE", "-O1", "-Wall", "-Wextra", "-o"])
            .args([&fresh, &source])
            .args(["-lEGL", "-lGL", "-lm"])
            .status()
            .expect("cc runs");
        assert!(
            status.success(),
            "ffcheck does not compile: are the headers of EGL and OpenGL installed?"
        );
        std::fs::rename(&fresh, &binary).expect("the folder can be written");
    }
    binary
}

/// Draws the first `count` cases of a folder; returns the results by number of the case, and `ffcheck`'s line about the driver.
pub(crate) fn run(folder: &Path, count: usize) -> (Vec<(usize, Difference)>, String) {
    let mut command = Command::new(build());
    command.arg(folder).arg(count.to_string());
    command
        .env("LIBGL_ALWAYS_SOFTWARE", "1")
        .env("GALLIUM_DRIVER", "llvmpipe")
        .env_remove("LD_PRELOAD");
    let output = command.output().expect("ffcheck runs");
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "ffcheck failed:\n{errors}");
    let text = String::from_utf8_lossy(&output.stdout);
    let lines = text
        .lines()
        .map(|line| Difference::parse(line).unwrap_or_else(|| panic!("ffcheck said: {line}")))
        .collect();
    (lines, errors)
}
