//! From written options to a [`Config`]; every value is checked here and nowhere else.
#![forbid(unsafe_code)]

use super::cameras;
use super::choice::{choice, choices, switch};
use super::error::ConfigError;
use super::field::{Field, Origin};
use super::flat_depth::FlatDepth;
use super::options::OptionId;
use super::output::{GLASSES, OUTPUTS};
use super::settings::Settings;
use super::strategy::STRATEGIES;
use super::{
    Anaglyph, AtlasLayout, Bindings, Capture, CaptureWhat, Clip, Config, Disabled, Explain, Filter,
    FrameCap, MAX_VIEWS, Mixture, Optimisation, OrthographicDraws, OsdParts, Output, PanelWindow,
    Presets, Profile, Strategy, TrueViews, ViewScale, panel, profile, program,
};
use crate::display::{Display, Kind, MAX_FINE_VIEWS, MaskError};
use std::path::PathBuf;

const DEFAULT_FRAME: u64 = 30;

impl Config {
    /// Understands every option; the first one that is wrong is the error.
    pub fn from_settings(settings: &Settings) -> Result<Self, ConfigError> {
        let display = display(settings)?;
        let output = output(settings, &display)?;
        let views = views(settings, &display, output)?;
        check_output(settings, OptionId::Output, output, views)?;
        let strategy = strategy(settings)?;
        let presets = Presets::of(settings)?;
        Ok(Self {
            views,
            output,
            filter: filter(settings, views, &display)?,
            camera: cameras::camera(settings)?,
            strategy,
            true_views: true_views(settings, strategy, views)?,
            atlas: choice(settings, OptionId::Atlas, ATLASES)?.unwrap_or(AtlasLayout::SideBySide),
            clip: choice(settings, OptionId::Clip, CLIPS)?,
            marks_holes: choice(settings, OptionId::Holes, HOLES)?.unwrap_or(false),
            chosen: program::Chosen::of(settings)?,
            surfaces: surfaces(settings, strategy)?,
            orthographic: choice(settings, OptionId::Orthographic, ORTHOGRAPHIC)?
                .unwrap_or_default(),
            fps_cap: FrameCap::from_settings(settings)?,
            view_scale: view_scale(settings)?,
            osd: osd(settings)?.unwrap_or_default(),
            hud_depth: hud_depth(settings)?,
            disabled: disabled(settings)?,
            profile: named_profile(settings)?,
            profiles: profile_folders(settings),
            explain: explain(settings, views)?,
            prove: prove(settings, views)?,
            report: path(settings, OptionId::Report),
            control: changes(settings, OptionId::Control, views)?,
            keys: changes(settings, OptionId::Keys, views)?
                || settings.get(OptionId::Bind).is_some(),
            bindings: Bindings::of(settings, presets.cameras.len())?,
            presets,
            capture: capture(settings, views)?,
            status: path(settings, OptionId::Status),
            launch: path(settings, OptionId::Launch),
            sockets: settings
                .get(OptionId::Sockets)
                .map(|setting| std::env::split_paths(&setting.value).collect())
                .unwrap_or_default(),
            panel: PanelWindow::from_settings(settings, views, (&display, output))?,
            renamings: settings.renamings().to_vec(),
            display,
        })
    }
}

const HOLES: &[(&str, bool)] = &[("fill", false), ("mark", true)];

const SPLATS: &[(&str, bool)] = &[("exact", false), ("surface", true)];

const ORTHOGRAPHIC: &[(&str, OrthographicDraws)] = &[
    ("auto", OrthographicDraws::Auto),
    ("flat", OrthographicDraws::Flat),
    ("scene", OrthographicDraws::Scene),
];

const CLIPS: &[(&str, Clip)] = &[
    ("distances", Clip::Distances),
    ("discard", Clip::Discard),
    ("both", Clip::Both),
    ("cut", Clip::Cut),
];

const ATLASES: &[(&str, AtlasLayout)] = &[
    ("side-by-side", AtlasLayout::SideBySide),
    ("layers", AtlasLayout::Layers),
];

fn disabled(settings: &Settings) -> Result<Disabled, ConfigError> {
    let Some((field, value)) = settings.field(OptionId::Disable) else {
        return Ok(Disabled::default());
    };
    let named = |name: &str| {
        let known = Optimisation::ALL
            .iter()
            .find(|(known, _)| *known == name.trim());
        known.map(|(_, optimisation)| *optimisation)
    };
    let disabled: Option<Disabled> = value.split(',').map(named).collect();
    disabled.ok_or_else(|| ConfigError::Choice {
        choices: choices(field.id),
        field,
        value: value.to_owned(),
    })
}

fn display(settings: &Settings) -> Result<Display, ConfigError> {
    let (field, value) = display_field(settings);
    panel::load(value).map_err(|reason| ConfigError::Display { field, reason })
}

fn display_field(settings: &Settings) -> (Field, &str) {
    let default = Field {
        id: OptionId::Display,
        origin: Origin::Default,
    };
    settings
        .field(OptionId::Display)
        .unwrap_or((default, panel::DEFAULT))
}

fn views(settings: &Settings, display: &Display, output: Output) -> Result<u32, ConfigError> {
    let given = settings.field(OptionId::Views);
    let (field, text) = match given {
        Some((field, value)) => (field, value.to_owned()),
        None => {
            let views = match output {
                // The program's own view is enough.
                Output::Rgbd => 1,
                _ if output.is_stereo() => 2,
                _ => display.views,
            };
            let field = display_field(settings).0.sibling(OptionId::Views);
            (field, views.to_string())
        }
    };
    let views = match text.parse() {
        Ok(views) if (1..=MAX_VIEWS).contains(&views) => views,
        _ => return Err(ConfigError::Views { field, value: text }),
    };
    // Other outputs do not show the display's mask.
    if output == Output::Panel {
        panel::check_views(display, views)
            .map_err(|reason| ConfigError::Display { field, reason })?;
    }
    Ok(views)
}

/// An output for views that are there.
pub(super) fn output_of(
    settings: &Settings,
    display: &Display,
    views: u32,
) -> Result<Output, ConfigError> {
    let output = output(settings, display)?;
    if output == Output::Panel
        && let Some((field, _)) = settings.field(OptionId::Output)
    {
        panel::check_views(display, views)
            .map_err(|reason| ConfigError::Display { field, reason })?;
    }
    check_output(settings, OptionId::Output, output, views)?;
    Ok(output)
}

/// The output as it is written; whether a single view is there is looked at when the number of views is known.
fn output(settings: &Settings, display: &Display) -> Result<Output, ConfigError> {
    let Some((field, value)) = settings.field(OptionId::Output) else {
        return Ok(match display.kind {
            Kind::Uncalibrated => Output::Quilt,
            _ => Output::Panel,
        });
    };
    if value == "panel" {
        let reason = |error: MaskError| ConfigError::Display {
            field,
            reason: error.to_string(),
        };
        return display.check_mask().map(|()| Output::Panel).map_err(reason);
    }
    written(&field, value)
}

/// The output that a word names; whether a single view is there is not looked at.
pub(super) fn written(field: &Field, value: &str) -> Result<Output, ConfigError> {
    if let Some((_, output)) = OUTPUTS.iter().find(|(name, _)| *name == value) {
        return Ok(*output);
    }
    if let Some(anaglyph) = anaglyph(value) {
        return Ok(Output::Anaglyph(anaglyph));
    }
    one_view(field, value, MAX_VIEWS).map(Output::View)
}

/// `anaglyph`, `anaglyph:GLASSES` or `anaglyph:GLASSES-MIXTURE`.
fn anaglyph(value: &str) -> Option<Anaglyph> {
    let kind = match value.strip_prefix("anaglyph")? {
        "" => GLASSES[0].0,
        kind => kind.strip_prefix(':')?,
    };
    GLASSES.into_iter().find_map(|(name, glasses)| {
        let mixture = match kind.strip_prefix(name)? {
            "" => Mixture::Dubois,
            "-half" => Mixture::HalfColour,
            "-grey" => Mixture::Grey,
            _ => return None,
        };
        Some(Anaglyph { glasses, mixture })
    })
}

/// Refuses a single view that is not there, and two eyes where there is one view.
pub(super) fn check_output(
    settings: &Settings,
    id: OptionId,
    output: Output,
    views: u32,
) -> Result<(), ConfigError> {
    let Some((field, value)) = settings.field(id) else {
        return Ok(());
    };
    match output {
        Output::View(_) => one_view(&field, value, views).map(drop),
        _ if output.is_stereo() && views < 2 => Err(ConfigError::OneEye { field }),
        _ => Ok(()),
    }
}

fn filter(settings: &Settings, views: u32, display: &Display) -> Result<Filter, ConfigError> {
    const FILTERS: &[(&str, Filter)] = &[
        ("nearest", Filter::Nearest),
        ("blend", Filter::Blend),
        ("gaussian", Filter::Gaussian),
    ];
    let filter = choice(settings, OptionId::Filter, FILTERS)?.unwrap_or(Filter::Nearest);
    match settings.field(OptionId::Filter) {
        Some((field, _)) if filter != Filter::Nearest && views > MAX_FINE_VIEWS => {
            Err(ConfigError::Fine { field, views })
        }
        Some((field, _)) if filter != Filter::Nearest && matches!(display.kind, Kind::Wall(_)) => {
            Err(ConfigError::WallFilter { field })
        }
        _ => Ok(filter),
    }
}

/// The I of `view:I`.
fn one_view(field: &Field, value: &str, views: u32) -> Result<u32, ConfigError> {
    let Some(view) = value
        .strip_prefix("view:")
        .and_then(|index| index.parse().ok())
    else {
        return Err(ConfigError::Choice {
            field: field.clone(),
            value: value.to_owned(),
            choices: choices(field.id),
        });
    };
    if view >= views {
        return Err(ConfigError::ViewOutOfRange {
            field: field.clone(),
            view,
            views,
        });
    }
    Ok(view)
}

/// Of a view over the window.
const SMALLEST_SCALE: f64 = 0.05;

fn view_scale(settings: &Settings) -> Result<ViewScale, ConfigError> {
    let Some((field, value)) = settings.field(OptionId::ViewScale) else {
        return Ok(ViewScale::Fixed(1.0));
    };
    match (value, value.parse::<f64>()) {
        ("auto", _) => Ok(ViewScale::Auto),
        (_, Ok(scale)) if (SMALLEST_SCALE..=1.0).contains(&scale) => Ok(ViewScale::Fixed(scale)),
        _ => Err(ConfigError::ViewScale {
            field,
            value: value.to_owned(),
        }),
    }
}

pub(super) fn hud_depth(settings: &Settings) -> Result<Option<FlatDepth>, ConfigError> {
    let Some((field, value)) = settings.field(OptionId::HudDepth) else {
        return Ok(None);
    };
    match FlatDepth::of(value) {
        Some(depth) => Ok(Some(depth)),
        None => Err(ConfigError::HudDepth {
            field,
            value: value.to_owned(),
        }),
    }
}

pub(super) fn osd(settings: &Settings) -> Result<Option<OsdParts>, ConfigError> {
    let Some((field, value)) = settings.field(OptionId::Osd) else {
        return Ok(None);
    };
    match OsdParts::of(value) {
        Some(parts) => Ok(Some(parts)),
        None => Err(ConfigError::Choice {
            choices: choices(field.id),
            field,
            value: value.to_owned(),
        }),
    }
}

fn profile_folders(settings: &Settings) -> Vec<PathBuf> {
    let wanted = settings.get(OptionId::Profile);
    if wanted.is_some_and(|setting| setting.value == profile::NONE) {
        return Vec::new();
    }
    let with_library = settings.get(OptionId::Profiles);
    let with_library = with_library.map(|setting| PathBuf::from(&setting.value));
    profile::users().into_iter().chain(with_library).collect()
}

fn named_profile(settings: &Settings) -> Result<Profile, ConfigError> {
    let Some((field, value)) = settings.field(OptionId::Profile) else {
        return Ok(Profile::default());
    };
    if value == profile::NONE {
        return Ok(Profile::default());
    }
    Profile::named(&profile_folders(settings), value)
        .map_err(|reason| ConfigError::Profile { field, reason })
}

fn explain(settings: &Settings, views: u32) -> Result<Option<Explain>, ConfigError> {
    let frame = settings.field(OptionId::ExplainFrame);
    let Some((out, value)) = settings.field(OptionId::Explain) else {
        return match frame {
            None => Ok(None),
            Some((field, value)) => Err(ConfigError::FrameWithoutExplain {
                explain: field.sibling(OptionId::Explain),
                field,
                value: value.to_owned(),
            }),
        };
    };
    let value = value.to_owned();
    if views < 2 {
        return Err(ConfigError::OneView { field: out, value });
    }
    let frame = match frame {
        None => DEFAULT_FRAME,
        Some((field, text)) => match frame_range(text) {
            Some((first, last)) if first == last => first,
            _ => {
                return Err(ConfigError::Frame {
                    field,
                    value: text.to_owned(),
                });
            }
        },
    };
    Ok(Some(Explain {
        out: PathBuf::from(value),
        frame,
    }))
}

fn prove(settings: &Settings, views: u32) -> Result<Option<u64>, ConfigError> {
    let Some((field, text)) = settings.field(OptionId::Prove) else {
        return Ok(None);
    };
    let value = text.to_owned();
    if views < 2 {
        return Err(ConfigError::OneView { field, value });
    }
    match text.parse() {
        Ok(every) if every > 0 => Ok(Some(every)),
        _ => Err(ConfigError::Prove { field, value }),
    }
}

/// Lets the views change while the program runs; nothing of one view can change.
fn changes(settings: &Settings, id: OptionId, views: u32) -> Result<bool, ConfigError> {
    match settings.field(id) {
        Some((field, value)) if views < 2 && value == "1" => Err(ConfigError::OneView {
            field,
            value: value.to_owned(),
        }),
        _ => switch(settings, id),
    }
}

pub(super) fn path(settings: &Settings, id: OptionId) -> Option<PathBuf> {
    settings
        .get(id)
        .map(|setting| PathBuf::from(&setting.value))
}

fn capture(settings: &Settings, views: u32) -> Result<Option<Capture>, ConfigError> {
    let frames = settings.field(OptionId::CaptureFrames);
    let what = settings.field(OptionId::CaptureWhat);
    let Some(out) = path(settings, OptionId::CaptureOut) else {
        return match frames.or(what) {
            None => Ok(None),
            Some((field, value)) => Err(ConfigError::CaptureWithoutOut {
                out: field.sibling(OptionId::CaptureOut),
                field,
                value: value.to_owned(),
            }),
        };
    };
    let (first, last) = match frames {
        None => (DEFAULT_FRAME, DEFAULT_FRAME),
        Some((field, value)) => frame_range(value).ok_or_else(|| ConfigError::Frames {
            field,
            value: value.to_owned(),
        })?,
    };
    let occlusion = settings
        .get(OptionId::Strategy)
        .is_some_and(|s| s.value == "occlusion");
    let held = capture_what(settings, views)?;
    if let (CaptureWhat::Reference | CaptureWhat::Samples, Some((field, value))) = (held, what)
        && (first < 2 || !occlusion)
    {
        return Err(ConfigError::NoReference {
            field,
            value: value.to_owned(),
        });
    }
    Ok(Some(Capture {
        out,
        first,
        last,
        what: held,
    }))
}

/// The content of a picture.
pub(super) fn capture_what(settings: &Settings, views: u32) -> Result<CaptureWhat, ConfigError> {
    Ok(match settings.field(OptionId::CaptureWhat) {
        None | Some((_, "output")) => CaptureWhat::Output,
        Some((_, "atlas")) => CaptureWhat::Atlas,
        Some((_, "depth")) => CaptureWhat::Depth,
        Some((_, "reference")) => CaptureWhat::Reference,
        Some((_, "samples")) => CaptureWhat::Samples,
        Some((field, value)) => CaptureWhat::View(one_view(&field, value, views)?),
    })
}

/// `30` or `30..40`, both ends included, counted from 1.
fn frame_range(text: &str) -> Option<(u64, u64)> {
    let (first, last) = text.split_once("..").unwrap_or((text, text));
    let (first, last) = (first.parse().ok()?, last.parse().ok()?);
    (1 <= first && first <= last).then_some((first, last))
}

/// Frames per second unless others are asked for: the rate of most screens.
const RATE: f64 = 60.0;

fn strategy(settings: &Settings) -> Result<Strategy, ConfigError> {
    let given = choice(settings, OptionId::Strategy, STRATEGIES)?;
    Ok(given.unwrap_or(Strategy::Auto))
}

fn surfaces(settings: &Settings, strategy: Strategy) -> Result<bool, ConfigError> {
    let wanted = choice(settings, OptionId::Splats, SPLATS)?.unwrap_or(false);
    match settings.field(OptionId::Splats) {
        Some((field, _)) if wanted && strategy != Strategy::Splats => {
            Err(ConfigError::OtherStrategy {
                remedy: field.sibling(OptionId::Strategy),
                field,
                strategy: "splats",
            })
        }
        Some((field, _)) if wanted => match settings.field(OptionId::Prove) {
            Some((proof, _)) => Err(ConfigError::ProvedSurfaces { field, proof }),
            None => Ok(wanted),
        },
        _ => Ok(wanted),
    }
}

fn true_views(
    settings: &Settings,
    strategy: Strategy,
    views: u32,
) -> Result<TrueViews, ConfigError> {
    let count = settings.field(OptionId::TrueViews);
    let rate = settings.field(OptionId::Fps);
    let given = count.as_ref().or(rate.as_ref()).map(|(field, _)| field);
    if let (Some(field), false) = (given, strategy == Strategy::Hybrid) {
        return Err(ConfigError::OtherStrategy {
            field: field.clone(),
            strategy: "hybrid",
            remedy: field.sibling(OptionId::Strategy),
        });
    }
    match (count, rate) {
        (Some((count, _)), Some((rate, _))) => Err(ConfigError::TrueViewsAndRate { count, rate }),
        (Some((field, value)), None) => match value.parse() {
            Ok(count) if (1..=views).contains(&count) => Ok(TrueViews::Fixed(count)),
            _ => Err(ConfigError::TrueViews {
                field,
                value: value.to_owned(),
                views,
            }),
        },
        (None, Some((field, value))) => match value.parse() {
            Ok(rate) if (1.0..=1000.0).contains(&rate) => Ok(TrueViews::Rate(rate)),
            _ => Err(ConfigError::Rate {
                field,
                value: value.to_owned(),
            }),
        },
        (None, None) => Ok(TrueViews::Rate(RATE)),
    }
}
