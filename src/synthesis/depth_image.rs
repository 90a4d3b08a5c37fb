//! A picture with the depth of each pixel.

/// A camera that stands beside that of the picture: the equation of `plan::parallax` for one view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shift {
    /// sep·e_i, in clip space.
    pub separation: f64,
    /// w of zero parallax.
    pub convergence: f64,
}

impl Shift {
    /// Pixels to the right by which a point at 1/w moves in a picture of this width: `separation·(1 − convergence/w)·width/2`.
    pub fn pixels(&self, inverse: f64, width: u32) -> f64 {
        self.separation * (1.0 - self.convergence * inverse) * f64::from(width) / 2.0
    }

    /// Pixels per unit of 1/w, without the sign.
    pub fn pixels_per_inverse(&self, width: u32) -> f64 {
        (self.separation * self.convergence).abs() * f64::from(width) / 2.0
    }
}

/// Why colours and depths are no depth image: width, height, number of colours, number of depths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a picture of {0} x {1} pixels has {2} colours and {3} depths")]
pub struct DepthImageError(u32, u32, usize, usize);

/// Stands for 1/w where nothing was drawn: behind everything.
const NOTHING: f32 = -1.0;

/// Whether a value of 1/w says that nothing was drawn.
pub(super) fn is_nothing(inverse: f32) -> bool {
    inverse < 0.0
}

/// A picture with depths, row 0 on top.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthImage {
    size: [u32; 2],
    colours: Vec<[u8; 3]>,
    inverses: Vec<f32>,
}

impl DepthImage {
    /// From width x height colours and as many values of 1/w, rows from the top. A value that is not finite, or below 0, means that nothing was
    /// drawn.
    pub fn new(
        size: [u32; 2],
        colours: Vec<[u8; 3]>,
        inverses: Vec<f32>,
    ) -> Result<DepthImage, DepthImageError> {
        let [w, h] = size;
        let pixels = w as usize * h as usize;
        if colours.len() != pixels || inverses.len() != pixels {
            return Err(DepthImageError(w, h, colours.len(), inverses.len()));
        }
        Ok(DepthImage::of(size, colours, inverses.into_iter()))
    }

    /// As [`DepthImage::new`], of as many colours and values as there are pixels.
    pub(super) fn of(
        size: [u32; 2],
        colours: Vec<[u8; 3]>,
        inverses: impl Iterator<Item = f32>,
    ) -> DepthImage {
        let drawn = |v: f32| v.is_finite() && v >= 0.0;
        let inverses = inverses.map(|v| if drawn(v) { v } else { NOTHING });
        DepthImage {
            size,
            colours,
            inverses: inverses.collect(),
        }
    }

    /// Width and height.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The colours of a row; empty below the last one.
    pub fn colours(&self, y: u32) -> &[[u8; 3]] {
        self.row(&self.colours, y)
    }

    /// The values of 1/w of a row; empty below the last one.
    pub fn inverses(&self, y: u32) -> &[f32] {
        self.row(&self.inverses, y)
    }

    /// 1/w of a pixel. None outside the picture.
    pub fn inverse(&self, x: i64, y: i64) -> Option<f32> {
        let [w, h] = self.size.map(i64::from);
        let inside = (0..w).contains(&x) && (0..h).contains(&y);
        inside
            .then(|| self.inverses.get((y * w + x) as usize).copied())
            .flatten()
    }

    fn row<'a, T>(&self, all: &'a [T], y: u32) -> &'a [T] {
        let width = self.size[0] as usize;
        let start = y as usize * width;
        all.get(start..start + width).unwrap_or(&[])
    }
}
