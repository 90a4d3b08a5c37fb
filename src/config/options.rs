//! The one table of options: each is an option of the command, a key of the TOML file and a `MANYVIEW_*` variable.
#![forbid(unsafe_code)]

use std::fmt;
use std::path::PathBuf;

/// Turns the layer off when it is set to anything but nothing or `0`.
pub const DISABLE: &str = "MANYVIEW_DISABLE";
/// Path of the layer's library; read by the launcher only.
pub const LIBRARY: &str = "MANYVIEW_LIBRARY";

/// Names an option wherever it comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum OptionId {
    /// The TOML file with the other options.
    Config,
    /// Panel, by name or file.
    Display,
    /// Number of views.
    Views,
    /// What is given to the swap.
    Output,
    /// How a subpixel is made of the views around its place.
    Filter,
    /// κ
    EyeSpacing,
    /// ξ
    FocalDepth,
    /// Separation in clip space.
    Separation,
    /// Convergence in clip space.
    Convergence,
    /// Cameras by what is in the depth buffer.
    AutoDepth,
    /// How draws are repeated.
    Strategy,
    /// Where the views lie.
    Atlas,
    /// What keeps views beside each other apart.
    Clip,
    /// What is seen where nothing is known of what is behind.
    Holes,
    /// Views that are drawn while others are made of them.
    TrueViews,
    /// Frames per second that the number of views drawn follows.
    Fps,
    /// Tile size over window size.
    ViewScale,
    /// Depth of flat draws.
    HudDepth,
    /// What is not left out.
    Disable,
    /// Rules for the program.
    Profile,
    /// Folder of the profiles that come with the library.
    Profiles,
    /// Where one frame is explained.
    Explain,
    /// Which frame is explained.
    ExplainFrame,
    /// Every how many frames one is drawn by replay as well.
    Prove,
    /// JSON report.
    Report,
    /// A socket by which the running program is asked and told.
    Control,
    /// Keys that change the views.
    Keys,
    /// Picture to write.
    CaptureOut,
    /// Frames to write.
    CaptureFrames,
    /// What the picture holds.
    CaptureWhat,
    /// Where the layer tells the launcher how far it is.
    Status,
}

/// How a value that may be a path is made absolute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathKind {
    /// Not a path.
    No,
    /// Always a path.
    File,
    /// A path unless it is the name of a built-in panel.
    NameOrFile,
    /// A path unless it is the name of a profile.
    ProfileOrFile,
}

/// One row of the table.
#[derive(Clone, Copy, Debug)]
pub struct OptionSpec {
    /// Which option.
    pub id: OptionId,
    /// Long option of the command, without the dashes.
    pub flag: Option<&'static str>,
    /// Key of the TOML file.
    pub key: Option<&'static str>,
    /// Environment variable.
    pub variable: &'static str,
    /// How the value is written in help texts.
    pub value: &'static str,
    /// Whether the value is a path.
    pub path: PathKind,
    /// One line for people.
    pub help: &'static str,
}

macro_rules! option {
    ($id:ident, $flag:expr, $key:expr, $variable:literal, $value:literal, $path:ident, $help:literal) => {
        OptionSpec {
            id: OptionId::$id,
            flag: $flag,
            key: $key,
            variable: $variable,
            value: $value,
            path: PathKind::$path,
            help: $help,
        }
    };
}

/// Every option, in the order in which people read about them.
#[rustfmt::skip]
pub const OPTIONS: &[OptionSpec] = &[
    option!(Display, Some("display"), Some("display"), "MANYVIEW_DISPLAY", "NAME|FILE", NameOrFile,
        "panel: a built-in name or a panel file; huebner8 unless given"),
    option!(Views, Some("views"), Some("views"), "MANYVIEW_VIEWS", "N", No,
        "number of views, 1 to 256; the panel's own unless given"),
    option!(Output, Some("output"), Some("output"), "MANYVIEW_OUTPUT", "panel|quilt|sbs|half-sbs|tb|half-tb|rows|columns|checker|quad|rgbd|anaglyph[:KIND]|view:I", No,
        "what the window shows; panel unless given"),
    option!(Filter, Some("filter"), Some("filter"), "MANYVIEW_FILTER", "nearest|blend|gaussian", No,
        "what a subpixel between two views shows on the panel; nearest unless given"),
    option!(EyeSpacing, Some("eye-spacing"), Some("eye-spacing"), "MANYVIEW_EYE_SPACING", "K", No,
        "spacing of neighbouring viewpoints in eye-space units; with --focal-depth"),
    option!(FocalDepth, Some("focal-depth"), Some("focal-depth"), "MANYVIEW_FOCAL_DEPTH", "X", No,
        "depth of zero parallax in eye-space units; with --eye-spacing"),
    option!(Separation, Some("separation"), Some("separation"), "MANYVIEW_SEPARATION", "S", No,
        "shift of neighbouring views in clip space; with --convergence"),
    option!(Convergence, Some("convergence"), Some("convergence"), "MANYVIEW_CONVERGENCE", "C", No,
        "clip-space w of zero parallax; with --separation"),
    option!(AutoDepth, Some("auto-depth"), Some("auto-depth"), "MANYVIEW_AUTO_DEPTH", "0|1", No,
        "place the cameras by the depths of each frame, within what the display can show; one of the four values above may be given with it"),
    option!(Strategy, Some("strategy"), Some("strategy"), "MANYVIEW_STRATEGY", "auto|replay|instanced|geometry|depth-image|occlusion|hybrid", No,
        "how draws are repeated per view; auto unless given"),
    option!(Atlas, Some("atlas"), Some("atlas"), "MANYVIEW_ATLAS", "side-by-side|layers", No,
        "where the views lie in memory; side-by-side unless given"),
    option!(Clip, Some("clip"), Some("clip"), "MANYVIEW_CLIP", "distances|discard|both|cut", No,
        "put the views of instanced and geometry side by side, and keep them apart so; views lie in layers unless given"),
    option!(Holes, Some("holes"), Some("holes"), "MANYVIEW_HOLES", "fill|mark", No,
        "what synthesised views have where nothing is known: what is behind, or magenta; fill unless given"),
    option!(TrueViews, Some("true-views"), Some("true-views"), "MANYVIEW_TRUE_VIEWS", "K", No,
        "views that hybrid draws, the others are made of them; as many as --fps leaves time for unless given"),
    option!(Fps, Some("fps"), Some("fps"), "MANYVIEW_FPS", "F", No,
        "frames per second that hybrid holds by drawing fewer views; 60 unless given"),
    option!(ViewScale, Some("view-scale"), Some("view-scale"), "MANYVIEW_VIEW_SCALE", "F", No,
        "size of a view over that of the window, from 0.05 to 1, or auto: as much as the output shows; 1 unless given"),
    option!(HudDepth, Some("hud-depth"), Some("hud-depth"), "MANYVIEW_HUD_DEPTH", "D", No,
        "where flat draws stand: 0 on the panel, 1 infinitely far, below 0 before the panel; 0 unless given"),
    option!(Disable, Some("without"), Some("without"), "MANYVIEW_WITHOUT", "NAME,…", No,
        "do the work that is left out where a scene does not need it, to see what that saves: unseen, alike, lists, uniforms and frustum, by commas"),
    option!(Profile, Some("profile"), Some("profile"), "MANYVIEW_PROFILE", "NAME|FILE|none", ProfileOrFile,
        "rules that say what draws are; the profile that names the program unless given"),
    option!(Explain, Some("explain"), Some("explain"), "MANYVIEW_EXPLAIN", "FOLDER|FILE", File,
        "write what each draw of one frame is, and why, as PNG and text"),
    option!(ExplainFrame, Some("explain-frame"), Some("explain-frame"), "MANYVIEW_EXPLAIN_FRAME", "N", No,
        "frame to explain, counted from 1; 30 unless given"),
    option!(Prove, Some("prove"), Some("prove"), "MANYVIEW_PROVE", "K", No,
        "draw every K-th frame by replay at the size of the window as well, and tell how far the two are apart and how much time is saved"),
    option!(Report, Some("report"), Some("report"), "MANYVIEW_REPORT", "FILE.json", File,
        "write a JSON report of frames, draws and fallbacks"),
    option!(Control, Some("control"), Some("control"), "MANYVIEW_CONTROL", "0|1", No,
        "let `manyview ctl` change the views while the program runs; 0 unless given"),
    option!(Keys, Some("keys"), Some("keys"), "MANYVIEW_KEYS", "0|1", No,
        "let keys with Ctrl+Alt change the views while the program runs (X11); 0 unless given"),
    option!(Config, Some("config"), None, "MANYVIEW_CONFIG", "FILE.toml", File,
        "read options from a TOML file; variables and the command line win over it"),
    option!(CaptureOut, Some("out"), Some("capture-out"), "MANYVIEW_CAPTURE_OUT", "PATH", File,
        "PNG to write; with several frames %d in it is the frame, else -000030 goes before the extension"),
    option!(CaptureFrames, Some("frames"), Some("capture-frames"), "MANYVIEW_CAPTURE_FRAMES", "N|A..B", No,
        "frames to write, counted from 1, both ends included; 30 unless given"),
    option!(CaptureWhat, Some("what"), Some("capture-what"), "MANYVIEW_CAPTURE_WHAT", "output|atlas|view:I|depth|reference|samples", No,
        "what a picture holds; output unless given"),
    option!(Status, None, None, "MANYVIEW_STATUS", "FILE.json", File,
        "where the layer tells the launcher how many frames it has seen"),
    option!(Profiles, None, None, "MANYVIEW_PROFILES", "FOLDER", File,
        "folder of the profiles that --profile names; beside the library unless given"),
];

impl OptionId {
    /// The row of this option.
    #[must_use]
    pub fn spec(self) -> &'static OptionSpec {
        // Every variant has a row (tested); the fallback only keeps this total.
        OPTIONS
            .iter()
            .find(|spec| spec.id == self)
            .unwrap_or(&OPTIONS[0])
    }

    /// True for options that are on or off; in a TOML file they are truth values.
    #[must_use]
    pub fn is_switch(self) -> bool {
        matches!(self, Self::Control | Self::Keys | Self::AutoDepth)
    }

    /// True for the options that place the cameras: a source that sets one of them replaces them all.
    #[must_use]
    pub fn places_cameras(self) -> bool {
        matches!(
            self,
            Self::EyeSpacing
                | Self::FocalDepth
                | Self::Separation
                | Self::Convergence
                | Self::AutoDepth
        )
    }
}

/// Where a value comes from, the strongest first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A request to the running program.
    Request,
    /// An option of the command.
    CommandLine,
    /// An environment variable.
    Variable,
    /// A key of this TOML file.
    File(PathBuf),
    /// Nobody asked: the default.
    Default,
}

/// An option as its user wrote it: `--views`, `MANYVIEW_VIEWS` or `views in panel.toml`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Which option.
    pub id: OptionId,
    /// Where its value comes from.
    pub origin: Origin,
}

impl Field {
    /// The same kind of spelling for another option, to name the remedy.
    #[must_use]
    pub fn sibling(&self, id: OptionId) -> Self {
        Self {
            id,
            origin: self.origin.clone(),
        }
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let spec = self.id.spec();
        match (&self.origin, spec.flag, spec.key) {
            (Origin::Request, _, Some(key)) => f.write_str(key),
            (Origin::File(path), _, Some(key)) => write!(f, "{key} in {}", path.display()),
            (Origin::CommandLine | Origin::Default, Some(flag), _) => write!(f, "--{flag}"),
            _ => f.write_str(spec.variable),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_name_is_used_once() {
        let unique = |names: Vec<&str>| names.len() == names.iter().collect::<BTreeSet<_>>().len();
        assert!(
            unique(OPTIONS.iter().filter_map(|o| o.flag).collect()),
            "flags"
        );
        assert!(
            unique(OPTIONS.iter().filter_map(|o| o.key).collect()),
            "keys"
        );
        assert!(
            unique(OPTIONS.iter().map(|o| o.variable).collect()),
            "variables"
        );
    }

    #[test]
    fn every_row_finds_itself() {
        for row in OPTIONS {
            assert_eq!(row.id.spec().variable, row.variable);
        }
        assert_eq!(OPTIONS.len(), 31, "a new option needs a row");
    }
}
