//! What the window shows.
#![forbid(unsafe_code)]

use super::words::words;
use std::fmt;

/// The picture that is shown. Those for two eyes show the first view to the left and the last one to the right eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// Interleaved through the mask of the display.
    Panel,
    /// All views in one row, view 0 on the left; `half`: in the width of one.
    SideBySide {
        /// Pictures squeezed to the size of one.
        half: bool,
    },
    /// All views in one column, view 0 on top; `half`: in the height of one.
    TopBottom {
        /// Pictures squeezed to the size of one.
        half: bool,
    },
    /// The Looking Glass order: view 0 bottom left, rows upwards.
    Quilt,
    /// Two eyes, interlaced by pixels of the screen.
    Interlaced(Interlace),
    /// Two eyes, through coloured glasses.
    Anaglyph(Anaglyph),
    /// Two eyes, each with its own buffer of a stereo window.
    Quad,
    /// The program's own view on the left, how near it is as grey on the right.
    Rgbd,
    /// One view.
    View(u32),
}

impl Output {
    /// Its pixels have to be those of the monitor: another size mixes up the views.
    #[must_use]
    pub fn is_interlaced(self) -> bool {
        matches!(self, Self::Panel | Self::Interlaced(_))
    }

    /// It shows two eyes, whatever the display.
    #[must_use]
    pub fn is_stereo(self) -> bool {
        match self {
            Self::Interlaced(_) | Self::Anaglyph(_) | Self::Quad | Self::TopBottom { .. } => true,
            Self::SideBySide { half } => half,
            Self::Panel | Self::Quilt | Self::Rgbd | Self::View(_) => false,
        }
    }
}

/// Which pixels of the screen the left eye has; counted from the left top corner, the first one is its.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interlace {
    /// Every other row.
    Rows,
    /// Every other column.
    Columns,
    /// The dark fields.
    Checkerboard,
}

impl Interlace {
    /// The display that has this pattern.
    #[must_use]
    pub fn display(self) -> &'static str {
        match self {
            Self::Rows => "rows",
            Self::Columns => "columns",
            Self::Checkerboard => "checkerboard",
        }
    }
}

/// Coloured glasses, and how colours are given to them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Anaglyph {
    /// The glasses.
    pub glasses: Glasses,
    /// The mixture.
    pub mixture: Mixture,
}

/// Colours of the left and the right glass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Glasses {
    /// Red, cyan.
    RedCyan,
    /// Green, magenta.
    GreenMagenta,
    /// Amber (red and green), blue.
    AmberBlue,
}

/// How colours become those of an anaglyph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mixture {
    /// Least squares (Dubois).
    Dubois,
    /// The glass of one colour gets the luminance of its view, the other one the colours of its view.
    HalfColour,
    /// Both get the luminance of their views.
    Grey,
}

/// Outputs that one word names.
pub(super) const OUTPUTS: &[(&str, Output)] = &[
    ("panel", Output::Panel),
    ("quilt", Output::Quilt),
    ("sbs", Output::SideBySide { half: false }),
    ("half-sbs", Output::SideBySide { half: true }),
    ("tb", Output::TopBottom { half: false }),
    ("half-tb", Output::TopBottom { half: true }),
    ("rows", Output::Interlaced(Interlace::Rows)),
    ("columns", Output::Interlaced(Interlace::Columns)),
    ("checker", Output::Interlaced(Interlace::Checkerboard)),
    ("quad", Output::Quad),
    ("rgbd", Output::Rgbd),
];

pub(super) const GLASSES: [(&str, Glasses); 3] = [
    ("red-cyan", Glasses::RedCyan),
    ("green-magenta", Glasses::GreenMagenta),
    ("amber-blue", Glasses::AmberBlue),
];

/// How outputs are written, for a message.
pub(super) const WORDS: [&str; OUTPUTS.len() + 2] = words(OUTPUTS, &["anaglyph[:KIND]", "view:I"]);

/// How outputs of the program's window are written while the panel has its own: its own picture, or one that needs no place on a panel and no second buffer.
pub(super) const WINDOW_WORDS: [&str; 8] = [
    "own",
    "quilt",
    "sbs",
    "half-sbs",
    "tb",
    "half-tb",
    "anaglyph[:KIND]",
    "view:I",
];

impl fmt::Display for Output {
    /// As the option is written.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::View(view) => write!(f, "view:{view}"),
            Self::Anaglyph(Anaglyph { glasses, mixture }) => {
                let named = GLASSES.iter().find(|(_, known)| known == glasses);
                let mixture = match mixture {
                    Mixture::Dubois => "",
                    Mixture::HalfColour => "-half",
                    Mixture::Grey => "-grey",
                };
                let glasses = named.map_or(GLASSES[0].0, |(name, _)| name);
                write!(f, "anaglyph:{glasses}{mixture}")
            }
            other => {
                let named = OUTPUTS.iter().find(|(_, known)| known == other);
                f.write_str(named.map_or(OUTPUTS[0].0, |(name, _)| name))
            }
        }
    }
}
