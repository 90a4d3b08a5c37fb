//! Why a shader is not rewritten, in one sentence each.

use thiserror::Error;

/// Why a shader is not rewritten. The draw is then replayed with the shift of fixed function, or drawn once.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Refusal {
    /// A zero byte with text after it. Drivers do not agree on where such a source ends.
    #[error("the shader has a zero byte inside")]
    Zero,
    /// `#include`: the included text is not known.
    #[error("the shader includes other text")]
    Include,
    /// `##`: it may form names that the source does not show.
    #[error("the shader puts names together with ##")]
    Pasted,
    /// A macro with a name that occurs in the added text.
    #[error("the shader defines {0} as a macro")]
    Defined(String),
    /// A member of a structure or block called `main`.
    #[error("the shader has a member called main")]
    MainMember,
    /// No place for a declaration before its first use, outside of all conditions and behind `#extension`.
    #[error("the shader has an #extension behind the start of the condition that holds its code")]
    NoPlace,
    /// OpenGL ES has neither layers nor clip distances in the vertex shader without extensions: only whole tiles, by replay.
    #[error(
        "layers, clip distances and distorted rays need desktop OpenGL, and the shader is of OpenGL ES"
    )]
    Es,
    /// `Target::Tiles` below GLSL 1.30.
    #[error("clip distances need GLSL 1.30, and the shader is of an earlier version")]
    NoClipDistances,
    /// `gl_Layer`, `gl_ViewportIndex`, `gl_ClipVertex`, `gl_CullDistance` and others, which conflict with what the view adds.
    #[error("the shader uses {0}")]
    Uses(&'static str),
    /// `gl_ClipDistance` with a size or an index that is not a plain number, or as a whole.
    #[error("the size of the shader's gl_ClipDistance is not plain to see")]
    Distances,
    /// More than 8 clip distances together with those of the tile.
    #[error("no clip distance is left for the sides of the tile")]
    TooManyDistances,
    /// `gl_PerVertex` is declared without `gl_Position`.
    #[error("the shader has no gl_Position")]
    NoPosition,
    /// Only the vertex shader has `gl_InstanceID`; tessellation evaluation and geometry shaders cannot tell the view from it.
    #[error("views by instances end at the vertex shader")]
    StageAfterVertex,
    /// A geometry shader can draw to a tile by the viewport only.
    #[error("a geometry shader is drawn once per view, into its tile")]
    GeometryTarget,
    /// `gl_FragData` with an index that is not a plain 0, or as a whole.
    #[error("the shader writes to more than one image")]
    Outputs,
    /// Variables between the stages that are in blocks, arrays, structures or conditions.
    #[error("the variables between its shaders are not plain to see")]
    Varyings,
    /// The two shaders of points have different names free.
    #[error("its shaders have names that clash with the layer's")]
    Clash,
    /// `EmitStreamVertex` of another stream than the plain 0.
    #[error("the shader emits vertices to streams")]
    Streams,
}
