//! The translation of the passes of synthesis and accumulation, and what no pass may contain.
#![forbid(unsafe_code)]

use super::shader::*;
use crate::config::DisocclusionSource;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Expression, Handle, ScalarKind, TypeInner};

#[test]
fn every_pass_of_synthesis_translates_for_every_version() {
    for pass in Synthesis::ALL {
        let textures: &[u32] = match pass {
            Synthesis::BlockBounds => &[DEPTH_UNIT],
            Synthesis::RowMaxima => &[BLOCK_BOUNDS_UNIT],
            Synthesis::RayRange => &[RAY_RANGE_UNIT, BLOCK_BOUNDS_UNIT],
            Synthesis::Steps => &[DEPTH_UNIT],
            Synthesis::Splats => &[5],
            Synthesis::DistortionMap => &[2, 5, 6],
            Synthesis::View(DisocclusionSource::Nothing | DisocclusionSource::Views) => {
                &[0, 2, 3, 4]
            }
            Synthesis::View(DisocclusionSource::Reference) => &[0, 2, 3, 4, 5, 6, 7, 8],
            Synthesis::Panel {
                source: DisocclusionSource::Nothing | DisocclusionSource::Views,
                ..
            } => &[0, 1, 2, 3, 4],
            Synthesis::Panel {
                source: DisocclusionSource::Reference,
                ..
            } => &[0, 1, 2, 3, 4, 5, 6, 7, 8],
        };
        for version in GlslVersion::SUPPORTED {
            let got = translate(Pass::Synthesis(pass), Stage::Fragment, version).unwrap();
            let units: Vec<_> = got.textures.iter().map(|t| t.unit).collect();
            assert_eq!(units, textures, "{pass:?}");
        }
    }
}

#[test]
fn every_step_of_the_accumulation_buffer_translates_for_every_version() {
    for step in Step::ALL {
        let textures: &[u32] = match step {
            Step::Fill => &[],
            Step::Load => &[0, 2],
            Step::Accumulate => &[0, 1, 2],
            Step::Copy | Step::Multiply | Step::Add => &[1],
            Step::Return => &[1, 2],
        };
        for version in GlslVersion::SUPPORTED {
            let got = translate(Pass::Accumulate(step), Stage::Fragment, version).unwrap();
            let units: Vec<_> = got.textures.iter().map(|t| t.unit).collect();
            assert_eq!(units, textures, "{step:?}");
            let places: Vec<_> = got.uniforms.iter().map(|u| (u.first, u.count)).collect();
            assert_eq!(places, [(0, 4), (4, 4), (8, 4), (12, 1), (13, 1), (14, 1)]);
        }
    }
}

/// Splats read their texture in the vertex stage, and the mask in the other, where a picture is of a panel.
#[test]
fn points_translate_for_every_version() {
    for points in Points::ALL {
        for version in GlslVersion::SUPPORTED {
            let units = |stage| {
                let got = translate(Pass::Points(points), stage, version).unwrap();
                got.textures.iter().map(|t| t.unit).collect::<Vec<_>>()
            };
            assert_eq!(units(Stage::Vertex), [VIEWS_UNIT], "{points:?}");
            let mask: &[u32] = match points {
                Points::View | Points::Group(Group::View) => &[],
                _ => &[MASK_UNIT],
            };
            assert_eq!(units(Stage::Fragment), mask, "{points:?}");
        }
    }
}

/// naga writes a choice by a vector of conditions as `mix`, which takes no integers before GLSL 4.50 and GLSL ES 3.10.
#[test]
fn no_pass_selects_integers_by_component() {
    let mut vectors = 0;
    for pass in Pass::all() {
        let module = naga::front::wgsl::parse_str(&source(pass)).unwrap();
        let info = Validator::new(ValidationFlags::all(), Capabilities::IMMEDIATES)
            .validate(&module)
            .unwrap();
        let functions = module.functions.iter().map(|(at, f)| (f, &info[at]));
        let entries = module.entry_points.iter().enumerate();
        let entries = entries.map(|(at, e)| (&e.function, info.get_entry_point(at)));
        for (function, info) in functions.chain(entries) {
            let of = |expression: Handle<Expression>| info[expression].ty.inner_with(&module.types);
            for (_, expression) in function.expressions.iter() {
                if let Expression::Select {
                    condition, accept, ..
                } = *expression
                    && matches!(of(condition), TypeInner::Vector { .. })
                {
                    let kind = of(accept).scalar_kind();
                    let name = &function.name;
                    assert_eq!(kind, Some(ScalarKind::Float), "{pass:?}, function {name:?}");
                    vectors += 1;
                }
            }
        }
    }
    assert!(vectors > 0, "the passes do select floats so");
}
