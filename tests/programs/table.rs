//! Which programs: programs.toml.

use serde::Deserialize;
use std::collections::BTreeMap;

/// One program.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Program {
    /// Also of its folder in target/programs.
    pub(crate) name: String,
    /// Debian package.
    pub(crate) package: String,
    /// Program and arguments.
    pub(crate) command: Vec<String>,
    #[serde(default)]
    pub(crate) api: Api,
    /// What it draws with, in the words of the zoo.
    pub(crate) draws: String,
    /// How long it is recorded.
    #[serde(default = "seconds")]
    pub(crate) seconds: u64,
    /// At most so many frames.
    #[serde(default = "frames")]
    pub(crate) frames: u64,
    /// From the menu into the game.
    #[serde(default)]
    pub(crate) input: Vec<Input>,
    /// Variables.
    #[serde(default)]
    pub(crate) env: BTreeMap<String, String>,
    /// Whether it shows a scene with depth in the frames that are compared, so that its views have to differ.
    #[serde(default)]
    pub(crate) parallax: bool,
    /// Why it fails, if it does.
    pub(crate) known: Option<String>,
}

impl Program {
    /// Whether it brings shaders, which `geometry` leaves to replay and `instanced` draws.
    pub(crate) fn own_shaders(&self) -> bool {
        self.draws.contains("GLSL")
    }

    /// Whether a check of `row::CHECKS` is made.
    pub(crate) fn asks(&self, check: &str) -> bool {
        match check {
            "instanced" => self.own_shaders(),
            "parallax" => self.parallax,
            _ => true,
        }
    }

    /// The strategy that may draw most of it without replay.
    pub(crate) fn fast(&self) -> &'static str {
        match self.own_shaders() {
            true => "instanced",
            false => "geometry",
        }
    }
}

/// What a player does while the program runs.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Input {
    /// Seconds since the start; in the order of the list.
    pub(crate) after: f64,
    /// Arguments of xdotool.
    pub(crate) xdotool: String,
}

/// Where the context comes from.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub(crate) enum Api {
    #[default]
    Glx,
    Egl,
}

impl Api {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Glx => "GLX",
            Self::Egl => "EGL",
        }
    }

    /// apitrace's name of it.
    pub(crate) fn traced(self) -> &'static str {
        match self {
            Self::Glx => "gl",
            Self::Egl => "egl",
        }
    }

    /// What repeats a trace of it.
    pub(crate) fn retrace(self) -> &'static str {
        match self {
            Self::Glx => "glretrace",
            Self::Egl => "eglretrace",
        }
    }
}

fn seconds() -> u64 {
    10
}

fn frames() -> u64 {
    500
}

/// All of them, in the order of the file.
pub(crate) fn read() -> Vec<Program> {
    #[derive(Deserialize)]
    struct Table {
        program: Vec<Program>,
    }
    let table: Table = toml::from_str(include_str!("programs.toml")).expect("programs.toml");
    table.program
}
