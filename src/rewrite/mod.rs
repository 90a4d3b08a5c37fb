//! A program's shader in, the shader of a view out. Text only: no GL, no files.
//!
//! The program's own shaders and programs stay as they are; draws that need views use a variant of the program, linked from rewritten
//! texts, with the same attributes, uniforms and varyings and those of the view.
//!
//! ```text
//! source ── scan ──► tokens ─┬─ entry      vertex, tessellation evaluation: a main around the program's
//!              version       │    ├─ position   the shift
//!              facts         │    ├─ instance   views by instances
//!              names         │    └─ target     layer, or tile and clip distances
//!                            ├─ emit       geometry: each vertex as it is emitted
//!                            ├─ fragment   gl_FragCoord
//!                            └─ moved      fragment: by how much distorted rays have moved a sample
//!                                 └──► edit ──► text
//! ```
//! Programs' GLSL is of many versions and dialects, and only what is edited is understood: names and a few patterns of tokens. What the
//! driver does not compile in the end is replayed. Only the last stage before the rasteriser moves vertices; the caller leaves the
//! stages before it as they are, or gets them back unchanged.
#![forbid(unsafe_code)]

mod edit;
mod emit;
mod entry;
mod error;
mod facts;
mod fragment;
mod instance;
mod moved;
mod names;
mod outputs;
mod position;
mod scan;
mod target;
#[cfg(test)]
mod tests;
mod version;

pub use crate::fixed::VertexLayer;
pub use error::Refusal;
pub use facts::{Facts, Matrix};
pub use names::{Names, Uniform};
pub use version::Version;

use edit::Edits;
use scan::Scan;
use std::borrow::Cow;

/// The stage that a shader object is of.
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

/// How one draw becomes several views.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Amplifier {
    /// The draw is repeated, with other uniforms; each time view 0 of them.
    Replay,
    /// The draw has as many times the instances; divisors are multiplied by the views.
    Instanced,
}

/// What tells the views apart in the atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The viewport: nothing is written.
    Whole,
    /// `gl_Layer`, by this extension.
    Layer(VertexLayer),
    /// Tiles side by side under one viewport, kept apart by two clip distances. The program's draw has no clip plane of fixed function.
    Tiles,
    /// Nothing: rays are distorted, by a function of [`Names::ray_distortion`], and the fragment shader says by how much.
    DistortedRays,
}

/// What the rewritten shader is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// How one draw becomes several views.
    pub amplifier: Amplifier,
    /// What tells the views apart.
    pub target: Target,
    /// Views that the arrays of uniforms hold: at least 1; 1 in replay.
    pub views: u32,
    /// The context is of OpenGL ES, where a text without `#version` is of 1.00.
    pub es: bool,
}

/// A shader for views.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rewritten<'a> {
    /// The text; borrowed where it is the program's own, which then serves the view as it is.
    pub text: Cow<'a, [u8]>,
    /// What the program's text uses.
    pub facts: Facts,
    /// What our uniforms are called.
    pub names: Names,
    /// `Target::Tiles`: the index of the left side's clip distance, the right side's is the next. They have to be enabled.
    pub first_distance: Option<u32>,
}

/// What a text uses. `es`: the context is of OpenGL ES.
///
/// # Errors
/// Those of every stage, where the text does not show what it uses.
pub fn facts(source: &[u8], es: bool) -> Result<Facts, Refusal> {
    let scan = readable(source)?;
    Ok(Facts::of(&scan, Version::of(&scan, es)))
}

/// Rewrites the text of one shader object: all its strings, one behind the other.
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
                moved::wrap(&mut edits, &scan, &names, &facts, declared)?;
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

/// The tokens of a text that shows all that it uses.
fn readable(source: &[u8]) -> Result<Scan<'_>, Refusal> {
    // Programs that count the zero at the end of a C string.
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
