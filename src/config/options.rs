//! The one table of options: each is an option of the command, a key of the TOML file and a `MANYVIEW_*` variable.
#![forbid(unsafe_code)]

use super::{osd, output, strategy};

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
    /// The picture that is shown.
    Output,
    /// The monitor of the panel's own window.
    Panel,
    /// How the picture is fitted to the panel.
    Fit,
    /// What the program's window shows while the panel has one of its own.
    WindowOutput,
    /// How a subpixel that lies between two views is coloured.
    Filter,
    /// κ
    EyeSpacing,
    /// ξ
    FocalDepth,
    /// Separation in clip space.
    Separation,
    /// Convergence in clip space.
    Convergence,
    /// Cameras by the depths of each frame.
    AutoDepth,
    /// How draws are repeated.
    Strategy,
    /// Where the views lie.
    Atlas,
    /// How views that lie side by side are clipped to their tiles.
    Clip,
    /// How disocclusions of synthesised views are shown.
    Holes,
    /// The programs that have the layer.
    Only,
    /// Programs that have it not.
    Except,
    /// How `splats` draws points.
    Splats,
    /// Which draws without perspective are sheared by their depths.
    Orthographic,
    /// Number of true views, from which the others are synthesised.
    TrueViews,
    /// Frames per second that the number of true views follows.
    Fps,
    /// The most frames per second.
    FpsCap,
    /// Tile size over window size.
    ViewScale,
    /// Parts of the on-screen display.
    Osd,
    /// Depth of flat draws.
    HudDepth,
    /// Optimisations that are turned off.
    Disable,
    /// Rules for the program.
    Profile,
    /// Folder of the profiles that come with the library.
    Profiles,
    /// Where one frame is explained.
    Explain,
    /// Which frame is explained.
    ExplainFrame,
    /// Every K-th frame is drawn by replay as well.
    Prove,
    /// JSON report.
    Report,
    /// A socket that takes commands for the running program.
    Control,
    /// Keys that change the views.
    Keys,
    /// Which keys these are.
    Bind,
    /// Cameras to choose from.
    Presets,
    /// How long the way to others takes.
    Ramp,
    /// Picture to write.
    CaptureOut,
    /// Frames to write.
    CaptureFrames,
    /// The content of the picture.
    CaptureWhat,
    /// Where the layer tells the launcher how far it is.
    Status,
    /// Where the programs of a launch claim paths.
    Launch,
    /// The socket of the panel's own window.
    PanelSocket,
    /// Folders of sockets.
    Sockets,
    /// Pixels of the panel without a window.
    PanelSize,
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

/// Which subcommands take an option on their command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Every subcommand that starts a program under the layer.
    Layer,
    /// `manyview capture` alone.
    Capture,
    /// None: the variable is set by the launcher, or by hand.
    Variable,
}

/// The spelling of an option in the version before. It is accepted for one version more, and whoever uses it is told.
#[derive(Clone, Copy, Debug, Default)]
pub struct Former {
    /// The flag.
    pub flag: Option<&'static str>,
    /// The key.
    pub key: Option<&'static str>,
    /// The variable.
    pub variable: Option<&'static str>,
    /// Words that the value may have, each with the present one.
    pub words: &'static [(&'static str, &'static str)],
}

impl Former {
    /// Nothing was called otherwise.
    const NONE: Self = Self {
        flag: None,
        key: None,
        variable: None,
        words: &[],
    };
}

/// One row of the table. More than 12 fields: the columns. Help texts, manual pages, the manual and the messages for wrong values come from it.
#[derive(Clone, Copy, Debug)]
pub struct OptionSpec {
    /// Which option.
    pub id: OptionId,
    /// Which subcommands have it.
    pub scope: Scope,
    /// Long option of the command, without the dashes.
    pub flag: Option<&'static str>,
    /// Another spelling of the flag.
    pub alias: Option<&'static str>,
    /// Key of the TOML file.
    pub key: Option<&'static str>,
    /// Environment variable.
    pub variable: &'static str,
    /// The value in help texts; empty for a switch, and where the choices are shown in its place.
    pub value: &'static str,
    /// The words that may be given, if they can be listed.
    pub choices: &'static [&'static str],
    /// Whether the value is a path.
    pub path: PathKind,
    /// The value that holds unless one is given, in words; empty where there is none.
    pub default: &'static str,
    /// One sentence for people, without its full stop.
    pub help: &'static str,
    /// What the manual adds, in Markdown; links are relative to `docs/`.
    pub manual: &'static str,
    /// What it was called.
    pub former: Former,
}

impl OptionSpec {
    /// A row of an option that every subcommand with the layer has, and that is a key of the file under the same name.
    const fn new(
        id: OptionId,
        flag: &'static str,
        variable: &'static str,
        value: &'static str,
        help: &'static str,
    ) -> Self {
        Self {
            id,
            scope: Scope::Layer,
            flag: Some(flag),
            alias: None,
            key: Some(flag),
            variable,
            value,
            choices: &[],
            path: PathKind::No,
            default: "",
            help,
            manual: "",
            former: Former::NONE,
        }
    }

    /// A row of a variable without option or key.
    const fn variable(
        id: OptionId,
        variable: &'static str,
        value: &'static str,
        help: &'static str,
    ) -> Self {
        let mut row = Self::new(id, "", variable, value, help);
        row.scope = Scope::Variable;
        row.flag = None;
        row.key = None;
        row
    }

    const fn choices(mut self, choices: &'static [&'static str]) -> Self {
        self.choices = choices;
        self
    }

    const fn default(mut self, default: &'static str) -> Self {
        self.default = default;
        self
    }

    const fn path(mut self, path: PathKind) -> Self {
        self.path = path;
        self
    }

    const fn manual(mut self, manual: &'static str) -> Self {
        self.manual = manual;
        self
    }

    /// An option of `capture` whose flag is not its key.
    const fn capture(mut self, key: &'static str) -> Self {
        self.scope = Scope::Capture;
        self.key = Some(key);
        self
    }

    const fn alias(mut self, alias: &'static str) -> Self {
        self.alias = Some(alias);
        self
    }

    const fn was(mut self, former: Former) -> Self {
        self.former = former;
        self
    }

    /// The option that no file can have: the file itself.
    const fn keyless(mut self) -> Self {
        self.key = None;
        self
    }

    /// A word of a value as it is called now.
    #[must_use]
    pub fn present_word<'a>(&self, word: &'a str) -> &'a str {
        let mut words = self.former.words.iter();
        words
            .find(|(old, _)| *old == word.trim())
            .map_or(word, |(_, new)| new)
    }

    /// How the value is written in help texts.
    #[must_use]
    pub fn value_name(&self) -> String {
        if self.value.is_empty() {
            self.choices.join("|")
        } else {
            self.value.to_owned()
        }
    }

    /// The variable, and the one that it was.
    pub fn variables(&self) -> impl Iterator<Item = &'static str> + use<> {
        [Some(self.variable), self.former.variable]
            .into_iter()
            .flatten()
    }

    /// The choices as a part of a sentence: "a, b and c", with another last word.
    #[must_use]
    pub fn listed(&self, last: &str) -> String {
        match self.choices {
            [] => String::new(),
            [only] => (*only).to_owned(),
            [most @ .., end] => format!("{} {last} {end}", most.join(", ")),
        }
    }

    /// The help of the command: the sentence, its choices where they are not the value's name, and the default.
    #[must_use]
    pub fn command_help(&self) -> String {
        let mut text = self.help.to_owned();
        if !self.value.is_empty() && !self.choices.is_empty() {
            text = format!("{text}: {}", self.listed("or"));
        }
        if !self.default.is_empty() {
            text = format!("{text} [default: {}]", self.default);
        }
        text
    }
}

/// Every option, in the order in which people read about them.
#[rustfmt::skip]
pub const OPTIONS: &[OptionSpec] = &[
    OptionSpec::new(OptionId::Display, "display", "MANYVIEW_DISPLAY", "NAME|FILE",
        "Panel: a built-in name (see `manyview displays`) or a panel file")
        .path(PathKind::NameOrFile).default("huebner8")
        .manual("`run` takes the panel that is set up or plugged in. See [Displays](displays.md)."),
    OptionSpec::new(OptionId::Views, "views", "MANYVIEW_VIEWS", "N",
        "Number of views, 1 to 256")
        .default("the panel's own"),
    OptionSpec::new(OptionId::Output, "output", "MANYVIEW_OUTPUT", "OUTPUT",
        "What the window shows")
        .choices(&output::WORDS)
        .default("panel").manual("See [Outputs](outputs.md)."),
    OptionSpec::new(OptionId::Panel, "panel", "MANYVIEW_PANEL", "MONITOR|auto",
        "Show the output in a window of its own over this monitor, by name or number; the program keeps its window (`run`, X11)")
        .manual("`auto` takes the panel's monitor. See [A window of the panel's own](outputs.md#a-window-of-the-panels-own)."),
    OptionSpec::new(OptionId::Fit, "fit", "MANYVIEW_FIT", "",
        "How the picture is fitted to a panel of another aspect (whole with black bars, cut off at its sides, or distorted), with --panel")
        .choices(&["contain", "cover", "stretch"]).default("contain"),
    OptionSpec::new(OptionId::WindowOutput, "window-output", "MANYVIEW_WINDOW_OUTPUT", "OUTPUT",
        "What the program's window shows, with --panel")
        .choices(&output::WINDOW_WORDS).default("own"),
    OptionSpec::new(OptionId::Filter, "filter", "MANYVIEW_FILTER", "FILTER",
        "How a subpixel that lies between two views is coloured")
        .choices(&["nearest", "blend", "gaussian"])
        .default("nearest").manual("`nearest` takes the nearest view. `blend` mixes two views by their distances. `gaussian` mixes three, which blurs double images."),
    OptionSpec::new(OptionId::EyeSpacing, "eye-spacing", "MANYVIEW_EYE_SPACING", "K",
        "Spacing of neighbouring viewpoints in the program's eye-space units; with --focal-depth")
        .manual("[Depth](depth.md) says where the cameras stand without it."),
    OptionSpec::new(OptionId::FocalDepth, "focal-depth", "MANYVIEW_FOCAL_DEPTH", "X",
        "Depth of zero parallax in the program's eye-space units; with --eye-spacing"),
    OptionSpec::new(OptionId::Separation, "separation", "MANYVIEW_SEPARATION", "S",
        "Shift of neighbouring views in clip space; with --convergence, in place of the two above"),
    OptionSpec::new(OptionId::Convergence, "convergence", "MANYVIEW_CONVERGENCE", "C",
        "Clip-space w of zero parallax; with --separation"),
    OptionSpec::new(OptionId::AutoDepth, "auto-depth", "MANYVIEW_AUTO_DEPTH", "",
        "Place the cameras by the depths of each frame, within the budget of the display, and keep one of the four values above if it is given")
        .default("1 unless two of them are given").manual("0 places them once, by the first projection. See [Depth](depth.md)."),
    OptionSpec::new(OptionId::Strategy, "strategy", "MANYVIEW_STRATEGY", "",
        "How draws are repeated per view")
        .choices(&strategy::WORDS)
        .default("auto").manual("See [Strategies](strategies.md)."),
    OptionSpec::new(OptionId::Atlas, "atlas", "MANYVIEW_ATLAS", "",
        "Where the views lie in memory")
        .choices(&["side-by-side", "layers"]).default("side-by-side"),
    OptionSpec::new(OptionId::Clip, "clip", "MANYVIEW_CLIP", "",
        "Put the views of `instanced` and `geometry` side by side, and clip each to its tile in this way")
        .choices(&["distances", "discard", "both", "cut"]).default("views lie in layers")
        .manual("By clip distances; by a fragment shader that discards; by that and a geometry shader that drops primitives outside; or by a geometry shader that cuts triangles."),
    OptionSpec::new(OptionId::Holes, "holes", "MANYVIEW_HOLES", "",
        "Fill disocclusions of synthesised views with their background, or mark them in magenta")
        .choices(&["fill", "mark"]).default("fill"),
    OptionSpec::new(OptionId::Splats, "splats", "MANYVIEW_SPLATS", "",
        "Draw points with --strategy splats as the program does, or as disks that close the gaps to their neighbours")
        .choices(&["exact", "surface"]).default("exact").manual("See [Points as surfaces](strategies.md#points-as-surfaces)."),
    OptionSpec::new(OptionId::TrueViews, "true-views", "MANYVIEW_TRUE_VIEWS", "K",
        "Views that --strategy hybrid draws; the others are synthesised")
        .default("as many as --fps leaves time for"),
    OptionSpec::new(OptionId::Fps, "fps", "MANYVIEW_FPS", "F",
        "Frames per second that --strategy hybrid holds by drawing fewer views")
        .default("60"),
    OptionSpec::new(OptionId::FpsCap, "fps-cap", "MANYVIEW_FPS_CAP", "F[:early|late]",
        "Frames per second that the program shows at most; it waits before a frame is shown (early) or after it (late)")
        .manual("`late`, unless given, follows input sooner; `early` makes the times between frames more equal."),
    OptionSpec::new(OptionId::ViewScale, "view-scale", "MANYVIEW_VIEW_SCALE", "F",
        "Size of a view over the size of the window, from 0.05 to 1, or auto: as finely as the output shows the view")
        .default("1"),
    OptionSpec::new(OptionId::Osd, "osd", "MANYVIEW_OSD", "WORDS",
        "What is written over the picture, words with commas between them")
        .choices(&osd::WORDS).default("values,warnings").manual("See [On-screen display](outputs.md#on-screen-display)."),
    OptionSpec::new(OptionId::HudDepth, "hud-depth", "MANYVIEW_HUD_DEPTH", "D|crosshair|cursor",
        "Where flat draws stand: 0 on the panel, 1 infinitely far, below 0 before it; or where the scene is in the middle or under the pointer")
        .default("0").manual("See [Profiles](profiles.md)."),
    OptionSpec::new(OptionId::Orthographic, "orthographic", "MANYVIEW_ORTHOGRAPHIC", "",
        "Which draws without perspective are moved by their depths: those of a scene, none, or all that are tested against depths")
        .choices(&["auto", "flat", "scene"]).default("auto").manual("See [Depth](depth.md)."),
    OptionSpec::new(OptionId::Disable, "disable", "MANYVIEW_DISABLE_OPTIMISATIONS", "NAME,…",
        "Optimisations to turn off, several by commas, to measure what they save")
        .choices(&["unseen", "mono", "lists", "uniforms", "frustum"])
        .manual("See [Optimisations](strategies.md#optimisations). `MANYVIEW_DISABLE` is another variable, which turns the whole layer off.")
        .was(Former { flag: Some("without"), key: Some("without"), variable: Some("MANYVIEW_WITHOUT"), words: &[("alike", "mono")] }),
    OptionSpec::new(OptionId::Profile, "profile", "MANYVIEW_PROFILE", "NAME|FILE|none",
        "Rules that say what draws are")
        .path(PathKind::ProfileOrFile).default("the profile that names the program").manual("See [Profiles](profiles.md)."),
    OptionSpec::new(OptionId::Only, "only", "MANYVIEW_ONLY", "NAME,…",
        "The programs that have the layer, of all that a launcher or a script starts")
        .default("all but known launchers, browsers and dialogues").manual("Names of files, such as `game.exe`; with Wine those of the Windows programs. See [Launchers](getting-started.md#launchers)."),
    OptionSpec::new(OptionId::Except, "except", "MANYVIEW_EXCEPT", "NAME,…",
        "Programs that run without the layer")
        .default("none besides known launchers, browsers and dialogues"),
    OptionSpec::new(OptionId::Explain, "explain", "MANYVIEW_EXPLAIN", "FOLDER|FILE",
        "Write what each draw of one frame is, and why, as PNG and text")
        .path(PathKind::File).manual("The files are `explain.png` and `explain.txt` in a folder that exists, else they have the file's name."),
    OptionSpec::new(OptionId::ExplainFrame, "explain-frame", "MANYVIEW_EXPLAIN_FRAME", "N",
        "Frame to explain, counted from 1")
        .default("30"),
    OptionSpec::new(OptionId::Prove, "prove", "MANYVIEW_PROVE", "K",
        "Draw every K-th frame by replay at the size of the window as well, and report the difference and the speed-up")
        .manual("See [Proof](proof-and-bench.md#proof)."),
    OptionSpec::new(OptionId::Report, "report", "MANYVIEW_REPORT", "FILE.json",
        "Write a JSON report of frames, draws and fallbacks")
        .path(PathKind::File),
    OptionSpec::new(OptionId::Control, "control", "MANYVIEW_CONTROL", "",
        "Let `manyview ctl` change the views while the program runs")
        .manual("See [Control](run-time-control.md#control)."),
    OptionSpec::new(OptionId::Keys, "keys", "MANYVIEW_KEYS", "",
        "Let keys with Ctrl+Alt change the views while the program runs (X11)")
        .manual("See [Keys](run-time-control.md#keys)."),
    OptionSpec::new(OptionId::Bind, "bind", "MANYVIEW_BIND", "KEY=ACTION,…",
        "Bind keys anew, such as F9=toggle,F10=hold:preset:1; turns keys on")
        .manual("See [Keys](run-time-control.md#keys)."),
    OptionSpec::new(OptionId::Presets, "presets", "MANYVIEW_PRESETS", "S:C,…",
        "Cameras to choose from while the program runs: separation and convergence, or auto")
        .manual("See [Presets](run-time-control.md#presets)."),
    OptionSpec::new(OptionId::Ramp, "ramp", "MANYVIEW_RAMP", "SECONDS",
        "How long the way to the cameras of a preset takes")
        .default("0.4"),
    OptionSpec::new(OptionId::Config, "config", "MANYVIEW_CONFIG", "FILE.toml",
        "Read options from a TOML file; variables and the command line win over it")
        .path(PathKind::File).keyless(),
    OptionSpec::new(OptionId::CaptureOut, "out", "MANYVIEW_CAPTURE_OUT", "PATH",
        "PNG to write; with several frames %d in it is the frame, else -000030 goes before the extension; the name of a quilt gets its columns, rows and aspect, such as _qs8x6a0.75, and goes to stdout")
        .capture("capture-out").path(PathKind::File).manual("See [Quilts](outputs.md#quilts) for `%q`."),
    OptionSpec::new(OptionId::CaptureFrames, "frames", "MANYVIEW_CAPTURE_FRAMES", "N|A..B",
        "Frames to write, counted from 1, both ends included")
        .capture("capture-frames").alias("frame").default("30"),
    OptionSpec::new(OptionId::CaptureWhat, "what", "MANYVIEW_CAPTURE_WHAT", "",
        "What a picture holds")
        .capture("capture-what").choices(&["output", "atlas", "view:I", "depth", "reference", "samples"]).default("output"),
    OptionSpec::variable(OptionId::Status, "MANYVIEW_STATUS", "FILE.json",
        "File in which the layer tells the launcher how many frames it has seen; set by `capture`, and for a proof by `run` and `bench`")
        .path(PathKind::File),
    OptionSpec::variable(OptionId::Launch, "MANYVIEW_LAUNCH", "FOLDER",
        "Folder in which the programs of one launch agree which of them writes to a path; set by the commands that start programs")
        .path(PathKind::File),
    OptionSpec::variable(OptionId::PanelSocket, "MANYVIEW_PANEL_SOCKET", "PATH",
        "Socket of the panel's window; set by `run`")
        .path(PathKind::File),
    OptionSpec::variable(OptionId::Sockets, "MANYVIEW_SOCKETS", "FOLDERS",
        "Folders with colons between, of which a program listens in the first that its container shows; set by `run`"),
    OptionSpec::variable(OptionId::PanelSize, "MANYVIEW_PANEL_SIZE", "WxH",
        "Pixels of the panel where no window is opened for it; set by `capture`"),
    OptionSpec::variable(OptionId::Profiles, "MANYVIEW_PROFILES", "FOLDER",
        "Folder in which profiles are found by name and by program, after `manyview/profiles` in `XDG_CONFIG_HOME` or `~/.config`")
        .path(PathKind::File).default("`profiles` beside `libmanyview.so`"),
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

#[cfg(test)]
mod tests {
    use super::super::{Config, Origin, Settings};
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_name_is_used_once() {
        let unique = |names: Vec<&str>| names.len() == names.iter().collect::<BTreeSet<_>>().len();
        assert!(
            unique(
                OPTIONS
                    .iter()
                    .flat_map(|o| [o.flag, o.alias, o.former.flag])
                    .flatten()
                    .collect()
            ),
            "flags"
        );
        assert!(
            unique(
                OPTIONS
                    .iter()
                    .flat_map(|o| [o.key, o.former.key])
                    .flatten()
                    .collect()
            ),
            "keys"
        );
        assert!(
            unique(
                OPTIONS
                    .iter()
                    .flat_map(|o| [Some(o.variable), o.former.variable])
                    .flatten()
                    .chain([DISABLE, LIBRARY])
                    .collect()
            ),
            "variables"
        );
    }

    #[test]
    fn what_a_row_lists_is_understood() {
        for row in OPTIONS {
            for choice in row.choices {
                let value = choice.replace("[:KIND]", ":red-cyan").replace(":I", ":0");
                let mut settings = Settings::default();
                settings.set(row.id, value, Origin::CommandLine);
                settings.set(OptionId::CaptureOut, "a.png", Origin::CommandLine);
                if matches!(row.id, OptionId::Fit | OptionId::WindowOutput) {
                    settings.set(OptionId::Panel, "auto", Origin::CommandLine);
                }
                if row.id == OptionId::Splats {
                    settings.set(OptionId::Strategy, "splats", Origin::CommandLine);
                }
                if *choice == "reference" || *choice == "samples" {
                    settings.set(OptionId::Strategy, "occlusion", Origin::CommandLine);
                }
                let config = Config::from_settings(&settings);
                config.unwrap_or_else(|error| panic!("{:?} {choice}: {error}", row.id));
            }
        }
    }

    #[test]
    fn a_row_that_lists_words_has_one_of_them_as_default_or_says_what_holds() {
        for row in OPTIONS.iter().filter(|row| !row.choices.is_empty()) {
            let listed = row.choices.contains(&row.default);
            let described = matches!(row.id, OptionId::Clip | OptionId::Disable | OptionId::Osd);
            assert_ne!(listed, described, "{:?}", row.id);
        }
    }

    #[test]
    fn help_is_a_sentence_without_its_stop() {
        for row in OPTIONS {
            let first = row.help.chars().next();
            assert!(first.is_some_and(char::is_uppercase), "{:?}", row.id);
            assert!(!row.help.ends_with('.'), "{:?}", row.id);
            assert!(
                row.manual.is_empty() || row.manual.ends_with('.'),
                "{:?}",
                row.id
            );
        }
    }

    #[test]
    fn every_row_finds_itself() {
        for row in OPTIONS {
            assert_eq!(row.id.spec().variable, row.variable);
        }
        assert_eq!(OPTIONS.len(), 47, "a new option needs a row");
    }
}
