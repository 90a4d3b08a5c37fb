//! Classes of draws: rules of a profile change them, flat draws stand at the depth that the demo gives itself, and one frame is explained.

use crate::support;
use crate::support::{Picture, capture, dump, library, manyview, rgb, screen, succeed};
use image::RgbImage;
use std::path::{Path, PathBuf};

const SIZE: [&str; 2] = ["--size", "300x220"];
const WIDTH: u32 = 300;
const VIEWS: u32 = 5;
const OWN: u32 = 2;

/// The views of the first frame.
fn views(demo: &str, layer: &[&str]) -> Vec<RgbImage> {
    let common = [
        "--views",
        "5",
        "--what",
        "atlas",
        "--eye-spacing",
        "0.3",
        "--focal-depth",
        "8",
    ];
    // Views lie at the origin unless a test is about their place.
    let layout: &[&str] = if layer.contains(&"--atlas") {
        &[]
    } else {
        &["--atlas", "layers"]
    };
    let all = capture(demo, &SIZE, 1, &[&common, layout, layer].concat());
    let all = image::DynamicImage::from(all).into_rgb8();
    assert_eq!(all.width(), VIEWS * WIDTH);
    (0..VIEWS)
        .map(|view| {
            image::imageops::crop_imm(&all, view * WIDTH, 0, WIDTH, all.height()).to_image()
        })
        .collect()
}

/// The picture that a demo draws without the layer.
fn own(demo: &str, arguments: &[&str]) -> RgbImage {
    let picture: Picture = dump(demo, &[&SIZE, &["--frames", "1"], arguments].concat());
    image::DynamicImage::from(picture).into_rgb8()
}

/// Writes a profile into a folder.
fn profile(folder: &Path, text: &str) -> String {
    let path = folder.join("profile.toml");
    std::fs::write(&path, text).expect("written");
    path.to_str().expect("UTF-8").to_owned()
}

/// Columns with a pixel that differs.
fn columns(a: &RgbImage, b: &RgbImage) -> Vec<u32> {
    let differs = |&x: &u32| (0..a.height()).any(|y| a.get_pixel(x, y) != b.get_pixel(x, y));
    (0..a.width()).filter(differs).collect()
}

#[test]
fn flat_draws_stand_at_the_depth_that_is_asked_for() {
    for depth in ["0.25", "-1"] {
        let views = views("sky", &["--hud-depth", depth]);
        for view in [0, 1, 4] {
            let want = own(
                "sky",
                &["--view", &format!("{view}/5"), "--hud-depth", depth],
            );
            let wrong = columns(&want, &views[view as usize]);
            assert!(wrong.is_empty(), "depth {depth}, view {view}: {wrong:?}");
        }
    }
}

#[test]
fn a_rule_that_makes_everything_flat_makes_all_views_equal() {
    let folder = tempfile::tempdir().expect("a folder");
    let profile = profile(folder.path(), "[[rule]]\nclass = \"flat\"\n");
    let before = own("room", &[]);
    for strategy in ["replay", "instanced", "geometry"] {
        let options = ["--strategy", strategy];
        let plain = views("room", &options);
        assert!(!columns(&before, &plain[0]).is_empty(), "{strategy}");
        for view in views("room", &[&options[..], &["--profile", &profile]].concat()) {
            assert!(columns(&before, &view).is_empty(), "{strategy}");
        }
    }
}

#[test]
fn a_rule_can_put_one_draw_elsewhere() {
    let folder = tempfile::tempdir().expect("a folder");
    // The first draw of the display: a dark panel at the lower left, 8 to 200 of 512 units wide.
    let text = "rule = [{ draw = 12, projection = \"orthographic\", class = \"flat\", depth = 1 }]";
    let profile = profile(folder.path(), text);
    let plain = views("room", &[]);
    let moved = views("room", &["--profile", &profile]);
    assert!(columns(&plain[OWN as usize], &moved[OWN as usize]).is_empty());
    let changed = columns(&plain[4], &moved[4]);
    // It moves by 18 pixels in the outermost view.
    let end = 200 * WIDTH / 512 + 20;
    assert!(!changed.is_empty(), "the panel is elsewhere");
    assert!(changed.iter().all(|&x| x < end), "{changed:?}");
}

#[test]
fn what_a_rule_takes_off_the_screen_is_in_the_own_view_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "rule = [{ projection = \"orthographic\", class = \"off-screen\" }]";
    let profile = profile(folder.path(), text);
    for layout in ["layers", "side-by-side"] {
        let options = ["--atlas", layout];
        let plain = views("room", &options);
        let without = views("room", &[&options[..], &["--profile", &profile]].concat());
        for (view, (plain, without)) in plain.iter().zip(&without).enumerate() {
            let same = columns(plain, without).is_empty();
            assert_eq!(same, view == OWN as usize, "{layout}, view {view}");
        }
    }
}

#[test]
fn a_sky_can_be_called_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let text =
        "rule = [{ depth-state = \"off\", projection = \"perspective\", class = \"scene\" }]";
    let profile = profile(folder.path(), text);
    let (sky, scene) = (views("sky", &[]), views("sky", &["--profile", &profile]));
    assert!(columns(&sky[OWN as usize], &scene[OWN as usize]).is_empty());
    assert!(!columns(&sky[0], &scene[0]).is_empty());
}

#[test]
fn what_is_drawn_to_the_near_depths_can_stand_about_a_depth_of_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let about = |depth: &str| {
        let text = format!(
            "rule = [{{ depth-range = \"near\", class = \"scene\", focal-depth = {depth} }}]"
        );
        views("sky", &["--profile", &profile(folder.path(), &text)])
    };
    let plain = views("sky", &[]);
    // The hand covers these columns in every view.
    let hand = WIDTH / 3..WIDTH;
    let (same, moved) = (about("8"), about("2"));
    for view in 0..VIEWS as usize {
        assert!(columns(&plain[view], &same[view]).is_empty(), "view {view}");
        let changed = columns(&plain[view], &moved[view]);
        assert_eq!(changed.is_empty(), view == OWN as usize, "view {view}");
        assert!(changed.iter().all(|x| hand.contains(x)), "{changed:?}");
    }
}

/// Runs a demo to its end and explains its second frame.
fn explain(demo_name: &str, options: &[&str], arguments: &[&str], out: &Path) -> String {
    library();
    let screen = screen();
    let mut command = manyview();
    command
        .args(["run", "--views", "5", "--explain-frame", "2", "--explain"])
        .arg(out)
        .args(options)
        .arg("--")
        .arg(support::demo(demo_name))
        .args(arguments)
        .args(SIZE)
        .args(["--frames", "3"]);
    let output = succeed(screen.give(&mut command));
    String::from_utf8(output.stderr).expect("UTF-8")
}

/// The draws of a list: class and reason, and the rule to paste into a profile.
fn draws(list: &Path) -> Vec<(String, String)> {
    let text = std::fs::read_to_string(list).expect("a list");
    let lines = text
        .lines()
        .filter(|line| !line.starts_with('#') && !line.starts_with(" draw"));
    lines
        .map(|line| {
            let rule = line.find('{').map_or("", |at| &line[at..]);
            let class = line[30..].split_whitespace().next().unwrap_or_default();
            (class.to_owned(), rule.to_owned())
        })
        .collect()
}

#[test]
fn a_frame_is_explained_as_picture_and_list() {
    let folder = tempfile::tempdir().expect("a folder");
    let said = explain("room", &[], &[], folder.path());
    let [picture, list] = ["explain.png", "explain.txt"].map(|name| folder.path().join(name));
    assert!(
        said.contains("wrote ") && said.contains("explain.txt"),
        "{said}"
    );
    let draws = draws(&list);
    let classes: Vec<_> = draws.iter().map(|(class, _)| class.as_str()).collect();
    assert_eq!(classes, [&["scene"; 11][..], &["flat"; 6]].concat());
    // Orange marks the display and green the room: at the cross-hair's centre and in the middle of the floor.
    let picture = rgb(&picture);
    assert_eq!(picture.dimensions(), (300, 238));
    let [r, g, b] = picture.get_pixel(60, 190).0;
    assert!(r > g && g > b, "the panel is flat: {r} {g} {b}");
    let [r, g, b] = picture.get_pixel(150, 200).0;
    assert!(g > b && b > r, "the floor is scene: {r} {g} {b}");
}

/// Programs with shaders of their own, too: their display is flat, and their sky one.
/// The demo has a texture of depths, whose image is none that a rule could name.
#[test]
fn a_texture_of_depths_is_explained_without_an_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let report = folder.path().join("report.json");
    let options = ["--report", report.to_str().expect("UTF-8")];
    explain("passes", &options, &[], folder.path());
    let text = std::fs::read_to_string(report).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(report["gl_errors"], 0, "{report}");
}

#[test]
fn what_shaders_draw_is_explained_as_it_is_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("why.png");
    let ways: [&[&str]; 3] = [&[], &["--box"], &["--box", "--glsl", "330"]];
    for (way, sky) in ways.into_iter().zip([None, Some(0), Some(5)]) {
        explain("shade", &[], way, &out);
        let mut expected = [&["scene"; 5][..], &["flat"; 4]].concat();
        sky.into_iter().for_each(|at| expected.insert(at, "sky"));
        let draws = draws(&out.with_extension("txt"));
        let classes: Vec<_> = draws.iter().map(|(class, _)| class.as_str()).collect();
        assert_eq!(classes, expected, "{way:?}");
    }
}

#[test]
fn every_rule_of_an_explanation_changes_the_class_of_its_draw() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("why.png");
    explain("sky", &[], &[], &out);
    let list: PathBuf = out.with_extension("txt");
    let before = draws(&list);
    assert!(before.iter().any(|(class, _)| class == "sky"), "{before:?}");
    for class in ["sky", "scene", "flat"] {
        let at = before.iter().position(|draw| draw.0 == class);
        let at = at.expect("a draw of each class");
        let rule = &before[at].1;
        let profile = profile(folder.path(), &format!("rule = [\n{rule}\n]\n"));
        explain("sky", &["--profile", &profile], &[], &out);
        let after = draws(&list);
        let text = std::fs::read_to_string(&list).expect("a list");
        let line = text.lines().nth(3 + at).expect("the draw's line");
        assert!(line.contains("rule 1 of the profile"), "{rule}\n{line}");
        assert_eq!(after.len(), before.len());
        assert!(class == "flat" || after[at].0 != class, "{rule}");
    }
}

/// Names of textures may be others in the next run, and an image is another one once the program has painted over it.
#[test]
fn a_rule_knows_an_image_by_what_it_shows() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("why.png");
    let list = out.with_extension("txt");
    let ruled = |profile: &str, arguments: &[&str]| -> Vec<usize> {
        explain("sky", &["--profile", profile], arguments, &out);
        let text = std::fs::read_to_string(&list).expect("a list");
        let lines = text.lines().skip(3).enumerate();
        let by_rule = lines.filter(|(_, line)| line.contains("rule 1 of the profile"));
        by_rule.map(|(at, _)| at).collect()
    };
    explain("sky", &[], &[], &out);
    let text = std::fs::read_to_string(&list).expect("a list");
    let ground = draws(&list).iter().position(|draw| draw.0 == "scene");
    let ground = ground.expect("the ground, after the six sides of the sky");
    let line = text.lines().nth(3 + ground).expect("its line");
    let sum = line.split("image = \"").nth(1).expect("an image");
    let rule = |key: &str| format!("rule = [{{ {key}, class = \"flat\" }}]");
    let by_image = profile(folder.path(), &rule(&format!("image = \"{}\"", &sum[..16])));
    let runs: [&[&str]; 3] = [&[], &["--renamed"], &["--repaint"]];
    let found = runs.map(|arguments| ruled(&by_image, arguments));
    assert_eq!(found, [vec![ground], vec![ground], vec![]]);
    let head = text.lines().nth(2).expect("the head");
    let column = head.find("texture").expect("a column");
    let name = &line[column..column + "texture".len()];
    let by_name = profile(folder.path(), &rule(&format!("texture = {}", name.trim())));
    assert_eq!(ruled(&by_name, &[]), [ground]);
    assert_ne!(ruled(&by_name, &["--renamed"]), [ground]);
}

#[test]
fn an_explanation_changes_nothing_of_the_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("why.png");
    let options = [
        "--explain-frame",
        "1",
        "--explain",
        out.to_str().expect("UTF-8"),
    ];
    for demo in ["mirror", "prims"] {
        let (plain, explained) = (views(demo, &[]), views(demo, &options));
        assert!(out.is_file(), "explained");
        std::fs::remove_file(&out).expect("removed");
        for (plain, explained) in plain.iter().zip(&explained) {
            assert!(columns(plain, explained).is_empty(), "{demo}");
        }
    }
}

#[test]
fn a_profile_is_chosen_by_the_name_of_the_program() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = "executable = \"room\"\nrule = [{ class = \"flat\" }]";
    std::fs::write(folder.path().join("some-game.toml"), text).expect("written");
    let classes = |options: &[&str]| {
        let report = folder.path().join("report.json");
        let screen = screen();
        let mut command = manyview();
        command
            .env("MANYVIEW_PROFILES", folder.path())
            .args(["run", "--report"])
            .arg(&report)
            .args(options)
            .arg("--")
            .arg(support::demo("room"))
            .args(["--frames", "2"]);
        succeed(screen.give(&mut command));
        let text = std::fs::read_to_string(&report).expect("a report");
        let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        report["classes"]["scene"].as_u64()
    };
    assert_eq!(classes(&[]), None, "all flat");
    assert_eq!(classes(&["--profile", "none"]), Some(22));
    assert_eq!(classes(&["--profile", "some-game"]), None);
}
