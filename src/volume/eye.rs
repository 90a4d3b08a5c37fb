//! The picture that an eye sees of the slices.
//!
//! The screen lets light through and hides nothing, so the light of all voxels is added. A voxel shines the same in all directions, and for as long as the
//! screen takes through its sector: its light is spread over that arc. (A real screen shows less of itself edge-on.)

use super::dither::{Lit, Slices};
use super::fragments::threads;
use super::{RotatingScreen, VolumeError};
use crate::interleave::reference::encoded;
use image::{Rgb, RgbImage};

/// An eye that looks at the middle of the display, and its picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Position of the eye in display space, inches.
    pub eye: [f64; 3],
    /// Columns and rows of the picture, into which the sphere of the display fits.
    pub size: [u32; 2],
    /// Whether lines are drawn on that sphere, as in the paper's Figure 4.
    pub sphere: bool,
}

/// Diameter of the sphere over the picture's smaller side.
const FITS: f64 = 0.96;

/// Smallest distance of an eye, radii.
const NEAREST: f64 = 1.05;

/// Share of the lit pixels that are brighter than white.
const CLIPPED: f64 = 0.01;

/// Light of one voxel, in units whose sums are exact.
const VOXEL: f32 = 4096.0;

/// Degrees between lines on the sphere, their grey, and their width in pixels.
const LINES: usize = 30;
const GREY: f32 = 90.0;

impl Sight {
    /// The display's viewer, with the picture size of the paper.
    pub fn of_viewer(screen: &RotatingScreen) -> Sight {
        Sight {
            eye: [0.0, 0.0, screen.viewer],
            size: [720, 480],
            sphere: false,
        }
    }

    /// The picture. Exposed so that one in a hundred of the pixels that have any light is brighter than white.
    pub fn see(&self, slices: &Slices) -> Result<RgbImage, VolumeError> {
        let camera = self.camera(slices.screen())?;
        let light = light(slices, &camera);
        let mut bright: Vec<u32> = light
            .iter()
            .map(|pixel| pixel.iter().copied().max().unwrap_or(0))
            .filter(|&light| light > 0)
            .collect();
        bright.sort_unstable();
        let white = bright.get(((1.0 - CLIPPED) * bright.len() as f64) as usize);
        let white = white.or(bright.last()).map_or(1.0, |&light| light as f32);
        let [width, height] = self.size;
        let mut picture = RgbImage::new(width, height);
        for (pixel, light) in picture.pixels_mut().zip(&light) {
            *pixel = Rgb(light.map(|light| {
                let stored = encoded((light as f32 / white).min(1.0));
                (stored * 255.0 + 0.5) as u8
            }));
        }
        if self.sphere {
            camera.draw_sphere(slices.screen().radius, &mut picture);
        }
        Ok(picture)
    }

    fn camera(&self, screen: &RotatingScreen) -> Result<Camera, VolumeError> {
        let [width, height] = self.size;
        if !(1..=8192).contains(&width) || !(1..=8192).contains(&height) {
            return Err(VolumeError::Size { width, height });
        }
        let [x, y, z] = self.eye;
        let far = (x * x + y * y + z * z).sqrt();
        let least = NEAREST * screen.radius;
        if !(far >= least && far.is_finite()) {
            return Err(VolumeError::Eye { x, y, z, least });
        }
        let forward = [-x / far, -y / far, -z / far];
        let level = (x * x + z * z).sqrt();
        // Seen from above or below, the viewer's side of the display is at the bottom or the top.
        let up = match level > 1e-6 * far {
            true => [0.0, 1.0, 0.0],
            false => [0.0, 0.0, -y.signum()],
        };
        let right = unit(cross(forward, up));
        let tangent = screen.radius / (far * far - screen.radius * screen.radius).sqrt();
        let up = cross(right, forward);
        let scale = FITS * f64::from(width.min(height)) / 2.0 / tangent;
        Ok(Camera {
            axes: [right, up, forward].map(|axis| axis.map(|part| part as f32)),
            far: far as f32,
            near: (far - screen.radius) as f32,
            scale: scale as f32,
            size: self.size,
        })
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|part| part * part).sum::<f64>().sqrt();
    v.map(|part| part / length)
}

/// A pinhole that looks at the middle of the display.
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    /// Unit vectors to the right, upwards and forwards.
    axes: [[f32; 3]; 3],
    /// Distance from the middle of the display, inches.
    far: f32,
    /// Distance from the nearest point of the display, inches.
    near: f32,
    /// Pixels per inch at a distance of one inch.
    scale: f32,
    size: [u32; 2],
}

impl Camera {
    /// The camera of a viewer outside of the display.
    pub(super) fn of(
        screen: &RotatingScreen,
        eye: [f64; 3],
        size: [u32; 2],
    ) -> Result<Camera, VolumeError> {
        let sphere = false;
        Sight { eye, size, sphere }.camera(screen)
    }

    /// Column and row in pixels, centres at halves, and the distance forwards in inches.
    #[inline(always)]
    pub(super) fn project(&self, point: [f32; 3]) -> [f32; 3] {
        let along = |axis: [f32; 3]| {
            let [x, y, z] = axis;
            x * point[0] + y * point[1] + z * point[2]
        };
        let [right, up, forward] = self.axes;
        let depth = self.far + along(forward);
        let scale = self.scale / depth;
        let [width, height] = self.size;
        [
            width as f32 / 2.0 + along(right) * scale,
            height as f32 / 2.0 - along(up) * scale,
            depth,
        ]
    }

    /// The size of some inches in pixels where the display is nearest.
    fn pixels(&self, inches: f64) -> f64 {
        inches * f64::from(self.scale / self.near)
    }

    /// The four pixels around a point, each with its share.
    #[inline(always)]
    fn around(&self, [x, y, _]: [f32; 3], mut pixel: impl FnMut(usize, f32)) {
        let [width, height] = self.size;
        let (x, y) = (x - 0.5, y - 0.5);
        let (left, top) = (x.floor(), y.floor());
        let (right_share, lower_share) = (x - left, y - top);
        for (dy, down) in [(0.0, 1.0 - lower_share), (1.0, lower_share)] {
            for (dx, across) in [(0.0, 1.0 - right_share), (1.0, right_share)] {
                let (x, y) = (left + dx, top + dy);
                if x >= 0.0 && y >= 0.0 && x < width as f32 && y < height as f32 {
                    pixel(y as usize * width as usize + x as usize, down * across);
                }
            }
        }
    }

    /// Circles through the poles and around the axis, 30° apart.
    fn draw_sphere(&self, radius: f64, picture: &mut RgbImage) {
        let mut share = vec![0.0_f32; picture.width() as usize * picture.height() as usize];
        let steps = (self.pixels(radius) * 16.0).ceil() as u32;
        let mut point = |polar: f64, around: f64| {
            let (out, y) = (radius * polar.sin(), radius * polar.cos());
            let at = [out * around.cos(), y, out * around.sin()].map(|part| part as f32);
            self.around(self.project(at), |pixel, weight| {
                share[pixel] = share[pixel].max(weight);
            });
        };
        for line in (0..360).step_by(LINES) {
            let line = f64::from(line).to_radians();
            for step in 0..=steps {
                let along = f64::from(step) / f64::from(steps);
                point(along * std::f64::consts::PI, line);
                if line < std::f64::consts::PI {
                    point(line, along * std::f64::consts::TAU);
                }
            }
        }
        for (pixel, share) in picture.pixels_mut().zip(share) {
            for value in &mut pixel.0 {
                *value = (f32::from(*value) + GREY * share).min(255.0) as u8;
            }
        }
    }
}

/// Points over a voxel, spaced by the picture's resolution: angles from its middle, radians, and pixels of the slice outwards and down.
pub(super) struct Spread {
    /// By column.
    turns: Vec<Vec<[f32; 2]>>,
    /// Offsets from the near and upper edges.
    steps: Vec<f32>,
}

impl Spread {
    pub(super) fn of(screen: &RotatingScreen, camera: &Camera) -> Spread {
        let middles = |count: u32| (0..count).map(move |i| (f64::from(i) + 0.5) / f64::from(count));
        let count = |inches: f64| camera.pixels(inches).ceil().max(1.0) as u32;
        let turns = (0..screen.columns()).map(|column| {
            let out = f64::from(column + 1) * screen.pixel();
            let angles =
                middles(count(out * screen.sector())).map(|part| (part - 0.5) * screen.sector());
            angles
                .map(|angle| [angle.sin() as f32, angle.cos() as f32])
                .collect()
        });
        Spread {
            turns: turns.collect(),
            steps: middles(count(screen.pixel()))
                .map(|part| part as f32)
                .collect(),
        }
    }

    /// Calls for the points of a voxel, in display space.
    #[inline(always)]
    pub(super) fn points(
        &self,
        screen: &RotatingScreen,
        [sin, cos]: [f32; 2],
        at: u32,
        mut point: impl FnMut([f32; 3]),
    ) {
        let (row, column) = (at / screen.columns(), at % screen.columns());
        let pixel = screen.pixel() as f32;
        for &down in &self.steps {
            let y = screen.radius as f32 - (row as f32 + down) * pixel;
            for &step in &self.steps {
                let out = (column as f32 + step) * pixel;
                for &[dsin, dcos] in self.turns.get(column as usize).into_iter().flatten() {
                    let x = out * (cos * dcos - sin * dsin);
                    point([x, y, out * (sin * dcos + cos * dsin)]);
                }
            }
        }
    }

    /// Number of points of each voxel in a column.
    fn count(&self, column: u32) -> usize {
        let turns = self.turns.get(column as usize).map_or(1, Vec::len);
        turns * self.steps.len() * self.steps.len()
    }
}

/// Sine and cosine of a half plane.
pub(super) fn direction(screen: &RotatingScreen, half_plane: usize) -> [f32; 2] {
    let (sin, cos) = (half_plane as f64 * screen.sector()).sin_cos();
    [sin as f32, cos as f32]
}

/// The light of each pixel, in whole parts of a voxel's light, so that the sums do not depend on their order.
fn light(slices: &Slices, camera: &Camera) -> Vec<[u32; 3]> {
    let screen = slices.screen();
    let spread = Spread::of(screen, camera);
    let planes: Vec<(usize, &Vec<Lit>)> = slices.half_planes.iter().enumerate().collect();
    let pixels = camera.size.iter().map(|&side| side as usize).product();
    let parts: Vec<Vec<[u32; 3]>> = std::thread::scope(|scope| {
        let started: Vec<_> = planes
            .chunks(planes.len().div_ceil(threads()).max(1))
            .map(|planes| {
                let spread = &spread;
                scope.spawn(move || {
                    let mut light = vec![[0_u32; 3]; pixels];
                    for &(half_plane, lit) in planes {
                        let direction = direction(screen, half_plane);
                        for lit in lit {
                            let each = VOXEL / spread.count(lit.at % screen.columns()) as f32;
                            let on =
                                [0, 1, 2].map(|channel| u32::from(lit.channels >> channel & 1));
                            spread.points(screen, direction, lit.at, |point| {
                                camera.around(camera.project(point), |pixel, share| {
                                    let part = (each * share + 0.5) as u32;
                                    if let Some(light) = light.get_mut(pixel) {
                                        for (light, on) in light.iter_mut().zip(on) {
                                            *light = light.saturating_add(part * on);
                                        }
                                    }
                                });
                            });
                        }
                    }
                    light
                })
            })
            .collect();
        let done = started.into_iter().map(|thread| thread.join());
        done.map(|part| part.unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    });
    let mut sum = vec![[0_u32; 3]; pixels];
    for part in parts {
        for (sum, light) in sum.iter_mut().zip(part) {
            for (sum, light) in sum.iter_mut().zip(light) {
                *sum = sum.saturating_add(light);
            }
        }
    }
    sum
}
