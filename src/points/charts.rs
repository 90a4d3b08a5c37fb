//! The charts of Hübner et al.: eight views of a surface of blended splats, in a pass for each view, in the paper's two ways and in ours; times, and errors against the passes.
//!
//! Charts 1 to 3: windows of 256 to 1024 pixels, 137 000, 303 000 and 1 100 000 points. Their scans are not part of this project: a surface with as many points
//! stands for each.
#![forbid(unsafe_code)]

use super::cost::{apart, medians, surface};
use super::{Cloud, GroupTarget, Grouped, Renderer};
use crate::display::{Display, Mask, Placement};
use crate::gl::{Gl, PixelStore};
use crate::interleave::shader::Group;
use crate::metric::Comparison;
use crate::splat::{Eyes, Screen};
use image::{Rgb, RgbImage};
use serde::{Deserialize, Serialize};

const VIEWS: u32 = 8;
/// The paper's display.
const DISPLAY: &str = "huebner8";
/// ε, in radii of a splat.
const BEHIND: f64 = 2.0;

/// One line of JSON of `manyview-probe points-chart`: medians in milliseconds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Chart {
    /// Splats.
    pub points: u32,
    /// Width and height of the picture in pixels.
    pub size: u32,
    /// K: groups of splats that do not overlap.
    pub groups: usize,
    /// One view.
    pub single: f64,
    /// Eight views one after another, without the interleaving that they need ("8 MV").
    pub passes: f64,
    /// The paper's first way: parameters of all views are interpolated ("GPU VS").
    pub vertex: Way,
    /// The paper's second way: three rays in a fragment ("GPU FS").
    pub fragment: Way,
    /// Ours: a fragment for each subpixel.
    pub subpixels: Way,
}

/// The time of a way, and how far its picture is from that of the passes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Way {
    /// Milliseconds.
    pub time: f64,
    /// In dB; none for equal pictures.
    pub psnr: Option<f64>,
    /// 1 for equal pictures.
    pub ssim: f64,
    /// Subpixels that differ by more than two steps of 255, in per cent: a step is what weights of 12 bits may do.
    pub wrong: f64,
}

/// Measures in a context that nobody else uses.
///
/// # Errors
/// There is no mask of this size.
pub fn measure(gl: &Gl, renderer: &Renderer, (points, size): (u32, u32)) -> Result<Chart, String> {
    let store = PixelStore::enter(gl);
    let screen = Screen {
        size: (size, size),
        half: 1.5,
    };
    let eyes = apart(VIEWS, &screen);
    let narrow = Eyes {
        spacing: 0.0,
        ..eyes
    };
    let no = |error: &dyn std::fmt::Display| error.to_string();
    let display = Display::named(DISPLAY).map_err(|error| no(&error))?;
    let mask = display.mask(&Placement::full_screen(size, size), VIEWS);
    let mask = mask.map_err(|error| no(&error))?;
    let splats = surface(points);
    let behind = BEHIND * splats.first().map_or(0.0, |splat| splat.radius);
    let Grouped { splats, ranges } = Grouped::new(&splats);
    let cloud = Cloud::new(gl, &store, &splats);
    let kinds = [
        Group::View,
        Group::Parameters,
        Group::Rays,
        Group::Subpixels,
    ];
    let target = |group| GroupTarget::new(gl, &store, (group, screen), &mask, ranges.len());
    let targets = kinds.map(target);
    let blend = |at: usize, view: u32, eyes: &Eyes| {
        let target = (&targets[at], view);
        renderer.blend(gl, (&cloud, &ranges), target, eyes, behind);
    };
    let read = || {
        let pixels = gl.read_rgb(&store, 0, 0, size, size);
        let mut picture = RgbImage::from_raw(size, size, pixels).unwrap_or_default();
        image::imageops::flip_vertical_in_place(&mut picture);
        picture
    };
    let views: Vec<_> = (0..VIEWS)
        .map(|view| {
            blend(0, view, &eyes);
            read()
        })
        .collect();
    let exact = interleave(&views, &mask);
    let pictures = [1, 2, 3].map(|at| {
        blend(at, 0, &eyes);
        read()
    });
    // One view needs no room for others in its quads.
    let single = |view: u32| blend(0, view, &narrow);
    let times = medians(
        gl,
        [
            &|| single(0),
            &|| (0..VIEWS).for_each(single),
            &|| blend(1, 0, &eyes),
            &|| blend(2, 0, &eyes),
            &|| blend(3, 0, &eyes),
        ],
    );
    for target in targets {
        target.delete(gl);
    }
    cloud.delete(gl);
    store.leave(gl);
    let [single, passes, ways @ ..] = times;
    let mut ways = pictures
        .iter()
        .zip(ways)
        .map(|(picture, time)| way(&exact, picture, time));
    let mut next = || ways.next().unwrap_or_else(|| Err("no picture".to_owned()));
    Ok(Chart {
        points,
        size,
        groups: ranges.len(),
        single,
        passes,
        vertex: next()?,
        fragment: next()?,
        subpixels: next()?,
    })
}

/// The picture of a panel from whole pictures of its views.
fn interleave(views: &[RgbImage], mask: &Mask) -> RgbImage {
    RgbImage::from_fn(mask.width(), mask.height(), |x, y| {
        let shown = mask.at(x, y).unwrap_or_default();
        Rgb([0, 1, 2].map(|channel| {
            let view = views.get(usize::from(shown[channel]));
            view.map_or(0, |view| view.get_pixel(x, y).0[channel])
        }))
    })
}

fn way(exact: &RgbImage, picture: &RgbImage, time: f64) -> Result<Way, String> {
    let compared = Comparison::new(exact, picture, None).map_err(|error| error.to_string())?;
    let off = exact.iter().zip(picture.iter());
    let wrong = off.filter(|(a, b)| a.abs_diff(**b) > 2).count();
    Ok(Way {
        time,
        psnr: Some(compared.psnr).filter(|psnr| psnr.is_finite()),
        ssim: compared.ssim,
        wrong: 100.0 * wrong as f64 / exact.len() as f64,
    })
}
