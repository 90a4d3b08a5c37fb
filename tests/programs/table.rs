//! The programs of programs.toml.

use crate::programs::cloud;
use crate::support::play::Input;
use serde::Deserialize;
use std::collections::BTreeMap;

/// One program.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Program {
    /// The program's name, and that of its folder in target/programs.
    pub(crate) name: String,
    /// Debian package.
    pub(crate) package: String,
    /// Program and arguments. `{cloud}` is the path of a point cloud, without its ending (see [`crate::programs::cloud`]).
    pub(crate) command: Vec<String>,
    #[serde(default)]
    pub(crate) api: Api,
    /// The means by which it draws, in the words of the page.
    pub(crate) draws: String,
    /// Seconds of the recording.
    #[serde(default = "seconds")]
    pub(crate) seconds: u64,
    /// Largest number of frames.
    #[serde(default = "frames")]
    pub(crate) frames: u64,
    /// Input that leads from the menu into the game.
    #[serde(default)]
    pub(crate) input: Vec<Input>,
    /// Variables of its environment.
    #[serde(default)]
    pub(crate) env: BTreeMap<String, String>,
    /// Width and height of its screen in pixels, where that has to be the mode that the program asks for.
    pub(crate) screen: Option<(u16, u16)>,
    /// Whether the compared frames show a scene with depth, so that the views have to differ.
    #[serde(default)]
    pub(crate) parallax: bool,
    /// Whether what it draws is points, most of all, which `splats` draws.
    #[serde(default)]
    pub(crate) points: bool,
    /// Why it fails, if it does.
    pub(crate) known: Option<String>,
    /// What it draws is another scene in each recording, so that it fails in some and passes in others.
    #[serde(default)]
    pub(crate) varies: bool,
}

impl Program {
    /// Whether it has shaders of its own, which `geometry` leaves to replay and `instanced` draws.
    pub(crate) fn own_shaders(&self) -> bool {
        self.draws.contains("GLSL")
    }

    /// Whether a check of `row::CHECKS` applies.
    pub(crate) fn asks(&self, check: &str) -> bool {
        match check {
            "instanced" => self.own_shaders(),
            "splats" | "splats over replay" => self.points,
            "parallax" => self.parallax,
            _ => true,
        }
    }

    /// The strategy that may draw most of it without replay.
    pub(crate) fn fast(&self) -> &'static str {
        match self.own_shaders() {
            _ if self.points => "splats",
            true => "instanced",
            false => "geometry",
        }
    }
}

/// The API that the context comes from.
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

    /// apitrace's name of the API.
    pub(crate) fn traced(self) -> &'static str {
        match self {
            Self::Glx => "gl",
            Self::Egl => "egl",
        }
    }

    /// The command that repeats a trace of it.
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
    let mut table: Table = toml::from_str(include_str!("programs.toml")).expect("programs.toml");
    let cloud = cloud::stem().display().to_string();
    for argument in table
        .program
        .iter_mut()
        .flat_map(|program| &mut program.command)
    {
        *argument = argument.replace("{cloud}", &cloud);
    }
    table.program
}
