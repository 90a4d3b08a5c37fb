//! Masks of `display` against the rays: two derivations that share nothing but the description.
#![forbid(unsafe_code)]

use super::light::Light;
use super::*;
use crate::display::{
    CellPattern, Display, Kind, LookingGlass, Mask, Number, Placement, Slanted, SubpixelOrder,
};
use crate::share;
use image::Rgb;

const SIZE: (u32, u32) = (480, 270);
const DISTANCE: f64 = 600.0;

const SETUP: Setup = Setup {
    pixel: 0.25,
    cone: 40.0,
    crosstalk: 0.0,
    design: None,
};

fn ratio(numerator: i64, denominator: i64) -> Number {
    Number::ratio(numerator, denominator).unwrap()
}

fn slanted(pitch: Number, slant: Number, offset: Number, order: SubpixelOrder) -> Kind {
    Kind::Slanted(Slanted {
        pitch,
        slant,
        offset,
        order,
        ..Slanted::HUEBNER
    })
}

/// The portrait Looking Glass of public numbers, made smaller: its screen has 480x270 pixels of the same size.
fn looking_glass(slope: f64, inverted: bool) -> Kind {
    Kind::LookingGlass(LookingGlass {
        serial: String::new(),
        pitch: 52.594_383_239_746_094,
        slope,
        center: 0.402_773_827_314_376_83,
        view_cone: 40.0,
        vertical_angle: 0.0,
        dpi: 324.0,
        width: 480,
        height: 270,
        inverted,
        flip_x: false,
        flip_y: false,
        flip_subpixels: false,
        fringe: None,
        cells: Vec::new(),
        cell_pattern: CellPattern::One,
    })
}

/// Panels of every kind that has optics, by name and number of views.
fn panels() -> Vec<(String, Display)> {
    let rgb = SubpixelOrder::Rgb;
    let thirds = |order| slanted(ratio(16, 3), ratio(2, 3), ratio(0, 1), order);
    let mut panels: Vec<_> = ["lenticular-5", "lenticular-2", "slanted8", "huebner8"]
        .into_iter()
        .map(|name| (name.to_owned(), Display::named(name).unwrap()))
        .collect();
    for (name, views, kind) in [
        ("huebner, BGR", 8, Kind::Huebner(SubpixelOrder::Bgr)),
        ("huebner of 5", 5, Kind::Huebner(rgb)),
        (
            "Looking Glass",
            9,
            looking_glass(-7.211_529_254_913_33, true),
        ),
        ("Looking Glass, ascending", 9, looking_glass(5.0, false)),
        (
            "16/3, 2/3 in front",
            8,
            Kind::Slanted(Slanted {
                pitch: ratio(16, 3),
                slant: ratio(2, 3),
                inverted: true,
                ..Slanted::HUEBNER
            }),
        ),
        ("16/3, 2/3", 8, thirds(rgb)),
        ("16/3, 2/3, BGR", 8, thirds(SubpixelOrder::Bgr)),
        ("16/3, 2/3 of 9", 9, thirds(rgb)),
        (
            "the other way",
            8,
            slanted(ratio(8, 1), ratio(-2, 3), ratio(7, 5), rgb),
        ),
        (
            "whole steps",
            7,
            slanted(ratio(7, 1), ratio(1, 1), ratio(0, 1), rgb),
        ),
        (
            "decimals",
            9,
            slanted(
                ratio(53_712, 10_000),
                ratio(6_543, 10_000),
                ratio(1_234, 1_000),
                rgb,
            ),
        ),
        (
            "floats",
            8,
            slanted(
                Number::Float(8.0_f64.sqrt() * 3.0),
                Number::Float(0.1_f64.sqrt()),
                Number::Float(2.0),
                rgb,
            ),
        ),
        (
            "wide lenses",
            45,
            slanted(ratio(207_502, 10_000), ratio(-5, 8), ratio(1, 2), rgb),
        ),
    ] {
        let name = name.to_owned();
        panels.push((name.clone(), Display::new(name, views, kind)));
    }
    panels
}

fn mask(display: &Display) -> Mask {
    let whole = Placement::full_screen(SIZE.0, SIZE.1);
    display.mask(&whole, display.views).unwrap()
}

/// The picture of the panel for views of `colour(view, x, row)`.
fn shown(display: &Display, colour: impl Fn(u16, u32, u32) -> [u8; 3]) -> RgbImage {
    let mask = mask(display);
    RgbImage::from_fn(SIZE.0, SIZE.1, |x, row| {
        let views = mask.at(x, row).unwrap();
        Rgb(std::array::from_fn(|c| colour(views[c], x, row)[c]))
    })
}

/// Different in every channel, and never close to those of other views.
fn flat(view: u16) -> [u8; 3] {
    let view = u32::from(view);
    [view * 5 + 20, (view * 35) % 225 + 25, 250 - view * 5].map(|value| value as u8)
}

/// In the middle of the zone of `view`, on the axis of the panel's height.
fn eye_of(view: u16, views: u32) -> Eye {
    let place = (f64::from(view) + 0.5) / f64::from(views) - 0.5;
    let x = place * 2.0 * DISTANCE * 20.0_f64.to_radians().tan();
    Eye {
        x,
        y: 0.0,
        z: DISTANCE,
    }
}

fn seen(display: &Display, panel: &RgbImage, setup: &Setup, eye: Eye) -> RgbImage {
    let optics = Optics::of(display, display.views).unwrap();
    see(panel, &optics, setup, eye, &|| {}).unwrap()
}

/// Which view of `flat` a stored value of a channel is, if any.
fn view_of(value: u8, channel: usize, views: u32) -> Option<u16> {
    let mut views = 0..views as u16;
    views.find(|&view| flat(view)[channel].abs_diff(value) <= 1)
}

/// Subpixels that are farther than any lens reaches from all edges of the panel.
fn inner(picture: &RgbImage) -> impl Iterator<Item = [u8; 3]> {
    let margin = 32;
    let inside = move |at: u32, all: u32| (margin..all - margin).contains(&at);
    picture
        .enumerate_pixels()
        .filter(move |(x, row, _)| inside(*x, SIZE.0) && inside(*row, SIZE.1))
        .map(|(_, _, pixel)| pixel.0)
}

/// Mean light of the inner subpixels of each colour.
fn mean_light(picture: &RgbImage) -> [f64; 3] {
    let light = Light::new();
    let (mut sums, mut count) = ([0.0; 3], 0.0);
    for pixel in inner(picture) {
        for (sum, stored) in sums.iter_mut().zip(pixel) {
            *sum += light.decoded(stored);
        }
        count += 1.0;
    }
    sums.map(|sum| sum / count)
}

#[test]
fn an_eye_in_the_middle_of_a_zone_sees_that_view() {
    for (name, display) in panels() {
        let panel = shown(&display, |view, _, _| flat(view));
        let mut worst = 1.0_f64;
        for view in (0..display.views as u16).step_by(share::every(3)) {
            let picture = seen(&display, &panel, &SETUP, eye_of(view, display.views));
            let mut counts = vec![0; display.views as usize];
            for pixel in picture.pixels() {
                for (channel, &value) in pixel.0.iter().enumerate() {
                    if let Some(view) = view_of(value, channel, display.views) {
                        counts[usize::from(view)] += 1;
                    }
                }
            }
            for pixel in inner(&picture) {
                assert_eq!(pixel, flat(view), "{name}, view {view}");
            }
            let all = f64::from(SIZE.0 * SIZE.1 * 3);
            let right = f64::from(counts[usize::from(view)]) / all;
            worst = worst.min(right);
        }
        println!("{name}: at least {:.3} % of the subpixels", worst * 100.0);
        assert!(worst >= 0.99, "{name}: {worst}");
    }
}

#[test]
fn the_share_of_other_views_is_the_crosstalk() {
    let mut worst = 0.0_f64;
    for (name, display) in panels() {
        for crosstalk in [0.05, 0.6] {
            let setup = Setup { crosstalk, ..SETUP };
            for view in [0, display.views as u16 / 2] {
                let others = shown(&display, |other, _, _| {
                    [if other == view { 0 } else { 255 }; 3]
                });
                let picture = seen(&display, &others, &setup, eye_of(view, display.views));
                for (channel, share) in mean_light(&picture).into_iter().enumerate() {
                    let off = (share - crosstalk).abs();
                    assert!(
                        off < 0.005,
                        "{name}, {crosstalk}, {view}, {channel}: {share}"
                    );
                    worst = worst.max(off);
                }
            }
        }
    }
    println!("the share is at most {worst:.5} off");
}

#[test]
fn half_of_the_light_is_188_of_255() {
    // The inverse of the sRGB function, by hand: 1.055 · 0.5^(1 / 2.4) − 0.055 = 0.7354.
    let light = Light::new();
    assert_eq!(light.encoded(0.5), 188);
    assert_eq!((light.encoded(0.0), light.encoded(1.0)), (0, 255));
    for stored in 0..=255 {
        assert_eq!(light.encoded(light.decoded(stored)), stored);
    }
}

#[test]
fn light_goes_to_the_neighbours_only() {
    let display = Display::named("slanted8").unwrap();
    let setup = Setup {
        crosstalk: 0.5,
        ..SETUP
    };
    let only = |lit| {
        shown(&display, |view, _, _| {
            [if view == lit { 255 } else { 0 }; 3]
        })
    };
    let share = |lit| mean_light(&seen(&display, &only(lit), &setup, eye_of(3, 8)));
    for (lit, expected) in [(1, 0.0), (2, 0.25), (3, 0.5), (4, 0.25), (5, 0.0), (7, 0.0)] {
        for share in share(lit) {
            assert!((share - expected).abs() < 0.01, "view {lit}: {share}");
        }
    }
}

#[test]
fn views_ascend_from_the_left_eye_to_the_right() {
    for (name, display) in panels() {
        let optics = Optics::of(&display, display.views).unwrap();
        // Some rows are enough: with the sheet made for this distance, the height of the panel does not matter.
        let panel = shown(&display, |view, _, _| flat(view));
        let panel = image::imageops::crop_imm(&panel, 0, 0, SIZE.0, 40).to_image();
        let middle = Eye {
            x: 0.0,
            y: 0.0,
            z: DISTANCE,
        };
        let views = display.views;
        let each = strip(&panel, &optics, &SETUP, middle, views, &|| {}).unwrap();
        let cell = each.width() / views;
        for view in 0..views {
            let pixel = each.get_pixel(view * cell + cell / 2, each.height() / 2);
            assert_eq!(pixel.0, flat(view as u16), "{name}, view {view}");
        }
        // Between the middles of the zones, too. Red grows with the view. Before the first and behind the last middle the zones
        // of the colours end one after the other.
        let eyes = 3 * views;
        let fine = strip(&panel, &optics, &SETUP, middle, eyes, &|| {}).unwrap();
        let cell = fine.width() / eyes;
        let red = |eye: u32| {
            let columns = eye * cell + cell / 4..eye * cell + 3 * cell / 4;
            let reds = columns
                .clone()
                .map(|x| fine.get_pixel(x, fine.height() / 2).0[0]);
            reds.map(f64::from).sum::<f64>() / columns.len() as f64
        };
        let steps: Vec<_> = (1..eyes - 1).map(red).collect();
        assert!(steps.is_sorted(), "{name}: {steps:?}");
    }
}

#[test]
fn the_eyes_of_a_viewer_get_the_order_of_depths() {
    for (name, display) in panels() {
        let views = display.views as u16;
        let (left, right) = (views / 4, 3 * views / 4);
        let middle = f64::from(views - 1) / 2.0;
        // A camera further right sees a near bar further left and a far one further right.
        for (what, parallax) in [("near", -6.0), ("on the panel", 0.0), ("far", 6.0)] {
            let panel = shown(&display, |view, x, _| {
                let bar = f64::from(SIZE.0 / 2) + parallax * (f64::from(view) - middle);
                let lit = (f64::from(x) - bar).abs() < 8.0;
                [if lit { 255 } else { 0 }; 3]
            });
            let place = |view| {
                let picture = seen(&display, &panel, &SETUP, eye_of(view, display.views));
                let (mut sum, mut weight) = (0.0, 0.0);
                for (x, _, pixel) in picture.enumerate_pixels() {
                    let light: f64 = pixel.0.into_iter().map(f64::from).sum();
                    sum += f64::from(x) * light;
                    weight += light;
                }
                sum / weight
            };
            let disparity = place(right) - place(left);
            let expected = parallax * f64::from(right - left);
            println!("{name}, {what}: {disparity:.2} of {expected} pixels");
            // A lens shows one place in all its width.
            let lens = Optics::of(&display, display.views).unwrap().period / 3.0;
            assert!(
                (disparity - expected).abs() < lens,
                "{name}, {what}: {disparity}"
            );
        }
    }
}

#[test]
fn a_lens_in_front_swaps_the_views() {
    let display = Display::named("slanted8").unwrap();
    let panel = shown(&display, |view, _, _| flat(view));
    let behind = Optics::of(&display, 8).unwrap();
    let front = Optics {
        side: Side::Front,
        ..behind
    };
    for view in 0..8 {
        let picture = see(&panel, &front, &SETUP, eye_of(view, 8), &|| {}).unwrap();
        assert!(
            inner(&picture).all(|pixel| pixel == flat(7 - view)),
            "view {view}"
        );
    }
}

#[test]
fn rays_of_several_eyes_to_one_lens_meet_on_the_sheet() {
    let display = Display::named("lenticular-5").unwrap();
    let subpixel = SETUP.pixel / 3.0;
    let gap = 15.0 * subpixel / 2.0 / 20.0_f64.to_radians().tan();
    let setup = Setup {
        design: Some(700.0),
        ..SETUP
    };
    for (side, below) in [(Side::Front, gap), (Side::Behind, -gap)] {
        let optics = Optics {
            side,
            ..Optics::of(&display, 5).unwrap()
        };
        let lines = |x, z| Lines::seen(SIZE, &optics, &setup, Eye { x, y: 0.0, z }).unwrap();
        for lens in [0, 41, 95] {
            // Where the ray from (x, z) to the place that is seen, at height -below, is at height 0; mm from the middle.
            let axis = |x: f64, z: f64| {
                let seen = subpixel * (lines(x, z).at(lens) - 1.5 * f64::from(SIZE.0));
                seen + (x - seen) * below / (z + below)
            };
            let one = axis(-120.0, 700.0);
            for (x, z) in [(0.0, 700.0), (90.0, 400.0), (300.0, 2000.0)] {
                let other = axis(x, z);
                assert!(
                    (one - other).abs() < 1e-9,
                    "{side:?}, lens {lens}: {one}, {other}"
                );
            }
        }
    }
}

#[test]
fn an_eye_that_moves_along_the_axes_sees_the_same() {
    let display = Display::named("slanted8").unwrap();
    let panel = shown(&display, |view, x, row| {
        [(u32::from(view) * 30 + x + row) as u8; 3]
    });
    let at = |x, y| seen(&display, &panel, &SETUP, Eye { x, y, z: DISTANCE });
    // Going down, the phase of a subpixel grows; so the axes go to the left, 2/3 of a subpixel for three.
    let (x, y) = (17.3, 90.0);
    assert_eq!(at(x, 0.0), at(x + y * 2.0 / 9.0, y));
    assert_ne!(at(x, 0.0), at(x, y));
}

#[test]
fn nearer_than_designed_views_change_across_the_panel() {
    let display = Display::named("slanted8").unwrap();
    let panel = shown(&display, |view, _, _| flat(view));
    let at = |z, design| {
        let setup = Setup {
            pixel: 1.0,
            design: Some(design),
            ..SETUP
        };
        let picture = seen(&display, &panel, &setup, Eye { x: 20.0, y: 0.0, z });
        [40, SIZE.0 - 40].map(|x| picture.get_pixel(x, SIZE.1 / 2).0[0])
    };
    let [left, right] = at(600.0, 600.0);
    assert_eq!(left, right);
    // A near eye sees the right end of the panel from further left than a far one does.
    let [left, right] = at(400.0, 600.0);
    assert!(left > right, "{left}, {right}");
    let [left, right] = at(900.0, 600.0);
    assert!(left < right, "{left}, {right}");
}

#[test]
fn a_black_and_white_edge_has_fringes_where_the_colours_lie() {
    // Every view is white from this column on; red lies in the left third of a pixel.
    let display = Display::named("slanted8").unwrap();
    let panel = RgbImage::from_fn(SIZE.0, SIZE.1, |x, _| {
        Rgb([if x >= 240 { 255 } else { 0 }; 3])
    });
    let white = seen(&display, &panel, &SETUP, eye_of(4, 8));
    assert!(
        white.pixels().any(|pixel| pixel.0[0] != pixel.0[2]),
        "colours are apart"
    );
    let flat = seen(
        &display,
        &RgbImage::from_pixel(SIZE.0, SIZE.1, Rgb([200; 3])),
        &SETUP,
        eye_of(4, 8),
    );
    assert!(
        inner(&flat).all(|pixel| pixel == [200; 3]),
        "a flat grey stays grey"
    );
}

#[test]
fn a_strip_is_small_enough() {
    let display = Display::named("lenticular-5").unwrap();
    let optics = Optics::of(&display, 5).unwrap();
    let panel = RgbImage::from_pixel(1000, 31, Rgb([90, 160, 230]));
    let middle = Eye {
        x: 0.0,
        y: 0.0,
        z: DISTANCE,
    };
    let strip = |eyes| strip(&panel, &optics, &SETUP, middle, eyes, &|| {});
    assert_eq!(strip(8).unwrap().dimensions(), (8000, 31));
    assert_eq!(strip(9).unwrap().dimensions(), (4500, 16));
    assert_eq!(strip(MAX_EYES).unwrap().dimensions(), (32 * MAX_EYES, 1));
    assert_eq!(strip(9).unwrap().get_pixel(2250, 8).0, [90, 160, 230]);
    for eyes in [0, MAX_EYES + 1] {
        assert!(strip(eyes).is_err(), "{eyes}");
    }
}

#[test]
fn what_cannot_be_simulated_is_one_sentence() {
    let refused = |result: Result<Optics, SimulateError>, part: &str| {
        let message = result.unwrap_err().to_string();
        assert!(
            message.contains(part) && message.contains("; "),
            "{message}"
        );
    };
    let kind = Kind::MaskFile {
        path: "m.png".into(),
        mask: mask(&Display::default()).into(),
    };
    let file = Display {
        kind,
        ..Display::default()
    };
    refused(Optics::of(&file, 8), "says nothing of lenses");
    let kind = slanted(ratio(1, 2), ratio(0, 1), ratio(0, 1), SubpixelOrder::Rgb);
    let narrow = Display {
        kind,
        ..Display::default()
    };
    refused(Optics::of(&narrow, 8), "0.5 subpixels wide");

    let optics = Optics::of(&Display::default(), 8).unwrap();
    let panel = RgbImage::new(8, 8);
    for (z, design) in [(0.0, None), (-600.0, None), (1.0, None), (600.0, Some(0.5))] {
        let setup = Setup { design, ..SETUP };
        let eye = Eye { x: 0.0, y: 0.0, z };
        let message = see(&panel, &optics, &setup, eye, &|| {})
            .unwrap_err()
            .to_string();
        assert!(message.contains("give a larger Z"), "{message}");
    }
    let eye = eye_of(0, 8);
    let empty = see(&RgbImage::new(0, 0), &optics, &SETUP, eye, &|| {});
    assert!(matches!(empty, Err(SimulateError::Empty)), "{empty:?}");
}
