//! What a window over a monitor does for the pictures of programs, whichever system of windows it is of.
#![forbid(unsafe_code)]

use super::{Monitor, WindowError};
use crate::control::panel::{Frame, PIXEL};
use std::fs::File;
use std::os::fd::BorrowedFd;
use std::os::unix::fs::FileExt;

/// Where a picture is in a window: left, top, width and height in pixels.
pub(super) type Place = ([u16; 2], [u16; 2]);

/// A window over a monitor. Nothing here waits for the monitor.
pub(super) trait Surface: Send {
    /// The monitor that it covers.
    fn monitor(&self) -> &Monitor;

    /// What can be read when the server has something to say.
    fn connection(&self) -> BorrowedFd<'_>;

    /// Handles what the server has said. Returns whether the window was closed.
    fn handle_events(&mut self) -> Result<bool, WindowError>;

    /// Sends what is to be sent.
    fn flush(&mut self) -> Result<(), WindowError>;

    /// A program with this number writes its pictures to a file.
    fn attach(&mut self, program: u32, file: &File);

    /// A program has ended.
    fn detach(&mut self, program: u32) -> Result<(), WindowError>;

    /// Whether it takes a picture now.
    fn is_free(&self) -> bool;

    /// Reads the part of a picture that it shows. It shows it after [`Surface::show`], and is black elsewhere.
    fn take(&mut self, picture: Picture<'_>, seen: Seen) -> Result<(), WindowError>;

    /// Shows what it has taken from the next refresh of the monitor on.
    fn show(&mut self) -> Result<(), WindowError>;
}

/// A picture of a program, in a slot of its file.
#[derive(Clone, Copy)]
pub(super) struct Picture<'a> {
    /// The number of the program.
    pub(super) program: u32,
    pub(super) file: &'a File,
    /// Where the slot begins, in bytes.
    pub(super) offset: u64,
    pub(super) frame: Frame,
}

/// The part of a picture that a window shows.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    /// Left and top in the picture as it lies in its slot.
    pub(super) from: [u16; 2],
    /// Where that is in the window.
    pub(super) place: Place,
}

impl Picture<'_> {
    /// What is seen of it in a row from the top, blue, green, red and a byte without meaning.
    pub(super) fn read(&self, seen: Seen, row: u16, out: &mut [u8]) -> Result<(), WindowError> {
        let texel = u64::from(seen.from[1]) + u64::from(row);
        let texel = texel * u64::from(self.frame.size[0]) + u64::from(seen.from[0]);
        let read = self
            .file
            .read_exact_at(out, self.offset + texel * PIXEL as u64);
        read.map_err(|error| WindowError::Socket(error.to_string()))
    }
}

impl Seen {
    /// What a window shows of a picture, where the window is the part `at` of the panel with this size.
    pub(super) fn of(frame: Frame, at: [u32; 2], size: (u32, u32)) -> Self {
        let axis = |axis: usize, side: u32| {
            let (start, end) = (at[axis], at[axis] + side);
            let first = u32::from(frame.at[axis]).max(start);
            let last = (u32::from(frame.at[axis]) + u32::from(frame.size[axis])).min(end);
            let from = first - u32::from(frame.at[axis]);
            [from, first - start, last.saturating_sub(first)].map(|n| n as u16)
        };
        let ([x, left, width], [y, top, height]) = (axis(0, size.0), axis(1, size.1));
        Self {
            from: [x, y],
            place: ([left, top], [width, height]),
        }
    }

    /// Nothing of the picture is in the window.
    pub(super) fn is_empty(&self) -> bool {
        self.place.1.contains(&0)
    }
}
