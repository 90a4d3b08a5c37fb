//! Walls: their descriptions, where their panels are, what each pixel shows.

use super::*;
use crate::display::{Homography, Wall, WallPanel, apply, placed};

const TEXT: &str = r#"
kind = "wall"
views = 8

[[panel]]
monitor = "DP-1"
display = "lenticular-8"
pixels = "100x60"
at = [0, 0]
width = 200

[[panel]]
monitor = "DP-2"
display = "own.toml"
pixels = "80x60"
at = [210, 10]
width = 160
turn = 5
light = 0.9
border = [2, 3, 4, 5]
"#;

fn read(text: &str) -> Result<Display, DisplayError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wall.toml");
    fs::write(&path, text).unwrap();
    let own = "kind = 'slanted'\nviews = 9\npitch = '16/3'\nslant = '2/3'";
    fs::write(folder.path().join("own.toml"), own).unwrap();
    Display::load(path.to_str().unwrap())
}

fn wall(text: &str) -> (Display, std::sync::Arc<Wall>) {
    let display = read(text).unwrap();
    match &display.kind {
        Kind::Wall(wall) => (display.clone(), wall.clone()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn panels_lie_beside_each_other_in_a_sheet() {
    let (display, wall) = wall(TEXT);
    let at: Vec<_> = wall.panels().iter().map(|panel| panel.at).collect();
    // 100 pixels are 7 cells, and one is between the panels.
    assert_eq!(at, [[0, 0], [128, 0]]);
    assert_eq!(wall.sheet(), (128 + 96, 80));
    assert_eq!(display.facts.screen, Some(wall.sheet()));
    assert_eq!(display.views, 8);
    let four: Vec<WallPanel> = wall.panels().iter().chain(wall.panels()).cloned().collect();
    let four = Wall::new(four, None).unwrap();
    assert_eq!(four.panels()[3].at, [128, 80]);
}

#[test]
fn each_panel_has_its_own_mask_and_its_border_is_black() {
    let (display, wall) = wall(TEXT);
    let (width, height) = wall.sheet();
    let mask = display
        .mask(&Placement::full_screen(width, height), 8)
        .unwrap();
    let own = &wall.panels()[1].display;
    let own = own.mask(&Placement::full_screen(80, 60), 8).unwrap();
    for (x, row) in [(0, 0), (99, 59), (17, 30)] {
        assert_eq!(mask.at(x, row), Some([(x % 8) as u16; 3]), "{x} {row}");
    }
    for (x, row) in [(2, 3), (75, 54), (40, 30)] {
        assert_eq!(mask.at(128 + x, row), own.at(x, row), "{x} {row}");
    }
    for (x, row) in [(1, 30), (40, 2), (76, 30), (40, 55)] {
        assert_eq!(mask.at(128 + x, row), Some([GUARD; 3]), "{x} {row}");
    }
    assert_eq!(mask.at(100, 0), Some([GUARD; 3]), "between the panels");
}

#[test]
fn the_nodes_are_where_the_panels_are() {
    let (_, wall) = wall(TEXT);
    // Turned by 5° about its left top corner.
    let (sine, cosine) = 5_f64.to_radians().sin_cos();
    let right = 210.0 + 160.0 * cosine;
    let bottom = 10.0 + 160.0 * sine + 120.0 * cosine;
    let left = wall.panels()[1].corners()[3][0];
    assert!((left - (210.0 - 120.0 * sine)).abs() < 1e-9);
    let [x, y, width, height] = wall.picture((640, 480), Fit::Stretch);
    assert!(x.abs() < 0.01 && y.abs() < 0.01, "{x} {y}");
    assert!(
        (width - right).abs() < 0.02 && (height - bottom).abs() < 0.02,
        "{width} {height}"
    );
    let contained = wall.picture((640, 480), Fit::Contain);
    assert!((contained[2] / contained[3] - 640.0 / 480.0).abs() < 1e-3);
    let nodes = wall.nodes((640, 480), Fit::Stretch);
    let (columns, _) = wall.node_count();
    // The node at pixel (32, 16) of the second panel.
    let node = nodes[(columns + 8 + 2) as usize];
    let expected = [
        210.0 + 64.0 * cosine - 32.0 * sine,
        10.0 + 64.0 * sine + 32.0 * cosine,
    ];
    for axis in 0..2 {
        let share = expected[axis] / [width, height][axis];
        assert!(
            (f64::from(node[axis]) - share).abs() < 1e-4,
            "{node:?} {share}"
        );
    }
    assert_eq!(node[2], 0.9);
    // In pixels of the first panel, which is half a pixel to a mm.
    let shown = f64::from(wall.picture_width((640, 480), Fit::Stretch));
    assert!((shown - width / 2.0).abs() < 1.0, "{shown}");
}

/// A cell's corners say within 0.005 pixels where each of its pixels is.
#[test]
fn between_the_corners_of_a_cell_the_warp_is_as_good_as_exact() {
    // Seen from three widths, a panel turned by 30° about its middle axis.
    let (sine, cosine) = 30_f64.to_radians().sin_cos();
    let far = 3.0 * 1920.0;
    let tilted: Homography = [[cosine * far, 0.0, 0.0], [0.0, far, 0.0], [sine, 0.0, far]];
    let mut worst = 0.0_f64;
    for cell in (0..1920).step_by(16) {
        let at = |x: f64, y: f64| apply(&tilted, [f64::from(cell) + x, 500.0 + y]);
        for (x, y) in [(8.0, 8.0), (4.0, 12.0), (15.5, 0.5)] {
            let mix = |a: [f64; 2], b: [f64; 2], t: f64| [0, 1].map(|i| a[i] + (b[i] - a[i]) * t);
            let upper = mix(at(0.0, 0.0), at(16.0, 0.0), x / 16.0);
            let lower = mix(at(0.0, 16.0), at(16.0, 16.0), x / 16.0);
            let [u, v] = mix(upper, lower, y / 16.0);
            let [a, b] = at(x, y);
            worst = worst.max((u - a).hypot(v - b));
        }
    }
    assert!(worst < 0.005, "{worst}");
}

#[test]
fn a_place_is_a_turn_and_a_scale() {
    let h = placed((100, 50), [10.0, 20.0], 200.0, 90.0);
    let [x, y] = apply(&h, [100.0, 0.0]);
    assert!((x - 10.0).abs() < 1e-9 && (y - 220.0).abs() < 1e-9);
}

#[test]
fn what_is_no_wall_is_refused_by_its_field() {
    let panel = "[[panel]]\nmonitor = 'DP-1'\ndisplay = 'rows'\npixels = '100x60'\n";
    let good = format!("kind = 'wall'\n{panel}at = [0, 0]\nwidth = 200\n");
    read(&good).unwrap();
    let mut said = Vec::new();
    for (from, to) in [
        ("[[panel]]", "[panel]"),
        ("monitor = 'DP-1'", ""),
        ("display = 'rows'", ""),
        ("display = 'rows'", "display = 'no-such'"),
        ("display = 'rows'", "display = 'looking-glass-go'"),
        ("display = 'rows'", "display = 'wall.toml'"),
        ("pixels = '100x60'", ""),
        ("at = [0, 0]", ""),
        ("at = [0, 0]", "at = [0]"),
        ("width = 200", ""),
        ("width = 200", "width = 0"),
        ("width = 200", "width = 200\nturn = 'much'"),
        ("width = 200", "width = 200\nlight = 0"),
        (
            "width = 200",
            "width = 200\nlight = { columns = 2, rows = 2, values = [1, 1, 1, 2] }",
        ),
        (
            "width = 200",
            "width = 200\nmesh-x = { columns = 2, rows = 2, values = [0, 0, 0, 0] }",
        ),
        ("width = 200", "width = 200\nborder = [50, 0, 50, 0]"),
        ("width = 200", "width = 200\nborder = 4"),
        ("width = 200", "width = 200\nbright = 1"),
        (
            "at = [0, 0]",
            "homography = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]",
        ),
        ("at = [0, 0]", "homography = [[1, 0, 0], [0, 1, 0]]"),
        ("kind = 'wall'", "kind = 'wall'\npitch = 3"),
        ("kind = 'wall'", "kind = 'wall'\nviewer = 800"),
        ("kind = 'wall'", "kind = 'wall'\nviewer = 'far'"),
    ] {
        let text = good.replacen(from, to, 1);
        assert_ne!(text, good);
        let error = read(&text).expect_err(to).to_string();
        let error = error.split("/").last().unwrap_or_default().to_owned();
        said.push(format!("{to:?}: {error}"));
    }
    insta::assert_snapshot!("walls", said.join("\n"));
}

/// An eye before the middle of the wall sees the panel at its side from the side, and is to see the same view there.
#[test]
fn views_are_moved_on_for_a_panel_at_the_side() {
    let panel = |monitor: &str, at: u32| {
        format!(
            "[[panel]]\nmonitor = '{monitor}'\ndisplay = 'own.toml'\npixels = '80x60'\nat = [{at}, 0]\nwidth = 160\n"
        )
    };
    let text = |viewer: &str| {
        format!(
            "kind = 'wall'\nviews = 9\n{viewer}{}{}",
            panel("a", 0),
            panel("b", 160)
        )
    };
    let folder = tempfile::tempdir().unwrap();
    let own = "kind = 'slanted'\nviews = 9\npitch = 9\ncone = 53.1301";
    fs::write(folder.path().join("own.toml"), own).unwrap();
    let path = folder.path().join("wall.toml");
    let load = |viewer: &str| {
        fs::write(&path, text(viewer)).unwrap();
        let display = Display::load(path.to_str().unwrap()).unwrap();
        let Kind::Wall(wall) = &display.kind else {
            panic!("a wall");
        };
        let (width, height) = wall.sheet();
        let mask = display
            .mask(&Placement::full_screen(width, height), 9)
            .unwrap();
        (wall.panels()[1].at[0], mask)
    };
    let ((at, plain), (_, moved)) = (load(""), load("viewer = 720\n"));
    // The zone is as wide as the distance, 720 mm, and the middle of the panel is 80 mm to the right: a ninth of the views.
    for x in 0..80 {
        let on = |view: u16| (view + 1) % 9;
        let expected = plain.at(at + x, 7).unwrap().map(on);
        assert_eq!(moved.at(at + x, 7), Some(expected), "{x}");
        let back = |view: u16| (view + 8) % 9;
        assert_eq!(
            moved.at(x, 7),
            plain.at(x, 7).map(|views| views.map(back)),
            "{x}"
        );
    }
}
