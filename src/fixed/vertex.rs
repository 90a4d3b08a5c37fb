//! The vertex shader: everything that fixed function computes per vertex.

use super::components::{Varying, varyings};
use super::key::{Dialect, FixedKey, FogSource, NormalScaling, PointSize, Tiles};
use super::limits::Limits;
use super::reason::Unsupported;
use super::text::{Text, VERSION};
use super::{UNIFORM_FIRST, lighting, texgen, view};

/// Name of the block between the vertex shader and a geometry or tessellation shader.
pub(super) const BLOCK: &str = "mv_Vertex";

/// Source of the vertex shader of a canonical key.
pub(super) fn write(key: &FixedKey, limits: &Limits) -> Result<String, Unsupported> {
    if limits.glsl < VERSION {
        return Err(Unsupported::ShadingLanguage {
            needed: VERSION,
            has: limits.glsl,
        });
    }
    let mut text = Text::default();
    text.line(format!("#version {VERSION} compatibility"));
    if !key.geometry() && key.target.tiles == Tiles::Layer {
        let layer = limits.vertex_layer.ok_or(Unsupported::VertexLayer)?;
        text.line(format!("#extension {} : require", layer.extension()));
    }
    text.line("");
    if key.geometry() {
        write_block(&mut text, key, "out", "mv_out");
    } else {
        view::write_uniforms(&mut text, key);
        view::write_outputs(&mut text, key);
        text.line("");
        view::write_position(&mut text, key);
    }
    text.line("");
    lighting::write_functions(&mut text, key);
    write_main(&mut text, key);
    Ok(text.finish())
}

/// Writes the interface block of the values that a later stage takes per vertex.
pub(super) fn write_block(text: &mut Text, key: &FixedKey, direction: &str, instance: &str) {
    text.open(format!("{direction} {BLOCK} {{"));
    for varying in varyings(key) {
        text.line(format!("{} {};", varying.glsl_type(), varying.member()));
    }
    text.close(format!("}} {instance};"));
}

/// Writes the declarations of a last stage that is not the vertex shader: its inputs, and those of the view.
pub(super) fn write_last(text: &mut Text, key: &FixedKey) {
    write_block(text, key, "in", "mv_in[]");
    view::write_uniforms(text, key);
    view::write_outputs(text, key);
    text.line("");
    view::write_position(text, key);
    text.line("");
}

/// Writes an interpolated value, from a function that gives the expression of the value at a corner.
type Between<'a> = dyn Fn(&dyn Fn(u8) -> String) -> String + 'a;

/// Writes the built-in outputs of a vertex within a primitive; `between` interpolates each value from the corners. A flat
/// primitive has the colours of corner `flat`.
pub(super) fn write_between(
    text: &mut Text,
    key: &FixedKey,
    flat: Option<u8>,
    between: &Between<'_>,
) {
    for varying in varyings(key) {
        let Some(builtin) = varying.builtin(key) else {
            continue;
        };
        let value = match flat {
            Some(source) if varying.is_color() => format!("mv_in[{source}].{}", varying.member()),
            _ => between(&|i| format!("mv_in[{i}].{}", varying.member())),
        };
        text.line(format!("{builtin} = {value};"));
    }
}

/// Name of the output of a value: a member of the block, or the built-in that the next stage reads.
fn output(key: &FixedKey, varying: Varying) -> String {
    match varying.builtin(key) {
        Some(builtin) if !key.geometry() => builtin,
        _ => format!("mv_out.{}", varying.member()),
    }
}

fn write_main(text: &mut Text, key: &FixedKey) {
    let name = |varying| output(key, varying);
    text.open("void main() {");
    if key.needs_eye() {
        text.line("vec4 eye = gl_ModelViewMatrix * gl_Vertex;");
    }
    write_position(text, key);
    if key.needs_normal() {
        let normal = if key.lighting.is_some_and(|lighting| lighting.object_space) {
            "gl_Normal"
        } else {
            "gl_NormalMatrix * gl_Normal"
        };
        text.line(match key.normals {
            NormalScaling::None => format!("vec3 normal = {normal};"),
            NormalScaling::Rescale => format!("vec3 normal = gl_NormalScale * ({normal});"),
            NormalScaling::Normalize => format!("vec3 normal = normalize({normal});"),
        });
    }
    lighting::write(text, key, &name);
    texgen::write(text, key, &name);
    write_fog(text, key, &name);
    write_point_size(text, key, &name);
    for plane in key.planes() {
        text.line(format!(
            "{} = dot(gl_ClipPlane[{plane}], eye);",
            name(Varying::Plane(plane))
        ));
    }
    text.close("}");
}

/// Only `ftransform()` is guaranteed to give the position of fixed function (11.1.3.11); passes that test for equal depth
/// rely on it.
fn write_position(text: &mut Text, key: &FixedKey) {
    if key.geometry() {
        text.line("gl_Position = ftransform();");
        text.line("mv_out.vertex = gl_Vertex;");
    } else {
        text.line(match key.target.tiles {
            Tiles::DistortedRays => "mv_place(ftransform());".to_owned(),
            _ => format!("mv_place({UNIFORM_FIRST} + gl_InstanceID, ftransform(), gl_Vertex);"),
        });
    }
}

/// Fog coordinate (16.4).
fn write_fog(text: &mut Text, key: &FixedKey, name: &dyn Fn(Varying) -> String) {
    let value = match (key.fog, key.dialect) {
        (FogSource::None, _) => return,
        (FogSource::Coordinate, Dialect::Specification) => "gl_FogCoord",
        (FogSource::Coordinate, Dialect::Mesa) => "abs(gl_FogCoord)",
        (FogSource::DepthMagnitude, _) => "abs(eye.z)",
        (FogSource::Depth, _) => "eye.z",
        (FogSource::Radial, _) => "length(eye.xyz)",
    };
    text.line(format!("{} = {value};", name(Varying::Fog)));
}

/// Derived size of a point (14.4), which the rasteriser then clamps to what it can draw.
fn write_point_size(text: &mut Text, key: &FixedKey, name: &dyn Fn(Varying) -> String) {
    if key.point != PointSize::Attenuated {
        return;
    }
    text.line("float depth = abs(eye.z);");
    text.line(
        "float fall = gl_Point.distanceConstantAttenuation + (gl_Point.distanceLinearAttenuation + \
         gl_Point.distanceQuadraticAttenuation * depth) * depth;",
    );
    text.line(format!(
        "{} = min(max(gl_Point.size * inversesqrt(fall), gl_Point.sizeMin), gl_Point.sizeMax);",
        name(Varying::PointSize)
    ));
}
