//! Surfaces for the volumetric display, and what a viewer sees of them; the plainest way, sharing nothing with the library.

use manyview::volume::{Joined, ReferenceImage, RotatingScreen, Sample, Triangle, Vertex};

/// A closed surface with bumps, of some 2·`rings`² triangles, inches.
fn blob(rings: u32, centre: [f32; 3], size: [f32; 3], bumps: f32) -> Vec<Triangle> {
    let turns = rings;
    let vertex = |ring: u32, turn: u32| {
        let polar = ring as f32 / rings as f32 * std::f32::consts::PI;
        let around = (turn % turns) as f32 / turns as f32 * std::f32::consts::TAU;
        let bump = (bumps * polar).sin() * (bumps * around).sin();
        let far = 1.0 + 0.12 * bump;
        let unit = [
            polar.sin() * around.cos(),
            polar.cos(),
            polar.sin() * around.sin(),
        ];
        let light = (0.55 + 0.25 * bump + 0.2 * unit[1]).clamp(0.0, 1.0);
        let colour = [1.0, 0.85, 0.6].map(|part: f32| (255.0 * part * light) as u8);
        Vertex {
            at: [0, 1, 2].map(|i| centre[i] + size[i] * far * unit[i]),
            colour,
        }
    };
    let mut triangles = Vec::with_capacity((2 * rings * turns) as usize);
    for ring in 0..rings {
        for turn in 0..turns {
            let [a, b] = [vertex(ring, turn), vertex(ring, turn + 1)];
            let [c, d] = [vertex(ring + 1, turn), vertex(ring + 1, turn + 1)];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    triangles
}

/// One closed surface that nearly fills the display.
pub(crate) fn statue(triangles: u32) -> Vec<Triangle> {
    let rings = (f64::from(triangles) / 2.0).sqrt().ceil() as u32;
    blob(rings, [0.0; 3], [3.6, 4.3, 3.6], 9.0)
}

/// Four of them, one hiding a part of the other.
pub(crate) fn statues(triangles: u32) -> Vec<Triangle> {
    let rings = (f64::from(triangles) / 8.0).sqrt().ceil() as u32;
    let places = [[-2.3, 0.8], [-0.6, -1.8], [0.8, 1.6], [2.4, -0.6]];
    let each = places.map(|[x, z]| blob(rings, [x, 0.0, z], [1.1, 3.2, 1.1], 7.0));
    each.concat()
}

/// The depth image of a surface for a viewer on the z axis, so large that the sphere of the display fits into it. Samples of neighbouring pixels are joined
/// where they are no farther apart than `step` inches along z.
pub(crate) fn depth_image(
    screen: &RotatingScreen,
    triangles: &[Triangle],
    [width, height]: [u32; 2],
    step: f32,
) -> ReferenceImage {
    let (far, radius) = (screen.viewer as f32, screen.radius as f32);
    // Pixels for one inch at one inch's distance.
    let scale = height as f32 / 2.0 / (radius / (far * far - radius * radius).sqrt());
    let middle = [width as f32 / 2.0, height as f32 / 2.0];
    let project = |v: &Vertex| {
        let depth = far - v.at[2];
        [
            middle[0] + scale * v.at[0] / depth,
            middle[1] - scale * v.at[1] / depth,
            1.0 / depth,
        ]
    };
    let mut nearest = vec![0.0_f32; (width * height) as usize];
    let mut colours = vec![[0_u8; 3]; nearest.len()];
    for triangle in triangles {
        let [a, b, c] = [0, 1, 2].map(|i| project(&triangle[i]));
        let side = |p: [f32; 3], q: [f32; 3], x: f32, y: f32| {
            (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
        };
        let area = side(a, b, c[0], c[1]);
        if area == 0.0 {
            continue;
        }
        let pixels = |i: usize, end: u32| {
            let least = a[i].min(b[i]).min(c[i]);
            let most = a[i].max(b[i]).max(c[i]);
            ((least - 0.5).ceil().max(0.0) as u32)..((most + 0.5).floor().max(0.0) as u32).min(end)
        };
        for row in pixels(1, height) {
            for column in pixels(0, width) {
                let (x, y) = (column as f32 + 0.5, row as f32 + 0.5);
                let weights = [side(b, c, x, y), side(c, a, x, y), side(a, b, x, y)];
                let weights = weights.map(|weight| weight / area);
                if weights.iter().any(|&weight| weight < 0.0) {
                    continue;
                }
                let near = weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2];
                let at = (row * width + column) as usize;
                if near > nearest[at] {
                    nearest[at] = near;
                    colours[at] = [0, 1, 2].map(|i| {
                        let parts = weights.iter().zip(triangle);
                        let sum = parts.map(|(weight, v)| weight * f32::from(v.colour[i]));
                        (sum.sum::<f32>() + 0.5) as u8
                    });
                }
            }
        }
    }
    let depth = |x: u32, y: u32| {
        let near = match x < width && y < height {
            true => nearest[(y * width + x) as usize],
            false => 0.0,
        };
        (near > 0.0).then(|| 1.0 / near)
    };
    let samples = (0..width * height).map(|at| {
        let (x, y) = (at % width, at / width);
        let own = depth(x, y)?;
        let joined = |other: Option<f32>| other.is_some_and(|other| (own - other).abs() <= step);
        let [u, v] = [x as f32 + 0.5 - middle[0], middle[1] - y as f32 - 0.5];
        Some(Sample {
            at: [u * own / scale, v * own / scale, far - own],
            colour: colours[at as usize],
            joined: Joined::of(joined(depth(x + 1, y)), joined(depth(x, y + 1))),
        })
    });
    ReferenceImage::new([width, height], samples.collect()).expect("as many as pixels")
}
