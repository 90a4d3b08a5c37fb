//! Random state of the fragment stage: as keys for the generators, and as text for `ffcheck`.

use super::matrices::{IDENTITY, matrices};
use super::random::{Random, floats};
use manyview::fixed::{
    Amplifier, Argument, BaseFormat, Clip, Combine, Combiner, Dialect, Environment, FixedKey,
    FogMode, FogSource, FragmentKey, FragmentUnit, Function, Operand, PointSize, Primitive, Source,
    Target, TextureTarget, Tiles,
};

/// Texture units that cases use.
const USED: usize = 4;

/// One draw with its state.
pub(crate) struct Fragments {
    /// Input of the generator of the vertex stage.
    pub(crate) vertex: FixedKey,
    /// Input of the generator of the fragment stage.
    pub(crate) key: FragmentKey,
    /// `ffcheck`'s input, except for the patches.
    pub(crate) text: String,
}

struct Writer {
    random: Random,
    text: String,
}

impl Writer {
    fn say(&mut self, verb: &str, arguments: impl std::fmt::Display) {
        self.text.push_str(&format!("{verb}={arguments}\n"));
    }
}

/// The case with this number; the same number is the same case for ever.
pub(crate) fn case(number: usize) -> Fragments {
    let mut w = Writer {
        random: Random(number as u64 * 6007 + 3),
        text: String::new(),
    };
    let mut vertex = FixedKey {
        target: Target {
            tiles: Tiles::Layer,
            ..Target::default()
        },
        clamp_colors: true,
        dialect: Dialect::Mesa,
        ..FixedKey::default()
    };
    let mut key = FragmentKey {
        dialect: Dialect::Mesa,
        ..FragmentKey::default()
    };
    let (projection, modelview) = matrices(&mut w.random);
    w.say("projection", floats(&projection));
    w.say("modelview", floats(&modelview));
    w.say("views", 1);
    w.say("columns", 1);
    w.say("layers", 1);
    w.say("instanced", 1);
    w.say("viewport", "0 0 96 96");
    w.say("arrays", 31);
    let mode = match w.random.below(10) {
        0 => {
            write_sprites(&mut w, &mut vertex);
            "GL_POINTS"
        }
        1 => "GL_LINES",
        _ => "GL_TRIANGLES",
    };
    w.say("draw", mode);
    w.say("program_draw", mode);
    if w.random.chance(30) {
        vertex.flat = true;
        w.say("shade", "GL_FLAT");
    }
    if w.random.chance(40) {
        vertex.color_sum = true;
        w.say("enable", "GL_COLOR_SUM");
    }
    write_fog(&mut w, &mut vertex, &mut key);
    let count = w.random.pick(&[0, 1, 1, 1, 2, 2, 3, 4]);
    for _ in 0..count {
        let unit = w.random.below(USED);
        vertex.units[unit].enabled = true;
    }
    for unit in 0..USED {
        if vertex.units[unit].enabled {
            key.units[unit] = write_unit(&mut w, unit);
        }
    }
    Fragments {
        key: key.after(&vertex),
        vertex,
        text: w.text,
    }
}

/// Three views side by side that only the fragment stage keeps apart, by instances or a geometry shader.
pub(crate) fn discarding(number: usize) -> Fragments {
    let mut w = Writer {
        random: Random(number as u64 * 3001 + 7),
        text: String::new(),
    };
    let (amplifier, clip) = [
        (Amplifier::Instanced, Clip::Discard),
        (Amplifier::GeometryLoop, Clip::Discard),
        (Amplifier::GeometryLoop, Clip::Both),
        (Amplifier::GeometryInvocations, Clip::Both),
    ][number % 4];
    let vertex = FixedKey {
        target: Target {
            amplifier,
            clip,
            views: 3,
            ..Target::default()
        },
        clamp_colors: true,
        dialect: Dialect::Mesa,
        ..FixedKey::default()
    };
    let (projection, modelview) = matrices(&mut w.random);
    w.say("projection", floats(&projection));
    w.say("modelview", floats(&modelview));
    w.say("views", 3);
    w.say("columns", 3);
    let (sep, conv) = (w.random.float(0.1, 0.4), w.random.float(2.0, 4.0));
    w.say("sep", sep);
    w.say("conv", conv);
    w.say("instanced", u8::from(amplifier == Amplifier::Instanced));
    w.say("viewport", "0 0 96 96");
    w.say("arrays", 31);
    w.say("draw", "GL_TRIANGLES");
    w.say("program_draw", "GL_TRIANGLES");
    Fragments {
        key: FragmentKey::default().after(&vertex),
        vertex,
        text: w.text,
    }
}

/// A receding floor under a texture with all its levels; the tile has every `spacing`th column of the window.
pub(crate) fn floor(number: usize, spacing: u32, filter: &str) -> Fragments {
    let mut w = Writer {
        random: Random(number as u64 * 911 + 5),
        text: String::new(),
    };
    let mut vertex = FixedKey {
        clamp_colors: true,
        dialect: Dialect::Mesa,
        ..FixedKey::default()
    };
    vertex.units[0].enabled = true;
    let mut key = FragmentKey {
        grid: true,
        ..FragmentKey::default()
    };
    key.units[0] = Some(FragmentUnit {
        target: TextureTarget::TwoD,
        format: BaseFormat::Rgb,
        detail: true,
        environment: Environment::Replace,
    });
    let mut projection = IDENTITY;
    // The window's pixels are square, so the picture is a wide strip of it.
    let tall = 0.9 * f64::from(spacing);
    (projection[0], projection[5], projection[10]) = (0.9, tall, -1.05);
    (projection[11], projection[14], projection[15]) = (-1.0, -2.05, 0.0);
    // Looks down onto the floor with a small roll, so that the level of detail varies along each row.
    let (down, bank) = (w.random.float(0.25, 0.6), w.random.float(-0.2, 0.2));
    let modelview = super::matrices::multiply(
        &super::matrices::turn(2, bank),
        &super::matrices::turn(0, down),
    );
    w.say("projection", floats(&projection));
    w.say("modelview", floats(&modelview));
    w.say("views", 1);
    w.say("columns", 1);
    w.say("instanced", 1);
    w.say("viewport", "0 0 96 96");
    w.say("floor", 40);
    w.say("draw", "GL_TRIANGLES");
    w.say("program_draw", "GL_TRIANGLES");
    w.say("arrays", 31);
    let offset = w.random.below(spacing as usize);
    w.say("spacing", format!("{spacing} {offset}"));
    w.say("image", format!("0 GL_TEXTURE_2D GL_RGB 256 {filter} 9 0"));
    w.say("env", "0 GL_TEXTURE_ENV_MODE GL_REPLACE");
    Fragments {
        key: key.after(&vertex),
        vertex,
        text: w.text,
    }
}

fn write_sprites(w: &mut Writer, vertex: &mut FixedKey) {
    vertex.target.primitive = Primitive::Points;
    vertex.point = PointSize::Constant;
    let size = w.random.float(1.0, 12.0);
    w.say("point_size", size);
    w.say("enable", "GL_POINT_SPRITE");
    for unit in 0..2 {
        w.say("coord_replace", unit);
    }
}

fn write_fog(w: &mut Writer, vertex: &mut FixedKey, key: &mut FragmentKey) {
    if w.random.chance(50) {
        return;
    }
    let (mode, name) = w.random.pick(&[
        (FogMode::Linear, "GL_LINEAR"),
        (FogMode::Exp, "GL_EXP"),
        (FogMode::Exp2, "GL_EXP2"),
    ]);
    key.fog = mode;
    vertex.fog = FogSource::DepthMagnitude;
    w.say("enable", "GL_FOG");
    w.say("fog", "GL_FOG_COORD_SRC GL_FRAGMENT_DEPTH");
    w.say("fog", format!("GL_FOG_MODE {name}"));
    let (start, end) = (w.random.float(0.0, 2.0), w.random.float(4.0, 8.0));
    w.say("fog", format!("GL_FOG_START {start}"));
    w.say("fog", format!("GL_FOG_END {end}"));
    let density = w.random.float(0.05, 0.4);
    w.say("fog", format!("GL_FOG_DENSITY {density}"));
    let color = w.random.color(1.0);
    w.say("fog", format!("GL_FOG_COLOR {color}"));
}

const FORMATS: [(BaseFormat, &str); 8] = [
    (BaseFormat::Alpha, "GL_ALPHA"),
    (BaseFormat::Luminance, "GL_LUMINANCE"),
    (BaseFormat::LuminanceAlpha, "GL_LUMINANCE_ALPHA"),
    (BaseFormat::Intensity, "GL_INTENSITY"),
    (BaseFormat::Rgb, "GL_RGB"),
    (BaseFormat::Rgba, "GL_RGBA"),
    (BaseFormat::Rgb, "GL_RED"),
    (BaseFormat::Rgb, "GL_RG"),
];

/// One unit; `None` where its texture is incomplete.
fn write_unit(w: &mut Writer, unit: usize) -> Option<FragmentUnit> {
    let (target, name) = w.random.pick(&[
        (TextureTarget::TwoD, "GL_TEXTURE_2D"),
        (TextureTarget::TwoD, "GL_TEXTURE_2D"),
        (TextureTarget::OneD, "GL_TEXTURE_1D"),
        (TextureTarget::ThreeD, "GL_TEXTURE_3D"),
        (TextureTarget::Cube, "GL_TEXTURE_CUBE_MAP"),
        (TextureTarget::Rectangle, "GL_TEXTURE_RECTANGLE"),
    ]);
    let (format, internal) = w.random.pick(&FORMATS);
    let (size, filter) = match target {
        // Coordinates of the mesh are about 1, so a texel of a rectangle covers as much as a few pixels.
        TextureTarget::Rectangle => (4, "GL_LINEAR"),
        TextureTarget::ThreeD => (32, "GL_LINEAR_MIPMAP_LINEAR"),
        _ => (
            w.random.pick(&[32, 64, 256]),
            w.random.pick(&[
                "GL_LINEAR",
                "GL_LINEAR_MIPMAP_NEAREST",
                "GL_LINEAR_MIPMAP_LINEAR",
                "GL_LINEAR_MIPMAP_LINEAR",
            ]),
        ),
    };
    let mipmaps = filter.contains("MIPMAP");
    let incomplete = mipmaps && w.random.chance(8);
    let levels = if incomplete { 2 } else { 9 };
    let bias = if w.random.chance(30) {
        w.random.float(-1.5, 1.5)
    } else {
        0.0
    };
    w.say(
        "image",
        format!("{unit} {name} {internal} {size} {filter} {levels} {bias}"),
    );
    if w.random.chance(30) {
        let bias = w.random.float(-1.5, 1.5);
        w.say("bias", format!("{unit} {bias}"));
    }
    let color = w.random.color(1.0);
    w.say("env", format!("{unit} GL_TEXTURE_ENV_COLOR {color}"));
    let environment = write_environment(w, unit, format);
    (!incomplete).then_some(FragmentUnit {
        target,
        format,
        detail: mipmaps,
        environment,
    })
}

fn write_environment(w: &mut Writer, unit: usize, format: BaseFormat) -> Environment {
    let modes = [
        (Environment::Modulate, "GL_MODULATE"),
        (Environment::Replace, "GL_REPLACE"),
        (Environment::Blend, "GL_BLEND"),
        (Environment::Add, "GL_ADD"),
        (Environment::Decal, "GL_DECAL"),
    ];
    if w.random.chance(50) {
        let combine = Combine {
            rgb: write_combiner(w, unit, "RGB"),
            alpha: write_combiner(w, unit, "ALPHA"),
        };
        w.say("env", format!("{unit} GL_TEXTURE_ENV_MODE GL_COMBINE"));
        return Environment::Combine(combine);
    }
    // A decal of any other format is undefined.
    let defined = matches!(format, BaseFormat::Rgb | BaseFormat::Rgba);
    let (mode, name) = w.random.pick(&modes[..if defined { 5 } else { 4 }]);
    w.say("env", format!("{unit} GL_TEXTURE_ENV_MODE {name}"));
    mode
}

fn write_combiner(w: &mut Writer, unit: usize, part: &str) -> Combiner {
    let functions = [
        (Function::Replace, "GL_REPLACE"),
        (Function::Modulate, "GL_MODULATE"),
        (Function::Add, "GL_ADD"),
        (Function::AddSigned, "GL_ADD_SIGNED"),
        (Function::Interpolate, "GL_INTERPOLATE"),
        (Function::Subtract, "GL_SUBTRACT"),
        (Function::Dot3Rgb, "GL_DOT3_RGB"),
        (Function::Dot3Rgba, "GL_DOT3_RGBA"),
    ];
    let rgb = part == "RGB";
    let (function, name) = w.random.pick(&functions[..if rgb { 8 } else { 6 }]);
    w.say("env", format!("{unit} GL_COMBINE_{part} {name}"));
    let scale = w.random.pick(&[0, 0, 1, 2]);
    w.say("env", format!("{unit} GL_{part}_SCALE {}", 1 << scale));
    let mut arguments = [Argument::default(); 3];
    for (index, argument) in arguments.iter_mut().enumerate() {
        let (source, name) = w.random.pick(&[
            (Source::Texture, "GL_TEXTURE"),
            (Source::Texture, "GL_TEXTURE"),
            (Source::Constant, "GL_CONSTANT"),
            (Source::Primary, "GL_PRIMARY_COLOR"),
            (Source::Previous, "GL_PREVIOUS"),
            (Source::Previous, "GL_PREVIOUS"),
            (Source::Unit(0), "GL_TEXTURE0"),
            (Source::Unit(1), "GL_TEXTURE1"),
            (Source::Unit(2), "GL_TEXTURE2"),
        ]);
        w.say("env", format!("{unit} GL_SRC{index}_{part} {name}"));
        let operands = [
            (Operand::Alpha, "GL_SRC_ALPHA"),
            (Operand::OneMinusAlpha, "GL_ONE_MINUS_SRC_ALPHA"),
            (Operand::Color, "GL_SRC_COLOR"),
            (Operand::OneMinusColor, "GL_ONE_MINUS_SRC_COLOR"),
        ];
        let (operand, name) = w.random.pick(&operands[..if rgb { 4 } else { 2 }]);
        w.say("env", format!("{unit} GL_OPERAND{index}_{part} {name}"));
        *argument = Argument { source, operand };
    }
    Combiner {
        function,
        arguments,
        scale,
    }
}
