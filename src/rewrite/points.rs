//! A program that draws points, for all views at once: a geometry shader between its two shaders. It emits one quad for all views, and the fragment shader is behind a test
//! of what the view of a pixel sees (see [`crate::fixed::point_quads`]); or it emits the point again for each view, to the layer of that.
//!
//! The vertex shader stays as it is. The geometry shader passes its outputs on under other names, as a name cannot be both input and output of a stage; the
//! fragment shader gets these. All of a point's values are constant over it, so nothing is interpolated.

use super::edit::Edits;
use super::entry;
use super::error::Refusal;
use super::facts::Facts;
use super::names::{Names, Uniform};
use super::scan::{Kind, Scan};
use super::version::Version;
use crate::fixed::{
    PointPlace, SURFACE_EXTENSION, point_globals, point_quads, point_shift, point_test,
    surface_disk, surface_size,
};
use std::fmt::Write;

/// The shaders of points for all views.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PointShaders {
    /// The source of the geometry shader.
    pub geometry: String,
    /// The new source of the fragment shader.
    pub fragment: Vec<u8>,
    /// The names of what was added.
    pub names: Names,
}

/// A variable between the stages.
struct Varying {
    /// What stands before the direction, such as `flat`.
    qualifiers: String,
    kind: String,
    name: Vec<u8>,
}

const TYPES: [&[u8]; 14] = [
    b"float", b"vec2", b"vec3", b"vec4", b"int", b"ivec2", b"ivec3", b"ivec4", b"uint", b"uvec2",
    b"uvec3", b"uvec4", b"mat3", b"mat4",
];

/// Where the points of all views go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointsTo {
    /// To the samples that a panel shows.
    Samples,
    /// To the layers of the views, so many views at most in a draw.
    Layers(u32),
    /// The same, as disks of a surface (see [`crate::fixed::surface_size`]).
    Surfaces(u32),
}

/// Makes the shaders of points of a program with a vertex and a fragment shader, one object each. `compatibility`: of the context's profile.
///
/// # Errors
/// Why there are none.
pub fn points(
    vertex: &[u8],
    fragment: &[u8],
    to: PointsTo,
    compatibility: bool,
) -> Result<PointShaders, Refusal> {
    match to {
        PointsTo::Samples => to_samples(vertex, fragment, compatibility),
        PointsTo::Layers(views) => to_layers(vertex, fragment, (views, false), compatibility),
        PointsTo::Surfaces(views) => to_layers(vertex, fragment, (views, true), compatibility),
    }
}

fn to_layers(
    vertex: &[u8],
    fragment: &[u8],
    (views, surfaces): (u32, bool),
    compatibility: bool,
) -> Result<PointShaders, Refusal> {
    let pair = Pair::of(vertex, fragment)?;
    let Pair {
        from, to, names, ..
    } = &pair;
    let used = |scan: &Scan, word: &[u8]| (0..scan.tokens.len()).any(|at| *scan.name(at) == *word);
    let taken = [
        ("gl_Layer", pair.facts.layer),
        ("gl_ViewportIndex", pair.facts.viewport_index),
        ("gl_ClipDistance", pair.facts.clip_distance),
        ("memory that it writes to", !pair.facts.writes.is_empty()),
        ("helpers", !pair.facts.main),
        // It makes a shape of its own.
        ("gl_PointCoord", surfaces && used(to, b"gl_PointCoord")),
    ];
    if let Some((name, _)) = taken.into_iter().find(|&(_, used)| used) {
        return Err(Refusal::Uses(name));
    }
    let varyings = varyings(to)?;
    check_members(to, &varyings)?;
    let mut edits = Edits::new(to, pair.version);
    for (at, token) in to.tokens.iter().enumerate() {
        let number = varyings
            .iter()
            .position(|varying| varying.name == *to.name(at));
        if let Some(number) = number.filter(|_| !to.is(at.wrapping_sub(1), b'.')) {
            edits.replace(token, renamed(names, number));
        }
    }
    let newest = pair.first.number.max(pair.version.number);
    let mut output = format!("layout(points, max_vertices = {views}) out;");
    if surfaces {
        output = format!("{SURFACE_EXTENSION}\n{output}");
    }
    let mut text = head(names, to, &varyings, (newest, compatibility), &output)?;
    let (shift, tile) = (names.uniform(Uniform::Shift), names.uniform(Uniform::Tile));
    let (count, x, pass) = (
        names.uniform(Uniform::Views),
        names.other("x"),
        names.other("pass"),
    );
    let _ = writeln!(
        text,
        "uniform vec4 {shift}[{views}], {tile}[{views}];\nuniform int {count};"
    );
    text.push_str(&point_shift(&names.other("")));
    if surfaces {
        text.push_str(&surface_size(&names.other("")));
    }
    let _ = writeln!(
        text,
        "void main() {{\n    for (int i = 0; i < {count}; ++i) {{\n        {pass}();"
    );
    let written = used(from, b"gl_PointSize");
    if surfaces {
        // Where the vertex shader writes no size, it is zero there.
        let sizes = names.other("surface");
        let size = match written {
            true => format!("{sizes}.z > 0.0 ? {sizes}.z : gl_in[0].gl_PointSize"),
            false => format!("{sizes}.z"),
        };
        let _ = writeln!(
            text,
            "        gl_PointSize = {}(gl_in[0].gl_Position, {size});",
            names.other("point_size")
        );
    } else if written {
        text.push_str("        gl_PointSize = gl_in[0].gl_PointSize;\n");
    }
    if used(to, b"gl_PrimitiveID") {
        text.push_str("        gl_PrimitiveID = gl_PrimitiveIDIn;\n");
    }
    let _ = writeln!(text, "        gl_Layer = int({tile}[i].z);");
    text.push_str("        vec4 p = gl_in[0].gl_Position;\n");
    let _ = writeln!(
        text,
        "        p.x = {x}(p, vec4(0.0), i);\n        gl_Position = p;"
    );
    text.push_str("        EmitVertex();\n        EndPrimitive();\n    }\n}\n");
    if surfaces {
        entry::rename(&mut edits, to, names)?;
        edits.append(surface_disk(&names.other("")));
        let (own, disk) = (names.other("main"), names.other("in_disk"));
        // A texture that is sampled after a discard has no gradients.
        edits.append(format!(
            "void main() {{\n    {own}();\n    if (!{disk}()) discard;\n}}"
        ));
    }
    let fragment = edits.finish()?.into_owned();
    Ok(PointShaders {
        geometry: text,
        fragment,
        names: names.clone(),
    })
}

/// The two shaders of a program, as far as both ways look into them.
struct Pair<'a> {
    from: Scan<'a>,
    to: Scan<'a>,
    /// Of the vertex shader, and of the fragment shader.
    first: Version,
    version: Version,
    names: Names,
    /// Of the fragment shader.
    facts: Facts,
}

impl<'a> Pair<'a> {
    fn of(vertex: &'a [u8], fragment: &'a [u8]) -> Result<Self, Refusal> {
        let [from, to] = [super::readable(vertex)?, super::readable(fragment)?];
        let [first, version] = [&from, &to].map(|scan| Version::of(scan, false));
        if first.es || version.es {
            return Err(Refusal::Es);
        }
        let names = Names::of(&to);
        if names != Names::of(&from) {
            return Err(Refusal::Clash);
        }
        check_vertex(&from, &Facts::of(&from, first))?;
        let facts = Facts::of(&to, version);
        Ok(Self {
            from,
            to,
            first,
            version,
            names,
            facts,
        })
    }
}

fn to_samples(
    vertex: &[u8],
    fragment: &[u8],
    compatibility: bool,
) -> Result<PointShaders, Refusal> {
    let Pair {
        to,
        first,
        version,
        names,
        facts,
        ..
    } = Pair::of(vertex, fragment)?;
    let coordinates = check_fragment(&to, &facts)?;
    let varyings = varyings(&to)?;
    check_members(&to, &varyings)?;
    let mut edits = Edits::new(&to, version);
    entry::rename(&mut edits, &to, &names)?;
    let mut first_use = None;
    for at in 0..to.tokens.len() {
        let Some(token) = to.tokens.get(at) else {
            continue;
        };
        let name = to.name(at);
        let member = to.is(at.wrapping_sub(1), b'.');
        let new = match &*name {
            b"gl_PointCoord" => names.other("point_coord"),
            b"gl_FragCoord" if !matches!(&*to.name(at.wrapping_sub(1)), b"vec4" | b"invariant") => {
                names.other("coord")
            }
            // A point has no back.
            b"gl_FrontFacing" => "true".to_owned(),
            name => match varyings.iter().position(|varying| varying.name == name) {
                Some(number) if !member => renamed(&names, number),
                _ => continue,
            },
        };
        if matches!(&*name, b"gl_PointCoord" | b"gl_FragCoord") {
            first_use.get_or_insert(at);
        }
        edits.replace(token, new);
    }
    let prefix = names.other("");
    match first_use {
        Some(at) => edits.declare(point_globals(&prefix), at),
        None => edits.append(point_globals(&prefix)),
    }
    edits.append(point_test(&prefix, PointPlace::Shift, version.number));
    edits.append("void main() {");
    // A texture that is sampled after a discard has no gradients.
    let test = format!("    if (!{}()) discard;", names.other("visible"));
    let own = format!("    {}();", names.other("main"));
    let lines = match samples(&to) && !coordinates {
        true => [own, test],
        false => [test, own],
    };
    lines.iter().for_each(|line| edits.append(line));
    edits.append("}");
    let newest = first.number.max(version.number);
    Ok(PointShaders {
        geometry: geometry(&names, &to, &varyings, newest, compatibility)?,
        fragment: edits.finish()?.into_owned(),
        names,
    })
}

/// Refuses variables whose names are those of members as well, which keep theirs. Components of vectors are no members.
fn check_members(scan: &Scan, varyings: &[Varying]) -> Result<(), Refusal> {
    let component = |name: &[u8]| name.iter().all(|letter| b"xyzwrgbastpq".contains(letter));
    let member = |at: usize| {
        let name = scan.name(at);
        scan.is(at.wrapping_sub(1), b'.')
            && !component(&name)
            && varyings.iter().any(|varying| varying.name == *name)
    };
    match (0..scan.tokens.len()).any(member) {
        true => Err(Refusal::Varyings),
        false => Ok(()),
    }
}

fn renamed(names: &Names, number: usize) -> String {
    names.other(&format!("v{number}"))
}

fn check_vertex(scan: &Scan, facts: &Facts) -> Result<(), Refusal> {
    let taken = [
        ("gl_Layer", facts.layer),
        ("gl_ViewportIndex", facts.viewport_index),
        ("gl_ClipVertex", facts.clip_vertex),
        ("gl_ClipDistance", facts.clip_distance),
        ("gl_CullDistance", facts.cull_distance),
        ("the projection matrix of fixed function", facts.projection),
        ("subroutines", facts.subroutines),
        ("transform feedback", facts.feedback),
        ("memory that it writes to", !facts.writes.is_empty()),
        ("helpers", !facts.main),
    ];
    // Its size would be that of the vertex shader's block.
    let block = (0..scan.tokens.len()).any(|at| *scan.name(at) == *b"gl_PerVertex");
    match taken.into_iter().find(|&(_, used)| used) {
        Some((name, _)) => Err(Refusal::Uses(name)),
        None if block => Err(Refusal::Uses("gl_PerVertex")),
        None => Ok(()),
    }
}

/// Refuses a fragment shader that asks what only a rasterised point has. Returns whether it reads gl_FragCoord or gl_PointCoord.
fn check_fragment(scan: &Scan, facts: &Facts) -> Result<bool, Refusal> {
    let used = |word: &[u8]| (0..scan.tokens.len()).any(|at| *scan.name(at) == *word);
    let coordinates = facts.frag_coord || used(b"gl_PointCoord");
    let derivatives = [&b"dFdx"[..], b"dFdy", b"fwidth"].into_iter().any(used);
    let taken = [
        ("gl_PrimitiveID", used(b"gl_PrimitiveID")),
        ("gl_Layer", facts.layer),
        ("gl_ViewportIndex", facts.viewport_index),
        ("gl_ClipDistance", facts.clip_distance),
        ("gl_SampleID", used(b"gl_SampleID")),
        ("gl_SamplePosition", used(b"gl_SamplePosition")),
        ("gl_SampleMask", used(b"gl_SampleMask")),
        ("gl_SampleMaskIn", used(b"gl_SampleMaskIn")),
        ("early_fragment_tests", used(b"early_fragment_tests")),
        ("pixel_center_integer", facts.whole_centre),
        ("origin_upper_left", facts.upper_left),
        ("subroutines", facts.subroutines),
        ("memory that it writes to", !facts.writes.is_empty()),
        ("helpers", !facts.main),
        // Neighbours of a pixel are of other views.
        ("derivatives of places", coordinates && derivatives),
        ("textures at places", coordinates && samples(scan)),
    ];
    match taken.into_iter().find(|&(_, used)| used) {
        Some((name, _)) => Err(Refusal::Uses(name)),
        None => Ok(coordinates),
    }
}

/// Whether a shader samples textures whose level of detail follows from derivatives.
fn samples(scan: &Scan) -> bool {
    (0..scan.tokens.len()).any(|at| {
        let name = scan.name(at);
        let texture = name.starts_with(b"texture") || name.starts_with(b"shadow");
        let levels = [&b"textureLod"[..], b"textureGrad", b"textureSize"];
        texture && scan.is(at + 1, b'(') && !levels.iter().any(|word| name.starts_with(word))
    })
}

/// The variables from the stage before, which have to be plain: no blocks, arrays or structures, and outside of conditions.
fn varyings(scan: &Scan) -> Result<Vec<Varying>, Refusal> {
    let mut found = Vec::new();
    let (mut nested, mut conditions, mut start) = (0_usize, 0_usize, 0);
    let mut directives = scan.directives.iter();
    let mut at = 0;
    while let Some(token) = scan.tokens.get(at) {
        if token.directive {
            let Some(directive) = directives.next() else {
                break;
            };
            match &*scan.called(directive) {
                b"if" | b"ifdef" | b"ifndef" => conditions += 1,
                b"endif" => conditions = conditions.saturating_sub(1),
                _ => {}
            }
            at = directive.tokens.end.max(at + 1);
            start = at;
            continue;
        }
        match token.kind {
            Kind::Mark(b'{' | b'(') => nested += 1,
            Kind::Mark(b'}' | b')') => {
                nested = nested.saturating_sub(1);
                if nested == 0 && token.kind == Kind::Mark(b'}') {
                    start = at + 1;
                }
            }
            Kind::Mark(b';') if nested == 0 => start = at + 1,
            Kind::Name if nested == 0 && matches!(&*scan.name(at), b"in" | b"varying") => {
                if conditions > 0 {
                    return Err(Refusal::Varyings);
                }
                at = declared(scan, start, at, &mut found)?;
                start = at;
                continue;
            }
            _ => {}
        }
        at += 1;
    }
    Ok(found)
}

/// Reads a declaration whose qualifiers begin at `start` and whose direction is at `at`; returns the token after it.
fn declared(
    scan: &Scan,
    start: usize,
    at: usize,
    found: &mut Vec<Varying>,
) -> Result<usize, Refusal> {
    let text = |at: usize| match scan.tokens.get(at) {
        Some(token) => String::from_utf8_lossy(&scan.text(token)).into_owned(),
        None => String::new(),
    };
    let precise = |at: usize| matches!(&*scan.name(at), b"highp" | b"mediump" | b"lowp");
    let mut qualifiers = String::new();
    (start..at).for_each(|at| qualifiers += &(text(at) + " "));
    let mut next = at + 1;
    while precise(next)
        || matches!(
            &*scan.name(next),
            b"flat" | b"smooth" | b"noperspective" | b"centroid"
        )
    {
        if !precise(next) {
            qualifiers += &(text(next) + " ");
        }
        next += 1;
    }
    if matches!(&*scan.name(next + 1), b"gl_FragCoord" | b"gl_PointCoord") {
        return Ok(next + 2);
    }
    let kind = scan.name(next);
    if !TYPES.contains(&&*kind) || qualifiers.contains('#') || qualifiers.contains("sample") {
        return Err(Refusal::Varyings);
    }
    loop {
        next += 1;
        let name = scan.name(next);
        if name.is_empty() {
            return Err(Refusal::Varyings);
        }
        found.push(Varying {
            qualifiers: qualifiers.clone(),
            kind: String::from_utf8_lossy(&kind).into_owned(),
            name: name.into_owned(),
        });
        next += 1;
        match (scan.is(next, b';'), scan.is(next, b',')) {
            (true, _) => return Ok(next + 1),
            (_, true) => {}
            _ => return Err(Refusal::Varyings),
        }
    }
}

/// The geometry shader of quads; `newest` is the version of the newer of the program's shaders.
fn geometry(
    names: &Names,
    fragment: &Scan,
    varyings: &[Varying],
    newest: u32,
    compatibility: bool,
) -> Result<String, Refusal> {
    let output = "layout(triangle_strip, max_vertices = 4) out;";
    let mut text = head(names, fragment, varyings, (newest, compatibility), output)?;
    let prefix = names.other("");
    text.push_str(&point_quads(
        &prefix,
        PointPlace::Shift,
        Version::of(fragment, false).number,
        ["gl_in[0].gl_PointSize", "vec4(0.0)"],
    ));
    Ok(text)
}

/// The beginning of a geometry shader: its layouts, the variables between the stages, and the function that passes them on.
fn head(
    names: &Names,
    fragment: &Scan,
    varyings: &[Varying],
    (newest, compatibility): (u32, bool),
    output: &str,
) -> Result<String, Refusal> {
    let mut text = String::new();
    let profile = if compatibility { " compatibility" } else { "" };
    let located = varyings.iter().any(|v| v.qualifiers.contains("layout"));
    if located && newest < 410 {
        return Err(Refusal::Varyings);
    }
    let _ = writeln!(
        text,
        "#version {}{profile}\n{output}\nlayout(points) in;",
        newest.max(150)
    );
    for (number, varying) in varyings.iter().enumerate() {
        let Varying {
            qualifiers, kind, ..
        } = varying;
        let (name, new) = (
            String::from_utf8_lossy(&varying.name),
            renamed(names, number),
        );
        let _ = writeln!(
            text,
            "{qualifiers}in {kind} {name}[];\n{qualifiers}out {kind} {new};"
        );
    }
    let _ = writeln!(text, "void {}() {{", names.other("pass"));
    for (number, varying) in varyings.iter().enumerate() {
        let name = String::from_utf8_lossy(&varying.name);
        let _ = writeln!(text, "    {} = {name}[0];", renamed(names, number));
    }
    if compatibility {
        built_in(&mut text, fragment)?;
    }
    text.push_str("}\n");
    Ok(text)
}

/// Passes on the built-in variables of fixed function that the fragment shader reads.
fn built_in(text: &mut String, fragment: &Scan) -> Result<(), Refusal> {
    let used = |word: &[u8]| (0..fragment.tokens.len()).any(|at| *fragment.name(at) == *word);
    let plain: [(&[u8], &str, &str); 3] = [
        (b"gl_Color", "gl_FrontColor", "gl_BackColor"),
        (
            b"gl_SecondaryColor",
            "gl_FrontSecondaryColor",
            "gl_BackSecondaryColor",
        ),
        (b"gl_FogFragCoord", "gl_FogFragCoord", ""),
    ];
    for (word, front, back) in plain {
        if used(word) {
            for output in [front, back].into_iter().filter(|name| !name.is_empty()) {
                let _ = writeln!(text, "    {output} = gl_in[0].{front};");
            }
        }
    }
    for at in 0..fragment.tokens.len() {
        if *fragment.name(at) != *b"gl_TexCoord" {
            continue;
        }
        let number = fragment
            .number(at + 2)
            .filter(|_| fragment.is(at + 1, b'['));
        let number = number.ok_or(Refusal::Varyings)?;
        let _ = writeln!(
            text,
            "    gl_TexCoord[{number}] = gl_in[0].gl_TexCoord[{number}];"
        );
    }
    Ok(())
}
