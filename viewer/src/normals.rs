//! Normals and sizes of points that have none, from their neighbours.

use crate::vertex::Vertex;
use glam::{IVec3, Vec3};
use nalgebra::{Matrix3, SymmetricEigen};
use rustc_hash::FxHashMap;

/// Neighbours through which a plane is laid.
const NEIGHBOURS: usize = 12;
/// No more points of a cell are looked at: many may be in one place.
const CROWD: usize = 64;
/// The neighbour whose distance tells how large a point is: on a square grid it is the first beyond the next ones along the axes.
const SIZED_BY: usize = 5;
/// No more points are in a cell on average: with those around it they are enough for a plane.
const CELL_POINTS: usize = 6;
/// Cells are not smaller, as a share of the spacing: many points may be in one place.
const SMALLEST_CELL: f32 = 1e-4;
/// The size of a point without neighbours, as a share of the distance that they would have.
const LONELY: f32 = 0.25;
/// What the disks are larger than half of that distance. Points that lie at random leave exp(−6·(COVER/2)²) of a surface uncovered: 0.07 per cent.
const COVER: f32 = 2.2;

/// Gives the first points normals and radii where they have none; the others are their surroundings. `spacing`: about the distance of neighbours. A radius that is guessed is
/// below zero. Returns the median of those that are guessed; none where there are none.
pub fn complete(points: &mut [Vertex], own: usize, spacing: f32) -> Option<f32> {
    let lacks = |point: &Vertex| !point.has_normal() || point.radius == 0.0;
    if spacing <= 0.0 || !points[..own].iter().any(lacks) {
        return None;
    }
    let mut guessed = Vec::new();
    let (side, cells) = cells(points, spacing);
    let cell = |place: Vec3| cell(place, side);
    let mut near = Vec::new();
    for number in 0..own {
        let point = points[number];
        if !lacks(&point) {
            continue;
        }
        let place = point.at();
        let middle = cell(place);
        near.clear();
        for x in -1..=1 {
            for y in -1..=1 {
                for z in -1..=1 {
                    let around = cells.get(&middle.saturating_add(IVec3::new(x, y, z)));
                    for &other in around.into_iter().flatten().take(CROWD) {
                        let other = points[other as usize].at();
                        near.push((other.distance_squared(place), other));
                    }
                }
            }
        }
        near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        near.truncate(NEIGHBOURS + 1);
        if point.radius == 0.0 {
            let far = near.get(SIZED_BY + 1).or(near.last());
            let distance = far.map_or(0.0, |(squared, _)| squared.sqrt());
            let radius = if distance > 0.0 {
                distance
            } else {
                spacing * LONELY
            };
            points[number].radius = -COVER / 2.0 * radius;
            guessed.push(COVER / 2.0 * radius);
        }
        if !point.has_normal()
            && let Some(normal) = plane(&near, spacing)
        {
            points[number].set_normal(normal);
        }
    }
    let middle = guessed.len() / 2;
    (!guessed.is_empty()).then(|| *guessed.select_nth_unstable_by(middle, f32::total_cmp).1)
}

fn cell(place: Vec3, side: f32) -> IVec3 {
    (place / side).floor().as_ivec3()
}

/// Points in cells, which are as large as a few of their neighbours need: about `spacing`, and smaller where they are closer to each other than that. Returns the
/// side of a cell, and the numbers of the points in each.
fn cells(points: &[Vertex], spacing: f32) -> (f32, FxHashMap<IVec3, Vec<u32>>) {
    let mut side = 2.0 * spacing;
    loop {
        let mut cells: FxHashMap<IVec3, Vec<u32>> = FxHashMap::default();
        for (number, point) in points.iter().enumerate() {
            let own = cells.entry(cell(point.at(), side)).or_default();
            own.push(number as u32);
        }
        let is_smallest = side <= spacing * SMALLEST_CELL;
        if is_smallest || points.len() <= cells.len() * CELL_POINTS {
            return (side, cells);
        }
        side /= 2.0;
    }
}

/// The normal of the plane through points that differs least from them: the direction in which they are spread least. None where they lie in a line.
fn plane(near: &[(f32, Vec3)], spacing: f32) -> Option<Vec3> {
    if near.len() < 4 {
        return None;
    }
    let middle = near.iter().map(|(_, place)| *place).sum::<Vec3>() / near.len() as f32;
    let mut spread = Matrix3::<f32>::zeros();
    for (_, place) in near {
        let from = (*place - middle) / spacing;
        let from = nalgebra::Vector3::new(from.x, from.y, from.z);
        spread += from * from.transpose();
    }
    let eigen = SymmetricEigen::new(spread);
    let least = eigen.eigenvalues.imin();
    let mut values: Vec<f32> = eigen.eigenvalues.iter().copied().collect();
    values.sort_unstable_by(f32::total_cmp);
    let is_line = values[1] <= values[2] * 1e-3;
    let normal = eigen.eigenvectors.column(least);
    (!is_line).then(|| Vec3::new(normal[0], normal[1], normal[2]))
}

#[cfg(test)]
mod tests {
    use super::complete;
    use crate::random::Random;
    use crate::read::Point;
    use crate::vertex::Vertex;
    use glam::{DVec3, Vec3};

    fn points(of: impl Fn(f64, f64) -> DVec3) -> Vec<Vertex> {
        let mut points = Vec::new();
        for x in 0..20 {
            for y in 0..20 {
                let place = of(f64::from(x), f64::from(y));
                points.extend(Vertex::new(&Point::at(place), DVec3::ZERO));
            }
        }
        points
    }

    #[test]
    fn points_of_a_plane_have_its_normal_and_cover_it() {
        let mut points = points(|x, y| DVec3::new(x, y, 0.5 * x));
        let all = points.len();
        complete(&mut points, all, 1.0);
        let normal = Vec3::new(-0.5, 0.0, 1.0).normalize();
        for point in &points {
            let own = Vec3::new(
                point.normal[0].into(),
                point.normal[1].into(),
                point.normal[2].into(),
            );
            assert!((own / 127.0).dot(normal).abs() > 0.999, "{point:?}");
            // The half diagonal of neighbours, and the farthest at a corner.
            assert!(-point.radius >= 0.75 && -point.radius < 3.0, "{point:?}");
        }
    }

    #[test]
    fn a_small_cloud_in_a_large_cube_has_small_points() {
        for spacing in [0.5, 1.0, 20.0, 1000.0] {
            let mut points = points(|x, y| DVec3::new(x, y, 0.0));
            let all = points.len();
            let median = complete(&mut points, all, spacing).unwrap_or_default();
            assert!((0.7..2.0).contains(&median), "{spacing}: {median}");
        }
    }

    #[test]
    fn points_at_random_cover_their_surface() {
        let mut random = Random::new(11);
        let mut place = || DVec3::new(random.unit(), random.unit(), 0.0) * 40.0;
        let made = (0..1600).filter_map(|_| Vertex::new(&Point::at(place()), DVec3::ZERO));
        let mut points: Vec<Vertex> = made.collect();
        let all = points.len();
        complete(&mut points, all, 1.0);
        let covers = |at: Vec3, point: &Vertex| point.at().distance(at) <= -point.radius;
        let tried = (0..4000).map(|_| (place() * 0.8 + 4.0).as_vec3() * Vec3::new(1.0, 1.0, 0.0));
        let bare = tried.filter(|&at| !points.iter().any(|point| covers(at, point)));
        // 0.07 per cent of 4,000 are three.
        assert!(bare.count() < 20);
    }

    #[test]
    fn points_of_a_line_have_no_normal() {
        let mut points = points(|x, y| DVec3::new(20.0 * x + y, 0.0, 0.0));
        let all = points.len();
        complete(&mut points, all, 1.0);
        assert!(
            points
                .iter()
                .all(|point| !point.has_normal() && point.radius < 0.0)
        );
    }

    #[test]
    fn what_the_file_has_stays() {
        let mut own = points(|x, y| DVec3::new(x, y, 0.0));
        for point in &mut own {
            point.set_normal(Vec3::X);
            point.radius = 3.0;
        }
        let before = own.clone();
        let all = own.len();
        complete(&mut own, all, 1.0);
        assert_eq!(own, before);
        // Also where the other is missing.
        own[7].normal = [0; 4];
        own[9].radius = 0.0;
        complete(&mut own, all, 1.0);
        assert_eq!((own[7].radius, own[9].normal), (3.0, before[9].normal));
        assert!(own[7].has_normal() && own[9].radius < 0.0);
    }
}
