//! The displacement of a sample by distorted rays: a second output of the fragment shader, at location 1.
//!
//! A program has either built-in outputs or its own (GLSL 1.30, 7.2), and the added output is of the same kind. It is `gl_FragData[1]`,
//! and `gl_FragColor` becomes `gl_FragData[0]`; or it has a name of its own, which the caller binds before it links. `gl_FragColor`
//! writes to all images, but the window has only one.

use super::edit::Edits;
use super::entry;
use super::error::Refusal;
use super::facts::Facts;
use super::names::Names;
use super::scan::Scan;
use super::version::Version;

/// Expression of the x that the pixel had in the tile before it was moved.
pub(super) fn write_displacement(names: &Names) -> String {
    format!(
        "(gl_FragCoord.x - {}.x * gl_FragCoord.w)",
        names.other("displacement")
    )
}

/// Declaration of the varying from the vertex stage; see [`crate::fixed::ray_distortion`].
pub(super) fn declaration(names: &Names, version: Version) -> String {
    let direction = match version.desktop(130) {
        true => "in",
        false => "varying",
    };
    format!("{direction} vec2 {};", names.other("displacement"))
}

/// Rewrites a fragment shader; `declared`: the varying is declared already.
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
            // Fragments that are discarded below would still write their depth.
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
        false => names.displacement_output(),
    };
    if !built_in {
        edits.append(format!("out vec4 {output};"));
    }
    let displacement = names.other("displacement");
    edits.append("void main() {");
    edits.append(format!("    {}();", names.other("main")));
    // The discard comes last, because textures that are sampled after it have no gradients.
    edits.append(format!("    if ({displacement}.y < 0.999)"));
    edits.append("        discard;");
    edits.append(format!(
        "    {output} = vec4({displacement}.x * gl_FragCoord.w);"
    ));
    edits.append("}");
    Ok(())
}
