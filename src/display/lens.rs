//! The three numbers of a lens sheet that are fitted by eye, and the sheet as a description with them.
#![forbid(unsafe_code)]

use super::{Display, DisplayError, Kind, Number};

/// Bounds as in a file.
const LARGEST: f64 = 1e6;

/// Pitch, slant and offset of a sheet of the kind "slanted".
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Subpixels from lens to lens along a row, above 0.
    pub pitch: Number,
    /// Subpixels by which the phase grows from a row to the one below.
    pub slant: Number,
    /// Phase of the leftmost subpixel in the top row, in subpixels.
    pub offset: Number,
}

/// Names one of the numbers of a [`Lens`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LensPart {
    /// [`Lens::pitch`]
    Pitch,
    /// [`Lens::slant`]
    Slant,
    /// [`Lens::offset`]
    Offset,
}

impl LensPart {
    /// All of them, in the order in which they are fitted.
    pub const ALL: [Self; 3] = [Self::Pitch, Self::Slant, Self::Offset];

    /// By its [name](Self::name).
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|part| part.name() == name)
    }

    /// As the field of a file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Pitch => "pitch",
            Self::Slant => "slant",
            Self::Offset => "offset",
        }
    }
}

impl Lens {
    /// One of the numbers.
    #[must_use]
    pub fn get(self, part: LensPart) -> Number {
        match part {
            LensPart::Pitch => self.pitch,
            LensPart::Slant => self.slant,
            LensPart::Offset => self.offset,
        }
    }

    /// With another value for one of the numbers: a decimal number or a fraction.
    pub fn with(self, part: LensPart, text: &str) -> Result<Self, DisplayError> {
        let good = |number: &Number| {
            let value = number.to_f64();
            value.abs() <= LARGEST && (value > 0.0 || part != LensPart::Pitch)
        };
        let number = Number::parse(text)
            .filter(good)
            .ok_or_else(|| DisplayError::Lens {
                part: part.name(),
                value: super::fields::in_a_line(text.to_owned()),
                expected: match part {
                    LensPart::Pitch => "a number above 0 and at most 1000000",
                    LensPart::Slant | LensPart::Offset => "a number from -1000000 to 1000000",
                },
            })?;
        let mut lens = self;
        *match part {
            LensPart::Pitch => &mut lens.pitch,
            LensPart::Slant => &mut lens.slant,
            LensPart::Offset => &mut lens.offset,
        } = number;
        Ok(lens)
    }
}

impl Display {
    /// The numbers of its sheet; none where it is no slanted one.
    #[must_use]
    pub fn lens(&self) -> Option<Lens> {
        match &self.kind {
            Kind::Slanted(sheet) => Some(Lens {
                pitch: sheet.pitch,
                slant: sheet.slant,
                offset: sheet.offset,
            }),
            _ => None,
        }
    }

    /// Gives its sheet other numbers; nothing where it is no slanted one.
    pub fn set_lens(&mut self, lens: Lens) {
        if let Kind::Slanted(sheet) = &mut self.kind {
            (sheet.pitch, sheet.slant, sheet.offset) = (lens.pitch, lens.slant, lens.offset);
        }
    }
}
