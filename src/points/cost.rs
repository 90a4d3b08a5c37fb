//! The time of splats that are drawn once for all views, beside that of one view and of a pass for each view; timed in turns.
//!
//! The nearest splat is seen as it is; [`super::charts`] has blended splats, as the paper has them.
#![forbid(unsafe_code)]

use super::{Cloud, Renderer, Target};
use crate::display::Mask;
use crate::gl::{Gl, PixelStore};
use crate::interleave::shader::Points;
use crate::splat::{Eyes, Screen, Splat};
use glam::DVec3;
use serde::Serialize;
use std::time::Instant;

/// Depth of the screen, and of the nearest point of [`surface`].
const FOCAL: f64 = 4.0;
const NEAREST: f64 = FOCAL - 1.2 * 1.05;
/// Pixels by which that point moves from view to view of eight: what a panel of eight views has by default (√(8/3)).
const BUDGET: f64 = 1.63;
const ROUNDS: usize = 5;

/// One line of JSON of `manyview-probe points-cost`: medians in milliseconds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Splats.
    pub points: u32,
    /// Width and height of the picture in pixels.
    pub size: u32,
    /// N.
    pub views: u32,
    /// One view.
    pub single: f64,
    /// One view after another, all of them, without the interleaving that they need; not measured of more than eight, which take as much longer.
    pub passes: Option<f64>,
    /// All views at once, for a panel whose pixels each show one view.
    pub pixels: f64,
    /// The same for a panel whose subpixels do.
    pub subpixels: f64,
}

/// Measures in a context that nobody else uses.
///
/// # Errors
/// There is no mask of this size.
pub fn measure(
    gl: &Gl,
    renderer: &Renderer,
    (points, size, views): (u32, u32, u32),
) -> Result<Cost, String> {
    let store = PixelStore::enter(gl);
    let screen = Screen {
        size: (size, size),
        half: 1.5,
    };
    let eyes = apart(views, &screen);
    // Columns, and lenses at a slant of one subpixel per row.
    let columns = mask(size, |x, _, _| x % views)?;
    let slanted = mask(size, |x, row, channel| (3 * x + channel + row) % views)?;
    let cloud = Cloud::new(gl, &store, &surface(points));
    let target = |points, mask: &Mask| Target::new(gl, &store, (points, screen), mask);
    let one = target(Points::View, &columns);
    let pixels = target(Points::Pixels, &columns);
    let subpixels = target(Points::Subpixels, &slanted);
    let draw = |target: &Target, view: u32| renderer.draw(gl, &cloud, (target, view), &eyes);
    let narrow = Eyes {
        spacing: 0.0,
        ..eyes
    };
    // One view needs no room for others in its quads.
    let single = |view: u32| renderer.draw(gl, &cloud, (&one, view), &narrow);
    let timed = if views <= 8 { views } else { 0 };
    let times = medians(
        gl,
        [
            &|| single(0),
            &|| (0..timed).for_each(single),
            &|| draw(&pixels, 0),
            &|| draw(&subpixels, 0),
        ],
    );
    for target in [one, pixels, subpixels] {
        target.delete(gl);
    }
    cloud.delete(gl);
    store.leave(gl);
    let [single, passes, pixels, subpixels] = times;
    Ok(Cost {
        points,
        size,
        views,
        single,
        passes: (timed > 0).then_some(passes),
        pixels,
        subpixels,
    })
}

/// Cameras of a display's default parallax. More views are as far apart together as eight, as on one display.
pub(super) fn apart(views: u32, screen: &Screen) -> Eyes {
    let apart = 7.0 * BUDGET * screen.pixel() / (FOCAL / NEAREST - 1.0);
    Eyes {
        views,
        spacing: apart / f64::from(views - 1),
        focal: FOCAL,
        near: 0.1,
    }
}

/// Median times of works that are done in turns, in milliseconds.
pub(super) fn medians<const N: usize>(gl: &Gl, works: [&dyn Fn(); N]) -> [f64; N] {
    works.iter().for_each(|work| work());
    let mut times = [const { Vec::new() }; N];
    for _ in 0..ROUNDS {
        for (times, work) in times.iter_mut().zip(works) {
            gl.finish();
            let start = Instant::now();
            work();
            gl.finish();
            times.push(start.elapsed().as_secs_f64() * 1000.0);
        }
    }
    times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[ROUNDS / 2]
    })
}

/// A square mask, from the view at a column, a row and a channel.
fn mask(size: u32, view: impl Fn(u32, u32, u32) -> u32) -> Result<Mask, String> {
    let pixels = (0..size).flat_map(|row| (0..size).map(move |x| (x, row)));
    let data = pixels.map(|(x, row)| [0, 1, 2].map(|channel| view(x, row, channel) as u16));
    let data = data.collect();
    Mask::new(size, size, data).ok_or_else(|| "the picture is too large".to_owned())
}

/// A ball with dents, as large as the picture. Its splats overlap, but not all of them where the dents are steepest: there a few pixels show its back.
#[must_use]
pub fn surface(points: u32) -> Vec<Splat> {
    let turn = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let radius = 2.0 * 1.2 / f64::from(points).sqrt() * 1.3;
    let all = (0..points).filter_map(|number| {
        let y = 1.0 - (2.0 * f64::from(number) + 1.0) / f64::from(points);
        let flat = (1.0 - y * y).sqrt();
        let (sine, cosine) = (turn * f64::from(number)).sin_cos();
        let normal = DVec3::new(flat * cosine, y, flat * sine);
        let dent = 1.2 * (1.0 + 0.05 * (9.0 * normal.x).sin() * (7.0 * normal.y).cos());
        let colour = (normal * 0.5 + 0.5).as_vec3().to_array();
        Splat::new(DVec3::Z * FOCAL + normal * dent, normal, radius, colour).ok()
    });
    all.collect()
}
