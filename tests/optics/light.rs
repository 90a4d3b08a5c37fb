//! The light of the pixels, gathered over the small area that one ray of a camera stands for.

use super::panel::Panel;
use image::RgbImage;

/// The integral of the normal distribution, tabulated.
#[derive(Clone, Debug)]
pub struct Bell {
    table: Vec<f32>,
}

impl Bell {
    /// Deviations that the table reaches.
    pub const REACH: f32 = 4.0;
    const STEPS: f32 = 128.0;

    fn new() -> Self {
        let count = (2.0 * Self::REACH * Self::STEPS) as usize;
        let density = |x: f64| (-x * x / 2.0).exp() / std::f64::consts::TAU.sqrt();
        let mut sum = 0.0;
        let table = (0..=count + 1).map(|i| {
            let x = i as f64 / f64::from(Self::STEPS) - f64::from(Self::REACH);
            let before = sum;
            sum += density(x + 0.5 / f64::from(Self::STEPS)) / f64::from(Self::STEPS);
            before as f32
        });
        Self {
            table: table.collect(),
        }
    }

    /// Share of the distribution below `x` deviations.
    pub fn below(&self, x: f32) -> f32 {
        let place = ((x + Self::REACH) * Self::STEPS).clamp(0.0, 2.0 * Self::REACH * Self::STEPS);
        let index = place as usize;
        let (low, high) = (self.table[index], self.table[index + 1]);
        low + (high - low) * (place - index as f32)
    }
}

/// How a spot or a line spreads across the axes. The unit is that of the call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spread {
    /// A normal distribution of this deviation.
    Bell(f32),
    /// Evenly over this width.
    Even(f32),
}

/// What the pixels of a panel emit.
#[derive(Clone, Debug)]
pub struct Light {
    columns: i64,
    rows: i64,
    /// Code values, three a pixel, row by row.
    codes: Vec<u8>,
    /// Light of a code value within its rectangle: the mean over a white panel is 1.
    levels: Vec<f32>,
    black: f32,
    /// Left, top, right and bottom edge of each colour as shares of a pixel.
    edges: [[f32; 4]; 3],
    bell: Bell,
}

impl Light {
    /// The light of a picture on a panel. A smaller picture lies at the upper left; the rest is black.
    pub fn new(panel: &Panel, shown: &RgbImage) -> Self {
        let (columns, rows) = (panel.columns, panel.rows);
        let mut codes = vec![0; columns * rows * 3];
        let width = columns.min(shown.width() as usize) * 3;
        let lines = shown
            .as_raw()
            .chunks_exact((shown.width() as usize * 3).max(1));
        for (to, from) in codes.chunks_exact_mut(columns * 3).zip(lines) {
            to[..width].copy_from_slice(&from[..width]);
        }
        let edges = std::array::from_fn(|colour| panel.layout.edges(colour));
        let area = |[left, top, right, bottom]: [f64; 4]| (right - left) * (bottom - top);
        let mean = edges.iter().map(|e| area(*e)).sum::<f64>() / 3.0;
        let level = |code: usize| {
            let share = (code as f64 / 255.0).powf(panel.gamma);
            ((panel.black + (1.0 - panel.black) * share) / mean) as f32
        };
        Self {
            columns: columns as i64,
            rows: rows as i64,
            codes,
            levels: (0..256).map(level).collect(),
            black: panel.black as f32,
            edges: edges.map(|e| e.map(|v| v as f32)),
            bell: Bell::new(),
        }
    }

    fn spread(&self, spread: Spread, x: f32) -> f32 {
        match spread {
            Spread::Bell(deviation) => self.bell.below(x / deviation),
            Spread::Even(width) => (x / width + 0.5).clamp(0.0, 1.0),
        }
    }

    /// Number of lines below a phase, where lines are at whole numbers.
    fn lines_below(&self, spread: Spread, phase: f32) -> f32 {
        let base = phase.floor();
        // Lines more than one period away count fully or not at all.
        base - 1.0
            + (-1..=2)
                .map(|k| self.spread(spread, phase - base - k as f32))
                .sum::<f32>()
    }

    /// Calls `part` for each strip of the area about a point: height above the point in rows and the row with the position in it.
    fn strips(&self, row: f64, height: f32, mut part: impl FnMut(f32, usize, f32)) -> f32 {
        let count = (height * 4.0).ceil().clamp(1.0, 16.0);
        for i in 0..count as usize {
            let down = ((i as f32 + 0.5) / count - 0.5) * height;
            let y = row + f64::from(down);
            if y >= 0.0 && (y as i64) < self.rows {
                part(down, y as usize, y.fract() as f32);
            }
        }
        1.0 / count
    }

    /// Calls `part` for each bright or dark rectangle that a horizontal stretch cuts: colour, level, left and right edge in columns
    /// from `origin`.
    fn along(
        &self,
        row: usize,
        inside: f32,
        origin: f64,
        stretch: [f32; 2],
        mut part: impl FnMut(usize, f32, f32, f32),
    ) {
        let first = ((origin + f64::from(stretch[0])).floor() as i64).max(0);
        let last = ((origin + f64::from(stretch[1])).floor() as i64).min(self.columns - 1);
        for column in first..=last {
            let at = (row as i64 * self.columns + column) as usize * 3;
            let codes = &self.codes[at..at + 3];
            if codes == [0; 3] && self.black == 0.0 {
                continue;
            }
            let shift = (column as f64 - origin) as f32;
            for (colour, &code) in codes.iter().enumerate() {
                let [left, top, right, bottom] = self.edges[colour];
                let near = shift + left < stretch[1] && shift + right > stretch[0];
                if near && inside >= top && inside < bottom {
                    part(
                        colour,
                        self.levels[usize::from(code)],
                        shift + left,
                        shift + right,
                    );
                }
            }
        }
    }

    /// Mean light that a lens or slit before the pixels gathers about a spot.
    ///
    /// `spot` is its column and row. `height` in rows is what the ray stands for along the axis, `lean` the columns per row by which
    /// the axis leads to the right. `spread` is in columns.
    pub fn spot(&self, spot: [f64; 2], height: f32, lean: f32, spread: Spread) -> [f32; 3] {
        let reach = match spread {
            Spread::Bell(deviation) => deviation * 3.5,
            Spread::Even(width) => width / 2.0,
        };
        let mut sum = [0.0; 3];
        let share = self.strips(spot[1], height, |down, row, inside| {
            let middle = lean * down;
            self.along(
                row,
                inside,
                spot[0],
                [middle - reach, middle + reach],
                |colour, level, left, right| {
                    sum[colour] += level
                        * (self.spread(spread, right - middle)
                            - self.spread(spread, left - middle));
                },
            );
        });
        sum.map(|v| v * share)
    }

    /// Mean light of an area of pixels that lines behind them light up.
    ///
    /// `at` is its middle in columns and rows, `size` its width and height in pixels. `phase` is that of the lines at the middle, and
    /// `slope` its growth per column and per row. Each line has the light of its period times `strength`.
    pub fn lit(
        &self,
        at: [f64; 2],
        size: f32,
        phase: f64,
        slope: [f32; 2],
        spread: Spread,
        strength: f32,
    ) -> [f32; 3] {
        let phase = (phase - phase.floor()) as f32;
        let half = size / 2.0;
        let mut sum = [0.0; 3];
        let share = self.strips(at[1], size, |down, row, inside| {
            let lines = |x: f32| self.lines_below(spread, phase + slope[0] * x + slope[1] * down);
            self.along(
                row,
                inside,
                at[0],
                [-half, half],
                |colour, level, left, right| {
                    let (left, right) = (left.max(-half), right.min(half));
                    if right > left {
                        sum[colour] += level * (lines(right) - lines(left));
                    }
                },
            );
        });
        sum.map(|v| v * share * strength / (slope[0] * size))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    /// Below one deviation lies 84.134 % of the normal distribution.
    #[test]
    fn bell() {
        let bell = Bell::new();
        assert!((bell.below(1.0) - 0.841_34).abs() < 1e-4 && (bell.below(0.0) - 0.5).abs() < 1e-4);
        assert!(bell.below(-9.0) < 1e-4 && bell.below(9.0) > 0.9999);
    }

    #[test]
    fn a_white_panel_has_the_mean_one() {
        let panel = Panel::new(64, 32, 1.0);
        let light = Light::new(&panel, &RgbImage::from_pixel(64, 32, Rgb([255; 3])));
        // A wide spread and whole rows average over all places.
        let wide = light.spot([32.0, 16.0], 3.0, 0.0, Spread::Even(12.0));
        assert!(wide.iter().all(|v| (v - 1.0).abs() < 0.2), "{wide:?}");
        let lit = light.lit(
            [32.0, 16.0],
            9.0,
            0.2,
            [1.0 / 3.0, 0.0],
            Spread::Bell(0.3),
            1.0,
        );
        assert!(lit.iter().all(|v| (v - 1.0).abs() < 0.2), "{lit:?}");
    }

    /// A high and narrow spot follows a slanted axis: to the right on the way down.
    #[test]
    fn a_leaning_spot_follows_its_axis() {
        let panel = Panel {
            black: 0.0,
            ..Panel::new(64, 32, 1.0)
        };
        let diagonal =
            RgbImage::from_fn(64, 32, |x, y| Rgb([if x == y + 10 { 255 } else { 0 }; 3]));
        let light = Light::new(&panel, &diagonal);
        let seen = |lean: f32| light.spot([26.5, 16.5], 5.0, lean, Spread::Even(0.2))[1];
        assert!(
            seen(1.0) > 0.9 && seen(-1.0) < 0.4,
            "{} {}",
            seen(1.0),
            seen(-1.0)
        );
    }

    /// A narrow spot on a white pixel sees the colour whose rectangle it meets.
    #[test]
    fn a_narrow_spot_sees_one_colour() {
        let panel = Panel {
            black: 0.0,
            ..Panel::new(64, 32, 1.0)
        };
        let light = Light::new(&panel, &RgbImage::from_pixel(64, 32, Rgb([255; 3])));
        for (colour, x) in [1.0 / 6.0, 0.5, 5.0 / 6.0].into_iter().enumerate() {
            let seen = light.spot([20.0 + x, 10.5], 0.1, 0.0, Spread::Bell(0.02));
            assert!((0..3).all(|c| (seen[c] > 1.0) == (c == colour)), "{seen:?}");
        }
    }
}
