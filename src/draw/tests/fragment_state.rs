//! The fragment stage of fixed function, in the key of a generated one.

use super::super::fragment_state::read;
use super::super::{Driver, FixedState};
use crate::fixed::{
    Argument, BaseFormat, Combine, Combiner, Dialect, Environment, FogMode, FragmentKey,
    FragmentUnit, Function, Operand, Source, TextureTarget, Unsupported,
};
use crate::gl::fake::{Fake, Scope};
use crate::gl::{TextureName, consts as c};

/// The unit that the texture of these tests is on.
const UNIT: u32 = 2;
const TEXTURE: TextureName = TextureName(40);

/// A driver with one enabled texture unit.
struct Textured {
    fake: Fake,
    mesa: bool,
}

impl Textured {
    /// A complete texture of 8 x 4 with RGBA, without mipmaps.
    fn new(target: u32) -> Textured {
        let textured = Textured {
            fake: Fake::new(),
            mesa: false,
        };
        textured.fake.program(|gl| {
            gl.active_texture(c::TEXTURE0 + UNIT);
            gl.bind_texture(target, TEXTURE);
            gl.active_texture(c::TEXTURE0);
        });
        textured
            .unit(target, &[1.0])
            .texture(c::TEXTURE_MIN_FILTER, c::LINEAR)
            .level(0, [8, 4, 1])
            .component(c::TEXTURE_RED_SIZE, 8)
            .component(c::TEXTURE_ALPHA_SIZE, 8)
    }

    fn unit(self, name: u32, values: &[f64]) -> Self {
        self.fake.put(Scope::Unit(UNIT), name, values);
        self
    }

    fn texture(self, name: u32, value: u32) -> Self {
        let scope = Scope::Texture(TEXTURE);
        self.fake.put(scope, name, &[value.into()]);
        self
    }

    fn level(self, level: i32, size: [u32; 3]) -> Self {
        let names = [c::TEXTURE_WIDTH, c::TEXTURE_HEIGHT, c::TEXTURE_DEPTH];
        let scope = Scope::Level(TEXTURE, level);
        for (name, side) in names.into_iter().zip(size) {
            self.fake.put(scope, name, &[side.into()]);
        }
        let format = [f64::from(c::RGBA8)];
        self.fake.put(scope, c::TEXTURE_INTERNAL_FORMAT, &format);
        self
    }

    fn component(self, name: u32, value: u32) -> Self {
        let scope = Scope::Level(TEXTURE, 0);
        self.fake.put(scope, name, &[value.into()]);
        self
    }

    fn environment(self, values: &[(u32, u32)]) -> Self {
        values.iter().fold(self, |textured, &(name, value)| {
            textured.unit(name, &[value.into()])
        })
    }

    fn read(&self) -> Result<FragmentKey, Unsupported> {
        let gl = self.fake.gl();
        let mut driver = Driver::ask(&gl);
        driver.mesa = self.mesa;
        let vertex = FixedState::read(&gl, driver, 0).key;
        let before = self.fake.state();
        let key = read(&gl, driver, &vertex);
        self.fake.assert_restored(&before);
        key
    }

    /// The unit in the key.
    fn is(&self) -> Result<Option<FragmentUnit>, Unsupported> {
        self.read().map(|key| {
            let others = key.units.iter().enumerate();
            let mut others = others.filter(|(at, _)| *at != UNIT as usize);
            assert!(others.all(|(_, unit)| unit.is_none()));
            key.units[UNIT as usize]
        })
    }
}

/// The texture of [`Textured::new`].
fn plain(target: TextureTarget) -> FragmentUnit {
    FragmentUnit {
        target,
        format: BaseFormat::Rgba,
        detail: false,
        environment: Environment::Modulate,
    }
}

const TARGETS: [(u32, TextureTarget); 5] = [
    (c::TEXTURE_1D, TextureTarget::OneD),
    (c::TEXTURE_2D, TextureTarget::TwoD),
    (c::TEXTURE_3D, TextureTarget::ThreeD),
    (c::TEXTURE_CUBE_MAP, TextureTarget::Cube),
    (c::TEXTURE_RECTANGLE, TextureTarget::Rectangle),
];

#[test]
fn every_target_is_found_at_its_unit() {
    for (name, target) in TARGETS {
        let textured = Textured::new(name).level(0, [8, 8, 1]);
        assert_eq!(textured.is(), Ok(Some(plain(target))));
    }
    let off = Textured::new(c::TEXTURE_2D).unit(c::TEXTURE_2D, &[0.0]);
    assert_eq!(off.is(), Ok(None));
    let sampled = Textured::new(c::TEXTURE_2D).unit(c::SAMPLER_BINDING, &[7.0]);
    assert_eq!(sampled.is(), Err(Unsupported::SamplerObject));
    let mut old = Textured::new(c::TEXTURE_2D).unit(c::SAMPLER_BINDING, &[7.0]);
    old.fake = old.fake.version(3, 2);
    assert_eq!(old.is(), Ok(Some(plain(TextureTarget::TwoD))));
}

#[test]
fn fog_and_dialect_are_in_the_key() {
    let modes = [
        (c::LINEAR, FogMode::Linear),
        (c::EXP2, FogMode::Exp2),
        (c::EXP, FogMode::Exp),
    ];
    for (mode, expected) in modes {
        let textured = Textured::new(c::TEXTURE_2D);
        textured
            .fake
            .put(Scope::Context, c::FOG_MODE, &[mode.into()]);
        assert_eq!(textured.read().expect("a key").fog, FogMode::None);
        textured.fake.put(Scope::Context, c::FOG, &[1.0]);
        assert_eq!(textured.read().expect("a key").fog, expected);
    }
    let mut textured = Textured::new(c::TEXTURE_2D);
    let dialect = |textured: &Textured| textured.read().expect("a key").dialect;
    assert_eq!(dialect(&textured), Dialect::Specification);
    textured.mesa = true;
    assert_eq!(dialect(&textured), Dialect::Mesa);
}

#[test]
fn an_incomplete_texture_is_none() {
    for size in [[0, 4, 1], [8, 0, 1], [8, 4, 0]] {
        let textured = Textured::new(c::TEXTURE_2D).level(0, size);
        assert_eq!(textured.is(), Ok(None));
    }
    // A face of a cube map has to be a square.
    assert_eq!(Textured::new(c::TEXTURE_CUBE_MAP).is(), Ok(None));
    // All six faces are asked about, and nothing else.
    let cube = Textured::new(c::TEXTURE_CUBE_MAP).level(0, [8, 8, 1]);
    assert!(cube.is().is_ok_and(|unit| unit.is_some()));
    let calls = cube.fake.calls();
    let mut asked: Vec<u32> = calls
        .iter()
        .filter(|call| call.name == "glGetTexLevelParameteriv")
        .map(|call| call.int(0) as u32)
        .collect();
    asked.sort_unstable();
    asked.dedup();
    let faces = c::TEXTURE_CUBE_MAP_POSITIVE_X..=c::TEXTURE_CUBE_MAP_NEGATIVE_Z;
    assert_eq!(asked, faces.collect::<Vec<_>>());
}

#[test]
fn mipmaps_have_to_be_there_down_to_the_last_level() {
    let mipmapped = || Textured::new(c::TEXTURE_2D).texture(c::TEXTURE_MIN_FILTER, 0x2702);
    let detailed = FragmentUnit {
        detail: true,
        ..plain(TextureTarget::TwoD)
    };
    // 8 x 4, 4 x 2, 2 x 1, 1 x 1.
    let levels = [[4, 2, 1], [2, 1, 1], [1, 1, 1]];
    let whole = |textured: Textured| {
        (1..).zip(levels).fold(textured, |textured, (level, size)| {
            textured.level(level, size)
        })
    };
    assert_eq!(whole(mipmapped()).is(), Ok(Some(detailed)));
    for level in 1..4 {
        let missing = whole(mipmapped()).level(level, [0; 3]);
        assert_eq!(missing.is(), Ok(None), "{level}");
        let wrong = whole(mipmapped()).level(level, [3, 1, 1]);
        assert_eq!(wrong.is(), Ok(None), "{level}");
        // Levels past GL_TEXTURE_MAX_LEVEL do not matter.
        let short = missing.texture(c::TEXTURE_MAX_LEVEL, level as u32 - 1);
        assert_eq!(short.is(), Ok(Some(detailed)), "{level}");
    }
    let none = whole(mipmapped())
        .texture(c::TEXTURE_BASE_LEVEL, 1)
        .texture(c::TEXTURE_MAX_LEVEL, 0);
    assert_eq!(none.is(), Ok(None));
    // The levels of a base level are counted from it.
    let based = whole(mipmapped()).texture(c::TEXTURE_BASE_LEVEL, 1);
    let scope = Scope::Level(TEXTURE, 1);
    based.fake.put(scope, c::TEXTURE_RED_SIZE, &[8.0]);
    let rgb = FragmentUnit {
        format: BaseFormat::Rgb,
        ..detailed
    };
    assert_eq!(based.is(), Ok(Some(rgb)));
    let format = Scope::Level(TEXTURE, 2);
    let other = whole(mipmapped());
    other.fake.put(format, c::TEXTURE_INTERNAL_FORMAT, &[1.0]);
    assert_eq!(other.is(), Ok(None));
}

#[test]
fn the_level_of_detail_matters_where_filters_differ() {
    for (min, mag, detail) in [
        (c::LINEAR, c::LINEAR, false),
        (c::NEAREST, c::NEAREST, false),
        (c::NEAREST, c::LINEAR, true),
    ] {
        let textured = Textured::new(c::TEXTURE_2D)
            .texture(c::TEXTURE_MIN_FILTER, min)
            .texture(c::TEXTURE_MAG_FILTER, mag);
        let expected = FragmentUnit {
            detail,
            ..plain(TextureTarget::TwoD)
        };
        assert_eq!(textured.is(), Ok(Some(expected)));
    }
}

#[test]
fn mesa_goes_on_to_the_next_target() {
    // The target of higher priority is enabled and has no image.
    let mut textured = Textured::new(c::TEXTURE_1D).unit(c::TEXTURE_2D, &[1.0]);
    assert_eq!(textured.is(), Ok(None));
    textured.mesa = true;
    assert_eq!(textured.is(), Ok(Some(plain(TextureTarget::OneD))));
}

#[test]
fn the_base_format_comes_from_the_components() {
    let components = [
        c::TEXTURE_RED_SIZE,
        c::TEXTURE_ALPHA_SIZE,
        c::TEXTURE_LUMINANCE_SIZE,
        c::TEXTURE_INTENSITY_SIZE,
    ];
    let of = |has: [u32; 4]| {
        components
            .into_iter()
            .zip(has)
            .fold(Textured::new(c::TEXTURE_2D), |textured, (name, size)| {
                textured.component(name, size)
            })
            .is()
            .map(|unit| unit.expect("complete").format)
    };
    assert_eq!(of([8, 8, 0, 0]), Ok(BaseFormat::Rgba));
    assert_eq!(of([8, 0, 0, 0]), Ok(BaseFormat::Rgb));
    assert_eq!(of([0, 0, 0, 8]), Ok(BaseFormat::Intensity));
    assert_eq!(of([0, 8, 8, 0]), Ok(BaseFormat::LuminanceAlpha));
    assert_eq!(of([0, 0, 8, 0]), Ok(BaseFormat::Luminance));
    assert_eq!(of([0, 8, 0, 0]), Ok(BaseFormat::Alpha));
    assert_eq!(of([0; 4]), Err(Unsupported::TextureFormat));
    for kind in [c::INT, c::UNSIGNED_INT] {
        let integer = Textured::new(c::TEXTURE_2D).component(c::TEXTURE_RED_TYPE, kind);
        assert_eq!(integer.is(), Err(Unsupported::TextureFormat));
        let mut old = Textured::new(c::TEXTURE_2D).component(c::TEXTURE_RED_TYPE, kind);
        old.fake = old.fake.version(2, 1);
        assert_eq!(old.is(), Ok(Some(plain(TextureTarget::TwoD))));
    }
    let float = Textured::new(c::TEXTURE_2D).component(c::TEXTURE_RED_TYPE, c::FLOAT);
    assert_eq!(float.is(), Ok(Some(plain(TextureTarget::TwoD))));
}

#[test]
fn environments_have_their_names() {
    let modes = [
        (c::MODULATE, Environment::Modulate),
        (c::REPLACE, Environment::Replace),
        (c::DECAL, Environment::Decal),
        (c::BLEND, Environment::Blend),
        (c::ADD, Environment::Add),
    ];
    for (mode, environment) in modes {
        let textured = Textured::new(c::TEXTURE_2D).environment(&[(c::TEXTURE_ENV_MODE, mode)]);
        let expected = FragmentUnit {
            environment,
            ..plain(TextureTarget::TwoD)
        };
        assert_eq!(textured.is(), Ok(Some(expected)));
    }
    let unknown = Textured::new(c::TEXTURE_2D).environment(&[(c::TEXTURE_ENV_MODE, 1)]);
    assert_eq!(unknown.is(), Err(Unsupported::TextureEnvironment));
}

/// GL's initial state of the combiners, with GL_COMBINE.
fn combining(changes: &[(u32, u32)]) -> Result<Combine, Unsupported> {
    let mut initial = vec![
        (c::TEXTURE_ENV_MODE, c::COMBINE),
        (c::COMBINE_RGB, c::MODULATE),
        (c::COMBINE_ALPHA, c::MODULATE),
        (c::RGB_SCALE, 1),
        (c::ALPHA_SCALE, 1),
    ];
    for at in 0..3 {
        let source = [c::TEXTURE, c::PREVIOUS, c::CONSTANT][at as usize];
        let operand = [c::SRC_COLOR, c::SRC_COLOR, c::SRC_ALPHA][at as usize];
        initial.extend([
            (c::SRC0_RGB + at, source),
            (c::SRC0_ALPHA + at, source),
            (c::OPERAND0_RGB + at, operand),
            (c::OPERAND0_ALPHA + at, c::SRC_ALPHA),
        ]);
    }
    let textured = Textured::new(c::TEXTURE_2D)
        .environment(&initial)
        .environment(changes);
    textured.is().map(|unit| match unit.map(|u| u.environment) {
        Some(Environment::Combine(combine)) => combine,
        other => panic!("{other:?}"),
    })
}

fn argument(source: Source, operand: Operand) -> Argument {
    Argument { source, operand }
}

#[test]
fn combiners_are_read_whole() {
    let three = [
        argument(Source::Texture, Operand::Color),
        argument(Source::Previous, Operand::Color),
        argument(Source::Constant, Operand::Alpha),
    ];
    let alphas = three.map(|of| argument(of.source, Operand::Alpha));
    let functions = [
        (c::REPLACE, Function::Replace, 1),
        (c::MODULATE, Function::Modulate, 2),
        (c::ADD, Function::Add, 2),
        (c::ADD_SIGNED, Function::AddSigned, 2),
        (c::INTERPOLATE, Function::Interpolate, 3),
        (c::SUBTRACT, Function::Subtract, 2),
        (c::DOT3_RGB, Function::Dot3Rgb, 2),
        (c::DOT3_RGBA, Function::Dot3Rgba, 2),
    ];
    let modulated = |arguments: [Argument; 3]| {
        let mut combiner = Combiner {
            function: Function::Modulate,
            arguments,
            scale: 0,
        };
        combiner.arguments[2] = Argument::default();
        combiner
    };
    let initial = Combine {
        rgb: modulated(three),
        alpha: modulated(alphas),
    };
    assert_eq!(combining(&[]), Ok(initial));
    for (name, function, count) in functions {
        let mut expected = initial;
        let mut arguments = three;
        arguments[count..].fill(Argument::default());
        expected.rgb = Combiner {
            function,
            arguments,
            scale: 0,
        };
        assert_eq!(combining(&[(c::COMBINE_RGB, name)]), Ok(expected));
    }
    let refused = Err(Unsupported::TextureEnvironment);
    for name in [
        c::COMBINE_RGB,
        c::COMBINE_ALPHA,
        c::SRC0_RGB,
        c::SRC0_ALPHA + 1,
    ] {
        assert_eq!(combining(&[(name, 1)]), refused);
    }
    let sources = [
        (c::TEXTURE, Source::Texture),
        (c::CONSTANT, Source::Constant),
        (c::PRIMARY_COLOR, Source::Primary),
        (c::PREVIOUS, Source::Previous),
        (c::TEXTURE0, Source::Unit(0)),
        (c::TEXTURE0 + 7, Source::Unit(7)),
    ];
    for (name, source) in sources {
        let mut expected = initial;
        expected.rgb.arguments[1].source = source;
        assert_eq!(combining(&[(c::SRC0_RGB + 1, name)]), Ok(expected));
        let mut expected = initial;
        expected.alpha.arguments[0].source = source;
        assert_eq!(combining(&[(c::SRC0_ALPHA, name)]), Ok(expected));
    }
    assert_eq!(combining(&[(c::SRC0_RGB, c::TEXTURE0 + 8)]), refused);
    let operands = [
        (c::SRC_COLOR, Operand::Color),
        (c::ONE_MINUS_SRC_COLOR, Operand::OneMinusColor),
        (c::SRC_ALPHA, Operand::Alpha),
        (c::ONE_MINUS_SRC_ALPHA, Operand::OneMinusAlpha),
    ];
    for (name, operand) in operands {
        let mut expected = initial;
        expected.rgb.arguments[1].operand = operand;
        assert_eq!(combining(&[(c::OPERAND0_RGB + 1, name)]), Ok(expected));
        let mut expected = initial;
        expected.alpha.arguments[0].operand = operand;
        assert_eq!(combining(&[(c::OPERAND0_ALPHA, name)]), Ok(expected));
    }
    for (scale, shift) in [(1, 0), (2, 1), (4, 2)] {
        let mut expected = initial;
        expected.rgb.scale = shift;
        assert_eq!(combining(&[(c::RGB_SCALE, scale)]), Ok(expected));
        let mut expected = initial;
        expected.alpha.scale = shift;
        assert_eq!(combining(&[(c::ALPHA_SCALE, scale)]), Ok(expected));
    }
}

#[test]
fn units_that_are_off_are_not_looked_at() {
    let fake = Fake::new();
    let gl = fake.gl();
    let driver = Driver::ask(&gl);
    let vertex = FixedState::read(&gl, driver, 0).key;
    let key = fake.assert_asks_nothing(|| read(&gl, driver, &vertex));
    assert_eq!(key, Ok(FragmentKey::default().after(&vertex)));
    assert_eq!(fake.count("glActiveTexture"), 0);
}
