//! A variant of the program's own shaders.

use super::super::{Drawn, NoVariant, Variant, VariantKind, drawn};
use super::Stage;
use crate::atlas::Grid;
use crate::config::AtlasLayout::SideBySide;
use crate::gl::{Gl, ProgramName, ShaderName, consts as c};
use crate::plan::Flat;
use crate::rewrite::{Stage as Shader, VertexLayer};
use crate::state::ShaderSource;
use crate::view::ViewIndex;
use std::sync::Arc;

const VERTEX: &str = "#version 150\nuniform mat4 camera;\nuniform vec4 lamps[2];\nin vec4 at;\nvoid main() { gl_Position = camera * at + lamps[1]; }\n";
const FRAGMENT: &str = "#version 150\nuniform sampler2D map;\nout vec4 colour;\nvoid main() { colour = texture(map, vec2(0.5)); }\n";

fn shaders<const K: usize>(all: [(u32, Shader, &str); K]) -> [ShaderSource; K] {
    all.map(|(kind, stage, source)| ShaderSource {
        kind,
        stage,
        source: source.into(),
    })
}

fn sources() -> [ShaderSource; 2] {
    shaders([
        (c::VERTEX_SHADER, Shader::Vertex, VERTEX),
        (c::FRAGMENT_SHADER, Shader::Fragment, FRAGMENT),
    ])
}

/// The program's own program object, in use, with values for its uniforms.
pub(super) fn program(stage: &mut Stage) -> ProgramName {
    let mut name = ProgramName::ZERO;
    stage.program(|gl| {
        let compiled =
            sources().map(|shader| gl.compile(shader.kind, shader.source).expect("compiles"));
        name = gl.link(&compiled).expect("links");
        gl.use_program(name);
        gl.set_uniform_matrix(0, &[0.5; 16]);
        gl.uniform_4fv(1, &[[1.0; 4], [2.0; 4]]);
        gl.uniform_1i(3, 7);
    });
    name
}

pub(super) fn variant(stage: &Stage, program: ProgramName, kind: VariantKind) -> Arc<Variant> {
    match drawn(&stage.gl, program, &sources(), kind) {
        Ok(Drawn::ByVariant(variant)) => variant,
        other => panic!("{other:?}"),
    }
}

#[test]
fn it_is_linked_beside_the_program_and_has_its_values() {
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    let program = program(&mut stage);
    let before = stage.fake.state();
    let variant = variant(&stage, program, VariantKind::Alone);
    stage.fake.assert_restored(&before);
    // Its attributes lie where the program's arrays are.
    let places = stage.fake.lines("glBindAttribLocation*");
    assert_eq!(places.len(), 1, "{places:?}");
    let gl = stage.gl;
    gl.use_program(variant.name());
    stage.fake.forget();
    variant.copy_uniforms(&gl, program, 0);
    let value = |name| stage.fake.uniform(variant.name(), name);
    assert_eq!(value("camera"), [0.5; 16]);
    assert_eq!(
        (value("lamps[0]"), value("lamps[1]")),
        (vec![1.0; 4], vec![2.0; 4])
    );
    assert_eq!(value("map"), [7.0]);
    // One query and one upload for each value: this program has four.
    assert_eq!(
        (
            stage.fake.count("glGetUniform*"),
            stage.fake.count("glUniform*")
        ),
        (4, 4)
    );
    variant.set_matrix(&gl, 0, &[0.25; 16]);
    assert_eq!(stage.fake.uniform(variant.name(), "camera"), [0.25; 16]);
    gl.use_program(program);
    stage.fake.assert_restored(&before);
}

#[test]
fn the_views_that_follow_are_placed_by_uniforms_alone() {
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    let program = program(&mut stage);
    let layers = VertexLayer::ArbShaderViewportLayerArray;
    let gl = stage.gl;
    let shifts = (stage.shear(), Flat::Still);
    for (kind, views) in [
        (VariantKind::Alone, 1),
        (VariantKind::Layer(layers), 1),
        (VariantKind::Instances(layers, 4), 4),
    ] {
        let variant = variant(&stage, program, kind);
        gl.use_program(variant.name());
        stage.fake.forget();
        let places: Vec<f64> = ViewIndex::all(views)
            .map(|view| stage.rig.position(view))
            .collect();
        variant.set_views(&gl, shifts, &places, 64);
        let sent = stage.fake.calls();
        assert!(
            sent.iter().all(|call| call.name == "glUniform4fv"),
            "{sent:?}"
        );
        let shift = sent[0].args[2].clone();
        let expected = places.iter().flat_map(|place| {
            let separation = 0.25 * place;
            [separation, separation * 2.0, 0.0, 0.0]
        });
        assert_eq!(
            shift,
            crate::gl::fake::Arg::Data(expected.collect()),
            "{kind:?}"
        );
    }
}

#[test]
fn what_the_driver_refuses_leaves_no_names() {
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    let program = program(&mut stage);
    let (before, names) = (stage.fake.state(), stage.fake.alive(["Programs"]));
    stage.fake.refuse_shaders("mv_");
    let refused = drawn(&stage.gl, program, &sources(), VariantKind::Alone);
    assert!(
        matches!(&refused, Err(NoVariant::Driver(log)) if log.contains("refused")),
        "{refused:?}"
    );
    assert_eq!(stage.fake.alive(["Programs"]), names);
    stage.fake.assert_restored(&before);
}

#[test]
fn programs_without_a_variant_say_why() {
    let stage = Stage::new(SideBySide, Grid::FULL);
    let refusal = |sources: &[ShaderSource]| {
        drawn(&stage.gl, ProgramName(1), sources, VariantKind::Alone).expect_err("none")
    };
    let [vertex, fragment] = sources();
    assert!(matches!(refusal(&[]), NoVariant::NoSource));
    let alone = refusal(std::slice::from_ref(&fragment));
    assert!(matches!(alone, NoVariant::NoVertex));
    let compute = ShaderSource {
        stage: Shader::Compute,
        ..fragment.clone()
    };
    assert!(matches!(refusal(&[vertex, compute]), NoVariant::Computes));
    assert_eq!(stage.fake.count("gl*"), 0, "nothing is asked for that");
}

/// A program of the context, linked from these sources.
fn linked(stage: &mut Stage, sources: &[ShaderSource]) -> ProgramName {
    let compile =
        |gl: &Gl, shader: &ShaderSource| gl.compile(shader.kind, &shader.source).expect("compiles");
    let mut name = ProgramName::ZERO;
    stage.program(|gl| {
        let shaders: Vec<ShaderName> = sources.iter().map(|shader| compile(gl, shader)).collect();
        name = gl.link(&shaders).expect("links");
    });
    name
}

#[test]
fn rays_are_distorted_for_one_colour_of_a_vertex_shader() {
    let two = FRAGMENT.replace("out vec4 colour;", "out vec4 colour;\nout vec4 more;");
    let built_in = "#version 120\nvoid main() { gl_FragColor = vec4(1.0); }\n";
    let stores = "#version 420\nlayout(rgba8) uniform image2D im;\nout vec4 colour;\nvoid main() { imageStore(im, ivec2(0), vec4(1.0)); colour = vec4(1.0); }\n";
    let old = VERTEX
        .replace("150", "120")
        .replace("in vec4", "attribute vec4");
    let [vertex, fragment] = sources();
    let with = |like: &ShaderSource, source: &str| ShaderSource {
        source: source.into(),
        ..like.clone()
    };
    let pair = |source: &str| [vertex.clone(), with(&fragment, source)];
    let of = std::mem::discriminant::<NoVariant>;
    let cases = [
        (pair(FRAGMENT), None),
        (pair(&two), Some(of(&NoVariant::Outputs))),
        ([with(&vertex, &old), with(&fragment, built_in)], None),
        (pair(stores), Some(of(&NoVariant::Effects))),
    ];
    for (sources, reason) in cases {
        let mut stage = Stage::new(SideBySide, Grid::FULL);
        let program = linked(&mut stage, &sources);
        let made = |kind| drawn(&stage.gl, program, &sources, kind);
        assert!(matches!(made(VariantKind::Alone), Ok(Drawn::ByVariant(_))));
        let distorted = made(VariantKind::DistortedRays);
        // That would be an error.
        let bound = stage.fake.lines("glBindFragDataLocation*");
        assert!(!bound.concat().contains("gl_"), "{bound:?}");
        match reason {
            None => assert!(
                matches!(distorted, Ok(Drawn::ByVariant(_))),
                "{distorted:?}"
            ),
            Some(reason) => assert_eq!(of(&distorted.expect_err("none")), reason),
        }
    }
}

#[test]
fn the_last_stage_before_the_fragments_moves_the_vertices() {
    let evaluation = "#version 400\nlayout(quads) in;\nuniform mat4 camera;\nvoid main() { gl_Position = camera * vec4(gl_TessCoord, 1.0); }\n";
    let vertex = "#version 400\nin vec4 at;\nvoid main() { gl_Position = at; }\n";
    let sources = [
        (c::VERTEX_SHADER, Shader::Vertex, vertex),
        (
            c::TESS_EVALUATION_SHADER,
            Shader::TessEvaluation,
            evaluation,
        ),
    ]
    .map(|(kind, stage, source)| ShaderSource {
        kind,
        stage,
        source: source.into(),
    });
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    let program = linked(&mut stage, &sources);
    let made = |kind| drawn(&stage.gl, program, &sources, kind);
    let refused = made(VariantKind::DistortedRays);
    assert!(matches!(refused, Err(NoVariant::Stages)), "{refused:?}");
    stage.fake.forget();
    assert!(matches!(made(VariantKind::Alone), Ok(Drawn::ByVariant(_))));
    let sources = stage.fake.calls();
    let sources: Vec<String> = sources
        .iter()
        .filter(|call| call.name == "glShaderSource")
        .map(|call| format!("{call:?}"))
        .collect();
    assert_eq!(sources.len(), 2);
    assert!(
        !sources[0].contains("mv_") && sources[1].contains("mv_"),
        "{sources:?}"
    );
}

#[test]
fn places_in_the_window_are_sent_to_those_who_ask() {
    let asks = FRAGMENT.replace("vec2(0.5)", "gl_FragCoord.xy");
    let [vertex, fragment] = sources();
    let asking = ShaderSource {
        source: asks.into(),
        ..fragment.clone()
    };
    for (fragment, sent) in [(fragment, 1), (asking, 3)] {
        let sources = [vertex.clone(), fragment];
        let mut stage = Stage::new(SideBySide, Grid::FULL);
        let program = linked(&mut stage, &sources);
        let variant = match drawn(&stage.gl, program, &sources, VariantKind::Alone) {
            Ok(Drawn::ByVariant(variant)) => variant,
            other => panic!("{other:?}"),
        };
        let gl = stage.gl;
        gl.use_program(variant.name());
        stage.fake.forget();
        variant.set_views(&gl, (stage.shear(), Flat::Still), &[0.5], 64);
        assert_eq!(stage.fake.count("glUniform4fv"), sent);
    }
}

#[test]
fn a_variant_is_told_the_layers_of_its_views() {
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    let program = program(&mut stage);
    let layers = VertexLayer::ArbShaderViewportLayerArray;
    let gl = stage.gl;
    for (kind, chosen) in [
        (VariantKind::Layer(layers), &[3][..]),
        (VariantKind::Instances(layers, 4), &[2, 0, 3, 1]),
    ] {
        let variant = variant(&stage, program, kind);
        gl.use_program(variant.name());
        stage.fake.forget();
        variant.set_layers(&gl, chosen);
        let sent = stage.fake.calls();
        let tiles = chosen
            .iter()
            .flat_map(|&layer| [0.0, 0.0, f64::from(layer), 0.0]);
        assert_eq!(
            sent[0].args[2],
            crate::gl::fake::Arg::Data(tiles.collect()),
            "{kind:?}: {sent:?}"
        );
    }
}

/// The matrices of fixed function in any stage before the last place the vertices, so they are what differs between the views.
#[test]
fn a_projection_of_fixed_function_counts_in_every_stage() {
    const FIRST: &str = "#version 150 compatibility\nvoid main() { gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex; }\n";
    const PLAIN: &str =
        "#version 150 compatibility\nin vec4 at;\nvoid main() { gl_Position = at; }\n";
    const GEOMETRY: &str = "#version 150 compatibility\nlayout(triangles) in;\nlayout(triangle_strip, max_vertices = 3) out;\nvoid main() { for (int i = 0; i < 3; i++) { gl_Position = gl_in[i].gl_Position; EmitVertex(); } }\n";
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    let program = program(&mut stage);
    for (vertex, by_matrix) in [(FIRST, true), (PLAIN, false)] {
        let sources = shaders([
            (c::VERTEX_SHADER, Shader::Vertex, vertex),
            (c::GEOMETRY_SHADER, Shader::Geometry, GEOMETRY),
            (c::FRAGMENT_SHADER, Shader::Fragment, FRAGMENT),
        ]);
        let made = drawn(&stage.gl, program, &sources, VariantKind::Alone);
        assert_eq!(matches!(made, Ok(Drawn::ByMatrix)), by_matrix, "{made:?}");
    }
}
