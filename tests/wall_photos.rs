//! A wall that hangs askew is measured from photos of its pattern. The camera shares no code with the library: it follows rays from the sensor through a
//! distorting lens to the wall, and its photos have the blur, the vignetting, the noise and the compression of those of tests/calibrate.rs.

use crate::calibrate::random::Random;
use crate::support::{manyview, rgb, run, succeed};
use image::codecs::jpeg::JpegEncoder;
use image::{Rgb, RgbImage};
use manyview::config::panel::load;
use manyview::display::Kind;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

/// Pixels of each panel, and mm of one.
const PANEL: (u32, u32) = (960, 540);
const PIXEL: f64 = 0.5;
/// Of a photo.
const PHOTO: (u32, u32) = (3000, 2000);
/// Nominal corners of the panels, mm: 12 mm are between them.
const AT: [[f64; 2]; 4] = [[0.0, 0.0], [492.0, 0.0], [0.0, 282.0], [492.0, 282.0]];

/// Where a panel truly is: its left top corner in mm, its turn in radians, and how bright it is.
#[derive(Clone, Copy)]
struct True {
    at: [f64; 2],
    turn: f64,
    light: f64,
}

impl True {
    /// A place of the wall in pixels of the panel.
    fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sine, cosine) = self.turn.sin_cos();
        let (dx, dy) = (x - self.at[0], y - self.at[1]);
        [
            (cosine * dx + sine * dy) / PIXEL,
            (cosine * dy - sine * dx) / PIXEL,
        ]
    }

    /// A pixel of the panel in the wall.
    fn wall(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sine, cosine) = self.turn.sin_cos();
        let (x, y) = (x * PIXEL, y * PIXEL);
        [
            self.at[0] + cosine * x - sine * y,
            self.at[1] + sine * x + cosine * y,
        ]
    }
}

/// A camera before the wall.
struct Camera {
    /// mm from the middle of the wall: to the right, down, and before it.
    eye: [f64; 3],
    roll: f64,
    k1: f64,
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = a.iter().map(|v| v * v).sum::<f64>().sqrt();
    a.map(|v| v / length)
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// A photo of the panels that show these pictures, as a JPEG file.
fn photo(panels: &[True], pictures: &[RgbImage], camera: &Camera, random: &mut Random) -> Vec<u8> {
    let (width, height) = PHOTO;
    let middle = [486.0, 276.0];
    let half = f64::from(width).hypot(f64::from(height)) / 2.0;
    let focal = 0.85 * f64::from(width) * camera.eye[2] / 1100.0;
    let forward = unit([-camera.eye[0], -camera.eye[1], -camera.eye[2]]);
    let right = unit(cross([0.0, 1.0, 0.0], forward)).map(|v| -v);
    let down = unit(cross(forward, right)).map(|v| -v);
    let (sine, cosine) = camera.roll.sin_cos();
    let linear: Vec<f64> = (0..256).map(|v| (f64::from(v) / 255.0).powf(2.2)).collect();
    let mut light = vec![0.0_f32; (width * height) as usize];
    for (i, out) in light.iter_mut().enumerate() {
        let (px, py) = (f64::from(i as u32 % width), f64::from(i as u32 / width));
        let mut sum = 0.0;
        for ray in 0..4 {
            let jitter = |k: usize, random: &mut Random| (k as f64 + random.unit()) / 2.0;
            let bent = [
                (px + jitter(ray % 2, random) - f64::from(width) / 2.0) / half,
                (py + jitter(ray / 2, random) - f64::from(height) / 2.0) / half,
            ];
            let far = bent[0].hypot(bent[1]);
            let mut radius = far;
            for _ in 0..5 {
                let off = radius * (1.0 + camera.k1 * radius * radius) - far;
                radius -= off / (1.0 + 3.0 * camera.k1 * radius * radius);
            }
            let scale = if far > 0.0 { radius / far } else { 1.0 } * half / focal;
            let [x, y] = bent.map(|v| v * scale);
            let [x, y] = [cosine * x - sine * y, sine * x + cosine * y];
            let ray = [0, 1, 2].map(|k| right[k] * x + down[k] * y + forward[k]);
            let steps = -camera.eye[2] / ray[2];
            let place = [0, 1].map(|k| camera.eye[k] + ray[k] * steps + middle[k]);
            let seen = panels.iter().zip(pictures).find_map(|(panel, picture)| {
                let [x, y] = panel.pixel(place);
                let inside = x >= 0.0 && y >= 0.0;
                let pixel = picture
                    .get_pixel_checked(x as u32, y as u32)
                    .filter(|_| inside)?;
                Some(panel.light * (0.004 + linear[usize::from(pixel.0[0])]))
            });
            sum += seen.unwrap_or(0.02) / 4.0;
        }
        let far = (px - f64::from(width) / 2.0).hypot(py - f64::from(height) / 2.0) / half;
        *out = (0.62 * sum * (1.0 - 0.3 * far * far)) as f32;
    }
    let light = blurred(&light, 0.8);
    let picture = RgbImage::from_fn(width, height, |x, y| {
        let value = f64::from(light[(y * width + x) as usize]);
        let radius = (-2.0 * (1.0 - random.unit()).ln()).sqrt();
        let noise = 0.012 * radius * (TAU * random.unit()).cos();
        let value = (value + noise).clamp(0.0, 1.0);
        let value = if value <= 0.003_130_8 {
            12.92 * value
        } else {
            1.055 * value.powf(1.0 / 2.4) - 0.055
        };
        Rgb([(255.0 * value).round() as u8; 3])
    });
    let mut bytes = Vec::new();
    let encoder = &mut JpegEncoder::new_with_quality(&mut bytes, 85);
    encoder.encode_image(&picture).expect("memory");
    bytes
}

/// Blurs a photo by a Gaussian of so many pixels.
fn blurred(light: &[f32], sigma: f64) -> Vec<f32> {
    let reach = (3.0 * sigma).ceil() as i64;
    let kernel: Vec<f32> = (-reach..=reach)
        .map(|i| (-0.5 * (i as f64 / sigma).powi(2)).exp() as f32)
        .collect();
    let total: f32 = kernel.iter().sum();
    let (width, height) = (i64::from(PHOTO.0), i64::from(PHOTO.1));
    let pass = |from: &[f32], dx: i64, dy: i64| -> Vec<f32> {
        let at = |x: i64, y: i64| {
            from[(y.clamp(0, height - 1) * width + x.clamp(0, width - 1)) as usize]
        };
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let sum = |(x, y): (i64, i64)| {
            let taps = (-reach..=reach).zip(&kernel);
            taps.map(|(i, weight)| weight * at(x + i * dx, y + i * dy))
                .sum::<f32>()
                / total
        };
        places.map(sum).collect()
    };
    pass(&pass(light, 1, 0), 0, 1)
}

/// The nominal description.
fn described(folder: &Path) -> PathBuf {
    let mut text = "kind = 'wall'\nviews = 8\n".to_owned();
    for (number, [x, y]) in AT.iter().enumerate() {
        text += &format!(
            "[[panel]]\nmonitor = 'DP-{number}'\ndisplay = 'huebner8'\npixels = '{}x{}'\nat = [{x}, {y}]\nwidth = 480\n",
            PANEL.0, PANEL.1
        );
    }
    let file = folder.join("wall.toml");
    std::fs::write(&file, text).expect("written");
    file
}

/// The patterns that the command writes.
fn patterns(wall: &Path, folder: &Path) -> Vec<RgbImage> {
    let mut command = manyview();
    command
        .args(["wall", "pattern", "--display"])
        .arg(wall)
        .arg("--out")
        .arg(folder);
    succeed(&mut command);
    (1..=AT.len())
        .map(|n| rgb(&folder.join(format!("pattern-{n}.png"))))
        .collect()
}

/// Panels that are up to 5° turned, 20 mm displaced and darker than described: their light is at least `low`.
fn askew(random: &mut Random, low: f64) -> Vec<True> {
    let panels = AT.map(|[x, y]| True {
        at: [
            x + random.between(-20.0, 20.0),
            y + random.between(-20.0, 20.0),
        ],
        turn: random.between(-5.0, 5.0).to_radians(),
        light: random.between(low, 1.0),
    });
    panels.to_vec()
}

/// The largest error of a place in pixels, and of the brightness as a share, of a wall that was measured. The first panel is the measure.
fn errors(file: &Path, truth: &[True]) -> (f64, f64) {
    let display = load(&file.to_string_lossy()).expect("a wall");
    let Kind::Wall(wall) = &display.kind else {
        panic!("a wall");
    };
    let text: toml::Table = std::fs::read_to_string(file)
        .expect("text")
        .parse()
        .expect("TOML");
    let lights = text["panel"].as_array().expect("panels").iter();
    let lights: Vec<f64> = lights
        .map(|panel| panel["light"].as_float().expect("a share"))
        .collect();
    // What the viewer sees of each panel, against the darkest.
    let shown: Vec<f64> = truth
        .iter()
        .zip(&lights)
        .map(|(panel, light)| panel.light * light)
        .collect();
    let (least, most) = shown
        .iter()
        .fold((f64::MAX, 0.0_f64), |(a, b), v| (a.min(*v), b.max(*v)));
    let mut worst = 0.0_f64;
    let nominal = True {
        at: AT[0],
        turn: 0.0,
        light: 1.0,
    };
    for (panel, truth_of) in wall.panels().iter().zip(truth) {
        for (x, y) in (0..=6).flat_map(|x| (0..=4).map(move |y| (x, y))) {
            let pixel = [f64::from(x) * 160.0, f64::from(y) * 135.0];
            let expected = nominal.wall(truth[0].pixel(truth_of.wall(pixel)));
            let [u, v] = panel.in_wall(pixel);
            worst = worst.max((u - expected[0]).hypot(v - expected[1]) / PIXEL);
        }
    }
    (worst, most / least - 1.0)
}

fn measured(folder: &Path, wall: &Path, photos: &[PathBuf]) -> (i32, String, PathBuf) {
    let out = folder.join("measured.toml");
    let mut command = manyview();
    let command = command.args(["wall", "fit", "--display"]).arg(wall);
    let command = command.args(photos).arg("--out").arg(&out);
    let (code, _, said) = run(command);
    (code, said, out)
}

#[test]
fn a_wall_that_hangs_askew_is_measured() {
    // The least light of a panel: 3 % less, and as much less as panels of two makers.
    for (seed, eyes, low) in [
        (1_u64, vec![[0.0, 0.0, 1300.0]], 0.97),
        (2, vec![[120.0, 60.0, 1400.0], [-90.0, -40.0, 1350.0]], 0.6),
    ] {
        let mut random = Random(seed);
        let folder = tempfile::tempdir().expect("a folder");
        let wall = described(folder.path());
        let pictures = patterns(&wall, folder.path());
        let truth = askew(&mut random, low);
        let k1 = random.between(-0.08, 0.03);
        let photos: Vec<PathBuf> = eyes
            .into_iter()
            .enumerate()
            .map(|(number, eye)| {
                let camera = Camera {
                    eye,
                    roll: random.between(-0.05, 0.05),
                    k1,
                };
                let file = folder.path().join(format!("photo-{number}.jpg"));
                let bytes = photo(&truth, &pictures, &camera, &mut random);
                std::fs::write(&file, bytes).expect("written");
                file
            })
            .collect();
        let (code, said, out) = measured(folder.path(), &wall, &photos);
        assert_eq!(code, 0, "{said}");
        let (pixels, light) = errors(&out, &truth);
        println!(
            "seed {seed}: {pixels:.3} pixels, light {:.2} %",
            100.0 * light
        );
        assert!(pixels <= 0.25, "seed {seed}: {pixels} pixels");
        assert!(light <= 0.01, "seed {seed}: {light}");
        // What the description says is off by far more.
        let (before, uneven) = {
            let text = std::fs::read_to_string(&wall).expect("text");
            let nominal = text.replace("width = 480\n", "width = 480\nlight = 1.0\n");
            let file = folder.path().join("nominal.toml");
            std::fs::write(&file, nominal).expect("written");
            errors(&file, &truth)
        };
        assert!(before > 20.0, "{before}");
        assert!(low > 0.9 || uneven > 0.2, "{uneven}");
    }
}

#[test]
fn photos_that_do_not_do_are_one_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let wall = described(folder.path());
    let pictures = patterns(&wall, folder.path());
    let grey = folder.path().join("grey.png");
    RgbImage::from_pixel(640, 480, Rgb([128; 3]))
        .save(&grey)
        .expect("saved");
    let one = folder.path().join("one.png");
    pictures[0].save(&one).expect("saved");
    let text = folder.path().join("text.jpg");
    std::fs::write(&text, "no photo").expect("written");
    for (photo, part) in [
        (&grey, "no tag of the pattern"),
        (&one, "panel 2 (DP-1) has 0 tags"),
        (&text, "give a photo as JPEG or PNG"),
    ] {
        let (code, said, _) = measured(folder.path(), &wall, std::slice::from_ref(photo));
        assert_eq!((code, said.lines().count()), (2, 1), "{said}");
        assert!(said.contains(part), "{said}");
    }
    let mut command = manyview();
    let command = command.args(["wall", "pattern", "--display", "rows", "--out", "."]);
    let (code, _, said) = run(command);
    assert!(code == 2 && said.contains("is one panel"), "{said}");
}
