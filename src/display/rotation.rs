//! A panel that is mounted turned: its own pixels against those of the picture.
#![forbid(unsafe_code)]

use super::{Mask, MaskError, Placement};

/// Clockwise, from the glass as it is described to the glass as it stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rotation {
    /// As described.
    #[default]
    None,
    /// The top of the glass is on the right.
    Quarter,
    /// The top of the glass is below.
    Half,
    /// The top of the glass is on the left.
    ThreeQuarters,
}

impl Rotation {
    /// 0, 90, 180 or 270.
    pub fn degrees(self) -> u32 {
        match self {
            Self::None => 0,
            Self::Quarter => 90,
            Self::Half => 180,
            Self::ThreeQuarters => 270,
        }
    }

    /// From 0, 90, 180 or 270 degrees.
    pub fn from_degrees(degrees: i64) -> Option<Self> {
        let all = [Self::None, Self::Quarter, Self::Half, Self::ThreeQuarters];
        all.into_iter()
            .find(|rotation| i64::from(rotation.degrees()) == degrees)
    }

    /// The mask of a picture on the turned glass, from the mask of any part of the upright one.
    pub(super) fn mask(
        self,
        placement: &Placement,
        upright: impl Fn(&Placement) -> Result<Mask, MaskError>,
    ) -> Result<Mask, MaskError> {
        let &Placement {
            screen_width,
            screen_height,
            x,
            y,
            width,
            height,
        } = placement;
        if self == Self::None {
            return upright(placement);
        }
        let far = |start: i32, length: u32, all: u32| {
            let end = i64::from(all) - i64::from(start) - i64::from(length);
            end.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
        };
        let turned = self != Self::Half;
        // The left top corner of the same part on the upright glass.
        let (left, top) = match self {
            Self::None => (x, y),
            Self::Quarter => (y, far(x, width, screen_width)),
            Self::Half => (far(x, width, screen_width), far(y, height, screen_height)),
            Self::ThreeQuarters => (far(y, height, screen_height), x),
        };
        let swap = |(a, b): (u32, u32)| if turned { (b, a) } else { (a, b) };
        let (upright_width, upright_height) = swap((width, height));
        let (glass_width, glass_height) = swap((screen_width, screen_height));
        let mask = upright(&Placement {
            screen_width: glass_width,
            screen_height: glass_height,
            x: left,
            y: top,
            width: upright_width,
            height: upright_height,
        })?;
        let (last_x, last_y) = (width.saturating_sub(1), height.saturating_sub(1));
        Mask::by_rows(placement, |first, row, out| {
            let row = (row - i64::from(y)) as u32;
            let start = (first - i64::from(x)) as u32;
            for (x, out) in (start..).zip(out) {
                let (upright_x, upright_row) = match self {
                    Self::None => (x, row),
                    Self::Quarter => (row, last_x - x),
                    Self::Half => (last_x - x, last_y - row),
                    Self::ThreeQuarters => (last_y - row, x),
                };
                if let Some(views) = mask.at(upright_x, upright_row) {
                    *out = views;
                }
            }
        })
    }
}
