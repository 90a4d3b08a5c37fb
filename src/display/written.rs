//! A slanted sheet as the file that [`Display::load`] reads.
#![forbid(unsafe_code)]

use super::{Display, Kind, Number};
use std::fmt::Write as _;

impl Display {
    /// The description as TOML with every field that is not as it is unless given; none for another kind than "slanted".
    #[must_use]
    pub fn to_toml(&self) -> Option<String> {
        let Kind::Slanted(sheet) = &self.kind else {
            return None;
        };
        let name = toml::Value::from(self.name.as_str());
        let mut text = format!(
            "version = 1\nname = {name}\nkind = \"slanted\"\nviews = {}\n",
            self.views
        );
        // Writing to a String cannot fail.
        let mut field = |name: &str, value: &dyn std::fmt::Display| {
            let _ = writeln!(text, "{name} = {value}");
        };
        field("pitch", &number(sheet.pitch));
        field("slant", &number(sheet.slant));
        field("offset", &number(sheet.offset));
        field("order", &format_args!("\"{}\"", sheet.order.name()));
        if sheet.colours.iter().any(|c| *c != Number::whole(0)) {
            let colours = sheet.colours.map(number).join(", ");
            field("colour-offsets", &format_args!("[{colours}]"));
        }
        field("inverted", &sheet.inverted);
        if self.rotation.degrees() != 0 {
            field("rotation", &self.rotation.degrees());
        }
        let facts = self.facts;
        if let Some((width, height)) = facts.screen {
            field("screen", &format_args!("\"{width}x{height}\""));
        }
        if let Some(dpi) = facts.dpi {
            field("dpi", &float(dpi));
        }
        if let Some(cone) = facts.cone {
            field("cone", &float(cone));
        }
        if let Some(spacing) = facts.spacing {
            field("spacing", &format_args!("\"{}\"", spacing.name()));
        }
        if let Some(px) = facts.budget_px {
            field("budget-px", &float(px));
        }
        if let Some(mm) = facts.budget_mm {
            field("budget-mm", &float(mm));
        }
        if let Some((columns, rows)) = facts.quilt {
            field("quilt", &format_args!("\"{columns}x{rows}\""));
        }
        if let Some(bias) = &sheet.bias {
            let (columns, rows, values) = bias.grid();
            let values: Vec<_> = values.iter().map(|value| number(*value)).collect();
            let _ = write!(
                text,
                "\n[bias]\ncolumns = {columns}\nrows = {rows}\nvalues = [{}]\n",
                values.join(", ")
            );
        }
        Some(text)
    }
}

/// A decimal number where it is one, else a fraction in quotes.
fn number(number: Number) -> String {
    match number.decimal() {
        Some(value) => float(value),
        None => format!("\"{number}\""),
    }
}

/// The shortest digits that are read as the same number; a whole one needs its point in lists of floats.
fn float(value: f64) -> String {
    format!("{value:?}")
}
