//! A variant of the program's own shaders.

use super::super::{Drawn, NoVariant, Variant, VariantKind, drawn};
use super::Stage;
use crate::atlas::Grid;
use crate::config::AtlasLayout::SideBySide;
use crate::gl::consts as c;
use crate::plan::Flat;
use crate::rewrite::{Stage as Shader, VertexLayer};
use crate::state::Text;
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

/// The program's own, in use, with values for its uniforms.
pub(super) fn program(stage: &mut Stage) -> u32 {
    let mut name = 0;
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

pub(super) fn variant(stage: &Stage, program: u32, kind: VariantKind) -> Arc<Variant> {
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
    // One question and one answer for each value: four of this program.
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
        let places: Vec<f64> = (0..views).map(|view| stage.rig.position(view)).collect();
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
        drawn(&stage.gl, 1, texts, VariantKind::Alone)
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
