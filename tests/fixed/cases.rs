//! Random fixed-function state: as a key for the generator, and as text for `ffcheck`.

use super::matrices::{IDENTITY, Matrix, matrices};
use super::random::{Random, floats};
use manyview::fixed::{
    Amplifier, Clip, ColorMaterial, Diagonal, Dialect, FixedKey, FogSource, LIGHTS, Light,
    Lighting, MaterialFace, MaterialMode, NormalScaling, PointSize, Primitive, Provoking, Target,
    TexGen, Tiles, UNITS,
};

/// One draw with its state.
pub(crate) struct Case {
    /// The generator's input.
    pub(crate) key: FixedKey,
    /// `ffcheck`'s input, except for the patches.
    pub(crate) text: String,
    /// The mode of the program, for the table of results.
    pub(crate) mode: &'static str,
    /// Views of the case.
    pub(crate) views: u8,
}

/// Modes of the program, the mode that is drawn in its place through a geometry shader, and the shader's input.
const MODES: [(&str, &str, Primitive); 11] = [
    ("GL_POINTS", "GL_POINTS", Primitive::Points),
    ("GL_LINES", "GL_LINES", Primitive::Lines),
    ("GL_LINE_STRIP", "GL_LINE_STRIP", Primitive::Lines),
    ("GL_LINE_LOOP", "GL_LINE_LOOP", Primitive::Lines),
    ("GL_TRIANGLES", "GL_TRIANGLES", Primitive::Triangles),
    (
        "GL_TRIANGLE_STRIP",
        "GL_TRIANGLE_STRIP",
        Primitive::Triangles,
    ),
    ("GL_TRIANGLE_FAN", "GL_TRIANGLE_FAN", Primitive::Triangles),
    ("GL_QUADS", "GL_LINES_ADJACENCY", Primitive::Quads),
    ("GL_QUAD_STRIP", "GL_LINES_ADJACENCY", Primitive::QuadStrip),
    ("GL_QUADS", "GL_LINES_ADJACENCY", Primitive::Quads),
    ("GL_POLYGON", "GL_TRIANGLE_FAN", Primitive::Polygon),
];

struct Writer {
    random: Random,
    key: FixedKey,
    text: String,
}

impl Writer {
    fn say(&mut self, verb: &str, arguments: impl std::fmt::Display) {
        self.text.push_str(&format!("{verb}={arguments}\n"));
    }
}

/// The case with this number; the same number is the same case for ever.
pub(crate) fn case(number: usize) -> Case {
    let mut w = Writer {
        random: Random(number as u64 * 7919 + 1),
        key: FixedKey::default(),
        text: String::new(),
    };
    let (mode, views) = write_target(&mut w, number);
    w.say("modelview", floats(&IDENTITY));
    let (projection, modelview) = matrices(&mut w.random);
    w.say("projection", floats(&projection));
    // Positions and planes are transformed by the modelview matrix of the time when they are set.
    let early = w.random.chance(50);
    if !early {
        w.say("modelview", floats(&modelview));
    }
    write_lighting(&mut w);
    write_planes(&mut w);
    w.say("modelview", floats(&modelview));
    write_normals(&mut w);
    write_fog(&mut w);
    write_points(&mut w);
    write_units(&mut w);
    write_colors(&mut w);
    w.key.dialect = Dialect::Mesa;
    let arrays = w.random.below(32) | if w.random.chance(70) { 0b11011 } else { 0 };
    w.say("arrays", arrays);
    if w.random.chance(25) {
        w.say("homogeneous", 1);
    }
    if w.random.chance(15) {
        w.say("enable", "GL_CULL_FACE");
    }
    Case {
        key: w.key,
        text: w.text,
        mode,
        views,
    }
}

fn write_target(w: &mut Writer, number: usize) -> (&'static str, u8) {
    let amplifier = [
        Amplifier::Instanced,
        Amplifier::GeometryLoop,
        Amplifier::GeometryInvocations,
    ][number % 3];
    let tiles = w.random.pick(&[Tiles::ClipLeftRight, Tiles::Layer]);
    let (mode, through_geometry, primitive) = w.random.pick(&MODES);
    let views = if w.random.chance(50) {
        1
    } else {
        w.random.pick(&[2, 3, 5])
    };
    let instanced = amplifier == Amplifier::Instanced;
    w.key.target = Target {
        amplifier,
        tiles,
        clip: Clip::Distances,
        primitive,
        diagonal: Diagonal::OneThree,
        views,
        surface: false,
    };
    w.say("views", views);
    w.say("columns", views);
    w.say("layers", u8::from(tiles == Tiles::Layer));
    w.say("draw", mode);
    w.say(
        "program_draw",
        if instanced { mode } else { through_geometry },
    );
    w.say("instanced", u8::from(instanced));
    let immediate = !instanced && w.random.chance(30);
    w.say("immediate", u8::from(immediate));
    if views > 1 {
        let (sep, conv) = (w.random.float(-0.12, 0.12), w.random.float(2.0, 4.0));
        w.say("sep", sep);
        w.say("conv", conv);
    }
    if tiles != Tiles::ClipLeftRight && w.random.chance(40) {
        let mut span = || {
            (
                w.random.below(50) as i32 - 25,
                w.random.below(70) as i32 + 50,
            )
        };
        let ((x, width), (y, height)) = (span(), span());
        w.say("viewport", format!("{x} {y} {width} {height}"));
    } else {
        w.say("viewport", "0 0 96 96");
    }
    w.key.flat = w.random.chance(30);
    if w.key.flat {
        w.say("shade", "GL_FLAT");
    }
    let first = w.random.chance(25);
    if first {
        w.say("provoking", "GL_FIRST_VERTEX_CONVENTION");
    }
    if primitive == Primitive::Quads && instanced && !first && !w.key.flat {
        // Other clipping decides which diagonal cuts the quad, here and in the reference: see `Diagonal`.
        w.key.flat = true;
        w.say("shade", "GL_FLAT");
    }
    // llvmpipe: quads ignore the convention, so `Provoking::First` would be wrong for them.
    w.key.provoking = Provoking::Last;
    write_diagonal(w, primitive, first);
    (mode, views)
}

/// The diagonal of quads; see [`Diagonal`] for llvmpipe's choice.
fn write_diagonal(w: &mut Writer, primitive: Primitive, first: bool) {
    if primitive == Primitive::QuadStrip {
        w.key.target.diagonal = Diagonal::ZeroTwo;
    } else if primitive == Primitive::Quads
        && !w.key.flat
        && !first
        && w.key.target.amplifier != Amplifier::Instanced
    {
        // The driver's choice is not known, so the reference draws two triangles.
        let (diagonal, cut) = w
            .random
            .pick(&[(Diagonal::OneThree, 13), (Diagonal::ZeroTwo, 2)]);
        w.key.target.diagonal = diagonal;
        w.say("cut", cut);
    }
}

fn write_lighting(w: &mut Writer) {
    if w.random.chance(30) {
        return;
    }
    let mut lighting = Lighting {
        local_viewer: w.random.chance(40),
        two_side: w.random.chance(45),
        separate_specular: w.random.chance(45),
        ..Lighting::default()
    };
    w.say("enable", "GL_LIGHTING");
    w.say(
        "light_model",
        format!(
            "GL_LIGHT_MODEL_LOCAL_VIEWER {}",
            u8::from(lighting.local_viewer)
        ),
    );
    w.say(
        "light_model",
        format!("GL_LIGHT_MODEL_TWO_SIDE {}", u8::from(lighting.two_side)),
    );
    let control = if lighting.separate_specular {
        "GL_SEPARATE_SPECULAR_COLOR"
    } else {
        "GL_SINGLE_COLOR"
    };
    w.say(
        "light_model",
        format!("GL_LIGHT_MODEL_COLOR_CONTROL {control}"),
    );
    let ambient = w.random.color(0.4);
    w.say("light_model", format!("GL_LIGHT_MODEL_AMBIENT {ambient}"));
    for _ in 0..w.random.below(4) {
        let index = w.random.below(LIGHTS);
        lighting.lights[index] = Some(write_light(w, index));
    }
    write_material(w, &mut lighting);
    w.key.lighting = Some(lighting);
}

fn write_light(w: &mut Writer, index: usize) -> Light {
    let light = Light {
        positional: w.random.chance(55),
        spot: w.random.chance(35),
        attenuated: w.random.chance(45),
    };
    w.say("enable", format!("GL_LIGHT{index}"));
    for (name, high) in [
        ("GL_AMBIENT", 0.2),
        ("GL_DIFFUSE", 0.9),
        ("GL_SPECULAR", 0.7),
    ] {
        let color = w.random.color(high);
        w.say("light", format!("{index} {name} {color}"));
    }
    let position = [
        w.random.float(-3.0, 3.0),
        w.random.float(-3.0, 3.0),
        w.random.float(0.5, 3.0),
    ];
    let fourth = if light.positional {
        w.random.pick(&[1.0, 1.0, 0.5, 2.0])
    } else {
        0.0
    };
    w.say(
        "light",
        format!("{index} GL_POSITION {} {fourth}", floats(&position)),
    );
    // The second setting of a light replaces the first.
    let spot = if light.spot {
        w.random.float(25.0, 80.0)
    } else {
        180.0
    };
    w.say("light", format!("{index} GL_SPOT_CUTOFF {spot}"));
    let exponent = if w.random.chance(30) {
        0.0
    } else {
        w.random.float(0.5, 12.0)
    };
    w.say("light", format!("{index} GL_SPOT_EXPONENT {exponent}"));
    let aim = [-position[0], -position[1], -3.0 - position[2]];
    w.say(
        "light",
        format!("{index} GL_SPOT_DIRECTION {}", floats(&aim)),
    );
    let [constant, linear, quadratic] = if light.attenuated {
        [
            w.random.float(0.3, 1.0),
            w.random.float(0.0, 0.2),
            w.random.float(0.0, 0.05),
        ]
    } else {
        [1.0, 0.0, 0.0]
    };
    w.say(
        "light",
        format!("{index} GL_CONSTANT_ATTENUATION {constant}"),
    );
    w.say("light", format!("{index} GL_LINEAR_ATTENUATION {linear}"));
    w.say(
        "light",
        format!("{index} GL_QUADRATIC_ATTENUATION {quadratic}"),
    );
    light
}

fn write_material(w: &mut Writer, lighting: &mut Lighting) {
    let mut any_dull = false;
    for face in ["GL_FRONT", "GL_BACK"] {
        for (name, high) in [
            ("GL_AMBIENT", 0.5),
            ("GL_DIFFUSE", 1.0),
            ("GL_SPECULAR", 1.0),
            ("GL_EMISSION", 0.2),
        ] {
            let color = w.random.color(high);
            w.say("material", format!("{face} {name} {color}"));
        }
        // 0 with a specular colour is refused for Mesa (`Unsupported::DriverQuirk`); 0 with black is GL's initial state.
        let dull = w.random.chance(15);
        any_dull |= dull;
        if dull {
            w.say("material", format!("{face} GL_SPECULAR 0 0 0 1"));
        }
        let shininess = if dull { 0.0 } else { w.random.float(1.0, 60.0) };
        w.say("material", format!("{face} GL_SHININESS {shininess}"));
    }
    if w.random.chance(50) {
        let (face, face_name) = w.random.pick(&[
            (MaterialFace::Front, "GL_FRONT"),
            (MaterialFace::Back, "GL_BACK"),
            (MaterialFace::FrontAndBack, "GL_FRONT_AND_BACK"),
        ]);
        let (mode, mode_name) = w.random.pick(&[
            (MaterialMode::Emission, "GL_EMISSION"),
            (MaterialMode::Ambient, "GL_AMBIENT"),
            (MaterialMode::Diffuse, "GL_DIFFUSE"),
            (MaterialMode::Specular, "GL_SPECULAR"),
            (MaterialMode::AmbientAndDiffuse, "GL_AMBIENT_AND_DIFFUSE"),
        ]);
        // Refused for Mesa as well (`Unsupported::DriverQuirk`).
        let lit = lighting.lights.iter().any(Option::is_some);
        let back_product = face == MaterialFace::Back && mode != MaterialMode::Emission;
        if lighting.two_side && lit && back_product || mode == MaterialMode::Specular && any_dull {
            return;
        }
        lighting.color_material = Some(ColorMaterial { face, mode });
        w.say("color_material", format!("{face_name} {mode_name}"));
        w.say("enable", "GL_COLOR_MATERIAL");
    }
}

fn write_planes(w: &mut Writer) {
    if w.random.chance(65) {
        return;
    }
    for _ in 0..1 + w.random.below(3) {
        let plane = w.random.below(8);
        let [a, b, c] = std::array::from_fn(|_| w.random.float(-1.0, 1.0));
        let d = w.random.float(0.3, 1.5);
        w.say(
            "clip_plane",
            format!("{plane} {} {}", floats(&[a, b, c]), d),
        );
        // The headers of fixed function define names for six planes only.
        const CLIP_PLANE0: usize = 0x3000;
        w.say("enable", (CLIP_PLANE0 + plane).to_string());
        w.key.clip_planes |= 1 << plane;
    }
}

fn write_normals(w: &mut Writer) {
    w.key.normals = w.random.pick(&[
        NormalScaling::None,
        NormalScaling::Rescale,
        NormalScaling::Normalize,
    ]);
    match w.key.normals {
        NormalScaling::None => {}
        NormalScaling::Rescale => w.say("enable", "GL_RESCALE_NORMAL"),
        NormalScaling::Normalize => w.say("enable", "GL_NORMALIZE"),
    }
}

fn write_fog(w: &mut Writer) {
    if w.random.chance(50) {
        return;
    }
    w.say("enable", "GL_FOG");
    let mode = w.random.pick(&["GL_LINEAR", "GL_EXP", "GL_EXP2"]);
    w.say("fog", format!("GL_FOG_MODE {mode}"));
    let (start, end) = (w.random.float(0.0, 2.0), w.random.float(4.0, 8.0));
    w.say("fog", format!("GL_FOG_START {start}"));
    w.say("fog", format!("GL_FOG_END {end}"));
    let density = w.random.float(0.05, 0.4);
    w.say("fog", format!("GL_FOG_DENSITY {density}"));
    let color = w.random.color(1.0);
    w.say("fog", format!("GL_FOG_COLOR {color}"));
    let (source, name, distance) = w.random.pick(&[
        (
            FogSource::Coordinate,
            "GL_FOG_COORD",
            "GL_EYE_PLANE_ABSOLUTE_NV",
        ),
        (
            FogSource::DepthMagnitude,
            "GL_FRAGMENT_DEPTH",
            "GL_EYE_PLANE_ABSOLUTE_NV",
        ),
        (FogSource::Depth, "GL_FRAGMENT_DEPTH", "GL_EYE_PLANE"),
        (FogSource::Radial, "GL_FRAGMENT_DEPTH", "GL_EYE_RADIAL_NV"),
    ]);
    w.key.fog = source;
    w.say("fog", format!("GL_FOG_COORD_SRC {name}"));
    w.say("fog", format!("GL_FOG_DISTANCE_MODE_NV {distance}"));
}

fn write_points(w: &mut Writer) {
    if w.key.target.primitive != Primitive::Points {
        return;
    }
    w.key.point = PointSize::Constant;
    if w.key.target.tiles != Tiles::Layer {
        // Larger points leak out of clipped tiles: `Unsupported::WidePoints`.
        return;
    }
    let size = w.random.float(1.0, 12.0);
    w.say("point_size", size);
    if w.random.chance(60) {
        w.key.point = PointSize::Attenuated;
        let [a, b, c] = [
            w.random.float(0.1, 1.0),
            w.random.float(0.0, 0.5),
            w.random.float(0.0, 0.2),
        ];
        w.say(
            "point",
            format!("GL_POINT_DISTANCE_ATTENUATION {}", floats(&[a, b, c])),
        );
    }
    if w.random.chance(40) {
        let (low, high) = (w.random.float(1.0, 4.0), w.random.float(4.0, 8.0));
        w.say("point", format!("GL_POINT_SIZE_MIN {low}"));
        w.say("point", format!("GL_POINT_SIZE_MAX {high}"));
    }
    if w.random.chance(40) {
        w.say("enable", "GL_POINT_SPRITE");
        for unit in 0..2 {
            w.say("coord_replace", unit);
        }
    }
}

fn write_units(w: &mut Writer) {
    if w.random.chance(35) {
        return;
    }
    for _ in 0..1 + w.random.below(3) {
        let unit = w.random.below(UNITS);
        if w.key.units[unit].enabled {
            continue;
        }
        w.key.units[unit].enabled = true;
        let target = w
            .random
            .pick(&["GL_TEXTURE_2D", "GL_TEXTURE_3D", "GL_TEXTURE_CUBE_MAP"]);
        w.say("texture", format!("{unit} {target}"));
        if w.random.chance(60) {
            let modes: &[TexGen] = &[
                TexGen::ObjectLinear,
                TexGen::EyeLinear,
                TexGen::SphereMap,
                TexGen::ReflectionMap,
                TexGen::NormalMap,
            ];
            let all = w.random.pick(modes);
            for part in 0..4 {
                write_generation(w, unit, part, all);
            }
        }
        if w.random.chance(45) {
            w.key.units[unit].matrix = true;
            let mut m: Matrix = std::array::from_fn(|_| w.random.float(-0.3, 0.3));
            for part in 0..4 {
                m[5 * part] += 1.0;
                // Keeps away from q = 0, where coordinates diverge.
                m[4 * part + 3] *= 0.1;
            }
            w.say("texture_matrix", format!("{unit} {}", floats(&m)));
        }
    }
}

fn write_generation(w: &mut Writer, unit: usize, part: usize, wish: TexGen) {
    let mode = match wish {
        TexGen::SphereMap if part >= 2 => return,
        TexGen::ReflectionMap | TexGen::NormalMap if part == 3 => return,
        _ if w.random.chance(15) => return,
        _ if w.random.chance(15) => w.random.pick(&[TexGen::ObjectLinear, TexGen::EyeLinear]),
        mode => mode,
    };
    w.key.units[unit].generation[part] = Some(mode);
    let coordinate = ["GL_S", "GL_T", "GL_R", "GL_Q"][part];
    let name = match mode {
        TexGen::ObjectLinear => "GL_OBJECT_LINEAR",
        TexGen::EyeLinear => "GL_EYE_LINEAR",
        TexGen::SphereMap => "GL_SPHERE_MAP",
        TexGen::ReflectionMap => "GL_REFLECTION_MAP",
        TexGen::NormalMap => "GL_NORMAL_MAP",
    };
    w.say("texgen", format!("{unit} {coordinate} {name}"));
    let plane = match mode {
        TexGen::ObjectLinear => "GL_OBJECT_PLANE",
        TexGen::EyeLinear => "GL_EYE_PLANE",
        TexGen::SphereMap | TexGen::ReflectionMap | TexGen::NormalMap => return,
    };
    let reach = if part == 3 { 0.03 } else { 0.6 };
    let mut values: [f64; 4] = std::array::from_fn(|_| w.random.float(-reach, reach));
    if part == 3 {
        values[3] += 1.2;
    }
    w.say(
        "texgen_plane",
        format!("{unit} {coordinate} {plane} {}", floats(&values)),
    );
}

fn write_colors(w: &mut Writer) {
    w.key.color_sum = w.key.lighting.is_none() && w.random.chance(40);
    if w.key.color_sum {
        w.say("enable", "GL_COLOR_SUM");
    }
    w.key.clamp_colors = w.random.chance(85);
    w.say(
        "clamp_colors",
        if w.key.clamp_colors {
            "GL_TRUE"
        } else {
            "GL_FALSE"
        },
    );
}
