//! Masks of `display` against the rays: two derivations that share nothing but the description.
#![forbid(unsafe_code)]

use super::*;
use crate::display::{Display, Kind, Mask, Number, Placement, Slanted, SubpixelOrder};
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
        panels.push((name.clone(), Display { name, views, kind }));
    }
    panels
}

fn mask(display: &Display) -> Mask {
    let whole = Placement::full_screen(SIZE.0, SIZE.1);
    display.mask(&whole, display.views).unwrap()
}

/// What the panel shows of views that are `colour(view, x, row)`.
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

#[test]
fn an_eye_in_the_middle_of_a_zone_sees_that_view() {
    for (name, display) in panels() {
        let panel = shown(&display, |view, _, _| flat(view));
        let mut worst = 1.0_f64;
        for view in 0..display.views as u16 {
            let picture = seen(&display, &panel, &SETUP, eye_of(view, display.views));
            let mut counts = vec![0; display.views as usize];
            for pixel in picture.pixels() {
                for (channel, &value) in pixel.0.iter().enumerate() {
                    if let Some(view) = view_of(value, channel, display.views) {
                        counts[usize::from(view)] += 1;
                    }
                }
            }
            let all = f64::from(SIZE.0 * SIZE.1 * 3);
            let right = f64::from(counts[usize::from(view)]) / all;
            worst = worst.min(right);
        }
        println!("{name}: at least {:.3} % of the subpixels", worst * 100.0);
        assert!(worst >= 0.99, "{name}: {worst}");
    }
}
