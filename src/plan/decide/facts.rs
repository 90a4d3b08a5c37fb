//! What a decision depends on: plain data that was observed before anything is decided.

use crate::gl::{FramebufferName, ProgramName, TextureName};
use crate::plan::class::{Classed, Traits};
use crate::state::ClassificationState;

/// One command, and the state that it finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// The command, where it goes, and what it is classed by.
    pub traits: Traits,
    /// What it is.
    pub classed: Classed,
    /// What it is projected by.
    pub projections: Projections,
    /// Viewport, scissor and window.
    pub rects: Rects,
    /// The program of shaders that is in use.
    pub shaders: Shaders,
    /// Depth test, depth range, blending, stencil; valid in the groups that [`super::needs`] names.
    pub state: ClassificationState,
    /// What is drawn to.
    pub destination: Destination,
    /// Samples of the tiles, where they are not the window's pixels.
    pub grid: Option<GridFacts>,
    /// What a clear writes.
    pub clear: ClearFacts,
    /// What a synthesised scene asks.
    pub synthesis: SynthesisFacts,
    /// Draws are inside a query that counts them.
    pub counted: bool,
    /// It reads an image that each view has its own of.
    pub reads_views: bool,
}

/// Matrices, column-major.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projections {
    /// GL_PROJECTION_MATRIX.
    pub fixed: [f32; 16],
    /// The matrix of the program's shaders that the scene is projected by; fixed function's without such a program.
    pub matrix: [f32; 16],
    /// The same without the camera's place in the world.
    pub scene: [f32; 16],
    /// A of the camera that draws to the window, where this command has shown it.
    pub lens: Option<f64>,
    /// The raster position stands for a point of the scene.
    pub raster_moves: bool,
}

impl Facts {
    /// Whether what is drawn at the raster position moves with the view.
    pub fn raster_moves(&self) -> bool {
        self.projections.raster_moves
    }
}

/// Rectangles in the program's window space: x, y, width, height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rects {
    /// GL_VIEWPORT.
    pub viewport: [i32; 4],
    /// GL_SCISSOR_BOX, while the test is on.
    pub scissor: Option<[i32; 4]>,
    /// Width and height of the window.
    pub window: [u32; 2],
}

/// How the vertex stage is programmed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shaders {
    /// Fixed function.
    Fixed,
    /// A program pipeline, of which nothing is known.
    Pipeline,
    /// A program that was not looked at since it was linked.
    Unlinked(ProgramName),
    /// A program that no variant can be made of, or whose vertices the projection matrix places.
    WithoutVariant(ProgramName),
    /// A program with a variant.
    Variant(VariantFacts),
}

impl Shaders {
    /// Whether a program object or a pipeline is in use.
    pub fn programmed(&self) -> bool {
        !matches!(self, Shaders::Fixed)
    }
}

/// What is known of a program that has a variant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VariantFacts {
    /// The program's own.
    pub program: ProgramName,
    /// The projection of the last camera that was among its matrices.
    pub camera: Option<[f32; 16]>,
    /// None of its matrices has a perspective now.
    pub lost: bool,
    /// The variant that draws one view to its layer.
    pub to_layer: Linked,
    /// The variant that draws all views to their layers.
    pub to_layers: Linked,
    /// An attribute advances by instances.
    pub divides: bool,
}

/// Whether a variant is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Linked {
    /// Nobody has asked for it.
    Untried,
    /// It is linked.
    Yes,
    /// It cannot be made.
    Refused,
}

/// The framebuffer that is drawn to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Destination {
    /// 0 for the window.
    pub framebuffer: FramebufferName,
    /// It gets a picture: nothing is compiled, selected or fed back.
    pub picture: bool,
    /// The views differ in what a framebuffer of the program's holds.
    pub differs: bool,
    /// The views have framebuffers of their own.
    pub split: Linked,
    /// Its views are layers of one framebuffer.
    pub layered: bool,
    /// The window has a front buffer of its own in the atlas.
    pub front: bool,
    /// The views differ in some image beside the window.
    pub copies: bool,
}

impl Destination {
    /// Whether a draw lands in framebuffer 0 as picture.
    pub fn is_window(&self) -> bool {
        self.framebuffer.is_zero() && self.picture
    }
}

/// Samples of the tiles that are fewer than the window's pixels, or lie elsewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridFacts {
    /// The samples lie where the panel's lenses are.
    pub aligned: bool,
    /// Columns of samples lean.
    pub leans: bool,
    /// GL_POLYGON_STIPPLE.
    pub stippled: bool,
    /// GL_POLYGON_MODE is not GL_FILL.
    pub outlined: bool,
}

/// What a clear writes; nothing for other commands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClearFacts {
    /// Buffers, as bits of glClear, whose masks leave all of them writable; asked for those that the views may come to share.
    pub writable: u32,
    /// The scissor leaves all of the window.
    pub unscissored: bool,
    /// GL_DEPTH_CLEAR_VALUE.
    pub depth: f32,
}

/// What the synthesis of views depends on; the least where no view is synthesised.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SynthesisFacts {
    /// Atlas, output and settings allow that views are synthesised.
    pub possible: bool,
    /// A view that would be drawn from this clear on has nothing to be drawn on.
    pub joins: bool,
    /// The draw is another pass over the last surface.
    pub over_last: bool,
    /// The distortion map of the reference image, while draws go there.
    pub reference: Option<TextureName>,
    /// The context has fixed function.
    pub fixed_function: bool,
}
