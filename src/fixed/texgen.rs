//! Texture coordinates: generation and texture matrices (OpenGL 4.6 compatibility, sections 12.1.1 and 12.1.3).

use super::components::Varying;
use super::key::{FixedKey, TexGen};
use super::text::Text;

/// Swizzles and the letters in the names of the built-in planes.
const COORDINATES: [(&str, &str); 4] = [("x", "S"), ("y", "T"), ("z", "R"), ("w", "Q")];

/// Writes the coordinate sets to the outputs that `name` gives. Expects `vec4 eye` and `vec3 normal` where the key needs them.
pub(super) fn write(text: &mut Text, key: &FixedKey, name: &dyn Fn(Varying) -> String) {
    if key.needs_reflection() {
        text.line("vec3 ray = normalize(eye.xyz);");
        text.line("vec3 bounce = ray - 2.0 * dot(normal, ray) * normal;");
    }
    if key.generates(TexGen::SphereMap) {
        // (r_x, r_y) / m + 1/2, m = 2·sqrt(r_x² + r_y² + (r_z + 1)²)
        text.line("vec2 sphere = bounce.xy / (2.0 * length(bounce + vec3(0.0, 0.0, 1.0))) + 0.5;");
    }
    for unit in key.coordinate_sets() {
        write_unit(text, key, unit, &name(Varying::TexCoord(unit)));
    }
}

fn write_unit(text: &mut Text, key: &FixedKey, unit: usize, output: &str) {
    let state = &key.units[unit];
    let matrix = if state.matrix {
        format!("gl_TextureMatrix[{unit}] * ")
    } else {
        String::new()
    };
    if state.generation.iter().all(Option::is_none) {
        text.line(format!("{output} = {matrix}gl_MultiTexCoord{unit};"));
        return;
    }
    let parts = [0, 1, 2, 3].map(|part| {
        let (swizzle, letter) = COORDINATES[part];
        match state.generation[part] {
            None => format!("gl_MultiTexCoord{unit}.{swizzle}"),
            Some(TexGen::ObjectLinear) => format!("dot(gl_Vertex, gl_ObjectPlane{letter}[{unit}])"),
            // The stored plane already includes the inverse of the modelview matrix at the time of glTexGen.
            Some(TexGen::EyeLinear) => format!("dot(eye, gl_EyePlane{letter}[{unit}])"),
            // S and T alone have this mode; GL refuses it for the others.
            Some(TexGen::SphereMap) if part < 2 => format!("sphere.{swizzle}"),
            Some(TexGen::ReflectionMap) if part < 3 => format!("bounce.{swizzle}"),
            Some(TexGen::NormalMap) if part < 3 => format!("normal.{swizzle}"),
            Some(TexGen::SphereMap | TexGen::ReflectionMap | TexGen::NormalMap) => {
                format!("gl_MultiTexCoord{unit}.{swizzle}")
            }
        }
    });
    text.line(format!("{output} = {matrix}vec4({});", parts.join(", ")));
}
