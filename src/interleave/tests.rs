//! The CPU reference against pictures that are easy to reason about; the shaders' translation.
#![forbid(unsafe_code)]

use super::reference::{ReferenceError, anaglyph, arrange, filtered, interleave};
use super::shader::*;
use super::*;
use crate::atlas::{Grid, Tiles, ViewSet};
use crate::config::{Filter, Glasses, Mixture};
use crate::display::{Display, GUARD, Mask, Placement};
use crate::view::ViewIndex;
use image::{GrayImage, Rgb, RgbImage, Rgba, RgbaImage};
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, RngSeed};

fn seeded(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(20_26),
        rng_algorithm: RngAlgorithm::ChaCha,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Every subpixel of every view has a value of its own, as far as 8 bits allow.
fn tiles(views: u32, width: u32, height: u32) -> Vec<RgbImage> {
    (0..views)
        .map(|view| {
            RgbImage::from_fn(width, height, |x, y| {
                Rgb([0, 1, 2].map(|c| (view * 53 + x * 7 + y * 29 + c * 101) as u8))
            })
        })
        .collect()
}

#[test]
fn equal_sizes_show_the_texels_themselves() {
    let views = tiles(8, 32, 20);
    let mask = Display::default()
        .mask(&Placement::full_screen(32, 20), 8)
        .unwrap();
    let got = interleave(&views, &mask).unwrap();
    for (x, y, pixel) in got.enumerate_pixels() {
        let shown = mask.at(x, y).unwrap();
        for c in 0..3 {
            assert_eq!(
                pixel.0[c],
                views[usize::from(shown[c])].get_pixel(x, y).0[c]
            );
        }
    }
}

#[test]
fn guards_are_black_and_alpha_is_ignored() {
    let tile = RgbaImage::from_pixel(2, 1, Rgba([10, 20, 30, 0]));
    let mask = Mask::new(2, 1, vec![[0, GUARD, 0], [GUARD, 0, GUARD]]).unwrap();
    let got = interleave(&[tile], &mask).unwrap();
    assert_eq!(got.as_raw(), &[10, 0, 30, 0, 20, 0]);
}

#[test]
fn smaller_tiles_are_bilinear_and_clamped() {
    let tile = RgbImage::from_raw(2, 1, vec![0, 0, 0, 200, 100, 50]).unwrap();
    let got = arrange(&[tile], Layout::View(0), (4, 2)).unwrap();
    // Pixel centres at -1/4, 1/4, 3/4 and 5/4 texels from the centre of the first one.
    let row = [0, 0, 0, 50, 25, 13, 150, 75, 38, 200, 100, 50];
    assert_eq!(got.as_raw()[..12], row, "12.5 and 37.5 round up");
    assert_eq!(got.as_raw()[12..], row);
}

#[test]
fn quilts_begin_bottom_left() {
    let views: Vec<_> = (0..5)
        .map(|i| RgbImage::from_pixel(3, 2, Rgb([10 + i; 3])))
        .collect();
    let layout = Layout::quilt(5, None);
    assert_eq!(
        layout,
        Layout::Quilt {
            columns: 3,
            rows: 2
        }
    );
    let size = layout.native_size(5, (3, 2));
    assert_eq!(size, (9, 4));
    let got = arrange(&views, layout, size).unwrap();
    let at = |x, y| got.get_pixel(x, y).0[0];
    assert_eq!([at(0, 3), at(3, 3), at(8, 2)], [10, 11, 12]);
    assert_eq!(
        [at(2, 1), at(5, 0), at(6, 0)],
        [13, 14, 0],
        "the last cell stays black"
    );

    let row = arrange(&views, Layout::SideBySide { half: false }, (15, 2)).unwrap();
    for x in 0..15 {
        assert_eq!(u32::from(row.get_pixel(x, 1).0[0]), 10 + x / 3);
    }
    let one = arrange(&views, Layout::View(3), (3, 2)).unwrap();
    assert_eq!(one, views[3]);
}

#[test]
fn quilt_shapes() {
    let shapes = [
        (1, 1, 1),
        (2, 2, 1),
        (5, 3, 2),
        (6, 3, 2),
        (7, 3, 3),
        (8, 4, 2),
        (9, 3, 3),
    ];
    let more = [
        (17, 5, 4),
        (45, 9, 5),
        (48, 8, 6),
        (66, 11, 6),
        (72, 9, 8),
        (16, 4, 4),
    ];
    for (views, columns, rows) in shapes.into_iter().chain(more) {
        assert_eq!(
            Layout::quilt(views, None),
            Layout::Quilt { columns, rows },
            "{views} views"
        );
    }
    for views in 1..500 {
        let (columns, rows) = Layout::quilt(views, None).grid(views);
        assert!(columns * rows >= views && columns * (rows - 1) < views && columns <= 2 * rows);
        let mut seen: Vec<_> = (0..rows)
            .flat_map(|row| (0..columns).map(move |column| (column, row)))
            .filter_map(|(column, row)| Layout::quilt(views, None).view_at(column, row, views))
            .collect();
        seen.sort_unstable();
        assert_eq!(seen, (0..views).collect::<Vec<_>>());
    }
    assert_eq!(Layout::SideBySide { half: false }.view_at(0, 1, 4), None);
    assert_eq!(Layout::View(3).view_at(0, 0, 4), Some(3));
}

#[test]
fn messages() {
    let small = Mask::new(2, 2, vec![[4; 3]; 4]).unwrap();
    let mut odd = tiles(3, 4, 4);
    odd.push(RgbImage::new(4, 5));
    let errors: [ReferenceError; 6] = [
        interleave::<Rgb<u8>>(&[], &small).unwrap_err(),
        interleave(&odd, &small).unwrap_err(),
        interleave(&[GrayImage::new(2, 2)], &small).unwrap_err(),
        interleave(&tiles(3, 2, 2), &small).unwrap_err(),
        arrange(&tiles(3, 2, 2), Layout::View(3), (2, 2)).unwrap_err(),
        arrange(&tiles(3, 2, 2), Layout::SideBySide { half: false }, (0, 2)).unwrap_err(),
    ];
    let mut said: Vec<String> = errors.iter().map(ToString::to_string).collect();
    for version in [GlslVersion::Desktop(120), GlslVersion::Embedded(100)] {
        let error = translate(Pass::Layout, Stage::Vertex, version).unwrap_err();
        said.push(error.to_string());
    }
    insta::assert_snapshot!(said.join("\n"));
}

proptest! {
    #![proptest_config(seeded(60))]

    /// Bilinear in f64, written another way.
    #[test]
    fn resampling_is_bilinear(
        tile in (1u32..9, 1u32..9), cells in (1u32..4, 1u32..4), size in (1u32..30, 1u32..30),
    ) {
        let views = cells.0 * cells.1;
        let pictures = tiles(views, tile.0, tile.1);
        let layout = Layout::Quilt { columns: cells.0, rows: cells.1 };
        let got = arrange(&pictures, layout, size).unwrap();
        for (x, y, pixel) in got.enumerate_pixels() {
            let along = |at: u32, size: u32, cells: u32, texels: u32| {
                let place = (f64::from(at) + 0.5) / f64::from(size) * f64::from(cells);
                // Centres on the edge between two cells belong to the right or lower one.
                let cell = (place + 1e-9).floor();
                let texel = ((place - cell) * f64::from(texels) - 0.5).clamp(0.0, f64::from(texels - 1));
                (cell as u32, texel)
            };
            let (column, u) = along(x, size.0, cells.0, tile.0);
            let (row, v) = along(y, size.1, cells.1, tile.1);
            let view = &pictures[((cells.1 - 1 - row) * cells.0 + column) as usize];
            for c in 0..3 {
                let at = |x: f64, y: f64| {
                    let (x, y) = (x.min(f64::from(tile.0 - 1)), y.min(f64::from(tile.1 - 1)));
                    f64::from(view.get_pixel(x as u32, y as u32).0[c])
                };
                let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
                let expected = mix(
                    mix(at(u.floor(), v.floor()), at(u.floor() + 1.0, v.floor()), u.fract()),
                    mix(at(u.floor(), v.floor() + 1.0), at(u.floor() + 1.0, v.floor() + 1.0), u.fract()),
                    v.fract(),
                );
                prop_assert!((expected - f64::from(pixel.0[c])).abs() <= 0.5 + 1e-6);
            }
        }
    }
}

#[test]
fn every_pass_translates_for_every_version() {
    for pass in Pass::OUTPUTS {
        for version in GlslVersion::SUPPORTED {
            let fragment = translate(pass, Stage::Fragment, version).unwrap();
            let line = match version {
                GlslVersion::Desktop(number @ ..150) => format!("#version {number}\n"),
                GlslVersion::Desktop(number) => format!("#version {number} core\n"),
                GlslVersion::Embedded(number) => format!("#version {number} es\n"),
            };
            assert!(fragment.source.starts_with(&line), "{}", fragment.source);
            let units: Vec<_> = fragment.textures.iter().map(|t| t.unit).collect();
            let expected: &[u32] = match pass {
                Pass::Interleave | Pass::Texels(_) | Pass::SampleAligned(_) => {
                    &[VIEWS_UNIT, MASK_UNIT]
                }
                Pass::Rgbd => &[VIEWS_UNIT, DEPTH_UNIT],
                _ => &[VIEWS_UNIT],
            };
            assert_eq!(units, expected);
            for texture in &fragment.textures {
                assert!(fragment.source.contains(&format!(" {};", texture.name)));
            }
            assert_eq!(fragment.uniforms.len(), 30);
            assert!(!fragment.source.contains("std140"), "no uniform block");

            let vertex = translate(pass, Stage::Vertex, version).unwrap();
            assert!(vertex.source.starts_with(&line));
            assert!(
                !vertex.source.contains("-gl_Position.y"),
                "nothing is flipped"
            );
            assert_eq!((vertex.textures, vertex.uniforms), (vec![], vec![]));
        }
    }
}

#[test]
fn uniforms_are_found_by_name() {
    let uniforms = Uniforms {
        tiles: Tiles {
            views: 10,
            window: [1, 2],
            grid: Grid {
                across: 5.0,
                shear: 6.0,
                up: 7.0,
                origin: [8.0, 9.0],
                step: [10.0, 11.0],
                exact: true,
            },
            shown: ViewSet::ALL,
            width: 1,
            height: 2,
            stride: 3,
            columns: 9,
            rows: 1,
        },
        picture: [5, 6],
        layout: Layout::Quilt {
            columns: 7,
            rows: 8,
        },
        rows_top_down: true,
        linear: false,
        mask: MaskUniforms {
            filter: Filter::Gaussian,
            period: [11, 12],
            column_bits: 13,
            black: 14,
        },
        matrices: ([[1.0; 3]; 3], [[2.0; 3]; 3]),
        depth: [3.0, 4.0],
        disparities: Disparities {
            scale: 21.0,
            offset: 22.0,
            far: 23.0,
            cleared: Cleared {
                depth: 24.0,
                sky: true,
            },
            baselines: [25.0, 26.0],
            margin: 27.0,
            aim: (2, 28),
            marked: true,
            before: [33.0, 34.0, 35.0, -1.0],
            sources: Some(Sources::spread(ViewIndex(1), 3, 2)),
            places: Places::One([31, 32, 0]),
            reach: 30.0,
        },
    };
    let version = GlslVersion::Desktop(330);
    let got = translate(Pass::Layout, Stage::Fragment, version).unwrap();
    let words = uniforms.words();
    let of: Vec<_> = got
        .uniforms
        .iter()
        .map(|slot| {
            (
                slot.name.rsplit('.').next().unwrap(),
                slot.of(&words).unwrap(),
            )
        })
        .collect();
    let (one, two) = (1.0f32.to_bits(), 2.0f32.to_bits());
    let (left, right) = ([one, one, one, 0], [two, two, two, 0]);
    // By the pixels of the picture, 5 x 6, and not by those of the window, 1 x 2.
    let column = [5.0f32 / 5.0, 6.0 * 2.0 / 6.0, 8.0, 10.0].map(f32::to_bits);
    let row = [0.0f32, 7.0 * 2.0 / 6.0, 9.0, 11.0].map(f32::to_bits);
    let expected: [(&str, &[u32]); 18] = [
        ("tile", &[1, 2]),
        ("picture", &[5, 6]),
        ("grid", &[7, 8]),
        ("stride", &[3]),
        ("columns", &[9]),
        ("views", &[10]),
        ("first", &[0]),
        ("rows_top_down", &[1]),
        ("cells_from_top", &[0]),
        ("linear", &[0]),
        ("filtered", &[2]),
        ("period", &[11, 12]),
        ("column_bits", &[13]),
        ("black", &[14]),
        ("left_red", &left),
        ("left_green", &left),
        ("left_blue", &left),
        ("right_red", &right),
    ];
    assert_eq!(of[..18], expected);
    let ends = [3.0f32.to_bits(), 4.0f32.to_bits(), 0, 0];
    assert_eq!(of[20], ("depth", &ends[..]));
    assert_eq!(of[21], ("column", &column[..]));
    assert_eq!(of[22], ("row", &row[..]));
    let rows = [
        [21.0f32, 22.0, 23.0, 24.0],
        [25.0, 26.0, 0.0, 27.0],
        [2.0, 28.0, 1.0, 208.0],
        [30.0, 31.0, 32.0, 0.0],
        [1.0, 2.0, 1e9, 1e9],
        [1e9; 4],
        [33.0, 34.0, 35.0, -1.0],
    ];
    let names = [
        "disparity",
        "baseline",
        "aim",
        "occlusion",
        "sources_low",
        "sources_high",
        "before",
    ];
    for (at, (name, row)) in names.into_iter().zip(rows).enumerate() {
        assert_eq!(of[23 + at], (name, &row.map(f32::to_bits)[..]));
    }
}

#[test]
fn columns_of_views_begin_on_top() {
    let views: Vec<_> = (0..3)
        .map(|i| RgbImage::from_pixel(4, 2, Rgb([10 + i; 3])))
        .collect();
    let layout = Layout::TopBottom { half: false };
    assert_eq!(layout.native_size(3, (4, 2)), (4, 6));
    let got = arrange(&views, layout, (4, 6)).unwrap();
    let column: Vec<u8> = (0..6).map(|y| got.get_pixel(2, y).0[0]).collect();
    assert_eq!(column, [10, 10, 11, 11, 12, 12]);
    for layout in [
        Layout::TopBottom { half: true },
        Layout::SideBySide { half: true },
    ] {
        assert_eq!(layout.native_size(2, (4, 2)), (4, 2));
    }
}

/// Grey views of 0, 100 and 200 under a mask that steps through all places between them.
#[test]
fn filters_at_places_between_views() {
    let tile = |value| RgbImage::from_pixel(1, 1, Rgb([value; 3]));
    let views = [tile(0), tile(100), tile(200)];
    let shown = |step: u16, filter| {
        let mask = Mask::new(1, 1, vec![[step; 3]]).unwrap();
        filtered(&views, &mask, filter).unwrap().get_pixel(0, 0).0[0]
    };
    // The middle of a view lies between two steps, so blending takes nearly that view alone: half a step adds a 512th of the light of
    // 100, which is 0.127. Beyond the ends there is no view.
    assert_eq!(
        [0, 127, 128].map(|step| shown(step, Filter::Blend)),
        [0, 0, 1]
    );
    assert_eq!(shown(256 + 127, Filter::Blend), 100);
    assert_eq!(
        [512 + 128, 767].map(|step| shown(step, Filter::Blend)),
        [200, 200]
    );
    // Halfway from 100 to 200 is the mean of their light: 0.127 and 0.578 give 0.352, which is 161.
    assert!((160..=162).contains(&shown(511, Filter::Blend)));
    // A view's neighbours have a quarter of its weight: (0.127 + 0.249 (0 + 0.578)) / 1.499 is 0.181, which is 118.
    assert!((117..=119).contains(&shown(256 + 128, Filter::Gaussian)));
    let flat = [tile(90), tile(90), tile(90)];
    for step in (0..768).step_by(7) {
        let mask = Mask::new(1, 1, vec![[step, step, GUARD]]).unwrap();
        for filter in [Filter::Blend, Filter::Gaussian] {
            let shown = filtered(&flat, &mask, filter).unwrap().get_pixel(0, 0).0;
            assert_eq!(shown, [90, 90, 0], "{filter:?} {step}");
        }
    }
}

/// White through both glasses is white: the rows of both matrices add up to 1.
#[test]
fn anaglyphs_keep_white_and_separate_the_eyes() {
    let white = RgbImage::from_pixel(1, 1, Rgb([255; 3]));
    let black = RgbImage::from_pixel(1, 1, Rgb([0; 3]));
    let both = |kind, left: &RgbImage, right: &RgbImage| {
        let views = [left.clone(), white.clone(), right.clone()];
        anaglyph(&views, kind, (1, 1)).unwrap().get_pixel(0, 0).0
    };
    for glasses in [Glasses::RedCyan, Glasses::GreenMagenta, Glasses::AmberBlue] {
        let left_glass = match glasses {
            Glasses::RedCyan => [255, 0, 0],
            Glasses::GreenMagenta => [0, 255, 0],
            Glasses::AmberBlue => [255, 255, 0],
        };
        for mixture in [Mixture::Grey, Mixture::HalfColour] {
            let kind = Anaglyph { glasses, mixture };
            assert_eq!(both(kind, &white, &white), [255; 3]);
            assert_eq!(both(kind, &white, &black), left_glass);
            assert_eq!(both(kind, &black, &white), left_glass.map(|v| 255 - v));
        }
        let kind = Anaglyph {
            glasses,
            mixture: Mixture::Dubois,
        };
        let shown = both(kind, &white, &white);
        assert!(
            shown.iter().all(|&value| value >= 254),
            "{kind:?} {shown:?}"
        );
        let (left, right) = kind.matrices();
        for (left, right) in left.iter().zip(right) {
            let sum: f32 = left.iter().chain(&right).sum();
            assert!((sum - 1.0).abs() < 0.0025, "{kind:?}: {sum}");
        }
    }
    // One view by hand: the luminance of red in linear light is 0.2126.
    let red = RgbImage::from_pixel(1, 1, Rgb([255, 0, 0]));
    let half = |glasses| Anaglyph {
        glasses,
        mixture: Mixture::HalfColour,
    };
    assert_eq!(both(half(Glasses::RedCyan), &red, &black), [127, 0, 0]);
    assert_eq!(both(half(Glasses::RedCyan), &black, &red), [0, 0, 0]);
    assert_eq!(both(half(Glasses::AmberBlue), &red, &black), [255, 0, 0]);
    assert_eq!(both(half(Glasses::GreenMagenta), &black, &red), [255, 0, 0]);
}

#[test]
fn dubois_is_as_published() {
    // Products with single colours are the columns of the tables.
    let of = |glasses| {
        let kind = Anaglyph {
            glasses,
            mixture: Mixture::Dubois,
        };
        let (left, right) = kind.matrices();
        let thousandths = |m: Matrix| m.map(|row| row.map(|v| (v * 1000.0).round() as i32));
        (thousandths(left), thousandths(right))
    };
    assert_eq!(
        of(Glasses::RedCyan),
        (
            [[437, 449, 164], [-62, -62, -24], [-48, -50, -17]],
            [[-11, -32, -7], [377, 761, 9], [-26, -93, 1234]]
        )
    );
    assert_eq!(
        of(Glasses::GreenMagenta),
        (
            [[-62, -158, -39], [284, 668, 143], [-15, -27, 21]],
            [[529, 705, 24], [-16, -15, -65], [9, 75, 937]]
        )
    );
    assert_eq!(
        of(Glasses::AmberBlue),
        (
            [[1062, -205, 299], [-26, 908, 68], [-38, -173, 22]],
            [[-16, -123, -17], [6, 62, -17], [94, 185, 911]]
        )
    );
}

#[test]
fn contexts_get_the_nearest_version_below() {
    use GlslVersion::{Desktop, Embedded};
    assert_eq!(Desktop(459).for_context(), Some(Desktop(450)));
    assert_eq!(Desktop(999).for_context(), Some(Desktop(460)));
    assert_eq!(Desktop(120).for_context(), None);
    assert_eq!(Embedded(310).for_context(), Some(Embedded(310)));
    assert_eq!(Embedded(100).for_context(), None);
}

#[test]
fn glsl_of_the_panel_pass() {
    let version = GlslVersion::Desktop(140);
    let got = translate(Pass::Interleave, Stage::Fragment, version);
    insta::assert_snapshot!(got.unwrap().source);
}

#[test]
fn glsl_of_the_texels_pass() {
    let pass = Pass::Texels(Texels::SubpixelsOfOneLayer);
    let got = translate(pass, Stage::Fragment, GlslVersion::Desktop(140));
    insta::assert_snapshot!(got.unwrap().source);
}

#[test]
fn glsl_of_the_layout_pass() {
    let version = GlslVersion::Embedded(300);
    let got = translate(Pass::Layout, Stage::Fragment, version).unwrap();
    let vertex = translate(Pass::Layout, Stage::Vertex, version).unwrap();
    insta::assert_snapshot!(format!("{}\n{}", vertex.source, got.source));
}
