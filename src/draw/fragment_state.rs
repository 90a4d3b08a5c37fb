//! Reads the driver's fixed-function fragment stage into the key of a generated one.
//!
//! It is read only where a draw needs a generated stage, and only for the enabled units. It is not kept from draw to draw,
//! because the layer does not track the commands that change a texture's images and filters.

use super::fixed_state::Driver;
use crate::fixed::{
    Argument, BaseFormat, Combine, Combiner, Dialect, Environment, FixedKey, FogMode, FogSource,
    FragmentKey, FragmentUnit, Function, Operand, Source, TextureTarget, UNITS, Unsupported,
};
use crate::gl::{Gl, consts as c};

/// Reads the fragment stage for the units and the fog of a vertex stage. Leaves all state as it is. The caller adds the grid, which is not
/// state of the driver.
///
/// # Errors
/// The state has something that a generated stage cannot do.
pub(super) fn read(gl: &Gl, driver: Driver, vertex: &FixedKey) -> Result<FragmentKey, Unsupported> {
    let mut units = [None; UNITS];
    if vertex.units.iter().any(|unit| unit.enabled) {
        let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
        let read = (0u32..).zip(&mut units).zip(&vertex.units);
        let read: Result<(), Unsupported> =
            read.filter(|(_, state)| state.enabled)
                .try_for_each(|((index, unit), _)| {
                    gl.active_texture(c::TEXTURE0 + index);
                    *unit = read_unit(gl, driver)?;
                    Ok(())
                });
        gl.active_texture(active);
        read?;
    }
    let key = FragmentKey {
        units,
        fog: match vertex.fog {
            FogSource::None => FogMode::None,
            _ => match gl.get_integer(c::FOG_MODE) as u32 {
                c::LINEAR => FogMode::Linear,
                c::EXP2 => FogMode::Exp2,
                _ => FogMode::Exp,
            },
        },
        dialect: if driver.mesa {
            Dialect::Mesa
        } else {
            Dialect::Specification
        },
        ..FragmentKey::default()
    };
    Ok(key.after(vertex))
}

/// The state of the active unit; `None` where its texture is incomplete.
fn read_unit(gl: &Gl, driver: Driver) -> Result<Option<FragmentUnit>, Unsupported> {
    if gl.version() >= (3, 3) && gl.get_integer(c::SAMPLER_BINDING) != 0 {
        return Err(Unsupported::SamplerObject);
    }
    for target in TextureTarget::ALL {
        let name = target_name(target);
        if !gl.is_enabled(name) {
            continue;
        }
        let min = gl.get_tex_parameter(name, c::TEXTURE_MIN_FILTER) as u32;
        let mipmaps = !matches!(min, c::NEAREST | c::LINEAR);
        if complete(gl, target, mipmaps) {
            let mag = gl.get_tex_parameter(name, c::TEXTURE_MAG_FILTER) as u32;
            let format = base_format(gl, target)?;
            return Ok(Some(FragmentUnit {
                target,
                format,
                detail: mipmaps || min != mag,
                environment: environment(gl)?,
            }));
        }
        // Mesa tries the next target (`update_ff_texture_state`); by the specification the unit is off.
        if !driver.mesa {
            break;
        }
    }
    Ok(None)
}

fn target_name(target: TextureTarget) -> u32 {
    match target {
        TextureTarget::Cube => c::TEXTURE_CUBE_MAP,
        TextureTarget::ThreeD => c::TEXTURE_3D,
        TextureTarget::Rectangle => c::TEXTURE_RECTANGLE,
        TextureTarget::TwoD => c::TEXTURE_2D,
        TextureTarget::OneD => c::TEXTURE_1D,
    }
}

/// The targets that have images: the faces of a cube map, else the target itself.
fn images(target: TextureTarget) -> std::ops::Range<u32> {
    match target {
        TextureTarget::Cube => c::TEXTURE_CUBE_MAP_POSITIVE_X..c::TEXTURE_CUBE_MAP_POSITIVE_X + 6,
        _ => target_name(target)..target_name(target) + 1,
    }
}

/// Texture completeness (OpenGL 4.6 compatibility, section 8.17), for which there is no query.
fn complete(gl: &Gl, target: TextureTarget, mipmaps: bool) -> bool {
    let name = target_name(target);
    let base = gl.get_tex_parameter(name, c::TEXTURE_BASE_LEVEL);
    let image = |image, level| {
        let ask = |what| gl.get_tex_level_parameter(image, level, what);
        let size = [
            ask(c::TEXTURE_WIDTH),
            ask(c::TEXTURE_HEIGHT),
            ask(c::TEXTURE_DEPTH),
        ];
        (size, ask(c::TEXTURE_INTERNAL_FORMAT))
    };
    let first @ (size, format) = image(images(target).start, base);
    let cubic = target != TextureTarget::Cube || size[0] == size[1];
    if size.contains(&0) || !cubic || !images(target).all(|face| image(face, base) == first) {
        return false;
    }
    if !mipmaps {
        return true;
    }
    let last = gl.get_tex_parameter(name, c::TEXTURE_MAX_LEVEL);
    let steps = size.into_iter().max().unwrap_or(1).ilog2() as i32;
    (base..=last.min(base.saturating_add(steps)))
        .skip(1)
        .all(|level| {
            let smaller = (size.map(|side| (side >> (level - base)).max(1)), format);
            images(target).all(|face| image(face, level) == smaller)
        })
        && base <= last
}

/// The base internal format, from the components that the texture has, so that formats of any size and extension are known.
fn base_format(gl: &Gl, target: TextureTarget) -> Result<BaseFormat, Unsupported> {
    let base = gl.get_tex_parameter(target_name(target), c::TEXTURE_BASE_LEVEL);
    let ask = |what| gl.get_tex_level_parameter(images(target).start, base, what);
    let has = |what| ask(what) != 0;
    if has(c::TEXTURE_RED_SIZE) {
        let integer = gl.version() >= (3, 0)
            && matches!(ask(c::TEXTURE_RED_TYPE) as u32, c::INT | c::UNSIGNED_INT);
        return match has(c::TEXTURE_ALPHA_SIZE) {
            _ if integer => Err(Unsupported::TextureFormat),
            true => Ok(BaseFormat::Rgba),
            false => Ok(BaseFormat::Rgb),
        };
    }
    if has(c::TEXTURE_INTENSITY_SIZE) {
        return Ok(BaseFormat::Intensity);
    }
    match (has(c::TEXTURE_LUMINANCE_SIZE), has(c::TEXTURE_ALPHA_SIZE)) {
        (true, true) => Ok(BaseFormat::LuminanceAlpha),
        (true, false) => Ok(BaseFormat::Luminance),
        (false, true) => Ok(BaseFormat::Alpha),
        (false, false) => Err(Unsupported::TextureFormat),
    }
}

fn environment(gl: &Gl) -> Result<Environment, Unsupported> {
    Ok(match gl.get_tex_env(c::TEXTURE_ENV_MODE) as u32 {
        c::MODULATE => Environment::Modulate,
        c::REPLACE => Environment::Replace,
        c::DECAL => Environment::Decal,
        c::BLEND => Environment::Blend,
        c::ADD => Environment::Add,
        c::COMBINE => Environment::Combine(Combine {
            rgb: combiner(
                gl,
                c::COMBINE_RGB,
                c::SRC0_RGB,
                c::OPERAND0_RGB,
                c::RGB_SCALE,
            )?,
            alpha: combiner(
                gl,
                c::COMBINE_ALPHA,
                c::SRC0_ALPHA,
                c::OPERAND0_ALPHA,
                c::ALPHA_SCALE,
            )?,
        }),
        _ => return Err(Unsupported::TextureEnvironment),
    })
}

fn combiner(
    gl: &Gl,
    function: u32,
    source: u32,
    operand: u32,
    scale: u32,
) -> Result<Combiner, Unsupported> {
    let function = match gl.get_tex_env(function) as u32 {
        c::REPLACE => Function::Replace,
        c::MODULATE => Function::Modulate,
        c::ADD => Function::Add,
        c::ADD_SIGNED => Function::AddSigned,
        c::INTERPOLATE => Function::Interpolate,
        c::SUBTRACT => Function::Subtract,
        c::DOT3_RGB => Function::Dot3Rgb,
        c::DOT3_RGBA => Function::Dot3Rgba,
        _ => return Err(Unsupported::TextureEnvironment),
    };
    let mut arguments = [Argument::default(); 3];
    for (index, argument) in (0u32..).zip(arguments.iter_mut().take(function.arguments())) {
        *argument = Argument {
            source: match gl.get_tex_env(source + index) as u32 {
                c::TEXTURE => Source::Texture,
                c::CONSTANT => Source::Constant,
                c::PRIMARY_COLOR => Source::Primary,
                c::PREVIOUS => Source::Previous,
                unit if (c::TEXTURE0..c::TEXTURE0 + UNITS as u32).contains(&unit) => {
                    Source::Unit((unit - c::TEXTURE0) as u8)
                }
                _ => return Err(Unsupported::TextureEnvironment),
            },
            operand: match gl.get_tex_env(operand + index) as u32 {
                c::SRC_COLOR => Operand::Color,
                c::ONE_MINUS_SRC_COLOR => Operand::OneMinusColor,
                c::SRC_ALPHA => Operand::Alpha,
                _ => Operand::OneMinusAlpha,
            },
        };
    }
    Ok(Combiner {
        function,
        arguments,
        scale: match gl.get_tex_env(scale) {
            4 => 2,
            2 => 1,
            _ => 0,
        },
    })
}
