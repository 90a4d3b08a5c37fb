//! Columns, rows and aspect in the name of a quilt: `NAME_qs<columns>x<rows>a<aspect>.png`, as Looking Glass's tools read and write it.
//!
//! Read with tolerance: capitals, no aspect (VTK writes `_qs5x9`), anything after it. Rows before columns (pylightio of AliceLG
//! reads names so) are only believed where the picture's size proves them, see [`QuiltName::grid`].
#![forbid(unsafe_code)]

use std::fmt;

/// Begins the part of the name.
const MARK: &str = "_qs";
/// Largest number of columns and of rows.
const MOST: u32 = 256;
/// Aspects that a name can say with four digits; others are not believed.
const ASPECTS: std::ops::RangeInclusive<f64> = 0.0001..=100_000.0;
/// Aspects that are this near each other, as a factor, are the same: tiles are whole pixels.
const SAME: f64 = 1.05;
/// And these are not.
const OTHER: f64 = 1.1;

/// Columns and rows of views, and the aspect of one view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuiltName {
    /// At least 1.
    pub columns: u32,
    /// At least 1.
    pub rows: u32,
    /// Width over height of one view.
    pub aspect: Option<f64>,
}

/// Why a quilt cannot be cut into its views.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum QuiltError {
    /// The name has the mark and nothing of use after it.
    #[error(
        "`{name}` does not say what it holds; name it like scene_qs8x6a0.75.png (columns x rows, aspect of a view), each from 1 to 256"
    )]
    Name {
        /// As it is.
        name: String,
    },
    /// Fewer pixels than views.
    #[error(
        "a picture of {width}x{height} pixels has no {columns}x{rows} views; give the quilt's own columns and rows"
    )]
    Small {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// As said.
        columns: u32,
        /// As said.
        rows: u32,
    },
}

impl QuiltName {
    /// Of views of this size, in pixels.
    pub fn new((columns, rows): (u32, u32), (width, height): (u32, u32)) -> Self {
        Self {
            columns,
            rows,
            aspect: Some(f64::from(width) / f64::from(height.max(1))),
        }
    }

    /// Reads the name of a file; none where it is not that of a quilt.
    pub fn read(name: &str) -> Result<Option<Self>, QuiltError> {
        let lower = name.to_ascii_lowercase();
        let marked = lower.match_indices(MARK).filter_map(|(at, _)| {
            let rest = lower.get(at + MARK.len()..)?;
            rest.starts_with(|c: char| c.is_ascii_digit())
                .then_some(rest)
        });
        let Some(rest) = marked.last() else {
            return Ok(None);
        };
        let read = Self::after_mark(rest);
        read.map(Some)
            .ok_or_else(|| QuiltError::Name { name: name.into() })
    }

    fn after_mark(text: &str) -> Option<Self> {
        let side = |text: &str| text.parse().ok().filter(|side| (1..=MOST).contains(side));
        let (columns, rest) = split_number(text, false);
        let (rows, rest) = split_number(rest.strip_prefix('x')?, false);
        let aspect = rest.strip_prefix('a').and_then(|rest| {
            let (aspect, _) = split_number(rest, true);
            aspect
                .parse()
                .ok()
                .filter(|aspect| ASPECTS.contains(aspect))
        });
        Some(Self {
            columns: side(columns)?,
            rows: side(rows)?,
            aspect,
        })
    }

    /// Whether the name of a file says it already, or tries to.
    pub fn is_in(name: &str) -> bool {
        !matches!(Self::read(name), Ok(None))
    }

    /// Columns and rows of a picture of this size, and whether they are the other way round than the name says. That is believed
    /// only where the aspect is that of a view so, and not that of one as the name says.
    pub fn grid(self, (width, height): (u32, u32)) -> Result<((u32, u32), bool), QuiltError> {
        let (columns, rows) = (self.columns, self.rows);
        let aspect = |columns: u32, rows: u32| {
            f64::from(width) * f64::from(rows) / (f64::from(height) * f64::from(columns))
        };
        let swapped = self.aspect.is_some_and(|told| {
            let off = |found: f64| (found / told).max(told / found);
            off(aspect(rows, columns)) < SAME && off(aspect(columns, rows)) > OTHER
        });
        let (columns, rows) = if swapped {
            (rows, columns)
        } else {
            (columns, rows)
        };
        if width < columns || height < rows {
            return Err(QuiltError::Small {
                width,
                height,
                columns,
                rows,
            });
        }
        Ok(((columns, rows), swapped))
    }
}

/// The digits that a text begins with, and the rest; with a fraction if there is one and it may have one.
fn split_number(text: &str, fraction: bool) -> (&str, &str) {
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let mut end = digits(text);
    if let Some(rest) = text.get(end..).and_then(|rest| rest.strip_prefix('.'))
        && fraction
        && digits(rest) > 0
    {
        end += 1 + digits(rest);
    }
    text.split_at_checked(end).unwrap_or((text, ""))
}

impl fmt::Display for QuiltName {
    /// As it ends a name, without the extension.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{MARK}{}x{}", self.columns, self.rows)?;
        if let Some(aspect) = self.aspect {
            let aspect = format!("{aspect:.4}");
            let short = aspect.trim_end_matches('0').trim_end_matches('.');
            write!(f, "a{short}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(columns: u32, rows: u32, aspect: Option<f64>) -> Option<QuiltName> {
        Some(QuiltName {
            columns,
            rows,
            aspect,
        })
    }

    #[test]
    fn names_are_read_with_tolerance() {
        for (text, expected) in [
            ("scene_qs8x6a0.75.png", name(8, 6, Some(0.75))),
            ("scene_qs8x6a1.png", name(8, 6, Some(1.0))),
            ("vtk_qs5x9.png", name(5, 9, None)),
            ("a_qs5x9a0.00001.png", name(5, 9, None)),
            ("a_qs5x9a1000000.png", name(5, 9, None)),
            ("SCENE_QS11X6A0.5625.PNG", name(11, 6, Some(0.5625))),
            ("a_qs7x7a1.777 (copy 2).png", name(7, 7, Some(1.777))),
            ("a_qs5x9a1.6_final.v2.png", name(5, 9, Some(1.6))),
            ("my_qs4x2_qs8x6a0.75.png", name(8, 6, Some(0.75))),
            ("a_qs8x6a.png", name(8, 6, None)),
            ("ä_qs2x1", name(2, 1, None)),
            ("scene.png", None),
            ("my_qstuff.png", None),
            ("qs8x6.png", None),
        ] {
            assert_eq!(QuiltName::read(text), Ok(expected), "{text}");
        }
        for wrong in ["a_qs8.png", "a_qs0x5.png", "a_qs8xsix.png", "a_qs999x9.png"] {
            assert!(QuiltName::read(wrong).is_err() && QuiltName::is_in(wrong));
        }
    }

    #[test]
    fn names_are_written_as_they_are_read() {
        for (size, text) in [
            ((420, 560), "_qs8x6a0.75"),
            ((640, 640), "_qs8x6a1"),
            ((1920, 1080), "_qs8x6a1.7778"),
            ((1440, 2560), "_qs8x6a0.5625"),
            ((100, 10), "_qs8x6a10"),
        ] {
            let name = QuiltName::new((8, 6), size);
            assert_eq!(name.to_string(), text);
            let read = QuiltName::read(text).unwrap().unwrap();
            assert!((read.aspect.unwrap() - name.aspect.unwrap()).abs() < 1e-4);
        }
        let plain = name(5, 9, None).unwrap();
        assert_eq!(plain.to_string(), "_qs5x9");
    }

    #[test]
    fn rows_before_columns_are_believed_where_the_aspect_proves_them() {
        let grid = |text: &str, size| QuiltName::read(text).unwrap().unwrap().grid(size).unwrap();
        // As the maker has them, some with tiles that are not quite of their aspect or not at all.
        for (text, size) in [
            ("_qs5x9a1.777", (4096, 4096)),
            ("_qs8x6a0.75", (3360, 3360)),
            ("_qs11x6a0.5625", (5995, 6000)),
            ("_qs8x9a1.777", (8192, 8192)),
            ("_qs12x4a0.5625", (7680, 4320)),
            ("_qs5x9", (4096, 4096)),
            ("_qs6x8", (3360, 3360)),
        ] {
            assert!(!grid(text, size).1, "{text}");
        }
        for (text, size, columns, rows) in [
            ("_qs9x5a1.777", (4096, 4096), 5, 9),
            ("_qs6x8a0.75", (3360, 3360), 8, 6),
            ("_qs6x11a0.5625", (5995, 6000), 11, 6),
        ] {
            assert_eq!(grid(text, size), ((columns, rows), true), "{text}");
        }
    }

    #[test]
    fn every_refusal_is_one_sentence() {
        let small = QuiltName::new((8, 6), (1, 1)).grid((7, 100)).unwrap_err();
        let said = [small, QuiltName::read("a_qs8.png").unwrap_err()].map(|e| e.to_string());
        insta::assert_snapshot!(said.join("\n"));
    }
}
