//! Comparison of pictures that may be a pixel apart at silhouettes.

use image::RgbImage;

/// Whether a pixel of `made` is more than 8 steps beyond the range of `exact` within a pixel of it.
pub(crate) fn beyond(exact: &RgbImage, made: &RgbImage, x: u32, y: u32) -> bool {
    let (width, height) = exact.dimensions();
    let around = (y.saturating_sub(1)..height.min(y + 2))
        .flat_map(|y| (x.saturating_sub(1)..width.min(x + 2)).map(move |x| (x, y)));
    let (mut low, mut high) = ([u8::MAX; 3], [0; 3]);
    for (x, y) in around {
        let pixel = exact.get_pixel(x, y).0;
        low = std::array::from_fn(|i| low[i].min(pixel[i]));
        high = std::array::from_fn(|i| high[i].max(pixel[i]));
    }
    let is = made.get_pixel(x, y).0;
    (0..3).any(|i| {
        i32::from(is[i]) < i32::from(low[i]) - 8 || i32::from(is[i]) > i32::from(high[i]) + 8
    })
}
