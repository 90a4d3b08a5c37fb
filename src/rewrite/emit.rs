//! Geometry shaders: each vertex is shifted when it is emitted.
//!
//! The program's `gl_Position` is restored after each vertex, so that shifts do not accumulate where the program reads it back.

use super::edit::Edits;
use super::error::Refusal;
use super::facts::Facts;
use super::names::Names;
use super::outputs::Outputs;
use super::scan::Scan;
use super::{Amplifier, Options, Target, position};

/// Rewrites a geometry shader.
pub(super) fn wrap(
    edits: &mut Edits,
    scan: &Scan,
    names: &Names,
    facts: &Facts,
    options: &Options,
) -> Result<(), Refusal> {
    if options.amplifier == Amplifier::Instanced {
        return Err(Refusal::StageAfterVertex);
    }
    if options.target != Target::Whole {
        return Err(Refusal::GeometryTarget);
    }
    if Outputs::of(scan).no_position {
        return Err(Refusal::NoPosition);
    }
    let emit = names.other("EmitVertex");
    let plain = edits.replace_name("EmitVertex", &emit);
    let stream = streams(edits, scan, &emit)?;
    if let Some(first) = [plain, stream].into_iter().flatten().min() {
        edits.declare(format!("void {emit}();"), first);
    }
    if !facts.main {
        // The object with main defines the function.
        return Ok(());
    }
    let (highp, kept) = (facts.version.highp(), names.other("position"));
    position::declare(edits, names, facts.version, 1);
    edits.append(format!("void {emit}() {{"));
    edits.append(format!("    {highp}vec4 {kept} = gl_Position;"));
    position::shift(edits, names, facts.version, "0");
    edits.append("    EmitVertex();");
    edits.append(format!("    gl_Position = {kept};"));
    edits.append("}");
    Ok(())
}

/// Replaces `EmitStreamVertex(0)`, which is `EmitVertex()`; returns the index of the first.
fn streams(edits: &mut Edits, scan: &Scan, emit: &str) -> Result<Option<usize>, Refusal> {
    for (at, token) in scan.tokens.iter().enumerate() {
        if *scan.name(at) != *b"EmitStreamVertex" {
            continue;
        }
        let argument = scan.tokens.get(at + 2).filter(|_| {
            scan.is(at + 1, b'(') && scan.number(at + 2) == Some(0) && scan.is(at + 3, b')')
        });
        edits.replace(argument.ok_or(Refusal::Streams)?, "");
        edits.replace(token, emit);
    }
    let stream = |at: &usize| *scan.name(*at) == *b"EmitStreamVertex";
    Ok((0..scan.tokens.len()).find(stream))
}
