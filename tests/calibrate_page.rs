//! The page of calibration word by word: its commands in their order, by a user who knows the size of a panel and takes the photos that they name with a simulated phone.

use crate::optics::compare::{Sampling, compare};
use crate::optics::displays::display;
use crate::optics::eye::Truth;
use crate::optics::photograph_jpeg;
use crate::optics::scenario::{Scenario, Taking, scenario};
use image::RgbImage;
use manyview::display::{Display, Placement};
use std::path::Path;
use std::process::Command;

/// A display of the size that the page has.
const SEED: u64 = 1;
/// The photos of the page, and which shot of a scenario each is: from the front, from the left, from the right.
const PHOTOS: [(&str, usize); 4] = [
    ("gratings.jpg", 0),
    ("front.jpg", 0),
    ("left.jpg", 1),
    ("right.jpg", 2),
];

/// The first block of commands under "From photos".
fn commands() -> Vec<String> {
    let page = std::fs::read_to_string("docs/calibration.md").expect("the page");
    let (_, part) = page.split_once("## From photos").expect("the part");
    let lines = part.lines().skip_while(|line| !line.starts_with("    "));
    let lines = lines.map_while(|line| line.strip_prefix("    manyview "));
    lines.map(str::to_owned).collect()
}

/// What the panel shows when a picture is shown full screen, as a photo.
fn photo(scenario: &Scenario, picture: &Path, shot: usize) -> Vec<u8> {
    let picture: RgbImage = image::open(picture).expect("a picture").into_rgb8();
    let shown = scenario.showing.apply(&scenario.display.panel, &picture);
    photograph_jpeg(&scenario.display, &shown, &scenario.shots[shot]).expect("a file")
}

#[test]
fn the_page_of_calibration_leads_to_a_panel_that_shows_one_view_to_each_eye() {
    let scenario = scenario("ordinary", &display(SEED), Taking::new(SEED)).expect("a name");
    let folder = tempfile::tempdir().expect("a folder");
    let commands = commands();
    assert!(commands.len() >= 4, "{commands:?}");
    let (mut shown, mut panel) = (None, None);
    for line in &commands {
        let words: Vec<&str> = line.split_whitespace().collect();
        for word in &words {
            if let Some((name, shot)) = PHOTOS.iter().find(|(name, _)| name == word) {
                let picture: &Path = shown.as_deref().expect("a pattern comes first");
                let file = photo(&scenario, picture, *shot);
                std::fs::write(folder.path().join(name), file).expect("written");
            }
        }
        let output = Command::new(env!("CARGO_BIN_EXE_manyview"))
            .current_dir(folder.path())
            .args(&words)
            .output()
            .expect("the command");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{line}: {errors}");
        let out = words.iter().skip_while(|word| **word != "--out").nth(1);
        let out = folder.path().join(out.expect("each command writes a file"));
        match words[1] {
            "pattern" => shown = Some(out),
            _ => panel = Some(out),
        }
    }
    let panel = panel.expect("a display file");
    let found = Display::load(panel.to_str().expect("UTF-8")).expect("a display");
    let size = (scenario.display.panel.columns, scenario.display.panel.rows);
    let placement = Placement::full_screen(size.0 as u32, size.1 as u32);
    let mask = found.mask(&placement, found.views).expect("a mask");
    // Its views, of which there are as many as a lens has subpixels, in those of the display.
    let views = f64::from(found.views) / f64::from(scenario.display.views);
    let view = |x: usize, row: usize, colour: usize| {
        let at = mask.at(x as u32, row as u32).expect("a pixel");
        (f64::from(at[colour]) + 0.5) / views
    };
    // A whole view is off by half of itself at its ends.
    let sampling = Sampling {
        tolerance: 0.5 + 0.5 / views,
        ..Sampling::default()
    };
    let compared = compare(&Truth::new(&scenario.display), view, sampling);
    assert!(
        compared.wrong < 0.01,
        "{:.1} % of the subpixels are wrong: {compared:?}",
        100.0 * compared.wrong
    );
    assert!(compared.wrong_after_offset < 0.01, "{compared:?}");
}

#[test]
fn options_that_gratings_do_not_need_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = |words: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_manyview"))
            .current_dir(folder.path())
            .args(["calibrate", words[0], "--size", "400x300"])
            .args(&words[1..])
            .output()
            .expect("the command");
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    let told = run(&["pattern", "--views", "8", "--dpi", "90", "--out", "a.png"]);
    assert!(folder.path().join("a.png").is_file(), "{told}");
    for part in [
        "--views has no effect",
        "--dpi has no effect",
        "--size 400x300 --out rough.toml",
    ] {
        assert!(told.contains(part), "{told}");
    }
    let told = run(&["fit", "--bias", "--out", "a.toml", "absent.jpg"]);
    for part in ["--bias has no effect", "absent.jpg"] {
        assert!(told.contains(part), "{told}");
    }
    let told = run(&["fit", "--views", "1", "--out", "a.toml", "absent.jpg"]);
    assert!(
        told.contains("the number of views is 1; give 2 to 256"),
        "{told}"
    );
    assert!(!folder.path().join("a.toml").exists());
}
