//! A camera before a panel with a lens sheet, sharing no code with the library: it follows rays from the sensor through a distorting camera
//! lens to the sheet, and from there to a subpixel.
//!
//! Millimetres, from the middle of the panel: x right, y down, z towards the camera. The pixels are at z = 0, the lenses
//! at z = gap.

use super::random::Random;
use image::codecs::jpeg::JpegEncoder;
use image::{Rgb, RgbImage};
use std::f64::consts::TAU;

/// Side of a pixel, mm.
pub(crate) const PIXEL: f64 = 0.25;
/// Bezel around the panel, mm.
const BEZEL: f64 = 12.0;
/// Rays per pixel of the photo (squared), and subpixels sampled per ray.
const RAYS: usize = 2;
const TAPS: usize = 3;

/// The sheet's true geometry; lengths in subpixels as in the display file.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    pub(crate) size: (u32, u32),
    pub(crate) views: u32,
    pub(crate) pitch: f64,
    pub(crate) slant: f64,
    pub(crate) offset: f64,
    /// Full angle over which all views are seen once, degrees.
    pub(crate) cone: f64,
    pub(crate) colours: [f64; 3],
    /// 3x3 values over the screen, rows from the top.
    pub(crate) bias: [f64; 9],
}

impl Sheet {
    /// Phase at a point of the panel in pixels from its top left corner, in lenses, not taken modulo 1.
    pub(crate) fn phase(&self, x: f64, y: f64) -> f64 {
        let plane = 3.0 * x - 0.5 + self.slant * (y - 0.5) + self.offset;
        (plane + self.bias_at(x, y)) / self.pitch
    }

    fn bias_at(&self, x: f64, y: f64) -> f64 {
        let at = |v: f64, size: u32| (v / f64::from(size) * 2.0).clamp(0.0, 1.999_999);
        let (u, v) = (at(x, self.size.0), at(y, self.size.1));
        let (i, j) = (u as usize, v as usize);
        let (fu, fv) = (u - i as f64, v - j as f64);
        let row = |j: usize| self.bias[3 * j + i] * (1.0 - fu) + self.bias[3 * j + i + 1] * fu;
        row(j) * (1.0 - fv) + row(j + 1) * fv
    }

    /// Distance of the lenses from the pixels, mm: a lens as wide as the pitch spreads it over the cone.
    pub(crate) fn gap(&self) -> f64 {
        self.pitch / 3.0 * PIXEL / 2.0 / (self.cone / 2.0).to_radians().tan()
    }
}

/// A photo to be taken.
#[derive(Clone, Debug)]
pub(crate) struct Shot {
    /// Pixels.
    pub(crate) size: (u32, u32),
    /// mm from the middle of the panel.
    pub(crate) eye: [f64; 3],
    /// Yaw, pitch and roll in radians; all 0 look straight at the middle of the panel.
    pub(crate) aim: [f64; 3],
    /// Pixels.
    pub(crate) focal: f64,
    /// Optical axis from the middle of the photo, pixels.
    pub(crate) axis: [f64; 2],
    /// Brown's k1 for the half diagonal, from ideal to distorted.
    pub k1: f64,
    /// Light lost at the corner of the photo, 0 to 1.
    pub(crate) vignette: f64,
    /// Standard deviation, pixels.
    pub(crate) blur: f64,
    /// The R, G and B of white in the photo.
    pub(crate) white: [f64; 3],
    /// Light that goes to the neighbouring views, 0 to 1.
    pub(crate) crosstalk: f64,
    /// Centre (panel pixels), radius and strength of a lamp's reflection.
    pub(crate) lamp: Option<[f64; 4]>,
    /// Light of the wall behind the panel.
    pub(crate) wall: f64,
}

/// The photo in linear light, without noise.
pub(crate) struct Exposure {
    light: Vec<[f32; 3]>,
    size: (u32, u32),
    /// Root mean square of the light's variation over the panel.
    signal: f64,
}

type V = [f64; 3];

fn cross(a: V, b: V) -> V {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn unit(a: V) -> V {
    let length = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt();
    a.map(|v| v / length)
}

/// The camera's axes as columns: right, down and forward.
fn axes(shot: &Shot) -> [V; 3] {
    let forward = unit(shot.eye.map(|v| -v));
    // With y down and z towards the camera, the axes are left-handed.
    let right = unit(cross(forward, [0.0, 1.0, 0.0]));
    let down = cross(right, forward);
    let mut axes = [right, down, forward];
    for (i, j, angle) in [
        (0, 2, shot.aim[0]),
        (1, 2, shot.aim[1]),
        (0, 1, shot.aim[2]),
    ] {
        let (sin, cos) = angle.sin_cos();
        let (a, b) = (axes[i], axes[j]);
        axes[i] = [0, 1, 2].map(|k: usize| a[k] * cos - b[k] * sin);
        axes[j] = [0, 1, 2].map(|k: usize| a[k] * sin + b[k] * cos);
    }
    axes
}

/// Takes a photo of the panel showing a picture.
pub(crate) fn expose(
    sheet: &Sheet,
    picture: &RgbImage,
    shot: &Shot,
    random: &mut Random,
) -> Exposure {
    let (width, height) = shot.size;
    let panel = (f64::from(sheet.size.0), f64::from(sheet.size.1));
    let gamma: Vec<f64> = (0..256).map(|v| (f64::from(v) / 255.0).powf(2.2)).collect();
    let half = f64::from(width).hypot(f64::from(height)) / 2.0;
    let axes = axes(shot);
    let gap = sheet.gap();
    let mut light = vec![[0.0f32; 3]; (width * height) as usize];
    let (mut sum, mut square, mut count) = (0.0, 0.0, 0.0);
    // Distance in pixels, at a right angle to the lenses, per turn of phase.
    let norm = (9.0 + sheet.slant * sheet.slant) / sheet.pitch;
    let across = [3.0 / norm, sheet.slant / norm];
    for (i, out) in light.iter_mut().enumerate() {
        let (px, py) = ((i as u32 % width) as f64, (i as u32 / width) as f64);
        let mut rgb = [0.0; 3];
        let mut on_panel = false;
        for ray in 0..RAYS * RAYS {
            let jitter = |k: usize, random: &mut Random| (k as f64 + random.unit()) / RAYS as f64;
            let bent = [
                (px + jitter(ray % RAYS, random) - f64::from(width) / 2.0 - shot.axis[0]) / half,
                (py + jitter(ray / RAYS, random) - f64::from(height) / 2.0 - shot.axis[1]) / half,
            ];
            let bent_radius = bent[0].hypot(bent[1]);
            let mut radius = bent_radius;
            for _ in 0..5 {
                let f = radius * (1.0 + shot.k1 * radius * radius) - bent_radius;
                radius -= f / (1.0 + 3.0 * shot.k1 * radius * radius);
            }
            let scale = if bent_radius > 0.0 {
                radius / bent_radius
            } else {
                1.0
            };
            let (cx, cy) = (
                bent[0] * scale * half / shot.focal,
                bent[1] * scale * half / shot.focal,
            );
            let d = [0, 1, 2].map(|k: usize| axes[0][k] * cx + axes[1][k] * cy + axes[2][k]);
            // The point on the sheet, in pixels of the panel.
            let steps = (gap - shot.eye[2]) / d[2];
            let qx = (shot.eye[0] + d[0] * steps) / PIXEL + panel.0 / 2.0;
            let qy = (shot.eye[1] + d[1] * steps) / PIXEL + panel.1 / 2.0;
            let outside = (-qx).max(qx - panel.0).max(-qy).max(qy - panel.1) * PIXEL;
            if outside > 0.0 {
                let dark = if outside < BEZEL {
                    0.01
                } else {
                    shot.wall * (0.7 + 0.3 * (qx / 300.0).sin())
                };
                rgb.iter_mut().for_each(|v| *v += dark);
                continue;
            }
            on_panel = true;
            let straight = [
                qx - d[0] / d[2] * gap / PIXEL,
                qy - d[1] / d[2] * gap / PIXEL,
            ];
            let turned = |x: f64, y: f64| (3.0 * x + sheet.slant * y) / sheet.pitch;
            let sideways = turned(straight[0] - qx, straight[1] - qy);
            let wanted = sheet.phase(qx, qy).floor() + 0.5 + sideways;
            for tap in 0..TAPS {
                // A spot of two subpixels, with crosstalk from one view to either side.
                let spread = ((tap as f64 + random.unit()) / TAPS as f64 - 0.5) * 2.0 / sheet.pitch;
                let leak = random.unit();
                let leak = if leak < shot.crosstalk / 2.0 {
                    1.0
                } else if leak < shot.crosstalk {
                    -1.0
                } else {
                    0.0
                };
                let shift = spread + leak / f64::from(sheet.views);
                let bias = sheet.bias_at(qx, qy) - sheet.bias_at(straight[0], straight[1]);
                let here = sheet.phase(straight[0], straight[1]) + bias / sheet.pitch;
                let mut look = |channels: std::ops::Range<usize>, colour: f64| {
                    let turns = wanted + shift - here - colour / sheet.pitch;
                    let (x, y) = (
                        straight[0] + across[0] * turns,
                        straight[1] + across[1] * turns,
                    );
                    if x < 0.0 || y < 0.0 || x >= panel.0 || y >= panel.1 {
                        return;
                    }
                    let c = (3.0 * x) as usize % 3;
                    if channels.contains(&c) {
                        let level = picture.get_pixel(x as u32, y as u32).0[c];
                        rgb[c] += (3.0 * gamma[usize::from(level)] + 0.006) / TAPS as f64;
                    }
                };
                if sheet.colours == [0.0; 3] {
                    look(0..3, 0.0);
                } else {
                    (0..3).for_each(|c| look(c..c + 1, sheet.colours[c]));
                }
            }
            if let Some([x, y, r, strength]) = shot.lamp {
                let far = (qx - x).hypot(qy - y) / r;
                rgb.iter_mut()
                    .for_each(|v| *v += strength * (-far * far).exp());
            }
        }
        let radius = (px - f64::from(width) / 2.0).hypot(py - f64::from(height) / 2.0) / half;
        let shade = (1.0 - shot.vignette * radius * radius) / (RAYS * RAYS) as f64;
        let rgb = [0, 1, 2].map(|c: usize| rgb[c] * shade * shot.white[c]);
        if on_panel {
            let grey = rgb.iter().sum::<f64>() / 3.0;
            (sum, square, count) = (sum + grey, square + grey * grey, count + 1.0);
        }
        *out = rgb.map(|v| v as f32);
    }
    let mean: f64 = sum / f64::max(count, 1.0);
    Exposure {
        light: blurred(&light, shot.size, shot.blur),
        size: shot.size,
        signal: (square / f64::max(count, 1.0) - mean * mean)
            .max(0.0)
            .sqrt(),
    }
}

fn blurred(light: &[[f32; 3]], (width, height): (u32, u32), sigma: f64) -> Vec<[f32; 3]> {
    let reach = (3.0 * sigma).ceil() as i64;
    let kernel: Vec<f32> = (-reach..=reach)
        .map(|i| (-0.5 * (i as f64 / sigma.max(1e-3)).powi(2)).exp() as f32)
        .collect();
    let total: f32 = kernel.iter().sum();
    let (width, height) = (i64::from(width), i64::from(height));
    let pass = |from: &[[f32; 3]], dx: i64, dy: i64| -> Vec<[f32; 3]> {
        let mut to = Vec::with_capacity(from.len());
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            let mut sum = [0.0f32; 3];
            for (i, weight) in (-reach..=reach).zip(&kernel) {
                let (x, y) = (
                    (x + i * dx).clamp(0, width - 1),
                    (y + i * dy).clamp(0, height - 1),
                );
                let value = from[(y * width + x) as usize];
                (0..3).for_each(|c| sum[c] += weight * value[c]);
            }
            to.push(sum.map(|v| v / total));
        }
        to
    };
    pass(&pass(light, 1, 0), 0, 1)
}

impl Exposure {
    /// The JPEG file: sRGB, 8 bits, at a quality, with noise `snr` dB below the variation over the panel.
    pub(crate) fn jpeg(&self, snr: f64, quality: u8, random: &mut Random) -> Vec<u8> {
        let sigma = self.signal * 10f64.powf(-snr / 20.0);
        let table: Vec<f32> = (0..1 << 15)
            .map(|_| {
                let radius = (-2.0 * (1.0 - random.unit()).ln()).sqrt();
                (sigma * radius * (TAU * random.unit()).cos()) as f32
            })
            .collect();
        let encoded: Vec<u8> = (0..=8192).map(|v| encoded(f64::from(v) / 8192.0)).collect();
        let picture = RgbImage::from_fn(self.size.0, self.size.1, |x, y| {
            let light = self.light[(y * self.size.0 + x) as usize];
            Rgb(light.map(|v| {
                let v = (v + table[random.below(table.len())]).clamp(0.0, 1.0);
                encoded[(8192.0 * v) as usize]
            }))
        });
        let mut bytes = Vec::new();
        JpegEncoder::new_with_quality(&mut bytes, quality)
            .encode_image(&picture)
            .expect("memory");
        bytes
    }
}

/// The sRGB transfer function.
fn encoded(v: f64) -> u8 {
    let v = if v <= 0.003_130_8 {
        12.92 * v
    } else {
        1.055 * v.powf(1.0 / 2.4) - 0.055
    };
    (255.0 * v).round() as u8
}
