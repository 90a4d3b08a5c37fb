//! The display in a room: what light comes from where.

use super::displays::Display;
use super::eye::see;
use super::light::Light;
use super::vector::{V3, add, dot, scale, sub, unit};
use image::RgbImage;

/// A lamp that the surface of the panel mirrors, softened by the sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glare {
    /// Place of the lamp in panel space in mm.
    pub lamp: V3,
    /// Standard deviation of the reflection as an angle in radians.
    pub width: f64,
    /// Brightest light of the reflection. 1 is that of a white panel.
    pub level: f32,
}

impl Glare {
    /// A lamp whose reflection lies at `at` on the panel (mm) when it is seen from `eye`.
    pub fn seen_at(at: [f64; 2], eye: V3, width: f64, level: f32) -> Self {
        let lamp = add(
            [at[0], at[1], 0.0],
            scale([at[0] - eye[0], at[1] - eye[1], eye[2]], 1.4),
        );
        Self { lamp, width, level }
    }
}

/// The light of the room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// Light of a white wall. 1 is that of a white panel. A dark room has about 0.003, a bright one 0.4.
    pub ambient: f32,
    pub glare: Option<Glare>,
    /// Width in mm of the dark frame about the active area.
    pub bezel: f64,
}

/// Share of the ambient light that comes back from the panel's surface, from its bezel and from the wall.
const REFLECTED: [f32; 3] = [0.04, 0.06, 0.5];

/// A display that shows a picture in a room.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    display: &'a Display,
    light: Light,
    room: Room,
    half: [f64; 2],
}

impl<'a> Scene<'a> {
    /// `shown` is what the panel's pixels hold.
    pub fn new(display: &'a Display, shown: &RgbImage, room: &Room) -> Self {
        Self {
            display,
            light: Light::new(&display.panel, shown),
            room: *room,
            half: display.panel.half(),
        }
    }

    /// Light that reaches `eye` in a unit direction. `spread` is the angle in radians that the ray stands for.
    pub fn look(&self, eye: V3, direction: V3, spread: f64) -> [f32; 3] {
        let ambient = self.room.ambient;
        if direction[2] >= 0.0 {
            return [ambient * REFLECTED[2]; 3];
        }
        let sheet = &self.display.sheet;
        let at = sheet.meet(eye, direction);
        let outside = (at[0].abs() - self.half[0]).max(at[1].abs() - self.half[1]);
        if outside > self.room.bezel {
            return self.wall(at);
        }
        let point = [at[0], at[1], sheet.front()];
        let glare = self.glare(point, direction);
        if outside > 0.0 {
            return [ambient * REFLECTED[1] + 0.3 * glare; 3];
        }
        let way = sub(point, eye);
        let footprint = dot(way, way).sqrt() * spread;
        see(self.display, &self.light, direction, at, footprint)
            .map(|v| v + ambient * REFLECTED[0] + glare)
    }

    /// A wall with soft stripes and a slow change of brightness. Coordinates are mm in the plane of the panel.
    fn wall(&self, at: [f64; 2]) -> [f32; 3] {
        let waves = 1.0
            + 0.1 * (at[0] / 37.0).sin() * (at[1] / 53.0).cos()
            + 0.0003 * at[0].clamp(-900.0, 900.0);
        [1.0, 0.96, 0.9].map(|tint: f32| self.room.ambient * REFLECTED[2] * tint * waves as f32)
    }

    fn glare(&self, point: V3, direction: V3) -> f32 {
        let Some(glare) = self.room.glare else {
            return 0.0;
        };
        let mirrored = [direction[0], direction[1], -direction[2]];
        // For small angles 2 (1 - cos) is the square of the angle.
        let square = 2.0 * (1.0 - dot(mirrored, unit(sub(glare.lamp, point))));
        glare.level * (-square / (2.0 * glare.width * glare.width)).exp() as f32
    }
}

#[cfg(test)]
mod tests {
    use super::super::displays;
    use super::*;

    #[test]
    fn glare_bezel_and_wall() {
        let display = displays::small();
        let eye = [10.0, 0.0, 500.0];
        let glare = Glare::seen_at([-30.0, 20.0], eye, 0.05, 2.0);
        let room = Room {
            ambient: 0.1,
            glare: Some(glare),
            bezel: 10.0,
        };
        let scene = Scene::new(&display, &RgbImage::new(640, 400), &room);
        let look = |x: f64, y: f64| scene.look(eye, unit(sub([x, y, 0.0], eye)), 1e-4)[1];
        assert!(
            (look(-30.0, 20.0) - 2.0).abs() < 0.1,
            "{}",
            look(-30.0, 20.0)
        );
        assert!(look(70.0, -40.0) < 0.1);
        // The panel is 160 mm wide: 85 mm is on the bezel and 200 mm on the wall.
        assert!(look(85.0, -30.0) < look(200.0, 0.0));
    }
}
