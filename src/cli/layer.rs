//! The options of the layer, the same for every subcommand that starts a program.
#![forbid(unsafe_code)]

use clap::Args;
use manyview::config::{ConfigError, OptionId, Origin, Settings};

/// Values stay as they are written: [`manyview::config`] understands them, wherever they come from.
#[derive(Args, Default)]
#[command(next_help_heading = "Layer")]
pub(crate) struct LayerArguments {
    /// Panel: a built-in name (see `manyview displays`) or a panel file [default: huebner8]
    #[arg(long, value_name = "NAME|FILE")]
    display: Option<String>,
    /// Number of views, 1 to 256 [default: the panel's own]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    views: Option<String>,
    /// What the window shows: panel, quilt, sbs, half-sbs, tb, half-tb, rows, columns, checker, quad, rgbd, anaglyph[:KIND] or view:I [default: panel]
    #[arg(long, value_name = "OUTPUT")]
    output: Option<String>,
    /// What a subpixel between two views shows on the panel: nearest, blend or gaussian [default: nearest]
    #[arg(long, value_name = "FILTER")]
    filter: Option<String>,
    /// Spacing of neighbouring viewpoints in eye-space units; with --focal-depth
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    eye_spacing: Option<String>,
    /// Depth of zero parallax in eye-space units; with --eye-spacing
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    focal_depth: Option<String>,
    /// Shift of neighbouring views in clip space; with --convergence
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    separation: Option<String>,
    /// Clip-space w of zero parallax; with --separation
    #[arg(long, value_name = "C", allow_hyphen_values = true)]
    convergence: Option<String>,
    /// Place the cameras by the depths of each frame, within what the display can show; one of the four values above may be given with it
    #[arg(long)]
    auto_depth: bool,
    /// How draws are repeated per view [default: auto]
    #[arg(
        long,
        value_name = "auto|replay|instanced|geometry|depth-image|occlusion|hybrid"
    )]
    strategy: Option<String>,
    /// Where the views lie in memory [default: side-by-side]
    #[arg(long, value_name = "side-by-side|layers")]
    atlas: Option<String>,
    /// Put the views of instanced and geometry side by side, and keep them apart so [default: views lie in layers]
    #[arg(long, value_name = "distances|discard|both|cut")]
    clip: Option<String>,
    /// What synthesised views have where nothing is known: what is behind, or magenta [default: fill]
    #[arg(long, value_name = "fill|mark")]
    holes: Option<String>,
    /// Views that --strategy hybrid draws, the others are made of them [default: as many as --fps leaves time for]
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    true_views: Option<String>,
    /// Frames per second that --strategy hybrid holds by drawing fewer views [default: 60]
    #[arg(long, value_name = "F", allow_hyphen_values = true)]
    fps: Option<String>,
    /// Size of a view over the size of the window, above 0 and at most 1 [default: 1]
    #[arg(long, value_name = "F", allow_hyphen_values = true)]
    view_scale: Option<String>,
    /// Where flat draws stand: 0 on the panel, 1 infinitely far, below 0 before the panel [default: 0]
    #[arg(long, value_name = "D", allow_hyphen_values = true)]
    hud_depth: Option<String>,
    /// Do the work that is left out where a scene does not need it, to see what that saves
    #[arg(long, value_name = "unseen|alike|lists|uniforms|frustum,…")]
    without: Option<String>,
    /// Rules that say what draws are [default: the profile that names the program]
    #[arg(long, value_name = "NAME|FILE|none")]
    profile: Option<String>,
    /// Write what each draw of one frame is, and why, as PNG and text
    #[arg(long, value_name = "FOLDER|FILE")]
    explain: Option<String>,
    /// Frame to explain, counted from 1 [default: 30]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    explain_frame: Option<String>,
    /// Draw every K-th frame by replay at the size of the window as well, and tell how far the two are apart and how much time is saved
    #[arg(long, value_name = "K", allow_hyphen_values = true)]
    prove: Option<String>,
    /// Write a JSON report of frames, draws and fallbacks
    #[arg(long, value_name = "FILE.json")]
    report: Option<String>,
    /// Let `manyview ctl` change the views while the program runs
    #[arg(long)]
    control: bool,
    /// Let keys with Ctrl+Alt change the views while the program runs (X11)
    #[arg(long)]
    keys: bool,
    /// Read options from a TOML file; variables and the command line win over it
    #[arg(long, value_name = "FILE.toml")]
    config: Option<String>,
}

impl LayerArguments {
    /// These options over the variables over the TOML file.
    pub(crate) fn settings(&self) -> Result<Settings, ConfigError> {
        let given = [
            (OptionId::Display, &self.display),
            (OptionId::Views, &self.views),
            (OptionId::Output, &self.output),
            (OptionId::Filter, &self.filter),
            (OptionId::EyeSpacing, &self.eye_spacing),
            (OptionId::FocalDepth, &self.focal_depth),
            (OptionId::Separation, &self.separation),
            (OptionId::Convergence, &self.convergence),
            (OptionId::Strategy, &self.strategy),
            (OptionId::Atlas, &self.atlas),
            (OptionId::Clip, &self.clip),
            (OptionId::Holes, &self.holes),
            (OptionId::TrueViews, &self.true_views),
            (OptionId::Fps, &self.fps),
            (OptionId::ViewScale, &self.view_scale),
            (OptionId::HudDepth, &self.hud_depth),
            (OptionId::Disable, &self.without),
            (OptionId::Profile, &self.profile),
            (OptionId::Explain, &self.explain),
            (OptionId::ExplainFrame, &self.explain_frame),
            (OptionId::Prove, &self.prove),
            (OptionId::Report, &self.report),
            (OptionId::Config, &self.config),
        ];
        let mut settings = Settings::default();
        settings.give(given);
        for (id, on) in [
            (OptionId::AutoDepth, self.auto_depth),
            (OptionId::Control, self.control),
            (OptionId::Keys, self.keys),
        ] {
            if on {
                settings.set(id, "1", Origin::CommandLine);
            }
        }
        settings
            .over(Settings::from_variables(variable))
            .with_file()
    }
}

/// A variable as text; what is not text turns into a value that the checks refuse by name.
pub(super) fn variable(name: &str) -> Option<String> {
    std::env::var_os(name).map(|value| value.to_string_lossy().into_owned())
}
