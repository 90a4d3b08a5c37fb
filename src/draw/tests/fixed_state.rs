//! Fixed-function state of the driver, in the key of a generated shader.

use super::super::{Driver, FixedState, limits};
use crate::fixed::{
    ColorMaterial, Diagonal, Dialect, FixedKey, FogSource, LEVELS, Light, Lighting, Limits,
    MaterialFace, MaterialMode, NormalScaling, PointSize, Provoking, TexGen, TextureUnit,
    VertexLayer,
};
use crate::gl::consts as c;
use crate::gl::fake::{Fake, Scope};

const IDENTITY: [f32; 16] = glam::Mat4::IDENTITY.to_cols_array();

/// Reads the state of a driver in which some values are set; reading must not change any state.
fn read(fake: &Fake, values: &[(u32, &[f64])], samples: u32) -> FixedState {
    let gl = fake.gl();
    for &(name, values) in values {
        let scope = match name {
            c::POSITION | c::SPOT_CUTOFF | c::CONSTANT_ATTENUATION => Scope::Light(c::LIGHT0 + 2),
            c::LINEAR_ATTENUATION | c::QUADRATIC_ATTENUATION => Scope::Light(c::LIGHT0 + 2),
            _ => Scope::Context,
        };
        fake.put(scope, name, values);
    }
    let (driver, before) = (Driver::ask(&gl), fake.state());
    let state = FixedState::read(&gl, driver, samples);
    fake.assert_restored(&before);
    state
}

const ON: &[f64] = &[1.0];
const OFF: &[f64] = &[0.0];

#[test]
fn each_state_has_its_place() {
    let initial = read(&Fake::new(), &[], 4);
    assert_eq!(initial.key.clamp_colors, initial.surroundings.multisample);
    type Case = (u32, &'static [f64], fn(&mut FixedState));
    let modes = [c::POINT, c::LINE].map(f64::from);
    let cases: [Case; 24] = [
        (c::NORMALIZE, ON, |s| {
            s.key.normals = NormalScaling::Normalize
        }),
        (c::RESCALE_NORMAL, ON, |s| {
            s.key.normals = NormalScaling::Rescale
        }),
        (c::FOG, ON, |s| s.key.fog = FogSource::DepthMagnitude),
        (c::CLIP_PLANE0, ON, |s| s.key.clip_planes = 1),
        (c::CLIP_PLANE0 + 5, ON, |s| s.key.clip_planes = 1 << 5),
        (c::COLOR_SUM, ON, |s| {
            (s.key.color_sum, s.color_sum) = (true, true);
        }),
        (c::CLAMP_VERTEX_COLOR, OFF, |s| s.key.clamp_colors = false),
        (c::SHADE_MODEL, &[c::FLAT as f64], |s| s.key.flat = true),
        (
            c::PROVOKING_VERTEX,
            &[c::FIRST_VERTEX_CONVENTION as f64],
            |s| s.key.provoking = Provoking::First,
        ),
        (c::VERTEX_PROGRAM_ARB, ON, |s| {
            s.surroundings.vertex_program = true
        }),
        (c::FRAGMENT_PROGRAM_ARB, ON, |s| {
            s.surroundings.vertex_program = true
        }),
        (c::LINE_STIPPLE, ON, |s| s.surroundings.line_stipple = true),
        (c::LINE_WIDTH, &[3.0], |s| s.surroundings.line_width = 3.0),
        (c::POINT_SIZE, &[4.0], |s| s.surroundings.point_size = 4.0),
        (c::POINT_SIZE_MIN, &[0.5], |s| {
            s.surroundings.point_size_min = 0.5
        }),
        (c::POINT_FADE_THRESHOLD_SIZE, &[2.0], |s| {
            s.surroundings.point_fade_threshold = 2.0
        }),
        (c::POINT_SMOOTH, ON, |s| s.surroundings.point_smooth = true),
        (c::LINE_SMOOTH, ON, |s| s.surroundings.line_smooth = true),
        (c::POLYGON_SMOOTH, ON, |s| {
            s.surroundings.polygon_smooth = true
        }),
        (c::MULTISAMPLE, OFF, |s| s.surroundings.multisample = false),
        (c::VERTEX_PROGRAM_TWO_SIDE, ON, |s| {
            s.program_two_side = true
        }),
        (c::PROGRAM_POINT_SIZE, ON, |s| s.program_point_size = true),
        (c::QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION, OFF, |s| {
            s.quads_follow = false
        }),
        (c::POINT_DISTANCE_ATTENUATION, &[1.0, 0.0, 0.5], |s| {
            s.point = PointSize::Attenuated
        }),
    ];
    for (name, values, change) in cases {
        let mut expected = initial;
        change(&mut expected);
        assert_ne!(expected, initial, "{name:#x}");
        assert_eq!(
            read(&Fake::new(), &[(name, values)], 4),
            expected,
            "{name:#x}"
        );
    }
    let outlined = read(&Fake::new(), &[(c::POLYGON_MODE, &modes)], 4);
    assert_eq!(outlined.polygon_mode, [c::POINT, c::LINE]);
    // Without samples, GL_MULTISAMPLE has no effect.
    assert!(!read(&Fake::new(), &[], 0).surroundings.multisample);
    let both = [(c::NORMALIZE, ON), (c::RESCALE_NORMAL, ON)];
    let both = read(&Fake::new(), &both, 0);
    assert_eq!(both.key.normals, NormalScaling::Normalize);
}

#[test]
fn old_drivers_have_no_convention_for_quads() {
    for (version, follows) in [((3, 1), false), ((3, 2), true)] {
        let fake = Fake::new().version(version.0, version.1);
        assert_eq!(read(&fake, &[], 0).quads_follow, follows);
    }
}

#[test]
fn only_clip_planes_that_there_are_count() {
    let fake = Fake::new().limit(c::MAX_CLIP_DISTANCES, &[2.0]);
    let planes: Vec<_> = (0..3).map(|at| (c::CLIP_PLANE0 + at, ON)).collect();
    assert_eq!(read(&fake, &planes, 0).key.clip_planes, 0b11);
    let embedded = Fake::new().es(3, 2);
    assert_eq!(read(&embedded, &planes, 0).key.clip_planes, 0);
}

#[test]
fn the_source_of_fog_is_the_drivers() {
    let of = |extension: &'static str, values: &[(u32, &[f64])]| {
        let fake = Fake::new().extensions([extension]);
        let on = [(c::FOG, ON)];
        read(&fake, &[&on, values].concat(), 0).key.fog
    };
    let nv = "GL_NV_fog_distance";
    let mode = |mode: u32| f64::from(mode);
    let coordinate: (u32, &[f64]) = (c::FOG_COORD_SRC, &[mode(c::FOG_COORDINATE)]);
    let radial: (u32, &[f64]) = (c::FOG_DISTANCE_MODE_NV, &[mode(c::EYE_RADIAL_NV)]);
    let plane: (u32, &[f64]) = (c::FOG_DISTANCE_MODE_NV, &[mode(c::EYE_PLANE)]);
    assert_eq!(of("", &[coordinate]), FogSource::Coordinate);
    assert_eq!(of(nv, &[coordinate, radial]), FogSource::Coordinate);
    assert_eq!(of("", &[radial]), FogSource::DepthMagnitude);
    assert_eq!(of(nv, &[radial]), FogSource::Radial);
    assert_eq!(of(nv, &[plane]), FogSource::Depth);
    assert_eq!(of(nv, &[]), FogSource::DepthMagnitude);
}

#[test]
fn lights_and_the_material_are_in_the_key() {
    let lit: (u32, &[f64]) = (c::LIGHTING, ON);
    let of = |values: &[(u32, &[f64])]| {
        let state = read(&Fake::new(), &[&[lit], values].concat(), 0);
        state.key.lighting.expect("lighting")
    };
    assert_eq!(read(&Fake::new(), &[], 0).key.lighting, None);
    assert_eq!(of(&[]), Lighting::default());
    let third: (u32, &[f64]) = (c::LIGHT0 + 2, ON);
    let with = |light: Light| {
        let mut lighting = Lighting::default();
        lighting.lights[2] = Some(light);
        lighting
    };
    assert_eq!(of(&[third]), with(Light::default()));
    let positional: (u32, &[f64]) = (c::POSITION, &[0.0, 0.0, 1.0, 1.0]);
    let expected = Light {
        positional: true,
        ..Light::default()
    };
    assert_eq!(of(&[third, positional]), with(expected));
    let spot: (u32, &[f64]) = (c::SPOT_CUTOFF, &[30.0]);
    let expected = Light {
        spot: true,
        ..Light::default()
    };
    assert_eq!(of(&[third, spot]), with(expected));
    for name in [
        c::CONSTANT_ATTENUATION,
        c::LINEAR_ATTENUATION,
        c::QUADRATIC_ATTENUATION,
    ] {
        let expected = Light {
            attenuated: true,
            ..Light::default()
        };
        assert_eq!(of(&[third, (name, &[0.5])]), with(expected));
    }
    assert!(of(&[(c::LIGHT_MODEL_LOCAL_VIEWER, ON)]).local_viewer);
    assert!(of(&[(c::LIGHT_MODEL_TWO_SIDE, ON)]).two_side);
    let separate = f64::from(c::SEPARATE_SPECULAR_COLOR);
    assert!(of(&[(c::LIGHT_MODEL_COLOR_CONTROL, &[separate])]).separate_specular);
    let faces = [
        (c::FRONT, MaterialFace::Front),
        (c::BACK, MaterialFace::Back),
        (c::FRONT_AND_BACK, MaterialFace::FrontAndBack),
    ];
    let modes = [
        (c::EMISSION, MaterialMode::Emission),
        (c::AMBIENT, MaterialMode::Ambient),
        (c::DIFFUSE, MaterialMode::Diffuse),
        (c::SPECULAR, MaterialMode::Specular),
        (0x1602, MaterialMode::AmbientAndDiffuse),
    ];
    for (face, expected_face) in faces {
        for (mode, expected_mode) in modes {
            let [face, mode] = [face, mode].map(f64::from);
            let follows = of(&[
                (c::COLOR_MATERIAL, ON),
                (c::COLOR_MATERIAL_FACE, &[face]),
                (c::COLOR_MATERIAL_PARAMETER, &[mode]),
            ]);
            let expected = ColorMaterial {
                face: expected_face,
                mode: expected_mode,
            };
            assert_eq!(follows.color_material, Some(expected));
        }
    }
}

/// The flag `zero_shininess` for the shininess and the specular red of both faces; `follows`: the material parameter that follows the colour.
fn zero_shininess(shininess: [f64; 2], red: [f64; 2], follows: Option<u32>) -> bool {
    let fake = Fake::new();
    for (face, (shininess, red)) in [c::FRONT, c::BACK]
        .into_iter()
        .zip(shininess.into_iter().zip(red))
    {
        fake.put(Scope::Face(face), c::SHININESS, &[shininess]);
        fake.put(Scope::Face(face), c::SPECULAR, &[red, 0.0, 0.0, 1.0]);
    }
    let mut values: Vec<(u32, &[f64])> = vec![(c::LIGHTING, ON)];
    let mode = follows.map(f64::from);
    if let Some(mode) = &mode {
        let mode = std::slice::from_ref(mode);
        values.extend([(c::COLOR_MATERIAL, ON), (c::COLOR_MATERIAL_PARAMETER, mode)]);
    }
    let state = read(&fake, &values, 0);
    let is = state.key.lighting.expect("lighting").zero_shininess;
    // Reading the material alone gives the same.
    let mut again = state;
    again.key.lighting = Some(Lighting {
        zero_shininess: !is,
        ..state.key.lighting.expect("lighting")
    });
    again.reread_material(&fake.gl());
    assert_eq!(again, state);
    is
}

#[test]
fn a_dull_face_has_shininess_0_and_some_specular_colour() {
    assert!(!zero_shininess([0.0; 2], [0.0; 2], None));
    assert!(zero_shininess([0.0, 5.0], [0.5, 0.0], None));
    assert!(zero_shininess([5.0, 0.0], [0.0, 0.5], None));
    assert!(!zero_shininess([5.0, 0.0], [0.5, 0.0], None));
    assert!(!zero_shininess([5.0; 2], [0.5; 2], Some(c::SPECULAR)));
    assert!(zero_shininess([0.0; 2], [0.0; 2], Some(c::SPECULAR)));
    assert!(!zero_shininess([0.0; 2], [0.0; 2], Some(c::DIFFUSE)));
}

#[test]
fn texture_units_are_read_one_by_one() {
    let unit = |fake: &Fake, at: u32, values: &[(u32, &[f64])]| {
        for &(name, values) in values {
            fake.put(Scope::Unit(at), name, values);
        }
    };
    let targets = [
        c::TEXTURE_1D,
        c::TEXTURE_2D,
        c::TEXTURE_3D,
        c::TEXTURE_CUBE_MAP,
        c::TEXTURE_RECTANGLE,
    ];
    for target in targets {
        let fake = Fake::new();
        unit(&fake, 3, &[(target, ON)]);
        let mut expected = [TextureUnit::default(); 8];
        expected[3].enabled = true;
        assert_eq!(read(&fake, &[], 0).key.units, expected);
    }
    let fake = Fake::new();
    let moved = glam::Mat4::from_translation(glam::Vec3::X).to_cols_array();
    unit(
        &fake,
        1,
        &[
            (c::TEXTURE_2D, ON),
            (c::TEXTURE_MATRIX, &moved.map(f64::from)),
        ],
    );
    // The state of a unit that is not enabled does not matter.
    unit(
        &fake,
        2,
        &[(c::TEXTURE_GEN_S, ON), (c::TEXTURE_MATRIX, &[2.0; 16])],
    );
    let mut expected = [TextureUnit::default(); 8];
    (expected[1].enabled, expected[1].matrix) = (true, true);
    assert_eq!(read(&fake, &[], 0).key.units, expected);
    let modes = [
        (c::OBJECT_LINEAR, TexGen::ObjectLinear),
        (c::EYE_LINEAR, TexGen::EyeLinear),
        (c::SPHERE_MAP, TexGen::SphereMap),
        (c::REFLECTION_MAP, TexGen::ReflectionMap),
        (c::NORMAL_MAP, TexGen::NormalMap),
    ];
    for (mode, expected) in modes {
        for at in 0..4 {
            let fake = Fake::new();
            let mode = [f64::from(mode)];
            unit(
                &fake,
                0,
                &[
                    (c::TEXTURE_2D, ON),
                    (c::TEXTURE_GEN_S + at, ON),
                    (c::TEXTURE_GEN_MODE, &mode),
                ],
            );
            let state = read(&fake, &[], 0);
            let mut generation = [None; 4];
            generation[at as usize] = Some(expected);
            assert_eq!(state.key.units[0].generation, generation);
            let asked = [format!("glGetTexGeniv({}, GL_TEXTURE_GEN_MODE)", c::S + at)];
            let lines = fake.lines("glGetTexGeniv");
            assert_eq!(lines.len(), 1, "{lines:?} {asked:?}");
            let call = fake
                .calls()
                .into_iter()
                .find(|call| call.name == "glGetTexGeniv");
            assert_eq!(call.expect("asked").int(0) as u32, c::S + at);
        }
    }
}

#[test]
fn a_unit_that_no_key_has_is_told() {
    for (units, at, high) in [(16, 9, true), (16, 8, true), (16, 7, false), (8, 9, false)] {
        let fake = Fake::new().limit(c::MAX_TEXTURE_UNITS, &[f64::from(units)]);
        fake.put(Scope::Unit(at), c::TEXTURE_2D, ON);
        let state = read(&fake, &[], 0);
        assert_eq!(state.surroundings.high_texture_unit, high, "{units} {at}");
        assert_eq!(state.key.units.iter().any(|unit| unit.enabled), at < 8);
    }
}

#[test]
fn the_dialect_is_the_drivers() {
    let fake = Fake::new();
    let gl = fake.gl();
    let mut driver = Driver::ask(&gl);
    assert!(!driver.mesa && !driver.programs);
    assert_eq!(
        FixedState::read(&gl, driver, 0).key.dialect,
        Dialect::Specification
    );
    driver.mesa = true;
    assert_eq!(FixedState::read(&gl, driver, 0).key.dialect, Dialect::Mesa);
    let fake = Fake::new().extensions(["GL_ARB_vertex_program"]);
    assert!(Driver::ask(&fake.gl()).programs);
}

/// The key and the surroundings of a primitive mode in a context with some values.
fn for_mode(values: &[(u32, &[f64])], mode: u32) -> (FixedKey, crate::fixed::Surroundings) {
    read(&Fake::new(), values, 0).for_mode(mode, &IDENTITY, false)
}

#[test]
fn a_mode_says_what_is_rasterised() {
    let rasterised = |values: &[(u32, &[f64])], mode| {
        let (_, surroundings) = for_mode(values, mode);
        let drawn = surroundings.rasterised;
        assert_eq!(surroundings.polygon_mode, surroundings.edge_flags);
        (
            [drawn.points, drawn.lines, drawn.polygons],
            surroundings.polygon_mode,
        )
    };
    assert_eq!(rasterised(&[], c::POINTS), ([true, false, false], false));
    for mode in [c::LINES, c::LINE_STRIP, c::LINE_LOOP] {
        assert_eq!(rasterised(&[], mode), ([false, true, false], false));
    }
    for mode in [c::TRIANGLES, c::QUADS, c::QUAD_STRIP, c::POLYGON] {
        assert_eq!(rasterised(&[], mode), ([false, false, true], false));
        let modes = [c::POINT, c::LINE].map(f64::from);
        let outlined: (u32, &[f64]) = (c::POLYGON_MODE, &modes);
        assert_eq!(rasterised(&[outlined], mode), ([true, true, false], true));
        let modes = [c::FILL, c::LINE].map(f64::from);
        let outlined: (u32, &[f64]) = (c::POLYGON_MODE, &modes);
        assert_eq!(rasterised(&[outlined], mode), ([false, true, true], true));
        let modes = [c::FILL, c::POINT].map(f64::from);
        let outlined: (u32, &[f64]) = (c::POLYGON_MODE, &modes);
        assert_eq!(rasterised(&[outlined], mode), ([true, false, true], true));
    }
    let far: (u32, &[f64]) = (c::POINT_DISTANCE_ATTENUATION, &[0.0, 1.0, 0.0]);
    assert_eq!(for_mode(&[far], c::POINTS).0.point, PointSize::Attenuated);
    assert_eq!(for_mode(&[], c::POINTS).0.point, PointSize::Constant);
    assert_eq!(for_mode(&[far], c::LINES).0.point, PointSize::Unused);
}

#[test]
fn quads_are_cut_by_the_convention() {
    let first: (u32, &[f64]) = (
        c::PROVOKING_VERTEX,
        &[f64::from(c::FIRST_VERTEX_CONVENTION)],
    );
    let alone: (u32, &[f64]) = (c::QUADS_FOLLOW_PROVOKING_VERTEX_CONVENTION, OFF);
    for mode in [c::QUADS, c::QUAD_STRIP] {
        let of = |values: &[(u32, &[f64])]| {
            let (key, _) = for_mode(values, mode);
            (key.target.diagonal, key.provoking)
        };
        assert_eq!(of(&[]), (Diagonal::OneThree, Provoking::Last));
        assert_eq!(of(&[first]), (Diagonal::ZeroTwo, Provoking::First));
        assert_eq!(of(&[first, alone]), (Diagonal::ZeroTwo, Provoking::Last));
    }
    let (key, _) = for_mode(&[first, alone], c::TRIANGLES);
    assert_eq!(
        (key.target.diagonal, key.provoking),
        (Diagonal::default(), Provoking::First)
    );
}

#[test]
fn a_material_inside_is_told() {
    let state = read(&Fake::new(), &[], 0);
    for inside in [false, true] {
        let (_, surroundings) = state.for_mode(c::TRIANGLES, &IDENTITY, inside);
        assert_eq!(surroundings.material_per_vertex, inside);
    }
}

#[test]
fn lighting_is_in_object_space_under_rotations() {
    let state = read(&Fake::new(), &[(c::LIGHTING, ON)], 0);
    let object_space = |matrix: glam::Mat4| {
        let (key, _) = state.for_mode(c::TRIANGLES, &matrix.to_cols_array(), false);
        key.lighting.expect("lighting").object_space
    };
    let turn = glam::Mat4::from_rotation_x(0.7) * glam::Mat4::from_rotation_y(0.4);
    assert!(object_space(glam::Mat4::IDENTITY));
    assert!(object_space(turn));
    assert!(object_space(
        glam::Mat4::from_translation(glam::Vec3::ONE) * turn
    ));
    for axis in 0..3 {
        // One axis is longer; one is sheared towards the next; the matrix is not affine.
        let mut longer = glam::Mat4::IDENTITY;
        longer.col_mut(axis)[axis] = 1.5;
        assert!(!object_space(longer));
        let (sin, cos) = 0.1f32.sin_cos();
        let mut leant = glam::Mat4::IDENTITY;
        leant.col_mut(axis)[axis] = cos;
        leant.col_mut(axis)[(axis + 1) % 3] = sin;
        assert!(!object_space(leant));
    }
    for column in 0..4 {
        let mut projecting = glam::Mat4::IDENTITY;
        projecting.col_mut(column)[3] += 0.5;
        assert!(!object_space(projecting));
    }
    // Two axes of length 1 are not at a right angle: only their dot product shows it.
    let mut two = glam::Mat4::IDENTITY;
    *two.col_mut(1) = glam::Vec4::new(0.6, 0.8, 0.0, 0.0);
    assert!(!object_space(two));
}

#[test]
fn limits_are_the_drivers_own() {
    let names = [
        c::MAX_CLIP_DISTANCES,
        c::MAX_VERTEX_OUTPUT_COMPONENTS,
        c::MAX_GEOMETRY_INPUT_COMPONENTS,
        c::MAX_GEOMETRY_OUTPUT_COMPONENTS,
        c::MAX_GEOMETRY_OUTPUT_VERTICES,
        c::MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS,
        c::MAX_GEOMETRY_SHADER_INVOCATIONS,
    ];
    let fake = |extensions: &[&'static str]| {
        let fake = Fake::new().extensions(extensions.iter().copied());
        names.iter().zip(11..).fold(fake, |fake, (&name, value)| {
            fake.limit(name, &[f64::from(value)])
        })
    };
    let expected = Limits {
        glsl: 450,
        clip_distances: 11,
        vertex_output_components: 12,
        geometry_input_components: 13,
        geometry_output_components: 14,
        geometry_output_vertices: 15,
        geometry_total_output_components: 16,
        geometry_invocations: 17,
        gpu_shader5: false,
        vertex_layer: None,
    };
    assert_eq!(limits(&fake(&[]).gl(), 450), expected);
    let older = |glsl, geometry_invocations| Limits {
        glsl,
        geometry_invocations,
        ..expected
    };
    assert_eq!(limits(&fake(&[]).gl(), 400), older(400, 17));
    assert_eq!(limits(&fake(&[]).gl(), 330), older(330, 0));
    assert_eq!(limits(&fake(&[]).gl(), 150), older(150, 0));
    let five = Limits {
        gpu_shader5: true,
        ..older(330, 17)
    };
    let gpu_shader5 = fake(&["GL_ARB_gpu_shader5"]);
    assert_eq!(limits(&gpu_shader5.gl(), 330), five);
    // Without geometry shaders, no limit is asked for.
    let none = |glsl| Limits {
        glsl,
        ..Limits::default()
    };
    assert_eq!(limits(&fake(&[]).gl(), 140), none(140));
    let embedded = fake(&[]).es(3, 2);
    assert_eq!(limits(&embedded.gl(), 320), none(320));
    let layers = [
        VertexLayer::ArbShaderViewportLayerArray,
        VertexLayer::AmdVertexShaderLayer,
    ];
    for layer in layers {
        let layered = fake(&[layer.extension()]);
        assert_eq!(limits(&layered.gl(), 450).vertex_layer, Some(layer));
    }
    let both = fake(&layers.map(VertexLayer::extension));
    assert_eq!(limits(&both.gl(), 450).vertex_layer, Some(layers[0]));
}

#[test]
fn tessellation_stays_within_the_corners_of_a_draw() {
    let fake = Fake::new();
    let gl = fake.gl();
    assert_eq!(Driver::ask(&gl).level(u64::MAX), 1);
    assert_eq!(Driver::ask(&gl).level(0), LEVELS);
    assert_eq!(Driver::ask(&gl).level(1), LEVELS);
    let fake = Fake::new().renderer("llvmpipe (LLVM 15)");
    let gl = fake.gl();
    let driver = Driver::ask(&gl);
    // A patch at level n has (n + 1)² vertices, of which there may be 65,535.
    for (patches, level) in [(655, 9), (656, 8), (40_000, 1), (65_535, 1), (1_000_000, 1)] {
        assert_eq!(driver.level(patches), level, "{patches}");
    }
}
