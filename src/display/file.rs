//! Panel descriptions on disk: TOML, the calibration JSON of a Looking Glass, or a PNG that is the mask itself.
//!
//! docs/displays.md has every field with an example; the version of the format is 1.
#![forbid(unsafe_code)]

use super::fields::{Fields, bias};
use super::wall_file::wall;
use super::{
    Display, DisplayError, Facts, GUARD, Integer, Kind, Leia, MAX_VIEWS, Mask, Pattern, Rotation,
    Slanted, calibration,
};
use crate::bounded;
use std::io::ErrorKind;
use std::path::Path;
use std::sync::Arc;
use toml::Value;

/// Bytes of a description; the largest pattern has half as many.
pub(super) const MOST_BYTES: u64 = 1 << 21;

const KIND: &str = "give the optics, for example kind = \"slanted\"";
const KINDS: &str = "\"lenticular\", \"huebner\", \"slanted\", \"integer\", \"looking-glass\", \"leia\", \"pattern\", \"wall\" or \"mask\"";
const NAME: &str = "give a name, for example name = \"My panel\"";
const VIEWS: &str = "give the number of views, for example views = 8";
const PITCH: &str = "give the lens pitch in subpixels, for example pitch = \"16/3\"";
const SLANT: &str = "give the slant in subpixels per row, for example slant = \"2/3\"";
const OFFSET: &str = "give the offset, for example offset = 0.5";
const COLOURS: &str =
    "give the offsets of R, G and B in subpixels, for example colour-offsets = [0, 0.1, 0.2]";
const BIAS: &str = "give a grid from 2x2 to 64x64 with as many values in subpixels, for example \
                    bias = { columns = 2, rows = 2, values = [0, 0.1, 0, 0.1] }";
const STEP: &str = "give the step of the phase, for example horizontal = 3";
const MODULUS: &str = "give the phase after which the views repeat, for example modulus = 8";
const TABLE: &str =
    "give a view for each part of the modulus, for example table = [0, 1, \"b\", 2]";
const PATTERN: &str =
    "give rows of one length from L, R, b (black) and 0 to 9, for example pattern = [\"LRLRbLRb\"]";
const INVERTED: &str = "give inverted = true where depth appears turned inside out";
const SUBPIXELS: &str = "give subpixels = true where each letter is a subpixel";
const DU: &str = "give the views from a pixel to the next, for example p-over-du = 3";
const DV: &str = "give the views from a row to the next, for example p-over-dv = 1";
const COLOUR_SLANT: &str = "give the views a row adds, for example colour-slant = 0.2";
const INVERSION: &str = "give colour-inversion = true where B comes before R";
const CALIBRATION: &str = "give the device's file, for example calibration = \"visual.json\"";
const MASK: &str = "give a 16-bit RGB PNG, for example mask = \"panel.png\"";
const VERSION: &str = "write version = 1, or use a newer manyview";
const SCREEN: &str = "give the screen in pixels, for example screen = \"2560x1600\"";
const DPI: &str = "give the pixels per inch, for example dpi = 338";
const CONE: &str = "give the angle of the views in degrees, for example cone = 40";
const ROTATION: &str = "give how far the panel is turned clockwise, for example rotation = 90";
const BUDGET_PX: &str =
    "give the disparity between neighbouring views in pixels, for example budget-px = 1.5";
const BUDGET_MM: &str =
    "give the disparity between neighbouring views in mm, for example budget-mm = 0.2";
const DPI_FOR_MM: &str = "give the pixels per inch with budget-mm, for example dpi = 338";
const QUILT: &str = "give columns and rows, for example quilt = \"8x6\"";

const COMMON: [&str; 12] = [
    "version",
    "name",
    "kind",
    "views",
    "screen",
    "dpi",
    "cone",
    "spacing",
    "rotation",
    "quilt",
    "budget-px",
    "budget-mm",
];
const LENS: [&str; 7] = [
    "pitch",
    "slant",
    "offset",
    "colour-offsets",
    "bias",
    "order",
    "inverted",
];
const STEPS: [&str; 7] = [
    "horizontal",
    "subpixel",
    "vertical",
    "offset",
    "modulus",
    "table",
    "order",
];
const LEIA: [&str; 5] = [
    "p-over-du",
    "p-over-dv",
    "colour-slant",
    "colour-inversion",
    "offset",
];

/// Every field that some kind reads.
const ALL: [&str; 22] = [
    "pitch",
    "slant",
    "offset",
    "colour-offsets",
    "bias",
    "order",
    "horizontal",
    "subpixel",
    "vertical",
    "modulus",
    "table",
    "p-over-du",
    "p-over-dv",
    "colour-slant",
    "colour-inversion",
    "pattern",
    "subpixels",
    "inverted",
    "calibration",
    "mask",
    "panel",
    "viewer",
];

/// Steps of an `integer` panel: with 32 bits a place on the screen times a step fits 64.
const STEP_RANGE: std::ops::RangeInclusive<i64> = -2_147_483_648..=2_147_483_647;

/// True for an argument that is meant as a file, whether or not that exists.
pub(super) fn looks_like_path(path: &Path) -> bool {
    let known = ["toml", "json", "png"];
    path.components().count() > 1
        || path
            .extension()
            .is_some_and(|e| known.iter().any(|k| e == *k))
}

/// `in_wall`: it is a panel of a wall, which cannot be a wall itself.
pub(super) fn load(path: &Path, in_wall: bool) -> Result<Display, DisplayError> {
    let is = |extension: &str| {
        path.extension()
            .is_some_and(|e| e.eq_ignore_ascii_case(extension))
    };
    if is("png") {
        return from_mask(path, stem(path), None);
    }
    let text = read(path)?;
    if is("json") {
        return calibration::read(&path.display().to_string(), stem(path), &text);
    }
    from_toml(path, &text, in_wall)
}

/// `path` for messages, and for files beside it.
pub(super) fn from_toml(path: &Path, text: &str, in_wall: bool) -> Result<Display, DisplayError> {
    let file = path.display().to_string();
    let table = text.parse().map_err(|e: toml::de::Error| {
        let before = e
            .span()
            .and_then(|span| text.get(..span.start))
            .unwrap_or("");
        DisplayError::Toml {
            file: file.clone(),
            line: before.matches('\n').count() + 1,
            message: e.message().replace('\n', ", "),
        }
    })?;
    let fields = Fields::new(file, table);
    Reader {
        path,
        fields,
        in_wall,
    }
    .display()
}

fn read(path: &Path) -> Result<String, DisplayError> {
    let file = path.display().to_string();
    bounded::text(path, MOST_BYTES).map_err(|source| match source.kind() {
        ErrorKind::FileTooLarge => DisplayError::Large { file },
        _ => DisplayError::Read { file, source },
    })
}

fn stem(path: &Path) -> String {
    path.file_stem()
        .unwrap_or(path.as_os_str())
        .to_string_lossy()
        .into_owned()
}

/// N is the largest index plus 1 where it is not given.
fn from_mask(path: &Path, name: String, views: Option<u32>) -> Result<Display, DisplayError> {
    let mask = Mask::from_png(path)?;
    let indices = mask
        .data()
        .as_flattened()
        .iter()
        .filter(|&&view| view != GUARD);
    let least = indices.max().map_or(1, |&view| u32::from(view) + 1);
    let views = views.unwrap_or(least);
    mask.check_indices(path, views)?;
    let screen = Some((mask.width(), mask.height()));
    let kind = Kind::MaskFile {
        path: path.into(),
        mask: Arc::new(mask),
    };
    let mut display = Display::new(name, views, kind);
    display.facts.screen = screen;
    Ok(display)
}

/// Turns fields into a panel.
struct Reader<'a> {
    path: &'a Path,
    fields: Fields,
    in_wall: bool,
}

impl Reader<'_> {
    fn display(&self) -> Result<Display, DisplayError> {
        let f = &self.fields;
        f.whole("version", 1..=1, VERSION)?;
        let name = match f.get("name") {
            Some(value) => f.text("name", value, "a text", NAME)?.to_owned(),
            None => stem(self.path),
        };
        let views = f.whole("views", 1..=i64::from(MAX_VIEWS), VIEWS)?;
        let views = views.and_then(|views| u32::try_from(views).ok());
        let given = f.need("kind", KIND)?;
        let kind = f.text("kind", given, KINDS, KIND)?;
        let only = |read: &[&'static str]| f.only(kind, &COMMON, read, &ALL);
        let need_views = || views.ok_or_else(|| f.missing("views", VIEWS));
        let mut display = match kind {
            "lenticular" => {
                only(&[])?;
                Display::new(name, need_views()?, Kind::Lenticular)
            }
            "huebner" => {
                only(&["order"])?;
                Display::new(name, views.unwrap_or(8), Kind::Huebner(f.order()?))
            }
            "slanted" => {
                only(&LENS)?;
                let lens = self.lens()?;
                Display::new(name, need_views()?, Kind::Slanted(lens))
            }
            "integer" => {
                only(&STEPS)?;
                let steps = self.steps()?;
                Display::new(name, need_views()?, Kind::Integer(steps))
            }
            "leia" => {
                only(&LEIA)?;
                let panel = Leia {
                    p_over_du: f.pitch("p-over-du", DU)?,
                    p_over_dv: f.length("p-over-dv", DV)?,
                    colour_slant: f.length("colour-slant", COLOUR_SLANT)?,
                    colour_inversion: f.flag("colour-inversion", INVERSION)?,
                    offset: f.length("offset", OFFSET)?,
                };
                Display::new(name, need_views()?, Kind::Leia(panel))
            }
            "pattern" => {
                only(&["pattern", "subpixels"])?;
                let pattern = self.pattern()?;
                let views = views.unwrap_or(pattern.views());
                Display::new(name, views, Kind::Pattern(pattern))
            }
            "looking-glass" => {
                only(&["calibration"])?;
                let path = self.beside("calibration", CALIBRATION)?;
                let file = path.display().to_string();
                let mut display = calibration::read(&file, name, &read(&path)?)?;
                display.views = views.unwrap_or(display.views);
                display
            }
            "wall" if !self.in_wall => {
                only(&["panel", "viewer"])?;
                let wall = wall(self.path, f)?;
                let views = views.or(wall.panels().first().map(|panel| panel.display.views));
                let screen = Some(wall.sheet());
                let views = views.unwrap_or(1);
                let mut display = Display::new(name, views, Kind::Wall(Arc::new(wall)));
                display.facts.screen = screen;
                display
            }
            "mask" => {
                only(&["mask"])?;
                from_mask(&self.beside("mask", MASK)?, name, views)?
            }
            _ => return Err(f.wrong("kind", KINDS, given, KIND)),
        };
        self.facts(&mut display.facts)?;
        let degrees = f.whole("rotation", 0..=270, ROTATION)?.unwrap_or(0);
        display.rotation = match (Rotation::from_degrees(degrees), f.get("rotation")) {
            (Some(rotation), _) => rotation,
            (None, Some(found)) => {
                return Err(f.wrong("rotation", "0, 90, 180 or 270", found, ROTATION));
            }
            (None, None) => Rotation::None,
        };
        Ok(display)
    }

    fn facts(&self, facts: &mut Facts) -> Result<(), DisplayError> {
        let f = &self.fields;
        facts.screen = f.pair("screen", 32_768, SCREEN)?.or(facts.screen);
        facts.dpi = f.float("dpi", (1.0, 10_000.0), DPI)?.or(facts.dpi);
        facts.cone = f.float("cone", (0.1, 170.0), CONE)?.or(facts.cone);
        facts.spacing = f.spacing()?.or(facts.spacing);
        facts.quilt = f.pair("quilt", 256, QUILT)?.or(facts.quilt);
        facts.budget_px = f.float("budget-px", (0.01, 1000.0), BUDGET_PX)?;
        facts.budget_mm = f.float("budget-mm", (0.001, 100.0), BUDGET_MM)?;
        if facts.budget_mm.is_some() && facts.dpi.is_none() {
            return Err(f.missing("dpi", DPI_FOR_MM));
        }
        Ok(())
    }

    fn lens(&self) -> Result<Slanted, DisplayError> {
        let f = &self.fields;
        Ok(Slanted {
            pitch: f.pitch("pitch", PITCH)?,
            slant: f.length("slant", SLANT)?,
            offset: f.length("offset", OFFSET)?,
            colours: f.lengths("colour-offsets", COLOURS)?,
            bias: match f.get("bias") {
                Some(value) => Some(
                    bias(value).ok_or_else(|| f.wrong("bias", "a grid of values", value, BIAS))?,
                ),
                None => None,
            },
            order: f.order()?,
            inverted: f.flag("inverted", INVERTED)?,
        })
    }

    fn steps(&self) -> Result<Integer, DisplayError> {
        let f = &self.fields;
        f.need("horizontal", STEP)?;
        f.need("modulus", MODULUS)?;
        let step =
            |field, range, remedy| f.whole(field, range, remedy).map(|step| step.unwrap_or(0));
        let table = match f.get("table") {
            Some(value) => {
                let expected = "a list of views, with \"b\" for black";
                table(value).ok_or_else(|| f.wrong("table", expected, value, TABLE))?
            }
            None => Vec::new(),
        };
        Ok(Integer {
            horizontal: step("horizontal", STEP_RANGE, STEP)?,
            subpixel: step("subpixel", STEP_RANGE, STEP)?,
            vertical: step("vertical", STEP_RANGE, STEP)?,
            offset: step("offset", STEP_RANGE, OFFSET)?,
            modulus: step("modulus", 1..=*STEP_RANGE.end(), MODULUS)?,
            table,
            order: f.order()?,
        })
    }

    fn pattern(&self) -> Result<Pattern, DisplayError> {
        let f = &self.fields;
        let value = f.need("pattern", PATTERN)?;
        let subpixels = f.flag("subpixels", SUBPIXELS)?;
        let rows = value.as_array().and_then(|rows| {
            let rows: Option<Vec<&str>> = rows.iter().map(Value::as_str).collect();
            Pattern::new(&rows?, subpixels)
        });
        rows.ok_or_else(|| f.wrong("pattern", "rows of views", value, PATTERN))
    }

    /// A file that is named in this one, from its folder.
    fn beside(
        &self,
        field: &'static str,
        remedy: &'static str,
    ) -> Result<std::path::PathBuf, DisplayError> {
        let value = self.fields.need(field, remedy)?;
        let name = self
            .fields
            .text(field, value, "the path of a file", remedy)?;
        Ok(self.path.parent().unwrap_or(Path::new("")).join(name))
    }
}

fn table(value: &Value) -> Option<Vec<u16>> {
    let view = |value: &Value| match value {
        Value::String(black) if black == "b" => Some(GUARD),
        _ => u16::try_from(value.as_integer()?)
            .ok()
            .filter(|&view| view != GUARD),
    };
    let views: Vec<u16> = value.as_array()?.iter().map(view).collect::<Option<_>>()?;
    (1..usize::from(GUARD))
        .contains(&views.len())
        .then_some(views)
}
