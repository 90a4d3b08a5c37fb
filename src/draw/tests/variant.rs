//! A variant of the program's own shaders.

use super::super::{Drawn, NoVariant, Variant, VariantKind, drawn};
use super::Stage;
use crate::atlas::Grid;
use crate::config::AtlasLayout::SideBySide;
use crate::gl::{Gl, ProgramName, ShaderName, consts as c};
use crate::plan::Flat;
use crate::rewrite::{Stage as Shader, VertexLayer};
use crate::state::Text;
use crate::view::ViewIndex;
use std::sync::Arc;

const VERTEX: &str = "#version 150\nuniform mat4 camera;\nuniform vec4 lamps[2];\nin vec4 at;\nvoid main() { gl_Position = camera * at + lamps[1]; }\n";
const FRAGMENT: &str = "#version 150\nuniform sampler2D map;\nout vec4 colour;\nvoid main() { colour = texture(map, vec2(0.5)); }\n";

fn texts() -> [Text; 2] {
    [
        (c::VERTEX_SHADER, Shader::Vertex, VERTEX),
        (c::FRAGMENT_SHADER, Shader::Fragment, FRAGMENT),
    ]
    .map(|(kind, stage, source)| Text {
        kind,
        stage,
        source: source.into(),
    })
}

/// The program's own program object, in use, with values for its uniforms.
pub(super) fn program(stage: &mut Stage) -> ProgramName {
    let mut name = ProgramName::ZERO;
    stage.program(|gl| {
        let compiled = texts().map(|text| gl.compile(text.kind, text.source).expect("compiles"));
        name = gl.link(&compiled).expect("links");
        gl.use_program(name);
        gl.set_uniform_matrix(0, &[0.5; 16]);
        gl.uniform_4fv(1, &[[1.0; 4], [2.0; 4]]);
        gl.uniform_1i(3, 7);
    });
    name
}

pub(super) fn variant(stage: &Stage, program: ProgramName, kind: VariantKind) -> Arc<Variant> {
    match drawn(&stage.gl, program, &texts(), kind) {
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
    let gl = stage.gl;
    gl.use_program(variant.name());
    stage.fake.forget();
    variant.copy_uniforms(&gl, program);
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
    let refused = drawn(&stage.gl, program, &texts(), VariantKind::Alone);
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
    let refusal = |texts: &[Text]| {
        drawn(&stage.gl, ProgramName(1), texts, VariantKind::Alone)
            .expect_err("none")
            .to_string()
    };
    let [vertex, fragment] = texts();
    assert!(refusal(&[]).contains("not known"));
    assert!(refusal(std::slice::from_ref(&fragment)).contains("no vertex shader"));
    let compute = Text {
        stage: Shader::Compute,
        ..fragment.clone()
    };
    assert!(refusal(&[vertex, compute]).contains("computes"));
    assert_eq!(stage.fake.count("gl*"), 0, "nothing is asked for that");
}

/// A program of the context, linked from these sources.
fn linked(stage: &mut Stage, texts: &[Text]) -> ProgramName {
    let compile = |gl: &Gl, text: &Text| gl.compile(text.kind, &text.source).expect("compiles");
    let mut name = ProgramName::ZERO;
    stage.program(|gl| {
        let shaders: Vec<ShaderName> = texts.iter().map(|text| compile(gl, text)).collect();
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
    let [vertex, fragment] = texts();
    let text = |like: &Text, source: &str| Text {
        source: source.into(),
        ..like.clone()
    };
    let pair = |source: &str| [vertex.clone(), text(&fragment, source)];
    let cases = [
        (pair(FRAGMENT), None),
        (pair(&two), Some("several")),
        ([text(&vertex, &old), text(&fragment, built_in)], None),
        (pair(stores), Some("writes to images")),
    ];
    for (texts, reason) in cases {
        let mut stage = Stage::new(SideBySide, Grid::FULL);
        let program = linked(&mut stage, &texts);
        let made = |kind| drawn(&stage.gl, program, &texts, kind);
        assert!(matches!(made(VariantKind::Alone), Ok(Drawn::ByVariant(_))));
        let distorted = made(VariantKind::DistortedRays);
        match reason {
            None => assert!(
                matches!(distorted, Ok(Drawn::ByVariant(_))),
                "{distorted:?}"
            ),
            Some(words) => {
                let refusal = distorted.expect_err(words).to_string();
                assert!(refusal.contains(words), "{refusal}");
            }
        }
    }
}

#[test]
fn the_last_stage_before_the_fragments_moves_the_vertices() {
    let evaluation = "#version 400\nlayout(quads) in;\nuniform mat4 camera;\nvoid main() { gl_Position = camera * vec4(gl_TessCoord, 1.0); }\n";
    let vertex = "#version 400\nin vec4 at;\nvoid main() { gl_Position = at; }\n";
    let texts = [
        (c::VERTEX_SHADER, Shader::Vertex, vertex),
        (
            c::TESS_EVALUATION_SHADER,
            Shader::TessEvaluation,
            evaluation,
        ),
    ]
    .map(|(kind, stage, source)| Text {
        kind,
        stage,
        source: source.into(),
    });
    let mut stage = Stage::new(SideBySide, Grid::FULL);
    let program = linked(&mut stage, &texts);
    let made = |kind| drawn(&stage.gl, program, &texts, kind);
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
    let [vertex, fragment] = texts();
    let asking = Text {
        source: asks.into(),
        ..fragment.clone()
    };
    for (fragment, sent) in [(fragment, 1), (asking, 3)] {
        let texts = [vertex.clone(), fragment];
        let mut stage = Stage::new(SideBySide, Grid::FULL);
        let program = linked(&mut stage, &texts);
        let variant = match drawn(&stage.gl, program, &texts, VariantKind::Alone) {
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
