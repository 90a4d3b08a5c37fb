//! What can be wrong with a panel description or a mask; every message is one sentence and ends with the remedy.
#![forbid(unsafe_code)]

use super::MAX_VIEWS;
use super::file::MOST_BYTES;
use std::io;

/// Why a display cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum DisplayError {
    /// Neither a name nor a file.
    #[error(
        "no display is called `{name}` and there is no such file; \
         use a name that `manyview displays` lists, or give the path of a .toml description, a Looking Glass .json or a .png mask"
    )]
    Unknown {
        /// As asked for.
        name: String,
    },
    /// `lenticular-N` with an N that is none.
    #[error(
        "display `{name}`: N must be a whole number from 1 to {MAX_VIEWS}; write for example lenticular-5"
    )]
    Count {
        /// As asked for.
        name: String,
    },
    /// The file is absent or forbidden.
    #[error("display `{file}` cannot be read: {source}; check the path and its permissions")]
    Read {
        /// The description.
        file: String,
        /// From the system.
        source: io::Error,
    },
    /// The file has more bytes than a description can have.
    #[error("display `{file}` is larger than {MOST_BYTES} bytes; give a description of a panel")]
    Large {
        /// The description.
        file: String,
    },
    /// Not TOML, or a field that does not exist.
    #[error("display `{file}`: line {line}: {message}; correct that line of the file")]
    Toml {
        /// The description.
        file: String,
        /// 1-based.
        line: usize,
        /// From the parser, in one line.
        message: String,
    },
    /// A field with a value it cannot have.
    #[error("display `{file}`: field `{field}` must be {expected}, found {found}; {remedy}")]
    Field {
        /// The description.
        file: String,
        /// Its name.
        field: &'static str,
        /// The rule.
        expected: String,
        /// The value, as TOML.
        found: String,
        /// What to write instead.
        remedy: &'static str,
    },
    /// A field that the kind needs.
    #[error("display `{file}`: field `{field}` is missing; {remedy}")]
    Missing {
        /// The description.
        file: String,
        /// Its name.
        field: &'static str,
        /// What to write.
        remedy: &'static str,
    },
    /// A field that no kind reads.
    #[error(
        "display `{file}`: unknown field `{field}`; the fields for kind = \"{kind}\" are {known}"
    )]
    UnknownField {
        /// The description.
        file: String,
        /// As written.
        field: String,
        /// The kind that was given.
        kind: String,
        /// In words.
        known: String,
    },
    /// Not JSON.
    #[error("display `{file}`: line {line}: {message}; give the calibration as the device has it")]
    Json {
        /// The calibration.
        file: String,
        /// 1-based.
        line: usize,
        /// From the parser.
        message: String,
    },
    /// A field that the kind does not read.
    #[error(
        "display `{file}`: field `{field}` has no meaning for kind = \"{kind}\"; remove it or choose another kind"
    )]
    Unused {
        /// The description.
        file: String,
        /// Its name.
        field: &'static str,
        /// The kind that was given.
        kind: String,
    },
    /// A number of a sheet that it cannot have.
    #[error("{part} is '{value}'; give {expected}, such as 5.34 or 16/3")]
    Lens {
        /// Which number.
        part: &'static str,
        /// As given.
        value: String,
        /// The bounds.
        expected: &'static str,
    },
    /// The mask file.
    #[error(transparent)]
    Mask(#[from] MaskError),
}

/// Why a mask cannot be made, read or written.
#[derive(Debug, thiserror::Error)]
pub enum MaskError {
    /// N out of range.
    #[error(
        "the number of views must be from 1 to {MAX_VIEWS}, found {views}; give another --views"
    )]
    Views {
        /// As asked for.
        views: u32,
    },
    /// No pixels, or more than memory should be asked for.
    #[error(
        "a mask of {width}x{height} pixels cannot be made; \
         give a width and a height from 1 to 32768 with at most 2^26 pixels in all, which are two screens of 7680x4320"
    )]
    Size {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
    /// The file is absent or forbidden.
    #[error("mask `{file}` cannot be read: {source}; check the path and its permissions")]
    Read {
        /// The mask.
        file: String,
        /// From the system.
        source: io::Error,
    },
    /// The file cannot be made.
    #[error("mask `{file}` cannot be written: {reason}; check that its folder exists and has room")]
    Write {
        /// The mask.
        file: String,
        /// From the system or the encoder.
        reason: String,
    },
    /// Not a PNG, or a broken one.
    #[error("mask `{file}` is not a readable PNG: {reason}; give a 16-bit RGB PNG")]
    NotPng {
        /// The mask.
        file: String,
        /// From the decoder.
        reason: String,
    },
    /// A PNG whose values cannot be view indices.
    #[error(
        "mask `{file}` must be a 16-bit RGB PNG, found {found}; \
         save it with 16 bits per channel, three channels and no palette"
    )]
    Format {
        /// The mask.
        file: String,
        /// In words.
        found: String,
    },
    /// An index that is no view.
    #[error(
        "mask `{file}`: {channel} at column {x}, row {row} shows view {view}, but there are only {views} views \
         (0 to {last}); ask for at least {least} views or use 65535 for black",
        last = views - 1, least = view + 1
    )]
    Index {
        /// The mask.
        file: String,
        /// red, green or blue.
        channel: &'static str,
        /// Pixels from the left.
        x: u32,
        /// Pixels from the top.
        row: u32,
        /// The index found.
        view: u32,
        /// N.
        views: u32,
    },
    /// Lengths that no lens has.
    #[error(
        "the lenses of the display are too fine or too coarse to be computed with; check its pitch"
    )]
    Pitch,
    /// A view that is asked for by a pattern or a table and is not there.
    #[error("the display shows view {view}, but there are only {views} views (0 to {last}); ask for at least {least} views",
        last = views - 1, least = view + 1)]
    Table {
        /// The largest index.
        view: u32,
        /// N.
        views: u32,
    },
    /// A model whose devices differ.
    #[error(
        "display `{name}`: every device has a mask of its own; give its calibration as --display visual.json, \
         or use --output quilt"
    )]
    Uncalibrated {
        /// The display.
        name: String,
    },
    /// A mask of another picture.
    #[error(
        "mask `{file}` is {mask_width}x{mask_height} pixels, but the picture is {width}x{height} at column {x}, \
         row {y} of a screen of {screen_width}x{screen_height}; give a mask of the whole screen, or one of the window's size"
    )]
    WindowSize {
        /// The mask.
        file: String,
        /// Pixels.
        mask_width: u32,
        /// Pixels.
        mask_height: u32,
        /// Of the picture.
        width: u32,
        /// Of the picture.
        height: u32,
        /// Of the picture on the screen.
        x: i32,
        /// Of the picture on the screen.
        y: i32,
        /// Pixels.
        screen_width: u32,
        /// Pixels.
        screen_height: u32,
    },
}
