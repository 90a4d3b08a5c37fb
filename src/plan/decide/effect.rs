//! What has to be done before a draw is made.

use crate::config::Viewport;
use crate::gl::{FramebufferName, ProgramName};
use crate::plan::{Ramp, Reason};

/// How finely the tiles are sampled. Each holds more kinds of draws than the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// A sample for each subpixel that the panel shows, where it shows it: triangles over the whole window.
    #[default]
    SampleAligned,
    /// Samples as many as the panel shows of a view: anything that has a size in the window's pixels.
    Scaled,
    /// The window's pixels: everything.
    Full,
}

/// What changes the facts: the command is observed and decided again after it. It is asked for once, since it either succeeds or
/// leaves a fact that says that it cannot be had.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preparation {
    /// The atlas is made anew with another grid, because the program does this.
    Remake(Detail, &'static str),
    /// What is known of a program, and its variant for one view, are made.
    LinkVariant(ProgramName),
    /// The program's variant that chooses layers is made: for one view, or for all at once.
    LinkLayers {
        /// The program's own.
        program: ProgramName,
        /// For all views.
        all: bool,
    },
    /// Each view gets a framebuffer like this one of the program's.
    Split(FramebufferName),
    /// The first command of a frame: the depths of the frame before are looked at, and the cameras go by them.
    MeasureDepths,
}

/// What is done once the command is decided, in the order in which it was decided, and before the draw.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// A picture of the depths is taken before they are spoilt.
    TakeDepths,
    /// Depths of the scene are written by this mapping.
    MapDepths {
        /// From depths to distances.
        ramp: Ramp,
        /// The projection of the scene, column-major.
        projection: [f32; 16],
        /// The zero parallax of its own that a rule gives the draw, in eye-space units.
        focal: Option<f64>,
        /// How much of the window it covers.
        viewport: Viewport,
    },
    /// What has no depth is a sky.
    MapSky,
    /// The depths are cleared, and what they meant is forgotten.
    ForgetDepths,
    /// A clear begins a scene that is drawn to some views only; the depth is what it leaves, as GL_DEPTH_CLEAR_VALUE.
    BeginScene {
        /// 0 to 1.
        depth: f32,
    },
    /// The depths of a surface that may be drawn over are remembered.
    CaptureSurface,
    /// The views that were not drawn are synthesised.
    SynthesiseViews,
    /// The other views get what the program's own has, and are drawn from now on.
    LeaveMono,
    /// A reason for the report, of this frame.
    Fallback(Reason),
    /// A sentence for the report.
    Note(&'static str),
}
