//! The geometry of a phone's camera: pose, lens distortion and the path of a shaking hand.

use super::random::Random;
use super::vector::{V3, add, cross, dot, scale, sub, unit};

/// How the picture moves on the sensor while its rows are read, by two slow waves along each axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shake {
    /// Amplitude in px, waves per picture height, and start in radians.
    waves: [[[f64; 3]; 2]; 2],
}

impl Shake {
    /// A path that spans `excursion` px from its first to its last row or between its extremes, whichever axis moves more.
    pub fn new(excursion: f64, seed: u64) -> Self {
        let mut random = Random::part(seed, 2);
        let mut wave = || {
            [
                random.range(0.4, 1.0),
                random.range(0.2, 0.9),
                random.range(0.0, std::f64::consts::TAU),
            ]
        };
        let mut shake = Self {
            waves: [[wave(), wave()], [wave(), wave()]],
        };
        let path: Vec<[f64; 2]> = (0..=64).map(|i| shake.at(f64::from(i) / 64.0)).collect();
        let span = |axis: usize| {
            let values = path.iter().map(|p| p[axis]);
            values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
        };
        let factor = excursion / span(0).max(span(1)).max(1e-9);
        shake
            .waves
            .as_flattened_mut()
            .iter_mut()
            .for_each(|wave| wave[0] *= factor);
        shake
    }

    /// Shift in px at a share of the picture's height.
    pub fn at(&self, height: f64) -> [f64; 2] {
        self.waves.map(|axis| {
            axis.iter()
                .map(|[size, rate, start]| {
                    size * (std::f64::consts::TAU * rate * height + start).sin()
                })
                .sum()
        })
    }
}

/// A camera. Picture coordinates are px, x right and y down from the upper left corner; pixel centres are at halves.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    pub width: u32,
    pub height: u32,
    /// Focal length in px.
    pub focal: f64,
    /// Where the optical axis meets the picture.
    pub centre: [f64; 2],
    /// Radial distortion: `distorted = r * (1 + k1 r² + k2 r⁴)`, with r the tangent of the angle from the axis.
    pub k1: f64,
    pub k2: f64,
    /// Entrance pupil in panel space in mm.
    pub position: V3,
    /// Turn to the viewer's right, in radians. At 0 the camera looks straight at the panel, along -z.
    pub yaw: f64,
    /// Turn upwards.
    pub pitch: f64,
    /// Turn of the camera clockwise, as the photographer sees it.
    pub roll: f64,
    pub shake: Shake,
}

impl Camera {
    /// A camera whose diagonal sees what `equivalent` mm see on 35 mm film. Its axis passes the middle of the picture.
    ///
    /// The film has a diagonal of 43.27 mm (CIPA DCG-001 compares diagonals).
    pub fn new(width: u32, height: u32, equivalent: f64) -> Self {
        let (w, h) = (f64::from(width), f64::from(height));
        Self {
            width,
            height,
            focal: equivalent / 36f64.hypot(24.0) * w.hypot(h),
            centre: [w / 2.0, h / 2.0],
            k1: 0.0,
            k2: 0.0,
            position: [0.0, 0.0, 600.0],
            yaw: 0.0,
            pitch: 0.0,
            roll: 0.0,
            shake: Shake::default(),
        }
    }

    /// The focal length as 35 mm film has it.
    pub fn equivalent(&self) -> f64 {
        self.focal * 36f64.hypot(24.0) / f64::from(self.width).hypot(f64::from(self.height))
    }

    /// Turns the camera so that its axis passes a point. The roll stays.
    pub fn aim(&mut self, at: V3) {
        let [x, y, z] = unit(sub(at, self.position));
        (self.yaw, self.pitch) = (x.atan2(-z), y.asin());
    }

    /// Unit vectors to the right of the picture, down and forward.
    pub fn axes(&self) -> [V3; 3] {
        let (sin, cos) = self.yaw.sin_cos();
        let (up, level) = self.pitch.sin_cos();
        let forward = [sin * level, up, -cos * level];
        let right = [cos, 0.0, sin];
        let upward = cross(right, forward);
        let (s, c) = self.roll.sin_cos();
        let turned = add(scale(right, c), scale(upward, -s));
        [
            turned,
            scale(add(scale(upward, c), scale(right, s)), -1.0),
            forward,
        ]
    }

    fn distort(&self, r: f64) -> f64 {
        r * (1.0 + r * r * (self.k1 + r * r * self.k2))
    }

    /// Inverse of the distortion, by Newton's method.
    fn undistort(&self, distorted: f64) -> f64 {
        if (self.k1 == 0.0 && self.k2 == 0.0) || distorted == 0.0 {
            return distorted;
        }
        let mut r = distorted * distorted / self.distort(distorted);
        for _ in 0..20 {
            let slope = 1.0 + r * r * (3.0 * self.k1 + 5.0 * self.k2 * r * r);
            let step = (self.distort(r) - distorted) / slope.max(0.1);
            r -= step;
            if step.abs() < 1e-12 {
                break;
            }
        }
        r
    }

    /// Shift in px by the shaking hand at a row of the picture.
    pub fn shift(&self, row: f64) -> [f64; 2] {
        self.shake.at(row / f64::from(self.height))
    }

    /// Unit direction of the ray through a point of the picture. `axes` are those of [`Camera::axes`], `shift` is that of the row.
    pub fn ray(&self, axes: &[V3; 3], shift: [f64; 2], at: [f64; 2]) -> V3 {
        let x = (at[0] - shift[0] - self.centre[0]) / self.focal;
        let y = (at[1] - shift[1] - self.centre[1]) / self.focal;
        let distorted = (x * x + y * y).sqrt();
        let factor = if distorted > 0.0 {
            self.undistort(distorted) / distorted
        } else {
            1.0
        };
        unit(add(
            axes[2],
            add(scale(axes[0], x * factor), scale(axes[1], y * factor)),
        ))
    }

    /// Where a point appears in the picture. None means behind the camera.
    pub fn project(&self, point: V3) -> Option<[f64; 2]> {
        let axes = self.axes();
        let [x, y, z] = axes.map(|axis| dot(sub(point, self.position), axis));
        if z <= 0.0 {
            return None;
        }
        let r = (x / z).hypot(y / z);
        let factor = if r > 0.0 { self.distort(r) / r } else { 1.0 };
        let still = [
            self.centre[0] + self.focal * factor * x / z,
            self.centre[1] + self.focal * factor * y / z,
        ];
        // The row decides the shift, and the shift the row. It changes by much less than a px per row.
        let mut at = still;
        for _ in 0..20 {
            let shift = self.shift(at[1]);
            at = [still[0] + shift[0], still[1] + shift[1]];
        }
        Some(at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: a panel of 600 by 340 mm from 800 mm straight ahead with a focal length of 3000 px. The half width appears as
    /// 3000 * 300 / 800 = 1125 px, the half height as 3000 * 170 / 800 = 637.5 px.
    #[test]
    fn a_pinhole_projects_four_corners() {
        let camera = Camera {
            focal: 3000.0,
            position: [0.0, 0.0, 800.0],
            ..Camera::new(4032, 3024, 26.0)
        };
        for (x, y) in [(-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
            let at = camera
                .project([x * 300.0, y * 170.0, 0.0])
                .expect("in front of the camera");
            assert!(
                (at[0] - (2016.0 + x * 1125.0)).abs() < 1e-9
                    && (at[1] - (1512.0 - y * 637.5)).abs() < 1e-9,
                "{at:?}"
            );
        }
        // Rolled clockwise by 90 degrees, what was at the upper left is at the lower left.
        let rolled = Camera {
            roll: std::f64::consts::FRAC_PI_2,
            ..camera
        };
        let at = rolled
            .project([-300.0, 170.0, 0.0])
            .expect("in front of the camera");
        assert!(
            (at[0] - (2016.0 - 637.5)).abs() < 1e-9 && (at[1] - (1512.0 + 1125.0)).abs() < 1e-9,
            "{at:?}"
        );
    }

    #[test]
    fn rays_lead_back_to_their_points() {
        let mut camera = Camera {
            k1: -0.1,
            k2: 0.01,
            roll: 0.3,
            shake: Shake::new(9.0, 4),
            ..Camera::new(4032, 3024, 26.0)
        };
        camera.position = [150.0, 60.0, 700.0];
        camera.aim([5.0, -7.0, 0.0]);
        let axes = camera.axes();
        for point in [[-290.0, 160.0, 0.0], [280.0, -150.0, 0.0], [0.0, 0.0, 2.0]] {
            let at = camera.project(point).expect("in front of the camera");
            let ray = camera.ray(&axes, camera.shift(at[1]), at);
            let length = (point[2] - camera.position[2]) / ray[2];
            let met = add(camera.position, scale(ray, length));
            assert!(
                (met[0] - point[0]).hypot(met[1] - point[1]) < 1e-6,
                "{met:?}"
            );
        }
    }

    #[test]
    fn aiming_and_focal_lengths() {
        let mut camera = Camera::new(4032, 3024, 26.0);
        camera.position = [-120.0, 40.0, 650.0];
        camera.aim([0.0, 0.0, 0.0]);
        let at = camera
            .project([0.0, 0.0, 0.0])
            .expect("in front of the camera");
        assert!((at[0] - 2016.0).abs() < 1e-6 && (at[1] - 1512.0).abs() < 1e-6);
        // 5040 px of diagonal against 43.267 mm of film: 26 mm are 3028.6 px.
        assert!((camera.focal - 3028.6).abs() < 0.1 && (camera.equivalent() - 26.0).abs() < 1e-9);
    }
}
