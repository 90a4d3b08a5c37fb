//! Text and decisions of the generators, without a driver.

use manyview::fixed::{
    Amplifier, Argument, BaseFormat, Clip, ColorMaterial, Combine, Combiner, Diagonal, Dialect,
    Environment, FixedKey, FogMode, FogSource, FragmentKey, FragmentUnit, Function, Light,
    Lighting, Limits, MaterialFace, MaterialMode, NormalScaling, Operand, PointSize, Primitive,
    Rasterised, Source, Surroundings, Target, TexGen, TextureTarget, TextureUnit, Tiles,
    Unsupported, VertexLayer, batch, generate, generate_fragment,
};

fn limits() -> Limits {
    Limits {
        vertex_layer: Some(VertexLayer::ArbShaderViewportLayerArray),
        ..Limits::default()
    }
}

fn target(amplifier: Amplifier, tiles: Tiles, primitive: Primitive, views: u8) -> Target {
    Target {
        amplifier,
        tiles,
        clip: Clip::Distances,
        primitive,
        diagonal: Diagonal::OneThree,
        views,
        surface: false,
    }
}

/// One directional and one spot light, as in many demos.
fn lit() -> Lighting {
    let mut lighting = Lighting::default();
    lighting.lights[0] = Some(Light::default());
    lighting.lights[1] = Some(Light {
        positional: true,
        spot: true,
        attenuated: true,
    });
    lighting
}

/// Both stages, for a snapshot.
fn text(key: &FixedKey) -> String {
    let shaders = generate(key, &limits()).expect("these keys are supported");
    let mut text = format!("{:?}\n\n{}", shaders.patches, shaders.vertex);
    if let Some(geometry) = shaders.geometry {
        text.push_str("\n---- geometry ----\n\n");
        text.push_str(&geometry);
    }
    for stage in shaders.tessellation.into_iter().flatten() {
        text.push_str("\n---- tessellation ----\n\n");
        text.push_str(&stage);
    }
    text
}

#[test]
fn unlit_instanced() {
    let key = FixedKey {
        clamp_colors: true,
        ..FixedKey::default()
    };
    insta::assert_snapshot!(text(&key));
}

#[test]
fn gears_instanced() {
    let mut lighting = Lighting::default();
    lighting.lights[0] = Some(Light::default());
    let key = FixedKey {
        lighting: Some(lighting),
        normals: NormalScaling::Normalize,
        clamp_colors: true,
        flat: true,
        dialect: Dialect::Mesa,
        ..FixedKey::default()
    };
    insta::assert_snapshot!(text(&key));
}

#[test]
fn everything_lit_in_layers() {
    let material = ColorMaterial {
        face: MaterialFace::FrontAndBack,
        mode: MaterialMode::AmbientAndDiffuse,
    };
    let lighting = Lighting {
        local_viewer: true,
        two_side: true,
        separate_specular: true,
        color_material: Some(material),
        ..lit()
    };
    let key = FixedKey {
        target: target(Amplifier::Instanced, Tiles::Layer, Primitive::Triangles, 8),
        lighting: Some(lighting),
        normals: NormalScaling::Rescale,
        fog: FogSource::Radial,
        clip_planes: 0b10_0100,
        clamp_colors: true,
        ..FixedKey::default()
    };
    insta::assert_snapshot!(text(&key));
}

#[test]
fn generated_coordinates() {
    let mut key = FixedKey {
        fog: FogSource::DepthMagnitude,
        clamp_colors: true,
        ..FixedKey::default()
    };
    let sphere = Some(TexGen::SphereMap);
    key.units[0] = TextureUnit {
        enabled: true,
        matrix: false,
        generation: [sphere, sphere, None, None],
    };
    key.units[3] = TextureUnit {
        enabled: true,
        matrix: true,
        generation: [Some(TexGen::EyeLinear); 4],
    };
    insta::assert_snapshot!(text(&key));
}

#[test]
fn flat_quads_in_a_loop() {
    let mut key = FixedKey {
        target: target(
            Amplifier::GeometryLoop,
            Tiles::ClipLeftRight,
            Primitive::Quads,
            5,
        ),
        clip_planes: 1,
        flat: true,
        ..FixedKey::default()
    };
    key.units[0].enabled = true;
    insta::assert_snapshot!(text(&key));
}

#[test]
fn attenuated_points_by_invocations() {
    let key = FixedKey {
        target: target(
            Amplifier::GeometryInvocations,
            Tiles::Layer,
            Primitive::Points,
            9,
        ),
        point: PointSize::Attenuated,
        color_sum: true,
        ..FixedKey::default()
    };
    insta::assert_snapshot!(text(&key));
}

#[test]
fn lit_points_for_all_views_at_once() {
    let key = FixedKey {
        target: target(Amplifier::Points, Tiles::Layer, Primitive::Points, 1),
        point: PointSize::Attenuated,
        lighting: Some(Lighting {
            two_side: true,
            ..Lighting::default()
        }),
        clip_planes: 4,
        ..FixedKey::default()
    };
    insta::assert_snapshot!(text(&key));
}

#[test]
fn flat_quads_for_distorted_rays() {
    let key = FixedKey {
        target: target(
            Amplifier::Tessellation,
            Tiles::DistortedRays,
            Primitive::Quads,
            3,
        ),
        flat: true,
        fog: FogSource::DepthMagnitude,
        ..FixedKey::default()
    };
    let stage = FragmentKey {
        fog: FogMode::Linear,
        ..FragmentKey::default()
    };
    let fragment = fragment(&stage.after(&key));
    insta::assert_snapshot!(format!("{}\n---- fragment ----\n\n{fragment}", text(&key)));
}

/// A fragment stage, for a snapshot.
fn fragment(key: &FragmentKey) -> String {
    generate_fragment(key, &limits()).expect("these keys are supported")
}

fn unit(target: TextureTarget, format: BaseFormat, environment: Environment) -> FragmentUnit {
    FragmentUnit {
        target,
        format,
        detail: true,
        environment,
    }
}

#[test]
fn fragments_of_a_game() {
    let mut key = FragmentKey {
        fog: FogMode::Exp2,
        grid: true,
        dialect: Dialect::Mesa,
        ..FragmentKey::default()
    };
    let two = TextureTarget::TwoD;
    key.units[0] = Some(unit(two, BaseFormat::Rgb, Environment::Modulate));
    key.units[1] = Some(unit(two, BaseFormat::LuminanceAlpha, Environment::Blend));
    insta::assert_snapshot!(fragment(&key));
}

#[test]
fn combined_fragments_within_limits() {
    let argument = |source, operand| Argument { source, operand };
    let bump = Combine {
        rgb: Combiner {
            function: Function::Dot3Rgb,
            arguments: [
                argument(Source::Texture, Operand::Color),
                argument(Source::Primary, Operand::OneMinusColor),
                argument(Source::Unit(7), Operand::Alpha),
            ],
            scale: 1,
        },
        alpha: Combiner {
            function: Function::Interpolate,
            arguments: [
                argument(Source::Unit(3), Operand::Alpha),
                argument(Source::Previous, Operand::Alpha),
                argument(Source::Constant, Operand::OneMinusAlpha),
            ],
            scale: 0,
        },
    };
    let vertex = FixedKey {
        target: Target {
            clip: Clip::Discard,
            ..Target::default()
        },
        color_sum: true,
        fog: FogSource::Coordinate,
        ..FixedKey::default()
    };
    let mut key = FragmentKey {
        fog: FogMode::Linear,
        ..FragmentKey::default()
    };
    let (cube, line) = (TextureTarget::Cube, TextureTarget::OneD);
    key.units[0] = Some(unit(cube, BaseFormat::Rgba, Environment::Combine(bump)));
    key.units[3] = Some(unit(line, BaseFormat::Alpha, Environment::Add));
    insta::assert_snapshot!(fragment(&key.after(&vertex)));
    let shaders = generate(&vertex, &limits()).expect("supported");
    insta::assert_snapshot!("limits_of_a_view", shaders.vertex);
    key.units[3] = None;
    assert_eq!(
        generate_fragment(&key, &limits()),
        Err(Unsupported::TextureEnvironment),
        "the texture of unit 3 is read and not there"
    );
}

#[test]
fn fragments_forget_what_does_not_matter() {
    let mut key = FragmentKey {
        grid: true,
        dialect: Dialect::Mesa,
        ..FragmentKey::default()
    };
    let rectangle = TextureTarget::Rectangle;
    key.units[2] = Some(unit(rectangle, BaseFormat::Rgb, Environment::Decal));
    let canonical = key.canonical();
    assert!(!canonical.grid, "a rectangle has one level");
    assert_eq!(canonical.dialect, Dialect::Specification);
    assert_eq!(canonical.canonical(), canonical, "canonical is final");
    assert_eq!(canonical.sampled().collect::<Vec<_>>(), [2]);
    key.units[2] = Some(unit(rectangle, BaseFormat::Alpha, Environment::Decal));
    assert_eq!(
        generate_fragment(&key, &limits()),
        Err(Unsupported::TextureEnvironment),
        "a decal without colour"
    );
}

#[test]
fn triangles_left_out_in_a_loop() {
    let key = FixedKey {
        target: Target {
            clip: Clip::Both,
            ..target(
                Amplifier::GeometryLoop,
                Tiles::ClipLeftRight,
                Primitive::Triangles,
                4,
            )
        },
        ..FixedKey::default()
    };
    insta::assert_snapshot!(text(&key));
}

#[test]
fn triangles_cut_in_invocations() {
    let key = FixedKey {
        target: Target {
            clip: Clip::Cut,
            ..target(
                Amplifier::GeometryInvocations,
                Tiles::ClipLeftRight,
                Primitive::Triangles,
                4,
            )
        },
        ..FixedKey::default()
    };
    insta::assert_snapshot!(text(&key));
    let instanced = FixedKey {
        target: Target {
            amplifier: Amplifier::Instanced,
            ..key.target
        },
        ..key
    };
    assert_eq!(instanced.canonical().target.clip, Clip::Distances);
}

#[test]
fn what_does_not_matter_is_forgotten() {
    let mut lighting = lit();
    lighting.lights[0] = Some(Light {
        attenuated: true,
        ..Light::default()
    });
    lighting.color_material = Some(ColorMaterial {
        face: MaterialFace::Back,
        mode: MaterialMode::Diffuse,
    });
    let mut key = FixedKey {
        lighting: Some(lighting),
        color_sum: true,
        ..FixedKey::default()
    };
    key.target = target(
        Amplifier::Instanced,
        Tiles::ClipLeftRight,
        Primitive::QuadStrip,
        17,
    );
    key.units[2].matrix = true;
    let plain = FixedKey {
        lighting: Some(lit()),
        ..FixedKey::default()
    };
    assert_eq!(key.canonical(), plain.canonical(), "one program for both");
    assert_eq!(
        key.canonical().canonical(),
        key.canonical(),
        "canonical is final"
    );
    let unlit = FixedKey {
        normals: NormalScaling::Normalize,
        dialect: Dialect::Mesa,
        ..FixedKey::default()
    };
    assert_eq!(
        unlit.canonical(),
        FixedKey::default().canonical(),
        "an unlit vertex has no normal"
    );
}

#[test]
fn views_that_fit_one_draw() {
    let mut key = FixedKey {
        target: target(
            Amplifier::GeometryLoop,
            Tiles::ClipLeftRight,
            Primitive::Triangles,
            1,
        ),
        ..FixedKey::default()
    };
    // 11 components a vertex: position, colour, two distances, the primitive's number. 1024 / (3 · 11) = 31.
    assert_eq!(
        batch(&key, &limits()),
        31,
        "the loop is bounded by what it emits"
    );
    key.target.views = 32;
    let refused = generate(&key, &limits());
    assert_eq!(
        refused,
        Err(Unsupported::Views {
            views: 32,
            limit: 31
        }),
        "one too many"
    );
    key.target.amplifier = Amplifier::GeometryInvocations;
    assert_eq!(batch(&key, &limits()), 32, "invocations are counted");
    assert!(generate(&key, &limits()).is_ok(), "and each emits one view");
    assert_eq!(
        batch(&FixedKey::default(), &limits()),
        64,
        "instances fill the array"
    );
}

#[test]
fn refused_with_a_reason() {
    let bare = Limits {
        geometry_invocations: 0,
        glsl: 330,
        ..Limits::default()
    };
    let mut key = FixedKey::default();
    key.target.tiles = Tiles::Layer;
    assert_eq!(generate(&key, &bare), Err(Unsupported::VertexLayer));
    key.target.amplifier = Amplifier::GeometryInvocations;
    assert_eq!(generate(&key, &bare), Err(Unsupported::Invocations));
    let old = Limits {
        glsl: 120,
        ..limits()
    };
    assert_eq!(
        generate(&FixedKey::default(), &old),
        Err(Unsupported::ShadingLanguage {
            needed: 150,
            has: 120
        })
    );
    let planes = FixedKey {
        clip_planes: 0b1_1111,
        target: Target {
            tiles: Tiles::ClipLeftRight,
            ..Target::default()
        },
        ..FixedKey::default()
    };
    assert_eq!(
        generate(
            &planes,
            &Limits {
                clip_distances: 6,
                ..limits()
            }
        ),
        Err(Unsupported::ClipDistances {
            needed: 7,
            limit: 6
        })
    );
    let zero_shininess = Lighting {
        zero_shininess: true,
        ..lit()
    };
    let key = FixedKey {
        lighting: Some(zero_shininess),
        dialect: Dialect::Mesa,
        ..FixedKey::default()
    };
    assert_eq!(generate(&key, &limits()), Err(Unsupported::DriverQuirk));
    assert!(
        generate(
            &FixedKey {
                dialect: Dialect::Specification,
                ..key
            },
            &limits()
        )
        .is_ok(),
        "others are right"
    );
}

#[test]
fn surroundings_that_forbid() {
    let quiet = Surroundings::default();
    let mut key = FixedKey::default();
    assert_eq!(quiet.allow(&key), Ok(()), "the initial state is fine");
    let lines = Rasterised {
        lines: true,
        ..Rasterised::default()
    };
    let wide = Surroundings {
        rasterised: lines,
        line_width: 2.0,
        ..quiet
    };
    assert_eq!(wide.allow(&key), Err(Unsupported::WideLines));
    key.target.tiles = Tiles::Layer;
    assert_eq!(wide.allow(&key), Ok(()), "nothing leaks between layers");
    key.target.amplifier = Amplifier::GeometryLoop;
    key.target.primitive = Primitive::Quads;
    let wire = Surroundings {
        polygon_mode: true,
        rasterised: lines,
        ..quiet
    };
    assert_eq!(wire.allow(&key), Err(Unsupported::PolygonMode));
    assert_eq!(Unsupported::PolygonMode.name(), "polygon-mode");
}
