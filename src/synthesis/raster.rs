//! Which pixels a triangle covers.

/// Calls `pixel` for each pixel whose centre a triangle of either winding covers, with its index and the barycentric weights of the corners.
pub(super) fn raster(
    [w, h]: [u32; 2],
    corners: [[f64; 2]; 3],
    mut pixel: impl FnMut(usize, [f64; 3]),
) {
    let [a, b, c] = corners;
    let range = |i: usize, end: u32| {
        let (low, high) = (a[i].min(b[i]).min(c[i]), a[i].max(b[i]).max(c[i]));
        up(low - 0.5)..up_past(high - 0.5).min(end)
    };
    // Most triangles of a fine mesh lie between pixel centres.
    let rows = range(1, h);
    if rows.is_empty() {
        return;
    }
    let columns = range(0, w);
    let side = |a: [f64; 2], b: [f64; 2], p: [f64; 2]| {
        (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
    };
    let area = side(a, b, c);
    if columns.is_empty() || !area.is_normal() {
        return;
    }
    for y in rows {
        for x in columns.clone() {
            let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let weights = [side(b, c, p), side(c, a, p), side(a, b, p)].map(|v| v / area);
            if weights.iter().all(|&weight| weight >= -1e-9) {
                pixel(y as usize * w as usize + x as usize, weights);
            }
        }
    }
}

/// The least whole number that is neither below the value nor negative. A cast is far faster than `ceil` where the processor has no instruction
/// for that.
fn up(value: f64) -> u32 {
    let whole = value as u32;
    whole + u32::from(f64::from(whole) < value && whole < u32::MAX)
}

/// One more than the largest whole number up to the value; 0 for a negative value.
fn up_past(value: f64) -> u32 {
    match value >= 0.0 {
        true => (value as u32).saturating_add(1),
        false => 0,
    }
}
