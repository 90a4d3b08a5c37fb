//! What can be wrong with the options; each message names the option, its value and the remedy.
#![forbid(unsafe_code)]

use super::field::Field;
use crate::display::MAX_FINE_VIEWS;
use std::path::PathBuf;

/// The depths that may be given, in words.
pub(super) const DEPTH_REMEDY: &str = "give a number from -10 (far before the panel) to 1 (infinitely far), 0 is on the panel, or crosshair or cursor to follow the scene";

/// Why the options cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ConfigError {
    /// N is no number, 0 or too large.
    #[error("{field} is '{value}'; give a whole number of views from 1 to {max}", max = super::MAX_VIEWS)]
    Views {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// A word that is not one of the choices.
    #[error("{field} is '{value}'; this version knows {choices}")]
    Choice {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
        /// What it could be.
        choices: String,
    },
    /// A picture of the occlusion camera, where there is none, or not yet.
    #[error(
        "{field} is '{value}', which needs an occlusion camera; give the strategy occlusion with it, and a frame from 2 on"
    )]
    NoReference {
        /// The option.
        field: Field,
        /// What it is.
        value: String,
    },
    /// An option of `hybrid` with another strategy.
    #[error(
        "{field} is for the strategy {strategy}; give {remedy} as '{strategy}' with it, or leave it out"
    )]
    OtherStrategy {
        /// The option.
        field: Field,
        /// The word of the strategy that it is for.
        strategy: &'static str,
        /// The other one.
        remedy: Field,
    },
    /// A key that cannot be bound.
    #[error("{field} has '{item}': {reason}")]
    Binding {
        /// The option.
        field: Field,
        /// The part of its value.
        item: String,
        /// What is wrong with it, and what would be right.
        reason: String,
    },
    /// Not cameras to choose from.
    #[error(
        "{field} is '{value}'; give SEPARATION:CONVERGENCE or auto, with commas between, such as 0.02:8,auto"
    )]
    Presets {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// A way to other cameras, where there are none.
    #[error("{field} is the time to other cameras; give {remedy} with it, or leave it out")]
    NoPresets {
        /// The option.
        field: Field,
        /// That of the cameras.
        remedy: Field,
    },
    /// Not a time.
    #[error("{field} is '{value}'; give seconds from 0 to 60")]
    Ramp {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// Not names of programs.
    #[error("{field} is '{value}'; give the file names of programs, with commas between")]
    ProgramNames {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// Points are not what the program draws, and yet they are to be proved.
    #[error(
        "{field} draws other points than the program does, and {proof} compares with what the program draws; leave one of them out"
    )]
    ProvedSurfaces {
        /// The option of the points.
        field: Field,
        /// That of the proof.
        proof: Field,
    },
    /// Two options that both give the number of true views.
    #[error("{count} and {rate} both say how many views are drawn; leave one of them out")]
    TrueViewsAndRate {
        /// The number of views.
        count: Field,
        /// The rate.
        rate: Field,
    },
    /// Not a number of true views.
    #[error(
        "{field} is '{value}'; give a whole number of views from 1 to {views}, as many as there are"
    )]
    TrueViews {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
        /// N.
        views: u32,
    },
    /// Not a frame rate.
    #[error("{field} is '{value}'; give frames per second from 1 to 1000")]
    Rate {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// Not a limit to the frame rate.
    #[error(
        "{field} is '{value}'; give frames per second from 1 to 1000, with :early or :late after them if you like, such as 60:early"
    )]
    FpsCap {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// A wall without windows.
    #[error(
        "the display is a wall, which is shown in windows of its panels; give --panel auto with manyview run, or another --output"
    )]
    WallWindow,
    /// A monitor for a wall.
    #[error(
        "{field} names a monitor, and the display is a wall, whose description names those of its panels; give auto"
    )]
    WallMonitor {
        /// The option.
        field: Field,
    },
    /// Filtered views on a wall.
    #[error(
        "{field} is for one panel, and the display is a wall, which shows the nearest view; leave it out"
    )]
    WallFilter {
        /// The option.
        field: Field,
    },
    /// An option of the panel's own window without that.
    #[error(
        "{field} is for a window of the panel's own; give {panel} as a monitor or auto with it, or leave it out"
    )]
    NoPanelWindow {
        /// The option.
        field: Field,
        /// The option that opens the window.
        panel: Field,
    },
    /// Two buffers for one window.
    #[error(
        "{field} is 'quad', for a stereo window of the program's own; give another output with {panel}"
    )]
    QuadPanel {
        /// The output.
        field: Field,
        /// The option that opens the window.
        panel: Field,
    },
    /// Pixels of a panel.
    #[error(
        "{field} is '{value}'; give width and height in pixels such as 1920x1080, each from 1 to 65535"
    )]
    PanelSize {
        /// The option.
        field: Field,
        /// As the user wrote it.
        value: String,
    },
    /// No name of a monitor.
    #[error("{field} is empty; give the name or the number of a monitor, or auto")]
    NoMonitor {
        /// The option.
        field: Field,
    },
    /// A view that does not exist.
    #[error("{field} asks for view {view} of {views}; views count from 0, so the last is view:{last}", last = views - 1)]
    ViewOutOfRange {
        /// The option.
        field: Field,
        /// The view asked for.
        view: u32,
        /// N
        views: u32,
    },
    /// An output for two eyes, and one view.
    #[error("{field} shows two eyes, and there is one view; ask for at least 2 views")]
    OneEye {
        /// The option.
        field: Field,
    },
    /// More views than a mask has steps for.
    #[error(
        "{field} blends at most {MAX_FINE_VIEWS} views, and there are {views}; leave it out or ask for fewer views"
    )]
    Fine {
        /// The option.
        field: Field,
        /// N.
        views: u32,
    },
    /// Not a finite number.
    #[error("{field} is '{value}'; give a finite number such as {example}")]
    Number {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
        /// A value that would do.
        example: &'static str,
    },
    /// Zero or negative where only a positive number makes sense.
    #[error(
        "{field} is {value}; give a number above 0, the distance to the plane of zero parallax"
    )]
    NotPositive {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// One half of a pair.
    #[error(
        "{field} is {value} but {partner} is missing; give both, or let auto-depth find the other"
    )]
    Partner {
        /// The half that is there.
        field: Field,
        /// Its value.
        value: String,
        /// The half that is missing.
        partner: Field,
    },
    /// κ, ξ and S, C at once.
    #[error(
        "{first} is {first_value} and {second} is {second_value}, two ways to place the same cameras; keep one of them"
    )]
    TwoCameras {
        /// One of the eye options.
        first: Field,
        /// Its value.
        first_value: String,
        /// One of the clip-space options.
        second: Field,
        /// Its value.
        second_value: String,
    },
    /// Not a size of a view.
    #[error("{field} is '{value}'; give auto, or a number from 0.05 to 1 such as 0.5")]
    ViewScale {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// Frames that cannot be counted.
    #[error(
        "{field} is '{value}'; give a frame counted from 1 such as 30, or a range such as 30..40"
    )]
    Frames {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// A frame that cannot be counted.
    #[error("{field} is '{value}'; give one frame counted from 1 such as 30")]
    Frame {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// Frames or content without a file to write to.
    #[error("{field} is '{value}' but no picture is asked for; set {out} to the file to write")]
    CaptureWithoutOut {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
        /// The option that is missing.
        out: Field,
    },
    /// A panel that cannot be loaded, or not with this number of views; the reason names it and the remedy.
    #[error("{field}: {reason}")]
    Display {
        /// The option.
        field: Field,
        /// What is wrong.
        reason: String,
    },
    /// A profile that cannot be loaded; the reason names the file, the rule, the key and the remedy.
    #[error("{field}: {reason}")]
    Profile {
        /// The option.
        field: Field,
        /// What is wrong.
        reason: String,
    },
    /// A number of a lens sheet, for a panel that has none.
    #[error(
        "{part} is a number of a slanted lens sheet, and display `{display}` is none; start the program with one of kind \"slanted\""
    )]
    NoSheet {
        /// The number.
        part: &'static str,
        /// The display.
        display: String,
    },
    /// A number that a lens sheet cannot have.
    #[error("{reason}")]
    Sheet {
        /// One sentence with the remedy.
        reason: String,
    },
    /// A depth for flat draws out of range.
    #[error("{field} is '{value}'; {remedy}", remedy = DEPTH_REMEDY)]
    HudDepth {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// A frame to explain, and nowhere to write to.
    #[error(
        "{field} is '{value}' but nothing is to be explained; set {explain} to a folder or file"
    )]
    FrameWithoutExplain {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
        /// The option that is missing.
        explain: Field,
    },
    /// Not a number of frames.
    #[error(
        "{field} is '{value}'; give a whole number of frames, 1 or more: every so many one is proved"
    )]
    Prove {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// Neither on nor off.
    #[error("{field} is '{value}'; give 1 for on or 0 for off")]
    Switch {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// One view is drawn by the program itself.
    #[error(
        "{field} is '{value}' and there is one view; one view is drawn by the program itself, so ask for two views or more"
    )]
    OneView {
        /// The option.
        field: Field,
        /// Its value.
        value: String,
    },
    /// A TOML file that cannot be read or parsed.
    #[error("{field} is '{}', which cannot be used: {reason}", path.display())]
    File {
        /// The option.
        field: Field,
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A key that means nothing.
    #[error("{} has the unknown key '{key}'; the keys are {known}", path.display())]
    UnknownKey {
        /// The file.
        path: PathBuf,
        /// The key.
        key: String,
        /// The keys there are.
        known: String,
    },
    /// A key with a table, list, date or truth value.
    #[error("{field} is of type {kind}; give a number or a text in quotes")]
    KeyType {
        /// The key.
        field: Field,
        /// What it is.
        kind: &'static str,
    },
}
