//! Work that has to be done before a draw.

use crate::config::Viewport;
use crate::gl::{FramebufferName, ProgramName};
use crate::plan::Ramp;
use crate::plan::reason::{Reason, Unrepresentable};

/// How finely the tiles are sampled. Each value can represent more kinds of draws than the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// A sample for each subpixel that the panel shows, at its place: for triangles over the whole window.
    #[default]
    SampleAligned,
    /// As many samples as the panel shows of a view, evenly spaced: also for lines, points and parts of the window.
    Scaled,
    /// The window's pixels: for everything.
    Full,
}

/// Work that changes the facts. The command is observed and decided again after it. Each is asked for once, since it either succeeds or
/// leaves a fact that says that it failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preparation {
    /// Makes the atlas anew with another grid, because the program does this.
    ChangeGrid(Detail, Unrepresentable),
    /// Examines a program and links its variant for one view.
    LinkVariant(ProgramName),
    /// Links the program's variant that chooses layers, for one view or for all at once.
    LinkLayers {
        /// The program's own.
        program: ProgramName,
        /// For all views at once.
        all: bool,
    },
    /// Splits a framebuffer of the program's into one per view.
    Split(FramebufferName),
    /// Reads the depths of the last frame and moves the cameras by them; before the first command of a frame.
    MeasureDepths,
}

/// Work that is done after the decision and before the draw, in the order of the list.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Captures the depths before they are overwritten.
    TakeDepths,
    /// Notes that a draw writes depths of the scene by this mapping.
    MapDepths {
        /// The mapping from depths to distances.
        ramp: Ramp,
        /// The projection of the scene, column-major.
        projection: [f32; 16],
        /// The distance of zero parallax that a rule gives to the draw, in eye-space units.
        focal: Option<f64>,
        /// It is drawn before everything else.
        foreground: bool,
        /// How much of the window the viewport covers.
        viewport: Viewport,
    },
    /// Notes that pixels without a depth show a sky.
    MapSky,
    /// Forgets the mappings of depths, which are cleared.
    ForgetDepths,
    /// Begins a scene that is drawn to some views only, at a clear.
    BeginScene {
        /// GL_DEPTH_CLEAR_VALUE, 0 to 1.
        depth: f32,
    },
    /// Remembers the vertices of a surface over which another pass may be drawn.
    CaptureSurface,
    /// Synthesises the views that were not drawn.
    SynthesiseViews,
    /// Copies the program's own view to the other views, which are drawn from now on.
    LeaveMono,
    /// Counts a reason in the report of this frame.
    Fallback(Reason),
    /// Tells that no camera was found in the matrices of a program.
    NoCamera(ProgramName),
}
