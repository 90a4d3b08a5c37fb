//! Views of Gaussians against the published equations.

use glam::{Mat4, Quat, Vec3};
use manyview_points::camera::Camera;
use manyview_points::draw::BACKGROUND;
use manyview_points::gaussian::reference::{self, picture};
use manyview_points::random::Random;
use manyview_points::read::{Up, gaussians};
use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const SIZE: [u32; 2] = [320, 240];
const VIEWS: i32 = 3;
/// Cameras, in units of the file: the cloud has a radius of about one, and is five away.
const SPACING: f32 = 0.1;
const FOCAL: f32 = 3.2;
const COUNT: u32 = 3000;
/// In dB. Other shapes, orders and blurs are below this.
const BOUND: f64 = 51.0;

/// Each from -1 to 1.
fn around(random: &mut Random) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| random.unit() as f32)) * 2.0 - 1.0
}

/// A ball of flat and long Gaussians, whose colours depend on the direction.
fn write(file: &Path) {
    let mut random = Random::new(5);
    let mut names = vec!["x".to_owned(), "y".to_owned(), "z".to_owned()];
    names.extend((0..3).map(|n| format!("f_dc_{n}")));
    names.extend((0..9).map(|n| format!("f_rest_{n}")));
    names.push("opacity".to_owned());
    names.extend((0..3).map(|n| format!("scale_{n}")));
    names.extend((0..4).map(|n| format!("rot_{n}")));
    let mut out = File::create(file).expect("a file");
    let properties: String = names
        .iter()
        .map(|name| format!("property float {name}\n"))
        .collect();
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\nelement vertex {COUNT}\n{properties}end_header\n"
    )
    .expect("written");
    for number in 0..COUNT {
        let place = around(&mut random).normalize_or_zero() * (0.7 + 0.3 * (random.unit() as f32));
        let mut values = place.to_array().to_vec();
        values.extend((place * 1.5).to_array());
        values.extend((0..9).map(|_| 0.3 * ((random.unit() as f32) - 0.5)));
        values.push(8.0 * (random.unit() as f32) - 1.0);
        let long = if number % 3 == 0 { 0.0 } else { -1.5 };
        values.extend([
            -4.0 + (random.unit() as f32),
            -3.0 + long * (random.unit() as f32),
            -4.5,
        ]);
        let axis = around(&mut random);
        let turn = Quat::from_axis_angle(axis.normalize_or(Vec3::X), 3.0 * (random.unit() as f32));
        values.extend([turn.w, turn.x, turn.y, turn.z]);
        for value in values {
            out.write_all(&value.to_le_bytes()).expect("written");
        }
    }
}

/// Ends with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn screen() -> (Running, String) {
    let mut server = Command::new("Xvfb");
    server.args(["-displayfd", "1", "-screen", "0", "640x480x24"]);
    let mut server = server
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("Xvfb; `make packages` installs it");
    let mut line = String::new();
    let out = server.stdout.take().expect("a pipe");
    BufReader::new(out).read_line(&mut line).expect("a number");
    (Running(server), format!(":{}", line.trim()))
}

/// What the viewer shows of a file in a view.
fn shown(file: &Path, view: i32, display: &str) -> image::RgbImage {
    let viewer = PathBuf::from(env!("CARGO_BIN_EXE_manyview-points"));
    let library = viewer.with_file_name("libmanyview.so");
    assert!(
        library.is_file(),
        "{}: run `make build` first",
        library.display()
    );
    let out = file.with_file_name(format!("view-{view}.png"));
    let mut command = Command::new(viewer);
    command
        .arg(file)
        .args(["--size", &format!("{}x{}", SIZE[0], SIZE[1])])
        .env("DISPLAY", display)
        .env_remove("WAYLAND_DISPLAY")
        .env("LD_PRELOAD", library)
        .env("XDG_CONFIG_HOME", "/dev/null/none")
        .env("MANYVIEW_VIEWS", VIEWS.to_string())
        .env("MANYVIEW_EYE_SPACING", SPACING.to_string())
        .env("MANYVIEW_FOCAL_DEPTH", FOCAL.to_string())
        .env("MANYVIEW_CAPTURE_OUT", &out)
        .env("MANYVIEW_CAPTURE_FRAMES", "5")
        .env("MANYVIEW_CAPTURE_WHAT", format!("view:{view}"));
    let _viewer = Running(command.spawn().expect("started"));
    let limit = Instant::now() + Duration::from_secs(60);
    loop {
        if let Ok(picture) = image::open(&out) {
            return picture.to_rgb8();
        }
        assert!(Instant::now() < limit, "no picture");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// In dB, over all channels.
fn psnr(a: impl Iterator<Item = u8>, b: impl Iterator<Item = u8>) -> f64 {
    let squares: Vec<f64> = a
        .zip(b)
        .map(|(a, b)| f64::from(a.abs_diff(b)).powi(2))
        .collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    10.0 * (255.0 * 255.0 / mean).log10()
}

#[test]
fn views_of_gaussians_are_those_of_the_published_equations() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("ball.ply");
    write(&file);
    let all = gaussians(&file, 1 << 30).expect("read").expect("Gaussians");
    assert_eq!((all.all.len() as u32, all.coefficients), (COUNT, 4));
    let (_server, display) = screen();
    let camera = Camera::new(all.extent(), Up::MinusY);
    let look = camera.look(SIZE);
    for view in 0..VIEWS {
        let aside = (view - (VIEWS - 1) / 2) as f32 * SPACING;
        let right = camera.view().row(0).truncate();
        let exact = reference::Camera {
            view: Mat4::from_translation(Vec3::new(-aside, 0.0, 0.0)) * camera.view(),
            eye: look.eye + right * aside,
            pixels: look.pixels.into(),
            shift: f64::from(aside / FOCAL * look.pixels),
            near: camera.near().into(),
        };
        let want = picture(&all, &exact, SIZE, Vec3::from_array(BACKGROUND));
        let seen = shown(&file, view, &display);
        let quality = psnr(
            seen.pixels().flat_map(|pixel| pixel.0),
            want.iter().copied().flatten(),
        );
        println!("view {view}: {quality:.1} dB");
        assert!(quality >= BOUND, "view {view}: {quality}");
    }
}
