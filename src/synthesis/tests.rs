//! Small scenes whose views are known.

use super::*;
use proptest::prelude::*;

const SIZE: [u32; 2] = [96, 64];
/// 1/w of the background, and of the columns before it.
const FAR: f64 = 0.1;
const NEAR: f64 = 0.25;
const THRESHOLD: f64 = 0.02;

fn at_zero_parallax(separation: f64) -> Shift {
    Shift {
        separation,
        convergence: 1.0 / NEAR,
    }
}

/// Two triangles in front of the camera; each corner with the same 1/w.
fn rectangle(
    [left, top, right, bottom]: [f64; 4],
    inverse: f64,
    colour: [f64; 3],
) -> [Triangle; 2] {
    let vertex = |x, y| Vertex {
        at: [x, y],
        inverse,
        colour,
    };
    let [a, b, c, d] = [
        vertex(left, top),
        vertex(right, top),
        vertex(right, bottom),
        vertex(left, bottom),
    ];
    [[a, b, c], [a, c, d]]
}

/// A background that gets lighter to the right with columns before it.
fn columns(places: &[[f64; 2]]) -> Vec<Triangle> {
    let mut behind = rectangle([-40.0, 0.0, 136.0, 64.0], FAR, [0.0; 3]);
    for vertex in behind.as_flattened_mut() {
        vertex.colour[1] = if vertex.at[0] < 0.0 { 40.0 } else { 250.0 };
    }
    let before = places
        .iter()
        .flat_map(|&[left, right]| rectangle([left, 16.0, right, 48.0], NEAR, [200.0, 0.0, 0.0]));
    behind.into_iter().chain(before).collect()
}

fn none() -> Distortions {
    let nothing = Splats {
        radius: 0.0,
        parallax: f64::INFINITY,
        asymmetry: 1.0,
    };
    Distortions::of(SIZE, &Edges::default(), &nothing)
}

fn drawn(scene: &[Triangle], distortions: &Distortions, longest: f64) -> Reference {
    let mut reference = Reference::new(SIZE);
    reference.draw(scene.iter().copied(), distortions, longest);
    reference
}

fn depth_image(scene: &[Triangle]) -> DepthImage {
    let drawn = drawn(scene, &none(), f64::INFINITY);
    let picture = drawn.picture().picture;
    let colours = picture.pixels().map(|pixel| pixel.0).collect();
    DepthImage::new(SIZE, colours, drawn.inverses()).expect("sizes that fit")
}

/// The scene as the other camera sees it.
fn truth(scene: &[Triangle], shift: &Shift) -> View {
    let moved = scene.iter().map(|triangle| {
        triangle.map(|vertex| Vertex {
            at: [
                vertex.at[0] + shift.pixels(vertex.inverse, SIZE[0]),
                vertex.at[1],
            ],
            ..vertex
        })
    });
    drawn(&moved.collect::<Vec<_>>(), &none(), f64::INFINITY).picture()
}

/// Pixels that differ by more than 8 where there is no hole.
fn wrong(view: &View, truth: &View) -> usize {
    let pairs = view.picture.pixels().zip(truth.picture.pixels());
    let differs = pairs.map(|(a, b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 8));
    differs
        .zip(&view.holes)
        .filter(|(d, hole)| *d && !**hole)
        .count()
}

#[test]
fn a_depth_image_seen_from_its_own_place_is_itself() {
    let scene = columns(&[[40.0, 56.0]]);
    let image = Reference::from(&depth_image(&scene));
    let camera = Pinhole::through(SIZE, 9.0, [0.5, -0.25, 10.0]);
    let seen = image.seen(SIZE, &camera.to(&camera), THRESHOLD);
    assert_eq!(seen.depth_image(), depth_image(&scene));
    assert_eq!(seen.picture(), image.picture());
}

#[test]
fn a_camera_moves_what_it_sees_as_it_would_project_it() {
    let camera = Pinhole::through(SIZE, 9.0, [0.0, 0.0, 10.0]);
    let nearer = Pinhole::through(SIZE, 12.0, [1.0, -2.0, 8.0]);
    for point in [[0.0, 0.0, 0.0], [1.5, -1.0, 3.0], [-2.0, 0.5, -7.0]] {
        let seen = |camera: &Pinhole| camera.project(point).expect("before the eye");
        let ((at, inverse), (other, other_inverse)) = (seen(&camera), seen(&nearer));
        let vertex = Vertex {
            at,
            inverse,
            colour: [0.0; 3],
        };
        let moved = camera.to(&nearer).apply(&vertex).expect("before the eye");
        assert!((moved.inverse - other_inverse).abs() < 1e-12);
        for i in 0..2 {
            assert!(
                (moved.at[i] - other[i]).abs() < 1e-9,
                "{moved:?}, {other:?}"
            );
        }
    }
    // A point in the plane of the window keeps its place, and a point behind the eye has none.
    assert_eq!(
        nearer.project([0.0; 3]).map(|seen| seen.0),
        Some([48.0, 32.0])
    );
    assert_eq!(nearer.project([0.0, 0.0, 9.0]), None);
}

#[test]
fn a_lone_sample_grows_as_the_camera_comes_nearer() {
    let mut inverses = vec![f32::NAN; 96 * 64];
    inverses[32 * 96 + 48] = 0.25;
    let lone = DepthImage::new(SIZE, vec![[9; 3]; 96 * 64], inverses).expect("sizes that fit");
    let camera = Pinhole {
        eye: [0.0, 0.0, 4.0],
        focal: 50.0,
        centre: [48.0, 32.0],
    };
    let nearer = Pinhole {
        eye: [0.0, 0.0, 1.0],
        ..camera
    };
    let seen = Reference::from(&lone).seen(SIZE, &camera.to(&nearer), THRESHOLD);
    // Four times as near, so four pixels wide and high.
    let covered = seen
        .inverses()
        .iter()
        .filter(|inverse| **inverse > 0.0)
        .count();
    assert_eq!(covered, 16);
}

#[test]
fn the_own_view_is_the_picture() {
    let image = depth_image(&columns(&[[40.0, 56.0]]));
    let view = warp(&image, &at_zero_parallax(0.0));
    assert_eq!(view.hole_share(), 0.0);
    for y in 0..SIZE[1] {
        let row: Vec<[u8; 3]> = (0..SIZE[0])
            .map(|x| view.picture.get_pixel(x, y).0)
            .collect();
        assert_eq!(row, image.colours(y));
    }
}

#[test]
fn a_hole_is_as_wide_as_disparities_differ_and_is_the_background_s() {
    let image = depth_image(&columns(&[[40.0, 56.0]]));
    // The background moves by 0.2 · (1 − 4 · 0.1) · 48 = 5.76 pixels to the right, the column stands.
    for (separation, side) in [(0.2, 56), (-0.2, 34)] {
        let view = warp(&image, &at_zero_parallax(separation));
        let row = 32;
        let holes: Vec<u32> = (0..SIZE[0])
            .filter(|x| view.holes[(row * SIZE[0] + x) as usize])
            .collect();
        let inner: Vec<u32> = holes
            .iter()
            .copied()
            .filter(|x| (10..86).contains(x))
            .collect();
        assert!((5..=6).contains(&inner.len()), "{inner:?}");
        assert!(inner[0].abs_diff(side) <= 1, "{inner:?} at {side}");
        for x in inner {
            assert_eq!(view.picture.get_pixel(x, row).0[0], 0, "column {x}");
        }
        // The column itself keeps its width.
        let red = (0..SIZE[0]).filter(|&x| view.picture.get_pixel(x, row).0[0] > 100);
        assert_eq!(red.count(), 16);
    }
}

#[test]
fn a_slanted_plane_moves_by_its_depths() {
    // 1/w and red are straight lines over the picture.
    let [w, h] = SIZE;
    let inverse = |x: f64| 0.1 + 0.15 * x / f64::from(w);
    let red = |x: f64| 20.0 + 2.0 * x;
    let place = |x: u32| f64::from(x) + 0.5;
    let all = || (0..h).flat_map(|_| 0..w).map(place);
    let colours = all().map(|x| [red(x).round() as u8, 0, 0]).collect();
    let inverses = all().map(|x| inverse(x) as f32).collect();
    let image = DepthImage::new(SIZE, colours, inverses).expect("sizes that fit");
    let shift = at_zero_parallax(0.1);
    let view = warp(&image, &shift);
    for x in 8..w - 8 {
        // x' = x + s·(1 − c·(a + b·x))·w/2, solved for x.
        let half = f64::from(w) / 2.0;
        let (s, c) = (shift.separation * half, shift.convergence);
        let from = (place(x) - s * (1.0 - c * 0.1)) / (1.0 - s * c * 0.15 / f64::from(w));
        let is = f64::from(view.picture.get_pixel(x, 30).0[0]);
        assert!((is - red(from)).abs() <= 1.0, "{x}: {is}, {}", red(from));
    }
    assert!(view.holes.iter().filter(|hole| **hole).count() < 8 * h as usize);
}

#[test]
fn magnitudes_are_those_of_equation_1() {
    for (r, asymmetry) in [(30.0, 1.0), (30.0, 2.0), (12.0, 3.0)] {
        assert!((distortion::magnitude(-r, r, asymmetry) - r).abs() < 1e-12);
        assert!(distortion::magnitude(r / asymmetry, r, asymmetry).abs() < 1e-12);
    }
    // Symmetrical: (r − x)/2.
    assert!((distortion::magnitude(4.0, 30.0, 1.0) - 13.0).abs() < 1e-12);
}

/// An edge at 50 whose background lies to the right.
fn distorted(radius: f64, room: f64) -> Distortion {
    Distortion {
        direction: [1.0, 0.0],
        edge: [50.0, 0.0],
        near: NEAR,
        far: FAR,
        seen: 16.0,
        radius,
        room,
    }
}

#[test]
fn rays_are_distorted_between_near_and_far_only() {
    let distorted = distorted(16.0, 8.0);
    // Nothing moves in front, where the splat ends, and beyond its reach.
    assert_eq!(distorted.at([45.0, 0.0], NEAR), 0.0);
    assert_eq!(distorted.at([45.0, 0.0], 2.0 * NEAR), 0.0);
    assert!(distorted.at([58.0, 0.0], FAR).abs() < 1e-12);
    assert_eq!(distorted.at([33.9, 0.0], FAR), 0.0);
    // Points beyond z_f move as at z_f: Equation 1 with α = 2.
    assert!((distorted.at([50.0, 0.0], FAR) - 16.0 / 3.0).abs() < 1e-12);
    assert_eq!(
        distorted.at([50.0, 0.0], 0.0),
        distorted.at([50.0, 0.0], FAR)
    );
}

#[test]
fn what_is_seen_of_each_depth_comes_out_from_behind_the_edge() {
    for (radius, room) in [(16.0, 16.0), (16.0, 5.0), (9.0, 4.0)] {
        let distorted = distorted(radius, room);
        for part in 1..=8 {
            let depth = f64::from(part) / 8.0;
            let inverse = NEAR + (FAR - NEAR) * depth;
            let reach = (16.0 * depth).min(radius);
            let lands = |x: f64| 50.0 + x + distorted.at([50.0 + x, 0.0], inverse);
            assert!((lands(-reach) - 50.0).abs() < 1e-9, "{depth}");
            // Samples that no viewpoint sees stay behind the edge, and the others keep their order.
            assert!((-30..0).all(|x| lands(f64::from(x) / 2.0 - reach - 1e-9) <= 50.0 + 1e-9));
            let all: Vec<f64> = (0..80).map(|x| lands(f64::from(x) / 2.0 - reach)).collect();
            assert!(all.windows(2).all(|pair| pair[0] < pair[1]), "{depth}");
        }
    }
}

#[test]
fn edges_lie_in_front_and_look_away_from_it() {
    let edges = Edges::of(&depth_image(&columns(&[[40.0, 56.0]])), THRESHOLD);
    let row: Vec<&Edge> = edges.all.iter().filter(|edge| edge.at[1] == 32).collect();
    let told: Vec<_> = row
        .iter()
        .map(|edge| (edge.at[0], edge.normal[0].round()))
        .collect();
    assert_eq!(told, [(40, -1.0), (55, 1.0)]);
    for edge in row {
        assert!((edge.near - NEAR).abs() < 1e-6 && (edge.far - FAR).abs() < 1e-6);
    }
    // A plane has none, however steep.
    let steep: Vec<f32> = (0..96 * 64).map(|i| 0.01 * (i % 96) as f32).collect();
    let plane = DepthImage::new(SIZE, vec![[0; 3]; 96 * 64], steep).expect("sizes that fit");
    assert!(Edges::of(&plane, THRESHOLD).all.is_empty());
}

/// Holes of a depth image and of a reference image, seen from both sides, and pixels of the latter that are wrong.
fn compare(places: &[[f64; 2]], splats: &Splats) -> (usize, usize, usize) {
    let scene = columns(places);
    let image = depth_image(&scene);
    let edges = Edges::of(&image, THRESHOLD);
    let reference = drawn(&scene, &Distortions::of(SIZE, &edges, splats), 1.0);
    let mut sums = (0, 0, 0);
    for separation in [-0.2, 0.2] {
        let shift = at_zero_parallax(separation);
        let truth = truth(&scene, &shift);
        // No sample comes from beyond the edges of the picture, so holes there do not count.
        let inner = |view: &View| {
            let holes = view.holes.iter().enumerate();
            let inside = holes.filter(|(at, hole)| **hole && (8..88).contains(&(at % 96)));
            inside.count()
        };
        let view = reference.view(&shift, THRESHOLD);
        sums.0 += inner(&warp(&image, &shift));
        sums.1 += inner(&view);
        sums.2 += wrong(&view, &truth);
    }
    sums
}

#[test]
fn an_occlusion_camera_has_what_is_about_to_be_seen() {
    let splats = Splats {
        radius: 14.0,
        parallax: f64::INFINITY,
        asymmetry: 1.0,
    };
    let (depth, occlusion, wrong) = compare(&[[32.0, 64.0]], &splats);
    assert!(depth > 200, "{depth}");
    // The remaining holes lie at the corners, where splats of two directions meet.
    assert!(occlusion * 10 <= depth, "{occlusion} of {depth}");
    // Apart from holes, only single pixels at silhouettes differ from the picture of the other camera.
    assert!(wrong * 200 <= 2 * 96 * 64, "{wrong}");
}

#[test]
fn a_finer_picture_has_the_same_rays() {
    let splats = Splats {
        radius: 14.0,
        parallax: f64::INFINITY,
        asymmetry: 1.0,
    };
    let edges = Edges::of(&depth_image(&columns(&[[32.0, 64.0]])), THRESHOLD);
    let distortions = Distortions::of(SIZE, &edges, &splats);
    let place = [30.5, 32.25];
    let own = distortions.vector(SIZE, place, FAR);
    let finer = distortions.vector([2 * SIZE[0], 3 * SIZE[1]], [61.0, 96.75], FAR);
    assert!(own[0] < -1.0, "{own:?}");
    assert_eq!(finer, [2.0 * own[0], 3.0 * own[1]]);
}

#[test]
fn a_thin_gap_loses_nothing_that_was_seen() {
    let splats = Splats {
        radius: 16.0,
        parallax: f64::INFINITY,
        asymmetry: 2.0,
    };
    let scene = columns(&[[30.0, 45.0], [49.0, 64.0]]);
    let image = depth_image(&scene);
    let edges = Edges::of(&image, THRESHOLD);
    let reference = drawn(&scene, &Distortions::of(SIZE, &edges, &splats), 1.0);
    let own = reference.view(&at_zero_parallax(0.0), THRESHOLD);
    let before = warp(&image, &at_zero_parallax(0.0));
    let green = |view: &View| {
        (45..49)
            .filter(|&x| view.picture.get_pixel(x, 32).0[1] > 0)
            .count()
    };
    assert_eq!(green(&before), 4);
    assert!(green(&own) >= 3);
}

proptest! {
    #[test]
    fn what_is_projected_is_unprojected(
        point in prop::array::uniform3(-5.0f64..5.0),
        eye in prop::array::uniform3(-4.0f64..4.0),
        scale in 1.0f64..100.0,
    ) {
        let camera = Pinhole::through(SIZE, scale, [eye[0], eye[1], 50.0 + eye[2]]);
        let (at, inverse) = camera.project(point).expect("before the eye");
        let back = camera.unproject(at, inverse);
        for i in 0..3 {
            prop_assert!((back[i] - point[i]).abs() < 1e-9, "{:?} of {:?}", back, point);
        }
    }

    #[test]
    fn any_depths_make_a_picture(
        inverses in proptest::collection::vec(
            prop_oneof![Just(f32::NAN), Just(f32::INFINITY), Just(-1.0), 0.0f32..2.0], 24 * 6),
        separation in -2.0f64..2.0,
    ) {
        let colours: Vec<[u8; 3]> = (0..24 * 6).map(|i| [i as u8 + 1, 0, 0]).collect();
        let image = DepthImage::new([24, 6], colours, inverses).expect("sizes that fit");
        let view = warp(&image, &at_zero_parallax(separation));
        prop_assert_eq!(view.holes.len(), 24 * 6);
        // A row with anything in it has no black left.
        for y in 0..6usize {
            let row = &view.holes[y * 24..][..24];
            if row.iter().any(|hole| !hole) {
                for x in 0..24 {
                    prop_assert!(view.picture.get_pixel(x, y as u32).0[0] > 0);
                }
            }
        }
        let edges = Edges::of(&image, 0.05);
        prop_assert!(edges.all.iter().all(|e| (e.normal[0].hypot(e.normal[1]) - 1.0).abs() < 1e-9));
        Distortions::of([24, 6], &edges, &Splats { radius: 5.0, parallax: f64::INFINITY, asymmetry: 2.0 });
    }
}

#[test]
fn a_surface_goes_on_along_itself_to_where_it_is_covered() {
    // A slope, farther to the right, that ends behind something.
    let inverses = [0.5, 0.49, 0.48, 0.47, 0.8, 0.8];
    let colours = vec![[200; 3]; 6];
    let image = DepthImage::new([6, 1], colours, inverses.to_vec()).expect("as many");
    let mesh: Vec<Triangle> = Reference::from(&image).mesh(0.05).collect();
    let ends = |range: std::ops::Range<f64>| {
        let corners = mesh.iter().flatten();
        let own = corners.filter(|corner| range.contains(&corner.inverse));
        let ends = own.map(|corner| (corner.at[0], corner.inverse));
        ends.fold((f64::INFINITY, 0.0, 0.0), |(low, high, last), (x, v)| {
            (x.min(low), x.max(high), if x >= high { v } else { last })
        })
    };
    let (low, high, last) = ends(0.4..0.6);
    // The slope extends half a pixel at the picture's edge. Behind the other surface it extends to that one's first sample, at the slope's own depth.
    assert!(
        (low, high) == (0.0, 4.5) && (last - 0.46).abs() < 1e-6,
        "{low} {high} {last}"
    );
    // The surface in front ends half a pixel before its first sample.
    assert_eq!(ends(0.7..0.9), (4.0, 6.0, f64::from(0.8_f32)));
}
