//! Panel descriptions on disk: TOML, or a PNG that is the mask itself.
//!
//! ```toml
//! name = "My panel"       # default: the name of the file
//! kind = "slanted"        # lenticular, huebner, slanted or mask
//! views = 9
//! pitch = "16/3"          # slanted: subpixels from lens to lens; a number or "a/b"
//! slant = "2/3"           # slanted: subpixels per row downwards, default 0
//! offset = 0.5            # slanted: subpixels, default 0
//! order = "bgr"           # slanted, huebner: leftmost colour, default "rgb"
//! mask = "panel.png"      # mask: beside the TOML file
//! ```
#![forbid(unsafe_code)]

use super::{
    Display, DisplayError, Kind, MAX_VIEWS, Mask, Number, Slanted, SubpixelOrder, mask::GUARD,
};
use serde::Deserialize;
use std::path::Path;
use std::sync::Arc;
use toml::Value;

const VIEWS: &str = "give the number of views, for example views = 8";
const PITCH: &str = "give the lens pitch in subpixels, for example pitch = \"16/3\"";
const SLANT: &str = "give the slant in subpixels per row, for example slant = \"2/3\"";
const OFFSET: &str = "give the offset in subpixels, for example offset = 0.5";
const KIND: &str = "give the optics, for example kind = \"slanted\"";
const MASK: &str = "give a 16-bit RGB PNG, for example mask = \"panel.png\"";
const NAME: &str = "give a name, for example name = \"My panel\"";
const ORDER: &str = "give the order of the subpixels, for example order = \"bgr\"";

/// Bounds for slant and offset; far outside of them a phase would lose its fraction.
const LARGEST: f64 = 1e6;

/// Values are kept as TOML, so that a wrong type is reported in our words.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    name: Option<Value>,
    views: Option<Value>,
    kind: Option<Value>,
    pitch: Option<Value>,
    slant: Option<Value>,
    offset: Option<Value>,
    order: Option<Value>,
    mask: Option<Value>,
}

/// True for what a user meant as a file even where none is.
pub(super) fn looks_like_path(path: &Path) -> bool {
    path.components().count() > 1 || path.extension().is_some_and(|e| e == "toml" || e == "png")
}

pub(super) fn load(path: &Path) -> Result<Display, DisplayError> {
    if path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("png"))
    {
        return from_mask(path, stem(path), None);
    }
    let file = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|source| DisplayError::Read {
        file: file.clone(),
        source,
    })?;
    let raw: Raw = toml::from_str(&text).map_err(|e| {
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
    Reader { path, file }.display(raw)
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
    Ok(Display {
        name,
        views,
        kind: Kind::MaskFile {
            path: path.into(),
            mask: Arc::new(mask),
        },
    })
}

/// Turns fields into values and mistakes into sentences.
struct Reader<'a> {
    path: &'a Path,
    file: String,
}

impl Reader<'_> {
    fn display(&self, raw: Raw) -> Result<Display, DisplayError> {
        let name = match &raw.name {
            Some(value) => self.text("name", value, "a text", NAME)?.to_owned(),
            None => stem(self.path),
        };
        let views = raw
            .views
            .as_ref()
            .map(|value| self.views(value))
            .transpose()?;
        let kinds = "\"lenticular\", \"huebner\", \"slanted\" or \"mask\"";
        let Some(given) = &raw.kind else {
            return Err(self.missing("kind", KIND));
        };
        let kind = self.text("kind", given, kinds, KIND)?;
        let read: &[&str] = match kind {
            "lenticular" => &[],
            "huebner" => &["order"],
            "slanted" => &["pitch", "slant", "offset", "order"],
            "mask" => &["mask"],
            _ => return Err(self.field("kind", kinds, given, KIND)),
        };
        let optional = [
            ("pitch", &raw.pitch),
            ("slant", &raw.slant),
            ("offset", &raw.offset),
            ("order", &raw.order),
            ("mask", &raw.mask),
        ];
        for (field, value) in optional {
            if value.is_some() && !read.contains(&field) {
                let (file, kind) = (self.file.clone(), kind.to_owned());
                return Err(DisplayError::Unused { file, field, kind });
            }
        }
        let order = self.order(raw.order.as_ref())?;
        let kind = match kind {
            "lenticular" => Kind::Lenticular,
            "huebner" => {
                let kind = Kind::Huebner(order);
                return Ok(Display {
                    name,
                    views: views.unwrap_or(8),
                    kind,
                });
            }
            "mask" => {
                let Some(mask) = &raw.mask else {
                    return Err(self.missing("mask", MASK));
                };
                let mask = self.text("mask", mask, "the path of a PNG file", MASK)?;
                let folder = self.path.parent().unwrap_or(Path::new(""));
                return from_mask(&folder.join(mask), name, views);
            }
            _ => {
                let Some(pitch) = &raw.pitch else {
                    return Err(self.missing("pitch", PITCH));
                };
                Kind::Slanted(Slanted {
                    pitch: self.pitch(pitch)?,
                    slant: self.length("slant", raw.slant.as_ref(), SLANT)?,
                    offset: self.length("offset", raw.offset.as_ref(), OFFSET)?,
                    order,
                })
            }
        };
        let views = views.ok_or_else(|| self.missing("views", VIEWS))?;
        Ok(Display { name, views, kind })
    }

    fn views(&self, value: &Value) -> Result<u32, DisplayError> {
        let views = value
            .as_integer()
            .and_then(|views| u32::try_from(views).ok());
        views
            .filter(|views| (1..=MAX_VIEWS).contains(views))
            .ok_or_else(|| {
                let expected = format!("a whole number from 1 to {MAX_VIEWS}");
                self.field("views", &expected, value, VIEWS)
            })
    }

    fn pitch(&self, value: &Value) -> Result<Number, DisplayError> {
        match number(value) {
            Some(pitch) if pitch.to_f64() > 0.0 && pitch.to_f64() <= LARGEST => Ok(pitch),
            Some(pitch) if pitch.to_f64() > LARGEST => {
                Err(self.field("pitch", "at most 1000000", value, PITCH))
            }
            _ => Err(self.field("pitch", "a number above 0", value, PITCH)),
        }
    }

    fn length(
        &self,
        field: &'static str,
        value: Option<&Value>,
        remedy: &'static str,
    ) -> Result<Number, DisplayError> {
        let Some(value) = value else {
            return Ok(Number::Exact {
                numerator: 0,
                denominator: 1,
            });
        };
        let number = number(value).filter(|number| number.to_f64().abs() <= LARGEST);
        let expected = "a number from -1000000 to 1000000";
        number.ok_or_else(|| self.field(field, expected, value, remedy))
    }

    fn order(&self, value: Option<&Value>) -> Result<SubpixelOrder, DisplayError> {
        let Some(value) = value else {
            return Ok(SubpixelOrder::Rgb);
        };
        match value.as_str() {
            Some("rgb") => Ok(SubpixelOrder::Rgb),
            Some("bgr") => Ok(SubpixelOrder::Bgr),
            _ => Err(self.field("order", "\"rgb\" or \"bgr\"", value, ORDER)),
        }
    }

    fn text<'v>(
        &self,
        field: &'static str,
        value: &'v Value,
        expected: &str,
        remedy: &'static str,
    ) -> Result<&'v str, DisplayError> {
        let text = value.as_str().filter(|text| !text.is_empty());
        text.ok_or_else(|| self.field(field, expected, value, remedy))
    }

    fn field(
        &self,
        field: &'static str,
        expected: &str,
        value: &Value,
        remedy: &'static str,
    ) -> DisplayError {
        let (file, expected) = (self.file.clone(), expected.to_owned());
        DisplayError::Field {
            file,
            field,
            expected,
            found: value.to_string(),
            remedy,
        }
    }

    fn missing(&self, field: &'static str, remedy: &'static str) -> DisplayError {
        DisplayError::Missing {
            file: self.file.clone(),
            field,
            remedy,
        }
    }
}

/// A TOML number, or a text with one.
fn number(value: &Value) -> Option<Number> {
    match value {
        Value::Integer(whole) => Number::ratio(*whole, 1),
        Value::Float(float) => Number::from_f64(*float),
        Value::String(text) => Number::parse(text),
        _ => None,
    }
}
