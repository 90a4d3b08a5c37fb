//! Why a draw is not made by the requested strategy, why views are synthesised before a command, and why the tiles get another grid. The
//! texts are keys and notes of the report.

use crate::fixed::Unsupported;
use thiserror::Error;

/// Why a draw is not made by the requested strategy.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Reason {
    /// Only replay can make this kind of draw.
    #[error("{0} are replayed")]
    Replayed(Replayed),
    /// The program uses its own shaders.
    #[error("the program's own shaders are replayed")]
    Program,
    /// No shader can be generated for the fixed-function state.
    #[error("{0}")]
    Fixed(Unsupported),
    /// The driver lacks a feature.
    #[error("the driver has no {0}")]
    Driver(Missing),
    /// The driver refused a generated shader.
    #[error("the driver refused the generated shader")]
    Compile,
    /// The draw cannot be repeated in the reference image; the text is the driver's, or that of the rewriter.
    #[error("a program draws nothing to the reference image: {0}")]
    NoReference(String),
    /// The program's own shaders draw no points for all views at once; the text is the driver's, or that of the rewriter.
    #[error("points of a program are replayed: {0}")]
    NoPoints(String),
    /// The views were synthesised before a command that has to be drawn in each of them.
    #[error("views are synthesised before {0}")]
    SynthesisedBefore(NotOfScene),
    /// Views were to be synthesised, and each is drawn.
    #[error("no view is synthesised: {0}")]
    NotSynthesised(Hindrance),
}

/// Why no view of a scene is synthesised; each text is a sentence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Error)]
pub enum Hindrance {
    /// Only a clear of all depths begins a scene.
    #[default]
    #[error("the depths of the window are not cleared as a whole before the scene")]
    NoClear,
    /// Depths are taken from the window alone.
    #[error("the scene is drawn to a framebuffer of the program's own")]
    Framebuffer,
    /// The front buffer and the accumulation buffer hold pictures that were shown or added before.
    #[error("the program uses the front buffer or the accumulation buffer")]
    Buffers,
    /// A window without a depth buffer.
    #[error("the window has no depths")]
    NoDepths,
    /// Synthesis has the window's own pixels.
    #[error("views have fewer pixels than the window")]
    Scaled,
    /// The user wants every view to be drawn at present.
    #[error("every view is wanted as it is drawn")]
    Unwanted,
}

/// The draws that only replay can make; each text is the subject of "are replayed".
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Error)]
pub enum Replayed {
    /// Passes that compare depths by GL_EQUAL need equal bits, which replay has.
    #[error("draws of a program whose passes have to meet in every pixel (GL_EQUAL)")]
    EqualDepths,
    /// glCallList and glCallLists.
    #[error("display lists")]
    Lists,
    /// Commands that no amplifier knows.
    #[error("rectangles, evaluators, multi-draws and instanced draws")]
    OtherCommands,
    /// glBegin to glEnd has no instances.
    #[error("immediate-mode draws under `instanced`")]
    Immediate,
    /// One draw of all views would count them all.
    #[error("draws that a query counts")]
    Counted,
    /// A texture that is split into one image per view.
    #[error("draws with a texture that each view has its own of")]
    SplitTexture,
    /// The tiles of such a grid do not show the same part of the window.
    #[error("draws to views whose tiles lie at other places of the window")]
    TilesApart,
    /// Drivers tear them after a geometry shader.
    #[error("wide and smooth points and lines under `geometry`")]
    WidePrimitives,
    /// Without clip distances the driver clips other vertices, and so takes the other diagonal.
    #[error("smooth quads under `--clip discard`, which the driver cuts along either diagonal,")]
    DiscardedQuads,
    /// A cut changes the corner that a flat triangle has its colour of.
    #[error("points, lines, quads and flat triangles under `--clip cut`")]
    CutPrimitives,
    /// A geometry shader sees one quad and cannot tell the diagonal.
    #[error("smooth quads under `geometry`, which the driver cuts along either diagonal,")]
    SmoothQuads,
    /// No input primitive of a geometry shader.
    #[error("flat quad strips under `geometry`")]
    FlatQuadStrips,
    /// Smooth points have a coverage that the driver computes.
    #[error("smooth points under `splats`")]
    SmoothPoints,
    /// Images whose views are not layers of one framebuffer: of an older driver, or of the front buffer.
    #[error("points in images whose views are not layers")]
    NoLayers,
    /// Points in one of several viewports.
    #[error("points in several viewports")]
    PointsInViewports,
    /// Primitives that have a geometry or a tessellation shader already.
    #[error("primitives with adjacency and patches")]
    Adjacency,
}

/// A feature that a strategy needs; each text is the object of "the driver has no".
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Error)]
pub enum Missing {
    /// For `instanced`.
    #[error("instancing with clip distances in compatibility shaders (GLSL 1.50)")]
    Instancing,
    /// For `geometry`.
    #[error("geometry shaders in compatibility contexts (GLSL 1.50)")]
    GeometryShaders,
}

/// Why a command does not belong to the scene from whose depths views are synthesised; each text is the object of "before".
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Error)]
pub enum NotOfScene {
    /// A clear after the scene has begun.
    #[error("another clear")]
    Clear,
    /// A stencil test, which would have to hold in each view.
    #[error("draws with a stencil test")]
    Stencil,
    /// A polygon stipple, which is fixed to the window.
    #[error("draws with a stipple of the screen's")]
    Stipple,
    /// glDrawPixels and its kin, and images of which each view has its own.
    #[error("pictures and pixels")]
    Pixels,
    /// A small viewport.
    #[error("a picture in the picture")]
    PictureInPicture,
    /// A sky that is tested against depths.
    #[error("a sky with depths")]
    SkyWithDepths,
    /// A sky that is drawn after something of the scene.
    #[error("a sky over the scene")]
    SkyOverScene,
    /// Shaders that compute positions from places on the screen, after something of the scene.
    #[error("what shaders compute for places on the screen")]
    Rays,
    /// A flat draw after something of the scene, such as a HUD.
    #[error("what is flat")]
    Flat,
    /// A flat draw that has depths or a shift.
    #[error("what is flat and stands elsewhere than on the panel")]
    FlatElsewhere,
    /// A draw of the scene without a shift.
    #[error("a scene without parallax")]
    NoParallax,
    /// A scene without perspective.
    #[error("an orthographic scene")]
    Orthographic,
    /// A projection from whose depths no distance follows.
    #[error("a projection without depths")]
    NoDepths,
    /// A blended draw.
    #[error("what is transparent")]
    Transparent,
    /// A draw that does not write depths.
    #[error("what has no depths")]
    WithoutDepths,
    /// A rule of the profile gives the draw a focal depth.
    #[error("a part of the scene with zero parallax of its own")]
    OwnFocalDepth,
    /// The scene has begun with another projection.
    #[error("another projection")]
    OtherProjection,
}

/// What a program does that the tiles' grid cannot represent; each text continues "because the program".
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Error)]
pub enum Unrepresentable {
    /// Pixels and bitmaps.
    #[error("draws pixels or bitmaps")]
    Pixels,
    /// glAccum.
    #[error("uses the accumulation buffer")]
    Accumulation,
    /// Shaders may read the place of a fragment.
    #[error("has shaders of its own")]
    Shaders,
    /// A polygon stipple, which is fixed to the window.
    #[error("draws stippled polygons")]
    Stipple,
    /// Lines and points, whose width is in pixels.
    #[error("draws lines or points")]
    LinesOrPoints,
    /// A list, of which nobody knows whether it draws lines.
    #[error("may draw lines or points in display lists")]
    ListsOfLines,
    /// Parts of the window, which have upright edges.
    #[error("draws to parts of the window")]
    PartsOfWindow,
    /// Blits.
    #[error("copies pictures into the window")]
    Copies,
    /// A drawable that another context has drawn to.
    #[error("draws to one window with several contexts")]
    Contexts,
    /// The front buffer.
    #[error("uses the front buffer")]
    FrontBuffer,
    /// Lists that were compiled before the layer was there, or in another context.
    #[error("calls display lists that were compiled elsewhere")]
    ForeignLists,
    /// A list with glLoadMatrix of the projection, or glViewport.
    #[error("changes the projection or the viewport in a display list")]
    ListOfCameras,
    /// GL_COMPILE_AND_EXECUTE.
    #[error("draws while it compiles a display list")]
    CompileAndExecute,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_continue_their_sentences() {
        let texts = [
            (
                Reason::Replayed(Replayed::Lists),
                "display lists are replayed",
            ),
            (
                Reason::Driver(Missing::GeometryShaders),
                "the driver has no geometry shaders in compatibility contexts (GLSL 1.50)",
            ),
            (
                Reason::SynthesisedBefore(NotOfScene::Clear),
                "views are synthesised before another clear",
            ),
            (
                Reason::Fixed(Unsupported::RenderMode),
                "selection or feedback mode",
            ),
        ];
        for (reason, text) in texts {
            assert_eq!(reason.to_string(), text);
        }
    }
}
