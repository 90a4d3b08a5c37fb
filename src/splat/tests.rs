use super::cover::{Cover, cover, facing};
use super::disk::{Parameters, axes, hit, on_plane};
use super::groups::Groups;
use super::random::Random;
use super::reference::{Surface, picture, weight};
use super::{Eyes, Fault, Screen, Splat};
use crate::display::{Display, Placement};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

impl Random {
    fn next(&mut self) -> f64 {
        self.between(0.0, 1.0)
    }

    fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let (sine, cosine) = self.between(0.0, TAU).sin_cos();
        let flat = (1.0 - z * z).sqrt();
        DVec3::new(flat * cosine, flat * sine, z)
    }

    /// A splat somewhere before or behind the screen: every fourth is seen from its edge, nearly or wholly.
    fn splat(&mut self) -> Splat {
        let centre = DVec3::new(
            self.between(-3.0, 3.0),
            self.between(-2.0, 2.0),
            self.between(-1.0, 12.0),
        );
        let mut normal = self.direction();
        if self.next() < 0.25 {
            let sight = centre.normalize();
            normal -= sight * normal.dot(sight) * (1.0 - self.between(-1e-9, 1e-9));
        }
        let radius = 10.0_f64.powf(self.between(-4.0, 0.5));
        Splat::new(centre, normal, radius, [1.0; 3]).expect("a splat")
    }
}

const EYES: Eyes = Eyes {
    views: 8,
    spacing: 0.1,
    focal: 4.0,
    near: 0.05,
};

const SPLATS: usize = 1000;

/// A point of the disk.
fn point(splat: &Splat, angle: f64, share: f64) -> DVec3 {
    let [u, v] = axes(splat.normal);
    let (sine, cosine) = angle.sin_cos();
    splat.centre + (u * cosine + v * sine) * splat.radius * share
}

/// Where a camera sees a point.
fn seen(point: DVec3, offset: f64) -> DVec2 {
    let scale = EYES.focal / point.z;
    DVec2::new((point.x - offset) * scale + offset, point.y * scale)
}

#[test]
fn the_axes_of_a_disk_are_at_right_angles() {
    let mut random = Random::new(1);
    let along = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::Z];
    let any = (0..SPLATS).map(|_| random.direction());
    for normal in along.into_iter().chain(any) {
        let [u, v] = axes(normal);
        for (a, b, expected) in [
            (u, u, 1.0),
            (v, v, 1.0),
            (u, v, 0.0),
            (u, normal, 0.0),
            (v, normal, 0.0),
        ] {
            assert!((a.dot(b) - expected).abs() < 1e-14, "{normal}");
        }
    }
}

/// A ray through a point of the disk meets that point, and one beside the disk does not.
#[test]
fn rays_meet_the_points_that_they_go_through() {
    let mut random = Random::new(2);
    let mut met = 0;
    for _ in 0..SPLATS {
        let splat = random.splat();
        let offset = EYES.offset((random.next() * 8.0) as u32);
        let (angle, share) = (random.between(0.0, TAU), random.between(0.0, 2.0));
        let expected = point(&splat, angle, share);
        let eye = DVec3::new(offset, 0.0, 0.0);
        let steep = splat.normal.dot((expected - eye).normalize()).abs();
        if expected.z < 2.0 * EYES.near || (share - 1.0).abs() < 1e-3 || steep < 1e-3 {
            continue;
        }
        met += 1;
        let place = seen(expected, offset);
        let found = on_plane(&splat, &EYES, offset, place).expect("a point");
        let off = found.distance(expected) / expected.length();
        assert!(off < 1e-10, "{splat:?}: {off}");
        let hit = hit(&splat, &EYES, offset, place);
        assert_eq!(hit.is_some(), share < 1.0, "{splat:?}");
        if let Some(hit) = hit {
            assert!((hit.distance - share).abs() < 1e-7, "{splat:?}");
            assert!((hit.depth - expected.z).abs() < 1e-9, "{splat:?}");
        }
    }
    assert!(met > SPLATS / 2, "{met}");
}

/// The parameters find what the ray finds, wherever on the screen and for every camera.
#[test]
fn parameters_are_the_ray() {
    let mut random = Random::new(3);
    let mut met = 0;
    for _ in 0..SPLATS {
        let splat = random.splat();
        let parameters = Parameters::new(&splat, &EYES);
        for _ in 0..20 {
            let offset = EYES.offset((random.next() * 8.0) as u32);
            let about = seen(
                point(&splat, random.between(0.0, TAU), random.between(0.0, 1.5)),
                offset,
            );
            let (ray, short) = (
                hit(&splat, &EYES, offset, about),
                parameters.hit(&EYES, offset, about),
            );
            // What a rounding of the numbers does to a place in the plane, in radii: much for small splats that are seen from their edge.
            let sight = about.extend(EYES.focal) - DVec3::new(offset, 0.0, 0.0);
            let steep = splat.normal.dot(sight.normalize()).abs();
            let near = 1e-13 * splat.centre.length() / (splat.radius * steep);
            if near > 0.01 {
                continue;
            }
            match (ray, short) {
                (None, None) => {}
                (Some(ray), Some(short)) => {
                    met += 1;
                    assert!((ray.distance - short.distance).abs() < near, "{splat:?}");
                    let off = (ray.depth - short.depth).abs();
                    assert!(off < near * splat.radius, "{splat:?}: {off}");
                }
                // At the edge either may be right.
                (ray, short) => {
                    let hit = ray.or(short).expect("one");
                    let edge = (hit.distance - 1.0).abs() < near
                        || (hit.depth - EYES.near).abs() < near * splat.radius;
                    assert!(edge, "{splat:?}: {ray:?}, {short:?}");
                }
            }
        }
    }
    assert!(met > 5 * SPLATS, "{met}");
}

/// A ray in the plane of the disk meets nothing, and gives no infinite numbers.
#[test]
fn a_disk_that_is_seen_from_its_edge_is_not_seen() {
    for normal in [DVec3::X, DVec3::Y] {
        let splat = Splat::new(DVec3::Z * 4.0, normal, 1.0, [1.0; 3]).expect("a splat");
        let parameters = Parameters::new(&splat, &EYES);
        assert!(parameters.at(0.0, DVec2::ZERO).is_finite());
        assert_eq!(parameters.hit(&EYES, 0.0, DVec2::ZERO), None);
        assert_eq!(hit(&splat, &EYES, 0.0, DVec2::ZERO), None);
    }
}

/// The bounds hold the disk in all views, and touch it.
#[test]
fn the_cover_is_the_smallest_one() {
    const STEPS: u32 = 2000;
    let mut random = Random::new(4);
    let mut bounded = 0;
    for _ in 0..SPLATS {
        let splat = random.splat();
        let depths = (0..STEPS).map(|step| f64::from(step) / f64::from(STEPS) * TAU);
        let rim: Vec<DVec3> = depths.map(|angle| point(&splat, angle, 1.0)).collect();
        let Some(found) = cover(&splat, &EYES) else {
            assert!(rim.iter().all(|point| point.z < EYES.near), "{splat:?}");
            continue;
        };
        if !found.low.is_finite() {
            let nearest = rim.iter().map(|point| point.z).fold(f64::MAX, f64::min);
            assert!(nearest < EYES.near + 1e-6, "{splat:?}");
            continue;
        }
        bounded += 1;
        let all = rim
            .iter()
            .flat_map(|point| (0..EYES.views).map(|view| seen(*point, EYES.offset(view))));
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for place in all {
            (low, high) = (low.min(place), high.max(place));
        }
        let size = (found.high - found.low).max(DVec2::splat(1e-9));
        let slack = (low - found.low).max(found.high - high) / size;
        let over = (found.low - low).max(high - found.high) / size;
        assert!(over.max_element() < 1e-7, "{splat:?}: {over}");
        assert!(slack.max_element() < 2e-5, "{splat:?}: {slack}");
    }
    assert!(bounded > SPLATS / 2, "{bounded}");
}

/// Equation 6 holds disks that face the viewer, and not all others.
#[test]
fn the_papers_quad_is_too_small_for_a_tilted_disk_near_the_camera() {
    let facing_it = Splat::new(DVec3::new(0.3, 0.2, 2.0), DVec3::Z, 0.5, [1.0; 3]);
    let facing_it = facing_it.expect("a splat");
    let (paper, exact) = (
        facing(&facing_it, &EYES).expect("a quad"),
        cover(&facing_it, &EYES).expect("a quad"),
    );
    assert!((paper.low - exact.low).length() < 1e-12);
    assert!((paper.high - exact.high).length() < 1e-12);
    let tilted = Splat {
        normal: DVec3::new(0.0, 0.6, 0.8),
        centre: DVec3::Z * 2.0,
        radius: 1.0,
        ..facing_it
    };
    let (paper, exact) = (
        facing(&tilted, &EYES).expect("a quad"),
        cover(&tilted, &EYES).expect("a quad"),
    );
    let place = seen(point(&tilted, TAU * 0.99, 1.0), EYES.offset(0));
    assert!(exact.contains(place));
    let outside = |cover: &Cover| {
        // A little within the rim, which rounding may put outside.
        let rim = (0..1000).map(|step| point(&tilted, f64::from(step) / 1000.0 * TAU, 1.0 - 1e-12));
        rim.filter(|rim| !cover.contains(seen(*rim, EYES.offset(0))))
            .count()
    };
    assert!(outside(&paper) > 100);
    assert_eq!(outside(&exact), 0);
}

#[test]
fn a_splat_without_place_size_or_direction_is_refused() {
    let new = |centre, normal, radius| {
        Splat::new(centre, normal, radius, [1.0; 3]).map(|splat| splat.normal)
    };
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(
            new(DVec3::X * wrong, DVec3::Z, 1.0),
            Err(Fault::NotFinite),
            "{wrong}"
        );
        assert_eq!(
            new(DVec3::Z, DVec3::splat(wrong), 1.0),
            Err(Fault::NotFinite)
        );
        assert_eq!(new(DVec3::Z, DVec3::Z, wrong), Err(Fault::NotFinite));
    }
    assert_eq!(new(DVec3::Z, DVec3::Z, 0.0), Err(Fault::NoRadius));
    assert_eq!(new(DVec3::Z, DVec3::Z, -1.0), Err(Fault::NoRadius));
    assert_eq!(new(DVec3::Z, DVec3::ZERO, 1.0), Err(Fault::NoNormal));
    assert_eq!(new(DVec3::Z, DVec3::Z * 1e300, 1.0), Ok(DVec3::Z));
    assert_eq!(new(DVec3::Z, DVec3::X * 1e-300, 1.0), Ok(DVec3::X));
}

/// A wavy sheet of splats, each with a colour of its own.
fn sheet(random: &mut Random, side: u32) -> Vec<Splat> {
    let step = 4.0 / f64::from(side);
    let all = (0..side * side).map(|number| {
        let (x, y) = (f64::from(number % side), f64::from(number / side));
        let (x, y) = ((x + 0.5) * step - 2.0, (y + 0.5) * step - 2.0);
        let centre = DVec3::new(x, y, 4.0 + 0.3 * (2.0 * x).sin());
        let normal = DVec3::new(0.6 * (2.0 * x).cos(), 0.0, -1.0);
        let colour = [(); 3].map(|()| random.next() as f32);
        Splat::new(centre, normal, 1.2 * step, colour).expect("a splat")
    });
    all.collect()
}

#[test]
fn splats_of_a_group_do_not_overlap() {
    let mut random = Random::new(5);
    let mut splats = sheet(&mut random, 30);
    splats.extend((0..300).map(|_| random.splat()));
    let groups = Groups::new(&splats);
    assert_eq!(groups.of.len(), splats.len());
    for (a, first) in splats.iter().enumerate() {
        for (b, second) in splats.iter().enumerate().skip(a + 1) {
            let apart = first.centre.distance(second.centre) >= first.radius + second.radius;
            assert!(apart || groups.of[a] != groups.of[b]);
        }
    }
    let sheet_alone = Groups::new(&sheet(&mut random, 30));
    assert!(sheet_alone.count <= 16, "{}", sheet_alone.count);
    assert_eq!(Groups::new(&[]).count, 0);
}

/// On one surface all ways to blend agree, and views differ from each other.
#[test]
fn deferred_blending_is_blending_where_nothing_is_hidden() {
    let mut random = Random::new(6);
    let splats = sheet(&mut random, 24);
    let screen = Screen {
        size: (48, 32),
        half: 1.2,
    };
    let display = Display::named("huebner8").expect("a display");
    let mask = display
        .mask(&Placement::full_screen(48, 32), EYES.views)
        .expect("a mask");
    let show = |surface| picture(&splats, (&EYES, &screen), &mask, surface);
    let behind = 0.5;
    let blended = show(Surface::Blended(behind));
    let groups = Groups::new(&splats);
    for averaged in [false, true] {
        let deferred = show(Surface::Deferred {
            behind,
            groups: &groups,
            averaged,
        });
        let off = blended.iter().zip(deferred.iter());
        let off = off.filter(|(a, b)| a.abs_diff(**b) > 1).count();
        assert_eq!(off, 0, "averaged: {averaged}");
    }
    assert_ne!(show(Surface::Opaque), blended);
    let one = Eyes {
        spacing: 0.0,
        ..EYES
    };
    let flat = picture(&splats, (&one, &screen), &mask, Surface::Opaque);
    assert_ne!(show(Surface::Opaque), flat);
    assert!(
        blended.iter().all(|value| *value > 0),
        "the sheet covers the screen"
    );
}

#[test]
fn weights_end_at_the_edge() {
    assert_eq!([0.0, 1.0, 2.0].map(weight), [1.0, 0.0, 0.0]);
    assert!(weight(0.3) > weight(0.6));
}
