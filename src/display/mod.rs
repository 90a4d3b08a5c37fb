//! Panel descriptions and their masks; pure, without GL.
//!
//! Spaces: screen pixels `(x, row)`, `x` to the right, `row` downwards from the top of the *screen*, both 0-based and
//! whole. Subpixels of a pixel are numbered `c = 0, 1, 2` from the left; on an RGB panel these are R, G and B. View 0
//! is the leftmost camera.
//!
//! The kinds and an asked number of views N that is not the native one: a `lenticular` and a `huebner` mask are the
//! same structure modulo N, that is a sheet made for N views, so every view is shown. A `slanted` lens keeps its pitch
//! and spreads N views over it; to drive one fixed piece of optics with another N, describe it as `slanted`
//! (`slanted8` is Hübner's filter as such a lens). A mask file is what it is and needs N above its largest index.
#![forbid(unsafe_code)]

mod error;
mod file;
mod huebner;
mod mask;
mod number;
mod slanted;
#[cfg(test)]
mod tests;

pub use error::{DisplayError, MaskError};
pub use mask::{GUARD, Mask};
pub use number::Number;
pub use slanted::Slanted;

use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Largest number of views: indices are 16-bit and 65535 is the guard.
pub const MAX_VIEWS: u32 = 65_535;

/// A panel: how many views it shows and which subpixel shows which.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// Name shown to the user.
    pub name: String,
    /// Native number of views.
    pub views: u32,
    /// Which subpixel shows which view.
    pub kind: Kind,
}

/// How a panel's mask is made.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// Whole pixels, view = x mod N (Hübner and Pajarola, section 3.3).
    Lenticular,
    /// Wavelength-selective filter, Hübner and Pajarola, equations 7 to 9.
    Huebner(SubpixelOrder),
    /// A lens sheet of any pitch and slant.
    Slanted(Slanted),
    /// A picture of the mask of the whole screen.
    MaskFile {
        /// Where it was read from, for messages.
        path: PathBuf,
        /// Its values; shared, as a 4K mask is 50 MB.
        mask: Arc<Mask>,
    },
}

/// Which colour the leftmost subpixel of a pixel has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SubpixelOrder {
    /// Red on the left.
    #[default]
    Rgb,
    /// Blue on the left.
    Bgr,
}

impl SubpixelOrder {
    /// From position (left to right) to colour (R, G, B). The same map undoes itself.
    fn colours(self, positions: [u16; 3]) -> [u16; 3] {
        let [a, b, c] = positions;
        match self {
            Self::Rgb => [a, b, c],
            Self::Bgr => [c, b, a],
        }
    }
}

/// Where the picture lies on the screen, in pixels of the screen.
///
/// Masks belong to the glass, not to the window, so their phase counts from the screen's corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placement {
    /// Height of the screen: the `screenHeight` of equation 8, and the height a mask file must have.
    pub screen_height: u32,
    /// Left edge of the picture, to the right from the left edge of the screen; negative when it hangs over.
    pub x: i32,
    /// Top edge of the picture, downwards from the top of the screen; negative when it hangs over.
    pub y: i32,
    /// Width of the picture.
    pub width: u32,
    /// Height of the picture.
    pub height: u32,
}

impl Placement {
    /// A picture that is the whole screen.
    pub fn full_screen(width: u32, height: u32) -> Self {
        Self {
            screen_height: height,
            x: 0,
            y: 0,
            width,
            height,
        }
    }
}

impl Default for Display {
    /// Hübner's 8-view filter, `huebner8`.
    fn default() -> Self {
        Self {
            name: "huebner8".into(),
            views: 8,
            kind: Kind::Huebner(SubpixelOrder::Rgb),
        }
    }
}

impl Display {
    /// The names [`Display::named`] knows, for listings; `lenticular-N` stands for any N.
    pub const NAMES: [&'static str; 3] = ["huebner8", "slanted8", "lenticular-N"];

    /// A built-in display.
    pub fn named(name: &str) -> Result<Self, DisplayError> {
        match name {
            "huebner8" => Ok(Self::default()),
            "slanted8" => Ok(Self {
                name: name.into(),
                views: 8,
                kind: Kind::Slanted(Slanted::HUEBNER),
            }),
            _ => {
                let Some(count) = name.strip_prefix("lenticular-") else {
                    return Err(DisplayError::Unknown { name: name.into() });
                };
                let views = count.parse().ok().filter(|n| (1..=MAX_VIEWS).contains(n));
                let views = views.ok_or_else(|| DisplayError::Count { name: name.into() })?;
                Ok(Self {
                    name: name.into(),
                    views,
                    kind: Kind::Lenticular,
                })
            }
        }
    }

    /// A built-in name, a TOML description or a PNG mask, tried in this order.
    ///
    /// A file that is called like a built-in display is reached as `./NAME`.
    pub fn load(name_or_path: &str) -> Result<Self, DisplayError> {
        let path = Path::new(name_or_path);
        match Self::named(name_or_path) {
            Err(DisplayError::Unknown { .. }) if path.is_file() || file::looks_like_path(path) => {
                file::load(path)
            }
            result => result,
        }
    }

    /// The mask of `views` views for a picture lying at `placement`.
    pub fn mask(&self, placement: &Placement, views: u32) -> Result<Mask, MaskError> {
        if !(1..=MAX_VIEWS).contains(&views) {
            return Err(MaskError::Views { views });
        }
        match &self.kind {
            Kind::Lenticular => Mask::by_rows(placement, |first, _, row| {
                for (x, out) in (first..).zip(row) {
                    *out = [x.rem_euclid(i64::from(views)) as u16; 3];
                }
            }),
            Kind::Huebner(order) => huebner::mask(placement, views, *order),
            Kind::Slanted(lens) => lens.mask(placement, views),
            Kind::MaskFile { path, mask } => {
                mask.check_indices(path, views)?;
                mask.crop(path, placement)
            }
        }
    }
}
