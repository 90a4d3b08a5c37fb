//! The panel: its pixels, where their colours lie, and what picture it holds.

use image::{Rgb, RgbImage};

/// Where the three colours of a pixel emit light.
///
/// Coordinates are shares of a pixel: x right, y down, from the pixel's upper left corner. Each colour is a rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Centre of the red, green and blue rectangle.
    pub centres: [[f64; 2]; 3],
    /// Width and height of each rectangle.
    pub size: [f64; 2],
}

impl Layout {
    /// Share of its third that a subpixel fills: across the stripes and along them.
    const APERTURE: [f64; 2] = [0.8, 0.85];

    /// Red left, blue right.
    pub fn rgb() -> Self {
        let third = |n: f64| [(n + 0.5) / 3.0, 0.5];
        Self {
            centres: [third(0.0), third(1.0), third(2.0)],
            size: [Self::APERTURE[0] / 3.0, Self::APERTURE[1]],
        }
    }

    /// Blue left, red right.
    pub fn bgr() -> Self {
        let Self {
            centres: [red, green, blue],
            size,
        } = Self::rgb();
        Self {
            centres: [blue, green, red],
            size,
        }
    }

    /// Red at the top, blue at the bottom.
    pub fn vertical_rgb() -> Self {
        Self::rgb().turned(1)
    }

    /// Rectangles of the given size about any centres. What lies outside the pixel is cut off.
    pub fn custom(centres: [[f64; 2]; 3], size: [f64; 2]) -> Self {
        Self { centres, size }
    }

    /// The layout turned clockwise by so many quarters, as on a panel that stands on its side.
    pub fn turned(self, quarters: u32) -> Self {
        (0..quarters % 4).fold(self, |layout, _| Self {
            centres: layout.centres.map(|[x, y]| [1.0 - y, x]),
            size: [layout.size[1], layout.size[0]],
        })
    }

    /// Left, top, right and bottom edge of the rectangle of a colour, cut to the pixel.
    pub fn edges(&self, colour: usize) -> [f64; 4] {
        let ([x, y], [width, height]) = (self.centres[colour], self.size);
        [
            x - width / 2.0,
            y - height / 2.0,
            x + width / 2.0,
            y + height / 2.0,
        ]
        .map(|edge| edge.clamp(0.0, 1.0))
    }
}

/// A flat panel of equal pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    pub columns: usize,
    pub rows: usize,
    /// Width and height of a pixel in mm.
    pub pitch: f64,
    pub layout: Layout,
    /// Exponent from code values to light.
    pub gamma: f64,
    /// Light of a black pixel as a share of that of a white one.
    pub black: f64,
}

impl Panel {
    /// A panel of a given diagonal in inches, with square pixels in the order red, green, blue.
    pub fn new(columns: usize, rows: usize, inches: f64) -> Self {
        let diagonal = (columns as f64).hypot(rows as f64);
        Self {
            columns,
            rows,
            pitch: inches * 25.4 / diagonal,
            layout: Layout::rgb(),
            gamma: 2.2,
            black: 0.001,
        }
    }

    /// Half of the width and height of the active area in mm.
    pub fn half(&self) -> [f64; 2] {
        [
            self.columns as f64 * self.pitch / 2.0,
            self.rows as f64 * self.pitch / 2.0,
        ]
    }

    /// Panel space in mm to continuous column and row.
    pub fn pixel(&self, at: [f64; 2]) -> [f64; 2] {
        [
            at[0] / self.pitch + self.columns as f64 / 2.0,
            self.rows as f64 / 2.0 - at[1] / self.pitch,
        ]
    }

    /// Continuous column and row to panel space in mm.
    pub fn place(&self, pixel: [f64; 2]) -> [f64; 2] {
        [
            (pixel[0] - self.columns as f64 / 2.0) * self.pitch,
            (self.rows as f64 / 2.0 - pixel[1]) * self.pitch,
        ]
    }

    /// Centre of a subpixel in panel space in mm.
    pub fn subpixel(&self, column: usize, row: usize, colour: usize) -> [f64; 2] {
        let [x, y] = self.layout.centres[colour];
        self.place([column as f64 + x, row as f64 + y])
    }
}

/// How a picture gets onto the panel. The default shows it pixel by pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Showing {
    /// Factor about the middle of the panel, by linear resampling of code values. 0.995 leaves a black border.
    pub scale: f64,
    /// Whole pixels to the right and downwards, after the scaling.
    pub shift: [i64; 2],
    /// Pixels at the left, top, right and bottom that something covers with black.
    pub covered: [usize; 4],
}

impl Default for Showing {
    fn default() -> Self {
        Self {
            scale: 1.0,
            shift: [0, 0],
            covered: [0; 4],
        }
    }
}

impl Showing {
    /// What the pixels hold, in the size of the panel. A smaller picture lies at the upper left, a larger one is cut.
    pub fn apply(&self, panel: &Panel, picture: &RgbImage) -> RgbImage {
        let [left, top, right, bottom] = self.covered;
        let middle = [panel.columns as f64 / 2.0, panel.rows as f64 / 2.0];
        RgbImage::from_fn(panel.columns as u32, panel.rows as u32, |column, row| {
            let (x, y) = (column as usize, row as usize);
            if x < left || y < top || x + right >= panel.columns || y + bottom >= panel.rows {
                return Rgb([0; 3]);
            }
            let moved = [
                i64::from(column) - self.shift[0],
                i64::from(row) - self.shift[1],
            ];
            if self.scale == 1.0 {
                return texel(picture, moved);
            }
            let source: [f64; 2] = std::array::from_fn(|axis| {
                (moved[axis] as f64 + 0.5 - middle[axis]) / self.scale + middle[axis] - 0.5
            });
            linear(picture, source)
        })
    }
}

/// A pixel of a picture, black outside.
fn texel(picture: &RgbImage, at: [i64; 2]) -> Rgb<u8> {
    match (u32::try_from(at[0]), u32::try_from(at[1])) {
        (Ok(x), Ok(y)) => picture
            .get_pixel_checked(x, y)
            .copied()
            .unwrap_or(Rgb([0; 3])),
        _ => Rgb([0; 3]),
    }
}

/// A picture between its pixels, whose centres are whole numbers here.
fn linear(picture: &RgbImage, at: [f64; 2]) -> Rgb<u8> {
    let corner = at.map(|v| v.floor() as i64);
    let part: [f64; 2] = std::array::from_fn(|axis| at[axis] - at[axis].floor());
    let mut sum = [0.0; 3];
    for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        let weight = |d: i64, part: f64| if d == 0 { 1.0 - part } else { part };
        let pixel = texel(picture, [corner[0] + dx, corner[1] + dy]);
        for (sum, code) in sum.iter_mut().zip(pixel.0) {
            *sum += weight(dx, part[0]) * weight(dy, part[1]) * f64::from(code);
        }
    }
    Rgb(sum.map(|v| v.round() as u8))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_orders() {
        let x = |layout: Layout| layout.centres.map(|c| c[0]);
        let y = |layout: Layout| layout.centres.map(|c| c[1]);
        assert!(x(Layout::rgb()).is_sorted() && x(Layout::bgr()).iter().rev().is_sorted());
        assert!(
            y(Layout::vertical_rgb()).is_sorted()
                && x(Layout::vertical_rgb())
                    .iter()
                    .all(|v| (v - 0.5).abs() < 1e-12)
        );
        // Two quarters put the right end to the left.
        let upside_down = x(Layout::rgb().turned(2));
        assert!(
            upside_down
                .iter()
                .zip(x(Layout::bgr()))
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
        // Blue is at the top after three quarters.
        assert!(y(Layout::rgb().turned(3)).iter().rev().is_sorted());
    }

    #[test]
    fn pixels_and_millimetres() {
        let panel = Panel::new(1920, 1080, 24.0);
        let corner = panel.place([0.0, 0.0]);
        assert!(
            corner[0] < 0.0 && corner[1] > 0.0,
            "the first pixel is at the upper left"
        );
        assert!((corner[0].hypot(corner[1]) * 2.0 / 25.4 - 24.0).abs() < 1e-9);
        let back = panel.pixel(panel.place([12.25, 700.5]));
        assert!((back[0] - 12.25).abs() < 1e-9 && (back[1] - 700.5).abs() < 1e-9);
    }

    #[test]
    fn wrong_showings() {
        let panel = Panel::new(400, 200, 10.0);
        let white = RgbImage::from_pixel(400, 200, Rgb([255; 3]));
        let lit = |showing: Showing| {
            showing
                .apply(&panel, &white)
                .pixels()
                .filter(|p| p.0[0] > 127)
                .count()
        };
        assert_eq!(lit(Showing::default()), 400 * 200);
        assert_eq!(
            lit(Showing {
                scale: 0.99,
                ..Default::default()
            }),
            396 * 198
        );
        assert_eq!(
            lit(Showing {
                shift: [7, 0],
                ..Default::default()
            }),
            393 * 200
        );
        assert_eq!(
            lit(Showing {
                covered: [0, 0, 0, 20],
                ..Default::default()
            }),
            400 * 180
        );
        let mut picture = RgbImage::new(400, 200);
        picture.put_pixel(10, 20, Rgb([1, 2, 3]));
        let moved = Showing {
            shift: [7, -2],
            ..Default::default()
        }
        .apply(&panel, &picture);
        assert_eq!(moved.get_pixel(17, 18).0, [1, 2, 3]);
    }
}
