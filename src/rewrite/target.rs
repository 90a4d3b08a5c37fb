//! Where a view goes: the layer, or the tile with clip distances at its sides.
//!
//! ```text
//! d0 = x − left·w      d1 = right·w − x               d ≥ 0 inside the tile
//! X  = x·scale_x + centre_x·w      Y = y·scale_y + centre_y·w
//! ```
//! (x, y, w) is in clip space of the program's own viewport; (X, Y, w) in that of a viewport over the whole atlas.

use super::edit::Edits;
use super::error::Refusal;
use super::facts::Facts;
use super::names::{Names, Uniform};
use super::outputs::Outputs;
use super::scan::Scan;
use super::{Target, VertexLayer};
use std::ops::{Range, RangeInclusive};

/// `GL_MAX_CLIP_DISTANCES` is at least this.
const MOST: u32 = 8;
/// Clip distances of a tile: left and right.
const SIDES: u32 = 2;

/// Refuses a shader that uses a built-in which the view needs.
pub(super) fn check(facts: &Facts, target: Target) -> Result<(), Refusal> {
    if target == Target::Whole {
        return Ok(());
    }
    if facts.version.es {
        return Err(Refusal::Es);
    }
    let tiles = target == Target::Tiles;
    if tiles && facts.version.number < 130 {
        return Err(Refusal::NoClipDistances);
    }
    // Clip planes have no effect in a shader that writes clip distances, so those that clip gl_ClipVertex would be lost.
    let taken = [
        ("gl_Layer", facts.layer),
        ("gl_ViewportIndex", facts.viewport_index),
        ("gl_ClipVertex", facts.clip_vertex && tiles),
        ("gl_CullDistance", facts.cull_distance && tiles),
    ];
    match taken.into_iter().find(|&(_, used)| used) {
        Some((name, _)) => Err(Refusal::Uses(name)),
        None => Ok(()),
    }
}

/// Refuses a fragment shader that reads a built-in which the view changes.
pub(super) fn check_fragment(facts: &Facts, target: Target) -> Result<(), Refusal> {
    match target {
        Target::Layer(_) if facts.layer => Err(Refusal::Uses("gl_Layer")),
        // The array would have to be as long as that of the vertex shader.
        Target::Tiles if facts.clip_distance => Err(Refusal::Uses("gl_ClipDistance")),
        Target::DistortedRays if facts.version.es => Err(Refusal::Es),
        _ => Ok(()),
    }
}

/// Makes `gl_Layer` available in the vertex shader. Where the program redeclares `gl_PerVertex`, Mesa takes `gl_Layer` for an omitted
/// member of the block, and the reference compiler does not take it for a member at all, so no edit of the block suits both. Both
/// provide it without the redeclaration, which is therefore removed; the sizes of its arrays are declared one by one.
pub(super) fn layer(edits: &mut Edits, scan: &Scan, outputs: &Outputs, extension: VertexLayer) {
    edits.require(extension.extension());
    for block in &outputs.blocks {
        // A block with other qualifiers of its members, such as `invariant`, is needed.
        let plain = |at: usize| {
            let name = scan.name(at);
            let word = matches!(&*name, b"" | b"out" | b"vec4" | b"float");
            let token = scan.tokens.get(at);
            (word || name.starts_with(b"gl_")) && token.is_some_and(|token| !token.directive)
        };
        if block.clone().all(plain) {
            remove_block(edits, scan, block);
        }
    }
}

/// Removes a block, but keeps its declarations of arrays with a size.
fn remove_block(edits: &mut Edits, scan: &Scan, block: &Range<usize>) {
    let mut remove = |tokens: RangeInclusive<usize>| {
        for token in tokens.filter_map(|at| scan.tokens.get(at)) {
            edits.replace(token, "");
        }
    };
    // out gl_PerVertex {
    let first = block.start + 3;
    let end = block.end + usize::from(scan.is(block.end + 1, b';'));
    remove(block.start..=first - 1);
    remove(block.end..=end);
    let mut arrays = Vec::new();
    let mut member = first;
    for at in first..block.end {
        if scan.is(at, b';') {
            // A type, a name, a bracket and a size.
            if scan.is(member + 2, b'[') && !scan.is(member + 3, b']') {
                arrays.push(member);
            } else {
                remove(member..=at);
            }
            member = at + 1;
        }
    }
    for member in arrays.iter().filter_map(|&at| scan.tokens.get(at)) {
        edits.insert(member, "out ");
    }
}

/// Adds clip distances for the sides of the tile after the program's own; returns the index of the first of them.
pub(super) fn add_clip_distances(
    edits: &mut Edits,
    scan: &Scan,
    outputs: &Outputs,
) -> Result<u32, Refusal> {
    let own = outputs.distances()?;
    let size = own.saturating_add(SIDES);
    if size > MOST {
        return Err(Refusal::TooManyDistances);
    }
    let token = |at: &usize| scan.tokens.get(*at);
    for number in outputs.sized.iter().filter_map(token) {
        edits.replace(number, size.to_string());
    }
    for bracket in outputs.open.iter().filter_map(token) {
        edits.replace(bracket, format!("{size}]"));
    }
    if outputs.sized.is_empty() && outputs.open.is_empty() {
        let braces = outputs.blocks.iter().map(|block| &block.end);
        for brace in braces.filter_map(token) {
            edits.replace(brace, format!("float gl_ClipDistance[{size}]; }}"));
        }
        if outputs.blocks.is_empty() {
            edits.append(format!("out float gl_ClipDistance[{size}];"));
        }
    }
    Ok(own)
}

/// Declares the uniforms of the target, or the function that distorts rays.
pub(super) fn declare(edits: &mut Edits, names: &Names, target: Target, views: u32) {
    if target == Target::DistortedRays {
        let distort = names.other("distort_rays");
        return edits.append(format!("vec4 {distort}(vec4);"));
    }
    if target == Target::Whole {
        return;
    }
    let tile = names.uniform(Uniform::Tile);
    edits.append(format!("uniform vec4 {tile}[{views}];"));
    if target == Target::Tiles {
        let (map, clip) = (names.uniform(Uniform::Map), names.uniform(Uniform::Clip));
        edits.append(format!("uniform vec4 {map};"));
        edits.append(format!("uniform vec4 {clip};"));
    }
}

/// Writes the statements that move `gl_Position` to the tile of the view, or choose its layer. `view` is an index into the uniforms,
/// `first` one into `gl_ClipDistance`.
pub(super) fn write_position(
    edits: &mut Edits,
    names: &Names,
    target: Target,
    view: &str,
    first: u32,
) {
    let tile = names.uniform(Uniform::Tile);
    match target {
        Target::Whole => {}
        Target::DistortedRays => {
            let distort = names.other("distort_rays");
            edits.append(format!("    gl_Position = {distort}(gl_Position);"));
        }
        Target::Layer(_) => edits.append(format!("    gl_Layer = int({tile}[{view}].z);")),
        Target::Tiles => {
            let (map, clip) = (names.uniform(Uniform::Map), names.uniform(Uniform::Clip));
            let second = first + 1;
            for line in [
                format!("gl_ClipDistance[{first}] = gl_Position.x - {clip}.x * gl_Position.w;"),
                format!("gl_ClipDistance[{second}] = {clip}.y * gl_Position.w - gl_Position.x;"),
                format!(
                    "gl_Position.xy = gl_Position.xy * {map}.xy + {tile}[{view}].xy * gl_Position.w;"
                ),
            ] {
                edits.append(format!("    {line}"));
            }
        }
    }
}
