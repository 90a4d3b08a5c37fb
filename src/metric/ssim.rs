//! Structural similarity.
//!
//! Based on: Z. Wang, A. Bovik, H. Sheikh, E. Simoncelli, "Image quality assessment: from error visibility to structural
//! similarity" (IEEE Transactions on Image Processing 13, 2004), equation 13, with C1 = (0.01·255)², C2 = (0.03·255)².
//! Windows are 8×8 pixels, unweighted, every 4 pixels and at the far edges; a smaller picture is one window across.
#![forbid(unsafe_code)]

use image::{Rgb, RgbImage};

const WINDOW: u32 = 8;
const STRIDE: u32 = 4;
const C1: f64 = (0.01 * 255.0) * (0.01 * 255.0);
const C2: f64 = (0.03 * 255.0) * (0.03 * 255.0);

/// Mean over all windows, of luma (Rec. 601); 1 for pictures without pixels.
pub(super) fn mean(a: &RgbImage, b: &RgbImage) -> f64 {
    let (mut sum, mut windows) = (0.0, 0u64);
    for top in starts(a.height()) {
        for left in starts(a.width()) {
            sum += window(a, b, left, top);
            windows += 1;
        }
    }
    if windows == 0 {
        1.0
    } else {
        sum / windows as f64
    }
}

/// First pixels of the windows along a side.
fn starts(length: u32) -> impl Iterator<Item = u32> {
    let last = length.saturating_sub(WINDOW);
    let steps = if length == 0 {
        0
    } else {
        last.div_ceil(STRIDE) + 1
    };
    (0..steps).map(move |step| (step * STRIDE).min(last))
}

fn window(a: &RgbImage, b: &RgbImage, left: u32, top: u32) -> f64 {
    let (mut n, mut sum_a, mut sum_b, mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for y in top..top.saturating_add(WINDOW) {
        for x in left..left.saturating_add(WINDOW) {
            let (Some(a), Some(b)) = (a.get_pixel_checked(x, y), b.get_pixel_checked(x, y)) else {
                continue;
            };
            let (a, b) = (luma(a), luma(b));
            n += 1.0;
            sum_a += a;
            sum_b += b;
            aa += a * a;
            bb += b * b;
            ab += a * b;
        }
    }
    let (mean_a, mean_b) = (sum_a / n, sum_b / n);
    // Variances and covariance have to have the same divisor; whether it is n or n − 1 hardly matters.
    let (var_a, var_b) = (aa / n - mean_a * mean_a, bb / n - mean_b * mean_b);
    let covariance = ab / n - mean_a * mean_b;
    (2.0 * mean_a * mean_b + C1) * (2.0 * covariance + C2)
        / ((mean_a * mean_a + mean_b * mean_b + C1) * (var_a + var_b + C2))
}

fn luma(&Rgb([r, g, b]): &Rgb<u8>) -> f64 {
    0.299 * f64::from(r) + 0.587 * f64::from(g) + 0.114 * f64::from(b)
}
