//! Lighting (OpenGL 4.6 compatibility, section 12.2.1), and the colours of unlit vertices.
//!
//! The equation, per face with material (e, a, d, s, shininess) and normal n (−n for the back):
//! ```text
//! c = e + a·scene + Σ att_i·spot_i·(a·a_i + max(n·L_i, 0)·d·d_i + f_i·max(n·H_i, 0)^shininess·s·s_i)
//! ```
//! with f_i = 1 if n·L_i > 0, else 0, and 0^0 = 1. Its alpha is that of d. With separate specular colour the last term
//! goes to the secondary colour.

use super::components::Varying;
use super::key::{ColorMaterial, Dialect, FixedKey, Light, Lighting, MaterialFace, MaterialMode};
use super::text::Text;

/// A face of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Face {
    Front,
    Back,
}

/// A material property that colour material can replace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Property {
    Emission,
    Ambient,
    Diffuse,
    Specular,
}

impl Face {
    /// Prefix of the built-in uniforms.
    fn builtin(self) -> &'static str {
        match self {
            Face::Front => "gl_Front",
            Face::Back => "gl_Back",
        }
    }

    /// Prefix of the local variables.
    fn local(self) -> &'static str {
        match self {
            Face::Front => "front",
            Face::Back => "back",
        }
    }

    /// Sign of a dot product with the normal.
    fn sign(self) -> &'static str {
        match self {
            Face::Front => "",
            Face::Back => "-",
        }
    }
}

impl Property {
    fn member(self) -> &'static str {
        match self {
            Property::Emission => "emission",
            Property::Ambient => "ambient",
            Property::Diffuse => "diffuse",
            Property::Specular => "specular",
        }
    }
}

/// Whether the property follows the colour of the vertex.
fn follows(material: Option<ColorMaterial>, face: Face, property: Property) -> bool {
    let Some(ColorMaterial { face: faces, mode }) = material else {
        return false;
    };
    let face = match faces {
        MaterialFace::FrontAndBack => true,
        MaterialFace::Front => face == Face::Front,
        MaterialFace::Back => face == Face::Back,
    };
    let property = match mode {
        MaterialMode::Emission => property == Property::Emission,
        MaterialMode::Ambient => property == Property::Ambient,
        MaterialMode::Diffuse => property == Property::Diffuse,
        MaterialMode::Specular => property == Property::Specular,
        MaterialMode::AmbientAndDiffuse => {
            matches!(property, Property::Ambient | Property::Diffuse)
        }
    };
    face && property
}

/// Material property of a face.
fn material(lighting: &Lighting, face: Face, property: Property) -> String {
    if follows(lighting.color_material, face, property) {
        "gl_Color".into()
    } else {
        format!("{}Material.{}", face.builtin(), property.member())
    }
}

/// Product of a light's and a material's colour.
fn product(lighting: &Lighting, face: Face, light: usize, property: Property) -> String {
    let member = property.member();
    if follows(lighting.color_material, face, property) {
        format!("gl_LightSource[{light}].{member}.rgb * gl_Color.rgb")
    } else {
        format!("{}LightProduct[{light}].{member}.rgb", face.builtin())
    }
}

/// The sum of emission and the scene's ambient light.
fn scene(lighting: &Lighting, face: Face) -> String {
    let varies = |property| follows(lighting.color_material, face, property);
    if varies(Property::Emission) || varies(Property::Ambient) {
        format!(
            "{}.rgb + {}.rgb * gl_LightModel.ambient.rgb",
            material(lighting, face, Property::Emission),
            material(lighting, face, Property::Ambient)
        )
    } else {
        format!("{}LightModelProduct.sceneColor.rgb", face.builtin())
    }
}

/// Functions that [`write`] calls.
pub(super) fn write_functions(text: &mut Text, key: &FixedKey) {
    if key.lights().next().is_none() {
        return;
    }
    text.lines(&[
        "// 0 to the power of 0 is 1 in the lighting equation and undefined in GLSL.",
        "float mv_power(float base, float exponent) {",
        "    return exponent == 0.0 ? 1.0 : pow(max(base, 0.0), exponent);",
        "}",
        "",
        "// normalize(), summed in this order.",
        "vec3 mv_unit(vec3 v) {",
        "    return v * inversesqrt(v.x * v.x + v.y * v.y + v.z * v.z);",
        "}",
        "",
    ]);
}

/// Writes the colours to the outputs that `name` gives. Expects `vec4 eye` and `vec3 normal` where the key needs them.
pub(super) fn write(text: &mut Text, key: &FixedKey, name: &dyn Fn(Varying) -> String) {
    match &key.lighting {
        Some(lighting) => write_lit(text, key, lighting, name),
        None => {
            text.line(format!(
                "{} = {};",
                name(Varying::Front),
                clamped(key, "gl_Color")
            ));
            if key.color_sum {
                text.line(format!(
                    "{} = {};",
                    name(Varying::FrontSecondary),
                    clamped(key, "gl_SecondaryColor")
                ));
            }
        }
    }
}

fn clamped(key: &FixedKey, value: &str) -> String {
    if key.clamp_colors {
        format!("clamp({value}, 0.0, 1.0)")
    } else {
        value.into()
    }
}

fn write_lit(
    text: &mut Text,
    key: &FixedKey,
    lighting: &Lighting,
    name: &dyn Fn(Varying) -> String,
) {
    let faces: &[Face] = if lighting.two_side {
        &[Face::Front, Face::Back]
    } else {
        &[Face::Front]
    };
    let lit = key.lights().next().is_some();
    for &face in faces {
        let local = face.local();
        text.line(format!("vec3 {local} = {};", scene(lighting, face)));
        if lit && lighting.separate_specular {
            text.line(format!("vec3 {local}_shine = vec3(0.0);"));
        }
    }
    write_viewer(text, key, lighting);
    for (index, light) in lighting.lights.iter().enumerate() {
        if let Some(light) = light {
            write_light(text, lighting, faces, index, *light);
        }
    }
    for &face in faces {
        let (local, alpha) = (face.local(), material(lighting, face, Property::Diffuse));
        let (primary, secondary) = match face {
            Face::Front => (Varying::Front, Varying::FrontSecondary),
            Face::Back => (Varying::Back, Varying::BackSecondary),
        };
        let shine = if lit {
            format!("{local}_shine")
        } else {
            "vec3(0.0)".into()
        };
        if lighting.separate_specular {
            let value = format!("vec4({local}, {alpha}.a)");
            text.line(format!("{} = {};", name(primary), clamped(key, &value)));
            let value = format!("vec4({shine}, 0.0)");
            text.line(format!("{} = {};", name(secondary), clamped(key, &value)));
        } else {
            let value = format!("vec4({local}, {alpha}.a)");
            text.line(format!("{} = {};", name(primary), clamped(key, &value)));
        }
    }
}

/// Declares the vertex position, from which vectors to lights and viewer start, and the direction to the viewer.
fn write_viewer(text: &mut Text, key: &FixedKey, lighting: &Lighting) {
    if lighting.local_viewer || key.lights().any(|light| light.positional) {
        text.line(match key.dialect {
            // A vertex at infinity (w = 0) is a direction in 12.2.1.1; we take its xyz for both.
            Dialect::Specification => "vec3 place = eye.w == 0.0 ? eye.xyz : eye.xyz / eye.w;",
            Dialect::Mesa => "vec3 place = eye.xyz;",
        });
    }
    if key.lights().next().is_some() && lighting.local_viewer {
        text.line("vec3 to_viewer = -normalize(place);");
    }
}

/// Adds one light. The sums are in the order of Mesa's `ffvertex_prog.c` (`build_lighting`), so that rounding is the same and
/// most vertices get exactly the colours of fixed function.
fn write_light(text: &mut Text, lighting: &Lighting, faces: &[Face], index: usize, light: Light) {
    let source = format!("gl_LightSource[{index}]");
    text.open(format!("{{ // light {index}"));
    if light.positional {
        text.line(format!(
            "vec3 to_light = {source}.position.xyz / {source}.position.w - place;"
        ));
        text.line("float near = inversesqrt(dot(to_light, to_light)); // 1 / distance");
        text.line("to_light *= near;");
    } else if lighting.object_space {
        text.line(format!(
            "vec3 to_light = mv_unit((gl_ModelViewMatrixInverse * {source}.position).xyz);"
        ));
    } else {
        text.line(format!("vec3 to_light = mv_unit({source}.position.xyz);"));
    }
    let scaled = light.spot || light.attenuated;
    if light.spot {
        text.line(format!(
            "float spot = dot(-to_light, mv_unit({source}.spotDirection));"
        ));
        text.line(format!(
            "float strength = spot >= {source}.spotCosCutoff ? mv_power(spot, {source}.spotExponent) : 0.0;"
        ));
    }
    if light.attenuated {
        text.line("float range = 1.0 / near;");
        text.line(format!(
            "float fall = 1.0 / dot(vec3({source}.constantAttenuation, {source}.linearAttenuation, \
             {source}.quadraticAttenuation), vec3(1.0, range, range * range));"
        ));
        text.line(if light.spot {
            "strength = fall * strength;"
        } else {
            "float strength = fall;"
        });
    }
    text.line("float facing = dot(normal, to_light);");
    // Mesa 22.3 sums from x to z where it computes a vector once on the CPU, as mv_unit does; dot() sums from z to x on the GPU.
    let half = match (
        lighting.local_viewer,
        light.positional,
        lighting.object_space,
    ) {
        (true, ..) => "normalize(to_light + to_viewer)",
        (_, true, _) => "normalize(to_light + vec3(0.0, 0.0, 1.0))",
        (_, _, true) => {
            "mv_unit(to_light + vec3(gl_ModelViewMatrix[0].z, gl_ModelViewMatrix[1].z, gl_ModelViewMatrix[2].z))"
        }
        (_, _, false) => "mv_unit(to_light + vec3(0.0, 0.0, 1.0))",
    };
    text.line(format!("float gloss = dot(normal, {half});"));
    let times = if scaled { " * strength" } else { "" };
    for &face in faces {
        let (local, sign) = (face.local(), face.sign());
        let [ambient, diffuse, specular] =
            [Property::Ambient, Property::Diffuse, Property::Specular]
                .map(|property| product(lighting, face, index, property));
        let shine = if lighting.separate_specular {
            format!("{local}_shine")
        } else {
            local.to_string()
        };
        text.line(if scaled {
            format!("{local} = strength * ({ambient}) + {local};")
        } else {
            format!("{local} = {ambient} + {local};")
        });
        text.line(format!(
            "{local} = (max({sign}facing, 0.0){times}) * ({diffuse}) + {local};"
        ));
        text.open(format!("if ({sign}facing > 0.0) {{"));
        text.line(format!(
            "{shine} = (mv_power({sign}gloss, {}Material.shininess){times}) * ({specular}) + {shine};",
            face.builtin()
        ));
        text.close("}");
    }
    text.close("}");
}
