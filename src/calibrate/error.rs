//! Why a panel is not measured; every message is one sentence and ends with the remedy.
#![forbid(unsafe_code)]

use std::io;

/// Why there is no pattern, or no answer from the photos.
#[derive(Debug, thiserror::Error)]
pub enum CalibrateError {
    /// A number of the setup is outside of what a panel can have.
    #[error("{field} is {value}; give {expected}")]
    Setup {
        /// What is wrong.
        field: &'static str,
        /// As given.
        value: f64,
        /// The bounds.
        expected: &'static str,
    },
    /// No pitch.
    #[error(
        "--pitch is '{text}'; give subpixels from lens to lens along a row such as 8.7 or 16/3, or with --dpi or --screen-mm the 0.286mm or 60lpi of a data sheet"
    )]
    Pitch {
        /// As given.
        text: String,
    },
    /// No slant.
    #[error(
        "--slant is '{text}'; give subpixels per row downwards such as 0.66 or 2/3, or the angle to the columns of pixels such as 12.5deg"
    )]
    Slant {
        /// As given.
        text: String,
    },
    /// Not a panel that can be measured.
    #[error("{reason}")]
    Display {
        /// One sentence with the remedy.
        reason: String,
    },
    /// A fit by eye that ends nowhere.
    #[error(
        "a fit by eye ends in a display file; give --out FILE.toml, or --photos to show the pattern that photos are taken of"
    )]
    NoOut,
    /// Millimetres without a scale.
    #[error("{option} is in mm, so the size of the screen is needed; give --screen-mm or --dpi")]
    NoScreenSize {
        /// The option that was given.
        option: &'static str,
    },
    /// Millimetres that do not fit the pixels.
    #[error(
        "--screen-mm is '{text}'; give width and height in mm of the shape that --size has, such as 344x194"
    )]
    ScreenSize {
        /// As given.
        text: String,
    },
    /// No photo at all.
    #[error("no photo is given; give one or more photos of the pattern")]
    NoPhoto,
    /// The file is absent or forbidden.
    #[error("photo `{photo}` cannot be read: {source}; check the path and its permissions")]
    Read {
        /// The file.
        photo: String,
        /// From the system.
        source: io::Error,
    },
    /// Neither JPEG nor PNG.
    #[error("photo `{photo}` is no picture that can be used: {reason}; give a JPEG or PNG file")]
    Decode {
        /// The file.
        photo: String,
        /// From the decoder.
        reason: String,
    },
    /// Photos of one camera have one size.
    #[error(
        "photo `{photo}` is {width}x{height} and the first one is {first_width}x{first_height}; \
         take all photos with one camera, without zoom, and do not crop them"
    )]
    Sizes {
        /// The file.
        photo: String,
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// Pixels.
        first_width: u32,
        /// Pixels.
        first_height: u32,
    },
    /// No white frame with the mark.
    #[error(
        "photo `{photo}`: the panel is not found; show the pattern full screen, darken the room, \
         and keep the whole white frame with its dark surroundings in the photo"
    )]
    NoPanel {
        /// The file.
        photo: String,
    },
    /// A mirror image.
    #[error("photo `{photo}`: the panel is mirrored; turn off the mirroring of the camera")]
    Mirrored {
        /// The file.
        photo: String,
    },
    /// The code in the picture is not that of the setup.
    #[error(
        "photo `{photo}` shows a pattern with code {seen:03x} where {expected:03x} belongs to this panel and size; \
         show the pattern made with the same --display and --size, or take a sharper photo"
    )]
    OtherPattern {
        /// The file.
        photo: String,
        /// Read from the photo.
        seen: u16,
        /// Of the setup.
        expected: u16,
    },
    /// The gratings, where another pattern belongs.
    #[error(
        "photo `{photo}` shows the gratings for a panel whose pitch is not known; leave out --pitch and --display, or show the pattern made with them"
    )]
    Gratings {
        /// The file.
        photo: String,
    },
    /// No gratings, or those of another panel.
    #[error(
        "photo `{photo}` shows another pattern than the gratings for a panel of this --size; check the size, give the --display or --pitch that the pattern was made with, or take a sharper photo"
    )]
    NoGratings {
        /// The file.
        photo: String,
    },
    /// The picture was resampled on its way to the pixels.
    #[error(
        "photo `{photo}`: the pattern was shown scaled, its finest rows are blurred; show it with `manyview calibrate show`, or full screen at 100 %, at the panel's own \
         resolution and without a scaled desk"
    )]
    Scaled {
        /// The file.
        photo: String,
    },
    /// The picture does not begin at the first pixel.
    #[error(
        "photo `{photo}`: the outermost pixels at the {side} are not those of the pattern, which was shown beside its place; show it full screen, without a border or a panel \
         of the desk, or take the photo straight from the front if the bezel hides them"
    )]
    Moved {
        /// The file.
        photo: String,
        /// A side of the panel.
        side: &'static str,
    },
    /// Too few camera pixels.
    #[error(
        "photo `{photo}`: the panel is only {width:.0} pixels wide, too few for {fringes:.0} fringes; \
         go nearer, or use a camera with more pixels"
    )]
    TooSmall {
        /// The file.
        photo: String,
        /// Width of the panel in the photo, pixels.
        width: f64,
        /// Fringes over the height of the panel.
        fringes: f64,
    },
    /// White without detail.
    #[error(
        "photo `{photo}`: {percent:.0} % of the pattern is overexposed or under glare; \
         expose shorter and keep lamps from mirroring in the panel"
    )]
    Glare {
        /// The file.
        photo: String,
        /// Part of the pattern.
        percent: f64,
    },
    /// The frame is there but not sharp.
    #[error(
        "photo `{photo}`: the edges of the frame are not clear; hold the camera still and focus on the panel"
    )]
    Edges {
        /// The file.
        photo: String,
    },
    /// Fringes without contrast.
    #[error(
        "photo `{photo}`: the fringes have {percent:.1} % of their contrast; \
         hold the camera still, focus on the panel, and check the pitch of --display"
    )]
    Contrast {
        /// The file.
        photo: String,
        /// Of the contrast shown.
        percent: f64,
    },
    /// No single frequency stands out.
    #[error(
        "photo `{photo}`: no single fringe frequency stands out (the best is {ratio:.1} times the next); \
         take a sharper photo, or measure the pitch from a photo of the gratings, which `manyview calibrate pattern` makes without --display and --pitch"
    )]
    Frequency {
        /// The file.
        photo: String,
        /// Amplitude of the best over that of the next.
        ratio: f64,
    },
    /// The frequency is where the search ends.
    #[error(
        "photo `{photo}`: the fringes are outside of what a pitch right to 1 % allows; \
         measure pitch and slant from a photo of the gratings, which `manyview calibrate pattern` makes without --display and --pitch, \
         or go farther away if the cone is narrow"
    )]
    Outside {
        /// The file.
        photo: String,
    },
    /// Gratings without beats of one sheet.
    #[error(
        "photo `{photo}`: no single lens sheet explains what is seen of the gratings; take a sharp photo straight from the front, which the panel fills and in which nothing mirrors, \
         or give --pitch, --slant and --views"
    )]
    NoSheet {
        /// The file.
        photo: String,
    },
    /// One sheet, but not known well enough for the next pattern.
    #[error(
        "photo `{photo}` tells the pitch to ± {percent:.1} % and the slant to ± {slant:.3} only; give --cone from the data sheet, and --focal where the photo does not say it, \
         or take a sharper photo from farther away"
    )]
    Unsure {
        /// The file.
        photo: String,
        /// Standard deviation of the pitch.
        percent: f64,
        /// Standard deviation of the slant, subpixels per row.
        slant: f64,
    },
    /// The fit did not come to rest.
    #[error(
        "the photos contradict each other; leave out those that are blurred or of another pattern"
    )]
    NoFit,
    /// The answer exists and is not good enough.
    #[error("the fit is doubtful: {reasons}")]
    Doubtful {
        /// Each with its remedy.
        reasons: String,
    },
    /// A result that cannot be written.
    #[error("{what} cannot be written to {file}: {reason}; choose another path")]
    Write {
        /// Which result.
        what: &'static str,
        /// The path.
        file: String,
        /// From the system.
        reason: String,
    },
}
