//! The wavelength-selective filter array.
//!
//! Based on: T. Hübner, Y. Zhang, R. Pajarola, "Multi-view point splatting" (GRAPHITE 2006), equations 7 to 9:
//! ```text
//! xoffset = (3·x) % 8                                                        (7)
//! yoffset = (screenHeight − y) % 12                                          (8)
//! v_R = (⌊(1 + yoffset + ⌊yoffset/3⌋) / 2⌋ + xoffset) % 8                    (9)
//! v_G = (v_R + 1) % 8,   v_B = (v_R + 2) % 8
//! ```
//! Two readings were needed, as the paper leaves them open:
//! * `x` and `y` are whole. They come from Cg's WPOS, which is (i + ½, j + ½) at the pixel in column i and row j; with
//!   the halves equation 7 would give no whole view. So x = i and y = j, `⌊WPOS⌋`.
//! * `y` counts upwards from the bottom, as WPOS does under OpenGL; that is why the paper subtracts it from the height of
//!   the screen. The bottom row is y = 0, so `screenHeight − y` is 1 in the top row (not 0) and screenHeight in the bottom
//!   one. Figure 7 is drawn from the top; a filter mounted a row away is a matter of calibration.
//!
//! Our rows count from the top of the screen: y = screenHeight − 1 − row.
#![forbid(unsafe_code)]

use super::{Mask, MaskError, Placement, SubpixelOrder};

/// Equations 7 to 9 with N for 8.
///
/// ⌊(1 + t + ⌊t/3⌋)/2⌋ is ⌊(2t + 1)/3⌋: the diagonal climbs two views in three rows whatever N is. It therefore repeats
/// after 3N/2 rows when N is even (the 12 of equation 8) and after 3N when N is odd. With these periods the equations
/// hold for every N, and every view is shown.
pub(super) fn mask(
    placement: &Placement,
    views: u32,
    order: SubpixelOrder,
) -> Result<Mask, MaskError> {
    let n = i64::from(views);
    let period = if n % 2 == 0 { 3 * n / 2 } else { 3 * n };
    let screen_height = i64::from(placement.screen_height);
    Mask::by_rows(placement, |first, screen_row, row| {
        let y = screen_height - 1 - screen_row;
        let yoffset = (screen_height - y).rem_euclid(period);
        let diagonal = (1 + yoffset + yoffset / 3) / 2;
        for (x, out) in (first..).zip(row) {
            let xoffset = (3 * x).rem_euclid(n);
            let red = (diagonal + xoffset) % n;
            *out = order.colours([red as u16, ((red + 1) % n) as u16, ((red + 2) % n) as u16]);
        }
    })
}
