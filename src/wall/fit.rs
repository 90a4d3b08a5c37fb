//! Where the panels of a wall are, from the corners of their tags in photos.
//!
//! Each photo is a homography of the wall, bent by the camera's lens: a place at the distance r from the middle, in half diagonals, is seen at
//! r·(1 + k1·r²). The first panel is where the description says; it gives the wall its mm. The homographies of all photos, k1, and place, turn and size of
//! all other panels are fitted together: that the pixels of panels are square holds the photos where the first panel does not reach. Then each panel
//! has a homography of its own, if that is needed: it may be tilted out of the wall.
#![forbid(unsafe_code)]

use super::WallError;
use super::homography::{from_pairs, matrix, of};
use super::light::lights;
use super::pattern::tags;
use super::photo::{Seen, Sighting};
use crate::calibrate::{minimise, soft};
use crate::display::{Homography, Wall, apply};
use std::path::PathBuf;

/// Tags that each panel needs.
const NEEDED: usize = 4;
/// How well the detector finds a corner, pixels of the photo.
const CORNER: f64 = 0.15;
/// What a homography has to leave of the distances of a panel with square pixels to be worth its four more numbers.
const WORTH: f64 = 0.9;
/// More than this is no flat wall, pixels of the photo.
const FLAT: f64 = 1.0;

/// What was measured.
#[derive(Clone, Debug)]
pub struct Fit {
    /// From the pixels of each panel to mm of the wall.
    pub to_wall: Vec<Homography>,
    /// The share of its light that each panel is to show.
    pub light: Vec<f64>,
    /// Root mean square of what is left, pixels of the photos.
    pub rms: f64,
    /// Tags that were found of each panel, in all photos.
    pub tags: Vec<usize>,
}

/// Measures a wall from photos of the pattern. `progress` is called once for each photo.
///
/// # Errors
/// See [`WallError`].
pub fn fit(wall: &Wall, photos: &[PathBuf], progress: impl Fn()) -> Result<Fit, WallError> {
    let all = tags(wall);
    let mut sightings = Vec::new();
    for photo in photos {
        sightings.push(Sighting::load(photo, &all)?);
        progress();
    }
    let count = wall.panels().len();
    let seen = |sighting: &Sighting, panel: usize| {
        let seen = sighting.seen.iter().filter(|seen| seen.tag.panel == panel);
        seen.count()
    };
    // A photo is placed by the first panel, and places the others.
    let placed: Vec<&Sighting> = sightings.iter().filter(|s| seen(s, 0) >= NEEDED).collect();
    let counts: Vec<usize> = (0..count)
        .map(|panel| placed.iter().map(|s| seen(s, panel)).sum())
        .collect();
    for (panel, found) in counts.iter().enumerate() {
        let most = placed.iter().map(|s| seen(s, panel)).max().unwrap_or(0);
        if most < NEEDED {
            return Err(WallError::Unseen {
                number: panel + 1,
                monitor: wall.panels()[panel].monitor.clone(),
                found: *found,
                needed: NEEDED,
            });
        }
    }
    let problem = Problem::new(wall, &placed);
    let start = problem
        .start()
        .ok_or(WallError::NotFlat { rms: f64::NAN })?;
    let steps = vec![1.0; start.len()];
    let minimum = minimise(&start, &steps, |at| problem.residuals(at, soft));
    let at = minimum.map_or(start, |minimum| minimum.at);
    let square = problem.to_walls(&at);
    let tilted = problem.tilted(&at, &square);
    let rms = |panels: &[Homography]| {
        let left = problem.left(&at, panels, |residual| residual)?;
        let squares: f64 = left.iter().map(|value| (value * CORNER).powi(2)).sum();
        Some((2.0 * squares / left.len() as f64).sqrt())
    };
    let wrong = || WallError::NotFlat { rms: f64::NAN };
    let rms = [
        rms(&square).ok_or_else(wrong)?,
        rms(&tilted).ok_or_else(wrong)?,
    ];
    let (to_wall, rms) = match rms[1] < WORTH * rms[0] {
        true => (tilted, rms[1]),
        false => (square, rms[0]),
    };
    if rms > FLAT || !rms.is_finite() {
        return Err(WallError::NotFlat { rms });
    }
    Ok(Fit {
        to_wall,
        light: lights(&placed, count)?,
        rms,
        tags: counts,
    })
}

/// The unknowns, all of about 1: for each photo the eight numbers of a homography from the wall, for each panel but the first its middle, its turn and the
/// logarithm of its size against the description, and k1.
struct Problem<'a> {
    wall: &'a Wall,
    photos: &'a [&'a Sighting],
    /// Middle of the wall, and half of its size, mm.
    middle: [f64; 2],
    half: f64,
}

/// Numbers of a homography, and of a panel.
const EIGHT: usize = 8;
const FOUR: usize = 4;

impl<'a> Problem<'a> {
    fn new(wall: &'a Wall, photos: &'a [&'a Sighting]) -> Self {
        let corners = || wall.panels().iter().flat_map(|panel| panel.corners());
        let range = |axis: usize| {
            let values = || corners().map(|corner| corner[axis]);
            (
                values().fold(f64::MAX, f64::min),
                values().fold(f64::MIN, f64::max),
            )
        };
        let ((left, right), (top, bottom)) = (range(0), range(1));
        Self {
            wall,
            photos,
            middle: [(left + right) / 2.0, (top + bottom) / 2.0],
            half: ((right - left).max(bottom - top) / 2.0).max(1e-9),
        }
    }

    /// A place of the wall in units of about 1.
    fn unit(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            (x - self.middle[0]) / self.half,
            (y - self.middle[1]) / self.half,
        ]
    }

    /// A place of a photo in half diagonals from its middle.
    fn photo_unit(photo: &Sighting, [x, y]: [f64; 2]) -> [f64; 2] {
        let [width, height] = photo.size;
        let half = width.hypot(height) / 2.0;
        [(x - width / 2.0) / half, (y - height / 2.0) / half]
    }

    /// The homography of a photo, from the wall in units.
    fn photo(&self, at: &[f64], photo: usize) -> Homography {
        nine(&at[photo * EIGHT..(photo + 1) * EIGHT])
    }

    /// mm of a pixel of a panel, as its description says.
    fn pixel(&self, panel: usize) -> f64 {
        let shown = &self.wall.panels()[panel];
        let [a, b, ..] = shown.corners();
        (b[0] - a[0]).hypot(b[1] - a[1]) / f64::from(shown.pixels.0)
    }

    /// From the pixels of all panels to mm of the wall.
    fn to_walls(&self, at: &[f64]) -> Vec<Homography> {
        let first = self.wall.panels()[0].to_wall;
        let others = (1..self.wall.panels().len()).map(|panel| {
            let from = self.photos.len() * EIGHT + (panel - 1) * FOUR;
            let [x, y, turn, size] = [0, 1, 2, 3].map(|i| at[from + i]);
            let (width, height) = self.wall.panels()[panel].pixels;
            let half = [width, height].map(|side| f64::from(side) / 2.0);
            let scale = self.pixel(panel) * size.exp();
            let (sine, cosine) = turn.sin_cos();
            let (c, s) = (scale * cosine, scale * sine);
            let [x, y] = [
                x * self.half + self.middle[0],
                y * self.half + self.middle[1],
            ];
            [
                [c, -s, x - c * half[0] + s * half[1]],
                [s, c, y - s * half[0] - c * half[1]],
                [0.0, 0.0, 1.0],
            ]
        });
        std::iter::once(first).chain(others).collect()
    }

    /// The homography of each panel by itself, with the photos where they are; the one that is given where there is none.
    fn tilted(&self, at: &[f64], panels: &[Homography]) -> Vec<Homography> {
        let k1 = at.last().copied().unwrap_or(0.0);
        let backs: Option<Vec<Homography>> = (0..self.photos.len())
            .map(|photo| Some(of(&matrix(&self.photo(at, photo)).try_inverse()?)))
            .collect();
        let Some(backs) = backs else {
            return panels.to_vec();
        };
        let found = (1..panels.len()).map(|panel| {
            let mut pairs = Vec::new();
            for (photo, back) in self.photos.iter().zip(&backs) {
                for seen in photo.seen.iter().filter(|seen| seen.tag.panel == panel) {
                    for (corner, found) in seen
                        .tag
                        .corners()
                        .into_iter()
                        .zip(unit_corners(photo, seen))
                    {
                        let [x, y] = apply(back, straight(found, k1));
                        let there = [
                            x * self.half + self.middle[0],
                            y * self.half + self.middle[1],
                        ];
                        pairs.push((corner, there));
                    }
                }
            }
            from_pairs(&pairs).unwrap_or(panels[panel])
        });
        std::iter::once(panels[0]).chain(found).collect()
    }

    /// Each photo from the first panel alone, each other panel from the photo that shows most of it.
    fn start(&self) -> Option<Vec<f64>> {
        let mut start = Vec::new();
        let mut placed = Vec::new();
        for photo in self.photos {
            let first = photo.seen.iter().filter(|seen| seen.tag.panel == 0);
            let pairs = first.flat_map(|seen| {
                let there = &self.wall.panels()[0];
                let places = seen
                    .tag
                    .corners()
                    .map(|corner| self.unit(there.in_wall(corner)));
                places.into_iter().zip(unit_corners(photo, seen))
            });
            let h = from_pairs(&pairs.collect::<Vec<_>>())?;
            start.extend(eight(&h));
            placed.push(matrix(&h).try_inverse()?);
        }
        for panel in 1..self.wall.panels().len() {
            let of_panel = |photo: &Sighting| {
                let seen = photo.seen.iter().filter(|seen| seen.tag.panel == panel);
                seen.count()
            };
            let best = (0..self.photos.len()).max_by_key(|at| of_panel(self.photos[*at]))?;
            let (photo, back) = (self.photos[best], of(&placed[best]));
            let seen = photo.seen.iter().filter(|seen| seen.tag.panel == panel);
            let pairs = seen.flat_map(|seen| {
                let there = unit_corners(photo, seen).map(|corner| apply(&back, corner));
                seen.tag.corners().into_iter().zip(there)
            });
            let h = from_pairs(&pairs.collect::<Vec<_>>())?;
            let (width, height) = self.wall.panels()[panel].pixels;
            let [w, h2] = [width, height].map(|side| f64::from(side) / 2.0);
            let (middle, right) = (apply(&h, [w, h2]), apply(&h, [2.0 * w, h2]));
            let along = [right[0] - middle[0], right[1] - middle[1]];
            let size = along[0].hypot(along[1]) * self.half / (w * self.pixel(panel));
            start.extend([middle[0], middle[1], along[1].atan2(along[0]), size.ln()]);
        }
        start.push(0.0);
        Some(start)
    }

    /// The distances of all corners from where they should be, in standard deviations.
    fn residuals(&self, at: &[f64], soft: impl Fn(f64) -> f64) -> Option<Vec<f64>> {
        self.left(at, &self.to_walls(at), soft)
    }

    /// As [`Problem::residuals`], with the panels at other places: from their pixels to mm of the wall.
    fn left(
        &self,
        at: &[f64],
        panels: &[Homography],
        soft: impl Fn(f64) -> f64,
    ) -> Option<Vec<f64>> {
        let k1 = *at.last()?;
        let mut left = Vec::new();
        for (number, photo) in self.photos.iter().enumerate() {
            let to_photo = self.photo(at, number);
            let [width, height] = photo.size;
            let scale = width.hypot(height) / 2.0 / CORNER;
            for seen in &photo.seen {
                let panel = panels.get(seen.tag.panel)?;
                for (corner, found) in seen
                    .tag
                    .corners()
                    .into_iter()
                    .zip(unit_corners(photo, seen))
                {
                    let [x, y] = apply(&to_photo, self.unit(apply(panel, corner)));
                    let bent = 1.0 + k1 * (x * x + y * y);
                    left.push(soft((x * bent - found[0]) * scale));
                    left.push(soft((y * bent - found[1]) * scale));
                }
            }
        }
        left.iter().all(|value| value.is_finite()).then_some(left)
    }
}

/// A place of a photo without the bending of its lens.
fn straight([x, y]: [f64; 2], k1: f64) -> [f64; 2] {
    let far = x.hypot(y);
    let mut radius = far;
    // Newton's method: the lens bends little, so that a few steps are exact.
    for _ in 0..6 {
        let off = radius * (1.0 + k1 * radius * radius) - far;
        radius -= off / (1.0 + 3.0 * k1 * radius * radius);
    }
    let share = if far > 0.0 { radius / far } else { 1.0 };
    [x * share, y * share]
}

fn unit_corners(photo: &Sighting, seen: &Seen) -> [[f64; 2]; 4] {
    seen.corners
        .map(|corner| Problem::photo_unit(photo, corner))
}

fn nine(numbers: &[f64]) -> Homography {
    let at = |i: usize| numbers.get(i).copied().unwrap_or(1.0);
    [
        [at(0), at(1), at(2)],
        [at(3), at(4), at(5)],
        [at(6), at(7), 1.0],
    ]
}

fn eight(h: &Homography) -> [f64; EIGHT] {
    let [[a, b, c], [d, e, f], [g, i, w]] = *h;
    [a, b, c, d, e, f, g, i].map(|number| number / w)
}
