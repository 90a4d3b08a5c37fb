//! Vertex and tessellation evaluation shaders as the last stage before the rasteriser: `main` is renamed, and a new one calls it.

use super::edit::Edits;
use super::error::Refusal;
use super::facts::Facts;
use super::names::Names;
use super::outputs::Outputs;
use super::scan::Scan;
use super::{Amplifier, Options, Stage, Target, instance, position, target};

/// Rewrites a vertex or tessellation evaluation shader; returns the index of the tile's first clip distance, if it has any.
pub(super) fn wrap(
    edits: &mut Edits,
    scan: &Scan,
    names: &Names,
    facts: &Facts,
    stage: Stage,
    options: &Options,
) -> Result<Option<u32>, Refusal> {
    let instanced = options.amplifier == Amplifier::Instanced;
    if instanced && stage != Stage::Vertex {
        return Err(Refusal::StageAfterVertex);
    }
    if instanced && facts.version.es {
        return Err(Refusal::Es);
    }
    target::check(facts, options.target)?;
    let outputs = Outputs::of(scan);
    if outputs.no_position {
        return Err(Refusal::NoPosition);
    }
    if instanced {
        instance::divide(edits, names);
    }
    if !facts.main {
        // The array has one size in all objects of a stage, but the size in this one is not known when the one with main is rewritten.
        if options.target == Target::Tiles && facts.clip_distance {
            return Err(Refusal::Distances);
        }
        return Ok(None);
    }
    rename(edits, scan, names)?;
    position::declare(edits, names, facts.version, options.views);
    target::declare(edits, names, options.target, options.views);
    if instanced {
        instance::declare(edits, names, facts.version, facts.instance);
    }
    let first = match options.target {
        Target::Whole | Target::DistortedRays => None,
        Target::Tiles => Some(target::add_clip_distances(edits, scan, &outputs)?),
        Target::Layer(extension) => {
            target::layer(edits, scan, &outputs, extension);
            None
        }
    };
    edits.append("void main() {");
    edits.append(format!("    {}();", names.other("main")));
    let view = if instanced {
        instance::view(edits, names, facts.version);
        names.other("view")
    } else {
        "0".to_owned()
    };
    position::shift(edits, names, facts.version, &view);
    target::write_position(edits, names, options.target, &view, first.unwrap_or(0));
    edits.append("}");
    Ok(first)
}

pub(super) fn rename(edits: &mut Edits, scan: &Scan, names: &Names) -> Result<(), Refusal> {
    let member = |at: usize| *scan.name(at) == *b"main" && scan.is(at.wrapping_sub(1), b'.');
    if (0..scan.tokens.len()).any(member) {
        return Err(Refusal::MainMember);
    }
    edits.replace_name("main", &names.other("main"));
    Ok(())
}
