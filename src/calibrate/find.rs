//! The panel in the photo, to a few pixels: a bright frame with four sides, a dark ring in it, and the mark.
#![forbid(unsafe_code)]

use super::camera::{homography, mapped};
use super::frame::{FRAME, Frame, IN_FRAME, IN_RING, PLACES};
use super::{CalibrateError, Photo};
use glam::{DMat3, DVec2};

/// The search is done in a picture of at most this many pixels a side.
const SEARCHED: u32 = 700;
/// Parts of the way from dark to bright at which the frame is looked for.
const THRESHOLDS: [f32; 8] = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.12];
/// A panel is at least this part of the photo's width or height.
const SMALLEST: f64 = 0.2;
/// Where frame and ring are compared along each side; between marks and code.
const PROBES: [f64; 8] = [0.07, 0.08, 0.09, 0.22, 0.78, 0.91, 0.92, 0.93];

/// The map from the panel to the picture, straight and good to a few pixels.
pub(super) fn find(photo: &Photo, frame: &Frame) -> Result<DMat3, CalibrateError> {
    let pool = photo.width.max(photo.height).div_ceil(SEARCHED).max(1);
    let (grey, width, height) = photo.small(pool);
    let picture = Small::new(grey, width, height);
    let mut sorted = picture.grey.clone();
    sorted.sort_by(f32::total_cmp);
    let rank = |part: f64| sorted.get((part * (sorted.len() as f64 - 1.0)) as usize);
    let (Some(&dark), Some(&bright)) = (rank(0.05), rank(0.995)) else {
        return Err(CalibrateError::NoPanel {
            photo: photo.name.clone(),
        });
    };
    let mut mirrored = false;
    for part in THRESHOLDS {
        for quad in picture.quads(dark + part * (bright - dark)) {
            match picture.turned(quad, frame) {
                Some(Turned::Upright(map)) => {
                    let pool = f64::from(pool);
                    return Ok(DMat3::from_diagonal(DVec2::splat(pool).extend(1.0)) * map);
                }
                Some(Turned::Mirrored) => mirrored = true,
                None => {}
            }
        }
    }
    let photo = photo.name.clone();
    Err(if mirrored {
        CalibrateError::Mirrored { photo }
    } else {
        CalibrateError::NoPanel { photo }
    })
}

enum Turned {
    Upright(DMat3),
    Mirrored,
}

/// A small grey picture, slightly blurred.
struct Small {
    grey: Vec<f32>,
    width: usize,
    height: usize,
}

impl Small {
    fn new(grey: Vec<f32>, width: usize, height: usize) -> Self {
        let mut blurred = grey.clone();
        for y in 1..height.saturating_sub(1) {
            for x in 1..width.saturating_sub(1) {
                let rows = (y - 1..=y + 1).map(|y| grey.iter().skip(y * width + x - 1).take(3));
                let sum: f32 = rows.flatten().sum();
                if let Some(out) = blurred.get_mut(y * width + x) {
                    *out = sum / 9.0;
                }
            }
        }
        Self {
            grey: blurred,
            width,
            height,
        }
    }

    fn at(&self, p: DVec2) -> Option<f64> {
        let inside =
            p.x >= 0.0 && p.y >= 0.0 && p.x < self.width as f64 && p.y < self.height as f64;
        let at = p.y as usize * self.width + p.x as usize;
        inside
            .then(|| self.grey.get(at).copied().map(f64::from))
            .flatten()
    }

    /// Four corners, in the order of the clock, of every large bright region that does not touch the border.
    fn quads(&self, threshold: f32) -> Vec<[DVec2; 4]> {
        let mut seen: Vec<bool> = self.grey.iter().map(|&v| v < threshold).collect();
        let mut quads = Vec::new();
        for start in 0..seen.len() {
            if seen.get(start) != Some(&false) {
                continue;
            }
            let region = self.region(start, &mut seen);
            quads.extend(self.quad(&region));
        }
        quads
    }

    /// The pixels connected to one; marks them as seen.
    fn region(&self, start: usize, seen: &mut [bool]) -> Vec<(usize, usize)> {
        let mut region = Vec::new();
        let mut open = vec![start];
        while let Some(at) = open.pop() {
            match seen.get_mut(at) {
                Some(seen @ false) => *seen = true,
                _ => continue,
            }
            let (x, y) = (at % self.width, at / self.width);
            region.push((x, y));
            open.extend((x > 0).then(|| at - 1));
            open.extend((x + 1 < self.width).then(|| at + 1));
            open.extend((y > 0).then(|| at - self.width));
            open.extend((y + 1 < self.height).then(|| at + self.width));
        }
        region
    }

    fn quad(&self, region: &[(usize, usize)]) -> Option<[DVec2; 4]> {
        let (right, below) = (self.width - 1, self.height - 1);
        let touches = |&(x, y): &(usize, usize)| x == 0 || y == 0 || x == right || y == below;
        let least = SMALLEST * (self.width.min(self.height)) as f64;
        if (region.len() as f64) < 2.0 * least || region.iter().any(touches) {
            return None;
        }
        // The ends of each row and column hold the outline.
        let mut rows = vec![(usize::MAX, 0); self.height];
        let mut columns = vec![(usize::MAX, 0); self.width];
        for &(x, y) in region {
            for (ends, value) in [(rows.get_mut(y)?, x), (columns.get_mut(x)?, y)] {
                *ends = (ends.0.min(value), ends.1.max(value));
            }
        }
        let mut outline = Vec::new();
        let point = |x: usize, y: usize| DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
        for (y, &(first, last)) in rows.iter().enumerate().filter(|(_, ends)| ends.0 <= ends.1) {
            outline.extend([
                (point(first, y), DVec2::new(-0.5, 0.0)),
                (point(last, y), DVec2::new(0.5, 0.0)),
            ]);
        }
        for (x, &(first, last)) in columns
            .iter()
            .enumerate()
            .filter(|(_, ends)| ends.0 <= ends.1)
        {
            outline.extend([
                (point(x, first), DVec2::new(0.0, -0.5)),
                (point(x, last), DVec2::new(0.0, 0.5)),
            ]);
        }
        let outline: Vec<DVec2> = outline.into_iter().map(|(p, out)| p + out).collect();
        let rough = four(hull(outline.clone()))?;
        let sides = [0, 1, 2, 3].map(|i| side(&outline, rough[i], rough[(i + 1) % 4]));
        let [Some(a), Some(b), Some(c), Some(d)] = sides else {
            return None;
        };
        let corners = [meet(d, a)?, meet(a, b)?, meet(b, c)?, meet(c, d)?];
        let sizes = (
            corners[0].distance(corners[2]),
            corners[1].distance(corners[3]),
        );
        (sizes.0.min(sizes.1) > least).then_some(corners)
    }

    /// Which corner is the top left one; None when this is not the pattern.
    fn turned(&self, quad: [DVec2; 4], frame: &Frame) -> Option<Turned> {
        let a = DVec2::splat(FRAME * frame.band);
        let b = frame.size - a;
        let outer = [a, DVec2::new(b.x, a.y), b, DVec2::new(a.x, b.y)];
        (0..4).find_map(|turn| {
            let corners = [0, 1, 2, 3].map(|i| quad[(i + turn) % 4]);
            let map = homography(outer, corners)?;
            let mean = |points: &mut dyn Iterator<Item = DVec2>| {
                let (mut sum, mut count) = (0.0, 0.0);
                for point in points {
                    sum += self.at(mapped(map, point))?;
                    count += 1.0;
                }
                Some(sum / count)
            };
            let mut level = 0.0;
            for side in 0..4 {
                let at = |depth| mean(&mut PROBES.iter().map(|&t| frame.along(side, t, depth)));
                let (white, ring) = (at(IN_FRAME)?, at(IN_RING)?);
                if ring > 0.6 * white {
                    return None;
                }
                level += (white + ring) / 8.0;
            }
            // Vignetting makes each place its own judge as little as possible: only one may be above the level.
            let mut bright = PLACES.map(|place| mean(&mut frame.place(place)));
            bright.sort_by(|a, b| b.partial_cmp(a).unwrap_or(std::cmp::Ordering::Equal));
            let [Some(first), Some(second), ..] = bright else {
                return None;
            };
            if first < level || second > 0.5 * (first + level) {
                return None;
            }
            match PLACES
                .iter()
                .position(|&place| mean(&mut frame.place(place)) == Some(first))
            {
                Some(0) => Some(Turned::Upright(map)),
                // A mirrored panel has its mark at the end of a side, whichever is on top.
                Some(1) => Some(Turned::Mirrored),
                _ => None,
            }
        })
    }
}

/// Convex hull in the order of the clock as seen with y down (Andrew's monotone chain).
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..] {
                if (b - a).perp_dot(p - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut all = half(&mut points.iter().copied());
    all.extend(half(&mut points.iter().rev().copied()));
    all
}

/// The hull without all but four corners: the one whose triangle is smallest goes first. Begins with the corner
/// nearest to the top left.
fn four(mut hull: Vec<DVec2>) -> Option<[DVec2; 4]> {
    while hull.len() > 4 {
        let n = hull.len();
        let area = |i: usize| {
            let (a, b, c) = (hull[(i + n - 1) % n], hull[i], hull[(i + 1) % n]);
            (b - a).perp_dot(c - a).abs()
        };
        let least = (0..n).min_by(|&i, &j| area(i).total_cmp(&area(j)))?;
        hull.remove(least);
    }
    let first =
        (0..hull.len()).min_by(|&i, &j| hull[i].element_sum().total_cmp(&hull[j].element_sum()))?;
    hull.rotate_left(first);
    hull.try_into().ok()
}

/// A line through the outline between two corners: a point and a direction.
fn side(outline: &[DVec2], a: DVec2, b: DVec2) -> Option<(DVec2, DVec2)> {
    let along = (b - a).try_normalize()?;
    let length = a.distance(b);
    let mut line = (a, along);
    for reach in [6.0, 2.5, 1.5] {
        let near: Vec<DVec2> = outline
            .iter()
            .copied()
            .filter(|&p| {
                let part = (p - a).dot(along) / length;
                (0.05..0.95).contains(&part) && (p - line.0).perp_dot(line.1).abs() < reach
            })
            .collect();
        if near.len() < 8 {
            return None;
        }
        let mean = near.iter().sum::<DVec2>() / near.len() as f64;
        // The main axis of the points, turned so that the line is nearly on the x axis.
        let (mut xx, mut xy) = (0.0, 0.0);
        for p in near {
            let d = p - mean;
            let (x, y) = (d.dot(along), along.perp_dot(d));
            xx += x * x;
            xy += x * y;
        }
        line = (mean, (along + along.perp() * (xy / xx)).try_normalize()?);
    }
    Some(line)
}

fn meet((p, u): (DVec2, DVec2), (q, v): (DVec2, DVec2)) -> Option<DVec2> {
    let cross = u.perp_dot(v);
    (cross.abs() > 0.1).then(|| p + u * ((q - p).perp_dot(v) / cross))
}
