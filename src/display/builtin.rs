//! Panels that have a name of their own.
#![forbid(unsafe_code)]

use super::{Display, DisplayError, Facts, Kind, MAX_VIEWS, Pattern, Slanted};

/// One line of the list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Builtin {
    /// Name; `N` stands for any number.
    pub name: String,
    /// Native number of views; none where the name says it.
    pub views: Option<u32>,
    /// Its description.
    pub about: &'static str,
}

const HUEBNER: &str = "huebner8";
const SLANTED: &str = "slanted8";
const LENTICULAR: &str = "lenticular-";

/// Two views, interlaced.
const INTERLACED: [(&str, &[&str], &str); 3] = [
    (
        "rows",
        &["L", "R"],
        "left eye in the even rows, from the top",
    ),
    ("columns", &["LR"], "left eye in the even columns"),
    (
        "checkerboard",
        &["LR", "RL"],
        "left eye where column and row are both even or both odd",
    ),
];

/// A model of the Looking Glass family, with the numbers of the maker's tools; every device has a mask of its own.
struct Model {
    name: &'static str,
    /// Beginning of its serial numbers. None where no public source names it: the device is then known by its screen.
    serials: &'static [&'static str],
    quilt: (u32, u32),
    screen: (u32, u32),
    dpi: f64,
    /// The angle over which it spreads its views, degrees.
    cone: f64,
    about: &'static str,
}

const MODELS: [Model; 13] = [
    Model {
        name: "looking-glass-8.9",
        serials: &["LKG-2K"],
        quilt: (5, 9),
        screen: (2560, 1600),
        dpi: 338.0,
        cone: 40.0,
        about: "Looking Glass 8.9\"",
    },
    Model {
        name: "looking-glass-15.6",
        serials: &["LKG-4K", "LKG-A"],
        quilt: (5, 9),
        screen: (3840, 2160),
        dpi: 283.0,
        cone: 40.0,
        about: "Looking Glass 15.6\" and 16\" of the second generation",
    },
    Model {
        name: "looking-glass-8k",
        serials: &["LKG-8K", "LKG-B"],
        quilt: (5, 9),
        screen: (7680, 4320),
        dpi: 280.0,
        cone: 40.0,
        about: "Looking Glass 8K and 32\" of the second generation",
    },
    Model {
        name: "looking-glass-portrait",
        serials: &["LKG-P"],
        quilt: (8, 6),
        screen: (1536, 2048),
        dpi: 324.0,
        cone: 40.0,
        about: "Looking Glass Portrait",
    },
    Model {
        name: "looking-glass-kiosk",
        serials: &["LKG-F"],
        quilt: (11, 6),
        screen: (1536, 2048),
        dpi: 324.0,
        cone: 40.0,
        about: "Looking Glass Kiosk",
    },
    Model {
        name: "looking-glass-65",
        serials: &["LKG-D"],
        quilt: (8, 9),
        screen: (7680, 4320),
        dpi: 136.0,
        cone: 40.0,
        about: "Looking Glass 65\"",
    },
    Model {
        name: "looking-glass-go",
        serials: &["LKG-E"],
        quilt: (11, 6),
        screen: (1440, 2560),
        dpi: 491.0,
        cone: 54.0,
        about: "Looking Glass Go",
    },
    Model {
        name: "looking-glass-16-landscape",
        serials: &["LKG-J"],
        quilt: (7, 7),
        screen: (3840, 2160),
        dpi: 283.0,
        cone: 50.0,
        about: "Looking Glass 16\", landscape",
    },
    Model {
        name: "looking-glass-16-portrait",
        serials: &["LKG-H"],
        quilt: (11, 6),
        screen: (2160, 3840),
        dpi: 283.0,
        cone: 50.0,
        about: "Looking Glass 16\", portrait",
    },
    Model {
        name: "looking-glass-27-landscape",
        serials: &[],
        quilt: (8, 6),
        screen: (5120, 2880),
        dpi: 218.0,
        cone: 50.0,
        about: "Looking Glass 27\", landscape",
    },
    Model {
        name: "looking-glass-27-portrait",
        serials: &[],
        quilt: (12, 4),
        screen: (2880, 5120),
        dpi: 218.0,
        cone: 50.0,
        about: "Looking Glass 27\", portrait",
    },
    Model {
        name: "looking-glass-32-landscape",
        serials: &["LKG-L"],
        quilt: (7, 7),
        screen: (7680, 4320),
        dpi: 280.0,
        cone: 50.0,
        about: "Looking Glass 32\", landscape",
    },
    Model {
        name: "looking-glass-32-portrait",
        serials: &["LKG-K"],
        quilt: (11, 6),
        screen: (4320, 7680),
        dpi: 280.0,
        cone: 54.0,
        about: "Looking Glass 32\", portrait",
    },
];

/// Every built-in panel, for lists.
#[must_use]
pub fn builtins() -> Vec<Builtin> {
    let line = |name: &str, views, about| Builtin {
        name: name.into(),
        views,
        about,
    };
    let mut all = vec![
        line(
            HUEBNER,
            Some(8),
            "wavelength-selective filter of Hübner and Pajarola",
        ),
        line(SLANTED, Some(8), "that filter as slanted lenses"),
        line("lenticular-N", None, "upright lenses, a pixel per view"),
    ];
    all.extend(INTERLACED.map(|(name, _, about)| line(name, Some(2), about)));
    all.extend(
        MODELS.map(|model| line(model.name, Some(model.quilt.0 * model.quilt.1), model.about)),
    );
    all
}

pub(super) fn named(name: &str) -> Result<Display, DisplayError> {
    match name {
        HUEBNER => return Ok(Display::default()),
        SLANTED => return Ok(Display::new(name, 8, Kind::Slanted(Slanted::HUEBNER))),
        _ => {}
    }
    let interlaced = INTERLACED.into_iter().find(|panel| panel.0 == name);
    if let Some(pattern) = interlaced.and_then(|panel| Pattern::new(panel.1, false)) {
        return Ok(Display::new(name, 2, Kind::Pattern(pattern)));
    }
    if let Some(model) = MODELS.iter().find(|model| model.name == name) {
        return Ok(Display {
            facts: model.facts(),
            ..Display::new(name, model.quilt.0 * model.quilt.1, Kind::Uncalibrated)
        });
    }
    let Some(count) = name.strip_prefix(LENTICULAR) else {
        return Err(DisplayError::Unknown { name: name.into() });
    };
    let views = count.parse().ok().filter(|n| (1..=MAX_VIEWS).contains(n));
    let views = views.ok_or_else(|| DisplayError::Count { name: name.into() })?;
    Ok(Display::new(name, views, Kind::Lenticular))
}

/// The model of a Looking Glass: by its serial number, else the one model of unknown serial numbers that has its screen.
pub(super) fn facts_of(serial: &str, screen: (u32, u32)) -> Option<Facts> {
    let known = |model: &&Model| model.serials.iter().any(|start| serial.starts_with(start));
    let like = |model: &&Model| model.serials.is_empty() && model.screen == screen;
    let model = MODELS.iter().find(known);
    Some(model.or_else(|| MODELS.iter().find(like))?.facts())
}

impl Model {
    fn facts(&self) -> Facts {
        Facts {
            screen: Some(self.screen),
            dpi: Some(self.dpi),
            cone: Some(self.cone),
            quilt: Some(self.quilt),
            ..Facts::default()
        }
    }
}
