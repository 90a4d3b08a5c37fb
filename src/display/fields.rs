//! Values of a description, each with its own sentence when it is wrong.
#![forbid(unsafe_code)]

use super::{Bias, DisplayError, Number, Spacing, SubpixelOrder};
use std::ops::RangeInclusive;
use toml::{Table, Value};

/// Bounds for lengths; far outside of them a phase would lose its fraction.
const LARGEST: f64 = 1e6;

/// The fields of one file.
pub(super) struct Fields {
    pub(super) file: String,
    table: Table,
}

impl Fields {
    pub(super) fn new(file: String, table: Table) -> Self {
        Self { file, table }
    }

    /// Refuses fields that are neither in `read` nor in `common`; `all` are those of every kind.
    pub(super) fn only(
        &self,
        kind: &str,
        common: &[&'static str],
        read: &[&'static str],
        all: &[&'static str],
    ) -> Result<(), DisplayError> {
        for given in self.table.keys() {
            if common.iter().chain(read).any(|field| field == given) {
                continue;
            }
            let (file, kind) = (self.file.clone(), kind.to_owned());
            return Err(match all.iter().find(|field| *field == given) {
                Some(field) => DisplayError::Unused { file, field, kind },
                None => DisplayError::UnknownField {
                    file,
                    field: in_a_line(given.clone()),
                    kind,
                    known: common
                        .iter()
                        .chain(read)
                        .copied()
                        .collect::<Vec<_>>()
                        .join(", "),
                },
            });
        }
        Ok(())
    }

    pub(super) fn get(&self, field: &'static str) -> Option<&Value> {
        self.table.get(field)
    }

    /// A field that must be there.
    pub(super) fn need(
        &self,
        field: &'static str,
        remedy: &'static str,
    ) -> Result<&Value, DisplayError> {
        self.get(field).ok_or_else(|| self.missing(field, remedy))
    }

    pub(super) fn missing(&self, field: &'static str, remedy: &'static str) -> DisplayError {
        DisplayError::Missing {
            file: self.file.clone(),
            field,
            remedy,
        }
    }

    pub(super) fn wrong(
        &self,
        field: &'static str,
        expected: impl Into<String>,
        found: &Value,
        remedy: &'static str,
    ) -> DisplayError {
        DisplayError::Field {
            file: self.file.clone(),
            field,
            expected: expected.into(),
            found: in_a_line(match found {
                Value::String(text) => format!("{text:?}"),
                _ => found.to_string(),
            }),
            remedy,
        }
    }

    /// A whole number, if it is there.
    pub(super) fn whole(
        &self,
        field: &'static str,
        range: RangeInclusive<i64>,
        remedy: &'static str,
    ) -> Result<Option<i64>, DisplayError> {
        let Some(value) = self.get(field) else {
            return Ok(None);
        };
        match value.as_integer().filter(|whole| range.contains(whole)) {
            Some(whole) => Ok(Some(whole)),
            None => {
                let expected = if range.start() == range.end() {
                    range.start().to_string()
                } else {
                    format!("a whole number from {} to {}", range.start(), range.end())
                };
                Err(self.wrong(field, expected, value, remedy))
            }
        }
    }

    /// A length above 0 that must be there.
    pub(super) fn pitch(
        &self,
        field: &'static str,
        remedy: &'static str,
    ) -> Result<Number, DisplayError> {
        let value = self.need(field, remedy)?;
        match number(value) {
            Some(pitch) if pitch.to_f64() > 0.0 && pitch.to_f64() <= LARGEST => Ok(pitch),
            Some(pitch) if pitch.to_f64() > LARGEST => {
                Err(self.wrong(field, "at most 1000000", value, remedy))
            }
            _ => Err(self.wrong(field, "a number above 0", value, remedy)),
        }
    }

    /// A length; 0 unless it is there.
    pub(super) fn length(
        &self,
        field: &'static str,
        remedy: &'static str,
    ) -> Result<Number, DisplayError> {
        match self.get(field) {
            Some(value) => length(value).ok_or_else(|| {
                self.wrong(field, "a number from -1000000 to 1000000", value, remedy)
            }),
            None => Ok(Number::whole(0)),
        }
    }

    /// Three lengths; 0 unless they are there.
    pub(super) fn lengths(
        &self,
        field: &'static str,
        remedy: &'static str,
    ) -> Result<[Number; 3], DisplayError> {
        let Some(value) = self.get(field) else {
            return Ok([Number::whole(0); 3]);
        };
        match value.as_array().map(Vec::as_slice) {
            Some([a, b, c]) => match (length(a), length(b), length(c)) {
                (Some(a), Some(b), Some(c)) => Some([a, b, c]),
                _ => None,
            },
            _ => None,
        }
        .ok_or_else(|| {
            self.wrong(
                field,
                "three numbers from -1000000 to 1000000",
                value,
                remedy,
            )
        })
    }

    /// A float in a range, if it is there.
    pub(super) fn float(
        &self,
        field: &'static str,
        (least, most): (f64, f64),
        remedy: &'static str,
    ) -> Result<Option<f64>, DisplayError> {
        let Some(value) = self.get(field) else {
            return Ok(None);
        };
        match number(value).map(Number::to_f64) {
            Some(float) if (least..=most).contains(&float) => Ok(Some(float)),
            _ => Err(self.wrong(
                field,
                format!("a number from {least} to {most}"),
                value,
                remedy,
            )),
        }
    }

    /// Two whole numbers with an x between them, if they are there.
    pub(super) fn pair(
        &self,
        field: &'static str,
        most: u32,
        remedy: &'static str,
    ) -> Result<Option<(u32, u32)>, DisplayError> {
        let Some(value) = self.get(field) else {
            return Ok(None);
        };
        let side = |text: &str| text.parse().ok().filter(|side| (1..=most).contains(side));
        let pair = value.as_str().and_then(|text| {
            let (a, b) = text.split_once('x')?;
            Some((side(a)?, side(b)?))
        });
        let expected = format!("\"AxB\" with whole numbers from 1 to {most}");
        pair.map(Some)
            .ok_or_else(|| self.wrong(field, expected, value, remedy))
    }

    /// false unless it is there.
    pub(super) fn flag(
        &self,
        field: &'static str,
        remedy: &'static str,
    ) -> Result<bool, DisplayError> {
        match self.get(field) {
            Some(value) => value
                .as_bool()
                .ok_or_else(|| self.wrong(field, "true or false", value, remedy)),
            None => Ok(false),
        }
    }

    pub(super) fn text<'v>(
        &self,
        field: &'static str,
        value: &'v Value,
        expected: &str,
        remedy: &'static str,
    ) -> Result<&'v str, DisplayError> {
        let text = value.as_str().filter(|text| !text.is_empty());
        text.ok_or_else(|| self.wrong(field, expected, value, remedy))
    }

    pub(super) fn spacing(&self) -> Result<Option<Spacing>, DisplayError> {
        const REMEDY: &str =
            "give where in the cone the cameras stand, for example spacing = \"edges\"";
        let Some(value) = self.get("spacing") else {
            return Ok(None);
        };
        let word = value.as_str().unwrap_or_default();
        match Spacing::ALL.iter().find(|known| known.name() == word) {
            Some(spacing) => Ok(Some(*spacing)),
            None => Err(self.wrong("spacing", "\"centres\" or \"edges\"", value, REMEDY)),
        }
    }

    pub(super) fn order(&self) -> Result<SubpixelOrder, DisplayError> {
        const REMEDY: &str = "give the order of the subpixels, for example order = \"bgr\"";
        let Some(value) = self.get("order") else {
            return Ok(SubpixelOrder::Rgb);
        };
        match value.as_str() {
            Some("rgb") => Ok(SubpixelOrder::Rgb),
            Some("bgr") => Ok(SubpixelOrder::Bgr),
            _ => Err(self.wrong("order", "\"rgb\" or \"bgr\"", value, REMEDY)),
        }
    }
}

/// A value as a message shows it.
pub(super) fn in_a_line(text: String) -> String {
    const LONGEST: usize = 80;
    let mut line: String = text.chars().take(LONGEST).collect();
    if line.len() < text.len() {
        line.push('…');
    }
    line.replace(char::is_control, " ")
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

fn length(value: &Value) -> Option<Number> {
    number(value).filter(|number| number.to_f64().abs() <= LARGEST)
}

/// A number of a file.
pub(super) fn float(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(whole) => Some(*whole as f64),
        _ => value.as_float(),
    }
}

/// A grid of numbers.
pub(super) fn bias(value: &Value) -> Option<Bias> {
    let table = value.as_table()?;
    if table
        .keys()
        .any(|k| !["columns", "rows", "values"].contains(&k.as_str()))
    {
        return None;
    }
    let side = |key| usize::try_from(table.get(key)?.as_integer()?).ok();
    let values = table.get("values")?.as_array()?.iter().map(number);
    Bias::new(
        side("columns")?,
        side("rows")?,
        values.collect::<Option<_>>()?,
    )
}
