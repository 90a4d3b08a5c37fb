//! A program's shader, rewritten in each way. Its length tells the stage and the language, so that shaders are seeds as they are.
#![no_main]

use libfuzzer_sys::fuzz_target;
use manyview::rewrite::{Amplifier, Options, Stage, Target, VertexLayer, rewrite};

const TARGETS: [Target; 4] = [
    Target::Whole,
    Target::Layer(VertexLayer::ArbShaderViewportLayerArray),
    Target::Tiles,
    Target::DistortedRays,
];

fuzz_target!(|source: &[u8]| {
    let stage = Stage::ALL[source.len() % Stage::ALL.len()];
    for amplifier in [Amplifier::Replay, Amplifier::Instanced] {
        for target in TARGETS {
            let options = Options {
                amplifier,
                target,
                views: 5,
                es: source.len() / Stage::ALL.len() % 2 == 1,
            };
            let _ = rewrite(source, stage, &options).map_err(|why| why.to_string());
        }
    }
});
