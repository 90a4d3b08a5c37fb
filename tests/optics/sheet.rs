//! The optical sheet: lenses or slits before or behind the pixels, and the path of a ray through its glass.
//!
//! Before the pixels, from the viewer on: air, the outer face with the lenses or slits, glass, an air gap (possibly none), the
//! pixels at z = 0. Behind the pixels: air, the pixels at z = 0, an air gap (possibly none), glass, the lines at its back face.

use super::vector::{V3, add, refract, scale, unit};

/// What the sheet is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Cylinder lenses. Behind the pixels they make bright lines of the backlight.
    Lenses,
    /// Slits, open for this share of the pitch.
    Slits { open: f64 },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Before,
    Behind,
}

/// How the air gap varies over the panel, in mm, as a smooth function.
///
/// With x and y from -1 to 1 over the panel it is `dome * (1 - x²) * (1 - y²) + twist * x * y`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bow {
    pub dome: f64,
    pub twist: f64,
    /// Half of the panel's width and height in mm.
    pub half: [f64; 2],
}

impl Bow {
    pub const FLAT: Self = Self {
        dome: 0.0,
        twist: 0.0,
        half: [1.0; 2],
    };

    /// The added gap in mm and its slope along x and y.
    pub fn at(&self, at: [f64; 2]) -> (f64, [f64; 2]) {
        if self.dome == 0.0 && self.twist == 0.0 {
            return (0.0, [0.0; 2]);
        }
        let [hx, hy] = self.half;
        let (x, y) = (at[0] / hx, at[1] / hy);
        let slope_x = -2.0 * self.dome * x * (1.0 - y * y) + self.twist * y;
        let slope_y = -2.0 * self.dome * y * (1.0 - x * x) + self.twist * x;
        (
            self.dome * (1.0 - x * x) * (1.0 - y * y) + self.twist * x * y,
            [slope_x / hx, slope_y / hy],
        )
    }
}

/// A sheet. Its axes pass the panel's centre at `offset`.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    pub kind: Kind,
    pub side: Side,
    /// Distance of neighbouring axes in mm, measured at right angles to them.
    pub pitch: f64,
    /// Angle of the axes from the vertical. A positive slant leads to the right on the way down.
    pub slant: f64,
    /// Angle by which the whole sheet is turned in its plane. It adds to the slant.
    pub turn: f64,
    /// Distance of an axis from the panel's centre, as a share of the pitch.
    pub offset: f64,
    /// Refractive index of the glass.
    pub index: f64,
    /// Thickness of the glass in mm.
    pub thickness: f64,
    /// Air gap between glass and pixels in mm, without the bow.
    pub gap: f64,
    pub bow: Bow,
    /// Standard deviation of the spot of a lens, or of its bright line, across the axis in mm.
    pub spot: f64,
}

/// Where the chief ray of a lens goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chief {
    /// Where the ray met the lens across its axis, as a share of the pitch from -0.5 to 0.5.
    pub across: f64,
    /// The spot on the pixels in mm.
    pub spot: [f64; 2],
}

impl Sheet {
    pub fn lines_per_inch(&self) -> f64 {
        25.4 / self.pitch
    }

    pub fn set_lines_per_inch(&mut self, lines: f64) {
        self.pitch = 25.4 / lines;
    }

    /// Angle of the axes from the vertical, with the turn.
    pub fn angle(&self) -> f64 {
        self.slant + self.turn
    }

    /// Unit vector across the axes, to the right.
    pub fn normal(&self) -> [f64; 2] {
        let (sin, cos) = self.angle().sin_cos();
        [cos, sin]
    }

    /// Position across the axes in periods: whole numbers are on an axis.
    pub fn periods(&self, at: [f64; 2]) -> f64 {
        let normal = self.normal();
        (at[0] * normal[0] + at[1] * normal[1]) / self.pitch - self.offset
    }

    /// z of the panel's outermost face, without the bow.
    pub fn front(&self) -> f64 {
        match self.side {
            Side::Before => self.thickness + self.gap,
            Side::Behind => 0.0,
        }
    }

    /// Where a ray from `eye` meets the outermost face. The direction leads away from the viewer.
    pub fn meet(&self, eye: V3, direction: V3) -> [f64; 2] {
        let at = |z: f64| {
            let length = (z - eye[2]) / direction[2];
            [
                eye[0] + direction[0] * length,
                eye[1] + direction[1] * length,
            ]
        };
        let first = at(self.front());
        match self.side {
            Side::Before => {
                at(self.front() + self.bow.at(at(self.front() + self.bow.at(first).0)).0)
            }
            Side::Behind => first,
        }
    }

    /// The path of a ray of a unit direction that meets the outermost face at `at`: the point on the far plane and the
    /// direction there. The far plane has the pixels, or the lines behind the pixels. None means total reflection.
    pub fn pass(&self, direction: V3, at: [f64; 2]) -> Option<(V3, V3)> {
        match self.side {
            Side::Before => {
                let (bow, slope) = self.bow.at(at);
                let normal = unit([-slope[0], -slope[1], 1.0]);
                let face = [at[0], at[1], self.front() + bow];
                let glass = refract(direction, normal, 1.0, self.index)?;
                let back = self.cross_glass(face, glass, normal);
                if self.gap + bow < 1e-9 {
                    return Some((back, glass));
                }
                let air = refract(glass, normal, self.index, 1.0)?;
                Some((add(back, scale(air, -back[2] / air[2])), air))
            }
            Side::Behind => {
                let point = |gap: f64| {
                    [
                        at[0] - direction[0] / direction[2] * gap,
                        at[1] - direction[1] / direction[2] * gap,
                    ]
                };
                let (bow, _) = self.bow.at(point(self.gap));
                let near = point(self.gap + bow);
                let (bow, slope) = self.bow.at(near);
                let normal = unit([slope[0], slope[1], 1.0]);
                let glass = refract(direction, normal, 1.0, self.index)?;
                Some((
                    self.cross_glass([near[0], near[1], -self.gap - bow], glass, normal),
                    glass,
                ))
            }
        }
    }

    /// From a face of the glass to the other one, which is parallel.
    fn cross_glass(&self, face: V3, direction: V3, normal: V3) -> V3 {
        let cosine =
            -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
        add(face, scale(direction, self.thickness / cosine))
    }

    /// The chief ray of the lens that a ray meets at `at`, for a sheet before the pixels.
    ///
    /// The lens bundles all rays of one direction. The one through its axis only refracts, so it tells where the spot is. Along
    /// the axis nothing is bundled: the chief ray starts beside `at`.
    pub fn chief(&self, direction: V3, at: [f64; 2]) -> Option<Chief> {
        let [x, y] = self.normal();
        let position = (at[0] * x + at[1] * y) / self.pitch - self.offset;
        let across = position - position.round();
        let step = across * self.pitch;
        let (spot, _) = self.pass(direction, [at[0] - x * step, at[1] - y * step])?;
        Some(Chief {
            across,
            spot: [spot[0], spot[1]],
        })
    }

    /// Position across the axes, in periods, of the ray that leads from an eye to a point on the pixels.
    ///
    /// Before the pixels it is the point of the outer face through which the eye would see the pixel if there were no lens:
    /// a whole number means that the pixel is in the middle of what the eye sees of that lens. Behind them it is the point of the
    /// line plane that the eye sees through the pixel: a whole number means that the pixel is before the middle of a line.
    pub fn phase(&self, eye: V3, pixel: [f64; 2]) -> Option<f64> {
        let toward = |at: [f64; 2], z: f64| unit([at[0] - eye[0], at[1] - eye[1], z - eye[2]]);
        match self.side {
            Side::Before => {
                // The path moves the point by less than the depth over the distance times its own move: this converges fast.
                let mut at = pixel;
                for _ in 0..24 {
                    let (bow, _) = self.bow.at(at);
                    let (spot, _) = self.pass(toward(at, self.front() + bow), at)?;
                    let miss = [pixel[0] - spot[0], pixel[1] - spot[1]];
                    at = [at[0] + miss[0], at[1] + miss[1]];
                    if miss[0].abs().max(miss[1].abs()) < 1e-11 {
                        break;
                    }
                }
                Some(self.periods(at))
            }
            Side::Behind => {
                let (line, _) = self.pass(toward(pixel, 0.0), pixel)?;
                Some(self.periods([line[0], line[1]]))
            }
        }
    }
}

#[cfg(test)]
mod tests;
