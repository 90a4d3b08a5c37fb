//! Panel descriptions and their masks; pure, without GL.
#![forbid(unsafe_code)]

/// A panel: how many views it shows and which subpixel shows which.
#[derive(Clone, Debug, PartialEq)]
pub struct Display {
    /// Name shown to the user.
    pub name: String,
    /// Native number of views.
    pub views: u32,
}
