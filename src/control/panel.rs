//! What the layer in a program and the window of the panel tell each other.
//!
//! The window opens a socket and a file of [`SLOTS`] pictures, each as large as the panel, four bytes a pixel (blue, green, red and one without
//! meaning), rows from the top down. The layer connects and reads a [`Hello`]. It writes a picture into a slot that is free, and sends a [`Frame`].
//! The window sends the number of a slot that is free again, in one byte. So neither waits for the other, and a picture is shown whole or not at all. Where
//! the newest picture comes later, or is left out because no slot is free, the layer says so: a program that shows no frame after that has to be woken.
#![forbid(unsafe_code)]

use std::path::{Path, PathBuf};

/// Pictures in the file: one that is shown, one that waits, and one that is written.
pub const SLOTS: u8 = 3;
/// Bytes of a pixel.
pub const PIXEL: usize = 4;
/// The first word of a [`Hello`], with the version of what follows.
const GREETING: &str = "manyview-panel-1";

/// What the window sends to a program that connects: a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hello {
    /// Width and height of the panel in pixels.
    pub size: (u32, u32),
    /// The file of the pictures.
    pub file: PathBuf,
}

impl Hello {
    /// The line, with its end.
    #[must_use]
    pub fn line(&self) -> String {
        let (width, height) = self.size;
        format!("{GREETING} {width} {height} {}\n", self.file.display())
    }

    /// Of a line without its end. None if it is another program's, or another version's.
    #[must_use]
    pub fn of(line: &str) -> Option<Self> {
        let mut words = line.splitn(4, ' ');
        let size = |word: Option<&str>| {
            let side = word?.parse().ok()?;
            (1..=u32::from(u16::MAX)).contains(&side).then_some(side)
        };
        (words.next() == Some(GREETING)).then_some(())?;
        Some(Self {
            size: (size(words.next())?, size(words.next())?),
            file: Path::new(words.next()?).to_owned(),
        })
    }
}

/// Bytes of one slot.
#[must_use]
pub fn slot_bytes((width, height): (u32, u32)) -> u64 {
    u64::from(width) * u64::from(height) * PIXEL as u64
}

/// What the layer sends for a frame: nine bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sent {
    /// A picture.
    pub picture: Option<Frame>,
    /// A newer one is to come.
    pub is_behind: bool,
}

/// A picture in a slot, whose rows follow each other without gaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// The number of the slot.
    pub slot: u8,
    /// Left and top in pixels of the panel, from its upper left corner.
    pub at: [u16; 2],
    /// Width and height in pixels.
    pub size: [u16; 2],
}

/// The bit of the first byte that says that a newer picture is to come.
const BEHIND: u8 = 0x80;
/// The other bits of the first byte, where there is no picture.
const NO_SLOT: u8 = 0x7f;

impl Sent {
    /// Bytes of it.
    pub const BYTES: usize = 9;

    /// As bytes.
    #[must_use]
    pub fn bytes(&self) -> [u8; Self::BYTES] {
        let mut bytes = [0; Self::BYTES];
        let slot = self.picture.map_or(NO_SLOT, |frame| frame.slot);
        bytes[0] = slot | if self.is_behind { BEHIND } else { 0 };
        let numbers = self.picture.map(|frame| [frame.at, frame.size]);
        let numbers = numbers.into_iter().flatten().flatten();
        for (number, place) in numbers.zip(bytes[1..].chunks_exact_mut(2)) {
            place.copy_from_slice(&number.to_le_bytes());
        }
        bytes
    }

    /// Of bytes. A picture that is in no slot, or not within a panel of this size, is none.
    #[must_use]
    pub fn of(bytes: [u8; Self::BYTES], (width, height): (u32, u32)) -> Self {
        let [first, x0, x1, y0, y1, w0, w1, h0, h1] = bytes;
        let slot = first & !BEHIND;
        let [x, y, w, h] = [[x0, x1], [y0, y1], [w0, w1], [h0, h1]].map(u16::from_le_bytes);
        let inside = |at: u16, side: u16, all: u32| u32::from(at) + u32::from(side) <= all;
        let fits = slot < SLOTS && inside(x, w, width) && inside(y, h, height);
        Self {
            picture: fits.then_some(Frame {
                slot,
                at: [x, y],
                size: [w, h],
            }),
            is_behind: first & BEHIND != 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hello_is_understood_and_others_are_not() {
        let hello = Hello {
            size: (3840, 2160),
            file: "/run/user/7/manyview/panel 1.pictures".into(),
        };
        let line = hello.line();
        assert_eq!(Hello::of(line.trim_end()), Some(hello));
        for wrong in [
            "",
            "manyview-panel-2 1 1 /a",
            "manyview-panel-1 0 1 /a",
            "manyview-panel-1 70000 1 /a",
            "manyview-panel-1 1 1",
        ] {
            assert_eq!(Hello::of(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn a_frame_is_within_the_panel() {
        let frame = Frame {
            slot: 2,
            at: [300, 7],
            size: [1000, 593],
        };
        let sent = |frame, is_behind| Sent {
            picture: Some(frame),
            is_behind,
        };
        let nothing = Sent {
            picture: None,
            is_behind: true,
        };
        for message in [sent(frame, false), sent(frame, true), nothing] {
            assert_eq!(Sent::of(message.bytes(), (1300, 600)), message);
        }
        let bytes = sent(frame, true).bytes();
        assert_eq!(Sent::of(bytes, (1299, 600)), nothing);
        assert_eq!(Sent::of(bytes, (1300, 599)), nothing);
        let frame = Frame {
            slot: SLOTS,
            ..frame
        };
        assert_eq!(Sent::of(sent(frame, true).bytes(), (1300, 600)), nothing);
    }
}
