//! By how much a sample lies beside its place, for the picture of distorted rays: a second output of the fragment shader, at location 1.
//!
//! A program has either the outputs of GLSL's or its own (GLSL 1.30, 7.2), and so has what is added: `gl_FragData[1]`, which makes a
//! `gl_FragColor` the first of them, or a name of its own, which the caller binds before it links. `gl_FragColor` is for all images, but
//! the window has one.

use super::edit::Edits;
use super::entry;
use super::error::Refusal;
use super::facts::Facts;
use super::names::Names;
use super::scan::Scan;
use super::version::Version;

/// x of the pixel's place in the tile before it was moved.
pub(super) fn write_displacement(names: &Names) -> String {
    format!(
        "(gl_FragCoord.x - {}.x * gl_FragCoord.w)",
        names.other("moved")
    )
}

/// What comes from the vertex stage; see [`crate::fixed::ray_distortion`].
pub(super) fn declaration(names: &Names, version: Version) -> String {
    let direction = match version.desktop(130) {
        true => "in",
        false => "varying",
    };
    format!("{direction} vec2 {};", names.other("moved"))
}

/// Rewrites a fragment shader; `declared`: what comes in is.
pub(super) fn wrap(
    edits: &mut Edits,
    scan: &Scan,
    names: &Names,
    facts: &Facts,
    declared: bool,
) -> Result<(), Refusal> {
    for (at, token) in scan.tokens.iter().enumerate() {
        match &*scan.name(at) {
            b"gl_FragColor" => edits.replace(token, "gl_FragData[0]"),
            b"gl_FragData" => {
                let first = scan.is(at + 1, b'[')
                    && scan.number(at + 2) == Some(0)
                    && scan.is(at + 3, b']');
                if !first {
                    return Err(Refusal::Outputs);
                }
            }
            // What is discarded below would leave its depth.
            b"early_fragment_tests" => return Err(Refusal::Uses("early_fragment_tests")),
            _ => {}
        }
    }
    if !facts.main {
        return Ok(());
    }
    entry::rename(edits, scan, names)?;
    if !declared {
        edits.append(declaration(names, facts.version));
    }
    let built_in = facts.writes_built_in();
    let output = match built_in {
        true => "gl_FragData[1]".to_owned(),
        false => names.beside(),
    };
    if !built_in {
        edits.append(format!("out vec4 {output};"));
    }
    let moved = names.other("moved");
    edits.append("void main() {");
    edits.append(format!("    {}();", names.other("main")));
    // Last: what is sampled after a discard has no gradients.
    edits.append(format!("    if ({moved}.y < 0.999)"));
    edits.append("        discard;");
    edits.append(format!("    {output} = vec4({moved}.x * gl_FragCoord.w);"));
    edits.append("}");
    Ok(())
}
