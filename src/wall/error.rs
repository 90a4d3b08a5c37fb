//! Why a wall cannot be measured; every message is one sentence with the remedy.
#![forbid(unsafe_code)]

/// What went wrong.
#[derive(Debug, thiserror::Error)]
pub enum WallError {
    /// The description is that of one panel.
    #[error("display `{0}` is one panel; give the description of a wall, kind = \"wall\"")]
    NoWall(String),
    /// A photo that cannot be read.
    #[error("{photo}: {reason}; give a photo as JPEG or PNG")]
    Photo {
        /// Its name.
        photo: String,
        /// Why.
        reason: String,
    },
    /// No tag was found in a photo.
    #[error(
        "{photo}: no tag of the pattern is found; take it sharp, with all panels in it and the pattern of `manyview wall show` on them"
    )]
    NoTags {
        /// Its name.
        photo: String,
    },
    /// A panel of which no photo shows enough.
    #[error(
        "panel {number} ({monitor}) has {found} tags in the photos that show it with others; take one with whole panels in it, at least {needed} tags of each"
    )]
    Unseen {
        /// From 1.
        number: usize,
        /// Its monitor.
        monitor: String,
        /// Tags.
        found: usize,
        /// As many as are needed.
        needed: usize,
    },
    /// The places of the tags contradict each other.
    #[error(
        "the tags are {rms:.2} pixels of the photos off a flat wall; take all photos from one place, sharp, and leave out those where something moved"
    )]
    NotFlat {
        /// Root mean square.
        rms: f64,
    },
    /// The white of the pattern is clipped.
    #[error(
        "{photo}: the white of the pattern is clipped, so that its brightness cannot be measured; take it darker"
    )]
    Clipped {
        /// Its name.
        photo: String,
    },
    /// The detector fails.
    #[error("tags cannot be looked for: {0}; make the photos smaller")]
    Detector(String),
    /// The result is not written.
    #[error("{file} is not written: {reason}; free its place")]
    Write {
        /// Its path.
        file: String,
        /// Why.
        reason: String,
    },
}
