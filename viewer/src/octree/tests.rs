use super::{CELLS, Choice, Id, Look, Octree};
use crate::random::Random;
use crate::read::Point;
use crate::vertex::Vertex;
use glam::{DVec3, Mat4, Vec3};
use std::collections::HashSet;

/// A point whose colour is its number.
fn vertex(place: Vec3, number: u32) -> Vertex {
    let mut vertex = Vertex::new(&Point::at(place.as_dvec3()), DVec3::ZERO).expect("finite");
    vertex.colour = number.to_le_bytes();
    vertex
}

/// A sphere, a thick cloud, many points in one place, and a few far away.
fn cloud(random: &mut Random, count: u32) -> Vec<Vertex> {
    (0..count)
        .map(|number| {
            let at = Vec3::from_array([(); 3].map(|()| random.unit() as f32)) - 0.5;
            let place = match number % 100 {
                0..60 => at.normalize_or_zero() * 10.0,
                60..90 => at * 3.0,
                90..99 => Vec3::new(1.0, 2.0, 3.0),
                _ => at * 1e4,
            };
            vertex(place, number)
        })
        .collect()
}

fn tree(points: &[Vertex], memory: u64, at_once: usize) -> Octree {
    let mut tree = Octree::new(DVec3::ZERO, 1.0, memory).expect("a file");
    for some in points.chunks(at_once) {
        tree.insert(some).expect("written");
    }
    tree
}

/// Every point is in one node, in its cube; no two of an inner node are in one cell; a child's cube is an octant of its parent's.
fn verify(tree: &Octree, count: u32) {
    let mut seen = HashSet::new();
    for (id, node) in tree.nodes.iter().enumerate() {
        let points = tree.points(id as Id).expect("read");
        assert_eq!(points.len(), node.count as usize);
        let mut cells = HashSet::new();
        for point in points {
            assert!(node.contains(point.at()), "{point:?} in {node:?}");
            assert!(seen.insert(u32::from_le_bytes(point.colour)), "twice");
            let cell = (point.at() - node.centre + node.half) / (2.0 * node.half / CELLS as f32);
            let is_new = cells.insert(cell.floor().as_ivec3());
            let edge = (cell - cell.round()).abs().min_element() < 1e-3;
            assert!(node.is_leaf() || is_new || edge, "two in a cell");
        }
        for (octant, child) in node.children.iter().enumerate() {
            let Some(child) = child.map(|child| tree.node(child)) else {
                continue;
            };
            assert_eq!(child.parent, Some(id as Id));
            assert_eq!(child.half, node.half / 2.0);
            assert!((child.centre - node.middle(octant)).length() <= node.half * 1e-5);
        }
    }
    assert_eq!(seen.len(), count as usize);
    assert_eq!(tree.count(), u64::from(count));
}

#[test]
fn every_point_is_in_the_tree_once() {
    let mut random = Random::new(7);
    for (count, at_once) in [
        (0, 1),
        (1, 1),
        (3000, 7),
        (100_000, 4096),
        (400_000, 30_000),
    ] {
        let points = cloud(&mut random, count);
        verify(&tree(&points, u64::MAX, at_once), count);
    }
}

#[test]
fn points_that_do_not_fit_into_memory_are_in_the_file() {
    let points = cloud(&mut Random::new(9), 300_000);
    let memory = 1 << 20;
    let mut tree = tree(&points, memory, 4096);
    let inner = tree.nodes.iter().filter(|node| !node.is_leaf()).count() as u64;
    let (cells, some) = (
        inner * (64 * 64 * 64 / 8),
        4096 * size_of::<Vertex>() as u64,
    );
    assert!(
        tree.resident() <= memory.max(cells) + some,
        "{}",
        tree.resident()
    );
    verify(&tree, 300_000);
    tree.finish();
    assert!(tree.resident() <= memory + some);
    verify(&tree, 300_000);
}

#[test]
fn a_hundred_thousand_points_in_one_place_are_one_leaf() {
    let points: Vec<_> = (0..100_000).map(|n| vertex(Vec3::ONE, n)).collect();
    let tree = tree(&points, u64::MAX, 4096);
    verify(&tree, 100_000);
    assert!(tree.nodes.len() < 64, "{}", tree.nodes.len());
}

fn look(eye: Vec3) -> Look {
    let view = glam::camera::rh::view::look_at_mat4(eye, Vec3::ZERO, Vec3::Y);
    let projection = glam::camera::rh::proj::opengl::perspective(0.7, 1.5, 0.1, 1e5);
    Look {
        eye,
        clip: projection * view,
        pixels: 1000.0,
    }
}

/// The list names each drawn node once, after the one above it, where that one says it is.
fn verify_choice(tree: &Octree, choice: &Choice) {
    for (place, chosen) in choice.drawn.iter().enumerate() {
        let node = tree.node(chosen.id);
        let mut next = chosen.first as usize;
        for (octant, child) in node.children.iter().enumerate() {
            if chosen.mask >> octant & 1 == 1 {
                assert!(next > place);
                assert_eq!(Some(choice.drawn[next].id), *child);
                next += 1;
            } else if let Some(child) = child {
                assert!(choice.drawn.iter().all(|other| other.id != *child));
            }
        }
    }
    let ids: HashSet<_> = choice.drawn.iter().map(|chosen| chosen.id).collect();
    assert_eq!(ids.len(), choice.drawn.len());
    for id in &ids {
        let above = tree.node(*id).parent;
        assert!(above.is_none_or(|above| ids.contains(&above)));
    }
}

#[test]
fn a_frame_has_no_more_points_than_it_may() {
    let points = cloud(&mut Random::new(3), 400_000);
    let tree = tree(&points, u64::MAX, 30_000);
    let mut before = 0;
    for budget in [0, 20_000, 100_000, 1_000_000] {
        let choice = tree.choose(&look(Vec3::new(0.0, 5.0, 30.0)), budget, &|_| true);
        verify_choice(&tree, &choice);
        let drawn = choice
            .drawn
            .iter()
            .map(|chosen| u64::from(tree.node(chosen.id).count));
        let drawn: u64 = drawn.sum();
        assert!(drawn <= budget && drawn >= before, "{drawn} of {budget}");
        assert_eq!(choice.is_limited, budget < 400_000, "{budget}");
        before = drawn;
    }
    assert!(before > 200_000, "{before}");
}

#[test]
fn what_is_not_ready_is_asked_for_and_nothing_below_it_is_drawn() {
    let points = cloud(&mut Random::new(5), 200_000);
    let tree = tree(&points, u64::MAX, 30_000);
    let from = look(Vec3::new(0.0, 5.0, 30.0));
    let all = tree.choose(&from, u64::MAX, &|_| true);
    assert!(all.missing.is_empty());
    let missing = all.drawn[2].id;
    let choice = tree.choose(&from, u64::MAX, &|id| id != missing);
    verify_choice(&tree, &choice);
    assert_eq!(choice.missing, [missing]);
    assert!(choice.drawn.iter().all(|chosen| chosen.id != missing));
}

#[test]
fn what_is_behind_the_viewer_is_not_drawn() {
    let points: Vec<_> = (0..1000)
        .map(|n| vertex(Vec3::new(0.0, 0.0, n as f32 * 1e-4), n))
        .collect();
    let tree = tree(&points, u64::MAX, 100);
    let mut behind = look(Vec3::new(0.0, 0.0, 50.0));
    assert_eq!(tree.choose(&behind, u64::MAX, &|_| true).drawn.len(), 1);
    behind.clip *= Mat4::from_translation(Vec3::new(0.0, 0.0, 120.0));
    assert_eq!(tree.choose(&behind, u64::MAX, &|_| true).drawn.len(), 0);
}

#[test]
fn what_is_beside_the_picture_is_drawn_where_other_views_may_see_it() {
    let points: Vec<_> = (0..1000)
        .map(|n| vertex(Vec3::new(n as f32 * 1e-4, 0.0, 0.0), n))
        .collect();
    let tree = tree(&points, u64::MAX, 100);
    // The right edge of the picture is where x/z is this.
    let edge = 1.5 * 0.35_f32.tan();
    let drawn = |share: f32, up: f32| {
        let mut from = look(Vec3::new(0.0, 0.0, 50.0));
        let aside = Vec3::new(50.0 * edge * share, 50.0 * 0.35_f32.tan() * up, 0.0);
        from.clip *= Mat4::from_translation(aside);
        tree.choose(&from, u64::MAX, &|_| true).drawn.len()
    };
    assert_eq!(
        [
            drawn(0.9, 0.0),
            drawn(1.1, 0.0),
            drawn(1.3, 0.0),
            drawn(-1.3, 0.0)
        ],
        [1, 1, 0, 0]
    );
    assert_eq!(
        [drawn(0.0, 0.9), drawn(0.0, 1.1), drawn(0.0, -1.1)],
        [1, 0, 0]
    );
}
