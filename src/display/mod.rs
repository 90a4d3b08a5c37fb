//! Panel descriptions and their masks; pure, without GL.
//!
//! Spaces: screen pixels `(x, row)`, `x` to the right, `row` downwards from the top of the *screen*, both 0-based and
//! whole. Subpixels of a pixel are numbered `c = 0, 1, 2` from the left; on an RGB panel these are R, G and B. View 0
//! is the leftmost camera.
//!
//! The kinds and an asked number of views N that is not the native one: a `lenticular` and a `huebner` mask are the
//! same structure modulo N, that is a sheet made for N views, so every view is shown. Lenses (`slanted`, `integer`,
//! `looking-glass`, `leia`) keep their pitch and spread N views over it; to drive one fixed piece of optics with another N,
//! describe it as `slanted` (`slanted8` is Hübner's filter as such a lens). A pattern, a table and a mask file are what they are
//! and need N above their largest index.
#![forbid(unsafe_code)]

mod bias;
mod budget;
mod builtin;
mod calibration;
mod cameras;
mod describe;
mod error;
mod fields;
mod file;
mod fit;
mod huebner;
mod integer;
mod lattice;
mod leia;
mod lens;
mod lens_phase;
mod looking_glass;
mod mask;
mod number;
mod pattern;
mod quilt;
mod rotation;
mod slanted;
#[cfg(test)]
mod tests;
mod wall;
mod wall_file;
mod written;

pub use bias::Bias;
pub use budget::{Budget, MM_PER_INCH};
pub use builtin::{Builtin, builtins};
pub use cameras::{Cameras, Spacing};
pub use error::{DisplayError, MaskError};
pub use fit::Fit;
pub use integer::Integer;
pub use leia::Leia;
pub use lens::{Lens, LensPart};
pub use lens_phase::LensPhase;
pub use looking_glass::{CellPattern, LookingGlass};
pub use mask::{GUARD, Mask};
pub use number::Number;
pub use pattern::Pattern;
pub use quilt::{QuiltError, QuiltName};
pub use rotation::Rotation;
pub use slanted::Slanted;
pub use wall::{CELL, Homography, Light, Node, Wall, WallPanel, apply, placed};

use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Largest number of views: indices are 16-bit and 65535 is the guard.
pub const MAX_VIEWS: u32 = 65_535;

/// Steps from view to view in [`Display::fine_mask`].
pub const FINE: u16 = 256;

/// Largest number of views that have such steps.
pub const MAX_FINE_VIEWS: u32 = 255;

/// A panel: how many views it shows and which subpixel shows which.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// Name shown to the user.
    pub name: String,
    /// Native number of views.
    pub views: u32,
    /// Which subpixel shows which view.
    pub kind: Kind,
    /// How the glass is turned against the picture.
    pub rotation: Rotation,
    /// Its properties beside the mask.
    pub facts: Facts,
}

/// Properties of a panel beside its mask; none of them changes the mask.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Facts {
    /// Width and height of the screen in pixels, as the picture stands on it.
    pub screen: Option<(u32, u32)>,
    /// Pixels per inch.
    pub dpi: Option<f64>,
    /// Angle over which the views are spread, degrees.
    pub cone: Option<f64>,
    /// Columns and rows of its quilt.
    pub quilt: Option<(u32, u32)>,
    /// Where in that angle the cameras stand, if the description says it; see [`Display::spacing`].
    pub spacing: Option<Spacing>,
    /// Largest disparity between neighbouring views, in pixels of the screen.
    pub budget_px: Option<f64>,
    /// The same, in mm.
    pub budget_mm: Option<f64>,
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
    /// Phases in whole steps, with a table.
    Integer(Integer),
    /// A Looking Glass with its calibration.
    LookingGlass(LookingGlass),
    /// A Leia-type panel.
    Leia(Leia),
    /// A pattern written by hand.
    Pattern(Pattern),
    /// A picture of the mask of the whole screen.
    MaskFile {
        /// Where it was read from, for messages.
        path: PathBuf,
        /// Its values; shared, as a 4K mask is 50 MB.
        mask: Arc<Mask>,
    },
    /// Several panels that show one picture.
    Wall(Arc<Wall>),
    /// No mask: the model is known, the single device is not. Quilts can be made for it.
    Uncalibrated,
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
/// Masks belong to the panel, not to the window, so their phase counts from the screen's corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placement {
    /// Width of the screen.
    pub screen_width: u32,
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
            screen_width: width,
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
        Self::new("huebner8", 8, Kind::Huebner(SubpixelOrder::Rgb))
    }
}

impl Display {
    /// An upright panel of which only the mask is known.
    pub fn new(name: impl Into<String>, views: u32, kind: Kind) -> Self {
        Self {
            name: name.into(),
            views,
            kind,
            rotation: Rotation::None,
            facts: Facts::default(),
        }
    }

    /// A built-in display.
    pub fn named(name: &str) -> Result<Self, DisplayError> {
        builtin::named(name)
    }

    /// A built-in name, a TOML description, the calibration JSON of a Looking Glass or a PNG mask, tried in this order.
    ///
    /// A file that is called like a built-in display is reached as `./NAME`.
    pub fn load(name_or_path: &str) -> Result<Self, DisplayError> {
        let path = Path::new(name_or_path);
        match Self::named(name_or_path) {
            Err(DisplayError::Unknown { .. }) if path.is_file() || file::looks_like_path(path) => {
                file::load(path, false)
            }
            result => result,
        }
    }

    /// As [`Display::load`] for a panel of a wall: a path is relative to `folder`, and a wall is refused, so that none has itself as a panel.
    fn load_for_wall(name_or_path: &str, folder: &Path) -> Result<Self, DisplayError> {
        match Self::named(name_or_path) {
            Err(DisplayError::Unknown { .. }) => file::load(&folder.join(name_or_path), true),
            result => result,
        }
    }

    /// The mask of `views` views for a picture lying at `placement`.
    pub fn mask(&self, placement: &Placement, views: u32) -> Result<Mask, MaskError> {
        if !(1..=MAX_VIEWS).contains(&views) {
            return Err(MaskError::Views { views });
        }
        self.check_views(views)?;
        self.rotation
            .mask(placement, |placement| self.upright(placement, views))
    }

    /// As [`Display::mask`], in steps of a 256th of a view: where between the views a subpixel lies. Panels that have no places
    /// between views have the middle of one. At most [`MAX_FINE_VIEWS`] views.
    pub fn fine_mask(&self, placement: &Placement, views: u32) -> Result<Mask, MaskError> {
        if !(1..=MAX_FINE_VIEWS).contains(&views) {
            return Err(MaskError::Views { views });
        }
        let steps = match &self.kind {
            Kind::Integer(steps) => steps.table.is_empty(),
            Kind::Slanted(_) | Kind::LookingGlass(_) | Kind::Leia(_) => true,
            _ => false,
        };
        if steps {
            return self.mask(placement, views * u32::from(FINE));
        }
        let mut mask = self.mask(placement, views)?;
        mask.map(|view| view.saturating_mul(FINE).saturating_add(FINE / 2));
        Ok(mask)
    }

    /// Refuses a number of views that a pattern, a table or a mask file cannot do with.
    pub fn check_views(&self, views: u32) -> Result<(), MaskError> {
        match &self.kind {
            Kind::Pattern(pattern) => pattern.check_views(views),
            Kind::Integer(steps) => steps.check_views(views),
            Kind::MaskFile { path, mask } => mask.check_indices(path, views),
            Kind::Wall(wall) => wall.check_views(views),
            _ => Ok(()),
        }
    }

    /// Refuses a panel without a mask.
    pub fn check_mask(&self) -> Result<(), MaskError> {
        match &self.kind {
            Kind::Uncalibrated => Err(self.uncalibrated()),
            _ => Ok(()),
        }
    }

    fn uncalibrated(&self) -> MaskError {
        MaskError::Uncalibrated {
            name: self.name.clone(),
        }
    }

    /// The mask as the glass is built.
    fn upright(&self, placement: &Placement, views: u32) -> Result<Mask, MaskError> {
        match &self.kind {
            Kind::Lenticular => Mask::by_rows(placement, |first, _, row| {
                for (x, out) in (first..).zip(row) {
                    *out = [x.rem_euclid(i64::from(views)) as u16; 3];
                }
            }),
            Kind::Huebner(order) => huebner::mask(placement, views, *order),
            Kind::Slanted(lens) => lens.mask(placement, views),
            Kind::Integer(steps) => steps.mask(placement, views),
            Kind::LookingGlass(device) => device.mask(placement, views),
            Kind::Leia(panel) => panel.mask(placement, self.views, views),
            Kind::Pattern(pattern) => pattern.mask(placement),
            Kind::MaskFile { path, mask } => mask.crop(path, placement),
            Kind::Wall(wall) => wall.mask(placement, views),
            Kind::Uncalibrated => Err(self.uncalibrated()),
        }
    }
}
