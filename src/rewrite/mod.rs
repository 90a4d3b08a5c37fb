//! Rewrites a program's shader to the shader of a view. Works on text only: no GL, no files.
//!
//! The program's own shaders and programs stay as they are. Draws that need views use a program variant, which is linked from
//! rewritten sources; it has the same attributes, uniforms and varyings, and in addition those of the view.
//!
//! ```text
//! source ── scan ──► tokens ─┬─ entry      vertex, tessellation evaluation: a main around the program's
//!              version       │    ├─ position   the shift
//!              facts         │    ├─ instance   views by instances
//!              names         │    └─ target     layer, or tile and clip distances
//!                            ├─ emit       geometry: each vertex as it is emitted
//!                            ├─ fragment   gl_FragCoord
//!                            └─ displacement  fragment: displacement of a sample by distorted rays
//!                                 └──► edit ──► text
//! ```
//! Programs use many versions and dialects of GLSL, so the rewriter understands only what it edits: names and a few patterns of
//! tokens. If the driver does not compile the result, the draw is replayed. Only the last stage before the rasteriser moves vertices;
//! the caller does not rewrite the stages before it, and control and compute shaders come back unchanged.
#![forbid(unsafe_code)]

mod displacement;
mod edit;
mod emit;
mod entry;
mod error;
mod facts;
mod far_end;
mod fragment;
mod instance;
mod memory_writes;
mod names;
mod outputs;
mod points;
mod position;
mod scan;
mod target;
#[cfg(test)]
mod tests;
mod version;

pub use crate::fixed::VertexLayer;
pub use error::Refusal;
pub use facts::{Facts, Matrix};
pub use memory_writes::MemoryWrites;
pub use names::{Names, Uniform};
pub use points::{PointShaders, PointsTo, points};
pub use version::Version;

use edit::Edits;
use scan::Scan;
use std::borrow::Cow;

/// The stage of a shader object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// `GL_VERTEX_SHADER`
    Vertex,
    /// `GL_TESS_CONTROL_SHADER`
    TessControl,
    /// `GL_TESS_EVALUATION_SHADER`
    TessEvaluation,
    /// `GL_GEOMETRY_SHADER`
    Geometry,
    /// `GL_FRAGMENT_SHADER`
    Fragment,
    /// `GL_COMPUTE_SHADER`
    Compute,
}

impl Stage {
    /// All of them.
    pub const ALL: [Stage; 6] = [
        Stage::Vertex,
        Stage::TessControl,
        Stage::TessEvaluation,
        Stage::Geometry,
        Stage::Fragment,
        Stage::Compute,
    ];
}

/// How one draw becomes several views.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Amplifier {
    /// The draw is repeated with new uniforms; each time the shader draws view 0 of the arrays.
    Replay,
    /// The number of instances is multiplied by the number of views, and so are the divisors of attributes.
    Instanced,
}

/// How the views are separated in the atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// By the viewport: the shader writes nothing.
    Whole,
    /// By `gl_Layer`, which this extension provides.
    Layer(VertexLayer),
    /// Tiles side by side under one viewport, kept apart by two clip distances. The program's draw has no clip plane of fixed function.
    Tiles,
    /// No views, but distorted rays: a function of [`Names::ray_distortion`] moves vertices, and the fragment shader writes the
    /// displacement.
    DistortedRays,
}

/// How the rewritten shader draws the views.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// How one draw becomes several views.
    pub amplifier: Amplifier,
    /// How the views are separated.
    pub target: Target,
    /// Views that the arrays of uniforms hold: at least 1; 1 in replay.
    pub views: u32,
    /// The context is of OpenGL ES, where a source without `#version` is GLSL ES 1.00.
    pub es: bool,
}

/// A shader for views.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rewritten<'a> {
    /// The new source; borrowed where the program's own serves the view unchanged.
    pub text: Cow<'a, [u8]>,
    /// Features that the program's source uses.
    pub facts: Facts,
    /// The names of the added uniforms.
    pub names: Names,
    /// `Target::Tiles`: the index of the left side's clip distance, the right side's is the next. They have to be enabled.
    pub first_distance: Option<u32>,
}

/// Finds the features that a source uses. `es`: the context is of OpenGL ES.
///
/// # Errors
/// If the source does not show all names that it uses: [`Refusal::Zero`], [`Refusal::Include`] or [`Refusal::Pasted`].
pub fn facts(source: &[u8], es: bool) -> Result<Facts, Refusal> {
    let scan = readable(source)?;
    Ok(Facts::of(&scan, Version::of(&scan, es)))
}

/// Rewrites the source of one shader object, which is all its strings joined.
///
/// # Errors
/// Why this shader cannot draw the views in this way.
pub fn rewrite<'a>(
    source: &'a [u8],
    stage: Stage,
    options: &Options,
) -> Result<Rewritten<'a>, Refusal> {
    let scan = readable(source)?;
    let version = Version::of(&scan, options.es);
    let facts = Facts::of(&scan, version);
    let names = Names::of(&scan);
    let mut edits = Edits::new(&scan, version);
    let mut first_distance = None;
    match stage {
        Stage::Vertex | Stage::TessEvaluation => {
            first_distance = entry::wrap(&mut edits, &scan, &names, &facts, stage, options)?;
        }
        Stage::Geometry => emit::wrap(&mut edits, &scan, &names, &facts, options)?,
        Stage::Fragment => {
            target::check_fragment(&facts, options.target)?;
            let declared = fragment::rewrite(&mut edits, &scan, &names, version, options.target);
            if options.target == Target::DistortedRays {
                displacement::wrap(&mut edits, &scan, &names, &facts, declared)?;
            }
        }
        Stage::TessControl | Stage::Compute => {}
    }
    Ok(Rewritten {
        text: edits.finish()?,
        facts,
        names,
        first_distance,
    })
}

/// Reads the tokens of a source; refuses one that does not show all names that it uses.
fn readable(source: &[u8]) -> Result<Scan<'_>, Refusal> {
    // Some programs count the zero at the end of a C string.
    let end = source.iter().rposition(|&byte| byte != 0);
    let source = source
        .get(..end.map_or(0, |end| end + 1))
        .unwrap_or_default();
    if source.contains(&0) {
        return Err(Refusal::Zero);
    }
    let scan = Scan::new(source);
    if scan
        .directives
        .iter()
        .any(|directive| *scan.called(directive) == *b"include")
    {
        return Err(Refusal::Include);
    }
    let pasted = |pair: &[scan::Token]| match pair {
        [a, b] => {
            let mark = scan::Kind::Mark(b'#');
            a.directive && a.kind == mark && b.kind == mark && a.end == b.start
        }
        _ => false,
    };
    if scan.tokens.windows(2).any(pasted) {
        return Err(Refusal::Pasted);
    }
    Ok(scan)
}
