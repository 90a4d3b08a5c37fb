//! Depth discontinuities, where a depth image would tear: the pixels on their near side.
//!
//! Popescu et al., section IV.C.2, step 2: "the second order depth variation exceeds a threshold". The normal is that of a least-squares line
//! through the discontinuity pixels around.

use super::DepthImage;
use super::depth_image::is_nothing;
use super::warp::excess;

/// Pixels to either side within which discontinuity pixels belong to one line.
const AROUND: i64 = 3;
/// Pixels to either side, the reach of a splat, within which the farthest sample is sought where nothing was drawn behind an edge.
const BEYOND: i64 = 30;

/// A pixel on the near side of a depth discontinuity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Column and row.
    pub at: [i64; 2],
    /// Away from the occluder, of length 1.
    pub normal: [f64; 2],
    /// 1/w in front.
    pub near: f64,
    /// 1/w behind. Where nothing was drawn behind, a hidden surface may still come out; this is then the 1/w of the farthest sample around.
    pub far: f64,
}

/// All discontinuity pixels of a depth image.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edges {
    /// Rows from the top, from left to right.
    pub all: Vec<Edge>,
    /// 1/w by pixel of the depth image.
    pub(super) depths: Vec<f32>,
    /// The threshold they were found with, in 1/w.
    pub(super) threshold: f64,
}

impl Edges {
    /// Finds the discontinuities of a depth image: steps of 1/w that differ from the slopes around them by more than `threshold`.
    pub fn of(image: &DepthImage, threshold: f64) -> Edges {
        let [w, h] = image.size().map(|side| side as usize);
        let beyond = Beyond::of(image, threshold);
        // For each pixel in front: the sum of the directions to the pixels behind it, and the 1/w of the farthest of those.
        let mut found: Vec<Option<([f64; 2], f64)>> = vec![None; w * h];
        let mut note = |at: [usize; 2], towards: [f64; 2], far: f64| {
            if let Some(slot) = found.get_mut(at[1] * w + at[0]) {
                let (sum, farthest) = slot.get_or_insert(([0.0; 2], far));
                *sum = [sum[0] + towards[0], sum[1] + towards[1]];
                *farthest = farthest.min(far);
            }
        };
        let mut line = |values: &[f32], place: &dyn Fn(usize) -> [usize; 2], d: [f64; 2]| {
            for x in 0..values.len().saturating_sub(1) {
                if excess(values, x) <= threshold {
                    continue;
                }
                let (a, b) = (f64::from(values[x]), f64::from(values[x + 1]));
                match a > b {
                    true => note(place(x), d, beyond.or(b, place(x))),
                    false => note(place(x + 1), d.map(|v| -v), beyond.or(a, place(x + 1))),
                }
            }
        };
        for y in 0..h {
            line(image.inverses(y as u32), &|x| [x, y], [1.0, 0.0]);
        }
        for x in 0..w {
            let column = (0..h as i64).map(|y| image.inverse(x as i64, y).unwrap_or(0.0));
            let column: Vec<f32> = column.collect();
            line(&column, &|y| [x, y], [0.0, 1.0]);
        }
        let edge = |at: usize| {
            let (towards, far) = found[at]?;
            let at = [(at % w) as i64, (at / w) as i64];
            let here = |x: i64, y: i64| {
                let inside = (0..w as i64).contains(&x) && (0..h as i64).contains(&y);
                inside && found[y as usize * w + x as usize].is_some()
            };
            Some(Edge {
                at,
                normal: normal(at, towards, here),
                near: image.inverse(at[0], at[1]).map_or(0.0, f64::from),
                far,
            })
        };
        Edges {
            all: (0..w * h).filter_map(edge).collect(),
            depths: (0..h)
                .flat_map(|y| image.inverses(y as u32).to_vec())
                .collect(),
            threshold,
        }
    }
}

/// How far away a hidden surface may be behind an edge where nothing was drawn.
struct Beyond {
    width: usize,
    /// By pixel: 1/w of the farthest sample around, or of the whole image where the former is no discontinuity farther away.
    farthest: Vec<f32>,
}

impl Beyond {
    fn of(image: &DepthImage, threshold: f64) -> Beyond {
        let [w, h] = image.size().map(|side| side as usize);
        let rows = (0..h).flat_map(|y| image.inverses(y as u32));
        let drawn = |v: &f32| if is_nothing(*v) { f32::INFINITY } else { *v };
        let own: Vec<f32> = rows.map(drawn).collect();
        let all = own.iter().copied().fold(f32::INFINITY, f32::min);
        let across = least(&own, [w, h], [1, w]);
        let around = least(&across, [h, w], [w, 1]);
        let step = |(own, around): (f32, f32)| match f64::from(own - around) > threshold {
            true => around,
            false => all,
        };
        Beyond {
            width: w,
            farthest: own.into_iter().zip(around).map(step).collect(),
        }
    }

    /// The 1/w behind a pixel, or, where nothing was drawn behind it, of the farthest surface that may be there.
    fn or(&self, behind: f64, at: [usize; 2]) -> f64 {
        match is_nothing(behind as f32) {
            true => f64::from(self.farthest[at[1] * self.width + at[0]]),
            false => behind,
        }
    }
}

/// By value: the least one within [`BEYOND`] along its line. There are `lines` lines of `count` values; `next` and `line` are the steps of the index
/// to the next value and to the next line.
fn least(values: &[f32], [count, lines]: [usize; 2], [next, line]: [usize; 2]) -> Vec<f32> {
    let mut out = vec![f32::INFINITY; values.len()];
    for start in (0..lines).map(|number| number * line) {
        for at in 0..count as i64 {
            let range = (at - BEYOND).max(0)..(at + BEYOND + 1).min(count as i64);
            let around = range.map(|other| values[start + other as usize * next]);
            out[start + at as usize * next] = around.fold(f32::INFINITY, f32::min);
        }
    }
    out
}

/// The normal of the line that best fits the discontinuity pixels around, on the side of `towards`.
fn normal(at: [i64; 2], towards: [f64; 2], here: impl Fn(i64, i64) -> bool) -> [f64; 2] {
    let around = (-AROUND..=AROUND).flat_map(|dy| (-AROUND..=AROUND).map(move |dx| (dx, dy)));
    let points = around.filter(|&(dx, dy)| here(at[0] + dx, at[1] + dy));
    let points: Vec<[f64; 2]> = points.map(|(dx, dy)| [dx as f64, dy as f64]).collect();
    let count = points.len().max(1) as f64;
    let mean = |i: usize| points.iter().map(|p| p[i]).sum::<f64>() / count;
    let [mx, my] = [mean(0), mean(1)];
    let sum = |f: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| f(p[0] - mx, p[1] - my)).sum();
    let (xx, yy, xy): (f64, f64, f64) =
        (sum(&|x, _| x * x), sum(&|_, y| y * y), sum(&|x, y| x * y));
    // The direction of the greatest extent lies along the line.
    let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
    let across = [-angle.sin(), angle.cos()];
    let dot = across[0] * towards[0] + across[1] * towards[1];
    let round = (xx - yy).hypot(2.0 * xy) < 1e-9 || dot.abs() < 1e-9;
    match round {
        true => unit(towards),
        false => across.map(|v| v * dot.signum()),
    }
}

/// The vector with length 1; to the right for a vector without length.
fn unit(v: [f64; 2]) -> [f64; 2] {
    let length = v[0].hypot(v[1]);
    match length > 0.0 {
        true => v.map(|side| side / length),
        false => [1.0, 0.0],
    }
}
