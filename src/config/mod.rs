//! What the user asked for: options of the command line, keys of the TOML file and `MANYVIEW_*` variables.
#![forbid(unsafe_code)]

mod bindings;
mod cameras;
mod capture;
mod choice;
mod class;
mod error;
mod explain;
mod field;
mod file;
mod flat_depth;
mod frame_cap;
mod live;
mod options;
mod osd;
mod output;
pub mod panel;
mod panel_window;
mod parse;
pub mod profile;
#[cfg(test)]
mod profile_tests;
pub mod profile_text;
pub mod program;
mod replace;
mod settings;
mod status;
mod strategy;
#[cfg(test)]
mod tests;
mod words;

pub use bindings::{Action, Binding, Bindings, Modifiers, Presets};
pub use capture::{Capture, CaptureWhat};
pub use class::{Class, DepthRange, DepthState, OrthographicDraws, Projection, Viewport, Word};
pub use error::ConfigError;
pub use explain::Explain;
pub use field::{Field, Origin, Renaming};
pub use file::user_folder;
pub use flat_depth::FlatDepth;
pub use frame_cap::FrameCap;
pub use live::{Knob, Live};
pub use options::{DISABLE, Former, LIBRARY, OPTIONS, OptionId, OptionSpec, PathKind, Scope};
pub use osd::{OsdPart, OsdParts};
pub use output::{Anaglyph, Glasses, Interlace, Mixture, Output};
pub use panel_window::{AUTO, PanelWindow};
pub use profile::{Profile, Rule};
pub use replace::{replace, replace_by};
pub use settings::{Setting, Settings};
pub use status::Status;
pub use strategy::{DisocclusionSource, Repetition, Strategy, TrueViews};

use crate::display::Display;
use std::path::{Path, PathBuf};

/// The largest number of views anyone may ask for; the driver may allow fewer.
pub const MAX_VIEWS: u32 = 256;

/// The name of the library, whatever its folder.
pub const LIBRARY_FILE: &str = "libmanyview.so";

/// Everything the layer needs to know before the first frame. More than 12 fields: about one for each row of [`options::OPTIONS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// Number of views N, at least 1.
    pub views: u32,
    /// The panel whose mask the pictures are interleaved for.
    pub display: Display,
    /// The picture that is shown.
    pub output: Output,
    /// How a subpixel of the panel that lies between two views is coloured.
    pub filter: Filter,
    /// Spacing of the cameras and the depth of zero parallax.
    pub camera: Camera,
    /// How draws are repeated per view.
    pub strategy: Strategy,
    /// Where the views lie in memory.
    pub atlas: AtlasLayout,
    /// How views that one draw puts side by side are clipped to their tiles; unless given, they lie in layers.
    pub clip: Option<Clip>,
    /// How many views `hybrid` draws; the others are synthesised from them.
    pub true_views: TrueViews,
    /// Which draws without perspective are sheared by their depths.
    pub orthographic: OrthographicDraws,
    /// Which programs of a launch have the layer.
    pub chosen: program::Chosen,
    /// Points under `splats` are disks of a surface.
    pub surfaces: bool,
    /// Holes of synthesised views are magenta.
    pub marks_holes: bool,
    /// The most frames per second, if the user wants a limit.
    pub fps_cap: Option<FrameCap>,
    /// Size of a tile over the size of the window.
    pub view_scale: ViewScale,
    /// Parts of the on-screen display.
    pub osd: OsdParts,
    /// Where flat draws stand that no rule places: 0 on the panel, 1 infinitely far; a fraction of the separation at infinity.
    pub hud_depth: Option<FlatDepth>,
    /// Optimisations that are turned off.
    pub disabled: Disabled,
    /// Rules for the classes of the program's draws.
    pub profile: Profile,
    /// Folders in which profiles are found, the user's own first; none where the user wants no profile.
    pub profiles: Vec<PathBuf>,
    /// One frame to explain, if any.
    pub explain: Option<Explain>,
    /// Every K-th frame is drawn by replay as well and compared; none: no frame is.
    pub prove: Option<u64>,
    /// Where the JSON report goes at the end of the program.
    pub report: Option<PathBuf>,
    /// The running program takes commands from a socket.
    pub control: bool,
    /// Keys change the views.
    pub keys: bool,
    /// Which keys these are.
    pub bindings: Bindings,
    /// Cameras to choose from while the program runs.
    pub presets: Presets,
    /// Pictures to write, if any.
    pub capture: Option<Capture>,
    /// Where the layer tells the launcher how far it is, if the launcher asked.
    pub status: Option<PathBuf>,
    /// The folder in which the programs of one launch claim paths, if the launcher has made one; see [`crate::claim`].
    pub launch: Option<PathBuf>,
    /// Folders in which the program may listen; see [`crate::control::place`].
    pub sockets: Vec<PathBuf>,
    /// The panel's own window, if the user wants one.
    pub panel: Option<PanelWindow>,
    /// Former names that somebody used, to be told.
    pub renamings: Vec<Renaming>,
}

impl Config {
    /// Reads the `MANYVIEW_*` variables through `lookup`, the TOML file that they name, and the profile for this process's program.
    pub fn from_env(lookup: impl Fn(&str) -> Option<String>) -> Result<Self, ConfigError> {
        let mut settings = Settings::from_env(&lookup)?;
        let preloads = lookup("LD_PRELOAD").unwrap_or_default();
        let items = preloads.split([':', ' ']).map(Path::new);
        let named = items.into_iter().find(|path| path.ends_with(LIBRARY_FILE));
        settings.find_profiles(mapped_library().as_deref().or(named));
        let mut config = Self::from_settings(&settings)?;
        config.choose_profile(&settings, program::this_program());
        Ok(config)
    }

    /// Without `--profile`, takes the profile that names the program.
    pub fn choose_profile(&mut self, settings: &Settings, program: Option<String>) {
        if settings.get(OptionId::Profile).is_none()
            && let Some(program) = program
            && let Some(profile) = Profile::automatic(&self.profiles, &program)
        {
            self.profile = profile;
        }
    }
}

/// The file of the layer's library in this process, links followed: LD_PRELOAD may name a link, or hold `$LIB`.
fn mapped_library() -> Option<PathBuf> {
    let maps = std::fs::read_to_string("/proc/self/maps").ok()?;
    let mut files = maps
        .lines()
        .filter_map(|line| Some(Path::new(&line[line.find('/')?..])));
    let library = files.find(|path| path.ends_with(LIBRARY_FILE));
    library.map(Path::to_owned)
}

/// True if [`DISABLE`] turns the layer off; then no other variable is read.
pub fn disabled(lookup: impl Fn(&str) -> Option<String>) -> bool {
    lookup(DISABLE).is_some_and(|value| !value.is_empty() && value != "0")
}

/// How a subpixel of a lens sheet is coloured. As a rule its place lies between two views.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// The view it belongs to.
    Nearest,
    /// The two views beside its place, by their distances.
    Blend,
    /// Three views by a Gaussian: points that move too far from view to view are blurred, not seen twice.
    Gaussian,
}

/// Where the cameras stand. Lengths are in the program's eye-space units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Camera {
    /// Derived from the first perspective projection that is drawn with.
    Auto,
    /// Derived from the depths of each frame, within the budget of the display, except for a value that is kept.
    Measured(Option<Kept>),
    /// κ and ξ of Luo et al.: spacing of neighbouring viewpoints, depth of the focal plane.
    Eye {
        /// κ
        spacing: f64,
        /// ξ, positive
        focal_depth: f64,
    },
    /// Shift of neighbouring views in clip space: `x += separation · (i − (N−1)/2) · (w − convergence)`.
    Clip {
        /// Per neighbouring view, in units of normalised device coordinates.
        separation: f64,
        /// In units of clip-space w.
        convergence: f64,
    },
}

/// One value of the cameras that the user has chosen. Lengths are in the program's eye-space units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kept {
    /// As in [`Camera::Clip`].
    Separation(f64),
    /// As in [`Camera::Clip`].
    Convergence(f64),
    /// κ
    EyeSpacing(f64),
    /// ξ, positive
    FocalDepth(f64),
}

/// Work that the layer leaves out where a scene does not need it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Optimisation {
    /// Views that no subpixel shows are not drawn.
    Unseen,
    /// Frames that are the same in all views are drawn once.
    MonoFrames,
    /// The driver copies many vertices between glBegin and glEnd once, not once per view.
    Lists,
    /// Uniforms that have their value are not sent again.
    Uniforms,
    /// Triangles are not drawn in views whose frustum none of them touches, where positions are known.
    Frustum,
}

impl Optimisation {
    /// All of them, with their names.
    pub const ALL: [(&str, Optimisation); 5] = [
        ("unseen", Optimisation::Unseen),
        ("mono", Optimisation::MonoFrames),
        ("lists", Optimisation::Lists),
        ("uniforms", Optimisation::Uniforms),
        ("frustum", Optimisation::Frustum),
    ];
}

/// The optimisations that are turned off, to measure them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Disabled(u8);

impl Disabled {
    /// Whether an optimisation is turned off.
    #[must_use]
    pub fn has(self, optimisation: Optimisation) -> bool {
        self.0 >> (optimisation as u8) & 1 != 0
    }
}

impl FromIterator<Optimisation> for Disabled {
    fn from_iter<I: IntoIterator<Item = Optimisation>>(optimisations: I) -> Self {
        let bits = optimisations
            .into_iter()
            .map(|optimisation| 1 << (optimisation as u8));
        Disabled(bits.fold(0, |all, bit| all | bit))
    }
}

/// How finely views are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ViewScale {
    /// Size of a tile over the size of the window, in (0, 1].
    Fixed(f64),
    /// As finely as the output shows a view.
    Auto,
}

/// How a view is clipped to its tile. All but the first are variants of F. de Sorbier et al.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Clip {
    /// Two clip distances per vertex: the driver cuts.
    #[default]
    Distances,
    /// The fragment shader discards fragments outside; the vertex stage passes it the limits.
    Discard,
    /// Likewise, after the geometry shader has dropped the primitives that lie outside as a whole. With instances the same as
    /// [`Clip::Discard`].
    Both,
    /// The geometry shader cuts triangles at the edges of the tile. With instances the same as [`Clip::Distances`].
    Cut,
}

/// Where the views lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtlasLayout {
    /// Tiles of one 2D texture, in a row or a grid.
    SideBySide,
    /// One layer of an array texture per view.
    Layers,
}
