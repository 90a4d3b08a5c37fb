//! Texture environments (OpenGL 4.6 compatibility, section 16.2, tables 16.1 to 16.4).
//!
//! With C and A the colour and alpha of the result, p the incoming colour, s the texel and c the environment colour:
//! ```text
//! REPLACE    C = Cs                 A = As
//! MODULATE   C = Cp·Cs              A = Ap·As
//! DECAL      C = Cp·(1−As) + Cs·As  A = Ap
//! BLEND      C = Cp·(1−Cs) + Cc·Cs  A = Ap·As     INTENSITY: A = Ap·(1−As) + Ac·As
//! ADD        C = Cp + Cs            A = Ap·As     INTENSITY: A = Ap + As
//! ```
//! A texture without colour leaves C = Cp, one without alpha A = Ap. Results are clamped to [0, 1].

use super::fragment_key::{
    Argument, BaseFormat, Combine, Combiner, Environment, FragmentKey, FragmentUnit, Function,
    Operand, Source,
};
use super::reason::Unsupported;
use super::text::Text;

/// Applies the environment of one unit to `color`. Expects the texels that [`FragmentKey::sampled`] names.
pub(super) fn write(
    text: &mut Text,
    key: &FragmentKey,
    unit: usize,
    state: &FragmentUnit,
) -> Result<(), Unsupported> {
    if let Environment::Combine(combine) = &state.environment {
        // The specification defines no colour for an absent texture, and Mesa's is not always the same.
        let there = |source| match source {
            Source::Unit(other) => key
                .units
                .get(usize::from(other))
                .is_some_and(Option::is_some),
            Source::Texture | Source::Constant | Source::Primary | Source::Previous => true,
        };
        if !combine.sources().all(there) {
            return Err(Unsupported::TextureEnvironment);
        }
        write_combine(text, unit, combine);
        return Ok(());
    }
    let texel = format!("texel{unit}");
    let constant = format!("gl_TextureEnvColor[{unit}]");
    let (has_color, has_alpha) = match state.format {
        BaseFormat::Alpha => (false, true),
        BaseFormat::Luminance | BaseFormat::Rgb => (true, false),
        BaseFormat::LuminanceAlpha | BaseFormat::Intensity | BaseFormat::Rgba => (true, true),
    };
    let intensity = state.format == BaseFormat::Intensity;
    let color = match state.environment {
        _ if !has_color => "color.rgb".into(),
        Environment::Replace => format!("{texel}.rgb"),
        Environment::Modulate => format!("color.rgb * {texel}.rgb"),
        Environment::Add => format!("color.rgb + {texel}.rgb"),
        Environment::Blend => format!("mix(color.rgb, {constant}.rgb, {texel}.rgb)"),
        Environment::Decal => match state.format {
            BaseFormat::Rgb => format!("{texel}.rgb"),
            _ => format!("mix(color.rgb, {texel}.rgb, {texel}.a)"),
        },
        Environment::Combine(_) => return Ok(()),
    };
    let alpha = match state.environment {
        Environment::Decal if !matches!(state.format, BaseFormat::Rgb | BaseFormat::Rgba) => {
            return Err(Unsupported::TextureEnvironment);
        }
        Environment::Decal => "color.a".into(),
        _ if !has_alpha => "color.a".into(),
        Environment::Replace => format!("{texel}.a"),
        Environment::Add if intensity => format!("color.a + {texel}.a"),
        Environment::Blend if intensity => format!("mix(color.a, {constant}.a, {texel}.a)"),
        _ => format!("color.a * {texel}.a"),
    };
    text.line(format!("color = clamp(vec4({color}, {alpha}), 0.0, 1.0);"));
    Ok(())
}

fn write_combine(text: &mut Text, unit: usize, combine: &Combine) {
    let rgb = function(unit, &combine.rgb, "rgb");
    let scales = [combine.rgb.scale, combine.alpha.scale].map(|scale| 1u32 << scale);
    let value = if combine.rgb.function == Function::Dot3Rgba {
        format!("vec4({rgb})")
    } else {
        let alpha = function(unit, &combine.alpha, "a");
        let rgb = match combine.rgb.function {
            Function::Dot3Rgb => format!("vec3({rgb})"),
            _ => rgb,
        };
        format!("vec4({rgb}, {alpha})")
    };
    let scale = match scales {
        [1, 1] => String::new(),
        [rgb, alpha] if rgb == alpha => format!(" * {rgb}.0"),
        [rgb, alpha] => format!(" * vec4(vec3({rgb}.0), {alpha}.0)"),
    };
    text.line(format!("color = clamp({value}{scale}, 0.0, 1.0);"));
}

/// The function of one half of a combination: a `vec3` for the swizzle `rgb` (a float for dot products), a float for `a`.
fn function(unit: usize, combiner: &Combiner, swizzle: &str) -> String {
    let [a, b, c] = combiner
        .arguments
        .map(|argument| value(unit, argument, swizzle));
    match combiner.function {
        Function::Replace => a,
        Function::Modulate => format!("{a} * {b}"),
        Function::Add => format!("{a} + {b}"),
        Function::AddSigned => format!("{a} + {b} - 0.5"),
        Function::Interpolate => format!("mix({b}, {a}, {c})"),
        Function::Subtract => format!("{a} - {b}"),
        Function::Dot3Rgb | Function::Dot3Rgba => {
            format!("dot(2.0 * {a} - 1.0, 2.0 * {b} - 1.0)")
        }
    }
}

fn value(unit: usize, argument: Argument, swizzle: &str) -> String {
    let source = match argument.source {
        Source::Texture => format!("texel{unit}"),
        Source::Unit(other) => format!("texel{other}"),
        Source::Constant => format!("gl_TextureEnvColor[{unit}]"),
        Source::Primary => "gl_Color".into(),
        Source::Previous => "color".into(),
    };
    let alpha = if swizzle == "rgb" {
        format!("{source}.aaa")
    } else {
        format!("{source}.a")
    };
    match argument.operand {
        Operand::Color => format!("{source}.{swizzle}"),
        Operand::OneMinusColor => format!("(1.0 - {source}.{swizzle})"),
        Operand::Alpha => alpha,
        Operand::OneMinusAlpha => format!("(1.0 - {alpha})"),
    }
}
