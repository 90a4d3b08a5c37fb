//! Comparison of the slices of a reference image with those of the geometry.

use super::eye::{Camera, Spread, direction};
use super::fragments::by_number;
use super::{RotatingScreen, Volume, VolumeError, Voxel};

/// A voxel is visible from an eye where no voxel lies more than this in front of it, in radii of the display: four pixels of a slice.
pub const VISIBLE: f64 = 0.01;

/// Rows of the pictures that decide which samples are visible: two rows of a slice fall on one of these, so that surfaces have no gaps.
const ROWS: u32 = 384;

/// The difference of two volumes. Neighbouring voxels differ by at most one sector, one column and one row: the largest distance of a piece from
/// its surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Voxels of the geometry that the eyes see.
    pub seen: usize,
    /// Of these, voxels that the other volume lacks.
    pub missing: usize,
    /// Of these, voxels without a neighbour in the other volume either.
    pub lost: usize,
    /// Voxels of the other volume.
    pub drawn: usize,
    /// Of these, voxels that the geometry lacks.
    pub extra: usize,
    /// Of these, voxels without a neighbour in the geometry either.
    pub wrong: usize,
    /// Mean difference of a channel where both have a voxel, of 255.
    pub colour: f64,
}

impl Difference {
    /// Compares the whole geometry with a part of it that is meant for `eyes`, in display space, inches. Without eyes all its voxels count
    /// as seen.
    pub fn between(
        geometry: &Volume,
        other: &Volume,
        eyes: &[[f64; 3]],
    ) -> Result<Difference, VolumeError> {
        let screen = geometry.screen();
        let maps = eyes.iter().map(|&eye| Map::of(geometry, eye));
        let maps = maps.collect::<Result<Vec<_>, _>>()?;
        let parts = by_number(screen.half_planes(), || {
            let (maps, spread) = (
                &maps,
                maps.first().map(|map| Spread::of(screen, &map.camera)),
            );
            move |half_plane: u32| {
                let direction = direction(screen, half_plane as usize);
                let visible = |voxel: &Voxel| {
                    let Some(spread) = &spread else { return true };
                    maps.iter().any(|map| {
                        let mut seen = false;
                        spread.points(screen, direction, voxel.at, |point| {
                            seen |= map.sees(point);
                        });
                        seen
                    })
                };
                half(geometry, other, half_plane, visible)
            }
        });
        let mut sum = Difference::default();
        let (mut colours, mut both) = (0, 0);
        for (part, colour, count) in parts {
            sum.seen += part.seen;
            sum.missing += part.missing;
            sum.lost += part.lost;
            sum.drawn += part.drawn;
            sum.extra += part.extra;
            sum.wrong += part.wrong;
            colours += colour;
            both += count;
        }
        sum.colour = colours as f64 / (3 * both).max(1) as f64;
        Ok(sum)
    }
}

/// One half plane: the counts, the sum of the colours' differences, and the number of voxels in it.
fn half(
    geometry: &Volume,
    other: &Volume,
    half_plane: u32,
    visible: impl Fn(&Voxel) -> bool,
) -> (Difference, u64, u64) {
    let mut counts = Difference::default();
    let (mut colours, mut both) = (0, 0);
    for voxel in plane(geometry, half_plane)
        .iter()
        .filter(|voxel| visible(voxel))
    {
        counts.seen += 1;
        if found(other, half_plane, voxel.at).is_none() {
            counts.missing += 1;
            counts.lost += usize::from(!near(other, half_plane, voxel.at));
        }
    }
    for voxel in plane(other, half_plane) {
        counts.drawn += 1;
        match found(geometry, half_plane, voxel.at) {
            Some(own) => {
                let pairs = own.colour.iter().zip(voxel.colour);
                colours += pairs.map(|(a, b)| u64::from(a.abs_diff(b))).sum::<u64>();
                both += 1;
            }
            None => {
                counts.extra += 1;
                counts.wrong += usize::from(!near(geometry, half_plane, voxel.at));
            }
        }
    }
    (counts, colours, both)
}

fn plane(volume: &Volume, half_plane: u32) -> &[Voxel] {
    let plane = volume.half_planes.get(half_plane as usize);
    plane.map_or(&[], Vec::as_slice)
}

fn found(volume: &Volume, half_plane: u32, at: u32) -> Option<&Voxel> {
    let plane = plane(volume, half_plane);
    let place = plane.binary_search_by_key(&at, |voxel| voxel.at).ok()?;
    plane.get(place)
}

/// Whether a volume has a voxel or a neighbour of it.
fn near(volume: &Volume, half_plane: u32, at: u32) -> bool {
    let RotatingScreen { pixels, .. } = *volume.screen();
    let (all, columns) = (volume.screen.half_planes(), volume.screen.columns());
    let (row, column) = (at / columns, at % columns);
    let around = |value: u32, end: u32| value.saturating_sub(1)..(value + 2).min(end);
    [all - 1, 0, 1].into_iter().any(|turn| {
        let half_plane = (half_plane + turn) % all;
        around(row, pixels).any(|row| {
            let mut columns_around = around(column, columns);
            columns_around.any(|column| found(volume, half_plane, row * columns + column).is_some())
        })
    })
}

/// The nearest voxels that an eye sees.
struct Map {
    camera: Camera,
    depths: Vec<f32>,
    beyond: f32,
}

impl Map {
    fn of(volume: &Volume, eye: [f64; 3]) -> Result<Map, VolumeError> {
        let screen = volume.screen();
        let camera = Camera::of(screen, eye, [ROWS, ROWS])?;
        let spread = Spread::of(screen, &camera);
        let mut map = Map {
            camera,
            depths: vec![f32::INFINITY; (ROWS * ROWS) as usize],
            beyond: (VISIBLE * screen.radius) as f32,
        };
        for (half_plane, voxels) in volume.half_planes.iter().enumerate() {
            let direction = direction(screen, half_plane);
            for voxel in voxels {
                spread.points(screen, direction, voxel.at, |point| {
                    let [x, y, depth] = map.camera.project(point);
                    if let Some(nearest) = pixel(x, y).and_then(|at| map.depths.get_mut(at)) {
                        *nearest = nearest.min(depth);
                    }
                });
            }
        }
        Ok(map)
    }

    fn sees(&self, point: [f32; 3]) -> bool {
        let [x, y, depth] = self.camera.project(point);
        let nearest = pixel(x, y).and_then(|at| self.depths.get(at));
        nearest.is_some_and(|nearest| depth <= nearest + self.beyond)
    }
}

fn pixel(x: f32, y: f32) -> Option<usize> {
    let inside = (0.0..ROWS as f32).contains(&x) && (0.0..ROWS as f32).contains(&y);
    inside.then(|| y as usize * ROWS as usize + x as usize)
}
