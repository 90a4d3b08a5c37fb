//! The state to which a generated fragment shader is specialised.
//!
//! As in [`FixedKey`](super::FixedKey), the key names the computations and not their values: fog parameters and
//! environment colours reach the shader through built-in uniforms, texture images through samplers.

use super::key::{Amplifier, Dialect, FixedKey, FogSource, Tiles, UNITS};

/// Everything that decides the source of a generated fragment shader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct FragmentKey {
    /// Texture units; `None`: no target is enabled, or the texture is incomplete.
    pub units: [Option<FragmentUnit>; UNITS],
    /// `GL_FOG`.
    pub fog: FogMode,
    /// The secondary colour is added after the textures (section 16.3).
    pub color_sum: bool,
    /// Pixels of the tile are further apart than the window's: textures are sampled with the gradients of the window's grid,
    /// by [`UNIFORM_GRID`](super::UNIFORM_GRID).
    pub grid: bool,
    /// Fragments outside the limits of their view are discarded: [`Clip`](super::Clip) of the vertex stage.
    pub discard: bool,
    /// A second output is the displacement of the sample: [`Tiles::DistortedRays`](super::Tiles::DistortedRays) of the vertex stage.
    pub displaced: bool,
    /// Pixels ask what their view sees of a point: [`Amplifier::Points`](super::Amplifier::Points) of the stages before.
    pub points: bool,
    /// Points are disks (see [`surface_disk`](super::surface_disk)).
    pub disks: bool,
    /// How the driver reads the specification where drivers differ.
    pub dialect: Dialect,
}

/// One texture unit with a complete texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FragmentUnit {
    /// The enabled target; of several the first in the order of [`TextureTarget`].
    pub target: TextureTarget,
    /// Base internal format of the texture (tables 8.10 and 8.11).
    pub format: BaseFormat,
    /// `GL_TEXTURE_MIN_FILTER` uses mipmaps or differs from `GL_TEXTURE_MAG_FILTER`: the level of detail decides.
    pub detail: bool,
    /// How the texel is combined with the incoming colour.
    pub environment: Environment,
}

/// Targets that the fixed fragment stage samples, the one that wins first (section 16.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TextureTarget {
    /// `GL_TEXTURE_CUBE_MAP`
    Cube,
    /// `GL_TEXTURE_3D`
    ThreeD,
    /// `GL_TEXTURE_RECTANGLE`
    Rectangle,
    /// `GL_TEXTURE_2D`
    TwoD,
    /// `GL_TEXTURE_1D`
    OneD,
}

impl TextureTarget {
    /// All, the one that wins first.
    pub const ALL: [Self; 5] = [
        Self::Cube,
        Self::ThreeD,
        Self::Rectangle,
        Self::TwoD,
        Self::OneD,
    ];
}

/// Base internal format, as far as texture environments tell them apart. Red and red-green textures count as RGB there;
/// depth and integer ones are [refused](super::Unsupported::TextureFormat) by the reader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BaseFormat {
    /// `GL_ALPHA`
    Alpha,
    /// `GL_LUMINANCE`
    Luminance,
    /// `GL_LUMINANCE_ALPHA`
    LuminanceAlpha,
    /// `GL_INTENSITY`
    Intensity,
    /// `GL_RGB`, `GL_RED`, `GL_RG`
    Rgb,
    /// `GL_RGBA`
    #[default]
    Rgba,
}

/// `GL_TEXTURE_ENV_MODE` (tables 16.1 and 16.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Environment {
    /// `GL_REPLACE`
    Replace,
    /// `GL_MODULATE`
    Modulate,
    /// `GL_DECAL`; defined for RGB and RGBA only.
    Decal,
    /// `GL_BLEND`
    Blend,
    /// `GL_ADD`
    Add,
    /// `GL_COMBINE`
    Combine(Combine),
}

/// State of `GL_COMBINE`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Combine {
    /// `GL_COMBINE_RGB`, with its arguments and scale.
    pub rgb: Combiner,
    /// `GL_COMBINE_ALPHA`, with its arguments and scale; its operands are those of alpha.
    pub alpha: Combiner,
}

/// One half of [`Combine`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Combiner {
    /// The function.
    pub function: Function,
    /// Its arguments; those beyond [`Function::arguments`] do not matter.
    pub arguments: [Argument; 3],
    /// The result is multiplied by 2 to this power: 0, 1 or 2.
    pub scale: u8,
}

/// `GL_COMBINE_RGB` and `GL_COMBINE_ALPHA` (tables 16.3 and 16.4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Function {
    /// `GL_REPLACE`
    Replace,
    /// `GL_MODULATE`
    #[default]
    Modulate,
    /// `GL_ADD`
    Add,
    /// `GL_ADD_SIGNED`
    AddSigned,
    /// `GL_INTERPOLATE`
    Interpolate,
    /// `GL_SUBTRACT`
    Subtract,
    /// `GL_DOT3_RGB`; of RGB only.
    Dot3Rgb,
    /// `GL_DOT3_RGBA`; of RGB only, and gives alpha as well.
    Dot3Rgba,
}

impl Function {
    /// Number of arguments it reads.
    pub const fn arguments(self) -> usize {
        match self {
            Self::Replace => 1,
            Self::Interpolate => 3,
            Self::Modulate
            | Self::Add
            | Self::AddSigned
            | Self::Subtract
            | Self::Dot3Rgb
            | Self::Dot3Rgba => 2,
        }
    }
}

/// `GL_SRCn_RGB` with `GL_OPERANDn_RGB`, or those of alpha.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Argument {
    /// The colour that is read.
    pub source: Source,
    /// The channels that are taken of it.
    pub operand: Operand,
}

/// `GL_SRCn_RGB`, `GL_SRCn_ALPHA`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Source {
    /// `GL_TEXTURE`: the unit's own.
    #[default]
    Texture,
    /// `GL_TEXTUREn`.
    Unit(u8),
    /// `GL_CONSTANT`: the unit's environment colour.
    Constant,
    /// `GL_PRIMARY_COLOR`
    Primary,
    /// `GL_PREVIOUS`
    Previous,
}

/// `GL_OPERANDn_RGB`, `GL_OPERANDn_ALPHA`. For alpha only the last two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Operand {
    /// `GL_SRC_COLOR`
    #[default]
    Color,
    /// `GL_ONE_MINUS_SRC_COLOR`
    OneMinusColor,
    /// `GL_SRC_ALPHA`
    Alpha,
    /// `GL_ONE_MINUS_SRC_ALPHA`
    OneMinusAlpha,
}

/// `GL_FOG_MODE` (section 16.4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FogMode {
    /// `GL_FOG` is disabled.
    #[default]
    None,
    /// `GL_LINEAR`
    Linear,
    /// `GL_EXP`
    Exp,
    /// `GL_EXP2`
    Exp2,
}

impl FragmentKey {
    /// The key of the stage after the vertex stage `vertex`: values that the vertex stage does not write are not read.
    #[must_use]
    pub fn after(mut self, vertex: &FixedKey) -> Self {
        let vertex = vertex.canonical();
        self.color_sum = vertex.secondary();
        if vertex.fog == FogSource::None {
            self.fog = FogMode::None;
        }
        self.discard = vertex.target.discards();
        self.points = vertex.target.amplifier == Amplifier::Points;
        self.disks = vertex.target.surface;
        self.displaced = vertex.target.tiles == Tiles::DistortedRays;
        self
    }

    /// The same key, with every field zeroed that does not affect the shader.
    #[must_use]
    pub fn canonical(mut self) -> Self {
        let (grid, dialect) = (self.grid, self.dialect);
        for unit in self.units.iter_mut().flatten() {
            unit.detail &= grid && unit.target != TextureTarget::Rectangle;
            if let Environment::Combine(combine) = &mut unit.environment {
                unit.format = BaseFormat::default();
                combine.canonicalise();
            }
        }
        let details = self.units.iter().flatten().any(|unit| unit.detail);
        self.grid &= details;
        let divides = self
            .units
            .iter()
            .flatten()
            .any(|unit| unit.target == TextureTarget::Cube);
        let sums = self.color_sum && self.fog != FogMode::None;
        if !divides && !sums {
            self.dialect = Dialect::Specification;
        } else {
            self.dialect = dialect;
        }
        self
    }

    /// Indices of the units whose texture is sampled, ascending. The uniform [`sampler`](super::sampler) of each has to hold
    /// the index.
    pub fn sampled(&self) -> impl Iterator<Item = usize> + '_ {
        (0..UNITS).filter(|&unit| self.samples(unit))
    }

    /// Whether some environment reads the texture of a unit.
    fn samples(&self, unit: usize) -> bool {
        self.units[unit].is_some()
            && (0..UNITS).any(|reader| {
                let Some(state) = &self.units[reader] else {
                    return false;
                };
                match &state.environment {
                    Environment::Combine(combine) => combine.sources().any(|source| match source {
                        Source::Texture => reader == unit,
                        Source::Unit(other) => usize::from(other) == unit,
                        Source::Constant | Source::Primary | Source::Previous => false,
                    }),
                    _ => reader == unit,
                }
            })
    }
}

impl Combine {
    fn canonicalise(&mut self) {
        if self.rgb.function == Function::Dot3Rgba {
            self.alpha = Combiner {
                scale: self.alpha.scale,
                function: Function::Replace,
                arguments: [Argument::default(); 3],
            };
        }
        for combiner in [&mut self.rgb, &mut self.alpha] {
            for argument in &mut combiner.arguments[combiner.function.arguments()..] {
                *argument = Argument::default();
            }
        }
    }

    /// Sources that are read.
    pub(super) fn sources(&self) -> impl Iterator<Item = Source> + '_ {
        let alpha = usize::from(self.rgb.function != Function::Dot3Rgba);
        [(&self.rgb, 1), (&self.alpha, alpha)]
            .into_iter()
            .flat_map(|(combiner, read)| {
                &combiner.arguments[..combiner.function.arguments() * read]
            })
            .map(|argument| argument.source)
    }
}
