//! Tests of the voxels that a surface sets.

use super::*;
use proptest::prelude::*;
use std::collections::{HashMap, HashSet};

/// A point in sectors, pixels down and pixels outwards, by angles of the standard library.
fn exact(screen: &RotatingScreen, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let turn = z.atan2(x).rem_euclid(std::f64::consts::TAU) / screen.sector() + 0.5;
    let down = (screen.radius - y) / screen.pixel();
    [turn, down, x.hypot(z) / screen.pixel()]
}

/// Points all over a triangle, some 0.2 pixels apart.
fn points(screen: &RotatingScreen, corners: [[f32; 3]; 3]) -> Vec<[f64; 3]> {
    let [a, b, c] = corners.map(|corner| corner.map(f64::from));
    let far = |a: [f64; 3], b: [f64; 3]| {
        let parts = a.iter().zip(b).map(|(a, b)| (a - b).powi(2));
        parts.sum::<f64>().sqrt()
    };
    let longest = far(a, b).max(far(b, c)).max(far(c, a));
    let n = (longest / screen.pixel() / 0.2).ceil().max(1.0) as u32;
    let mut points = Vec::new();
    for i in 0..=n {
        for j in 0..=n - i {
            let (i, j) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
            points.push([0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * i + (c[k] - a[k]) * j));
        }
    }
    points
}

/// How far a place is from a voxel: in rows and columns, and across in sectors or, where those are narrower, in pixels.
fn distance(screen: &RotatingScreen, place: [f64; 3], cell: [u32; 3]) -> f64 {
    let beyond = |at: f64, low: f64| (low - at).max(at - low - 1.0).max(0.0);
    let all = f64::from(screen.half_planes());
    let off = (place[0] - f64::from(cell[0]) - 0.5).rem_euclid(all);
    let turn = (off.min(all - off) - 0.5).max(0.0);
    let across = turn * (place[2] * screen.sector()).min(1.0);
    let [_, row, column] = cell.map(f64::from);
    across
        .max(beyond(place[1], row))
        .max(beyond(place[2], column))
}

/// Checks that every lit voxel is near the triangle and that every point of the triangle is near a lit voxel.
fn check(screen: &RotatingScreen, corners: [[f32; 3]; 3]) -> Result<(), TestCaseError> {
    let lit: HashSet<[u32; 3]> = cells(&volume(screen, corners)).into_iter().collect();
    prop_assert!(!lit.is_empty(), "nothing is lit");
    let all = screen.half_planes();
    let mut nearest: HashMap<[u32; 3], f64> = HashMap::new();
    for point in points(screen, corners) {
        let place = exact(screen, point);
        // Sectors that are no wider than a pixel.
        let beside = (1.0 / (place[2] * screen.sector()).max(1e-9))
            .ceil()
            .min(f64::from(all) / 2.0);
        let beside = (beside as i64).max(1);
        let mut best = f64::INFINITY;
        for row in -1..=1 {
            for column in -1..=1 {
                for turn in -beside..=beside {
                    let turn = (place[0] as i64 + turn).rem_euclid(i64::from(all));
                    let (row, column) = (place[1] as i64 + row, place[2] as i64 + column);
                    let (Ok(row), Ok(column)) = (u32::try_from(row), u32::try_from(column)) else {
                        continue;
                    };
                    let cell = [turn as u32, row, column];
                    if lit.contains(&cell) {
                        let off = distance(screen, place, cell);
                        best = best.min(off);
                        let nearest = nearest.entry(cell).or_insert(off);
                        *nearest = nearest.min(off);
                    }
                }
            }
        }
        prop_assert!(best <= 1.0, "{place:?} is {best} from what is lit");
    }
    for cell in lit {
        let off = nearest.get(&cell).copied().unwrap_or(f64::INFINITY);
        prop_assert!(off <= 0.5, "{cell:?} is {off} from the triangle");
    }
    Ok(())
}

fn point() -> impl Strategy<Value = [f32; 3]> {
    [-2.85_f32..2.85, -2.85_f32..2.85, -2.85_f32..2.85]
}

/// A triangle within the sphere; most are small, and some are near the axis.
fn inside() -> impl Strategy<Value = [[f32; 3]; 3]> {
    let size = prop_oneof![Just(0.01_f32), Just(0.1), Just(0.4), Just(1.0)];
    let axis = prop_oneof![3 => Just(1.0_f32), 1 => Just(0.05)];
    (point(), point(), point(), size, axis).prop_map(|(a, b, c, size, axis)| {
        let at = |to: [f32; 3]| [0, 1, 2].map(|i| a[i] + (to[i] - a[i]) * size);
        [a, at(b), at(c)].map(|[x, y, z]| [x * axis, y, z * axis])
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn any_triangle_is_lit_where_it_is_and_nowhere_else(corners in inside()) {
        check(&SMALL, corners)?;
    }

    #[test]
    fn so_is_any_small_one_of_the_display_of_the_paper(
        at in point(),
        across in [[-0.15_f32..0.15, -0.15..0.15, -0.15..0.15], [-0.15_f32..0.15, -0.15..0.15, -0.15..0.15]],
    ) {
        let beside = across.map(|by| [0, 1, 2].map(|i| at[i] + by[i]));
        check(&RotatingScreen::POPESCU, [at, beside[0], beside[1]])?;
    }
}

#[test]
fn a_triangle_in_the_plane_of_a_slice_fills_it_there() {
    let screen = RotatingScreen::POPESCU;
    let volume = volume(&screen, [[1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [1.0, 2.0, 0.0]]);
    let lit = cells(&volume);
    assert!(lit.iter().all(|cell| cell[0] == 0), "in one slice");
    let area = 2.0 / screen.pixel().powi(2);
    let share = lit.len() as f64 / area;
    assert!((0.98..1.03).contains(&share), "{share} of its pixels");
    let picture = volume.dithered().picture(0);
    assert_ne!(picture.get_pixel(384 + 77, 383).0, [255; 3], "dithered");
    let light: u32 = picture
        .pixels()
        .map(|pixel| u32::from(pixel.0[0] > 0))
        .sum();
    assert!(
        light > 0
            && volume
                .dithered()
                .picture(1)
                .pixels()
                .all(|pixel| pixel.0 == [0; 3])
    );
}

#[test]
fn a_triangle_across_slices_is_an_unbroken_line_in_each() {
    let screen = RotatingScreen::POPESCU;
    let corners = [[1.0, 0.5, -2.0], [4.0, 0.5, 0.1], [1.5, 0.5, 2.0]];
    let by_plane = |cells: &mut dyn Iterator<Item = [u32; 3]>| {
        let mut planes: HashMap<u32, Vec<u32>> = HashMap::new();
        for [half_plane, row, column] in cells {
            assert_eq!(row, 384 - 39, "of one height");
            planes.entry(half_plane).or_default().push(column);
        }
        planes
    };
    let planes = by_plane(&mut cells(&volume(&screen, corners)).into_iter());
    let exact = points(&screen, corners).into_iter().map(|point| {
        let [turn, row, column] = exact(&screen, point);
        [
            turn as u32 % screen.half_planes(),
            row as u32,
            column as u32,
        ]
    });
    let exact = by_plane(&mut { exact });
    let mut found: Vec<&u32> = planes.keys().collect();
    let mut wanted: Vec<&u32> = exact.keys().collect();
    found.sort_unstable();
    wanted.sort_unstable();
    assert_eq!(found, wanted, "from -63° to 53°, a sector being 0.91°");
    for (half_plane, columns) in planes {
        let broken = columns.windows(2).any(|pair| pair[1] != pair[0] + 1);
        assert!(!broken, "{half_plane}: {columns:?}");
        // A piece may stand for half a sector, which is three pixels wide.
        let wanted = &exact[&half_plane];
        let ends = [columns.iter().min(), columns.iter().max()];
        let exact = [wanted.iter().min(), wanted.iter().max()];
        let off = ends
            .iter()
            .zip(exact)
            .map(|(a, b)| a.unwrap().abs_diff(*b.unwrap()));
        assert!(
            off.max() <= Some(2),
            "{half_plane}: {columns:?} for {exact:?}"
        );
    }
}

#[test]
fn a_wall_between_two_planes_is_in_a_slice_all_the_same() {
    let screen = RotatingScreen::POPESCU;
    // A third of a sector from plane 7, nearly parallel to it: no plane meets it.
    let angle = (7.3 * screen.sector()) as f32;
    let at = |out: f32, y: f32| [out * angle.cos(), y, out * angle.sin()];
    let lit = cells(&volume(
        &screen,
        [at(2.0, -1.0), at(3.0, -1.0), at(2.5, 1.0)],
    ));
    assert!(lit.iter().all(|cell| cell[0] == 7));
    let share = lit.len() as f64 / (1.0 / screen.pixel().powi(2));
    assert!((0.98..1.03).contains(&share), "{share} of its pixels");
}

#[test]
fn what_the_axis_goes_through_is_in_every_slice() {
    let screen = RotatingScreen::POPESCU;
    let lit = cells(&volume(
        &screen,
        [[-1.0, 1.0, -1.0], [1.5, 1.0, -1.0], [0.0, 1.0, 1.5]],
    ));
    for half_plane in 0..screen.half_planes() {
        let middle = lit.iter().any(|cell| cell[0] == half_plane && cell[2] == 0);
        assert!(middle, "half plane {half_plane}");
    }
    // Within a pixel from the axis, around it and beside it.
    let small = |x: f32| {
        let corners = [
            [x - 4e-3, 1.0, -4e-3],
            [x + 4e-3, 1.0, -4e-3],
            [x, 1.0, 5e-3],
        ];
        let lit = cells(&volume(&screen, corners));
        assert!(lit.iter().all(|cell| cell[2] == 0), "{lit:?}");
        lit.len()
    };
    assert_eq!(small(0.0), 396);
    // Seen from the axis, the triangle beside it is 2 · atan(4 / 4.5) wide, and slightly more for the corner towards the viewer.
    let beside = small(8e-3);
    assert!((85..150).contains(&beside), "{beside}");
    // In a plane through the axis: both sides of one slice. Voxels in the column on the axis may be counted to their neighbours.
    let lit = cells(&volume(
        &screen,
        [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    ));
    let off_axis = lit.iter().filter(|cell| cell[2] > 0);
    let planes: HashSet<u32> = off_axis.map(|cell| cell[0]).collect();
    assert_eq!(planes, HashSet::from([0, 198]));
    // A corner on the axis itself.
    let lit = cells(&volume(
        &screen,
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.5, 0.0]],
    ));
    assert!(lit.iter().any(|cell| cell[2] == 0) && lit.iter().any(|cell| cell[2] == 76));
}

#[test]
fn the_rim_is_within_the_display() {
    let screen = RotatingScreen::POPESCU;
    let point = |at: [f32; 3]| cells(&volume(&screen, [at; 3]));
    assert_eq!(point([5.0, 0.0, 0.0]), [[0, 384, 383]]);
    assert_eq!(point([0.0, 0.0, -5.0]), [[297, 384, 383]]);
    assert_eq!(point([0.3, -4.99, 0.0]), [[0, 767, 23]]);
    assert!(
        point([0.0, 5.0, 0.0])
            .iter()
            .all(|cell| cell[1..] == [0, 0])
    );
    assert_eq!(point([5.01, 0.0, 0.0]), [[0; 3]; 0]);
}

#[test]
fn what_has_no_area_is_a_point_or_a_line() {
    assert_eq!(cells(&volume(&SMALL, [[2.0, 1.0, 2.0]; 3])), [[10, 51, 36]]);
    let line = cells(&volume(
        &SMALL,
        [[1.0, 1.0, 0.0], [3.0, 1.0, 0.0], [2.0, 1.0, 0.0]],
    ));
    let columns: Vec<u32> = line.iter().map(|cell| cell[2]).collect();
    assert!(columns.len() >= 25, "{columns:?}");
    assert!(
        columns.windows(2).all(|pair| pair[1] == pair[0] + 1),
        "{columns:?}"
    );
}

#[test]
fn what_is_no_number_sets_nothing() {
    let good = [[1.0, 0.0, 0.0], [2.0, 0.0, 0.5], [1.0, 1.0, 0.0]];
    assert!(!volume(&SMALL, good).is_empty());
    for corner in 0..3 {
        for part in 0..3 {
            for wrong in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
                let mut corners = good;
                corners[corner][part] = wrong;
                assert!(volume(&SMALL, corners).is_empty(), "{corners:?}");
            }
        }
    }
}

#[test]
fn what_is_outside_is_cut_off() {
    assert!(volume(&SMALL, [[5.5, 0.0, 0.0], [7.0, 0.0, 0.0], [6.0, 3.0, 0.0]]).is_empty());
    assert!(volume(&SMALL, [[0.0, 5.5, 0.0], [1.0, 7.0, 0.0], [0.0, 6.0, 1.0]]).is_empty());
    // In the corner between the sphere and the square around a slice.
    assert!(volume(&SMALL, [[4.0, 4.0, 0.0], [4.4, 4.0, 0.0], [4.0, 4.4, 0.0]]).is_empty());
    for size in [6.0_f32, 1e3, 1e6, 1e12] {
        let disc = volume(
            &SMALL,
            [
                [-size, 0.3, -size],
                [size, 0.3, -size],
                [0.0, 0.3, 2.0 * size],
            ],
        );
        let lit = cells(&disc);
        assert!(lit.iter().all(|cell| cell[1] == 60), "{size}");
        // Except for the part of the sphere that a triangle of this size leaves out, and the rim.
        let share = lit.len() as f64 / f64::from(SMALL.half_planes() * SMALL.columns());
        assert!(
            share > 0.95 || size < 10.0 && share > 0.7,
            "{size}: {share}"
        );
    }
}

/// A bumpy wall of samples, some of it so steep that it is not joined.
fn wall(size: u32) -> ReferenceImage {
    let at = |x: u32, y: u32| {
        let [u, v] = [x, y].map(|part| 7.0 * (part as f32 / (size - 1) as f32 - 0.5));
        let z = 1.5 * (1.3 * u).sin() * (0.9 * v).cos() + if u > 1.0 { 1.0 } else { 0.0 };
        [u, -v, z]
    };
    let samples = (0..size * size).map(|index| {
        let (x, y) = (index % size, index / size);
        let colour = [(255 * x / size) as u8, (255 * y / size) as u8, 90];
        let near = |to: [f32; 3]| (at(x, y)[2] - to[2]).abs() < 0.5;
        let joined = Joined::of(near(at(x + 1, y)), near(at(x, y + 1)));
        let hole = x.pow(2) + y.pow(2) < 100;
        (!hole).then_some(Sample {
            at: at(x, y),
            colour,
            joined,
        })
    });
    ReferenceImage::new([size, size], samples.collect()).unwrap()
}

#[test]
fn a_reference_image_is_drawn_as_its_triangles_are() {
    for (screen, size) in [(SMALL, 40), (SMALL, 300), (RotatingScreen::POPESCU, 150)] {
        let image = wall(size);
        let mesh = image.triangles();
        assert!(mesh.len() as u32 > size * size, "most samples are joined");
        let mesh = Volume::of_triangles(&screen, &mesh).unwrap();
        let drawn = Volume::of_reference(&screen, &image).unwrap();
        let off = Difference::between(&mesh, &drawn, &[]).unwrap();
        assert_eq!(off.seen, mesh.len());
        assert!(off.lost * 1000 <= off.seen, "{size}: {off:?}");
        assert!(off.wrong * 1000 <= off.drawn, "{size}: {off:?}");
        assert!(
            off.missing * 4 <= off.seen && off.colour < 2.0,
            "{size}: {off:?}"
        );
    }
}

#[test]
fn a_sample_that_is_joined_to_none_is_a_point() {
    let sample = |joined| {
        Some(Sample {
            at: [2.0, 1.0, 2.0],
            colour: GREY,
            joined,
        })
    };
    let alone = ReferenceImage::new([1, 1], vec![sample(Joined::Both)]).unwrap();
    let lit = Volume::of_reference(&SMALL, &alone).unwrap();
    assert_eq!(cells(&lit), [[10, 51, 36]]);
    let apart = vec![sample(Joined::Neither), None, sample(Joined::Right), None];
    let apart = ReferenceImage::new([2, 2], apart).unwrap();
    assert_eq!(Volume::of_reference(&SMALL, &apart).unwrap().len(), 1);
    assert!(apart.triangles().is_empty());
    let nothing = ReferenceImage::new([0, 0], Vec::new()).unwrap();
    assert!(Volume::of_reference(&SMALL, &nothing).unwrap().is_empty());
    let error = ReferenceImage::new([2, 2], Vec::new()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the reference image has 0 samples; give 2 x 2 of them"
    );
}

#[test]
fn colours_are_interpolated() {
    let corner = |at, colour| Vertex { at, colour };
    let triangle = [
        corner([1.0, 0.0, 0.0], [0, 0, 200]),
        corner([3.0, 0.0, 0.0], [200, 0, 200]),
        corner([1.0, 2.0, 0.0], [0, 100, 200]),
    ];
    let volume = Volume::of_triangles(&SMALL, &[triangle]).unwrap();
    for voxel in volume.half_planes().iter().flatten() {
        let [x, y, _] = SMALL.centre(0, voxel.at);
        let wanted = [100.0 * (x - 1.0), 50.0 * y, 200.0];
        for (value, wanted) in voxel.colour.into_iter().zip(wanted) {
            let off = (f64::from(value) - wanted).abs();
            assert!(
                off < 9.0,
                "{:?} instead of {wanted:?} at {x}, {y}",
                voxel.colour
            );
        }
    }
}
