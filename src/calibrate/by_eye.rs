//! A sheet fitted by eye: pictures through its mask, and keys that change its numbers while the user looks at one of them.
//!
//! With the phase `Φ` of the real sheet and `φ` that of the description, an eye sees the view of `Φ − φ` at each place: stripes where
//! the difference grows over the panel, one colour where it does not. `1/pitch` sets how fast it grows along a row and, with the
//! slant, from row to row, so each stripe is a whole turn of error: a hundredth of a subpixel of pitch is one on a full HD panel.
#![forbid(unsafe_code)]

use super::{CalibrateError, written};
use crate::display::{Display, DisplayError, Kind, Lens, LensPart, MaskError, Placement};
use image::{Rgb, RgbImage};
use std::path::Path;

/// How much larger a step is with Shift.
const LARGE: f64 = 10.0;
/// Digits kept of a nudged number.
const DIGITS: usize = 8;
const WHITE: [u8; 3] = [255; 3];
const BLACK: [u8; 3] = [0; 3];
const LEFT: [u8; 3] = [255, 0, 0];
const RIGHT: [u8; 3] = [0, 0, 255];

/// The effect of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// A number of the sheet, up or down.
    Nudge(LensPart, bool),
    /// One view is white and all others black.
    White,
    /// The next view is the white one.
    NextView,
    /// The left half of the views is red, the right one blue.
    Halves,
    /// The views run the other way.
    Invert,
    /// The display file is written.
    Save,
    /// The end.
    Leave,
}

/// Keys: their X keysym (lower case), their name for people, and their effect.
pub const KEYS: [(u32, &str, Action); 15] = [
    (0xff52, "Up", Action::Nudge(LensPart::Pitch, true)),
    (0xff54, "Down", Action::Nudge(LensPart::Pitch, false)),
    (0xff55, "Page Up", Action::Nudge(LensPart::Slant, true)),
    (0xff56, "Page Down", Action::Nudge(LensPart::Slant, false)),
    (0xff53, "Right", Action::Nudge(LensPart::Offset, true)),
    (0xff51, "Left", Action::Nudge(LensPart::Offset, false)),
    (0x77, "w", Action::White),
    (0x6e, "n", Action::NextView),
    (0x68, "h", Action::Halves),
    (0x69, "i", Action::Invert),
    (0x73, "s", Action::Save),
    (0xff0d, "Return", Action::Save),
    (0xff8d, "Enter", Action::Save),
    (0xff1b, "Escape", Action::Leave),
    (0x71, "q", Action::Leave),
];

/// The effect of a key, by its keysym.
#[must_use]
pub fn action(keysym: u32) -> Option<Action> {
    let found = KEYS.iter().find(|(known, ..)| *known == keysym);
    found.map(|(_, _, action)| *action)
}

/// The picture in the views.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scene {
    White(u32),
    Halves,
}

/// A sheet while it is fitted.
#[derive(Clone, Debug)]
pub struct ByEye {
    display: Display,
    lens: Lens,
    scene: Scene,
    size: (u32, u32),
    steps: [f64; 3],
}

impl ByEye {
    /// Begins with a description, on a panel of a size in pixels; none where the display is no slanted sheet.
    #[must_use]
    pub fn new(display: Display, size: (u32, u32)) -> Option<Self> {
        let lens = display.lens()?;
        let pitch = lens.pitch.to_f64();
        let (width, height) = (f64::from(size.0), f64::from(size.1));
        // What moves the far edge by a stripe, in fifths or finer: a key held down passes no stripe unseen.
        let stripe = [pitch * pitch / (3.0 * width), pitch / height, pitch];
        let middle = display.views.saturating_sub(1) / 2;
        Some(Self {
            display,
            lens,
            scene: Scene::White(middle),
            size,
            steps: stripe.map(|stripe| 10f64.powf((stripe / 5.0).log10().floor())),
        })
    }

    /// The small step of a number.
    #[must_use]
    pub fn step(&self, part: LensPart) -> f64 {
        let [pitch, slant, offset] = self.steps;
        match part {
            LensPart::Pitch => pitch,
            LensPart::Slant => slant,
            LensPart::Offset => offset,
        }
    }

    /// Another value for a number; nothing changes where it cannot be.
    pub fn set(&mut self, part: LensPart, text: &str) -> Result<(), DisplayError> {
        self.lens = self.lens.with(part, text)?;
        self.display.set_lens(self.lens);
        Ok(())
    }

    /// Applies a key that changes the picture; saving and leaving are the caller's.
    pub fn act(&mut self, action: Action, large: bool) -> Result<(), DisplayError> {
        match action {
            Action::Nudge(part, up) => {
                let step = self.step(part) * if large { LARGE } else { 1.0 };
                let step = if up { step } else { -step };
                let value = written::rounded(self.lens.get(part).to_f64() + step, DIGITS);
                self.set(part, &value.to_string())?;
            }
            Action::White | Action::NextView => {
                self.scene = match self.scene {
                    Scene::White(view) if action == Action::NextView => {
                        Scene::White((view + 1) % self.display.views)
                    }
                    Scene::White(view) => Scene::White(view),
                    Scene::Halves => Scene::White(self.display.views.saturating_sub(1) / 2),
                };
            }
            Action::Halves => self.scene = Scene::Halves,
            Action::Invert => {
                if let Kind::Slanted(sheet) = &mut self.display.kind {
                    sheet.inverted = !sheet.inverted;
                }
            }
            Action::Save | Action::Leave => {}
        }
        Ok(())
    }

    /// The display with the numbers as they are now.
    #[must_use]
    pub fn display(&self) -> &Display {
        &self.display
    }

    /// The picture for the panel; row 0 on top.
    pub fn picture(&self) -> Result<RgbImage, MaskError> {
        let (width, height) = self.size;
        let mask = self
            .display
            .mask(&Placement::full_screen(width, height), self.display.views)?;
        let colours: Vec<_> = (0..self.display.views)
            .map(|view| self.colour(view))
            .collect();
        Ok(RgbImage::from_fn(width, height, |x, row| {
            let views = mask.at(x, row).unwrap_or_default();
            let light = |c: usize| {
                let colour = colours.get(usize::from(views[c]));
                colour.map_or(0, |colour| colour[c])
            };
            Rgb([light(0), light(1), light(2)])
        }))
    }

    fn colour(&self, view: u32) -> [u8; 3] {
        let others = self.display.views - 1 - view;
        match self.scene {
            Scene::White(white) if view == white => WHITE,
            Scene::White(_) => BLACK,
            Scene::Halves if view < others => LEFT,
            Scene::Halves if view > others => RIGHT,
            // The middle one of an odd number belongs to neither half.
            Scene::Halves => BLACK,
        }
    }

    /// Writes the display file.
    pub fn write(&self, path: &Path) -> Result<(), CalibrateError> {
        written::write(&self.display, path)
    }
}

/// The numbers and the picture, in one line.
impl std::fmt::Display for ByEye {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for part in LensPart::ALL {
            write!(f, "{} {}  ", part.name(), self.lens.get(part).to_f64())?;
        }
        let inverted = matches!(&self.display.kind, Kind::Slanted(sheet) if sheet.inverted);
        write!(f, "inverted {inverted}  ")?;
        match self.scene {
            Scene::White(view) => write!(f, "view {view} of {} white", self.display.views),
            Scene::Halves => write!(f, "left views red, right views blue"),
        }
    }
}
