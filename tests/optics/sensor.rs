//! From light to code values: lens blur, colour filters, noise and the sRGB curve.

use super::camera::Camera;
use super::random::Random;
use super::scene::Scene;
use image::RgbImage;

/// How the camera turns light into a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Four rays a pixel instead of one.
    pub supersample: bool,
    /// Standard deviation of the lens blur in px.
    pub blur: f64,
    /// Movement in px while a row is exposed: it blurs along this line.
    pub smear: [f64; 2],
    /// Sensor value of a white panel. 1 is where the sensor clips.
    pub exposure: f32,
    /// 0 is none, 1 the full fourth power of the cosine.
    pub vignetting: f64,
    /// Electrons at the value 1. Shot noise is the root of their number.
    pub electrons: f32,
    /// Deviation of the read noise as a share of the value 1.
    pub read_noise: f32,
    /// Share of each other colour that a colour filter lets through.
    pub leak: f32,
    pub seed: u64,
}

impl Default for Sensor {
    fn default() -> Self {
        Self {
            supersample: false,
            blur: 0.8,
            smear: [0.0; 2],
            exposure: 0.5,
            vignetting: 0.5,
            electrons: 4000.0,
            read_noise: 0.0015,
            leak: 0.03,
            seed: 0,
        }
    }
}

/// Takes a picture of a scene. Equal arguments give equal bytes.
pub fn expose(scene: &Scene, camera: &Camera, sensor: &Sensor) -> RgbImage {
    let size = [camera.width as usize, camera.height as usize];
    let mut light = render(scene, camera, sensor);
    smear(&mut light, size, sensor.smear);
    let blur = bell(sensor.blur);
    bands(&mut light, size[0], |_, line| blur_line(line, &blur));
    let mosaic = mosaic(&light, camera, sensor, &blur);
    drop(light);
    let mut codes = vec![0u8; size[0] * size[1] * 3];
    let curve = srgb_curve();
    bands(&mut codes, size[0] * 3, |y, line| {
        for (x, pixel) in line.chunks_exact_mut(3).enumerate() {
            pixel.copy_from_slice(&demosaic(&mosaic, size, x, y).map(|v| code(&curve, v)));
        }
    });
    // The buffer has the size that the picture asks for.
    RgbImage::from_raw(camera.width, camera.height, codes).unwrap_or_default()
}

/// Calls `work` with the number and the values of each line, on two threads.
fn bands<T: Send>(values: &mut [T], width: usize, work: impl Fn(usize, &mut [T]) + Sync) {
    let upper = values.len() / width / 2;
    let (top, bottom) = values.split_at_mut(upper * width);
    let run = |first: usize, part: &mut [T]| {
        part.chunks_exact_mut(width)
            .enumerate()
            .for_each(|(line, values)| work(first + line, values));
    };
    std::thread::scope(|scope| {
        scope.spawn(|| run(0, top));
        run(upper, bottom);
    });
}

/// Light at each pixel, row by row.
fn render(scene: &Scene, camera: &Camera, sensor: &Sensor) -> Vec<[f32; 3]> {
    let axes = camera.axes();
    let offsets: &[[f64; 2]] = if sensor.supersample {
        &[[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]
    } else {
        &[[0.5, 0.5]]
    };
    let spread = if sensor.supersample { 0.5 } else { 1.0 } / camera.focal;
    let mut light = vec![[0.0; 3]; camera.width as usize * camera.height as usize];
    bands(&mut light, camera.width as usize, |y, line| {
        for [dx, dy] in offsets {
            let row = y as f64 + dy;
            let shift = camera.shift(row);
            for (x, pixel) in line.iter_mut().enumerate() {
                let ray = camera.ray(&axes, shift, [x as f64 + dx, row]);
                let seen = scene.look(camera.position, ray, spread);
                (0..3).for_each(|c| pixel[c] += seen[c] / offsets.len() as f32);
            }
        }
    });
    light
}

/// Blurs along a line of whole-pixel steps.
fn smear(light: &mut Vec<[f32; 3]>, [width, height]: [usize; 2], along: [f64; 2]) {
    let steps = along[0].abs().max(along[1].abs()).ceil() as usize;
    if steps == 0 {
        return;
    }
    let source = std::mem::replace(light, vec![[0.0; 3]; width * height]);
    let place = |at: usize, by: f64, size: usize| {
        (at as f64 + by).round().clamp(0.0, (size - 1) as f64) as usize
    };
    bands(light, width, |y, line| {
        for (x, pixel) in line.iter_mut().enumerate() {
            for step in 0..=steps {
                let share = step as f64 / steps as f64 - 0.5;
                let from = source[place(y, along[1] * share, height) * width
                    + place(x, along[0] * share, width)];
                (0..3).for_each(|c| pixel[c] += from[c] / (steps + 1) as f32);
            }
        }
    });
}

/// Weights of a blur, of the sum 1. The middle one is the centre.
fn bell(deviation: f64) -> Vec<f32> {
    let reach = (3.0 * deviation).ceil() as i32;
    let weight = |i: i32| {
        if deviation > 0.0 {
            (-0.5 * (f64::from(i) / deviation).powi(2)).exp()
        } else {
            1.0
        }
    };
    let sum: f64 = (-reach..=reach).map(weight).sum();
    (-reach..=reach).map(|i| (weight(i) / sum) as f32).collect()
}

fn blur_line(line: &mut [[f32; 3]], weights: &[f32]) {
    let (reach, last) = (weights.len() / 2, line.len() - 1);
    let source = line.to_vec();
    for (x, pixel) in line.iter_mut().enumerate() {
        *pixel = [0.0; 3];
        for (i, weight) in weights.iter().enumerate() {
            let from = source[(x + i).saturating_sub(reach).min(last)];
            (0..3).for_each(|c| pixel[c] += weight * from[c]);
        }
    }
}

/// Colour that the filter of a sensor pixel lets through: red and green, then green and blue.
fn filter(x: usize, y: usize) -> usize {
    x % 2 + y % 2
}

/// What the sensor reads at each pixel, blurred downwards. `light` is blurred along its rows already.
fn mosaic(light: &[[f32; 3]], camera: &Camera, sensor: &Sensor, weights: &[f32]) -> Vec<f32> {
    let (width, last) = (camera.width as usize, camera.height as usize - 1);
    let reach = weights.len() / 2;
    let mut mosaic = vec![0.0; light.len()];
    bands(&mut mosaic, width, |y, line| {
        let mut random = Random::part(sensor.seed, y as u64);
        for (x, value) in line.iter_mut().enumerate() {
            let own = filter(x, y);
            let mut signal = 0.0;
            for (i, weight) in weights.iter().enumerate() {
                let from = light[(y + i).saturating_sub(reach).min(last) * width + x];
                signal += weight
                    * (from[own] * (1.0 - 3.0 * sensor.leak)
                        + sensor.leak * (from[0] + from[1] + from[2]));
            }
            let tangent = [
                x as f64 + 0.5 - camera.centre[0],
                y as f64 + 0.5 - camera.centre[1],
            ]
            .map(|v| v / camera.focal);
            let cosine4 = (1.0 + tangent[0] * tangent[0] + tangent[1] * tangent[1]).powi(-2);
            signal *= sensor.exposure * (1.0 - sensor.vignetting * (1.0 - cosine4)) as f32;
            let deviation =
                (signal.max(0.0) / sensor.electrons + sensor.read_noise * sensor.read_noise).sqrt();
            *value = (signal + deviation * random.normal() as f32).clamp(0.0, 1.0);
        }
    });
    mosaic
}

/// The colours of a pixel, by linear interpolation between sensor pixels of the same filter.
fn demosaic(mosaic: &[f32], [width, height]: [usize; 2], x: usize, y: usize) -> [f32; 3] {
    let mirror = |at: usize, by: i32, size: usize| {
        let to = at as i32 + by;
        if to < 0 || to >= size as i32 {
            (at as i32 - by).clamp(0, size as i32 - 1) as usize
        } else {
            to as usize
        }
    };
    let at = |dx: i32, dy: i32| mosaic[mirror(y, dy, height) * width + mirror(x, dx, width)];
    let own = at(0, 0);
    let sides = || (at(-1, 0) + at(1, 0)) / 2.0;
    let ends = || (at(0, -1) + at(0, 1)) / 2.0;
    let corners = || (at(-1, -1) + at(1, -1) + at(-1, 1) + at(1, 1)) / 4.0;
    match (x % 2, y % 2) {
        (0, 0) => [own, (sides() + ends()) / 2.0, corners()],
        (1, 0) => [sides(), own, ends()],
        (0, _) => [ends(), own, sides()],
        _ => [corners(), (sides() + ends()) / 2.0, own],
    }
}

const CURVE: usize = 1 << 14;

/// The sRGB curve at `CURVE + 1` even steps from 0 to 1.
fn srgb_curve() -> Vec<u8> {
    let encode = |v: f64| {
        if v <= 0.003_130_8 {
            12.92 * v
        } else {
            1.055 * v.powf(1.0 / 2.4) - 0.055
        }
    };
    (0..=CURVE)
        .map(|i| (encode(i as f64 / CURVE as f64) * 255.0).round() as u8)
        .collect()
}

fn code(curve: &[u8], value: f32) -> u8 {
    curve[(value.clamp(0.0, 1.0) * CURVE as f32).round() as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// sRGB 188 is half of the light, within rounding.
    #[test]
    fn curve() {
        let curve = srgb_curve();
        assert_eq!(
            [0.0, 0.5, 1.0, 7.0].map(|v| code(&curve, v)),
            [0, 188, 255, 255]
        );
    }

    #[test]
    fn a_grey_mosaic_stays_grey() {
        let mosaic = vec![0.25; 6 * 4];
        assert!((0..24).all(|i| demosaic(&mosaic, [6, 4], i % 6, i / 6) == [0.25; 3]));
        // A plane of one colour alone comes back as that colour, at the border too.
        for colour in 0..3 {
            let only: Vec<f32> = (0..24)
                .map(|i| f32::from(filter(i % 6, i / 6) == colour))
                .collect();
            assert!((0..24).all(|i| demosaic(&only, [6, 4], i % 6, i / 6)[colour] == 1.0));
        }
    }

    #[test]
    fn blur_keeps_light() {
        let weights = bell(1.1);
        assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-5);
        assert_eq!(bell(0.0), [1.0]);
        let mut line = vec![[0.0; 3]; 21];
        line[10] = [1.0; 3];
        blur_line(&mut line, &weights);
        assert!((line.iter().map(|p| p[0]).sum::<f32>() - 1.0).abs() < 1e-5 && line[9] == line[11]);
    }
}
