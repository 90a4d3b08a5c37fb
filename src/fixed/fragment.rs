//! The fragment shader: everything that fixed function computes per fragment before alpha test and blending.
//!
//! The driver's own fragment stage does not suffice in three cases: textures are filtered in tiles whose pixels are further
//! apart than the window's, fragments beyond their tile are discarded, or the displacement by distorted rays is an output.
//!
//! ```text
//! textures ──► environments ──► colour sum ──► fog ──► discard
//! 8.14          16.2            16.3           16.4
//! ```
//! Sections are those of the OpenGL 4.6 compatibility specification.

use super::distortion::DISPLACEMENT;
use super::environment;
use super::fragment_key::{FogMode, FragmentKey, FragmentUnit, TextureTarget};
use super::key::Dialect;
use super::limits::Limits;
use super::points::{PointPlace, point_globals, point_test};
use super::reason::Unsupported;
use super::surface::surface_disk;
use super::text::{Text, VERSION};
use super::{LIMITS, UNIFORM_GRID};

/// Name of the sampler uniform of a texture unit; its value has to be the unit's index.
pub fn sampler(unit: usize) -> String {
    format!("mv_texture{unit}")
}

/// Writes the fragment shader of a key that [`FragmentKey::after`] has matched to the vertex stage of the program.
/// Equal canonical keys give equal sources.
///
/// # Errors
/// If the driver cannot run the shader, or if the specification leaves a texture environment undefined. The draw then has
/// to be replayed with the driver's own fragment stage.
pub fn generate_fragment(key: &FragmentKey, limits: &Limits) -> Result<String, Unsupported> {
    if limits.glsl < VERSION {
        return Err(Unsupported::ShadingLanguage {
            needed: VERSION,
            has: limits.glsl,
        });
    }
    let key = key.canonical();
    let mut text = Text::default();
    text.line(format!("#version {VERSION} compatibility"));
    text.line("");
    for (unit, state) in sampled(&key) {
        text.line(format!(
            "uniform {} {};",
            sampler_type(state.target),
            sampler(unit)
        ));
    }
    if key.grid {
        text.line(format!(
            "uniform vec4 {UNIFORM_GRID}; // tile pixels per window pixel: x and y of one step in x, then of one in y"
        ));
    }
    if key.discard {
        text.line(format!(
            "flat in vec2 {LIMITS}; // left and right of the view in window coordinates"
        ));
    }
    if key.displaced {
        text.line(format!(
            "in vec2 {DISPLACEMENT}; // pixels, times w; 1: all of it is moved"
        ));
    }
    if key.points {
        text.line(point_globals("mv_"));
        text.line(point_test("mv_", PointPlace::Rows, VERSION));
    }
    if key.disks {
        text.line(surface_disk("mv_"));
    }
    text.line("");
    text.open("void main() {");
    let samples = sampled(&key).next().is_some();
    if key.points && !samples {
        text.line("if (!mv_visible()) discard;");
    }
    for (unit, state) in sampled(&key) {
        write_texel(&mut text, &key, unit, state);
    }
    text.line("vec4 color = gl_Color;");
    for (unit, state) in key.units.iter().enumerate() {
        if let Some(state) = state {
            environment::write(&mut text, &key, unit, state)?;
        }
    }
    if key.color_sum {
        text.line("color.rgb += gl_SecondaryColor.rgb;");
        // Mesa's ff_fragment_shader.cpp does not clamp the sum before fog; without fog the framebuffer clamps.
        if key.fog != FogMode::None && key.dialect == Dialect::Specification {
            text.line("color.rgb = min(color.rgb, 1.0);");
        }
    }
    write_fog(&mut text, key.fog);
    // The discard comes last, because textures that are sampled after it have no gradients.
    if key.points && samples {
        text.line("if (!mv_visible()) discard;");
    }
    if key.disks {
        text.line("if (!mv_in_disk()) discard;");
    }
    if key.discard {
        text.line(format!(
            "if (gl_FragCoord.x < {LIMITS}.x || gl_FragCoord.x >= {LIMITS}.y) {{"
        ));
        text.line("    discard;");
        text.line("}");
    }
    if key.displaced {
        text.line(format!("if ({DISPLACEMENT}.y < 0.999) discard;"));
        text.line("gl_FragData[0] = color;");
        text.line(format!(
            "gl_FragData[1] = vec4({DISPLACEMENT}.x * gl_FragCoord.w);"
        ));
    } else {
        text.line("gl_FragColor = color;");
    }
    text.close("}");
    Ok(text.finish())
}

fn sampled(key: &FragmentKey) -> impl Iterator<Item = (usize, &FragmentUnit)> {
    key.sampled()
        .filter_map(|unit| Some((unit, key.units[unit].as_ref()?)))
}

fn sampler_type(target: TextureTarget) -> &'static str {
    match target {
        TextureTarget::Cube => "samplerCube",
        TextureTarget::ThreeD => "sampler3D",
        TextureTarget::Rectangle => "sampler2DRect",
        TextureTarget::TwoD => "sampler2D",
        TextureTarget::OneD => "sampler1D",
    }
}

/// Declares `texelN`. Coordinates are divided by q, except those of a cube map (section 16.2); Mesa divides those too.
fn write_texel(text: &mut Text, key: &FragmentKey, unit: usize, state: &FragmentUnit) {
    let sampler = sampler(unit);
    let coordinate = format!("gl_TexCoord[{unit}]");
    if !state.detail {
        text.line(match (state.target, key.dialect) {
            (TextureTarget::Cube, Dialect::Specification) => {
                format!("vec4 texel{unit} = texture({sampler}, {coordinate}.xyz);")
            }
            (TextureTarget::Cube, Dialect::Mesa) => {
                format!("vec4 texel{unit} = texture({sampler}, {coordinate}.xyz / {coordinate}.w);")
            }
            _ => format!("vec4 texel{unit} = textureProj({sampler}, {coordinate});"),
        });
        return;
    }
    let divided = state.target != TextureTarget::Cube || key.dialect == Dialect::Mesa;
    let (kind, parts) = match state.target {
        TextureTarget::OneD => ("float", "x"),
        TextureTarget::TwoD | TextureTarget::Rectangle => ("vec2", "xy"),
        TextureTarget::ThreeD | TextureTarget::Cube => ("vec3", "xyz"),
    };
    let at = format!("at{unit}");
    text.line(if divided {
        format!("{kind} {at} = {coordinate}.{parts} / {coordinate}.w;")
    } else {
        format!("{kind} {at} = {coordinate}.{parts};")
    });
    let gradient = |x: &str, y: &str| {
        format!("dFdx({at}) * {UNIFORM_GRID}.{x} + dFdy({at}) * {UNIFORM_GRID}.{y}")
    };
    text.line(format!(
        "vec4 texel{unit} = textureGrad({sampler}, {at}, {}, {});",
        gradient("x", "y"),
        gradient("z", "w")
    ));
}

/// Blends with the fog colour (16.4), without alpha.
fn write_fog(text: &mut Text, mode: FogMode) {
    let factor = match mode {
        FogMode::None => return,
        FogMode::Linear => "(gl_Fog.end - gl_FogFragCoord) * gl_Fog.scale",
        FogMode::Exp => "exp(-gl_Fog.density * gl_FogFragCoord)",
        FogMode::Exp2 => {
            text.line("float thickness = gl_Fog.density * gl_FogFragCoord;");
            "exp(-thickness * thickness)"
        }
    };
    text.line(format!("float clear = clamp({factor}, 0.0, 1.0);"));
    text.line("color.rgb = mix(gl_Fog.color.rgb, color.rgb, clear);");
}
