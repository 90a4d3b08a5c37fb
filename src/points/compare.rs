//! Random splats, drawn by the GPU one by one and all together, compared with [`crate::splat`] subpixel by subpixel.
#![forbid(unsafe_code)]

use super::cost::surface;
use super::{Cloud, GroupTarget, Grouped, Renderer, Target};
use crate::display::{Display, Mask, Placement};
use crate::gl::{Gl, PixelStore};
use crate::interleave::glsl_version;
use crate::interleave::shader::{Group, Points};
use crate::splat::disk::on_plane;
use crate::splat::groups::Groups;
use crate::splat::random::Random;
use crate::splat::reference::{Surface, picture};
use crate::splat::{Eyes, Fault, Screen, Splat};
use glam::DVec3;
use image::RgbImage;
use serde::Serialize;

const SPLATS: usize = 1000;
/// Of the picture of one splat.
const SCREEN: Screen = Screen {
    size: (48, 32),
    half: 2.0,
};
/// Of the picture of all splats.
const LARGE: Screen = Screen {
    size: (320, 240),
    half: 2.0,
};
/// Of the surface.
const BALL: Screen = Screen {
    size: (96, 64),
    half: 2.0,
};
const EYES: Eyes = Eyes {
    views: 8,
    spacing: 0.1,
    focal: 4.0,
    near: 0.05,
};
/// How far a float is off, as a share of it, after the sums that a fragment makes.
const ROUNDING: f64 = 2e-6;

/// What was found.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Compared {
    /// Splats that were drawn.
    pub splats: usize,
    /// Splats that were left out, because a number of theirs is infinite or none.
    pub refused: usize,
    /// Subpixels that were compared, each splat alone.
    pub subpixels: u64,
    /// Of these, those in which the splat is seen.
    pub seen: u64,
    /// Of these, those in which a rounding decides: at the edge of a disk, or of one that is seen from its edge.
    pub at_the_edge: u64,
    /// Of these, those that are seen though they should not be, or not though they should.
    pub wrong: u64,
    /// Subpixels of the picture of all splats.
    pub together: u64,
    /// Of these, those that differ from the reference by more than one step of 255.
    pub together_wrong: u64,
    /// Subpixels of the picture of a surface of blended splats.
    pub blended: u64,
    /// Of these, those that differ from the reference by more than two steps of 255.
    pub blended_wrong: u64,
}

/// Draws and compares in the context that is current.
///
/// # Errors
/// The text of the driver, which refuses a program.
pub fn compare(gl: &Gl) -> Result<Compared, String> {
    let renderer = Renderer::new(gl, glsl_version(gl))?;
    let store = PixelStore::enter(gl);
    let display = Display::named("huebner8").map_err(|error| error.to_string())?;
    let mask = |screen: Screen| {
        let (width, height) = screen.size;
        let placement = Placement::full_screen(width, height);
        let mask = display.mask(&placement, EYES.views);
        mask.map_err(|error| error.to_string())
    };
    let mut random = Random::new(30);
    let mut splats = Vec::new();
    let mut found = Compared::default();
    while splats.len() < SPLATS {
        match random_splat(&mut random) {
            Ok(splat) => splats.push(splat),
            Err(_) => found.refused += 1,
        }
    }
    found.splats = splats.len();
    let small = mask(SCREEN)?;
    let target = Target::new(gl, &store, (Points::Subpixels, SCREEN), &small);
    for splat in &splats {
        let white = Splat {
            colour: [1.0; 3],
            ..*splat
        };
        let shown = draw(gl, &store, (&renderer, &target, SCREEN), &[white]);
        found.add(splat, &small, &shown);
    }
    target.delete(gl);
    let large = mask(LARGE)?;
    let target = Target::new(gl, &store, (Points::Subpixels, LARGE), &large);
    let shown = draw(gl, &store, (&renderer, &target, LARGE), &splats);
    let expected = picture(&splats, (&EYES, &LARGE), &large, Surface::Opaque);
    let off = shown.iter().zip(expected.iter());
    found.together = shown.len() as u64;
    found.together_wrong = off.filter(|(a, b)| a.abs_diff(**b) > 1).count() as u64;
    target.delete(gl);
    found.blend(gl, &store, &renderer, &mask(BALL)?);
    store.leave(gl);
    Ok(found)
}

/// The picture of splats on a panel.
fn draw(
    gl: &Gl,
    store: &PixelStore,
    (renderer, target, screen): (&Renderer, &Target, Screen),
    splats: &[Splat],
) -> RgbImage {
    let cloud = Cloud::new(gl, store, splats);
    renderer.draw(gl, &cloud, (target, 0), &EYES);
    cloud.delete(gl);
    read(gl, store, screen)
}

/// The picture in the framebuffer that is bound.
fn read(gl: &Gl, store: &PixelStore, screen: Screen) -> RgbImage {
    let (width, height) = screen.size;
    let pixels = gl.read_rgb(store, 0, 0, width, height);
    let mut picture = RgbImage::from_raw(width, height, pixels).unwrap_or_default();
    image::imageops::flip_vertical_in_place(&mut picture);
    picture
}

impl Compared {
    /// Compares a surface of splats that overlap.
    fn blend(&mut self, gl: &Gl, store: &PixelStore, renderer: &Renderer, mask: &Mask) {
        let Grouped { splats, ranges } = Grouped::new(&surface(SPLATS as u32));
        let behind = 2.0 * splats.first().map_or(0.0, |splat| splat.radius);
        let cloud = Cloud::new(gl, store, &splats);
        let target = GroupTarget::new(gl, store, (Group::Subpixels, BALL), mask, ranges.len());
        renderer.blend(gl, (&cloud, &ranges), (&target, 0), &EYES, behind);
        let shown = read(gl, store, BALL);
        target.delete(gl);
        cloud.delete(gl);
        let groups = Groups {
            of: (0..)
                .zip(&ranges)
                .flat_map(|(group, range)| range.clone().map(move |_| group))
                .collect(),
            count: ranges.len() as u32,
        };
        let expected = Surface::Deferred {
            behind,
            groups: &groups,
            averaged: false,
        };
        let expected = picture(&splats, (&EYES, &BALL), mask, expected);
        let off = shown.iter().zip(expected.iter());
        self.blended = shown.len() as u64;
        self.blended_wrong = off.filter(|(a, b)| a.abs_diff(**b) > 2).count() as u64;
    }

    /// Counts the subpixels of one splat.
    fn add(&mut self, splat: &Splat, mask: &Mask, shown: &RgbImage) {
        let (width, height) = SCREEN.size;
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let place = SCREEN.place([f64::from(x) + 0.5, f64::from(y) + 0.5]);
            let views = mask.at(x, y).unwrap_or_default();
            for (view, shown) in views.into_iter().zip(shown.get_pixel(x, y).0) {
                let offset = EYES.offset(view.into());
                let point = on_plane(splat, &EYES, offset, place);
                let away = point.map(|point| point.distance(splat.centre) / splat.radius);
                // What a rounding does to the place in the plane, in radii.
                let sight = place.extend(EYES.focal) - DVec3::X * offset;
                let steep = splat.normal.dot(sight.normalize()).abs();
                let near = ROUNDING * (splat.centre.length() + 1.0) / (splat.radius * steep);
                let expected = away.is_some_and(|away| away <= 1.0);
                let eye = DVec3::X * offset;
                let depth =
                    EYES.focal * splat.normal.dot(splat.centre - eye) / splat.normal.dot(sight);
                let edge = near > 0.5
                    || away.is_some_and(|away| (away - 1.0).abs() < near)
                    || (depth - EYES.near).abs() < near * splat.radius;
                self.subpixels += 1;
                self.seen += u64::from(expected);
                self.at_the_edge += u64::from(edge);
                self.wrong += u64::from(!edge && (shown > 0) != expected);
            }
        }
    }
}

/// A splat before or behind the viewer, as small as a subpixel or larger than the screen. Some are seen from their edge, and some are none.
fn random_splat(random: &mut Random) -> Result<Splat, Fault> {
    let mut centre = DVec3::new(
        random.between(-3.0, 3.0),
        random.between(-2.0, 2.0),
        random.between(-0.5, 12.0),
    );
    let mut normal = [(); 3].map(|()| random.between(-1.0, 1.0));
    let mut radius = 10.0_f64.powf(random.between(-2.5, 0.7));
    match random.between(0.0, 100.0) as u32 {
        0 => centre.x = f64::NAN,
        1 => normal[1] = f64::INFINITY,
        2 => radius = 0.0,
        // At the near plane.
        3..10 => centre.z = EYES.near + radius * random.between(-1.0, 1.0),
        10..20 => normal = [-centre.z, random.between(-0.01, 0.01), centre.x],
        _ => {}
    }
    let colour = [(); 3].map(|()| random.between(0.2, 1.0) as f32);
    Splat::new(centre, DVec3::from_array(normal), radius, colour)
}
