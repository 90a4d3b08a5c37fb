//! The facts that a decision depends on: plain data, observed before anything is decided.

use crate::config::{Class, Projection, Viewport};
use crate::gl::{FramebufferName, ProgramName, TextureName};
use crate::plan::class::{Classed, Traits, Why};
use crate::plan::reason::{Hindrance, Unrepresentable};
use crate::plan::{Kind, Ramp};
use crate::state::ClassificationState;

/// One command, and the state that it finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facts {
    /// The kind of the command, its target, and the properties that decide its class.
    pub traits: Traits,
    /// Its class, and why.
    pub classed: Classed,
    /// The matrices that project it.
    pub projections: Projections,
    /// Viewport, scissor and window.
    pub rects: Rects,
    /// The program object in use.
    pub shaders: Shaders,
    /// Depth test, depth range, blending, stencil; only the groups that [`super::needs`] names are valid.
    pub state: ClassificationState,
    /// The framebuffer that is drawn to.
    pub destination: Destination,
    /// The grid of the tiles, where their samples are not the window's pixels.
    pub grid: Option<GridFacts>,
    /// The extent of a clear.
    pub clear: ClearFacts,
    /// The facts that the synthesis of views depends on.
    pub synthesis: SynthesisFacts,
    /// A query that counts draws or samples is active.
    pub counted: bool,
    /// It reads an image that is split into one per view.
    pub reads_views: bool,
}

/// Matrices, column-major.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projections {
    /// GL_PROJECTION_MATRIX.
    pub fixed: [f32; 16],
    /// The matrix by which the program's shaders project the scene; fixed function's without such shaders.
    pub matrix: [f32; 16],
    /// The same as a pure projection, without the camera's rotation and position.
    pub scene: [f32; 16],
    /// A of the camera that draws to the window, where this command shows it.
    pub lens: Option<f64>,
    /// The raster position stands for a point of the scene.
    pub raster_moves: bool,
}

impl Facts {
    /// Whether a draw at the raster position moves with the view.
    pub fn raster_moves(&self) -> bool {
        self.projections.raster_moves
    }

    /// Whether it belongs to an orthographic scene, by the state or a rule: its views are sheared by depth.
    pub fn slants(&self) -> bool {
        let why = self.classed.why;
        self.classed.class == Class::Scene
            && self.traits.projection != Projection::Perspective
            && self.traits.kind != Kind::Pixels
            && (why == Why::Slanted || matches!(why, Why::Rule(_)))
    }

    /// Whether it is a draw of the scene, in perspective and to the main viewport, but nothing in the viewer's hand.
    pub fn is_main_scene(&self) -> bool {
        let traits = &self.traits;
        self.classed.class == Class::Scene
            && !self.classed.is_foreground()
            && traits.projection == Projection::Perspective
            && traits.viewport == Viewport::Main
            && traits.target.is_shown()
            && !matches!(traits.kind, Kind::Clear { .. } | Kind::Accum | Kind::Pixels)
    }

    /// The mapping from its window depths to distances; `None` where there is none.
    pub fn ramp(&self) -> Option<Ramp> {
        let state = &self.state;
        match self.slants() {
            true => Ramp::orthographic(state.depths, state.reversed),
            false => Ramp::of(&self.projections.matrix, state.depths, state.zero_to_one),
        }
    }

    /// The projection of the scene, column-major: without the camera's rotation and position in perspective.
    pub fn scene_projection(&self) -> [f32; 16] {
        match self.slants() {
            true => self.projections.matrix,
            false => self.projections.scene,
        }
    }

    /// Whether its shaders compute positions from places on the screen, by matrices that each view has of its own.
    pub fn unprojects(&self) -> bool {
        matches!(self.shaders, Shaders::Variant(variant) if variant.unprojects)
    }
}

/// Rectangles in the program's window space: x, y, width, height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rects {
    /// GL_VIEWPORT.
    pub viewport: [i32; 4],
    /// GL_SCISSOR_BOX, if the scissor test is on.
    pub scissor: Option<[i32; 4]>,
    /// Width and height of the window.
    pub window: [u32; 2],
}

/// How the vertex stage is programmed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shaders {
    /// Fixed function.
    Fixed,
    /// A program pipeline object, which the layer does not look into.
    Pipeline,
    /// A program that the layer has not examined since it was linked.
    Unlinked(ProgramName),
    /// A program that has no variant, or needs none because the projection matrix of fixed function places its vertices.
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

/// The state of a program that has a variant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VariantFacts {
    /// The program's own.
    pub program: ProgramName,
    /// The projection of the last camera that was found among its matrices.
    pub camera: Option<[f32; 16]>,
    /// At present none of its matrices has a perspective, nor has the w of its vertices.
    pub lost: bool,
    /// It has no camera among its matrices, and it is time to measure the w of its vertices.
    pub unmeasured: bool,
    /// Its vertices lie at the far end of the depths, z = w in clip space.
    pub far_end: bool,
    /// The variant that draws one view to its layer.
    pub to_layer: Linked,
    /// The variant that draws all views to their layers.
    pub to_layers: Linked,
    /// A vertex attribute advances per instance (glVertexAttribDivisor).
    pub divides: bool,
    /// See [`Facts::unprojects`].
    pub unprojects: bool,
}

/// Whether a variant, or a split framebuffer, is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Linked {
    /// It was not tried yet.
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
    /// Draws produce pixels: no display list is compiled only, and the render mode is not selection or feedback.
    pub picture: bool,
    /// It is a framebuffer of the program's whose contents differ between the views.
    pub differs: bool,
    /// The views have framebuffers of their own.
    pub split: Linked,
    /// All views can be drawn to as layers of one framebuffer, by a variant of the program.
    pub layered: bool,
    /// The atlas has a front buffer of its own.
    pub front: bool,
    /// Some image beside the window differs between the views.
    pub copies: bool,
    /// The program draws a picture for each eye itself.
    pub eyes: bool,
}

impl Destination {
    /// Whether a draw lands in framebuffer 0 as picture.
    pub fn is_window(&self) -> bool {
        self.framebuffer.is_zero() && self.picture
    }
}

/// A demand on the grid that does not follow from a command's kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demand {
    /// No demand.
    None,
    /// The command may draw lines or points, as display lists may.
    LinesOrPoints,
    /// The window's own pixels are needed, because the program does this.
    Everything(Unrepresentable),
}

/// A grid of the tiles whose samples are fewer than the window's pixels, or lie elsewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridFacts {
    /// The demand of the command that does not follow from its kind.
    pub demand: Demand,
    /// The samples lie where the panel shows the view.
    pub aligned: bool,
    /// Columns of samples are slanted.
    pub slanted: bool,
    /// GL_POLYGON_STIPPLE.
    pub stippled: bool,
    /// GL_POLYGON_MODE is not GL_FILL.
    pub outlined: bool,
}

/// The extent of a clear; nothing for other commands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ClearFacts {
    /// Buffers, as bits of glClear, whose write masks are fully open. Only buffers whose answer is needed are read.
    pub writable: u32,
    /// The scissor covers the whole window.
    pub unscissored: bool,
    /// GL_DEPTH_CLEAR_VALUE.
    pub depth: f32,
}

/// The facts that the synthesis of views depends on; the defaults where no view is synthesised.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SynthesisFacts {
    /// Why no view can be synthesised of a scene that begins with this clear; none where views can.
    pub hindrance: Option<Hindrance>,
    /// From this clear on a view would be drawn that was not drawn before, so its tile holds no earlier picture.
    pub adds_views: bool,
    /// The draw is another pass over the same vertices as the last surface.
    pub over_last: bool,
    /// The distortion map of the reference image, while draws go there.
    pub reference: Option<TextureName>,
    /// The context has fixed function.
    pub fixed_function: bool,
}
