//! A wall of panels shows one picture: each window has, subpixel for subpixel, what the CPU makes of the same views by its warp and its own mask.

use crate::support;
use crate::support::x::User;
use crate::support::{Compiled, compiled, manyview, refused, rgb, sized_screen, succeed};
use image::{GenericImageView, RgbImage};
use manyview::config::panel::load;
use manyview::display::{Display, Fit, Kind, Placement, Wall};
use manyview::interleave::wall::wall;
use manyview::simulate::{Eye, Optics, Setup, see};
use std::io::Read;
use std::path::Path;
use std::process::Stdio;
use std::sync::Arc;
use std::time::{Duration, Instant};

const LIMIT: Duration = Duration::from_secs(60);
const CAMERAS: [&str; 4] = ["--separation", "0.02", "--convergence", "8"];
/// Of the program's window, and the views that it is drawn in.
const WINDOW: (u32, u32) = (320, 240);
const VIEWS: u32 = 8;
/// Both sides interpolate in floats.
const STEP: u8 = 1;

/// Four monitors of four sizes.
const MONITORS: [(&str, [i16; 4]); 4] = [
    ("a", [0, 0, 400, 300]),
    ("b", [400, 0, 360, 300]),
    ("c", [0, 300, 400, 260]),
    ("d", [400, 300, 350, 250]),
];

const TEXT: &str = r#"
kind = "wall"
views = 8

[[panel]]
monitor = "a"
display = "huebner8"
pixels = "400x300"
at = [0, 0]
width = 400

[[panel]]
monitor = "b"
display = "sheet.toml"
pixels = "360x300"
at = [410, 5]
width = 380
turn = 2
light = 0.9
border = [3, 0, 5, 2]

[[panel]]
monitor = "c"
display = "lenticular-8"
pixels = "400x260"
homography = [[1.01, 0.02, 2], [-0.01, 0.99, 312], [0.00003, 0.00001, 1]]
light = { columns = 2, rows = 2, values = [0.8, 1, 0.9, 0.95] }

[[panel]]
monitor = "d"
display = "slanted8"
pixels = "350x250"
at = [420, 310]
width = 360
turn = -3
mesh-x = { columns = 3, rows = 2, values = [0, 2, 0, 0, -2, 0] }
mesh-y = { columns = 3, rows = 2, values = [0, 1, 0, 0, 1, 0] }
"#;

fn described(folder: &Path) -> String {
    let sheet = "kind = 'slanted'\nviews = 8\npitch = '16/3'\nslant = '-2/3'\norder = 'bgr'";
    std::fs::write(folder.join("sheet.toml"), sheet).expect("written");
    let file = folder.join("wall.toml");
    std::fs::write(&file, TEXT).expect("written");
    file.display().to_string()
}

fn still() -> std::path::PathBuf {
    compiled("still", Compiled::Program, &["-lEGL", "-lGL"])
}

/// The views, as the program's window would show them.
fn views() -> Vec<RgbImage> {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("atlas.png");
    let (width, height) = WINDOW;
    let mut command = manyview();
    command.args(["capture", "--frame", "3", "--what", "atlas", "--views", "8"]);
    command
        .args(CAMERAS)
        .arg("--out")
        .arg(&out)
        .arg("--")
        .arg(still());
    command.args([width.to_string(), height.to_string()]);
    succeed(&mut command);
    let all = rgb(&out);
    let view = |i| all.view(i * width, 0, width, height).to_image();
    (0..VIEWS).map(view).collect()
}

fn of(display: &Display) -> Arc<Wall> {
    match &display.kind {
        Kind::Wall(wall) => wall.clone(),
        other => panic!("{other:?}"),
    }
}

/// What the panels have to show.
fn expected(display: &Display, fit: Fit) -> Vec<RgbImage> {
    let described = of(display);
    let (width, height) = described.sheet();
    let mask = display.mask(&Placement::full_screen(width, height), VIEWS);
    let nodes = described.nodes(WINDOW, fit);
    let columns = described.node_count().0;
    let sheet = wall(&views(), &mask.expect("a mask"), &nodes, columns).expect("a picture");
    let part = |panel: &manyview::display::WallPanel| {
        let [x, y] = panel.at;
        sheet.view(x, y, panel.pixels.0, panel.pixels.1).to_image()
    };
    described.panels().iter().map(part).collect()
}

fn worst(a: &RgbImage, b: &RgbImage) -> u8 {
    assert_eq!(a.dimensions(), b.dimensions());
    let off = a.iter().zip(b.iter()).map(|(a, b)| a.abs_diff(*b));
    off.max().unwrap_or(0)
}

#[test]
fn four_panels_show_one_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = described(folder.path());
    let display = load(&file).expect("a wall");
    for (word, fit) in [("contain", Fit::Contain), ("cover", Fit::Cover)] {
        let expected = expected(&display, fit);
        let screen = sized_screen((760, 560));
        let user = User::at(screen.display());
        for (name, place) in MONITORS {
            user.add_monitor(name, place);
        }
        let mut command = manyview();
        let command = command.args(["run", "--panel", "auto", "--display", &file, "--fit", word]);
        let command = command.args(CAMERAS).arg("--").arg(still());
        let command = command.args([WINDOW.0.to_string(), WINDOW.1.to_string()]);
        let command = command.stdin(Stdio::piped()).stderr(Stdio::piped());
        let mut child = screen.give(command).spawn().expect("it starts");
        let limit = Instant::now() + LIMIT;
        let window_at = |place: [i16; 4]| {
            let all = user.windows().into_iter();
            let mut all = all.filter(|window| user.place(*window) == [place[0], place[1]]);
            all.find(|window| {
                user.picture(*window).dimensions() == (place[2] as u32, place[3] as u32)
            })
        };
        for ((name, place), expected) in MONITORS.iter().zip(&expected) {
            let off = loop {
                let off = window_at(*place).map(|window| worst(&user.picture(window), expected));
                match off {
                    Some(off) if off <= STEP || Instant::now() > limit => break off,
                    _ => assert!(Instant::now() < limit, "a window on {name}"),
                }
                std::thread::sleep(Duration::from_millis(30));
            };
            assert!(expected.pixels().any(|pixel| pixel.0 != [0; 3]), "{name}");
            assert!(off <= STEP, "{word}, {name}: off by {off}");
        }
        drop(child.stdin.take());
        let mut said = String::new();
        let errors = child.stderr.as_mut().expect("a pipe");
        errors.read_to_string(&mut said).expect("text");
        assert!(child.wait().expect("it ends").success(), "{said}");
        assert_eq!(said, "");
    }
}

#[test]
fn a_wall_is_woven_as_one_sheet() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = described(folder.path());
    let display = load(&file).expect("a wall");
    let all = views();
    let mut quilt = RgbImage::new(WINDOW.0 * 4, WINDOW.1 * 2);
    for (view, tile) in (0_u32..).zip(&all) {
        let at = [view % 4 * WINDOW.0, (1 - view / 4) * WINDOW.1];
        image::imageops::replace(&mut quilt, tile, at[0].into(), at[1].into());
    }
    let input = folder.path().join("scene_qs4x2.png");
    quilt.save(&input).expect("saved");
    let out = folder.path().join("sheet.png");
    let mut command = manyview();
    command
        .args(["weave", "--display", &file, "--in"])
        .arg(&input)
        .arg("--out")
        .arg(&out);
    succeed(&mut command);
    let sheet = rgb(&out);
    for (panel, expected) in of(&display)
        .panels()
        .iter()
        .zip(expected(&display, Fit::Contain))
    {
        let [x, y] = panel.at;
        let part = sheet.view(x, y, panel.pixels.0, panel.pixels.1).to_image();
        assert_eq!(worst(&part, &expected), 0, "{}", panel.monitor);
    }
}

#[test]
fn what_a_wall_cannot_do_is_one_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = described(folder.path());
    let file: &'static str = file.leak();
    let run = |more: &[&'static str]| [&["run", "--display", file], more, &["--", "true"]].concat();
    refused(&run(&[]), 2, "--panel auto");
    refused(&run(&["--panel", "DP-1"]), 2, "names a monitor");
    refused(
        &run(&["--panel", "auto", "--filter", "blend"]),
        2,
        "nearest view",
    );
    let screen = sized_screen((760, 560));
    let mut command = manyview();
    let command = command.args(run(&["--panel", "auto"]));
    let (code, _, said) = support::run(screen.give(command));
    assert_eq!(code, 2, "{said}");
    assert!(
        said.contains("--panel 'a': there is no such monitor"),
        "{said}"
    );
}

/// Two panels with lenses beside each other, and what an eye sees of both: x in mm from the middle of the wall.
fn seen(display: &Display, parts: &[RgbImage], x: f64) -> Vec<RgbImage> {
    let wall = of(display);
    let middle = wall.panels().iter().map(middle_of).sum::<f64>() / wall.panels().len() as f64;
    let panels = wall.panels().iter().zip(parts);
    let part = |(panel, part): (&manyview::display::WallPanel, &RgbImage)| {
        let optics = Optics::of(&panel.display, VIEWS).expect("lenses");
        let setup = Setup {
            pixel: PIXEL,
            cone: CONE,
            crosstalk: 0.0,
            design: Some(VIEWER),
        };
        let eye = Eye {
            x: x + middle - middle_of(panel),
            y: 0.0,
            z: VIEWER,
        };
        see(part, &optics, &setup, eye, &|| {}).expect("a picture")
    };
    panels.map(part).collect()
}

const PIXEL: f64 = 0.25;
const CONE: f64 = 30.0;
const VIEWER: f64 = 700.0;

fn middle_of(panel: &manyview::display::WallPanel) -> f64 {
    panel.corners().iter().map(|corner| corner[0]).sum::<f64>() / 4.0
}

/// Two panels of lenses, 5 mm apart; `viewer` is a line of the description.
fn two(folder: &Path, size: (u32, u32), viewer: &str) -> Display {
    let own = format!(
        "kind = 'slanted'\nviews = 8\npitch = 9.3\nslant = '2/3'\ninverted = true\ncone = {CONE}"
    );
    std::fs::write(folder.join("own.toml"), own).expect("written");
    let width = f64::from(size.0) * PIXEL;
    let panel = |monitor: &str, at: f64| {
        format!(
            "[[panel]]\nmonitor = '{monitor}'\ndisplay = 'own.toml'\npixels = '{}x{}'\nat = [{at}, 0]\nwidth = {width}\n",
            size.0, size.1
        )
    };
    let text = format!(
        "kind = 'wall'\nviews = 8\n{viewer}\n{}{}",
        panel("a", 0.0),
        panel("b", width + 5.0)
    );
    let file = folder.join("two.toml");
    std::fs::write(&file, text).expect("written");
    load(&file.to_string_lossy()).expect("a wall")
}

/// The parts of the sheet that the panels show.
fn parts(display: &Display, views: &[RgbImage]) -> Vec<RgbImage> {
    let described = of(display);
    let (width, height) = described.sheet();
    let mask = display.mask(&Placement::full_screen(width, height), VIEWS);
    let size = views[0].dimensions();
    let nodes = described.nodes(size, Fit::Cover);
    let columns = described.node_count().0;
    let sheet = wall(views, &mask.expect("a mask"), &nodes, columns).expect("a picture");
    let panels = described.panels().iter();
    let part = |panel: &manyview::display::WallPanel| {
        let [x, y] = panel.at;
        sheet.view(x, y, panel.pixels.0, panel.pixels.1).to_image()
    };
    panels.map(part).collect()
}

/// Of a seen picture beside its left or right edge: its mean grey.
fn edge(picture: &RgbImage, right: bool) -> f64 {
    let (width, height) = picture.dimensions();
    let left = if right { width - 24 } else { 8 };
    let part = picture.view(left, height / 4, 16, height / 2).to_image();
    part.pixels()
        .map(|pixel| f64::from(pixel.0[1]))
        .sum::<f64>()
        / f64::from(16 * (height / 2))
}

#[test]
fn eyes_that_see_across_a_border_see_one_view() {
    let folder = tempfile::tempdir().expect("a folder");
    let size = (480, 120);
    // View i is as bright as its number, so that the brightness tells the view.
    let views: Vec<RgbImage> = (0..VIEWS as u8)
        .map(|view| RgbImage::from_pixel(640, 120, image::Rgb([20 + 25 * view; 3])))
        .collect();
    let off = |display: &Display| {
        let shown = parts(display, &views);
        let eyes = [-120.0, -80.0, -40.0, 0.0, 40.0, 80.0, 120.0];
        let off = eyes.map(|x| {
            let seen = seen(display, &shown, x);
            (edge(&seen[0], true) - edge(&seen[1], false)).abs() / 25.0
        });
        off.into_iter().fold(0.0, f64::max)
    };
    let met = off(&two(folder.path(), size, &format!("viewer = {VIEWER}")));
    let apart = off(&two(folder.path(), size, ""));
    assert!(met <= 1.0, "{met} views apart at the border");
    assert!(apart > 2.0, "{apart}: the test tells nothing");
}

/// Writes the picture of docs/gallery.md: what three eyes see of a scene on two panels.
#[test]
#[ignore = "`make gallery` runs it"]
fn gallery_wall() {
    let folder = support::scratch("gallery");
    let out = folder.join("wall-views.png");
    let (width, height) = (960, 360);
    let mut command = manyview();
    command.args([
        "capture", "--frame", "40", "--what", "atlas", "--views", "8",
    ]);
    command
        .args(["--eye-spacing", "0.3", "--focal-depth", "8", "--out"])
        .arg(&out);
    command.arg("--").arg(support::demo("mirror"));
    command.args(["--size", &format!("{width}x{height}")]);
    succeed(&mut command);
    let all = rgb(&out);
    let view = |i| all.view(i * width, 0, width, height).to_image();
    let views: Vec<RgbImage> = (0..VIEWS).map(view).collect();
    let display = two(&folder, (480, 360), &format!("viewer = {VIEWER}"));
    let shown = parts(&display, &views);
    let (wide, gap) = (960 + 20, 12);
    let mut strip = RgbImage::from_pixel(wide, 3 * 360 + 2 * gap, image::Rgb([255; 3]));
    for (row, x) in (0..).zip([-100.0, 0.0, 100.0]) {
        for (column, picture) in (0..).zip(seen(&display, &shown, x)) {
            let at = [column * (480 + 20), row * (360 + i64::from(gap))];
            image::imageops::replace(&mut strip, &picture, at[0], at[1]);
        }
    }
    strip.save(folder.join("wall-strip.png")).expect("saved");
}
